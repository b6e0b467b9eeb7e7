"""The examples do what they say, by themselves and against the library."""

import shutil
import subprocess
import sys

import pytest

from meshwright import Drive
from meshwright._library import SHIPPED
from meshwright.results import ARCSEC
from tests.embedding import compile as c

EXAMPLES = c.ROOT / "runtime" / "examples"


@pytest.fixture(scope="module")
def error():
    """Transmission error that the examples compute, arcsec."""
    result = Drive.load("recess-action-full").tca([7.0])
    return f"{result.error[0] / ARCSEC:.6f}"


@pytest.mark.parametrize("standard", ["c99", "c++11"])
def test_a_program_with_one_copied_header(tmp_path, error, standard):
    shutil.copy(c.GENERATED / "cylindrical_worm_zn_zn.h", tmp_path)
    source = tmp_path / ("contact.c" if standard == "c99" else "contact.cpp")
    shutil.copy(EXAMPLES / "contact.c", source)
    command = sorted(c.compilers().items())[-1][1][standard == "c++11"]
    c.run(*command, f"-std={standard}", "-O2", *c.STRICT, *c.EXACT, source, "-o", tmp_path / "contact", "-lm")
    assert error in c.run(tmp_path / "contact")


def test_the_library_without_the_python_package(error):
    assert error in c.run(sys.executable, EXAMPLES / "library.py", SHIPPED / "libmeshwright.so")


def test_the_library_from_cpp(tmp_path):
    command = sorted(c.compilers().items())[-1][1][1]
    program = tmp_path / "trace"
    c.run(*command, "-std=c++11", *c.STRICT, f"-I{SHIPPED / 'include'}", EXAMPLES / "trace.cpp", "-o", program,
          f"-L{SHIPPED}", "-lmeshwright", f"-Wl,-rpath,{SHIPPED}")  # fmt: skip
    assert "11 of 11 points solved" in c.run(program)


@pytest.mark.slow
def test_an_installed_library_is_found_by_cmake_and_pkg_config(tmp_path):
    if not shutil.which("cmake"):
        pytest.skip("cmake is not installed")
    prefix = tmp_path / "prefix"
    c.run("cmake", "-S", c.RUNTIME, "-B", tmp_path / "library", f"-DCMAKE_INSTALL_PREFIX={prefix}")
    c.run("cmake", "--build", tmp_path / "library", "-j2")
    c.run("cmake", "--install", tmp_path / "library")
    c.run("cmake", "-S", EXAMPLES, "-B", tmp_path / "example", f"-DCMAKE_PREFIX_PATH={prefix}")
    c.run("cmake", "--build", tmp_path / "example")
    assert "11 of 11 points solved" in c.run(tmp_path / "example" / "trace")
    if shutil.which("pkg-config"):
        folder = next(prefix.rglob("meshwright.pc")).parent
        flags = c.run("pkg-config", "--cflags", "--libs", "meshwright", env={"PKG_CONFIG_PATH": str(folder)}).split()
        c.run("g++", EXAMPLES / "trace.cpp", "-o", tmp_path / "trace", *flags)
        assert "11 of 11 points solved" in c.run(tmp_path / "trace")


@pytest.mark.slow
def test_the_wheel_holds_library_metadata_and_headers(tmp_path):
    c.run(sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", tmp_path, c.ROOT)
    c.run(sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "venv")
    python = tmp_path / "venv" / "bin" / "python"
    (wheel,) = tmp_path.glob("*.whl")
    c.run(python, "-m", "pip", "install", "--quiet", "numpy", "cffi", "pydantic", "rich", wheel)
    command = [str(python), "-m", "meshwright.cli", "tca", "recess-action-full", "--phi-deg", "400"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert "converged" in done.stdout
