"""Line contact: the curve along which two flanks touch at one input angle, clipped at the edges of the flanks.

Every point of the line solves the equations of contact, so their Jacobian has a null direction: the line's own. The
line is followed along it with a least-squares correction.
"""

from dataclasses import dataclass

import numpy as np

from meshwright.base.library import pointer
from meshwright.base.roots import bracketed
from meshwright.contact.model import DriveModel

#: Step along the line in natural sizes of the unknowns, and how many at most to either side.
STEP = 0.125
MAX_STEPS = 240

#: The line is left where it has gone away from the flanks for more than this many steps.
LEAVING = 6
CORRECTIONS = 12
CORRECTED, FALLING = 1e-12, 1e-2

#: An end of the line is known to this share of a step.
EDGE = 1e-12

#: Singular values below this share of the largest belong to the direction of the line.
RANK = 1e-8
SECTIONS = 40
GOLDEN = 0.6180339887498949


@dataclass(frozen=True)
class ContactLine:
    """The line of contact at pinion ``angle`` (rad): ``points`` (M, 3) fixed frame, ``body_points[member]`` (M, 3),
    mm, and surface ``parameters[member]`` (M, k), from edge to edge. Empty where no part of it lies on both flanks.

    Right-hand drive, whatever the design's hand, like the flanks.
    """

    angle: float
    points: np.ndarray
    body_points: dict[str, np.ndarray]
    parameters: dict[str, np.ndarray]


def contact_line(drive, angle, start):
    """The :class:`ContactLine` through the solution ``start`` (nx,), which may lie outside the limits.

    It is followed either way; of what lies on both flanks, the longest piece. Empty where ``start`` is no solution.
    """
    equations = _Equations.of(drive, angle)
    solved = bool(np.isfinite(start).all())
    solutions = _longest_inside(equations, *_whole(equations, start)) if solved else np.empty((0, drive.model.nx))
    observed = np.array([equations.observe(x) for x in solutions]).reshape(-1, drive.model.no)
    bodies = drive.design.description["bodies"]
    return ContactLine(
        angle=float(angle),
        points=observed[:, 0:3],
        body_points={b["name"]: observed[:, b["point"] : b["point"] + 3] for b in bodies},
        parameters={b["name"]: solutions[:, b["unknowns"]] for b in bodies},
    )


def deepest(drive, angle, start):
    """The limit functions at the point of the line through ``start`` that lies farthest inside them: (no,), in the
    order of the drive's observation, NaN elsewhere.
    """
    equations = _Equations.of(drive, angle)
    line, depths = _whole(equations, start)
    k = int(np.argmax(depths))
    x = line[k]
    if 0 < k < len(line) - 1:
        between = _summit(equations, line[k - 1], line[k + 1])
        x = x if between is None or equations.margin(between) < depths[k] else between
    observed = equations.observe(x)
    chosen = np.full(len(observed), np.nan)
    chosen[equations.margins] = observed[equations.margins]
    return chosen


def _summit(equations, before, after):
    """The deepest point between two points of the line, by golden section; None if the line is lost between them."""

    def at(share):
        return equations.corrected(before + share * (after - before))

    def depth(share):
        x = at(share)
        return -np.inf if x is None else equations.margin(x)

    low, high = 0.0, 1.0
    first, second = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    depths = depth(first), depth(second)
    for _ in range(SECTIONS):
        if depths[0] > depths[1]:
            high, second, first = second, first, second - GOLDEN * (second - low)
            depths = depth(first), depths[0]
        else:
            low, first, second = first, second, first + GOLDEN * (high - first)
            depths = depths[1], depth(second)
    return at(0.5 * (low + high))


def _whole(equations, start):
    """The line as far as the surfaces go, or somewhat past the flanks: (P, nx), and the smallest limits there (P,)."""
    direction, margin = equations.direction(start), equations.margin(start)
    (before, below), (after, above) = (_followed(equations, start, s * direction, margin) for s in (-1.0, 1.0))
    return np.array([*before[::-1], start, *after]), np.array([*below[::-1], margin, *above])


