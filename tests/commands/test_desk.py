"""The first minutes at the command line: designs printed, words explained, misspelt keys named."""

import json
import math
import re
import shutil
import subprocess
import sys
import tomllib
from dataclasses import replace

import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.contact.analysis import statuses
from meshwright.design import description, design, outline
from tests.quick import quick


def test_a_packaged_design_is_printed_as_it_is_written(capsys):
    assert main(["show", "plain-za"]) == 0
    assert capsys.readouterr().out == (design.PACKAGED / "plain-za.toml").read_text(encoding="utf-8")


def test_a_changed_design_is_printed_as_a_file_that_loads(capsys, tmp_path):
    assert main(["show", "plain-za", "--set", "misalignment.vertical_deg=0.05", "--out", str(tmp_path / "d.toml")]) == 0
    again = Drive.load(tmp_path / "d.toml")
    assert again.design.given() == Drive.load("plain-za").with_(misalignment={"vertical_deg": 0.05}).design.given()


@pytest.mark.parametrize("name", design.packaged_names())
def test_every_packaged_design_survives_printing(name):
    given = Drive.load(name).design.given()
    assert tomllib.loads(design.toml_text(given)) == given


def test_every_status_and_flag_is_explained(capsys):
    assert main(["explain"]) == 0
    shown = capsys.readouterr().out
    for word in (*statuses().values(), "interference", "throat", "not_first", "edge_contact"):
        assert f" {word} " in shown
    assert main(["explain", "interference"]) == 0
    assert "bodies cannot make" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("contact ratio", "quantity contact_ratio: over how many pitches"),
        ("hob_pitch_radius_mm", "key hob_pitch_radius_mm [design] reference radius of the hob (cylindrical-worm)"),
        ("misalignment.center_distance_mm", "[misalignment]"),
        ("wide", "reason wide: the equations cannot be told to have one solution"),
    ],
)
def test_quantities_reasons_and_keys_are_explained(capsys, words, said):
    for typed in (words.split(), [words]):
        assert main(["explain", *typed]) == 0
        shown = capsys.readouterr().out
        assert said in shown and not ("." in words and "[design]" in shown)


@pytest.mark.parametrize(
    "word",
    [
        "relative", "ellipse", "ellipse semi-axes", "jams", "crowning", "tube", "joint", "unique", "rides on edge",
        "pairs change", "first type", "pitchfork", "tip thickness", "orders", "efficiency", "lever_arms_mm",
        "psi_fixed_hob", "helix", "transfer_angles_deg",
    ],
)  # fmt: skip
def test_words_that_commands_print_are_explained(capsys, word):
    assert main(["explain", word]) == 2 * (word == "ellipse semi-axes")
    shown = capsys.readouterr()
    assert len(shown.out) > 40 or "did you mean 'semi_axes'?" in shown.err


def _names(document):
    """Names of a document, without those of the design."""
    if isinstance(document, list):
        return set().union(*map(_names, document))
    if not isinstance(document, dict):
        return set()
    apart = {"design", "assumed_blank", "parameters", "unknowns"}
    return {*document}.union(*(_names(value) for name, value in document.items() if name not in apart))


COMMANDS = [
    *(["tca", name, "--phi-deg", "0", "--friction", "0.05"] for name in ("plain-za", "helical-crowned")),
    *(["ratio", name, "--friction", "0.05"] for name in ("plain-za", "spur-profile-shift")),
    *(["limits", name] for name in ("zk-zn-90", "bevel-hypoid", "helical-crowned")),
]


@pytest.mark.parametrize("words", quick(COMMANDS, *COMMANDS[::2]))
def test_every_name_and_label_that_a_command_writes_is_known_or_answered_with_another(capsys, words):
    assert main([*words, "--json", "-"]) == 0
    names = _names(json.loads(capsys.readouterr().out))
    assert main(words) == 0
    lines = capsys.readouterr().out.splitlines()[1:]
    labels = [re.match(r" *([a-z_,-]+( [a-z_,-]+)*?)(  +|: )", line) for line in lines]
    names |= {match[1].replace(",", "") for match in labels if match and len(match[1].split()) < 7}
    assert len(names) > 10
    for name in names:
        status, shown = main(["explain", *name.split()]), capsys.readouterr()
        assert status == 0 or "did you mean" in shown.err, name


