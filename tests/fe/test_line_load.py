"""Loaded contact along lines and of what is nearly one: closed forms of lines, and what no load can do."""

import json
import math

import numpy as np
import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.commands import loading
from meshwright.design.design import toml_text
from meshwright.fe import cells, free_edges
from meshwright.fe.compliance import tooth_compliance
from meshwright.fe.gap import ContactPlane
from meshwright.fe.loaded import loaded_contact
from meshwright.fe.material import contact_modulus
from meshwright.fe.model import Load
from meshwright.fe.pair import first_touches, unloaded_wheel_angle
from meshwright.fe.solids import gear_pair
from meshwright.fe.strip import Strip
from tests.fe.line_designs import EQUAL_HOB, EQUAL_HOB_TABLES, FZG_C14, FZG_C14_TABLES, H501
from tests.independent import pressed_flanks
from tests.quick import quick

#: Peak in MPa by lead crowning in um of the C14 pair at the pitch point under 200 N m: half-spaces on rigid teeth whose
#: loads are mirrored 1.39 times at both ends, by cells of 0.1 mm along; 1 % off at most.
CROWNED = {0.1: 1364, 0.5: 1375, 1: 1388, 2: 1414, 5: 1491, 10: 1610, 20: 1805}

_ROOM = 0.01

#: Drives, pitches from angle 0 (None: the middle of the path), and the pair whose flanks brute force presses under a
#: load, within so many mm along and across.
PRESSED = (
    ("helical-crowned", 0.4, 1, Load(20e3, "pinion"), (3.8, 0.2)),
    ("bevel-formate", None, 0, Load(50e3, "wheel"), (5.4, 0.17)),
)

#: A drive of each family, and what puts it out of line.
_OUT_OF_LINE = (
    ("helical-crowned", "horizontal_deg"),
    ("spherical-table-4-4-concave", "horizontal_deg"),
    ("recess-action-full", "horizontal_deg"),
    ("bevel-formate", "shaft_angle_deg"),
    ("face-worm-conical-convex", "shaft_angle_deg"),
)


def _crowned(micrometres):
    return FZG_C14.with_(design={"pinion_lead_crowning_um": micrometres})


def _strips(gear, angle, pairs):
    """Contact and strip of all pairs at an angle."""
    contacts = first_touches(gear, angle, pairs)
    angles = angle, unloaded_wheel_angle(gear, contacts)
    return [(contact, Strip.of(ContactPlane.of(gear, contact, angles))) for contact in contacts]


def _lines(gear, angle, pairs):
    """Those of the pairs that touch first along a line."""
    return [(contact, strip) for contact, strip in _strips(gear, angle, pairs) if not contact.touch.edge]


def _line(strip):
    """Length of the curve of smallest gap on both flanks, integral of it over curvature, curvatures at its ends."""
    profile = strip.profile
    on_both = np.isfinite(profile.gap) & (profile.offset == 0.0)
    along, curvature = profile.along[on_both], profile.curvature[on_both]
    lengths = strip.lengths(along)
    return np.trapezoid(lengths, along), np.trapezoid(lengths / curvature, along), sorted(curvature[[0, -1]])


@pytest.mark.parametrize(
    ("drive", "torque", "force", "length", "least"),
    [
        (FZG_C14, 200.0, 5912.1, 14.0, 1346.28),
        (FZG_C14, 626.0, 18504.9, 14.0, 2381.81),
        (H501, 100.0, 3040.51, 14.43338, 944.33),
    ],
    ids=["C14", "C14-626", "H501"],
)
def test_forces_lengths_and_least_peaks_of_lines(drive, torque, force, length, least):
    """F = T/(r_b cos β_b), and what one pressure all along would give: √(F E*/(π ∫dl/κ)).  No peak is below that."""
    gear = gear_pair(drive)
    ((_, strip),) = _lines(gear, 0.0, 3)
    found_length, integral, _ = _line(strip)
    assert found_length == pytest.approx(length, abs=2e-5)
    modulus = contact_modulus(gear.pinion.material, gear.wheel.material)
    assert math.sqrt(force * modulus / (math.pi * integral)) == pytest.approx(least, rel=1e-4)
    found = loaded_contact(gear, 0.0, 3, Load(1000.0 * torque, "pinion"), None)
    assert not found.unresolved
    (pair,) = found.pairs
    assert pair.force == pytest.approx(force, rel=1e-5)
    assert pair.peak_pressure > least


@pytest.mark.parametrize("micrometres", quick(CROWNED, 0.1, 2))
def test_crowned_from_a_line_on(micrometres, monkeypatch):
    """Without bodies of teeth, images of both ends go all along."""
    whole = free_edges._edges

    def ends(grid, name):
        return [edge for edge in whole(grid, name) if edge.axis == 1]

    monkeypatch.setattr(free_edges, "_edges", ends)
    monkeypatch.setattr(free_edges, "_weight", np.ones_like)
    found = loaded_contact(gear_pair(_crowned(micrometres)), 0.0, 3, Load(200e3, "pinion"), None)
    assert not found.unresolved
    assert found.pairs[0].peak_pressure == pytest.approx(CROWNED[micrometres], rel=_ROOM)


