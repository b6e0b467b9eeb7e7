"""Expressions of a description: values by hand, and what has none."""

import math
import operator
from fractions import Fraction

import pytest

from meshwright.base.expression import Evaluator, completed, value

SYMBOLS = {"a": 2.0, "b": 0.5, "open": math.nan}

CASES = [
    (3, 3.0),
    ("a", 2.0),
    (["/", 1, 4], 0.25),
    (["+", "a", "b", ["*", -1, "a"]], 0.5),
    (["*", 2, ["pi"]], 2 * math.pi),
    (["^", "a", -2], 0.25),
    (["^", "a", ["/", 1, 3]], 2 ** (1 / 3)),
    (["atan2", ["*", -1, "b"], 0], -math.pi / 2),
    (["min", "a", "b"], 0.5),
    (["excess", ["*", -1, "a"]], 0.0),
    (["sqrt", ["abs", ["*", -1, "a"]]], math.sqrt(2)),
    (["unit_step", 0], 1.0),
    (["sign", 0], 1.0),
    (("sign", ("*", -1, "b")), -1.0),
]


@pytest.mark.parametrize(("expression", "expected"), CASES)
def test_values_by_hand(expression, expected):
    assert value(expression, SYMBOLS) == pytest.approx(expected, rel=1e-15, abs=0)


NOT_NUMBERS = [["sqrt", -1], ["/", 1, 0], ["^", -1, ["/", 1, 2]], ["acos", 2], ["*", 0, "open"], ["^", 1000, 1000]]


@pytest.mark.parametrize("expression", NOT_NUMBERS)
def test_what_has_no_value_is_not_a_number(expression):
    assert math.isnan(value(expression, SYMBOLS))


def test_rules_fill_what_is_open_in_their_order():
    rules = [["open", ["*", "a", 3]], ["a", 7], ["later", ["+", "open", 1]]]
    assert completed(rules, SYMBOLS | {"later": math.nan}) == {"a": 2.0, "b": 0.5, "open": 6.0, "later": 7.0}


def test_any_kind_of_number_has_its_operations_and_nodes_of_its_own():
    evaluated = []
    exact = Evaluator(
        lambda leaf: evaluated.append(leaf) or Fraction(2 if leaf == "x" else leaf),
        {"+": lambda *terms: sum(terms), "/": operator.truediv, "double": lambda a: 2 * a},
        {"^": lambda base, exponent: exact(base) ** exponent},
    )
    third = ["/", "x", 6]
    assert exact(["+", third, ["double", ["^", third, -2]], third]) == Fraction(56, 3)
    assert evaluated == ["x", 6]
