"""Unmodified and nearly unmodified cylindrical pairs touch along lines, on edges and at corners where bounded
involutes do.

Expected values are those of explicit involutes (`tests.independent.involute_delta`) or closed forms, to the digits
given.
"""

import math
import re

import numpy as np
import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.contact import analysis
from meshwright.contact.results import ARCSEC
from meshwright.design import design as designs
from meshwright.sweep import samples
from tests.independent.involute_delta import Gear, Pair, involute
from tests.quick import full

#: Spur pair C14 (m 4.5, z 16/24) and helical pair of 17 and 43 teeth (m 1, 20°).
C14 = {
    "normal_module_mm": 4.5, "pressure_angle_deg": 20.0, "face_width_mm": 14.0, "pinion_teeth": 16, "wheel_teeth": 24,
    "pinion_helix_angle_deg": 0.0, "wheel_helix_angle_deg": 0.0, "pinion_profile_shift_coefficient": 0.1817,
    "wheel_profile_shift_coefficient": 0.1715,
}  # fmt: skip
C14_TIPS = {"pinion_tip_radius_mm": 41.31765, "wheel_tip_radius_mm": 59.27175}
H17 = {
    "normal_module_mm": 1.0, "pressure_angle_deg": 20.0, "face_width_mm": 10.0, "pinion_teeth": 17, "wheel_teeth": 43,
    "pinion_helix_angle_deg": 20.0, "wheel_helix_angle_deg": -20.0,
}  # fmt: skip


def pair_of(design, flank="left", misalignment=None, blank=None, **changes):
    tables = {"drive": "cylindrical-gears", "flank": flank, "design": design | changes}
    return Drive.from_tables(tables | {"misalignment": misalignment or {}, "blank": blank or {}})


def c14(misalignment=None, **changes):
    return pair_of(C14, misalignment=misalignment, blank=C14_TIPS, **changes)


def h17(misalignment=None, **changes):
    return pair_of(H17, misalignment=misalignment, **changes)


def point_of(drive, degrees):
    (point,) = drive.tca(np.radians([degrees])).to_points()
    return point


#: Drive, angle in degrees, transmission error in arcsec, and member and limit that touch.
EDGES = {
    "spur, axes inclined": (lambda: c14({"vertical_deg": 0.005}), 0.0, 0.9474448922, "wheel", "face"),
    "spur, axes skew": (lambda: c14({"horizontal_deg": 0.003}), 0.0, 1.3770465618, "pinion", "face"),
    "helical, axes skew": (lambda: h17({"horizontal_deg": 0.02}), -4.0, 18.1732393558, "wheel", "face"),
    "helical, lead slope": (lambda: h17(wheel_lead_slope_um=5.0), 0.0, 25.5235374479, "both", "face"),
    "helical, lead slope, at a tip": (lambda: h17(wheel_lead_slope_um=5.0), -20.0, -7.2146423857, "wheel", "tip"),
}


@pytest.mark.parametrize("name", EDGES)
def test_a_pair_that_is_not_aligned_touches_at_the_end_of_its_line(name):
    made, degrees, expected, member, limit = EDGES[name]
    drive = made()
    point, first = point_of(drive, degrees), drive.first_contact(np.radians([degrees]))
    assert point["status"] == "edge_contact" and drive.tca(np.radians([degrees])).complete
    assert point["transmission_error_arcsec"] == pytest.approx(expected, abs=1e-7)
    assert (first.kinds, first.members, first.limits[0][0]) == (("edge",), (member,), limit)
    assert point["contact_point_mm"] == pytest.approx(first.points[0].tolist(), abs=1e-12)
    assert np.linalg.norm(point["contact_normal"]) == pytest.approx(1.0, abs=1e-12)


