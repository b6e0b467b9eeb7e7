"""The wheel's bounded flank as it is searched: a mesh of its region, and what is known of it."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from meshwright.base.library import ffi, library, pointer
from meshwright.contact.analysis import at_solutions
from meshwright.contact.flags import on_flanks
from meshwright.contact.results import SOLVED
from meshwright.flank.bounds import OPEN
from meshwright.flank.mesh import mesh
from meshwright.flank.region import region
from meshwright.flank.uses import Uses

#: Cells of the mesh over the wheel's flank, across and along.
CELLS = (12, 24)

#: Contacts at so many angles show where the flanks are,
ANGLES = 9

#: over so many pitches to either side of the reference angle.
PITCHES = 0.5

#: Where nothing ends a flank it is searched so many natural sizes beyond them.
BEYOND = 4.0


@dataclass(frozen=True)
class SearchedFlank:
    """A mesh over the wheel's bounded flank: a ``table`` for C, of arrays that are ``kept`` with it. ``solutions``
    (P, nx) of contacts in the middle, or the places from which they are sought, at ``angles`` (P,), right hand;
    ``pointless``: none of them is a contact in a point of both flanks; ``extent``: longest side of a box about the
    flank, mm; ``found``: first contacts by angle, ``ridges``: depths and deepest places of the ridge of the wheel's
    turn to which start values lead, by angle, ``passed``: those that were passed on the way from there, by angle and
    direction.
    """

    table: object
    kept: tuple
    angles: np.ndarray
    solutions: np.ndarray
    pointless: bool
    extent: float
    found: dict = field(default_factory=dict, repr=False)
    ridges: dict = field(default_factory=dict, repr=False)
    passed: dict = field(default_factory=dict, repr=False)

    @classmethod
    def of(cls, drive):
        """Of the flank about the contacts in the middle or, where there is none, about the places from which contact is
        sought; None if no part of it lies within its limits.
        """
        here = drive.design.reference_angle + np.linspace(-PITCHES, PITCHES, ANGLES) * drive.pitch()
        known, words = drive.trace(here)
        sought = start_values(drive, here)
        for used in (known, sought):
            solved = np.isfinite(used).all(axis=1)
            found = _triangulated(drive, used[solved]) if solved.any() else None
            if found is not None:
                use = known if np.isfinite(known).any() else sought
                solved = np.isfinite(use).all(axis=1)
                return cls._of(found, here[solved], use[solved], not _in_a_point(drive, here, known, words))
        return None

    @classmethod
    def _of(cls, found, angles, solutions, pointless):
        """Of the region, its triangles and the natural sizes of the pinion's parameters."""
        whole, triangles, sizes = found
        names = np.array(whole.limits.names)
        open_ = np.zeros(len(triangles.points), dtype=np.uint8)
        open_[triangles.border[names[triangles.limit] == OPEN].ravel()] = 1
        kept = (
            np.ascontiguousarray(triangles.parameters), np.ascontiguousarray(triangles.triangles, dtype=np.int32),
            open_, np.ascontiguousarray(whole.chart.sizes), np.ascontiguousarray(sizes),
        )  # fmt: skip
        table = ffi.new("mw_flank_mesh *")
        table.vertices, table.triangles = len(triangles.points), len(triangles.triangles)
        names = ("q", "corner", "open", "wheel_sizes", "pinion_sizes")
        kinds = ("double[]", "int[]", "unsigned char[]", "double[]", "double[]")
        views = tuple(ffi.from_buffer(kind, array) for kind, array in zip(kinds, kept, strict=True))
        for name, view in zip(names, views, strict=True):
            setattr(table, name, view)
        table.span = whole.chart.free
        extent = float(np.ptp(triangles.points, axis=0).max())
        return cls(table, (kept, views), angles, solutions, pointless, extent)


def _in_a_point(drive, angles, unknowns, words):
    """Whether flanks touch in a point of both at one of some angles (N,): ``unknowns`` and status ``words`` there."""
    solved = np.isin(words, SOLVED)
    found = at_solutions(drive, angles[solved], unknowns[solved])
    on_both = np.array([on_flanks(flags) for flags in found.flags], dtype=bool)
    return bool((found.solved & on_both).any())


def _triangulated(drive, unknowns):
    """The wheel's region about contacts (P, nx), its triangles and natural sizes of the pinion's parameters; None if no
    part of it lies within its limits.
    """
    pinion, wheel = (body["name"] for body in drive.design.description["bodies"])
    uses = Uses.of(drive, unknowns, beyond=BEYOND)
    whole = region(drive, wheel, "flank", uses)
    triangles = mesh(whole, CELLS)
    return (whole, triangles, uses.on(drive.flank(pinion))[1]) if len(triangles.triangles) else None


def start_values(drive, angles):
    """Where contact is sought in the middle of the flanks at angles (N,) of the right-hand drive: unknowns (N, nx)."""
    model, state = drive.design.model, drive.design.state.copy()
    x = np.empty((len(angles), model.nx))
    for row, angle in zip(x, angles, strict=True):
        model.set_phi(pointer(state), angle)
        library().mw_start_values(model, pointer(state), pointer(row))
    return x
