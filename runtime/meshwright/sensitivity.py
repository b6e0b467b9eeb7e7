"""Exact sensitivities of a contact: what a small change of each parameter does to it.

The generated derivatives give the change of the residual and of the contact point along a parameter, following the
rules by which other parameters depend on it; the implicit function theorem gives the change of the solution.
"""

import math
from dataclasses import dataclass

import numpy as np

from meshwright import design as designs
from meshwright._library import ffi, library, model
from meshwright.errors import UsageError


@dataclass(frozen=True)
class Sensitivity:
    """Derivatives at N pinion angles (rad) by the parameters ``keys`` ("table.key"), per inner unit (mm, rad).

    ``unknowns[name]`` and ``error``, the transmission error in rad: (N, K). ``points``: contact point in the fixed
    frame, mm: (N, K, 3). NaN where there is no contact point.
    """

    angles: np.ndarray
    keys: tuple[str, ...]
    unknowns: dict[str, np.ndarray]
    error: np.ndarray
    points: np.ndarray

    def of(self, key):
        """Column of a key."""
        return self.keys.index(key)


def sensitivity(drive, angles):
    """:class:`Sensitivity` of a drive at pinion angles, by every real parameter of design and misalignment.

    A parameter that the design leaves to a rule is taken as if it alone were given; what a given parameter changes by
    rules changes with it. Raises :class:`~meshwright.errors.UsageError` for a left-hand drive, and for a drive whose
    parameters a system of equations solves.
    """
    description, m = drive.design.description, model(drive.design.description["name"])
    if m.nsystems:
        raise UsageError(f"{description['title']}: its parameters follow from a system of equations; no sensitivities")
    if drive.design.mirrored:
        raise UsageError("hand = 'left': sensitivities are those of the right-hand mirror image; set hand to right")
    angles = np.atleast_1d(np.asarray(angles, dtype=float))
    given = designs.given_vector(drive.design)
    columns = [k for k, p in enumerate(description["parameters"]) if _counts(p, k, drive.design, given)]
    x, status = drive.trace(angles)
    n, count, nx = len(angles), len(columns), m.nx
    changes, points = np.full((n, count, nx), np.nan), np.full((n, count, 3), np.nan)
    for i, phi in enumerate(angles):
        if status[i] != "converged":
            continue
        state = _state(m, drive.design.parameters, phi)
        for j, column in enumerate(columns):
            solved = _derivative(m, given, drive.design.parameters, phi, state, x[i], column)
            if solved is not None:
                changes[i, j], points[i, j] = solved
    parameters = description["parameters"]
    return Sensitivity(
        angles=angles,
        keys=tuple(f"{parameters[k]['table']}.{parameters[k]['key']}" for k in columns),
        unknowns={u["name"]: changes[..., k] for k, u in enumerate(description["unknowns"])},
        error=changes[..., description["error"]],
        points=points,
    )


def _counts(parameter, k, design, given):
    """Whether a parameter is a real number in effect, and not the other name of one that is given."""
    if parameter["table"] not in ("design", "misalignment") or parameter["integer"] or parameter["choices"]:
        return False
    if math.isnan(design.parameters[k]):
        return False
    rivals = [group for group in design.description["exclusive"] if parameter["key"] in group]
    return not (rivals and parameter["table"] == "design" and math.isnan(given[k]))


def _pointer(array):
    return ffi.from_buffer("double[]", array)


def _state(m, parameters, phi):
    s = np.empty(m.ns)
    m.setup(_pointer(parameters), _pointer(s))
    m.set_phi(_pointer(s), phi)
    return s


def _derivative(m, given, parameters, phi, state, x, column):
    """Changes of the unknowns and of the contact point per unit of one parameter; None where they do not exist."""
    change = np.zeros(m.np)
    change[column] = 1.0
    alone = given.copy()
    alone[column] = parameters[column]
    dp, dx, dr = np.empty(m.np), np.empty(m.nx), np.empty(3)
    rest = map(_pointer, (state, np.ascontiguousarray(x), change, dp, dx, dr))
    ended = library().mw_sensitivity(m, _pointer(alone), _pointer(parameters), phi, *rest)
    return (dx, dr) if ended >= 0 else None
