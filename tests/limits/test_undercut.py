"""Where flanks are undercut of which a drive does not say where to search."""

import numpy as np
import pytest

from meshwright import Drive
from meshwright.flank.blank import with_whole_blank

STEP = 1e-5


def test_a_flank_is_sought_for_undercut_between_its_limits():
    """At what is found differences of points along both parameters are parallel; beside it they are not, and their
    cross product is the other way round on the other side. Nothing lies beyond tip or root.
    """
    drive, *_ = with_whole_blank(Drive.load("bevel-formate"))
    limits = drive.limits()
    assert "undercut" not in limits.omitted and limits.undercut
    for line in limits.undercut:
        flank, q = drive.flank(line.member), np.array([*line.parameters.values()])
        assert all(flank([q]).margins[event][0] > -1e-6 for event in ("tip", "root"))

        def singular(p, flank=flank):
            steps = STEP * np.eye(2)
            first, second = ((flank([p + s]).points[0] - flank([p - s]).points[0]) / (2 * STEP) for s in steps)
            return np.cross(first, second) @ flank([p]).normals[0] / np.linalg.norm(first) / np.linalg.norm(second)

        assert singular(q) == pytest.approx(0.0, abs=1e-6)
        beside = [singular(q + side) for side in ([1e-2, 0.0], [-1e-2, 0.0])]
        assert beside[0] * beside[1] < 0.0
