"""Expressions as data, and their values in any kind of number.

An expression is a name, a whole number, or a list or tuple ``[operation, operand, …]``: ``"m_n"`` is a symbol,
``["/", 1, 4]`` a quotient, ``["*", "m_n", ["cos", "alpha"]]`` a product. Descriptions hold such expressions as JSON;
``derive/language/description.md`` lists their operations.
"""

import math
import operator
from collections.abc import Callable, Hashable, Mapping
from typing import Any, Generic, TypeVar

T = TypeVar("T")

_ALIKE = ("sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "atan2")


class Evaluator(Generic[T]):
    """Values of expressions in one kind of number.

    ``leaf`` gives the value of a name or a whole number, ``operations`` are functions of the values of operands,
    ``nodes`` functions of operands as they are written. Each part of an expression is evaluated once; two parts are the
    same where ``key`` is, by default one object. ``read`` makes an expression of what stands for one.
    """

    def __init__(
        self,
        leaf: Callable[[Any], T],
        operations: Mapping[str, Callable[..., T]],
        nodes: Mapping[str, Callable[..., T]] | None = None,
        key: Callable[[Any], Hashable] = id,
        read: Callable[[Any], Any] = lambda expression: expression,
    ):
        self.leaf, self.operations, self.nodes, self.key, self.read = leaf, operations, nodes or {}, key, read
        # a part is kept with its value, so that no other object gets its identity
        self._known: dict[Hashable, tuple[Any, T]] = {}

    def __call__(self, expression: Any) -> T:
        """The value of an expression; KeyError for an operation that these numbers do not have."""
        key = self.key(expression)
        if key not in self._known:
            self._known[key] = expression, self._value(self.read(expression))
        return self._known[key][1]

    def _value(self, expression: Any) -> T:
        if not isinstance(expression, list | tuple):
            return self.leaf(expression)
        operation, *operands = expression
        if operation in self.nodes:
            return self.nodes[operation](*operands)
        return self.operations[operation](*map(self, operands))


def real_operations(of: Any, power: Callable[[T, T], T]) -> dict[str, Callable[..., T]]:
    """The operations of a description by the functions of a module such as ``math``; not a number where an operand is
    none.
    """
    functions: dict[str, Callable[..., Any]] = {
        "+": lambda *terms: of.fsum(terms),
        "*": lambda *factors: math.prod(factors),
        "/": operator.truediv,
        "^": power,
        "pi": lambda: +of.pi,
        **{name: getattr(of, name) for name in _ALIKE},
        "abs": lambda a: max(a, -a), "sign": lambda a: -1 if a < 0 else 1,
        "min": lambda *values: min(values), "max": lambda *values: max(values),
        "unit_step": lambda a: int(a >= 0), "excess": lambda a: max(a, 0),
    }  # fmt: skip

    def of_numbers(function: Callable[..., Any]) -> Callable[..., Any]:
        return lambda *numbers: of.nan if any(map(of.isnan, numbers)) else function(*numbers)

    return {name: of_numbers(function) for name, function in functions.items()}


FLOATS = real_operations(math, math.pow)


def value(expression: Any, symbols: Mapping[str, float]) -> float:
    """The value of an expression; ``symbols`` are numbers by name, NaN where they are open.

    What is not a number (an open parameter, a root of a negative number) makes what depends on it not a number.
    """
    evaluator = Evaluator(lambda leaf: float(symbols[leaf] if isinstance(leaf, str) else leaf), FLOATS)
    try:
        result = float(evaluator(expression))
    except (ValueError, ZeroDivisionError, OverflowError):
        return math.nan
    return result if math.isfinite(result) else math.nan


def completed(rules: Any, symbols: Mapping[str, float]) -> dict[str, float]:
    """``symbols`` with what rules (pairs of a name and an expression), in their order, give to those that are open."""
    known = dict(symbols)
    for name, expression in rules:
        if math.isnan(known[name]):
            known[name] = value(expression, known)
    return known


def names(expression: Any) -> frozenset[str]:
    """The names in an expression."""
    if isinstance(expression, str):
        return frozenset({expression})
    parts = expression[1:] if isinstance(expression, list | tuple) else ()
    return frozenset().union(*map(names, parts))


def text(expression: Any) -> str:
    """An expression as one writes it on a line: ``m*(pi/2 + 2*x*tan(alpha))``."""
    return _text(expression, 0)


#: How tightly an operation binds.
_SUM = 1
_PRODUCT = 2
_POWER = 3


def _text(expression: Any, around: int) -> str:
    if not isinstance(expression, list | tuple):
        whole = str(expression)
        return f"({whole})" if whole.startswith("-") and around > _SUM else whole
    operation, *operands = expression
    if operation == "+":
        parts = sorted((_text(term, _SUM) for term in operands), key=lambda part: part.startswith("-"))
        written, binds = " + ".join(parts).replace("+ -", "- "), _SUM
    elif operation == "*":
        written, binds = _quotient(operands), _PRODUCT
    elif operation == "/":
        written, binds = f"{operands[0]}/{operands[1]}", _PRODUCT
    elif operation == "^" and operands[1] == -1:
        written, binds = _quotient([expression]), _PRODUCT
    elif operation == "^":
        written, binds = f"{_text(operands[0], _POWER)}^{_text(operands[1], _POWER)}", _POWER - 1
    elif operation == "pi":
        return "pi"
    else:
        return f"{operation}({', '.join(_text(o, 0) for o in operands)})"
    return f"({written})" if around > binds else written


def _quotient(factors: Any) -> str:
    """A product, what has a negative power below the line."""
    sign, above, below = "", [], []
    for factor in factors:
        match factor:
            case ["sqrt", ["sign", _]]:
                continue  # 1 where there is a value at all
            case int() if factor < 0:
                sign, above = "-", above + ([] if factor == -1 else [-factor])
            case ["/", p, q]:
                sign, above, below = ("-" if p < 0 else sign), above + ([] if abs(p) == 1 else [abs(p)]), [*below, q]
            case ["^", base, -1]:
                below.append(base)
            case _:
                above.append(factor)
    over = "*".join(_text(f, _PRODUCT) for f in above) or "1"
    under = "*".join(_text(f, _PRODUCT) for f in below)
    return sign + over + (f"/({under})" if len(below) > 1 else f"/{_text(below[0], _POWER)}" if below else "")
