"""Designs through REXS files and files through designs: the mapped keys to 1e-12, foreign parts to the byte."""

import math
import random

import pytest

from meshwright.design import design as designs
from meshwright.rexs.document import RexsError, parsed
from meshwright.rexs.writing import file_of
from tests.rexs.designs import CROSSED, HELICAL, PAIRS, complete, file_text, named, read_text, worm_pair


def key_values(tables):
    """Values by "table.key"."""
    return {f"{t}.{k}": v for t, entries in tables.items() if isinstance(entries, dict) for k, v in entries.items()}


@pytest.mark.parametrize("tables", PAIRS, ids=named)
def test_mapped_keys_come_back(tables):
    written = file_of(tables, "0")
    read = read_text(written.content.decode())
    mapped, back = {entry["key"] for entry in written.report["mapped"]}, key_values(read.tables)
    before, after = complete(tables), complete(read.tables)
    given = key_values(tables)
    assert given.keys() <= mapped | {entry.get("key") for entry in written.report["unmapped"]}
    for key in given.keys() & mapped & back.keys():
        expected = given[key]
        assert back[key] == (expected if isinstance(expected, str) else pytest.approx(expected, rel=1e-12, abs=0)), key
    for symbol, number in before.items():
        assert after[symbol] == pytest.approx(number, rel=1e-12, abs=1e-15, nan_ok=True), symbol


def test_a_design_from_a_drawing_is_written_with_the_keys_that_follow():
    """The tip by its diameter, the helix angle without a sign and the hand: the same file as by the keys."""
    design = {k: v for k, v in HELICAL["design"].items() if "helix_angle" not in k}
    angle = HELICAL["design"]["pinion_helix_angle_deg"]
    by_keys = HELICAL | {"design": design | {"pinion_helix_angle_deg": angle, "wheel_helix_angle_deg": -angle},
                         "blank": {"pinion_tip_radius_mm": 34.1}}  # fmt: skip
    drawn = {"helix_angle_deg": abs(angle), "pinion_hand": "right" if angle > 0 else "left"}
    by_drawing = HELICAL | {"design": design | drawn, "blank": {"pinion_tip_diameter_mm": 68.2}}
    one, other = (read_text(file_of(tables, "0").content.decode()).tables for tables in (by_keys, by_drawing))
    assert other == one


@pytest.mark.parametrize("tables", PAIRS, ids=named)
def test_a_key_has_another_name_at_most_in_an_exclusive_group(tables):
    """What is mapped and is not written back under its name determines, and is determined by, what is."""
    written = file_of(tables, "0")
    back = key_values(read_text(written.content.decode()).tables)
    lost = key_values(tables).keys() & {entry["key"] for entry in written.report["mapped"]} - back.keys()
    assert lost <= {"design.axial_module_mm", "design.worm_pitch_radius_mm"}


@pytest.mark.parametrize("tables", [worm_pair("ZN", "ZN"), worm_pair("ZC", "ZA"), HELICAL], ids=named)
def test_what_is_written_again_is_the_same_file(tables):
    text = file_text(tables)
    assert file_of(read_text(text).tables, "0", parsed(text.encode(), "FILE.rexs")).content.decode() == text


FOREIGN_COMPONENT = """<component id="900" name="Öl &amp; mehr" type="lubricant">
        <!-- a comment stays -->
        <attribute unit="kg / dm^3"   id="density_at_15_degree_celsius">0.890</attribute></component>"""
FOREIGN_ATTRIBUTE = """<attribute id="length_worm_gear" unit="mm">61.50</attribute>"""
SPECTRUM = """<load_spectrum id="1"><load_case id="1"><component id="1"/></load_case></load_spectrum>
  <other:thing xmlns:other="urn:other" a='1>0'>x</other:thing>"""


def with_foreign_parts(text):
    text = text.replace("</components>", f"  {FOREIGN_COMPONENT}\n  </components>\n  {SPECTRUM}")
    text = text.replace('type="worm_gear">', f'type="worm_gear">\n   {FOREIGN_ATTRIBUTE}', 1)
    text = text.replace(">20.0</attribute>", ">2.0e+1</attribute>")
    return text.replace("\n", "\r\n")


