"""Binding times: which values are kept between the stages of a computation.

design   once per geometry and misalignment: ``setup`` fills the design part of the state
instant  once per input angle: ``set_phi`` fills the instant part
iterate  every Newton step: ``eval``, ``step``; at a solution: ``observe``; anywhere on a flank: ``surface_…``

A value is computed at the earliest stage that knows its inputs, and stored in the state if a later one reads it.
"""

from collections.abc import Iterator

from derive.passes import check
from derive.passes.plan import Bound, Read
from derive.program.tape import Stage


def bind(plan: Read) -> Bound:
    """The functions of a drive with numbers for the values that one stage leaves for a later one."""
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
    kept, turning = list(wanted[Stage.DESIGN]), list(wanted[Stage.INSTANT])
    check.bound("setup", tape, kept, (), {Stage.DESIGN})
    check.bound("set_phi", tape, turning, kept, {Stage.INSTANT})
    check.bound("iterate", tape, outputs, [*kept, *turning], {Stage.ITERATE})
    state = {node: slot for slot, node in enumerate([*kept, *turning])}
    return Bound(**vars(plan), state=state, design_slots=len(kept))


def iterate_outputs(plan: Read) -> Iterator[int]:
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


def bounded_outputs(plan: Read) -> Iterator[int]:
    """All nodes that the functions of bounded flanks return: they form what they need of the design themselves."""
    yield from plan.edges.equations
    for row in plan.edges.jacobian:
        yield from row
    for expansion in plan.expansions:
        yield from (*expansion.slopes, *expansion.second)
