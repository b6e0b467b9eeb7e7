"""Schedule: a drive → one tape and the functions that read it, each with its binding time.

design   once per geometry and misalignment: ``setup`` fills the design part of the state
instant  once per input angle: ``set_phi`` fills the instant part
iterate  every Newton step: ``eval``, ``step``; at a solution: ``observe``; anywhere on a flank: ``surface_…``

A value is computed at the earliest stage that knows its inputs, and stored in the state if a later one reads it.
"""

from collections.abc import Iterable, Iterator
from itertools import combinations_with_replacement

import sympy as sp

from derive.language.drive import Body, Drive, Margin, System, Values
from derive.language.functions import Function
from derive.language.origin import STEP_SIZE, Origin
from derive.language.surface import Surface
from derive.language.symbols import Quantity
from derive.passes import check, geometry, guards, linearise, pivot_order, sample
from derive.passes.completion import lower_system, on_parameters
from derive.passes.directional import Derivatives
from derive.passes.edges import edge_contact
from derive.passes.plan import Along, BodyOutputs, Expansion, Flank, FunctionOutputs, Output, Schedule
from derive.passes.singular import singular_function
from derive.program.lowering import Lowering
from derive.program.tape import Stage, Tape

#: What the instantaneous ratio divides by.
LEVER = Origin("derivation/quotient", "lever arm of the wheel")


def schedule(drive: Drive) -> Schedule:
    """All functions of a drive on one tape: derived, reduced and bound."""
    return bind(reduce(derive(drive)))


def derive(drive: Drive) -> Schedule:
    """The equations of a drive on one tape: rules, design systems, residual and Jacobian of contact, start system."""
    inputs: dict[sp.Symbol, Stage] = {p.symbol: Stage.DESIGN for p in drive.parameters}
    inputs[drive.instant] = Stage.INSTANT
    inputs |= {u.symbol: Stage.ITERATE for u in drive.unknowns}
    inputs |= {q: Stage.ITERATE for region in drive.regions for q in region.surface.parameters}
    inputs |= {q: Stage.ITERATE for function in _functions(drive) for q in function.arguments}
    tape = Tape()
    for symbol, stage in inputs.items():
        tape.input(symbol, stage)
    plan = Schedule(drive, tape, Lowering(tape, inputs, drive.definitions))

    plan.rules = [on_parameters(drive, [rule.value]) for rule in drive.completion]
    plan.systems = [lower_system(system, drive.parameters) for system in drive.systems]
    plan.sizes = on_parameters(drive, [value for _, value, _ in drive.sizes])
    plan.residual, plan.linear = _system(plan, drive.residual, plan.unknowns)
    plan.jacobian = linearise.jacobian(tape, plan.linear)
    check.derives("linearise", tape, plan.residual, [plan.lower(u) for u in plan.unknowns], plan.jacobian)
    plan.scales = [plan.lower(u.scale) for u in drive.unknowns]
    _start(plan, drive.start)
    return plan


def reduce(plan: Schedule) -> Schedule:
    """The equations with their linear system solved: Newton's step, in the order of pivots of the sample's contact."""
    tape = plan.tape
    plan.sample = sample.sample_contact(plan)
    plan.step, plan.change = pivot_order.newton_step(plan)
    check.solves("pivot order", tape, plan.jacobian, plan.change, plan.residual)
    with tape.within(STEP_SIZE):
        plan.weight = [tape.div(tape.constant(1), s) for s in plan.scales]
    return plan


def bind(plan: Schedule) -> Schedule:
    """The equations with all that is read from them, each value at the earliest stage that knows its inputs."""
    drive, tape = plan.drive, plan.tape
    _observe(plan)
    for body in drive.bodies:
        limits = [Output(f"margin_{m.event}", (_margin(plan, body, m),)) for m in body.margins]
        plan.flanks.append(Flank(body.name, *_surface(plan, body.surface, body.name, _regular(plan, body), limits)))
    for region in drive.regions:
        regular = tape.mul(plan.lower(region.regular), singular_function(plan.lower, region.surface))
        limits = [Output(f"margin_{m.event}", (plan.lower(m.positive),)) for m in region.margins]
        surface = _surface(plan, region.surface, region.member, regular, limits)
        plan.regions.append(Flank(region.member, *surface, region.name))
    plan.functions = [_function(plan, function) for function in _functions(drive)]
    plan.along = _along(plan)
    plan.edges = edge_contact(plan, lambda body, margin: _margin(plan, body, margin))
    plan.expansions = [_expansion(plan, f, second=True) for f in plan.flanks]
    plan.expansions += [_expansion(plan, f, second=False) for f in plan.regions]
    _assign_state(plan)
    unseen = guards.unseen(plan)
    plan.guards = guards.design_guards(plan, unseen)
    plan.tests = guards.tests(plan, unseen)
    return plan