def test_the_headings_of_a_report_are_explained_or_answered_with_another_word(capsys):
    from meshwright.report import analyse
    from meshwright.report.findings import tiles
    from meshwright.report.tables import groups

    analysis = analyse(Drive.load("spherical-table-3-1-concave"), lambda text: None)
    for words in (*(tile.label for tile in tiles(analysis)), *(group.title for group in groups(analysis))):
        status, shown = main(["explain", *words.split()]), capsys.readouterr()
        assert status == 0 or "did you mean" in shown.err, words


def test_the_help_of_new_names_the_words_of_every_family(capsys):
    with pytest.raises(SystemExit):
        main(["new", "--help"])
    shown = capsys.readouterr().out
    for word in ("worm_profile", "ZA, ZC, ZI, ZK, ZN", "concave, convex", "outer transverse module"):
        assert word in shown


def test_an_unknown_word_is_answered_with_the_nearest(capsys):
    assert main(["explain", "of_tip"]) == 2
    assert "did you mean 'off_tip'?" in capsys.readouterr().err


def test_a_misspelt_key_is_named_before_the_missing_one():
    tables = design.read("recess-action-full")
    tables["design"]["wheel_tooth"] = tables["design"].pop("wheel_teeth")
    with pytest.raises(ValueError, match="wheel_tooth.*unknown key.*wheel_teeth"):
        Drive.from_tables(tables)


def test_the_package_is_a_command():
    shown = subprocess.run([sys.executable, "-m", "meshwright", "show", "plain-za"], capture_output=True, text=True)
    assert shown.returncode == 0 and 'drive = "cylindrical-worm"' in shown.stdout


FIRST = [
    "cylindrical-worm --m 4 --z 2:40 --a 100 --profile ZI",
    "cylindrical-worm --m 2 --z 1:60 --profile ZN",
    "cylindrical-gears --m 2 --z 20:45",
    "spherical --m 3 --z 20:40",
    "face-worm --m 1.5 --z 2:60",
    "bevel --m 3 --z 14:40",
]


@pytest.mark.parametrize("words", quick(FIRST, *FIRST[1:4], FIRST[5]))
def test_a_first_design_of_every_family_meshes(tmp_path, monkeypatch, capsys, words):
    monkeypatch.chdir(tmp_path)
    assert main(["new", *words.split(), "--out", "first.toml"]) == 0
    shown = capsys.readouterr().out
    assert "first.toml written" in shown and "meshwright report first.toml" in shown
    drive = Drive.load("first.toml")
    result = drive.tca([0.0])
    assert result.status == ("converged",) and not any(flag != "off_face" for flag in result.flags[0])
    assert drive.contact_ratio().contact_ratio > 1.0


def test_a_first_design_gives_the_keys_of_a_tool_that_no_word_chooses():
    """A family of one drive has no words; what its tool alone needs to know is suggested like any other size."""
    family = description.families()["face-worm"]
    own = [p | {"tools": ["blade"]} if p["key"] == "blade_parabola_per_mm" else p for p in family.parameters]
    given = {"m": 3.0, "z_1": 2, "z_2": 51, "a": math.nan}
    text = outline.first_design(replace(family, parameters=own), "own", {}, given, {}).text
    assert tomllib.loads(text)["design"]["blade_parabola_per_mm"] > 0.0
    assert "design.profile_arc_radius_mm" in description.families()["cylindrical-worm"].unused({"worm_profile": "ZI"})


#: Worms of every form; steep threads and hollow flanks are those whose wheels an edge meets first. The wheel of a
#: hollow worm of one thread is undercut, and refused.
WORMS = [f"--m 4 --z {z} --profile {form}" for form in ("ZI", "ZN", "ZA", "ZK") for z in ("1:30", "2:40", "4:29")]
WORMS += [f"--m 4 --z {z} --profile ZC" for z in ("2:40", "4:29")]


