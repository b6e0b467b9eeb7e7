"""Unmodified involute pairs are conjugate: parallel axes touch along a line, crossed axes in a point that runs along a
fixed normal, both without transmission error."""

import math
from dataclasses import replace

import mpmath
import numpy as np
import pytest

from meshwright import Drive
from tests.cylindrical_gears.designs import ARCSEC, tables
from tests.independent.cylindrical_gears import pair_of

ANGLES = np.radians([-8.0, -1.0, 0.0, 3.0, 9.0])
SPUR = {"pinion_teeth": 12, "wheel_teeth": 24, "pinion_profile_shift_coefficient": 0.6,
        "wheel_profile_shift_coefficient": 0.36}  # fmt: skip
HELICAL = {"pinion_teeth": 12, "wheel_teeth": 60, "pinion_helix_angle_deg": 30.0,
           "pinion_profile_shift_coefficient": 0.09809}  # fmt: skip
CROSSED = {"normal_module_mm": 1.0, "pinion_teeth": 17, "wheel_teeth": 23, "pinion_helix_angle_deg": 45.0,
           "wheel_helix_angle_deg": 45.0, "face_width_mm": 12.0}  # fmt: skip
SHIFTED = {"pinion_teeth": 15, "wheel_teeth": 24, "pinion_helix_angle_deg": 20.0, "wheel_helix_angle_deg": 30.0,
           "pinion_profile_shift_coefficient": 0.4, "wheel_profile_shift_coefficient": 0.2,
           "shaft_angle_deg": 51.1025}  # fmt: skip
ERRORS = [
    {},
    {"center_distance_mm": 0.3},
    {"horizontal_deg": 0.7},
    {"vertical_deg": -0.4},
    {"axial_mm": 0.5},
    {"center_distance_mm": -0.1, "horizontal_deg": -0.3, "vertical_deg": 0.9, "axial_mm": -0.6},
]


def size(drive, key):
    return drive.design.as_solved()["design"][key]


@pytest.mark.parametrize("flank", ["left", "right"])
@pytest.mark.parametrize("design", [SPUR, HELICAL])
def test_a_parallel_pair_touches_along_a_line_without_error(design, flank):
    found = Drive.from_tables(tables(design, flank=flank)).tca(ANGLES)
    assert set(found.status) == {"line_contact"}
    assert np.abs(found.error).max() < 1e-9 * ARCSEC


@pytest.mark.parametrize("flank", ["left", "right"])
@pytest.mark.parametrize("widened", [0.25, -0.1])
@pytest.mark.parametrize("design", [SPUR, HELICAL])
def test_another_centre_distance_shifts_the_error_by_the_involutes(design, widened, flank):
    changed = tables(design, {"center_distance_mm": widened}, flank)
    drive = Drive.from_tables(changed)
    found = drive.tca(ANGLES)
    assert set(found.status) == {"line_contact"}
    with mpmath.workdps(30):
        exact = pair_of(changed)
        exact = replace(exact, distance=exact.zero_backlash_distance())
        assert abs(size(drive, "center_distance_mm") - float(exact.distance)) < 1e-12 * float(exact.distance)
        assert np.abs(found.error - float(exact.parallel_error())).max() < 1e-9 * ARCSEC


@pytest.mark.parametrize("flank", ["left", "right"])
@pytest.mark.parametrize("errors", ERRORS)
@pytest.mark.parametrize("design", [CROSSED, SHIFTED])
def test_a_crossed_pair_has_one_normal_and_no_error_under_every_misalignment(design, errors, flank):
    """Constant error, as the closed form has it; the point runs along the normal, s r_b cos β_b a radian."""
    drive = Drive.from_tables(tables(design, errors, flank))
    found = drive.tca(ANGLES)
    assert set(found.status) == {"converged"}
    with mpmath.workdps(30):
        exact = pair_of(drive.design.tables)
        normal = np.array([float(c) for c in exact.common_normal()])
        error, lever = float(exact.crossed_error()), float(exact.pinion.r_b * mpmath.cos(exact.pinion.beta_b))
    assert np.abs(found.error - error).max() < 1e-9 * ARCSEC
    assert np.ptp(found.error) < 1e-9 * ARCSEC
    assert np.abs(found.normals - normal).max() < 1e-9 * ARCSEC
    travel = exact.pinion.s * lever * (ANGLES - ANGLES[0])
    assert np.abs(found.points - found.points[0] - travel[:, None] * normal).max() < 1e-10


