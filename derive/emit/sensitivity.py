"""Print what a change of the parameters does: directional derivatives of rules, residual and contact point.

One direction at a time: the tangent of every value on the tape, by the chain rule. With the Jacobian of the contact
this gives exact sensitivities of the solution (implicit function theorem); see ``runtime/c/sensitivity.c``.
"""

import sympy as sp

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
    drive, tape, lower = plan.drive, plan.tape, plan.lower
    parameters = [p.symbol for p in drive.parameters]
    by_p, by_x = _seeds(tape, lower, parameters, Stage.DESIGN), _seeds(tape, lower, plan.unknowns, Stage.ITERATE)
    leaves = {lower(s): f"p[{k}]" for k, s in enumerate(parameters)} | {lower(drive.instant): "phi"}
    leaves |= {lower(s): f"x[{k}]" for k, s in enumerate(plan.unknowns)}
    leaves |= {node: f"dp[{k}]" for k, node in enumerate(by_p.values())}
    leaves |= {node: f"dx[{k}]" for k, node in enumerate(by_x.values())}
    tangent = _Tangents(tape, by_p | by_x)
    point = next(o for o in plan.observed if o.name == _POINT)
    nodes = [*plan.residual, *point.nodes]
    return render(
        "sensitivity.h.jinja",
        drive=drive,
        X=drive.name,
        generator=generator,
        defaults=[k for k, p in enumerate(drive.parameters) if p.default is not None],
        rules=list(_rules(drive)),
        tangent=Printer(tape, drive.name, leaves).body([tangent(i) for i in nodes])[0],
    )


def _rules(drive):
    """Tangent of each rule of the drive: parameter index, C body, name."""
    symbols = [p.symbol for p in drive.parameters]
    index = {symbol: k for k, symbol in enumerate(symbols)}
    for rule in drive.rules:
        tape = Tape()
        lower = Lowering(tape, dict.fromkeys(symbols, Stage.DESIGN), drive.definitions)
        seeds = _seeds(tape, lower, symbols, Stage.DESIGN)
        leaves = {lower(s): f"p[{k}]" for k, s in enumerate(symbols)}
        leaves |= {node: f"dp[{k}]" for k, node in enumerate(seeds.values())}
        value = _Tangents(tape, seeds)(lower(rule.value))
        needs = sorted(index[s] for s in sp.sympify(rule.value).free_symbols & index.keys())
        yield {
            "index": index[rule.target],
            "name": rule.target.name,
            "needs": needs,
            "body": Printer(tape, drive.name, leaves).body([value])[0],
        }


def table_of_models(names):
    """C source that lists the sensitivity functions of every drive, for the shared library."""
    includes = "".join(f'#include "{name}_sensitivity.h"\n' for name in names)
    rows = "".join(f'    {{ "{name}", {name}_derive_tangent, {name}_tangent }},\n' for name in names)
    return (
        "/* The sensitivity functions of every drive. Generated; do not edit.  SPDX-License-Identifier: MIT-0 */\n"
        f"{includes}\n"
        f"static const mw_tangents mw_tangent_models[] = {{\n{rows}}};\n"
    )
