"""Folders of drives made from files outside the tree, and commands run on them."""

import json
import os
import subprocess
import sys
from pathlib import Path

from meshwright.cli import main

ROOT = Path(__file__).resolve().parents[2]
FILES = Path(__file__).parent / "drives"


def derived(name, folder):
    """``python -m derive NAME.py --into folder``; returns the folder."""
    done = answered(FILES / f"{name}.py", folder)
    assert done.returncode == 0, done.stderr
    return folder


def answered(page, folder):
    """How ``python -m derive PAGE --into folder`` ended."""
    command = [sys.executable, "-m", "derive", page, "--into", folder]
    return subprocess.run(command, cwd=ROOT, env=os.environ, capture_output=True, text=True)


class Commands:
    """Commands on a design file of a folder of drives; outputs are written beside the design."""

    def __init__(self, folder, design):
        self.folder, self.design = folder, design

    def __call__(self, command, *options, status=0):
        words = ["--drives", str(self.folder), command, str(self.design), *map(str, options)]
        assert main(words) == status, words

    def json(self, command, *options, status=0):
        """The JSON that a command writes."""
        path = self.design.with_suffix(".json")
        self(command, *options, "--json", path, status=status)
        return json.loads(path.read_text(encoding="utf-8"))
