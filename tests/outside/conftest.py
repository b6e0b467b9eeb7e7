"""Derivations that tests of several files share."""

import pytest

from tests.outside.folder import derived


@pytest.fixture(scope="session")
def derivation(tmp_path_factory):
    """The folder of a file of ``drives/`` by its name, derived once in a process."""
    folders = {}

    def of(name):
        if name not in folders:
            folders[name] = derived(name, tmp_path_factory.mktemp(name))
        return folders[name]

    return of
