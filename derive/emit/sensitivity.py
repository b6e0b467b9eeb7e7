"""Print what a change of the parameters does: the tangents that :mod:`derive.passes.tangents` has made."""

from derive.emit.c99 import Printer
from derive.emit.render import render
from derive.program.names import Names

#: Arguments that are one number.
_NUMBERS = ("phi", "dphi")


def header(plan, routines, generator):
    """The text of the drive's sensitivity header, of a :class:`~derive.passes.tangents.Differentiated` plan."""
    drive = plan.drive
    return render(
        "sensitivity.h.jinja",
        drive=drive,
        X=drive.name,
        generator=generator,
        defaults=[k for k, p in enumerate(drive.parameters) if p.default is not None],
        rules=[_rule(drive, *pair, routines) for pair in zip(drive.rules, plan.rule_tangents, strict=True)],
        systems=[_system(drive, *pair, routines) for pair in zip(plan.systems, plan.system_tangents, strict=True)],
        tangent=_body(drive, plan.contact_tangent, routines),
        flanks=[
            {"name": flank.body, "body": _body(drive, tangent, routines)}
            for flank, tangent in zip(plan.flanks, plan.flank_tangents, strict=True)
        ],
    )


def _body(drive, tangent, routines):
    leaves = {
        node: name if name in _NUMBERS else f"{name}[{k}]"
        for name, nodes in tangent.inputs.items()
        for k, node in enumerate(nodes)
    }
    names = Names(tangent.lower.tape, tangent.lower.names())
    return Printer(names, drive.name, leaves).body(routines[tangent.evaluated().key][tangent.part])[0]


def _rule(drive, rule, tangent, routines):
    """A rule for the template: parameter index, name, what it needs, C body."""
    index, lower = {p.symbol: k for k, p in enumerate(drive.parameters)}, tangent.lower
    return {
        "index": index[rule.target],
        "name": rule.target.name,
        "needs": sorted(index[s] for s in lower.tape.inputs_of([lower(rule.value)])),
        "body": _body(drive, tangent, routines),
    }


def _system(drive, plan, tangents, routines):
    """A design system for the template: C bodies of the two tangents."""
    symbols = [p.symbol for p in drive.parameters]
    residual, values = tangents
    return {
        "name": plan.system.name,
        "unknowns": plan.unknowns,
        "residual": _body(drive, residual, routines),
        "values": _body(drive, values, routines),
        "fills": [symbols.index(target) for target in plan.system.fills],
    }
