"""The examples do what they say, by themselves and against the library."""

import os
import re
import shutil
import subprocess
import sys
import tarfile
from pathlib import Path

import pytest

from meshwright import Drive
from meshwright.base.compile import PARTS
from meshwright.base.library import ABI, SHIPPED
from meshwright.cli import main
from meshwright.contact.results import ARCSEC
from tests.embedding import compile as c
from tests.quick import quick

EXAMPLES = c.ROOT / "runtime" / "examples"


@pytest.fixture(scope="module")
def error():
    """Transmission error that the examples compute, arcsec."""
    result = Drive.load("recess-action-full").tca([7.0])
    return f"{result.error[0] / ARCSEC:.6f}"


@pytest.mark.parametrize("standard", quick(["c99", "c++11"], "c++11"))
def test_a_program_with_one_copied_header(tmp_path, error, standard):
    shutil.copy(c.GENERATED / "cylindrical_worm_zn_zn.h", tmp_path)
    source = tmp_path / ("contact.c" if standard == "c99" else "contact.cpp")
    shutil.copy(EXAMPLES / "contact.c", source)
    command = sorted(c.compilers().items())[-1][1][standard == "c++11"]
    c.run(*command, f"-std={standard}", "-O2", *c.STRICT, *c.EXACT, source, "-o", tmp_path / "contact", "-lm")
    assert error in c.run(tmp_path / "contact")


@pytest.mark.parametrize("standard", quick(["c99", "c++11"], "c99"))
def test_a_proof_with_two_copied_headers(tmp_path, error, standard):
    for name in ("cylindrical_worm_zn_zn.h", "cylindrical_worm_zn_zn_certify.h"):
        shutil.copy(c.GENERATED / name, tmp_path)
    source = tmp_path / ("certify.c" if standard == "c99" else "certify.cpp")
    shutil.copy(EXAMPLES / "certify.c", source)
    command = sorted(c.compilers().items())[-1][1][standard == "c++11"]
    c.run(*command, f"-std={standard}", "-O0", *c.STRICT, *c.EXACT, source, "-o", tmp_path / "certify", "-lm")
    said = re.search(r"error (\S+) arcsec within (\S+) arcsec, the only one within (\S+) ", c.run(tmp_path / "certify"))
    assert said[1] == error and 0.0 < float(said[2]) < 1e-8 < float(said[3])


def test_the_library_without_the_python_package(error):
    assert error in c.run(sys.executable, EXAMPLES / "library.py", SHIPPED / "cylindrical_worm_zn_zn.so")


def test_the_library_from_cpp(tmp_path):
    command = sorted(c.compilers().items())[-1][1][1]
    program = tmp_path / "trace"
    c.run(*command, "-std=c++11", *c.STRICT, f"-I{SHIPPED / 'include'}", EXAMPLES / "trace.cpp", "-o", program,
          SHIPPED / "cylindrical_worm_zn_zn.so", f"-L{SHIPPED}", "-lmeshwright", f"-Wl,-rpath,{SHIPPED}")  # fmt: skip
    assert "11 of 11 points solved" in c.run(program)


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """Prefix of a library with one drive, configured, built and installed by CMake."""
    folder = tmp_path_factory.mktemp("installed")
    options = (f"-DCMAKE_INSTALL_PREFIX={folder / 'prefix'}", "-DMESHWRIGHT_DRIVES=cylindrical_worm_zn_zn")
    c.run(c.tool("cmake"), "-S", c.RUNTIME, "-B", folder / "library", *options)
    c.run(c.tool("cmake"), "--build", folder / "library", "-j2")
    c.run(c.tool("cmake"), "--install", folder / "library")
    return folder / "prefix"


@pytest.mark.validate
def test_an_installed_library_is_found_by_cmake(tmp_path, installed):
    c.run(c.tool("cmake"), "-S", EXAMPLES, "-B", tmp_path, f"-DCMAKE_PREFIX_PATH={installed}")
    c.run(c.tool("cmake"), "--build", tmp_path)
    assert "11 of 11 points solved" in c.run(tmp_path / "trace")


