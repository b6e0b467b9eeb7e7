"""Print what bounded flanks need: the systems of edge contact, and limits and surfaces beyond first order.

Functions of the state alone, the parameters at its end included: what they need of the design they form themselves.
"""

from derive.emit.c99 import Leaves, Printer, linearised, names_of
from derive.emit.metadata import parameters_at
from derive.emit.render import render


def header(plan, routines, generator):
    """The text of the drive's header of bounded flanks."""
    drive, names = plan.drive, names_of(plan)
    before = parameters_at(plan)
    known = Leaves.of(plan).state | {
        plan.lower(p.symbol): f"s[{before + k}]" for k, p in enumerate(drive.parameters)
    }
    unknowns = {plan.lower(u): f"x[{k}]" for k, u in enumerate(plan.unknowns)}
    printer = Printer(names, drive.name, known | unknowns, seldom=True)
    equations, jacobian = linearised(printer, routines["edges"]) if plan.edges.systems else (None, None)
    return render(
        "bounded.h.jinja",
        drive=drive,
        X=drive.name,
        generator=generator,
        equations=equations,
        jacobian=jacobian,
        systems=plan.edges.systems,
        expansions=[_expansion(plan, names, known, routines, e) for e in plan.expansions],
    )


def _expansion(plan, names, known, routines, expansion):
    """Bodies of the slopes and of the second derivatives of one surface, functions of its parameters q."""
    own = {plan.lower(q): f"q[{k}]" for k, q in enumerate(expansion.of.parameters)}
    printer = Printer(names, plan.drive.name, known | own, seldom=True)
    name = f"{expansion.of.region}_{expansion.of.body}"
    return {
        "name": name,
        "slopes": printer.body(*routines[f"slopes_{name}"])[0],
        "second": printer.body(*routines[f"second_{name}"])[0] if expansion.second else None,
    }
