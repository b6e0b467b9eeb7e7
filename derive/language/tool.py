"""Generating tools: a function that makes a tool's surface, and the data of its own that the function needs.

A tool declares its data once, beside the geometry that uses them::

    CROWN = Datum("blade_crown_per_mm", "c", "crowning of the blade", default=0)

    @tool(CROWN)
    def crowned_blade(body, definitions): ... body[CROWN] ...

The family makes a design key of each for every body that the tool makes (see :meth:`Datum.parameter`); a design that
gives a key of a tool that it does not use is refused.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import partial
from inspect import getmodule
from typing import Any, cast

import sympy as sp

from derive.language.definitions import Definitions
from derive.language.outline import Suggestion
from derive.language.symbols import Domain, Parameter, Table, parameter
from derive.language.vectors import Number


@dataclass(frozen=True)
class Datum:
    """A number that a tool needs to know, by its design key, before a body gives it a name.

    ``required``: no such tool without it. ``sample`` is its number, in the unit of the key, in the family's sample
    design. ``suggested`` is what a first design takes, in terms of its options (:mod:`derive.language.outline`) and
    rounded to so many ``decimals``, and ``why``; by default a tool that must know takes the sample's. The rest as in
    :class:`~derive.language.symbols.Parameter`.
    """

    key: str
    symbol: str
    meaning: str
    domain: Domain = (-sp.oo, sp.oo)
    default: Number | None = None
    required: bool = False
    sample: float | int | str | None = None
    table: Table = Table.DESIGN
    lower_included: bool = False
    suggested: Number | None = None
    why: str = ""
    decimals: int | None = None

    def suggestion(self) -> Suggestion | None:
        """What a first design takes of this datum; None where it leaves it open."""
        number = self.sample if self.suggested is None and self.required else self.suggested
        if number is None:
            return None
        exact = sp.Rational(str(number)) if isinstance(number, str | float) else sp.sympify(number)
        return Suggestion(f"{self.table}.{self.key}", (exact,), self.why, decimals=self.decimals)

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

    ``title`` is the first line of the function's docstring or of its module's, else the function's name.
    """

    make: Callable[..., Any]
    data: tuple[Datum, ...] = ()

    def __call__(self, body: Any, definitions: Definitions) -> Any:  # noqa: ANN401  what family and tool agree on
        return self.make(body, definitions)

    @property
    def name(self) -> str:
        """The name of the function."""
        return self._function.__name__

    @property
    def title(self) -> str:
        """What the tool is, for readers."""
        texts = (self._function.__doc__, getattr(getmodule(self._function), "__doc__", None), self.name)
        return next(filter(None, texts)).strip().splitlines()[0]

    @property
    def sample(self) -> dict[str, float | int | str]:
        """Numbers of the data in the sample design, by key."""
        return {datum.key: datum.sample for datum in self.data if datum.sample is not None}

    @property
    def _function(self) -> Callable[..., Any]:
        return cast("partial[Any]", self.make).func if isinstance(self.make, partial) else self.make


def suggestions(tools: Iterable[Tool]) -> tuple[Suggestion, ...]:
    """What a first design takes of the data of tools, each once."""
    data = {datum.key: datum for tool in tools for datum in tool.data}
    return tuple(found for datum in data.values() if (found := datum.suggestion()))


def tool(*data: Datum) -> Callable[[Callable[..., Any]], Tool]:
    """Decorator: a function ``make(body, definitions)`` as a :class:`Tool` with these data."""

    def declare(make: Callable[..., Any]) -> Tool:
        return Tool(make, data)

    return declare
