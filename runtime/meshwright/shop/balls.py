"""Size over balls and wires: where a ball rests in the space between two teeth, and what a micrometer then reads.

The ball touches both flanks of the space: each contact point with half the ball's diameter along the flank's outward
normal gives the same centre, which is sought in the body's plane z = 0. Where the space is symmetric to a half turn
about a radial line, the centre lies on that line; nothing depends on it.
Source of the arrangement in one plane: ISO 21771:2007, 8 (dimensions over balls).
"""

import math
from dataclasses import dataclass

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.contact.placement import about_z
from meshwright.flank.bounds import OPEN
from meshwright.flank.mesh import mesh
from meshwright.flank.sections import solved
from meshwright.shop.nominal import flank_words, of_flank

NEWTON_STEPS = 60

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
    """One flank of the space: ``turn`` (3, 3) from where it is drawn; sampled ``q`` (V, k), ``points``, ``normals``."""

    region: object
    turn: np.ndarray
    q: np.ndarray
    points: np.ndarray
    normals: np.ndarray

    @classmethod
    def of(cls, region):
        triangles = mesh(region, CELLS)
        return cls(region, np.eye(3), triangles.parameters, triangles.points, triangles.normals)

    def turned(self, angle):
        turn = about_z(angle)[:3, :3]
        return _Side(self.region, turn, self.q, self.points @ turn.T, self.normals @ turn.T)

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
        first, second = (_Side.of(d.region(member)) for d in drives)
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
        everything = np.concatenate([*(side.points for side in self.sides), self.others])
        depth = distance - np.linalg.norm(everything - centre, axis=1).min()
        if depth > ROUNDING:
            return f"it would cut {depth:.3g} mm into the tooth elsewhere"
        return centre, np.array(points)

    def _solved(self, distance):
        """Parameters (k,) of the contact on either side, by Newton's method from the sampled flanks; None if none."""
        starts = [s.points + distance * s.normals for s in self.sides]
        apart = np.linalg.norm(starts[0][:, None] - starts[1][None], axis=2) + np.abs(starts[0][:, None, 2])
        near = np.unravel_index(np.nanargmin(apart), apart.shape)
        q = [side.q[k].copy() for side, k in zip(self.sides, near, strict=True)]
        count = [len(part) for part in q]
        scale = np.concatenate([side.region.chart.sizes for side in self.sides])
        for _ in range(NEWTON_STEPS):
            (c1, d1, g1, e1), (c2, d2, g2, e2) = (s.offset(p, distance) for s, p in zip(self.sides, q, strict=True))
            residual = np.concatenate([c1 - c2, c1[2:], g1, g2])
            matrix = np.zeros((len(residual), sum(count)))
            matrix[:3, : count[0]], matrix[:3, count[0] :], matrix[3, : count[0]] = d1, -d2, d1[2]
            matrix[4 : 4 + len(g1), : count[0]], matrix[4 + len(g1) :, count[0] :] = e1, e2
            step = solved(matrix[None], residual[None])[0]
            if not np.isfinite(step).all():
                return None
            step *= min(1.0, 0.25 / max(np.abs(step / scale).max(), 1e-300))
            q = [q[0] - step[: count[0]], q[1] - step[count[0] :]]
            if max(np.linalg.norm(d1 @ step[: count[0]]), np.linalg.norm(d2 @ step[count[0] :])) < RESOLVED:
                return q
        return None


def _beyond(region, q):
    """The limit, set by a size of the design or by the surface itself, beyond which q (k,) lies most; None if none."""
    values = zip(region.limits.names, region.limits.values(region.flank(q))[0], strict=True)
    least = min((value, name) for name, value in values if name != OPEN)
    return least[1] if least[0] < -ROUNDING else None


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
