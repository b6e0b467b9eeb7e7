"""Derive: a drive → its equations on one tape.

Rules, design systems, residual and Jacobian of contact, and the start system that leads to a first contact.
"""

from collections.abc import Iterable

import sympy as sp

from derive.language.drive import Drive, Values
from derive.language.symbols import Quantity
from derive.passes import check, geometry, linearise
from derive.passes.completion import lower_system, on_parameters, together
from derive.passes.plan import Derived
from derive.program.lowering import Lowering
from derive.program.tape import Stage, Tape


def derive(drive: Drive) -> Derived:
    """The equations of a drive on one tape."""
    lower = _lowering(drive)
    rules = tuple(on_parameters(drive, [rule.value]) for rule in drive.completion)
    completion = together(drive)
    systems = tuple(lower_system(system, drive.parameters) for system in drive.systems)
    sizes = on_parameters(drive, [value for _, value, _ in drive.all_sizes])
    unknowns = [u.symbol for u in drive.unknowns]
    residual = [lower(r) for r in drive.residual]
    linear = linearise.linearise(lower.tape, residual, list(map(lower, unknowns)), _solutions(drive, lower))
    jacobian = linearise.jacobian(lower.tape, linear)
    check.derives("linearise", lower.tape, residual, list(map(lower, unknowns)), jacobian)
    scales = tuple(lower(u.scale) for u in drive.unknowns)
    start = [u.symbol for u in drive.start.unknowns]
    start_residual, start_jacobian = _start(drive, lower, start)
    return Derived(
        drive=drive,
        turns_about_z=geometry.turns_about_z(drive),
        tape=lower.tape,
        lower=lower,
        rules=rules,
        completion=completion,
        systems=systems,
        sizes=sizes,
        residual=tuple(residual),
        linear=linear,
        jacobian=jacobian,
        scales=scales,
        start_residual=tuple(start_residual),
        start_jacobian=start_jacobian,
        start_scales=tuple(lower(u.scale) for u in drive.start.unknowns),
        start_guess=tuple(lower(drive.guess[u]) for u in start),
        start_solution=tuple(fixed(lower, lower(drive.start.outputs[u]), drive.start.fixed) for u in unknowns),
    )


def _lowering(drive: Drive) -> Lowering:
    """What lowers onto a new tape, with the inputs of all functions of a drive."""
    inputs: dict[sp.Symbol, Stage] = {p.symbol: Stage.DESIGN for p in drive.parameters}
    inputs[drive.instant] = Stage.INSTANT
    inputs |= {u.symbol: Stage.ITERATE for u in drive.unknowns}
    inputs |= {q: Stage.ITERATE for region in drive.regions for q in region.surface.parameters}
    inputs |= {q: Stage.ITERATE for function in geometry.functions(drive) for q in function.arguments}
    tape = Tape()
    for symbol, stage in inputs.items():
        tape.input(symbol, stage)
    return Lowering(tape, inputs, drive.definitions)


def _solutions(drive: Drive, lower: Lowering) -> list[tuple[int, int, int]]:
    """Solution, equation and slope of what a drive's definitions have solved."""
    equations = drive.definitions.equations()
    return [(lower(solution), lower(equation), lower(slope)) for solution, equation, slope in equations]


def _start(drive: Drive, lower: Lowering, unknowns: Iterable[Quantity]) -> tuple[list[int], linearise.Matrix]:
    """Residual of the start system, and its Jacobian."""
    nodes = [lower(r) for r in drive.start.residual]
    if drive.start.fixed:
        nodes = [fixed(lower, i, drive.start.fixed) for i in nodes]
    solutions = [] if drive.start.fixed else _solutions(drive, lower)
    inputs = [lower(u) for u in unknowns]
    jacobian = linearise.jacobian(lower.tape, linearise.linearise(lower.tape, nodes, inputs, solutions))
    check.derives("start", lower.tape, nodes, inputs, jacobian)
    return nodes, jacobian


def fixed(lower: Lowering, node: int, values: Values) -> int:
    """The node where these symbols have these values."""
    return lower.tape.substitute(node, {lower(k): lower(value) for k, value in values.items()})
