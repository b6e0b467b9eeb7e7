"""Surfaces: a curve carried by a motion, its tangents and its normal.

A surface keeps its point, tangents and normal in the frame where they are simple (the tool's section) together
with the motion into the body frame. Nothing is multiplied out.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Self, TypeAlias

import sympy as sp

from derive.language import vectors as v
from derive.language.chain import Motion, Rz, screw, station
from derive.language.definitions import Definitions
from derive.language.origin import cited, joined, said
from derive.language.sampled import NEGLIGIBLE, sampled
from derive.language.symbols import Quantity
from derive.language.vectors import Number
from derive.language.written import page_file

#: What a step may be made of.
StepData: TypeAlias = Motion | v.Vector | Number


@dataclass(frozen=True)
class Step:
    """A step by which a surface was made: its name and what went into it, by name.

    ``swept``: a ``curve`` in ``along`` carried by ``motion``, which ``sweep`` moves; the normal is ``outward`` times
    the tangents' cross product. ``given``: point, tangents and normal written down. ``moved`` by ``motion``.
    ``envelope`` under ``motion``, which ``variable`` moves. ``merged``: ``total`` = ``kept`` + ``removed`` replaces
    ``removed``. ``solved``: the last condition solved for ``parameter``, whose value is ``value``.
    """

    word: str
    data: tuple[tuple[str, StepData], ...]

    @classmethod
    def of(cls, word: str, **data: StepData) -> Self:
        return cls(word, tuple(data.items()))


@dataclass(frozen=True)
class Surface:
    """A surface in its body frame.

    ``point``, the two ``tangents`` and ``normal`` are in the section frame and depend on ``parameters`` through
    ``definitions``; ``motion`` takes the section frame into the body frame. ``conditions`` are equations (= 0)
    left implicit: a surface with k conditions has k + 2 parameters. The normal points out of the body, has any
    positive length, and the tangents, of any length, span its plane. An envelope keeps the tangents of its
    generating surface, which touch it; they are then not its derivatives. ``pole`` is any other point of the
    normal's line, section frame: n·(ω × r) does not change along it, so that the equation of meshing may be formed
    there. ``steps`` are the statements of the record on which its derivation so far rests; ``made`` are the
    :class:`Step` by which it came about, none for a surface that is written down.
    """

    definitions: Definitions
    parameters: tuple[Quantity, ...]
    point: v.Vector
    tangents: tuple[v.Vector, ...]
    normal: v.Vector
    motion: Motion = Motion()
    conditions: tuple[sp.Expr, ...] = ()
    pole: v.Vector | None = None
    steps: tuple[str, ...] = ()
    made: tuple[Step, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "steps", cited(self.steps))

    def on(self, *statements: str) -> Self:
        """The same surface, resting on these statements of the record as well."""
        page = page_file()
        return replace(self, steps=joined(self.steps, [said(statement, self, page) for statement in statements]))

    @property
    def rests_on(self) -> tuple[str, ...]:
        """Statements of the record behind the surface in its body frame."""
        return joined(self.steps, self.motion.rests_on)

    def with_pole(self, pole: v.Vector) -> Self:
        """The same surface, with another point of the normal's line, section frame."""
        return replace(self, pole=pole)

    def in_order(self, *parameters: Quantity) -> Self:
        """The same surface with its parameters in this order: across the tooth, then along it."""
        return replace(self, parameters=parameters)

    def turned_over(self) -> Self:
        """The same surface as the border of the body on its other side: a copy of the tool that stays at rest."""
        return replace(self, normal=v.scale(-1, self.normal))

    def placed(self, *motions: Motion) -> Self:
        """The surface moved by the product of these motions (leftmost acting last)."""
        motion = self.motion
        for outer in reversed(motions):
            motion = outer @ motion
        moves = (Step.of("moved", motion=outer) for outer in reversed(motions))
        return replace(self.written_down, motion=motion).by(*moves)

    @property
    def written_down(self) -> Self:
        """The same surface; one that no step has made is given as it stands."""
        if self.made:
            return self
        first, second = self.tangents
        given = Step.of("given", point=self.point, normal=self.normal, motion=self.motion, first=first, second=second)
        return self.by(given)

    def by(self, *steps: Step) -> Self:
        """The same surface, made by these further steps."""
        return replace(self, made=(*self.made, *steps))

    @cached_property
    def body_point(self) -> v.Vector:
        """The point in the body frame."""
        return self.motion.point(self.point)

    @cached_property
    def body_normal(self) -> v.Vector:
        """The normal in the body frame."""
        return self.motion.direction(self.normal)

    @cached_property
    def body_tangents(self) -> tuple[v.Vector, ...]:
        """The tangents in the body frame."""
        return tuple(self.motion.direction(t) for t in self.tangents)


