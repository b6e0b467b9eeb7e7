"""Generated headers go anywhere: strict C99 and C++11, nothing but sqrt, the same bits on every machine."""

import ctypes
import json
import re
import shutil

import numpy as np
import pytest

from meshwright.base.library import folders, model_in_lanes, object_of
from tests.embedding import compile as c
from tests.embedding.machines import MACHINES, Problem
from tests.quick import quick, some

DRIVES = sorted(json.loads(p.read_text())["name"] for p in c.GENERATED.glob("*.json"))
FAMILIES = ("cylindrical_worm_zn_zn", "spherical_convex_spur", "face_worm")

#: One small drive in the quick tests, the others in the longer ones.
ONE_QUICKLY = [pytest.param(drive, marks=[pytest.mark.validate] * (drive != FAMILIES[1])) for drive in FAMILIES]


def problem_of(drive):
    """The drive's self-test: arguments of ``solve`` and the solution to 40 digits, rounded."""
    described = json.loads((c.GENERATED / f"{drive}.json").read_text(encoding="utf-8"))
    test = described["self_test"]
    p, x = (np.array([float.fromhex(v) for v in test[key]]) for key in ("p", "x_start"))
    solution = np.array([float.fromhex(v) for v in test["x"]])
    return Problem(p, float.fromhex(test["phi"]), x, described["shapes"]["s"][0]), solution


def _native(drive, folder, command, level):
    library = folder / "solve.so"
    defines = (f"-DDRIVE={drive}", f'-DHEADER="{drive}.h"')
    c.run(*command, level, *c.EXACT, "-shared", "-fPIC", *defines, f"-I{c.GENERATED}", c.FREESTANDING / "solve.c",
          "-o", library, "-lm")  # fmt: skip
    solve = ctypes.CDLL(str(library)).solve
    problem, _ = problem_of(drive)
    s, x = np.empty(problem.state), problem.x.copy()
    pointers = [a.ctypes.data_as(ctypes.c_void_p) for a in (problem.p, s, x)]
    steps = solve(pointers[0], ctypes.c_double(problem.phi), *pointers[1:])
    return steps, x


@pytest.mark.parametrize("drive", ONE_QUICKLY)
@pytest.mark.parametrize("standard", quick(["c99", "c++11"], "c++11"))
@pytest.mark.parametrize("name", sorted(c.compilers()))
def test_a_header_alone_compiles_strictly_and_needs_only_sqrt(tmp_path, drive, standard, name):
    command = c.compilers()[name][standard == "c++11"]
    output = c.strict_object(command, f"{drive}.h", tmp_path, standard)
    assert c.undefined(output) <= {"sqrt", "_GLOBAL_OFFSET_TABLE_"}
    assert not c.writable(output)


@pytest.mark.parametrize("standard", quick(["c99", "c++11"], "c99"))
def test_every_header_alone_is_strictly_standard(tmp_path, standard):
    """Each in a translation unit of its own, checked but not compiled."""
    units = []
    for drive in DRIVES:
        units.append(tmp_path / f"{drive}.{'c' if standard == 'c99' else 'cpp'}")
        before = "" if standard == "c99" else 'extern "C" '
        declared = f"{before}const mw_model *model(void);\n"
        text = f'#include "{drive}.h"\n{declared}const mw_model *model(void) {{ return &{drive}_model; }}\n'
        units[-1].write_text(text)
    command = sorted(c.compilers().items())[-1][1][standard == "c++11"]
    checked = ("-fsyntax-only", "-Wno-unused-command-line-argument")
    c.run(*command, f"-std={standard}", *c.STRICT, *c.EXACT, f"-I{c.GENERATED}", *checked, *units)


@pytest.mark.parametrize("drive", FAMILIES)
def test_the_lanes_of_a_drive_need_nothing(drive):
    """The object of all instruction sets asks for no symbol but the square root; weak ones are the start-up code's."""
    model_in_lanes(drive)
    symbols = [line.split() for line in c.run("nm", "-u", object_of(drive, folders(), "_in_lanes")).splitlines()]
    assert {name for kind, name in symbols if kind != "w"} <= {"sqrt"}


#: Options under which a compiler might fuse, and whether the header is asked to.
CONTRACTION = {"separate": (), "native": ("-march=native",), "fused": ("-DMW_FUSED", "-march=native")}


@pytest.mark.validate
@pytest.mark.parametrize("fused", [False, True])
@pytest.mark.parametrize("levels", [("-O3",), ("-O0", "-O1", "-O2")])
@pytest.mark.parametrize("drive", some(FAMILIES, FAMILIES[1]))
def test_every_compiler_level_and_machine_gives_the_same_bits(tmp_path, drive, levels, fused):
    """A contact from nothing: with this machine's instructions too, products are fused where the header says."""
    problem, solution = problem_of(drive)
    results = {}
    for name, (command, _) in c.compilers().items():
        for level in levels:
            for way in ("fused",) if fused else ("separate", "native"):
                folder = tmp_path / f"{name}{level}{way}"
                folder.mkdir()
                results[name, level, way] = _native(drive, folder, (*command, *CONTRACTION[way]), level)
    for machine, solve in MACHINES.items():
        if fused and machine == "wasm":
            continue  # it has no fused product
        pytest.importorskip("wasmtime" if machine == "wasm" else "unicorn")
        options = ("-DMW_FUSED", "-Dfma=__builtin_fma") if fused else ()
        program = c.freestanding(machine, drive, tmp_path / machine, c.FREESTANDING / "solve.c", *options)
        results[machine] = solve(program, problem)
    steps, first = next(iter(results.values()))
    assert steps > 0
    for where, (count, x) in results.items():
        assert count == steps, where
        assert x.tobytes() == first.tobytes(), where
    assert np.abs(first - solution).max() < 1e-11 * max(1.0, np.abs(solution).max())