def _system(
    plan: Schedule, residual: Iterable[sp.Expr], unknowns: Iterable[Quantity], fixed: Values | None = None
) -> tuple[list[int], linearise.Linear]:
    lower, tape = plan.lower, plan.tape
    nodes = [lower(r) for r in residual]
    if fixed:
        nodes = [_fixed(plan, i, fixed) for i in nodes]
    equations = () if fixed else plan.drive.definitions.equations()
    solutions = [(lower(solution), lower(equation), lower(slope)) for solution, equation, slope in equations]
    return nodes, linearise.linearise(tape, nodes, [lower(u) for u in unknowns], solutions)


def _fixed(plan: Schedule, node: int, values: Values) -> int:
    return plan.tape.substitute(node, {plan.lower(k): plan.lower(value) for k, value in values.items()})


def _start(plan: Schedule, start: System) -> None:
    unknowns = [u.symbol for u in start.unknowns]
    plan.start_residual, linear = _system(plan, start.residual, unknowns, start.fixed)
    plan.start_jacobian = linearise.jacobian(plan.tape, linear)
    plan.start_scales = [plan.lower(u.scale) for u in start.unknowns]
    plan.start_guess = [plan.lower(plan.drive.guess[u]) for u in unknowns]
    solution = (_fixed(plan, plan.lower(start.outputs[u]), start.fixed) for u in plan.unknowns)
    plan.start_solution = list(solution)


def _vector(plan: Schedule, vector: Iterable[sp.Expr]) -> list[int]:
    return [plan.lower(c) for c in vector]


def _observe(plan: Schedule) -> None:
    drive = plan.drive
    put = plan.observed.append
    for body in drive.bodies:
        placed = body.placed
        normal, _ = geometry.unit(plan.tape, _vector(plan, placed.body_normal))
        put(Output(f"point_{body.name}_f", tuple(_vector(plan, placed.body_point)), "mm", "f"))
        put(Output(f"normal_{body.name}_f", tuple(normal), "", "f"))
    for body in drive.bodies:
        local = tuple(_vector(plan, body.surface.body_point))
        if body.point:
            plan.lower.stand(body.point, local)
        put(Output(f"point_{body.name}", local, "mm", body.name))
    put(Output("wheel_angle", (plan.lower(drive.wheel_angle),), "rad", "f"))
    for body in drive.bodies:
        for symbol in body.recovered:
            put(Output(f"{symbol}", (plan.lower(symbol),), symbol.unit, symbol.frame))
    for body in drive.bodies:
        _observe_body(plan, body)
    _observe_contact(plan)


def _observe_body(plan: Schedule, body: Body) -> None:
    """Derivatives of the point by the surface parameters, fixed frame; of its conditions; its margins."""
    tape = plan.tape
    parameters = [plan.lower(p) for p in body.surface.parameters]
    point = _vector(plan, body.placed.body_point)
    at = _count(plan.observed)
    put = plan.observed.append
    for symbol, parameter in zip(body.surface.parameters, parameters, strict=True):
        tangent = [tape.derivative(i, parameter) for i in point]
        put(Output(f"tangent_{symbol}", tuple(tangent), f"mm/({symbol.unit})", "f"))
    for k, slopes in enumerate(_slopes(plan, body.surface)):
        put(Output(f"condition_{body.name}_{k}", slopes))
    singular = _count(plan.observed)
    put(Output(f"regular_{body.name}", (_regular(plan, body),)))
    margins: list[int] = []
    for margin in body.margins:
        margins.append(_count(plan.observed))
        put(Output(f"margin_{body.name}_{margin.event}", (_margin(plan, body, margin),)))
    plan.bodies[body.name] = BodyOutputs(
        len(parameters), len(body.surface.conditions), at, singular, tuple(margins)
    )


def _slopes(plan: Schedule, surface: Surface) -> list[tuple[int, ...]]:
    """Derivatives of each implicit condition of a surface by its parameters."""
    parameters = [plan.lower(p) for p in surface.parameters]
    return [tuple(plan.tape.derivative(plan.lower(c), p) for p in parameters) for c in surface.conditions]


