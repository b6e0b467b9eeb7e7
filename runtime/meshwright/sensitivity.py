"""Exact sensitivities of a contact: what a small change of each parameter does to it.

The generated derivatives give the change of the residual and of the contact point along a parameter, following the
rules and design systems by which other parameters depend on it; the implicit function theorem gives the change of
the solutions, of the design systems and of the contact.
"""

import math
from dataclasses import dataclass

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.library import library, pointer
from meshwright.contact import analysis
from meshwright.design import design as designs

#: Tables whose parameters do not form the flanks, or follow from others.
_OUTSIDE_THE_FLANKS = ("flank", "placement", "blank", "contact")


@dataclass(frozen=True)
class Sensitivity:
    """Derivatives at N pinion angles (rad) by the parameters ``keys`` ("table.key"), per inner unit (mm, rad).

    ``unknowns[name]`` and ``error``, the transmission error in rad: (N, K). ``points``: contact point in the fixed
    frame, mm: (N, K, 3). NaN where there is no contact point. ``design``: derivatives of the complete parameter
    vector, (P, K). ``error_by_angle``: that of the transmission error by the pinion angle, (N,).
    """

    angles: np.ndarray
    keys: tuple[str, ...]
    unknowns: dict[str, np.ndarray]
    error: np.ndarray
    points: np.ndarray
    design: np.ndarray
    error_by_angle: np.ndarray

    def of(self, key):
        """Column of a key."""
        if key not in self.keys:
            raise UsageError(f"{key}: no parameter of this sensitivity; use one of {', '.join(self.keys)}")
        return self.keys.index(key)


def sensitivity(drive, angles):
    """:class:`Sensitivity` of a drive at pinion angles, by every real parameter of design, in whatever table, and of
    misalignment.

    A parameter that the design leaves to a rule is taken as if it alone were given; what a given parameter changes by
    rules or design systems changes with it. A left-hand drive is the mirror image: its angles, transmission error and
    points are those of the drive of that hand.
    """
    description, checked = drive.design.description, drive.design
    angles = analysis.checked_angles(angles)
    columns = [k for k, p in enumerate(description["parameters"]) if _counts(p, k, checked)]
    design = np.stack([_of_design(checked, column) for column in columns], axis=1)
    changes, points, by_angle = _of_contact(drive, angles, design)
    mirror = checked.mirror
    names = [u["name"] for u in description["unknowns"]]
    turning = [mirror.factor(name) for name in names]
    parameters = description["parameters"]
    return Sensitivity(
        angles=angles,
        keys=tuple(f"{parameters[k]['table']}.{parameters[k]['key']}" for k in columns),
        unknowns={name: turning[k] * changes[..., k] for k, name in enumerate(names)},
        error=mirror.sign * changes[..., description["error"]],
        points=points * mirror.flip,
        design=design,
        error_by_angle=by_angle[:, description["error"]],
    )


def on_member(drive, found, member):
    """Derivatives (N, K, 3) of the contact point in the body frame of ``"pinion"`` or ``"wheel"``, as the
    :class:`Sensitivity` of the drive has those in the fixed frame, mm.

    The point moves with its flank parameters, and with the flank itself.
    """
    description, model, mirror = drive.design.description, drive.design.model, drive.design.mirror
    number = next(k for k, body in enumerate(description["bodies"]) if body["name"] == member)
    own = description["bodies"][number]["unknowns"]
    names = [description["unknowns"][k]["name"] for k in own]
    changes = np.stack([mirror.factor(name) * found.unknowns[name] for name in names], axis=2)
    places = np.ascontiguousarray(analysis.analyse(drive, found.angles).solutions[:, own])
    along = np.einsum("njk,nkc->njc", changes, drive.flank(member)(places).tangents)
    formed = np.empty((len(found.keys), len(places), 3))
    for column, direction in zip(formed, found.design.T, strict=True):
        given = (drive.design.parameters, np.ascontiguousarray(direction), places)
        if library().mw_flank_tangent(model, number, *map(pointer, given), len(places), pointer(column)) < 0:
            column[:] = np.nan
    return mirror.flip * (along + np.swapaxes(formed, 0, 1))


def _counts(parameter, k, design):
    """Whether a parameter is a real number in effect, and not the other name of one that is given."""
    if parameter["table"] in _OUTSIDE_THE_FLANKS or not designs.is_real(parameter):
        return False
    if math.isnan(design.parameters[k]):
        return False
    return parameter["table"] != "design" or not designs.has_rival(design, parameter["key"])


def _of_design(design, column):
    """Change of the complete parameter vector per unit of one parameter, as if that were given."""
    m = design.model
    given, change = designs.given_vector(design), np.zeros(m.np)
    given[column], change[column] = design.parameters[column], 1.0
    ended = library().mw_complete_tangent(m, pointer(given), pointer(design.parameters), pointer(change))
    return change if ended >= 0 else np.full(m.np, np.nan)


def _of_contact(drive, angles, design):
    """Changes (N, K, nx) of the unknowns and (N, K, 3) of the contact point of the right-hand drive, and (N, nx) of the
    unknowns by its pinion angle.
    """
    m, p = drive.design.model, drive.design.parameters
    solved = analysis.analyse(drive, angles)
    ways = [*((direction, 0.0) for direction in design.T), (np.zeros(m.np), 1.0)]
    changes, s = np.full((len(angles), len(ways), m.nx), np.nan), np.empty(m.ns)
    points = np.full((*changes.shape[:2], 3), np.nan)
    m.setup(pointer(p), pointer(s))
    for i in np.flatnonzero([status == "converged" for status in solved.status]):
        phi = drive.design.mirror.sign * angles[i]
        m.set_phi(pointer(s), phi)
        x = np.ascontiguousarray(solved.solutions[i])
        for j, (direction, turn) in enumerate(ways):
            dp, dx, dr = np.ascontiguousarray(direction), np.empty(m.nx), np.empty(3)
            arguments = map(pointer, (s, x, dx, dr))
            if library().mw_contact_tangent(m, pointer(p), pointer(dp), phi, turn, *arguments) >= 0:
                changes[i, j], points[i, j] = dx, dr
    return changes[:, :-1], points[:, :-1], changes[:, -1]
