"""Every generated model fits the runtime's fixed sizes and carries what the runtime needs."""

import pytest

from meshwright import metadata
from meshwright._library import library, model, text

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
