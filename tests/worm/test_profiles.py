"""The flank forms are what ISO 10828 says they are, and turn into each other where they should."""

import numpy as np
import pytest

from meshwright import Drive
from tests.worm.designs import PROFILES, plain

#: Radii well inside every flank of the plain design (reference radius 20.4, base radius 9.7).
RADII = np.linspace(17.0, 24.0, 15)


def _drive(profile, **changes):
    return Drive.from_tables(plain(profile, **changes))


def _sizes(drive):
    value = drive.design.value
    return {
        "r": value("worm_pitch_radius_mm"),
        "lead": value("worm_lead_angle_deg"),
        "alpha": value("pressure_angle_deg"),
        "p": drive.design.sizes["screw_parameter_worm_mm_per_rad"],
        "S": drive.design.sizes["groove_width_mm"],
        "s": drive.design.flank,
    }


def _parameters(drive, radii):
    """Profile parameters at the given radii, by the secant rule on the generated profile."""
    profile = drive.function("profile_pinion")
    span = {key: float(v) for key, v in drive.function("profile_range_pinion")().items()}

    def radius(t):
        return np.hypot(*np.moveaxis(profile(t)["point"][..., :2], -1, 0))

    found = []
    for wanted in radii:
        a, b = span["pitch_point"], span["pitch_point"] + 0.05 * span["scale"] * drive.design.flank
        for _ in range(60):
            f, g = radius(a) - wanted, radius(b) - wanted
            if abs(g) < 1e-13 or f == g:
                break
            a, b = b, b - g * (b - a) / (g - f)
        found.append(b)
    return np.array(found)


def _axial(drive, radii=RADII):
    """Axial section f(ρ): height of the profile carried by the screw into the half plane y = 0."""
    return drive.function("profile_pinion")(_parameters(drive, radii))["axial"]


def _bend(points):
    """Largest distance of points (N, 3) from the line through the first and last."""
    chord = points[-1] - points[0]
    offset = points - points[0]
    along = np.outer(offset @ chord / (chord @ chord), chord)
    return np.linalg.norm(offset - along, axis=1).max()


@pytest.mark.parametrize("flank", ["right", "left"])
def test_za_is_straight_in_the_axial_section_and_no_other_form_is(flank):
    for profile in PROFILES:
        drive = _drive(profile, flank=flank)
        bend = _bend(np.column_stack([RADII, np.zeros_like(RADII), _axial(drive)]))
        assert (bend < 1e-12) == (profile == "ZA"), (profile, bend)


@pytest.mark.parametrize("flank", ["right", "left"])
def test_zn_is_straight_in_the_normal_section_of_the_thread_space_and_no_other_form_is(flank):
    for profile in PROFILES:
        drive = _drive(profile, flank=flank)
        bend = _bend(_normal_section(drive))
        assert (bend < 1e-12) == (profile == "ZN"), (profile, bend)


def _normal_section(drive):
    """Flank points (N, 3) in the plane through the common perpendicular x, turned by the lead angle about it."""
    size = _sizes(drive)
    points = []
    for t in _parameters(drive, RADII):
        x, y, z = drive.function("profile_pinion")(t)["point"]
        psi = 0.0
        for _ in range(60):  # the plane is y cos(lead) + z sin(lead) = 0
            c, s = np.cos(psi), np.sin(psi)
            height = (s * x + c * y) * np.cos(size["lead"]) + (z + size["p"] * psi) * np.sin(size["lead"])
            slope = (c * x - s * y) * np.cos(size["lead"]) + size["p"] * np.sin(size["lead"])
            psi -= height / slope
        c, s = np.cos(psi), np.sin(psi)
        points.append([c * x - s * y, s * x + c * y, z + size["p"] * psi])
    return np.array(points)


