"""Limits of worm drives: rack and pinion, limit points, meshing axes, undercut, edges of regression, pointed teeth."""

import json
import re

import mpmath
import numpy as np
import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.design.design import changed
from meshwright.limits import Request
from meshwright.limits.sections import section
from tests.fuzz.mutate import toml
from tests.independent.worm import WormDrive
from tests.quick import quick
from tests.worm.designs import PROFILES, plain

FLANKS = ("right", "left")


def _drive(profile, **changes):
    return Drive.from_tables(plain(profile, **changes))


def _rack(drive):
    """Screw parameter, ratio, distances of the pitch line from the worm axis and of the wheel axis."""
    p = drive.design.sizes["screw_parameter_hob_mm_per_rad"]
    ratio, A = 2 / 41, drive.design.value("cutting_center_distance_mm")
    return p, ratio, A - p / ratio, A


def _places(drive, count=6):
    """Random (t, Ψ) on the flank, from the radii of the profile."""
    rng = np.random.default_rng(7)
    span = drive.function("profile_range_tool")()
    t = span["pitch_point"] + span["scale"] * rng.uniform(-0.3, 0.3, count)
    return t, rng.uniform(-0.3, 0.3, count)


@pytest.mark.parametrize("flank", FLANKS)
@pytest.mark.parametrize("profile", PROFILES)
def test_generated_contact_is_the_rack_form_of_the_paper(profile, flank):
    """Zc = n_k (x − R1j)/n_x, λ = (Zc − ζ)/p, φ1 = ψ − λ, and the wheel point diag(−1, 1, −1) R(2)."""
    drive = _drive(profile, flank=flank)
    p, ratio, pitch_line, A = _rack(drive)
    for t, psi in zip(*_places(drive), strict=True):
        section, at = drive.function("profile_tool")(t), drive.function("generation")(t, psi)
        (xi, eta, zeta), (n_e, n_1, n_k) = section["point"], section["normal"]
        c, s = np.cos(psi), np.sin(psi)
        x, y, n_x = xi * c - eta * s, xi * s + eta * c, n_e * c - n_1 * s
        z = n_k * (x - pitch_line) / n_x
        turn = (z - zeta) / p
        assert np.allclose(at["point"], [x, y, z], rtol=0, atol=1e-11)
        assert at["psi_hob"] == pytest.approx(turn, abs=1e-11)
        assert at["phi_hob"] == pytest.approx(psi - turn, abs=1e-11)
        angle = -ratio * (psi - turn)  # turned by −φ2 about k2; i2, j2 = −i1, −k1
        x2, y2 = np.cos(-angle) * (A - x) + np.sin(-angle) * -z, -np.sin(-angle) * (A - x) + np.cos(-angle) * -z
        assert np.allclose(at["point_wheel"], np.array([-1, 1, -1]) * [x2, y2, -y], rtol=0, atol=1e-11)


@pytest.mark.parametrize("flank", FLANKS)
@pytest.mark.parametrize("profile", PROFILES)
def test_a_worm_point_touches_twice_a_revolution_and_once_at_a_second_type_limit(profile, flank):
    drive = _drive(profile, flank=flank)
    contacts, generation = drive.function("tool_point"), drive.function("generation")
    for t, psi in zip(*_places(drive), strict=True):
        both = contacts(t, generation(t, psi)["psi_hob"])["psi_fixed_hob"]
        assert np.abs(np.exp(1j * both) - np.exp(1j * psi)).min() < 1e-7
        for root in both:
            assert np.isfinite(root)
        for limit in drive.function("second_type")(t)["psi_fixed_hob"]:
            at = generation(t, limit)
            merged = contacts(t, at["psi_hob"] * (1 - 1e-13))["psi_fixed_hob"]
            if not np.all(np.isfinite(merged)):
                merged = contacts(t, at["psi_hob"] * (1 + 1e-13))["psi_fixed_hob"]
            assert np.abs(np.exp(1j * merged) - np.exp(1j * limit)).max() < 1e-4
            q_0 = at["point"][2] * at["normal"][1] / at["normal"][2] - at["point"][1]
            assert abs(q_0) < 1e-9  # the normal meets the pitch line at its foot


