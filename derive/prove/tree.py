"""Expression trees: the closed grammar in which every statement is written, printed, hashed and checked.

A tree is an expression as data (:mod:`meshwright.base.expression`), a nested tuple with more operations than those of a
description. Nothing is ever evaluated, ordered or collapsed: a tree is what was printed, term by term.

    scalar   int, symbol, ("+", a, b, ...), ("-", a), ("*", a, b, ...), ("/", a, b), ("^", a, n), ("sqrt", a),
             ("cos" | "sin" | "tan", angle), ("atan2", y, x), ("jet", name, order, ...), ("dot", u, v),
             ("triple", u, v, w), ("at", u, i), ("entry", A, i, j)
    vector   ("vec", a, b, c), ("cross", u, v), sums, multiples and quotients of vectors, ("@", A, u)
    matrix   ("mat", (row), (row), (row)), ("Rx" | "Ry" | "Rz", angle), ("@", A, B), ("T", A)
    any      ("d", expression, (symbol, rate), ...): derivative when every listed symbol moves at its rate

A jet is the value of an unspecified function or of one of its derivatives: ("jet", "xi", 2) is xi'' of a function of
one variable, ("jet", "x", 1, 0) is the first partial derivative of a function of two.
"""

import ast
import json
import re
from collections.abc import Callable, Iterator, Mapping
from typing import Any, TypeAlias, cast

#: Which node has which parts, the grammar says, not Python's types.
Tree: TypeAlias = Any

FUNCTIONS = ("cos", "sin", "tan", "sqrt")
ROTATIONS = ("Rx", "Ry", "Rz")
FIXED_ARITY = {
    **dict.fromkeys(FUNCTIONS + ROTATIONS, 1),
    "-": 1,
    "/": 2,
    "T": 1,
    "@": 2,
    "dot": 2,
    "cross": 2,
    "atan2": 2,
    "triple": 3,
    "vec": 3,
}
COMPONENTS = {"x": 0, "y": 1, "z": 2}
NUMERIC_FUNCTIONS = ("asin", "acos", "atan", "degrees", "radians")


class NotationError(ValueError):
    """A text or a SymPy expression that the closed grammar does not contain."""


def parse(text: str, jets: Mapping[str, tuple[str, ...]] | None = None) -> Tree:
    """Read an expression in the compact notation of the document modules, keeping every term as written.

    `xi'` is the first derivative of a jet named in `jets` (name -> variables), `x[1, 0]` a partial derivative, `R.x`
    the first component of a vector, `A @ B` a matrix product, `d(f, u)` and `d(f, (u, 1), (v, m))` a derivative.
    """
    primed = re.sub(r"(\w)('+)", lambda match: f"{match[1]}[{len(match[2])}]", text)
    try:
        node = ast.parse(" ".join(primed.split()), mode="eval").body
    except SyntaxError as error:
        raise NotationError(f"cannot read {text!r}: {error.msg}") from error
    return _Reader(jets or {}, text).read(node)


def parse_formula(text: str) -> Tree:
    """Read a formula with numbers put in: decimals become quotients, arc functions and degrees are allowed as well."""
    exact = re.sub(r"(\d+)\.(\d+)", lambda match: f"({int(match[1] + match[2])}/{10 ** len(match[2])})", text)
    return _Reader({}, text, FIXED_ARITY | dict.fromkeys(NUMERIC_FUNCTIONS, 1)).read(ast.parse(exact, mode="eval").body)


