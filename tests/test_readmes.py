"""The pages on the rooms of the house are true: what lives where, what imports what, and their snippets run."""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
PAGES = ("derive/README.md", "runtime/README.md", "tests/README.md")


def rows(page, heading):
    """First cell → whole row of the table whose heading begins so."""
    table = (ROOT / page).read_text(encoding="utf-8").split(f"| {heading} |", 1)[1].split("\n\n", 1)[0]
    return [line for line in table.splitlines()[2:] if line.startswith("|")]


def named(cell):
    return [word.strip("/") for word in re.findall(r"`([^`]+)`", cell)]


def imports(package, path):
    """Rooms of a package that a file imports when it is imported."""
    for node in ast.parse(path.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == package:
            inner = node.module.split(".")[1:]
            yield from inner[:1] or (alias.name for alias in node.names)
        elif isinstance(node, ast.Import):
            yield from (a.name.split(".")[1] for a in node.names if a.name.startswith(f"{package}."))


def files_of(folder, room):
    return [*(folder / room).rglob("*.py")] if (folder / room).is_dir() else [folder / f"{room}.py"]


def test_rooms_of_the_runtime_import_only_those_above_them():
    folder = ROOT / "runtime" / "meshwright"
    above = set()
    for row in rows("runtime/README.md", "room"):
        group = named(row.split("|")[1])
        for room in group:
            for path in files_of(folder, room):
                assert set(imports("meshwright", path)) <= above | {room} | {*group}, path
        above |= {*group}
    rooms = {path.name.removesuffix(".py") for path in folder.iterdir() if not path.name.startswith("_")}
    assert above == rooms - {"designs"}


@pytest.mark.parametrize("room", ["language", "tools", "drives", "program", "passes", "emit"])
def test_rooms_of_the_compiler_import_what_their_row_allows(room):
    (row,) = [row for row in rows("derive/README.md", "room") if room in named(row.split("|")[1])]
    allowed = {room, *named(row.split("|")[3])}
    for path in files_of(ROOT / "derive", room):
        assert set(imports("derive", path)) <= allowed, path


def test_every_folder_that_a_page_names_is_there():
    for page in PAGES:
        for line in (ROOT / page).read_text(encoding="utf-8").splitlines():
            for name in re.findall(r"`([a-z_]+/)`", line.split("|")[1] if line.startswith("|") else line):
                places = (ROOT, ROOT / Path(page).parent, ROOT / "runtime" / "c", ROOT / "tests", ROOT / "generated")
                assert any((place / name).is_dir() for place in places), (page, name)


@pytest.mark.parametrize("page", PAGES)
def test_snippets_run(page, capsys):
    for snippet in re.findall(r"```python\n(.*?)```", (ROOT / page).read_text(encoding="utf-8"), re.DOTALL):
        exec(compile(snippet, page, "exec"), {})