@pytest.mark.validate
@pytest.mark.parametrize("torque", [200.0, 626.0])
@pytest.mark.parametrize(
    ("drive", "force", "least"), [(FZG_C14, 5912.1, 1346.28), (H501, 3040.51, 944.33)], ids=["C14", "H501"]
)
def test_less_crowning_leads_to_the_line(drive, force, least, torque):
    """In steps from 20 um to none, elastic teeth: no step leaves the way between its neighbours by 1 %, and none has
    less than the line under the same force.
    """
    gear = gear_pair(drive)
    teeth = {name: tooth_compliance(getattr(gear, name)) for name in ("pinion", "wheel")}
    peaks, lines = [], []
    for micrometres in np.linspace(20.0, 0.0, 13):
        crowned = gear_pair(drive.with_(design={"pinion_lead_crowning_um": float(micrometres)}))
        found = loaded_contact(crowned, 0.0, 3, Load(1000.0 * torque, "pinion"), teeth)
        assert not found.unresolved
        pair = next(pair for pair in found.pairs if pair.contact.pairs_later == 0)
        peaks.append(pair.peak_pressure)
        lines.append(least * math.sqrt(pair.force / force))
    peaks = np.array(peaks)
    assert np.abs(peaks[1:-1] / (0.5 * (peaks[2:] + peaks[:-2])) - 1.0).max() < _ROOM
    assert (peaks > lines).all() and peaks[-1] < 1.03 * lines[-1]


def _worm(micrometres):
    """The equal hob's drive with one so much larger that flanks part by micrometres half a face from contact."""
    derived = "cutting_center_distance_mm", "cutting_shaft_angle_deg"
    design = {key: value for key, value in EQUAL_HOB_TABLES["design"].items() if key not in derived}
    larger = {"hob_pitch_radius_mm": 20.0 + 0.0142 * micrometres}
    return Drive.from_tables(EQUAL_HOB_TABLES | {"design": design | larger})


@pytest.mark.validate
def test_a_contact_that_grows_beyond_a_sharp_tip_keeps_the_peak_of_its_free_part():
    """Less crowning lengthens the ellipse beyond the worm's tip, which presses the wheel's flank with more and more."""
    peaks, highest = [], []
    for micrometres in np.linspace(20.0, 10.0, 7):
        found = loaded_contact(gear_pair(_worm(micrometres)), 0.0, 3, Load(200e3, "wheel"), None)
        assert not found.unresolved
        pair = next(pair for pair in found.pairs if pair.contact.pairs_later == -1)
        peaks.append(pair.peak_pressure)
        highest.append(pair.pressures.max())
    peaks = np.array(peaks)
    assert np.abs(peaks[1:-1] / (0.5 * (peaks[2:] + peaks[:-2])) - 1.0).max() < _ROOM
    assert highest[0] == peaks[0] and highest[-1] > 1.3 * peaks[-1]


@pytest.mark.parametrize(("name", "pitches", "later", "load", "reach"), quick(PRESSED, PRESSED[0]))
def test_flanks_that_curve_as_they_like_press_as_brute_force_has_it(name, pitches, later, load, reach, monkeypatch):
    """Beside the base circle curvature changes within the contact: the peak is 17 % below Hertz's, half-spaces alone.
    Ellipses of bevel gears are some millimetres long: it is 1 % above.
    """
    monkeypatch.setattr(cells, "free_edge_displacements", lambda *_: None)
    drive = Drive.load(name)
    gear = gear_pair(drive)
    if pitches is None:
        window = drive.contact_ratio()
        pitches = 0.5 * (window.begin.angle + window.end.angle) / gear.pinion.pitch
    found = loaded_contact(gear, pitches * gear.pinion.pitch, 3 if later else 1, load, None)
    pair = next(pair for pair in found.pairs if pair.contact.pairs_later == later)
    modulus = contact_modulus(gear.pinion.material, gear.wheel.material)
    expected = pressed_flanks.peak_pressure(drive, pair.contact.touch, pair.force, modulus, reach, (128, 64))
    assert pair.peak_pressure == pytest.approx(expected, rel=_ROOM)


def test_a_tilted_line_touches_on_an_edge_and_tends_to_the_line():
    """Shafts out of line: the end of a face touches first; less and less of it leads to the load along the line."""
    peaks = []
    for degrees in (0.01, 0.001, 0.0):
        gear = gear_pair(FZG_C14.with_(misalignment={"vertical_deg": degrees}))
        found = loaded_contact(gear, 0.0, 1, Load(200e3, "pinion"), None)
        pair = next(pair for pair in found.pairs if pair.contact.pairs_later == 0)
        assert not found.unresolved and bool(pair.contact.touch.edge) == (degrees > 0.0)
        assert pair.force == pytest.approx(5912.1, rel=1e-4)
        peaks.append(pair.peak_pressure)
    assert peaks[0] > peaks[1] > 1346.28 and peaks[1] == pytest.approx(peaks[2], rel=_ROOM)


