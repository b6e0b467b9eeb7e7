"""``X_certify`` of a header alone: strict C, nothing but sqrt, and what it proves holds the library's certificate."""

import ctypes
from fractions import Fraction

import numpy as np
import pytest

from meshwright import Drive
from meshwright.contact import exact
from tests.embedding import compile as c
from tests.quick import quick

#: A small drive in the quick tests, one of every other kind in the longer ones.
DESIGNS = (
    "spherical-table-2-3", "recess-action-full", "face-worm-cylindrical-convex", "helical-crowned", "bevel-formate",
)  # fmt: skip
ONE_QUICKLY = [pytest.param(name, marks=[pytest.mark.validate] * (name != DESIGNS[0])) for name in DESIGNS]

PROGRAM = r"""
#include "DRIVE_certify.h"

int prove(const mw_wide *p, double phi, const double *x, double *e, double *box);
int prove(const mw_wide *p, double phi, const double *x, double *e, double *box)
{
    double s[DRIVE_CERTIFY_NS];
    return DRIVE_certify_setup(p, s) ? DRIVE_certify(s, mwc_make(phi, 0.0), x, e, box) : -1;
}
"""


def prover(drive, folder, commands, standard, *options):
    """The function ``prove`` of a program that holds nothing but the header.

    ``commands``: a compiler's for C and C++; what it links it links as C: the header needs no library of C++.
    """
    name = drive.design.description["name"]
    unit = folder / ("prove.c" if standard == "c99" else "prove.cpp")
    before = "" if standard == "c99" else 'extern "C" '
    unit.write_text(PROGRAM.replace("DRIVE", name).replace("int prove", f"{before}int prove", 1))
    output, library = folder / "prove.o", folder / "prove.so"
    command = (*commands[standard == "c++11"], f"-std={standard}", "-O1", "-fPIC", *c.STRICT, *c.EXACT, *options)
    c.run(*command, f"-I{c.GENERATED}", "-c", unit, "-o", output)
    allowed = {"sqrt", "memcpy", "memset", "_GLOBAL_OFFSET_TABLE_", "__stack_chk_fail"}
    assert c.undefined(output) <= allowed | ({"fabs"} if "-O0" in options else set())  # elsewhere an instruction
    assert not c.writable(output)
    c.run(*commands[0], "-shared", output, "-o", library, "-lm")
    return ctypes.CDLL(str(library)).prove


def called(prove, drive, phi, x):
    """(outcome, e, box) of the design of exactly the doubles of its parameters."""
    p = exact.wides([(Fraction(float(v)),) * 2 for v in np.nan_to_num(drive.design.parameters)])
    x, e, box = np.ascontiguousarray(x, float), np.empty(len(x)), np.empty(len(x))
    arrays = [a.ctypes.data_as(ctypes.c_void_p) for a in (x, e, box)]
    return prove(p.ctypes.data_as(ctypes.c_void_p), ctypes.c_double(phi), *arrays), e, box


@pytest.mark.parametrize("name", ONE_QUICKLY)
def test_a_contact_is_proved_and_its_bounds_hold_what_the_library_encloses(tmp_path, name):
    drive = Drive.load(name)
    prove = prover(drive, tmp_path, sorted(c.compilers().items())[-1][1], "c99")
    angle = float(drive.design.reference_angle) + 0.01
    solution = drive.trace([angle])[0][0]
    outcome, e, box = called(prove, drive, angle, solution)
    assert outcome == 1 and np.all(e < box)
    closer = drive.certify([drive.design.mirror.sign * angle])
    for k, entry in enumerate(closer.records["x"][0][: len(solution)]):
        # of the decimals, where the header's is of the doubles: they differ by some units in the last place
        assert abs(float(entry["hi"]) - solution[k]) <= e[k] + 1e-12 * (1.0 + abs(solution[k]))
    outcome, e, _ = called(prove, drive, angle, solution + 1e-3)
    assert outcome == 0 or np.all(e > 0.999e-3)
    assert called(prove, drive, angle, np.full(len(solution), np.nan))[0] == 0


@pytest.mark.parametrize("compiler", sorted(c.compilers()))
@pytest.mark.parametrize("standard", quick(["c99", "c++11"], "c99"))
def test_the_header_compiles_strictly_with_every_compiler(tmp_path, compiler, standard):
    drive = Drive.load(DESIGNS[0])
    prove = prover(drive, tmp_path, c.compilers()[compiler], standard, "-O0", "-fno-sanitize=all")
    angle = float(drive.design.reference_angle)
    assert called(prove, drive, angle, drive.trace([angle])[0][0])[0] == 1
