"""Size over balls and wires: where a ball rests in the space between two teeth, and what a micrometer then reads.

The ball touches both flanks of the space: each contact point with half the ball's diameter along the flank's outward
normal gives the same centre, which is sought in the body's plane z = 0. Where the space is symmetric to a half turn
about a radial line, the centre lies on that line; nothing depends on it.
Source of the arrangement in one plane: ISO 21771:2007, 8 (dimensions over balls).
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.contact.placement import about_z
from meshwright.flank.bounds import OPEN
from meshwright.flank.mesh import mesh
from meshwright.flank.sections import solved
from meshwright.shop.nominal import flank_words, of_flank

NEWTON_STEPS = 20

#: A contact is followed from one ball to another in steps of this many natural sizes of its parameters at the most, and
#: of this share of the way at the least.
FARTHEST = 0.25
SMALLEST_STEP = 1e-4

#: Pairs of sampled places that are looked at for a start, and starts that are tried.
CANDIDATES = 200
STARTS = 4

#: A centre is found when the last step moves the contact points by less than this, mm.
RESOLVED = 1e-11

#: A ball may go so far into a sampled flank, mm: rounding.
ROUNDING = 1e-9

#: Cells across and along each flank, where a start is looked for and the ball is checked against the flank.
CELLS = (24, 48)

#: Helicoids of a smaller lead angle than this are threads: two balls then lie on opposite sides, not in one plane.
STEEPEST_THREAD = math.radians(30.0)

#: A flank is a helicoid if it keeps to one lead within this share.
SCREW = 1e-9


@dataclass(frozen=True)
class Size:
    """A ball of diameter ``ball`` in a space of a member, mm; NaN where it does not rest there, and why.

    ``centre_radius`` is the distance of its centre from the axis, ``size`` what is measured over two such balls, of an
    internal gear between them, ``wires`` over three wires between parallel anvils (threads alone), ``arrangement`` how
    the balls lie, ``lowest`` the radius of the ball's point nearest to the root. ``contacts`` (2, 3) are where it
    touches, body frame.
    """

    ball: float
    centre_radius: float
    size: float
    wires: float
    arrangement: str
    lowest: float
    contacts: np.ndarray
    reason: str


def sizes(drive, member, balls, step=lambda text: None):
    """The :class:`Size` for every ball diameter (mm) in the spaces of a member; ``step(text)`` is called before each,
    and once before all.
    """
    if drive.design.description["flanks_apart"]:
        raise UsageError(
            "--over-balls: each flank of this drive is a design of its own, so that no design describes a whole space "
            "between teeth; measure points instead: --lines NxM --csv FILE"
        )
    step(f"space between the teeth of the {member}")
    space, found = _Space.of(drive, member), []
    for ball in balls:
        step(f"ball of {ball:g} mm")
        found.append(space.size(float(ball)))
    return found


@dataclass(frozen=True)
class _Side:
    """One flank of the space: ``turn`` (3, 3) from where it is drawn; ``whole`` (P, 3) points of it; where a ball may
    touch ``q`` (V, k), ``points``, ``normals``, of a helicoid about the plane z = 0, wherever contact uses it.
    """

    region: object
    turn: np.ndarray
    whole: np.ndarray
    q: np.ndarray
    points: np.ndarray
    normals: np.ndarray

    @classmethod
    def of(cls, region, teeth):
        triangles = mesh(region, CELLS)
        pitch = _screw(triangles.points, triangles.normals)
        q = triangles.parameters if math.isinf(pitch) else _about_plane(region, triangles, math.pi * pitch / teeth)
        found = region.flank(q)
        return cls(region, np.eye(3), triangles.points, q, found.points, found.normals)

    def turned(self, angle):
        turn = about_z(angle)[:3, :3]
        whole, points, normals = (vectors @ turn.T for vectors in (self.whole, self.points, self.normals))
        return replace(self, turn=turn, whole=whole, points=points, normals=normals)

    def offset(self, q, distance):
        """Centre (3,) at a distance above the point of q (k,), its slopes (3, k), conditions (c,) and theirs (c, k)."""
        flank = self.region.flank
        found, curved = flank(q), flank.curvature(q)
        basis, tangents = curved.basis[0], found.tangents[0]
        turning = -(basis.T @ curved.second_form[0] @ basis) @ tangents.T
        centre = self.turn @ (found.points[0] + distance * found.normals[0])
        slopes = self.turn @ (tangents.T + distance * turning)
        return centre, slopes, found.conditions[0, :, 0], found.conditions[0, :, 1:]


@dataclass(frozen=True)
class _Space:
    """The space between two teeth: its two sides and other surfaces (P, 3) of points that a ball must not reach."""

    sides: tuple[_Side, _Side]
    teeth: int
    pitch: float
    others: np.ndarray

    @classmethod
    def of(cls, drive, member):
        right = drive.as_described
        drives = [of_flank(right, word) for word in flank_words(right)]
        teeth = drive.teeth(member)
        first, second = (_Side.of(d.region(member), teeth) for d in drives)
        steps = [second.turned(2.0 * math.pi * k / teeth) for k in ((0,) if teeth == 1 else (-1, 0, 1))]
        second = min(steps, key=lambda side: _gap(first, side))
        fillets = [_fillet(d, member) for d in drives]
        others = np.concatenate([fillets[0], fillets[1] @ second.turn.T])
        return cls((first, second), teeth, _screw(first.points, first.normals), others)

    def size(self, ball):
        found = self._centre(0.5 * ball)
        if isinstance(found, str):
            nothing = math.nan
            return Size(ball, nothing, nothing, nothing, "", nothing, np.full((2, 3), nothing), found)
        centre, contacts = found
        radius = float(np.hypot(centre[0], centre[1]))
        # where the flanks push the ball towards the axis, the teeth point there too, and it is measured between balls
        ball_out = math.copysign(ball, (centre - contacts.mean(axis=0))[:2] @ centre[:2])
        size, arrangement = self._over_two(radius, ball_out)
        wires = 2.0 * radius + ball if self._thread(radius) else math.nan
        return Size(ball, radius, size, wires, arrangement, radius - 0.5 * ball_out, contacts, "")

    def _thread(self, radius):
        """Whether the teeth are threads, by their lead angle at this radius."""
        return abs(self.pitch) < radius * math.tan(STEEPEST_THREAD)

    def _over_two(self, radius, ball):
        """Size over two balls, and how they lie: in the two spaces, or turns of one, that face each other best.

        A negative diameter is one on either side inside the centres.
        """
        if self.teeth % 2 == 0:
            return 2.0 * radius + ball, "opposite spaces"
        if self._thread(radius):
            half_pitch = math.pi * self.pitch / self.teeth
            return math.hypot(2.0 * radius, half_pitch) + ball, "opposite sides, half an axial pitch apart"
        return 2.0 * radius * math.cos(0.5 * math.pi / self.teeth) + ball, "spaces nearest to opposite, in one plane"

    def _centre(self, distance):
        """Centre (3,) and contact points (2, 3) of a ball of this radius, or why there is none."""
        places = self._solved(distance)
        if places is None:
            return "no place between the flanks where a ball of this size touches both"
        points = []
        for side, q in zip(self.sides, places, strict=True):
            if (beyond := _beyond(side.region, q)) is not None:
                return f"it would touch beyond the flank's limit {beyond!r}: take a larger or a smaller ball"
            if side.region.flank.curvature(q).principal[0, 1] * distance > 1.0:
                return "it would touch where the flank is hollowed more sharply than the ball"
            points.append(side.turn @ side.region.flank(q).points[0])
        centre = self.sides[0].offset(places[0], distance)[0]
        everything = np.concatenate([*(p for side in self.sides for p in (side.whole, side.points)), self.others])
        depth = distance - np.linalg.norm(everything - centre, axis=1).min()
        if depth > ROUNDING:
            return f"it would cut {depth:.3g} mm into the tooth elsewhere"
        return centre, np.array(points)

    def _solved(self, distance):
        """Parameters (k,) of the contact of a ball of this radius on either side; None if none.

        They are followed from a ball that all but rests on two of the sampled points: Newton's method alone may end on
        another sheet of the surfaces, which the tooth does not have.
        """
        for q, radius in self._starts:
            if (found := self._followed(q, radius, distance)) is not None:
                return found
        return None

    @cached_property
    def _starts(self):
        """Pairs of sampled places that come nearest to one ball's contacts, each with the ball's radius."""
        first, second = self.sides
        way = first.points[:, None] - second.points[None]
        apart = first.normals[:, None] - second.normals[None]
        with np.errstate(all="ignore"):
            radius = -np.einsum("abi,abi->ab", way, apart) / np.einsum("abi,abi->ab", apart, apart)
            miss = np.linalg.norm(way + radius[..., None] * apart, axis=2)
            off_plane = np.abs(first.points[:, None, 2] + radius * first.normals[:, None, 2])
            order = np.argsort(np.where(radius > 0.0, miss + off_plane, np.inf), axis=None)[:CANDIDATES]
        found, everything = [], np.concatenate([first.points, second.points, first.whole, second.whole])
        for a, b in zip(*np.unravel_index(order, radius.shape), strict=True):
            centre = first.points[a] + radius[a, b] * first.normals[a]
            inside = radius[a, b] - np.linalg.norm(everything - centre, axis=1).min()
            if np.isfinite(miss[a, b]) and inside <= miss[a, b] + ROUNDING:  # else there is a tooth between the two
                found.append(((first.q[a], second.q[b]), float(radius[a, b])))
        return found[:STARTS]

    def _followed(self, q, before, distance):
        """Parameters of the contact of a ball of the radius ``distance``, from places ``q`` where one of the radius
        ``before`` comes near; None where they cannot be followed that far.
        """
        scale = np.concatenate([side.region.chart.sizes for side in self.sides])
        missed, at, step = self._residual(q, before)[0], 0.0, 1.0
        while at < 1.0:
            ahead = min(1.0, at + step)
            found = self._corrected(q, before + ahead * (distance - before), (1.0 - ahead) * missed, scale)
            if found is not None:
                q, at, step = found, ahead, 2.0 * step
            elif (step := 0.5 * (ahead - at)) < SMALLEST_STEP:
                return None
        return q

    def _corrected(self, q, distance, missed, scale):
        """Places near ``q`` at which the residual is ``missed``; None unless Newton's method goes straight to them."""
        moved = math.inf
        for _ in range(NEWTON_STEPS):
            residual, matrix, slopes = self._residual(q, distance)
            step = solved(matrix[None], (residual - missed)[None])[0]
            before, moved = moved, np.abs(step / scale).max()
            if not moved <= (FARTHEST if math.isinf(before) else 0.5 * before):
                return None
            parts = np.split(step, [len(q[0])])
            q = [place - part for place, part in zip(q, parts, strict=True)]
            if max(np.linalg.norm(slope @ part) for slope, part in zip(slopes, parts, strict=True)) < RESOLVED:
                return q
        return None

    def _residual(self, q, distance):
        """How far centres above places ``q`` are apart and off the plane, and their conditions; slopes of all that, and
        of either centre.
        """
        (c1, d1, g1, e1), (c2, d2, g2, e2) = (s.offset(p, distance) for s, p in zip(self.sides, q, strict=True))
        residual, first = np.concatenate([c1 - c2, c1[2:], g1, g2]), len(q[0])
        matrix = np.zeros((len(residual), first + len(q[1])))
        matrix[:3, :first], matrix[:3, first:], matrix[3, :first] = d1, -d2, d1[2]
        matrix[4 : 4 + len(g1), :first], matrix[4 + len(g1) :, first:] = e1, e2
        return residual, matrix, (d1, d2)


