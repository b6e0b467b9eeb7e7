"""A design file's keys through index macros alone: the header completes the design and solves it to the library's bits.

One packaged design of each family, those of them whose sizes follow from equations of the design included.
"""

import subprocess

import pytest

from meshwright import Drive
from tests.embedding import compile as c

PROGRAM = r"""
#include <stdio.h>
#include "DRIVE.h"
#define X(name) DRIVE_##name
int main(void)
{
    double p[X(NP)], s[X(NS)], x[X(NX)];
    mw_info info;
    for (int k = 0; k < X(NP); k++) p[k] = NAN;
KEYS
    if (X(solve_design)(p, &info)) { printf("open: %s\n", X(status_text)(info.status)); return 2; }
    const int guard = X(setup)(p, s);
    if (guard) { printf("guard: %s\n", X(guard_texts)[guard - 1]); return 2; }
    if (X(solve)(s, PHI, x, NULL) < 0) return 1;
    printf("%a\n", x[X(U_transmission_error)]);
    return 0;
}
"""

DESIGNS = (
    "plain-zk", "spherical-table-4-4-concave", "crossed-helical-17-23", "spur-profile-shift", "bevel-crowned-both",
    "bevel-hypoid-formate", "bevel-face-hobbed", "face-worm-conical-convex",
)  # fmt: skip


def assignments(drive, header):
    """Statements that set what the design file says, in the macros of the header."""
    given = drive.design.given()
    tables = {name: entries for name, entries in given.items() if isinstance(entries, dict)}
    for table, entries in (tables | {"flank": {"flank": given["flank"]}}).items():
        for key, value in entries.items():
            name = f"{table}_{key}" if f"_P_{table}_{key} " in header else key
            if f"_P_{name} " not in header:
                continue  # a word that chose this header
            place = f"X(P_{name})"
            if isinstance(value, str):
                yield f"    p[{place}] = X(W_{name}_{value.replace('-', '_')});"
            else:
                yield f"    p[{place}] = {float(value)!r} * X(parameter_names)[{place}].factor;"


@pytest.mark.parametrize("name", DESIGNS[:1] + tuple(pytest.param(n, marks=pytest.mark.validate) for n in DESIGNS[1:]))
def test_a_design_of_keys_is_completed_and_solved_by_its_header(tmp_path, name):
    drive = Drive.load(name)
    angle = float(drive.about_the_middle([0.03])[0])
    described = drive.design.description["name"]
    header = (c.GENERATED / f"{described}.h").read_text(encoding="utf-8")
    program = PROGRAM.replace("DRIVE", described).replace("PHI", angle.hex())
    source = tmp_path / "design.c"
    source.write_text(program.replace("KEYS", "\n".join(assignments(drive, header))), encoding="utf-8")
    command = sorted(c.compilers().items())[-1][1][0]
    options = ("-std=c99", "-O1", *c.STRICT, *c.EXACT, f"-I{c.GENERATED}")
    c.run(*command, *options, source, "-o", tmp_path / "design", "-lm")
    done = subprocess.run([tmp_path / "design"], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout
    sign = drive.design.mirror.sign
    solved, _ = drive.trace([angle])
    found, contact = float.fromhex(done.stdout), drive.tca([sign * angle])
    assert found == solved[0, drive.design.description["error"]]
    if contact.status == ("converged",):  # the point of a line is nobody's
        assert found == sign * contact.error[0]
