"""What the cycle of a tooth pair needs of a drive besides what its flanks and proofs of contact do."""

from typing import Protocol

from meshwright.contact.certificate import ProvedModel
from meshwright.cycle.path import Path
from meshwright.cycle.searched_flank import SearchedFlank
from meshwright.cycle.windows import Window
from meshwright.flank.model import DriveModel as FlankModel


class DriveModel(FlankModel, ProvedModel, Protocol):
    """A drive with what has been found of its contact and the drive keeps."""

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
