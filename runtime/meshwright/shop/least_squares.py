"""Which errors explain measured deviations: weighted least squares that says what it cannot tell apart.

Model δ = J q + noise. J is known exactly; what it does not determine is judged in units that matter: each parameter has
a tolerance, and a combination of parameters whose standard deviation exceeds it is named and not estimated.
Sources: C. L. Lawson and R. J. Hanson, Solving Least Squares Problems (1974), chapter 5 (singular values);
P. J. Huber, Robust Statistics (1981), chapter 7 (weights).
"""

import math
from dataclasses import dataclass

import numpy as np

#: Residuals beyond so many standard deviations lose weight: 95 % efficiency for normal noise (Huber 1981).
HUBER = 1.345

#: Share of weight × residual² in residual² for normal noise.
KEPT = math.erf(HUBER / math.sqrt(2.0))

#: Points of less weight are listed as distrusted.
DISTRUSTED = 0.5

#: A parameter with a larger share (square of a direction cosine) in undetermined combinations is not estimated.
SHARE = 0.01

_ROUNDS = 100


@dataclass(frozen=True)
class Undetermined:
    """A combination of parameters, by its direction in units of their tolerances, and its standard deviation there."""

    direction: np.ndarray
    standard_deviation: float

    def members(self):
        """Indices of the parameters that take part, largest share first."""
        shares = self.direction**2
        return [int(k) for k in np.argsort(-shares) if shares[k] > SHARE]


@dataclass(frozen=True)
class Estimate:
    """Result of :func:`estimate` for k parameters and n deviations.

    ``values`` (k,) and ``deviations`` (k,) are NaN for what is not determined; ``covariance`` (k, k) is that of the
    determined combinations. ``fitted`` (k,) explain the deviations best, 0 along undetermined combinations.
    ``weights`` (n,) in (0, 1], ``residuals`` (n,) in the unit of the deviations.
    """

    values: np.ndarray
    deviations: np.ndarray
    covariance: np.ndarray
    fitted: np.ndarray
    undetermined: tuple[Undetermined, ...]
    weights: np.ndarray
    residuals: np.ndarray
    chi_square_per_degree: float
    sigma: float

    def distrusted(self):
        """Indices of points of little weight."""
        return np.flatnonzero(self.weights < DISTRUSTED)


def estimate(columns, deviations, tolerances, sigma=None):
    """Fit ``deviations`` (n,) by ``columns`` (n, k), robustly.

    ``tolerances`` (k,) are sizes of the parameters that matter; ``sigma`` is the standard deviation of one measurement,
    None where it is unknown: it is then the robust scatter of the residuals, and the goodness of fit says nothing.
    Raises ValueError if there are not more measurements than parameters.
    """
    columns, deviations = np.asarray(columns, float), np.asarray(deviations, float)
    n, k = columns.shape
    if n <= k:
        raise ValueError(f"{n} measurements cannot determine {k} parameters")
    scaled = columns * tolerances
    weights, known = np.ones(n), sigma
    for _ in range(_ROUNDS):
        fit = _Fit.of(scaled, deviations, weights, sigma)
        sigma = known or fit.sigma
        if not sigma > 0.0:
            break
        size = np.abs(fit.residuals) / sigma
        new = np.minimum(1.0, HUBER / np.maximum(size, HUBER))
        if np.abs(new - weights).max() < 1e-10:
            break
        weights = new
    return fit.in_units_of(np.asarray(tolerances, float), known is not None)


@dataclass(frozen=True)
class _Fit:
    """One weighted fit in units of the tolerances."""

    values: np.ndarray
    directions: np.ndarray
    spreads: np.ndarray
    determined: np.ndarray
    residuals: np.ndarray
    weights: np.ndarray
    sigma: float

    @classmethod
    def of(cls, scaled, deviations, weights, sigma):
        root = np.sqrt(weights)
        left, sizes, directions = np.linalg.svd(root[:, None] * scaled, full_matrices=False)
        numerically = sizes > 1e-12 * sizes[0] if sizes[0] > 0.0 else np.zeros(len(sizes), bool)
        along = np.where(numerically, (left.T @ (root * deviations)) / np.where(numerically, sizes, 1.0), 0.0)
        if sigma is None:
            rest = deviations - scaled @ (directions.T @ along)
            sigma = _scatter(rest, numerically.sum())
        with np.errstate(divide="ignore"):
            spreads = np.where(numerically, sigma / np.where(numerically, sizes, 1.0), np.inf)
        determined = spreads < 1.0
        values = directions.T @ np.where(determined, along, 0.0)
        return cls(values, directions, spreads, determined, deviations - scaled @ values, weights, sigma)

    def in_units_of(self, tolerances, tested):
        kept, lost = self.directions[self.determined], self.directions[~self.determined]
        share = (lost**2).sum(axis=0)
        # what little of a determined parameter lies in a lost direction may be as large as its tolerance
        variance = ((kept.T * self.spreads[self.determined] ** 2) * kept.T).sum(axis=1) + share
        covariance = (kept.T * self.spreads[self.determined] ** 2) @ kept * np.outer(tolerances, tolerances)
        known = share <= SHARE
        degrees = len(self.residuals) - int(self.determined.sum())
        squares = float((self.weights * self.residuals**2).sum()) / self.sigma**2 if self.sigma > 0.0 else 0.0
        return Estimate(
            np.where(known, self.values * tolerances, np.nan),
            np.where(known, np.sqrt(variance) * tolerances, np.nan),
            covariance,
            self.values * tolerances,
            tuple(Undetermined(d, float(s)) for d, s in zip(lost, self.spreads[~self.determined], strict=True)),
            self.weights,
            self.residuals,
            squares / (KEPT * degrees) if tested else float("nan"),
            self.sigma,
        )


def _scatter(residuals, parameters):
    """Robust standard deviation of residuals: 1.4826 times the median magnitude, for the degrees of freedom."""
    n = len(residuals)
    return float(1.4826 * np.median(np.abs(residuals)) * np.sqrt(n / (n - parameters)))
