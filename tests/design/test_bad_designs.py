"""Bad input: an error that names key, value, reason and remedy; exit status 2; nothing already written is lost."""

import random
import re
import subprocess
import sys

import pytest

from meshwright import DesignError, Drive, UsageError
from meshwright.cli import main
from meshwright.contact.analysis import largest_angle
from meshwright.design import design

CASES = [
    ({"design.normal_module_mm": 0.0}, ("normal_module_mm", "0", "greater than 0")),
    ({"design.normal_module_mm": -2.0}, ("normal_module_mm", "-2", "greater than 0")),
    ({"design.normal_module_mm": 1e-300}, ("design.normal_module_mm = 1e-300", "too small", "larger")),
    ({"design.worm_lead_angle_deg": 1e-300}, ("design.worm_lead_angle_deg = 1e-300", "too small", "larger")),
    ({"design.normal_module_mm": float("nan")}, ("normal_module_mm", "nan", "finite")),
    ({"design.normal_module_mm": float("inf")}, ("normal_module_mm", "inf", "finite")),
    ({"design.normal_module_mm": "2"}, ("normal_module_mm", "'2'", "number")),
    ({"design.normal_module_mm": True}, ("normal_module_mm", "True", "number")),
    ({"design.worm_threads": 1.5}, ("worm_threads", "1.5", "whole number")),
    ({"design.worm_threads": 0}, ("worm_threads", "0", "greater than 0")),
    ({"design.worm_lead_angle_deg": 90.0}, ("worm_lead_angle_deg", "90", "less than 90")),
    ({"design.worm_lead_angle_deg": 0.0}, ("worm_lead_angle_deg", "greater than 0")),
    ({"design.shaft_angle_deg": 180.0}, ("shaft_angle_deg", "180", "less than 180")),
    ({"design.shaft_angle_deg": 178.0}, ("shaft_angle_deg", "178", "lead angle", "below 180")),
    ({"design.worm_pitch_radius_mm": 19.0}, ("worm_pitch_radius_mm", "determine each other", "exactly one")),
    ({"design.axial_module_mm": 2.0}, ("axial_module_mm", "determine each other", "exactly one")),
    ({"design.hob_pitch_radius_mm": 0.9}, ("hob_pitch_radius_mm", "0.9", "too thin", "m_n")),
    ({"design.pitch_line_shift_mm": 10.0}, ("pitch_line_shift_mm", "10", "groove", "change")),
    ({"design.worm_profile": "ZX"}, ("worm_profile", "ZX", "use")),
    ({"design.worm_profile": "ZK"}, ("grinding_wheel_radius_mm", "without it", "add")),
    ({"design.grinding_wheel_radius_mm": 60.0}, ("grinding_wheel_radius_mm", "60", "not use it", "ZC, ZK", "remove")),
    ({"design.hob_profile_arc_radius_mm": 40.0}, ("hob_profile_arc_radius_mm", "40", "not use it", "ZC", "remove")),
    ({"design.normal_modul_mm": 2.0}, ("normal_modul_mm", "unknown key", "normal_module_mm")),
    ({"misalignment.temperature": 2.0}, ("temperature", "unknown key", "remove it", "[misalignment] has center_dist")),
    ({"flank": "top"}, ("flank", "top", "right", "left")),
    ({"design.worm_threads": 10**330}, ("worm_threads", "greater than 100000", "smaller")),
    ({"contact.elastic_allowance_mm": -1.0}, ("elastic_allowance_mm", "-1", "not be less than 0", "larger")),
    ({"misalignment": 3.0}, ("misalignment", "3.0", "table", "[misalignment]")),
    ({"name": 3}, ("name", "3", "text", "quotes")),
    ({"drive": ["cylindrical-worm"]}, ("drive", "cylindrical-worm", "no such family", "use one of")),
    ({"blank.worm_tip_radius_mm": 18.0, "blank.worm_root_radius_mm": 18.5}, ("blank.worm_tip_radius_mm", "18", "18.5")),
    ({"misalignment.vertical_deg": 1e308}, ("misalignment.vertical_deg", "1e+308", "not be greater than 360")),
    ({"misalignment.center_distance_mm": -1e12}, ("center_distance_mm", "not be less than -1e+09")),
    ({"design.wheel_teeth": 10**17}, ("wheel_teeth", "not be greater than 100000")),
    ({"name": "\x1b[31mred"}, ("name", r"\x1b[31mred", "control characters")),
    ({"name": "a" * 10_000}, ("name", "a...a", "longer than 200")),
    ({"drive": "cylindrical-wurm"}, ("drive", "cylindrical-wurm", "cylindrical-worm")),
]  # fmt: skip