def test_where_an_inclined_wheel_touches_is_at_the_end_of_its_face():
    """At (36.62357, 0.05759, −6.99521): the wheel's face is not flush with the pinion's."""
    point = point_of(c14({"vertical_deg": 0.005}), 0.0)
    assert point["contact_point_mm"] == pytest.approx([36.62357, 0.05759, -6.99521], abs=5e-6)
    assert abs(point["contact_point_wheel_mm"][2]) == pytest.approx(7.0, abs=1e-10)


def test_the_line_of_a_helical_pair_runs_from_face_to_face():
    line = point_of(h17(), 0.0)["contact_line"]
    ends = sorted(end["point_mm"] for end in line["ends"])
    assert ends[0] == pytest.approx([8.432583571, -1.582446557, -5.0], abs=1e-9)
    assert ends[1] == pytest.approx([9.658438561, 1.582446557, 5.0], abs=1e-9)
    base = math.asin(math.sin(math.radians(20.0)) * math.cos(math.radians(20.0)))
    assert line["length_mm"] == pytest.approx(10.0 / math.cos(base), abs=1e-9)
    assert all(end["limits"] == ["face"] for end in line["ends"])


def test_across_the_line_of_spur_gears_is_the_curvature_of_both_involutes():
    point = point_of(c14(), 0.0)
    assert point["status"] == "line_contact" and point["contact_point_mm"] is None
    assert point["contact_line"]["curvature_per_mm"] == pytest.approx([0.11912661] * len(
        point["contact_line"]["points_mm"]), abs=5e-9)  # fmt: skip
    assert point["contact_line"]["length_mm"] == pytest.approx(14.0, abs=1e-9)


def test_a_line_is_cut_by_the_tip_that_comes_first():
    line = point_of(h17(), 26.0)["contact_line"]
    assert {(end["member"], end["limits"][0]) for end in line["ends"]} >= {("pinion", "tip")}


def test_past_its_segment_a_spur_pair_touches_along_a_tip_edge_and_then_nowhere():
    drive = c14()
    at_tip, past = (point_of(drive, degrees) for degrees in (20.0, 35.0))
    expected = involutes(drive).error(math.radians(20.0))[0] / ARCSEC
    assert at_tip["status"] == "edge_contact" and at_tip["contact_line"]["length_mm"] == pytest.approx(14.0, abs=1e-9)
    assert at_tip["transmission_error_arcsec"] == pytest.approx(expected, abs=1e-6)
    assert past["status"] == "no_contact" and drive.first_contact(np.radians([35.0])).kinds == (None,)


def test_crowning_within_the_rounding_of_a_position_leaves_a_line():
    point, plain = (point_of(c14(pinion_lead_crowning_um=c), 5.0) for c in (1e-6, 0.0))
    assert point["status"] == "line_contact"
    assert point["transmission_error_arcsec"] == pytest.approx(plain["transmission_error_arcsec"], abs=1e-8)
    assert point_of(c14(pinion_lead_crowning_um=1e-4), 5.0)["status"] == "converged"


def test_slope_beside_little_crowning_touches_at_the_end_of_the_face_where_both_leave_material():
    drive = c14(pinion_lead_crowning_um=0.5, wheel_lead_slope_um=8.0)
    expected = (8.0 / 2.0 - 0.5) * 1e-3 / (4.5 * 12.0 * math.cos(math.radians(20.0)))
    found = drive.first_contact([0.0])
    assert found.errors[0] == pytest.approx(expected, rel=1e-3)
    assert found.errors[0] == pytest.approx(involutes(drive).error(0.0)[0], abs=1e-6 * ARCSEC)


