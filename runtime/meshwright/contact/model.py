"""What the rooms below the façade know of a drive: a checked design, the model that solves it, and its contacts."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol, Self

import numpy as np
from numpy.typing import ArrayLike

from meshwright.contact.results import TCA
from meshwright.design.design import Design

if TYPE_CHECKING:
    from meshwright.contact.certificate import EnclosedDesign
    from meshwright.contact.functions import Function
    from meshwright.cycle.first_contact import SearchedFlank
    from meshwright.cycle.path import Path
    from meshwright.cycle.windows import Window
    from meshwright.flank.region import Region
    from meshwright.flank.surface import Flank
    from meshwright.flank.uses import Uses


class DriveModel(Protocol):
    """A drive as contact, flanks, cycle, pattern and limits see it; :class:`~meshwright.drive.Drive` is one.

    Angles in rad, lengths in mm.
    """

    @property
    def design(self) -> Design:
        """The checked design."""
        ...

    @property
    def backend(self) -> str:
        """What evaluates the equations: "c" or "casadi"."""
        ...

    @property
    def model(self) -> Any:  # noqa: ANN401  cffi has no type for a pointer to a structure
        """The model table of mw_model.h."""

    @property
    def ratio(self) -> float:
        """Wheel turns per pinion turn."""
        ...

    def pitch(self) -> float:
        """Pinion angle from one tooth pair to the next."""
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

    def flank(self, member: str, region: str = "flank") -> Flank:
        """A surface of ``"pinion"`` or ``"wheel"``."""
        ...

    def function(self, name: str) -> Function:
        """A generated function by name."""
        ...

    @property
    def enclosed(self) -> EnclosedDesign:
        """The design's state, enclosed."""
        ...

    def with_(self, **tables: object) -> Self:
        """The drive with keys of its design changed."""
        ...

    def of_design(self, design: Design) -> Self:
        """The drive of another checked design."""
        ...

    @property
    def other_side(self) -> Self | None:
        """The drive of the same design whose flank is the other side of the teeth; None where a side has its own."""
        ...

    def teeth(self, member: str) -> int:
        """Teeth of ``"pinion"`` or ``"wheel"``."""
        ...

    # what a room has found of the drive, and the drive keeps

    @property
    def path_start(self) -> tuple[Path | None, str]:
        """The path of contact of a tooth pair as far as its first solution, and a status word."""
        ...

    @property
    def window(self) -> Window:
        """Contact of one tooth pair from begin to end."""
        ...

    @property
    def searched_flank(self) -> SearchedFlank | None:
        """The wheel's flank about the contacts in the middle."""
        ...

    @property
    def uses(self) -> Uses:
        """What contact uses of the flanks."""
        ...

    def region(self, member: str, name: str = "flank") -> Region:
        """A surface of a member with the limits that bound it."""
        ...
