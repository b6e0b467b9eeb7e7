"""Symbolic side of meshwright: from kinematic chains to generated code."""
