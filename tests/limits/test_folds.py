"""A fold ends contact: two branches meet there, and beyond it neither exists."""

import numpy as np
import pytest

from meshwright import Drive
from meshwright.contact.branch import fold_angle
from meshwright.cycle.path import Path


@pytest.mark.parametrize("error", [0.02, -0.02, -0.05, 0.1])
def test_two_contacts_of_a_zk_worm_meet_and_vanish_at_a_fold(error):
    """A centre distance error unfolds the pitchfork of the ZK worm with a ZN-hobbed wheel at right angles."""
    drive = Drive.load("zk-zn-90").with_(misalignment={"center_distance_mm": error})
    start = np.radians(-60.0)
    folds = []
    for solution in drive.contacts(start).solutions:
        path = Path.through(drive, start, solution).extended(start + drive.pitch())
        if path.ended[1]:
            folds.append(fold_angle(path, -1))
    assert len(folds) == 2
    assert folds[0] == pytest.approx(folds[1], abs=1e-9)
    counts = [len(drive.contacts(folds[0] + d).solutions) for d in (-1e-3, 1e-3)]
    assert counts == [3, 1]
