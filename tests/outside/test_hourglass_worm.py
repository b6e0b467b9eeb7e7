"""An hourglass worm ground by a plane, a file outside the tree: commands against an own formulation in mpmath.

The independent formulation knows the plane and two turning axes. The worm is the envelope of the plane under a relative
motion whose velocity is a difference of positions in 40 digits; contact is common point and common normal.
"""

import json
import math

import mpmath
import numpy as np
import pytest

from meshwright import Drive
from meshwright.contact.results import ARCSEC
from meshwright.fe.closed_body import solid_body
from meshwright.fe.thread_flanks import threads
from meshwright.flank.patches import triangulated
from meshwright.sensitivity import sensitivity
from tests.independent.vectors import cross

pytestmark = pytest.mark.validate

DESIGN = {
    "worm_threads": 1, "wheel_teeth": 40, "center_distance_mm": 125.0, "wheel_pitch_radius_mm": 100.0,
    "pressure_angle_deg": 22.0, "tooth_inclination_deg": 8.0, "wheel_crowning_per_mm": 0.001,
}  # fmt: skip
TABLES = {"drive": "hourglass-worm", "name": "hourglass", "design": DESIGN}
ALPHA, BETA = math.radians(22.0), math.radians(8.0)
ERRORS = {"center_distance_mm": 0.05, "shaft_angle_deg": 0.02, "axial_mm": -0.03}


class Twin:
    """The pair in mpmath: unknowns (u, w, θ) of the worm, (U, W) of the wheel, and the wheel's angle."""

    def __init__(self, sign, errors):
        degrees = mpmath.pi / 180
        self.s, self.alpha, self.beta = sign, 22 * degrees, 8 * degrees
        self.normal = mpmath.matrix([
            -mpmath.sin(self.alpha), sign * mpmath.cos(self.alpha) * mpmath.cos(self.beta),
            sign * mpmath.cos(self.alpha) * mpmath.sin(self.beta),
        ])  # fmt: skip
        self.along = mpmath.matrix([0, -mpmath.sin(self.beta), mpmath.cos(self.beta)])
        self.up = mpmath.matrix([-sign * self.normal[1], sign * self.normal[0], 0])
        self.up /= mpmath.norm(self.up)
        half = mpmath.pi / 80
        self.foot = mpmath.matrix([-100 * mpmath.cos(half), 100 * sign * mpmath.sin(half), 0])
        self.da, self.db = (mpmath.mpf(errors.get(key, 0)) for key in ("center_distance_mm", "axial_mm"))
        self.dsigma = mpmath.mpf(errors.get("shaft_angle_deg", 0)) * degrees

    def wheel(self, u, w, crown):
        """Point and normal of a tooth flank, wheel at rest."""
        point = self.foot + u * self.up + w * self.along - crown * (u**2 + w**2) * self.normal
        slopes = [direction - 2 * crown * q * self.normal for q, direction in ((u, self.up), (w, self.along))]
        return point, cross(*slopes)

    @staticmethod
    def into_worm(point, theta, turn, a=125, shaft=0, axial=0, direction=False):
        """From the wheel, turned by −turn about its axis, to a worm that has turned by θ."""
        x, y, z = point
        c, d = mpmath.cos(turn), mpmath.sin(turn)
        x, y, z = x * c + y * d, -x * d + y * c, z + (0 if direction else axial)
        # wheel axis to (0, sin Σ, cos Σ)
        c, d = mpmath.cos(mpmath.pi / 2 + shaft), mpmath.sin(mpmath.pi / 2 + shaft)
        x, y, z = x + (0 if direction else a), y * c + z * d, -y * d + z * c
        c, d = mpmath.cos(theta), mpmath.sin(theta)
        return mpmath.matrix([x * c + y * d, -x * d + y * c, z])

    def worm(self, u, w, theta):
        """Point, normal and the equation of meshing of the worm's thread."""
        point, step = self.foot + u * self.up + w * self.along, mpmath.mpf(10) ** -13

        def at(angle):
            return self.into_worm(point, angle, angle / 40)

        normal = self.into_worm(self.normal, theta, theta / 40, direction=True)
        velocity = (at(theta + step) - at(theta - step)) / (2 * step)
        return at(theta), normal, sum(a * b for a, b in zip(normal, velocity, strict=True))

    def residual(self, phi, crown):
        def of(u, w, theta, up, across, turn):
            worm, n, meshing = self.worm(u, w, theta)
            point, normal = self.wheel(up, across, crown)
            there = self.into_worm(point, phi, turn, 125 + self.da, self.dsigma, self.db)
            normal = self.into_worm(normal, phi, turn, shaft=self.dsigma, direction=True)
            gap, twist = worm - there, cross(n, normal)
            return [*gap, twist[0], twist[2], meshing / 100]

        return of


