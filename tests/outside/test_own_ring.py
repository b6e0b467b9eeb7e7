"""A crowned pinion in an internal gear, a file outside the tree: a member whose teeth point to its axis.

Closed forms of involute pairs (ISO 21771:2007, internal gears) and an own formulation in mpmath, which knows positions
alone: its normals are cross products of differences in 40 digits.
"""

import json
import math

import mpmath
import numpy as np
import pytest

from meshwright import Drive
from meshwright.base.errors import DesignError
from meshwright.cli import main
from meshwright.contact.results import ARCSEC
from meshwright.fe.closed_body import closed_body
from meshwright.sensitivity import sensitivity
from meshwright.shop.balls import sizes
from tests.independent.vectors import cross, dot

pytestmark = pytest.mark.validate

M, T, BETA, F, CROWN = 2.0, (30, 72), math.radians(12.0), 20.0, 0.02
R = tuple(M * t / (2 * math.cos(BETA)) for t in T)
ALPHA_T = math.atan(math.tan(math.radians(20.0)) / math.cos(BETA))
R_B = tuple(r * math.cos(ALPHA_T) for r in R)
DESIGN = {
    "normal_module_mm": M, "pressure_angle_deg": 20.0, "helix_angle_deg": 12.0, "pinion_teeth": T[0],
    "wheel_teeth": T[1], "face_width_mm": F, "pinion_lead_crowning_um": 1000 * CROWN,
}  # fmt: skip
TABLES = {"drive": "own-ring", "name": "ring", "design": DESIGN}
ERRORS = {"center_distance_mm": 0.05, "out_of_plane_deg": 0.03, "in_plane_deg": -0.02}


def inv(angle):
    return math.tan(angle) - angle


def spur(**more):
    return {"design": DESIGN | {"helix_angle_deg": 0.0} | more}


# -- the involute pair -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("hand", ["right", "left"])
@pytest.mark.parametrize("flank", ["left", "right"])
def test_aligned_flanks_roll_without_error_in_the_middle_of_the_face(drive, flank, hand):
    result = drive(flank=flank, design=DESIGN | {"hand": hand}).tca(np.radians(np.linspace(-12.0, 4.0, 9)))
    assert set(result.status) == {"converged"}
    assert np.abs(result.error).max() < 1e-9 * ARCSEC
    assert np.abs(result.points[:, 2]).max() < 1e-9
    moment = np.cross(result.points, result.normals)[:, 2]
    sine = math.sin(BETA) * math.cos(math.radians(20.0))
    assert np.abs(moment) == pytest.approx(R_B[0] * math.sqrt(1 - sine**2), abs=1e-11)


@pytest.mark.parametrize(("flank", "sign"), [("left", 1.0), ("right", -1.0)])
def test_a_smaller_distance_opens_a_gap_of_the_involute_functions(drive, flank, sign):
    """cos α_w = (r_b2 − r_b1)/a; the pinion turns on by the difference of the involute functions times 1 − z1/z2."""
    change = -0.2
    working = math.acos((R_B[1] - R_B[0]) / (R[1] - R[0] + change))
    (error,) = drive(flank=flank, misalignment={"center_distance_mm": change}).tca([0.0]).error
    assert error == pytest.approx(sign * (1 - T[0] / T[1]) * (inv(working) - inv(ALPHA_T)), abs=1e-9 * ARCSEC)


def test_the_curvatures_are_those_of_the_two_involutes_and_of_the_crowning(drive):
    """Spur gears: 1/ϱ1 − 1/ϱ2 across the tooth, 8 C/b² along it (ISO 21771; ϱ2 = ϱ1 + a sin α)."""
    angles = np.radians([-6.0, -3.0, 0.0])
    result = drive(**spur()).tca(angles)
    first = M * T[0] / 2 * math.cos(math.radians(20.0))
    roll = math.tan(math.radians(20.0)) + angles + math.pi / (2 * T[0])
    other = first * roll + M * (T[1] - T[0]) / 2 * math.sin(math.radians(20.0))
    assert result.curvatures[:, 1] == pytest.approx(1 / (first * roll) - 1 / other, rel=1e-9)
    assert result.curvatures[:, 0] == pytest.approx(np.full(3, 8 * CROWN / F**2), rel=1e-9)


