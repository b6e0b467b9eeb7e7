"""What the flanks' room needs of a drive besides what contact does."""

from typing import Protocol, Self

from meshwright.contact.model import DriveModel as ContactModel
from meshwright.flank.region import Region
from meshwright.flank.surface import Flank
from meshwright.flank.uses import Uses


class DriveModel(ContactModel, Protocol):
    """A drive as its flanks see it."""

    @property
    def other_side(self) -> Self | None:
        """The drive of the same design whose flank is the other side of the teeth; None where a side has its own."""
        ...

    @property
    def uses(self) -> Uses:
        """What contact uses of the flanks."""
        ...

    def flank(self, member: str, region: str = "flank") -> Flank:
        """A surface of ``"pinion"`` or ``"wheel"``."""
        ...

    def region(self, member: str, name: str = "flank") -> Region:
        """A surface of a member with the limits that bound it."""
        ...
