"""A description that is refused."""


class DescriptionError(ValueError):
    """A description that contradicts itself; the message names the drive, the part and the remedy."""
