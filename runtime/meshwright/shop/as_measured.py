"""The as-measured flank in contact: nominal surface plus interpolated deviation.

r̃ = r + δ n with bicubic splines δ and n through the measured deviations and the nominal normals at their places; along
the tooth their coordinate is that of the lines, and across it the share of the way from the first to the last of them.
Derivatives are exact, by the chain rule: those of the splines with first and second ones of the nominal surface. The
normal of a surface with an implicit condition f = 0 is the sum over cyclic (a, b, c) of f_a ∂r̃/∂b × ∂r̃/∂c, without
one ∂r̃/∂a × ∂r̃/∂b. Nothing is extrapolated: a contact beyond the measured grid has no numbers.
"""

import math
from dataclasses import dataclass

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.contact.placement import placed
from meshwright.drive import Drive
from meshwright.flank.sections import lengthwise, lengthwise_bending, lengthwise_slopes
from meshwright.pattern.gap import smallest_margin
from meshwright.shop.located import located
from meshwright.shop.spline import Knots
from meshwright.shop.tables import Points

#: Points of a file are a grid if shares of the profile differ by less than this from line to line.
REGULAR = 1e-4

#: Newton steps, the size at which they are done (mm and rad), and what is left of a solved contact.
STEPS, DONE, SOLVED = 40, 1e-12, 1e-9

#: Points into which each cell of the grid is divided, each way, for first contact, pattern and ease-off; angles of the
#: window at which pattern and ease-off are looked at.
FINER, ANGLES = 4, 33

#: Three parameters of a surface with one condition, in turn.
CYCLIC = ((0, 1, 2), (1, 2, 0), (2, 0, 1))

#: A place outside the grid by less than this share of a cell is on its border.
ON_BORDER = 1e-6

#: A tangency is the first contact if no other place of the grid overlaps by more than this, mm.
OVERLAP = 1e-6


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
        chosen = Points(
            points.tooth[rows], tuple(points.flank[k] for k in rows), points.i[rows], points.j[rows],
            points.points[rows], points.normals[rows], points.deviations[rows],
        )  # fmt: skip
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
            return found.points, found.normals, found.conditions[:, :, 0], smallest_margin(found) > -SOLVED
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


def _solve(matrix, right):
    good = np.isfinite(matrix).all(axis=(1, 2)) & np.isfinite(right).all(axis=(1, 2))
    good[good] = np.abs(np.linalg.det(matrix[good])) > 0.0
    found = np.full((len(matrix), matrix.shape[2], right.shape[2]), np.nan)
    found[good] = np.linalg.solve(matrix[good], right[good])
    return found


@dataclass(frozen=True)
class MeasuredContact:
    """Contact of as-measured flanks at N pinion ``angles``; NaN where there is none on the measured grid.

    ``errors``: transmission error of the tangency, ``nominal`` that of the design, rad; ``points`` and ``normals``
    (N, 3) fixed frame, normals out of the pinion. ``status``: converged, off_grid or diverged. ``first``: transmission
    error at which the flanks touch first, ``kinds`` tangency or edge: of the grid or of the mate. ``solutions`` (N, k):
    parameters of both flanks and transmission error of the right-hand drive.
    """

    angles: np.ndarray
    status: tuple[str, ...]
    errors: np.ndarray
    nominal: np.ndarray
    points: np.ndarray
    normals: np.ndarray
    first: np.ndarray
    kinds: tuple[str | None, ...]
    solutions: np.ndarray


@dataclass(frozen=True)
class EaseOff:
    """Over the nodes of the grid (N, M), mm: ``ease_off``, the normal distance from the conjugate of the mate, least 0;
    NaN where the mate never comes; ``pattern``: the share of the grid that comes nearer to the mate than the
    ``separation`` in any position of the pair.
    """

    ease_off: np.ndarray
    pattern: float
    separation: float