@pytest.mark.parametrize("flank", quick(FLANKS, "right"))
@pytest.mark.parametrize("offset", quick([-3.0, 0.0, 4.0], 4.0))
@pytest.mark.parametrize("profile", PROFILES)
def test_normals_of_a_section_pass_through_its_pitch_point(profile, offset, flank):
    drive = _drive(profile, flank=flank)
    _, _, pitch_line, _ = _rack(drive)
    found = drive.limits(Request(section_y=offset, radii=(18.0, 20.4, 23.0)))
    assert [c.radius for c in found.section_profile] == pytest.approx([18.0, 20.4, 23.0], abs=1e-11)
    for c in found.section_profile:
        assert c.point[1] == pytest.approx(offset, abs=1e-12)
        assert c.wheel_point[2] == pytest.approx(offset, abs=1e-12)
        assert (c.point[0] - pitch_line) * c.normal[2] - c.point[2] * c.normal[0] == pytest.approx(0, abs=1e-11)


@pytest.mark.parametrize("flank", FLANKS)
def test_first_type_limit_of_an_archimedean_rack_is_the_classical_one(flank):
    drive = _drive("ZA", flank=flank)
    p, ratio, pitch_line, _ = _rack(drive)
    tangent = np.tan(drive.design.value("pressure_angle_deg")) / np.cos(drive.design.value("worm_lead_angle_deg"))
    classical = pitch_line + p / ratio * tangent**2 / (1 + tangent**2)
    (limit,) = drive.limits().first_type
    assert limit.point[0] == pytest.approx(classical, abs=1e-11)
    assert limit.point[1] == pytest.approx(0, abs=1e-13)


@pytest.mark.parametrize("flank", FLANKS)
def test_second_type_limits_of_an_involute_worm_are_those_of_its_generators(flank):
    """cos ψ = r_b/R1j for the generator's own angle, at every radius."""
    drive = _drive("ZI", flank=flank)
    _, _, pitch_line, _ = _rack(drive)
    base = drive.function("profile_range_tool")()["lower_end"]
    found = drive.limits(Request(radii=(17.0, 20.0, 23.0))).second_type
    assert len(found) == 6
    for c in found:
        generator = np.arctan2(c.point[1], c.point[0]) - drive.design.flank * np.arccos(base / c.radius)
        assert np.cos(generator) == pytest.approx(base / pitch_line, abs=1e-11)


@pytest.mark.parametrize("flank", quick(FLANKS, "left"))
@pytest.mark.parametrize("profile", PROFILES)
def test_first_type_limits_are_singular_points_of_the_wheel(profile, flank):
    drive = _drive(profile, flank=flank)
    for c in drive.limits(Request(section_y=2.0)).first_type:
        at = drive.flank("wheel")([[c.parameters["t_hob"], c.parameters["psi_fixed_hob"]]])
        assert abs(at.regular[0]) < 1e-8
        # there the normal of the line of action in the section passes through the wheel's centre
        x, z = c.point[0] - drive.design.value("cutting_center_distance_mm"), c.point[2]
        profile_tangent = _line_of_action(drive, c, 2.0)
        assert abs(profile_tangent @ [x, z]) / np.hypot(x, z) < 1e-6


def _line_of_action(drive, contact, offset, step=1e-6):
    """Unit tangent (x, z) of the line of action in the section y = ``offset``, by central differences."""
    t = contact.parameters["t_hob"]
    h = step * float(drive.function("profile_range_tool")()["scale"])
    ends = []
    for q in (t - h, t + h):
        psi = drive.function("section")(q, offset)["psi_fixed_hob"]
        ends.append(drive.function("generation")(q, psi)["point"][[0, 2]])
    return (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0])


