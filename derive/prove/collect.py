"""Sums and products collected: the operations of an evaluator whose numbers are expressions; and these as trees.

Equal terms of a sum are one term with a coefficient, equal factors of a product one power. First stands a number, then
pi, then names in the order of the alphabet, then what is composed, in that of its text. Sines and cosines are of angles
without right angles and with a positive first term.
"""

from collections.abc import Callable
from fractions import Fraction
from functools import partial
from math import isqrt, prod
from typing import Any

from derive.prove.tree import Tree
from meshwright.base.expression import Evaluator

HALF, PI = Fraction(1, 2), ("pi",)


def number(e: Tree) -> Any:
    """The rational number that an expression is; None for any other."""
    if isinstance(e, int):
        return Fraction(e)
    return Fraction(*e[1:]) if isinstance(e, tuple) and e[0] == "/" else None


def exact(q: Fraction) -> Tree:
    """A rational number as an expression."""
    return int(q) if q.denominator == 1 else ("/", q.numerator, q.denominator)


def terms(e: Tree) -> dict[Tree, Fraction]:
    """The terms of a sum, without their coefficients, and these."""
    found: dict[Tree, Fraction] = {}
    for term in e[1:] if _is(e, "+") else (e,):
        q, *rest = term[1:] if _is(term, "*") and number(term[1]) else (1, term) if number(term) is None else (term, 1)
        part = rest[0] if len(rest) == 1 else ("*", *rest)
        found[part] = found.get(part, 0) + number(q)
    return found


def powers(e: Tree) -> dict[Tree, Fraction]:
    """The factors of a product and their exponents."""
    found: dict[Tree, Fraction] = {}
    for factor in e[1:] if _is(e, "*") else (e,):
        base, exponent = factor, Fraction(1)
        if _is(factor, "^") or _is(factor, "sqrt"):
            base, exponent = factor[1], number(factor[2]) if factor[0] == "^" else HALF
        found[base] = found.get(base, 0) + exponent
    return found


def _is(e: Tree, operation: str) -> bool:
    return isinstance(e, tuple) and e[0] == operation


def _place(entry: tuple[Tree, Fraction]) -> tuple[int, str]:
    part, _ = entry
    kind = 3 if isinstance(part, tuple) else 2
    return 0 if isinstance(part, int) else 1 if part == PI else kind, str(part)


def plus(*summands: Tree) -> Tree:
    """A sum."""
    total: dict[Tree, Fraction] = {}
    for summand in summands:
        for term, q in terms(summand).items():
            total[term] = total.get(term, 0) + q
    parts = [_multiple(q, term) for term, q in sorted(total.items(), key=_place) if q]
    return parts[0] if len(parts) == 1 else ("+", *parts) if parts else 0


def _multiple(q: Fraction, term: Tree) -> Tree:
    if term == 1 or q == 1:
        return term if q == 1 else exact(q)
    return ("*", exact(q), *(term[1:] if _is(term, "*") else (term,)))


def times(*factors: Tree) -> Tree:
    """A product. A number times a sum is a sum."""
    total: dict[Tree, Fraction] = {}
    for factor in factors:
        for base, exponent in powers(factor).items():
            total[base] = total.get(base, 0) + exponent
    parts = [power(base, exponent) for base, exponent in sorted(total.items(), key=_place) if exponent]
    if any(_is(part, "*") for part in parts):
        return times(*parts)
    coefficient = Fraction(prod(number(part) for part in parts if number(part) is not None))
    parts = [part for part in parts if number(part) is None]
    if not coefficient or not parts:
        return exact(coefficient)
    product = parts[0] if len(parts) == 1 else ("*", *parts)
    if _is(product, "+") and coefficient != 1:
        return plus(*(times(exact(coefficient), term) for term in product[1:]))
    return _multiple(coefficient, product)


def power(base: Tree, exponent: Fraction) -> Tree:
    """A whole or half power."""
    q, whole = number(base), exponent.denominator == 1
    if q is not None and (whole or (q := _root(q)) is not None):
        return exact(q**exponent.numerator)
    if exponent in (0, 1):
        return base if exponent else 1
    inner = powers(base)
    if whole and (_is(base, "*") or inner != {base: 1}):
        return times(*(power(b, e * exponent) for b, e in inner.items()))
    return ("sqrt", base) if exponent == HALF else ("^", base, exact(exponent))


def _root(q: Fraction) -> Fraction | None:
    root = Fraction(isqrt(max(q.numerator, 0)), isqrt(q.denominator))
    return root if root * root == q else None


