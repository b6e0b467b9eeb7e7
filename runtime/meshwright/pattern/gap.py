"""The gap between two flanks near contacts, over the tangent planes: right-hand drive, fixed frame.

Both flanks are met by the line through a point of the tangent plane along the contact normal; what lies between
the two is the separation. Vectorised over N points, each in the plane of its own contact.
"""

from dataclasses import dataclass

import numpy as np

from meshwright.contact.placement import placements_at


@dataclass(frozen=True)
class Side:
    """One member's flank, placed for each point: ``matrix`` (N, 4, 4) from the body to the fixed frame."""

    flank: object
    matrix: np.ndarray

    def at(self, parameters):
        """Flank points, and where they are in the fixed frame (N, 3)."""
        found = self.flank(parameters)
        return found, np.matmul(self.matrix[:, :3, :3], found.points[:, :, None])[:, :, 0] + self.matrix[:, :3, 3]

    def over(self, plane, places, start):
        """Parameters (N, k) of the flank, from nearby ones (N, k), at ``places`` (N, 2): lengths along two unit vectors
        ``plane`` (N, 2, 3), fixed frame, from its origin. NaN where Newton's method finds none.
        """
        n, k = start.shape
        factors = np.zeros((n, 2, k + 4))
        factors[:, :, k : k + 3] = np.matmul(plane, self.matrix[:, :3, :3])
        values = places - np.matmul(plane, self.matrix[:, :3, 3, None])[:, :, 0]
        return self.flank.places(factors, self.flank.sizes, values, start)

    def only(self, chosen):
        """The same for the chosen points."""
        return Side(self.flank, self.matrix[chosen])


@dataclass(frozen=True)
class Gap:
    """Two flanks in contact at ``point`` (N, 3); ``axes`` (N, 3, 3) by rows: two tangents, normal out of the pinion.

    ``parameters`` (N, k) are those of each member's flank at the contact.
    """

    point: np.ndarray
    axes: np.ndarray
    sides: tuple[Side, Side]
    parameters: tuple[np.ndarray, np.ndarray]

    @classmethod
    def at(cls, drive, angles, unknowns, points, normals, majors):
        """The gap at solved contacts (N,), of the right-hand drive; the same contact may stand there many times."""
        placed = placements_at(drive, angles, unknowns).matrices
        bodies = drive.design.description["bodies"]
        return cls(
            points,
            np.stack([majors, np.cross(normals, majors), normals], axis=1),
            tuple(Side(drive.flank(b["name"]), placed[b["name"]]) for b in bodies),
            tuple(unknowns[:, b["unknowns"]] for b in bodies),
        )

    def only(self, chosen):
        """The same for the chosen points."""
        sides, parameters = (part.only(chosen) for part in self.sides), (q[chosen] for q in self.parameters)
        return Gap(self.point[chosen], self.axes[chosen], tuple(sides), tuple(parameters))

    def separations(self, places, starts):
        """Where the flanks stand over ``places`` (N, 2) of the tangent planes, from parameters (N, k) of each near
        there: :class:`Sections`.
        """
        found = [self._over(k, places, start) for k, start in enumerate(starts)]
        heights = [f[1] for f in found]
        return Sections(
            np.asarray(places), heights[1] - heights[0], tuple(f[0] for f in found),
            np.fmin(found[0][2], found[1][2]),
        )  # fmt: skip

    def _over(self, k, places, start):
        """Parameters (N, k), height along the normal (N,) and smallest margin (N,) of one flank over places."""
        side, plane = self.sides[k], self.axes[:, :2]
        q = side.over(plane, places + np.matmul(plane, self.point[:, :, None])[:, :, 0], start)
        found, points = side.at(q)
        heights = np.einsum("ni,ni->n", points - self.point, self.axes[:, 2])
        return q, heights, np.where(np.isfinite(heights), smallest_margin(found), -np.inf)


@dataclass(frozen=True)
class Sections:
    """Both flanks over N ``places`` of the tangent plane: ``separation`` (N,), mm, NaN where a flank does not reach;
    ``parameters`` of each flank, (N, k); ``margin`` (N,), negative where either flank has ended.
    """

    places: np.ndarray
    separation: np.ndarray
    parameters: tuple[np.ndarray, np.ndarray]
    margin: np.ndarray


def smallest_margin(found):
    """The smallest limit function of flank points, (N,); limits that the design leaves open do not count."""
    values = np.stack([found.regular, *found.margins.values()])
    return np.where(np.isnan(values), np.inf, values).min(axis=0)