@pytest.mark.parametrize(("changes", "words"), CASES)
def test_a_bad_design_is_refused_with_key_value_reason_and_remedy(changes, words):
    tables = design.changed(design.read("recess-action-full"), changes)
    with pytest.raises(DesignError) as caught:
        Drive.from_tables(tables)
    for word in words:
        assert word in str(caught.value)


def test_an_unknown_key_of_a_table_of_few_is_answered_with_all_of_them():
    """Bevel gears have the misalignments V, H, J and Σ, not those of other families."""
    with pytest.raises(DesignError) as caught:
        Drive.load("bevel-formate").with_(misalignment={"vertical_deg": 0.1})
    assert str(caught.value).endswith("[misalignment] has offset_mm, pinion_axial_mm, gear_axial_mm, shaft_angle_deg")


@pytest.mark.parametrize("name", ["plain-za", "crossed-helical-17-23", "face-worm-conical-concave"])
def test_a_size_too_small_to_compute_with_is_named_not_what_follows_from_it(name):
    drive = Drive.load(name)
    key = next(k for k in ("normal_module_mm", "axial_module_mm") if drive.design.tables["design"].get(k))
    with pytest.raises(DesignError, match=f"design.{key} = 1e-300: too small to compute with.*larger"):
        drive.with_(design={key: 1e-300})


@pytest.mark.parametrize("name", ["plain-zn", "spherical-table-2-3", "helical-crowned", "face-worm-conical-convex",
                                  "bevel-formate"])  # fmt: skip
def test_flanks_that_are_far_apart_do_not_touch(name):
    """A separation of metres would draw an ellipse of metres; marking compound has some thousandths of a millimetre."""
    drive, chance = Drive.load(name), random.Random(name)
    for separation in (1.0 + 1e-9, 1e5, 10.0 ** chance.uniform(0.0, 9.0)):
        with pytest.raises(DesignError, match="contact.separation_mm = .*: must not be greater than 1; .*smaller"):
            drive.with_(contact={"separation_mm": separation})
    drive.with_(contact={"separation_mm": 1.0})


def test_missing_keys_are_named():
    tables = design.read("recess-action-full")
    del tables["design"]["wheel_teeth"]
    with pytest.raises(DesignError, match=r"design\.wheel_teeth: the key is missing; add it"):
        Drive.from_tables(tables)
    tables = design.read("recess-action-full")
    del tables["design"]["normal_module_mm"]
    with pytest.raises(DesignError, match="normal_module_mm and axial_module_mm.*exactly one"):
        Drive.from_tables(tables)


@pytest.mark.parametrize(
    "arguments",
    [
        ["tca", "no-such-design"],
        ["tca", "recess-action-full", "--phi-deg", "0:10"],
        ["tca", "recess-action-full", "--phi-deg", "10:0:1"],
        ["tca", "recess-action-full", "--set", "design.normal_module_mm"],
        ["tca", "recess-action-full", "--set", "design.normal_module_mm=0"],
        ["tca", "recess-action-full", "--phi-deg", "500", "--json", "/no/such/folder/out.json"],
        ["tca", "recess-action-full", "--phi-deg", "500", "--json", "/"],
        ["tca", "recess-action-full", "--phi-deg", "500", "--json", ""],
        ["tca", "recess-action-full", "--phi-deg", "0:1e400:1"],
        ["tca", "plain-zi", "--phi-deg", "1e300"],
        ["tca", "plain-zi", "--phi-deg=-6e7:0:1e7"],
        ["tca", "plain-zi", "--phi-deg", "0", "--contour", "100000000", "--json", "-"],
        ["tca", "plain-zi", "--phi-deg", "0", "--csv", "-", "--json", "-"],
        ["surface", "plain-zi", "--member", "wheel", "--vtu", "-", "--stl", "-"],
        ["limits", "zk-zn-90", "--grid", "100000000"],
        ["limits", "zk-zn-90", "--section-y-mm", "1e9"],
        ["limits", "spherical-table-2-3", "--section-y-mm", "5"],
        ["surface", "recess-action-full", "--member", "wheel", "--grid", "99999x99999"],
        ["sweep", "recess-action-full", "--vary", "misalignment.vertical_deg=0:nan", "--samples", "2", "--out", "/x"],
        ["sweep", "plain-zn", "--vary", "misalignment.vertical_deg=0:1", "--samples", "2", "--out", "/dev/null"],
        ["sweep", "plain-zn", "--vary", "misalignment.vertical_deg=0:1", "--samples", "2", "--out", "/x", "--seed=-1"],
        ["sweep", "plain-zn", "--vary", "misalignment.vertical_deg=0:1", "--samples", "1000000000000", "--out", "/x"],
        ["sweep", "plain-zn", "--vary", "misalignment.vertical_deg=-1e308:1e308", "--samples", "2", "--out", "/x"],
        ["sweep", "plain-zn", "--vary", "misalignment.vertical_deg=0:1", "--vary", "misalignment.axial_mm=0:1",
         "--vary", "misalignment.horizontal_deg=0:1", "--vary", "misalignment.center_distance_mm=0:1",
         "--grid", "100000", "--out", "/x"],
        ["sweep", "recess-action-full", "--samples", "2", "--out", "/x", "--vary", "misalignment.vertical_deg=0:1",
         "--vary", "misalignment.vertical_deg=0:2"],
    ],
)  # fmt: skip
def test_the_command_line_answers_bad_input_with_status_two_and_no_traceback(arguments, capsys):
    assert main(arguments) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith("meshwright: ")
    assert "Traceback" not in captured.err


