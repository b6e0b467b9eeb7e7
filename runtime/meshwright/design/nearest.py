"""The place nearest to solving a design system: where only a start is asked of it, that will do."""

import numpy as np

from meshwright.base.library import library, pointer

#: Steps of the method of Levenberg and Marquardt at most, and the length of the last one, in natural sizes.
STEPS = 200
LAST_STEP = 1e-10

#: Its damping at first; by what that falls after a good step and grows after a bad one; the largest.
DAMPING = 1e-3
FALL = 3.0
GROWTH = 4.0
LARGEST_DAMPING = 1e12


def filled_nearly(c, number, parameters):
    """Fill in what system ``number`` of a model fills in of ``parameters`` (np,), from the place nearest to solving it.

    Whether that misses by less than the unknowns move in a natural size: else there is nothing to start from.
    """
    system, q = c.systems[number], np.append(parameters, 1.0)
    most, n = library().MW_MAX_UNKNOWNS, system.n
    y, scale = np.zeros(most), np.zeros(most)
    system.guess(pointer(q), pointer(y))
    system.scale(pointer(q), pointer(scale))
    scale = scale[:n]

    def equations(y):
        residual, jacobian = np.full(n, np.nan), np.full((n, n), np.nan)
        system.eval(pointer(q), pointer(y), pointer(residual), pointer(jacobian))
        return residual, jacobian * scale

    damping, (residual, slopes) = DAMPING, equations(y)
    for _ in range(STEPS):
        if not (np.isfinite(residual).all() and np.isfinite(slopes).all()):
            return False
        step = -np.linalg.solve(slopes.T @ slopes + damping * np.eye(n), slopes.T @ residual)
        trial = y.copy()
        trial[:n] += scale * step
        found = equations(trial)
        if found[0] @ found[0] < residual @ residual:
            y, (residual, slopes), damping = trial, found, damping / FALL
            if np.abs(step).max() < LAST_STEP:
                break
        elif (damping := damping * GROWTH) > LARGEST_DAMPING:
            break
    if not np.linalg.norm(residual) <= np.linalg.norm(slopes, axis=0).max():
        return False
    system.fill(pointer(y), pointer(q))
    parameters[:] = q[: c.np]
    c.derive(pointer(parameters))
    return True
