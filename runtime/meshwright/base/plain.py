"""Numbers as plain data."""

import math


def finite_or_none(value):
    """A number as a float for JSON, which has no word for one that does not exist: None."""
    return float(value) if math.isfinite(value) else None