@pytest.mark.parametrize(
    ("arguments", "named"),
    [(["tca", "plain-zi", "--phi-deg="], "--phi-deg: an empty word"), (["tca", ""], "DESIGN: an empty word")],
)
def test_an_empty_word_is_named_as_it_was_typed(arguments, named, capsys):
    assert main(arguments) == 2
    assert named in capsys.readouterr().err


def test_a_region_without_its_sizes_names_the_keys_that_are_open(capsys):
    assert main(["surface", "plain-za", "--member", "wheel", "--region", "fillet", "--grid", "3x3"]) == 2
    assert "hob_tip_rounding_mm" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("value", "remedy"), [("277", "without quotes"), (True, "without quotes"), (277.5, "without a decimal point")]
)
def test_a_count_that_is_no_whole_number_gets_the_remedy_that_fits(value, remedy):
    with pytest.raises(DesignError, match=f"design.wheel_teeth.*must be a whole number; .*{remedy}"):
        Drive.load("recess-action-full").with_(design={"wheel_teeth": value})


@pytest.mark.parametrize("angles", [[float("nan")], [0.0, float("inf")], [-1e9], [[0.0, 1.0]]])
@pytest.mark.parametrize("analysis", [Drive.tca, Drive.trace])
def test_angles_that_cannot_be_traced_are_refused(analysis, angles):
    with pytest.raises(UsageError, match=f"angles: .*; give none beyond {largest_angle():g} rad"):
        analysis(Drive.load("plain-zi"), angles)


def test_a_file_that_is_not_toml_is_refused(tmp_path, capsys):
    path = tmp_path / "broken.toml"
    path.write_text("drive = \n", encoding="utf-8")
    assert main(["tca", str(path)]) == 2
    assert "not a TOML file" in capsys.readouterr().err


def test_a_failed_command_keeps_the_file_already_there(tmp_path):
    out = tmp_path / "out.json"
    assert main(["tca", "recess-action-full", "--phi-deg", "500", "--json", str(out)]) == 0
    before = out.read_text(encoding="utf-8")
    assert main(["tca", "recess-action-full", "--set", "design.worm_threads=0", "--json", str(out)]) == 2
    assert out.read_text(encoding="utf-8") == before
    assert [p.name for p in tmp_path.iterdir()] == ["out.json"]


def test_the_program_starts_as_a_process():
    done = subprocess.run(
        [sys.executable, "-m", "meshwright.cli", "tca", "nothing"], capture_output=True, text=True, check=False
    )
    assert done.returncode == 2
    assert "Traceback" not in done.stderr


FILES = {
    "digits": (b"drive = 'x'\nvalue = " + b"9" * 5000, "number that cannot be read"),
    "nested": (b"x = " + b"[" * 5000 + b"]" * 5000, "nested too deeply"),
    "carriage-returns": (b"drive = 'x'\rname = 'y'\r", "not a TOML file"),
    "not-utf-8": (b"name = '\xff\xfe'", "save it as UTF-8"),
    "long": (b"#" * (design.LARGEST_FILE + 1), "longer than 1048576 bytes"),
}


def _nested(chance):
    """TOML text of nested tables: so many names that tables of tables, or a key's dots, go deep."""
    names = chance.choices(("a", "x1", '"q.q"', "'='", '"\\""'), k=chance.choice((40, 300, 500, 3000, 60_000)))
    dotted = chance.choice((".", " . ")).join(names)
    return chance.choice((
        f"[{dotted}]\n", f"[[{dotted}]]\n", f"{dotted} = 1\n", f"x = {{{dotted} = 1}}\n", f"[{dotted}]\n[{dotted}.b]\n",
        "x = " + "".join(f"{{{name} = " for name in names) + "1" + "}" * len(names),
        "x = " + "[{a = " * len(names) + "1" + "}]" * len(names),
    ))  # fmt: skip


