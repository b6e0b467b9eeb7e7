"""The printed function of residual and Jacobian at a point computes what the table of both does, bit by bit, and shows
what ``domain.h`` looks at in the table's order: its bounds, found by the table, are of the numbers that it computes.
"""

import ctypes
from pathlib import Path

import numpy as np
import pytest

from meshwright import Drive
from tests.certified.arithmetic import C, library_of
from tests.quick import quick

D = ctypes.POINTER(ctypes.c_double)
GENERATED = Path(__file__).resolve().parents[2] / "generated" / "c"
#: A design of every kind of operation, then of every other drive.
DESIGNS = ("recess-action-full", "plain-zc", "plain-zi", "helical-crowned")
OTHERS = (
    "plain-za", "plain-zk", "zk-zn-90", "spherical-table-2-3", "face-worm-cylindrical-convex", "bevel-crowned-both",
    "bevel-formate",
)  # fmt: skip

_SOURCE = """
#define MWC_BALLS
#define MW_LANES 1
#include "certify/domain.h"
#include "{drive}_certified.h"
#include "{drive}_certify.h"

int guards(void)
{{
    return mwc_run_bounds(&{drive}_certified.equations, NULL, NULL, NULL);
}}

int design_slots(void)
{{
    return {drive}_certified.design_slots;
}}

/* The numbers of the state that follow from the angle. */
void turn(double *s, double phi)
{{
    const mw_certified *t = &{drive}_certified;
    mw_ball arguments[MWC_ARGUMENTS], registers[MWC_REGISTERS];
    for (int i = 0; i < t->slots; i++) arguments[i] = mwc_make(s[i], 0.0);
    arguments[t->slots] = mwc_make(phi, 0.0);
    mwc_run_ball(&t->instant, t->instant.instructions, arguments, registers);
    for (int i = t->design_slots; i < t->slots; i++) s[i] = registers[t->instant.output[i - t->design_slots]].mid;
}}

/* By the table, one operation after the other: residual and Jacobian, and what is looked at. */
void by_table(const double *known, double *results, double *G)
{{
    const mw_code *code = &{drive}_certified.equations;
    mw_ball arguments[MWC_ARGUMENTS], registers[MWC_REGISTERS];
    unsigned char quotient[MWC_REGISTERS] = {{ 0 }};
    const int count = {drive}_certified.slots + {unknowns};
    for (int i = 0; i < count; i++) arguments[i] = mwc_make(known[i], 0.0);
    mwc_run_ball(code, 0, arguments, registers);
    for (int k = 0; k < code->instructions; k++) {{
        const unsigned short *i = code->operation + 4 * k;
        const double a = registers[i[2]].mid, b = registers[i[3]].mid;
        mw_code one = *code;
        if (i[0] == MW_OP_DIV) *G++ = fabs(b), *G++ = -fabs(a);
        if (i[0] == MW_OP_SQRT) *G++ = a;
        if (i[0] == MW_OP_SIGN) *G++ = fabs(a);
        if (i[0] == MW_OP_ATAN2) *G++ = mwc_uncut(a, b);
        if (i[0] == MW_OP_MUL && quotient[i[2]]) *G++ = -fabs(b);
        else if (i[0] == MW_OP_MUL && quotient[i[3]]) *G++ = -fabs(a);
        one.operation = i;
        mwc_run_ball(&one, 1, arguments, registers);
        quotient[i[1]] = i[0] == MW_OP_DIV;
        if (i[0] == MW_OP_SINCOS) quotient[i[3]] = 0;
    }}
    for (int k = 0; k < code->outputs; k++) results[k] = registers[code->output[k]].mid;
}}

void at_point(const double *s, const double *t, const double *x, const int *rows, double *R, double *J, double *G)
{{
    {drive}_enclose_point1(s, t, x, rows, R, J, G);
}}
"""


def compiled(folder, description):
    name, unknowns = description["name"], len(description["unknowns"])
    return library_of(folder, _SOURCE.format(drive=name, unknowns=unknowns), C, GENERATED)


def pointer(array):
    return array.ctypes.data_as(D)


def agrees(folder, name):
    drive = Drive.load(name)
    description, n = drive.design.description, drive.model.nx
    loaded, angle = compiled(folder, description), float(drive.design.reference_angle)
    x, s, design = drive.trace([angle])[0][0], drive.enclosed.state["hi"].copy(), loaded.design_slots()
    loaded.turn(pointer(s), ctypes.c_double(angle))
    three = np.zeros((design, 3))
    three[:, 0], three[:, 2] = s[:design], np.abs(s[:design])
    own = np.zeros((len(s) - design, 2))
    own[:, 0] = s[design:]
    rows, error = np.random.default_rng(1).permutation(n).astype(np.int32), description["error"]
    R, J, shown = np.empty((n, 2)), np.empty((n, n)), np.empty(loaded.guards())
    loaded.at_point(*map(pointer, (three, own, x)), rows.ctypes.data_as(ctypes.c_void_p), *map(pointer, (R, J, shown)))
    results, wanted = np.empty(n + n * n), np.full(len(shown) + 1, np.inf)
    loaded.by_table(*map(pointer, (np.concatenate([s, x]), results, wanted)))
    columns = [k for k in range(n) if k != error] + [error]
    np.testing.assert_array_equal(R[rows, 0], results[:n])
    np.testing.assert_array_equal(J[rows], results[n:].reshape(n, n)[:, columns])
    np.testing.assert_array_equal(shown, wanted[:-1])
    assert np.all(np.isfinite(results)) and np.isinf(wanted[-1]) and np.all(R[:, 1] >= 0.0)


@pytest.mark.parametrize("name", quick(DESIGNS, DESIGNS[0]))
def test_the_printed_point_is_that_of_the_table(tmp_path, name):
    agrees(tmp_path, name)


@pytest.mark.validate
@pytest.mark.parametrize("name", OTHERS)
def test_so_is_that_of_every_other_drive(tmp_path, name):
    agrees(tmp_path, name)
