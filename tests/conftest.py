"""Fixtures shared by all tests."""

import json
import os
from pathlib import Path

import pytest

# as the command line does, which tests call in a process that has NumPy already: see meshwright.cli
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

ROOT = Path(__file__).resolve().parent.parent

#: Folders whose files read the same analyses, which take long.
TOGETHER = ("report",)


def pytest_collection_modifyitems(config, items):
    """Where many processes run tests (``--dist loadgroup``), one runs those of a file, or of a folder of TOGETHER."""
    if not config.pluginmanager.hasplugin("xdist"):
        return
    for item in items:
        name, *_ = place = item.path.relative_to(ROOT / "tests").parts
        item.add_marker(pytest.mark.xdist_group(name if name in TOGETHER else "/".join(place)))


@pytest.fixture(scope="session")
def reference():
    """Published numbers by file name: ``reference("recess-action-worm")``."""

    def load(name):
        return json.loads((ROOT / "tests" / "reference" / f"{name}.json").read_text(encoding="utf-8"))

    return load
