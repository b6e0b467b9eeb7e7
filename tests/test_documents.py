"""What the pages tell a reader to type does what they say."""

import re

import pytest

from tests import snippets

PAGES = [snippets.ROOT / "README.md", *sorted((snippets.ROOT / "runtime" / "site").rglob("*.md"))]


#: Pages whose commands take long.
LONG = ("first-drive", "report")


def _typed():
    for path in PAGES:
        if "```console" in path.read_text(encoding="utf-8"):
            yield pytest.param(path, id=path.stem, marks=[pytest.mark.validate] if path.stem in LONG else [])


@pytest.mark.parametrize("path", [*_typed()])
def test_a_page_does_what_it_says(path, tmp_path):
    (tmp_path / "generated").symlink_to(snippets.ROOT / "generated")
    snippets.run(path.read_text(encoding="utf-8"), tmp_path)


@pytest.mark.parametrize("path", PAGES, ids=lambda p: p.stem)
def test_every_link_and_inclusion_leads_somewhere(path):
    text = path.read_text(encoding="utf-8")
    linked = re.findall(r"\]\(([^)#:]+\.(?:md|png))\)", text)
    linked += re.findall(r"^```\{literalinclude\} (\S+)", text, re.MULTILINE)
    assert [name for name in linked if not (path.parent / name).exists()] == []


@pytest.mark.parametrize("path", PAGES, ids=lambda p: p.stem)
def test_every_file_of_the_tree_that_a_page_names_is_there(path):
    """In a table's row the names after the first may be of the same folder."""
    for line in path.read_text(encoding="utf-8").splitlines():
        folder = snippets.ROOT
        for name in re.findall(r"`((?:derive|runtime|tests)/[\w./-]+|\w+\.py)`", line):
            if "/" in name:
                folder = (snippets.ROOT / name).parent
            elif folder == snippets.ROOT:
                continue
            assert (snippets.ROOT / name).exists() or (folder / name).exists(), name


def test_what_is_printed_must_agree():
    assert snippets.agrees("a … c\n…\nend", "a b c\nx\ny\nend\n")
    assert not snippets.agrees("a b\n", "a b c\n")
    assert not snippets.agrees("…\nend", "end\nmore\n")
