"""A drive that turns on, all pairs and both flanks: error, ratio and backlash at pinion angles of any size."""

from dataclasses import dataclass, replace

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.library import ffi, library, pointer, record
from meshwright.contact.analysis import checked_angles, statuses
from meshwright.contact.placement import placed
from meshwright.cycle.backlash import offsets
from meshwright.cycle.first_results import STATUSES
from meshwright.cycle.pairs import Mesh
from meshwright.cycle.rigid import RigidTeeth


@dataclass(frozen=True)
class Side:
    """One flank of a drive at N pinion angles: the pair that leads, NaN where none touches within its limits.

    ``statuses``: a contact's, or why there is none, in the words of ``tca``. ``pairs``: numbers of the pairs that lead,
    counted from the reference of this flank. ``touching``: how many pairs touch within their limits, 0 along lines.
    ``errors``: transmission error in the driving flank's angles, rad. ``ratios``: d(wheel angle)/d(pinion angle).
    ``edges``: where the edge of a pair outside its limits may touch first, and is not searched for; the error is then
    that of the others.
    """

    statuses: list[str]
    pairs: np.ndarray
    touching: np.ndarray
    errors: np.ndarray
    ratios: np.ndarray
    edges: np.ndarray


@dataclass(frozen=True)
class Cycle:
    """A drive at pinion angles (N,), as the user counts them; angles in rad.

    ``pairs`` and ``own_angles`` as of :class:`~meshwright.contact.turning.Turning`. The wheel stands at the ratio times
    the angle plus ``drive.errors`` where it is driven, plus ``coast.errors`` where it runs ahead. ``backlash``: wheel
    angle between both, negative where the drive jams.
    """

    angles: np.ndarray
    pairs: np.ndarray
    own_angles: np.ndarray
    drive: Side
    coast: Side
    backlash: np.ndarray


def cycle(drive, angles, coast=None, edges=False):
    """:class:`Cycle` of a drive at pinion angles (N,), rad, in any order; quickest where each is near the one before.

    ``coast``: the drive of the other flank, where that has a design of its own; without it that side has no contact.
    ``edges``: search for edges and corners where they may touch first, which C leaves open, some milliseconds an angle.
    Raises :class:`~meshwright.base.errors.UsageError` for what is no angle or beyond 10¹² rad, or no other flank.
    """
    m, lib, sign = drive.model, library(), drive.design.mirror.sign
    angles = checked_angles(angles, lib.mw_largest_angle())
    other = drive.other_side if coast is None else _checked(drive, coast)
    c = np.empty(lib.mw_cycle_size(m))
    parameters = ffi.NULL if other is None else pointer(other.design.parameters)
    lib.mw_cycle_setup(m, pointer(drive.design.parameters), parameters, pointer(c))
    found = np.zeros(len(angles), record("mw_cycle"))
    lib.mw_cycles(
        m, pointer(c), pointer(np.ascontiguousarray(sign * angles)), len(angles), pointer(found, "mw_cycle[]")
    )
    here = Cycle(
        angles=angles,
        pairs=(sign * found["pair"]).astype(np.int64),
        own_angles=sign * found["angle"],
        drive=_side(found["drive"], sign),
        coast=_side(found["coast"], sign),
        backlash=found["backlash"],
    )
    return _with_edges(drive, other, here) if edges else here


def _with_edges(drive, other, found):
    """The :class:`Cycle` with edges and corners on both flanks where they touch first."""
    mesh = Mesh.of(drive)
    driven, coast = _searched(mesh, found.drive, found.pairs, found.own_angles), found.coast
    if other is not None:
        there, sign, tooth = Mesh.of(other), drive.design.mirror.sign, drive.pitch() * drive.ratio
        pinion, wheel = (sign * offset for offset in offsets(mesh, there))
        shift = drive.ratio * pinion + wheel
        coast = replace(coast, errors=coast.errors - shift)
        coast = _searched(there, coast, found.pairs, found.own_angles + pinion)
        errors = coast.errors + shift
        coast = replace(coast, errors=errors - tooth * np.round((errors - driven.errors) / tooth))
    backlash = mesh.sense * (coast.errors - driven.errors)
    return replace(found, drive=driven, coast=coast, backlash=backlash)


def _searched(mesh, side, pairs, angles):
    """A side of a drive with the first contact of all pairs at own angles (N,) of ``pairs`` where it is left open."""
    rows = np.flatnonzero(side.edges)
    teeth = (mesh.rigid or RigidTeeth.of(mesh)) if rows.size else None
    if teeth is None:
        return side
    leads = [teeth.leader(angle) for angle in angles[rows].tolist()]
    known = [np.isfinite(ahead) and angle not in teeth.unknown
             for (_, ahead), angle in zip(leads, angles[rows].tolist(), strict=True)]  # fmt: skip
    rows, leads = rows[known], [lead for lead, is_known in zip(leads, known, strict=True) if is_known]
    numbers = np.array([number for number, _ in leads], dtype=np.int64)
    own = angles[rows] - numbers * mesh.drive.pitch()
    first = mesh.search.first(own)
    words = list(side.statuses)
    for row, kind in zip(rows, first.kinds, strict=True):
        words[row] = STATUSES[kind]
    columns = {
        "pairs": pairs[rows] + numbers, "errors": teeth.sense * np.array([ahead for _, ahead in leads]),
        "ratios": _ratios(mesh.drive, own, first), "edges": np.zeros(len(rows), dtype=bool),
    }  # fmt: skip
    changed = {name: getattr(side, name).copy() for name in columns}
    for name, values in columns.items():
        changed[name][rows] = values
    return replace(side, statuses=words, **changed)


def _ratios(drive, angles, first):
    """d(wheel angle)/d(pinion angle) at first contacts at angles (N,): the quotient of their lever arms."""
    mirror, own = drive.design.mirror, drive.design.mirror.sign * angles
    axes = placed(drive, own, drive.ratio * own + mirror.sign * first.errors).axes
    points, normals = mirror.flip * first.points, mirror.flip * first.normals
    pinion, wheel = (np.einsum("ni,ni->n", normals, np.cross(axes[name][0], points - axes[name][1]))
                     for name in (body["name"] for body in drive.design.description["bodies"]))  # fmt: skip
    return pinion / wheel


def _side(found, sign):
    words = statuses()
    return Side(
        statuses=[words[code] for code in found["status"].tolist()],
        pairs=sign * found["pair"],
        touching=found["pairs"],
        errors=sign * found["error"],
        ratios=found["ratio"],
        edges=found["edge"] != 0,
    )


def _checked(drive, coast):
    """The drive of the other flank; raises UsageError for one that is not of the same family, hand and members."""
    if not isinstance(coast, type(drive)):
        raise UsageError(f"coast = {coast!r}: no drive; give that of the other flank, Drive.load(…)")
    one, other = drive.design, coast.design
    if (one.description["name"], one.mirrored, one.sizes["ratio"], drive.pitch()) != (
        other.description["name"], other.mirrored, other.sizes["ratio"], coast.pitch()
    ) or one.flank == other.flank:  # fmt: skip
        raise UsageError(
            f"coast = {other.label}: not the other flank of {one.label}; give a design of the same drive, hand and "
            f"numbers of teeth with the other flank"
        )
    return coast
