"""Where contact uses the flanks, which is where their regions are looked for."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from meshwright.base.library import pointer
from meshwright.flank.surface import Flank

#: How far beyond what contact uses a surface goes where nothing in the design ends it and no more is asked for, in
#: natural sizes of its parameters.
BEYOND = 0.5


@dataclass(frozen=True)
class Uses:
    """Where contact uses the flanks: parameters (P, k) of each by member, and the natural sizes of its parameters by
    member (k,). ``edges`` gives further points (E, 3) of a member's flank in use, body frame. Where nothing ends a
    surface it goes ``beyond`` what is used by so many natural sizes. Right-hand drive. ``known`` are the regions
    found so far, by member and name.
    """

    places: dict[str, np.ndarray]
    sizes: dict[str, np.ndarray]
    edges: Callable[[str], np.ndarray]
    beyond: float
    known: dict = field(default_factory=dict, compare=False, repr=False)

    @classmethod
    def of(cls, drive, unknowns, edges=lambda member: np.empty((0, 3)), beyond=BEYOND):
        """From solutions (P, nx) of the drive's contact."""
        scale = np.empty(drive.model.nx)
        drive.model.scale(pointer(drive.state()), pointer(scale))
        bodies = drive.design.description["bodies"]
        return cls(
            {b["name"]: unknowns[:, b["unknowns"]] for b in bodies},
            {b["name"]: scale[b["unknowns"]] for b in bodies},
            edges,
            beyond,
        )

    def on(self, flank):
        """Places (P, k) and sizes (k,) in the parameters of a flank, or of another region of its member.

        Parameters that the flank lacks, such as a fillet's own, are 0 there and of size 1.
        """
        member = flank.body["name"]
        if member not in self.places:
            count = len(next(iter(self.places.values())))
            return np.zeros((count, len(flank.parameters))), np.ones(len(flank.parameters))
        names = list(Flank.of(flank.drive, member).parameters)
        places, sizes = self.places[member], self.sizes[member]
        column = [names.index(p) if p in names else None for p in flank.parameters]
        return (
            np.stack([np.zeros(len(places)) if c is None else places[:, c] for c in column], axis=1),
            np.array([1.0 if c is None else sizes[c] for c in column]),
        )
