"""Zeros of functions of one variable by sampling, bracketing and refining; poles are told apart."""

import numpy as np

#: A refined sign change is a zero only if the function there is this much smaller than beside it.
ZERO_SHARE = 1e-6


def zeros(function, samples):
    """All zeros of a vectorised ``function`` between neighbouring ``samples`` with values of opposite sign."""
    values = function(samples)
    with np.errstate(invalid="ignore", over="ignore"):
        changes = np.flatnonzero(values[:-1] * values[1:] < 0.0)
    found = [samples[k] for k in np.flatnonzero(values == 0.0)]
    for k in changes:
        root = _refine(function, samples[k], samples[k + 1], values[k])
        beside = max(abs(values[k]), abs(values[k + 1]))
        if abs(function(np.array([root]))[0]) <= ZERO_SHARE * beside:
            found.append(root)
    return sorted(found)


def _refine(function, low, high, at_low):
    """Bisection to round-off, sixteen points at a time."""
    for _ in range(16):
        inner = np.linspace(low, high, 17)
        values = function(inner)
        values[0] = at_low
        with np.errstate(invalid="ignore", over="ignore"):
            changes = np.flatnonzero(values[:-1] * values[1:] <= 0.0)
        if not len(changes):
            break  # a pole that round-off hides
        k = int(changes[0])
        low, high, at_low = inner[k], inner[k + 1], values[k]
        if at_low == 0.0 or abs(high - low) <= 4e-16 * max(abs(low), abs(high)):
            return float(low)
    return float(0.5 * (low + high))