def _observe_contact(plan: Schedule) -> None:
    """Second fundamental forms of both flanks and of the gap in one tangent basis, its curvatures; lever arms.

    The basis is that of the pinion's first tangent and the contact normal, the pinion's outward normal; both arms are
    those of the pinion's point, which is the wheel's.
    """
    drive, tape = plan.drive, plan.tape
    pinion, _ = drive.bodies
    normal, _ = geometry.unit(tape, _vector(plan, pinion.placed.body_normal))
    points = [_vector(plan, body.placed.body_point) for body in drive.bodies]
    first = plan.lower(pinion.surface.parameters[0])
    basis = geometry.tangent_basis(tape, normal, [tape.derivative(i, first) for i in points[0]])
    forms = [_second_form(plan, body.placed, basis) for body in drive.bodies]
    first_form, second_form = forms
    entries = [tape.sub(tape.neg(a), b) for a, b in zip(first_form, second_form, strict=True)]
    gap = entries[0], entries[1], entries[2]
    arms = [
        geometry.lever_arm(plan, body, variable, points[0], normal)
        for body, variable in zip(drive.bodies, (drive.instant, drive.error), strict=True)
    ]
    with tape.within(LEVER):
        ratio = tape.div(*arms)
    plan.observed += [
        Output("tangent_basis", (*basis[0], *basis[1]), "", "f"),
        *(Output(f"second_form_{b.name}", form, "1/mm", "f") for b, form in zip(drive.bodies, forms, strict=True)),
        Output("second_form_gap", gap, "1/mm", "f"),
        Output("curvature_gap", geometry.principal_curvatures(tape, gap), "1/mm"),
        *(Output(f"lever_arm_{body.name}", (arm,), "mm") for body, arm in zip(drive.bodies, arms, strict=True)),
        Output("instantaneous_ratio", (ratio,)),
    ]


def _second_form(plan: Schedule, surface: Surface, basis: geometry.Basis) -> geometry.Form:
    parameters = [plan.lower(p) for p in surface.parameters]
    point, normal = _vector(plan, surface.body_point), _vector(plan, surface.body_normal)
    return geometry.second_form(plan.tape, parameters, point, normal, _slopes(plan, surface), basis)


def _along(plan: Schedule) -> Along:
    """Derivatives of the residual along a direction: see :class:`Along`."""
    tape, symbols = plan.tape, [*plan.unknowns, plan.drive.instant]
    seeds = {plan.lower(s): tape.input(sp.Symbol(f"along_{s}"), Stage.ITERATE) for s in symbols}
    tangent = Derivatives(tape, seeds)
    first = [tangent(i) for i in plan.residual]
    return Along(tuple(seeds.values()), tuple(first), tuple(tangent(i) for i in first))


def _expansion(plan: Schedule, flank: Flank, *, second: bool) -> Expansion:
    """The :class:`Expansion` of a flank or region."""
    tape, parameters = plan.tape, [plan.lower(p) for p in flank.parameters]
    slopes = [tape.derivative(i, p) for i in flank.limits for p in parameters]
    point = next(o.nodes for o in flank.outputs if o.name == "point")
    bent = [
        tape.derivative(tape.derivative(i, p), q)
        for i in (*point, *flank.limits, *flank.conditions)
        for p, q in combinations_with_replacement(parameters, 2)
        if second
    ]
    return Expansion(flank, tuple(slopes), tuple(bent))


def _count(outputs: Iterable[Output]) -> int:
    return sum(len(o.nodes) for o in outputs)


def _relative(plan: Schedule, body: Body, node: int) -> int:
    at_reference = _fixed(plan, node, body.reference)
    with plan.tape.within(Origin("derivation/relative", f"the same at the reference point of the {body.name}")):
        return plan.tape.div(node, at_reference)


def _regular(plan: Schedule, body: Body) -> int:
    if body.regular is not None:
        return plan.tape.mul(plan.lower(body.regular), singular_function(plan.lower, body.surface))
    return _relative(plan, body, singular_function(plan.lower, body.surface))


def _margin(plan: Schedule, body: Body, margin: Margin) -> int:
    """A margin in terms of surface parameters; body coordinates stand for the surface's own."""
    node = plan.lower(margin.positive)
    if margin.along is not None:
        node = plan.tape.derivative(node, plan.lower(margin.along))
    return _relative(plan, body, node) if margin.relative else node


