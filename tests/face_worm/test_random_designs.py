"""Designs drawn widely about the report's tables: 50 digits, the law of zero plunge, scaling of all lengths."""

import math

import mpmath
import numpy as np
import pytest

from meshwright import DesignError, Drive
from tests.face_worm.designs import NAMES, UNKNOWNS, independent
from tests.quick import quick

ARCSEC = math.pi / 648000
LENGTHS = ("axial_module_mm", "offset_mm", "worm_axial_position_mm", "worm_pitch_diameter_mm",
           "gear_inner_radius_mm", "gear_outer_radius_mm")  # fmt: skip


def _random(rng):
    """A drive and its misalignments; None where it cannot be made (undercut reference gear, no pitch point)."""
    name = str(rng.choice(NAMES))
    base = Drive.load(name)
    size = float(np.exp(rng.uniform(-1.2, 1.2)))
    design = {key: base.design.value(key) * size * float(rng.uniform(0.97, 1.03)) for key in LENGTHS}
    angle = (8.0, 15.0) if name.endswith("convex") else (25.0, 35.0)
    design |= {
        "worm_threads": int(rng.integers(1, 4)),
        "gear_teeth": int(rng.integers(45, 80)),
        "worm_cone_angle_deg": float(rng.uniform(0.0, 8.0)),
        "profile_angle_deg": float(rng.uniform(*angle)),
        "blade_parabola_per_mm": float(rng.uniform(0.004, 0.03)) / size,
        "plunge_mm_per_rad2": base.design.value("plunge_mm_per_rad2") * size * float(rng.uniform(0.3, 1.5)),
        "pitch_point_rule": str(rng.choice(["mid", "cones"])),
    }
    errors = {
        "offset_mm": float(rng.uniform(-0.1, 0.1)) * size,
        "axial_mm": float(rng.uniform(-0.1, 0.1)) * size,
        "shaft_angle_deg": float(rng.uniform(-0.05, 0.05)),
    }
    try:
        return base.with_(design=design, misalignment=errors)
    except DesignError:
        return None


@pytest.fixture(scope="module", params=quick([5, 60], 5))
def drives(request):
    rng = np.random.default_rng(20)
    found = []
    while len(found) < request.param:
        if (drive := _random(rng)) is not None:
            found.append(drive)
    return found


def test_double_precision_agrees_with_fifty_digits(drives):
    rng = np.random.default_rng(21)
    compared = 0
    for drive in drives:
        angle = float(rng.uniform(-1.0, 1.0)) * drive.pitch()
        unknowns, (status,) = drive.trace([angle])
        if status != "converged":
            continue
        error = drive.design.description["error"]
        start = [float(x) for x in unknowns[0]]
        start[error] += angle * drive.ratio
        with mpmath.workdps(50):
            twin = independent(drive)
            exact = twin.contact(mpmath.mpf(angle), start)
            wheel = exact[5] - mpmath.mpf(angle) * twin.ratio
            assert abs(wheel - mpmath.mpf(float(unknowns[0, error]))) < 3e-11 * ARCSEC
            scale = float(twin.module)
            for ours, theirs, unit in zip(unknowns[0, :5], exact, (scale, 1, 1, scale, 1), strict=False):
                assert abs(float(mpmath.mpf(float(ours)) - theirs)) < 1e-10 * unit
        compared += 1
    assert compared >= 0.97 * len(drives)


def test_without_plunge_and_errors_there_is_no_transmission_error(drives):
    for drive in drives[:40]:
        none = {"offset_mm": 0.0, "axial_mm": 0.0, "shaft_angle_deg": 0.0}
        conjugate = drive.with_(design={"plunge_mm_per_rad2": 0.0}, misalignment=none)
        unknowns, status = conjugate.trace(np.linspace(-1.0, 1.0, 5) * drive.pitch())
        assert set(status) == {"converged"}
        assert np.max(np.abs(unknowns[:, drive.design.description["error"]])) < 1e-9 * ARCSEC


def test_all_lengths_scale(drives):
    """Twice as large in every length and coefficient: equal angles and error, twice the unknown lengths."""
    for drive in drives[:40]:
        design = {key: 2 * drive.design.value(key) for key in (*LENGTHS, "plunge_mm_per_rad2")}
        design["blade_parabola_per_mm"] = drive.design.value("blade_parabola_per_mm") / 2
        errors = {key: 2 * drive.design.value(key, "misalignment") for key in ("offset_mm", "axial_mm")}
        angles = np.array([0.0, 0.4]) * drive.pitch()
        small, large = (d.tca(angles) for d in (drive, drive.with_(design=design, misalignment=errors)))
        both = small.solved & large.solved
        assert np.array_equal(small.solved, large.solved)
        assert np.allclose(small.error[both], large.error[both], rtol=0, atol=1e-9 * ARCSEC)
        for name in UNKNOWNS:
            factor = 2.0 if name.startswith("u_") else 1.0
            expected = factor * small.unknowns[name][both]
            assert np.allclose(expected, large.unknowns[name][both], rtol=0, atol=1e-10 * factor)
