"""Definitions that were read from a drive's description: read again, and compared at values drawn at random.

A step says which drive it was read from, which letters of the document stand for those of the drive, and what part of
the description it is. Letters are put in one after the other, so the drive's values follow from the document's from
the last letter to the first: a name has the value of what stands for it. Where a whole expression is replaced, the one
letter of the document that is new in it takes the value that makes both equal.
"""

import re
from pathlib import Path
from random import Random

from .described import Described, Open
from .description import ONE, names_in
from .draws import on_both_flanks
from .lines import read_file, read_json
from .machine import Circle, Machine
from .modular import PRIME, Number, add, divide, multiply
from .printed import read_expression
from .refusal import UNREADABLE, Rejected, require
from .straight_line import Function

ZERO = Number(0, (), {})
UNIT = [[ONE if i == k else ZERO for i in range(3)] for k in range(3)]
#: Characters of a letter, and exponents.
LONGEST, HIGHEST = 200, 100
ARCS = ("asin", "acos", "atan", "atan2")
DRIVE = re.compile(r"[a-z][a-z0-9_]*")


def check_origins(folder: Path, objects: dict[str, dict]) -> int:
    """All steps of a record that were read; how many. ``folder`` holds the descriptions."""
    steps = [item for item in objects.values() if item["object"] == "step" and item["read"] is not None]
    drives: dict[str, Described] = {}
    for step in steps:
        origin = step["read"]
        name = origin["drive"]
        require(DRIVE.fullmatch(name), f"{step['id']}: {name[:40]!r} is no drive")
        if name not in drives:
            path = folder / f"{name}.json"
            require(path.is_file(), f"{step['id']}: there is no description of {name}")
            drives[name] = Described(read_json(read_file(path)))
        try:
            on_both_flanks(check_origin, step, drives[name])
        except (*UNREADABLE, StopIteration, SyntaxError) as error:
            raise Rejected(f"{step['id']}: {error!r}") from error
    return len(steps)


def check_origin(step: dict, drive: Described, rng: Random) -> None:
    """One step's tree has the values of the part it names."""
    reading = Reading(drive, step["read"]["letters"], rng)
    shape, found = reading.part(step["read"]["part"])
    require(
        [number.value % PRIME for number in found] == [n.value % PRIME for n in reading.tree(shape, step["tree"])],
        f"{step['id']}: not what the description of {step['read']['drive']} says",
    )


class Reading:
    """The document's letters at random values, and what follows for the names of a description."""

    def __init__(self, drive: Described, letters: list, rng: Random):
        self.drive, self.rng = drive, rng
        self.drawn: dict[str, Number] = {}
        self.run = Machine({}, Function("record", {}, {}), None, Circle(rng, True))
        self.document = Open({}, {}, self.run, self._draw, {})
        values: dict[str, Number] = {}
        for old, new in reversed(letters):
            left, right = expression_of(old), expression_of(new)
            here = Open({}, values, self.run, self._draw, {})
            if isinstance(left, str):
                values = values | {left: here(right)}
            else:
                self._solve(right, here, here(left))
        named = {name: value for name, value in drive.named.items() if name not in values}
        self.description = Open(named, values, self.run, self._draw, {})

    def _draw(self, name: str) -> Number:
        if name not in self.drawn:
            sign = name == self.drive.parameters[0]
            value = self.rng.choice((1, PRIME - 1)) if sign else self.rng.randrange(1, PRIME)
            self.drawn[name] = Number(value)
        return self.drawn[name]

    def _solve(self, right: object, here: Open, value: Number) -> None:
        """The document's own letter in an expression, so that it has the value."""
        theirs = {*here.values, *self.drive.parameters, *self.drive.named}
        own = [name for name in names_in(right, {}) if name not in theirs]
        require(len(own) == 1, f"{right} has not one letter of the document alone")
        found = solved(right, own[0], value, here)
        require(self.drawn.setdefault(own[0], found).value == found.value, f"{own[0]} stands for two things")

    # -- the description's side

    def part(self, part: list) -> tuple[str, list[Number]]:
        """What a part is, and its values: a matrix column by column."""
        kind, *words = part
        if kind in ("edge", "edge_normal", "normal", "carried", "turned"):
            return "vector", self._vector(part)
        if kind == "matrix":
            return "matrix", [n for e in UNIT for n in self.description.carried(self._motion(*words[0]), e, free=True)]
        return "scalar", [self.description(self._expression(part))]

    def _vector(self, part: list) -> list[Number]:
        kind, *words = part
        if kind == "given":
            return self.tree("vector", words[0])
        if kind in ("carried", "turned"):
            motion, vector = words
            return self.description.carried(self._motion(*motion), self._vector(vector), free=kind == "turned")
        surface = self.drive.entries[words[0]]["surface"]
        first = surface["made"][0]
        components = {
            "edge": lambda: first.get("curve") or first["point"],
            "edge_normal": lambda: first["normal"],
            "normal": lambda: surface["normal"],
        }
        return self.description.vector(components[kind]())

    def _motion(self, kind: str, place: str, first: int, last: int) -> list:
        entry = self.drive.entries[place]
        made = entry["surface"]["made"]
        steps = {"sweep": made[:1], "moved": [step for step in made if step["step"] == "moved"][:1]}
        steps["generation"] = [step for step in made if step["step"] == "envelope"][-1:]
        motion = entry["motion"] if kind == "motion" else steps[kind][0]["motion"]
        whole = type(first) is type(last) is int and 0 <= first < last <= len(motion)
        require(whole, f"{kind} of {place} has no such factors")
        return motion[first:last]

    def _expression(self, part: list) -> object:
        kind, *words = part
        d = self.drive.description
        match kind:
            case "rule":
                target, place = words
                return numbered([value for name, value in d["rules"] if name == target], place)
            case "size":
                return next(size["value"] for size in d["sizes"] if size["key"] == words[0])
            case "arc":
                operation, *operands = self._expression(words[1])
                require(operation in ARCS, f"{operation} is no arc function")
                return numbered(operands, words[0])
            case "name":
                return words[0]
            case "contact":
                return d["contact"][words[0]]
            case "margin":
                margins = self.drive.entries[words[0]]["margins"]
                return next(m["positive"] for m in margins if m["event"] == words[1])
            case "condition":
                return numbered(self.drive.entries[words[0]]["surface"]["conditions"], words[1])
            case "solved":
                made = self.drive.entries[words[0]]["surface"]["made"]
                return next(step["value"] for step in made if step["step"] == "solved")
        raise Rejected(f"{kind} is no part of a description")

    # -- the document's side

    def tree(self, shape: str, tree: object) -> list[Number]:
        """Values of a tree of the record; names where a vector or a matrix stands are any."""
        return {"scalar": self._scalar, "vector": self._column, "matrix": self._columns}[shape](tree)

    def _scalar(self, tree: object) -> list[Number]:
        return [self.document(prefix(tree))]

    def _column(self, tree: object) -> list[Number]:
        if isinstance(tree, str):
            return [self._draw(f"{tree} {k}") for k in range(3)]
        match tree:
            case ["vec", *parts]:
                return [self.document(prefix(part)) for part in parts]
            case ["-", part]:
                return [add(ZERO, number, -1) for number in self._column(part)]
            case ["+", part, *parts]:
                total = self._column(part)
                for other in parts:
                    total = list(map(add, total, self._column(other)))
                return total
            case ["*", factor, part]:
                scale = self.document(prefix(factor))
                return [multiply(scale, number) for number in self._column(part)]
            case ["@", matrix, part]:
                return times(self._columns(matrix), self._column(part))
        raise Rejected(f"{str(tree)[:40]} is no vector that is read from a description")

    def _columns(self, tree: object) -> list[Number]:
        if isinstance(tree, str):
            return [self._draw(f"{tree} {k}") for k in range(9)]
        match tree:
            case ["mat", *rows]:
                return [self.document(prefix(row[k])) for k in range(3) for row in rows]
            case ["Rx" | "Ry" | "Rz" as turn, angle]:
                motion = [["rotation", turn[1], prefix(angle)]]
                return [number for e in UNIT for number in self.document.carried(motion, e, free=True)]
            case ["@", left, right]:
                a, b = self._columns(left), self._columns(right)
                return [number for k in range(3) for number in times(a, b[3 * k : 3 * k + 3])]
        raise Rejected(f"{str(tree)[:40]} is no matrix that is read from a description")


