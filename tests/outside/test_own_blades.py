"""Worms cut by blades of an own file, against an own formulation in 40 digits that knows their profiles alone."""

import dataclasses
import json
import math

import mpmath as mp
import numpy as np
import pytest
from scipy.optimize import brentq

from meshwright import Drive
from meshwright.base.errors import DesignError
from meshwright.cli import main
from meshwright.contact.results import ARCSEC
from meshwright.design import design as designs
from meshwright.sensitivity import sensitivity
from tests.independent.chords import chords
from tests.independent.vectors import cross, rotate
from tests.independent.worm import Helicoid, WormDrive, unit
from tests.outside.folder import Commands
from tests.worm.hob_tip import Balls

pytestmark = pytest.mark.validate

DESIGN = {
    "normal_module_mm": 4.0, "worm_threads": 2, "wheel_teeth": 41, "worm_lead_angle_deg": 11.31,
    "pressure_angle_deg": 20.0, "hob_pitch_radius_mm": 21.0,
}  # fmt: skip
BLANK = {
    "wheel_throat_radius_mm": 87.62, "wheel_tip_radius_mm": 89.66, "wheel_face_width_mm": 32.0,
    "worm_tip_radius_mm": 24.4, "worm_root_radius_mm": 15.6, "hob_tip_addendum_mm": 4.9,
}  # fmt: skip
CROWNED = {"worm_profile": "ZY", "blade_crown_per_mm": 0.002, "hob_blade_crown_per_mm": 0.001}
RELIEVED = {"worm_profile": "ZT", "tip_relief_per_mm": 0.01, "tip_relief_begin_mm": 1.0, "hob_tip_relief_per_mm": 0.0}
ERRORS = {"center_distance_mm": 0.05, "horizontal_deg": 0.02, "vertical_deg": -0.03, "axial_mm": 0.04}
STEP = mp.mpf(10) ** -13


@dataclasses.dataclass
class Own(Helicoid):
    """A helicoid whose profile is a curve of positions: its normal is that of a difference in 40 digits."""

    own: tuple = ()

    def profile(self, t):
        curve = getattr(self, f"_{self.kind}")
        point, ends = curve(t), [curve(t + h) for h in (STEP, -STEP)]
        slope = [(a - b) / (2 * STEP) for a, b in zip(*ends, strict=True)]
        along = [-point[1], point[0], self.p]
        return point, unit([-self.s * c for c in cross(slope, along)])

    def _ZY(self, t):
        (crown,) = self.own
        point, _ = self._ZI(t)
        return [point[0], point[1], point[2] - self.s * crown * (t - self.r) ** 2]

    def _ZT(self, t):
        relief, begin = self.own
        foot = mp.sqrt(self.r**2 - (self.S * mp.sin(self.lead) / 2) ** 2)
        across = self.S / 2 + t * mp.tan(self.alpha) + relief * max(t - begin, 0) ** 2
        return rotate("x", self.lead, [foot + t, mp.mpf(0), self.s * across])


def exact_error(tables, phi, contact):
    """The transmission error, rad, of the contact near that of a solved drive."""
    d = tables["design"]
    own = {"ZY": ("blade_crown_per_mm",), "ZT": ("tip_relief_per_mm", "tip_relief_begin_mm")}[d["worm_profile"]]
    with mp.workdps(40):
        twin = WormDrive.of(tables)
        bodies = (
            Own(**{f.name: getattr(body, f.name) for f in dataclasses.fields(Helicoid)},
                own=tuple(mp.mpf(d.get(prefix + key, d.get(key, 0))) for key in own))
            for body, prefix in ((twin.worm, ""), (twin.hob, "hob_"))
        )  # fmt: skip
        twin.worm, twin.hob = bodies
        known = {name: float(values[0]) for name, values in contact.unknowns.items()}
        start = [known[name] for name in ("t_worm", "psi_worm", "t_hob", "psi_hob", "phi_hob")]
        start.append(float(contact.wheel_angles[0]))
        solved = chords(lambda x: twin.residual(x, mp.mpf(phi)), start, digits=20)
        return float(solved[5] - mp.mpf(phi) * twin.threads / twin.teeth)


