"""The kinematic chain: rotations, translations and swings, their products, and the velocities they cause.

A motion maps coordinates of the moving body to coordinates of its parent, as an active right-handed product
that acts right to left. Products merge successive rotations about one axis and move a translation along an
axis through a rotation about it, so that only the angles that geometry needs remain in the equations.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar, TypeAlias, TypeVar

import sympy as sp

from derive.language import vectors as v
from derive.language.differentiate import partial
from derive.language.origin import joined
from derive.language.replace import replaced
from derive.language.vectors import Number

_Part = TypeVar("_Part", bound=sp.Expr)
_OTHERS = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}


def _turned(axis: str, cosine: sp.Expr, sine: sp.Expr, a: v.Vector) -> v.Vector:
    first, second = _OTHERS[axis]
    out = list(a)
    out[first] = cosine * a[first] - sine * a[second]
    out[second] = sine * a[first] + cosine * a[second]
    return tuple(out)


@dataclass(frozen=True)
class Rotation:
    """Rotation by ``angle`` about a coordinate axis."""

    axis: str
    angle: sp.Expr
    rests_on: ClassVar[tuple[str, ...]] = ("conventions/rotations", "conventions/sums", "derivation/rotation")

    def direction(self, a: v.Vector) -> v.Vector:
        return _turned(self.axis, v.cosine(self.angle), v.sine(self.angle), a)

    point = direction

    def expressions(self) -> tuple[sp.Expr, ...]:
        return (self.angle,)

    def turn(self, variable: sp.Symbol) -> v.Vector:
        """Angular velocity over ``variable``, which is the same in either frame."""
        return v.scale(partial(self.angle, variable), v.AXES[self.axis])

    def inverse(self) -> Rotation:
        return Rotation(self.axis, -self.angle)

    def local_velocity(self, variable: sp.Symbol, point: v.Vector) -> v.Vector:
        """∂/∂variable of a body-fixed point, as components in the moving frame."""
        return v.scale(partial(self.angle, variable), v.cross(v.AXES[self.axis], point))


@dataclass(frozen=True)
class Translation:
    """Translation by ``offset``."""

    offset: v.Vector
    rests_on: ClassVar[tuple[str, ...]] = ("derivation/translation",)

    def direction(self, a: v.Vector) -> v.Vector:
        return a

    def point(self, a: v.Vector) -> v.Vector:
        return v.add(self.offset, a)

    def expressions(self) -> tuple[sp.Expr, ...]:
        return self.offset

    def turn(self, variable: sp.Symbol) -> v.Vector:
        """None: see :meth:`Rotation.turn`."""
        return v.ORIGIN

    def inverse(self) -> Translation:
        return Translation(v.scale(-1, self.offset))

    def local_velocity(self, variable: sp.Symbol, point: v.Vector) -> v.Vector:
        return tuple(partial(c, variable) for c in self.offset)


@dataclass(frozen=True)
class Station(Translation):
    """A constant translation to the place, far from the axes, where everything happens.

    In a product it moves to the left end, and the rotations it passes become swings about their axes as seen from
    there: what remains are small displacements. Where two chains meet, their stations cancel as symbols.
    """

    rests_on: ClassVar[tuple[str, ...]] = ("derivation/translation", "derivation/swing")

    def inverse(self) -> Station:
        return Station(v.scale(-1, self.offset))


@dataclass(frozen=True)
class Swing:
    """Rotation by ``angle`` about the axis through ``centre``, for an arc whose radius may be huge.

    The displacement of the origin, (1 − R)·centre, is written with half angles so that no large lengths cancel.
    """

    axis: str
    angle: sp.Expr
    centre: v.Vector
    rests_on: ClassVar[tuple[str, ...]] = ("derivation/swing", "derivation/rotation")

    def direction(self, a: v.Vector) -> v.Vector:
        return _turned(self.axis, v.cosine(self.angle), v.sine(self.angle), a)

    def point(self, a: v.Vector) -> v.Vector:
        first, second = _OTHERS[self.axis]
        if (a[first], a[second]) == (self.centre[first], self.centre[second]):
            return a
        half = self.angle / 2
        versine, sine = 2 * sp.sin(half) ** 2, 2 * sp.sin(half) * sp.cos(half)
        shift: list[sp.Expr] = [*v.ORIGIN]
        shift[first] = versine * self.centre[first] + sine * self.centre[second]
        shift[second] = versine * self.centre[second] - sine * self.centre[first]
        return v.add(tuple(shift), self.direction(a))

    def expressions(self) -> tuple[sp.Expr, ...]:
        return (self.angle, *self.centre)

    def turn(self, variable: sp.Symbol) -> v.Vector:
        """As :meth:`Rotation.turn`."""
        return v.scale(partial(self.angle, variable), v.AXES[self.axis])

    def inverse(self) -> Swing:
        return replace(self, angle=-self.angle)

    def local_velocity(self, variable: sp.Symbol, point: v.Vector) -> v.Vector:
        rate = partial(self.angle, variable)
        return v.scale(rate, v.cross(v.AXES[self.axis], v.sub(point, self.centre)))


@dataclass(frozen=True)
class Placement:
    """A constant orthonormal frame: columns of the rotation (given, not checked here) and no motion of its own."""

    columns: tuple[v.Vector, ...]
    rests_on: ClassVar[tuple[str, ...]] = ("derivation/placement",)

    def direction(self, a: v.Vector) -> v.Vector:
        return v.combined(a, self.columns)

    point = direction

    def expressions(self) -> tuple[sp.Expr, ...]:
        return tuple(c for column in self.columns for c in column)

    def turn(self, variable: sp.Symbol) -> v.Vector:
        """None: see :meth:`Rotation.turn`."""
        return v.ORIGIN

    def inverse(self) -> Placement:
        return Placement(tuple(zip(*self.columns, strict=True)))

    def local_velocity(self, variable: sp.Symbol, point: v.Vector) -> v.Vector:
        return v.ORIGIN


#: An elementary motion.
Factor: TypeAlias = Rotation | Translation | Swing | Placement


def _along(axis: str, offset: v.Vector) -> bool:
    return all(c == 0 for c, e in zip(offset, v.AXES[axis], strict=True) if e == 0)


def _merged(left: Factor, right: Factor) -> list[Factor] | None:
    """The product of two neighbours as a shorter or better ordered list of factors, or None."""
    match left, right:
        case (Rotation(), Rotation()) if left.axis == right.axis:
            return _moving(Rotation(left.axis, left.angle + right.angle))
        case (Swing(), Swing()) if (left.axis, left.centre) == (right.axis, right.centre):
            return _moving(replace(left, angle=left.angle + right.angle))
        case (Translation(), Translation()) if type(left) is type(right):
            return _moving(replace(left, offset=v.add(left.offset, right.offset)))
        case (Rotation(), Translation()) if _along(left.axis, right.offset):
            return [right, left]
        case (_, Station()):
            return _passed(left, right)
        case _:
            return None


def _passed(factor: Factor, station: Station) -> list[Factor]:
    """factor · T(c) with the station T(c) on the left."""
    c = station.offset
    match factor:
        case Rotation() if not factor.angle.is_number:
            return [station, Swing(factor.axis, factor.angle, v.scale(-1, c))]
        case Swing():
            return [station, replace(factor, centre=v.sub(factor.centre, c))]
        case _:
            return [Station(factor.direction(c)), factor]


def _moving(factor: Rotation | Swing | Translation) -> list[Factor]:
    """The factor, or none where it moves nothing."""
    still = all(e == 0 for e in factor.offset) if isinstance(factor, Translation) else factor.angle == 0
    return [] if still else [factor]


def _normal_form(factors: Iterable[Factor]) -> tuple[Factor, ...]:
    """Merge and reorder neighbours until nothing changes; translations only move left, so this ends."""
    left = [f for f in factors if not (isinstance(f, Rotation | Swing) and f.angle == 0)]
    at = 0
    while at + 1 < len(left):
        merged = _merged(left[at], left[at + 1])
        if merged is None:
            at += 1
        else:
            left[at : at + 2] = merged
            at = max(at - 1, 0)
    return tuple(left)


#: Rotations of a long motion. Where so many act on point, normal, tangents and all their derivatives, it takes fewer
#: operations to turn the three axes of the body once and to write every vector by them.
LONG = 6

#: How many rotations turn the axes: those further out act on fewer vectors, which they turn one by one, and sums of
#: large lengths, which round off, come after fewer of them.
INNER = 4


def _moved_by(factor: Factor, variable: sp.Symbol) -> bool:
    return any(sp.sympify(e).has(variable) for e in factor.expressions())


@dataclass(frozen=True)
class Motion:
    """A product of elementary motions, leftmost acting last."""

    factors: tuple[Factor, ...] = ()

    @property
    def rests_on(self) -> tuple[str, ...]:
        """Statements of the record behind the elementary motions."""
        return joined(*(factor.rests_on for factor in self.factors))

    def __matmul__(self, other: Motion) -> Motion:
        return Motion(_normal_form((*self.factors, *other.factors)))

    def inverse(self) -> Motion:
        return Motion(tuple(f.inverse() for f in reversed(self.factors)))

    def point(self, a: v.Vector) -> v.Vector:
        """Parent coordinates of a point given in body coordinates."""
        if not self.is_long:
            return self._through(a)
        outer, inner = self._parts
        return outer._through(v.add(inner._through(v.ORIGIN), v.combined(a, inner._axes)))

    def _through(self, a: v.Vector) -> v.Vector:
        """The same, carried from factor to factor."""
        for factor in reversed(self.factors):
            a = factor.point(a)
        return a

    def direction(self, a: v.Vector) -> v.Vector:
        """Parent components of a free vector given in body components."""
        if not self.is_long:
            return self._turned(a)
        outer, inner = self._parts
        return outer._turned(v.combined(a, inner._axes))

    @cached_property
    def is_long(self) -> bool:
        """Whether vectors are written by the turned axes of the body, not turned one by one: see :data:`LONG`."""
        return sum(isinstance(f, Rotation) for f in self.factors) >= LONG

    @cached_property
    def _parts(self) -> tuple[Motion, Motion]:
        """The factors further out, and those from the body on that turn its axes: see :data:`INNER`."""
        rotations = [k for k, f in enumerate(self.factors) if isinstance(f, Rotation)]
        return Motion(self.factors[: rotations[-INNER]]), Motion(self.factors[rotations[-INNER] :])

    def _turned(self, a: v.Vector) -> v.Vector:
        """A free vector turned by one factor after the other."""
        for factor in reversed(self.factors):
            a = factor.direction(a)
        return a

    @cached_property
    def _axes(self) -> list[v.Vector]:
        """The axes of the body in the parent frame: the columns of the rotation."""
        return [self._turned(axis) for axis in (v.I, v.J, v.K)]

    def local_velocity(self, variable: sp.Symbol, point: v.Vector) -> v.Vector:
        """∂(parent coordinates)/∂variable of a body-fixed point, as components in the body frame."""
        rate: v.Vector = v.ORIGIN
        inner = Motion()
        for factor in reversed(self.factors):
            local = factor.local_velocity(variable, inner.point(point))
            rate = v.add(rate, inner.inverse().direction(local))
            inner = Motion((factor, *inner.factors))
        return rate

    def screw(self, variable: sp.Symbol) -> tuple[v.Vector, v.Vector]:
        """Angular velocity over ``variable``, and the velocity of the body's origin, as components in the body frame.

        That of any of its points is advance + turn × point, as :meth:`local_velocity` has it.
        """
        turn: v.Vector = v.ORIGIN
        advance: v.Vector = v.ORIGIN
        inner = Motion()
        for factor in reversed(self.factors):
            to_body = inner.inverse().direction
            turn = v.add(turn, to_body(factor.turn(variable)))
            advance = v.add(advance, to_body(factor.local_velocity(variable, inner.point(v.ORIGIN))))
            inner = Motion((factor, *inner.factors))
        return turn, advance

    def power(self, variable: sp.Symbol, point: v.Vector, normal: v.Vector) -> sp.Expr:
        """normal · velocity, each term formed in the frame of the factor that causes it.

        Scalar products do not change under rotation, so this is the meshing equation of a chain as a sum of
        n·(axis × r), free of every angle that does not matter. Of a long motion it is formed in the body frame.
        """
        if self.is_long:
            return v.dot(normal, self._velocity(variable, point))
        total: sp.Expr = sp.Integer(0)
        for factor in reversed(self.factors):
            total += v.dot(normal, factor.local_velocity(variable, point))
            point, normal = factor.point(point), factor.direction(normal)
        return total

    def _velocity(self, variable: sp.Symbol, point: v.Vector) -> v.Vector:
        """∂(parent coordinates)/∂variable of a body-fixed point, as components in the body frame, by the screw of the
        velocities.

        The screw is that of all factors in the frame next to the innermost one that the variable moves, where the axes
        of those further out stand still or nearly so; only its components turn with the body.
        """
        moving = [k for k, factor in enumerate(self.factors) if _moved_by(factor, variable)]
        if not moving:
            return v.ORIGIN
        inner = Motion(self.factors[moving[-1] :])
        turning, moved = v.ORIGIN, v.ORIGIN  # of the frame's origin
        for k in moving:
            factor, back = self.factors[k], Motion(self.factors[k + 1 : moving[-1]]).inverse()
            if isinstance(factor, Translation):
                moved = v.add(moved, back.direction(factor.local_velocity(variable, v.ORIGIN)))
            elif isinstance(factor, Rotation | Swing):
                centre = factor.centre if isinstance(factor, Swing) else v.ORIGIN
                rate = back.direction(v.scale(partial(factor.angle, variable), v.AXES[factor.axis]))
                moved = v.sub(moved, v.cross(rate, back.point(centre)))
                turning = v.add(turning, rate)
        moved = v.add(moved, v.cross(turning, inner._through(v.ORIGIN)))
        spin, shift = (tuple(v.dot(a, axis) for axis in inner._axes) for a in (turning, moved))
        return v.add(shift, v.cross(spin, point))

    def axis(self, variable: sp.Symbol) -> tuple[v.Vector, v.Vector]:
        """Unit direction and a point of the axis about which the body turns with ``variable``, parent frame.

        The sense of the direction is that in which a growing variable turns the body. Raises ValueError for a motion
        that is not one rotation by it.
        """
        at, factor, rate = self._turning(variable)
        outer = Motion(self.factors[:at])
        centre = factor.centre if isinstance(factor, Swing) else v.ORIGIN
        return outer.direction(v.scale(rate, v.vector(*v.AXES[factor.axis]))), outer.point(centre)

    def law(self, variable: sp.Symbol, instant: sp.Symbol) -> sp.Expr:
        """Angle by which the body turns about the :meth:`axis` of ``variable``, in its sense, for one radian of
        ``instant``.

        Raises ValueError where ``instant`` moves the body otherwise, or not in proportion.
        """
        at, factor, rate = self._turning(variable)
        if any(k != at and _moved_by(other, instant) for k, other in enumerate(self.factors)):
            raise ValueError(f"{instant} moves the body otherwise than about the axis of {variable}")
        slope = rate * partial(factor.angle, instant)
        if slope.has(instant) or slope.has(variable):
            raise ValueError(f"{instant} turns the body by {slope} for a radian, which is no fixed ratio")
        return slope

    def _turning(self, variable: sp.Symbol) -> tuple[int, Rotation | Swing, sp.Expr]:
        """The factor by which ``variable`` turns the body, its place, and its sense."""
        moving = [k for k, factor in enumerate(self.factors) if _moved_by(factor, variable)]
        if len(moving) != 1 or not isinstance(factor := self.factors[moving[0]], Rotation | Swing):
            raise ValueError(f"{variable} does not turn the body about one axis")
        rate = partial(factor.angle, variable)
        if rate not in (1, -1):
            raise ValueError(f"the body does not turn by {variable} but by {rate} times it")
        return moving[0], factor, rate

    def substitute(self, replacement: Mapping[_Part, sp.Expr]) -> Motion:
        """The same motion with symbols replaced; rotations that become equal merge again."""
        def swap(expression: sp.Expr) -> sp.Expr:
            return replaced(expression, replacement)

        factors: list[Factor] = []
        for f in self.factors:
            match f:
                case Rotation():
                    factors.append(Rotation(f.axis, swap(f.angle)))
                case Translation():
                    factors.append(replace(f, offset=tuple(map(swap, f.offset))))
                case Swing():
                    factors.append(replace(f, angle=swap(f.angle), centre=tuple(map(swap, f.centre))))
                case Placement():
                    factors.append(Placement(tuple(tuple(map(swap, c)) for c in f.columns)))
        return Motion(_normal_form(factors))


def _rotation(axis: str) -> Callable[[Number], Motion]:
    def make(angle: Number) -> Motion:
        turn = sp.sympify(angle)
        return Motion() if turn == 0 else Motion((Rotation(axis, turn),))

    make.__doc__ = f"Rotation about {axis}."
    return make


Rx, Ry, Rz = map(_rotation, "xyz")


def translation(x: Number = 0, y: Number = 0, z: Number = 0) -> Motion:
    """Translation by (x, y, z)."""
    offset = v.vector(x, y, z)
    return Motion() if all(c == 0 for c in offset) else Motion((Translation(offset),))


def screw(angle: sp.Expr, parameter: sp.Expr) -> Motion:
    """Turning by ``angle`` about z while advancing by ``parameter``·``angle`` along z."""
    return Rz(angle) @ translation(z=parameter * angle)


def swing(axis: str, angle: Number, centre: v.Vector) -> Motion:
    """Rotation about the line through ``centre`` parallel to ``axis``, free of cancellation for large radii."""
    return Motion((Swing(axis, sp.sympify(angle), centre),))


def station(x: Number = 0, y: Number = 0, z: Number = 0) -> Motion:
    """Constant translation by (x, y, z) to or from the place, far from the axes, where everything happens."""
    return Motion(tuple(_moving(Station(v.vector(x, y, z)))))


def placement(x_axis: v.Vector, y_axis: v.Vector, z_axis: v.Vector, origin: tuple[Number, Number, Number]) -> Motion:
    """The constant motion from a frame with these axes and this origin, its station, to its parent."""
    return station(*origin) @ Motion((Placement((x_axis, y_axis, z_axis)),))
