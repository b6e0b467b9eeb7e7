"""Two of a surface's parameters as coordinates of its points."""

from dataclasses import dataclass

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.flank.sections import solved
from meshwright.flank.surface import Flank


@dataclass(frozen=True)
class Chart:
    """Two of a surface's parameters as coordinates: ``free`` their numbers; the others follow from the surface's
    conditions, from values near ``start`` (k,). ``sizes`` (k,) are natural sizes.
    """

    flank: Flank
    free: tuple[int, int]
    sizes: np.ndarray

    @classmethod
    def at(cls, flank, start, sizes):
        """The chart that leaves out the parameter which the condition at ``start`` (k,) determines best."""
        k, slopes = len(start), flank(start).conditions[0, :, 1:]
        bound = set()
        for row in np.abs(slopes * sizes):
            bound.add(int(max((i for i in range(k) if i not in bound), key=lambda i: row[i])))
        free = tuple(i for i in range(k) if i not in bound)
        if len(free) != 2:
            raise UsageError(f"the {flank.region} of the {flank.body['name']} is no surface of two free parameters")
        return cls(flank, free, sizes)

    def complete(self, coordinates, start):
        """Parameters (N, k) at coordinates (N, 2), from nearby ones (N, k); NaN where there are none."""
        q = start.copy()
        q[:, self.free] = coordinates
        k = q.shape[1]
        if k == 2:
            return q
        factors = np.zeros((2, k + 4))
        factors[[0, 1], self.free] = 1.0
        return self.flank.places(factors, self.sizes, coordinates, q)

    def by_coordinates(self, found, slopes):
        """Slopes (N, L, 2) by the coordinates, conditions kept, of what has the slopes (N, L, k) by the parameters."""
        free, bound = list(self.free), [i for i in range(slopes.shape[2]) if i not in self.free]
        if not bound:
            return slopes[:, :, free]
        conditions = found.conditions[:, :, 1:]
        with np.errstate(divide="ignore", invalid="ignore"):
            follow = np.stack([solved(conditions[:, :, bound], conditions[:, :, i]) for i in free], axis=2)
        return slopes[:, :, free] - slopes[:, :, bound] @ follow
