"""What is left of a flank that its own fillet cuts off: an undercut tooth's, as a grid and as a STEP file."""

from __future__ import annotations

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.drive import Drive
from meshwright.fe.sides import RegionSide
from meshwright.flank.grids import Grid, between_lines
from meshwright.flank.lines import CELLS, SINGULAR
from meshwright.flank.mesh import mesh
from meshwright.flank.region import Region
from meshwright.flank.sections import Sections
from meshwright.flank.step import StepFile, needs_open_cascade
from meshwright.flank.step import between_lines as step_between_lines


def undercut_side(drive: Drive, member: str) -> RegionSide | None:
    """The side of a tooth whose fillet cuts off its flank; None where it does not, or the design leaves it open."""
    regions = {(r["name"], r["region"]) for r in drive.design.description["regions"]}
    if Sections.of(drive.flank(member)) is None or (member, "fillet") not in regions:
        return None
    flank = drive.region(member)
    if flank.empty or not _ends_at_singular_line(flank):
        return None
    fillet = _fillet(drive, member)
    if fillet is None or fillet.empty:
        return None
    side = RegionSide.of(flank, fillet)
    return side if side.cut else None


def _ends_at_singular_line(flank: Region) -> bool:
    """Whether the surface's own singular line is part of its border."""
    found = mesh(flank, (CELLS, CELLS))
    return any(flank.limits.names[k] in SINGULAR for k in np.unique(found.limit))


def _fillet(drive: Drive, member: str) -> Region | None:
    try:
        return drive.region(member, "fillet")
    except UsageError:
        return None  # the design does not say how its tool is rounded


def left_of_flank(drive: Drive, side: RegionSide, shape: tuple[int, int]) -> Grid:
    """The flank up to its fillet, ``shape`` points across and along."""
    return between_lines(drive, side.flank_lines(np.linspace(*side.reach, shape[1])), shape[0])


def step_of_flank(drive: Drive, side: RegionSide, shape: tuple[int, int]) -> StepFile:
    """The flank up to its fillet as B-spline surfaces."""
    needs_open_cascade()
    name = f"{drive.design.tables['name'] or drive.design.family} {side.flank.region.flank.body['name']} flank"
    flip = np.array([1.0, -1.0, 1.0]) if drive.design.mirrored else np.ones(3)
    return step_between_lines(side.flank_lines, [side.reach[0], *side.breaks(), side.reach[1]], shape, flip, name)
