"""What drawings of cylindrical gears state: handbook values, closed forms, and designs given by any of their sizes.

Values: KHK Gear Technical Reference (span), SDP/SI Elements of Metric Gear Technology, Table 10-1 (chord), and ISO
21771 and ISO 1328-1 evaluated to 40 digits.
"""

import json
import math
import random

import pytest

from meshwright import DesignError, Drive
from meshwright.cli import main
from meshwright.contact.results import TOUCHING
from meshwright.design import description as metadata
from tests.cylindrical_gears.designs import tables

HELICAL = {
    "pinion_teeth": 23, "wheel_teeth": 58, "helix_angle_deg": 14, "pinion_profile_shift_coefficient": 0.2,
    "wheel_profile_shift_coefficient": 0.1, "face_width_mm": 30,
}  # fmt: skip
THINNED = {**HELICAL, "pinion_thickness_allowance_um": -50, "wheel_thickness_allowance_um": -70}


def drawn(design, blank=None):
    return Drive.from_tables(tables(design, blank=blank)).drawing()


CASES = [
    ({"pinion_teeth": 24, "wheel_teeth": 24, "pinion_profile_shift_coefficient": 0.4, "pinion_span_teeth": 4},
     {"pinion_span_mm": 32.82662725}),
    ({"pinion_teeth": 24, "wheel_teeth": 24, "helix_angle_deg": 25, "pinion_profile_shift_coefficient": 0.4,
      "pinion_span_teeth": 5}, {"pinion_span_mm": 42.00847177}),
    ({"normal_module_mm": 10, "pinion_teeth": 12, "wheel_teeth": 24, "pinion_profile_shift_coefficient": 0.3},
     {"pinion_normal_thickness_mm": 17.8918, "pinion_chordal_thickness_mm": 17.8256,
      "pinion_chordal_height_mm": 13.6657}),
    (HELICAL, {"center_distance_mm": 126.098149, "transverse_contact_ratio": 1.552722914,
               "overlap_ratio": 0.770061311, "pinion_span_mm": 32.460995, "pinion_form_diameter_mm": 67.535773,
               "pinion_tip_thickness_mm": 1.970236}),
    (THINNED, {"normal_backlash_mm": 0.112763114, "circumferential_backlash_mm": 0.124541382,
               "radial_backlash_mm": 0.157270744, "wheel_backlash_deg": 0.079028661,
               "pinion_root_diameter_mm": 64.674967, "pinion_span_mm": 32.414011}),
    ({"pinion_teeth": 20, "wheel_teeth": 30, "face_width_mm": 30, "pinion_flank_tolerance_class": 5},
     {"pinion_single_pitch_tolerance_um": 6.26, "pinion_total_pitch_tolerance_um": 18.4803,
      "pinion_total_profile_tolerance_um": 8.4788, "pinion_total_helix_tolerance_um": 9.4256}),
]  # fmt: skip


@pytest.mark.parametrize(("design", "sizes"), CASES)
def test_sizes_are_those_of_handbooks_and_standards(design, sizes):
    """To the last digit printed."""
    found = drawn(design).sizes
    for key, value in sizes.items():
        digits = len(repr(value).partition(".")[2])
        assert found[key].value == pytest.approx(value, abs=0.51 * 10.0**-digits), key


def test_two_classes_coarser_are_twice_as_wide():
    five, seven = (drawn(HELICAL | {"wheel_flank_tolerance_class": a}).sizes for a in (5, 7))
    for kind in ("single_pitch", "total_pitch", "total_profile", "total_helix"):
        key = f"wheel_{kind}_tolerance_um"
        assert seven[key].value == pytest.approx(2 * five[key].value, rel=1e-12)


def test_the_tool_that_thins_the_teeth_cuts_deeper_and_leaves_the_tip():
    nominal, thin = (Drive.from_tables(tables(d)).design for d in (HELICAL, THINNED))
    deeper = 0.05 / (2 * math.tan(math.radians(20)))
    lowered = nominal.sizes["pinion_root_radius_mm"] - thin.sizes["pinion_root_radius_mm"]
    assert lowered == pytest.approx(deeper, abs=1e-12)
    assert thin.value("pinion_tip_radius_mm", "blank") == nominal.value("pinion_tip_radius_mm", "blank")
    assert thin.sizes["pinion_limit_radius_mm"] < nominal.sizes["pinion_limit_radius_mm"]


def test_the_flanks_lie_apart_by_the_backlash_of_the_drawing():
    """The transmission errors of the two flanks differ by the backlash, angle of the wheel (ISO 21771)."""
    crowned = THINNED | {"pinion_lead_crowning_um": 5, "pinion_profile_crowning_um": 5}
    drive = Drive.from_tables(tables(crowned))
    left, right = drive, drive.with_(flank="right")
    shown = [d.tca([0.0]) for d in (left, right)]
    assert all(r.status[0] in TOUCHING for r in shown)
    apart = abs(shown[0].error[0] - shown[1].error[0])
    assert math.degrees(apart) == pytest.approx(drive.drawing().sizes["wheel_backlash_deg"].value, rel=1e-2)