def test_a_crossed_pair_without_backlash_has_no_error():
    for design in (CROSSED, SHIFTED):
        assert np.abs(Drive.from_tables(tables(design)).tca(ANGLES).error).max() < 1e-9 * ARCSEC


@pytest.mark.parametrize("flank", ["left", "right"])
def test_curvatures_of_a_crossed_pair_are_those_of_two_cylinders(flank):
    drive = Drive.from_tables(tables(CROSSED, flank=flank))
    found = drive.tca(ANGLES)
    exact = pair_of(drive.design.tables)
    p, w = exact.pinion, exact.wheel
    bases = [(float(g.r_b), float(g.beta_b)) for g in (p, w)]
    chi = math.acos((math.cos(float(exact.sigma)) + math.sin(bases[0][1]) * math.sin(bases[1][1]))
                    / (math.cos(bases[0][1]) * math.cos(bases[1][1])))  # fmt: skip
    for k in range(len(ANGLES)):
        radii = [math.hypot(*found.body_points[name][k][:2]) for name in ("pinion", "wheel")]
        k1, k2 = (math.cos(b) / math.sqrt(r**2 - rb**2) for r, (rb, b) in zip(radii, bases, strict=True))
        root = math.sqrt(k1**2 + k2**2 + 2 * k1 * k2 * math.cos(2 * chi))
        assert found.curvatures[k] == pytest.approx([(k1 + k2 - root) / 2, (k1 + k2 + root) / 2], rel=1e-9)


@pytest.mark.parametrize("flank", ["left", "right"])
@pytest.mark.parametrize(
    "design", [SPUR, {**SPUR, "center_distance_mm": 56.7}, HELICAL, {**HELICAL, "face_width_mm": 45.0}]
)
def test_contact_ratios_of_parallel_pairs_are_those_of_iso_21771(design, flank):
    """ε_γ = ε_α + ε_β."""
    drive = Drive.from_tables(tables(design, flank=flank))
    _, transverse, overlap = pair_of(drive.design.tables).parallel_contact()
    assert drive.contact_ratio().contact_ratio == pytest.approx(float(transverse + overlap), abs=1e-9)


@pytest.mark.parametrize("errors", ERRORS)
def test_contact_ratios_of_crossed_pairs_follow_from_their_tips(errors):
    """Contact travels along the normal from tip to tip: s_i ≤ √(r_ai² − r_bi²)/cos β_bi, s1 + s2 fixed."""
    drive = Drive.from_tables(tables({**SHIFTED, "face_width_mm": 60.0}, errors))
    exact, found = pair_of(drive.design.tables), drive.tca([0.0])
    path = 0.0
    for gear, name in ((exact.pinion, "pinion"), (exact.wheel, "wheel")):
        base, here = float(gear.r_b), math.hypot(*found.body_points[name][0][:2])
        rolled = math.sqrt(float(gear.r_a) ** 2 - base**2) - math.sqrt(here**2 - base**2)
        path += rolled / math.cos(float(gear.beta_b))
    expected = path / (math.pi * 3.0 * math.cos(math.radians(20.0)))
    assert drive.contact_ratio().contact_ratio == pytest.approx(expected, abs=1e-9)


def test_the_contact_ratio_of_the_crossed_pair_17_23():
    """Published: git-akai, gearcalc, worked example of crossed helical gears."""
    assert Drive.load("crossed-helical-17-23").contact_ratio().contact_ratio == pytest.approx(1.777921669562, abs=1e-9)
