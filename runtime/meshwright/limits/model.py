"""What the limits need of a drive besides what its flanks do."""

from typing import Protocol

from meshwright.contact.functions import Function
from meshwright.flank.model import DriveModel as FlankModel


class DriveModel(FlankModel, Protocol):
    """A drive with the functions that are generated beside its contact."""

    def function(self, name: str) -> Function:
        """A generated function by name."""
        ...