def test_the_contact_ratio_is_the_length_of_action_over_the_base_pitch(run):
    """From the tip of the internal gear, its smallest radius, to that of the pinion."""
    tips = R[0] + M, R[1] - M
    words = ("--set", f"blank.wheel_form_radius_mm={R[1] + 1.1 * M}")
    a = R[1] - R[0]
    length = math.sqrt(tips[0] ** 2 - R_B[0] ** 2) - math.sqrt(tips[1] ** 2 - R_B[1] ** 2) + a * math.sin(ALPHA_T)
    found = run.json("ratio", *words)
    assert (found["begin"]["event"], found["begin"]["member"]) == ("tip", "wheel")
    assert (found["end"]["event"], found["end"]["member"]) == ("tip", "pinion")
    assert found["contact_ratio"] == pytest.approx(length / (2 * math.pi * R_B[0] / T[0]), abs=1e-9)
    assert found["backlash_arcsec"] == pytest.approx(0.0, abs=1e-6)


def test_backlash_is_the_room_between_both_flanks_and_negative_where_they_jam(run):
    for change in (-0.05, 0.05):
        working = math.acos((R_B[1] - R_B[0]) / (R[1] - R[0] + change))
        room = 2 * (1 - T[0] / T[1]) * (inv(ALPHA_T) - inv(working)) / ARCSEC
        found = run.json("ratio", "--set", f"misalignment.center_distance_mm={change}")
        assert found["backlash_arcsec"] == pytest.approx(room, abs=1e-6)


# -- misaligned: an own formulation ------------------------------------------------------------------------------------


class Twin:
    """Positions of both flanks in mpmath; unknowns: roll and height of either, and the wheel angle."""

    def __init__(self, sign, errors):
        self.s, degrees = sign, mpmath.pi / 180
        self.da = mpmath.mpf(errors.get("center_distance_mm", 0))
        self.dx, self.dy = (errors.get(key, 0) * degrees for key in ("out_of_plane_deg", "in_plane_deg"))
        self.beta, self.alpha = 12 * degrees, 20 * degrees
        self.tangent = mpmath.tan(self.alpha) / mpmath.cos(self.beta)
        self.r = [2 * mpmath.mpf(t) / (2 * mpmath.cos(self.beta)) for t in T]

    def flank(self, k, roll, z, turn, crown):
        """A point of member k, turned about its own axis."""
        base = self.r[k] / mpmath.sqrt(1 + self.tangent**2)
        half = mpmath.pi / (2 * T[k]) + self.tangent - mpmath.atan(self.tangent) - roll + mpmath.atan(roll)
        angle = self.s * half + z * mpmath.tan(self.beta) / self.r[k] + turn
        angle -= self.s * crown / base * (z / 10) ** 2
        radius = base * mpmath.sqrt(1 + roll**2)
        return mpmath.matrix([radius * mpmath.cos(angle), radius * mpmath.sin(angle), z])

    def pinion(self, roll, z, phi):
        return self.flank(0, roll, z, phi, mpmath.mpf(CROWN))

    def wheel(self, roll, z, phi):
        x, y, z = self.flank(1, roll, z, phi, 0)
        c, d = mpmath.cos(self.dy), mpmath.sin(self.dy)
        x, z = c * x + d * z, c * z - d * x
        c, d = mpmath.cos(self.dx), mpmath.sin(self.dx)
        return mpmath.matrix([x - (self.r[1] - self.r[0] + self.da), c * y - d * z, d * y + c * z])

    def residual(self, phi):
        step = mpmath.mpf(10) ** -15

        def slopes(surface, u, w, turn):
            return [(surface(*hi, turn) - surface(*lo, turn)) / (2 * step)
                    for hi, lo in (((u + step, w), (u - step, w)), ((u, w + step), (u, w - step)))]  # fmt: skip

        def of(u, w, p, q, turn):
            apart = self.pinion(u, w, phi) - self.wheel(p, q, turn)
            a, b = slopes(self.wheel, p, q, turn)
            normal = cross(a, b)
            return [*apart, *(dot(normal, way) for way in slopes(self.pinion, u, w, phi))]

        return of


