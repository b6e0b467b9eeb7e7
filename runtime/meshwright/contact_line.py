"""Line contact: the line along which two flanks touch at one pinion angle, followed from one of its points.

On the line the equations of contact lose one rank; the direction that they leave free is the line's.
"""

from dataclasses import dataclass

import numpy as np

from meshwright._library import ffi
from meshwright.windows import limits_of

#: Steps on the pinion, as a share of its radius, and how many of them either way.
STEP, MOST_STEPS = 0.02, 150

#: Corrections back onto the line after each step; the last one is below this, in units of the unknowns.
CORRECTIONS, TOLERANCE = 8, 1e-9

#: Singular values below this share of the largest are those of the line's own direction.
RANK_SHARE = 1e-7


@dataclass(frozen=True)
class ContactLine:
    """The line of contact at pinion ``angle`` (rad): ``points`` (M, 3) fixed frame, ``body_points[member]`` (M, 3),
    mm, and surface ``parameters[member]`` (M, k). Empty where no part of it lies inside the limits.

    Right-hand drive, whatever the design's hand, like the flanks.
    """

    angle: float
    points: np.ndarray
    body_points: dict[str, np.ndarray]
    parameters: dict[str, np.ndarray]


def contact_line(drive, angle, start):
    """The :class:`ContactLine` through the solution ``start`` (nx,), which may lie outside the limits.

    It is followed either way; of what lies inside every limit of the flanks, the longest piece.
    """
    state = drive.state(angle)
    step = STEP * np.hypot(*_observed(drive, state, start)[drive.design.description["bodies"][0]["point"] :][:2])
    ahead = _followed(drive, state, start, step)
    back = _followed(drive, state, start, -step)
    solutions = np.array([*back[:0:-1], *ahead]).reshape(-1, drive.model.nx)
    observed = np.array([_observed(drive, state, x) for x in solutions]).reshape(-1, drive.model.no)
    indices = [limit.index for limit in limits_of(drive)]
    inside = np.nan_to_num(observed[:, indices], nan=np.inf).min(axis=1, initial=np.inf) >= 0.0
    kept = _longest(inside)
    bodies = drive.design.description["bodies"]
    return ContactLine(
        angle=float(angle),
        points=observed[kept, 0:3],
        body_points={b["name"]: observed[kept, b["point"] : b["point"] + 3] for b in bodies},
        parameters={b["name"]: solutions[kept][:, b["unknowns"]] for b in bodies},
    )


def _followed(drive, state, start, step):
    """Solutions along the line, the first of them ``start`` put exactly onto it."""
    x = _corrected(drive, state, np.array(start))
    found, before = [], None
    while x is not None and len(found) <= MOST_STEPS:
        found.append(x)
        direction = _direction(drive, state, x, step)
        if before is not None and direction @ before < 0.0:
            direction = -direction
        before = direction
        x = _corrected(drive, state, x + direction)
    return found


def _direction(drive, state, x, step):
    """Change of the unknowns along the line that moves the pinion's point by |step| mm; its sense is that of step."""
    _, jacobian = _equations(drive, state, x)
    free = np.linalg.svd(jacobian)[2][-1]
    nudge = 1e-4 / np.abs(free).max()
    moved = (_observed(drive, state, x + nudge * free) - _observed(drive, state, x - nudge * free))[0:3] / (2.0 * nudge)
    largest = free[np.argmax(np.abs(free))]
    return free * np.sign(largest) * step / np.linalg.norm(moved)


def _corrected(drive, state, x):
    """The solution nearest to x, by Gauss and Newton across the line; None if there is none close by."""
    for _ in range(CORRECTIONS):
        residual, jacobian = _equations(drive, state, x)
        if not np.isfinite(residual).all() or not np.isfinite(jacobian).all():
            return None
        change = np.linalg.lstsq(jacobian, residual, rcond=RANK_SHARE)[0]
        x = x - change
        if np.abs(change).max() < TOLERANCE:
            return x
    return None


def _equations(drive, state, x):
    n = drive.model.nx
    residual, jacobian = np.empty(n), np.empty((n, n))
    buffers = (ffi.from_buffer("double[]", a) for a in (state, np.ascontiguousarray(x), residual, jacobian))
    drive.model.eval(*buffers)
    return residual, jacobian


def _observed(drive, state, x):
    observed = np.empty(drive.model.no)
    drive.model.observe(*(ffi.from_buffer("double[]", a) for a in (state, np.ascontiguousarray(x), observed)))
    return observed


def _longest(inside):
    """The longest run of True, as a slice."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], inside, [False])).astype(int)))
    runs = list(zip(edges[::2], edges[1::2], strict=True))
    return slice(*max(runs, key=lambda r: r[1] - r[0])) if runs else slice(0, 0)
