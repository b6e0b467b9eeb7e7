"""Print a schedule's kernels over several instances at once: structure of arrays, for SIMD units.

The statements are those of the scalar header (:mod:`derive.emit.c99`), inside a loop over lanes; only what a trace
needs for every design or point is printed: the design stage, the instant stage and the Newton step. The step's loop
takes two lanes in a turn, of the lower and of the upper half, so that one has work while the other waits.
"""

from derive.emit.c99 import Body, Leaves, Printer, names_of
from derive.emit.render import render
from derive.passes.arrange import Routines, SideBySide
from derive.passes.plan import Schedule


def _in_lanes(leaves, lane="l"):
    """The scalar operands, per lane: ``s[3]`` becomes ``s[3 * MW_LANES + l]``."""
    return {node: _in_lane(text, lane) for node, text in leaves.items()}


def _in_lane(text, lane):
    return f"{text[:-1]} * MW_LANES + {lane}]" if text.endswith("]") else f"{text}[{lane}]"


#: Functions that are printed in lanes, beside the step.
KERNELS = ("setup", "set_phi")


def header(plan: Schedule, routines: Routines, step: SideBySide, generator: str):
    """The text of the drive's lane header."""
    leaves, name, names = Leaves.of(plan), plan.drive.name, names_of(plan)
    guards, setup = routines["setup"]

    def body(readable, made):
        return Printer(names, name, _in_lanes(readable)).body(made)[0]

    lower = Printer(names, name, _in_lanes(leaves.iterate))
    upper = Printer(names, name, _in_lanes(leaves.iterate, "m"), own="m")
    return render(
        "lanes.h.jinja",
        drive=plan.drive,
        X=plan.drive.name,
        generator=generator,
        design_slots=plan.design_slots,
        guards=body(leaves.design, guards),
        setup=body(leaves.design, setup),
        set_phi=body(leaves.instant, *routines["set_phi"]),
        step=_side_by_side([lower, upper], step),
    )


def _side_by_side(printers, step):
    """One body of a routine by each of two printers of the same tape, statement beside statement; results come printer
    by printer.
    """
    program, statements, known = dict(step.routine.steps), [], [{}, {}]
    for copy, i in step.places:
        statements += printers[copy].statement(i, program[i], known[copy])
    results = [r for k, printer in enumerate(printers) for r in printer.results(step.routine.outputs, known[k])]
    return Body(tuple(statements), tuple(results), step.routine.operations)