def exact_error(sign, errors, phi, contact, crown=0.001):
    """The transmission error, rad, found from the contact of a solved drive rounded to four digits."""
    with mpmath.workdps(40):
        twin = Twin(sign, errors)
        names = ("u_tool", "w_tool", "theta_worm", "u_wheel", "w_wheel")
        start = [mpmath.mpf(f"{float(contact.unknowns[name][0]):.4g}") for name in names]
        start.append(mpmath.mpf(phi) / 40)
        solved = mpmath.findroot(twin.residual(mpmath.mpf(phi), mpmath.mpf(crown)), start, tol=1e-30, maxsteps=30)
        return float(solved[5] - mpmath.mpf(phi) / 40)


@pytest.mark.parametrize("errors", [{}, ERRORS], ids=["aligned", "misaligned"])
@pytest.mark.parametrize("flank", ["left", "right"])
def test_the_error_is_that_of_forty_digits(drive, flank, errors):
    made = drive(flank=flank, misalignment=errors)
    for angle in (-2.0, 0.5):
        contact = made.tca([angle])
        assert contact.status == ("converged",)
        expected = exact_error(1 if flank == "left" else -1, errors, angle, contact)
        assert contact.error[0] == pytest.approx(expected, abs=1e-9 * ARCSEC)


def test_without_crowning_the_flanks_touch_along_lines_without_error(drive):
    result = drive(design=DESIGN | {"wheel_crowning_per_mm": 0.0}).tca([0.0, 1.5])
    assert set(result.status) == {"line_contact"}
    assert np.abs(result.error).max() < 1e-9 * ARCSEC


def test_the_left_hand_and_casadi_agree(drive, folder):
    right = drive(misalignment=ERRORS).tca([-1.0, 1.0])
    left = drive(design=DESIGN | {"hand": "left"}, misalignment=ERRORS).tca([-1.0, 1.0])
    assert left.error == pytest.approx(-right.error[::-1], abs=1e-14)
    casadi = Drive.from_tables(TABLES | {"misalignment": ERRORS}, "casadi", folder).tca([-1.0, 1.0])
    assert casadi.error == pytest.approx(right.error, abs=1e-13)


def test_sensitivities_are_differences_in_forty_digits(drive):
    """Central differences of the independent formulation, over 2 µm."""
    made, step = drive(), 1e-3
    found = sensitivity(made, [0.5])
    for key, unit in (("center_distance_mm", 1.0), ("axial_mm", 1.0), ("shaft_angle_deg", math.radians(1.0))):
        ends = [exact_error(1, {key: h}, 0.5, drive(misalignment={key: h}).tca([0.5])) for h in (-step, step)]
        slope = (ends[1] - ends[0]) / (2 * step * unit)
        assert found.error[0, found.of(f"misalignment.{key}")] == pytest.approx(slope, rel=1e-5)


def test_worm_points_are_touched_by_the_plane_alone_once(run):
    """Every point of the thread lies on the plane tooth at its own angle and on no deeper one beside it."""
    shown = run.json("surface", "--member", "pinion", "--grid", "4x9")
    twin = Twin(1, {})
    points = [(p, q) for p, q in zip(shown["points_mm"], shown["parameter_values"], strict=True) if p]
    assert len(points) > 20
    for point, (_, theta) in points:
        depth = []
        for angle in (theta - 1e-3, theta, theta + 1e-3):
            plane = twin.into_worm(twin.foot, angle, angle / 40)
            normal = twin.into_worm(twin.normal, angle, angle / 40, direction=True)
            depth.append(float(sum(n * (a - b) for n, a, b in zip(normal, point, plane, strict=True))))
        assert abs(depth[1]) < 1e-9
        assert (depth[0] - depth[1]) * (depth[2] - depth[1]) > 0 or abs(depth[0] - depth[2]) < 1e-9


