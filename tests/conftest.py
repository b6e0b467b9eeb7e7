"""Fixtures shared by all tests."""

import gc
import json
import os
from pathlib import Path

import pytest

from derive import products

# as the command line does, which tests call in a process that has NumPy already: see meshwright.cli
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
# what modules hold lives as long as the process: it is searched for garbage neither while they are imported nor later
gc.disable()

ROOT = Path(__file__).resolve().parent.parent

#: Folders whose files read the same analyses, which take long.
TOGETHER = ("report",)


def unbuilt(generated=products.GENERATED, library=ROOT / "runtime/meshwright/_generated/libmeshwright.so"):
    """What is to be done first, in words, in a checkout that is not built; else nothing."""
    lacking = products.absent(generated)
    if not lacking and library.exists():
        return ""
    return f"this checkout is not built ({generated / lacking[0] if lacking else library} is missing): make setup build"


def pytest_configure(config):
    """Say it once in place of an error a test."""
    if not hasattr(config, "workerinput") and (words := unbuilt()):
        pytest.exit(words, returncode=2)


def pytest_collection_finish():
    """Every module is imported; garbage is looked for less often than Python does by itself."""
    gc.freeze()
    gc.set_threshold(20_000)
    gc.enable()


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config, log):
    """Of many processes that run tests, one runs those of a file, or of a folder of TOGETHER: shared work is done once.

    Not by marks and ``--dist loadgroup``: pytest-xdist 3.8 writes groups where pytest 9.2 no longer reads them.
    """
    from xdist.scheduler import LoadFileScheduling

    class Scheduling(LoadFileScheduling):
        def _split_scope(self, nodeid):
            path = Path(super()._split_scope(nodeid))
            return next((folder for folder in TOGETHER if folder in path.parts), str(path))

    return Scheduling(config, log)


@pytest.fixture(scope="session")
def reference():
    """Published numbers by file name: ``reference("recess-action-worm")``."""

    def load(name):
        return json.loads((ROOT / "tests" / "reference" / f"{name}.json").read_text(encoding="utf-8"))

    return load