@pytest.mark.validate
def test_an_installed_library_is_found_by_pkg_config(tmp_path, installed):
    if not c.tool("pkg-config"):
        pytest.skip("pkg-config is not installed")
    folder = next(installed.rglob("meshwright.pc")).parent
    found = c.run(c.tool("pkg-config"), "--cflags", "--libs", "meshwright", env={"PKG_CONFIG_PATH": str(folder)})
    command = sorted(c.compilers().items())[-1][1][1]
    c.run(*command, "-std=c++11", EXAMPLES / "trace.cpp", "-o", tmp_path / "trace", *found.split())
    assert "11 of 11 points solved" in c.run(tmp_path / "trace")


@pytest.mark.validate
def test_a_library_with_chosen_drives_holds_no_other(tmp_path, installed):
    source = tmp_path / "count.c"
    main = 'int main(void) { return mw_model_count() * 10 + !mw_find("face_worm"); }'
    source.write_text(f'#include "meshwright.h"\n{main}\n')
    command = sorted(c.compilers().items())[-1][1][0]
    archive = next(installed.rglob("libmeshwright.a"))
    c.run(*command, f"-I{installed / 'include' / 'meshwright'}", source, archive, "-lm", "-o", tmp_path / "count")
    assert subprocess.run([tmp_path / "count"]).returncode == 11


@pytest.mark.validate
def test_headers_of_chosen_drives_alone_are_installed(installed):
    headers = {path.name for path in installed.rglob("*.h")}
    assert "cylindrical_worm_zn_zn.h" in headers and "meshwright.h" in headers
    assert not {name for name in headers if name.startswith(("face_worm", "spherical", "bevel"))}


@pytest.mark.parametrize(
    ("libraries", "prefix"),
    [("lib", "${pcfiledir}/../../"), ("lib/x86_64-linux-gnu", "${pcfiledir}/../../../"), ("/opt/lib", "/usr/mw")],
)
def test_pkg_config_finds_the_prefix_however_deep_the_libraries_lie(tmp_path, libraries, prefix):
    places = ("-DCMAKE_INSTALL_PREFIX=/usr/mw", f"-DCMAKE_INSTALL_LIBDIR={libraries}")
    c.run(c.tool("cmake"), "-S", c.RUNTIME, "-B", tmp_path, "-DMESHWRIGHT_DRIVES=cylindrical_worm_zn_zn", *places)
    said = dict(line.split("=") for line in (tmp_path / "meshwright.pc").read_text().splitlines() if "=" in line)
    assert said["prefix"] == prefix
    assert said["libdir"] == (libraries if libraries.startswith("/") else f"${{prefix}}/{libraries}")


def test_a_project_that_holds_the_library_names_it_as_an_installed_one(tmp_path):
    (tmp_path / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.18)\nproject(host LANGUAGES C)\n"
        "set(MESHWRIGHT_DRIVES cylindrical_worm_zn_zn)\n"
        f"add_subdirectory({c.RUNTIME} meshwright)\n"
        "add_executable(host host.c)\ntarget_link_libraries(host PRIVATE meshwright::meshwright)\n"
    )
    (tmp_path / "host.c").write_text("int main(void) { return 0; }\n")
    c.run(c.tool("cmake"), "-S", tmp_path, "-B", tmp_path / "build")


def test_a_drive_that_does_not_exist_is_named_by_cmake(tmp_path):
    command = [c.tool("cmake"), "-S", c.RUNTIME, "-B", tmp_path, "-DMESHWRIGHT_DRIVES=face_worms"]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode != 0
    assert "there is no drive face_worms" in done.stderr


