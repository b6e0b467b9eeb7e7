"""Flanks that touch along lines: the line itself, and the window in which any of it lies on the flanks."""

import json
import math

import numpy as np
import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.contact.contact_line import contact_line
from meshwright.contact.results import ARCSEC

SPUR = {
    "drive": "spherical",
    "design": {
        "module_mm": 4.0,
        "pinion_teeth": 36,
        "wheel_teeth": 72,
        "pressure_angle_deg": 20.0,
        "pinion_form": "spur",
        "wheel_form": "spur",
        "face_width_mm": 15.0,
    },
}


def _equal_helicoids():
    drive = Drive.load("recess-action-full")
    return drive.with_(design={"hob_pitch_radius_mm": drive.design.as_solved()["design"]["worm_pitch_radius_mm"]})


def _involute_contact_ratio(module, teeth, pressure_angle):
    """ISO 21771: transverse contact ratio of a spur pair with tips one module beyond the pitch circles."""
    radii = [module * t / 2 for t in teeth]
    lengths = [math.sqrt((r + module) ** 2 - (r * math.cos(pressure_angle)) ** 2) for r in radii]
    distance = module * sum(teeth) / 2
    path = sum(lengths) - distance * math.sin(pressure_angle)
    return path / (math.pi * module * math.cos(pressure_angle))


@pytest.mark.parametrize("pressure_angle", [20.0, 25.0])
def test_spur_gears_have_the_contact_ratio_of_the_standard(pressure_angle):
    drive = Drive.from_tables(SPUR).with_(design={"pressure_angle_deg": pressure_angle})
    found = drive.contact_ratio()
    assert found.status == "line_contact"
    assert (found.begin.reason, found.begin.member) == ("tip", "wheel")
    assert (found.end.reason, found.end.member) == ("tip", "pinion")
    expected = _involute_contact_ratio(4.0, (36, 72), math.radians(pressure_angle))
    assert found.contact_ratio == pytest.approx(expected, abs=1e-8)


def _line(drive, angle):
    starts, _ = drive.trace([angle])
    return contact_line(drive, angle, starts[0])


def test_the_line_of_spur_gears_runs_straight_across_the_face():
    line = _line(Drive.from_tables(SPUR), 0.02)
    ends = line.points[[0, -1]]
    assert np.abs(ends[:, 2]) == pytest.approx([7.5, 7.5], abs=1e-9)
    assert np.ptp(line.points[:, :2], axis=0) == pytest.approx([0.0, 0.0], abs=1e-10)


def test_a_worm_and_its_equal_hob_touch_along_a_curve_from_edge_to_edge():
    drive = _equal_helicoids()
    line = _line(drive, math.radians(1000.0))
    blade_end = math.pi / (2 * math.sin(math.radians(10.0))) + 4.0 / math.cos(math.radians(10.0))
    wheel = drive.flank("wheel")(line.parameters["wheel"])
    at_tip = np.abs(wheel.margins["tip"][[0, -1]]) < 1e-8
    at_root = np.abs(line.parameters["wheel"][[0, -1], 0] - blade_end) < 1e-8
    at_sheet = np.abs(wheel.margins["spurious_sheet"][[0, -1]]) < 1e-6
    assert (at_tip | at_root | at_sheet | (np.abs(wheel.regular[[0, -1]]) < 1e-6)).all()


def test_line_contact_begins_earlier_and_ends_later_than_contact_at_a_point():
    """The line reaches past the point that a barely larger hob leaves of it."""
    line, point = _equal_helicoids().contact_ratio(), Drive.load("recess-action-full").contact_ratio()
    assert line.begin.angle < point.begin.angle and line.end.angle > point.end.angle


def test_the_command_draws_the_line(capsys):
    equal = _equal_helicoids().design.value("hob_pitch_radius_mm")
    setting = ["--set", f"design.hob_pitch_radius_mm={equal!r}"]
    assert main(["tca", "recess-action-full", *setting, "--phi-deg", "1000", "--contour", "8", "--json", "-"]) == 0
    (point,) = json.loads(capsys.readouterr().out)["points"]
    assert point["contour"] == [] and len(point["contact_line_mm"]) > 10


def test_a_worm_and_a_wheel_cut_by_its_equal_touch_along_a_curve_from_face_to_face():
    """ZI, m_x 4, 2/40, r1 20: a point for each polar angle of the thread, from the meshing of the worm alone."""
    drive = Drive.from_tables({
        "drive": "cylindrical-worm", "flank": "right",
        "design": {"worm_profile": "ZI", "axial_module_mm": 4.0, "worm_threads": 2, "wheel_teeth": 40,
                   "worm_pitch_radius_mm": 20.0, "pressure_angle_deg": 20.0},
        "blank": {"worm_tip_radius_mm": 24.0, "worm_root_radius_mm": 15.2, "wheel_throat_radius_mm": 84.0,
                  "wheel_tip_radius_mm": 86.0, "wheel_face_width_mm": 24.0},
    })  # fmt: skip
    (point,) = drive.tca([0.0]).to_points()
    line = point["contact_line"]
    assert point["status"] == "line_contact" and point["transmission_error_arcsec"] == pytest.approx(0.0, abs=1e-8)
    at_ends = line["curvature_per_mm"][0], line["curvature_per_mm"][-1]
    order = sorted(zip((end["point_mm"] for end in line["ends"]), at_ends, strict=True))
    assert order[0][0] == pytest.approx([18.6127060, 12.0, 6.2397587], abs=1e-7)
    assert order[1][0] == pytest.approx([19.2030248, -12.0, 1.9053764], abs=1e-7)
    assert [curvature for _, curvature in order] == pytest.approx([0.0462716, 0.0303573], abs=1e-7)
    assert line["length_mm"] == pytest.approx(24.57378, abs=2e-5)
    assert all((end["member"], end["limits"]) == ("wheel", ["face"]) for end in line["ends"])


@pytest.mark.parametrize("name", ["bevel-crown-pair", "bevel-face-hobbed-crown-pair"])
def test_gears_cut_by_one_crown_gear_touch_along_lines_from_end_to_end_of_their_window(name):
    """Their mean contact may lie far from the pinion's angle 0; past the ends of the window no line is left."""
    drive = Drive.load(name)
    window = drive.window
    low, high = sorted((window.begin.angle, window.end.angle))
    assert window.complete and window.status == "line_contact" and low < drive.design.reference_angle < high
    inner = 1e-4 * (high - low)
    inside = drive.tca(np.linspace(low + inner, high - inner, 9))
    assert set(inside.status) == {"line_contact"} and np.abs(inside.error).max() < 1e-8 * ARCSEC
    assert "line_contact" not in drive.tca(np.array([low - inner, high + inner])).status
