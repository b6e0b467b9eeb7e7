"""What drawings of internal gears state: ISO 21771 evaluated to 40 digits, and rolling of sampled teeth."""

import math

import numpy as np
import pytest

from meshwright import DesignError, Drive
from tests.internal_gears.designs import random_pair, tables

FULL = {"pinion_teeth": 22, "wheel_teeth": -70}


def drawn(design, blank=None):
    return Drive.from_tables(tables(design, blank=blank)).drawing()


CASES = [
    ({"normal_module_mm": 1.0, "pinion_teeth": 18, "wheel_teeth": -40, "wheel_ball_diameter_mm": 1.7}, {},
     {"wheel_over_balls_mm": 37.59511518}),
    (FULL, {"wheel_tip_diameter_mm": 137.2},
     {"center_distance_mm": 48.0, "transverse_contact_ratio": 1.547361846, "wheel_helix_angle_deg": 0.0,
      "wheel_working_diameter_mm": 140.0}),
    ({"normal_module_mm": 1.0, "pinion_teeth": 60, "wheel_teeth": -150}, {"wheel_tip_diameter_mm": 148.0},
     {"transverse_contact_ratio": 1.882729794}),
    ({"pinion_teeth": 22, "wheel_teeth": -70, "wheel_profile_shift_coefficient": -0.15, "shaper_teeth": 20,
      "shaper_profile_shift_coefficient": 0.1, "shaper_tip_radius_mm": 22.7, "shaper_tip_rounding_mm": 0.0}, {},
     {"shaping_center_distance_mm": 50.09926138, "wheel_root_radius_mm": 72.79926138,
      "wheel_limit_radius_mm": 72.34663219, "wheel_root_diameter_mm": 145.5985228}),
]  # fmt: skip


@pytest.mark.parametrize(("design", "blank", "sizes"), CASES)
def test_sizes_are_those_of_the_standard(design, blank, sizes):
    """To the last digit printed."""
    found = drawn(design, blank).sizes
    for key, value in sizes.items():
        digits = len(repr(value).partition(".")[2])
        assert found[key].value == pytest.approx(value, abs=0.51 * 10.0**-digits), key


INTERFERENCES = [
    (22, -70, 137.2, "trochoid_interference", 0.0109997), (22, -70, 137.2, "radial_assembly", 0.0269522),
    (45, -60, 116.0, "radial_assembly", -0.0012863), (56, -60, 116.0, "trochoid_interference", -0.0140661),
]  # fmt: skip


@pytest.mark.parametrize(("z_1", "z_2", "d_a2", "name", "margin"), INTERFERENCES)
def test_interferences_are_those_of_the_standard(z_1, z_2, d_a2, name, margin):
    found = drawn({"pinion_teeth": z_1, "wheel_teeth": z_2}, {"wheel_tip_diameter_mm": d_a2}).checks[name]
    assert found.margin == pytest.approx(margin, abs=0.51e-7)
    assert found.holds is ((margin < 0) if found.word == "occurs" else (margin > 0))


def inv(angle):
    return math.tan(angle) - angle


def thickness(sizes, name, side, radius):
    """Transverse tooth thickness of an involute gear at a radius; ``side`` −1 of a ring gear."""
    value = {key: size.value for key, size in sizes.items()}
    alpha_t = math.radians(value["pinion_transverse_pressure_angle_deg"])
    beta = math.radians(value["pinion_helix_angle_deg"])
    r, s_n = value[f"{name}_reference_radius_mm"], value[f"{name}_normal_thickness_mm"]
    at = math.acos(value[f"{name}_base_radius_mm"] / radius)
    return radius * (s_n / math.cos(beta) / r + side * 2 * (inv(alpha_t) - inv(at)))


