"""One library for every processor of a kind: wide instructions only where the processor has been asked, ARM64 too."""

import platform
import re
import shutil

import numpy as np
import pytest

from meshwright.base import compile as build
from meshwright.base.library import SHIPPED
from tests.embedding import compile as c
from tests.embedding.machines import arm64
from tests.embedding.test_headers import ONE_QUICKLY, problem_of

OBJECTS = c.ROOT / ".venv" / "objects"

#: Units whose code is called only after ``__builtin_cpu_supports``.
WIDE = {"lanes_avx2.o": "ymm", "lanes_avx512.o": "zmm"}

_VECTOR = re.compile(r"\t(v[a-z0-9]+)\s.*%[xyz]mm")


@pytest.mark.skipif(platform.machine() != "x86_64" or not shutil.which("objdump"), reason="x86-64 with binutils")
def test_only_the_wide_lanes_hold_instructions_that_not_every_x86_64_has(tmp_path):
    shutil.copytree(SHIPPED / "include", tmp_path / "include")
    build.drives(["spherical_convex_spur"], tmp_path, SHIPPED, tmp_path, parts=(build.IN_LANES,))
    objects = [*OBJECTS.glob("*.o"), *OBJECTS.glob("face_worm/*.o")]
    objects += tmp_path.glob("spherical_convex_spur_in_lanes/*.o")
    assert {path.name for path in objects} >= {*WIDE, "lanes_native.o", "library.o", "sensitivity.o", "drive.o"}
    for path in objects:
        code = c.run("objdump", "-d", "--no-show-raw-insn", path)
        if path.name in WIDE:
            assert f"%{WIDE[path.name]}" in code
        else:
            assert not _VECTOR.search(code), path.name


@pytest.mark.validate
def test_the_library_builds_for_arm64(tmp_path):
    """Core and a drive in one: the wide units are empty there."""
    library = tmp_path / "libmeshwright.so"
    target = ("-target", "aarch64-linux-gnu", "-std=c99", "-O1", "-shared", "-fPIC")
    options = (*c.STRICT, *c.EXACT, f"-I{c.GENERATED}", f"-I{c.RUNTIME}")
    objects = []
    for part in build.PARTS:
        for unit in part.units:
            objects.append(tmp_path / f"{c.Path(unit).stem}{part.ending}.o")
            compiled = (*target[:-2], "-fPIC", *options, "-DMW_DRIVE=face_worm", *part.defines, "-c", c.RUNTIME / unit)
            c.run(*c.CLANG, "cc", *compiled, "-o", objects[-1])
    c.run(*c.CLANG, "cc", *target, *options, *sorted(c.RUNTIME.glob("*.c")), *objects, "-o", library, "-lm")
    content = library.read_bytes()
    assert b"mw_drive_face_worm" in content
    assert content[:4] == b"\x7fELF"
    assert int.from_bytes(content[18:20], "little") == 183  # EM_AARCH64
    assert b"mw_trace_designs" in content
    assert b"mw_lanes_avx2" not in content


LANES = r"""
#define MW_LANES_SIMD
#define MW_LANES 4
#include "DRIVE_lanes.h"
/* All lanes from the same start: Newton as below, by the vector unit. */
int solve(const double *p, double phi, double *s, double *x)
{
    double q[MW_LANES * DRIVE_NP], y[MW_LANES * DRIVE_NX], angle[MW_LANES], size[MW_LANES];
    int steps = 0;
    for (int l = 0; l < MW_LANES; l++) {
        angle[l] = phi;
        for (int k = 0; k < DRIVE_NP; k++) q[MW_LANES * k + l] = p[k];
        for (int k = 0; k < DRIVE_NX; k++) y[MW_LANES * k + l] = x[k];
    }
    MW_LANE_NAME(DRIVE_setup_lanes)(q, s, size);
    MW_LANE_NAME(DRIVE_set_phi_lanes)(s, angle);
    do {
        MW_LANE_NAME(DRIVE_step_lanes)(s, y, size);
        for (int l = 1; l < MW_LANES; l++)
            if (size[0] != size[l]) return -2;
    } while (++steps < 30 && !(size[0] < 1e-13));
    for (int k = 0; k < DRIVE_NX; k++) {
        for (int l = 1; l < MW_LANES; l++)
            if (y[MW_LANES * k] != y[MW_LANES * k + l]) return -3;
        x[k] = y[MW_LANES * k];
    }
    return steps;
}
"""

SCALAR = r"""
#include "DRIVE.h"
/* Newton from the start x; a step that is not a number ends in failure. */
int solve(const double *p, double phi, double *s, double *x)
{
    int steps = 0;
    double size;
    if (DRIVE_setup(p, s)) return -1;
    DRIVE_set_phi(s, phi);
    do size = DRIVE_step(s, x);
    while (++steps < 30 && !(size < 1e-13));
    return size == size ? steps : -2;
}
"""


@pytest.mark.parametrize("drive", ONE_QUICKLY)
def test_lanes_on_an_arm64_processor_give_the_bits_of_its_scalar_kernel(tmp_path, drive):
    pytest.importorskip("unicorn")
    problem, _ = problem_of(drive)
    source = tmp_path / "lanes.c"
    source.write_text(LANES.replace("DRIVE", drive))
    wide = type(problem)(problem.p, problem.phi, problem.x, 4 * problem.state)
    steps, x = arm64(c.freestanding("arm64", drive, tmp_path / "lanes", source, "-fopenmp-simd"), wide)
    source = tmp_path / "scalar.c"
    source.write_text(SCALAR.replace("DRIVE", drive))
    scalar_steps, scalar = arm64(c.freestanding("arm64", drive, tmp_path / "scalar", source), problem)
    assert steps == scalar_steps
    assert np.array_equal(x, scalar)