@dataclass(frozen=True)
class AsMeasured:
    """A drive whose ``member`` has a measured :class:`Field`; all inside is of the right-hand drive."""

    drive: Drive
    member: str
    field: Field

    @classmethod
    def of(cls, drive, member, points, tooth=None):
        """From :class:`~meshwright.shop.tables.Points` with deviations."""
        return cls(drive, member, Field.of(drive, member, points, tooth))

    @property
    def _bodies(self):
        return self.drive.design.description["bodies"]

    def _surfaces(self):
        return [Surface(self.drive.flank(b["name"]), self.field if b["name"] == self.member else None)
                for b in self._bodies]  # fmt: skip

    def tca(self, angles):
        """:class:`MeasuredContact` at pinion angles (N,), rad."""
        angles = np.atleast_1d(np.asarray(angles, dtype=float))
        nominal, mirror = self.drive.tca(angles), self.drive.design.mirror
        turned = mirror.sign * angles
        parts = [nominal.solutions[:, b["unknowns"]] for b in self._bodies]
        errors = nominal.solutions[:, self.drive.design.description["error"]]
        start = np.concatenate([*parts, errors[:, None]], axis=1)
        first, nearest, sense = self._first(turned, parts, errors)
        found = self._solved(turned, start)
        from_lattice = self._solved(turned, nearest)
        better = ~found.good | (sense * from_lattice.errors > sense * found.errors + DONE)
        found = found.where(from_lattice.good & better, from_lattice)
        touching = found.good & found.inside
        lever = np.abs(nominal.lever_arms["wheel"])
        tangency = touching & ~(sense * (first - found.errors) * lever > OVERLAP)
        first = np.where(tangency, found.errors, first)
        kept = np.where(touching, 1.0, np.nan)
        status = [("converged" if t else "off_grid") if g else "diverged" for g, t in
                  zip(found.good, touching, strict=True)]  # fmt: skip
        kinds = tuple(None if math.isnan(f) else "tangency" if t else "edge" for f, t in
                      zip(first, tangency, strict=True))  # fmt: skip
        flip = mirror.flip
        return MeasuredContact(
            angles, tuple(status), mirror.sign * kept * found.errors, nominal.error,
            kept[:, None] * found.points * flip, kept[:, None] * found.normals * flip, mirror.sign * first, kinds,
            kept[:, None] * found.solutions,
        )  # fmt: skip

    def curvatures(self, angle, solution):
        """Relative curvatures (2,), smaller first, 1/mm, and the direction (3,) of the smaller, fixed frame, at a
        contact of the right-hand drive (pinion angle, rad, and its solution (k,)).
        """
        stand = placed(self.drive, [angle], [self.drive.ratio * angle + solution[-1]])
        at, form, basis = 0, np.zeros((2, 2)), None
        for body, surface in zip(self._bodies, self._surfaces(), strict=True):
            count = len(surface.flank.parameters)
            q = solution[at : at + count]
            rotation = stand.matrices[body["name"]][0, :3, :3]
            slopes = [s[0] for s in surface.slopes(q[None])]
            points, normals = rotation @ slopes[0], rotation @ slopes[1]
            if basis is None:
                first = points[:, 0] / np.linalg.norm(points[:, 0])
                basis = np.stack([first, np.cross(rotation @ surface(q[None])[1][0], first)])
            matrix = np.concatenate([basis @ points, slopes[2]])
            along = np.linalg.solve(matrix, np.eye(len(matrix))[:, :2])
            form += basis @ normals @ along  # −II of either flank along its own outward normal
            at += count
        values, directions = np.linalg.eigh(0.5 * (form + form.T))
        return values, directions[:, 0] @ basis

    def ease_off(self, low, high, separation):
        """:class:`EaseOff` over the positions of a pair between two pinion angles, rad, at a ``separation`` in mm."""
        angles = np.linspace(low, high, ANGLES)
        nominal = self.drive.tca(angles)
        turned = self.drive.design.mirror.sign * angles
        parts = [nominal.solutions[:, b["unknowns"]] for b in self._bodies]
        errors = nominal.solutions[:, self.drive.design.description["error"]]
        behind, near = [], []
        q, shape = self.field.lattice()
        for k in np.flatnonzero(np.isfinite(errors)):
            found, lever, _ = self._turned(turned[k], [p[k] for p in parts], errors[k], q)
            sense = np.sign(nominal.lever_arms["wheel"][k])
            if np.isfinite(found).any():
                behind.append(-sense * found * np.abs(lever))
                near.append((np.nanmax(sense * found) - sense * found) * np.abs(lever))
        if not behind:
            raise UsageError("--measured: the mate comes nowhere to the measured grid; check member, flank and tooth")
        with np.errstate(invalid="ignore"):
            least = np.fmin.reduce(behind).reshape(shape)
            close = np.fmin.reduce(near).reshape(shape)
        nodes = (slice(None, None, FINER),) * 2
        return EaseOff(least[nodes] - np.nanmin(least), float(np.mean(close < separation)), float(separation))

    def _first(self, angles, parts, errors):
        """First contact over the lattice: transmission errors (N,), starts (N, k) there, and the sense of the wheel."""
        q, _ = self.field.lattice()
        first, starts = np.full(len(angles), np.nan), np.full((len(angles), sum(p.shape[1] for p in parts) + 1), np.nan)
        senses = np.full(len(angles), np.nan)
        for k in np.flatnonzero(np.isfinite(errors)):
            found, lever, other = self._turned(angles[k], [p[k] for p in parts], errors[k], q)
            if not np.isfinite(found).any():
                continue
            senses[k] = np.sign(lever[np.flatnonzero(np.isfinite(found))[0]])
            best = int(np.nanargmax(senses[k] * found))
            first[k] = found[best]
            pair = [q[best] if b["name"] == self.member else other[best] for b in self._bodies]
            starts[k] = np.concatenate([*pair, found[best : best + 1]])
        return first, starts, senses

    def _turned(self, angle, parts, error, q):
        """Transmission errors (P,) at which the mate reaches measured points of parameters q (P, k) at a pinion angle,
        the levers of the wheel there (mm), and the mate's parameters. NaN where it does not reach them.
        """
        surfaces, names = self._surfaces(), [b["name"] for b in self._bodies]
        own = names.index(self.member)
        fixed = surfaces[own](q)[0]
        flank = surfaces[1 - own].flank
        other, errors = np.tile(parts[1 - own], (len(q), 1)), np.full(len(q), error)
        open_, size = np.ones(len(q), dtype=bool), np.full(len(q), np.inf)
        for _ in range(STEPS):
            found, matrices, points, arm = self._meeting(angle, errors, own, fixed, flank, other)
            residual = np.concatenate([points[own] - points[1 - own], found.conditions[:, :, 0]], axis=1)
            rotation = matrices[names[1 - own]][:, :3, :3]
            n, k = other.shape
            slopes = np.zeros((n, residual.shape[1], k + 1))
            slopes[:, :3, :k] = -np.einsum("nij,nkj->nik", rotation, found.tangents)
            slopes[:, :3, k] = arm if names[own] == "wheel" else -arm
            slopes[:, 3:, :k] = found.conditions[:, :, 1:]
            step = _solve(slopes, residual[:, :, None])[:, :, 0]
            size = np.abs(np.einsum("nki,nk->ni", found.tangents, step[:, :k])).max(axis=1)
            step *= np.minimum(1.0, 2.0 / np.maximum(size, 1e-300))[:, None]
            other, errors = other - step[:, :k], errors - step[:, k]
            open_ = ~(size < 1e-10)
            if not (open_ & np.isfinite(size)).any():
                break
        found, matrices, points, arm = self._meeting(angle, errors, own, fixed, flank, other)
        with np.errstate(invalid="ignore"):
            lost = open_ | ~(smallest_margin(found) > -SOLVED)
        normals = np.einsum("nij,nj->ni", matrices[names[1 - own]][:, :3, :3], found.normals)
        lever = np.einsum("ni,ni->n", normals, arm) * (1.0 if names[1 - own] == "pinion" else -1.0)
        return np.where(lost, np.nan, errors), np.where(lost, np.nan, lever), other

    def _meeting(self, angle, errors, own, fixed, flank, other):
        """The mate's flank points, placements, the points of both (fixed frame), and how the wheel moves there."""
        names = [b["name"] for b in self._bodies]
        stand = placed(self.drive, np.full(len(errors), angle), self.drive.ratio * angle + errors)
        found = flank(other)
        points = [None, None]
        for which, body in ((own, fixed), (1 - own, found.points)):
            matrix = stand.matrices[names[which]]
            points[which] = np.einsum("nij,nj->ni", matrix[:, :3, :3], body) + matrix[:, :3, 3]
        direction, origin = stand.axes["wheel"]
        return found, stand.matrices, points, np.cross(direction, points[names.index("wheel")] - origin)

    def _solved(self, angles, start):
        """Tangencies from start values (N, k1 + k2 + 1) by Newton's method."""
        x = start.copy()
        for _ in range(STEPS):
            residual, matrix = self._residual(angles, x)[0], self._jacobian(angles, x)
            step = _solve(matrix, residual[:, :, None])[:, :, 0]
            x = x - step * np.minimum(1.0, 0.5 / np.maximum(np.abs(step).max(axis=1), 1e-300))[:, None]
            if not (np.abs(step) > DONE * np.maximum(1.0, np.abs(x))).any():
                break
        residual, points, normals, inside = self._residual(angles, x)
        with np.errstate(invalid="ignore"):
            good = (np.abs(residual) < SOLVED).all(axis=1)
        return _Tangencies(good, inside, x[:, -1], points, normals, x)

    def _residual(self, angles, x):
        """Residual (N, k1 + k2 + 1): places apart, normals' tangential parts, conditions; and where that is."""
        stand = placed(self.drive, angles, self.drive.ratio * angles + x[:, -1])
        at, points, normals, conditions, inside = 0, [], [], [], np.ones(len(x), dtype=bool)
        for body, surface in zip(self._bodies, self._surfaces(), strict=True):
            count = len(surface.flank.parameters)
            place, normal, left, here = surface(x[:, at : at + count])
            matrix = stand.matrices[body["name"]]
            points.append(np.einsum("nij,nj->ni", matrix[:, :3, :3], place) + matrix[:, :3, 3])
            normals.append(np.einsum("nij,nj->ni", matrix[:, :3, :3], normal))
            conditions.append(left)
            inside &= here
            at += count
        across = _tangents(normals[0])[0]
        apart = [np.einsum("ni,ni->n", normals[1], t)[:, None] for t in across]
        return np.concatenate([points[0] - points[1], *apart, *conditions], axis=1), points[0], normals[0], inside

    def _jacobian(self, angles, x):
        """Derivatives (N, k1 + k2 + 1, k1 + k2 + 1) of the residual by the parameters and the transmission error."""
        stand = placed(self.drive, angles, self.drive.ratio * angles + x[:, -1])
        direction, origin = stand.axes["wheel"]
        n, size = x.shape
        moved, turned, normals = np.zeros((2, n, 3, size)), np.zeros((2, n, 3, size)), []
        matrix, at, row = np.zeros((n, size, size)), 0, 5
        for k, (body, surface) in enumerate(zip(self._bodies, self._surfaces(), strict=True)):
            columns = slice(at, at + len(surface.flank.parameters))
            q, motion = x[:, columns], stand.matrices[body["name"]]
            rotation = motion[:, :3, :3]
            point, normal = (np.einsum("nij,nj->ni", rotation, v) for v in surface(q)[:2])
            tangents, turnings, left = surface.slopes(q)
            moved[k][:, :, columns], turned[k][:, :, columns] = rotation @ tangents, rotation @ turnings
            if body["name"] == "wheel":
                moved[k][:, :, -1] = np.cross(direction, point + motion[:, :3, 3] - origin)
                turned[k][:, :, -1] = np.cross(direction, normal)
            matrix[:, row : row + left.shape[1], columns] = left
            normals.append(normal)
            at, row = columns.stop, row + left.shape[1]
        matrix[:, :3] = moved[0] - moved[1]
        (first, other), (first_1, other_1) = _tangents(normals[0], turned[0])
        for k, (t, t_1) in enumerate(((first, first_1), (other, other_1))):
            matrix[:, 3 + k] = np.einsum("ni,nij->nj", t, turned[1]) + np.einsum("ni,nij->nj", normals[1], t_1)
        return matrix


