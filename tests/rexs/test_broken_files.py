"""Broken files: each error names component and attribute, the value, and what helps; exit status 2."""

import pytest

from meshwright.cli import main
from tests.rexs.designs import file_text, worm_pair

DESIGN = worm_pair("ZN", "ZN")
del DESIGN["design"]["worm_pitch_radius_mm"]
DESIGN["design"]["worm_lead_angle_deg"] = 13.5
GOOD = file_text(DESIGN)


def attribute(name, text):
    """The element of an attribute of the file, the first of this name."""
    begin = text.index(f'<attribute id="{name}"')
    return text[begin : text.index("</attribute>", begin) + len("</attribute>")]


def replaced(name, old, new):
    """The file with a part of an attribute replaced."""
    element = attribute(name, GOOD)
    assert old in element
    return GOOD.replace(element, element.replace(old, new), 1)


def without(name):
    return GOOD.replace(attribute(name, GOOD), "", 1)


#: What is broken → (file, words that its error must hold).
BROKEN = {
    "unit": (replaced("normal_module", 'unit="mm"', 'unit="in"'), ["component 2 (worm_gear)", "normal_module", "'in'"]),
    "no unit": (replaced("lead", ' unit="mm"', ""), ["component 2 (worm_gear)", "attribute lead", "unit"]),
    "not a number": (replaced("lead_angle_worm_gear", "13.5", "13,5"), ["component 2", "lead_angle_worm_gear", "13,5"]),
    "not finite": (
        GOOD.replace(attribute("center_distance", GOOD), '<attribute id="center_distance" unit="mm">INF</attribute>'),
        ["component 1 (worm_stage)", "center_distance", "INF"],
    ),
    "not whole": (replaced("number_of_teeth", ">1<", ">1.5<"), ["component 2", "number_of_teeth", "1.5", "whole"]),
    "out of range": (
        replaced("lead_angle_worm_gear", "13.5", "113.5"), ["component 2", "lead_angle_worm_gear", "below 90"]
    ),
    "no word": (replaced("flank_form", ">zn<", ">zx<"), ["component 2 (worm_gear)", "flank_form", "'zx'", "za"]),
    "missing": (
        without("pressure_angle_worm_gear"), ["component 2 (worm_gear)", "pressure_angle_worm_gear", "missing"]
    ),
    "contradiction": (
        replaced("form_factor_worm_gear", "none\">", "none\">1"),
        ["component 2 (worm_gear)", "form_factor_worm_gear", "contradicts"],
    ),
    "array": (replaced("u_axis_vector", "<c>1.0</c>", ""), ["component 5 (shaft)", "u_axis_vector", "2 entries"]),
    "twice": (
        GOOD.replace(attribute("lead", GOOD), 2 * attribute("lead", GOOD), 1),
        ["component 2", "attribute lead", "twice"],
    ),
    "impossible": (
        replaced("lead_angle_worm_gear", "13.5", "0.0000013"), ["component 2", "contradicts"]
    ),
    "same id": (GOOD.replace('<component id="4"', '<component id="5"'), ["component 5", "id occurs twice"]),
    "no component": (GOOD.replace('<ref id="3" role="gear_2"/>', '<ref id="77" role="gear_2"/>'), ["77", "gear_2"]),
    "wrong gear": (
        GOOD.replace('<ref id="3" role="gear_2"/>', '<ref id="5" role="gear_2"/>'),
        ["component 1 (worm_stage)", "component 5 (shaft)", "worm_wheel"],
    ),
    "no stage": (GOOD.replace('type="worm_stage"', 'type="planetary_stage"'), ["component 1 (planetary_stage)"]),
    "old version": (GOOD.replace('version="2.0"', 'version="1.4"'), ["model", "version", "1.4"]),
    "document type": (GOOD.replace("<model", '<!DOCTYPE model [<!ENTITY x "y">]><model', 1), ["DOCTYPE"]),
    "not XML": (GOOD.replace("</components>", ""), ["line", "well-formed"]),
    "another encoding": (GOOD.replace("UTF-8", "ISO-8859-1"), ["ISO-8859-1"]),
    "another root": (GOOD.replace("<model", "<gears", 1).replace("</model>", "</gears>"), ["gears"]),
}


@pytest.mark.parametrize("broken", BROKEN)
def test_a_broken_file_is_refused(broken, tmp_path, capsys):
    text, words = BROKEN[broken]
    assert text != GOOD
    path, out = tmp_path / "broken.rexs", tmp_path / "out.toml"
    path.write_text(text, encoding="utf-8")
    assert main(["import", str(path), "--toml", str(out)]) == 2
    error = capsys.readouterr().err
    assert all(word in error for word in ["broken.rexs", *words]), error
    assert len(error.splitlines()) == 1 and not out.exists()
