"""``X_solve`` of a header alone, from nothing: the library's contact, to the bit, or a status that says why not.

Random input angles and misalignments, within and far beyond what the teeth can do, go through a C program that holds
the header and is linked with the library. What it calls a success is judged again by what the two surfaces say.
"""

import json
import subprocess

import numpy as np
import pytest

from meshwright.base.library import SHIPPED
from tests.embedding import compile as c
from tests.quick import full

QUICK = "spherical_convex_spur"
FAMILIES = ("cylindrical_worm_zn_zn", QUICK, "face_worm")
DRIVES = sorted(json.loads(path.read_text())["name"] for path in c.GENERATED.glob("*.json"))

PROGRAM = r"""
#include <stdio.h>
#include <string.h>
#include "DRIVE.h"
#include "meshwright.h"
#define X(name) DRIVE_##name

/* Distance of the points, and 1 + cosine between the normals, as the observation of x has them. */
static void gaps(const double *s, const double *x, double *distance, double *normals, double *size)
{
    double o[X(NO)], sum = 0.0, dot = 0.0, length = 0.0;
    X(observe)(s, x, o);
    for (int i = 0; i < 3; i++) {
        const double d = o[X(O_point_pinion_f) + i] - o[X(O_point_wheel_f) + i];
        sum += d * d;
        length += o[X(O_point_pinion_f) + i] * o[X(O_point_pinion_f) + i];
        dot += o[X(O_normal_pinion_f) + i] * o[X(O_normal_wheel_f) + i];
    }
    *distance = sqrt(sum), *normals = 1.0 + dot, *size = sqrt(length);
}

static int sides_differ(const mw_side *a, const mw_side *b)
{
    return a->status != b->status || a->pairs != b->pairs || a->edge != b->edge ||
           memcmp(&a->pair, &b->pair, 3 * sizeof a->pair) != 0;
}

/* Whether header and library say the same of the whole drive, asked first far away by one of them. */
static int cycles_differ(const double *p, double phi)
{
    static double c[X(NC)], by_library[X(NC)];
    double coast[X(NP)];
    mw_cycle one, other;
    for (int k = 0; k < X(NP); k++) coast[k] = k == X(OTHER_FLANK) ? -p[k] : p[k];
    const int guard = X(cycle_setup)(p, NULL, c), size = mw_cycle_size(&X(model));
    if (size != X(NC) || guard != mw_cycle_setup(&X(model), p, X(OTHER_FLANK) < 0 ? NULL : coast, by_library)) return 1;
    X(cycle)(c, phi + 0.4, &one);
    if (X(cycle)(c, phi, &one) != one.drive.status) return 1;
    mw_cycles(&X(model), by_library, &phi, 1, &other);
    if (guard && one.drive.status >= 0 && one.coast.status >= 0) return 1;
    return sides_differ(&one.drive, &other.drive) || sides_differ(&one.coast, &other.coast) ||
           memcmp(&one.pair, &other.pair, 2 * sizeof one.pair) != 0 ||
           memcmp(&one.backlash, &other.backlash, sizeof one.backlash) != 0;
}

int main(void)
{
    double p[X(NP)], phi, s[X(NS)], x[X(NX)], other[X(NX)], state[X(NS)], work[X(NP)];
    const mw_model *m = &X(model);
    double s_next[X(NS)], next[X(NX)];
    mw_info info, by_library, followed;
    long solved = 0, differ = 0, garbage = 0, numbers = 0, count = 0; /* info may be NULL: now and then it is */
    while (fread(&phi, sizeof phi, 1, stdin) == 1 && fread(p, sizeof p, 1, stdin) == 1) {
        double distance = 0.0, normals = 0.0, size = 0.0;
        count++;
        const int guard = X(setup)(p, s), status = X(solve)(s, phi, x, &info);
        const int expected = mw_solve(m, p, phi, state, work, other, &by_library);
        if (status != info.status || status != expected || memcmp(x, other, sizeof x) != 0) differ++;
        if (guard && status != MW_BAD_INPUT) garbage++;
        if (strcmp(X(status_text)(status), "no such status") == 0) garbage++;
        if (count % 16 == 0 && X(solve)(s, phi, x, NULL) != status) differ++;
        for (int i = 0; i < X(NX); i++) next[i] = NAN;
        X(setup)(p, s_next);
        X(follow)(s_next, phi, next, &followed);
        mw_turn(m, p, &phi, 1, state, work, other, &by_library);
        if (followed.status != by_library.status || memcmp(next, other, sizeof other) != 0) differ++;
        if (guard && followed.status != MW_BAD_INPUT) garbage++;
        if (X(follow)(s_next, phi, next, NULL) != followed.status || memcmp(next, other, sizeof other) != 0) differ++;
        if (count % 8 == 0 && count < 128 && cycles_differ(p, phi)) differ++; /* it may look long */
        if (status < 0) {
            for (int i = 0; i < X(NX); i++) numbers += x[i] == x[i];
            continue;
        }
        solved++;
        gaps(s, x, &distance, &normals, &size);
        if (!(distance <= 1e-9 * (1.0 + size)) || !(normals <= 1e-9)) garbage++;
        for (int i = 0; i < X(NX); i++)
            if (!(x[i] >= X(unknown_names)[i].lower && x[i] <= X(unknown_names)[i].upper)) garbage++;
    }
    printf("%ld %ld %ld %ld %ld\n", count, solved, differ, garbage, numbers);
    return 0;
}
"""