def numbered(items: list, place: object) -> object:
    """The first is number 1."""
    require(type(place) is int and 1 <= place <= len(items), f"there is no number {place!r} of {len(items)}")
    return items[place - 1]


def expression_of(text: str) -> object:
    """A letter, or what stands for it, as an expression of a description; short, with exponents of one digit."""
    require(type(text) is str and len(text) <= LONGEST, "a letter is no short text")
    require(not re.search(r"\*\*\s*[(+-]*\s*\d\d", text), f"{text}: an exponent of more than one digit")
    return read_expression(text)


def times(matrix: list[Number], vector: list[Number]) -> list[Number]:
    """A matrix, column by column, times a vector."""
    total = [ZERO] * 3
    for k, component in enumerate(vector):
        total = [add(sum_, multiply(matrix[3 * k + i], component)) for i, sum_ in enumerate(total)]
    return total


def prefix(tree: object) -> object:
    """A tree of the record as an expression of a description."""
    if tree == "pi":
        return ["pi"]
    if isinstance(tree, (str, int)):
        return tree
    operation, *operands = tree
    match operation:
        case "jet":
            return " ".join(map(str, operands))
        case "-":
            return ["*", -1, prefix(operands[0])]
        case "/" if all(isinstance(part, int) for part in operands):
            return ["/", *operands]
        case "/" if isinstance(operands[1], int):
            return ["*", ["/", 1, operands[1]], prefix(operands[0])]
        case "/":
            return ["*", prefix(operands[0]), ["^", prefix(operands[1]), -1]]
        case "^":
            require(type(operands[1]) is int and abs(operands[1]) < HIGHEST, "an exponent is too high")
            return ["^", prefix(operands[0]), operands[1]]
        case "*":
            flat = [prefix(part) for part in operands]
            parts = [p for each in flat for p in (each[1:] if isinstance(each, list) and each[0] == "*" else [each])]
            return ["*", *parts]
    return [operation, *map(prefix, operands)]


def solved(e: object, name: str, value: Number, reader: Open) -> Number:
    """What a name is if an expression in which it stands once has a value."""
    if e == name:
        return value
    operation, *operands = e
    (inside,) = (part for part in operands if name in names_in(part, {}))
    others = [reader(part) for part in operands if part is not inside and operation != "^"]
    match operation:
        case "+":
            for other in others:
                value = add(value, other, -1)
        case "*":
            for other in others:
                value = divide(value, other)
        case "^" if operands[1] == -1:
            value = divide(ONE, value)
        case _:
            raise Rejected(f"{operation} is not undone here")
    return solved(inside, name, value, reader)
