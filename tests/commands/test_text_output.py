"""What the commands print for a reader: round-off is no figure, and what is missing has its cause and its remedy."""

import json
import math

import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.commands.shown import ROUND_OFF, shown
from meshwright.cycle.backlash import backlash
from meshwright.cycle.ends import why_open
from meshwright.cycle.pairs import Mesh
from meshwright.flank.pointed import pointed
from tests.worm.designs import without_blank


def _printed(capsys, *arguments):
    main(list(arguments))
    return capsys.readouterr().out


def _line(text, name):
    return next(line for line in text.splitlines() if line.strip().startswith(name))


def test_a_constant_transmission_error_and_full_teeth_are_zeros_in_words_and_full_numbers_in_json(capsys):
    """The rack that cuts both spur gears leaves no backlash and transmits uniformly."""
    text = _printed(capsys, "ratio", "spherical-table-3-1-spur")
    assert _line(text, "transmission error of a pair").endswith(" 0 arcsec peak to peak, constant to round-off")
    assert _line(text, "backlash").endswith(" 0 arcsec of the wheel, the teeth just fill the spaces")
    exact = json.loads(_printed(capsys, "ratio", "spherical-table-3-1-spur", "--json", "-"))
    assert 0.0 < exact["transmission_error"]["pair_peak_to_peak_arcsec"] < 1e-8


def test_negative_backlash_says_that_the_drive_jams(capsys):
    assert _line(_printed(capsys, "ratio", "plain-za"), "backlash").endswith(" of the wheel, negative: the drive jams")


def test_what_ends_contact_is_said_in_words_for_a_reader(capsys):
    text = _printed(capsys, "ratio", "recess-action-full")
    assert _line(text, "contact begins at").endswith(" deg, the tip of the wheel")
    assert _line(text, "contact ends at").endswith(" deg, the end of the cutting tool")
    assert "tool_end" not in text


@pytest.mark.parametrize(
    ("name", "words", "computed"),
    [
        ("bevel-hypoid", {"tip thickness": "helicoid"}, "undercut"),
        ("zk-zn-90", {"section profile": "--section-y-mm"}, "first type"),
        ("recess-action-full", {"first type": "90.1431°", "second type": "90.1431°"}, "regression"),
        ("spherical-table-2-1", {"branch points": "no contact in a point"}, "least teeth without undercut"),
    ],
)
def test_limits_that_are_not_computed_are_not_said_to_be_none(capsys, name, words, computed):
    text = _printed(capsys, "limits", name)
    assert _line(text, f"{computed}:")
    for limit, why in words.items():
        assert not any(line.startswith(f"{limit}:") for line in text.splitlines())
        assert any(limit in line and why in line for line in text.splitlines() if line.startswith("not computed: "))
    found = json.loads(_printed(capsys, "limits", name, "--json", "-"))
    assert {limit.replace(" ", "_") for limit in words} <= set(found["not_computed"])
    assert all(not found[limit] for limit in found["not_computed"])


@pytest.mark.parametrize(
    ("name", "setting", "member"),
    [
        ("plain-za", "blank.worm_tip_radius_mm=30", "pinion"),
        ("plain-zn", "blank.wheel_throat_radius_mm=92 blank.wheel_tip_radius_mm=93", "wheel"),
        pytest.param("plain-za", "blank.worm_tip_radius_mm=29", None, marks=pytest.mark.validate),
        ("bevel-formate", "pinion.face_apex_mm=40", None),
    ],
)
def test_teeth_that_end_in_a_point_are_said_where_both_flanks_are_known(capsys, name, setting, member):
    words = [name, *(f"--set={change}" for change in setting.split())]
    text = _printed(capsys, "ratio", *words)
    ratio, limits = (json.loads(_printed(capsys, c, *words, "--json", "-")) for c in ("ratio", "limits"))
    assert ratio["pointed_teeth"] == limits["pointed_teeth"]
    assert ("pointed_teeth" in limits["not_computed"]) == name.startswith("bevel")
    assert [entry["member"] for entry in ratio["pointed_teeth"]] == ([member] if member else [])
    assert (f"the flanks of a tooth of the {member} meet at radius" in text) == bool(member)
    for entry in ratio["pointed_teeth"]:  # as the thickness of the teeth in the generation has it
        (thick,) = (t for t in limits["tip_thickness"] if t["member"] == member)
        assert entry["radius_mm"] == pytest.approx(thick["pointed_radius_mm"], rel=2e-4)