@pytest.mark.parametrize("seed", range(6))
def test_on_the_working_circles_teeth_and_backlash_fill_the_pitch(seed):
    """s_w1 + s_w2 + j_wt = p_w: thicknesses from the reference circle, by the involute alone."""
    design = random_pair(np.random.default_rng(seed), modified=False)
    sizes = Drive.from_tables(design).drawing().sizes
    teeth = design["design"]["pinion_teeth"], -design["design"]["wheel_teeth"]
    radii = [sizes[f"{name}_working_diameter_mm"].value / 2 for name in ("pinion", "wheel")]
    assert radii[1] - radii[0] == pytest.approx(sizes["center_distance_mm"].value, abs=1e-9)
    pitch = 2 * math.pi * radii[0] / teeth[0]
    assert pitch == pytest.approx(2 * math.pi * radii[1] / teeth[1], abs=1e-9)
    filled = thickness(sizes, "pinion", 1, radii[0]) + thickness(sizes, "wheel", -1, radii[1])
    backlash = sizes["circumferential_backlash_mm"].value
    assert filled + backlash == pytest.approx(pitch, abs=1e-9)
    assert backlash > 0
    normal = backlash * math.cos(math.radians(sizes["pinion_base_helix_angle_deg"].value))
    normal *= math.cos(math.radians(sizes["transverse_working_pressure_angle_deg"].value))
    assert sizes["normal_backlash_mm"].value == pytest.approx(normal, abs=1e-9)


@pytest.mark.parametrize("seed", range(3))
def test_balls_between_the_teeth_touch_both_flanks(seed):
    """The centre of the ball is as far from both involutes as its radius: brute force over points of the profile."""
    design = random_pair(np.random.default_rng(100 + seed), modified=False)
    design["design"]["pinion_helix_angle_deg"] = 0.0
    drive = Drive.from_tables(design)
    sizes = {key: size.value for key, size in drive.drawing().sizes.items()}
    z = -design["design"]["wheel_teeth"]
    over, ball = sizes["wheel_over_balls_mm"], sizes["wheel_ball_diameter_mm"]
    centre = (over + ball) / 2 / (math.cos(math.pi / (2 * z)) if z % 2 else 1.0)
    r_b = sizes["wheel_base_radius_mm"]
    alpha, x = math.radians(design["design"]["pressure_angle_deg"]), sizes["wheel_generating_profile_shift_coefficient"]
    half = (math.pi / 2 - 2 * x * math.tan(alpha)) / z + inv(alpha)
    rolling = np.linspace(0.0, 0.6 * r_b, 200001)
    turn = half - rolling / r_b
    points = r_b * np.exp(1j * turn) + 1j * rolling * np.exp(1j * turn)
    assert abs(points - centre).min() == pytest.approx(ball / 2, abs=1e-7 * r_b)


@pytest.mark.parametrize(("given", "value"), [("wheel_normal_thickness_mm", 3.0), ("wheel_over_balls_mm", 135.4)])
def test_what_is_measured_of_the_ring_gear_sets_its_allowance(given, value):
    sizes = drawn(FULL | {"wheel_ball_diameter_mm": 3.4, given: value}).sizes
    assert sizes["wheel_thickness_allowance_um"].provenance == "derived"
    allowance = sizes["wheel_thickness_allowance_um"].value
    again = drawn(FULL | {"wheel_ball_diameter_mm": 3.4, "wheel_thickness_allowance_um": allowance}).sizes
    assert again[given].value == pytest.approx(value, abs=1e-9)


REFUSED = [
    ({"wheel_teeth": 70}, ("wheel_teeth = 70", "cylindrical-gears")),
    ({"wheel_kind": "external"}, ("wheel_kind = 'external'", "wheel_teeth = -70")),
    ({"wheel_kind": "rack"}, ("wheel_kind = 'rack'", "none travels")),
    ({"pinion_teeth": 70}, ("wheel_teeth = -70", "pinion_teeth = 70")),
    ({"shaper_teeth": 80}, ("shaper_teeth = 80", "wheel_teeth = -70")),
    ({"shaping_center_distance_mm": 47.0}, ("shaping_center_distance_mm = 47",)),
    ({"shaper_tip_rounding_mm": 1.5}, ("shaper_tip_rounding_mm = 1.5", "wide enough")),
    ({"center_distance_mm": 48.0, "normal_backlash_mm": 0.1, "pinion_profile_shift_coefficient": 0,
      "wheel_profile_shift_coefficient": 0, "pinion_thickness_allowance_um": 0, "wheel_thickness_allowance_um": 0},
     ("normal_backlash_mm = 0.1", "contradicts")),
]  # fmt: skip


@pytest.mark.parametrize(("design", "words"), REFUSED)
def test_what_no_internal_pair_has_is_refused_with_the_keys(design, words):
    with pytest.raises(DesignError) as caught:
        Drive.from_tables(tables(FULL | design)).drawing()
    for word in words:
        assert word in str(caught.value)
