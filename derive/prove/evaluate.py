"""Interpret expression trees in the polynomial ring: a tree becomes a quotient, or three, or nine of them."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import product
from typing import Any, TypeAlias

from derive.prove.angles import PI, BaseAngle, linear_form, quarter_turns
from derive.prove.fraction import Quotient
from derive.prove.normal_form import Relation
from derive.prove.polynomial import BACKENDS, Poly, PolynomialRing
from derive.prove.statement import Statement
from derive.prove.tree import NotationError, Tree
from meshwright.base import expression

Vector: TypeAlias = "tuple[Quotient, ...]"
#: What a tree becomes: a quotient, or three, or nine of them; which, its grammar says, not Python's types.
Value: TypeAlias = Any


@dataclass(frozen=True)
class Root:
    """sqrt(radicand) = generator / divisor; the divisor, a polynomial, clears the radicand's denominators."""

    radicand: Tree
    generator: str
    divisor: Poly


def jet_name(name: str, orders: tuple[int, ...]) -> str:
    return f"{name}[{','.join(map(str, orders))}]"


class Evaluator:
    """The ring of one statement and the values of its trees in that ring."""

    def __init__(self, statement: Statement, backend: str = BACKENDS[0]):
        self.statement = statement
        self.roots: list[Root] = []
        self._jets = {
            jet_name(name, orders): (name, orders)
            for name, highest in statement.used_jets.items()
            for orders in product(range(highest + 1), repeat=len(statement.jets[name]))
            if sum(orders) <= highest
        }
        radicands = [tree for kind, tree in statement.dependent_generators if kind == "root"]
        names = [f"sqrt{k}" for k in range(len(radicands))]
        self.arcs = {
            tree: f"arc{k}"
            for k, tree in enumerate(tree for kind, tree in statement.dependent_generators if kind == "arc")
        }
        names += [*self.arcs.values(), *statement.free_symbols, *self._jets]
        names += [name for angle in statement.angles for name in (angle.cosine, angle.sine)]
        self.ring = PolynomialRing(tuple(names), backend)
        self.relations = self._circle_and_sign_relations()
        self.value = expression.Evaluator(self._leaf, ALGEBRA, self._nodes(), key=lambda tree: tree)
        self._angles = {angle.symbol: angle for angle in statement.angles}
        for radicand in radicands:
            self._adjoin_root(radicand)

    def constant(self, value: int) -> Quotient:
        return Quotient(self.ring, self.ring.constant(value))

    def generator(self, name: str) -> Quotient:
        return Quotient(self.ring, self.ring.generator(name))

    def _circle_and_sign_relations(self) -> tuple[Relation, ...]:
        terms, index, one = self.ring.terms, self.ring.index, self.ring.constant(1)
        circles = tuple(
            Relation("circle", angle.sine, terms(one - self.ring.generator(angle.cosine) ** 2))
            for angle in self.statement.angles
        )
        signs = tuple(Relation("sign", name, terms(one)) for name in sorted(self.statement.signs) if name in index)
        return circles + signs

    def _adjoin_root(self, radicand: Tree) -> None:
        """Name sqrt(radicand), reusing the generator of an equal radicand."""
        square = self.value(radicand)
        divisor = self.ring.constant(1)
        for factor, times in square.factors:
            divisor *= factor**times
        terms = self.ring.terms(square.numerator * divisor)
        known = next(
            (relation for relation in self.relations if relation.kind == "root" and relation.square == terms), None
        )
        if known is None:
            known = Relation("root", f"sqrt{sum(relation.kind == 'root' for relation in self.relations)}", terms)
            self.relations = (known, *self.relations)
        self.roots.append(Root(radicand, known.generator, divisor))

    def _leaf(self, part: str | int) -> Value:
        if isinstance(part, int):
            return self.constant(part)
        return self.value(self.statement.used[part]) if part in self.statement.used else self.generator(part)

    def _nodes(self) -> dict[str, Callable[..., Value]]:
        """What depends on more than the values of its operands."""

        def turned(axis: int) -> Callable[[Tree], Value]:
            return lambda angle: self._rotation(axis, *self._cosine_and_sine(angle))

        def tangent(angle: Tree) -> Quotient:
            cosine, sine = self._cosine_and_sine(angle)
            return sine / cosine

        return {
            "^": lambda base, exponent: self.value(base) ** exponent,
            "sqrt": lambda radicand: self._root(next(root for root in self.roots if root.radicand == radicand)),
            "cos": lambda angle: self._cosine_and_sine(angle)[0],
            "sin": lambda angle: self._cosine_and_sine(angle)[1],
            "tan": tangent,
            "atan2": lambda y, x: self.generator(self.arcs["atan2", y, x]),
            "jet": lambda name, *orders: self.generator(jet_name(name, orders)),
            "d": self._derivative,
            "mat": lambda *rows: tuple(tuple(map(self.value, row)) for row in rows),
            "at": lambda vector, place: self.value(vector)[place],
            "entry": lambda matrix, row, column: self.value(matrix)[row][column],
            **{f"R{axis}": turned(place) for place, axis in enumerate("xyz")},
        }

    def _derivative(self, tree: Tree, *moving: tuple[str, Tree]) -> Value:
        rates = self._rates({symbol: self.value(rate) for symbol, rate in moving})
        return _map(lambda part: part.derivative(rates), self.value(tree))

    def _root(self, root: Root) -> Quotient:
        return self.generator(root.generator) / Quotient(self.ring, root.divisor)

    def _cosine_and_sine(self, tree: Tree) -> tuple[Quotient, Quotient]:
        """By complex multiplication over the base angles, then by quarter turns."""
        form = linear_form(tree, self.statement.used)
        cosine, sine = self.constant(1), self.constant(0)
        for symbol in sorted(set(form) - {PI}):
            angle = self._angles[symbol]
            times = int(form[symbol] * angle.divisor)
            c = self.generator(angle.cosine)
            s = self.generator(angle.sine) if times > 0 else -self.generator(angle.sine)
            for _ in range(abs(times)):
                cosine, sine = cosine * c - sine * s, sine * c + cosine * s
        for _ in range(quarter_turns(form) % 4):
            cosine, sine = -sine, cosine
        return cosine, sine

    def _rotation(self, axis: int, cosine: Quotient, sine: Quotient) -> tuple[Vector, ...]:
        one, zero = self.constant(1), self.constant(0)
        rows = [[one if i == j else zero for j in range(3)] for i in range(3)]
        first, second = (axis + 1) % 3, (axis + 2) % 3
        rows[first][first], rows[first][second] = cosine, -sine
        rows[second][first], rows[second][second] = sine, cosine
        return tuple(map(tuple, rows))

    def _rates(self, moving: Mapping[str, Quotient]) -> dict[str, Quotient]:
        """The rate of every generator when symbols move: the derivation of the ring."""
        rates = dict(moving)
        for symbol, rate in moving.items():
            if symbol in self._angles:
                self._turn(self._angles[symbol], rate, rates)
        for name, (function, orders) in self._jets.items():
            for position, variable in enumerate(self.statement.jets[function]):
                raised = jet_name(function, tuple(n + (k == position) for k, n in enumerate(orders)))
                if variable in moving and raised in self._jets:
                    slope = self.generator(raised) * moving[variable]
                    rates[name] = rates[name] + slope if name in rates else slope
        for kind, tree in self.statement.dependent_generators:
            rate = self._arc_rate(tree, rates) if kind == "arc" else self.value(tree).derivative(rates)
            if not rate.numerator:
                continue
            if kind == "angle":
                self._turn(self._angles[tree], rate, rates)
            elif kind == "arc":
                rates[self.arcs[tree]] = rate
            else:
                root = next(root for root in self.roots if root.radicand == tree)
                rates[root.generator] = self._root_rate(root, rate, rates)
        return rates

    def _arc_rate(self, tree: Tree, rates: Mapping[str, Quotient]) -> Quotient:
        y, x = self.value(tree[1]), self.value(tree[2])
        turning = x * y.derivative(rates) - y * x.derivative(rates)
        return turning / (x * x + y * y) if turning.numerator else turning

    def _root_rate(self, root: Root, rate: Quotient, rates: Mapping[str, Quotient]) -> Quotient:
        """Rate of generator = divisor * root of a radicand with this rate."""
        divisor = Quotient(self.ring, root.divisor)
        total = rate * divisor * divisor / (self.constant(2) * self.generator(root.generator))
        slope = divisor.derivative(rates)
        return total + slope * self._root(root) if slope.numerator else total

    def _turn(self, angle: BaseAngle, rate: Quotient, rates: dict[str, Quotient]) -> None:
        turning = rate if angle.divisor == 1 else rate / self.constant(angle.divisor)
        rates[angle.cosine] = -self.generator(angle.sine) * turning
        rates[angle.sine] = self.generator(angle.cosine) * turning