def test_the_thread_of_a_straight_edge_in_the_axial_plane_ends_where_its_flanks_meet():
    """Half the axial thickness at r: π m_x/4 − (r − r_1) tan α/cos λ = 0 (the pressure angle is that of the normal
    section).
    """
    drive = Drive.load("plain-za").with_(blank={"worm_tip_radius_mm": 30.0})
    size = drive.design.as_solved()["design"]
    lead, alpha = (math.radians(size[key]) for key in ("worm_lead_angle_deg", "pressure_angle_deg"))
    half = math.pi * size["normal_module_mm"] / math.cos(lead) / 4
    (found,) = pointed(drive)
    closed = size["worm_pitch_radius_mm"] + half * math.cos(lead) / math.tan(alpha)
    assert found.radius == pytest.approx(closed, abs=1e-6)


def test_threads_that_grow_together_at_a_deep_root_do_not_end_in_a_point():
    """There the groove, not the thread, has no width left."""
    assert pointed(Drive.load("plain-za").with_(blank={"worm_root_radius_mm": 5.0})) == ()


def test_limits_print_no_round_off(capsys):
    """At a right angle the limit point of the second type lies in the worm's axial plane: y = z = 0."""
    text = _printed(capsys, "limits", "zk-zn-90")
    assert "point_mm (12, 0, 0)" in text
    assert "(certified to " in text
    assert "e-1" not in text.replace(text[text.index("(certified to ") :].split(")")[0], "")


def test_a_number_above_round_off_is_kept():
    assert (shown(2.0 * ROUND_OFF), shown(-0.5 * ROUND_OFF), shown(None)) == ("2e-09", "0", "–")


def test_an_open_blank_is_named_with_the_keys_that_would_end_contact(capsys, tmp_path):
    line = _line(_printed(capsys, "ratio", without_blank("zk-zn-60", tmp_path)), "no complete window")
    assert "begins or ends" in line and "[blank]: wheel_tip_radius_mm, wheel_throat_radius_mm" in line


def test_contact_beyond_a_limit_everywhere_names_the_limit():
    """At a shaft angle of 120° the wheel is larger than the blank that was meant for 90°."""
    changes = {"design": {"shaft_angle_deg": 120.0}, "blank": {"wheel_tip_radius_mm": 200.0}}
    mesh = Mesh.of(Drive.load("plain-zk").with_(**changes))
    assert "beyond the throat of the wheel; change [blank]" in why_open(mesh)


def test_teeth_that_do_not_reach_each_other_say_so():
    mesh = Mesh.of(Drive.load("spherical-table-3-1-spur").with_(misalignment={"center_distance_mm": 20.0}))
    assert why_open(mesh).startswith("no turn of the wheel brings the bounded flanks together")


@pytest.mark.parametrize("name", ["recess-action-full", "spherical-table-2-1"])
def test_a_complete_window_needs_no_reason(name):
    assert why_open(Mesh.of(Drive.load(name))) is None


def test_a_full_width_oversize_hob_takes_the_backlash_away_and_cutting_deeper_gives_it():
    """Nothing is missing at the worm's own radius; what is missing beyond is regained by a smaller cutting distance."""
    drive = Drive.load("plain-za")
    radius = drive.design.value("worm_pitch_radius_mm")
    over = [drive.with_(design={"hob_pitch_radius_mm": radius * (1.0 + share)}) for share in (0.0005, 0.001)]
    assert backlash(over[0]) < 0.0
    assert backlash(over[1]) == pytest.approx(2.0 * backlash(over[0]), rel=0.01)
    distance = drive.design.value("cutting_center_distance_mm")
    assert backlash(drive) < 0.0 < backlash(drive.with_(design={"cutting_center_distance_mm": distance - 0.02}))