@pytest.mark.parametrize("flank", ["right", "left"])
def test_zi_is_straight_in_the_plane_that_touches_the_base_cylinder(flank):
    drive = _drive("ZI", flank=flank)
    size = _sizes(drive)
    base = size["r"] / np.sqrt(1 + (np.tan(size["alpha"]) / np.sin(size["lead"])) ** 2)
    assert drive.function("profile_range_pinion")()["lower_end"] == pytest.approx(base, abs=1e-12)
    f = _axial(drive)
    # carried into the plane x = base on the side on which the generator lies
    angle = size["s"] * np.arccos(base / RADII)
    line = np.column_stack([RADII * np.cos(angle), RADII * np.sin(angle), f + size["p"] * angle])
    assert _bend(line) < 1e-12
    rise = (line[-1, 2] - line[0, 2]) / (line[-1, 1] - line[0, 1])
    assert rise == pytest.approx(size["p"] / base, rel=1e-12)


@pytest.mark.parametrize("flank", ["right", "left"])
@pytest.mark.parametrize(
    ("form", "curved", "limit", "gap"),
    [("ZK", "grinding_wheel_radius_mm", "ZI", 1e-6), ("ZC", "profile_arc_radius_mm", "ZK", 1e-5)],
)
def test_a_form_tends_to_its_limit_at_first_order_in_the_curvature_of_disc_or_arc(form, curved, limit, gap, flank):
    target = _axial(_drive(limit, flank=flank))
    radii = (1e4, 1e5, 1e6, 1e7)
    gaps = [np.abs(_axial(_drive(form, flank=flank, **{curved: radius})) - target).max() for radius in radii]
    assert np.allclose(np.divide(gaps[:-1], gaps[1:]), 10.0, rtol=0.02)
    assert gaps[-1] < gap


@pytest.mark.parametrize("radius", [40.0, 200.0, 3000.0])
@pytest.mark.parametrize("flank", ["right", "left"])
def test_zk_and_zi_of_equal_data_touch_along_one_helix_whatever_the_disc(flank, radius):
    zk, zi = _drive("ZK", flank=flank, grinding_wheel_radius_mm=radius), _drive("ZI", flank=flank)
    size = _sizes(zk)
    half, a = size["S"] / 2, size["alpha"]
    helix = np.hypot(
        size["r"] - half * np.sin(a) * np.cos(a), half * np.cos(a) ** 2 * np.sin(size["lead"])
    )
    ground, straight = zk.function("profile_pinion")(0.0), zi.function("profile_pinion")(helix)
    assert np.hypot(*ground["point"][:2]) == pytest.approx(helix, abs=1e-12)
    assert ground["axial"] == pytest.approx(float(straight["axial"]), abs=1e-12)
    turn = np.arctan2(ground["point"][1], ground["point"][0])
    c, s = np.cos(turn), np.sin(turn)
    n = straight["normal"]
    assert np.allclose(ground["normal"], [c * n[0] - s * n[1], s * n[0] + c * n[1], n[2]], atol=1e-12)


@pytest.mark.parametrize("flank", ["right", "left"])
@pytest.mark.parametrize("profile", PROFILES)
def test_every_form_is_a_helicoid(profile, flank):
    """The normal resists no motion in the flank's own screw: n·(k × r + p k) = 0."""
    drive = _drive(profile, flank=flank)
    at = drive.function("profile_pinion")(_parameters(drive, RADII))
    (x, y, _), (a, b, c) = np.moveaxis(at["point"], -1, 0), np.moveaxis(at["normal"], -1, 0)
    assert np.abs(-a * y + b * x + _sizes(drive)["p"] * c).max() < 1e-13


@pytest.mark.parametrize("flank", ["right", "left"])
@pytest.mark.parametrize("profile", PROFILES)
def test_the_groove_has_its_width_at_its_middle(profile, flank):
    """The normal groove width at the reference cylinder is S for every form (to the disc's size for ground ones)."""
    drive = _drive(profile, flank=flank)
    size = _sizes(drive)
    axial = size["s"] * float(_axial(drive, [size["r"]])[0]) * np.cos(size["lead"])
    assert axial == pytest.approx(size["S"] / 2, abs=0.02)
