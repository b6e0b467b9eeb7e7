"""Collected expressions have the values of those that they were collected from, and equal ones are one."""

import math
import random
from fractions import Fraction

import pytest

from derive.audit.described import reader
from derive.prove.collect import as_tree, collected, exact, plus, power, replaced, times
from meshwright.base.expression import FLOATS, Evaluator

NAMES = "abcd"
#: As a reader writes it, too: with differences and quotients.
READ = {**FLOATS, "-": lambda a: -a}


def drawn(rng, depth):
    """An expression of a description."""
    if depth == 0:
        return rng.choice([*NAMES, *NAMES, rng.randint(-3, 3), ["/", rng.choice((-3, 1, 5)), 2], ["pi"]])
    inner = [drawn(rng, depth - rng.randint(1, depth)) for _ in range(3)]
    return rng.choice(
        [["+", *inner], ["+", *inner], ["*", *inner], ["*", *inner], ["^", inner[0], rng.choice((2, 3))],
         ["sin", inner[0]], ["cos", ["+", inner[0], ["*", ["/", rng.randint(-3, 3), 2], ["pi"]]]], ["tan", inner[0]],
         ["sqrt", ["+", 20, ["*", inner[0], inner[0]]]], ["^", ["+", 7, ["cos", inner[1]]], ["/", -1, 2]],
         ["^", ["+", 9, ["sin", inner[2]]], -1]]
    )  # fmt: skip


def shuffled(rng, expression):
    if not isinstance(expression, list):
        return expression
    operation, *operands = expression
    operands = [shuffled(rng, operand) for operand in operands]
    if operation in "+*":
        rng.shuffle(operands)
    return [operation, *operands]


def value(expression, values):
    return Evaluator(lambda leaf: float(values[leaf] if isinstance(leaf, str) else leaf), READ)(expression)


@pytest.mark.parametrize("seed", range(8))
def test_a_collected_expression_has_the_same_value_and_is_one_however_it_is_ordered(seed):
    rng = random.Random(seed)
    for _ in range(50):
        expression = drawn(rng, 4)
        values = {name: rng.uniform(0.5, 1.5) for name in NAMES} | {"pi": math.pi}
        found = collected(expression)
        expected = value(expression, values)
        for form in (found, as_tree(found)):
            assert value(form, values) == pytest.approx(expected, rel=1e-9, abs=1e-9)
        assert collected(found) == found == collected(shuffled(rng, expression))


def test_numbers_terms_and_factors_by_hand():
    third = Fraction(1, 3)
    assert plus("b", 1, "a", ("/", 1, 2), "b") == ("+", ("/", 3, 2), "a", ("*", 2, "b"))
    assert plus("a", times(-1, "a")) == 0
    assert times("b", 2, "a", power("b", Fraction(-1))) == ("*", 2, "a")
    assert times(2, ("+", "a", 1)) == ("+", 2, ("*", 2, "a"))
    assert power(power("a", Fraction(1, 2)), Fraction(2)) == "a"
    assert power(("/", 4, 9), Fraction(-1, 2)) == exact(Fraction(3, 2))
    assert collected(["+", ["*", "b", "a"], ["*", -1, "a", "b"], exact(third)]) == ("/", 1, 3)
    turned = ["+", "b", ["*", -1, "a"], ["*", ["/", 5, 2], ["pi"]]]
    assert collected(["sin", turned]) == ("cos", ("+", "a", ("*", -1, "b")))
    assert collected(["sin", ["pi"]]) == 0


def test_what_is_part_of_a_sum_or_a_product_is_replaced():
    whole, part = ["*", 2, "T", "phi", ["^", "N", -1], "r"], ["*", "T", "phi", ["^", "N", -1]]
    assert replaced(collected(whole), collected(part), "x") == collected(["*", 2, "x", "r"])
    assert replaced(collected(["^", ["*", "a", "b"], 2]), collected(["*", "a", "b"]), "x") == power("x", Fraction(2))
    whole = ["+", ["*", -2, "a"], ["*", -2, "b"], "c"]
    assert replaced(collected(whole), collected(["+", "a", "b"]), "x") == collected(["+", ["*", -2, "x"], "c"])
    for kept in (["*", "a", ["^", "b", -1]], ["+", "a", ["*", -1, "b"]], "a"):
        whole = collected(kept)
        for operation in "*+":
            assert replaced(whole, collected([operation, "a", "b"]), "x") == whole


LETTERS = [
    ({"a": "b", "b": "c"}, ["+", "a", "b"], ["*", 2, "c"]),
    ({"a": "b", "b": "a"}, ["*", "a", ["^", "b", 2]], ["^", "a", 3]),
    ({"tan(a)": "p/r", "r": "b"}, ["*", "r", ["tan", "a"]], "p"),
    ({"r": "b", "tan(a)": "p/r"}, ["tan", "a"], ["*", "p", ["^", "b", -1]]),
    ({"T*phi/N": "f"}, ["cos", ["+", ["*", -1, ["^", "N", -1], "wide"], "b"]], ["cos", ["+", "f", ["*", -1, "b"]]]),
    ({"u": "wide/N"}, ["+", "u", "wide"], ["+", ["*", "wide", ["^", "N", -1]], ["*", "T", "phi"]]),
]


@pytest.mark.parametrize(("letters", "expression", "expected"), LETTERS)
def test_letters_are_put_in_and_definitions_followed(letters, expression, expected):
    """``wide`` is T·phi by definition; in what stands for a letter it is a letter of the document."""
    assert reader({"wide": ["*", "phi", "T"]}, letters)(expression) == collected(expected)
