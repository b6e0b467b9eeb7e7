"""What tests of several files share: derivations, and of a file whose ``TABLES`` are a design commands and drives."""

import pytest

from meshwright import Drive
from meshwright.design import design as designs
from tests.outside.folder import Commands, derived


@pytest.fixture(scope="session")
def derivation(tmp_path_factory):
    """The folder of a file of ``drives/`` by its name, derived once in a process."""
    folders = {}

    def of(name):
        if name not in folders:
            folders[name] = derived(name, tmp_path_factory.mktemp(name))
        return folders[name]

    return of


@pytest.fixture(scope="module")
def folder(derivation, request):
    """The folder of the drive that a test file is named after."""
    return derivation(request.module.__name__.rpartition("test_")[2])


@pytest.fixture
def run(folder, request, tmp_path):
    """Commands on the design of a test file."""
    path = tmp_path / "design.toml"
    path.write_text(designs.toml_text(request.module.TABLES), encoding="utf-8")
    return Commands(folder, path)


@pytest.fixture
def drive(folder, request):
    """Its drive, with tables changed."""

    def made(**tables):
        return Drive.from_tables(request.module.TABLES | tables, drives=folder)

    return made
