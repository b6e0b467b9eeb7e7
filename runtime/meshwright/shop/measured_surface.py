"""A measured flank as a surface: nominal surface plus interpolated deviation.

r̃ = r + δ n with bicubic splines δ and n through the measured deviations and the nominal normals at their places; along
the tooth their coordinate is that of the lines, and across it the share of the way from the first to the last of them.
Derivatives are exact, by the chain rule: those of the splines with first and second ones of the nominal surface. The
normal of a surface with an implicit condition f = 0 is the sum over cyclic (a, b, c) of f_a ∂r̃/∂b × ∂r̃/∂c, without
one ∂r̃/∂a × ∂r̃/∂b. Nothing is extrapolated: a place beyond the measured grid has no numbers.
"""

from dataclasses import dataclass

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.flank.sections import lengthwise, lengthwise_bending, lengthwise_slopes
from meshwright.pattern.gap import smallest_margin
from meshwright.shop.located import located
from meshwright.shop.spline import Knots

#: Points of a file are a grid if shares of the profile differ by less than this from line to line.
REGULAR = 1e-4

#: Newton steps back onto the surface at most.
STEPS = 40

#: Points into which each cell of the grid is divided, each way, for first contact, pattern and ease-off.
FINER = 4

#: A place beyond the mate's limits by less than this, mm or natural sizes, is on them.
ON_LIMIT = 1e-9

#: Three parameters of a surface with one condition, in turn.
CYCLIC = ((0, 1, 2), (1, 2, 0), (2, 0, 1))

#: A place outside the grid by less than this share of a cell is on its border.
ON_BORDER = 1e-6


