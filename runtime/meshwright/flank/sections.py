"""Surfaces of revolution that cut a member across its teeth: planes, cylinders, or the cones between them.

A section holds points with one value of z·cos δ + ρ·sin δ, where ρ is the distance from the axis: planes across the
axis for δ = 0, cylinders about it for δ = 90°, otherwise the cones that stand at right angles on a pitch cone of the
angle δ. Height is measured within a section, away from the axis.
"""

import math
from dataclasses import dataclass

import numpy as np

from meshwright.design.description import table_and_key

#: Angle δ of the sections by the word for what runs along a tooth.
ANGLES = {"axial": 0.0, "radius": math.pi / 2.0}

#: Faces are planes, cylinders or cones to this, mm or rad.
EVEN = 1e-7


@dataclass(frozen=True)
class Sections:
    """Sections of the angle δ in rad, body frame, mm."""

    angle: float

    @classmethod
    def of(cls, word, design):
        """Those that a drive names for a surface of a design, or None where a parameter runs along the tooth."""
        if isinstance(word, cls) or not word:
            return word or None
        if word in ANGLES:
            return cls(ANGLES[word])
        table, key = table_and_key(word)
        return cls(design.value(key, table))

    @classmethod
    def of_faces(cls, points, edges):
        """Those in which the edges (E, 2) between points (N, 3) lie, of which none is longer than they show; None if
        there are no such ones.
        """
        radius, z = np.hypot(points[:, 0], points[:, 1])[edges], points[:, 2][edges]
        ways = np.diff(radius, axis=1)[:, 0] + 1j * np.diff(z, axis=1)[:, 0]
        if not np.abs(ways).sum() > 0.0:
            return None
        angle = -0.5 * np.angle(np.sum(ways**2 / np.maximum(np.abs(ways), 1e-300)))
        angle = next((a for a in ANGLES.values() if abs(abs(angle) - a) < EVEN), angle)
        found = cls(float(angle))
        return found if np.ptp(found.at(points[edges]), axis=1).max() < EVEN else None

    @property
    def sides(self):
        """Sine and cosine of the angle, exactly 0 and 1 at its ends."""
        if self.angle == ANGLES["radius"]:
            return 1.0, 0.0
        return math.sin(self.angle), math.cos(self.angle)

    def at(self, points):
        """The section (...,) that points (..., 3) lie in."""
        sine, cosine = self.sides
        return cosine * points[..., 2] + (sine * np.hypot(points[..., 0], points[..., 1]) if sine else 0.0)

    def factors(self, values):
        """Factors (K, 4) of x, y, z and the distance from the axis, and what (K,) they add up to in sections (K,)."""
        sine, cosine = self.sides
        return np.tile([0.0, 0.0, cosine, sine], (len(values), 1)), values

    def across(self, points):
        """Unit normals (..., 3) of the sections at points (..., 3)."""
        sine, cosine = self.sides
        azimuth = np.arctan2(points[..., 1], points[..., 0])
        return np.stack([sine * np.cos(azimuth), sine * np.sin(azimuth), np.full_like(azimuth, cosine)], axis=-1)

    def height(self, points):
        """Height (...,) of points (..., 3) within their sections."""
        sine, cosine = self.sides
        return (cosine * np.hypot(points[..., 0], points[..., 1]) if cosine else 0.0) - sine * points[..., 2]

    def slopes(self, points, tangents):
        """Slopes (N, k) of the section by the parameters at points (N, 3) with tangents (N, k, 3)."""
        sine, cosine = self.sides
        slopes = cosine * tangents[:, :, 2]
        if sine:
            radius = np.hypot(points[:, 0], points[:, 1])[:, None]
            slopes = slopes + sine * np.einsum("nkj,nj->nk", tangents[:, :, :2], points[:, :2]) / radius
        return slopes

    def second_slopes(self, points, tangents, second):
        """Second derivatives (N, k, k) of the section by the parameters, from those of the points (N, 3, k, k)."""
        sine, cosine = self.sides
        bent = cosine * second[:, 2]
        if sine:
            radius = np.hypot(points[:, 0], points[:, 1])[:, None, None]
            radial = np.einsum("nkj,nj->nk", tangents[:, :, :2], points[:, :2]) / radius[:, 0]
            inner = np.einsum("nkj,nlj->nkl", tangents[:, :, :2], tangents[:, :, :2])
            inner = inner + np.einsum("njkl,nj->nkl", second[:, :2], points[:, :2])
            bent = bent + sine * (inner - radial[:, :, None] * radial[:, None, :]) / radius
        return bent

    def points(self, section, height, azimuth):
        """Points (..., 3) of sections at heights and azimuths in rad."""
        sine, cosine = self.sides
        radius, z = sine * section + cosine * height, cosine * section - sine * height
        return np.stack(np.broadcast_arrays(radius * np.cos(azimuth), radius * np.sin(azimuth), z), axis=-1)


def lengthwise(flank, found):
    """The coordinate along the tooth (N,) at flank points."""
    return flank.sections.at(found.points) if flank.sections else found.parameters[:, -1]


def lengthwise_slopes(flank, found):
    """Its slopes (N, k) by the parameters."""
    if flank.sections:
        return flank.sections.slopes(found.points, found.tangents)
    slopes = np.zeros(found.parameters.shape)
    slopes[:, -1] = 1.0
    return slopes


def lengthwise_bending(flank, found, second):
    """Second derivatives (N, k, k) of the coordinate along the tooth, from those of the points (N, 3, k, k)."""
    if flank.sections:
        return flank.sections.second_slopes(found.points, found.tangents, second)
    return np.zeros((len(second), *second.shape[2:]))


def solved(matrix, residual):
    """Solutions (N, c), or (N, c, m) of m at once, of N systems of linear equations; NaN for singular ones."""
    if matrix.shape[1] == 1:  # the one condition of a surface is solved so often that the library's detour counts
        return _quotients(residual, matrix.reshape(-1, *[1] * (residual.ndim - 1)))
    each = residual if residual.ndim == 3 else residual[:, :, None]
    step = np.full(each.shape, np.nan)
    good = np.isfinite(matrix).all(axis=(1, 2)) & np.isfinite(each).all(axis=(1, 2))
    try:
        step[good] = np.linalg.solve(matrix[good], each[good])
    except np.linalg.LinAlgError:  # one singular matrix refuses them all
        good[good] = np.abs(np.linalg.det(matrix[good])) > 0.0
        step[good] = np.linalg.solve(matrix[good], each[good])
    return step.reshape(residual.shape)


def _quotients(residual, slope):
    """Residuals by slopes that broadcast; NaN where a slope is zero or either is not finite."""
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        step = residual / slope
    return np.where(np.isfinite(step) & np.isfinite(slope), step, np.nan)