def _assembly(machine, folder, source, *defines):
    """Lines that clang makes of a source without a C library: where errno is kept, and where it is not."""
    target = () if machine == "native" else c.TARGETS[machine][: 3 if machine == "cortex-m7" else 2]
    for errno in ("-fmath-errno", "-fno-math-errno"):
        output = folder / f"{errno}.s"
        options = ("-ffp-contract=off", "-ffreestanding", "-O2", "-g0", errno, f"-I{c.FREESTANDING}")
        c.run(*c.CLANG, "cc", *target, *options, *defines, "-S", source, "-o", output)
        yield output.read_text(encoding="latin-1").splitlines()


@pytest.mark.parametrize("machine", ["native", *sorted(MACHINES)])
def test_without_a_c_library_a_square_root_is_an_instruction(tmp_path, machine):
    """One that calls itself is an endless loop, which clang deletes with all that asks for it."""
    text = "#include <math.h>\ndouble root(double a);\ndouble root(double a) { return sqrt(a); }"
    (tmp_path / "root.c").write_text(text)
    kept, dropped = _assembly(machine, tmp_path, tmp_path / "root.c")
    assert kept == dropped
    assert any("sqrt" in line and not re.search(r"call|\bbl?\b", line) for line in kept)


@pytest.mark.validate
@pytest.mark.parametrize("machine", ["native", *sorted(MACHINES)])
def test_without_a_c_library_clang_keeps_the_whole_solver(tmp_path, machine):
    drive = (f"-I{c.GENERATED}", "-DDRIVE=spherical_convex_spur", '-DHEADER="spherical_convex_spur.h"')
    kept, dropped = _assembly(machine, tmp_path, c.FREESTANDING / "solve.c", *drive)
    assert len(kept) == len(dropped) > 5_000


@pytest.mark.skipif(not shutil.which("gcc"), reason="there is no gcc")
def test_without_a_c_library_gcc_is_told_what_it_needs(tmp_path):
    defines = ("-DDRIVE=face_worm", '-DHEADER="face_worm.h"', f"-I{c.GENERATED}", f"-I{c.FREESTANDING}")
    command = ["gcc", "-fsyntax-only", *defines, c.FREESTANDING / "solve.c"]
    c.run(*command, "-fno-math-errno")
    with pytest.raises(AssertionError, match="compile with -fno-math-errno"):
        c.run(*command)


LANES = r"""
#define MW_LANES_SIMD
#define MW_LANES WIDTH
#include "DRIVE_lanes.h"
void lanes(const double *p, double phi, double *s, double *x, double *z)
{
    double valid[WIDTH], angle[WIDTH];
    for (int l = 0; l < WIDTH; l++) angle[l] = phi * (1.0 + 1e-3 * l);
    MW_LANE_NAME(DRIVE_setup_lanes)(p, s, valid);
    MW_LANE_NAME(DRIVE_set_phi_lanes)(s, angle);
    MW_LANE_NAME(DRIVE_step_lanes)(s, x, z);
}
void scalar(const double *p, double phi, int l, double *s, double *x, double *z)
{
    DRIVE_setup(p, s);
    DRIVE_set_phi(s, phi * (1.0 + 1e-3 * l));
    *z = DRIVE_step(s, x);
}
"""


@pytest.mark.parametrize("drive", ONE_QUICKLY)
@pytest.mark.parametrize("width", quick([2, 4, 8, 16], 4))
@pytest.mark.parametrize("contraction", ["separate", "fused"])
def test_lanes_give_the_bits_of_the_scalar_kernel(tmp_path, drive, width, contraction):
    problem, _ = problem_of(drive)
    source, library = tmp_path / "lanes.c", tmp_path / "lanes.so"
    source.write_text(LANES.replace("WIDTH", str(width)).replace("DRIVE", drive))
    command = sorted(c.compilers().items())[-1][1][0]
    c.run(*command, "-std=c99", "-O3", *c.STRICT, *c.EXACT, "-fopenmp-simd", *CONTRACTION[contraction], "-shared",
          "-fPIC", f"-I{c.GENERATED}", source, "-o", library, "-lm")  # fmt: skip
    loaded = ctypes.CDLL(str(library))
    generator = np.random.default_rng(width)
    starts = problem.x[:, None] + 1e-3 * generator.normal(size=(len(problem.x), width))
    many, s, sizes = starts.copy(), np.empty(problem.state * width), np.empty(width)
    p = np.ascontiguousarray(np.repeat(problem.p[:, None], width, axis=1))
    phi = ctypes.c_double(problem.phi)
    loaded.lanes(_address(p), phi, _address(s), _address(many), _address(sizes))
    for lane in range(width):
        x, size = np.ascontiguousarray(starts[:, lane]), np.empty(1)
        loaded.scalar(_address(problem.p), phi, lane, _address(s), _address(x), _address(size))
        assert x.tobytes() == np.ascontiguousarray(many[:, lane]).tobytes()
        assert size[0] == sizes[lane]


@pytest.mark.validate
@pytest.mark.parametrize("drive", ONE_QUICKLY)
def test_fusing_changes_no_more_than_round_off(tmp_path, drive):
    _, solution = problem_of(drive)
    command = sorted(c.compilers().items())[-1][1][0]
    found = {}
    for name in ("separate", "fused"):
        options = CONTRACTION[name]
        (tmp_path / name).mkdir()
        _, found[name] = _native(drive, tmp_path / name, (*command, *options), "-O3")
        assert np.abs(found[name] - solution).max() < 1e-11 * max(1.0, np.abs(solution).max())
    assert found["separate"].tobytes() != found["fused"].tobytes()


def _address(array):
    return array.ctypes.data_as(ctypes.c_void_p)
