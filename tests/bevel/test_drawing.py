"""What drawings of bevel and hypoid gears state, and the machine settings that follow from them.

Values: ISO 23509:2016 and the pitch cones of offset axes (method 1 without its estimates), evaluated to 40 digits.
"""

import math
import random

import numpy as np
import pytest

from meshwright import DesignError, Drive
from meshwright.cli import main
from meshwright.design.design import toml_text
from tests.bevel.exact import crown_pair
from tests.quick import quick

ARCSEC = math.radians(1 / 3600)


def tables(flank="convex", pinion=None, gear=None, **design):
    return {"drive": "bevel", "flank": flank, "design": design} | {
        name: member for name, member in (("pinion", pinion), ("gear", gear)) if member
    }


def sizes(document):
    return {key: size.value for key, size in Drive.from_tables(document).drawing().sizes.items()}


DUPLEX = tables(
    pinion_teeth=16, gear_teeth=49, outer_transverse_module_mm=4.5, face_width_mm=30, mean_spiral_angle_deg=35,
    cutter_radius_mm=88.9, pressure_angle_deg=20, crown_dedendum_factor=1.125, pinion_profile_shift_coefficient=0.3,
    depth_taper="duplex",
)  # fmt: skip
HYPOID = tables(
    pinion_teeth=11, gear_teeth=41, offset_mm=30, gear_outer_pitch_diameter_mm=200, face_width_mm=30,
    cutter_radius_mm=76.2, pinion_mean_spiral_angle_deg=48,
)  # fmt: skip
OTHER = tables(
    pinion_teeth=12, gear_teeth=43, offset_mm=28, outer_transverse_module_mm=5, face_width_mm=30,
    cutter_radius_mm=88.9, pinion_mean_spiral_angle_deg=44,
)  # fmt: skip
VALUES = [
    (DUPLEX, {
        "mean_normal_module_mm": 3.20943497, "pinion.face_angle_deg": 20.7365428,
        "pinion.root_cone_angle_deg": 16.6548545, "gear.face_angle_deg": 73.3451455,
        "gear.root_cone_angle_deg": 69.2634572, "pinion.outer_tip_diameter_mm": 81.253843,
        "virtual_transverse_contact_ratio": 1.22398244, "outer_spiral_angle_deg": 41.0875259,
    }),
    (HYPOID, {
        "pinion.pitch_angle_deg": 19.9151878, "gear.pitch_angle_deg": 69.0225188, "pinion_offset_angle_deg": 19.1050514,
        "pinion_mean_radius_mm": 30.1874682, "gear_mean_radius_mm": 85.9941820, "limit_pressure_angle_deg": -4.4844357,
        "pinion.pitch_apex_mm": 1.50168066, "gear.pitch_apex_mm": 2.99178295,
    }),
    (OTHER, {
        "pinion.pitch_angle_deg": 19.135662, "gear.pitch_angle_deg": 70.114998, "gear_mean_spiral_angle_deg": 27.597431,
        "pinion.pitch_apex_mm": 2.53293, "gear.pitch_apex_mm": 1.81889,
    }),
]  # fmt: skip


@pytest.mark.parametrize(("document", "values"), VALUES)
def test_sizes_are_those_of_the_standard(document, values):
    """To the last digit printed."""
    found = sizes(document)
    for key, value in values.items():
        digits = len(repr(value).partition(".")[2])
        assert found[key] == pytest.approx(value, abs=0.51 * 10.0**-digits), key


def test_a_crown_gear_generates_what_crosses_with_uniform_depth():
    """Settings against those of a derivation from the crown gear alone, for any shaft angle."""
    for shaft, flank in ((90.0, "convex"), (75.0, "concave")):
        expected = crown_pair(flank, shaft_deg=shaft, lengthwise=2.0)
        mean = sizes(tables(flank, pinion_teeth=15, gear_teeth=44, outer_transverse_module_mm=4, face_width_mm=27,
                            shaft_angle_deg=shaft))["mean_normal_module_mm"]  # fmt: skip
        side = 1 if flank == "convex" else -1
        found = Drive.from_tables(tables(
            flank, {"blade_curvature_per_mm": 0.0}, shaft_angle_deg=shaft, pinion_teeth=15, gear_teeth=44,
            outer_transverse_module_mm=4, face_width_mm=27, cutter_radius_mm=76.2, mean_spiral_angle_deg=35,
            pinion_cutter_radius_mm=76.2 + side * 2, crown_addendum_factor=3 / mean, crown_dedendum_factor=3.7 / mean,
            pinion_profile_shift_coefficient=0,
        )).design  # fmt: skip
        for member in ("pinion", "gear"):
            for key, value in expected[member].items():
                if isinstance(value, float) and key != "blade_reference_mm":
                    angle = math.radians(1) if key.endswith("deg") else 1.0
                    assert found.value(key, member) / angle == pytest.approx(value, rel=1e-10, abs=1e-10), key