def test_a_spur_pair_moved_apart_has_the_ratio_and_backlash_of_its_working_involutes():
    found = c14(center_distance_mm=91.7).contact_ratio()
    assert found.status == "line_contact" and found.impossible == ()
    assert found.contact_ratio == pytest.approx(1.4232529799, abs=2e-10)
    assert found.transverse_contact_ratio == pytest.approx(1.4232529799, abs=2e-10)
    assert found.overlap_ratio == pytest.approx(0.0, abs=1e-9)
    assert found.backlash / ARCSEC == pytest.approx(624.3245780, abs=1e-6)
    assert found.backlash_lengths == pytest.approx((0.1665351395, 0.1535906843), abs=2e-10)
    error = found.transmission_error
    assert error.envelope == "upper" and (error.pair_peak_to_peak, error.envelope_peak_to_peak) == (0.0, 0.0)
    (point,) = c14(center_distance_mm=91.7).tca([0.0]).to_points()
    assert point["transmission_error_arcsec"] == pytest.approx(-312.1622890, abs=1e-6)


def test_a_helical_pair_moved_apart_likewise():
    found = h17({"center_distance_mm": 0.05}).contact_ratio()
    assert found.contact_ratio == pytest.approx(2.5363863462, abs=2e-10)
    overlap = 10.0 * math.sin(math.radians(20.0)) / math.pi
    assert found.overlap_ratio == pytest.approx(overlap, abs=1e-9)
    assert found.transverse_contact_ratio + found.overlap_ratio == pytest.approx(found.contact_ratio, abs=1e-12)
    assert found.backlash / ARCSEC == pytest.approx(350.9960599, abs=1e-6)
    assert found.backlash_lengths == pytest.approx((0.0389950419, 0.0343796447), abs=2e-10)


def test_a_pair_on_edges_has_a_window_an_error_and_a_backlash():
    """Inclined: s TE = (b/2) Δv sin α_w / r_b2 to first order on either flank, by so much less backlash."""
    errors = ({}, {"vertical_deg": 0.005})
    straight, inclined = (c14(e, center_distance_mm=91.7).contact_ratio() for e in errors)
    assert inclined.status == "edge_contact" and inclined.contact_ratio == pytest.approx(1.42325, abs=5e-4)
    lead = 7.0 * math.radians(0.005) * math.sin(math.acos(45.0 * 2 * math.cos(math.radians(20.0)) / 91.7)) / 50.744
    assert straight.backlash - inclined.backlash == pytest.approx(2.0 * lead, rel=1e-2)
    assert inclined.transmission_error.pair_peak_to_peak < 0.01 * lead


def involutes(drive):
    """The explicit pair of a design of the product without profile modifications."""
    solved = drive.design.as_solved()
    d, e, b = (solved[table] for table in ("design", "misalignment", "blank"))
    alpha = math.radians(d["pressure_angle_deg"])
    gears = [
        Gear.of(
            d["normal_module_mm"], alpha, d[f"{name}_teeth"], math.radians(d[f"{name}_helix_angle_deg"]),
            d[f"{name}_face_width_mm"], d[f"{name}_profile_shift_coefficient"], b[f"{name}_tip_radius_mm"],
            d[f"{name}_lead_slope_um"] * 1e-3, d[f"{name}_lead_crowning_um"] * 1e-3,
        )
        for name in ("pinion", "wheel")
    ]  # fmt: skip
    errors = (e["center_distance_mm"], *np.radians([e["horizontal_deg"], e["vertical_deg"]]), e["axial_mm"])
    return Pair(*gears, d["center_distance_mm"], 1 if drive.design.tables["flank"] == "left" else -1, *errors)


