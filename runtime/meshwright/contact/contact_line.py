"""Line contact: the curve along which two flanks touch at one input angle, clipped at the edges of the flanks.

Every point of the line solves the equations of contact, so their Jacobian has a null direction: the line's own. The
line is followed along it in C.
"""

from dataclasses import dataclass

import numpy as np

from meshwright.base.library import library, pointer
from meshwright.base.roots import bracketed
from meshwright.contact.model import DriveModel

#: Step along the line in natural sizes of the unknowns, how many are made at once, and how often to either side.
STEP = 0.125
AT_ONCE, STRETCHES = 12, 20

#: The line is left where it has gone away from the flanks for more than this many steps.
LEAVING = 6

#: An end of the line is known to this share of a step.
EDGE = 1e-12


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
    observed = equations.observe(solutions)
    bodies = drive.design.description["bodies"]
    return ContactLine(
        angle=float(angle),
        points=observed[:, 0:3],
        body_points={b["name"]: observed[:, b["point"] : b["point"] + 3] for b in bodies},
        parameters={b["name"]: solutions[:, b["unknowns"]] for b in bodies},
    )


def _whole(equations, start):
    """The line as far as the surfaces go, or somewhat past the flanks: (P, nx), and the smallest limits there (P,)."""
    border, margin = equations.border(start), equations.margin(start)
    (before, below), (after, above) = (_followed(equations, start, border, s * STEP, margin) for s in (-1.0, 1.0))
    return np.concatenate([before[::-1], start[None], after]), np.concatenate([below[::-1], [margin], above])


@dataclass(frozen=True)
class _Equations:
    """The drive's equations at one angle, unknowns in natural sizes."""

    drive: DriveModel
    angle: float
    state: np.ndarray
    scale: np.ndarray
    limits: tuple[int, ...]

    @classmethod
    def of(cls, drive, angle):
        scale, state = np.empty(drive.model.nx), drive.state(angle)
        drive.model.scale(pointer(state), pointer(scale))
        bodies = drive.design.description["bodies"]
        limits = [b["margin"] + i for b in bodies for i in range(len(b["margins"]))] + [b["regular"] for b in bodies]
        return cls(drive, float(angle), state, scale, tuple(limits))

    def observe(self, x):
        """Observations (N, no) at unknowns (N, nx)."""
        x = np.ascontiguousarray(np.atleast_2d(x))
        angles, observed = np.full(len(x), self.angle), np.empty((len(x), self.drive.model.no))
        library().mw_observe(
            self.drive.model, pointer(self.state), pointer(angles), pointer(x), len(x), pointer(observed)
        )
        return observed

    def margins(self, x):
        """The smallest limits of both flanks (N,); limits that the design leaves open do not count."""
        values = self.observe(x)[:, self.limits]
        return np.where(np.isnan(values), np.inf, values).min(axis=1)

    def margin(self, x):
        """The same of one."""
        return float(self.margins(x)[0])

    def border(self, x):
        """Unit null vectors of the Jacobian, right and left, in natural sizes: (2, nx)."""
        residual, jacobian = np.empty(len(x)), np.empty((len(x), len(x)))
        self.drive.model.eval(pointer(self.state), pointer(x), pointer(residual), pointer(jacobian))
        left, _, right = np.linalg.svd(jacobian * self.scale)
        return np.stack([right[-1], left[:, -1]])

    def followed(self, x, border, step, count):
        """Solutions (M, nx) on the line: the one at ``x`` and ``count`` more, fewer where the line is lost; the
        ``border`` becomes that at the last one.
        """
        points = np.empty((count + 1, len(x)))
        points[0] = x
        found = library().mw_line(self.drive.model, pointer(self.state), pointer(border), step, count, pointer(points))
        return points[:found]

    def corrected(self, x, border):
        """The solution straight beside ``x``; None if there is none near."""
        found = self.followed(x, border.copy(), 0.0, 0)
        return found[0] if len(found) else None


def _followed(equations, start, border, step, margin):
    """Solutions (M, nx) from ``start`` on, without it, to one side, and the smallest limits there (M,)."""
    line, margins, border = start[None], np.array([margin]), border.copy()
    for _ in range(STRETCHES):
        points = equations.followed(line[-1], border, step, AT_ONCE)[1:]
        line, margins = np.concatenate([line, points]), np.concatenate([margins, equations.margins(points)])
        end = _left(margins)
        if end < len(line) or len(points) < AT_ONCE:
            return line[1:end], margins[1:end]
    return line[1:], margins[1:]


def _left(margins):
    """How many points of a line come before there is no flank any more, or it has gone too far away from it."""
    falling = 0
    for k in range(1, len(margins)):
        if not np.isfinite(margins[k]):
            return k
        falling = falling + 1 if margins[k] < min(margins[k - 1], 0.0) else 0
        if falling > LEAVING:
            return k + 1
    return len(margins)


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
    inside, border = [inner], equations.border(inner)

    def margin(share):
        x = equations.corrected(inner + share * (outer - inner), border)
        value = -1.0 if x is None else equations.margin(x)
        if value >= 0.0:
            inside.append(x)
        return value

    bracketed(margin, 0.0, 1.0, EDGE, (equations.margin(inner), equations.margin(outer)))
    return max(inside, key=lambda x: np.abs(x - inner).max())