def _tangents(normals, changes=None):
    """Two unit vectors (N, 3) at right angles to unit normals (N, 3) and to each other, and their changes (N, 3, k)
    with those of the normals.
    """
    axis = np.eye(3)[np.argmin(np.abs(np.nan_to_num(normals)), axis=1)]
    first = np.cross(normals, axis)
    length = np.linalg.norm(first, axis=1)[:, None]
    first = first / length
    other = np.cross(normals, first)
    if changes is None:
        return (first, other), None
    turned = np.cross(changes, axis[:, :, None], axis=1) / length[:, None]
    turned = turned - first[:, :, None] * np.einsum("ni,nij->nj", first, turned)[:, None]
    return (first, other), (
        turned, np.cross(changes, first[:, :, None], axis=1) + np.cross(normals[:, :, None], turned, axis=1)
    )  # fmt: skip


@dataclass(frozen=True)
class _Tangencies:
    """Solved contacts: which are ``good`` and ``inside`` the grid and the mate's limits; errors, points, normals."""

    good: np.ndarray
    inside: np.ndarray
    errors: np.ndarray
    points: np.ndarray
    normals: np.ndarray
    solutions: np.ndarray

    def where(self, chosen, other):
        """The other ones where chosen (N,)."""
        pick = chosen[:, None]
        return _Tangencies(
            np.where(chosen, other.good, self.good), np.where(chosen, other.inside, self.inside),
            np.where(chosen, other.errors, self.errors), np.where(pick, other.points, self.points),
            np.where(pick, other.normals, self.normals), np.where(pick, other.solutions, self.solutions),
        )  # fmt: skip