def exact_error(sign, errors, phi, contact):
    """The transmission error, rad, found from the contact of a solved drive rounded to four digits."""
    with mpmath.workdps(40):
        start = [mpmath.mpf(f"{float(contact.unknowns[name][0]):.4g}")
                 for name in ("roll_pinion", "z_pinion", "roll_wheel", "z_wheel")]  # fmt: skip
        ratio = mpmath.mpf(T[0]) / T[1]
        start.append(mpmath.mpf(phi) * ratio)
        twin = Twin(sign, errors)
        solved = mpmath.findroot(twin.residual(mpmath.mpf(phi)), start, tol=1e-24, maxsteps=40)
        return float(solved[4] - mpmath.mpf(phi) * ratio)


@pytest.mark.parametrize(("flank", "sign"), [("left", 1), ("right", -1)])
def test_the_error_of_tilted_gears_is_that_of_forty_digits(drive, flank, sign):
    made = drive(flank=flank, misalignment=ERRORS)
    for angle in (-0.1, 0.02):
        contact = made.tca([angle])
        assert contact.status == ("converged",)
        assert contact.error[0] == pytest.approx(exact_error(sign, ERRORS, angle, contact), abs=1e-9 * ARCSEC)


def test_sensitivities_are_differences_in_forty_digits(drive):
    made, step = drive(), 1e-4
    found = sensitivity(made, [-0.05])
    for key, unit in (("center_distance_mm", 1.0), ("out_of_plane_deg", math.radians(1.0))):
        ends = [exact_error(1, {key: h}, -0.05, drive(misalignment={key: h}).tca([-0.05])) for h in (-step, step)]
        slope = (ends[1] - ends[0]) / (2 * step * unit)
        assert found.error[0, found.of(f"misalignment.{key}")] == pytest.approx(slope, rel=1e-5)


def test_the_left_hand_and_casadi_agree(drive, folder):
    angles = [-0.1, 0.02]
    right = drive(misalignment=ERRORS).tca(angles)
    mirrored = ERRORS | {"out_of_plane_deg": -ERRORS["out_of_plane_deg"]}
    casadi = Drive.from_tables(TABLES | {"misalignment": ERRORS}, "casadi", folder).tca(angles)
    assert casadi.error == pytest.approx(right.error, abs=1e-13)
    for misalignment in (ERRORS, mirrored):
        left = drive(design=DESIGN | {"hand": "left"}, misalignment=misalignment).tca(angles)
        assert set(left.status) == {"converged"}


# -- surfaces, solids, sizes -------------------------------------------------------------------------------------------


def test_the_flank_of_the_gear_faces_its_axis_and_its_fillet_goes_on_outwards(run):
    """Normals point out of the material: into the space, and towards the axis."""
    flank = run.json("surface", "--member", "wheel", "--grid", "5x7")
    points, normals = (np.array([p for p in flank[key] if p], dtype=float) for key in ("points_mm", "normals"))
    radius = np.hypot(points[:, 0], points[:, 1])
    assert (radius.min(), radius.max()) == pytest.approx((R[1] - M, R[1] + 0.9 * M), abs=1e-6)
    assert np.einsum("ij,ij->i", points[:, :2], normals[:, :2]).max() < 0.0
    fillet = run.json("surface", "--member", "wheel", "--region", "fillet", "--grid", "5x7")
    points, normals = (np.array(fillet[key], dtype=float) for key in ("points_mm", "normals"))
    assert np.hypot(points[:, 0], points[:, 1]).min() == pytest.approx(R[1] + 0.9 * M, abs=1e-9)
    assert np.einsum("ij,ij->i", points[:, :2], normals[:, :2]).max() < 0.0


def test_the_solid_of_the_internal_gear_is_a_ring_outside_its_teeth(drive):
    """Of spur gears: from the tip circle to the outside, the volume of the ring less that of the spaces.

    The outside is a polygon of few corners; facets of hollow flanks and fillets take up to a micrometre of the spaces.
    """
    body = closed_body(drive(**spur()), "wheel", rim_thickness=5.0)
    radius = np.hypot(body.points[:, 0], body.points[:, 1])
    tip, root = M * (T[1] / 2 - 1), float(_root_radius(drive(**spur())))
    assert (radius.min(), radius.max()) == pytest.approx((tip, root + 5.0), abs=1e-5)
    space = _cross_section(drive(**spur()))
    corners = np.unique(np.round(np.arctan2(*body.points[radius > root + 4.999, 1::-1].T), 9))
    outside = 0.5 * (root + 5.0) ** 2 * np.sin(np.diff(corners, append=corners[0] + 2 * math.pi)).sum()
    assert body.volume == pytest.approx(F * (outside - math.pi * tip**2 - T[1] * space), rel=1.5e-4)


