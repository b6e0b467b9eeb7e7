"""The hand of a design: every drive is solved as it is described, and its mirror image y → −y is read from that."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Mirror:
    """What the hand of a design makes of the numbers of the drive that is solved, and back.

    ``sign`` is −1 for the mirror image: the factor of angles of rotation and of the transmission error. ``negated``
    are the names of the quantities that the mirror image negates, as the drive's description says.
    """

    sign: float
    negated: frozenset[str]

    @classmethod
    def of(cls, description, mirrored):
        """The mirror image, or the drive as it is."""
        negated = (name for name, q in description["quantities"].items() if q["parity"] < 0)
        return cls(-1.0 if mirrored else 1.0, frozenset(negated))

    @property
    def flip(self):
        """Factors (3,) of the coordinates of a point or direction, in any frame."""
        return np.array([1.0, self.sign, 1.0])

    def placements(self, matrices):
        """Placements (…, 4, 4) of bodies of the mirror image, from those of the bodies, or the other way."""
        flip = np.append(self.flip, 1.0)
        return flip[:, None] * matrices * flip

    def factor(self, name):
        """Factor of a quantity by its name."""
        return self.sign if name in self.negated else 1.0

    def numbers(self, values):
        """Quantities by name, of the drive that the design describes."""
        return {name: self.factor(name) * value for name, value in values.items()}