def negative(e: Tree) -> Tree:
    """The same with the other sign."""
    return times(-1, e)


def _sine(angle: Tree, turned: int = 0) -> Tree:
    """The sine of an angle and of right angles more."""
    found = terms(angle)
    if (2 * found.get(PI, 0)).denominator == 1 and found.get(PI, 0):
        return _sine(plus(angle, times(exact(-found[PI]), PI)), turned + int(2 * found[PI]))
    if angle == 0:
        return (0, 1, 0, -1)[turned % 4]
    if next(iter(found.values())) < 0:
        return times(1 if turned % 2 else -1, _sine(negative(angle), turned))
    return times(-1 if turned % 4 > 1 else 1, ("cos" if turned % 2 else "sin", angle))


def _tangent(angle: Tree) -> Tree:
    if angle == 0 or next(iter(terms(angle).values())) < 0:
        return times(-1, ("tan", negative(angle))) if angle else 0
    return ("tan", angle)


COLLECTED: dict[str, Callable[..., Tree]] = {
    "+": plus,
    "*": times,
    "-": negative,
    "/": lambda above, below: times(above, power(below, Fraction(-1))),
    "^": lambda base, exponent: power(base, number(exponent)),
    "sqrt": lambda radicand: power(radicand, HALF),
    "pi": lambda: PI,
    "sin": _sine,
    "cos": partial(_sine, turned=1),
    "tan": _tangent,
    "atan2": lambda y, x: ("atan2", y, x),
}


def replaced(e: Tree, old: Tree, new: Tree) -> Tree:
    """An expression with ``new`` in place of ``old``: of the whole, of some of its terms or of its factors."""
    if e == old:
        return new
    for operation, parts, combined in (("+", terms, _summed), ("*", powers, _multiplied)):
        if _is(e, operation) and _is(old, operation):
            own, wanted = parts(e), parts(old)
            if wanted.keys() <= own.keys():
                return combined(e, old, new, [own[part] / q for part, q in wanted.items()])
    return e


def _summed(e: Tree, old: Tree, new: Tree, times_in: list[Fraction]) -> Tree:
    q = times_in[0]
    return plus(e, times(exact(-q), old), times(exact(q), new)) if len(set(times_in)) == 1 else e


def _multiplied(e: Tree, old: Tree, new: Tree, times_in: list[Fraction]) -> Tree:
    n = Fraction(int(min(times_in)))
    return times(e, power(old, -n), power(new, n)) if n >= 1 else e


def collected(data: Any) -> Tree:
    """An expression of a description, collected; KeyError for one with cases."""
    return Evaluator(lambda leaf: PI if leaf == "pi" else leaf, COLLECTED)(data)


def as_tree(e: Tree) -> Tree:
    """A collected expression in the closed grammar, with differences and quotients as a reader writes them: what is
    taken off stands last. TypeError for one that the grammar does not have.
    """
    if not isinstance(e, tuple):
        return e
    operation, *operands = e
    match operation:
        case "pi":
            return "pi"
        case "+":
            return ("+", *map(as_tree, sorted(operands, key=lambda term: min(terms(term).values()) < 0)))
        case "*" | "/" | "^" | "sqrt":
            return _product(e)
        case "cos" | "sin" | "tan" | "atan2":
            return (operation, *map(as_tree, operands))
    raise TypeError(f"{e!r} is not part of the closed grammar")


def _product(e: Tree) -> Tree:
    ((product, q),) = terms(e).items()
    parts: dict[bool, list[Tree]] = {True: [abs(q.numerator)], False: [q.denominator]}
    for base, exponent in powers(product).items():
        root, n = as_tree(base) if exponent.denominator == 1 else ("sqrt", as_tree(base)), abs(exponent.numerator)
        parts[exponent > 0].append(root if n == 1 else ("^", root, n))
    above, below = ([part for part in parts[side] if part != 1] for side in (True, False))
    value = ("/", _joined(above), _joined(below)) if below else _joined(above)
    return value if q > 0 else opposite(value)


def _joined(factors: list) -> Tree:
    return 1 if not factors else factors[0] if len(factors) == 1 else ("*", *factors)


def opposite(tree: Tree) -> Tree:
    """A scalar or vector of the closed grammar with the other sign."""
    if tree == 0:
        return 0
    if isinstance(tree, tuple) and tree[0] == "vec":
        return ("vec", *map(opposite, tree[1:]))
    return tree[1] if isinstance(tree, tuple) and tree[0] == "-" else ("-", tree)