GIVEN_INSTEAD = [
    ({"normal_module_mm": None, "transverse_module_mm": 3 / math.cos(math.radians(14))}, {}),
    ({"normal_module_mm": None, "normal_diametral_pitch_per_in": 25.4 / 3}, {}),
    ({"normal_module_mm": None, "normal_module_in": 3 / 25.4}, {}),
    ({"helix_angle_deg": None, "transverse_module_mm": 3 / math.cos(math.radians(14))}, {}),
    ({"face_width_mm": None, "pinion_face_width_mm": 30, "wheel_face_width_mm": 30}, {}),
    ({"pinion_thickness_allowance_um": None, "pinion_normal_thickness_mm": 5.0991533}, {}),
    ({"pinion_thickness_allowance_um": None, "pinion_span_teeth": 4, "pinion_span_mm": 32.4140107}, {}),
    ({"pinion_thickness_allowance_um": None, "pinion_thickness_upper_allowance_um": -40,
      "pinion_thickness_lower_allowance_um": -60}, {}),
    ({"pinion_thickness_allowance_um": None, "radial_backlash_mm": 0.157270744}, {}),
    ({"wheel_profile_shift_coefficient": None, "center_distance_mm": 126.0981490,
      "normal_backlash_mm": 0.112763114}, {}),
    ({}, {"pinion_tip_diameter_mm": 78.3125}), ({}, {"pinion_root_diameter_mm": 64.674967}),
    ({"helix_angle_deg": 14, "pinion_hand": "right"}, {"wheel_tip_diameter_in": 7.33}),
]  # fmt: skip


@pytest.mark.parametrize(("instead", "blank"), GIVEN_INSTEAD)
def test_a_design_may_be_given_by_other_sizes_of_the_same_drawing(instead, blank):
    design = {"normal_module_mm": 3.0, **THINNED} | instead
    given = {key: value for key, value in design.items() if value is not None}
    document = {"drive": "cylindrical-gears", "design": {"pressure_angle_deg": 20, **given}, "blank": blank}
    solved = Drive.from_tables(document).drawing().sizes
    whole = drawn(THINNED).sizes
    for key in ("normal_module_mm", "pinion_helix_angle_deg", "wheel_helix_angle_deg", "center_distance_mm",
                "pinion_thickness_allowance_um", "wheel_thickness_allowance_um", "face_width_mm"):  # fmt: skip
        tolerance = 0.02 if key.endswith("um") else 2e-6
        assert solved[key].value == pytest.approx(whole[key].value, rel=2e-6, abs=tolerance), key


REFUSED = [
    ({"normal_diametral_pitch_per_in": 10}, {}, ("normal_module_mm = 3.0", "pitch_per_in = 10", "2.54")),
    ({"normal_module_in": 0.1}, {}, ("normal_module_mm = 3.0", "normal_module_in = 0.1", "2.54")),
    ({"pinion_normal_thickness_mm": 4.6, "pinion_thickness_allowance_um": -50}, {},
     ("pinion_normal_thickness_mm = 4.6", "pinion_thickness_allowance_um = -50", "difference")),
    ({"pinion_helix_angle_deg": 14, "pinion_hand": "left"}, {}, ("pinion_helix_angle_deg = 14", "pinion_hand = left")),
    ({}, {"pinion_tip_diameter_mm": 75.0, "pinion_tip_radius_mm": 37.4}, ("tip_diameter_mm = 75", "37.4", "74.8")),
    ({}, {"pinion_root_diameter_mm": 61.5, "wheel_root_diameter_mm": 166}, ("pinion_root", "wheel_root", "0.5")),
    ({"normal_backlash_mm": 0.1, "pinion_thickness_allowance_um": -10, "wheel_thickness_allowance_um": -10}, {},
     ("normal_backlash_mm = 0.1", "pinion_thickness_allowance_um = -10", "wheel_thickness", "0.0187938524")),
    ({"pinion_span_mm": 23.0}, {}, ("pinion_span_mm = 23", "pinion_span_teeth")),
    ({"wheel_teeth": -60}, {}, ("wheel_teeth = -60", 'drive = "internal-gears"')),
    ({"wheel_teeth": -60, "wheel_kind": "external"}, {}, ("wheel_teeth = -60", "wheel_kind = external")),
    ({"wheel_kind": "internal"}, {}, ("wheel_kind = 'internal'", "wheel_teeth = 58")),
    ({"wheel_kind": "rack"}, {}, ("wheel_kind = 'rack'", "none travels", "10000")),
    ({"wheel_kind": "planet"}, {}, ("wheel_kind = 'planet'", "external")),
    ({"pinion_span_mm": "wide"}, {}, ("pinion_span_mm = 'wide'", "must be a number")),
    ({"face_width_in": -1}, {}, ("face_width_in = -1", "greater than 0")),
]  # fmt: skip


