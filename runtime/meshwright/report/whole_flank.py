"""Whole flanks between their limits, with what a marking compound would show and the ease-off over them.

From every point of one flank the mate is met along the point's own normal. With both members turned uniformly, the
least of these distances over all positions is how far the point lies from the conjugate of the mate: the ease-off.
With the wheel where contact puts it, the least distance says whether a compound of given thickness is printed there.
Source: F. L. Litvin and A. Fuentes, Gear Geometry and Applied Theory, 2nd ed. (2004), chapters 6 and 9.
"""

from dataclasses import dataclass
from functools import partial

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.contact.placement import placed
from meshwright.drive import Drive
from meshwright.flank.mesh import mesh
from meshwright.flank.region import solved
from meshwright.report.projection import Projection

#: Cells of the lattice over a flank; positions at which the mate is met first, over the contact of a pair and this
#: share of it to either side; angles there at which it is told where the drive stands; narrowing of the steps about the
#: nearest position, and how often.
CELLS, POSITIONS, BEYOND, STANDINGS = (18, 18), 41, 0.5, 481
NARROWER, NARROWED = 5.0, 3

#: Newton steps to the mate, mm: longest, done; how many; and how far a flank may be off, as a share of its size.
LONGEST, DONE, STEPS, FARTHEST = 8.0, 1e-9, 16, 0.05

#: Two flanks face each other where their outward normals have at most this scalar product.
FACING = -0.98


@dataclass(frozen=True)
class WholeFlank:
    """A member's flank inside its limits, body frame with the design's hand: ``points`` and outward ``normals`` (V, 3),
    mm, of ``triangles`` (T, 3), and its border: ``edges`` (B, 2) of vertices on the limits named by ``limits`` (B,).

    Distances to the mate, mm, at the vertices (V,), NaN where it never comes: ``ease_off`` from the mate's conjugate,
    0 at the contact of the reference angle; ``alone`` while the pair carries, ``running`` in the drive, where the pair
    carries that touches first, with a tangency, an edge or a corner. They are not sought on a thread of several turns,
    which no compound marks.
    """

    points: np.ndarray
    normals: np.ndarray
    triangles: np.ndarray
    edges: np.ndarray
    limits: tuple[str, ...]
    ease_off: np.ndarray
    alone: np.ndarray
    running: np.ndarray


def whole_flanks(drive, angles, alone=None, running=None):
    """The :class:`WholeFlank` of each member by name, of pairs in contact at ascending pinion ``angles`` (N,), rad.

    ``alone`` (N,), rad, is the transmission error there of a pair that carries alone, by default that of its tangency;
    ``running``, of pinion angles (M,), rad, that of the drive: with it no place of any two flanks overlaps, and the
    places that stand close to the mate are those that a compound prints. By default ``alone``. A member whose flank is
    empty or cannot be bounded has none; none at all where there is no contact.
    """
    contacts = _Contacts.of(drive, angles, alone, running)
    if contacts is None:
        return {}
    found = {}
    for body in drive.design.description["bodies"]:
        try:
            region = drive.region(body["name"])
        except UsageError:
            continue
        if not region.empty:
            found[body["name"]] = _whole(drive, body["name"], mesh(region, CELLS), region.limits.names, contacts)
    return found


def _whole(drive, member, triangles, names, contacts):
    if Projection.of(triangles.points, triangles.normals).screw is None:
        rays = _Rays.of(drive, member, triangles.points, triangles.normals, contacts)
        ease_off, alone, running = rays.nearest()
    else:
        ease_off = alone = running = np.full(len(triangles.points), np.nan)
    flip = np.array([1.0, drive.design.mirror.sign, 1.0])
    return WholeFlank(
        triangles.points * flip, triangles.normals * flip, triangles.triangles, triangles.border,
        tuple(names[k] for k in triangles.limit), ease_off, alone, running,
    )  # fmt: skip