@pytest.mark.parametrize("words", quick(WORMS, "--m 4 --z 2:40 --profile ZC", "--m 4 --z 4:29 --profile ZN"))
@pytest.mark.parametrize("flank", quick(["right", "left"], "right"))
def test_no_edge_of_a_first_worm_wheel_meets_the_worm_before_the_flanks(tmp_path, monkeypatch, capsys, words, flank):
    monkeypatch.chdir(tmp_path)
    setting = ["--set", f"flank={flank}", "--out", "first.toml"]
    assert main(["new", "cylindrical-worm", *words.split(), *setting]) == 0
    assert "the flanks touch, and nothing else before them" in capsys.readouterr().out
    assert Drive.load("first.toml").design.tables["flank"] == flank


@pytest.mark.parametrize("form", ["ZK", "ZC"])
def test_the_hob_of_a_first_worm_wheel_lies_along_the_teeth_that_the_worm_meets(tmp_path, monkeypatch, form):
    """Where hob and worm roll on the wheel, at its reference cylinder, both threads run along one tooth.

    Two screws with lead angles λ, λ_h there, whose axes stand at Σ, Σ_h to that of the wheel: Σ + λ = Σ_h + λ_h.
    """
    monkeypatch.chdir(tmp_path)
    assert main(["new", "cylindrical-worm", "--m", "4", "--z", "3:31", "--profile", form, "--out", "first.toml"]) == 0
    drive = Drive.load("first.toml")
    of, sizes = drive.design.value, drive.design.sizes
    worm_rolls, hob_rolls = (
        of(key) - sizes["wheel_pitch_radius_mm"] for key in ("center_distance_mm", "cutting_center_distance_mm")
    )
    lead = math.atan2(sizes["screw_parameter_worm_mm_per_rad"], worm_rolls)
    swivel = lead - math.atan2(sizes["screw_parameter_hob_mm_per_rad"], hob_rolls)
    cutting = math.degrees(of("cutting_shaft_angle_deg") - of("shaft_angle_deg"))
    assert cutting == pytest.approx(math.degrees(swivel), abs=2e-4) and cutting > 0.1


