"""Errors that a user can act on."""


class DesignError(ValueError):
    """A design that cannot be solved: names the key, the value, the reason and the remedy."""

    def __init__(self, key, value, reason, remedy):
        self.key, self.value, self.reason, self.remedy = key, value, reason, remedy
        shown = "" if value is None else f" = {value!r}"
        super().__init__(f"{key}{shown}: {reason}; {remedy}")


class UsageError(ValueError):
    """A command line that cannot be run."""


class LibraryError(RuntimeError):
    """A compiled library is missing, cannot be made or does not fit this package."""