@pytest.mark.parametrize("seed", range(30))
def test_nested_tables_are_refused_before_they_cost_time_or_stack(seed, tmp_path, capsys):
    text = "drive = 'spherical'\n" + _nested(random.Random(seed))
    (tmp_path / "design.toml").write_text(text, encoding="utf-8")
    assert main(["tca", str(tmp_path / "design.toml")]) == 2
    assert re.search("nested too deeply|unknown key", capsys.readouterr().err)
    with pytest.raises(DesignError):
        Drive.from_tables(_deep(seed))


def _deep(depth):
    tables = {"drive": "spherical", "flank": "right"}
    inner = tables
    for _ in range(10 ** (1 + depth % 4)):
        inner["design"] = inner = {}
    return design.changed(tables, {"design.x": 1.0})


def test_dots_in_names_and_remarks_nest_nothing():
    dots = ".".join("a" * 80)
    text = f'# {dots}\nname = "{dots}"\n' + f"x = \'\'\'\n{dots} = 1\n\'\'\'\n" + f'y = """\n{dots}"""\n'
    assert design.parsed(text, "FILE") == {"name": dots, "x": f"{dots} = 1\n", "y": dots}


@pytest.mark.parametrize("kind", FILES)
def test_a_file_that_is_no_design_is_refused(tmp_path, kind):
    content, words = FILES[kind]
    (tmp_path / "design.toml").write_bytes(content)
    with pytest.raises(DesignError, match=words) as caught:
        design.read(tmp_path / "design.toml")
    assert len(str(caught.value)) < 600 + len(str(tmp_path))


def test_an_endless_file_is_refused():
    with pytest.raises(DesignError, match="longer than"):
        design.read("/dev/zero")


def test_a_byte_order_mark_is_read_over(tmp_path):
    (tmp_path / "design.toml").write_bytes(b"\xef\xbb\xbf" + (design.PACKAGED / "plain-za.toml").read_bytes())
    assert design.read(tmp_path / "design.toml") == design.read("plain-za")


def test_no_value_is_echoed_whole_and_none_reaches_the_terminal_as_it_is(capsys):
    assert main(["tca", "plain-za", "--set", "design.worm_profile=" + "Z" * 10_000]) == 2
    assert main(["tca", "plain-za", "--set", "x" * 10_000 + ".y=1"]) == 2
    assert main(["tca", "plain-za", "--set", "design.worm_profile=\x1b[31m"]) == 2
    shown = capsys.readouterr().err
    assert len(shown) < 2000 and "\x1b" not in shown


RED = "\x1b[31m\x9b\u202ered"


@pytest.mark.parametrize(
    "arguments",
    [
        [RED], ["tca", RED], ["tca", f"{RED}.toml"], ["tca", "plain-za", f"--{RED}"],
        ["tca", "plain-za", "--set", f"{RED}=1"], ["tca", "plain-za", "--set", f"design.{RED}=1"],
        ["tca", "plain-za", "--phi-deg", RED], ["explain", RED],
        ["tca", "plain-za", "--phi-deg", "0", "--json", f"/{RED}/file"], ["new", RED, "--m", "1", "--z", "1:40"],
        ["surface", "plain-za", "--member", RED], ["--drives", f"/{RED}", "tca", "plain-za"],
        ["sweep", "plain-za", "--vary", f"{RED}=0:1", "--samples", "2", "--out", "/dev/null"],
    ],
    ids=ascii,
)  # fmt: skip
def test_no_control_character_of_the_command_line_reaches_the_terminal(arguments, capsys):
    try:
        status = main(arguments)
    except SystemExit as ended:  # of argparse
        status = ended.code
    shown = "".join(capsys.readouterr())
    assert status == 2 and "x1b" in shown
    assert not {c for c in shown if not c.isprintable()} - {"\n"}


@pytest.mark.parametrize("letter", ["\0", "\x07", "\x1b", "\x7f", "\x9b", "\r", "\n", "\u202e", "\u2066"], ids=ascii)
def test_a_name_with_control_characters_is_no_design_and_so_in_no_page(letter):
    """Report and live page take the name from here; markup in it they escape: see their own tests."""
    tables = design.read("plain-za") | {"name": f"a{letter}b"}
    with pytest.raises(DesignError, match="name.*control characters"):
        Drive.from_tables(tables)
    with pytest.raises(DesignError, match="name.*control characters"):
        Drive.load("plain-za").with_(name=f"a{letter}b")
