"""Limits of a surface: functions of its points that are negative outside."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from meshwright.flank.sections import lengthwise, lengthwise_slopes
from meshwright.flank.surface import Flank, FlankPoints

#: Name of the limit where nothing in the design bounds the surface.
OPEN = "open"


@dataclass(frozen=True)
class Limit:
    """A limit by its name: functions of flank points to its ``values`` (N,), negative outside, and to their ``slopes``
    (N, k) by the parameters.
    """

    name: str
    values: Callable[[FlankPoints], np.ndarray]
    slopes: Callable[[FlankPoints], np.ndarray]


@dataclass(frozen=True)
class Limits:
    """Everything that bounds a surface: its own limits, and ``added`` ones."""

    flank: Flank
    added: tuple[Limit, ...] = ()

    @cached_property
    def names(self):
        """The limits' names, in the order of the columns of :meth:`values`."""
        return ("undercut", *(m["event"] for m in self.flank.body["margins"]), *(limit.name for limit in self.added))

    def values(self, found):
        """The limit functions (N, L) of flank points: +inf where a limit is left open, -inf where there is no point."""
        columns = [found.regular, *found.margins.values(), *(limit.values(found) for limit in self.added)]
        values = np.stack(columns, axis=1)
        values[np.isnan(values)] = np.inf
        values[~(np.isfinite(found.points).all(axis=1) & np.isfinite(found.normals).all(axis=1))] = -np.inf
        return values

    def slopes(self, found):
        """Slopes of the limit functions by the parameters (N, L, k) at flank points; not a number where one is open."""
        added = [limit.slopes(found)[:, None] for limit in self.added]
        return np.concatenate([self.flank.limit_slopes(found.parameters), *added], axis=1)

    def least(self, found):
        """The smallest limit function (N,)."""
        return self.values(found).min(axis=1)

    def with_(self, *more):
        """These and other ones."""
        return replace(self, added=(*self.added, *more))


def lengthwise_end(name, flank, sign, end):
    """The :class:`Limit` of how far points are from an end of the tooth."""
    return Limit(
        name,
        lambda found: sign * (lengthwise(flank, found) - end),
        lambda found: sign * lengthwise_slopes(flank, found),
    )


def parameter_end(number, sign, end):
    """The :class:`Limit` of how far a parameter, times a sign, is from an end."""

    def slopes(found):
        by_parameters = np.zeros(found.parameters.shape)
        by_parameters[:, number] = -sign
        return by_parameters

    return Limit(OPEN, lambda found: end - sign * found.parameters[:, number], slopes)
