"""Generating tools: a function that makes a tool's surface, and the data of its own that the function needs.

A tool declares its data once, beside the geometry that uses them::

    CROWN = Datum("blade_crown_per_mm", "c", "crowning of the blade", default=0)

    @tool(CROWN)
    def crowned_blade(body, definitions): ... body[CROWN] ...

The family makes a design key of each for every body that the tool makes (see :meth:`Datum.parameter`); a design that
gives a key of a tool that it does not use is refused.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import sympy as sp

from derive.language.symbols import Parameter, Table, parameter


@dataclass(frozen=True)
class Datum:
    """A number that a tool needs to know, by its design key, before a body gives it a name.

    ``required``: no such tool without it. ``sample`` is its number, in the unit of the key, in the family's sample
    design. The rest as in :class:`~derive.language.symbols.Parameter`.
    """

    key: str
    symbol: str
    meaning: str
    domain: tuple = (-sp.oo, sp.oo)
    default: sp.Expr | None = None
    required: bool = False
    sample: object = None
    table: Table = Table.DESIGN
    lower_included: bool = False

    def parameter(self, body: str, prefix: str = "", required: bool | None = None) -> Parameter:
        """The design key of this datum for the tool of a body; ``prefix`` goes before the key."""
        return parameter(
            prefix + self.key,
            f"{self.symbol}_{body}",
            f"{self.meaning} of the {body}",
            table=self.table,
            domain=self.domain,
            default=self.default,
            required=self.required if required is None else required,
            lower_included=self.lower_included,
        )


@dataclass(frozen=True)
class Tool:
    """A tool: ``make(body, definitions)`` gives what the family wants of it, ``data`` are its own.

    ``title`` is the first line of the function's docstring or of its module's.
    """

    make: Callable
    data: tuple[Datum, ...] = ()

    def __call__(self, body, definitions):
        return self.make(body, definitions)

    @property
    def name(self):
        """The name of the function."""
        return self._function.__name__

    @property
    def title(self):
        """What the tool is, for readers."""
        return (self._function.__doc__ or "").strip().splitlines()[0]

    @property
    def sample(self):
        """Numbers of the data in the sample design, by key."""
        return {datum.key: datum.sample for datum in self.data if datum.sample is not None}

    @property
    def _function(self):
        return self.make.func if isinstance(self.make, partial) else self.make


def tool(*data: Datum):
    """Decorator: a function ``make(body, definitions)`` as a :class:`Tool` with these data."""

    def declare(make):
        return Tool(make, data)

    return declare
