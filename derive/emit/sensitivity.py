"""Print what a change of the parameters does: directional derivatives of rules, design systems, residual and contact.

One direction at a time: the tangent of every value on the tape, by the chain rule. With the Jacobians of the design
systems and of the contact this gives exact sensitivities of their solutions (implicit function theorem); see
``runtime/c/sensitivity.c``.
"""

import sympy as sp

from derive.conditions import Evaluated
from derive.drive import PATH
from derive.emit.c99 import Printer
from derive.emit.render import render
from derive.tape import Lowering, Stage, Tape

_POINT = "point_pinion_f"


class _Tangents:
    """Tangent nodes on a tape: an input's is an input of its own, a value's follows by the chain rule."""

    def __init__(self, tape, seeds):
        self.tape, self._done = tape, dict(seeds)

    def __call__(self, i):
        for k in [*self.tape.needed([i], self._done), i]:
            if k not in self._done:
                args = self.tape.nodes[k].args
                known = {a: self._done.get(a, self.tape.constant(0)) for a in args}
                self._done[k] = self.tape.rule(k, known) if args else self.tape.constant(0)
        return self._done[i]


def _seeds(tape, lower, symbols, stage):
    """Seed inputs d_name of these input symbols: input node → seed node."""
    return {lower(s): tape.input(sp.Symbol(f"d_{s}"), stage) for s in symbols}


def header(plan, generator):
    """The text of the drive's sensitivity header."""
    drive = plan.drive
    leaves, nodes = _contact(plan)
    return render(
        "sensitivity.h.jinja",
        drive=drive,
        X=drive.name,
        generator=generator,
        defaults=[k for k, p in enumerate(drive.parameters) if p.default is not None],
        rules=list(_rules(drive)),
        systems=[_system(system, drive) for system in plan.systems],
        tangent=Printer(plan.tape, drive.name, leaves).body(nodes)[0],
    )


def functions(plan):
    """The generated functions, for the list of side conditions."""
    for k, rule in enumerate(plan.drive.rules):
        lower, leaves, _, value = _rule(plan.drive, rule)
        yield Evaluated("derive_tangent", lower.tape, lower, ((value,),), frozenset(leaves), "tangent", k)
    for system in plan.systems:
        leaves, residual, values = _tangents_of_system(system, plan.drive)
        for name, nodes in (("tangent", residual), ("fill_tangent", values)):
            name = f"{system.system.name}_{name}"
            yield Evaluated(name, system.tape, system.lower, (tuple(nodes),), frozenset(leaves), "tangent")
    leaves, nodes = _contact(plan)
    yield Evaluated("tangent", plan.tape, plan.lower, (tuple(nodes),), frozenset(leaves), "tangent")


def _contact(plan):
    """C operands of the inputs, and the tangents of residual and contact point."""
    drive, tape, lower = plan.drive, plan.tape, plan.lower
    parameters = [p.symbol for p in drive.parameters]
    by_p, by_x = _seeds(tape, lower, parameters, Stage.DESIGN), _seeds(tape, lower, plan.unknowns, Stage.ITERATE)
    by_phi = _seeds(tape, lower, [drive.instant], Stage.INSTANT)
    leaves = _leaves(lower, "p", parameters, by_p) | _leaves(lower, "x", plan.unknowns, by_x)
    leaves |= {lower(drive.instant): "phi", by_phi[lower(drive.instant)]: "dphi"}
    tangent = _Tangents(tape, by_p | by_phi | by_x)
    point = next(o for o in plan.observed if o.name == _POINT)
    return leaves, [tangent(i) for i in (*plan.residual, *point.nodes)]


def _leaves(lower, name, symbols, seeds):
    """C operands of inputs ``name[k]`` and of their seeds ``dname[k]``."""
    leaves = {lower(s): f"{name}[{k}]" for k, s in enumerate(symbols)}
    return leaves | {seeds[lower(s)]: f"d{name}[{k}]" for k, s in enumerate(symbols)}


def _rules(drive):
    """Tangent of each rule of the drive: parameter index, what it needs, C body, name."""
    symbols = [p.symbol for p in drive.parameters]
    index = {symbol: k for k, symbol in enumerate(symbols)}
    for rule in drive.rules:
        lower, leaves, node, value = _rule(drive, rule)
        yield {
            "index": index[rule.target],
            "name": rule.target.name,
            "needs": sorted(index[s] for s in lower.tape.inputs_of([node])),
            "body": Printer(lower.tape, drive.name, leaves).body([value])[0],
        }


def _rule(drive, rule):
    """A rule on a tape of its own: lowering, C operands of the inputs, its value and its tangent."""
    symbols, tape = [p.symbol for p in drive.parameters], Tape()
    lower = Lowering(tape, dict.fromkeys(symbols, Stage.DESIGN), drive.definitions)
    seeds = _seeds(tape, lower, symbols, Stage.DESIGN)
    node = lower(rule.value)
    return lower, _leaves(lower, "p", symbols, seeds), node, _Tangents(tape, seeds)(node)


def _system(plan, drive):
    """Tangents of a design system: of its residual and of the values that it fills in, along dq and dy."""
    symbols = [p.symbol for p in drive.parameters]
    leaves, residual, values = _tangents_of_system(plan, drive)
    printer = Printer(plan.tape, drive.name, leaves)
    return {
        "name": plan.system.name,
        "unknowns": plan.unknowns,
        "residual": printer.body(residual)[0],
        "values": printer.body(values)[0],
        "fills": [symbols.index(target) for target in plan.system.fills],
    }


def _tangents_of_system(plan, drive):
    """C operands of a design system's inputs, and the tangents of its residual and of its values."""
    tape, lower = plan.tape, plan.lower
    symbols = [p.symbol for p in drive.parameters]
    by_q, by_y = _seeds(tape, lower, symbols, Stage.DESIGN), _seeds(tape, lower, plan.unknowns, Stage.ITERATE)
    leaves = _leaves(lower, "q", symbols, by_q) | _leaves(lower, "y", plan.unknowns, by_y)
    leaves[lower(PATH)] = f"q[{len(symbols)}]"
    tangent = _Tangents(tape, by_q | by_y)
    return leaves, [tangent(i) for i in plan.residual], [tangent(i) for i in plan.values]