@pytest.mark.parametrize("shaft_angle", quick([50.0, 90.0, 105.0], 105.0))
@pytest.mark.parametrize("flank", quick(FLANKS, "right"))
@pytest.mark.parametrize("profile", PROFILES)
def test_every_normal_meets_both_meshing_axes_at_any_shaft_angle(profile, flank, shaft_angle):
    drive = _drive(profile, flank=flank, shaft_angle_deg=shaft_angle)
    found = drive.limits()
    assert found.axes_exist and len(found.axes) == 2
    for t, psi in zip(*_places(drive), strict=True):
        at = drive.function("generation")(t, psi)
        for axis in found.axes:
            moment = np.dot(at["point"] - axis.point, np.cross(at["normal"], axis.direction))
            assert abs(moment) < 1e-10


def test_meshing_axes_at_right_angles_are_the_pitch_line_and_the_line_at_its_lead_angle():
    drive = _drive("ZN")
    p, _, pitch_line, _ = _rack(drive)
    first, second = drive.limits().axes
    assert first.inclination == pytest.approx(np.pi / 2, abs=1e-13)
    assert first.point[0] == pytest.approx(pitch_line, abs=1e-11)
    assert second.inclination == pytest.approx(np.arctan(p / pitch_line), abs=1e-13)
    assert np.allclose(second.point, 0, atol=1e-11)


def test_meshing_axes_need_not_exist():
    """p τ² − (p + p I cos Σ + A I sin Σ) τ + A I sin Σ has complex roots at an obtuse angle with A I sin Σ = p."""
    p, ratio, _, _ = _rack(_drive("ZN"))
    sigma = np.radians(110.0)
    for distance, exists in ((p / ratio / np.sin(sigma), False), (1.5 * p / ratio / np.sin(sigma), True)):
        drive = _drive("ZN", shaft_angle_deg=110.0, cutting_shaft_angle_deg=110.0, cutting_center_distance_mm=distance)
        found = drive.limits()
        assert found.axes_exist is exists and len(found.axes) == 2 * exists


@pytest.mark.parametrize("flank", quick(FLANKS, "right"))
@pytest.mark.parametrize("profile", ["ZK", "ZC"])
def test_a_ground_profile_turns_back_at_its_edge_of_regression(profile, flank):
    tables = plain(profile, flank=flank)
    (edge,) = Drive.from_tables(tables).limits().regression
    helicoid = WormDrive.of(tables).worm

    def squared(t):
        x, y, _ = helicoid.profile(t)[0]
        return x**2 + y**2

    t = edge.parameters["t_worm"]
    usual = abs(mpmath.diff(squared, 0))
    assert abs(mpmath.diff(squared, t)) < 1e-6 * usual
    assert edge.radius == pytest.approx(float(mpmath.sqrt(squared(t))), abs=1e-9)


def test_contact_beyond_the_edge_of_regression_is_flagged():
    """The conference paper's design: at a lead angle of 30° the edge lies above the nominal root."""
    drive = Drive.load("zk-zn-45")
    (edge,) = drive.limits().regression
    nominal_root = drive.design.value("worm_pitch_radius_mm") - 1.2 * drive.design.value("normal_module_mm")
    assert edge.radius > nominal_root
    at = drive.flank("pinion")([[edge.parameters["t_worm"] * (1 + share), 0.0] for share in (-0.01, 0.01)])
    assert at.margins["regression"][0] > 0 > at.margins["regression"][1]


def test_the_undercut_line_passes_through_the_first_type_limit():
    drive = _drive("ZN", flank="right")
    (limit,) = drive.limits().first_type
    found = drive.limits(Request(axial=(0.0,))).undercut
    assert any(np.allclose(u.point, limit.wheel_point, atol=1e-6) for u in found)


def test_a_wheel_of_few_teeth_is_undercut_within_its_blank_and_one_of_many_is_not():
    few, many = (_undercut_within_blank(teeth) for teeth in (12, 60))
    assert few and not many


