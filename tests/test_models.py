"""Every generated model fits the runtime's fixed sizes and carries what the runtime needs."""

import numpy as np
import pytest

from meshwright import metadata
from meshwright._library import library, model, text
from meshwright.analysis import pointer

MAX_UNKNOWNS, MAX_OBSERVATION, MAX_PARAMETERS = 8, 512, 128  # MW_MAX_... of meshwright.h


@pytest.mark.parametrize("name", metadata.drives())
def test_a_model_fits_the_runtime(name):
    m = model(name)
    assert m.abi == library().mw_abi()
    assert m.nx <= MAX_UNKNOWNS
    assert m.nstart <= MAX_UNKNOWNS
    assert m.no <= MAX_OBSERVATION
    assert m.np <= MAX_PARAMETERS
    assert all(m.systems[k].n <= MAX_UNKNOWNS for k in range(m.nsystems))
    assert text(m.hash) == metadata.drives()[name]["specification_hash"]


def test_the_library_and_the_descriptions_list_the_same_drives():
    lib = library()
    assert {text(lib.mw_model_at(k).drive) for k in range(lib.mw_model_count())} == set(metadata.drives())


@pytest.mark.parametrize("name", metadata.drives())
def test_newton_comes_from_the_start_of_a_self_test_to_its_solution(name):
    m, test = model(name), metadata.drives()[name]["self_test"]
    p, x, solution = (np.array([float.fromhex(v) for v in test[key]]) for key in ("p", "x_start", "x"))
    if name == "spherical_spur_spur":  # touches along a line at every angle: its Newton step has no matrix to invert
        assert np.array_equal(x, solution)
        return
    s = np.empty(m.ns)
    assert m.setup(pointer(p), pointer(s)) == 0
    m.set_phi(pointer(s), float.fromhex(test["phi"]))
    sizes = [m.step(pointer(s), pointer(x)) for _ in range(8)]
    assert sizes[0] > 0.01
    assert np.abs(x - solution).max() < 1e-11 * max(1.0, np.abs(solution).max())
