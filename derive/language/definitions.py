"""Named intermediate results: an ordered list ``symbol = expression`` with total derivatives by the chain rule.

Long formulae stay readable (and short) because a part that has a meaning gets a name. Definitions may use
earlier definitions; differentiation follows them.
"""

import sympy as sp

from derive.language.differentiate import partial
from derive.language.replace import replaced
from derive.language.symbols import Quantity


class Definitions:
    """An ordered, append-only table of named expressions."""

    def __init__(self):
        self._values = {}
        self._derivatives = {}
        self._origins = {}
        self._equations = {}

    def __getitem__(self, symbol):
        return self._values[symbol]

    def __contains__(self, symbol):
        return symbol in self._values

    def items(self):
        return self._values.items()

    def origin(self, symbol):
        """The :class:`~derive.language.origin.Origin` given with a name, or None."""
        return self._origins.get(symbol)

    def solves(self, symbol, equation, slope):
        """A name is the solution of ``equation`` = 0, an expression of the name with this derivative by it."""
        self._equations[symbol] = equation, slope

    def equations(self):
        """(name, equation, slope) of every name that solves an equation."""
        return tuple((symbol, *rest) for symbol, rest in self._equations.items())

    def let(self, name, value, meaning="", unit="", frame="", origin=None, parity=1):
        """Name a value; numbers and single symbols need no name and are returned as they are.

        ``origin`` says which statement of the record tells where the value exists, ``parity`` what a mirror image does
        to the value (see :class:`~derive.language.symbols.Quantity`).
        """
        value = sp.sympify(value)
        if value.is_Number or value.is_Symbol:
            return value
        symbol = Quantity(name, unit, meaning, frame, parity=parity)
        known = self._values.setdefault(symbol, value)
        if known != value:
            raise ValueError(f"the name {name!r} is already used for another expression")
        self._origins.setdefault(symbol, origin)
        return symbol

    def let_vector(self, name, value, meaning="", unit="", frame="", origin=None):
        """Name the three components of a vector ``name_x``, ``name_y``, ``name_z``."""
        return tuple(
            self.let(f"{name}_{axis}", component, meaning, unit, frame, origin)
            for axis, component in zip("xyz", value, strict=True)
        )

    def derivative(self, expression, variable):
        """Total derivative by ``variable``, following definitions."""
        expression = sp.sympify(expression)
        total = partial(expression, variable)
        for symbol in sorted(expression.free_symbols & self._values.keys(), key=str):
            inner = self._derivative_of(symbol, variable)
            if inner != 0:
                total += partial(expression, symbol) * inner
        return total

    def derivative_vector(self, vector, variable):
        return tuple(self.derivative(c, variable) for c in vector)

    def resolve(self, expression):
        """The expression with every definition put in, down to symbols that have none."""
        expression = sp.sympify(expression)
        while known := expression.free_symbols & self._values.keys():
            expression = replaced(expression, {symbol: self._values[symbol] for symbol in known})
        return expression

    def free(self, expression):
        """The symbols without a definition on which the expression depends."""
        open_, seen = set(sp.sympify(expression).free_symbols), set()
        while named := {s for s in open_ if s in self._values}:
            seen |= named
            inner = set().union(*(self._values[s].free_symbols for s in named))
            open_ = (open_ - named) | (inner - seen)
        return open_

    def depends(self, expression, variable):
        """Whether the expression contains the variable, directly or through definitions."""
        symbols = sp.sympify(expression).free_symbols
        return variable in symbols or any(
            self.depends(self._values[s], variable) for s in symbols & self._values.keys()
        )

    def _derivative_of(self, symbol, variable):
        key = symbol, variable
        if key not in self._derivatives:
            value = self.derivative(self._values[symbol], variable)
            self._derivatives[key] = self.let(f"{symbol}_{variable}", value, origin=self.origin(symbol))
        return self._derivatives[key]
