"""Named intermediate results: an ordered list ``symbol = expression`` with total derivatives by the chain rule.

Long formulae stay readable (and short) because a part that has a meaning gets a name. Definitions may use
earlier definitions; differentiation follows them.
"""


import sympy as sp

from derive.language.differentiate import partial
from derive.language.origin import Origin
from derive.language.replace import replaced
from derive.language.symbols import Quantity
from derive.language.vectors import Number, Vector


class Definitions:
    """An ordered, append-only table of named expressions."""

    def __init__(self) -> None:
        self._symbols: list[Quantity] = []
        self._values: dict[sp.Symbol, sp.Expr] = {}
        self._read: dict[sp.Symbol, set[sp.Symbol]] = {}
        self._derivatives: dict[tuple[sp.Symbol, sp.Symbol], sp.Expr] = {}
        self._origins: dict[sp.Symbol, Origin | None] = {}
        self._equations: dict[sp.Expr, tuple[sp.Expr, sp.Expr]] = {}

    def __getitem__(self, symbol: sp.Symbol) -> sp.Expr:
        return self._values[symbol]

    def __contains__(self, symbol: sp.Expr) -> bool:
        return symbol in self._values

    def items(self) -> list[tuple[Quantity, sp.Expr]]:
        return [(symbol, self._values[symbol]) for symbol in self._symbols]

    def origin(self, symbol: sp.Symbol) -> Origin | None:
        """The :class:`~derive.language.origin.Origin` given with a name, or None."""
        return self._origins.get(symbol)

    def solves(self, symbol: sp.Expr, equation: sp.Expr, slope: sp.Expr) -> None:
        """A name is the solution of ``equation`` = 0, an expression of the name with this derivative by it."""
        self._equations[symbol] = equation, slope

    def equations(self) -> tuple[tuple[sp.Expr, sp.Expr, sp.Expr], ...]:
        """(name, equation, slope) of every name that solves an equation."""
        return tuple((symbol, *rest) for symbol, rest in self._equations.items())

    def let(
        self,
        name: str,
        value: Number,
        meaning: str = "",
        unit: str = "",
        frame: str = "",
        origin: Origin | None = None,
        parity: int = 1,
    ) -> sp.Expr:
        """Name a value; numbers and single symbols need no name and are returned as they are.

        ``origin`` says which statement of the record tells where the value exists, ``parity`` what a mirror image does
        to the value (see :class:`~derive.language.symbols.Quantity`).
        """
        expression = sp.sympify(value)
        if isinstance(expression, sp.Number | sp.Symbol):
            return expression
        symbol = Quantity(name, unit, meaning, frame, parity=parity)
        if symbol not in self._values:
            self._symbols.append(symbol)
        known = self._values.setdefault(symbol, expression)
        if known != expression:
            raise ValueError(f"the name {name!r} is already used for another expression")
        self._origins.setdefault(symbol, origin)
        return symbol

    def let_vector(
        self,
        name: str,
        value: Vector,
        meaning: str = "",
        unit: str = "",
        frame: str = "",
        origin: Origin | None = None,
    ) -> Vector:
        """Name the three components of a vector ``name_x``, ``name_y``, ``name_z``."""
        return tuple(
            self.let(f"{name}_{axis}", component, meaning, unit, frame, origin)
            for axis, component in zip("xyz", value, strict=True)
        )

    def derivative(self, expression: Number, variable: sp.Symbol) -> sp.Expr:
        """Total derivative by ``variable``, following definitions."""
        whole = sp.sympify(expression)
        total = partial(whole, variable)
        for symbol in sorted(whole.free_symbols & self._values.keys(), key=str):
            inner = self._derivative_of(symbol, variable)
            if inner != 0:
                total += partial(whole, symbol) * inner
        return total

    def derivative_vector(self, vector: Vector, variable: sp.Symbol) -> Vector:
        return tuple(self.derivative(c, variable) for c in vector)

    def resolve(self, expression: Number) -> sp.Expr:
        """The expression with every definition put in, down to symbols that have none."""
        resolved = sp.sympify(expression)
        while known := resolved.free_symbols & self._values.keys():
            resolved = replaced(resolved, {symbol: self._values[symbol] for symbol in known})
        return resolved

    def free(self, expression: Number) -> set[sp.Symbol]:
        """The symbols without a definition on which the expression depends."""
        open_ = set(sp.sympify(expression).free_symbols)
        seen: set[sp.Symbol] = set()
        while named := {s for s in open_ if s in self._values}:
            seen |= named
            inner = {q for s in named for q in self._symbols_of(s)}
            open_ = (open_ - named) | (inner - seen)
        return open_

    def _symbols_of(self, symbol: sp.Symbol) -> set[sp.Symbol]:
        """The symbols in what a name stands for."""
        if symbol not in self._read:
            self._read[symbol] = self._values[symbol].free_symbols
        return self._read[symbol]

    def depends(self, expression: Number, variable: sp.Symbol) -> bool:
        """Whether the expression contains the variable, directly or through definitions."""
        symbols = sp.sympify(expression).free_symbols
        return variable in symbols or any(
            self.depends(self._values[s], variable) for s in symbols & self._values.keys()
        )

    def _derivative_of(self, symbol: sp.Symbol, variable: sp.Symbol) -> sp.Expr:
        key = symbol, variable
        if key not in self._derivatives:
            value = self.derivative(self._values[symbol], variable)
            self._derivatives[key] = self.let(f"{symbol}_{variable}", value, origin=self.origin(symbol))
        return self._derivatives[key]