@dataclass(frozen=True)
class _Equations:
    """The drive's equations at one angle, unknowns in natural sizes."""

    drive: DriveModel
    state: np.ndarray
    scale: np.ndarray
    margins: np.ndarray

    @classmethod
    def of(cls, drive, angle):
        scale, state = np.empty(drive.model.nx), drive.state(angle)
        drive.model.scale(pointer(state), pointer(scale))
        bodies = drive.design.description["bodies"]
        margins = [b["margin"] + i for b in bodies for i in range(len(b["margins"]))] + [b["regular"] for b in bodies]
        return cls(drive, state, scale, np.array(margins))

    def evaluate(self, x):
        """Residual (nx,) and Jacobian (nx, nx) by unknowns in natural sizes."""
        n = len(x)
        residual, jacobian = np.empty(n), np.empty((n, n))
        self.drive.model.eval(pointer(self.state), pointer(x), pointer(residual), pointer(jacobian))
        return residual, jacobian * self.scale

    def observe(self, x):
        o = np.empty(self.drive.model.no)
        self.drive.model.observe(pointer(self.state), pointer(np.ascontiguousarray(x)), pointer(o))
        return o

    def margin(self, x):
        """The smallest limit of both flanks; limits that the design leaves open do not count."""
        return float(np.fmin.reduce(self.observe(x)[self.margins], initial=np.inf))

    def direction(self, x):
        """Unit null direction of the Jacobian, in natural sizes."""
        return np.linalg.svd(self.evaluate(x)[1])[2][-1]

    def corrected(self, x):
        """The nearest solution; None if there is none near."""
        before = 0.0
        for _ in range(CORRECTIONS):
            residual, jacobian = self.evaluate(x)
            if not (np.isfinite(residual).all() and np.isfinite(jacobian).all()):
                return None
            step = np.linalg.lstsq(jacobian, residual, rcond=RANK)[0]
            x, size = x - step * self.scale, float(np.abs(step).max())
            # by quadratic convergence the next step would be shorter by the square of what this one is shorter by
            if size < CORRECTED or (size < FALLING * before and size * (size / before) ** 2 < CORRECTED):
                return x
            before = size
        return None


def _followed(equations, start, along, margin):
    """Solutions [(nx,)] from ``start`` on, without it, to one side, and the smallest limits there."""
    x, found, margins, falling = start, [], [], 0
    for _ in range(MAX_STEPS):
        x = equations.corrected(x + STEP * along * equations.scale)
        before, margin = margin, np.nan if x is None else equations.margin(x)
        if not np.isfinite(margin):
            break
        found.append(x)
        margins.append(margin)
        falling = falling + 1 if margin < min(before, 0.0) else 0
        if falling > LEAVING:
            break
        after = equations.direction(x)
        along = after if after @ along > 0.0 else -after
    return found, margins


def _longest_inside(equations, line, margins):
    """The longest stretch of the line on both flanks, its ends at their edges: (M, nx)."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], margins >= 0.0, [False])).astype(int)))
    if not len(edges):
        return line[:0]
    first, last = max(zip(edges[::2], edges[1::2], strict=True), key=lambda s: s[1] - s[0])
    ends = [line[first:last]]
    if first > 0:
        ends.insert(0, _edge(equations, line[first], line[first - 1])[None, :])
    if last < len(line):
        ends.append(_edge(equations, line[last - 1], line[last])[None, :])
    return np.concatenate(ends)


def _edge(equations, inner, outer):
    """Where the line between two of its points leaves a flank; of what is known of it there, the last on the flank."""
    inside = [inner]

    def margin(share):
        x = equations.corrected(inner + share * (outer - inner))
        value = -1.0 if x is None else equations.margin(x)
        if value >= 0.0:
            inside.append(x)
        return value

    bracketed(margin, 0.0, 1.0, EDGE, (equations.margin(inner), equations.margin(outer)))
    return max(inside, key=lambda x: np.abs(x - inner).max())
