"""SymPy expressions as trees. Structure is kept as SymPy holds it; nothing is expanded or simplified."""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp

from derive.prove.angles import linear_form
from derive.prove.tree import NotationError, Tree

FUNCTIONS = {sp.sin: "sin", sp.cos: "cos", sp.tan: "tan"}


class Translator:
    """Translates expressions that share a table of definitions.

    An angle that is no rational combination of symbols gets a name of its own, which joins the definitions.
    """

    def __init__(self, definitions: Mapping[sp.Symbol, sp.Expr] | None = None):
        self.definitions: dict[str, Tree] = {}
        for symbol, value in (definitions or {}).items():
            self.definitions[symbol.name] = self(value)

    def __call__(self, expression: sp.Expr | int) -> Tree:
        expression = sp.sympify(expression)
        match expression:
            case sp.Integer():
                return _integer(int(expression))
            case sp.Rational():
                return ("/", _integer(int(expression.p)), int(expression.q))
            case sp.Symbol():
                return expression.name
            case sp.Add():
                return ("+", *map(self, expression.args))
            case sp.Mul():
                return self._product(expression)
            case sp.Pow():
                return self._power(*expression.args)
            case _ if expression == sp.pi:
                return "pi"
            case sp.atan2():
                return ("atan2", *map(self, expression.args))
            case _ if type(expression) in FUNCTIONS:
                return (FUNCTIONS[type(expression)], self._angle(expression.args[0]))
        raise NotationError(f"{type(expression).__name__} has no place in an identity: {expression}")

    def vector(self, components: tuple) -> Tree:
        return ("vec", *map(self, components))

    def _product(self, expression: sp.Mul) -> Tree:
        above, below = expression.as_numer_denom() if expression.args[0].is_Rational else (expression, sp.Integer(1))
        if below != 1 and below.is_Integer:
            return ("/", self(above), int(below))
        return ("*", *map(self, expression.args))

    def _power(self, base: sp.Expr, exponent: sp.Expr) -> Tree:
        if exponent.is_Integer:
            return ("^", self(base), int(exponent))
        if exponent.is_Rational and exponent.q == 2:
            root = ("sqrt", self(base))
            return root if exponent.p == 1 else ("^", root, int(exponent.p))
        raise NotationError(f"power {exponent} has no place in an identity")

    def _angle(self, expression: sp.Expr) -> Tree:
        tree = self(expression)
        try:
            linear_form(tree, self.definitions)
        except NotationError:
            name = next(
                (known for known, value in self.definitions.items() if value == tree and known.startswith("angle_")), ""
            )
            if not name:
                name = f"angle_{sum(known.startswith('angle_') for known in self.definitions) + 1}"
                self.definitions[name] = tree
            return name
        return tree


def _integer(value: int) -> Tree:
    return value if value >= 0 else ("-", -value)
