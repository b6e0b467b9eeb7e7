"""Where contact begins and ends, how many teeth share it, and what the drive transmits."""

import json
from dataclasses import replace

import numpy as np
import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.contact.results import ARCSEC
from meshwright.cycle.backlash import backlash
from meshwright.cycle.pairs import Mesh
from meshwright.cycle.rigid import ROUND_OFF
from meshwright.cycle.room import room
from meshwright.cycle.transmission import envelopes, transmission_error


def _errors(case):
    """Misalignment keys of a published case: the paper turns both axes the other way."""
    errors = case["errors"]
    return {
        "center_distance_mm": float(errors["dC_mm"]),
        "vertical_deg": -errors["dgv_arcmin"] / 60.0,
        "horizontal_deg": -errors["dgh_arcmin"] / 60.0,
    }


def _case(reference, name):
    return next(c for c in reference("recess-action-worm")["cases"] if c["id"] == name)


@pytest.mark.parametrize("name", ["2", "3", "4"])
def test_contact_window_and_kinematic_error_of_the_published_cases(reference, name):
    case, tolerance = _case(reference, name), reference("recess-action-worm")["cases_tolerance"]
    mesh = Mesh.of(Drive.load("recess-action-full").with_(misalignment=_errors(case)))
    begin, end = mesh.window.begin, mesh.window.end
    assert (begin.reason, begin.member) == ("tip", "wheel")
    assert (end.reason, end.member) == ("tool_end", "wheel")
    assert np.degrees(begin.angle) == pytest.approx(case["begin_deg"], abs=tolerance["angle_deg"])
    assert np.degrees(end.angle) == pytest.approx(case["end_deg"], abs=tolerance["angle_deg"])
    assert mesh.contact_ratio == pytest.approx(case["cr"], abs=tolerance["cr"])
    assert mesh.average_begin_to_end() == pytest.approx(case["acr"], abs=tolerance["acr"])
    counts = {mesh.teeth_in_contact(angle) for angle in np.radians(np.arange(0.0, 360.0, 3.0))}
    assert sorted(counts) == case["ict"]
    found = transmission_error(mesh)
    # the paper takes the lower envelope of a convex curve; rigid flanks transmit the upper one
    assert found.envelope == "upper"
    assert found.other_envelope_peak_to_peak / ARCSEC == pytest.approx(
        case["max_ke_arcsec"], abs=tolerance["max_ke_arcsec"]
    )


@pytest.mark.parametrize("name", ["standard", "semi", "full"])
def test_contact_of_the_aligned_drives_ends_where_the_paper_says(reference, name):
    case = _case(reference, f"1 {name}")
    end = Mesh.of(Drive.load(f"recess-action-{name}")).window.end
    assert np.degrees(end.angle) == pytest.approx(case["end_deg"], abs=case["tolerance"]["end_deg"])


def test_events_lie_on_their_limits():
    drive = Drive.load("recess-action-full").with_(misalignment={"center_distance_mm": -0.1})
    window = Mesh.of(drive).window
    at = drive.tca([window.begin.angle, window.end.angle])
    tip = drive.design.value("wheel_tip_radius_mm", "blank")
    assert np.hypot(*at.body_points["wheel"][0, :2]) == pytest.approx(tip, abs=1e-8)
    blade_end = np.pi * 2.0 / (4.0 * np.sin(np.radians(10.0))) + 4.0 / np.cos(np.radians(10.0))
    assert at.unknowns["t_hob"][1] == pytest.approx(blade_end, abs=1e-8)


def test_the_other_hand_is_the_mirror_image():
    misalignment = {"center_distance_mm": -0.1, "vertical_deg": 0.05}
    right = Mesh.of(Drive.load("recess-action-full").with_(misalignment=misalignment))
    left = Mesh.of(right.drive.with_(design={"hand": "left"}))
    assert left.window.begin.angle == pytest.approx(-right.window.begin.angle, abs=1e-9)
    assert left.window.end.angle == pytest.approx(-right.window.end.angle, abs=1e-9)
    assert (right.envelope, left.envelope) == ("upper", "lower")
    assert left.errors([-8.0])[0] == pytest.approx(-right.errors([8.0])[0], abs=1e-15)


def test_half_a_turn_swaps_the_flanks_and_the_order_of_the_ends():
    right, left = (Mesh.of(Drive.load("recess-action-standard").with_(flank=f)) for f in ("right", "left"))
    assert left.window.begin.angle == pytest.approx(-right.window.begin.angle, abs=1e-8)
    assert left.window.begin.angle > left.window.end.angle
    assert (right.envelope, left.envelope) == ("upper", "lower")