def _beyond(region, q):
    """The limit, set by a size of the design or by the surface itself, beyond which q (k,) lies most; None if none."""
    values = zip(region.limits.names, region.limits.values(region.flank(q))[0], strict=True)
    least = min((value, name) for name, value in values if name != OPEN)
    return least[1] if least[0] < -ROUNDING else None


def _about_plane(region, triangles, reach):
    """Places (V, k) of a helicoid at the radii of its triangles, within ``reach`` (mm) of the plane z = 0 or as far as
    the triangles go.
    """
    radii, heights = np.hypot(*triangles.points[:, :2].T), triangles.points[:, 2]
    ends = np.clip([heights.min(), heights.max()], -abs(reach), abs(reach))
    ends = np.abs(ends).max() * np.array([-1.0, 1.0])
    spans = (radii.min(), radii.max()), ends
    grid = np.meshgrid(*(np.linspace(*span, cells + 1) for span, cells in zip(spans, CELLS, strict=True)))
    wanted = np.stack([values.ravel() for values in grid], axis=1)
    near = [np.argmin((radii - radius) ** 2 + (heights - height) ** 2) for radius, height in wanted]
    q = triangles.parameters[near]
    factors = np.zeros((2, q.shape[1] + 4))
    factors[[0, 1], [-1, -2]] = 1.0
    q = region.flank.places(factors, region.chart.sizes, wanted, q)
    return q[np.isfinite(q).all(axis=1)]