@pytest.fixture(scope="module")
def wheeled(tmp_path_factory):
    """Runs a module of the wheel, unpacked, as Python would outside the checkout: what it prints."""
    folder = tmp_path_factory.mktemp("wheel")
    built = ("--no-build-isolation", "--config-settings", "libraries=built")
    c.run(sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", *built, "--wheel-dir", folder, c.ROOT)
    (wheel,) = folder.glob("*.whl")
    assert "-py3-none-" in wheel.name
    c.run(sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--target", folder / "site", wheel)
    environment = {**os.environ, "PYTHONPATH": str(folder / "site"), "MESHWRIGHT_CACHE": str(folder / "cache")}

    def run(*command):
        return c.run(sys.executable, *command, env=environment, cwd=folder)

    place = run("-c", "import derive, meshwright; print(derive.__file__, meshwright.__file__)")
    assert place.count(str(folder / "site")) == 2
    return run


def test_the_wheel_holds_library_metadata_and_headers(wheeled):
    assert "converged" in wheeled("-m", "meshwright", "tca", "recess-action-full", "--phi-deg", "400")


@pytest.mark.validate
def test_drives_are_derived_from_the_wheel(wheeled, tmp_path):
    """A drive of one's own, and a combination of tools that no packaged design uses when a command asks for it."""
    own = c.ROOT / "tests" / "outside" / "drives" / "crossed_helicoids.py"
    wheeled("-m", "derive", own, "--into", tmp_path)
    assert (tmp_path / "crossed_helicoids.so").exists()
    mixed = ("tca", "recess-action-full", "--set", "design.hob_profile=ZI", "--phi-deg", "400")
    assert wheeled("-m", "meshwright", *mixed) == c.run(sys.executable, "-m", "meshwright", *mixed)


@pytest.mark.validate
def test_from_the_wheel_to_a_report_of_a_drive_of_ones_own_takes_half_a_minute(tmp_path):
    """Two commands in an empty folder, of a fresh environment; time of the processor, whatever else it has to do."""
    built = ("--no-build-isolation", "--config-settings", "libraries=built")
    c.run(sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", *built, "--wheel-dir", tmp_path, c.ROOT)
    (wheel,) = tmp_path.glob("*.whl")
    c.run(sys.executable, "-m", "venv", tmp_path / "venv")
    folder, programs = tmp_path / "empty", tmp_path / "venv" / "bin"
    folder.mkdir()
    begun = os.times()
    c.run(programs / "pip", "install", "--quiet", f"{wheel}[plot]", cwd=folder)
    meshwright = programs / "meshwright"
    c.run(meshwright, "new", "cylindrical-worm", "--m", "4", "--z", "2:40", "--out", "pair.toml", cwd=folder)
    c.run(meshwright, "report", "pair.toml", "--html", "report.html", cwd=folder)
    taken = os.times()
    assert "new TeethView(" in (folder / "report.html").read_text(encoding="utf-8")
    assert taken.children_user + taken.children_system - begun.children_user - begun.children_system < 30.0


@pytest.mark.validate
def test_the_source_archive_holds_all_that_a_wheel_is_built_from(tmp_path):
    """Every tracked file of the folders that count; a compiler finds in it all that core and drives are made of."""
    c.run(sys.executable, "-m", "build", "--sdist", "--no-isolation", "--outdir", tmp_path, c.ROOT)
    (archive,) = tmp_path.glob("*.tar.gz")
    with tarfile.open(archive) as packed:
        packed.extractall(tmp_path, filter="data")
    (unpacked,) = (path for path in tmp_path.iterdir() if path.is_dir())
    tracked = c.run("git", "ls-files", "Makefile", "LICENSE", "derive", "generated", "runtime", "tests", cwd=c.ROOT)
    assert [name for name in tracked.splitlines() if not (unpacked / name).exists()] == []
    assert not (c.ROOT / "MANIFEST.in").exists()
    program = Path("runtime", "meshwright", "base", "compile.py")
    built, objects = tmp_path / "built", tmp_path / "objects"
    compiler = " ".join((*sorted(c.compilers().items())[-1][1][0], "-fsyntax-only"))
    c.run(sys.executable, program, "generated", built, "spherical_convex_spur", "--objects", objects, "--whole",
          cwd=unpacked, env=os.environ | {"CC": compiler})  # fmt: skip
    assert all((built / f"spherical_convex_spur{part.ending}.so").exists() for part in PARTS)


def test_a_library_of_another_abi_is_refused_with_the_remedy(tmp_path):
    """By the package, exit status 2, and by a program that loads the library itself."""
    shutil.copytree(SHIPPED / "include", tmp_path / "include")
    source, library = tmp_path / "old.c", tmp_path / "libmeshwright.so"
    source.write_text("int mw_abi(void);\nint mw_abi(void) { return " + str(ABI + 1) + "; }\n")
    c.run(*sorted(c.compilers().items())[-1][1][0], "-shared", "-fPIC", source, "-o", library)
    code = (
        "import pathlib, sys; from meshwright.base import library; from meshwright.cli import main\n"
        "library.SHIPPED = pathlib.Path(sys.argv[1]); sys.exit(main(sys.argv[2:]))"
    )
    arguments = ["tca", "recess-action-full", "--phi-deg", "0"]
    done = subprocess.run([sys.executable, "-c", code, tmp_path, *arguments], capture_output=True, text=True)
    assert done.returncode == 2
    assert f"{library} has ABI {ABI + 1}, this package needs ABI {ABI}: run `make build` again" in done.stderr
    done = subprocess.run([sys.executable, EXAMPLES / "library.py", library], capture_output=True, text=True)
    assert done.returncode == 1
    assert f"has ABI {ABI + 1}, this program needs ABI {ABI}" in done.stderr


@pytest.mark.validate
def test_javascript_finds_the_backlash_of_theory(tmp_path):
    """Of the helical gears: 1.0082373729 arcseconds at the least."""
    if not c.tool("node"):
        pytest.skip("node is not installed")
    assert main(["export", "helical-crowned", "--npm", str(tmp_path / "helical")]) == 0
    found = c.run(c.tool("node"), EXAMPLES / "backlash.mjs", tmp_path / "helical", "23")
    assert float(found) == pytest.approx(1.0082373729, abs=2e-9)


@pytest.mark.validate
def test_a_program_in_rust_follows_a_drive_a_million_radians_on(tmp_path):
    if not c.tool("cargo"):
        pytest.skip("cargo is not installed")
    shutil.copytree(EXAMPLES / "rust", tmp_path / "rust")
    assert main(["export", "helical-crowned", "--crate", str(tmp_path / "helical")]) == 0
    found = c.run(c.tool("cargo"), "run", "--quiet", "--offline", cwd=tmp_path / "rust").split()
    assert int(float(found[0])) == 3660564 and float(found[1]) == pytest.approx(-2.2557720634, abs=2e-9)


@pytest.mark.validate
def test_a_simulation_of_ones_own_takes_a_component(tmp_path):
    """Errors of theory, and a torque of K δ at each pair that is pressed, wherever the pinion stands."""
    pytest.importorskip("fmpy", reason="FMPy is not installed: `pip install '.[fmi]'` brings it")
    drive, path = Drive.load("helical-crowned"), tmp_path / "helical.fmu"
    assert main(["export", "helical-crowned", "--fmu", str(path), "--fmi", "2", "--allow-jam"]) == 0
    said = c.run(sys.executable, EXAMPLES / "simulate.py", path, repr(drive.ratio), repr(drive.pitch()))
    rows = [[float(word) for word in line.split()] for line in said.splitlines()[1:]]
    errors = drive.cycle([row[0] for row in rows]).drive.errors / ARCSEC
    assert [row[1] for row in rows] == pytest.approx(errors, abs=1e-6)
    assert all(0.0 < row[2] < 2.0 for row in rows)


@pytest.mark.validate
def test_octave_has_the_error_at_any_angle(tmp_path):
    if not c.tool("octave"):
        pytest.skip("octave is not installed")
    assert main(["export", "helical-crowned", "--table", str(tmp_path / "te.csv")]) == 0
    shutil.copy(EXAMPLES / "error_over_angle.m", tmp_path)
    asked = "printf('%.17g\\n', error_over_angle('te.csv', [0.05 0.15 1e3]))"
    found = [float(word) for word in c.run(c.tool("octave"), "--eval", asked, cwd=tmp_path).split()]
    known = Drive.load("helical-crowned").cycle([0.05, 0.15, 1e3]).drive.errors
    assert found == pytest.approx(known, abs=1e-2 * ARCSEC)
