"""Whether points lie on a generated flank: found from their coordinates and the compiled surface alone."""

import numpy as np

_STEPS, _HALVINGS = 60, 12


def distance_from_flank(flank, points: np.ndarray, starts: np.ndarray) -> np.ndarray:
    """Distances (K,) in mm of points (K, 3), body frame, from what a flank has near them; 0 on it.

    starts (S, k): places on the flank. Gauss and Newton's method from the start nearest to each point, on the place
    and, where the surface has them, its implicit conditions, whose violation counts as distance.
    """
    q = _nearest(flank, points, starts)
    for _ in range(_STEPS):
        residual, slopes = _residual(flank, q, points)
        step = _damped(np.stack([np.linalg.lstsq(m, r, rcond=None)[0] for m, r in zip(slopes, residual, strict=True)]))
        q = q - _nearer(flank, points, q, step)
    return np.linalg.norm(_residual(flank, q, points)[0], axis=1)


def _nearer(flank, points, q, step):
    """The steps (K, k), halved until they lead nearer: beside the cusp of an undercut flank whole ones jump over it."""
    before = np.linalg.norm(_residual(flank, q, points)[0], axis=1)
    for _ in range(_HALVINGS):
        further = ~(np.linalg.norm(_residual(flank, q - step, points)[0], axis=1) <= before)
        if not further.any():
            break
        step = np.where(further[:, None], 0.5 * step, step)
    return step


def turn_onto_flank(flank, point: np.ndarray, starts: np.ndarray) -> float:
    """Angle in rad about z by which a flank must turn to pass through a point (3,)."""
    q, turn = _nearest(flank, point[None], starts), 0.0
    for _ in range(_STEPS):
        c, s = np.cos(turn), np.sin(turn)
        back = np.array([[c * point[0] + s * point[1], -s * point[0] + c * point[1], point[2]]])
        residual, slopes = _residual(flank, q, back)
        by_turn = np.zeros((slopes.shape[1], 1))
        by_turn[:3, 0] = [-back[0, 1], back[0, 0], 0.0]
        step = _damped(np.linalg.solve(np.concatenate([slopes[0], by_turn], axis=1), residual[0])[None])[0]
        q, turn = q - step[None, :-1], turn - step[-1]
    return turn


def _nearest(flank, points, starts):
    known = flank(starts).points
    return starts[np.argmin(np.linalg.norm(points[:, None] - known[None], axis=-1), axis=1)]


def _residual(flank, q, points):
    found = flank(q)
    residual = np.concatenate([found.points - points, found.conditions[:, :, 0]], axis=1)
    return residual, np.concatenate([np.swapaxes(found.tangents, 1, 2), found.conditions[:, :, 1:]], axis=1)


def _damped(step):
    return step * np.minimum(1.0, 0.3 / np.maximum(np.abs(step).max(axis=1), 1e-300))[:, None]
