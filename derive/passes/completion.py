"""Schedule of what completes a design: rules, and design systems as functions of parameters alone.

Each system has a small tape of its own, read by the C printer and, at generation time, by :mod:`derive.passes.sample`.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import sympy as sp

from derive.language.drive import PATH, DesignSystem, Drive
from derive.language.symbols import Parameter, Quantity
from derive.passes import check
from derive.passes.singular import singular_function
from derive.program.lowering import Lowering
from derive.program.tape import Stage, Tape


@dataclass(frozen=True)
class SystemTape:
    """Nodes of one design system. ``watch`` must be positive along the path; None if there is nothing to watch."""

    system: DesignSystem
    tape: Tape
    lower: Lowering
    residual: tuple[int, ...]
    jacobian: tuple[tuple[int, ...], ...]
    scales: tuple[int, ...]
    guess: tuple[int, ...]
    values: tuple[int, ...]
    watch: int | None

    @property
    def unknowns(self) -> list[Quantity]:
        return [u.symbol for u in self.system.unknowns]


@dataclass(frozen=True)
class ParameterTape:
    """Nodes of expressions of a drive's parameter vector alone, on a tape of their own."""

    lower: Lowering
    nodes: tuple[int, ...]

    @property
    def tape(self) -> Tape:
        return self.lower.tape


def on_parameters(drive: Drive, expressions: Iterable[sp.Expr]) -> ParameterTape:
    """The :class:`ParameterTape` of these expressions."""
    lower = _lowering(drive)
    for p in drive.parameters:
        lower(p.symbol)
    return ParameterTape(lower, tuple(lower(e) for e in expressions))


def together(drive: Drive) -> ParameterTape:
    """The defaults and rules that complete a design of a drive, on one tape."""
    lower = _lowering(drive)
    return ParameterTape(lower, tuple(lower(rule.value) for rule in drive.completion))


def _lowering(drive: Drive) -> Lowering:
    return Lowering(Tape(), {p.symbol: Stage.DESIGN for p in drive.parameters}, drive.definitions)


def at_end(plan: SystemTape) -> SystemTape:
    """A design system at the end of its path, on a copy of its tape."""
    lower = plan.lower.copy()
    tape, end = lower.tape, {lower(PATH): lower.tape.constant(1)}
    return replace(
        plan,
        tape=tape,
        lower=lower,
        residual=tuple(tape.substitute(i, end) for i in plan.residual),
        jacobian=tuple(tuple(tape.substitute(i, end) for i in row) for row in plan.jacobian),
        values=tuple(tape.substitute(i, end) for i in plan.values),
    )


def lower_system(system: DesignSystem, parameters: Sequence[Parameter]) -> SystemTape:
    """A design system of a drive with these parameters on a tape."""
    tape = Tape()
    inputs: dict[sp.Symbol, Stage] = {p.symbol: Stage.DESIGN for p in parameters}
    inputs |= {PATH: Stage.INSTANT} | {u.symbol: Stage.ITERATE for u in system.unknowns}
    inputs |= dict.fromkeys(system.fixed, Stage.ITERATE)
    lower = Lowering(tape, inputs, system.definitions)
    fixed = {lower(symbol): lower(value) for symbol, value in system.fixed.items()}
    unknowns = [lower(u.symbol) for u in system.unknowns]
    guess = [lower(system.guess[u.symbol]) for u in system.unknowns]
    residual = [tape.substitute(lower(r), fixed) for r in system.residual]
    if system.homotopy:
        left = tape.sub(tape.constant(1), lower(PATH))
        begun = [tape.substitute(r, dict(zip(unknowns, guess, strict=True))) for r in residual]
        residual = [tape.sub(r, tape.mul(left, b)) for r, b in zip(residual, begun, strict=True)]
    jacobian = tuple(tuple(tape.derivative(r, u) for u in unknowns) for r in residual)
    check.derives(f"design system {system.name}", tape, residual, unknowns, jacobian)
    return SystemTape(
        system=system,
        tape=tape,
        lower=lower,
        residual=tuple(residual),
        jacobian=jacobian,
        scales=tuple(lower(u.scale) for u in system.unknowns),
        guess=tuple(guess),
        values=tuple(lower(value) for value in system.fills.values()),
        watch=_watch(system, lower, fixed),
    )


def _watch(system: DesignSystem, lower: Lowering, fixed: Mapping[int, int]) -> int | None:
    if system.regular is None:
        return None
    surface, sign = system.regular
    value = lower.tape.mul(lower(sign), singular_function(lower, surface))
    return lower.tape.substitute(value, fixed)
