"""The path of contact of one tooth pair: the branch of solutions through the start angle, over the input angle.

Right-hand drive throughout, whatever the design's hand; callers mirror what they show.
"""

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from meshwright.base.library import ffi, library, pointer, text
from meshwright.contact.analysis import analyse
from meshwright.contact.model import DriveModel

#: Spacing of the stored solutions as a share of the pitch.
NODES_PER_PITCH = 16

#: Where a path is looked for to either side of the reference angle, in pitches: errors may have moved it far away.
TRIED = np.array([*np.arange(9) / 8.0, 2.0, 4.0, 8.0])

#: A path that ends in a fold is followed up to this part of a pitch before it, and what is between counts as its end.
SHORT_OF_FOLD = 1e-6


@dataclass(frozen=True)
class Path:
    """Solutions ``unknowns`` (N, nx) at ascending input ``angles`` (N,), all on one branch.

    ``ended`` are the status words of what stopped the branch below and above; "" where the search stopped.
    """

    drive: DriveModel
    angles: np.ndarray
    unknowns: np.ndarray
    ended: tuple[str, str] = ("", "")
    state: np.ndarray | None = field(default=None, repr=False)

    @property
    def spacing(self):
        """Largest spacing of neighbouring solutions, rad."""
        return self.drive.pitch() / NODES_PER_PITCH

    @classmethod
    def through(cls, drive, angle, unknowns):
        """The path that so far is one solution."""
        return cls(drive, np.array([angle]), np.array([unknowns]), state=drive.state())

    @classmethod
    def start(cls, drive):
        """The path through the first solvable angle of :data:`TRIED`, None if there is none; and a status word."""
        tried, reference = TRIED * drive.pitch(), drive.design.reference_angle
        angles = reference + np.stack([tried, -tried], axis=1).ravel()[1:]
        first = None
        for part in (angles[:1], angles[1:]):  # nearly always the first angle is enough
            found = analyse(drive, drive.design.mirror.sign * part)
            for angle, status, unknowns in zip(part, found.status, found.solutions, strict=True):
                if status == "converged":
                    return cls.through(drive, angle, unknowns), status
                if status == "line_contact":
                    return None, status
                first = first or status
        return None, first

    def extended(self, to):
        """The path continued to the input angle ``to``, or as far towards it as the branch goes."""
        up = bool(to > self.angles[-1])
        first = self.angles[-1] if up else self.angles[0]
        count = max(1, math.ceil(abs(to - first) / self.spacing))
        wanted = np.linspace(first, to, count + 1)[1:]
        x, word = self._follow(first, self.unknowns[-1 if up else 0], wanted)
        wanted, ended = wanted[: len(x)], list(self.ended)
        ended[up] = word
        order = slice(None) if up else slice(None, None, -1)
        parts = [(self.angles, self.unknowns), (wanted[order], x[order])]
        if not up:
            parts.reverse()
        angles, unknowns = (np.concatenate(arrays) for arrays in zip(*parts, strict=True))
        return Path(self.drive, angles, unknowns, tuple(ended), self.state)

    def _follow(self, angle, unknowns, wanted):
        """Solutions along ``wanted`` as far as the branch goes, and the status word of what stopped it."""
        model = self.drive.model
        x, records = np.empty((len(wanted), model.nx)), ffi.new("mw_info[]", len(wanted))
        wanted, unknowns = np.ascontiguousarray(wanted), np.ascontiguousarray(unknowns)
        solved = library().mw_follow(
            model, pointer(self.state), angle, pointer(unknowns), pointer(wanted), len(wanted), pointer(x), records
        )
        word = "" if solved == len(wanted) else text(library().mw_status_word(records[solved].status))
        return x[:solved], word

    def solve(self, angles):
        """Unknowns (M, nx) at input angles (M,) in any order; NaN beyond the ends of the path."""
        angles = self._reached(np.atleast_1d(np.asarray(angles, dtype=float)))
        nodes = np.clip(np.searchsorted(self.angles, angles), 1, len(self.angles)) - 1
        nodes[~((self.angles[0] <= angles) & (angles <= self.angles[-1]))] = -1
        model, solved = self.drive.model, np.empty((len(angles), self.unknowns.shape[1]))
        library().mw_from_nodes(
            model, pointer(self.state), pointer(np.ascontiguousarray(self.angles)),
            pointer(np.ascontiguousarray(self.unknowns)), len(self.angles), pointer(nodes.astype(np.int32), "int[]"),
            pointer(angles), len(angles), pointer(solved), ffi.new("mw_info[]", len(angles)),
        )  # fmt: skip
        return solved

    def _reached(self, angles):
        """The angles; those hardly beyond an end of the path are that end."""
        nearest = np.clip(angles, self.angles[0], self.angles[-1])
        return np.where(np.abs(angles - nearest) <= 2.0 * SHORT_OF_FOLD * self.drive.pitch(), nearest, angles)

    def errors(self, angles):
        """Transmission error, rad, at input angles (M,)."""
        return self.solve(angles)[:, self.error_index]

    def observe(self, angles, unknowns=None):
        """Observations (M, no) at input angles, of the solutions there unless other unknowns are given."""
        angles = np.atleast_1d(np.asarray(angles, dtype=float))
        unknowns = self.solve(angles) if unknowns is None else unknowns
        angles, unknowns = np.ascontiguousarray(angles), np.ascontiguousarray(unknowns)
        observed = np.empty((len(angles), self.drive.model.no))
        library().mw_observe(
            self.drive.model, pointer(self.state), pointer(angles), pointer(unknowns), len(angles), pointer(observed)
        )
        return observed

    def levers(self, angles):
        """Signed lever of the wheel, mm: how the wheel's flank moves along the contact normal with the wheel angle.

        The normal points out of the pinion: with a positive lever the gap grows with the wheel angle.
        """
        return self._observed("lever_arm_wheel", angles)

    def error_slopes(self, angles):
        """d(transmission error)/d(input angle): the flanks' points move alike along the common normal."""
        return self._observed("instantaneous_ratio", angles) - self.drive.ratio

    def _observed(self, name, angles):
        """A named number of the observation at input angles: (M,)."""
        outputs = self.drive.design.description["outputs"]
        return self.observe(angles)[:, next(o["offset"] for o in outputs if o["name"] == name)]

    @cached_property
    def error_index(self):
        """Which unknown is the transmission error."""
        return self.drive.design.description["error"]