def random_pair(rng):
    """A plain or nearly plain pair: none or a little of crowning, slope, skew and inclination; and a pinion angle."""
    def some(most):
        return float(rng.choice([0.0, 1.0]) * rng.uniform(-most, most))

    module, teeth = float(rng.uniform(1.0, 6.0)), (int(rng.integers(16, 40)), int(rng.integers(18, 70)))
    helix = float(rng.choice([0.0, 0.0, 1.0]) * rng.uniform(-30.0, 30.0))
    face = float(rng.uniform(4.0, 12.0)) * module
    design = {
        "normal_module_mm": module, "pressure_angle_deg": float(rng.uniform(18.0, 25.0)), "pinion_teeth": teeth[0],
        "wheel_teeth": teeth[1], "pinion_helix_angle_deg": helix, "wheel_helix_angle_deg": -helix,
        "face_width_mm": face, "wheel_face_width_mm": face * float(rng.choice([1.0, 0.9, 1.1])),
        "pinion_profile_shift_coefficient": float(rng.uniform(0.0, 0.4)),
        "wheel_profile_shift_coefficient": float(rng.uniform(-0.1, 0.3)),
    }  # fmt: skip
    for name in ("pinion", "wheel"):
        design[f"{name}_lead_crowning_um"] = abs(some(1.0))
        design[f"{name}_lead_slope_um"] = some(10.0)
    misalignment = {
        "center_distance_mm": abs(some(0.02)) * module, "horizontal_deg": some(0.05), "vertical_deg": some(0.05),
        "axial_mm": some(0.1),
    }  # fmt: skip
    drive = pair_of(design, str(rng.choice(["left", "right"])), misalignment)
    return drive, float(rng.uniform(-0.7, 0.7)) * drive.pitch()


def agrees(drive, angle):
    """Error within 1e-6″ of the explicit involutes', place within 1e-4 mm where it is not a line; the status says so.
    """
    pair = involutes(drive)
    error, place, _ = pair.error(angle)
    result = drive.tca([angle])
    found = drive.first_contact([angle], result)
    if math.isnan(error):
        assert found.kinds == (None,) and found.untouched[0]
        assert result.status[0] == "no_contact" or result.flags[0]
        return
    assert found.kinds[0] is not None
    there = pair_error_at(pair, angle, found.points[0])
    error = pair.s * max(pair.s * error, pair.s * there)  # brute force falls short of a flat summit by some 1e-6″
    assert found.errors[0] / ARCSEC == pytest.approx(error / ARCSEC, abs=1e-6)
    if found.lines[0] is None:
        close = np.linalg.norm(found.points[0] - place) < 1e-4
        assert close or pair.s * there >= pair.s * error - 1e-6 * ARCSEC
    if result.status[0] != "converged":
        assert result.error[0] / ARCSEC == pytest.approx(error / ARCSEC, abs=1e-6)
    if result.status[0] == "line_contact":
        assert result.lines[0].points.shape[0] > 1


def pair_error_at(pair, angle, point):
    """The error at which the wheel's involute passes through a point of the pinion: where two places touch alike."""
    length = math.sqrt(max(point[0] ** 2 + point[1] ** 2 - pair.pinion.r_b**2, 0.0))
    return float(pair.limits(angle, length, point[2])[1])


#: Pairs of the quick test, and of the whole.
QUICK = 3
ALL = 300


def test_plain_pairs_touch_where_explicit_involutes_do():
    rng = np.random.default_rng(44)
    for _ in range(QUICK):
        agrees(*random_pair(rng))


