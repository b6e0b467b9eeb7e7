"""Fixtures shared by all tests."""

import json
import os
from pathlib import Path

import pytest

# as the command line does, which tests call in a process that has NumPy already: see meshwright.cli
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

ROOT = Path(__file__).resolve().parent.parent


@pytest.fixture(scope="session")
def reference():
    """Published numbers by file name: ``reference("recess-action-worm")``."""

    def load(name):
        return json.loads((ROOT / "tests" / "reference" / f"{name}.json").read_text(encoding="utf-8"))

    return load
