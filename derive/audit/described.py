"""A drive's own description in the letters of a document: the derived side of its statements.

Edges of tools, motions of machine and assembly, rules and sizes are read from the description that the program is made
from (:mod:`derive.language.description`) and written as trees of the closed grammar, with the document's letters for
those of the drive. Nothing of them is typed a second time: an edit of a drive's page changes what is proved here.

A tree that was read knows where: :class:`Origin`, by which the record's checker reads it again.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property, reduce
from typing import Any

from derive.audit.plain_text import text
from derive.prove.collect import COLLECTED, as_tree, collected, opposite, replaced
from derive.prove.tree import NotationError, Tree, parse_formula
from meshwright.base.expression import Evaluator


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


class Factors:
    """A motion's factors, read when they are asked for, and where they stand: kind, place, first and last."""

    def __init__(self, read: Callable[[], Sequence], where: tuple[str, str], first: int = 0):
        self._read, self.where, self._first = read, where, first

    @cached_property
    def _all(self) -> Sequence:
        return self._read()

    def __iter__(self) -> Iterator:
        return iter(self._all)

    def __reversed__(self) -> Iterator:
        return reversed(self._all)

    def __getitem__(self, cut: slice) -> Factors:
        return _Cut(self, cut)

    @property
    def first(self) -> int:
        return self._first

    @property
    def part(self) -> list:
        return [*self.where, self.first, self.first + len(self._all)]


class _Cut(Factors):
    """Some of a motion's factors, one after the other."""

    def __init__(self, whole: Factors, cut: slice):
        super().__init__(lambda: [*whole][cut], whole.where)
        self._whole, self._slice = whole, cut

    @property
    def first(self) -> int:
        return self._whole.first + self._slice.indices(len([*self._whole]))[0]


ARCS = ("asin", "acos", "atan", "atan2")
#: What a mirror image of a drive's letters stands for: a half turn about x.
HALF_TURN: Tree = ("mat", (1, 0, 0), (0, -1, 0), (0, 0, -1))
#: The same about y.
HALF_TURN_Y: Tree = ("mat", (-1, 0, 0), (0, 1, 0), (0, 0, -1))

#: Descriptions at hand, by drive. Any other is made from the drive's page.
AT_HAND: dict[str, dict] = {}


def _description(name: str) -> dict:
    if name not in AT_HAND:
        from derive.drives import drive  # with SymPy, which nothing else here needs
        from derive.language import description

        AT_HAND[name] = description.describe(drive(name))
    return AT_HAND[name]


class Described:
    """The description of one drive.

    ``letters`` says what stands for an expression of the description: its own names left, the document's right.
    Products and functions on the left are replaced first, then names, one after the other; of a name on the left the
    definition is not put in.
    """

    def __init__(self, drive: str, letters: Mapping[str, str]):
        self.drive = drive
        self.letters = letters

    @cached_property
    def data(self) -> dict:
        return _description(self.drive)

    @cached_property
    def _reader(self) -> Callable[[Any], Tree]:
        named = {entry["name"]: entry["value"] for entry in self.data["definitions"]}
        return reader({name: value for name, value in named.items() if name not in self.letters}, self.letters)

    def tree(self, data: Any) -> Tree:
        """An expression of the description; NotationError for one that the closed grammar does not have."""
        try:
            return as_tree(self._reader(data))
        except KeyError as error:
            raise NotationError(f"{error.args[0]} is no operation of the closed grammar") from error

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
        found = [value for name, value in self.data["rules"] if name == target]
        return self._one(found[place - 1 : place], f"rule for {target}")

    def _size(self, key: str) -> Any:
        return self._one([entry["value"] for entry in self.data["sizes"] if entry["key"] == key], f"size {key}")

    def name(self, name: str) -> Tree:
        """A definition, or a name as the document writes it."""
        return self._of(["name", name], self.tree(name))

    def contact(self, name: str) -> Tree:
        return self._of(["contact", name], self.tree(self.data["contact"][name]))

    def margin(self, place: str, event: str) -> Tree:
        found = [m["positive"] for m in self._place(place)["margins"] if m["event"] == event]
        return self._of(["margin", place, event], self.tree(self._one(found, f"limit {event} of {place}")))

    def _place(self, place: str) -> dict:
        entries = {body["name"]: body for body in self.data["bodies"]}
        entries |= {f"{region['member']}/{region['region']}": region for region in self.data["regions"]}
        return entries[place]

    def _steps(self, place: str) -> list[dict]:
        return self._place(place)["surface"]["made"]

    def _step(self, steps: Sequence[dict], word: str) -> dict:
        """The first of these steps of this kind."""
        return self._one([step for step in steps if step["step"] == word], f"surface that is {word}")

    def _one(self, found: Sequence, what: str) -> Any:
        if not found:
            raise LookupError(f"{self.drive} has no {what}")
        return found[0]

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
        return Factors(lambda: self._steps(place)[0]["motion"], ("sweep", place))

    def moved(self, place: str) -> Factors:
        return Factors(lambda: self._step(self._steps(place), "moved")["motion"], ("moved", place))

    def generation(self, place: str) -> Factors:
        """The motion of the tool against the blank."""
        return Factors(lambda: self._step(self._steps(place)[::-1], "envelope")["motion"], ("generation", place))

    def condition(self, place: str, number: int = 1) -> Tree:
        condition = self._place(place)["surface"]["conditions"][number - 1]
        return self._of(["condition", place, number], self.tree(condition))

    def solved(self, place: str) -> Tree:
        """What the equation of meshing was solved by."""
        return self._of(["solved", place], self.tree(self._step(self._steps(place), "solved")["value"]))

    def motion(self, place: str) -> Factors:
        """The motion of a body into the fixed frame."""
        return Factors(lambda: self._place(place)["motion"], ("motion", place))

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
                    arm = _plus(point, opposite(self.vector(centre)))
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


def reader(definitions: Mapping[str, Any], letters: Mapping[str, str]) -> Callable[[Any], Tree]:
    """A function that collects an expression of a description in a document's letters."""
    expressions = [(_letter(old), _letter(new)) for old, new in letters.items() if not old.isidentifier()]

    def replacing(operation: Callable[..., Tree]) -> Callable[..., Tree]:
        return lambda *parts: reduce(lambda e, letter: replaced(e, *letter), expressions, operation(*parts))

    def leaf(part: Any) -> Tree:
        return collect(definitions[part]) if part in definitions else part

    collect = Evaluator(leaf, {name: replacing(operation) for name, operation in COLLECTED.items()})
    known: dict[str | int, Tree] = {}
    for old, new in reversed([*letters.items()]):
        known[old] = Evaluator(lambda part: known.get(part, part), COLLECTED)(_letter(new))
    put_in = Evaluator(lambda part: known.get(part, part), COLLECTED)
    return lambda data: put_in(collect(data))


@cache
def _letter(text: str) -> Tree:
    return collected(parse_formula(text))


def written(tree: Tree, numbers: Mapping[str, str]) -> str:
    """A formula of a description as text, with numbers put in for its letters."""

    def put(part: Tree) -> Tree:
        if isinstance(part, tuple):
            return (part[0], *map(put, part[1:]))
        return parse_formula(numbers[part]) if part in numbers else part

    return text(put(tree)).replace("^", "**")


def _plus(point: Tree, offset: Tree) -> Tree:
    return point if offset == ("vec", 0, 0, 0) else ("+", point, offset)