@dataclass(frozen=True)
class Field:
    """Deviations ``values`` (N, M), mm, over a flank: lines across it at ``along`` (M,) with ``ends`` (2, M) of the
    profile parameter; ``nodes`` (N, M, k) parameters of the flank, ``normals`` (N, M, 3) of it there.
    """

    flank: object
    across: Knots
    along: Knots
    ends: np.ndarray
    values: np.ndarray
    nodes: np.ndarray
    normals: np.ndarray

    @classmethod
    def of(cls, drive, member, points, tooth=None):
        """The field of the design's flank of one tooth, by default the first that is measured.

        Raises :class:`~meshwright.base.errors.UsageError` where it is not a whole grid.
        """
        word = drive.design.tables["flank"]
        own = np.array([w == word for w in points.flank])
        if not own.any():
            raise UsageError(f"flank = {word!r}: the design's flank is not measured; set the flank that is")
        tooth = int(points.tooth[own].min()) if tooth is None else tooth
        rows = np.flatnonzero(own & (points.tooth == tooth))
        if not len(rows):
            raise UsageError(f"--tooth {tooth}: its {word} flank is not measured; name one of the file's teeth")
        chosen = points.of(rows)
        shape = int(chosen.i.max()) + 1, int(chosen.j.max()) + 1
        order = np.full(shape, -1)
        order[chosen.i, chosen.j] = np.arange(len(rows))
        missing = np.argwhere((order < 0) | ~np.isfinite(chosen.deviations[order]))
        if min(shape) < 2 or len(missing):
            i, j = missing[0] if len(missing) else (1, 1)
            raise UsageError(
                f"tooth {tooth}, {word} flank, i = {i}, j = {j}: not measured, so that there is no surface between its "
                "neighbours; measure a grid without gaps: a larger --margin-percent of `meshwright grid`"
            )
        flanks = located(drive, member, chosen)
        return cls._over(flanks.drives[0].flank(member), flanks.parameters[0][order], chosen.deviations[order])

    @classmethod
    def _over(cls, flank, nodes, values):
        found = flank(nodes.reshape(-1, nodes.shape[2]))
        reached, normals = lengthwise(flank, found).reshape(values.shape), found.normals.reshape(*values.shape, 3)
        profile, along = nodes[:, :, 0], reached.mean(axis=0)
        ends = profile[[0, -1]]
        shares = (profile - ends[0]) / (ends[1] - ends[0])
        across = shares.mean(axis=1)
        uneven = np.ptp(shares, axis=1).max() + np.ptp(reached, axis=0).max() / np.ptp(along)
        if not uneven < REGULAR:
            raise UsageError("--measured: its points are not those of one `meshwright grid`; measure such a grid")
        order = np.argsort(along)
        return cls(
            flank, Knots.at(across), Knots.at(along[order]), ends[:, order], values[:, order], nodes[:, order],
            normals[:, order],
        )  # fmt: skip

    def at(self, found):
        """Displacements (P, 3) at flank points, body frame, mm, and places (P, 2): 0 to 1 each way in the grid."""
        share, y, reached = self._place(found)
        weights = self.across.weights(share[1])[0], self.along.weights(y)[0]
        place = np.stack([share[0], (reached - self.along.places[0]) / np.ptp(self.along.places)], axis=1)
        value, normal = self._interpolated(*weights)
        return value * normal, place

    def derivatives(self, found, second):
        """First (P, 3, k) and second (P, 3, k, k) derivatives of the displacement by the flank's parameters, from the
        second ones (P, 3, k, k) of the flank's points.
        """
        y_slopes = lengthwise_slopes(self.flank, found)
        y_bent = lengthwise_bending(self.flank, found, second)
        share, y, _ = self._place(found)
        along = self.along.weights(y)
        low, low_1, low_2 = (w @ self.ends[0] for w in along)
        width, width_1, width_2 = (w @ (self.ends[1] - self.ends[0]) for w in along)
        # the share s of the profile parameter q, from s·width = q − low
        by_q, by_y = 1.0 / width, -(low_1 + share[0] * width_1) / width
        by_q_y, by_y_y = -width_1 / width**2, -(low_2 + 2.0 * by_y * width_1 + share[0] * width_2) / width
        across = self.across.weights(share[1])
        (v, n), (v_s, n_s), (v_y, n_y), (v_ss, n_ss), (v_sy, n_sy), (v_yy, n_yy) = (
            self._interpolated(across[i], along[j]) for i, j in ((0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2))
        )
        d_s, d_y, d_ss = v_s * n + v * n_s, v_y * n + v * n_y, v_ss * n + 2.0 * v_s * n_s + v * n_ss
        d_sy, d_yy = v_sy * n + v_s * n_y + v_y * n_s + v * n_sy, v_yy * n + 2.0 * v_y * n_y + v * n_yy
        q_slopes = np.zeros_like(y_slopes)
        q_slopes[:, 0] = 1.0
        y_y, q_y = _outer(y_slopes, y_slopes), _outer(q_slopes, y_slopes)
        s_slopes = by_q[:, None] * q_slopes + by_y[:, None] * y_slopes
        s_bent = by_q_y[:, None, None] * (q_y + q_y.transpose(0, 2, 1)) + by_y_y[:, None, None] * y_y
        s_bent += by_y[:, None, None] * y_bent
        s_y = _outer(s_slopes, y_slopes)
        first = _each(d_s, s_slopes) + _each(d_y, y_slopes)
        bent = _each(d_ss, _outer(s_slopes, s_slopes)) + _each(d_sy, s_y + s_y.transpose(0, 2, 1))
        return first, bent + _each(d_yy, y_y) + _each(d_s, s_bent) + _each(d_y, y_bent)

    def _place(self, found):
        """The share of the profile (P,) and that within reach of the spline; the coordinate along the tooth (P,)
        within its reach, and as it is.
        """
        reached = lengthwise(self.flank, found)
        room, step = np.diff(self.along.places), np.diff(self.across.places)
        y = np.clip(reached, self.along.places[0] - room[0], self.along.places[-1] + room[-1])
        along = self.along.weights(y)[0]
        low, high = along @ self.ends[0], along @ self.ends[1]
        share = (found.parameters[:, 0] - low) / (high - low)
        return (share, np.clip(share, -step[0], 1.0 + step[-1])), y, reached

    def _interpolated(self, across, along):
        """Deviations (P, 1) and normals (P, 3) with these weights of the nodes, or derivatives of both."""
        value = np.einsum("pi,ij,pj->p", across, self.values, along)
        return value[:, None], np.einsum("pi,ijx,pj->px", across, self.normals, along)

    def inside(self, place):
        """Which places (P, 2) lie in the grid."""
        margin = ON_BORDER / (np.array(self.values.shape) - 1.0)
        return ((place > -margin) & (place < 1.0 + margin)).all(axis=1)

    def lattice(self, finer=FINER):
        """Parameters (n·m, k) of the flank on a lattice over the grid that holds its nodes, and its shape."""
        lines = [_divided(knots.places, finer) for knots in (self.across, self.along)]
        across, along = (knots.weights(line)[0] for knots, line in zip((self.across, self.along), lines, strict=True))
        q = np.einsum("ai,ijk,bj->abk", across, self.nodes, along).reshape(-1, self.nodes.shape[2])
        for _ in range(STEPS if q.shape[1] > 2 else 0):  # back onto the surface, by the shortest way
            conditions = self.flank(q).conditions
            step = np.einsum("pkc,pc->pk", np.linalg.pinv(conditions[:, :, 1:]), conditions[:, :, 0])
            q = q - step
            if not np.abs(step).max() > 1e-13:
                break
        return q, (len(lines[0]), len(lines[1]))