def test_foreign_parts_stay_to_the_byte():
    tables = worm_pair("ZN", "ZN")
    tables["design"]["pressure_angle_deg"] = 20.0
    text = with_foreign_parts(file_text(tables))
    read = read_text(text)
    again = file_of(read.tables, "0", parsed(text.encode(), "FILE.rexs")).content.decode()
    assert again == text
    foreign = {(e["component"], e["attribute"]) for e in read.report["unmapped"] if "component" in e}
    assert {("lubricant", "density_at_15_degree_celsius"), ("worm_gear", "length_worm_gear")} <= foreign


def test_a_changed_design_changes_its_attributes_alone():
    text = with_foreign_parts(file_text(worm_pair("ZN", "ZN")))
    changed = designs.changed(read_text(text).tables, {"blank.worm_tip_radius_mm": 34.0})
    again = file_of(changed, "0", parsed(text.encode(), "FILE.rexs")).content.decode()
    assert again == text.replace(">67.8<", ">68.0<")


def test_what_the_file_has_no_place_for_is_added():
    text = file_text(worm_pair("ZN", "ZN"))
    changed = designs.changed(
        read_text(text).tables, {"design.worm_profile": "ZK", "design.grinding_wheel_radius_mm": 123.0}
    )
    again = file_of(changed, "0", parsed(text.encode(), "FILE.rexs")).content.decode()
    lines, old = again.splitlines(), text.splitlines()
    assert not [line for line in old if line not in lines]
    assert lines.count('      <attribute id="flank_form" unit="none">zk</attribute>') == 1
    assert read_text(again).tables["design"] == changed["design"]


@pytest.mark.parametrize("seed", range(6))
def test_what_a_file_does_not_hold_is_in_the_report_of_who_reads_it(seed):
    """Flank modifications, errors of assembly, …: a random part of the keys that REXS lacks."""
    chance = random.Random(seed)
    lost = {"pinion_lead_crowning_um": 5.0, "wheel_profile_crowning_um": -3.25, "pinion_flank_twist_um": 1e-5}
    lost = dict(chance.sample(sorted(lost.items()), chance.randint(1, 3)))
    tables = HELICAL | {"design": HELICAL["design"] | lost}
    text = file_text(tables)
    report = read_text(text).report
    said = {e["key"]: e["reason"] for e in report["unmapped"] if "key" in e}
    for key, value in lost.items():
        assert repr(value) in said[f"design.{key}"] and "not written" in said[f"design.{key}"]
    taken = tables | {"design": HELICAL["design"] | dict.fromkeys(lost, 1.5)}
    again = file_of(taken, "0", parsed(text.encode(), "FILE.rexs")).content.decode()
    assert again.count("left out of this file") == 1 and '"design.' + next(iter(lost)) + '": 1.5' in again
    begins = "left out of this file: "
    damaged = text.replace(begins + "{", begins + chance.choice(("{{", "[", "[1] ", "")), 1)
    with pytest.raises(RexsError, match="remark on what was left out: damaged; remove it"):
        read_text(damaged)


@pytest.mark.parametrize("seed", range(4))
def test_every_attribute_of_a_file_is_mapped_or_reported(seed):
    """Those of load cases and of what else a file may hold, at any depth, as many as there are."""
    chance = random.Random(seed)
    names = [f"speed_{k}" for k in range(chance.randint(1, 9))]
    cases = "".join(
        f'<load_case id="{k}"><component id="2"><attribute id="{name}">{k}</attribute></component></load_case>'
        for k, name in enumerate(names)
    )
    spectrum = f'<load_spectrum id="7">{cases}<x><attribute id="odd"/></x></load_spectrum>'
    text = file_text(HELICAL).replace("</components>", f"</components>{spectrum}")
    report = read_text(text).report
    said = {e["attribute"]: e for e in report["unmapped"] if e.get("attribute") in {*names, "odd"}}
    assert {*said} == {*names, "odd"}
    assert said[names[0]]["reason"].startswith("under load spectrum 7, load case 0, component 2")
    assert said[names[0]]["component"] == parsed(text.encode(), "").components["2"].type
    held = {(e["id"], e["attribute"]) for e in (*report["mapped"], *report["unmapped"]) if "component" in e}
    listed = {(c.id, a) for c in parsed(text.encode(), "").components.values() for a in c.attributes}
    assert listed <= held


