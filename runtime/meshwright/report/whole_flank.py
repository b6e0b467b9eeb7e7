"""Whole flanks between their limits, with what a marking compound would show and the ease-off over them.

From every point of one flank the mate is met along the point's own normal. With both members turned uniformly, the
least of these distances over all positions is how far the point lies from the conjugate of the mate: the ease-off.
With the wheel where contact puts it, the least distance says whether a compound of given thickness is printed there.
Source: F. L. Litvin and A. Fuentes, Gear Geometry and Applied Theory, 2nd ed. (2004), chapters 6 and 9.
"""

from dataclasses import dataclass

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.contact.placement import placed
from meshwright.drive import Drive
from meshwright.flank.mesh import mesh
from meshwright.report.projection import Projection

#: Cells of the lattice over a flank; positions at which the mate is met first, over the contact of a pair and this
#: share of it to either side; narrowing of the steps about the nearest position, and how often.
CELLS, POSITIONS, BEYOND = (18, 18), 41, 0.5
NARROWER, NARROWED = 5.0, 3

#: Longest Newton step to the mate, mm; and how far a flank may be off, as a share of its size.
LONGEST, FARTHEST = 8.0, 0.05

#: A ray whose end strays so far, as a share of the flank's size, is given up.
STRAYED = 0.5

#: Two flanks face each other where their outward normals have at most this scalar product.
FACING = -0.98


@dataclass(frozen=True)
class WholeFlank:
    """A member's flank inside its limits, body frame with the design's hand: ``points`` and outward ``normals`` (V, 3),
    mm, of ``triangles`` (T, 3), and its border: ``edges`` (B, 2) of vertices on the limits named by ``limits`` (B,).

    Distances to the mate, mm, at the vertices (V,), NaN where it never comes: ``ease_off`` from the mate's conjugate,
    0 at the contact of the reference angle; ``alone`` while the pair carries, ``running`` while the drive's leading
    pair does. They are not sought on a thread of several turns, which no compound marks.
    """

    points: np.ndarray
    normals: np.ndarray
    triangles: np.ndarray
    edges: np.ndarray
    limits: tuple[str, ...]
    ease_off: np.ndarray
    alone: np.ndarray
    running: np.ndarray


def whole_flanks(drive, angles, transmitted=None, places=None):
    """The :class:`WholeFlank` of each member by name, of pairs in contact at ascending pinion ``angles`` (N,), rad.

    ``transmitted`` (N,), rad, is the transmission error of the drive there, by default that of the pair; ``places``
    (N, nx) are unknowns of where the pair touches, right hand, by default in tangencies. A member
    whose flank is empty or cannot be bounded has none; none at all where there is no contact.
    """
    contacts = _Contacts.of(drive, angles, transmitted, places)
    if contacts is None:
        return {}
    found = {}
    for body in drive.design.description["bodies"]:
        try:
            region = drive.region(body["name"])
        except UsageError:
            continue
        triangles = None if region.empty else mesh(region, CELLS)
        if triangles is not None and len(triangles.triangles):  # no flank is left of one as wide as rounding
            found[body["name"]] = _whole(drive, body["name"], triangles, region.limits.names, contacts)
    return found


def _whole(drive, member, triangles, names, contacts):
    if Projection.of(triangles.points, triangles.normals).screw is None:
        rays = _Rays.of(drive, member, triangles.points, triangles.normals, contacts)
        ease_off, alone, running = rays.nearest()
    else:
        ease_off = alone = running = np.full(len(triangles.points), np.nan)
    flip = drive.design.mirror.flip
    return WholeFlank(
        triangles.points * flip, triangles.normals * flip, triangles.triangles, triangles.border,
        tuple(names[k] for k in triangles.limit), ease_off, alone, running,
    )  # fmt: skip


