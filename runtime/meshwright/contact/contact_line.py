"""Line contact: the curve along which two flanks touch at one input angle, clipped at the edges of the flanks.

Every point of the line solves the equations of contact, so their Jacobian has a null direction: the line's own. The
line is followed along it with a least-squares correction.
"""

from dataclasses import dataclass

import numpy as np

from meshwright.base.library import pointer
from meshwright.contact.model import DriveModel

#: Step along the line in natural sizes of the unknowns, and how many at most to either side.
STEP = 0.125
MAX_STEPS = 240

#: The line is left where it has gone away from the flanks for more than this many steps.
LEAVING = 6
CORRECTIONS = 12
CORRECTED = 1e-10

#: Singular values below this share of the largest belong to the direction of the line.
RANK = 1e-8
BISECTIONS = 40
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
    solutions = _longest_inside(equations, _whole(equations, start)) if solved else np.empty((0, drive.model.nx))
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
    line = _whole(equations, start)
    depths = [equations.margin(x) for x in line]
    k = int(np.argmax(depths))
    x = line[k]
    if 0 < k < len(line) - 1:
        between = _summit(equations, line[k - 1], line[k + 1])
        x = x if between is None or equations.margin(between) < depths[k] else between
    observed = equations.observe(x)
    chosen = np.full(len(observed), np.nan)
    chosen[list(equations.margins)] = observed[list(equations.margins)]
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
    """The line as far as the surfaces go, or somewhat past the flanks: (P, nx)."""
    followed = [_followed(equations, start, sign) for sign in (-1.0, 1.0)]
    return np.concatenate([followed[0][::-1], start[None, :], followed[1]])


@dataclass(frozen=True)
class _Equations:
    """The drive's equations at one angle, unknowns in natural sizes."""

    drive: DriveModel
    state: np.ndarray
    scale: np.ndarray
    margins: tuple[int, ...]

    @classmethod
    def of(cls, drive, angle):
        scale, state = np.empty(drive.model.nx), drive.state(angle)
        drive.model.scale(pointer(state), pointer(scale))
        bodies = drive.design.description["bodies"]
        margins = [b["margin"] + i for b in bodies for i in range(len(b["margins"]))] + [b["regular"] for b in bodies]
        return cls(drive, state, scale, tuple(margins))

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
        values = self.observe(x)[list(self.margins)]
        return float(np.min(np.where(np.isnan(values), np.inf, values)))

    def direction(self, x):
        """Unit null direction of the Jacobian, in natural sizes."""
        return np.linalg.svd(self.evaluate(x)[1])[2][-1]

    def corrected(self, x):
        """The nearest solution; None if there is none near."""
        for _ in range(CORRECTIONS):
            residual, jacobian = self.evaluate(x)
            if not (np.all(np.isfinite(residual)) and np.all(np.isfinite(jacobian))):
                return None
            step = np.linalg.lstsq(jacobian, residual, rcond=RANK)[0]
            x = x - step * self.scale
            if np.abs(step).max() < CORRECTED:
                return x
        return None


def _followed(equations, start, sign):
    """Solutions (P, nx) from ``start`` on, without it, to one side."""
    x, along = start, sign * equations.direction(start)
    found, falling, margin = [], 0, equations.margin(start)
    for _ in range(MAX_STEPS):
        x = equations.corrected(x + STEP * along * equations.scale)
        if x is None or not np.isfinite(equations.margin(x)):
            break
        found.append(x)
        before, margin = margin, equations.margin(x)
        falling = falling + 1 if margin < min(before, 0.0) else 0
        if falling > LEAVING:
            break
        after = equations.direction(x)
        along = after if after @ along > 0.0 else -after
    return np.array(found).reshape(-1, len(start))


def _longest_inside(equations, line):
    """The longest stretch of the line on both flanks, its ends at their edges: (M, nx)."""
    inside = np.array([equations.margin(x) >= 0.0 for x in line])
    edges = np.flatnonzero(np.diff(np.concatenate(([False], inside, [False])).astype(int)))
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
    """Where the line between two of its points leaves a flank."""
    for _ in range(BISECTIONS):
        middle = equations.corrected(0.5 * (inner + outer))
        if middle is not None and equations.margin(middle) >= 0.0:
            inner = middle
        else:
            outer = 0.5 * (inner + outer) if middle is None else middle
    return inner
