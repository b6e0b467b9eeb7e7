"""A hob over its life: designs built grind by grind by hand, what a reground profile is, and what bounds allow."""

import json
import math

import numpy as np
import pytest

from meshwright import Drive
from meshwright.base.errors import UsageError
from meshwright.cli import main
from meshwright.contact.results import ARCSEC
from meshwright.cycle.backlash import backlash
from meshwright.shop.tool_life import Bounds, ToolLife

ANGLES = np.radians(np.linspace(-60.0, 60.0, 5))
AMOUNTS = (0.0, 0.15, 0.3)


@pytest.fixture(scope="module")
def life():
    return ToolLife.of(Drive.load("plain-za"))


def _by_hand(drive, amount):
    """A ZA wheel cut by a reground hob with the keys of a new one.

    The axial profile is straight: half groove W/(2 cos λ) + (ϱ − r) tan α/cos λ moves inwards by the amount at the lead
    of the new hob. On the radius R where the groove, normal to the thread, is W again, found by bisection, it is a ZA
    hob of lead angle atan(p/R) and pressure angle atan(tan α_x cos λ').
    """
    new = drive.design.as_solved()["design"]
    radius, lead = new["hob_pitch_radius_mm"], math.radians(new["hob_lead_angle_deg"])
    pitch = radius * math.tan(lead)
    slope = math.tan(math.radians(new["hob_pressure_angle_deg"])) / math.cos(lead)
    width = new["groove_width_mm"]
    low, high = radius - 2.0 * amount - 1.0, radius
    for _ in range(200):
        middle = 0.5 * (low + high)
        axial = width / math.cos(lead) + 2.0 * (middle + amount - radius) * slope
        low, high = (middle, high) if axial * math.cos(math.atan2(pitch, middle)) < width else (low, middle)
    lead_left = math.atan2(pitch, low)
    worm, tip = new["worm_pitch_radius_mm"], drive.design.value("hob_tip_addendum_mm", "blank")
    return drive.with_(
        design={
            "hob_pitch_radius_mm": low,
            "hob_lead_angle_deg": math.degrees(lead_left),
            "hob_pressure_angle_deg": math.degrees(math.atan(slope * math.cos(lead_left))),
            "cutting_center_distance_mm": new["center_distance_mm"] + low - worm,
            "cutting_shaft_angle_deg": new["shaft_angle_deg"] + new["worm_lead_angle_deg"] - math.degrees(lead_left),
        },
        blank={"hob_tip_addendum_mm": radius + tip - amount - low},
    )


@pytest.mark.validate
@pytest.mark.parametrize("amount", AMOUNTS)
def test_a_life_is_that_of_designs_built_grind_by_grind(life, amount):
    state, hand = life.state(amount), _by_hand(life.drive, amount)
    here, there = state.drive.tca(ANGLES), hand.tca(ANGLES)
    assert np.abs(here.error - there.error).max() < 1e-9 * ARCSEC
    for name in ("points", "normals", "semi_axes"):
        assert np.abs(getattr(here, name) - getattr(there, name)).max() < 1e-9
    assert state.working == pytest.approx(hand.design.value("hob_pitch_radius_mm"), abs=1e-9)
    assert state.backlash == pytest.approx(backlash(hand), abs=1e-9 * ARCSEC)


def test_a_worn_hob_is_no_new_hob_of_its_radius(life):
    """Lowering the radius alone keeps the module and hides that the lead no longer matches."""
    worn = life.state(0.5)
    new = life.at(0.0, worn.working)
    hidden = ToolLife.of(new).state(0.0)
    assert worn.error > 10.0 * hidden.error


def test_the_lead_may_match_at_any_point_of_the_life(life):
    drive = life.at(0.3).with_(design={"hob_lead_matched_mm": 0.3})
    matched = math.asin(4.0 * 2 / (2 * (21.0 - 0.3)))
    lead = math.radians(drive.design.as_solved()["design"]["hob_lead_angle_deg"])
    assert 21.0 * math.tan(lead) == pytest.approx((21.0 - 0.3) * math.tan(matched), rel=1e-14)
    assert ToolLife.of(drive).state(0.3).error < 0.5 * life.state(0.3).error


