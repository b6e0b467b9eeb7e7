"""A drive's own description in the letters of a document: the derived side of its statements.

Edges of tools, motions of machine and assembly, rules and sizes are read from the description that the program is made
from (:mod:`derive.language.description`) and written as trees of the closed grammar, with the document's letters for
those of the drive. Nothing of them is typed a second time: an edit of a drive's page changes what is proved here.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from functools import cache, cached_property
from typing import Any

import sympy as sp
from sympy.parsing.sympy_parser import parse_expr

from derive import drives
from derive.language import description
from derive.prove.tree import Tree

Factors = Sequence[Sequence]

_KNOWN = {name: getattr(sp, name) for name in ("sin", "cos", "tan", "sqrt", "atan2", "asin", "acos", "pi")}
#: What a mirror image of a drive's letters stands for: a half turn about x.
HALF_TURN: Tree = ("mat", (1, 0, 0), (0, -1, 0), (0, 0, -1))


@cache
def _description(name: str) -> dict:
    return description.describe(drives.catalogue([name])[name]())


class Described:
    """The description of one drive.

    ``letters`` says, in the order in which they are put in, what stands for an expression of the description: its own
    names left, the document's right. A name on the left is not replaced by its definition.
    """

    def __init__(self, drive: str, letters: Mapping[str, str]):
        self.drive = drive
        self.letters = letters

    @cached_property
    def data(self) -> dict:
        return _description(self.drive)

    @cached_property
    def _definitions(self) -> dict[str, object]:
        named = {entry["name"]: entry["value"] for entry in self.data["definitions"]}
        return {name: value for name, value in named.items() if name not in self.letters}

    def tree(self, data: Any) -> Tree:
        """An expression of the description."""
        written = self._read(data)
        for old, new in self.letters.items():
            written = written.subs(_parsed(old), _parsed(new))
        return as_tree(description.prefix(written))

    def _read(self, data: Any) -> sp.Expr:
        match data:
            case str():
                return self._read(self._definitions[data]) if data in self._definitions else sp.Symbol(data)
            case int():
                return sp.Integer(data)
            case ["pi"]:
                return sp.pi
            case ["/", int() as p, int() as q]:
                return sp.Rational(p, q)
            case [operation, *operands]:
                return _OPERATIONS[operation](*map(self._read, operands))
        raise TypeError(f"{data!r} is no expression of a description")

    # -- what the description holds

    def rule(self, target: str, place: int = 1) -> Tree:
        """The rule for a parameter, by its place among those for it."""
        return self.tree([value for name, value in self.data["rules"] if name == target][place - 1])

    def size(self, key: str) -> Tree:
        return self.tree(self._size(key))

    def operands(self, key: str) -> list[Tree]:
        """Of a size that is an angle, what its arc function is taken of."""
        return [self.tree(part) for part in self._size(key)[1:]]

    def _size(self, key: str) -> Any:
        return next(entry["value"] for entry in self.data["sizes"] if entry["key"] == key)

    def name(self, name: str) -> Tree:
        """A definition, or a name as the document writes it."""
        return self.tree(name)

    def contact(self, name: str) -> Tree:
        return self.tree(self.data["contact"][name])

    def margin(self, place: str, event: str) -> Tree:
        return self.tree(next(m["positive"] for m in self._place(place)["margins"] if m["event"] == event))

    def _place(self, place: str) -> dict:
        entries = {body["name"]: body for body in self.data["bodies"]}
        entries |= {f"{region['member']}/{region['region']}": region for region in self.data["regions"]}
        return entries[place]

    def _steps(self, place: str) -> list[dict]:
        return self._place(place)["surface"]["made"]

    def edge(self, place: str) -> Tree:
        """The tool's edge, or its given point."""
        first = self._steps(place)[0]
        return self.vector(first.get("curve") or first["point"])

    def edge_normal(self, place: str) -> Tree:
        return self.vector(self._steps(place)[0]["normal"])

    def normal(self, place: str) -> Tree:
        """The outward normal in the frame of the edge."""
        return self.vector(self._place(place)["surface"]["normal"])

    def sweep(self, place: str) -> Factors:
        return self._steps(place)[0]["motion"]

    def moved(self, place: str) -> Factors:
        return next(step["motion"] for step in self._steps(place) if step["step"] == "moved")

    def generation(self, place: str) -> Factors:
        """The motion of the tool against the blank."""
        return next(step["motion"] for step in reversed(self._steps(place)) if step["step"] == "envelope")

    def condition(self, place: str, number: int = 1) -> Tree:
        return self.tree(self._place(place)["surface"]["conditions"][number - 1])

    def solved(self, place: str) -> Tree:
        """What the equation of meshing was solved by."""
        return self.tree(next(step["value"] for step in self._steps(place) if step["step"] == "solved"))

    def motion(self, place: str) -> Factors:
        """The motion of a body into the fixed frame."""
        return self._place(place)["motion"]

    # -- trees

    def vector(self, parts: Sequence) -> Tree:
        return ("vec", *map(self.tree, parts))

    def carried(self, motion: Factors, point: Tree) -> Tree:
        """A point, carried by a motion."""
        for kind, *data in reversed(motion):
            match kind:
                case "translation" | "station":
                    point = _plus(point, self.vector(data[0]))
                case "swing":
                    axis, angle, centre = data
                    arm = _plus(point, _negative(self.vector(centre)))
                    point = _plus(("@", self._rotation(axis, angle), arm), self.vector(centre))
                case _:
                    point = ("@", self._rotation(*data), point)
        return point

    def turned(self, motion: Factors, direction: Tree) -> Tree:
        """A direction, turned by a motion."""
        for kind, *data in reversed(motion):
            if kind not in ("translation", "station"):
                direction = ("@", self._rotation(*data[:2]), direction)
        return direction

    def matrix(self, motion: Factors) -> Tree:
        """The rotation of a motion."""
        parts = [self._rotation(*data[:2]) for kind, *data in motion if kind not in ("translation", "station")]
        product = parts[-1]
        for part in reversed(parts[:-1]):
            product = ("@", part, product)
        return product

    def _rotation(self, axis: Any, angle: Any = None) -> Tree:
        if isinstance(axis, str):
            return (f"R{axis}", self.tree(angle))
        rows = zip(*(map(self.tree, column) for column in axis), strict=True)
        return ("mat", *rows)