def test_a_convex_wheel_lies_in_the_hollow_of_a_first_concave_pinion(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    words = "new spherical --m 2 --z 20:33 --profile concave:convex --out first.toml"
    assert main(words.split()) == 0 and "the flanks touch, and nothing" in capsys.readouterr().out
    of = Drive.load("first.toml").design.value
    assert of("pinion_sphere_radius_mm") > of("wheel_sphere_radius_mm")


def test_a_first_worm_pair_stands_at_the_centre_distance_asked_for(tmp_path, monkeypatch):
    """ISO/TR 10828: q = 2a/m − z2 = 10 leaves the wheel without profile shift: r1 = qm/2 = 20, a = 100."""
    monkeypatch.chdir(tmp_path)
    assert main(["new", "cylindrical-worm", "--m", "4", "--z", "2:40", "--a", "100", "--name", "pair"]) == 0
    design = Drive.load("pair.toml").design
    assert design.value("worm_pitch_radius_mm") == 20.0
    assert design.value("center_distance_mm") == pytest.approx(100.0)
    assert design.sizes["wheel_pitch_radius_mm"] == pytest.approx(80.0, abs=1e-12)


@pytest.mark.parametrize(("teeth", "undercut"), quick([(17, True), (18, False)], (18, False)))
def test_new_writes_no_undercut_gear_unless_forced(tmp_path, monkeypatch, capsys, teeth, undercut):
    """A spur gear without profile shift whose rack's line ends a module below the pitch line: from 2/sin²20° = 17.1."""
    monkeypatch.chdir(tmp_path)
    plain = [f"--set=design.pinion_{kind}_crowning_um=0" for kind in ("lead", "profile")]
    words = ["new", "cylindrical-gears", "--m", "2", "--z", f"{teeth}:60", *plain, "--out", "first.toml"]
    assert main(words) == (2 if undercut else 0)
    assert ("the tool undercuts the flank of the pinion" in capsys.readouterr().err) == undercut
    assert (tmp_path / "first.toml").exists() != undercut
    if undercut:
        assert main([*words, "--force"]) == 0
        assert "the tool undercuts the flank of the pinion" in capsys.readouterr().out


@pytest.mark.validate
def test_a_size_of_ones_own_that_nothing_follows_is_said(tmp_path, monkeypatch, capsys):
    """The offset of a face worm drive is one of the proportions that its other sizes do not follow."""
    monkeypatch.chdir(tmp_path)
    words = ["new", "bevel", "--m", "4", "--z", "15:44", "--set", "gear.center_to_back_mm=3", "--out", "b.toml"]
    assert main(words) == 2 and not (tmp_path / "b.toml").exists()
    assert "without gear.center_to_back_mm = 3 the flanks touch" in capsys.readouterr().err
    assert main([*words, "--force"]) == 0
    assert "without gear.center_to_back_mm = 3 the flanks touch" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("own", "blamed"),
    [
        pytest.param(["design.hob_pitch_radius_mm=5"], "design.hob_pitch_radius_mm = 5", marks=pytest.mark.validate),
        (["contact.separation_mm=0.01", "design.hob_pitch_radius_mm=5"], "design.hob_pitch_radius_mm = 5"),
        (["contact.separation_mm=0.01"], None),
    ],
)
def test_a_size_of_ones_own_without_which_the_flanks_touch_is_named(tmp_path, monkeypatch, capsys, own, blamed):
    monkeypatch.chdir(tmp_path)
    settings = [f"--set={setting}" for setting in own]
    words = ["new", "cylindrical-worm", "--m", "4", "--z", "2:40", *settings, "--out", "w.toml"]
    assert main(words) == (2 if blamed else 0)
    lines = [line for line in capsys.readouterr().err.splitlines() if line.startswith("without ")]
    assert [line.split(" the flanks")[0] for line in lines] == ([f"without {blamed}"] if blamed else [])


#: Pairs of words of a family, of which some are derived on first use. In a hollow only a convex tooth has room.
PAIRS = ["convex:convex", "convex:spur", "spur:convex", "spur:spur", "concave:convex", "convex:concave"]


@pytest.mark.parametrize("pair", quick(PAIRS, "convex:spur", "convex:concave"))
def test_every_pair_of_words_whose_flanks_can_touch_gives_a_design(tmp_path, monkeypatch, pair):
    monkeypatch.chdir(tmp_path)
    assert main(f"new spherical --m 3 --z 30:50 --profile {pair} --out first.toml".split()) == 0


@pytest.mark.parametrize("teeth", ["14:30", "20:40", "40:14"])
def test_few_teeth_of_spherical_gears_are_given_room_for_the_rack(tmp_path, monkeypatch, teeth):
    monkeypatch.chdir(tmp_path)
    assert main(f"new spherical --m 3 --z {teeth} --out first.toml".split()) == 0


#: Words and what they lead to: keys of the design that is written, in the units of the keys.
DRAWN = {
    "--z 23:47 --set design.normal_diametral_pitch_per_in=10": {"normal_module_mm": 2.54, "face_width_mm": 25.4},
    "--m 3 --z 23:58 --set design.helix_angle_deg=14 --set design.pinion_hand=left --set design.pinion_span_teeth=4 "
    "--set design.pinion_span_mm=32.1": {"pinion_helix_angle_deg": -14.0, "wheel_helix_angle_deg": 14.0},
    "--m 2 --z 20:45 --a 66 --set design.normal_backlash_mm=0.1": {
        "pinion_thickness_allowance_um": -50 / math.cos(math.radians(20))},
    "--m 2 --z 20:45 --set design.transverse_module_mm=2.1": {
        "pinion_helix_angle_deg": math.degrees(math.acos(2 / 2.1))},
}  # fmt: skip