@pytest.mark.validate
@pytest.mark.parametrize("part", range(10))
def test_many_plain_pairs_touch_where_explicit_involutes_do(part):
    rng = np.random.default_rng([44, part])
    for _ in range((ALL if full() else ALL // 3) // 10):
        agrees(*random_pair(rng))


def test_working_involute():
    assert involute(math.radians(20.0)) == pytest.approx(0.014904384, abs=1e-9)


@pytest.mark.parametrize("turned", [1.0, -1.0])
def test_words_name_the_end_of_the_face_that_touches_and_how_far_the_flanks_are_out_of_line(turned, capsys, tmp_path):
    """Inclined by Δv, the gap rises by b Δv sin α_w over the face."""
    path = tmp_path / "c14.toml"
    path.write_text(designs.toml_text(c14({"vertical_deg": 0.005 * turned}).design.given()))
    assert main(["tca", str(path), "--phi-deg=0"]) == 0
    said = capsys.readouterr().out
    point = point_of(c14({"vertical_deg": 0.005 * turned}), 0.0)
    end = "right" if point["contact_point_mm"][2] > 0.0 else "left"
    assert f"edge_contact ({end} face of the wheel)" in said
    working = math.acos(45.0 * 2 * math.cos(math.radians(20.0)) / c14().design.value("center_distance_mm"))
    rise = 1000.0 * 14.0 * math.radians(0.005) * math.sin(working)
    assert float(re.search(r"out of line by ([\d.]+) µm", said)[1]) == pytest.approx(rise, rel=5e-3)
    assert "vertical_deg = " in said


@pytest.mark.parametrize(("axial", "degrees", "end"), [(0.05, 2.0, "toe"), (-0.05, -10.0, "heel")])
def test_bevel_gears_touch_at_toe_or_heel(axial, degrees, end):
    drive = Drive.load("bevel-crown-pair").with_(misalignment={"pinion_axial_mm": axial})
    found = drive.first_contact(np.radians([degrees]))
    assert found.kinds == ("edge",) and end in found.edges[0]
    middle = Drive.load("bevel-crown-pair").first_contact([0.0])
    assert (np.linalg.norm(found.points) < np.linalg.norm(middle.points)) == (end == "toe")


def test_a_sweep_and_an_analysis_call_the_same_contacts_lines_edges_and_points():
    """Crowning within 1e-9 mm is none; the assembly decides whether a line, an edge or a point touches."""
    angles = np.radians([0.0, 20.0, 35.0])
    nominal = c14(pinion_lead_crowning_um=0.0, wheel_lead_slope_um=0.0)
    keys = ("design.pinion_lead_crowning_um", "misalignment.vertical_deg")
    values = np.array([[0.0, 0.0], [1e-6, 0.0], [1.0, 0.0], [0.0, 1e-3], [1e-6, 0.0]])
    found = samples.solve(nominal, keys, values, angles)
    for row, (crowning, inclined) in enumerate(values.tolist()):
        alone = c14({"vertical_deg": inclined}, pinion_lead_crowning_um=crowning).tca(angles)
        assert [analysis.statuses()[code] for code in found.status[row].tolist()] == list(alone.status)
        assert found.error[row] == pytest.approx(alone.error, abs=1e-9 * ARCSEC, nan_ok=True)
    assert set(found.status[1].tolist()) == set(found.status[0].tolist())


def test_where_tangencies_interfere_a_ratio_is_that_of_the_edges_that_touch():
    """A wheel cut by a hob of the worm's size that goes deeper than the worm: its face touches at either end."""
    deep = {
        "drive": "cylindrical-worm", "flank": "right",
        "design": {
            "worm_profile": "ZI", "axial_module_mm": 4.0, "worm_threads": 2, "wheel_teeth": 40, "shaft_angle_deg": 90.0,
            "worm_pitch_radius_mm": 20.0, "pressure_angle_deg": 20.0, "center_distance_mm": 100.0, "hob_threads": 2,
            "hob_pitch_radius_mm": 20.0, "cutting_center_distance_mm": 99.883, "cutting_shaft_angle_deg": 89.9352,
        },
        "blank": {
            "worm_tip_radius_mm": 24.0, "worm_root_radius_mm": 15.2, "wheel_throat_radius_mm": 84.0,
            "wheel_tip_radius_mm": 86.0, "wheel_face_width_mm": 24.1, "hob_tip_addendum_mm": 4.8,
        },
    }  # fmt: skip
    drive = Drive.from_tables(deep)
    found = drive.contact_ratio()
    assert found.impossible == ("interference",) and found.status == "edge_contact"
    first = drive.first_contact([found.mesh.middle])
    (pair,) = [p for p in found.mesh.pairs(found.mesh.middle) if p.number == 0]
    assert pair.error == pytest.approx(first.errors[0], abs=1e-9 * ARCSEC)
