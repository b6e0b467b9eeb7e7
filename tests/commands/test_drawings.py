"""Drawings of every family, each started by one call of ``new`` in the drawing's own words; and at random."""

import math
import random

import pytest

from meshwright import Drive
from meshwright.cli import main
from tests.quick import quick

#: Words, and sizes that the drawing of the design then states.
DRAWINGS = {
    "cylindrical-worm --z 2:40 --profile ZI --m 4 --worm-diameter-quotient 10 --hob-pitch-diameter 40 "
    "--normal-backlash 0.08": {"center_distance_mm": 100.0, "cutting_center_distance_mm": 100.0, "axial_backlash_mm":
        0.08 / (math.cos(math.atan(0.2)) * math.cos(math.radians(20)))},
    "cylindrical-worm --z 1:45 --profile ZK --axial-pitch 4.71238898 --worm-diameter-quotient 11.2 "
    "--hob-pitch-diameter 16.8": {"cutting_center_distance_mm": 42.15, "worm_thickness_allowance_um": -31.9},
    "cylindrical-worm --z 1:30 --profile ZK --axial-pitch 12.566370614 --worm-pitch-diameter 40 "
    "--wheel-profile-shift-coefficient 0.3": {"center_distance_mm": 81.2, "worm_diameter_quotient": 10.0},
    "cylindrical-worm --z 1:30 --profile ZA --m 4 --worm-diameter-quotient 10 --center-distance 79": {
        "wheel_profile_shift_coefficient": -0.25},
    "cylindrical-gears --m 3 --z 23:47 --helix-angle 20 --pinion-hand left --pinion-lead-crowning 6 "
    "--pinion-tip-relief 20 --pinion-tip-relief-radius 38.5 --pinion-thickness-upper-allowance -40 "
    "--pinion-thickness-lower-allowance -60 --wheel-normal-thickness 4.65": {
        "pinion_helix_angle_deg": -20.0, "pinion_thickness_allowance_um": -50.0,
        "wheel_thickness_allowance_um": 4650 - 1500 * math.pi},
    "bevel --z 11:41 --offset 30 --shaft-angle 90 --gear-outer-pitch-diameter 200 --face-width 30 --cutter-radius 76.2 "
    "--pinion-mean-spiral-angle 48": {"gear.pitch_angle_deg": 69.0225188},
    "bevel --z 15:45 --m 4 --mean-spiral-angle 30 --cutter-radius 114.3": {
        "gear.pitch_angle_deg": math.degrees(math.atan(3)), "gear_outer_pitch_diameter_mm": 180.0},
    "spherical --z 30:50 --m 3 --pressure-angle 20 --profile convex:spur": {"pinion_sphere_radius_mm": 45.0},
    "face-worm --z 2:60 --m 1.5": {"axial_module_mm": 1.5},
}  # fmt: skip


@pytest.mark.parametrize("words", quick(list(DRAWINGS), *list(DRAWINGS)[::3]))
def test_a_drawing_is_started_in_its_own_words(tmp_path, capsys, words):
    place = tmp_path / "first.toml"
    assert main(["new", *words.split(), "--out", str(place)]) == 0, capsys.readouterr().err
    assert "the flanks touch" in capsys.readouterr().out
    stated = Drive.load(place).drawing().sizes
    for key, value in DRAWINGS[words].items():
        assert stated[key].value == pytest.approx(value, rel=1e-6, abs=1e-6), key


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("bevel --m 4 --z 11:41 --offsett 3", "unrecognized arguments"),
        ("bevel --m 4 --z 11:41 --center-distance 90", "--center-distance 90: no size of the family bevel"),
        ("bevel --m 4 --z 11:41 --gear-outer-pitch-diameter 200", "4.0: contradicts design.gear_outer_pitch_diameter"),
        ("bevel --m 4 --z 11:41 --depth-taper steep", "use 'uniform', 'standard', 'duplex' or 'tilted_root_line'"),
        ("spherical --m 3 --z 20:40 --profile concave:spur", "wheel_form = spur: a hollow tooth takes a convex one"),
        ("cylindrical-worm --m 3 --z 2:40 --profile ZN:ZC", "a hollow thread and a hob of another form"),
    ],
)
def test_words_that_make_no_drawing_are_refused(tmp_path, monkeypatch, capsys, words, said):
    monkeypatch.chdir(tmp_path)
    try:
        assert main(["new", *words.split()]) == 2
    except SystemExit as ended:  # of the parser
        assert ended.code == 2
    assert said in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def gears(draw, module):
    teeth = draw.randint(19, 40)
    words = ["--z", f"{teeth}:{draw.randint(teeth, 110)}"]
    words += draw.choice([["--m", module], ["--normal-diametral-pitch", 25.4 / module]])
    words += draw.choice([[], ["--helix-angle", draw.uniform(5, 30), "--pinion-hand", draw.choice(["left", "right"])]])
    allowances = ["--pinion-thickness-upper-allowance", -30, "--pinion-thickness-lower-allowance", -70]
    return words + draw.choice([[], ["--normal-backlash", 0.05 * module], allowances])


def worms(draw, module):
    quotient = draw.choice([9, 10, 11.2, 12.5])
    words = ["--z", f"{draw.randint(1, 3)}:{draw.randint(30, 60)}", "--profile", draw.choice(["ZI", "ZA", "ZN", "ZK"])]
    words += draw.choice([["--m", module], ["--axial-pitch", math.pi * module]])
    words += draw.choice([["--worm-diameter-quotient", quotient], ["--worm-pitch-diameter", quotient * module]])
    words += draw.choice([[], ["--wheel-profile-shift-coefficient", draw.uniform(-0.3, 0.3)]])
    equal = ["--hob-pitch-radius", quotient * module / 2]
    return words + draw.choice([[], equal, [*equal, "--normal-backlash", 0.02 * module]])


def spheres(draw, module):
    teeth = draw.randint(16, 40)
    forms = ["convex:convex", "convex:spur", "spur:spur", "concave:convex", "convex:concave"]
    return ["--m", module, "--z", f"{teeth}:{draw.randint(teeth, 80)}", "--profile", draw.choice(forms)]


FAMILIES = {"cylindrical-gears": gears, "cylindrical-worm": worms, "spherical": spheres}


@pytest.mark.parametrize("seed", quick(range(20), 0))
@pytest.mark.parametrize("family", FAMILIES)
def test_standard_drawings_at_random_mesh(tmp_path, capsys, family, seed):
    draw = random.Random(seed)
    words = FAMILIES[family](draw, draw.choice([1, 1.5, 2, 3, 4, 6]))
    place = str(tmp_path / "first.toml")
    written = [f"{word:.9g}" if isinstance(word, float) else str(word) for word in words]
    assert main(["new", family, *written, "--out", place]) == 0, capsys.readouterr().err
