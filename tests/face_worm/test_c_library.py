"""The face worm drive from C: design keys in, head-cutter placed, contact solved."""

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from meshwright import Drive
from tests.face_worm.designs import NAMES

ROOT = Path(__file__).resolve().parents[2]

PROGRAM = r"""
#include <math.h>
#include <stdio.h>
#include <string.h>
#include "meshwright.h"
#include "face_worm.h"

static void set(const mw_model *m, double *p, const char *table, const char *key, double value)
{
    for (int i = 0; i < m->np; i++)
        if (!strcmp(m->parameters[i].key, key) && !strcmp(m->parameters[i].table, table))
            p[i] = value * m->parameters[i].factor;
}

int main(void)
{
    const mw_model *m = &face_worm_model;
    double p[face_worm_NP], q[face_worm_NP + 1], s[face_worm_NS], x[face_worm_NX];
    mw_info info;
    for (int i = 0; i < face_worm_NP; i++) p[i] = NAN;
    set(m, p, "flank", "flank", 1.0);
SETTINGS
    const int failed = mw_complete(m, p, q, &info);
    if (failed) {
        printf("no placement: %s\n", m->systems[failed - 1].name);
        return 1;
    }
    const int status = mw_solve(m, p, 0.7, s, q, x, &info);
    printf("%d %.17g\n", status, x[m->error]);
    return 0;
}
"""


#: What a program with one header needs of the runtime.
SOURCES = ("complete", "solve", "trace")


@pytest.fixture(scope="module")
def build(tmp_path_factory):
    compiler = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
    if compiler is None:
        pytest.skip("no C compiler")
    folder = tmp_path_factory.mktemp("c")

    def make(settings):
        lines = "".join(f'    set(m, p, "design", "{key}", {value!r});\n' for key, value in settings.items())
        (folder / "main.c").write_text(PROGRAM.replace("SETTINGS\n", lines), encoding="utf-8")
        sources = [folder / "main.c", *(ROOT / "runtime" / "c" / f"{name}.c" for name in SOURCES)]
        includes = [f"-I{ROOT / 'generated' / 'c'}", f"-I{ROOT / 'runtime' / 'c'}"]
        command = [compiler, "-std=c99", "-Wall", "-Wextra", "-Werror", "-ffp-contract=off", *includes, *sources, "-lm"]
        subprocess.run([*map(str, command), "-o", str(folder / "program")], check=True)
        return subprocess.run([str(folder / "program")], capture_output=True, text=True, check=False)

    return make


def _keys(name):
    """The numbers of the packaged design, as a C programmer would type them."""
    tables = Drive.load(name).design.tables["design"]
    return {key: float(value) for key, value in tables.items() if isinstance(value, int | float)}


def test_a_c_program_places_the_head_cutter_and_solves_contact(build):
    done = build(_keys(NAMES[0]))
    status, error = done.stdout.split()
    assert int(status) >= 0
    assert float(error) == pytest.approx(Drive.load(NAMES[0]).tca(np.array([0.7])).error[0], abs=1e-15)


def test_a_c_program_is_told_which_system_has_no_solution(build):
    done = build(_keys(NAMES[0]) | {"gear_inner_radius_mm": 36.0})
    assert done.returncode == 1
    assert done.stdout.strip() == "no placement: inner_point"
