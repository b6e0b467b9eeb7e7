"""Two flanks pressed on one another as elastic half-spaces, by brute force over a plain grid.

Flanks are sampled and interpolated, equal cells fill a rectangle of the tangent plane, and conjugate gradients with the
fast Fourier transform find the pressures: I. A. Polonsky and L. M. Keer, A numerical method for solving rough contact
problems based on the multi-level multi-summation and conjugate gradient techniques, Wear 231 (1999). Nothing of the
runtime's strips, gaps, cells or active sets is used.
"""

import numpy as np
from scipy.fft import irfft2, rfft2
from scipy.interpolate import CloughTocher2DInterpolator

from meshwright.contact.placement import placed

# Points along either side of a flank that are interpolated, in what remains of a polynomial of this degree.
_SAMPLES, _DEGREE = 240, 6
_STEPS, _SETTLED = 2000, 1e-7


def peak_pressure(drive, touch, force, modulus, reach, cells):
    """Largest pressure in MPa under a force in N of the pair that touches at ``touch`` in a tangency.

    reach: half sides in mm of the rectangle along and across the contact; cells: how many fill either side.
    """
    axes = np.stack([touch.major_direction, np.cross(touch.normal, touch.major_direction), touch.normal])
    stand = placed(drive, [touch.pinion_angle], [touch.wheel_angle]).matrices
    x, y = (half * (2.0 * np.arange(count) + 1.0 - count) / count for half, count in zip(reach, cells, strict=True))
    at = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1)
    pinion, wheel = (_height(drive, name, stand[name][0], touch.point, axes, at) for name in ("pinion", "wheel"))
    pressures = _pressures(wheel - pinion, x[1] - x[0], y[1] - y[0], modulus, force)
    border = np.concatenate([pressures[[0, -1]].ravel(), pressures[:, [0, -1]].ravel()])
    assert not border.any(), "pressure reaches the border of the rectangle"
    return float(pressures.max())


def _height(drive, member, motion, origin, axes, at):
    """Heights (M, N) of a flank above the tangent plane at (M, N, 2), not a number off the flank."""
    points = drive.surface(member, (_SAMPLES, _SAMPLES)).points.reshape(-1, 3)
    points = points[np.isfinite(points).all(axis=1)]
    samples = (points @ motion[:3, :3].T + motion[:3, 3] - origin) @ axes.T
    reach = 1.2 * np.abs(at).max(axis=(0, 1)) + 0.3
    samples = samples[(np.abs(samples[:, :2]) < reach).all(axis=1)]

    def powers(places):
        u, v = np.moveaxis(places / reach, -1, 0)
        return np.stack([u**i * v**j for i in range(_DEGREE + 1) for j in range(_DEGREE + 1 - i)], axis=-1)

    smooth, *_ = np.linalg.lstsq(powers(samples[:, :2]), samples[:, 2], rcond=None)
    rest = CloughTocher2DInterpolator(samples[:, :2], samples[:, 2] - powers(samples[:, :2]) @ smooth)
    return rest(at) + powers(at) @ smooth


def _love(count, side, modulus):
    """What a unit pressure on a cell lifts others by whose centres are so many cells away: A. E. H. Love (1929)."""
    x, y = np.meshgrid(*(s * np.fft.fftfreq(2 * c, 0.5 / c) for c, s in zip(count, side, strict=True)), indexing="ij")

    def corner(u, v):
        return u * np.arcsinh(v / np.abs(u)) + v * np.arcsinh(u / np.abs(v))

    a, b = 0.5 * side[0], 0.5 * side[1]
    sum_ = corner(x + a, y + b) - corner(x - a, y + b) - corner(x + a, y - b) + corner(x - a, y - b)
    return sum_ / (np.pi * modulus)


def _pressures(gap, dx, dy, modulus, force):
    on_both = np.isfinite(gap)
    gap = np.where(on_both, gap, 0.0)
    kernel = rfft2(_love(gap.shape, (dx, dy), modulus))
    whole = [2 * count for count in gap.shape]

    def lifted(p):
        return irfft2(rfft2(p, whole) * kernel, whole)[: gap.shape[0], : gap.shape[1]]

    def scaled(p):
        return p * force / (dx * dy * p.sum())

    p = scaled(np.where(on_both & (gap < np.quantile(gap[on_both], 0.3)), 1.0, 0.0))
    way, before, onward = np.zeros_like(p), 1.0, 0.0
    for _ in range(_STEPS):
        open_ = lifted(p) + gap
        touching = p > 0.0
        open_ -= open_[touching].mean()
        norm = float((open_[touching] ** 2).sum())
        way = np.where(touching, open_ + onward * norm / before * way, 0.0)
        turned = lifted(way)
        turned -= turned[touching].mean()
        length = (open_ * way)[touching].sum() / (turned * way)[touching].sum()
        last, before = p, norm
        p = np.maximum(np.where(touching, p - length * way, 0.0), 0.0)
        overlapping = on_both & (p == 0.0) & (open_ < 0.0)
        onward = 0.0 if overlapping.any() else 1.0
        p = scaled(np.where(overlapping, p - length * open_, p))
        if np.abs(p - last).sum() < _SETTLED * p.sum():
            return p
    raise AssertionError("conjugate gradients did not settle")