def test_ratio_limits_sweep_and_report_are_written(run, tmp_path):
    """Five teeth touch at once, as many as an hourglass worm of this length has."""
    found = run.json("ratio")
    assert 4.0 < found["contact_ratio"] < 7.0 and found["begin"]["event"] == "face"
    assert run.json("limits")["meshing_axes_exist"] is False
    run("sweep", "--vary", "misalignment.axial_mm=-0.05:0.05", "--grid", 3, "--out", tmp_path / "rows", "--phi-deg", 0)
    run("report", "--html", tmp_path / "hourglass.html")


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (("surface", "--member", "wheel", "--region", "fillet", "--json", "-"), "no fillet of 'wheel'"),
        (("surface", "--member", "pinion", "--region", "fillet"), "its description makes flank of pinion"),
        (("surface", "--member", "pinion", "--solid", "--stl", "-"), "million facets are off the flanks of the pinion"),
        (("loaded", "--torque-nm", "50", "--set", "design.worm_threads=2"), "from its middle is not whole: the flank"),
    ],
)
def test_what_its_page_does_not_describe_is_refused_with_the_reason(run, capsys, words, reason):
    run(*words, status=2)
    assert reason in capsys.readouterr().err


def test_pairs_beyond_the_ends_of_its_thread_are_refused(run, tmp_path, capsys):
    """Four turns from its middle the torus of its root ends before the thread does."""
    run("fe", "--torque-nm", "50", "--phi-deg", "0", "--folder", tmp_path / "fe", status=2)
    said = capsys.readouterr().err
    assert "4 pitches from its middle is not whole" in said and "--pairs" in said


@pytest.mark.parametrize(("member", "teeth"), [("pinion", 1), ("wheel", 2)])
def test_its_margins_make_closed_bodies(drive, member, teeth):
    """The worm lies between the tori of its tip and root, to its ends; the wheel between its own cylinders."""
    patches, departure = solid_body(drive(), member, teeth).splined(1e-3)
    _, triangles = triangulated(patches)
    there = np.concatenate([triangles[:, pair] for pair in ([0, 1], [1, 2], [2, 0])])
    assert departure < 1e-3
    assert set(map(tuple, there.tolist())) == set(map(tuple, there[:, ::-1].tolist()))
    points = np.concatenate([p.points.reshape(-1, 3) for p in patches if p.kind in ("flank", "tip", "land")])
    radius, z = np.hypot(points[:, 0], points[:, 1]), points[:, 2]
    height = drive().design.value("addendum_mm", "blank")
    if member == "pinion":
        assert (-z.min(), z.max()) == pytest.approx((50.0, 50.0), abs=1e-9)
        least, most, height_of = 100.0 - height, 100.0 + 1.2 * height, np.hypot(125.0 - radius, z)
    else:
        least, most, height_of = 100.0 - 1.2 * height, 100.0 + height, radius
    assert (height_of.min(), height_of.max()) == pytest.approx((least, most), abs=1e-6)


def _envelope(points, sign):
    """How far points (N, 3) of the worm are from the nearest plane that is its tool's at some angle, and leave it.

    Beside it is none that is deeper: the depth over the angle is stationary there.
    """
    half = math.pi / 80
    normal = np.array([-math.sin(ALPHA), sign * math.cos(ALPHA) * math.cos(BETA),
                       sign * math.cos(ALPHA) * math.sin(BETA)])  # fmt: skip
    foot = np.array([-100.0 * math.cos(half), 100.0 * sign * math.sin(half), 0.0])

    def depth(theta):
        """Of points in the wheel's frame, the inverse of Twin.into_worm."""
        x, y, z = points.T if theta.ndim == 1 else points.T[:, :, None]
        c, s = np.cos(theta), np.sin(theta)
        x, y, z = x * c - y * s - 125.0, -z, x * s + y * c
        c, s = np.cos(theta / 40.0), np.sin(theta / 40.0)
        found = np.stack([x * c - y * s, x * s + y * c, z], axis=-1)
        return (found - foot) @ normal

    step = 1e-4
    grid = -np.arctan2(points[:, 1], points[:, 0])[:, None] + np.linspace(-30.0, 30.0, 6001)
    values = depth(grid)
    turns = np.diff(np.sign(np.diff(values, axis=1)), axis=1) != 0.0
    away = np.where(turns, np.abs(values[:, 1:-1]), np.inf)
    theta = np.take_along_axis(grid[:, 1:-1], away.argmin(axis=1)[:, None], axis=1)[:, 0]
    for _ in range(8):
        low, here, high = (depth(theta + h) for h in (-step, 0.0, step))
        theta = theta - (high - low) * step / (2.0 * (high - 2.0 * here + low))
    return np.abs(depth(theta))