def test_byte_order_mark_and_no_namespace():
    tables = worm_pair("ZI", "ZI")
    text = file_text(tables).replace(' xmlns="https://www.rexs.info"', "")
    source = b"\xef\xbb\xbf" + text.encode()
    read = read_text(text)
    assert read.tables == read_text(file_text(tables)).tables
    changed = designs.changed(read.tables, {"design.worm_threads": 7})
    again = file_of(changed, "0", parsed(source, "FILE.rexs")).content
    assert again.startswith(b'\xef\xbb\xbf<?xml') and b'id="number_of_teeth" unit="none">7<' in again


def test_one_stage_of_several():
    first, second = file_text(worm_pair("ZN", "ZN")), file_text(CROSSED)
    for k in range(30, 0, -1):
        second = second.replace(f'id="{k}"', f'id="{k + 100}"')

    def inside(text, tag):
        return text.split(f"<{tag}>")[1].split(f"</{tag}>")[0]

    both = first
    for tag in ("relations", "components"):
        both = both.replace(f"</{tag}>", f"{inside(second, tag)}</{tag}>")
    assert read_text(both, "101").tables == read_text(second).tables
    assert read_text(both, "1").tables == read_text(first).tables


def test_the_hob_by_its_lead_alone():
    """p/tan λ with cos λ = π·m_n·T/lead: the radius of a hob whose tip is not known (closed form)."""
    tables = worm_pair("ZN", "ZN")
    del tables["blank"]
    tables["design"] |= {"hob_threads": 3}
    radius = read_text(file_text(tables)).tables["design"]["hob_pitch_radius_mm"]
    assert radius == pytest.approx(tables["design"]["hob_pitch_radius_mm"], rel=1e-12)


def test_two_ways_to_the_hob_that_differ_are_both_reported():
    tables = designs.changed(worm_pair("ZN", "ZN"), {"design.hob_lead_angle_deg": 10.0})
    read = read_text(file_text(tables))
    (entry,) = [e for e in read.report["assumed"] if e["key"] == "design.hob_pitch_radius_mm"]
    symbols = complete(tables)
    lead = 2 * math.pi * symbols["r_hob"] * math.tan(math.radians(10.0))
    cosine = math.pi * symbols["m_n"] * symbols["T_hob"] / lead
    other = lead / (2 * math.pi * math.tan(math.acos(cosine))) if cosine < 1 else None
    assert entry["value"] == pytest.approx(symbols["r_hob"], rel=1e-12)
    assert repr(other)[:10] in entry["reason"]
    assert read.tables["design"]["hob_lead_angle_deg"] == pytest.approx(10.0, rel=1e-12)


def test_what_rexs_does_not_say_is_reported():
    written = file_of(worm_pair("ZA", "ZK"), "0").report
    read = read_text(file_text(worm_pair("ZA", "ZK"))).report
    for report in (written, read):
        assumed = {entry["key"] for entry in report["assumed"]}
        assert {
            "design.pressure_angle_deg", "design.grinding_wheel_radius_mm", "design.hand",
            "misalignment.center_distance_mm", "misalignment.horizontal_deg", "misalignment.vertical_deg",
            "misalignment.axial_mm",
        } <= assumed  # fmt: skip
    assert {"flank"} <= {entry.get("key") for entry in written["unmapped"]}
    assert {"flank", "design.pitch_line_shift_mm"} <= {entry["key"] for entry in read["assumed"]}
