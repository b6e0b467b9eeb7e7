"""A trace stays on its tooth pair, however far apart the angles are."""

import numpy as np
import pytest

from meshwright import Drive


@pytest.mark.parametrize("name", ["recess-action-full", "spherical-table-3-1-concave", "face-worm-conical-convex"])
def test_a_trace_in_whole_pitches_follows_one_pair(name):
    """A pitch away stands the contact of the neighbouring pair, an exact solution with an error of a tooth."""
    drive = Drive.load(name)
    whole = np.arange(-1, 3) * drive.pitch()
    fine = drive.tca(np.linspace(whole[0], whole[-1], 49))
    coarse = drive.tca(whole)
    assert coarse.error == pytest.approx(fine.error[::16], abs=1e-12)
    assert coarse.points == pytest.approx(fine.points[::16], abs=1e-8, nan_ok=True)