@pytest.mark.parametrize("words", DRAWN)
def test_a_first_design_is_asked_for_in_the_words_of_a_drawing(tmp_path, monkeypatch, words):
    monkeypatch.chdir(tmp_path)
    assert main(f"new cylindrical-gears {words} --out first.toml".split()) == 0
    given = Drive.load("first.toml").design.tables["design"]
    for key, value in DRAWN[words].items():
        assert given[key] == pytest.approx(value, rel=2e-3), key  # profile shifts are rounded to 1e-4 modules


REFUSED = {
    "new bevel --m 2 --z 20:-60": "20:-60: no wheel of the family bevel; use `meshwright new internal-gears`",
    "new spherical --m 2 --z 20:internal": "20:internal: no wheel.*use `meshwright new internal-gears`",
    "new cylindrical-gears --m 2 --z 20:internal": "design.wheel_teeth: the key is missing",
    "new cylindrical-gears --m 2 --z 20:-60 --wheel-kind external": "kind = 'external': contradicts.*wheel_teeth = -60",
    "new cylindrical-gears --m 2 --z 20:rack": "wheel_kind = 'rack': no family has a rack",
    "new cylindrical-gears --m 2 --z 20:moon": "moon: no wheel of the family cylindrical-gears; give its number",
    "new internal-gears --m 2 --z 20:-24": "tips meet outside the path of contact.*margin in rad of the ring gear -0.0",
    "new cylindrical-gears --z 20:60": "--m: no module",
    "new cylindrical-wurm --m 4 --z 2:40": "did you mean 'cylindrical-worm'",
    "new cylindrical-worm --m 4 --z 2:40 --profile ZX": "no drive of this family has these words.*ZA, ZC, ZI, ZK, ZN",
    "new spherical --m 4 --z 20:40 --a 100": "centre distance of this family follows from its teeth",
    "new cylindrical-worm --m 4 --z 2:40 --set design.wheel_tooth=40": "wheel_tooth.*unknown key",
    "new cylindrical-worm --m 4 --z 2:40 --set hand=left": "hand = 'left'.*unknown key.*design.hand",
    "new cylindrical-worm --m 4 --z 2:40 --set flank=middle": "flank = 'middle'",
    "new cylindrical-worm --m 4 --z 2:40 --a 500": "x_2 = 95: profile shift.* -1 to 1: change one of --m, --z, --a",
    "new cylindrical-worm --m 4 --z 2:40 --a 10": "x_2 = -21.*change one of --m, --z, --a",
    "new cylindrical-worm --m 4 --z 40:2": "no design follows from --m --z --a.*hob_tip_rounding",
    "new cylindrical-gears --m 3 --z 19:53 --a 120": "y = 4: centre distance modification.*change one of --m",
}


@pytest.mark.parametrize("words", REFUSED)
def test_a_first_design_that_cannot_be_is_refused(tmp_path, monkeypatch, capsys, words):
    import re

    monkeypatch.chdir(tmp_path)
    assert main(words.split()) == 2
    assert re.search(REFUSED[words], capsys.readouterr().err)
    assert not list(tmp_path.iterdir())