def _gap(first, second):
    """How near the two flanks' outward sides come to facing each other: distance of points less what faces away."""
    way = second.points[None] - first.points[:, None]
    distance = np.linalg.norm(way, axis=2)
    facing = (np.einsum("abi,ai->ab", way, first.normals) > 0.0) & (np.einsum("abi,bi->ab", way, second.normals) < 0.0)
    return np.where(facing, distance, np.inf).min()


def _screw(points, normals):
    """Screw parameter (mm/rad) of a surface that is a helicoid about z; infinite if it is none, or has no lead."""
    moments = np.cross([0.0, 0.0, 1.0], points)
    arms = np.einsum("ij,ij->i", moments, normals)
    axial = normals[:, 2]
    if not np.abs(axial).min() > 1e-6:
        return math.inf
    found = -arms / axial
    return float(found.mean()) if np.ptp(found) <= SCREW * np.abs(found).max() else math.inf


def _fillet(drive, member):
    """Points (P, 3) of the member's fillet, none where the drive has none or leaves its sizes open."""
    if not any(r["name"] == member and r["region"] == "fillet" for r in drive.design.description["regions"]):
        return np.empty((0, 3))
    try:
        region = drive.region(member, "fillet")
    except UsageError:
        return np.empty((0, 3))
    return np.empty((0, 3)) if region.empty else mesh(region, CELLS).points
