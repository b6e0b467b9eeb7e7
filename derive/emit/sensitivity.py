"""Print what a change of the parameters does: directional derivatives of rules, design systems, residual, contact and
flanks.

One direction at a time: the tangent of every value on the tape, by the chain rule. With the Jacobians of the design
systems and of the contact this gives exact sensitivities of their solutions (implicit function theorem); see
``runtime/c/sensitivity.c``.
"""

from dataclasses import dataclass

import sympy as sp

from derive.emit.c99 import Printer
from derive.emit.render import render
from derive.language.drive import PATH
from derive.passes.directional import Derivatives
from derive.passes.guards import Evaluated
from derive.program.lowering import Lowering
from derive.program.tape import Stage, Tape

_POINT = "point_pinion_f"


@dataclass(frozen=True)
class Tangent:
    """Tangents ``nodes`` on a tape, of the generated function ``name``; ``part`` as in :class:`Evaluated`.

    ``leaves`` are the C operands of the inputs and of their changes.
    """

    name: str
    lower: Lowering
    leaves: dict
    nodes: tuple[int, ...]
    part: int = 0

    def body(self, drive):
        return Printer(self.lower.tape, drive.name, self.leaves).body(self.nodes)[0]

    def evaluated(self):
        known = frozenset(self.leaves)
        return Evaluated(self.name, self.lower.tape, self.lower, (self.nodes,), known, "tangent", self.part)


@dataclass(frozen=True)
class Tangents:
    """All tangents of a drive: of each rule; of residual and values of each design system; of the contact; of the
    point of each flank at fixed parameters of the flank.
    """

    rules: tuple[Tangent, ...]
    systems: tuple[tuple[Tangent, ...], ...]
    contact: Tangent
    flanks: tuple[Tangent, ...]

    def functions(self):
        """The generated functions, for the list of side conditions."""
        systems = (part for system in self.systems for part in system)
        for tangent in (*self.rules, *systems, self.contact, *self.flanks):
            yield tangent.evaluated()


def _seeds(tape, lower, symbols, stage):
    """Seed inputs d_name of these input symbols: input node → seed node."""
    return {lower(s): tape.input(sp.Symbol(f"d_{s}"), stage) for s in symbols}


def tangents(plan):
    """The :class:`Tangents` of a schedule. Adds the changes of the inputs to its tapes."""
    drive = plan.drive
    by_p = _seeds(plan.tape, plan.lower, [p.symbol for p in drive.parameters], Stage.DESIGN)
    return Tangents(
        rules=tuple(_of_rule(drive, rule, k) for k, rule in enumerate(drive.rules)),
        systems=tuple(_of_system(drive, system) for system in plan.systems),
        contact=_of_contact(plan, by_p),
        flanks=tuple(_of_flank(plan, flank, by_p) for flank in plan.flanks),
    )


def header(plan, tangents, generator):
    """The text of the drive's sensitivity header."""
    drive = plan.drive
    return render(
        "sensitivity.h.jinja",
        drive=drive,
        X=drive.name,
        generator=generator,
        defaults=[k for k, p in enumerate(drive.parameters) if p.default is not None],
        rules=[_rule(drive, *pair) for pair in zip(drive.rules, tangents.rules, strict=True)],
        systems=[_system(drive, *pair) for pair in zip(plan.systems, tangents.systems, strict=True)],
        tangent=tangents.contact.body(drive),
        flanks=[
            {"name": flank.body, "body": tangent.body(drive)}
            for flank, tangent in zip(plan.flanks, tangents.flanks, strict=True)
        ],
    )


def _of_contact(plan, by_p):
    """Of residual and contact point."""
    drive, tape, lower = plan.drive, plan.tape, plan.lower
    parameters = [p.symbol for p in drive.parameters]
    by_x = _seeds(tape, lower, plan.unknowns, Stage.ITERATE)
    by_phi = _seeds(tape, lower, [drive.instant], Stage.INSTANT)
    leaves = _leaves(lower, "p", parameters, by_p) | _leaves(lower, "x", plan.unknowns, by_x)
    leaves |= {lower(drive.instant): "phi", by_phi[lower(drive.instant)]: "dphi"}
    tangent = Derivatives(tape, by_p | by_phi | by_x)
    point = next(o for o in plan.observed if o.name == _POINT)
    return Tangent("tangent", lower, leaves, tuple(map(tangent, (*plan.residual, *point.nodes))))


def _of_flank(plan, flank, by_p):
    """Of a flank's point, at fixed parameters of the flank: the normal part does not depend on which are fixed."""
    tape, lower = plan.tape, plan.lower
    leaves = _leaves(lower, "p", [p.symbol for p in plan.drive.parameters], by_p)
    leaves |= {lower(q): f"q[{k}]" for k, q in enumerate(flank.parameters)}
    point = next(o for o in flank.outputs if o.name == "point")
    return Tangent(f"{flank.body}_tangent", lower, leaves, tuple(map(Derivatives(tape, by_p), point.nodes)))


def _leaves(lower, name, symbols, seeds):
    """C operands of inputs ``name[k]`` and of their seeds ``dname[k]``."""
    leaves = {lower(s): f"{name}[{k}]" for k, s in enumerate(symbols)}
    return leaves | {seeds[lower(s)]: f"d{name}[{k}]" for k, s in enumerate(symbols)}


def _of_rule(drive, rule, part):
    """Of a rule's value, on a tape of its own."""
    symbols, tape = [p.symbol for p in drive.parameters], Tape()
    lower = Lowering(tape, dict.fromkeys(symbols, Stage.DESIGN), drive.definitions)
    seeds = _seeds(tape, lower, symbols, Stage.DESIGN)
    value = Derivatives(tape, seeds)(lower(rule.value))
    return Tangent("derive_tangent", lower, _leaves(lower, "p", symbols, seeds), (value,), part)


def _rule(drive, rule, tangent):
    """A rule for the template: parameter index, name, what it needs, C body."""
    index, lower = {p.symbol: k for k, p in enumerate(drive.parameters)}, tangent.lower
    return {
        "index": index[rule.target],
        "name": rule.target.name,
        "needs": sorted(index[s] for s in lower.tape.inputs_of([lower(rule.value)])),
        "body": tangent.body(drive),
    }


def _of_system(drive, plan):
    """Of a design system's residual and of the values that it fills in, along dq and dy."""
    tape, lower = plan.tape, plan.lower
    symbols = [p.symbol for p in drive.parameters]
    by_q, by_y = _seeds(tape, lower, symbols, Stage.DESIGN), _seeds(tape, lower, plan.unknowns, Stage.ITERATE)
    leaves = _leaves(lower, "q", symbols, by_q) | _leaves(lower, "y", plan.unknowns, by_y)
    leaves[lower(PATH)] = f"q[{len(symbols)}]"
    tangent = Derivatives(tape, by_q | by_y)
    return tuple(
        Tangent(f"{plan.system.name}_{name}", lower, leaves, tuple(map(tangent, nodes)))
        for name, nodes in (("tangent", plan.residual), ("fill_tangent", plan.values))
    )


def _system(drive, plan, tangents):
    """A design system for the template: C bodies of the two tangents."""
    symbols = [p.symbol for p in drive.parameters]
    residual, values = tangents
    return {
        "name": plan.system.name,
        "unknowns": plan.unknowns,
        "residual": residual.body(drive),
        "values": values.body(drive),
        "fills": [symbols.index(target) for target in plan.system.fills],
    }
