"""Errors of settings found from measured flanks: exact columns, honest spreads, what cannot be told apart."""

import contextlib
import json
import math
import re
import tomllib
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import root

from meshwright import Drive, UsageError
from meshwright.cli import main
from meshwright.shop.identify import Parameters
from meshwright.shop.nominal import nominal
from meshwright.shop.tables import csv_text

KEYS = (
    "cutting_center_distance_mm", "cutting_shaft_angle_deg", "hob_pitch_radius_mm", "hob_pressure_angle_deg",
    "pose.rotation_arcsec",
)  # fmt: skip
ERRORS = np.array([-0.03, 0.04, 0.05, 0.02, 30.0])


@pytest.fixture(scope="module")
def drive():
    return Drive.load("plain-za")


@pytest.fixture(scope="module")
def points(drive):
    return nominal(drive, "wheel", (4, 7), 0.05, teeth=(1, 14, 28), flanks=("right", "left"))


@pytest.fixture(scope="module")
def parameters(drive, points):
    return Parameters.at(drive, "wheel", points, KEYS)


def _turned(vectors, angle):
    c, s = math.cos(angle), math.sin(angle)
    return vectors @ np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])


def _measured(drive, points, parameters, errors):
    """Deviations (N,) of a wheel cut and held with the errors: each ray met with its flank by SciPy."""
    settings = {key: parameters.drive.design.value(key) for key in KEYS[:4]}
    units = np.radians([1.0 if key.endswith("deg") else 180.0 / math.pi for key in KEYS[:4]])
    made = {key: settings[key] / u + e for key, u, e in zip(KEYS[:4], units, errors, strict=False)}
    turn = errors[4] * math.pi / 648000.0
    found = np.empty(len(points.tooth))
    for word, rows, start in zip(parameters.flanks.words, parameters.flanks.rows, parameters.flanks.parameters,
                                 strict=True):  # fmt: skip
        flank = drive.with_(flank=word, design=made).flank("wheel")
        for row, q in zip(rows, start, strict=True):
            back = -turn - 2 * math.pi * (points.tooth[row] - 1) / 41
            place, normal = (_turned(v[row], back) for v in (points.points, points.normals))

            def gap(x, flank=flank, place=place, normal=normal):
                return flank(x[:2]).points[0] - place - x[2] * normal

            met = root(gap, [*q, 0.0], tol=1e-13)
            assert np.abs(met.fun).max() < 1e-10
            found[row] = met.x[2]
    return found


@pytest.fixture(scope="module")
def clean(drive, points, parameters):
    return _measured(drive, points, parameters, ERRORS)


def test_the_column_of_a_pressure_angle_in_closed_form():
    """ZA worm: z = pθ + S/2 + (ρ − r) tan α / cos λ, so that δ = n_z (ρ − r) / (cos λ cos² α) for a unit of α."""
    worm = Drive.load("plain-za")
    points = nominal(worm, "pinion", (4, 5), 0.05)
    lead_angle, alpha = math.radians(11.31), math.radians(20.0)
    found = Parameters.at(worm, "pinion", points, ["pressure_angle_deg"]).columns[:, 0]
    height = np.hypot(*points.points[:, :2].T) - 4.0 / math.sin(lead_angle)
    slope = points.normals[:, 2] * height / (math.cos(lead_angle) * math.cos(alpha) ** 2)
    assert found == pytest.approx(math.radians(1.0) * slope, abs=1e-13)


@pytest.mark.parametrize("member", ["pinion", "wheel"])
def test_the_column_of_a_profile_shift_in_closed_form(member):
    """An involute flank moves by m sin α along its normal for a unit of profile shift, everywhere."""
    gears = Drive.load("spur-profile-shift")
    points = nominal(gears, member, (3, 3), 0.05)
    found = Parameters.at(gears, member, points, [f"{member}_profile_shift_coefficient"]).columns
    assert found == pytest.approx(np.full((9, 1), 3.0 * math.sin(math.radians(20.0))), abs=1e-12)


@pytest.mark.parametrize(
    ("design", "member", "key"),
    [
        ("face-worm-conical-convex", "wheel", "blade_angle_deg"),
        ("face-worm-conical-convex", "pinion", "head_cutter_radius_mm"),
        ("spherical-table-3-1-convex", "wheel", "wheel_sphere_radius_mm"),
    ],
)
def test_columns_of_other_drives_are_slopes_of_their_flanks(design, member, key):
    other = Drive.load(design)
    parameters = Parameters.at(other, member, nominal(other, member, (3, 4), 0.1), [key])
    step = 2e-4
    ahead, behind, further, back = (parameters.deviations(np.array([k * step])) for k in (1, -1, 2, -2))
    slope = (8 * (ahead - behind) - (further - back)) / (12 * step)
    assert parameters.columns[:, 0] == pytest.approx(slope, abs=1e-8 * max(1.0, np.abs(slope).max()))