def tables_of(own, errors=None, **tables):
    return {
        "drive": "cylindrical-worm", "name": "own", "flank": "right", "design": DESIGN | own, "blank": BLANK,
        "misalignment": errors or {}, **tables,
    }  # fmt: skip


@pytest.fixture
def drive(folder):
    def made(tables, backend="c"):
        return Drive.from_tables(tables, backend, folder)

    return made


@pytest.mark.parametrize("flank", ["right", "left"])
@pytest.mark.parametrize("errors", [{}, ERRORS], ids=["aligned", "misaligned"])
@pytest.mark.parametrize("own", [CROWNED, RELIEVED], ids=["crowned", "relieved"])
def test_the_error_is_that_of_forty_digits(drive, own, errors, flank):
    tables = tables_of(own, errors, flank=flank)
    made = drive(tables)
    for degrees in (-60.0, 10.0, 150.0):
        contact = made.tca([math.radians(degrees)])
        assert contact.status == ("converged",)
        expected = exact_error(tables, math.radians(degrees), contact)
        assert contact.error[0] == pytest.approx(expected, abs=1e-9 * ARCSEC)


def test_a_relieved_tip_touches_beyond_its_begin_and_only_there_differs_from_a_straight_blade(drive):
    angles = np.radians(np.arange(-60.0, 241.0, 20.0))
    relieved, straight = (drive(tables_of(RELIEVED | more)).tca(angles) for more in ({}, {"tip_relief_per_mm": 0.0}))
    plain = Drive.from_tables(tables_of({"worm_profile": "ZN"})).tca(angles)
    assert straight.error == pytest.approx(plain.error, abs=1e-13)
    on_relief = straight.unknowns["t_worm"] > 1.0
    assert on_relief.any() and not on_relief.all()
    assert relieved.error[~on_relief] == pytest.approx(plain.error[~on_relief], abs=1e-13)
    assert np.abs(relieved.error[on_relief] - plain.error[on_relief]).min() > 1e-9


def test_without_crown_the_flanks_are_involute_helicoids(drive):
    angles = np.radians([-90.0, 0.0, 90.0])
    plain = Drive.from_tables(tables_of({"worm_profile": "ZI"}, ERRORS)).tca(angles)
    ours = drive(tables_of({"worm_profile": "ZY"}, ERRORS)).tca(angles)
    assert ours.error == pytest.approx(plain.error, abs=1e-13)
    assert ours.points == pytest.approx(plain.points, abs=1e-9)


def test_the_hob_has_the_worms_crown_unless_it_has_its_own(drive):
    both = {"worm_profile": "ZY", "blade_crown_per_mm": 0.002}
    alike = drive(tables_of(both)).tca([0.3]).error[0]
    assert alike == drive(tables_of(both | {"hob_blade_crown_per_mm": 0.002})).tca([0.3]).error[0]
    assert alike != drive(tables_of(both | {"hob_blade_crown_per_mm": 0.0})).tca([0.3]).error[0]


def test_a_key_of_the_one_blade_is_refused_with_the_other(drive):
    with pytest.raises(DesignError, match="tip_relief_per_mm.* is a key of ZT"):
        drive(tables_of(CROWNED | {"tip_relief_per_mm": 0.1}))


