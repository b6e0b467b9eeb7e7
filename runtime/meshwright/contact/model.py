"""What contact needs of a drive: a checked design and the model that solves it."""

from typing import Any, Protocol, Self

import numpy as np
from numpy.typing import ArrayLike

from meshwright.contact.results import TCA
from meshwright.design.design import Design


class DriveModel(Protocol):
    """A drive as contact sees it; a room above declares what it needs besides. :class:`~meshwright.drive.Drive` is one
    for every room.

    Angles in rad, lengths in mm.
    """

    @property
    def design(self) -> Design:
        """The checked design."""
        ...

    @property
    def model(self) -> Any:  # noqa: ANN401  cffi has no type for a pointer to a structure
        """The model table of mw_model.h."""

    @property
    def ratio(self) -> float:
        """Wheel turns per pinion turn."""
        ...

    def teeth(self, member: str) -> int:
        """Teeth of ``"pinion"`` or ``"wheel"``."""
        ...

    def pitch(self) -> float:
        """Pinion angle from one tooth pair to the next."""
        ...

    @property
    def past_the_tips(self) -> bool:
        """Whether the teeth do not reach each other at any angle."""
        ...

    def about_the_middle(self, pitches: ArrayLike) -> np.ndarray:
        """Pinion angles so many pitches from the one to which relative errors refer."""
        ...

    def state(self, angle: float = 0.0) -> np.ndarray:
        """The model's state for this design at an input angle."""
        ...

    def trace(self, angles: ArrayLike) -> tuple[np.ndarray, list[str]]:
        """Unknowns (N, nx) and status words at input angles (N,)."""
        ...

    def tca(self, angles: ArrayLike) -> TCA:
        """Tooth contact analysis at pinion angles (N,), in any order."""
        ...

    def with_(self, **tables: object) -> Self:
        """The drive with keys of its design changed."""
        ...

    def of_design(self, design: Design) -> Self:
        """The drive of another checked design."""
        ...
