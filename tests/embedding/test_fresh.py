"""A fresh checkout, which holds what git keeps and no build product: what says so, and what makes the rest."""

import os
import shutil
import subprocess
import sys

import pytest

from derive import products
from derive.audit import __main__ as audit
from tests.embedding import compile as c


@pytest.fixture(scope="module")
def fresh(tmp_path_factory):
    """A copy of the files that git holds or would."""
    folder = tmp_path_factory.mktemp("checkout")
    for path in c.run("git", "ls-files", "--cached", "--others", "--exclude-standard", cwd=c.ROOT).splitlines():
        kept = not path.startswith("generated/") or products.kept(path.removeprefix("generated/"))
        if kept and (c.ROOT / path).is_file():
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(c.ROOT / path, folder / path)
    return folder


def tried(*command, **options):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)


def test_pytest_says_once_that_it_is_not_built(fresh):
    done = tried(sys.executable, "-m", "pytest", "tests/derive", "-p", "no:cacheprovider", cwd=fresh)
    assert done.returncode == 2
    said = done.stdout + done.stderr
    assert said.count("make setup build") == 1 and "Traceback" not in said


@pytest.mark.parametrize("command", [["verify"], ["kernel"], ["explain", "recess-action/18"], ["html"]])
def test_the_audit_says_what_makes_its_record(fresh, command, capsys):
    assert audit.main(["--generated", str(fresh / "generated"), *command]) == 2
    assert "is missing: `make build` makes" in capsys.readouterr().err


def test_cmake_says_what_to_run_where_headers_cannot_be_derived(fresh, tmp_path):
    cannot = f"-DMESHWRIGHT_PYTHON={shutil.which('false')}"
    done = tried(c.tool("cmake"), "-S", fresh / "runtime" / "c", "-B", tmp_path, cannot)
    assert done.returncode != 0
    assert "Run `make build` in" in " ".join(done.stderr.split()) and "face_worm" in done.stderr


@pytest.mark.validate
def test_cmake_derives_the_headers_of_the_drives_that_it_builds(fresh, tmp_path):
    folder = shutil.copytree(fresh, tmp_path / "checkout")
    options = ("-DMESHWRIGHT_DRIVES=spherical_convex_spur", f"-DMESHWRIGHT_PYTHON={sys.executable}")
    c.run(c.tool("cmake"), "-S", folder / "runtime" / "c", "-B", tmp_path / "build", *options)
    for path in (products.GENERATED / "c").glob("spherical_convex_spur*.h"):
        assert (folder / "generated" / "c" / path.name).read_bytes() == path.read_bytes()
    assert (folder / "generated" / "manifest.json").read_bytes() == (products.GENERATED / "manifest.json").read_bytes()


def required(folder):
    code = "import build_backend; print(*build_backend.get_requires_for_build_wheel(), sep='\\n')"
    environment = os.environ | {"PYTHONPATH": str(folder / "runtime")}
    return c.run(sys.executable, "-c", code, cwd=folder, env=environment).split()


def test_a_wheel_of_it_asks_for_what_derives_and_one_of_a_built_checkout_for_nothing(fresh):
    assert {"sympy==1.14.0", "casadi==3.8.2"} < set(required(fresh))
    assert bool(required(c.ROOT)) == bool(products.missing())
