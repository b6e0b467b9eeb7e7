"""Python calls that cannot be: wrong shapes, kinds and ranges are refused in words, before any of them reaches C."""

import math

import numpy as np
import pytest

from meshwright import Drive
from meshwright.base.errors import DesignError, UsageError
from meshwright.sensitivity import sensitivity

NO_ANGLES = {
    "a word": "abc", "complex": [1j], "an object": [object()], "ragged": [[1.0], [1.0, 2.0]], "a table": {},
    "two axes": [[0.0, 1.0]], "no number": [math.nan], "nothing": None, "too large": [1e300],
}  # fmt: skip


@pytest.fixture(scope="module")
def drive():
    return Drive.load("plain-zn")


@pytest.mark.parametrize("angles", NO_ANGLES.values(), ids=NO_ANGLES)
def test_angles_are_finite_numbers(drive, angles):
    for analysis in (drive.tca, drive.certify, drive.first_contact, lambda a: sensitivity(drive, a)):
        with pytest.raises(UsageError, match="angles: must be a one-dimensional array of finite numbers"):
            analysis(angles)


@pytest.mark.parametrize("places", [[0.0], [[1.0, 2.0, 3.0]], np.zeros((2, 2, 2)), None, "x", [[1j, 2.0]]])
def test_a_flank_has_as_many_parameters_as_it_has(drive, places):
    flank = drive.flank("wheel")
    slopes, second = flank.limit_slopes, flank.second_derivatives
    for evaluate in (flank, flank.curvature, slopes, second, lambda q: flank.places(None, None, None, q)):
        with pytest.raises(UsageError, match="flank of the wheel has t_hob, psi_fixed_hob; give an array"):
            evaluate(places)


def test_one_place_of_a_flank_needs_no_axis_and_whole_numbers_are_numbers(drive):
    flank = drive.flank("pinion")
    one, many = flank([20, 1]), flank(np.array([[20.0, 1.0], [21.0, 0.0]]).T.copy(order="F").T)
    assert one.points[0] == pytest.approx(many.points[0], abs=0.0)


def test_a_function_has_as_many_arguments_as_it_has(drive):
    with pytest.raises(UsageError, match="undercut_place_wheel: 1 arguments; give t_hob, psi_fixed_hob"):
        drive.function("undercut_place_wheel")(0.0)


@pytest.mark.parametrize("ends", [(1.0, 0.0), (0.0, 0.0), (math.nan, 1.0), (0.0, 1e9), (None, 1.0)])
def test_a_path_leads_from_a_smaller_angle_to_a_larger_one(drive, ends):
    """A path without a piece would hold of nothing, which is no proof."""
    for proof in (drive.certify_path, drive.certify_first_path):
        with pytest.raises(UsageError, match="give the smaller angle first"):
            proof(*ends)


@pytest.mark.parametrize("neighbours", [-1, 1.5, "a"])
def test_neighbours_are_counted(drive, neighbours):
    with pytest.raises(UsageError, match="neighbours = .*whole number"):
        drive.certify_first([0.0], neighbours=neighbours)


@pytest.mark.parametrize("shape", [(3,), None, (2.5, 3), (1, 9), "21x41"])
def test_a_grid_has_two_whole_numbers_of_points(drive, shape):
    with pytest.raises(UsageError, match="needs at least 2 points each way"):
        drive.surface("wheel", shape)


def test_keys_of_a_sensitivity_are_named(drive):
    with pytest.raises(UsageError, match="design.nothing: .*design.pressure_angle_deg"):
        sensitivity(drive, [0.0]).of("design.nothing")


def test_a_key_that_is_taken_away_is_missed_by_its_name(drive):
    with pytest.raises(DesignError, match="neither of normal_module_mm and axial_module_mm is given"):
        drive.with_(design={"normal_module_mm": None})


@pytest.mark.parametrize("design", [None, 3, b"plain-zn"])
def test_what_is_no_design_is_refused(design):
    with pytest.raises(DesignError, match="name a packaged design or a TOML file"):
        Drive.load(design)
    with pytest.raises(DesignError, match="must be tables"):
        Drive.from_tables(design)