def test_an_offset_pair_is_set_as_a_formate_gear_and_its_own_cradle():
    """Settings of a hypoid 12/43 computed elsewhere, whose gear is cut with a blade of 20° on its convex flank."""
    first = sizes(OTHER)
    module, limit = first["mean_normal_module_mm"], first["limit_pressure_angle_deg"]
    deep = 4.350150, 5.274076
    document = OTHER | {"design": OTHER["design"] | {
        "pressure_angle_deg": 20 - limit, "crown_dedendum_factor": sum(deep) / (2 * module),
        "pinion_profile_shift_coefficient": (deep[1] - deep[0]) / (2 * module), "pinion_cutter_radius_mm": 91.567,
    }, "pinion": {"blade_curvature_per_mm": 0.0}}  # fmt: skip
    drive = Drive.from_tables(document)
    settings = {
        ("gear", "radial_setting_mm"): 97.910675, ("gear", "cradle_angle_deg"): 53.577966,
        ("pinion", "radial_setting_mm"): 98.022439, ("pinion", "swivel_deg"): -55.879582,
        ("pinion", "sliding_base_mm"): 13.442842,
    }  # fmt: skip
    solved = drive.design.as_solved()
    for (member, key), value in settings.items():
        assert solved[member][key] == pytest.approx(value, abs=2e-6), (member, key)
    result = drive.tca(drive.about_the_middle(np.linspace(-0.3, 0.3, 5)))
    assert {*result.status} == {"converged"}
    assert abs(result.relative_error).max() < 1e-9 * ARCSEC * 1e3


CONJUGATE = [
    tables(pinion_teeth=11, gear_teeth=41, outer_transverse_module_mm=5, offset_mm=30),
    tables("concave", pinion_teeth=11, gear_teeth=41, outer_transverse_module_mm=5, offset_mm=30, depth_taper="duplex"),
    tables(pinion_teeth=14, gear_teeth=37, outer_transverse_module_mm=3, shaft_angle_deg=75, offset_mm=12),
    tables(pinion_teeth=14, gear_teeth=37, outer_transverse_module_mm=3, depth_taper="standard"),
    tables("concave", pinion_teeth=15, gear_teeth=45, outer_transverse_module_mm=4, depth_taper="tilted_root_line"),
]  # fmt: skip


@pytest.mark.parametrize("document", CONJUGATE)
def test_without_a_curved_blade_every_pair_runs_without_error(document):
    """The pinion's cutter touches the gear's flank along a generatrix: contact in a point, no transmission error."""
    drive = Drive.from_tables(document | {"pinion": {"blade_curvature_per_mm": 0.0}})
    result = drive.tca(drive.about_the_middle(np.linspace(-0.2, 0.2, 5)))
    assert {*result.status} == {"converged"}
    assert abs(result.relative_error).max() < 1e-6 * ARCSEC


@pytest.mark.parametrize("document", [HYPOID, DUPLEX, OTHER])
def test_the_pair_touches_at_the_mean_point(document):
    """Where the gear's flank crosses its pitch cone at mid face, the pinion's touches it at the same turn."""
    drive = Drive.from_tables(document)
    stated = {key: size.value for key, size in drive.drawing().sizes.items()}
    result = drive.tca(drive.about_the_middle(np.linspace(-0.5, 0.5, 41)))
    delta = math.radians(stated["gear.pitch_angle_deg"])
    z, rho = result.points[:, 2] + stated["gear.pitch_apex_mm"], np.hypot(*result.points[:, :2].T)
    along = z * math.cos(delta) + rho * math.sin(delta) - stated["mean_cone_distance_mm"]
    above = rho * math.cos(delta) - z * math.sin(delta)
    assert np.hypot(along, above).min() < 0.05 * stated["mean_normal_module_mm"]


GIVEN_INSTEAD = [
    {"gear_outer_pitch_diameter_mm": None, "outer_transverse_module_mm": 200 / 41},
    {"gear_outer_pitch_diameter_mm": None, "gear_outer_pitch_radius_mm": 100},
    {"gear_outer_pitch_diameter_mm": None, "outer_transverse_diametral_pitch_per_in": 41 * 25.4 / 200},
    {"cutter_radius_mm": None, "cutter_diameter_in": 6},
]


@pytest.mark.parametrize("instead", GIVEN_INSTEAD)
def test_a_pair_may_be_given_by_other_sizes_of_the_same_drawing(instead):
    given = {key: value for key, value in (HYPOID["design"] | instead).items() if value is not None}
    found, whole = sizes(HYPOID | {"design": given}), sizes(HYPOID)
    for key in whole:
        if key.startswith("pinion."):
            assert found[key] == pytest.approx(whole[key], rel=1e-9, abs=1e-9), key