def _surface(
    plan: Schedule, surface: Surface, frame: str, regular: int, limits: Iterable[Output]
) -> tuple[tuple[Quantity, ...], tuple[Output, ...], tuple[Output, ...]]:
    """Parameters of a surface, what is known at them, and its curvature there, body frame."""
    normal, _ = geometry.unit(plan.tape, _vector(plan, surface.body_normal))
    parameters = [plan.lower(p) for p in surface.parameters]
    point = _vector(plan, surface.body_point)
    outputs = [
        Output("point", tuple(point), "mm", frame),
        Output("normal", tuple(normal), "", frame),
        *(
            Output(f"tangent_{s}", tuple(plan.tape.derivative(i, p) for i in point), f"mm/({s.unit})", frame)
            for s, p in zip(surface.parameters, parameters, strict=True)
        ),
        Output("regular", (regular,)),
        *limits,
    ]
    for k, (condition, slopes) in enumerate(zip(surface.conditions, _slopes(plan, surface), strict=True)):
        outputs += [Output(f"condition_{k}", (plan.lower(condition),)), Output(f"condition_{k}_slopes", slopes)]
    basis = geometry.tangent_basis(plan.tape, normal, outputs[2].nodes)
    form = _second_form(plan, surface, basis)
    curvature = (
        Output("tangent_basis", (*basis[0], *basis[1]), "", frame),
        Output("second_form", form, "1/mm", frame),
        Output("curvature", geometry.principal_curvatures(plan.tape, form), "1/mm"),
    )
    return tuple(surface.parameters), tuple(outputs), curvature


def _functions(drive: Drive) -> tuple[Function, ...]:
    return geometry.placement(drive), *drive.functions


def _function(plan: Schedule, function: Function) -> FunctionOutputs:
    outputs = (Output(r.name, tuple(map(plan.lower, r.values)), r.unit, r.frame) for r in function.results)
    return FunctionOutputs(function.name, function.meaning, function.arguments, tuple(outputs), function.rests_on)


def iterate_outputs(plan: Schedule) -> Iterator[int]:
    """All nodes that iterate-stage functions return."""
    yield from plan.residual
    for row in plan.jacobian:
        yield from row
    yield from plan.scales
    yield from plan.newton_step
    yield from plan.start_residual
    for row in plan.start_jacobian:
        yield from row
    yield from plan.start_guess
    yield from plan.start_scales
    yield from plan.start_solution
    for output in plan.observed:
        yield from output.nodes
    for table in (*plan.flanks, *plan.regions, *plan.functions):
        for output in table.outputs:
            yield from output.nodes
    for flank in (*plan.flanks, *plan.regions):
        for output in flank.curvature:
            yield from output.nodes


def bounded_outputs(plan: Schedule) -> Iterator[int]:
    """All nodes that the functions of bounded flanks return: they form what they need of the design themselves."""
    yield from plan.edges.equations
    for row in plan.edges.jacobian:
        yield from row
    for expansion in plan.expansions:
        yield from (*expansion.slopes, *expansion.second)


def _assign_state(plan: Schedule) -> None:
    """Number the values that one stage leaves for a later one."""
    tape = plan.tape
    wanted: dict[Stage, dict[int, None]] = {Stage.DESIGN: {}, Stage.INSTANT: {}}

    def leave(i: int, reader: Stage) -> None:
        stage = tape.stages[i]
        if stage in wanted and stage < reader:
            wanted[stage][i] = None

    early = {i for i, stage in enumerate(tape.stages) if stage <= Stage.INSTANT}
    outputs = list(iterate_outputs(plan))
    for i in tape.needed(outputs, early):
        for a in tape.nodes[i].args:
            leave(a, Stage.ITERATE)
    for i in outputs:
        leave(i, Stage.ITERATE)
    bounded = list(bounded_outputs(plan))
    for i in (*bounded, *(a for k in tape.needed(bounded, early) for a in tape.nodes[k].args)):
        if tape.stages[i] == Stage.INSTANT:
            leave(i, Stage.ITERATE)
    design = {i for i, stage in enumerate(tape.stages) if stage <= Stage.DESIGN}
    for i in tape.needed(list(wanted[Stage.INSTANT]), design):
        for a in tape.nodes[i].args:
            leave(a, Stage.INSTANT)
    for i in tape.needed([*plan.along.first, *plan.along.second], design):  # given the instant itself
        for a in tape.nodes[i].args:
            leave(a, Stage.INSTANT)
    for i in (*plan.along.first, *plan.along.second):
        leave(i, Stage.INSTANT)
    slots = [*wanted[Stage.DESIGN], *wanted[Stage.INSTANT]]
    plan.state = {node: slot for slot, node in enumerate(slots)}
    plan.design_slots = len(wanted[Stage.DESIGN])

