"""Geometry of bodies and of their contact, on the tape: placements, axes, lever arms, curvatures.

Input: a drive's bodies and the nodes of their points and normals. Output: nodes.

Curvature is measured along a flank's own outward normal: negative where the body is convex. In an orthonormal basis of
the tangent plane the first fundamental form is the unit matrix and the second one holds the curvatures. Along a
surface, changes of the parameters keep its implicit conditions; there the normal turns by −II times the way. With
multipliers λ for the conditions that is [II λ] [tangents; slopes] = −turnings (Weingarten's equations on an implicitly
parametrised surface), solved by Cramer's rule, so that no parameter is singled out.
"""

from collections.abc import Iterable, Sequence
from fractions import Fraction
from typing import TypeAlias

import sympy as sp

from derive.language import vectors as v
from derive.language.chain import Motion, Rotation
from derive.language.drive import Body, Drive
from derive.language.functions import Function, Result
from derive.language.origin import SINGULAR, UNIT, Origin
from derive.language.symbols import Quantity
from derive.passes import check
from derive.passes.plan import Derived
from derive.passes.singular import determinant
from derive.program.tape import Tape

#: Two orthonormal vectors, and a symmetric matrix (a11, a12, a22), of nodes.
Basis: TypeAlias = tuple[Sequence[int], Sequence[int]]
Form: TypeAlias = tuple[int, int, int]
#: What the curvatures of a flank divide by: zero where its singular function is.
REGULAR = Origin(SINGULAR, "singular function of a flank")
PRINCIPAL = Origin("derivation/quotient", "larger principal curvature of the gap")

PINION_ANGLE = Quantity("pinion_angle", "rad", "angle of the pinion in mesh", "f")
WHEEL_ANGLE = Quantity("wheel_angle", "rad", "angle of the wheel in mesh", "f")


def functions(drive: Drive) -> tuple[Function, ...]:
    """What a drive offers beside its contact: how its bodies are placed, and its own functions."""
    return placement(drive), *drive.functions


def placement(drive: Drive) -> Function:
    """The :class:`~derive.language.functions.Function` that places both bodies: motions and axes of rotation.

    Of each member the rows of the 3 × 4 matrix (rotation | origin) that takes its frame into the fixed frame, and unit
    direction and a point of the axis about which a growing angle of its own turns it, misalignments included.
    """
    at_wheel_angle = {drive.error: WHEEL_ANGLE - (drive.turned - drive.error)}
    results: list[Result] = []
    for body, variable in ((drive.pinion, drive.instant), (drive.wheel, drive.error)):
        direction, point = body.motion.axis(variable)
        motion = body.motion.substitute(at_wheel_angle).substitute({drive.instant: PINION_ANGLE})
        results += [
            Result(f"placement_{body.name}", tuple(_rows(motion)), "", "f"),
            Result(f"axis_{body.name}", direction, "", "f"),
            Result(f"axis_point_{body.name}", point, "mm", "f"),
        ]
    return Function(
        "placement",
        "rows of the motion (rotation | origin) from each body's frame into the fixed frame, and its axis of rotation",
        (PINION_ANGLE, WHEEL_ANGLE),
        tuple(results),
        rests_on=tuple(dict.fromkeys(s for body in drive.bodies for s in body.motion.rests_on)),
    )


def _rows(motion: Motion) -> list[sp.Expr]:
    columns = [*(motion.direction(axis) for axis in (v.I, v.J, v.K)), motion.point(v.ORIGIN)]
    return [column[row] for row in range(3) for column in columns]


def turns_about_z(drive: Drive) -> bool:
    """Whether the wheel's angle is that of the last of its rotations, about the z axis of its own frame, alone."""
    *others, last = drive.wheel.motion.factors
    moves = any(sp.sympify(e).has(drive.error) for factor in others for e in factor.expressions())
    return isinstance(last, Rotation) and last.axis == "z" and sp.diff(last.angle, drive.error) in (1, -1) and not moves