def swept(
    definitions: Definitions,
    section: v.Vector,
    motion: Motion,
    *,
    along: Quantity,
    sweep: Quantity,
    outward: Number,
    arm: Number = 1,
    slope: v.Vector | None = None,
    screw: str = "",
) -> Surface:
    """The surface of a curve ``section(along)``, which may change with ``sweep``, carried by ``motion(sweep)``.

    The normal, section frame, is ``outward`` · (∂r/∂along × ∂r/∂sweep)/``arm``; ``outward`` (±1, or the flank
    sign) makes it point out of the body. ``arm`` > 0 is the length of ∂r/∂sweep where that is large: dividing it
    out keeps tangent and normal of order one. ``slope`` is a shorter vector along the section's derivative, to be used
    instead of it, as of a curve that may shrink to a point; ``ValueError`` if it is none. ``screw`` names
    the motion's turn and advance over ``sweep``, of which ∂r/∂sweep is then formed: for a motion of many factors and a
    section at rest.
    """
    steps = ("derivation/swept",)
    if screw:
        turn, advance = motion.screw(sweep)
        turn = definitions.let_vector(f"omega_{screw}", turn, f"turn of the section over {sweep}", "", "section")
        advance = definitions.let_vector(f"v_{screw}", advance, f"its advance over {sweep}", "mm/rad", "section")
        lengthwise, steps = v.add(advance, v.cross(turn, section)), (*steps, "derivation/screw")
        lengthwise = definitions.let_vector(f"v_{along}", lengthwise, f"velocity over {sweep}", "mm/rad", "section")
    else:
        lengthwise = v.add(motion.local_velocity(sweep, section), definitions.derivative_vector(section, sweep))
    across = definitions.derivative_vector(section, along)
    if slope is not None:
        require_parallel(tuple(map(definitions.resolve, across)), tuple(map(definitions.resolve, slope)))
        across = slope
    tangents = across, v.scale(1 / sp.sympify(arm), lengthwise)
    normal = v.scale(outward, v.cross(*tangents))
    made = Step.of("swept", curve=section, along=along, motion=motion, sweep=sweep, outward=outward)
    return Surface(definitions, (along, sweep), section, tangents, normal, motion, steps=steps, made=(made,))


def revolved(
    definitions: Definitions,
    profile: v.Vector,
    *,
    along: Quantity,
    turn: Quantity,
    outward: Number,
    radius: Number = 0,
    sense: Number = 1,
    slope: v.Vector | None = None,
) -> Surface:
    """The surface of revolution about z of a ``profile`` in the x–z half plane, measured from x = ``radius``.

    That place is its station, so that large lengths do not cancel. The tangent along the circle has unit length, so
    the normal is as long as the profile's tangent. ``sense`` −1 turns the other way. ``slope`` is a shorter vector
    along the profile's derivative, to be used instead of it; ``ValueError`` if it is none.
    """
    tangent = definitions.derivative_vector(profile, along)
    if slope is not None:
        require_parallel(tuple(map(definitions.resolve, tangent)), tuple(map(definitions.resolve, slope)))
        tangent = slope
    tangents = (tangent, v.vector(*v.J))
    across = v.cross(*tangents)
    normal = v.scale(outward, across) if slope is None else v.signed(outward, across)
    motion = Rz(sense * turn) @ station(x=radius)
    made = Step.of("swept", curve=profile, along=along, motion=motion, sweep=turn, outward=sense * outward)
    return Surface(
        definitions, (along, turn), profile, tangents, normal, motion, steps=("derivation/revolved",), made=(made,)
    )


def require_parallel(derivative: v.Vector, slope: v.Vector) -> None:
    """Raise ``ValueError`` unless two vectors have the same direction."""
    for values in sampled((*derivative, *slope)):
        a, b = values[:3], values[3:]
        across = sum(abs(a[i] * b[j] - a[j] * b[i]) for i, j in ((1, 2), (2, 0), (0, 1)))
        if across > NEGLIGIBLE or sum(p * q for p, q in zip(a, b, strict=True)) <= 0:
            raise ValueError("the slope given is not along the derivative of the profile")


def helicoid(
    definitions: Definitions,
    section: v.Vector,
    *,
    along: Quantity,
    sweep: Quantity,
    parameter: sp.Expr,
    outward: Number,
) -> Surface:
    """The helicoid of a curve in screw motion: r = Rz(ψ) P(t) + p ψ k."""
    flank = swept(definitions, section, screw(sweep, parameter), along=along, sweep=sweep, outward=outward)
    return flank.on("helicoids/helicoid", "helicoids/normal")
