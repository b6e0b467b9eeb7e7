"""Loaded contact and stress: Hertz, half-space and finite-element analysis of the generated flanks."""
