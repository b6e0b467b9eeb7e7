"""The solver: tests that need it are skipped, and say so, where it cannot be had."""

import pytest

from meshwright.fe.solver import INSTALL_HINT, find_ccx


@pytest.fixture(scope="session")
def ccx():
    found = find_ccx()
    if found is None:
        pytest.skip(f"finite-element part not run: {INSTALL_HINT}")
    return found