@pytest.mark.parametrize(("design", "blank", "words"), REFUSED)
def test_what_contradicts_or_leaves_open_is_refused_with_both_keys(design, blank, words):
    with pytest.raises(DesignError) as caught:
        Drive.from_tables(tables({"pinion_teeth": 23, "wheel_teeth": 58} | design, blank=blank))
    for word in words:
        assert word in str(caught.value)


def test_a_missing_module_is_answered_with_what_gives_one():
    document = tables({"pinion_teeth": 23, "wheel_teeth": 58})
    del document["design"]["normal_module_mm"]
    with pytest.raises(DesignError, match="normal_module_mm: the key is missing.*transverse_module_mm or "):
        Drive.from_tables(document)


def standard(draw):
    """A standard pair at random."""
    beta = draw.choice([0.0, draw.uniform(5, 30)])
    return {
        "normal_module_mm": draw.choice([1.0, 2.0, 2.5, 4.0, 8.0]), "pinion_teeth": draw.randint(18, 40),
        "wheel_teeth": draw.randint(30, 90), "pinion_helix_angle_deg": beta,
        "pinion_profile_shift_coefficient": draw.uniform(0, 0.4),
        "wheel_profile_shift_coefficient": draw.uniform(-0.1, 0.3),
        "pinion_thickness_allowance_um": draw.uniform(-80, 0), "wheel_thickness_allowance_um": draw.uniform(-80, 0),
    }  # fmt: skip


@pytest.mark.parametrize("seed", range(8))
def test_the_completed_drawing_is_the_completed_design(seed):
    """Relations in Python and rules in C complete a design alike."""
    draw = random.Random(seed)
    document = tables(standard(draw))
    design = Drive.from_tables(document).design
    solved, sizes = design.as_solved(), Drive.from_tables(document).drawing().sizes
    for table in ("design", "blank"):
        for key, number in solved[table].items():
            if isinstance(number, float) and key in sizes:
                assert sizes[key].value == pytest.approx(number, rel=1e-11, abs=1e-11), key


@pytest.mark.parametrize("seed", range(4))
def test_a_size_beside_all_those_that_determine_it_is_accepted_or_contradicts_one_of_them(seed):
    """Any derived size, beside all keys of the design and what else was assumed: as it is, it is accepted; moved, it is
    refused.
    """
    draw = random.Random(seed)
    document = tables(standard(draw))
    drawing = metadata.families()["cylindrical-gears"].drawing
    sizes = Drive.from_tables(document).drawing().sizes
    beside = [p for place, p in drawing.places.items() if place in drawing.beside and p["key"] in sizes]
    whole = {key: sizes[key].value for key in ("center_distance_mm", "basic_rack_dedendum_mm")} | document["design"]
    whole |= {p["key"]: sizes[p["key"]].value for p in beside if sizes[p["key"]].provenance == "assumed"}
    derived = [p for p in beside if sizes[p["key"]].provenance == "derived"]
    for p in draw.sample(derived, 6):
        given, value = tables(whole), sizes[p["key"]].value
        given[p["table"]][p["key"]] = value
        Drive.from_tables(given)
        given[p["table"]][p["key"]] = value * 1.01 + 0.01
        with pytest.raises(DesignError, match="contradicts") as caught:
            Drive.from_tables(given)
        assert f"{p['table']}.{p['key']} = " in str(caught.value)


def test_the_command_writes_the_drawing(capsys):
    assert main(["drawing", "helical-crowned", "--set", "design.pinion_thickness_allowance_um=-40", "--json", "-"]) == 0
    written = json.loads(capsys.readouterr().out)
    assert written["schema"] == "meshwright.drawing/1"
    assert written["drive"] == "cylindrical-gears"
    size = written["sizes"]["pinion_normal_thickness_mm"]
    assert set(size) == {"value", "symbol", "provenance", "relation"}
    assert size["provenance"] == "derived"
    assert written["sizes"]["normal_module_mm"]["provenance"] == "given"
    assert written["sizes"]["pinion_tip_radius_mm"]["provenance"] == "assumed"
    assert written["checks"]["undercut_pinion"] == {"occurs": False, "margin": pytest.approx(11.9, abs=0.5)}


@pytest.mark.parametrize("name", ["bevel-hypoid", "plain-zi", "spherical-table-2-1", "face-worm-conical-concave"])
def test_every_family_has_a_drawing(name, capsys):
    assert main(["drawing", name]) == 0
    assert "given" in capsys.readouterr().out
