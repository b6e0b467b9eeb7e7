"""Contact of internal pairs: closed forms of the involute, 50-digit arithmetic, the cutter rolled in small steps."""

import math

import mpmath
import numpy as np
import pytest

from meshwright import DesignError, Drive
from meshwright.contact.results import ARCSEC
from meshwright.fe.closed_body import closed_body
from tests.independent.chords import chords
from tests.independent.internal_gears import internal_pair
from tests.internal_gears.designs import random_pair, tables
from tests.quick import full

DESIGN = {"pinion_teeth": 22, "wheel_teeth": -70, "pinion_lead_crowning_um": 8.0}
BASES = tuple(z * math.cos(math.radians(20.0)) for z in (22, 70))
DIGITS, PAIRS = 50, 60 if full() else 8


def inv(angle):
    return math.tan(angle) - angle


@pytest.mark.parametrize(("flank", "sign"), [("left", 1.0), ("right", -1.0)])
def test_a_smaller_distance_opens_a_gap_of_the_involute_functions(flank, sign):
    """cos α_w = (r_b2 − r_b1)/a; the wheel lags by the difference of the involute functions times 1 − z1/|z2|."""
    moved = Drive.from_tables(tables(DESIGN, {"center_distance_mm": -0.2}, flank))
    working = math.acos((BASES[1] - BASES[0]) / 47.8)
    (error,) = moved.tca([0.0]).error
    gap = (1 - 22 / 70) * (inv(working) - inv(math.radians(20.0)))
    assert error == pytest.approx(sign * gap, abs=1e-9 * ARCSEC)


def test_the_relative_curvatures_are_those_of_two_involutes_and_the_crowning():
    """1/ϱ1 − 1/ϱ2 across the tooth, ϱ2 = ϱ1 + a sin α; along it 8 C/b²."""
    angles = np.radians([-6.0, 0.0, 5.0])
    result = Drive.from_tables(tables(DESIGN)).tca(angles)
    first = BASES[0] * (math.tan(math.radians(20.0)) + angles)
    other = first + 48.0 * math.sin(math.radians(20.0))
    assert result.curvatures[:, 1] == pytest.approx(1 / first - 1 / other, rel=1e-9)
    assert result.curvatures[:, 0] == pytest.approx(np.full(3, 8 * 0.008 / 20.0**2), rel=1e-9)
    assert np.abs(result.error).max() < 1e-9 * ARCSEC


@pytest.mark.parametrize("beta", [0.0, 17.0])
def test_unmodified_flanks_touch_along_a_line_without_error(beta):
    drive = Drive.from_tables(tables(DESIGN | {"pinion_lead_crowning_um": 0.0, "pinion_helix_angle_deg": beta}))
    result = drive.tca(np.radians([-4.0, 0.0, 3.0]))
    assert set(result.status) == {"line_contact"}
    assert np.abs(result.error).max() < 1e-9 * ARCSEC


def test_contact_agrees_with_fifty_digits():
    """Transmission error within 1e-10 arcsec, positions (mm) and normals within 1e-11, of an own formulation."""
    rng, rows = np.random.default_rng(60), []
    with mpmath.workdps(DIGITS):
        while len(rows) < PAIRS:
            design, phi = random_pair(rng), float(rng.uniform(-0.1, 0.1))
            try:
                found = Drive.from_tables(design).tca([phi])
            except DesignError:
                continue
            if found.status != ("converged",):
                continue
            exact, angle = internal_pair(design), mpmath.mpf(phi)
            x = chords(lambda x, exact=exact, angle=angle: exact.residual(angle, x), found.solutions[0])
            point, normal, _, _ = exact.placed(angle, x)
            rows.append((
                abs(float(x[4] - mpmath.mpf(float(found.error[0])))) / ARCSEC,
                max(abs(float(a - mpmath.mpf(float(b)))) for a, b in zip(point, found.points[0], strict=True)),
                max(abs(float(a - mpmath.mpf(float(b)))) for a, b in zip(normal, found.normals[0], strict=True)),
            ))  # fmt: skip
    worst = np.array(rows).max(axis=0)
    assert worst[0] < 1e-10
    assert worst[1:].max() < 1e-11


@pytest.mark.parametrize("seed", range(3))
def test_ratio_and_backlash_are_those_of_the_drawing(seed):
    """The path of contact in the involute's closed form; the play from one flank to the other."""
    design = random_pair(np.random.default_rng(40 + seed), modified=False)
    design["design"]["pinion_lead_crowning_um"] = 5.0
    drive = Drive.from_tables(design)
    sizes, found = drive.drawing().sizes, drive.contact_ratio()
    if design["design"]["pinion_helix_angle_deg"] == 0.0:
        assert found.contact_ratio == pytest.approx(sizes["transverse_contact_ratio"].value, abs=1e-6)
    other = "left" if design["flank"] == "right" else "right"
    errors = [d.tca([0.0]).error[0] for d in (drive, drive.with_(flank=other))]
    play = math.radians(sizes["wheel_backlash_deg"].value)
    assert abs(errors[0] - errors[1]) == pytest.approx(play, abs=1e-9)
    lengths = [sizes[f"{kind}_backlash_mm"].value for kind in ("circumferential", "normal")]
    assert found.backlash_lengths == pytest.approx(lengths, rel=1e-3)


# -- the ring gear against its cutter, rolled in small steps -----------------------------------------------------------