@dataclass(frozen=True)
class _Contacts:
    """Contacts of the right-hand drive at ascending ``angles`` (N,): ``unknowns`` (N, nx); ``reference``, the error of
    uniform motion, rad; ``alone`` and ``running``, where pair and drive stand at the angles (M,) of each: (angles,
    errors), rad.
    """

    angles: np.ndarray
    unknowns: np.ndarray
    reference: float
    alone: tuple[np.ndarray, np.ndarray]
    running: tuple[np.ndarray, np.ndarray]

    @classmethod
    def of(cls, drive, angles, alone, running):
        mirror = drive.design.mirror.sign
        order = np.argsort(mirror * angles)
        turned = (mirror * angles)[order]
        unknowns, _ = drive.trace(turned)
        errors = unknowns[:, drive.design.description["error"]]
        known = np.isfinite(unknowns).all(axis=1)
        if not known.any():
            return None
        middle = errors[known][np.argmin(np.abs(turned[known] - drive.design.reference_angle))]
        driven = errors if alone is None else mirror * alone[order]
        driven = np.where(np.isfinite(driven), driven, errors)
        one = turned[known], driven[known]
        return cls(turned[known], unknowns[known], float(middle), one, _standing(running, one, mirror))

    def near(self, angles):
        """Numbers of the contacts nearest to angles."""
        after = np.clip(np.searchsorted(self.angles, angles), 1, max(1, len(self.angles) - 1))
        if len(self.angles) == 1:
            return np.zeros(np.shape(angles), dtype=int)
        return np.where(angles - self.angles[after - 1] < self.angles[after] - angles, after - 1, after)


def _standing(running, alone, mirror):
    """Where the drive stands over the contact of a pair and beyond it on either side; as ``alone`` if nothing says."""
    if running is None:
        return alone
    low, high = alone[0][0], alone[0][-1]
    room = BEYOND * (high - low)
    angles = np.linspace(low - room, high + room, STANDINGS)
    errors = mirror * running(mirror * angles)
    known = np.isfinite(errors)
    return (angles[known], errors[known]) if known.any() else alone


@dataclass(frozen=True)
class _Met:
    """The mate met at P pairs of point and pinion angle: ``distance`` at uniform motion, its ``slope`` by the wheel's
    angle, mm/rad, the mate's parameters ``q`` and its ``margin``; distance NaN where it is not met.
    """

    distance: np.ndarray
    slope: np.ndarray
    q: np.ndarray
    margin: np.ndarray


