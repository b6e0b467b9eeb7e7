"""A drive's own description in the letters of a document: the derived side of its statements.

Edges of tools, motions of machine and assembly, rules and sizes are read from the description that the program is made
from (:mod:`derive.language.description`) and written as trees of the closed grammar, with the document's letters for
those of the drive. Nothing of them is typed a second time: an edit of a drive's page changes what is proved here.

A tree that was read knows where: :class:`Origin`, by which the record's checker reads it again.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from typing import Any

import sympy as sp
from sympy.parsing.sympy_parser import parse_expr

from derive import drives
from derive.audit.plain_text import text
from derive.language import description
from derive.language.drive import Drive
from derive.prove.tree import Tree, parse_formula


@dataclass(frozen=True)
class Origin:
    """What a tree was read from: a drive, the document's letters for the drive's, and a part of its description.

    A part is a list of words; a vector that is carried is a part itself or ``["given", tree]``.
    """

    drive: str
    letters: tuple[tuple[str, str], ...]
    part: list

    def as_json(self) -> dict:
        return {"drive": self.drive, "letters": [list(pair) for pair in self.letters], "part": self.part}


class Read(tuple):
    """A tree that was read from a description."""

    origin: Origin


class ReadName(str):
    """The same, of a single letter."""

    origin: Origin


def origin_of(tree: Tree) -> Origin | None:
    """Where a tree was read; None for one that is typed."""
    return getattr(tree, "origin", None)


class Factors(list):
    """A motion's factors, and where they stand: kind, place, first and last."""

    def __init__(self, factors: Sequence, where: tuple[str, str], first: int = 0):
        super().__init__(factors)
        self.where, self.first = where, first

    def __getitem__(self, index: Any) -> Any:
        if not isinstance(index, slice):
            return super().__getitem__(index)
        return Factors(super().__getitem__(index), self.where, self.first + index.indices(len(self))[0])

    @property
    def part(self) -> list:
        return [*self.where, self.first, self.first + len(self)]


_KNOWN = {name: getattr(sp, name) for name in ("sin", "cos", "tan", "sqrt", "atan2", "asin", "acos", "pi")}
ARCS = ("asin", "acos", "atan", "atan2")
#: What a mirror image of a drive's letters stands for: a half turn about x.
HALF_TURN: Tree = ("mat", (1, 0, 0), (0, -1, 0), (0, 0, -1))
#: The same about y.
HALF_TURN_Y: Tree = ("mat", (-1, 0, 0), (0, 1, 0), (0, 0, -1))


@cache
def drive_of(name: str) -> Drive:
    """A drive of the tree, as its page builds it."""
    return drives.catalogue([name])[name]()