def test_the_average_over_a_pitch_is_the_contact_ratio():
    mesh = Mesh.of(Drive.load("recess-action-semi"))
    ratio = mesh.contact_ratio
    whole, part = np.floor(ratio), ratio - np.floor(ratio)
    assert mesh.average_over_pitch() == pytest.approx(ratio, abs=1e-10)
    published = ((whole + 1) ** 2 * part + whole**2 * (1 - part)) / ratio
    assert mesh.average_begin_to_end() == pytest.approx(published, abs=1e-10)


def test_an_elastic_allowance_counts_the_pairs_it_closes():
    rigid = Mesh.of(Drive.load("recess-action-full"))
    separations = [pair.separation for pair in rigid.pairs(1.0)]
    assert separations == sorted(separations) and separations[0] == 0.0
    allowance = 0.5 * (separations[2] + separations[3])
    soft = Mesh.of(rigid.drive.with_(contact={"elastic_allowance_mm": allowance}))
    assert soft.teeth_in_contact(1.0) == 3
    assert 1.0 < soft.average_over_pitch() < rigid.average_over_pitch()


def test_transfer_and_vertex_are_where_neighbours_agree_and_the_curve_is_flat():
    mesh = Mesh.of(Drive.load("recess-action-full").with_(misalignment={"center_distance_mm": -0.1}))
    found = transmission_error(mesh)
    first, second = mesh.errors(found.transfers)
    assert first == pytest.approx(second, abs=1e-15)
    assert found.transfers[1] - found.transfers[0] == pytest.approx(mesh.drive.pitch(), abs=1e-12)
    wide, narrow = (np.diff(mesh.errors(found.vertex + h * np.array([-1.0, 1.0])))[0] / (2 * h) for h in (0.5, 0.25))
    curvature = np.diff(mesh.errors(found.vertex + np.array([-0.5, 0.0, 0.5])), n=2)[0] / 0.25
    assert abs(4 * narrow - wide) / 3 < 1e-6 * curvature  # the slope, free of the curve's third derivative


def test_the_wheel_follows_the_pair_that_is_ahead():
    mesh = Mesh.of(Drive.load("recess-action-full"))
    angles = np.linspace(0.0, mesh.drive.pitch(), 25)
    found = envelopes(mesh, angles)
    assert (np.nanmax(found.pairs, axis=0) == found.upper).all()
    assert [mesh.pairs(a)[0].number for a in angles] == found.leading.tolist()


def test_limits_that_are_not_given_do_not_end_contact(tmp_path, capsys):
    tables = Drive.load("recess-action-full").design.tables
    open_design = tmp_path / "open.toml"
    open_design.write_text(
        'drive = "cylindrical-worm"\n[design]\n'
        + "\n".join(f"{k} = {json.dumps(v)}" for k, v in tables["design"].items() if v is not None)
    )
    assert main(["ratio", str(open_design), "--json", "-"]) == 1
    document = json.loads(capsys.readouterr().out)
    assert document["begin"] == {"pinion_angle_deg": None, "event": "none", "member": None}
    assert document["contact_ratio"] is None
    assert document["transmission_error"]["envelope"] == "upper"