def test_settings_that_the_design_gives_move_as_their_rules_do(life):
    """A hob fed 0.05 mm deeper stays so much deeper."""
    distance = life.drive.design.value("cutting_center_distance_mm")
    deeper = ToolLife.of(life.drive.with_(design={"cutting_center_distance_mm": distance - 0.05}))
    for amount in AMOUNTS:
        moved, ruled = (of.at(amount).design.value("cutting_center_distance_mm") for of in (deeper, life))
        assert moved == pytest.approx(ruled - 0.05, abs=1e-12)


def test_what_bounds_allow(life):
    """Smallest: the least oversize is left at the end. Largest: one step more breaks the bound that is named."""
    bounds = Bounds(error=20.0 * ARCSEC, oversize=0.01)
    found = life.range((0.0, 0.2), bounds)
    least = life.mate * 1.01
    assert life.state(0.2, found.smallest.radius).working == pytest.approx(least, abs=1e-9)
    assert found.largest.bound == "transmission error"
    at = found.largest
    inside, outside = (life.state(at.ground_off, at.radius + more).error for more in (0.0, 2e-4))
    assert inside <= bounds.error < outside
    assert life.state(found.life, at.radius).working == pytest.approx(least, abs=1e-9)


def test_bounds_that_nothing_meets_are_said(life):
    with pytest.raises(UsageError, match="transmission error is beyond its bound"):
        life.range((0.0, 0.3), Bounds(error=0.01 * ARCSEC))
    with pytest.raises(UsageError, match="no bound limits the oversize"):
        life.range((0.0,), Bounds(error=1e6 * ARCSEC))


def test_the_command(capsys, tmp_path):
    assert main(["hob-life", "plain-za", "--life-mm", "0.2", "--grinds", "1", "--json", "-"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["schema"] == "meshwright.tool-life/1" and found["oversize"] is None
    assert [state["ground_off_mm"] for state in found["states"]] == [0.0, 0.2]
    assert 0.0 < found["states"][0]["pattern"]["share"] < found["states"][1]["pattern"]["share"] < 1.0
    assert found["states"][1]["design"]["design"]["hob_regrind_mm"] == 0.2


@pytest.mark.parametrize(
    "words",
    [["helical-crowned"], ["plain-za", "--life-mm", "0"], ["plain-za", "--error", "design.hob_threads=1"],
     ["plain-za", "--error", "misalignment.axial_mm=-1"], ["plain-za", "--toml", "-"],
     ["plain-za", "--oversize-percent", "-1"], ["plain-za", "--life-mm", "30"],
     ["plain-za", "--set", "design.hob_pitch_radius_mm=20.0"]],
)  # fmt: skip
def test_what_cannot_be_is_refused(words, capsys):
    try:
        status = main(["hob-life", *words])
    except SystemExit as stopped:
        status = stopped.code
    assert status == 2 and capsys.readouterr().err


@pytest.mark.validate
@pytest.mark.parametrize("form", ["zi", "zn", "zk", "zc"])
def test_a_reground_profile_is_the_new_one_nearer_to_the_axis(form):
    """Axial profile f(ϱ) → f(ϱ + Δ), whatever the form; its normal is perpendicular to it by differences."""
    drive = Drive.load(f"plain-{form}")
    worn = ToolLife.of(drive).at(0.4)
    at = worn.function("profile_range_tool")()
    t = at["pitch_point"].item() + at["scale"].item() * np.linspace(-0.2, 0.2, 5)
    new, old = drive.function("profile_tool")(t), worn.function("profile_tool")(t)
    assert np.hypot(*old["point"].T[:2]) == pytest.approx(np.hypot(*new["point"].T[:2]) - 0.4, abs=1e-12)
    assert old["axial"].ravel() == pytest.approx(new["axial"].ravel(), abs=1e-12)
    step = 1e-4 * at["scale"].item()
    ahead, back = (worn.function("profile_tool")(t + s)["point"] for s in (step, -step))
    along = (ahead - back) / np.linalg.norm(ahead - back, axis=1)[:, None]
    assert np.abs(np.einsum("ni,ni->n", old["normal"], along)).max() < 1e-8