@pytest.mark.parametrize("own", [CROWNED, RELIEVED], ids=["crowned", "relieved"])
def test_casadi_the_left_hand_and_the_sensitivity_to_the_own_key_agree_with_forty_digits(drive, own):
    tables, phi = tables_of(own), math.radians(150.0)
    contact = drive(tables).tca([phi])
    assert drive(tables, "casadi").tca([phi]).error == pytest.approx(contact.error, abs=1e-13)
    left = drive(tables | {"design": tables["design"] | {"hand": "left"}}).tca([-phi])
    assert left.error == pytest.approx(-contact.error, abs=1e-14)
    key = next(key for key in own if key.endswith("_per_mm"))
    found = sensitivity(drive(tables), [phi])
    ends = []
    for change in (-1e-6, 1e-6):
        moved = tables | {"design": tables["design"] | {key: own[key] + change}}
        ends.append(exact_error(moved, phi, drive(moved).tca([phi])))
    assert found.error[0, found.of(f"design.{key}")] == pytest.approx((ends[1] - ends[0]) / 2e-6, rel=1e-6)


def balls_of(tables, rounding):
    """Balls of a radius between the hob's own flank and the cylinder of its tip, as it cuts the wheel."""
    twin, d = WormDrive.of(tables), tables["design"]
    hob = Own(**{f.name: getattr(twin.hob, f.name) for f in dataclasses.fields(Helicoid)},
              own=(mp.mpf(d["hob_blade_crown_per_mm"]),))  # fmt: skip

    def centre(t):
        with mp.workdps(40):
            point, normal = hob.profile(mp.mpf(t))
            return np.array([float(p - rounding * n) for p, n in zip(point, normal, strict=True)])

    tip = d["hob_pitch_radius_mm"] + tables["blank"]["hob_tip_addendum_mm"]
    t = brentq(lambda t: np.hypot(*centre(t)[:2]) - tip + rounding, tip - 3.0 * rounding, tip)
    balls = object.__new__(Balls)
    balls.centre, balls.screw, balls.ratio = centre(t), float(hob.p), twin.hob_threads / twin.teeth
    balls.distance, balls.angle = float(twin.A_gen), float(twin.sigma_gen)
    return balls


def test_the_fillet_of_the_wheel_is_swept_by_balls_at_the_tip_of_its_hob(folder, tmp_path):
    """Points as far from the nearest place of a ball's centre as the rounding says."""
    tables = tables_of(CROWNED)
    path = tmp_path / "design.toml"
    path.write_text(designs.toml_text(tables | {"blank": BLANK | {"hob_tip_rounding_mm": 0.8}}), encoding="utf-8")
    shown = Commands(folder, path).json("surface", "--member", "wheel", "--region", "fillet", "--grid", "3x4")
    balls, points = balls_of(tables, 0.8), [point for point in shown["points_mm"] if point]
    assert len(points) == 12
    assert [balls.nearest(np.array(point)) for point in points] == pytest.approx([0.8] * 12, abs=1e-9)


def test_windows_of_contact_and_a_first_design(folder, tmp_path):
    path = tmp_path / "first.toml"
    words = ["new", "cylindrical-worm", "--m", "4", "--z", "2:40", "--profile", "ZY", "--out", str(path)]
    assert main(["--drives", str(folder), *words]) == 0
    found = Commands(folder, path).json("ratio", "--set", "design.blade_crown_per_mm=0.0005")
    assert found["begin"]["event"] and found["contact_ratio"] > 1.0


def test_rexs_has_no_word_for_an_own_blade_and_says_so(folder, tmp_path):
    """All else is written, and read again."""
    file, report = tmp_path / "design.rexs", tmp_path / "report.json"
    path = tmp_path / "design.toml"
    path.write_text(designs.toml_text(tables_of(CROWNED)), encoding="utf-8")
    Commands(folder, path)("export", "--rexs", file, "--json", report)
    unmapped = [entry for entry in json.loads(report.read_text(encoding="utf-8"))["unmapped"] if "attribute" in entry]
    reasons = [entry["reason"] for entry in unmapped if entry["attribute"] == "flank_form"]
    assert len(reasons) == 3 and all("no word for 'ZY'" in reason and "ZA, ZI, ZN" in reason for reason in reasons)
    assert 'id="number_of_teeth"' in file.read_text(encoding="utf-8")