def test_line_contact_has_no_path_but_every_key(capsys):
    equal = Drive.load("recess-action-full").design.as_solved()["design"]["worm_pitch_radius_mm"]
    arguments = ["recess-action-full", "--set", f"design.hob_pitch_radius_mm={equal!r}", "--json", "-"]
    assert main(["ratio", *arguments]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["status"] == "line_contact"
    assert set(document["transmission_error"]) > {"envelope", "transfer_angles_deg", "vertex_deg"}


def test_moving_the_wheel_away_opens_the_backlash(capsys):
    """Both flanks gain the same: 2 ΔA tan(pressure angle) along the wheel's pitch circle, to the errors of Δ²."""
    arcsec = []
    for distance in (0.0, 0.05):
        setting = f"misalignment.center_distance_mm={distance}"
        assert main(["ratio", "recess-action-full", "--set", setting, "--json", "-"]) == 0
        arcsec.append(json.loads(capsys.readouterr().out)["backlash_arcsec"])
    assert arcsec[0] < 0.0 < arcsec[1]
    wheel_radius = 277.38
    expected = 2 * 0.05 * np.tan(np.radians(10.0)) / np.cos(np.radians(3.0)) / wheel_radius / ARCSEC
    assert arcsec[1] - arcsec[0] == pytest.approx(expected, rel=0.05)


@pytest.mark.parametrize("name", ["plain-za", "helical-crowned"])
def test_a_drive_that_jams_names_the_sizes_that_give_it_room(name, capsys):
    """Each change that is named takes the backlash to zero, that of the assembly among them."""
    settings = ["--set", "misalignment.center_distance_mm=-0.05"]
    assert main(["ratio", name, *settings, "--json", "-"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["backlash_arcsec"] < 0.0
    drive = Drive.load(name).with_(misalignment={"center_distance_mm": -0.05})
    for entry in found["room"]:
        table, key = entry["key"].split(".")
        changed = drive.with_(**{table: {key: drive.design.value(key, table) + entry["change"]}})
        assert abs(backlash(changed) / ARCSEC) < 0.02 * abs(found["backlash_arcsec"])
    keys = {entry["key"] for entry in found["room"]}
    assert "misalignment.center_distance_mm" in keys
    assert ("design.cutting_center_distance_mm" in keys) == (name == "plain-za")
    assert main(["ratio", name, *settings]) == 0
    assert "what gives it room, one at a time: design." in capsys.readouterr().out
    assert not Drive.load("spherical-table-3-1-spur").contact_ratio().backlash < -ROUND_OFF
    assert room(Drive.load("spherical-table-3-1-spur"), 0.0) == ()


#: Spur gears whose teeth are so low that a pair ends half a pitch before the next one begins.
LOW_TEETH = """
drive = "cylindrical-gears"
[design]
normal_module_mm = 2.5
pressure_angle_deg = 20
pinion_teeth = 23
wheel_teeth = 41
face_width_mm = 20
pinion_lead_crowning_um = 8
pinion_profile_crowning_um = 5
[blank]
pinion_tip_radius_mm = 29.3
wheel_tip_radius_mm = 52
"""


@pytest.mark.parametrize("crowning", [8, 0])
def test_a_contact_ratio_below_1_is_said_and_no_change_of_pairs_where_none_touches(tmp_path, capsys, crowning):
    """In a point or, without crowning, along lines: there the length of action over the base pitch (ISO 21771)."""
    path = tmp_path / "low.toml"
    path.write_text(LOW_TEETH)
    settings = [f"--set=design.pinion_{kind}_crowning_um={crowning}" for kind in ("lead", "profile")]
    assert main(["ratio", str(path), *settings]) == 0
    shown = capsys.readouterr().out
    alpha, bases = np.radians(20), [2.5 * z / 2 * np.cos(np.radians(20)) for z in (23, 41)]
    lengths = [np.sqrt(tip**2 - r_b**2) - r_b * np.tan(alpha) for tip, r_b in zip((29.3, 52.0), bases, strict=True)]
    ratio = sum(lengths) / (np.pi * 2.5 * np.cos(alpha))
    assert "contact ratio below 1: without load a pair leaves contact before the next one begins" in shown
    line = next(line for line in shown.splitlines() if line.startswith("pairs change at"))
    assert line.split(",")[0].split() == ["pairs", "change", "at", "–"]
    assert ("outside of contact" in line) == (crowning > 0)
    said = float(shown.split("begins; over ")[1].split("°")[0])
    assert said == pytest.approx((1 - ratio) * 360 / 23, rel=0.05 if crowning else 1e-3)


def test_pairs_change_inside_their_contact_or_where_one_ends(capsys):
    """Contact of the recess-action drive begins after the curves of neighbours cross: it rides on an edge."""
    for name, inside in (("plain-zn", True), ("recess-action-full", False)):
        assert main(["ratio", name]) == 0
        shown = capsys.readouterr().out
        assert "below 1" not in shown
        assert inside == ("outside of contact" not in shown) == ("certified: pairs change" in shown)


def test_the_papers_limits_can_be_asked_for_by_name():
    """Tip r2 + 2 m_n − shift and blade end 2 m_n + shift, as the packaged designs spell them out."""
    tables = Drive.load("recess-action-semi").design.tables
    design = {k: v for k, v in tables["design"].items() if v is not None}
    named = {"drive": "cylindrical-worm", "design": design, "blank": {"limits": "recess-action"}}
    first, second = Drive.from_tables(named), Drive.load("recess-action-semi")
    for key in ("wheel_tip_radius_mm", "hob_tip_addendum_mm"):
        assert first.design.value(key, "blank") == pytest.approx(second.design.value(key, "blank"), abs=1e-8)
    assert first.contact_ratio().contact_ratio == pytest.approx(second.contact_ratio().contact_ratio, abs=1e-7)


@pytest.mark.parametrize(
    ("vertical", "word"),
    [(-0.074, "converged"), (-0.0765, "no_contact"), (-0.0795, "no_contact"), (-0.082, "no_contact")],
)
def test_teeth_past_the_tips_do_not_touch_however_far_off_their_path_is(vertical, word):
    """Misalignment moves the path of these teeth past the tip, and at last all of it away from angle 0."""
    drive = Drive.load("recess-action-full")
    drive = drive.with_(misalignment={"center_distance_mm": 0.02, "vertical_deg": vertical})
    assert set(drive.tca(np.radians([-1000.0, -900.0])).status) == {word}


@pytest.mark.validate
def test_a_contact_ratio_of_flanks_that_cut_into_each_other_says_so(capsys):
    """At 60 degrees this worm's contact is one of the equations alone; as it is published, bodies can make it."""
    command = ["ratio", "plain-zk", "--json", "-", "--set"]
    assert main([*command, "design.shaft_angle_deg=60"]) == 1
    found = json.loads(capsys.readouterr().out)
    assert found["impossible"] == ["interference"]
    assert found["end"]["event"] == "fold"  # up to which the pair has a transmission error
    assert found["transmission_error"]["pair_peak_to_peak_arcsec"] > 1.0
    assert None not in [distance for teeth in found["contact_teeth"] for distance in teeth["separations_mm"]]
    assert main(["ratio", "plain-zk", "--set", "design.shaft_angle_deg=60"]) == 1
    assert "bodies cannot make this contact everywhere from begin to end: interference" in capsys.readouterr().out
    assert main([*command, "design.shaft_angle_deg=90"]) == 0
    assert json.loads(capsys.readouterr().out)["impossible"] == []


def test_a_sliver_of_a_further_pair_counts():
    """A window of 3.00413 pitches: a fourth pair is in contact over 0.00413 of each pitch, however short that is."""
    mesh = Mesh.of(Drive.load("spherical-table-3-1-concave"))
    pitch, begin = mesh.drive.pitch(), mesh.window.begin
    end = replace(mesh.window.end, angle=begin.angle + 3.00413 * pitch)
    longer = Mesh(mesh.drive, replace(mesh.window, end=end))
    assert longer.average_over_pitch() == pytest.approx(3.00413, abs=1e-12)
    assert longer.average_begin_to_end() == pytest.approx((16 * 0.00413 + 9 * (1 - 0.00413)) / 3.00413, abs=1e-12)


def test_a_path_with_a_gap_at_angle_0_still_says_which_way_the_wheel_is_pushed():
    mesh = Mesh.of(Drive.load("plain-za"))
    path = mesh.window.path
    unknowns = path.unknowns.copy()
    unknowns[np.argmin(np.abs(path.angles))] = np.nan
    broken = Mesh(mesh.drive, replace(mesh.window, path=replace(path, unknowns=unknowns)))
    assert broken.sense == mesh.sense


def test_flanks_that_touch_for_one_instant_have_one_tooth_in_contact_at_it():
    """A wheel as wide as rounding, whose tip begins the contact where its root ends it: no pitch, one tooth."""
    thin = {"pinion_sphere_radius_mm": 5000.0, "wheel_edge_offset_mm": 1e-13, "wheel_face_width_mm": 1e-13}
    found = Drive.load("spherical-table-2-3").with_(flank="left", design=thin).contact_ratio()
    assert found.contact_ratio == found.average_over_pitch == 0.0
    assert found.average_begin_to_end == 1.0


def test_a_flank_narrower_than_rounding_still_has_a_contact_ratio():
    """Teeth without width between them bound no region, and transmit what their flanks do."""
    drive = Drive.load("spherical-table-3-1-concave").with_(flank="left")
    thin, whole = drive.with_(design={"face_width_mm": 1e-300}).contact_ratio(), drive.contact_ratio()
    assert thin.contact_ratio == pytest.approx(whole.contact_ratio, rel=1e-12)
    assert thin.transmission_error.envelope_with_edges_peak_to_peak < 1e-8 * ARCSEC
