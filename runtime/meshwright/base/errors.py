"""Errors that a user can act on."""

import reprlib

_LONGEST_KEY = 120
_SHORT = reprlib.Repr()
_SHORT.maxstring = _SHORT.maxother = _SHORT.maxlong = 60


def plain(text):
    """Text without control characters, which a terminal would obey: each as an escape of Python's."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)


class DesignError(ValueError):
    """A design that cannot be solved: names the key, the value, the reason and the remedy."""

    def __init__(self, key, value, reason, remedy):
        self.key, self.value, self.reason, self.remedy = key, value, reason, remedy
        shown = "" if value is None else f" = {_SHORT.repr(value)}"
        place = key if len(key) <= _LONGEST_KEY else f"{key[:_LONGEST_KEY]}…"
        super().__init__(plain(f"{place}{shown}: {reason}; {remedy}"))


class UsageError(ValueError):
    """A command line that cannot be run."""


class LibraryError(RuntimeError):
    """A compiled library is missing, cannot be made or does not fit this package."""
