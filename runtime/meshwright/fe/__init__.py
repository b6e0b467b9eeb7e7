"""Loaded contact and stress: Hertz, half-space and finite-element analysis of the generated flanks.

From a drive (``solids``: teeth and placement of each family, ``pair``: their contacts) to the semi-analytic loaded
contact (``gap``, ``halfspace``, ``compliance``, ``loaded``) and on to finite elements (``profile``, ``tooth``,
``body``: the mesh; ``model``, ``deck``: the input; ``solver``, ``results``, ``stress``: run and read; ``gate``: believe
or not; ``analysis``: all of it for one position).
"""

from meshwright.fe import analysis, compliance, gate, grading, loaded, model, pair, pictures, solids, solver

__all__ = ["analysis", "compliance", "gate", "grading", "loaded", "model", "pair", "pictures", "solids", "solver"]