def _above(points):
    """Distance of points (..., 3) from the circle in which the wheel's axis would stand about the worm's, mm."""
    return np.hypot(125.0 - np.hypot(points[..., 0], points[..., 1]), points[..., 2])


@pytest.mark.parametrize("angle", [-20.0, 0.0, 8.0])
def test_its_thread_goes_from_an_arc_on_the_torus_of_its_root_to_that_of_its_tip(drive, angle):
    """In half planes, at the throat and near both ends; the flanks between are the envelope of the plane."""
    form = threads(drive(), "pinion", 10.0).at(angle)
    values, height, rounding = np.linspace(*form.faces, 5), 3.5, 1.0
    for name, sign in (("right", 1.0), ("left", -1.0)):
        side = form.side(name)
        arcs = side.fillet.points(values, np.tile(np.linspace(0.0, 1.0, 7), (5, 1)))
        ends = np.stack([side.flank.first(values), side.flank.last(values)], axis=1)
        flank = side.flank.points(values, ends[:, :1] + (ends[:, 1:] - ends[:, :1]) * np.linspace(0.0, 1.0, 9))
        assert _above(arcs[:, 0]) == pytest.approx(100.0 + 1.2 * height, abs=1e-9)
        assert _above(flank[:, -1]) == pytest.approx(100.0 - height, abs=1e-9)
        assert np.abs(arcs[:, -1] - flank[:, 0]).max() < 1e-6
        plane = [np.stack([np.hypot(p[..., 0], p[..., 1]), p[..., 2]], axis=-1) for p in (arcs, flank)]
        inward = np.array([125.0, 0.0]) - plane[0][:, 0]
        centres = plane[0][:, 0] + rounding * inward / np.linalg.norm(inward, axis=1)[:, None]
        away = [np.linalg.norm(p - centres[:, None], axis=2) for p in plane]
        assert away[0] == pytest.approx(rounding, abs=1e-6)
        # flank and arc have one tangent, at right angles to the radius of the arc
        step = np.linalg.norm(plane[1][:, 1] - plane[1][:, 0], axis=1)
        assert away[1][:, 1] == pytest.approx(np.hypot(rounding, step), rel=5e-3)
        assert _envelope(flank.reshape(-1, 3), sign).max() < 1e-6


def test_under_load_its_pairs_carry_the_torque_at_the_pressure_of_hertz(run):
    """Levers about the wheel's axis are those of the rigid contacts, each pair a turn of the worm after the next."""
    (point,) = run.json("loaded", "--torque-nm", 50, "--phi-deg", 0)["points"]
    pairs = [pair for pair in point["pairs"] if pair["force_n"] > 0.0]
    angles = [-360.0 * pair["pairs_later"] for pair in pairs]
    rigid = run.json("tca", f"--phi-deg={','.join(map(str, angles))}")["points"]
    total = 0.0
    for pair, contact in zip(pairs, rigid, strict=True):
        arm = np.cross(np.array(contact["contact_point_mm"]) - [125.0, 0.0, 0.0], contact["contact_normal"])[1]
        total += pair["force_n"] * abs(arm)
        assert pair["peak_pressure_mpa"] == pytest.approx(pair["hertz_pressure_mpa"], rel=0.01)
    assert len(pairs) == 3 and total == pytest.approx(50_000.0, rel=1e-4)


def test_the_audit_entry_says_what_is_proved(folder):
    entry = json.loads((folder / "audit" / "hourglass_worm.json").read_text(encoding="utf-8"))
    assert set(entry["checked"].values()) == {"holds"} and entry["not_proved"] == {}
    assert "derivation/envelope" in entry["proved"]
