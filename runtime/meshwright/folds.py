"""Folds: input angles at which a branch of contact turns back, so that contact exists on one side only."""

import numpy as np

from meshwright._library import ffi
from meshwright.roots import bracketed

#: Step of the difference that gives the change of the residual with the input angle, rad.
STEP = 1e-5
MAX_STEPS = 60

#: A fold is approached until it is nearer than this, in pitches.
NEAR = 1e-4


def fold_angle(path, side):
    """The input angle of the fold beyond the path's lower (0) or upper (-1) end; None if the end is no fold.

    The branch is followed past its turning point with its fastest unknown in the role of the input angle; at the
    fold the input angle is stationary.
    """
    if len(path.angles) < 2:
        return None
    branch = _Branch(_approached(path, side), side)
    here, slope = branch.at_end()
    if slope is None:
        return None
    step = branch.first_step()
    for _ in range(MAX_STEPS):
        further = branch.slope(here + step)
        if further is None:
            return None
        if further * slope < 0.0:
            at = bracketed(branch.slope, here, here + step, abs(step) * 1e-8, (slope, further))
            branch.slope(at)
            return float(branch.angle)
        here, slope = here + step, further
    return None


def _approached(path, side):
    """The path continued towards its end in ever smaller steps: close to a fold its fastest unknown stands out."""
    pitch = path.drive.pitch()
    step = (1.0 if side else -1.0) * pitch / 32.0
    while abs(step) > NEAR * pitch:
        longer = path.extended(path.angles[side] + step)
        if len(longer.angles) > len(path.angles):
            path = longer
        else:
            step *= 0.5
    return path


class _Branch:
    """The branch with one unknown, measured in natural sizes, as its parameter; remembers the last solution."""

    def __init__(self, path, side):
        self.model, self.state = path.drive.model, path.state
        inward = 1 if side == 0 else -2
        self.scale = np.empty(self.model.nx)
        self.model.set_phi(_pointer(self.state), path.angles[side])
        self.model.scale(_pointer(self.state), _pointer(self.scale))
        self.unknowns, self.angle = path.unknowns[side].copy(), path.angles[side]
        change = (self.unknowns - path.unknowns[inward]) / self.scale
        self.kept = int(np.argmax(np.abs(change)))
        self.change = change[self.kept]

    def at_end(self):
        here = self.unknowns[self.kept] / self.scale[self.kept]
        return here, self.slope(here)

    def first_step(self):
        return 0.25 * self.change

    def slope(self, parameter):
        """d(input angle)/d(parameter) of the branch at the parameter; None if it cannot be followed."""
        x, phi, kept = self.unknowns.copy(), self.angle, self.kept
        x[kept] = parameter * self.scale[kept]
        others = [k for k in range(len(x)) if k != kept]
        for _ in range(30):
            residual, jacobian, by_angle = self._equations(x, phi)
            matrix = np.column_stack([jacobian[:, others] * self.scale[others], by_angle])
            try:
                step = np.linalg.solve(matrix, residual)
            except np.linalg.LinAlgError:
                return None
            x[others] -= step[:-1] * self.scale[others]
            phi -= step[-1]
            if not np.all(np.isfinite(x)):
                return None
            if np.abs(step).max() < 1e-11:
                self.unknowns, self.angle = x, phi
                return float(-np.linalg.solve(matrix, jacobian[:, kept] * self.scale[kept])[-1])
        return None

    def _equations(self, x, phi):
        n = len(x)
        residual, jacobian = np.empty(n), np.empty((n, n))
        self._evaluate(x, phi, residual, jacobian)
        around = [self._evaluate(x, phi + h, np.empty(n), None) for h in (STEP, -STEP)]
        return residual, jacobian, (around[0] - around[1]) / (2 * STEP)

    def _evaluate(self, x, phi, residual, jacobian):
        self.model.set_phi(_pointer(self.state), phi)
        slopes = ffi.NULL if jacobian is None else _pointer(jacobian)
        self.model.eval(_pointer(self.state), _pointer(x), _pointer(residual), slopes)
        return residual


def _pointer(array):
    return ffi.from_buffer("double[]", array)
