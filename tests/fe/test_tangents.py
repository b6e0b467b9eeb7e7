"""The tangents that every flank of a tooth in contact knows, by which normals of the tangent plane pierce it."""

import numpy as np
import pytest

from meshwright import Drive
from meshwright.fe.profile import Smooth
from meshwright.fe.solids import gear_pair

#: A thread and a generated wheel, threads that are envelopes, gears of one and of two parameters along the tooth.
NAMES = ("recess-action-full", "face-worm-conical-convex", "spherical-table-3-1-concave", "bevel-crowned-both")
STEP = 1e-4


@pytest.mark.parametrize("member", ["pinion", "wheel"])
@pytest.mark.parametrize("name", NAMES)
def test_tangents_are_what_differences_of_fourth_order_tend_to(name, member):
    of = getattr(gear_pair(Drive.load(name)), member)
    form = of.tooth(0.0)
    flank = form.side(of.working).flank
    assert isinstance(flank.surface, Smooth)
    sections = np.linspace(*form.faces, 7)[1:-1]
    profile = 0.5 * (flank.first(sections) + flank.last(sections))
    face = flank.solve(sections, profile[:, None])[:, 0]
    points, tangents = flank.surface.tangents(profile, face)
    assert points == pytest.approx(flank.surface(profile, face)[0], abs=1e-9)
    for k, way in enumerate(np.eye(2)):
        at = [flank.surface(profile + n * STEP * way[0], face + n * STEP * way[1])[0] for n in (-2, -1, 1, 2)]
        slope = (at[0] - 8.0 * at[1] + 8.0 * at[2] - at[3]) / (12.0 * STEP)
        assert np.abs(tangents[:, k] - slope).max() < 1e-6 * max(1.0, np.abs(slope).max())


@pytest.mark.parametrize("name", NAMES)
def test_normals_of_sections_stand_on_the_curves_in_them(name):
    """Of planes, cylinders, cones and half planes: along the curve of a flank in a section nothing moves across it."""
    of = gear_pair(Drive.load(name)).pinion
    form = of.tooth(0.0)
    flank = form.side(of.working).flank
    section = np.array([0.5 * sum(form.faces)])
    ends = flank.first(section), flank.last(section)
    profile = np.linspace(0.4, 0.6, 201)[None, :] * (ends[1] - ends[0]) + ends[0]
    points = flank.points(section, profile)[0]
    across = flank.section.across(points)
    assert np.linalg.norm(across, axis=1) == pytest.approx(1.0, abs=1e-12)
    steps = np.diff(points, axis=0)
    off = np.sum(steps * (0.5 * (across[1:] + across[:-1])), axis=1)
    assert np.abs(off).max() < 1e-4 * np.linalg.norm(steps, axis=1).max()