REFUSED = [
    ({"outer_transverse_module_mm": 5}, ("gear_outer_pitch_diameter_mm = 200", "outer_transverse_module_mm = 5")),
    ({"gear_outer_pitch_diameter_in": 8}, ("gear_outer_pitch_diameter_mm = 200", "gear_outer_pitch_diameter_in = 8")),
    ({"gear_mean_spiral_angle_deg": 30}, ("gear_mean_spiral_angle_deg = 30", "pinion_mean_spiral_angle_deg = 48")),
    ({"offset_mm": 3000}, ("offset_mm = 3000", "no pitch angle of the gear")),
    ({"offset_mm": 0, "shaft_angle_deg": 130}, ("shaft_angle_deg = 130", "opens to 90°")),
    ({"depth_taper": "steep"}, ("depth_taper = 'steep'", "duplex")),
]


@pytest.mark.parametrize(("design", "words"), REFUSED)
def test_what_contradicts_or_cannot_be_is_refused_with_the_keys(design, words):
    with pytest.raises(DesignError) as caught:
        Drive.from_tables(HYPOID | {"design": HYPOID["design"] | design})
    assert all(word in str(caught.value) for word in words)


def test_settings_of_ones_own_that_contradict_the_drawing_are_named():
    with pytest.raises(DesignError, match="pinion.tilt_deg = 12.0: contradicts .*offset_mm = 30"):
        Drive.from_tables(HYPOID | {"pinion": {"tilt_deg": 12.0}})


def test_settings_that_follow_may_be_written_and_changed(tmp_path):
    path, settings = tmp_path / "pair.toml", tmp_path / "settings.toml"
    path.write_text(toml_text(HYPOID))
    assert main(["drawing", str(path), "--toml", str(settings)]) == 0
    drive = Drive.load(path)
    written = Drive.load(settings).design.parameters
    assert np.allclose(written, drive.design.parameters, rtol=1e-14, atol=1e-14, equal_nan=True)
    assert Drive.load(settings).with_(pinion={"tilt_deg": 20.9}).tca([1.1]).status == ("converged",)
    assert drive.with_(flank="concave").design.value("blade_angle_deg", "gear") > math.radians(24)


def test_a_design_of_machine_settings_is_what_it_is():
    """Nothing is assumed of it, and what it follows from is not judged."""
    stated = Drive.load("bevel-hypoid").drawing().sizes
    assert "mean_spiral_angle_deg" not in stated and "cutter_radius_mm" not in stated
    assert stated["gear_outer_pitch_diameter_mm"].provenance == "derived"


@pytest.mark.parametrize("words", [
    "--z 11:41 --offset 30 --shaft-angle 90 --gear-outer-pitch-diameter 200 --cutter-radius 76.2",
    "--m 4 --z 15:45 --mean-spiral-angle 30 --cutter-radius 114.3",
    "--m 4 --z 15:45 --depth-taper duplex --hand right --set flank=concave",
])  # fmt: skip
def test_a_pair_is_started_in_the_words_of_its_drawing(tmp_path, capsys, words):
    path = tmp_path / "first.toml"
    assert main(["new", "bevel", *words.split(), "--out", str(path)]) == 0
    assert "the flanks touch, and nothing else before them" in capsys.readouterr().out
    drive = Drive.load(path)
    stated = drive.drawing().sizes
    assert stated["pressure_angle_deg"].provenance == "assumed" and stated["pinion_teeth"].provenance == "given"
    assert drive.contact_ratio().contact_ratio > 1.2


@pytest.mark.validate
def test_below_contact_ratio_1_the_size_to_change_is_named(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    words = "new bevel --m 4 --z 6:11 --depth-taper standard"
    assert main(words.split()) == 2 and not list(tmp_path.iterdir())
    told = capsys.readouterr().err
    assert "contact ratio 0.92" in told and "the pair meshes" in told
    place, number = next(line.split(",")[0].split()[1::2] for line in told.splitlines() if line.startswith("with "))
    assert main([*words.split(), f"--set={place}={number}"]) == 0


def standard(seed):
    """A pair of standard proportions, whose other sizes are at random."""
    draw = random.Random(seed)
    pinion = draw.randint(10, 22)
    gear = max(pinion + 5, round(pinion * draw.uniform(1.5, 6)))
    module = round(draw.uniform(1.5, 8), 2)
    diameter = module * gear
    design = {"pinion_teeth": pinion, "gear_teeth": gear, "outer_transverse_module_mm": module}
    if draw.random() < 0.5:
        design["offset_mm"] = round(draw.uniform(0.05, 0.2) * diameter, 2)
    else:
        design["mean_spiral_angle_deg"] = round(draw.uniform(25, 40), 1)
        design["shaft_angle_deg"] = round(draw.uniform(65, 90), 1)
    if draw.random() < 0.5:
        design["depth_taper"] = draw.choice(["standard", "duplex", "tilted_root_line"])
    return tables(draw.choice(["convex", "concave"]), **design)


@pytest.mark.parametrize("seed", quick(range(60), 0, 1))
def test_standard_pairs_at_random_mesh(seed):
    drive = Drive.from_tables(standard(seed))
    result = drive.tca(drive.about_the_middle(np.linspace(-0.5, 0.5, 5)))
    assert {*result.status} == {"converged"}
    assert drive.contact_ratio().contact_ratio > 1.0
