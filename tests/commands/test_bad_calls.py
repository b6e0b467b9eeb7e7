"""Python calls that cannot be: wrong shapes, kinds and ranges are refused in words, before any of them reaches C."""

import math
from fractions import Fraction

import numpy as np
import pytest

from meshwright import Drive
from meshwright.base.errors import DesignError, UsageError
from meshwright.sensitivity import sensitivity

NO_ANGLES = {
    "a word": "abc", "complex": [1j], "an object": [object()], "ragged": [[1.0], [1.0, 2.0]], "a table": {},
    "two axes": [[0.0, 1.0]], "no number": [math.nan], "nothing": None, "too large": [1e300], "no double": 10**400,
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
    searches = (lambda q: flank.places(None, None, None, q)), (lambda q: flank.met(None, None, q, 1.0, 1.0))
    for evaluate in (flank, flank.curvature, slopes, second, *searches):
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


@pytest.mark.parametrize("pitches", NO_ANGLES.values(), ids=NO_ANGLES)
def test_pitches_are_finite_numbers(drive, pitches):
    with pytest.raises(UsageError, match="pitches: must be a one-dimensional array of finite numbers"):
        drive.about_the_middle(pitches)


@pytest.mark.parametrize("angle", [*NO_ANGLES.values(), [0.0]])
def test_all_contacts_are_those_at_one_angle(drive, angle):
    with pytest.raises(UsageError, match="angle: must be a finite number"):
        drive.contacts(angle)


@pytest.mark.parametrize("result", [3, "x", [0.0]])
def test_what_is_proved_is_a_contact_analysis(drive, result):
    for use in (drive.certify, drive.certify_first, drive.first_contact):
        with pytest.raises(UsageError, match=r"result: .*give what tca\(angles\) returns"):
            use([0.0], result)
    with pytest.raises(UsageError, match=r"result: .*give what tca\(angles\) returns"):
        drive.refined(result)


def test_proofs_and_exact_angles_are_as_many_as_contacts(drive):
    """Fewer would be read beyond their end."""
    two = drive.tca([0.0, 0.1])
    with pytest.raises(UsageError, match="result: "):
        drive.certify([0.0, 0.1, 0.2], two)
    for certificates in (3, drive.certify([0.0])):
        with pytest.raises(UsageError, match=r"certificates: .*give what certify\(angles, result\) returns"):
            drive.refined(two, certificates)
        with pytest.raises(UsageError, match="certificates: "):
            drive.certify_first(two.angles, two, certificates)
    for degrees in ([Fraction(0)], 3, [0.0, 0.1], "01"):
        with pytest.raises(UsageError, match="degrees: must be exact; give 2 fractions"):
            drive.certify(two.angles, two, degrees)


@pytest.mark.parametrize("member", ["gear", None, 3])
def test_teeth_are_those_of_a_member(drive, member):
    with pytest.raises(UsageError, match="no member .*; use pinion or wheel"):
        drive.teeth(member)


def test_functions_and_requests_are_named(drive):
    with pytest.raises(UsageError, match="no function 'solid_gear'; it has .*undercut_place_wheel"):
        drive.function("solid_gear")
    with pytest.raises(UsageError, match="request = 3: .*give a meshwright.limits.Request"):
        drive.limits(3)


@pytest.mark.parametrize("folder", [3, b"generated", ["generated"]])
def test_a_folder_of_drives_is_a_path(folder):
    with pytest.raises(UsageError, match="drives = .*: no path; name a folder"):
        Drive.load("plain-za", drives=folder)


@pytest.mark.parametrize("inset", [-0.1, 0.5, math.nan, None])
def test_a_grid_keeps_off_less_than_half_of_the_flank(drive, inset):
    with pytest.raises(UsageError, match="inset = .*share from 0 to below 0.5"):
        drive.surface("wheel", (3, 3), inset=inset)


def test_a_grid_fits_in_memory(drive):
    with pytest.raises(UsageError, match="1000000x1000000: 1000000000000 points; 4000000 at most"):
        drive.surface("wheel", (10**6, 10**6))


@pytest.mark.parametrize("shape", [(3,), None, (2.5, 3), (1, 9), "21x41", ([1, 2], [3])])
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
