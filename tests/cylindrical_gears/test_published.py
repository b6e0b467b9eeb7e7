"""Published numbers of involute gear pairs, to the print."""

import math

import numpy as np
import pytest

from meshwright import Drive
from tests.cylindrical_gears.designs import tables


def sizes(design):
    return Drive.from_tables(tables(design)).design.as_solved()["design"]


def test_spur_gears_with_profile_shift():
    """KHK Gear Technical Reference, calculation of profile-shifted spur gears: m 3, 12/24, x 0.6/0.36."""
    found = sizes({"pinion_teeth": 12, "wheel_teeth": 24, "pinion_profile_shift_coefficient": 0.6,
                   "wheel_profile_shift_coefficient": 0.36})  # fmt: skip
    assert found["transverse_working_pressure_angle_deg"] == pytest.approx(26.0886, abs=5e-5)
    assert found["center_distance_mm"] == pytest.approx(56.4999, abs=5e-5)


def test_helical_gears_with_profile_shift():
    """The same reference, helical gears of the normal system: m 3, β 30°, 12/60, x 0.09809/0."""
    found = sizes({"pinion_teeth": 12, "wheel_teeth": 60, "pinion_helix_angle_deg": 30.0,
                   "pinion_profile_shift_coefficient": 0.09809})  # fmt: skip
    assert found["transverse_working_pressure_angle_deg"] == pytest.approx(23.1126, abs=5e-5)
    assert found["center_distance_mm"] == pytest.approx(125.000, abs=5e-4)


def test_a_worked_sheet_on_iso_21771():
    """m 3.5, β 21°, 31/30: reference centre distance and, at 116.5 mm, the working pressure angle and its involute."""
    design = {"normal_module_mm": 3.5, "pinion_teeth": 31, "wheel_teeth": 30, "pinion_helix_angle_deg": 21.0}
    found = sizes(design)
    assert found["center_distance_mm"] == pytest.approx(114.3447280708, abs=5e-11)
    assert found["pinion_transverse_pressure_angle_deg"] == pytest.approx(21.2990642859, abs=5e-11)
    angle = math.radians(sizes({**design, "center_distance_mm": 116.5})["transverse_working_pressure_angle_deg"])
    assert math.degrees(angle) == pytest.approx(23.8707609654, abs=5e-11)
    assert math.tan(angle) - angle == pytest.approx(0.0259052382, abs=5e-11)


@pytest.mark.parametrize(
    ("shaft", "working", "distance"), [(51.1025, 22.9394, 67.1931), (50.0, 20.0, 67.3132)]
)  # fmt: skip
def test_screw_gears_exactly(shaft, working, distance):
    """m 3, 15/24, β 20°/30°, x 0.4/0.2: exact values beside the approximation by virtual spur gears (22.9338, 67.1925),
    which turns the shafts to 51.1025°.
    """
    found = sizes({"pinion_teeth": 15, "wheel_teeth": 24, "pinion_helix_angle_deg": 20.0, "wheel_helix_angle_deg": 30.0,
                   "pinion_profile_shift_coefficient": 0.4, "wheel_profile_shift_coefficient": 0.2,
                   "shaft_angle_deg": shaft})  # fmt: skip
    assert found["normal_working_pressure_angle_deg"] == pytest.approx(working, abs=1e-4)
    assert found["center_distance_mm"] == pytest.approx(distance, abs=5e-5)


@pytest.mark.parametrize(
    ("radius", "module", "teeth", "curvatures"),
    [(6.0, 1.0, 1, (0.0557064, 0.1490735)), (3.5, 1.0, 1, (0.0816150, 0.1732425)),
     (6.0, 1.0, 4, (0.0419840, 0.1871367))],
)  # fmt: skip
def test_a_zi_worm_with_an_involute_wheel(radius, module, teeth, curvatures):
    """A ZI worm is an involute gear of helix angle 90° − λ: published relative curvatures in the pitch point."""
    lead = math.degrees(math.asin(module * teeth / (2 * radius)))
    design = {"normal_module_mm": module, "pinion_teeth": teeth, "wheel_teeth": 40, "shaft_angle_deg": 90.0,
              "pinion_helix_angle_deg": 90.0 - lead, "wheel_helix_angle_deg": lead}  # fmt: skip
    found = Drive.from_tables(tables(design)).tca([0.0])
    assert found.points[0] == pytest.approx([radius, 0.0, 0.0], abs=1e-9)
    assert found.curvatures[0] == pytest.approx(curvatures, abs=6e-8)


def test_least_teeth_without_undercut():
    """20°, standard rack with its rounding: 17.097, of which practice makes 17; by helix angle with cos β/sin² α_t."""
    found = sizes({"pinion_teeth": 20, "wheel_teeth": 40, "pinion_helix_angle_deg": 30.0})
    transverse = math.atan(math.tan(math.radians(20)) / math.cos(math.radians(30)))
    height = 1.25 - 0.38 * (1 - math.sin(math.radians(20)))
    expected = 2 * height * math.cos(math.radians(30)) / math.sin(transverse) ** 2
    assert found["pinion_least_teeth_without_undercut"] == pytest.approx(expected, rel=1e-12)
    spur = sizes({"pinion_teeth": 20, "wheel_teeth": 40})
    assert spur["pinion_least_teeth_without_undercut"] == pytest.approx(17.097, abs=5e-4)


@pytest.mark.parametrize(("teeth", "undercut"), [(16, True), (17, True), (18, False)])
def test_undercut_begins_below_that_number(teeth, undercut):
    """Whether the start of the involute is past the singular line, which lies at l_u = −r sin² α/cos α."""
    drive = Drive.from_tables(tables({"pinion_teeth": teeth, "wheel_teeth": 40}))
    start, alpha = drive.design.sizes["pinion_edge_start_mm"], math.radians(20.0)
    singular = -1.5 * teeth * math.sin(alpha) ** 2 / math.cos(alpha)
    at_start, at_limit = drive.flank("pinion")(np.array([[start, 0.0], [singular, 0.0]])).regular
    assert (at_start < 0.0) == undercut == (singular > start)
    assert abs(at_limit) < 1e-12


@pytest.mark.parametrize("shift, least", [(0.0, 18), (-0.1, 19), (0.3, 12)])
def test_limits_name_undercut_and_the_least_teeth(shift, least):
    """Every section is singular at l_u = −(r sin² α_t + x m)/cos α; z_lim = 2 (h − x) cos β/sin² α_t, rounded up."""
    design = {"pinion_teeth": 14, "wheel_teeth": 40, "pinion_profile_shift_coefficient": shift}
    found = Drive.from_tables(tables(design)).limits()
    alpha = math.radians(20.0)
    line = [entry for entry in found.undercut if entry.member == "pinion"]
    singular = -(21.0 * math.sin(alpha) ** 2 + 3.0 * shift) / math.cos(alpha)
    assert [entry.parameters["l_pinion"] for entry in line] == pytest.approx([singular] * len(line), abs=1e-9)
    assert all(entry.on_flank == (singular > -3.1924300532) for entry in line)
    assert found.least_teeth["pinion"] == least
