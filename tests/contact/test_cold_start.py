"""Cold starts: every packaged angle, and random designs in which a dense search finds an interior contact."""

import math

import numpy as np
import pytest

from meshwright import DesignError, Drive
from meshwright.contact.results import ARCSEC
from tests.contact.test_fifty_digits import _random_tables
from tests.independent import gap_search
from tests.quick import quick

#: Published ranges of the worm angle, degrees.
RANGES = {"standard": (-1050, 1430), "semi": (-560, 2080), "full": (20, 2740)}


@pytest.mark.parametrize("proportions", RANGES)
@pytest.mark.parametrize("hob", ["", "-printed-hob"])
def test_every_ten_degrees_of_the_published_range_solves_cold(proportions, hob):
    drive = Drive.load(f"recess-action-{proportions}{hob}")
    begin, end = RANGES[proportions]
    for angle in np.radians(np.arange(begin, end + 1, 10)):
        _, statuses = drive.trace([angle])
        assert statuses == ["converged"]


@pytest.mark.parametrize("designs", quick([60, 400], 60))
def test_ninety_nine_percent_of_interior_contacts_are_found_cold(designs):
    rng = np.random.default_rng(7)
    found = missed = 0
    for _ in range(designs):
        tables = _random_tables(rng)
        phi = float(rng.uniform(-1.0, 1.0)) * 2 * math.pi / tables["design"]["worm_threads"]
        try:
            drive = Drive.from_tables(tables)
        except DesignError:
            continue
        extreme = gap_search.search(drive.design.as_solved(), tables["flank"], phi)
        if not extreme.interior:
            continue
        x, statuses = drive.trace([phi])
        error = x[0, drive.design.description["error"]]
        if statuses == ["converged"] and abs(error - extreme.error) < 1e-4 * ARCSEC:
            found += 1
        else:
            missed += 1
            print(tables, math.degrees(phi), statuses, error / ARCSEC, extreme.error / ARCSEC)
    assert found + missed > designs // 2
    assert missed <= 0.01 * (found + missed)
