"""Sensitivities against differences of the independent formulations in 50-digit arithmetic."""

import mpmath
import numpy as np
import pytest

from meshwright import Drive
from meshwright.design import design
from meshwright.sensitivity import sensitivity
from tests.independent.twins import twin
from tests.quick import quick

#: Share of the pitch at which the packaged designs are looked at.
PLACE = 0.11

#: Sizes given that otherwise follow: by rules, by design systems, or as defaults.
GIVEN = {
    "face-worm-conical-convex": (
        {"head_cutter_radius_mm": 24.398},
        {"blade_angle_deg": -9.5, "head_cutter_tilt_change_deg": 3.0},
        {"pitch_point_rule": "cones"},
        {"pitch_point_rule": "cones", "head_cutter_radius_mm": 24.398, "blade_angle_deg": -9.5},
    ),
    "plain-zk": ({"hob_lead_angle_deg": 10.9}, {"center_distance_mm": 103.9, "hob_pressure_angle_deg": 20.1}),
    "spherical-table-4-4-convex": ({"wheel_half_space_mm": 3.1}, {"edge_offset_mm": 4.2}),
}

CASES = [(name, given) for name, cases in GIVEN.items() for given in cases]

#: Equal spheres and unmodified spur gears touch along a line, and misaligned not in a point of their own: there is
#: nothing to differentiate.
LINES = ("spherical-table-2-1", "spur-profile-shift")

#: Misalignments of each family that has a twin in 50 digits, so that nothing vanishes by symmetry.
ERRORS = {
    "cylindrical-worm": {"center_distance_mm": 0.01, "vertical_deg": 0.01},
    "spherical": {"center_distance_mm": 0.1, "horizontal_deg": 0.02, "vertical_deg": 0.01},
    "face-worm": {"offset_mm": 0.05, "shaft_angle_deg": 0.02},
    "cylindrical-gears": {"center_distance_mm": 0.05, "horizontal_deg": 0.02, "vertical_deg": 0.01, "axial_mm": 0.3},
}

WITH_TWINS = [name for name in design.packaged_names() if design.read(name)["drive"] in ERRORS]

#: A design of each family.
NOW = ("recess-action-full", "spherical-table-2-2-convex-20")


def _values(drive, keys):
    return {key: mpmath.mpf(drive.design.value(*reversed(key.split(".")))) for key in keys}


def _given(drive, key):
    table, name = key.split(".")
    return table == "misalignment" or drive.design.tables[table].get(name) is not None


def _agree(drive, angle):
    """Whether the drive has a contact at the angle; if so, its sensitivities are those of 50 digits."""
    ours = sensitivity(drive, [angle])
    right = drive.with_(design={"hand": "right"}) if drive.design.mirrored else drive
    sign = -1.0 if drive.design.mirrored else 1.0
    contact = right.tca([sign * angle])
    if contact.status != ("converged",):
        assert np.isnan(ours.points).all()
        return False
    with mpmath.workdps(50):
        given = _values(drive, [key for key in ours.keys if _given(drive, key)])
        exact = twin(right, contact)
        slopes = exact.slopes(given, mpmath.mpf(sign * angle), _values(drive, ours.keys))
    turned = [sign if n.startswith(("psi_", "phi_", "transmission")) else 1.0 for n in exact.names]
    slopes *= [*turned, 1.0, sign, 1.0]
    found = np.column_stack([*(ours.unknowns[name][0] for name in exact.names), ours.points[0]])
    off = np.abs(found - slopes)
    assert (off.max(axis=1) / np.maximum(1.0, np.abs(slopes).max(axis=1))).max() < 1e-10
    assert off[:, exact.names.index("transmission_error")].max() < 1e-13
    assert ours.error[0] == pytest.approx(ours.unknowns["transmission_error"][0], abs=0.0)
    return True


@pytest.mark.parametrize("name", quick(WITH_TWINS, *NOW))
def test_every_parameter_agrees_with_differences_in_50_digits(name):
    drive = Drive.load(name)
    angle = PLACE * drive.pitch()
    misaligned = drive.with_(misalignment=ERRORS[drive.design.family])
    assert [_agree(d, angle) for d in (drive, misaligned)] == [name not in LINES] * 2


@pytest.mark.parametrize("name, given", quick(CASES, CASES[0], CASES[4], CASES[6]))
def test_what_is_given_instead_of_derived_stays_where_it_is(name, given):
    drive = Drive.load(name).with_(design=given)
    assert _agree(drive, PLACE * drive.pitch())
    result = sensitivity(drive, [0.0])
    for key in given.keys() - {"pitch_point_rule"}:
        places = [p["table"] == "design" and p["key"] == key for p in drive.design.description["parameters"]]
        own = result.of(f"design.{key}")
        assert result.design[places.index(True)] == pytest.approx(np.eye(len(result.keys))[own], abs=0.0)


@pytest.mark.parametrize("name", quick(["plain-zi", "recess-action-full", "zk-zn-60"], "plain-zi"))
def test_a_left_hand_drive_is_the_mirror_image(name):
    drive = Drive.load(name).with_(design={"hand": "left"}, misalignment=ERRORS["cylindrical-worm"])
    assert _agree(drive, PLACE * drive.pitch())


def test_a_left_hand_drive_agrees_with_differences_of_its_own_analysis():
    drive, angle, step = Drive.load("plain-zi").with_(design={"hand": "left"}), 0.3, 1e-4
    result = sensitivity(drive, [angle])
    for key in ("vertical_deg", "center_distance_mm"):
        ends = [drive.with_(misalignment={key: h * step}).tca([angle]) for h in (-2, -1, 1, 2)]
        unit = np.radians(step) if key.endswith("_deg") else step
        column = result.of(f"misalignment.{key}")
        for name in ("error", "points"):
            values = [getattr(end, name)[0] for end in ends]
            slope = (values[0] - 8 * values[1] + 8 * values[2] - values[3]) / (12 * unit)
            assert getattr(result, name)[0, column] == pytest.approx(slope, rel=1e-5, abs=1e-7)


def test_placement_of_the_head_cutter_follows_the_keys():
    """Columns of the completed design against differences of completed designs."""
    drive = Drive.load("face-worm-conical-convex")
    result = sensitivity(drive, [0.0])
    step = 1e-4
    for key in ("axial_module_mm", "offset_mm", "gear_inner_radius_mm"):
        value = drive.design.value(key)
        ends = [drive.with_(design={key: value + h * step}).design.parameters for h in (-2, -1, 1, 2)]
        slope = (ends[0] - 8 * ends[1] + 8 * ends[2] - ends[3]) / (12 * step)
        ours = result.design[:, result.of(f"design.{key}")]
        assert ours == pytest.approx(slope, rel=1e-6, abs=1e-6)
