"""Print a schedule's kernels over several instances at once: structure of arrays, for SIMD units.

The statements are those of the scalar header (:mod:`derive.emit.c99`), inside a loop over lanes; only what a trace
needs for every design or point is printed: the design stage, the instant stage and the Newton step. The step's loop
takes two lanes in a turn, of the lower and of the upper half, so that one has work while the other waits.
"""

from derive.emit.c99 import Leaves, Printer, side_by_side
from derive.emit.render import render
from derive.passes.plan import Schedule


def _in_lanes(leaves, lane="l"):
    """The scalar operands, per lane: ``s[3]`` becomes ``s[3 * MW_LANES + l]``."""
    return {node: _in_lane(text, lane) for node, text in leaves.items()}


def _in_lane(text, lane):
    return f"{text[:-1]} * MW_LANES + {lane}]" if text.endswith("]") else f"{text}[{lane}]"


def header(plan: Schedule, generator: str):
    """The text of the drive's lane header."""
    leaves, name = Leaves.of(plan), plan.drive.name
    slots = list(plan.state)

    def body(readable, outputs):
        return Printer(plan.tape, name, _in_lanes(readable)).body(outputs)[0]

    lower = Printer(plan.tape, name, _in_lanes(leaves.iterate))
    upper = Printer(plan.tape, name, _in_lanes(leaves.iterate, "m"), suffix="m")
    return render(
        "lanes.h.jinja",
        drive=plan.drive,
        X=plan.drive.name,
        generator=generator,
        design_slots=plan.design_slots,
        guards=body(leaves.design, [g.node for g in plan.guards]),
        setup=body(leaves.design, slots[: plan.design_slots]),
        set_phi=body(leaves.instant, slots[plan.design_slots :]),
        step=side_by_side([lower, upper], lower.routine(plan.newton_step, {}), [{}, {}]),
    )
