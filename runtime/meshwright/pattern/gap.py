"""The gap between two flanks near contacts, over the tangent planes: right-hand drive, fixed frame.

Both flanks are met by the line through a point of the tangent plane along the contact normal; what lies between
the two is the separation. Vectorised over N points, each in the plane of its own contact.
"""

from contextlib import suppress
from dataclasses import dataclass

import numpy as np

from meshwright.contact.placement import placements_at

MAX_STEPS = 24

#: Newton steps below this length are done, mm; smaller than the second they may also stagnate in round-off.
STEP_DONE = 1e-11
STEP_NOISE = 1e-8

#: No point moves further at once, mm.
STEP_LIMIT = 8.0


@dataclass(frozen=True)
class Side:
    """One member's flank, placed for each point: ``matrix`` (N, 4, 4) from the body to the fixed frame."""

    flank: object
    matrix: np.ndarray

    def at(self, parameters):
        """Flank points with points, tangents in the fixed frame: (FlankPoints, points (N, 3), tangents (N, k, 3))."""
        found = self.flank(parameters)
        turned, origin = np.swapaxes(self.matrix[:, :3, :3], 1, 2), self.matrix[:, :3, 3]
        points = np.matmul(found.points[:, None], turned)[:, 0] + origin
        return found, points, np.matmul(found.tangents, turned)

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
        side, q = self.sides[k], start.copy()
        going, before = np.arange(len(q)), np.full(len(q), np.inf)
        for _ in range(MAX_STEPS):
            plane, at = self.axes[going, :2], q[going]
            found, points, tangents = side.only(going).at(at)
            misses = np.matmul(plane, (points - self.point[going])[:, :, None])[:, :, 0] - places[going]
            step, size = _newton_step(found, misses, tangents, plane)
            q[going] = at - step
            done = (size < STEP_DONE) | ((size < STEP_NOISE) & (size > 0.5 * before[going]))
            before[going] = size
            going = going[~done]
            if not len(going):
                break
        found, points, _ = side.at(q)
        heights = np.einsum("ni,ni->n", points - self.point, self.axes[:, 2])
        lost = ~np.isfinite(heights)
        lost[going] = True
        return q, np.where(lost, np.nan, heights), np.where(lost, -np.inf, smallest_margin(found))


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


def _newton_step(found, misses, tangents, plane):
    """Step of the parameters (N, k) that cancels the misses in the ``plane`` (N, 2, 3), (N, 2), and the flank's own
    conditions, and its length, mm.
    """
    residual = np.concatenate([misses, found.conditions[:, :, 0]], axis=1)
    slopes = np.matmul(plane, np.swapaxes(tangents, 1, 2))
    matrix = np.concatenate([slopes, found.conditions[:, :, 1:]], axis=1)
    step = _solved(matrix, residual)
    length = np.linalg.norm(np.matmul(step[:, None], tangents)[:, 0], axis=1)
    limit = np.minimum(1.0, STEP_LIMIT / np.maximum(length, 1e-300))
    return step * limit[:, None], length


def _solved(matrix, residual):
    """Solutions (N, k) of N systems; NaN where one is singular or not finite."""
    if np.isfinite(matrix).all():
        with suppress(np.linalg.LinAlgError):
            return np.linalg.solve(matrix, residual[:, :, None])[:, :, 0]
    good = np.isfinite(matrix).all(axis=(1, 2)) & (np.abs(np.linalg.det(np.nan_to_num(matrix))) > 0.0)
    step = np.full((len(residual), matrix.shape[2]), np.nan)
    step[good] = np.linalg.solve(matrix[good], residual[good][:, :, None])[:, :, 0]
    return step