def _map(function: Callable[[Quotient], Quotient], value: Value) -> Value:
    return function(value) if isinstance(value, Quotient) else tuple(_map(function, part) for part in value)


def _zip(function: Callable[[Quotient, Quotient], Quotient], left: Value, right: Value) -> Value:
    if isinstance(left, Quotient) != isinstance(right, Quotient):
        raise NotationError("a scalar is added to a vector")
    if isinstance(left, Quotient):
        return function(left, right)
    return tuple(_zip(function, a, b) for a, b in zip(left, right, strict=True))


def _fold(function: Callable, values) -> Value:
    values = iter(values)
    total = next(values)
    for value in values:
        total = function(total, value)
    return total


def _times(left: Value, right: Value) -> Value:
    if isinstance(left, Quotient):
        return _map(lambda part: left * part, right)
    if not isinstance(right, Quotient):
        raise NotationError("two vectors are multiplied: write dot, cross or @")
    return _map(lambda part: part * right, left)


def _dot(u: Vector, v: Vector) -> Quotient:
    return _fold(Quotient.__add__, (a * b for a, b in zip(u, v, strict=True)))


def _cross(u: Vector, v: Vector) -> Vector:
    return tuple(u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3] for i in range(3))


def _matmul(left: tuple[Vector, ...], right: Value) -> Value:
    if isinstance(right[0], Quotient):
        return tuple(_dot(row, right) for row in left)
    columns = tuple(zip(*right, strict=True))
    return tuple(tuple(_dot(row, column) for column in columns) for row in left)


ALGEBRA: dict[str, Callable[..., Value]] = {
    "+": lambda *terms: _fold(lambda a, b: _zip(Quotient.__add__, a, b), terms),
    "-": lambda value: _map(Quotient.__neg__, value),
    "*": lambda *factors: _fold(_times, factors),
    "/": lambda value, divisor: _map(lambda part: part / divisor, value),
    "vec": lambda *parts: parts,
    "dot": _dot,
    "cross": _cross,
    "triple": lambda u, v, w: _dot(_cross(u, v), w),
    "@": _matmul,
    "T": lambda matrix: tuple(zip(*matrix, strict=True)),
}


def components(value: Value) -> list[Quotient]:
    """The scalar entries of a value, row by row."""
    return [value] if isinstance(value, Quotient) else [entry for part in value for entry in components(part)]
