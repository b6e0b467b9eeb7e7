"""Loaded contact and stress: Hertz, half-space and finite-element analysis of the generated flanks.

From a drive (``solids``: teeth and placement of each family, ``pair``: their contacts) to the semi-analytic loaded
contact (``gap``, ``strip``, ``halfspace``, ``compliance``, ``loaded``) and on to finite elements (``profile``,
``tooth``, ``body``: the mesh; ``model``, ``deck``: the input; ``solver``, ``results``, ``stress``: run and read;
``gate``: believe or not; ``analysis``: all of it for one position).
"""

from importlib import import_module
from types import ModuleType

#: The parts, imported when they are first used: loaded contact does not wait for what draws and what runs a solver.
__all__ = ["analysis", "compliance", "gate", "grading", "loaded", "model", "pair", "pictures", "solids", "solver"]


def __getattr__(name: str) -> ModuleType:
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return import_module(f"{__name__}.{name}")
