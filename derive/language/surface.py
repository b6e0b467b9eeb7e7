"""Surfaces: a curve carried by a motion, its tangents and its normal.

A surface keeps its point, tangents and normal in the frame where they are simple (the tool's section) together
with the motion into the body frame. Nothing is multiplied out.
"""

from dataclasses import dataclass, replace

import sympy as sp

from derive.language import vectors as v
from derive.language.chain import Motion, Rz, screw, station
from derive.language.definitions import Definitions
from derive.language.origin import joined


@dataclass(frozen=True)
class Surface:
    """A surface in its body frame.

    ``point``, the two ``tangents`` and ``normal`` are in the section frame and depend on ``parameters`` through
    ``definitions``; ``motion`` takes the section frame into the body frame. ``conditions`` are equations (= 0)
    left implicit: a surface with k conditions has k + 2 parameters. The normal points out of the body, has any
    positive length, and the tangents, of any length, span its plane. An envelope keeps the tangents of its
    generating surface, which touch it; they are then not its derivatives. ``pole`` is any other point of the
    normal's line, section frame: n·(ω × r) does not change along it, so that the equation of meshing may be formed
    there. ``steps`` are the statements of the record on which its derivation so far rests.
    """

    definitions: Definitions
    parameters: tuple
    point: tuple
    tangents: tuple
    normal: tuple
    motion: Motion = Motion()
    conditions: tuple = ()
    pole: tuple | None = None
    steps: tuple[str, ...] = ()

    def on(self, *statements):
        """The same surface, resting on these statements of the record as well."""
        return replace(self, steps=joined(self.steps, statements))

    @property
    def rests_on(self):
        """Statements of the record behind the surface in its body frame."""
        return joined(self.steps, self.motion.rests_on)

    def placed(self, *motions):
        """The surface moved by the product of these motions (leftmost acting last)."""
        motion = self.motion
        for outer in reversed(motions):
            motion = outer @ motion
        return replace(self, motion=motion)

    def body_point(self):
        return self.motion.point(self.point)

    def body_normal(self):
        return self.motion.direction(self.normal)

    def body_tangents(self):
        return tuple(self.motion.direction(t) for t in self.tangents)


def swept(definitions, section, motion, *, along, sweep, outward, arm=1):
    """The surface of a curve ``section(along)``, which may change with ``sweep``, carried by ``motion(sweep)``.

    The normal, section frame, is ``outward`` · (∂r/∂along × ∂r/∂sweep)/``arm``; ``outward`` (±1, or the flank
    sign) makes it point out of the body. ``arm`` > 0 is the length of ∂r/∂sweep where that is large: dividing it
    out keeps tangent and normal of order one.
    """
    lengthwise = v.add(motion.local_velocity(sweep, section), definitions.derivative_vector(section, sweep))
    tangents = definitions.derivative_vector(section, along), v.scale(1 / sp.sympify(arm), lengthwise)
    normal = v.scale(outward, v.cross(*tangents))
    return Surface(definitions, (along, sweep), section, tangents, normal, motion, steps=("derivation/swept",))


def revolved(definitions, profile, *, along, turn, outward, radius=0):
    """The surface of revolution about z of a ``profile`` in the x–z half plane, measured from x = ``radius``.

    That place is its station, so that large lengths do not cancel. The tangent along the circle has unit length, so
    the normal is as long as the profile's tangent.
    """
    tangents = (definitions.derivative_vector(profile, along), v.vector(*v.J))
    normal = v.scale(outward, v.cross(*tangents))
    motion = Rz(turn) @ station(x=radius)
    return Surface(definitions, (along, turn), profile, tangents, normal, motion, steps=("derivation/revolved",))


def helicoid(definitions, section, *, along, sweep, parameter, outward):
    """The helicoid of a curve in screw motion: r = Rz(ψ) P(t) + p ψ k."""
    flank = swept(definitions, section, screw(sweep, parameter), along=along, sweep=sweep, outward=outward)
    return flank.on("helicoids/helicoid", "helicoids/normal")
