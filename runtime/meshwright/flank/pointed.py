"""Teeth that end in a point: both flanks of an external tooth meet below the tip that the design gives."""

import math
from dataclasses import dataclass

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.flank.blank import with_whole_blank
from meshwright.flank.mesh import mesh
from meshwright.flank.region import region
from meshwright.flank.tooth import CELLS, tooth

#: Margins beyond which a member has no more tooth.
TIPS = ("tip", "throat")

#: Larger changes of the angle across a tooth along an edge of the mesh, in pitches, are no change of its thickness.
STEEPEST = 0.25


@dataclass(frozen=True)
class Pointed:
    """A member whose teeth end in a point; ``radius``: the least, mm, at which their flanks meet."""

    member: str
    radius: float

    def plain(self):
        return {"member": self.member, "radius_mm": self.radius}

    def __str__(self):
        return (
            f"the flanks of a tooth of the {self.member} meet at radius {self.radius:.6g} mm: it ends in a point below "
            "the tip of [blank]"
        )


def pointed(drive):
    """Every :class:`Pointed` member of a drive.

    None is where the design gives no tip, or says nothing of the other flank of the teeth: see :func:`unknown`.
    """
    if unknown(drive):
        return ()
    teeth = 2 * math.pi / drive.pitch()
    members = (("pinion", teeth), ("wheel", teeth / drive.ratio))
    whole, _, _ = with_whole_blank(drive)
    found = ((member, _meeting(drive, whole, member, round(count))) for member, count in members)
    return tuple(Pointed(member, radius) for member, radius in found if math.isfinite(radius))


def unknown(drive):
    """Why nothing is known of the tips of a drive's teeth, "" where it is."""
    return "each flank of a tooth is a design of its own" if drive.other_side is None else ""


def _meeting(drive, whole, member, teeth):
    """The least radius at which the flanks of a member's teeth meet; NaN where they do not, or no tip is given.

    ``whole`` is the drive with a whole blank: where a root is open, a flank goes on to where there is no tooth.
    """
    try:
        near = mesh(region(whole, member, "flank", whole.uses), CELLS)
    except UsageError:  # not bounded by what the design gives, or not in contact
        return math.nan
    if not len(near.points):
        return math.nan
    flank, places = drive.flank(member), whole.uses.on(whole.flank(member))[0]
    x, y = near.points[:, 0], near.points[:, 1]
    inwards = -np.sign(np.median(x * near.normals[:, 1] - y * near.normals[:, 0]))
    across = inwards * tooth(whole, member, near, teeth).across
    depth, used = _depth(flank, near.parameters), _depth(flank, places)
    met = _Met.on(near.triangles, across, 2 * math.pi / teeth)
    above = met.between(depth) < np.fmax.reduce(used, initial=0.0)
    return float(np.min(met.between(np.hypot(x, y))[above], initial=math.inf))


def _depth(flank, parameters):
    """How far places (N,) are below the tips that the design gives, mm; NaN where it gives none."""
    margins = flank(parameters).margins
    depths = [margins[event] for event in TIPS if event in margins]
    return np.fmin.reduce(depths) if depths else np.full(len(parameters), math.nan)


@dataclass(frozen=True)
class _Met:
    """Edges (N,) of triangles ``first`` to ``last`` on which the angle across a tooth becomes 0 after a ``share``, or a
    whole pitch: it is known but for whole pitches. The former is a point; the latter, deeper than all contact, is where
    teeth grow together at their roots.
    """

    first: np.ndarray
    last: np.ndarray
    share: np.ndarray

    @classmethod
    def on(cls, triangles, across, pitch):
        here, there = triangles.ravel(), np.roll(triangles, 1, axis=1).ravel()
        first, last = np.concatenate([here, there]), np.concatenate([there, here])
        begin = across[first] % pitch
        step = (across[last] - begin + pitch / 2) % pitch - pitch / 2
        with np.errstate(invalid="ignore"):
            crossed = (begin < STEEPEST * pitch) & (begin + step < 0.0) & (step > -STEEPEST * pitch)
        return cls(first[crossed], last[crossed], -begin[crossed] / step[crossed])

    def between(self, values):
        """Values of the places, where the angle is zero."""
        return values[self.first] + self.share * (values[self.last] - values[self.first])
