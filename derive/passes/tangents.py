"""What a change of the parameters does: directional derivatives of rules, design systems, residual, contact and flanks.

One direction at a time: the tangent of every value on the tape, by the chain rule. With the Jacobians of the design
systems and of the contact this gives exact sensitivities of their solutions (implicit function theorem); see
``runtime/c/sensitivity.c``.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import sympy as sp

from derive.language.drive import PATH, Drive, Rule
from derive.language.symbols import Quantity
from derive.passes import check
from derive.passes.completion import SystemTape
from derive.passes.directional import Derivatives
from derive.passes.guards import Evaluated
from derive.passes.plan import Flank, Schedule
from derive.program.lowering import Lowering
from derive.program.tape import Stage, Tape

_POINT = "point_pinion_f"


@dataclass(frozen=True)
class Tangent:
    """Tangents ``nodes`` on a tape, of the generated function ``name``; ``part`` and ``of`` as in :class:`Evaluated`.

    ``inputs`` are its arguments and their changes: name → nodes.
    """

    name: str
    lower: Lowering
    inputs: Mapping[str, tuple[int, ...]]
    nodes: tuple[int, ...]
    part: int = 0
    of: str = ""

    def evaluated(self) -> Evaluated:
        """The generated function, for the list of side conditions."""
        known = frozenset(i for nodes in self.inputs.values() for i in nodes)
        tape, nodes = self.lower.tape, (self.nodes,)
        return Evaluated(self.name, tape, self.lower, nodes, known, "tangent", self.part, of=self.of)


@dataclass(frozen=True)
class Differentiated(Schedule):
    """The functions of a drive on tapes that have their tangents too: of each rule; of residual and values of each
    design system; of the contact; of the point of each flank at fixed parameters of the flank.
    """

    rule_tangents: tuple[Tangent, ...]
    system_tangents: tuple[tuple[Tangent, Tangent], ...]
    contact_tangent: Tangent
    flank_tangents: tuple[Tangent, ...]

    def tangents(self) -> Iterator[Tangent]:
        """All of them, in the order in which they are printed."""
        yield from self.rule_tangents
        for system in self.system_tangents:
            yield from system
        yield self.contact_tangent
        yield from self.flank_tangents


def differentiate(plan: Schedule) -> Differentiated:
    """The functions of a drive with their tangents, on copies of their tapes."""
    drive, systems = plan.drive, tuple(_apart(system) for system in plan.systems)
    plan = replace(plan.copy(), systems=systems)
    by_p = _seeds(plan.lower, [p.symbol for p in drive.parameters], Stage.DESIGN)
    rules = tuple(_of_rule(drive, rule, k) for k, rule in enumerate(drive.rules))
    of_systems = tuple(_of_system(drive, system) for system in systems)
    contact = _of_contact(plan, by_p)
    return Differentiated(
        **vars(plan),
        rule_tangents=rules,
        system_tangents=of_systems,
        contact_tangent=contact,
        flank_tangents=tuple(_of_flank(plan, flank, by_p) for flank in plan.flanks),
    )


def _apart(system: SystemTape) -> SystemTape:
    lower = system.lower.copy()
    return replace(system, tape=lower.tape, lower=lower)


def _seeds(lower: Lowering, symbols: Iterable[sp.Symbol], stage: Stage) -> dict[int, int]:
    """Seed inputs d_name of these input symbols: input node → seed node."""
    return {lower(s): lower.tape.input(sp.Symbol(f"d_{s}"), stage) for s in symbols}


def _tangents(tape: Tape, seeds: Mapping[int, int], nodes: Sequence[int]) -> tuple[int, ...]:
    """Tangents of nodes along the changes of inputs."""
    found = tuple(map(Derivatives(tape, seeds), nodes))
    check.moves("tangents", tape, nodes, seeds, found)
    return found


def _inputs(name: str, seeds: Mapping[int, int]) -> dict[str, tuple[int, ...]]:
    """Inputs under a name, their changes under its d."""
    return {name: tuple(seeds), f"d{name}": tuple(seeds.values())}


def _of_contact(plan: Schedule, by_p: Mapping[int, int]) -> Tangent:
    """Of residual and contact point."""
    tape, lower = plan.tape, plan.lower
    by_x = _seeds(lower, plan.unknowns, Stage.ITERATE)
    by_phi = _seeds(lower, [plan.drive.instant], Stage.INSTANT)
    inputs = _inputs("p", by_p) | _inputs("x", by_x) | _inputs("phi", by_phi)
    point = next(o for o in plan.observed if o.name == _POINT)
    nodes = _tangents(tape, {**by_p, **by_phi, **by_x}, (*plan.residual, *point.nodes))
    return Tangent("tangent", lower, inputs, nodes)


def _of_flank(plan: Schedule, flank: Flank, by_p: Mapping[int, int]) -> Tangent:
    """Of a flank's point, at fixed parameters of the flank: the normal part does not depend on which are fixed."""
    inputs = _inputs("p", by_p) | {"q": tuple(map(plan.lower, flank.parameters))}
    point = next(o for o in flank.outputs if o.name == "point")
    return Tangent(f"{flank.body}_tangent", plan.lower, inputs, _tangents(plan.tape, by_p, point.nodes), of="surface")


def _of_rule(drive: Drive, rule: Rule, part: int) -> Tangent:
    """Of a rule's value, on a tape of its own."""
    symbols: list[Quantity] = [p.symbol for p in drive.parameters]
    lower = Lowering(Tape(), dict.fromkeys(symbols, Stage.DESIGN), drive.definitions)
    seeds = _seeds(lower, symbols, Stage.DESIGN)
    nodes = _tangents(lower.tape, seeds, [lower(rule.value)])
    return Tangent("derive_tangent", lower, _inputs("p", seeds), nodes, part)


def _of_system(drive: Drive, plan: SystemTape) -> tuple[Tangent, Tangent]:
    """Of a design system's residual and the values that it fills in, along dq and dy; q ends with the path's share."""
    lower = plan.lower
    by_q = _seeds(lower, [p.symbol for p in drive.parameters], Stage.DESIGN)
    by_y = _seeds(lower, plan.unknowns, Stage.ITERATE)
    inputs = _inputs("q", by_q) | _inputs("y", by_y) | {"q": (*by_q, lower(PATH))}
    seeds, name = {**by_q, **by_y}, plan.system.name
    residual, values = (_tangents(plan.tape, seeds, nodes) for nodes in (plan.residual, plan.values))
    return (
        Tangent(f"{name}_tangent", lower, inputs, residual, of="system"),
        Tangent(f"{name}_fill_tangent", lower, inputs, values, of="system"),
    )
