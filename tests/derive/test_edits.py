"""An edited page compiles, or is refused in words; what the edit makes false is open and cited nowhere."""

import json
import re
from itertools import islice

import pytest

from tests.derive import edits

#: A crown on the edge of the ZN tool, which is no straight line then.
CROWNED = ("s * t * sp.sin(alpha))", "s * t * sp.sin(alpha) - s * t**2 / 4000)")


@pytest.fixture(scope="module")
def tree(tmp_path_factory):
    return edits.copy_of_tree(tmp_path_factory.mktemp("tree"))


def cited(header):
    """Statement → key, as the header lists them."""
    head = header.partition(" * Equations, each")[2].partition(" * Open statements")[0].partition("*/")[0]
    return dict(line.strip(" *").split() for line in head.splitlines()[1:] if line.strip(" *"))


def in_functions(header):
    """The statements that the comments of functions name."""
    found = re.findall(r"/\* Equations: ([^*]*(?:\*[^/][^*]*)*)\. \*/", header)
    return {key.strip(" *\n") for keys in found for key in keys.split(",")}


def check(edit, outcome):
    """What holds of any edit."""
    assert outcome.status in (0, 2) and "Traceback" not in outcome.said, f"{edit}\n{outcome.said}"
    if outcome.status == 2:
        said = outcome.said.strip().splitlines()[-1]
        assert len(said) > 20 and outcome.header is None, f"{edit}\n{outcome.said}"
        return
    described = json.loads((outcome.folder / "c" / f"{edit.drive}.json").read_text(encoding="utf-8"))
    named = cited(outcome.header)
    assert named == described["keys"] and in_functions(outcome.header) <= named.keys(), str(edit)
    assert not named.keys() & described["open"].keys(), str(edit)
    for statement in described["open"]:
        assert f"{statement}: " in outcome.said and f" *   {statement}: " in outcome.header, str(edit)


def test_a_statement_that_an_edit_makes_false_is_open_and_the_c_is_written(tree, tmp_path):
    """With its counterexample in the log, in the header and in the drive's JSON; cited nowhere; an error if strict."""
    page = tree / "derive" / "tools" / "straight_blade.py"
    before = page.read_text(encoding="utf-8")
    assert CROWNED[0] in before
    page.write_text(before.replace(*CROWNED), encoding="utf-8")
    names = ("cylindrical_worm_zn_zn", "cylindrical_worm_zk_zn")
    try:
        outcome = edits.derived(tree, *names, "--output", tmp_path / "crowned", "--strict")
    finally:
        page.write_text(before, encoding="utf-8")
    assert outcome.status == 1 and "Traceback" not in outcome.said
    plain = edits.derived(tree, names[0], "--output", tmp_path / "plain", "--strict")
    assert plain.status == 0 and "open" not in plain.said
    old = cited((tmp_path / "plain" / "c" / f"{names[0]}.h").read_text(encoding="utf-8"))
    for name in names:
        described = json.loads((tmp_path / "crowned" / "c" / f"{name}.json").read_text(encoding="utf-8"))
        header = (tmp_path / "crowned" / "c" / f"{name}.h").read_text(encoding="utf-8")
        assert described["open"].keys() == {"helicoids/zn-straight", "helicoids/zn-width"}
        assert re.match(r"false: at .*t = 5.* its left side is", described["open"]["helicoids/zn-straight"])
        named = cited(header)
        assert not (named.keys() | in_functions(header)) & described["open"].keys()
        # the normal is still normal, but of another edge
        assert "helicoids/zn-normal" in named and named["helicoids/zn-normal"] != old["helicoids/zn-normal"]
        assert named["helicoids/helicoid"] == old["helicoids/helicoid"]
        assert f"open      {name:<28} helicoids/zn-straight: false: at " in outcome.said


@pytest.mark.validate
def test_a_statement_of_one_body_is_open_where_the_tool_makes_another_surface_of_the_other(tree, tmp_path):
    """An edge that is straight on the worm, of which the statements are proved, and crowned on the hob."""
    page = tree / "derive" / "tools" / "straight_blade.py"
    before = page.read_text(encoding="utf-8")
    of_hob = "s * t * sp.sin(alpha) - (s * t**2 / 4000 if body.name == 'hob' else 0))"
    page.write_text(before.replace(CROWNED[0], of_hob), encoding="utf-8")
    try:
        outcome = edits.derived(tree, "cylindrical_worm_zk_zn", "cylindrical_worm_zn_zn", "--output", tmp_path)
    finally:
        page.write_text(before, encoding="utf-8")
    assert outcome.status == 0
    for name in ("cylindrical_worm_zk_zn", "cylindrical_worm_zn_zn"):
        described = json.loads((tmp_path / "c" / f"{name}.json").read_text(encoding="utf-8"))
        assert described["open"].keys() == {f"helicoids/zn-{word}" for word in ("width", "straight", "normal")}
        assert "straight_blade.py makes of hob" in described["open"]["helicoids/zn-straight"]
        assert not described["open"].keys() & described["keys"].keys()


@pytest.mark.parametrize(
    "line", ["raise SystemExit(3)", "raise KeyError(0)", "return straight_blade(body, definitions)"]
)
def test_a_page_that_ends_is_refused_by_its_line(tree, tmp_path, line):
    begin = "    alpha, r, s = "
    with edits.changed(tree, "tools/straight_blade.py", lambda text: text.replace(begin, f"    {line}\n{begin}")):
        outcome = edits.derived(tree, "cylindrical_worm_zn_zn", "--output", tmp_path)
    assert outcome.status == 2 and f"straight_blade.py, line 17: `{line}`" in outcome.said


@pytest.mark.parametrize("edit", [*islice(edits.edits(0), 0, 3, 2)], ids=str)
def test_an_edited_page_compiles_or_is_refused_in_words(tree, tmp_path, edit):
    check(edit, edits.compiled(tree, edit, tmp_path / "out"))


@pytest.mark.validate
@pytest.mark.parametrize("edit", [*islice(edits.edits(1), 72)], ids=str)
def test_many_edited_pages_compile_or_are_refused_in_words(tree, tmp_path, edit):
    check(edit, edits.compiled(tree, edit, tmp_path / "out"))


@pytest.mark.parametrize("page", ["tools/axial_blade.py", "drives/face_worm.py"])
def test_a_page_that_is_no_python_is_refused_by_its_line(tree, tmp_path, page):
    lines = (tree / "derive" / page).read_bytes().splitlines()
    edit = edits.Edit(page, len(lines), len(lines[-1]), len(lines[-1]), " (")
    outcome = edits.compiled(tree, edit, tmp_path / "out")
    assert outcome.status == 2 and "Traceback" not in outcome.said
    assert re.search(rf"{page.rpartition('/')[2]}, line {len(lines)}: .*; correct the line", outcome.said), outcome.said


def test_an_interrupted_run_ends_in_a_line(tree, tmp_path):
    with edits.changed(tree, "tools/straight_blade.py", lambda text: text + "\nraise KeyboardInterrupt\n"):
        outcome = edits.derived(tree, "cylindrical_worm_zn_zn", "--output", tmp_path)
    assert outcome.status == 130 and outcome.said.startswith("interrupted;") and not [*tmp_path.iterdir()]
