"""The worked optimisation of a hypoid pair's machine settings: what it promises, by the C solver alone."""

import runpy
from dataclasses import astuple

import numpy as np
import pytest

from meshwright import Drive
from meshwright.contact.results import ARCSEC
from tests.conftest import ROOT

#: The example's own targets, and others on the other side of the design at hand.
WANTED = [(5.5, 40.0, 8.0), pytest.param((7.0, 60.0, 20.0), marks=pytest.mark.validate)]


@pytest.fixture(scope="module")
def example():
    return runpy.run_path(str(ROOT / "runtime" / "examples" / "optimise_hypoid.py"))


@pytest.fixture(scope="module")
def drive():
    return Drive.load("bevel-hypoid")


def over_one_pitch(example, drive, settings):
    """Contact at begin, middle and end of a pitch."""
    return example["with_settings"](drive, settings).tca([example["_angle"](drive, k) for k in (-0.5, 0.0, 0.5)])


@pytest.mark.parametrize("wanted", WANTED)
def test_the_c_solver_finds_the_pattern_that_was_wanted(example, drive, wanted):
    best = example["optimised"](drive, example["Pattern"](*wanted))
    seen, contact_ratio = example["verified"](drive, best)
    assert best.status == "Solve_Succeeded"
    assert best.iterations < 30
    np.testing.assert_allclose(astuple(seen), wanted, rtol=1e-6)
    assert contact_ratio > 1.0
    middle = over_one_pitch(example, drive, best.settings)
    assert middle.status == ("converged",) * 3
    assert middle.flags[1] == ()


def test_printed_sensitivities_are_differences_of_the_c_solver(example, drive):
    best = example["optimised"](drive)

    def pattern(settings):
        found = over_one_pitch(example, drive, settings)
        return np.array([found.semi_axes[1, 0], (found.error[1] - found.error[[0, 2]].mean()) / ARCSEC])

    for key in ("pinion.tilt_deg", "pinion.blank_offset_mm", "pinion.roll_2c"):
        step, column = 1e-4, list(best.settings).index(key)
        above, below = (pattern(best.settings | {key: best.settings[key] + change}) for change in (step, -step))
        np.testing.assert_allclose((above - below) / (2 * step), best.slopes[::2, column], rtol=1e-4)


def test_spiral_angles_differ_by_the_angle_of_the_generatrices(drive):
    """Hypoid: tooth traces coincide where the flanks touch, generatrices of the two pitch cones do not."""
    found = drive.tca([drive.design.reference_angle])
    axes = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])  # pinion, gear, at a shaft angle of 90 degrees
    feet = np.array([[0.0, drive.design.value("offset_mm"), 0.0], [0.0, 0.0, 0.0]])
    generatrices, spirals = [], []
    for axis, foot, table in zip(axes, feet, ("pinion", "gear"), strict=True):
        cone, arm = drive.design.value("pitch_angle_deg", table), found.points[0] - foot
        out = arm - (arm @ axis) * axis
        out /= np.linalg.norm(out)
        generatrices.append(np.cos(cone) * axis + np.sin(cone) * out)
        around = np.cross(axis, out)
        spirals.append(np.degrees(np.arctan(abs(found.normals[0] @ generatrices[-1] / (found.normals[0] @ around)))))
    between = np.degrees(np.arccos(generatrices[0] @ generatrices[1]))
    assert spirals[1] == pytest.approx(32.0, abs=1.5)  # for which the gear's cutter was placed, on its root plane
    assert between > 15.0
    assert spirals[0] - spirals[1] == pytest.approx(between, abs=1.5)  # the cones touch in the pitch point only