def lever_arm(plan: Derived, body: Body, variable: Quantity, point: Sequence[int], normal: Sequence[int]) -> int:
    """Node of n · (d × (r − o)): how fast the body's point moves along ``normal`` for a unit of its angle, mm."""
    direction, origin = (list(map(plan.lower, vector)) for vector in body.motion.axis(variable))
    arm = [plan.tape.sub(r, o) for r, o in zip(point, origin, strict=True)]
    return plan.tape.triple(normal, direction, arm)


def dot(tape: Tape, a: Sequence[int], b: Sequence[int]) -> int:
    total = tape.mul(a[0], b[0])
    for p, q in zip(a[1:], b[1:], strict=True):
        total = tape.add(total, tape.mul(p, q))
    return total


def cross(tape: Tape, a: Sequence[int], b: Sequence[int]) -> list[int]:
    return [tape.sub(tape.mul(a[i], b[j]), tape.mul(a[j], b[i])) for i, j in ((1, 2), (2, 0), (0, 1))]


def unit(tape: Tape, nodes: Sequence[int]) -> tuple[list[int], int]:
    """A node vector divided by its length, and the length."""
    square = dot(tape, nodes, nodes)
    with tape.within(UNIT):
        length = tape.sqrt(square)
        return [tape.div(i, length) for i in nodes], length


def tangent_basis(tape: Tape, normal: Sequence[int], tangent: Sequence[int]) -> Basis:
    """Orthonormal basis of the tangent plane: the tangent's part across the unit normal, and normal × it."""
    along = dot(tape, tangent, normal)
    first, _ = unit(tape, [tape.sub(t, tape.mul(along, n)) for t, n in zip(tangent, normal, strict=True)])
    return first, cross(tape, normal, first)


def second_form(
    tape: Tape,
    parameters: Sequence[int],
    point: Sequence[int],
    raw_normal: Sequence[int],
    slopes: Iterable[Iterable[int]],
    basis: Basis,
) -> Form:
    """Nodes (II11, II12, II22) of a surface's second fundamental form in an orthonormal ``basis`` of its tangent plane.

    ``raw_normal`` is outward, of any length; ``slopes`` are the derivatives of each implicit condition.
    """
    _, length = unit(tape, raw_normal)
    columns = [[tape.derivative(i, p) for i in point] for p in parameters]
    changes = [[tape.derivative(i, p) for i in raw_normal] for p in parameters]
    by_parameter = [[*column, *change] for column, change in zip(columns, changes, strict=True)]
    check.derives("geometry", tape, [*point, *raw_normal], parameters, [*zip(*by_parameter, strict=True)])
    with tape.within(UNIT):
        turnings = [[tape.div(c, length) for c in change] for change in changes]
    matrix = [[dot(tape, e, column) for column in columns] for e in basis] + [list(row) for row in slopes]
    turned = [[dot(tape, e, turning) for turning in turnings] for e in basis]
    with tape.within(REGULAR):
        over = tape.div(tape.constant(-1), determinant(tape, matrix))

    def entry(row: int, column: int) -> int:
        replaced = [turned[row] if k == column else line for k, line in enumerate(matrix)]
        return tape.mul(determinant(tape, replaced), over)

    half = tape.constant(Fraction(1, 2))
    return entry(0, 0), tape.mul(half, tape.add(entry(0, 1), entry(1, 0))), entry(1, 1)


def principal_curvatures(tape: Tape, form: Form) -> tuple[int, int]:
    """Smaller and larger eigenvalue of a symmetric matrix (a11, a12, a22), without cancellation or branches.

    With mean m and radius r of Mohr's circle the eigenvalue of smaller magnitude is the determinant over |m| + r.
    """
    a, b, c = form
    half = tape.constant(Fraction(1, 2))
    mean, apart = tape.mul(half, tape.add(a, c)), tape.mul(half, tape.sub(a, c))
    radius = tape.sqrt(tape.add(tape.mul(apart, apart), tape.mul(b, b)))
    size = tape.sqrt(tape.mul(mean, mean))
    with tape.within(PRINCIPAL):
        small = tape.div(tape.sub(tape.mul(a, c), tape.mul(b, b)), tape.add(size, radius))
    return tape.add(tape.sub(mean, size), small), tape.sub(tape.add(mean, size), small)