def test_an_equal_hob_gives_three_curved_lines_that_share_the_torque():
    """The least peak of all three together under 300 N m on the wheel."""
    gear = gear_pair(EQUAL_HOB)
    modulus, whole = contact_modulus(gear.pinion.material, gear.wheel.material), 0.0
    lines = _lines(gear, 0.0, 5)
    assert [contact.pairs_later for contact, _ in lines] == [-1, 0, 1]
    origin, axis = gear.wheel.axis
    for contact, strip in lines:
        touch, (length, integral, ends) = contact.touch, _line(strip)
        lever = abs(float(np.cross(touch.point - origin, touch.normal) @ axis))
        whole += lever * integral
        if contact.pairs_later == 0:
            assert length == pytest.approx(24.57378, abs=2e-4)
            assert ends == pytest.approx([0.0303573, 0.0462716], rel=1e-4)
            assert lever == pytest.approx(73.715554, rel=1e-7)
    assert math.sqrt(300e3 * modulus / (math.pi * whole)) == pytest.approx(356.31, rel=1e-4)


@pytest.mark.parametrize(
    "tables",
    [
        pytest.param(FZG_C14_TABLES, id="spur"),
        pytest.param(EQUAL_HOB_TABLES, id="equal-hob", marks=pytest.mark.validate),
    ],
)
def test_the_command_has_lines(tables, capsys, monkeypatch, tmp_path):
    monkeypatch.setattr(loading, "compliances", lambda *_: None)
    design = tmp_path / "design.toml"
    design.write_text(toml_text(tables))
    assert main(["loaded", str(design), "--torque-nm", "200", "--phi-deg=0", "--json", "-"]) == 0
    (point,) = json.loads(capsys.readouterr().out)["points"]
    assert point["status"] == "converged"
    assert {pair["kind"] for pair in point["pairs"]} == {"line"}
    assert sum(pair["share"] for pair in point["pairs"]) == pytest.approx(1.0)
    assert all(pair["hertz_semi_major_mm"] is None for pair in point["pairs"])
    # Edges end lines: only a peak of pressure there is worth a word.
    assert ("cut off" in point["message"]) == any(pair["peak_at_edge"] for pair in point["pairs"])


def _neighbour(random):
    """A drive of any family somewhat out of line, or a cylindrical pair with crowning from none to much."""
    if random.random() < 0.5:
        name, key = random.choice(_OUT_OF_LINE)
        return Drive.load(str(name)).with_(misalignment={str(key): float(random.uniform(-0.02, 0.02))})
    drive = [FZG_C14, H501][random.integers(2)]
    return drive.with_(design={"pinion_lead_crowning_um": float(10.0 ** random.uniform(-3.0, 1.3))})


@pytest.mark.parametrize("seed", quick(range(24), 0, 1))
def test_no_converged_result_breaks_a_gate(seed):
    """Random loads on random neighbours of drives of all families: the moment is the torque, no pressure is left at a
    free border of the cells, and no peak is below the least with which lines carry the force.
    """
    random = np.random.default_rng(seed)
    gear = gear_pair(_neighbour(random))
    angle, torque = float(random.uniform(-0.5, 0.5)) * gear.pinion.pitch, float(10.0 ** random.uniform(0.0, 2.3))
    if not first_touches(gear, angle, 3):
        return
    found = loaded_contact(gear, angle, 3, Load(1000.0 * torque, "pinion"), None)
    if found.unresolved:
        return
    origin, axis = gear.pinion.axis
    modulus = contact_modulus(gear.pinion.material, gear.wheel.material)
    moment, strips = 0.0, {contact.pairs_later: strip for contact, strip in _strips(gear, angle, 3)}
    for pair in found.pairs:
        arms = np.abs(np.cross(pair.grid.points - origin, pair.grid.frame[:, 2]) @ axis)
        moment += float((pair.grid.area * pair.pressures) @ arms)
        assert not pair.pressures[pair.grid.free[1]].any()
        profile = strips[pair.contact.pairs_later].profile
        on_both = np.isfinite(profile.gap)
        if (profile.curvature[on_both] > 0.0).all():  # a hollow gap has no line
            integral = float(np.sum(profile.length[on_both] / profile.curvature[on_both]))
            assert pair.peak_pressure >= 0.98 * math.sqrt(pair.force * modulus / (math.pi * integral))
        assert pair.peak_pressure >= pair.force / pair.grid.area.sum()
    assert moment == pytest.approx(1000.0 * torque, rel=1e-3)
