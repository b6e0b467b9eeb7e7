"""Flanks as surfaces: points, grids, files for other programs."""
