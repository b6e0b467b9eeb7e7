"""Numbers as plain data."""

import math

import numpy as np


def finite_or_none(value):
    """A number as a float for JSON, which has no word for one that does not exist: None."""
    return float(value) if math.isfinite(value) else None


def finite_or_nones(values):
    """The same of an array (N,): a list; of rows (N, M): lists of M, or None where a number of it does not exist."""
    there = np.isfinite(values) if values.ndim == 1 else np.isfinite(values).all(axis=1)
    plain = values.tolist()
    return plain if there.all() else [value if is_there else None for value, is_there in zip(plain, there, strict=True)]
