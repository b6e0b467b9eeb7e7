"""The as-measured flank in contact: the tangencies, first contacts and ease-off of flanks of which one is measured."""

import math
from dataclasses import dataclass

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.contact.placement import placed
from meshwright.drive import Drive
from meshwright.pattern.gap import smallest_margin
from meshwright.shop.measured_surface import FINER, ON_LIMIT, Field, Surface

#: Newton steps, the size at which they are done (mm and rad), and what is left of a solved contact.
STEPS, DONE, SOLVED = 40, 1e-12, 1e-9

#: Angles of the window at which pattern and ease-off are looked at.
ANGLES = 33

#: A tangency is the first contact if no other place of the grid overlaps by more than this, mm.
OVERLAP = 1e-6


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
            lost = open_ | ~(smallest_margin(found) > -ON_LIMIT)
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


def _solve(matrix, right):
    good = np.isfinite(matrix).all(axis=(1, 2)) & np.isfinite(right).all(axis=(1, 2))
    good[good] = np.abs(np.linalg.det(matrix[good])) > 0.0
    found = np.full((len(matrix), matrix.shape[2], right.shape[2]), np.nan)
    found[good] = np.linalg.solve(matrix[good], right[good])
    return found


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