@cache
def _description(name: str) -> dict:
    return description.describe(drive_of(name))


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

    def _of(self, part: list, tree: Tree) -> Tree:
        """The tree, with where it was read."""
        if isinstance(tree, int):
            return tree
        read = ReadName(tree) if isinstance(tree, str) else Read(tree)
        read.origin = Origin(self.drive, tuple(self.letters.items()), part)
        return read

    # -- what the description holds

    def rule(self, target: str, place: int = 1) -> Tree:
        """The rule for a parameter, by its place among those for it."""
        return self._of(["rule", target, place], self.tree(self._rule(target, place)))

    def size(self, key: str) -> Tree:
        return self._of(["size", key], self.tree(self._size(key)))

    def arc_of_rule(self, target: str, place: int = 1) -> list[Tree]:
        """Of a rule for an angle, what its arc function is taken of."""
        return self._arc(["rule", target, place], self._rule(target, place))

    def arc_of_size(self, key: str) -> list[Tree]:
        """Of a size that is an angle, what its arc function is taken of."""
        return self._arc(["size", key], self._size(key))

    def _arc(self, part: list, value: Any) -> list[Tree]:
        if value[0] not in ARCS:
            raise TypeError(f"{value!r} is no angle that an arc function gives")
        return [self._of(["arc", k, part], self.tree(operand)) for k, operand in enumerate(value[1:], 1)]

    def _rule(self, target: str, place: int) -> Any:
        return [value for name, value in self.data["rules"] if name == target][place - 1]

    def _size(self, key: str) -> Any:
        return next(entry["value"] for entry in self.data["sizes"] if entry["key"] == key)

    def name(self, name: str) -> Tree:
        """A definition, or a name as the document writes it."""
        return self._of(["name", name], self.tree(name))

    def contact(self, name: str) -> Tree:
        return self._of(["contact", name], self.tree(self.data["contact"][name]))

    def margin(self, place: str, event: str) -> Tree:
        positive = next(m["positive"] for m in self._place(place)["margins"] if m["event"] == event)
        return self._of(["margin", place, event], self.tree(positive))

    def _place(self, place: str) -> dict:
        entries = {body["name"]: body for body in self.data["bodies"]}
        entries |= {f"{region['member']}/{region['region']}": region for region in self.data["regions"]}
        return entries[place]

    def _steps(self, place: str) -> list[dict]:
        return self._place(place)["surface"]["made"]

    def edge(self, place: str) -> Tree:
        """The tool's edge, or its given point."""
        first = self._steps(place)[0]
        return self._of(["edge", place], self.vector(first.get("curve") or first["point"]))

    def edge_normal(self, place: str) -> Tree:
        return self._of(["edge_normal", place], self.vector(self._steps(place)[0]["normal"]))

    def normal(self, place: str) -> Tree:
        """The outward normal in the frame of the edge."""
        return self._of(["normal", place], self.vector(self._place(place)["surface"]["normal"]))

    def sweep(self, place: str) -> Factors:
        return Factors(self._steps(place)[0]["motion"], ("sweep", place))

    def moved(self, place: str) -> Factors:
        step = next(step for step in self._steps(place) if step["step"] == "moved")
        return Factors(step["motion"], ("moved", place))

    def generation(self, place: str) -> Factors:
        """The motion of the tool against the blank."""
        step = next(step for step in reversed(self._steps(place)) if step["step"] == "envelope")
        return Factors(step["motion"], ("generation", place))

    def condition(self, place: str, number: int = 1) -> Tree:
        condition = self._place(place)["surface"]["conditions"][number - 1]
        return self._of(["condition", place, number], self.tree(condition))

    def solved(self, place: str) -> Tree:
        """What the equation of meshing was solved by."""
        value = next(step["value"] for step in self._steps(place) if step["step"] == "solved")
        return self._of(["solved", place], self.tree(value))

    def motion(self, place: str) -> Factors:
        """The motion of a body into the fixed frame."""
        return Factors(self._place(place)["motion"], ("motion", place))

    # -- trees

    def vector(self, parts: Sequence) -> Tree:
        return ("vec", *map(self.tree, parts))

    def carried(self, motion: Factors, point: Tree) -> Tree:
        """A point, carried by a motion."""
        part = ["carried", motion.part, self._vector_part(point)]
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
        return self._of(part, point)

    def turned(self, motion: Factors, direction: Tree) -> Tree:
        """A direction, turned by a motion."""
        part = ["turned", motion.part, self._vector_part(direction)]
        for kind, *data in reversed(motion):
            if kind not in ("translation", "station"):
                direction = ("@", self._rotation(*data[:2]), direction)
        return self._of(part, direction)

    def _vector_part(self, vector: Tree) -> list:
        origin = origin_of(vector)
        if origin and (origin.drive, dict(origin.letters)) == (self.drive, dict(self.letters)):
            return origin.part
        return ["given", vector]

    def matrix(self, motion: Factors) -> Tree:
        """The rotation of a motion."""
        parts = [self._rotation(*data[:2]) for kind, *data in motion if kind not in ("translation", "station")]
        product = parts[-1]
        for part in reversed(parts[:-1]):
            product = ("@", part, product)
        return self._of(["matrix", motion.part], product)

    def _rotation(self, axis: Any, angle: Any = None) -> Tree:
        if isinstance(axis, str):
            return (f"R{axis}", self.tree(angle))
        rows = zip(*(map(self.tree, column) for column in axis), strict=True)
        return ("mat", *rows)


_OPERATIONS = {
    "+": sp.Add, "*": sp.Mul, "^": sp.Pow, "sqrt": sp.sqrt, "cos": sp.cos, "sin": sp.sin, "tan": sp.tan,
    "atan2": sp.atan2, "asin": sp.asin, "acos": sp.acos, "atan": sp.atan, "abs": sp.Abs, "min": sp.Min, "max": sp.Max,
}  # fmt: skip


def written(tree: Tree, numbers: Mapping[str, str]) -> str:
    """A formula of a description as text, with numbers put in for its letters."""

    def put(part: Tree) -> Tree:
        if isinstance(part, tuple):
            return (part[0], *map(put, part[1:]))
        return parse_formula(numbers[part]) if part in numbers else part

    return text(put(tree)).replace("^", "**")


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
