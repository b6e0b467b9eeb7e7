"""The worked optimisation: what it promises, by the C solver alone."""

import runpy

import numpy as np
import pytest

from meshwright import Drive
from meshwright.contact.results import ARCSEC
from tests.conftest import ROOT


@pytest.fixture(scope="module")
def example():
    return runpy.run_path(str(ROOT / "runtime" / "examples" / "optimise_recess_action.py"))


@pytest.fixture(scope="module")
def drive():
    return Drive.load("recess-action-full")


@pytest.fixture(scope="module")
def best(example, drive):
    return example["optimised"](drive)


def test_the_packaged_hob_loses_contact_in_a_corner(example, drive):
    corner = {"center_distance_mm": 0.1, "horizontal_deg": -0.05, "vertical_deg": -0.05}
    assert corner in example["CORNERS"]
    assert "converged" not in drive.with_(misalignment=corner).tca(example["ANGLES"]).status


def test_optimum_is_found_and_agrees_with_the_c_solver(example, drive, best):
    seen = example["verified"](drive, best.design)
    assert best.status == "Solve_Succeeded"
    assert best.iterations < 40
    assert seen.semi_major == pytest.approx(example["SEMI_MAJOR_MM"], abs=1e-6)
    assert seen.largest_error <= example["LARGEST_ERROR"]
    assert seen.largest_error == pytest.approx(best.largest_error, abs=1e-6 * ARCSEC)
    assert not seen.flags


def test_no_other_shift_with_the_same_ellipse_has_a_smaller_error(example, drive, best):
    hob, shift = best.design.values()
    for other in (3.0, 3.5, 4.0):
        radius = _hob_of_same_ellipse(example, drive, hob, other)
        seen = example["verified"](drive, dict(zip(best.design, (radius, other), strict=True)))
        assert seen.semi_major == pytest.approx(example["SEMI_MAJOR_MM"], abs=1e-5)
        assert seen.largest_error > best.largest_error


def _hob_of_same_ellipse(example, drive, hob, shift):
    """By the secant method on the C solver's semi-major axis, traced along the example's angles."""
    row = int(np.argmin(np.abs(example["ANGLES"] - example["ELLIPSE_AT"])))

    def excess(radius):
        here = drive.with_(design={"hob_pitch_radius_mm": radius, "pitch_line_shift_mm": shift})
        return here.tca(example["ANGLES"]).semi_axes[row, 0] - example["SEMI_MAJOR_MM"]

    a, b = hob, hob + 0.01
    for _ in range(4):
        fa, fb = excess(a), excess(b)
        if abs(fb) < 1e-9:
            break
        a, b = b, b - fb * (b - a) / (fb - fa)
    return b


def test_the_report_names_the_active_constraints(best):
    assert best.active == (
        "ellipse",
        "error at center_distance_mm +0.1, horizontal_deg -0.05, vertical_deg -0.05",
        "design.pitch_line_shift_mm",
    )
