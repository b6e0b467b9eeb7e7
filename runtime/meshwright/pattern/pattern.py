"""Contact patterns by surface separation: the patch within which the flanks stand closer than a given distance.

In each direction of the tangent plane the flanks are followed outwards until their separation along the contact
normal reaches the given one or a flank ends. Five unknowns a direction: two parameters on each flank, and the radius.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache, cached_property

import numpy as np

from meshwright.cycle.rigid import ROUND_OFF
from meshwright.pattern.gap import Gap

#: Steps outwards, as shares of the quadratic ellipse's radius, and how many of them at most.
STEP = 0.125
MAX_STEPS = 160
REFINEMENTS = 60
RADIUS_TOLERANCE = 1e-11

#: The longest ray is this many times as long as the ellipse is narrow, times the steps allowed by STEP.
LONGEST = 40.0


@dataclass(frozen=True)
class Contour:
    """The patch of one contact at pinion ``angle`` (rad) and ``separation`` (mm).

    ``directions`` (N,), rad, about the contact normal (out of the pinion) from the major direction.
    ``radii_on_flank`` (N,), mm, from the contact point to the separation or the edge of a flank. ``points`` (N, 3): the
    edge of the patch on the flanks, in the tangent plane, fixed frame; ``body_points[member]`` (N, 3) the same on each
    flank, body frame.
    """

    angle: float
    separation: float
    directions: np.ndarray
    radii_on_flank: np.ndarray
    points: np.ndarray
    body_points: dict[str, np.ndarray]
    past_edges: Callable[[], np.ndarray] = field(repr=False)

    @cached_property
    def radii(self):
        """Radii (N,), mm, to the separation on flanks continued past their edges; NaN where they never reach it."""
        return self.past_edges()


def evenly(count, *_curvatures):
    """``count`` directions from the major one at equal angles, rad."""
    return 2.0 * np.pi * np.arange(count) / count


def along_ellipse(count, smaller, larger):
    """``count`` directions from the major one that are spread evenly along the ellipse of relative curvatures
    ``smaller`` and ``larger`` (1/mm), rad; equal angles where there is no ellipse.
    """
    angle = evenly(count)
    if not smaller > 0.0:
        return angle
    return np.arctan2(np.sqrt(smaller) * np.sin(angle), np.sqrt(larger) * np.cos(angle)) % (2.0 * np.pi)


def contour(drive, angle, count=72, separation=None, result=None, spacing=evenly):
    """The :class:`Contour` at a pinion angle in ``count`` directions; None where there is no contact point.

    ``separation`` defaults to the design's. ``result`` is a TCA that holds the angle, if there is one already.
    ``spacing`` is :func:`evenly`, or :func:`along_ellipse` for a smooth outline of a slender patch.
    """
    found = drive.tca([angle]) if result is None else result
    k = int(np.argmin(np.abs(found.angles - angle)))
    return _contours(drive, found, [k], count, separation, spacing)[0]


def contours(drive, result, count=72, separation=None, spacing=evenly, rows=None):
    """A :class:`Contour`, or None, for every point of a TCA, or for those in the ``rows`` that are named."""
    rows = range(len(result.angles)) if rows is None else rows
    return _contours(drive, result, list(rows), count, separation, spacing)


def patches(mesh, angle, count=72, separation=None):
    """The contours of all pairs that touch or stand closer than the separation at a pinion angle, by pair number.

    The drive stands where its bounded flanks touch first, with a tangency or an edge of any pair; a pair that lags is a
    gap apart there already, and its patch is where the rest of the separation is reached.
    """
    if separation is None:
        separation = mesh.drive.design.value("separation_mm", "contact")
    apart = _apart(mesh, angle)
    near = [pair for pair in mesh.pairs(angle) if apart[pair.number] < separation]
    found = {p.number: contour(mesh.drive, p.angle, count, separation - apart[p.number]) for p in near}
    return {number: patch for number, patch in found.items() if patch is not None}


def _apart(mesh, angle):
    """How far the tangencies of pairs are apart at a pinion angle, mm, by pair number."""
    pairs = mesh.pairs(angle)
    lead = max((mesh.sense * pair.error for pair in pairs), default=math.nan)
    teeth = mesh.rigid
    ahead = 0.0 if teeth is None or not pairs else mesh.sense * teeth.transmitted([angle])[0] - lead
    if not ahead > ROUND_OFF:
        return {pair.number: pair.separation for pair in pairs}
    levers = np.abs(mesh.window.path.levers(mesh.mirror * np.array([pair.angle for pair in pairs])))
    return {pair.number: pair.separation + ahead * lever for pair, lever in zip(pairs, levers, strict=True)}


def _contours(drive, found, rows, count, separation, spacing):
    """The contours of rows of a TCA, None where there is no contact point: all rays together."""
    if separation is None:
        separation = drive.design.value("separation_mm", "contact")
    solved = [k for k in rows if found.solved[k]]
    if not solved:
        return (None,) * len(rows)
    mirror = drive.design.mirror
    flip, of = mirror.flip, np.repeat(solved, count)
    directions = np.concatenate([spacing(count, *found.curvatures[k]) for k in solved])
    contact = (flip * a[of] for a in (found.points, found.normals, found.major))
    gap = Gap.at(drive, mirror.sign * found.angles[of], found.solutions[of], *contact)
    rays = _Rays.of(gap, found.curvatures[of], mirror.sign * directions, separation)
    on_flank = rays.followed(_separation_or_edge_reached)
    places = np.matmul((on_flank.radius[:, None] * rays.along)[:, None], gap.axes[:, :2])[:, 0]
    points, reached = flip * (gap.point + places), cache(lambda: rays.past_edges(on_flank))
    bodies = drive.design.description["bodies"]
    on_bodies = {
        b["name"]: flip * side.flank(q).points
        for b, side, q in zip(bodies, gap.sides, on_flank.parameters, strict=True)
    }

    def one(k, part):
        on = {name: body[part] for name, body in on_bodies.items()}
        around = directions[part], on_flank.radius[part], points[part]
        return Contour(float(found.angles[k]), float(separation), *around, on, lambda: reached()[part])

    parts = {k: one(k, slice(i * count, (i + 1) * count)) for i, k in enumerate(solved)}
    return tuple(parts.get(k) for k in rows)


def _separation_reached(rays, sections):
    """Positive before the separation is reached."""
    return rays.separation - rays.sign * sections.separation


def _separation_or_edge_reached(rays, sections):
    """Positive before the separation is reached and while both flanks last."""
    return np.fmin(_separation_reached(rays, sections), sections.margin)


@dataclass(frozen=True)
class _Rays:
    """Straight lines ``along`` (N, 2) in the tangent plane. ``sign``: where the flanks interfere the separation falls.
    ``step``: how far to go at once.
    """

    gap: Gap
    along: np.ndarray
    sign: np.ndarray
    step: np.ndarray
    separation: float

    @classmethod
    def of(cls, gap, curvatures, directions, separation):
        along = np.stack([np.cos(directions), np.sin(directions)], axis=1)
        curvature = np.einsum("ni,ni->n", along**2, curvatures)
        ellipse = np.sqrt(2.0 * separation / np.maximum(np.abs(curvature), 1e-300))
        step = STEP * np.minimum(ellipse, LONGEST * np.sqrt(2.0 * separation / np.abs(curvatures).max(axis=1)))
        return cls(gap, along, np.where(curvature < 0.0, -1.0, 1.0), step, separation)

    def followed(self, remaining):
        """Where ``remaining`` falls to 0 on each ray, with the value 0.

        A ray along which a flank is lost before ends there, one that is too long ends somewhere: the value is NaN.
        """
        inner = _State.start(self)
        outer = self._at(self.step, inner, remaining)
        for _ in range(MAX_STEPS):
            (going,) = np.nonzero(outer.value > 0.0)
            if not len(going):
                break
            inner.put(going, outer.only(going))
            rays, here = self.only(going), inner.only(going)
            outer.put(going, rays._at(here.radius + rays.step, here, remaining))
        return self._refined(inner, outer, remaining)

    def past_edges(self, on_flank):
        """Radii (N,) at which the separation is reached, the flanks continued past their edges, NaN where it never is;
        ``on_flank`` is where it is reached or a flank ends.
        """
        reached = on_flank.only(np.arange(len(self.along)))
        (ended,) = np.nonzero(~((on_flank.value == 0.0) & (on_flank.margin > 0.0)))
        if len(ended):
            reached.put(ended, self.only(ended).followed(_separation_reached))
        return np.where(reached.value == 0.0, reached.radius, np.nan)

    def only(self, chosen):
        """The chosen rays."""
        return _Rays(self.gap.only(chosen), self.along[chosen], self.sign[chosen], self.step[chosen], self.separation)

    def _at(self, radius, near, remaining):
        sections = self.gap.separations(radius[:, None] * self.along, near.parameters)
        value = remaining(self, sections)
        return _State(
            radius.copy(), sections.parameters, np.where(np.isfinite(value), value, np.nan), sections.margin
        )

    def _refined(self, inner, outer, remaining):
        """The place between an inner and an outer state, by false position (Illinois) or bisection."""
        weight, beyond = np.stack([inner.value, outer.value]), outer.margin.copy()
        last = np.zeros(len(inner.radius))
        for _ in range(REFINEMENTS):
            width = outer.radius - inner.radius
            (wide,) = np.nonzero(~(width <= RADIUS_TOLERANCE * outer.radius))
            if not len(wide):
                break
            low, high = weight[:, wide]
            with np.errstate(divide="ignore", invalid="ignore"):
                share = low / (low - high)
            share = np.where((share > 0.0) & (share < 1.0), share, 0.5)
            here = inner.only(wide)
            middle = self.only(wide)._at(here.radius + share * width[wide], here, remaining)
            before = middle.value > 0.0
            weight[0, wide] = np.where(before, middle.value, np.where(last[wide] < 0, 0.5, 1.0) * low)
            weight[1, wide] = np.where(before, np.where(last[wide] > 0, 0.5, 1.0) * high, middle.value)
            last[wide] = np.where(before, 1.0, -1.0)
            inner.put(wide[before], middle.only(before))
            outer.put(wide[~before], middle.only(~before))
        found = np.isfinite(outer.value) & (outer.value <= 0.0)
        margin = np.fmin(beyond, outer.margin)
        return _State(inner.radius, inner.parameters, np.where(found, 0.0, np.nan), margin)


@dataclass(frozen=True)
class _State:
    """A place on each ray: radius (N,), parameters of both flanks there, what remains to the end, and the smallest
    margin of both flanks; at the end of a ray, the smallest of the margins beyond it.
    """

    radius: np.ndarray
    parameters: tuple[np.ndarray, np.ndarray]
    value: np.ndarray
    margin: np.ndarray

    @classmethod
    def start(cls, rays):
        """The contact point itself."""
        n = len(rays.along)
        return cls(
            np.zeros(n), tuple(q.copy() for q in rays.gap.parameters), np.full(n, rays.separation), np.full(n, np.inf)
        )

    def only(self, chosen):
        """The state on the chosen rays."""
        parameters = tuple(q[chosen] for q in self.parameters)
        return _State(self.radius[chosen], parameters, self.value[chosen], self.margin[chosen])

    def put(self, chosen, other):
        """Take over another state, of the chosen rays alone, in place."""
        self.radius[chosen], self.value[chosen], self.margin[chosen] = other.radius, other.value, other.margin
        for mine, its in zip(self.parameters, other.parameters, strict=True):
            mine[chosen] = its