def _undercut_within_blank(teeth):
    radius = 4.0 * teeth / (2 * np.cos(np.radians(11.31)))
    blank = {"hob_tip_addendum_mm": 4.8, "wheel_tip_radius_mm": radius + 6.0, "wheel_face_width_mm": 30.0}
    drive = Drive.from_tables(
        changed(plain("ZA", wheel_teeth=teeth), {f"blank.{key}": value for key, value in blank.items()})
    )
    return [u for u in drive.limits().undercut if u.on_flank]


@pytest.mark.parametrize("blank", ["open", "without the hob's tip"])
def test_an_ordinary_wheel_is_not_undercut_below_the_tip_of_any_hob(blank, tmp_path, capsys):
    """Where the blank is open, the standard proportions end the blade, as they do under load; the output says so.

    41 teeth at 20°: the involute hob's blade would undercut only with an addendum of more than m z sin²α / 2, which is
    twice the 1.2 modules of a standard one.
    """
    tables = changed(plain("ZI"), {} if blank == "open" else {"blank.wheel_tip_radius_mm": 89.66})
    drive = Drive.from_tables(tables)
    found = drive.limits()
    whole, assumed = drive.design.with_whole_blank()
    axial = 4.0 / np.cos(np.radians(11.31))
    assert assumed["hob_tip_addendum_mm"] == pytest.approx(1.2 * axial) and 1.2 * axial < 4.0 * 41 * 0.342**2 / 2.0
    assert found.undercut and not any(u.on_flank for u in found.undercut)
    assert found.assumed_blank == found.plain()["assumed_blank"] == assumed
    given = tmp_path / "given.toml"
    given.write_bytes(toml(tables))
    assert main(["limits", str(given)]) == 0
    assert f"assumed where [blank] is open: hob_tip_addendum_mm = {1.2 * axial:.6g}" in capsys.readouterr().out
    assert Drive(whole).limits().assumed_blank == {}


@pytest.mark.validate
def test_an_open_blank_that_the_standard_proportions_do_not_fit_is_said_to_bound_nothing(tmp_path, capsys):
    """A worm whose root is given above the tip that a standard addendum makes."""
    given = tmp_path / "given.toml"
    given.write_bytes(toml(changed(plain("ZA"), {"blank.worm_root_radius_mm": 25.0})))
    assert main(["limits", str(given)]) == 0
    said = capsys.readouterr().out
    assert "a standard blank does not fit: blank.worm_tip_radius_mm = 24.47" in said and "25" in said


def test_thread_thickness_at_the_tip_and_pointed_radius():
    """Axial thread thickness of an Archimedean worm: half the axial pitch at r1, less 2 tan α_x a millimetre up."""
    tables = changed(plain("ZA"), {"blank.worm_tip_radius_mm": 24.0})
    drive = Drive.from_tables(tables)
    (worm,) = (t for t in drive.limits().tip_thickness if t.member == "pinion")
    r = drive.design.value("worm_pitch_radius_mm")
    lead = drive.design.value("worm_lead_angle_deg")
    slope = np.tan(drive.design.value("pressure_angle_deg")) / np.cos(lead)
    half_pitch = np.pi * 4.0 / np.cos(lead) / 2
    assert worm.thickness == pytest.approx(half_pitch - 2 * slope * (24.0 - r), abs=1e-11)
    assert worm.pointed_radius == pytest.approx(r + half_pitch / 2 / slope, abs=1e-9)


def test_limits_of_the_left_hand_drive_are_the_mirror_image():
    right, left = (_drive("ZK", hand=hand).limits(Request(section_y=0.0)) for hand in ("right", "left"))
    mirror = np.array([1, -1, 1])
    for name in ("first_type", "second_type", "section_profile", "undercut", "regression"):
        pairs = list(zip(getattr(right, name), getattr(left, name), strict=True))
        assert pairs and all(np.allclose(a.point * mirror, b.point) for a, b in pairs)
    assert all(a.angle == -b.angle for a, b in zip(right.first_type, left.first_type, strict=True))