def _root_radius(drive):
    return drive.function("solid_wheel")()["root_radius"]


def _cross_section(drive):
    """Area of one space between tip and root circle: the polygon through many points of its sides, mm²."""
    sides = []
    for word in ("left", "right"):
        one = drive.with_(flank=word)
        sizes_ = {key: float(value) for key, value in one.function("solid_wheel")().items()}
        base = M * T[1] / 2 * math.cos(math.radians(20.0))
        tip = math.sqrt((M * (T[1] / 2 - 1)) ** 2 - base**2) / base
        flank = np.linspace(tip, sizes_["flank_root"], 2001)
        fillet = np.linspace(0.0, sizes_["fillet_land"], 2001)
        flank = one.flank("wheel")(np.stack([flank, 0 * flank], axis=1)).points[:, :2]
        fillet = one.flank("wheel", "fillet")(np.stack([fillet, 0 * fillet], axis=1)).points[:, :2]
        sides.append(np.concatenate([flank, fillet]))
    ends = [np.arctan2(*side[k][::-1]) for side in sides for k in (0, -1)]
    arcs = [np.hypot(*sides[0][k]) * np.exp(1j * np.linspace(a, b, 2001))
            for k, a, b in ((-1, ends[1], ends[3]), (0, ends[2], ends[0]))]  # fmt: skip
    left, right = (side @ [1, 1j] for side in sides)
    outline = np.concatenate([left, arcs[0], right[::-1], arcs[1]])
    return abs(np.sum(np.imag(np.conj(outline) * np.roll(outline, -1)))) / 2


def test_balls_are_measured_between_them(drive):
    """ISO 21771: inv α_K = inv α + η − D/(m z cos α), η the space's half angle, r_K = r_b/cos α_K, M = 2 r_K − D."""
    ball, alpha = 3.5, math.radians(20.0)
    (size,) = sizes(drive(**spur()), "wheel", [ball])
    target = inv(alpha) + math.pi / (2 * T[1]) - ball / (M * T[1] * math.cos(alpha))
    angle = float(mpmath.findroot(lambda x: mpmath.tan(x) - x - target, 0.3))
    radius = M * T[1] / 2 * math.cos(alpha) / math.cos(angle)
    assert size.centre_radius == pytest.approx(radius, abs=1e-9)
    assert size.size == pytest.approx(2 * radius - ball, abs=1e-9)
    assert size.lowest == pytest.approx(radius + ball / 2, abs=1e-9)


# -- load, first design, record ----------------------------------------------------------------------------------------


def test_under_load_the_pairs_carry_the_torque(run):
    words = ("--set", "design.pinion_lead_crowning_um=60")
    (point,) = run.json("loaded", "--torque-nm", 20, "--phi-deg", 0, *words)["points"]
    sine = math.sin(BETA) * math.cos(math.radians(20.0))
    arm = R_B[0] * math.sqrt(1 - sine**2)
    assert sum(pair["force_n"] for pair in point["pairs"]) * arm == pytest.approx(20000.0, rel=1e-3)
    for pair in point["pairs"]:
        assert pair["peak_pressure_mpa"] == pytest.approx(pair["hertz_pressure_mpa"], rel=0.03)


def test_a_first_design_is_written_from_what_the_file_declares(folder, tmp_path, capsys):
    path = tmp_path / "first.toml"
    assert main(["--drives", str(folder), "new", "own-ring", "--m", "3", "--z", "30:72", "--out", str(path)]) == 0
    assert f"meshwright --drives {folder} tca {path}\n" in capsys.readouterr().out
    assert Drive.load(path, drives=folder).tca([0.0]).status == ("converged",)


def test_a_size_that_follows_from_others_is_refused_with_its_value(drive):
    """The involute of so few teeth begins above 0.9 modules below the pitch circle."""
    follows = M * 12 / (2 * math.cos(BETA)) - 0.9 * M
    with pytest.raises(DesignError, match=rf"blank.pinion_form_radius_mm = {follows:.6g}: .* inside its base circle"):
        drive(design=DESIGN | {"pinion_teeth": 12})


def test_the_audit_entry_holds(folder):
    entry = json.loads((folder / "audit" / "own_ring.json").read_text(encoding="utf-8"))
    assert set(entry["checked"].values()) == {"holds"} and entry["not_proved"] == {}
