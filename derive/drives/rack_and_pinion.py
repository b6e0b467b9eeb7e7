"""The cylindrical worm drive as rack and pinion: explicit contact and limit points.

The worm, or the hob that cuts the wheel, slides along its axis as a rack of profile Rz(ψ) P(t); turning it by φ
with the profile held at ψ = λ + φ is the same. Its parameter λ (``turn``) then enters the equation of meshing only
by the slide p λ, and the equation is linear in it. Everything holds for any helicoid, given by its section; frames
as in the drive: z along the worm, x to the wheel, whose axis is (0, sin Σ, cos Σ) through (A, 0, 0).
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace

import sympy as sp

from derive.language import vectors as v
from derive.language.chain import Rx, Rz, translation
from derive.language.envelope import envelope, in_turn, merge_sum
from derive.language.functions import both_turns
from derive.language.replace import replaced
from derive.language.surface import Surface
from derive.language.symbols import Quantity, rotation_angle


@dataclass(frozen=True)
class Rack:
    """A helicoid ``flank`` with parameters (t, λ) that meshes with a wheel at the velocity ratio I = ω2/ω1."""

    flank: Surface
    screw_parameter: sp.Expr
    ratio: sp.Expr
    center_distance: sp.Expr
    shaft_angle: sp.Expr

    @property
    def pitch_line(self) -> sp.Expr:
        """Distance of the pitch line from the worm axis at right angles, R1j = A − p/I."""
        return self.center_distance - self.screw_parameter / self.ratio


def wheel_axis(shaft_angle: sp.Expr) -> v.Vector:
    """Direction of the wheel axis."""
    return Rx(-shaft_angle).direction(v.K)


def meshing(rack: Rack, psi: sp.Expr, turn: sp.Expr) -> sp.Expr:
    """The equation of meshing n·(ω1 × r − ω2 × (r − A i)) at rack angle ψ, the rack having slid by p·``turn``.

    Derived from the chain: hob turns by φ, blank by I φ about minus its axis.
    """
    turn_of_flank = rack.flank.parameters[1]
    phi = rotation_angle("phi_rack", "angle of the worm or hob")
    chain = (
        Rz(rack.ratio * phi) @ Rx(rack.shaft_angle) @ translation(x=-rack.center_distance) @ Rz(phi)
    )
    generated = envelope(rack.flank, chain, phi)
    merged, total = merge_sum(generated, turn_of_flank, phi, "psi_rack", "rack angle")
    return replaced(merged.conditions[-1], {total: psi, turn_of_flank: turn})


def placed_in_generation(rack: Rack, psi: sp.Expr, turn: sp.Expr) -> Surface:
    """The flank at rack angle ψ, having slid by p·``turn``, in the fixed frame of generation."""
    return replace(rack.flank, motion=translation(z=rack.screw_parameter * turn) @ Rz(psi))


def contacts_of_worm_point(rack: Rack, turn: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
    """The two rack angles ψ at which the worm point (t, λ = ``turn``) touches the wheel, right angles only.

    a cos ψ + b sin ψ = c: two contacts a revolution, one at a limit point of the second type, none beyond.
    """
    psi = rotation_angle("psi_rack", "rack angle")
    right_angle = replace(rack, shaft_angle=sp.pi / 2)
    return both_turns(*in_turn(meshing(right_angle, psi, turn), psi))


def second_type_angles(rack: Rack) -> tuple[sp.Expr, sp.Expr]:
    """The two rack angles ψ at which the contact normal passes through the point (R1j, 0, 0), right angles only.

    There the two contacts of a worm point fall together (∂f/∂φ = 0 at fixed (t, λ)): the boundary of the region of
    worm points that ever touch. Moment of the normal about the parallel to the worm axis through that point.
    """
    psi = rotation_angle("psi_rack", "rack angle")
    section, normal = rack.flank.point, rack.flank.normal
    about_worm_axis = v.dot(normal, v.cross(v.K, section))
    transverse = Rz(psi).direction(normal)[1]
    return both_turns(*in_turn(about_worm_axis - rack.pitch_line * transverse, psi))


def section_angle(rack: Rack, offset: sp.Expr) -> sp.Expr:
    """The rack angle ψ at which the profile point P(t) lies in the plane y = ``offset``, on the wheel's side."""
    x, y, _ = rack.flank.point
    return sp.asin(offset / v.radius(x, y)) - v.arc(y, x)


def first_type(rack: Rack, placed: v.Vector, parameters: Iterable[Quantity]) -> sp.Expr:
    """Zero where the normal of the surface of action meets the wheel axis: limit points of the first type.

    ``placed`` is the contact point in the fixed frame of generation as a function of ``parameters``; its surface is
    tangent there to the wheel's velocity, so that the wheel's flank is singular (undercut).
    """
    definitions = rack.flank.definitions
    first, second = (definitions.derivative_vector(placed, q) for q in parameters)
    arm = v.sub(placed, v.vector(rack.center_distance, 0, 0))
    return v.dot(v.cross(first, second), v.cross(wheel_axis(rack.shaft_angle), arm))


def meshing_axes(rack: Rack) -> tuple[sp.Expr, tuple[tuple[v.Vector, v.Vector], ...]]:
    """The two lines that every contact normal meets: (discriminant, ((point, direction), (point, direction))).

    A helicoid's normal resists no motion in its own screw, so the relative twist may be completed by any share τ of
    it; an axis is where the sum is a pure rotation, direction · velocity = 0, quadratic in τ. No real root: no axis.
    """
    definitions = rack.flank.definitions
    tau = sp.Symbol("_tau")
    omega = v.scale(-rack.ratio, wheel_axis(rack.shaft_angle))
    direction = v.add(v.sub(omega, v.K), v.scale(tau, v.K))
    arm = (rack.center_distance, sp.Integer(0), sp.Integer(0))
    velocity = v.add(v.cross(arm, omega), v.scale(tau * rack.screw_parameter, v.K))
    a, b, c = sp.Poly(v.dot(direction, velocity), tau).all_coeffs()
    discriminant = definitions.let("axes_discriminant", b**2 - 4 * a * c, "negative where there are no meshing axes")
    axes: list[tuple[v.Vector, v.Vector]] = []
    for k, sign in enumerate((-1, 1), 1):
        root = (-b + sign * v.root(discriminant)) / (2 * a)
        share = {tau: definitions.let(f"axis_{k}_share", root, "share of the screw that makes the twist a rotation")}
        line = tuple(replaced(d, share) for d in direction)
        square = definitions.let(f"axis_{k}_square", v.dot(line, line), "squared angular velocity about the axis")
        foot = replaced(v.cross(direction, velocity)[0], share) / square
        axes.append(((foot, sp.Integer(0), sp.Integer(0)), line))
    return discriminant, tuple(axes)