def test_five_errors_at_once_come_back_within_three_deviations(parameters, clean):
    noise = np.random.default_rng(24).normal(0.0, 1e-3, len(clean))
    found = parameters.fit(clean + noise, 1e-3).estimate
    assert found.undetermined == ()
    assert (np.abs(found.values - ERRORS) < 3.0 * found.deviations).all()
    assert 0.7 < found.chi_square_per_degree < 1.3


def test_without_noise_the_exact_surface_gives_them_exactly(parameters, clean):
    found = parameters.fit(clean, 1e-3)
    assert found.estimate.values == pytest.approx(ERRORS, rel=1e-5)
    assert found.largest < 1e-8


@pytest.mark.parametrize("seeds", [40, pytest.param(200, marks=pytest.mark.validate)])
def test_the_covariance_holds_over_many_measurements(parameters, clean, seeds):
    """Normalised squared errors of five parameters follow χ²: mean 5, variance 10; Huber's weights cost 5 %."""
    squares = []
    for seed in range(seeds):
        noise = np.random.default_rng(seed).normal(0.0, 1e-3, len(clean))
        found = parameters.fit(clean + noise, 1e-3).estimate
        off = found.values - ERRORS
        squares.append(off @ np.linalg.solve(found.covariance, off))
    spread = 3.0 * math.sqrt(10.0 / seeds)
    assert 5.0 - spread < np.mean(squares) < 5.0 / 0.95 + spread


def test_dirt_is_distrusted(parameters, clean):
    dirty = clean + np.random.default_rng(2).normal(0.0, 1e-3, len(clean))
    dirty[[5, 60]] += 0.03
    found = parameters.fit(dirty, 1e-3).estimate
    assert {5, 60} <= set(found.distrusted().tolist())
    assert (np.abs(found.values - ERRORS) < 4.0 * found.deviations).all()


def test_what_looks_alike_is_named(tmp_path, capsys, drive):
    """A spur gear's turn and its profile shift move one flank by constants: r_b and m sin α."""
    gears = Drive.load("spur-profile-shift")
    file = tmp_path / "one.csv"
    for flanks, status in ((("left",), 1), (("left", "right"), 0)):
        points = nominal(gears, "pinion", (3, 3), 0.05, teeth=(1, 5, 9), flanks=flanks)
        points.deviations[:] = 1e-3
        file.write_text(csv_text(points, {}))
        arguments = ["identify", "spur-profile-shift", "--member", "pinion", "--measured", str(file), "--json", "-"]
        keys = "pinion_profile_shift_coefficient,pose.rotation_arcsec"
        assert main([*arguments, "--parameters", keys, "--sigma-um", "1"]) == status
        document = json.loads(capsys.readouterr().out)
        assert document["schema"] == "meshwright.identify/1"
        one_flank = [w for w in document["warnings"] if "one flank alone" in w]
        if status:
            (lost,) = document["inseparable"]
            assert sorted(lost["keys"]) == keys.split(",") and "does not tell them apart" in lost["words"]
            assert [e["value"] for e in document["estimates"]] == [None, None] and one_flank
        else:
            assert document["inseparable"] == [] and not one_flank
            shift, turn = document["estimates"]
            assert shift["value"] == pytest.approx(1e-3 / (3.0 * math.sin(math.radians(20.0))), rel=1e-6)
            assert turn["value"] == pytest.approx(0.0, abs=1e-6)


def test_corrected_settings_make_the_part_that_was_meant(tmp_path, drive, points, parameters, clean, capsys):
    """With the same errors, the corrected machine cuts the nominal flank: what is left is the noise of measuring."""
    points.deviations[:] = clean + np.random.default_rng(7).normal(0.0, 1e-3, len(clean))
    measured, corrected = tmp_path / "measured.csv", tmp_path / "corrected.toml"
    measured.write_text(csv_text(points, {}))
    arguments = ["identify", "plain-za", "--member", "wheel", "--measured", str(measured), "--sigma-um", "1"]
    assert main([*arguments, "--parameters", ",".join(KEYS), "--toml", str(corrected)]) == 0
    assert "left unexplained" in capsys.readouterr().out
    tables = tomllib.loads(corrected.read_text())
    nominal_settings = {key: drive.design.as_solved()["design"][key] for key in KEYS[:4]}
    errors = [tables["design"][key] + e - nominal_settings[key] for key, e in zip(KEYS[:4], ERRORS, strict=False)]
    again = _measured(drive, points, parameters, np.array([*errors, 0.0]))
    assert np.abs(clean).max() > 0.03 and np.abs(again).max() < 1e-3


