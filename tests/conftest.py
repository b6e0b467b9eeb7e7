"""Fixtures shared by all tests."""

import json
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent


@pytest.fixture(scope="session")
def reference():
    """Published numbers by file name: ``reference("recess-action-worm")``."""

    def load(name):
        return json.loads((ROOT / "tests" / "reference" / f"{name}.json").read_text(encoding="utf-8"))

    return load