class Cutter:
    """The cutter's tooth in the transverse section, written down: involutes and roundings of the tip."""

    def __init__(self, drive):
        design, sizes = drive.design, {key: size.value for key, size in drive.drawing().sizes.items()}
        self.z_0, self.z_2 = design.value("shaper_teeth"), -design.value("wheel_teeth")
        self.alpha_t = math.radians(sizes["pinion_transverse_pressure_angle_deg"])
        self.r_b = sizes["wheel_base_radius_mm"] * self.z_0 / self.z_2
        shift, alpha = design.value("shaper_profile_shift_coefficient"), design.value("pressure_angle_deg")
        self.half = (math.pi / 2 + 2 * shift * math.tan(alpha)) / self.z_0 + inv(self.alpha_t)
        self.rounding = sizes["shaper_tip_rounding_mm"]
        self.centre = sizes["shaper_tip_radius_mm"] - self.rounding
        self.distance = sizes["shaping_center_distance_mm"]
        within = math.sqrt(self.centre**2 - self.r_b**2)
        self.end = within + self.rounding
        self.centre_angle = self.half - self.end / self.r_b + math.atan2(within, self.r_b)

    def seen(self, point, turn):
        """A point of the ring gear's section (complex) in the frame of the cutter, which has turned by ``turn``."""
        return (point * np.exp(1j * turn * self.z_0 / self.z_2) - self.distance) * np.exp(-1j * turn)

    def beyond_involute(self, point, turn, s):
        """Distance along the normal from the involute of flank ``s``."""
        seen = self.seen(point, turn)
        rolling = np.sqrt(np.maximum(np.abs(seen) ** 2 - self.r_b**2, 0.0))
        polar = s * np.angle(seen)
        return (polar - np.arctan2(rolling, self.r_b)) * self.r_b + rolling - self.half * self.r_b

    def beyond_rounding(self, point, turn, s):
        """Distance from the rounding of flank ``s``."""
        return np.abs(self.seen(point, turn) - self.centre * np.exp(1j * s * self.centre_angle)) - self.rounding


def least(function):
    """The least value over turns of the cutter, found by ever finer steps."""
    middle, width = 0.0, 0.8
    for _ in range(12):
        turns = middle + np.linspace(-width, width, 401)
        values = function(turns)
        middle, width = turns[np.argmin(values)], width / 50
    return values.min()


@pytest.mark.parametrize("flank", ["left", "right"])
@pytest.mark.parametrize("beta", [0.0, 20.0])
def test_the_cutter_touches_every_point_of_flank_and_fillet_once_and_enters_none(flank, beta):
    """Rolled in small steps: the least distance from its involute, and from its rounding, is zero."""
    design = DESIGN | {"pinion_helix_angle_deg": beta, "wheel_profile_shift_coefficient": 0.2, "shaper_teeth": 18,
                       "shaper_profile_shift_coefficient": 0.15, "wheel_thickness_allowance_um": -30.0}  # fmt: skip
    drive = Drive.from_tables(tables(design, flank=flank))
    cutter, s = Cutter(drive), 1 if flank == "left" else -1
    pitch = math.tan(math.radians(beta)) / drive.drawing().sizes["wheel_reference_radius_mm"].value
    for region, beyond in (("flank", cutter.beyond_involute), ("fillet", cutter.beyond_rounding)):
        points = drive.surface("wheel", (6, 3), region).points.reshape(-1, 3)
        points = points[np.isfinite(points).all(axis=1)]
        assert len(points) > 8
        for x, y, z in points:
            section = complex(x, y) * np.exp(-1j * z * pitch)
            assert least(lambda turns, at=section, of=beyond: of(at, turns, s)) == pytest.approx(0.0, abs=1e-8)


def test_the_volume_of_the_ring_gear_is_that_of_the_rim_less_its_spaces():
    """Spaces between tip and root circle: involute angles, and the widest reach of the rounding as it rolls."""
    drive = Drive.from_tables(tables(DESIGN | {"shaper_tip_rounding_mm": 0.5}))
    cutter, sizes = Cutter(drive), {key: size.value for key, size in drive.drawing().sizes.items()}
    tip, form, root = (sizes[f"wheel_{key}_radius_mm"] for key in ("tip", "limit", "root"))
    r_b, z = sizes["wheel_base_radius_mm"], int(cutter.z_2)
    half = math.pi / 2 / z + inv(cutter.alpha_t)
    turns = np.linspace(-0.6, 0.6, 6001)
    tooth = cutter.distance + cutter.centre * np.exp(1j * (turns + cutter.centre_angle))
    centres = tooth * np.exp(-1j * turns * cutter.z_0 / z)

    def reach(radius):
        if radius < form:
            at = math.acos(r_b / radius)
            return half - inv(at)
        size = np.abs(centres)
        cosine = (radius**2 + size**2 - cutter.rounding**2) / (2 * radius * size)
        met = np.abs(cosine) <= 1.0
        return (np.angle(centres[met]) + np.arccos(cosine[met])).max()

    space = 0.0
    for low, high, steps in ((tip, form, 400), (form, root, 400)):
        radii = low + (np.arange(steps) + 0.5) * (high - low) / steps
        space += sum(2 * reach(r) * r for r in radii) * (high - low) / steps
    solid = math.pi * ((root + 5.0) ** 2 - tip**2) - z * space
    assert closed_body(drive, "wheel", rim_thickness=5.0).volume == pytest.approx(20.0 * solid, rel=1e-4)


def test_the_default_tip_of_the_ring_gear_clears_the_fillet_of_the_pinion():
    """By a tenth of a module along the line of action, at the start of the pinion's involute."""
    sheet = Drive.from_tables(tables(DESIGN | {"pinion_teeth": 20, "wheel_teeth": -60})).drawing()
    assert sheet.checks["involute_interference"].margin == pytest.approx(0.2, abs=1e-9)
    assert not any(check.holds for check in sheet.checks.values() if check.word == "occurs")
