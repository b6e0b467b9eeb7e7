"""Every generated model fits the runtime's fixed sizes and carries what the runtime needs."""

import re
import subprocess

import numpy as np
import pytest

from derive.emit.metadata import ABI as GENERATED_FOR
from meshwright import Drive
from meshwright.base import library as loading
from meshwright.base.compile import compiler
from meshwright.base.errors import LibraryError
from meshwright.base.library import SHIPPED, ffi, library, model, pointer, text
from meshwright.contact import analysis
from meshwright.design import description as metadata

HEADER = (SHIPPED / "include" / "mw_status.h").read_text(encoding="utf-8")

#: The drives that the package ships, with or without a packaged design.
BUILT = [name for name in metadata.drives() if (SHIPPED / f"{name}.json").exists()]

#: Name → value of the largest sizes that the runtime has room for.
MOST = {name: int(value) for name, value in re.findall(r"MW_MAX_(\w+) = (\d+)", HEADER)}


@pytest.mark.parametrize("name", BUILT)
def test_a_model_fits_the_runtime(name):
    m = model(name)
    assert m.abi == library().mw_abi()
    assert m.nx <= MOST["UNKNOWNS"]
    assert m.nstart <= MOST["UNKNOWNS"]
    assert m.no <= MOST["OBSERVATION"]
    assert m.np <= MOST["PARAMETERS"]
    assert m.nanchor <= MOST["ANCHOR"]
    assert all(m.systems[k].n <= MOST["UNKNOWNS"] for k in range(m.nsystems))
    assert text(m.hash) == metadata.described(name)["specification_hash"]


def test_python_and_c_refuse_the_same_angles():
    assert MOST["TURN"] == analysis.largest_angle()


def test_the_core_library_knows_no_drive():
    assert library().mw_model_count() == 0
    assert text(model(BUILT[0]).drive) == BUILT[0]


@pytest.mark.parametrize("name", BUILT)
def test_newton_comes_from_the_start_of_a_self_test_to_its_solution(name):
    m, test = model(name), metadata.described(name)["self_test"]
    p, x, solution = (np.array([float.fromhex(v) for v in test[key]]) for key in ("p", "x_start", "x"))
    s = np.empty(m.ns)
    assert m.setup(pointer(p), pointer(s)) == 0
    m.set_phi(pointer(s), float.fromhex(test["phi"]))
    sizes = [m.step(pointer(s), pointer(x)) for _ in range(8)]
    assert sizes[0] > 0.01
    assert np.abs(x - solution).max() < 1e-11 * max(1.0, np.abs(solution).max())


@pytest.mark.parametrize("name", BUILT)
def test_close_to_an_anchor_the_residual_is_that_of_eval(name):
    m, test = model(name), metadata.described(name)["self_test"]
    p, x = (np.array([float.fromhex(v) for v in test[key]]) for key in ("p", "x"))
    phi, rng = float.fromhex(test["phi"]), np.random.default_rng(3)
    s, at, scale, close, there = np.empty(m.ns), np.empty(m.nanchor), np.empty(m.nx), np.empty(m.nx), np.empty(m.nx)
    m.setup(pointer(p), pointer(s))
    m.set_phi(pointer(s), phi)
    m.scale(pointer(s), pointer(scale))
    m.anchor(pointer(s), phi, pointer(x), pointer(at))
    for size in (0.0, 1e-9, 1e-6, 1e-4, 3e-4):
        change = size * rng.uniform(-1.0, 1.0, m.nx + 1)
        moved = x + change[1:] * scale
        assert m.by_anchor(pointer(s), pointer(at), phi + change[0], pointer(moved), pointer(close)) <= m.nearest
        m.set_phi(pointer(s), phi + change[0])
        m.eval(pointer(s), pointer(moved), pointer(there), ffi.NULL)
        assert close == pytest.approx(there, abs=3e-13)
    assert not m.by_anchor(pointer(s), pointer(at), phi + 1.0, pointer(x + scale), pointer(close)) <= m.nearest
    assert not m.by_anchor(pointer(s), pointer(at), phi, pointer(x * np.nan), pointer(close)) <= m.nearest


def test_the_version_of_the_table_is_one_everywhere():
    assert library().mw_abi() == loading.ABI == GENERATED_FOR
    assert {metadata.described(name)["abi"] for name in BUILT} == {loading.ABI}


OLD = """
#include <stddef.h>
static const struct {{ int abi; const char *drive; double rest[200]; }} table = {{ {abi}, "old_drive", {{ 0.0 }} }};
const void *mw_drive_old_drive(void);
const void *mw_drive_old_drive(void) {{ return &table; }}
"""


@pytest.mark.parametrize("abi", [1, loading.ABI + 1])
def test_an_object_of_another_version_is_refused_with_a_message(tmp_path, monkeypatch, abi):
    """As an object that was compiled before the table changed: its first number is all that may be read of it."""
    (tmp_path / "old.c").write_text(OLD.format(abi=abi), encoding="utf-8")
    subprocess.run([*compiler(), "-shared", "-fPIC", tmp_path / "old.c", "-o", tmp_path / "old_drive.so"], check=True)
    monkeypatch.setattr(loading, "object_of", lambda name, places: tmp_path / f"{name}.so")
    refused = f"old_drive.so has ABI {abi}, this package needs ABI {loading.ABI}: build it again"
    with pytest.raises(LibraryError, match=refused):
        model("old_drive")


def test_headers_of_two_versions_do_not_compile_together(tmp_path):
    """Both hold the table's declaration under one guard: the second would be read as the first says."""
    (tmp_path / "two.c").write_text(
        f'#define MW_MODEL_ABI 1\n#include "{SHIPPED / "include" / BUILT[0]}.h"\n', encoding="utf-8"
    )
    done = subprocess.run([*compiler(), "-fsyntax-only", tmp_path / "two.c"], capture_output=True, text=True)
    assert done.returncode and "different versions of meshwright" in done.stderr


def test_no_angle_flag_or_table_leads_a_call_astray():
    """Infinite angles come to an end; numbers of no flag and tables too large for the solver are refused."""
    drive, lib, info = Drive.load("plain-za"), library(), ffi.new("mw_info *")
    m, state = drive.model, drive.state(0.05)
    x0 = drive.tca([0.05]).solutions[0].copy()
    for begin, end in ((0.05, np.inf), (0.05, -np.inf), (0.05, np.nan), (np.inf, 0.05), (np.nan, 0.05), (0.05, 1e300)):
        x, angle = np.empty((1, m.nx)), np.array([end])
        assert lib.mw_follow(m, pointer(state), begin, pointer(x0), pointer(angle), 1, pointer(x), info) == 0
        assert info.status < 0
    assert {lib.mw_flag(m, k) for k in (-1, -(2**31), 32, 2**31 - 1)} == {ffi.NULL}
    wrong = [("nx", MOST["UNKNOWNS"] + 1), ("nx", -1), ("nanchor", MOST["ANCHOR"] + 1)]
    for field, value in (*wrong, ("abi", m.abi - 1), ("abi", m.abi + 1)):
        other = ffi.new("mw_model *", m[0])
        setattr(other, field, value)
        x = x0.copy()
        assert lib.mw_refine(other, pointer(state), pointer(x), info) == info.status
        assert text(lib.mw_status_word(info.status)) == "bad_input", (field, value)
        assert np.array_equal(x, x0) or np.isnan(x).all()
