"""Reports that several tests read, each made once."""

import pytest

from meshwright import Drive
from meshwright.report import analyse, page

DESIGNS = ("recess-action-full", "spherical-table-3-1-concave", "face-worm-conical-convex")


def quiet(_text):
    """Progress that nobody watches."""


@pytest.fixture(scope="session")
def analysed():
    """Analysis of a packaged design by name."""
    made = {}

    def of(name):
        if name not in made:
            made[name] = analyse(Drive.load(name), quiet)
        return made[name]

    return of


@pytest.fixture(scope="session")
def paged(analysed):
    """Page of a packaged design by name."""
    made = {}

    def of(name):
        if name not in made:
            made[name] = page(analysed(name))
        return made[name]

    return of