class _Reader:
    """Translate Python's own syntax tree into ours; anything else is an error."""

    def __init__(self, jets: Mapping[str, tuple[str, ...]], text: str, arity: Mapping[str, int] = FIXED_ARITY):
        self.jets = jets
        self.text = text
        self.arity = arity

    def read(self, node: ast.expr) -> Tree:
        method = getattr(self, f"_{type(node).__name__.lower()}", None)
        if method is None:
            raise NotationError(f"{type(node).__name__} is not part of the notation: {self.text!r}")
        return method(node)

    def _constant(self, node: ast.Constant) -> Tree:
        if type(node.value) is not int:
            raise NotationError(f"write {node.value!r} as an integer or a quotient: {self.text!r}")
        return node.value

    def _name(self, node: ast.Name) -> Tree:
        return ("jet", node.id, *(0 for _ in self.jets[node.id])) if node.id in self.jets else node.id

    def _unaryop(self, node: ast.UnaryOp) -> Tree:
        if not isinstance(node.op, ast.USub):
            raise NotationError(f"operator not part of the notation: {self.text!r}")
        return ("-", self.read(node.operand))

    def _binop(self, node: ast.BinOp) -> Tree:
        left, right = self.read(node.left), self.read(node.right)
        match node.op:
            case ast.Add():
                return _join("+", left, right)
            case ast.Sub():
                return _join("+", left, ("-", right))
            case ast.Mult():
                return _signed(left, lambda inner: _join("*", inner, right))
            case ast.Div():
                return _signed(left, lambda inner: ("/", inner, right))
            case ast.MatMult():
                return ("@", left, right)
            case ast.Pow():
                exponent = -right[1] if isinstance(right, tuple) and right[0] == "-" else right
                if isinstance(exponent, int):
                    return ("^", left, exponent)
        raise NotationError(f"operator not part of the notation: {self.text!r}")

    def _subscript(self, node: ast.Subscript) -> Tree:
        orders = self._orders(node.slice)
        if not (isinstance(node.value, ast.Name) and len(self.jets.get(node.value.id, ())) == len(orders)):
            raise NotationError(f"only declared functions have derivatives: {self.text!r}")
        return ("jet", node.value.id, *orders)

    @staticmethod
    def _orders(node: ast.expr) -> tuple[int, ...]:
        return tuple(ast.literal_eval(item) for item in (node.elts if isinstance(node, ast.Tuple) else [node]))

    def _attribute(self, node: ast.Attribute) -> Tree:
        if node.attr not in COMPONENTS:
            raise NotationError(f"a vector has components x, y, z: {self.text!r}")
        return ("at", self.read(node.value), COMPONENTS[node.attr])

    def _call(self, node: Any) -> Tree:
        name = node.func.id if isinstance(node.func, ast.Name) else ""
        if name in self.arity and len(node.args) == self.arity[name]:
            return (name, *map(self.read, node.args))
        if name == "mat":
            return ("mat", *(tuple(map(self.read, row.elts)) for row in node.args))
        if name == "entry":
            matrix, row, column = node.args
            return ("entry", self.read(matrix), row.value - 1, column.value - 1)
        if name == "d":
            return ("d", self.read(node.args[0]), *map(self._direction, node.args[1:]))
        raise NotationError(f"unknown function {name or '?'} or wrong number of arguments: {self.text!r}")

    def _direction(self, node: Any) -> Tree:
        if isinstance(node, ast.Tuple):
            symbol, rate = cast(Any, node).elts
            return (symbol.id, self.read(rate))
        return (node.id, 1)


def _signed(left: Tree, build: Callable[[Tree], Tree]) -> Tree:
    """-a*b is printed and meant as -(a*b)."""
    return ("-", build(left[1])) if isinstance(left, tuple) and left[0] == "-" else build(left)


def _join(operator: str, left: Tree, right: Tree) -> Tree:
    head = left[1:] if isinstance(left, tuple) and left[0] == operator else (left,)
    return (operator, *head, right)


def children(tree: Tree) -> Iterator[Tree]:
    """The direct subexpressions of a node."""
    if not isinstance(tree, tuple):
        return
    match tree[0]:
        case "jet":
            return
        case "^" | "at":
            yield tree[1]
        case "entry":
            yield tree[1]
        case "mat":
            for row in tree[1:]:
                yield from row
        case "d":
            yield tree[1]
            for _, rate in tree[2:]:
                yield rate
        case _:
            yield from tree[1:]


def rebuild(tree: Tree, new: list[Tree]) -> Tree:
    """The same node with its `children` replaced, in order."""
    match tree[0]:
        case "^" | "at":
            return (tree[0], new[0], tree[2])
        case "entry":
            return (tree[0], new[0], *tree[2:])
        case "mat":
            width = len(tree[1])
            return ("mat", *(tuple(new[at : at + width]) for at in range(0, len(new), width)))
        case "d":
            return ("d", new[0], *((symbol, rate) for (symbol, _), rate in zip(tree[2:], new[1:], strict=True)))
        case _:
            return (tree[0], *new)


def walk(tree: Tree) -> Iterator[Tree]:
    """Every node of the tree, parents first."""
    yield tree
    for child in children(tree):
        yield from walk(child)


def symbols(tree: Tree) -> set[str]:
    """Every symbol that occurs, including those a derivative is taken along."""
    found = set()
    for node in walk(tree):
        if isinstance(node, str):
            found.add(node)
        elif isinstance(node, tuple) and node[0] == "d":
            found.update(symbol for symbol, _ in node[2:])
    return found


def canonical(value: object) -> str:
    """The one JSON text of a value: sorted keys, no spaces. What is hashed is this text."""
    return json.dumps(value, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
