"""What gives a drive that jams its room: lengths of the design whose change, one at a time, ends the overlap of teeth.

No list of remedies is kept: each length of the design and of the assembly is changed a little and the backlash asked.
"""

import math
from typing import NamedTuple

import numpy as np

from meshwright.base.errors import DesignError
from meshwright.cycle.backlash import backlash
from meshwright.cycle.pairs import Mesh
from meshwright.cycle.transmission import ROUND_OFF

#: Tables whose lengths are tried: how the members are made and how they are assembled.
TABLES = ("design", "misalignment")

#: Changes of more than this times the least are no remedy; the overlap must be gone with this share more of a change.
FARTHEST, BEYOND = 10.0, 0.05

#: A length that opens less than this share of the overlap when it is changed by as much leaves the teeth as they are.
LEAST = 0.01


class Room(NamedTuple):
    """A length ``key`` ("table.key") of the design and the ``change`` of it, mm, that takes the backlash to zero."""

    key: str
    change: float


def room(drive, play):
    """Every :class:`Room` of a drive with the negative backlash ``play`` (rad), the least change first.

    Empty where the drive does not jam. A change is where the secant of two backlashes, of the design and of one changed
    by its overlap, comes to zero; the backlash a little beyond it is computed and may not be negative.
    """
    if not play < -ROUND_OFF:
        return ()
    step = _overlap(drive, play)
    found = [Room(f"{table}.{key}", change) for table, key in _lengths(drive.design)
             if math.isfinite(change := _change(drive, play, table, key, step))]  # fmt: skip
    found.sort(key=lambda r: abs(r.change))
    near = [r for r in found if abs(r.change) <= FARTHEST * abs(found[0].change)]
    return tuple(r for r in near if _play(drive, *r.key.split("."), (1.0 + BEYOND) * r.change) > -ROUND_OFF)


def said(rooms):
    """The changes, one at a time, in words."""
    return ", ".join(f"{r.key} {'larger' if r.change > 0.0 else 'smaller'} by {abs(r.change):.3g} mm" for r in rooms)


def _lengths(design):
    """(table, key) of the lengths that may be changed alone: a key that another one determines is left out."""
    tied = {key for group in design.description["exclusive"] for key in group}
    for p in design.description["parameters"]:
        length = p["table"] in TABLES and p["key_unit"] == "mm" and p["key"] not in tied
        if length and math.isfinite(design.value(p["key"], p["table"])):
            yield p["table"], p["key"]


def _overlap(drive, play):
    """How deep the teeth stand in each other along the normal, mm."""
    mesh = Mesh.of(drive)
    path = mesh.window.path
    levers = np.abs(mesh.contact.levers(np.array([mesh.middle]) if path is None else path.angles))
    return -play * float(np.nanmedian(levers))


def _change(drive, play, table, key, step):
    """The change of a key at which the secant through the backlash ``play`` comes to zero; NaN if it never does."""
    gained = _play(drive, table, key, step) - play
    return -play * step / gained if abs(gained) > -LEAST * play else math.nan


def _play(drive, table, key, change):
    """Backlash with a key changed, rad; NaN where there is no such design or no contact."""
    value = drive.design.value(key, table)
    try:
        return backlash(drive.with_(**{table: {key: value + change}}))
    except DesignError:
        return math.nan
