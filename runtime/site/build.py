"""``make site``: the static pages, below ``generated/site``.

What pages include is written anew each time: the help of every command, a page with sliders for one packaged design of
each family, the audit record.
"""

import contextlib
import io
import shutil
import sys
from pathlib import Path

from sphinx.cmd.build import main as sphinx

from meshwright import cli, commands
from meshwright.design import description, design

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]


def main(folder=ROOT / "generated" / "site"):
    """Exit status of the generator; a warning is an error."""
    # as deep as this folder, because inclusions are relative
    pages, beside = ROOT / "build" / "pages", ROOT / "build" / "beside"
    for place in (pages, beside, folder):
        shutil.rmtree(place, ignore_errors=True)
    shutil.copytree(HERE, pages, ignore=shutil.ignore_patterns("build.py", "__pycache__"))
    reference = pages / "reference"
    (reference / "commands.md").write_text(_commands(), encoding="utf-8")
    (beside / "live").mkdir(parents=True)
    (reference / "drives.md").write_text(_drives(beside / "live"), encoding="utf-8")
    shutil.copytree(ROOT / "generated" / "audit", beside / "audit")
    options = ["-q", "-W", "--keep-going", "-b", "html", "-D", f"html_extra_path={beside}"]
    return sphinx([*options, str(pages), str(folder)])


def _commands():
    """The help of every command."""
    parts = ["# Commands\n"]
    for name in commands.MODULES:
        with io.StringIO() as text, contextlib.redirect_stdout(text):
            with contextlib.suppress(SystemExit):
                cli.main([name, "--help"])
            parts.append(f"## {name}\n\n```text\n{text.getvalue()}```\n")
    return "\n".join(parts)


def _drives(live):
    """The families: keys, packaged designs, and a live page of the first of them."""
    parts = ["# Drives\n"]
    for family in description.families():
        designs = [name for name in design.packaged_names() if design.read(name)["drive"] == family]
        page = live / f"{designs[0]}.html"
        if cli.main(["live", designs[0], "--html", str(page)]):
            raise SystemExit(f"{designs[0]}: its live page could not be made")
        parts.append(f'## {family}\n\n<a href="../live/{page.name}">{designs[0]}, with sliders</a>\n')
        parts.append("Packaged designs: " + ", ".join(f"`{name}`" for name in designs) + "\n")
    return "\n".join(parts)


if __name__ == "__main__":
    sys.exit(main())
