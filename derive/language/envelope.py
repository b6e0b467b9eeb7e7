"""Envelopes: the surface a moving surface leaves behind, its equation of meshing, and its explicit form.

``envelope`` derives the equation of meshing n·∂r/∂φ = 0 from the chain. ``explicit`` is the reduce stage: it
merges angles that only occur as a sum and solves the equation for a parameter in which it is linear, so that
the generated surface needs no root finding.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TypeVar

import sympy as sp

from derive.language import vectors as v
from derive.language.chain import Motion
from derive.language.differentiate import partial
from derive.language.origin import EXPLICIT, Origin
from derive.language.replace import replaced
from derive.language.sampled import vanishes
from derive.language.surface import Step, Surface
from derive.language.symbols import Quantity
from derive.language.vectors import Number

_Part = TypeVar("_Part", bound=sp.Expr)


def envelope(surface: Surface, motion: Motion, variable: Quantity) -> Surface:
    """The envelope of ``surface`` under ``motion(variable)``, in the frame that the motion leads to.

    The new body lies on the other side of the surface, so the normal turns round. The equation of meshing
    joins the conditions; ``variable`` joins the parameters.
    """
    moved = surface.placed(motion)
    meshing = moved.motion.power(variable, surface.pole or surface.point, surface.normal)
    parameters = surface.parameters + (() if variable in surface.parameters else (variable,))
    made = (*surface.written_down.made, Step.of("envelope", motion=motion, variable=variable))
    generated = replace(
        moved,
        parameters=parameters,
        normal=v.scale(-1, surface.normal),
        conditions=(*surface.conditions, meshing),
        made=made,
    )
    poles = ("derivation/pole",) if surface.pole else ()
    return generated.on("derivation/invariance", "derivation/envelope", *poles)


@dataclass(frozen=True)
class Solved:
    """How the reduce stage removed a parameter: ``symbol`` = ``value`` where ``denominator`` ≠ 0."""

    symbol: sp.Expr
    value: sp.Expr
    denominator: sp.Expr


def merge_sum(surface: Surface, kept: Quantity, removed: Quantity, name: str, meaning: str) -> tuple[Surface, Quantity]:
    """Replace ``removed`` by a new parameter ``name`` = kept + removed.

    Legal for any surface; worth doing where a rotation angle is that sum.
    """
    total = Quantity(name, removed.unit, meaning, removed.frame, parity=removed.parity)
    value = total - kept
    parameters = tuple(total if p == removed else p for p in surface.parameters)
    merged = substitute(replace(surface, parameters=parameters), {removed: value})
    return merged.on("derivation/merge-sum").by(Step.of("merged", total=total, kept=kept, removed=removed)), total


def substitute(surface: Surface, replacement: Mapping[_Part, sp.Expr]) -> Surface:
    """The same surface with parameters replaced by expressions, everywhere but in definitions."""

    def swap(expression: sp.Expr) -> sp.Expr:
        return replaced(expression, replacement)

    return replace(
        surface,
        point=tuple(map(swap, surface.point)),
        tangents=tuple(tuple(map(swap, t)) for t in surface.tangents),
        normal=tuple(map(swap, surface.normal)),
        motion=surface.motion.substitute(replacement),
        conditions=tuple(map(swap, surface.conditions)),
    )


def explicit(surface: Surface) -> tuple[Surface, Solved]:
    """Solve the last condition for a parameter in which it is linear; ``(surface, Solved)``.

    Raises ``ValueError`` if there is none: the surface then has to stay implicit.
    """
    *others, condition = surface.conditions
    for parameter in reversed(surface.parameters):
        slope = _constant_slope(surface, condition, parameter)
        if slope is None:
            continue
        if any(surface.definitions.depends(s, parameter) for s in _defined(surface, condition)):
            continue
        solution = -replaced(condition, {parameter: sp.Integer(0)}) / slope
        origin = Origin(EXPLICIT, f"slope of the equation of meshing in {parameter}")
        named = surface.definitions.let(
            parameter.name, solution, parameter.meaning, parameter.unit, origin=origin, parity=parameter.parity
        )
        surface.definitions.solves(named, replaced(condition, {parameter: named}), slope)
        remaining = tuple(p for p in surface.parameters if p != parameter)
        done = replace(surface, parameters=remaining, conditions=tuple(others))
        made = Step.of("solved", parameter=parameter, value=solution)
        return substitute(done, {parameter: named}).on(EXPLICIT).by(made), Solved(named, solution, slope)
    raise ValueError("the equation of meshing is linear in none of its parameters")


def _constant_slope(surface: Surface, condition: sp.Expr, parameter: Quantity) -> sp.Expr | None:
    """∂condition/∂parameter where that is free of the parameter, also where this shows only multiplied out.

    What shows only then is for the record to prove: a surface that relies on it names its statement.
    """
    definitions = surface.definitions
    if _angle_of(condition, parameter):
        return None
    slope = definitions.derivative(condition, parameter)
    if slope == 0 or not definitions.depends(slope, parameter):
        return None if slope == 0 else slope
    if parameter not in slope.free_symbols:
        return None
    if not vanishes(definitions.resolve(definitions.derivative(slope, parameter))):
        return None
    return replaced(slope, {parameter: sp.Integer(0)})


def _angle_of(condition: sp.Expr, parameter: Quantity) -> bool:
    """Whether the parameter occurs in a sine or cosine."""
    return any(parameter in e.free_symbols for e in condition.atoms(sp.sin, sp.cos))


def explicit_angle(surface: Surface, angle: Quantity, sign: Number | Callable[[sp.Expr, sp.Expr], sp.Expr]) -> Surface:
    """Solve the last condition, homogeneous in the cosine and sine of ``angle``, for that parameter.

    Of a·cos + b·sin = 0 the result is the direction (cos, sin) ∝ sign · (b, −a): the opposite one solves it too.
    ``sign`` may be a function of a and b.
    """
    *others, condition = surface.conditions
    a, b = _direction(condition, angle)
    if callable(sign):
        a, b = (surface.definitions.let(f"{angle}_{part}", c) for part, c in (("cosine", a), ("sine", b)))
        towards = sign(a, b)
    else:
        towards = sp.sympify(sign)
    origin = Origin("derivation/explicit-angle", f"the direction that solves the equation of meshing for {angle}")
    turn = v.arc(-towards * a, towards * b)
    named = surface.definitions.let(
        angle.name, turn, angle.meaning, angle.unit, origin=origin, parity=angle.parity
    )
    remaining = tuple(p for p in surface.parameters if p != angle)
    solved = substitute(replace(surface, parameters=remaining, conditions=tuple(others)), {angle: named})
    return solved.on("derivation/explicit-angle").by(Step.of("solved", parameter=angle, value=turn))


def explicit_turn(surface: Surface, angle: Quantity, sign: Number) -> Surface:
    """Solve the last condition, a·cos + b·sin + c = 0 in ``angle``, for that parameter.

    The result is the direction (cos, sin) ∝ −c (a, b) + ``sign`` √(a² + b² − c²) (−b, a), between −π and π; ``sign`` is
    1 or −1.
    """
    *others, condition = surface.conditions
    a, b, c = in_turn(condition, angle)
    half = sign * v.root(a**2 + b**2 - c**2)
    turn = v.arc(half * a - c * b, -half * b - c * a)
    origin = Origin("derivation/both-turns", f"a root of the equation of meshing for {angle}")
    named = surface.definitions.let(angle.name, turn, angle.meaning, angle.unit, origin=origin, parity=angle.parity)
    remaining = tuple(p for p in surface.parameters if p != angle)
    solved = substitute(replace(surface, parameters=remaining, conditions=tuple(others)), {angle: named})
    return solved.on("derivation/both-turns").by(Step.of("solved", parameter=angle, value=turn))


def in_turn(condition: sp.Expr, angle: Quantity) -> tuple[sp.Expr, sp.Expr, sp.Expr]:
    """Coefficients (a, b, c) of a condition that is a·cos(angle) + b·sin(angle) + c, perhaps only multiplied out."""
    cosine, sine = sp.Symbol("_cos"), sp.Symbol("_sin")
    form = replaced(condition, {sp.cos(angle): cosine, sp.sin(angle): sine})
    if any(partial(partial(form, p), q) != 0 for p, q in ((cosine, cosine), (cosine, sine), (sine, sine))):
        form = sp.expand(replaced(sp.expand(form), {sine**2: 1 - cosine**2}))
    a, b, c = partial(form, cosine), partial(form, sine), replaced(form, {cosine: sp.Integer(0), sine: sp.Integer(0)})
    if {cosine, sine, angle} & (a.free_symbols | b.free_symbols | c.free_symbols):
        raise ValueError("the equation is not linear in the cosine and sine of one angle")
    return a, b, c


def _direction(condition: sp.Expr, angle: Quantity) -> tuple[sp.Expr, sp.Expr]:
    a, b, c = in_turn(condition, angle)
    if c != 0:
        raise ValueError("the equation is not homogeneous in the cosine and sine of one angle")
    return a, b


def nearest_turn(condition: sp.Expr, angle: Quantity) -> sp.Expr:
    """The root of a·cos + b·sin + c = 0 that is nearest 0; not a number where there is none."""
    a, b, c = in_turn(condition, angle)
    return v.arc(b, a) - b / sp.Abs(b) * sp.acos(-c / v.radius(a, b))


def _defined(surface: Surface, expression: sp.Expr) -> list[sp.Symbol]:
    return [s for s in expression.free_symbols if s in surface.definitions]