def _inputs(drive, count, seed):
    """Angles and complete parameters (count, 1 + np): half the misalignments are small, some angles are none."""
    described = json.loads((c.GENERATED / f"{drive}.json").read_text(encoding="utf-8"))
    generator = np.random.default_rng(seed)
    rows = np.tile([0.0, *(float.fromhex(v) for v in described["self_test"]["p"])], (count, 1))
    size = np.where(generator.random(count) < 0.5, 0.05, 1.0)
    for k, p in enumerate(described["parameters"]):
        if p["table"] == "misalignment":
            unit = np.radians(0.5) if p["unit"] == "rad" else 0.3
            rows[:, k + 1] += unit * size * generator.normal(size=count)
    sizes = generator.choice([0.3, 3.0, 40.0, 3000.0], count, p=[0.35, 0.35, 0.27, 0.03])  # far ones take long
    rows[:, 0] = sizes * generator.uniform(-1.0, 1.0, count)
    rows[:5, 0] = np.nan, np.inf, -np.inf, 1e300, -20000.0
    return rows


def _run(drive, folder, count, seed):
    source, program = folder / "solve.c", folder / "solve"
    source.write_text(PROGRAM.replace("DRIVE", drive))
    command = sorted(c.compilers().items())[-1][1][0]
    c.run(*command, "-std=c99", "-O2", *c.STRICT, *c.EXACT, f"-I{c.GENERATED}", f"-I{c.RUNTIME}", source, "-o", program,
          f"-L{SHIPPED}", "-lmeshwright", f"-Wl,-rpath,{SHIPPED}", "-lm")  # fmt: skip
    done = subprocess.run([program], input=_inputs(drive, count, seed).tobytes(), capture_output=True, check=True)
    return [int(number) for number in done.stdout.split()]


def _holds(drive, folder, count):
    given, solved, differ, garbage, numbers = _run(drive, folder, count, seed=len(drive))
    assert given == count
    assert differ == garbage == numbers == 0
    return solved


@pytest.mark.parametrize("drive", [pytest.param(d, marks=[pytest.mark.validate] * (d != QUICK)) for d in FAMILIES])
def test_a_header_alone_solves_what_the_library_solves(tmp_path, drive):
    assert _holds(drive, tmp_path, 300) > 30


@pytest.mark.validate
@pytest.mark.parametrize("drive", DRIVES)
def test_random_inputs_of_every_drive(tmp_path, drive):
    """A thousand, or ten thousand."""
    count = 10_000 if full() else 1_000
    assert _holds(drive, tmp_path, count) > count // 10