def test_the_other_hand_has_the_same_errors(points, clean):
    """The mirror image, mirrored points, the same deviations: the same settings, the opposite turn."""
    left = Drive.load("plain-za").with_(design={"hand": "left"})
    there = nominal(left, "wheel", (4, 7), 0.05, teeth=(1, 14, 28), flanks=("right", "left"))
    back = {1: 1, 14: 29, 28: 15}  # tooth k of the mirror image is tooth 43 − k
    mirrored = nominal(
        Drive.load("plain-za"), "wheel", (4, 7), 0.05, teeth=tuple(back.values()), flanks=("right", "left")
    )
    assert there.points == pytest.approx(mirrored.points * [1, -1, 1], abs=1e-9)
    found = Parameters.at(left, "wheel", there, KEYS)
    own = Parameters.at(Drive.load("plain-za"), "wheel", mirrored, KEYS)
    assert found.columns == pytest.approx(own.columns * [1, 1, 1, 1, -1], abs=1e-9)


@pytest.mark.parametrize("seed", range(4))
def test_a_place_that_is_given_twice_is_refused_not_counted_twice(seed, drive, points, clean):
    """A row once more, as it is, with another deviation, or under another name; it would halve the variance."""
    chance = np.random.default_rng(seed)
    k, at = chance.integers(len(points.tooth), size=2)
    rows = np.insert(np.arange(len(points.tooth)), at, k)
    again = replace(points.of(rows), deviations=chance.normal(0.0, 1e-3, len(rows)))
    if seed % 2:
        again.i[at] += 50
    with pytest.raises(UsageError, match=f"tooth {points.tooth[k]}, {points.flank[k]} flank, .*: the same place as"):
        Parameters.at(drive, "wheel", again, KEYS)


@pytest.mark.parametrize("sigma", ["1e-12", "1e-6", "1e-300", "1e300", "5e-324"])
def test_where_nothing_is_left_to_trust_it_is_said(sigma, tmp_path, points, clean, capsys):
    (tmp_path / "m.csv").write_text(csv_text(replace(points, deviations=clean), {}))
    with contextlib.suppress(SystemExit):
        words = ["--measured", str(tmp_path / "m.csv"), "--parameters", "pose.axial_mm", "--sigma-um", sigma]
        assert main(["identify", "plain-za", "--member", "wheel", *words]) == 2
    said = capsys.readouterr().err
    assert re.search(r"--sigma-um:? [\d.e+-]+: (no point lies within|smaller than|larger than)", said)


def test_points_of_another_design_or_member_are_named(tmp_path, capsys, points, clean):
    """Flanks that differ by less than a measurement resolves, and a pair in which only another size is other."""
    label = {"design": Drive.load("plain-za").design.label, "member": "wheel"}
    (tmp_path / "m.csv").write_text(csv_text(replace(points, deviations=clean), label))
    words = ["--measured", str(tmp_path / "m.csv"), "--parameters", "pose.rotation_arcsec", "--json", "-"]
    command = ["identify", "plain-za", "--member", "wheel", *words]
    notes = []
    for change in ("flank='left'", "design.pressure_angle_deg=20.00005", "blank.worm_tip_radius_mm=24.5"):
        assert main([*command, "--set", change]) == 0
        notes.append([w for w in json.loads(capsys.readouterr().out)["warnings"] if label["design"] in w])
    assert not notes[0] and len(notes[1]) == len(notes[2]) == 1
    assert "µm off" in notes[1][0] and "µm off" not in notes[2][0]
    assert main([*command, "--member", "pinion"]) == 2
    assert "the file says that its points are of the wheel" in capsys.readouterr().err


BAD = {
    "unknown key": (["--parameters", "nonsense_mm"], "nonsense_mm: the drive has no such key"),
    "pose": (["--parameters", "pose.nonsense"], "pose.nonsense: no such key of the pose"),
    "count": (["--parameters", "wheel_teeth"], "wheel_teeth: a count or a choice"),
    "twice": (["--parameters", "pose.axial_mm,pose.axial_mm"], "pose.axial_mm: named twice"),
    "no effect": (["--parameters", "misalignment.axial_mm"], "does not change the flanks"),
    "none": (["--parameters", ","], "names no key"),
    "tolerance": (["--parameters", "pose.axial_mm", "--tolerance", "pose.axial_mm=0"], "not KEY=SIZE"),
    "design": (["--parameters", "pose.axial_mm", "--set", "design.pressure_angle_deg=21"], "mm off the flank"),
    "member": (["--parameters", "pose.axial_mm", "--member", "pinion"], "teeth 1 to 2"),
}


@pytest.mark.parametrize("kind", BAD)
def test_bad_input_is_refused(kind, tmp_path, points, capsys):
    options, message = BAD[kind]
    (tmp_path / "m.csv").write_text(csv_text(points, {}))
    arguments = ["identify", "plain-za", "--member", "wheel", "--measured", str(tmp_path / "m.csv")]
    assert main([*arguments, *options]) == 2
    assert message in capsys.readouterr().err
