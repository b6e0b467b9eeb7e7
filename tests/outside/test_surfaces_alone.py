"""Drives outside the tree of which nothing is said but surfaces, motions and limits: a face gear, a cycloidal disc in a
ring of pins, beveloids, and a Hindley worm with a wheel cut by an hourglass hob.

Where they are undercut is written out once more here, at 40 digits.
"""

import json
import math

import mpmath as mp
import numpy as np
import pytest

from meshwright import Drive
from meshwright.design import design as designs
from meshwright.limits.results import Request
from tests.outside.folder import FILES, Commands, answered

pytestmark = pytest.mark.validate

FACE_GEAR = {
    "drive": "face-gear",
    "design": {
        "module_mm": 6.35, "pressure_angle_deg": 25.0, "pinion_teeth": 25, "shaper_teeth": 28, "wheel_teeth": 160
    },
}  # fmt: skip
PINS = {
    "drive": "pin-wheel",
    "design": {
        "disc_lobes": 11, "ring_pins": 12, "pin_circle_radius_mm": 50.0, "pin_radius_mm": 6.0, "eccentricity_mm": 1.5,
        "face_width_mm": 12.0,
    },
}  # fmt: skip
BEVELOID = {
    "drive": "beveloid",
    "design": {
        "normal_module_mm": 3.0, "pressure_angle_deg": 20.0, "pinion_teeth": 24, "wheel_teeth": 36,
        "pinion_cone_angle_deg": 10.0, "wheel_cone_angle_deg": 12.0, "face_width_mm": 20.0,
    },
}  # fmt: skip


def changed(tables, **design):
    return tables | {"design": tables["design"] | design}


def undercut(tables, folder, member, grid=9):
    limits = Drive.from_tables(tables, drives=folder).limits(Request(grid=grid))
    assert "undercut" not in limits.omitted
    return [line for line in limits.undercut if line.member == member]


def face_gear_undercut(m, alpha, n_s, n_2):
    """Radius at which the rounded tip of the shaper, 1.25 modules high and m/5 round, begins to undercut a spur face
    gear at 90° (Litvin, Fuentes, chapter 18): the root met coming inwards.
    """
    with mp.workdps(40):
        m, base = mp.mpf(m), mp.mpf(m) * n_s / 2 * mp.cos(mp.radians(alpha))
        tip, rho, k = m * n_s / 2 + m * 5 / 4, m / 5, mp.mpf(n_2) / n_s
        t = (rho + mp.sqrt((tip - rho) ** 2 - base**2)) / base
        u = mp.findroot(lambda u: (k * u) ** 2 * (1 + u**2) - t * (t - u), (0, 0.9), solver="anderson")
        return float(base * mp.sqrt(k**2 * (1 + u**2) + (t - u) ** 2 / (1 + u**2)))


def test_a_face_gear_is_undercut_where_the_book_has_it(derivation):
    assert face_gear_undercut(6.35, 25, 28, 160) == pytest.approx(464.990528916746, abs=1e-10)
    rng = np.random.default_rng(5)
    cases = [(6.35, 25.0, 25, 28, 160), (3.0, 25.0, 25, 28, 160)]
    cases += [(float(rng.uniform(1, 8)), float(rng.uniform(20, 27)), n, n + 3, n * 5 + 7) for n in (19, 23)]
    for m, alpha, n_1, n_s, n_2 in cases:
        keys = {"module_mm": m, "pressure_angle_deg": alpha, "pinion_teeth": n_1, "shaper_teeth": n_s}
        lines = undercut(changed(FACE_GEAR, **keys, wheel_teeth=n_2), derivation("face_gear"), "wheel")
        radii = [math.hypot(*line.point[:2]) for line in lines]
        assert max(radii) == pytest.approx(face_gear_undercut(m, alpha, n_s, n_2), rel=1e-11)
        # nothing of the other root, whose points lie above the tips of the gear
        assert all(line.point[2] <= m - m * n_s / 2 + 1e-9 for line in lines)


def test_a_cycloidal_disc_is_undercut_by_larger_pins_than_its_least_curvature_allows(derivation):
    for radius, cut in ((17.3834, False), (17.3835, True)):
        lines = undercut(changed(PINS, pin_radius_mm=radius), derivation("pin_wheel"), "pinion", 3)
        assert any(line.on_flank for line in lines) == cut


def test_a_beveloid_is_undercut_on_its_base_cylinder(derivation):
    for member, teeth, cone in (("pinion", 24, 10.0), ("wheel", 36, 12.0)):
        tangent = math.tan(math.radians(20.0)) * math.cos(math.radians(cone))
        lines = undercut(BEVELOID, derivation("beveloid"), member)
        assert lines and [math.hypot(*line.point[:2]) for line in lines] == pytest.approx(
            [1.5 * teeth / math.hypot(1.0, tangent)] * len(lines), rel=1e-11
        )


def test_aligned_beveloids_and_pins_transmit_without_error(derivation):
    """Both are conjugate: the rack is common to both beveloids; the disc is the envelope of the pins."""
    for tables, name in ((BEVELOID, "beveloid"), (PINS, "pin_wheel"), (FACE_GEAR, "face_gear")):
        drive = Drive.from_tables(tables, drives=derivation(name))
        error = drive.tca(np.radians([-3.0, 0.0, 3.0])).error
        assert np.abs(error).max() < 1e-14
        teeth = [tables["design"][key] for key in tables["design"] if key.endswith(("_teeth", "_lobes", "_pins"))]
        assert (drive.teeth("pinion"), drive.teeth("wheel")) == (teeth[0], teeth[-1])


def test_the_audit_holds_of_a_wheel_cut_by_an_hourglass_hob(derivation):
    found = json.loads((derivation("hindley_worm") / "audit" / "hindley_worm.json").read_text(encoding="utf-8"))
    assert set(found["checked"].values()) == {"holds"}


def test_a_report_names_members_whatever_their_teeth_are_called(derivation, tmp_path):
    design = tmp_path / "design.toml"
    design.write_text(designs.toml_text(PINS), encoding="utf-8")
    Commands(derivation("pin_wheel"), design)("report", "--html", tmp_path / "page.html")
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert "radius on which the pins lie" in page and "pins of the ring" in page


WRONG = {
    "cutting for one tooth more": ("cutting = Rz(-N_s / N_2 * phi_s)", "cutting = Rz(-N_s / (N_2 + 1) * phi_s)"),
    "motion for one tooth more": ("@ Rz(phi_2),", "@ Rz(N_1 / (N_2 + 1) * phi_1 + error),"),
    "motion turned round": ("phi_2 = ratio * phi_1 + error", "phi_2 = error - ratio * phi_1"),
    "size of twice the ratio": ("instant=phi_1,", 'sizes=(("ratio", 2 * N_1 / N_2, "twice"),), instant=phi_1,'),
}


@pytest.mark.parametrize("case", WRONG)
def test_another_ratio_is_refused(case, tmp_path):
    page = (FILES / "face_gear.py").read_text(encoding="utf-8")
    old, new = WRONG[case]
    assert old in page
    (tmp_path / "face_gear.py").write_text(page.replace(old, new), encoding="utf-8")
    done = answered(tmp_path / "face_gear.py", tmp_path / "out")
    assert done.returncode == 2 and "Traceback" not in done.stderr
    assert "the motion of the wheel" in done.stderr and "face_gear.py, line" in done.stderr