def test_the_command_writes_every_list_of_the_schema(tmp_path, capsys):
    target = tmp_path / "limits.json"
    assert main(["limits", "zk-zn-90", "--json", str(target), "--section-y-mm", "0", "--radius-mm", "11,13"]) == 0
    document = json.loads(target.read_text(encoding="utf-8"))
    assert document["schema"] == "meshwright.limits/1"
    lists = {"undercut", "regression", "first_type", "second_type", "meshing_axes", "section_profile", "branch_points"}
    assert all(isinstance(document[key], list) for key in lists)
    assert document["meshing_axes_exist"] is True and document["least_teeth_without_undercut"] is None
    assert [round(p["radius_mm"], 9) for p in document["section_profile"]] == [11.0, 13.0]
    assert document["branch_points"][0]["kind"] == "pitchfork"


def test_a_section_of_a_drive_that_is_not_at_right_angles_is_an_error(capsys):
    assert main(["limits", "zk-zn-45", "--section-y-mm", "0"]) == 2
    message = capsys.readouterr().err
    assert "section y" in message and "45" in message


@pytest.mark.parametrize("hand", ["right", "left"])
def test_a_section_lies_in_the_plane_asked_for_whatever_the_hand(hand):
    found = _drive("ZN", hand=hand).limits(Request(section_y=3.0))
    assert [c.point[1] for c in found.section_profile] == pytest.approx([3.0] * 11, abs=1e-12)


@pytest.mark.parametrize("hand", quick(["right", "left"], "left"))
@pytest.mark.parametrize("profile", quick(PROFILES, "ZA", "ZC"))
def test_the_surface_command_writes_the_profiles_of_a_section(profile, hand):
    drive = _drive(profile, hand=hand)
    grids = {}
    for member, plane, place in (("pinion", 1, 3.0), ("wheel", 2, 3.0 if hand == "right" else -3.0)):
        grids[member] = section(drive, member, 3.0, 7)
        assert np.allclose(grids[member].points[:, plane], place, atol=1e-11)
    contacts = drive.limits(Request(section_y=3.0, radii=tuple(np.hypot(*grids["pinion"].points[:, :2].T))))
    for k, c in enumerate(contacts.section_profile):
        assert np.allclose(c.wheel_point, grids["wheel"].points[k], atol=1e-9)
        assert np.allclose(c.normal, grids["pinion"].normals[k], atol=1e-9)  # the rack slides, it does not turn


def test_a_section_on_the_command_line(capsys):
    assert main(["surface", "zk-zn-90", "--member", "wheel", "--section", "1.5", "--grid", "5x2", "--json", "-"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["section_y_mm"] == 1.5 and document["shape"] == [5, 1]
    assert [p[2] for p in document["points_mm"]] == pytest.approx([1.5] * 5, abs=1e-11)
    assert main(["surface", "zk-zn-90", "--member", "wheel", "--section", "1.5", "--stl", "x.stl"]) == 2
    assert main(["surface", "zk-zn-45", "--member", "wheel", "--section", "1.5"]) == 2


def test_a_radius_that_the_profile_does_not_reach_is_refused_with_those_it_does(capsys):
    assert main(["limits", "zk-zn-90", "--radius-mm", "12,500"]) == 2
    message = capsys.readouterr().err
    assert "radius 500 mm: the hob's profile does not reach it; choose one from" in message
    least, most = map(float, re.search(r"from (\S+) to (\S+) mm", message).groups())
    assert main(["limits", "zk-zn-90", "--radius-mm", f"{1.001 * least},{0.999 * most}"]) == 0


def test_no_undercut_at_a_position_is_not_no_undercut(capsys):
    assert main(["limits", "zk-zn-90", "--axial-mm", "900"]) == 0
    assert "undercut at the axial positions given: none" in capsys.readouterr().out
