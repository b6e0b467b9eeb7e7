"""Symbolic side of meshwright: from kinematic chains to generated code."""

import os

# SymPy looks for faster integers and loads what it finds, which takes longer than these derivations save by it.
os.environ.setdefault("SYMPY_GROUND_TYPES", "python")