def _divided(places, finer):
    steps = np.arange(finer) / finer
    return np.append((places[:-1, None] + np.diff(places)[:, None] * steps).ravel(), places[-1])


@dataclass(frozen=True)
class Surface:
    """A member's flank, with a :class:`Field` of deviations or without: points, normals, conditions, body frame."""

    flank: object
    field: Field | None = None

    def __call__(self, q):
        """Points (P, 3), unit normals (P, 3), conditions (P, c) and whether a measured value is there (P,)."""
        found = self.flank(q)
        if self.field is None:
            return found.points, found.normals, found.conditions[:, :, 0], smallest_margin(found) > -ON_LIMIT
        shift, place = self.field.at(found)
        first, _ = self.field.derivatives(found, self.flank.second_derivatives(q)[0])
        raw = _normal(found.tangents.transpose(0, 2, 1) + first, found.conditions[:, :, 1:])
        sign = np.sign(np.einsum("px,px->p", raw, found.normals)) / np.linalg.norm(raw, axis=1)
        return found.points + shift, sign[:, None] * raw, found.conditions[:, :, 0], self.field.inside(place)

    def slopes(self, q):
        """Derivatives by the parameters of points (P, 3, k), unit normals (P, 3, k) and conditions (P, c, k)."""
        found, (second, conditions) = self.flank(q), self.flank.second_derivatives(q)
        tangents = found.tangents.transpose(0, 2, 1)
        if self.field is not None:
            first, bent = self.field.derivatives(found, second)
            tangents, second = tangents + first, second + bent
        left = found.conditions[:, :, 1:]
        raw = _normal(tangents, left)
        changes = (
            _normal_change(tangents, second[:, :, :, j], left, conditions[:, :, :, j]) for j in range(q.shape[1])
        )
        turned = np.stack([*changes], axis=2)
        with np.errstate(invalid="ignore"):
            raw_size = np.linalg.norm(raw, axis=1)
            normal = raw / raw_size[:, None]
            turned -= normal[:, :, None] * np.einsum("px,pxj->pj", normal, turned)[:, None]
            sign = np.sign(np.einsum("px,px->p", raw, found.normals)) / raw_size
        return tangents, sign[:, None, None] * turned, left


def _normal(tangents, slopes):
    """Σ f_a ∂r/∂b × ∂r/∂c (P, 3) over cyclic (a, b, c) for tangents (P, 3, 3) and slopes f (P, 1, 3) of a condition;
    without one ∂r/∂a × ∂r/∂b.
    """
    if not slopes.shape[1]:
        return np.cross(tangents[:, :, 0], tangents[:, :, 1])
    return sum(slopes[:, 0, a, None] * np.cross(tangents[:, :, b], tangents[:, :, c]) for a, b, c in CYCLIC)


def _normal_change(tangents, tangent_changes, slopes, slope_changes):
    """Change (P, 3) of :func:`_normal` with those of tangents and slopes."""
    if not slopes.shape[1]:
        (a, b), (da, db) = (np.moveaxis(t, 2, 0) for t in (tangents, tangent_changes))
        return np.cross(da, b) + np.cross(a, db)
    total = _normal(tangents, slope_changes)
    for a, b, c in CYCLIC:
        turned = np.cross(tangent_changes[:, :, b], tangents[:, :, c]) + np.cross(
            tangents[:, :, b], tangent_changes[:, :, c]
        )
        total = total + slopes[:, 0, a, None] * turned
    return total


def _outer(a, b):
    return a[:, :, None] * b[:, None, :]


def _each(vectors, weights):
    """Vectors (P, 3) times numbers (P, …) of each point: (P, 3, …)."""
    return np.einsum("px,p...->px...", vectors, weights)
