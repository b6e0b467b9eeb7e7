"""Kinks of flanks, where a relief begins: what is continuous there is told from what jumps, and paths go through."""

import ctypes

import numpy as np
import pytest
import sympy as sp

from derive.emit.certified import code
from derive.language.choice import excess, unit_step
from derive.passes.quotients import reciprocals
from derive.program.routine import routine
from meshwright import Drive
from meshwright.base.library import ffi, library
from meshwright.contact.analysis import trace
from meshwright.contact.certified_path import certified_path
from meshwright.contact.results import ARCSEC
from tests.certified.arithmetic import library_of
from tests.derive.small import lowered, x, y

_SOURCE = """
#define MWC_PATHS
#include "certify/kinks.h"
int continuous(const int *sizes, const unsigned short *operation, const unsigned short *output)
{
    const mw_code code = { sizes[0], sizes[1], sizes[2], sizes[3], sizes[3], sizes[4], NULL, NULL, operation, output };
    return mwc_continuous(&code, sizes[4]);
}
"""

CONTINUOUS = (
    excess(x), excess(x) ** 2 * y, x**2 * unit_step(x) + y, sp.Abs(x - y), excess(x) * excess(y),
    sp.sqrt(y + excess(x)), excess(x) ** 3 * unit_step(x) * sp.sin(y),
)  # fmt: skip
#: What jumps, and what no one shows that it does not.
JUMPING = (
    unit_step(x), sp.sign(x) * y, excess(x) * unit_step(y), y * unit_step(x) + x, sp.sin(unit_step(x)),
    x * sp.sign(x - 1), x + unit_step(x) * excess(y), sp.sign(excess(x) - unit_step(x)),
)  # fmt: skip


@pytest.fixture(scope="module")
def continuous(tmp_path_factory):
    """Whether the function of x and y with a kink is shown to be continuous."""
    loaded = library_of(tmp_path_factory.mktemp("kinks"), _SOURCE)

    def shown(*expressions):
        tape, lower, nodes = lowered(*expressions)
        made = code(reciprocals(routine(tape, nodes)), {lower(x): 0, lower(y): 1})
        flat = [k for instruction in made.instructions for k in instruction]
        sizes = made.registers, len(made.inputs), len(made.constants), len(made.instructions), len(nodes)
        return loaded.continuous(
            (ctypes.c_int * 5)(*sizes), (ctypes.c_ushort * len(flat))(*flat),
            (ctypes.c_ushort * len(nodes))(*made.outputs),
        )  # fmt: skip

    return shown


@pytest.mark.parametrize("expression", CONTINUOUS, ids=str)
def test_a_kink_is_no_jump(continuous, expression):
    assert continuous(expression, y) == 1


@pytest.mark.parametrize("expression", JUMPING, ids=str)
def test_a_jump_is_none_of_the_kinks_that_a_path_goes_through(continuous, expression):
    assert continuous(expression, y) == 0
    assert continuous(y, expression) == 0


#: Reliefs of tips by a parabola and by a cubic, and of a root too.
RELIEVED = ({}, {"relief_exponent": 3}, {"pinion_root_relief_um": 6.0, "pinion_root_relief_radius_mm": 30.5})


@pytest.mark.parametrize("design", RELIEVED, ids=("parabolas", "cubics", "root"))
def test_a_path_goes_on_where_a_relief_begins(design):
    """All contacts that floating point finds lie in it, close to the kinks most of all; so do their errors."""
    drive = Drive.load("helical-crowned").with_(design=design)
    path = certified_path(drive, -0.25, 0.28)
    assert path.complete and path.tube < 5e-8 * ARCSEC
    kinked = [ends for piece, ends in zip(path.pieces, path.ends, strict=True) if piece.kinks]
    assert kinked
    for (begin, end), piece in zip(path.ends, path.pieces, strict=True):
        angles = np.linspace(begin, end, 7)[1:-1]
        solved, found = trace(drive, angles)
        assert (found["status"] >= 0).all()
        for angle, unknowns in zip(angles, solved, strict=True):
            for k, value in enumerate(unknowns):
                ball = library().mw_piece_at(piece, ffi.addressof(piece.x[k]), angle)
                assert abs(value - ball.mid) <= ball.radius + 1e-10
            low, high = path.error(float(angle))
            assert low - 1e-14 <= unknowns[-1] <= high + 1e-14


def test_only_about_a_kink_pieces_are_short():
    """Where a relief of no depth would begin there is none."""
    path = certified_path(Drive.load("helical-crowned"), -0.25, 0.28)
    widths = np.array([end - begin for begin, end in path.ends])
    kinked = np.array([bool(piece.kinks) for piece in path.pieces])
    assert widths[kinked].min() < 1e-6 and widths[kinked].max() > 0.1
    assert np.count_nonzero(widths < 1e-6) < 50
    assert len(path.pieces) < 150