@dataclass(frozen=True)
class _Contacts:
    """Contacts of the right-hand drive at ascending ``angles`` (N,): ``unknowns`` (N, nx), transmission errors of the
    pair and of the drive (N,), rad; ``reference`` the error that uniform motion has.
    """

    angles: np.ndarray
    unknowns: np.ndarray
    errors: np.ndarray
    transmitted: np.ndarray
    reference: float

    @classmethod
    def of(cls, drive, angles, transmitted, places):
        mirror = drive.design.mirror.sign
        order = np.argsort(mirror * angles)
        turned = (mirror * angles)[order]
        unknowns = drive.trace(turned)[0] if places is None else places[order]
        errors = unknowns[:, drive.design.description["error"]]
        driven = errors if transmitted is None else mirror * transmitted[order]
        known = np.isfinite(unknowns).all(axis=1)
        if not known.any():
            return None
        driven = np.where(np.isfinite(driven), driven, errors)
        middle = errors[known][np.argmin(np.abs(turned[known] - drive.design.reference_angle))]
        return cls(turned[known], unknowns[known], errors[known], driven[known], float(middle))

    def near(self, angles):
        """Numbers of the contacts nearest to angles."""
        after = np.clip(np.searchsorted(self.angles, angles), 1, max(1, len(self.angles) - 1))
        if len(self.angles) == 1:
            return np.zeros(np.shape(angles), dtype=int)
        return np.where(angles - self.angles[after - 1] < self.angles[after] - angles, after - 1, after)


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
        inside = (positions > low - 1e-12) & (positions < high + 1e-12)
        count = len(self.points)
        vertices = np.tile(np.arange(count), POSITIONS)
        angles = np.repeat(positions, count)
        first = self._met(vertices, angles)
        printed = [self._printed(first, angles, errors).reshape(POSITIONS, count)[inside]
                   for errors in (self.contacts.errors, self.contacts.transmitted)]  # fmt: skip
        printed = [np.fmin.reduce(p) if len(p) else np.full(count, np.nan) for p in printed]
        distance = first.distance.reshape(POSITIONS, count)
        step = positions[1] - positions[0]
        free, *_ = self._narrowed(first, positions, distance, step, (positions[0], positions[-1]))
        within = np.where(inside[:, None], distance, np.nan)
        _, *more = self._narrowed(first, positions, within, step, (low, high))
        return free, *(np.fmin(a, b) for a, b in zip(printed, more, strict=True))

    def _narrowed(self, first, positions, distance, step, bounds):
        """The least distance (V,) about the nearest of the positions, not a number where the mate is still coming
        nearer at the bounds or is lost; and the least printed ones met on the way.
        """
        count = len(self.points)
        vertices = np.flatnonzero(np.isfinite(distance).any(axis=0))
        best = np.nanargmin(distance[:, vertices], axis=0)
        angle, q = positions[best], first.q.reshape(POSITIONS, count, -1)[best, vertices]
        printed = [np.full(count, np.nan), np.full(count, np.nan)]
        for _ in range(NARROWED):
            about = np.array([np.clip(angle + s * step, *bounds) for s in (-1.0, 0.0, 1.0)])
            met = [self._met(vertices, a, q) for a in about]
            self._note(printed, vertices, met, about)
            angle, turning = _lowest(about, np.array([m.distance for m in met]))
            q = np.where(np.isfinite(met[1].distance)[:, None], met[1].q, q)
            step /= NARROWER
        met = self._met(vertices, angle, q)
        self._note(printed, vertices, [met], [angle])
        least = np.full(count, np.nan)
        least[vertices] = np.where(turning, met.distance, np.nan)
        return least, *printed

    def _note(self, printed, vertices, met, angles):
        for values, errors in zip(printed, (self.contacts.errors, self.contacts.transmitted), strict=True):
            for one, at in zip(met, angles, strict=True):
                values[vertices] = np.fmin(values[vertices], self._printed(one, at, errors))

    def _printed(self, met, angles, errors):
        """Distances to the mate inside its limits, the wheel turned by the errors of the contacts."""
        turned = np.interp(angles, self.contacts.angles, errors) - self.contacts.reference
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
        extent = np.ptp(self.points, axis=0).max()
        distance, q = self.mate.met(seen, along, q, LONGEST, STRAYED * extent)
        found = self.mate(q)
        with np.errstate(invalid="ignore"):
            facing = np.einsum("ni,ni->n", found.normals, along) < FACING
            good = facing & (found.regular > 0.0) & (np.abs(distance) < FARTHEST * extent)
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