_OPERATIONS = {
    "+": sp.Add, "*": sp.Mul, "^": sp.Pow, "sqrt": sp.sqrt, "cos": sp.cos, "sin": sp.sin, "tan": sp.tan,
    "atan2": sp.atan2, "asin": sp.asin, "acos": sp.acos, "atan": sp.atan, "abs": sp.Abs, "min": sp.Min, "max": sp.Max,
}  # fmt: skip


@cache
def _parsed(text: str) -> sp.Expr:
    names = {name: sp.Symbol(name) for name in _names(text)}
    return parse_expr(text, local_dict=names | _KNOWN)


def _names(text: str) -> set[str]:
    return {name for name in re.findall(r"[A-Za-z_]\w*", text) if name not in _KNOWN}


def as_tree(data: object) -> Tree:
    """Prefix lists in the closed grammar, with differences and quotients as a reader writes them."""
    match data:
        case str() | int():
            return data
        case ["pi"]:
            return "pi"
        case ["/", int() as p, int() as q]:
            return ("-", ("/", -p, q)) if p < 0 else ("/", p, q)
        case ["+", *terms]:
            return ("+", *map(as_tree, sorted(terms, key=_is_negative)))
        case ["*", *factors]:
            return _product(factors)
        case ["^", base, int() as power] if power > 0:
            return ("^", as_tree(base), power)
        case ["^", _, int() | ["/", -1, 2]]:
            return _product([data])
        case ["sqrt" | "cos" | "sin" | "tan" | "atan2" as name, *operands]:
            return (name, *map(as_tree, operands))
    raise TypeError(f"{data!r} is not part of the closed grammar")


def _is_negative(term: object) -> bool:
    match term:
        case ["*", int() as number, *_] | ["*", ["/", int() as number, int()], *_] | ["/", int() as number, int()]:
            return number < 0
    return isinstance(term, int) and term < 0


def _product(factors: list) -> Tree:
    sign = 1
    above: list[Tree] = []
    below: list[Tree] = []
    for factor in factors:
        match factor:
            case int():
                sign, factor = (-sign, -factor) if factor < 0 else (sign, factor)
                above += [factor] if factor != 1 else []
            case ["/", int() as p, int() as q]:
                sign, p = (-sign, -p) if p < 0 else (sign, p)
                above += [p] if p != 1 else []
                below.append(q)
            case ["^", base, -1]:
                below.append(as_tree(base))
            case ["^", base, int() as power] if power < 0:
                below.append(("^", as_tree(base), -power))
            case ["^", base, ["/", -1, 2]]:
                below.append(("sqrt", as_tree(base)))
            case _:
                above.append(as_tree(factor))
    value = _joined(above)
    if below:
        value = ("/", value, _joined(below))
    return value if sign > 0 else _negative(value)


def _joined(factors: list) -> Tree:
    return 1 if not factors else factors[0] if len(factors) == 1 else ("*", *factors)


def _negative(tree: Tree) -> Tree:
    if tree == 0:
        return 0
    if isinstance(tree, tuple) and tree[0] == "vec":
        return ("vec", *map(_negative, tree[1:]))
    return tree[1] if isinstance(tree, tuple) and tree[0] == "-" else ("-", tree)


def _plus(point: Tree, offset: Tree) -> Tree:
    return point if offset == ("vec", 0, 0, 0) else ("+", point, offset)