def test_no_file_is_overwritten(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.toml").write_text("precious")
    assert main(["new", "cylindrical-gears", "--m", "2", "--z", "20:45", "--name", "mine"]) == 2
    assert "exists already" in capsys.readouterr().err and (tmp_path / "mine.toml").read_text() == "precious"
    assert main(["new", "cylindrical-gears", "--m", "2", "--z", "20:45", "--out", "mine.toml"]) == 2
    assert "exists already" in capsys.readouterr().err and (tmp_path / "mine.toml").read_text() == "precious"
    assert main(["show", "plain-za"]) == 0
    text = capsys.readouterr().out
    (tmp_path / "plain-za.toml").write_text(text)
    assert main(["tca", "plain-za.toml", "--phi-deg", "0", "--json", "./plain-za.toml"]) == 2
    assert "is the design itself" in capsys.readouterr().err
    assert (tmp_path / "plain-za.toml").read_text() == text
    assert main(["tca", "plain-za", "--phi-deg", "0", "--json", "new.txt", "--csv", "./new.txt"]) == 2
    assert "--csv ./new.txt: is the file of --json too" in capsys.readouterr().err
    assert not (tmp_path / "new.txt").exists()
    assert main(["tca", "plain-za", "--phi-deg", "0", "--json", "/dev/null", "--csv", "/dev/null"]) == 0


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ("design.axial_module_mm=5", "design.center_distance_mm = 100: 120 by"),
        ("design.center_distance_mm=120", "x_2 = 5: profile shift coefficient of the wheel"),
        ("design.hob_pitch_radius_mm=5", "design.hob_pitch_radius_mm = 5: 21 by"),
    ],
)
def test_where_flanks_meet_nowhere_the_sizes_that_do_not_belong_together_are_named(tmp_path, capsys, change, told):
    place = tmp_path / "pair.toml"
    assert main(["new", "cylindrical-worm", "--m", "4", "--z", "2:40", "--a", "100", "--out", str(place)]) == 0
    assert main(["tca", str(place), "--phi-deg", "0", "--set", change]) == 1
    assert told in capsys.readouterr().err


def test_of_cylindrical_gears_too(tmp_path, capsys):
    place = tmp_path / "pair.toml"
    assert main(["new", "cylindrical-gears", "--m", "3", "--z", "19:53", "--a", "109", "--out", str(place)]) == 0
    assert main(["tca", str(place), "--phi-deg", "0", "--set", "design.pinion_teeth=30"]) == 1
    assert "y = -5.167: centre distance modification coefficient; sound designs have -1 to 2" in capsys.readouterr().err


def test_a_helical_pair_is_parallel_and_without_backlash_at_its_centre_distance(tmp_path, monkeypatch, capsys):
    """Sum of the profile shifts by involutes of the working and the reference transverse pressure angle (ISO 21771)."""
    monkeypatch.chdir(tmp_path)
    given = ["--m", "3", "--z", "19:53", "--a", "114", "--set", "design.pinion_helix_angle_deg=18"]
    assert main(["new", "cylindrical-gears", *given, "--name", "h"]) == 0
    made = tomllib.loads((tmp_path / "h.toml").read_text())["design"]
    assert made["wheel_helix_angle_deg"] == -18
    capsys.readouterr()
    assert main(["ratio", "h.toml", "--set", "design.pinion_profile_crowning_um=0", "--json", "-"]) == 0
    assert abs(json.loads(capsys.readouterr().out)["backlash_arcsec"]) < 0.2  # shifts are rounded to 1e-4 modules


def test_bash_completes_designs_and_commands(tmp_path, capsys):
    bash = shutil.which("bash") or pytest.skip("bash not found")
    assert main(["completion", "bash"]) == 0
    script = tmp_path / "complete.bash"
    script.write_text(capsys.readouterr().out)

    def completed(*words):
        asked = f"COMP_WORDS=({' '.join(words)}); COMP_CWORD={len(words) - 1}; _shtab_meshwright meshwright {words[-1]}"
        told = subprocess.run(
            [bash, "-c", f'source {script}; {asked}; printf "%s\\n" "${{COMPREPLY[@]}}"'],
            capture_output=True,
            text=True,
            cwd=tmp_path,
        )
        return told.stdout.split()

    assert completed("meshwright", "rat") == ["ratio"]
    assert completed("meshwright", "tca", "zk-zn") == [n for n in design.packaged_names() if n.startswith("zk-zn")]
    assert "complete.bash" in completed("meshwright", "tca", "com")
    assert completed("meshwright", "new", "spher") == ["spherical"]


@pytest.mark.parametrize("shell", ["zsh", "fish"])
def test_other_shells_take_their_script(tmp_path, capsys, shell):
    program = shutil.which(shell) or pytest.skip(f"{shell} not found")
    assert main(["completion", shell]) == 0
    script = tmp_path / "script"
    script.write_text(capsys.readouterr().out)
    assert subprocess.run([program, "-n", script], capture_output=True).returncode == 0