@dataclass(frozen=True)
class _Rays:
    """Normals through ``points`` (V, 3) of the flank of ``member``, right hand, body frame; ``mate`` is the other."""

    drive: Drive
    member: str
    mate: object
    columns: slice
    points: np.ndarray
    normals: np.ndarray
    contacts: _Contacts

    @classmethod
    def of(cls, drive, member, points, normals, contacts):
        other = next(b for b in drive.design.description["bodies"] if b["name"] != member)
        return cls(drive, member, drive.flank(other["name"]), other["unknowns"], points, normals, contacts)

    def nearest(self):
        """Least distances (V,), mm: from the conjugate of the mate, to the mate of the pair alone, in the drive."""
        low, high = self.contacts.angles[0], self.contacts.angles[-1]
        room = BEYOND * (high - low) + 1e-12
        positions = np.linspace(low - room, high + room, POSITIONS)
        count = len(self.points)
        first = self._met(np.tile(np.arange(count), POSITIONS), np.repeat(positions, count))
        free, turning, _ = self._narrowed(first, positions, lambda met, angles: met.distance, positions[[0, -1]])
        alone, running = (
            self._narrowed(first, positions, partial(self._printed, standing), standing[0][[0, -1]])[2]
            for standing in (self.contacts.alone, self.contacts.running)
        )
        # beyond its contact a pair alone comes at least as near as in the drive
        return np.where(turning, free, np.nan), np.fmin(alone, running), running

    def _narrowed(self, first, positions, value, bounds):
        """About the position within ``bounds`` at which ``value``, of :class:`_Met` and angles, is least: the value
        (V,) at the end of ever finer steps, whether it turns there, and the least one met on the way.
        """
        count, step = len(self.points), positions[1] - positions[0]
        end, turns, least = np.full(count, np.nan), np.zeros(count, dtype=bool), np.full(count, np.nan)
        values = value(first, np.repeat(positions, count)).reshape(POSITIONS, count)
        values[(positions < bounds[0] - 1e-12) | (positions > bounds[1] + 1e-12)] = np.nan
        vertices = np.flatnonzero(np.isfinite(values).any(axis=0))
        if not len(vertices):
            return end, turns, least
        best = np.nanargmin(values[:, vertices], axis=0)
        angle, q = positions[best], first.q.reshape(POSITIONS, count, -1)[best, vertices]
        met_least = values[best, vertices]
        for _ in range(NARROWED):
            about = np.array([np.clip(angle + s * step, *bounds) for s in (-1.0, 0.0, 1.0)])
            met = [self._met(vertices, a, q) for a in about]
            found = np.array([value(m, a) for m, a in zip(met, about, strict=True)])
            met_least = np.fmin(met_least, np.fmin.reduce(found))
            angle, turning = _lowest(about, found)
            q = np.where(np.isfinite(met[1].distance)[:, None], met[1].q, q)
            step /= NARROWER
        end[vertices] = value(self._met(vertices, angle, q), angle)
        turns[vertices], least[vertices] = turning, np.fmin(met_least, end[vertices])
        return end, turns, least

    def _printed(self, standing, met, angles):
        """Distances to the mate inside its limits, the wheel where it stands, not a number where nothing says where."""
        turned = np.interp(angles, *standing, left=np.nan, right=np.nan) - self.contacts.reference
        return np.where(met.margin >= 0.0, met.distance + met.slope * turned, np.nan)

    def _met(self, vertices, angles, start=None):
        """:class:`_Met` from the vertices at pinion angles (P,), in uniform motion."""
        stand = placed(self.drive, angles, self.drive.ratio * angles + self.contacts.reference)
        own, other = (stand.matrices[name] for name in (self.member, self.mate.body["name"]))
        points = np.einsum("nij,nj->ni", own[:, :3, :3], self.points[vertices]) + own[:, :3, 3]
        normals = np.einsum("nij,nj->ni", own[:, :3, :3], self.normals[vertices])
        direction, origin = stand.axes["wheel"]
        lever = np.einsum("ni,ni->n", normals, np.cross(direction, points - origin))
        seen = np.einsum("nji,nj->ni", other[:, :3, :3], points - other[:, :3, 3])
        along = np.einsum("nji,nj->ni", other[:, :3, :3], normals)
        q = self._beside(seen, angles) if start is None else start
        distance, q, margin = self._followed(seen, along, q)
        return _Met(distance, -lever if self.member == "wheel" else lever, q, margin)

    def _beside(self, seen, angles):
        """Parameters (P, k) of the mate near points ``seen`` in its frame, to first order from the contact."""
        near = self.contacts.near(angles)
        found = self.mate(self.contacts.unknowns[:, self.columns])
        slopes = np.concatenate([np.swapaxes(found.tangents, 1, 2), found.conditions[:, :, 1:]], axis=1)
        inverse = np.linalg.pinv(slopes)[:, :, :3]
        return found.parameters[near] + np.einsum("nij,nj->ni", inverse[near], seen - found.points[near])

    def _followed(self, seen, along, q):
        """Distance (P,) to the mate along rays, its parameters and the margin there, by Newton's method."""
        q, distance = q.copy(), np.zeros(len(q))
        going = np.arange(len(q))
        good = np.zeros(len(q), dtype=bool)
        for _ in range(STEPS):
            found = self.mate(q[going])
            residual = np.concatenate(
                [found.points - seen[going] - distance[going, None] * along[going], found.conditions[:, :, 0]], axis=1
            )
            matrix = np.zeros((len(going), residual.shape[1], residual.shape[1]))
            matrix[:, :3, :-1], matrix[:, :3, -1] = np.swapaxes(found.tangents, 1, 2), -along[going]
            matrix[:, 3:, :-1] = found.conditions[:, :, 1:]
            step = solved(matrix, residual)
            length = np.linalg.norm(np.einsum("nk,nkj->nj", step[:, :-1], found.tangents), axis=1)
            step *= np.minimum(1.0, LONGEST / np.maximum(length, 1e-300))[:, None]
            q[going] -= step[:, :-1]
            distance[going] -= step[:, -1]
            done = np.maximum(length, np.abs(step[:, -1])) < DONE
            good[going[done]] = True
            going = going[~done & np.isfinite(step).all(axis=1)]
            if not going.size:
                break
        found = self.mate(q)
        size = np.ptp(self.points, axis=0).max()
        with np.errstate(invalid="ignore"):
            facing = np.einsum("ni,ni->n", found.normals, along) < FACING
            good &= facing & (found.regular > 0.0) & (np.abs(distance) < FARTHEST * size)
        margin = np.min([np.where(np.isnan(m), np.inf, m) for m in (found.regular, *found.margins.values())], axis=0)
        return np.where(good, distance, np.nan), q, margin


def _lowest(about, values):
    """Where a parabola through three values (3, P) at places (3, P) is lowest, and whether that is between them (P,);
    else the place of the lowest value.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        before, after = (values[i] - values[1] for i in (0, 2))
        left, right = about[0] - about[1], about[2] - about[1]
        bend = (after / right - before / left) / (right - left)
        lowest = about[1] - 0.5 * (before / left - bend * left) / bend
        between = (bend > 0.0) & (lowest >= about[0]) & (lowest <= about[2])
    best = np.argmin(np.where(np.isfinite(values), values, np.inf), axis=0)
    return np.where(between, lowest, np.take_along_axis(about, best[None], axis=0)[0]), between
