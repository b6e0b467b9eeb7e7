"""What a Markdown page tells its reader to type, run as the reader would, in order, in one folder.

A block ``console`` holds commands after ``$`` and what they print: a line ``…`` stands for any lines, ``…`` in a line
for any text, and runs of blanks are one. ``# exit N`` after a command names its exit status if that is not 0. Blocks
``python`` share one namespace. A block ``c`` or ``toml`` whose first line is a comment that names a file is that file.
"""

import contextlib
import io
import os
import re
import shlex
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

_FENCE = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_NAMED = re.compile(r"^(?:/\*|#|//)\s*([\w.-]+\.(?:c|cpp|toml|py))\b")


@dataclass(frozen=True)
class Command:
    """One command line: its words, the exit status it must have and what it must print."""

    line: str
    status: int
    printed: str


def blocks(page):
    """(language, text) of the fenced blocks of a page, in order."""
    return [match.groups() for match in _FENCE.finditer(page)]


def commands(text):
    """The commands of a block ``console``."""
    found = []
    for part in re.split(r"^\$ ", text, flags=re.MULTILINE)[1:]:
        line, _, printed = part.partition("\n")
        line, _, status = line.partition("  # exit ")
        found.append(Command(line.strip(), int(status or 0), printed))
    return found


def agrees(expected, printed):
    """Whether the text printed is the expected one, where ``…`` stands for anything."""
    lines = [" ".join(line.split()) for line in expected.strip().splitlines()]
    pattern = ""
    for line in lines:
        inner = ".*".join(map(re.escape, line.split("…")))
        pattern += r"(?:.*\n)*" if line == "…" else inner + r"\n"
    shown = "".join(" ".join(line.split()) + "\n" for line in printed.strip().splitlines())
    return re.fullmatch(pattern, shown) is not None


def run(page, folder):
    """Run a page's blocks in ``folder``; an :class:`AssertionError` names the first that does not do as it says."""
    names = {"__name__": "page"}
    with contextlib.chdir(folder):
        for language, text in blocks(page):
            if language == "console":
                for command in commands(text):
                    status, printed = _run(command.line)
                    assert status == command.status, f"$ {command.line}\nexit status {status}\n{printed}"
                    assert agrees(command.printed, printed), f"$ {command.line}\n{printed}\nnot:\n{command.printed}"
            elif language == "python":
                exec(compile(text, "page", "exec"), names)
            elif named := _NAMED.match(text):
                Path(named[1]).write_text(text, encoding="utf-8")


def _run(line):
    """Exit status and output of a command line; meshwright's own run in this process."""
    words = shlex.split(line)
    if Path(words[0]).name == "meshwright" and not set("|&;") & set(words):
        from meshwright.cli import main

        with io.StringIO() as out, contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
            try:
                status = main(words[1:])
            except SystemExit as end:
                status = end.code
            return status, out.getvalue()
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    done = subprocess.run(line, shell=True, capture_output=True, text=True, env={**os.environ, "PATH": path})
    return done.returncode, done.stdout + done.stderr
