"""Programs of a few operations, on which a pass can be followed by hand, and the smallest drive that is packaged."""

from functools import cache

import sympy as sp

from derive import drives
from derive.passes.schedule import schedule
from derive.program.lowering import Lowering
from derive.program.routine import routine
from derive.program.tape import Stage, Tape

p, x, y, z = sp.symbols("p x y z", real=True)
INPUTS = {p: Stage.DESIGN, x: Stage.ITERATE, y: Stage.ITERATE, z: Stage.ITERATE}
VALUES = {p: 2.3, x: 0.8, y: -1.7, z: 0.4}

DRIVE = "spherical_convex_spur"


def lowered(*expressions):
    """Tape, what lowers onto it, and the nodes of the expressions."""
    lower = Lowering(Tape(), INPUTS)
    return lower.tape, lower, [lower(e) for e in expressions]


def program(*expressions):
    """The routine of the expressions."""
    tape, _, nodes = lowered(*expressions)
    return routine(tape, nodes)


@cache
def plan():
    """The schedule of the smallest drive."""
    return schedule(drives.catalogue([DRIVE])[DRIVE]())
