#!/usr/bin/env python3
"""Check the description of each drive against what its sources print and against the laws of enveloping:
`python check_print.py [folder [drive …]]`, exit status 0 if everything holds.

Print: ``printed.txt`` says, family by family, what books, papers and standards print: motions of machine and assembly,
edges of tools, rules, sizes, guards, margins, outward normals. The other side of each statement is read from the
description (``descriptions/<drive>.json``) that the program is made from, never from a copy. Both are evaluated modulo
a prime of 61 bits drawn at random, at random values, on both flanks; a wrong one agrees with a probability of about
degree / 2^61.

Laws, of every surface of every drive:

  made       its point is the tool's edge carried by sweep, moves and generating motion, in this order
  enveloping its normal is at right angles to what moves the tool against the blank, solved or as a condition
  normal     at right angles to both tangents of the tool's surface
  contact    the residual is the difference of the two placed points and the normal of one against the tangents of the
             other
  derived    definitions that are slopes are the derivatives of what they are named after

Needs check.py, check_code.py, check_description.py and printed.txt beside it and nothing else.
"""

from __future__ import annotations

import ast
import json
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass, replace
from fnmatch import fnmatch
from fractions import Fraction
from pathlib import Path
from random import Random
from types import ModuleType


def _beside(name: str) -> ModuleType:
    """A checker from this file's own folder, wherever they are copied, without leaving compiled files there."""
    module = ModuleType(f"meshwright_{name}_beside")
    module.__file__ = str(Path(__file__).with_name(f"{name}.py"))
    sys.modules[module.__name__] = module
    exec(compile(Path(module.__file__).read_text(encoding="utf-8"), module.__file__, "exec"), module.__dict__)
    return module


DESCRIBED = _beside("check_description")
CODE = DESCRIBED.CODE
Rejected, require, Number = CODE.Rejected, CODE.require, CODE.Number
Reader, Surface, inner, unit, rate = (
    DESCRIBED.Reader, DESCRIBED.Surface, DESCRIBED.inner, DESCRIBED.unit, DESCRIBED.rate,
)  # fmt: skip
Draw, Draws, attempt, once = DESCRIBED.Draw, DESCRIBED.Draws, DESCRIBED.attempt, DESCRIBED.once


# ---- what is printed -------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Statement:
    """One printed statement: what it is about, its two sides (or one), and where it stands."""

    kind: str
    about: tuple[str, ...]
    sides: tuple[object, ...]
    source: str
    text: str


#: An abbreviation of a section without statements: it holds in all sections that follow.
LET_ALONE = "let"
LET = re.compile(r"let (\w+): (.*)")
LINE = re.compile(r"(\w+)((?: [\w/]+)*): (.*?) *\| (.+)")


def read_printed(text: str) -> list[tuple[list[str], list[Statement]]]:
    """Sections: patterns of the names of drives, and what is printed of them; abbreviations, where there is nothing
    else.
    """
    sections: list[tuple[list[str], list[Statement]]] = []
    for part in re.split(r"^(?=\[)", re.sub(r"\n +", " ", text), flags=re.M)[1:]:
        head, *lines = part.splitlines()
        names = head.strip("[]").split()
        words = [name.split(":") for name in names if not PATTERN.search(name)]
        found: dict[str, Statement] = {}
        let: dict[str, object] = {}
        for word in words or [["$", "%"]]:
            let = {}
            for line in lines:
                if line and not line.startswith("#"):
                    _read_line(line.replace("$", word[0]).replace("%", word[-1]), let, found)
        shared = [Statement(LET_ALONE, (name,), (value,), "", "") for name, value in let.items()]
        patterns = [pattern for name in names if PATTERN.search(name) for pattern in alternatives(name)]
        sections.append((patterns, list(found.values()) or shared))
    return sections


def alternatives(pattern: str) -> list[str]:
    """``a_{b,c}`` is ``a_b`` and ``a_c``."""
    match = re.search(r"{([^{}]*)}", pattern)
    if not match:
        return [pattern]
    words = (pattern[: match.start()] + word + pattern[match.end() :] for word in match[1].split(","))
    return [found for word in words for found in alternatives(word)]


def is_about(name: str, patterns: list[str]) -> bool:
    """Is a drive among those named? A pattern after an exclamation mark leaves drives out."""
    left_out = [pattern[1:] for pattern in patterns if pattern.startswith("!")]
    return any(fnmatch(name, p) for p in patterns) and not any(fnmatch(name, p) for p in left_out)


def _read_line(line: str, let: dict[str, object], found: dict[str, Statement]) -> None:
    """An abbreviation, or a statement."""
    if match := LET.fullmatch(line):
        let[match[1]] = replaced(read_expression(match[2]), let)
        return
    match = LINE.fullmatch(line)
    require(match, f"printed.txt: not a statement: {line[:60]}")
    sides = tuple(replaced(read_expression(side), let) for side in match[3].split(" = "))
    found[line] = Statement(match[1], tuple(match[2].split()), sides, match[4], line)


def replaced(e: object, values: dict[str, object]) -> object:
    """An expression, vector or motion with abbreviations written out."""
    if isinstance(e, str):
        return values.get(e, e)
    if isinstance(e, tuple):
        return tuple(replaced(part, values) for part in e)
    if not isinstance(e, list):
        return e
    return [e[0] if isinstance(e[0], str) else replaced(e[0], values), *(replaced(part, values) for part in e[1:])]


#: A pattern of names of drives; any other word stands for $.
PATTERN = re.compile(r"[*_]")

OPERATORS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.Pow: "^", ast.MatMult: "@"}


def read_expression(text: str) -> object:
    """An expression as a description writes it: prefix lists; a vector as a tuple, a motion as a list of factors."""
    return _node(ast.parse(text, mode="eval").body)


def _node(node: ast.expr) -> object:
    match node:
        case ast.Name(name):
            return ["pi"] if name == "pi" else name
        case ast.Constant(int() as value):
            return value
        case ast.Constant(float() as value):
            exact = Fraction(str(value))
            return ["/", exact.numerator, exact.denominator]
        case ast.Tuple(elements):
            return tuple(map(_node, elements))
        case ast.UnaryOp(ast.USub(), operand):
            return ["*", -1, _node(operand)]
        case ast.BinOp(left, ast.Pow(), ast.Constant(int() as power)):
            return ["^", _node(left), power]
        case ast.BinOp(left, operator, right):
            a, b = _node(left), _node(right)
            match OPERATORS[type(operator)]:
                case "@":
                    return [*a, *b]
                case "-":
                    return ["+", a, ["*", -1, b]]
                case "/" if isinstance(a, int) and isinstance(b, int):
                    return ["/", a, b]
                case "/" if isinstance(b, int):
                    return ["*", ["/", 1, b], a]
                case "/":
                    return ["*", a, ["^", b, -1]]
                case sign:
                    return [sign, a, b]
        case ast.Call(ast.Name("T"), parts):
            return [["translation", [_node(part) for part in parts]]]
        case ast.Call(ast.Name("F"), columns):
            return [["placement", [list(_node(column)) for column in columns]]]
        case ast.Call(ast.Name("Rx" | "Ry" | "Rz" as name), [angle]):
            return [["rotation", name[1], _node(angle)]]
        case ast.Call(ast.Name(name), parts):
            return [name, *map(_node, parts)]
    raise Rejected(f"printed.txt: {ast.unparse(node)[:60]} has no meaning")


# ---- a description at random values ----------------------------------------------------------------------------------


class Described:
    """A description beside random values of all that it does not define."""

    def __init__(self, description: dict):
        self.description = description
        self.named = {entry["name"]: entry["value"] for entry in description["definitions"]}
        self.parameters = [key["symbol"]["name"] for key in description["keys"]]
        self.entries = {body["name"]: body for body in description["bodies"]} | {
            f"{region['member']}/{region['region']}": region for region in description["regions"]
        }
        self.said = dict(said_of(description))

    def reader(self, rng: Random, along: tuple[str, ...] = (), free: tuple[str, ...] = ()) -> Reader:
        """Values of one draw, with rates along some symbols; ``free`` are drawn although they are defined."""

        def drawn(name: str) -> Number:
            if name == self.parameters[0]:
                return Number(rng.choice((1, CODE.PRIME - 1)))
            value = once(rng, ("value", name), lambda: rng.randrange(1, CODE.PRIME))
            return Number(value, tuple(int(name == other) for other in along), {name: Fraction(1)})

        def made() -> Reader:
            circle = once(rng, "circle", lambda: CODE.Circle(rng, True))
            run = CODE.Machine({}, CODE.Function("description", {}, {}), None, circle)
            named = {name: value for name, value in self.named.items() if name not in (*along, *free)}
            entries = {name.replace("/", "_"): entry for name, entry in self.entries.items()}
            return Open(named, once(rng, "axes", lambda: axes(self.parameters, circle)), run, drawn, entries)

        return once(rng, ("described", along, free), made)


def axes(parameters: list[str], circle: object) -> dict[str, Number]:
    """Parameters that are the components of the axes of a placed frame, `xg_x` to `zg_z`: a random rotation."""
    frames = [p[:-3] for p in parameters if p.startswith("xg") and p.endswith("_x")]
    names = [tuple(f"{axis}g_{part}" for axis in "xyz" for part in "xyz")] if frames else []
    return {key: Number(value) for key, value in CODE.axes(tuple(names), circle).items()}


class Open(Reader):
    """A reader that draws what is not defined, and knows surfaces, substitutions and derivatives.

    ``r_of_wheel_x``, ``n_of_wheel_x``: point and unit normal of a surface in its body's frame; ``f_of_wheel``: its
    condition; ``at(e, name, value, …)``: an expression at other values; ``d(e, name)``: its derivative.
    """

    def __init__(self, named: dict, values: dict, run: object, draw: object, entries: dict):
        super().__init__(named, values, run)
        self.draw, self.entries = draw, entries

    def at(self, values: dict) -> Open:
        there = super().at(values)
        return Open(there.named, there.values, self.run, self.draw, self.entries)

    def __call__(self, e: object) -> Number:
        match e:
            case ["at", inside, *pairs]:
                return self.at({pairs[k]: self(pairs[k + 1]) for k in range(0, len(pairs), 2)})(inside)
            case ["min", first, *others]:
                least = self(first)
                for other in map(self, others):
                    apart = FUNCTIONS["abs"](self.run, CODE.add(least, other, -1))
                    least = CODE.multiply(HALF, CODE.add(CODE.add(least, other), apart, -1))
                return least
            case ["d", inside, str() as name]:
                here = self(name)
                return rate(self.at({name: Number(here.value, (1,), here.form)})(inside), 0)
        return super().__call__(e)

    def _defined(self, name: str) -> Number:
        if name in self.named:
            return super()._defined(name)
        of = OF.fullmatch(name)
        if of and of[2] in self.entries:
            surface = Surface(self, self.entries[of[2]]["surface"], [])
            if of[1] == "f":
                return self(surface.surface["conditions"][0])
            return (surface.point if of[1] == "r" else surface.normal)["xyz".index(of[3])]
        self.values[name] = self.draw(name)
        return self.values[name]


FUNCTIONS, HALF = DESCRIBED.FUNCTIONS, DESCRIBED.literal(Fraction(1, 2))
OF = re.compile(r"([rnf])_of_(\w+?)(?:_([xyz]))?")


# ---- statements ------------------------------------------------------------------------------------------------------


def check_statement(drive: Described, statement: Statement, rng: Random) -> None:
    """What is printed is what the description says."""
    SUBJECTS.get(statement.kind, subject_entry)(drive, statement, rng)


def same(found: Number, expected: Number, statement: Statement) -> None:
    require((found.value - expected.value) % CODE.PRIME == 0, f"not as printed ({statement.source}): {statement.text}")


def subject_rule(drive: Described, statement: Statement, rng: Random) -> None:
    """Every rule for a parameter, or one by its place among them, satisfies the printed relation."""
    target, *place = statement.about
    values = [value for name, value in DESCRIBED.given_rules(drive) if name == target]
    require(values, f"no rule for {target}")
    reader = drive.reader(rng)
    for value in [values[int(place[0]) - 1]] if place else values:
        there = reader.at({target: reader(value)})
        same(there(statement.sides[0]), there(statement.sides[1]), statement)


def subject_where(drive: Described, statement: Statement, rng: Random) -> None:
    """A printed relation between what the description defines."""
    reader = drive.reader(rng)
    same(reader(statement.sides[0]), reader(statement.sides[1]), statement)


def subject_signed(drive: Described, statement: Statement, rng: Random) -> None:
    """The same where the square of a sign has to be 1."""
    with CODE.real_signs():
        subject_where(drive, statement, Draw(rng.sign))


def subject_entry(drive: Described, statement: Statement, rng: Random) -> None:
    """An entry of the description: what is printed of it, component by component."""
    key = (statement.kind, *statement.about)
    require(key in drive.said, f"the description has no {' '.join(key)}")
    found, printed = drive.said[key], statement.sides[0]
    reader = drive.reader(rng)
    pairs = zip(found, printed, strict=True) if isinstance(printed, tuple) else [(found, printed)]
    for a, b in pairs:
        same(reader(a), reader(b), statement)


def carried_alike(drive: Described, found: list, statement: Statement, rng: Random) -> None:
    """Two motions carry any point to the same place."""
    reader = drive.reader(rng)
    point = [Number(rng.randrange(1, CODE.PRIME)) for _ in range(3)]
    (printed,) = statement.sides
    for a, b in zip(reader.carried(found, point), reader.carried(printed, point), strict=True):
        same(a, b, statement)


def subject_root(drive: Described, statement: Statement, rng: Random) -> None:
    """Every value of a result makes an expression zero, and no two are the same."""
    values, reader = drive.said["function", *statement.about], drive.reader(rng)
    found = list(map(reader, values if isinstance(values[0], list) else [values]))
    require(len({str(value.form) for value in found}) == len(found), f"one root twice: {statement.text}")
    for value in found:
        same(reader.at({statement.about[1]: value})(statement.sides[0]), Number(0), statement)


def subject_motion(drive: Described, statement: Statement, rng: Random) -> None:
    carried_alike(drive, drive.entries[statement.about[0]]["motion"], statement, rng)


def subject_generation(drive: Described, statement: Statement, rng: Random) -> None:
    steps = [step for step in drive.entries[statement.about[0]]["surface"]["made"] if step["step"] == "envelope"]
    require(steps, f"{statement.about[0]} is no envelope")
    carried_alike(drive, steps[-1]["motion"], statement, rng)


def subject_sweep(drive: Described, statement: Statement, rng: Random) -> None:
    carried_alike(drive, first_step(drive, statement)["motion"], statement, rng)


def first_step(drive: Described, statement: Statement) -> dict:
    return drive.entries[statement.about[0]]["surface"]["made"][0]


def subject_curve(drive: Described, statement: Statement, rng: Random) -> None:
    step, reader = first_step(drive, statement), drive.reader(rng)
    for a, b in zip(step.get("curve") or step["point"], statement.sides[0], strict=True):
        same(reader(a), reader(b), statement)


def subject_normal(drive: Described, statement: Statement, rng: Random) -> None:
    """The outward normal in the frame of the tool's edge, of any positive length."""
    reader = drive.reader(rng)
    found = unit(reader.vector(drive.entries[statement.about[0]]["surface"]["normal"]))
    printed = unit(reader.vector(list(statement.sides[0])))
    for a, b in zip(found, printed, strict=True):
        same(a, b, statement)


def subject_condition(drive: Described, statement: Statement, rng: Random) -> None:
    """A condition that a surface keeps, by its place."""
    place, *number = statement.about
    conditions = drive.entries[place]["surface"]["conditions"]
    reader = drive.reader(rng)
    same(reader(conditions[int(number[0]) - 1 if number else 0]), reader(statement.sides[0]), statement)


#: Kinds of statements of which more is to be known than that an entry is what is printed.
SUBJECTS = {
    "rule": subject_rule,
    "where": subject_where,
    "signed": subject_signed,
    "root": subject_root,
    "motion": subject_motion,
    "generation": subject_generation,
    "sweep": subject_sweep,
    "curve": subject_curve,
    "normal": subject_normal,
}


def said_of(d: dict) -> Iterator[tuple[tuple[str, ...], object]]:
    """Every entry of a description that a statement can be about, and its value. Which curves, motions, rules and
    normals there are follows here too; their own subjects read them.
    """
    places: dict[tuple[str, str], int] = {}
    rules = [(key["symbol"]["name"], key["default"]) for key in d["keys"] if key["default"] is not None]
    for kind, listed in (("rule", [*rules, *d["rules"]]), ("proportion", d["proportions"])):
        for target, value in listed:
            places[kind, target] = places.get((kind, target), 0) + 1
            yield (kind, target, str(places[kind, target])), value
    for k, guard in enumerate(d["guards"], 1):
        yield ("guard", str(k)), guard["positive"]
    for size in d["sizes"]:
        yield ("size", size["key"]), size["value"]
    for entry in (*d["bodies"], *d["regions"]):
        yield from said_of_surface(entry)
    for key in ("ratio", "wheel_angle", "reference_angle"):
        yield ("contact", key), d["contact"][key]
    for unknown in d["contact"]["unknowns"]:
        yield ("scale", unknown["name"]), unknown["scale"]
    start = d["start"]
    for name, value in start["solution"].items():
        yield ("start", name), value
    systems = [("start", start), *((system["name"], system) for system in d["design_systems"])]
    for name, system in systems:
        for unknown in system["unknowns"]:
            yield ("scale", name, unknown["name"]), unknown["scale"]
        for k, row in enumerate(system["residual"], 1):
            yield ("equation", name, str(k)), row
        for key in ("guess", "fills", "fixed"):
            for symbol, value in system.get(key, {}).items():
                yield (key, name, symbol), value
        if system.get("regular"):
            yield ("regular", name), system["regular"]["sign"]
    for function in d["functions"]:
        for result in function["results"]:
            values = result["values"]
            yield ("function", function["name"], result["name"]), values if len(values) > 1 else values[0]


def said_of_surface(entry: dict) -> Iterator[tuple[tuple[str, ...], object]]:
    name = entry.get("name") or f"{entry['member']}/{entry['region']}"
    if "motion" in entry:
        yield ("motion", name), None
    for kind in ("curve", "sweep", "normal"):
        yield (kind, name), None
    if any(step["step"] == "envelope" for step in entry["surface"]["made"]):
        yield ("generation", name), None
    for margin in entry["margins"]:
        along = margin["along"]
        kind = ("margin", name, margin["event"]) if along is None else ("growth", name, margin["event"], along)
        yield kind, margin["positive"]
    if entry["regular"] is not None:
        yield ("regular", name), entry["regular"]
    for symbol, value in entry.get("reference", {}).items():
        yield ("reference", name, symbol), value
    for k, condition in enumerate(entry["surface"]["conditions"], 1):
        yield ("condition", name, str(k)), condition


def check_said(drive: Described, statements: list[Statement]) -> None:
    """Nothing of the description is left unsaid, but for what is listed as open and what a law says."""
    about = {("function" if s.kind == "root" else s.kind, *s.about) for s in statements}
    about |= {s.about for s in statements if s.kind == "open"}
    for key in drive.said:
        kind, name, *_ = key
        first = key[:-1] if key[-1] == "1" else key
        law = kind == "condition" and len(drive.entries[name]["surface"]["made"]) > 1
        if kind == "rule":
            first = key[:-1]
        require(key in about or first in about or law, f"nothing says what {' '.join(key)} is")


# ---- laws ------------------------------------------------------------------------------------------------------------


def chain_of(entry: dict) -> tuple[list, list, list[str]]:
    """Edge or given point, the whole motion that carries it, and the variables of its generating motions."""
    first, *steps = entry["surface"]["made"]
    motion, variables = list(first["motion"]), []
    for step in steps:
        if step["step"] in ("moved", "envelope"):
            motion = [*step["motion"], *motion]
        if step["step"] == "envelope":
            variables.append(step["variable"])
    return first.get("curve") or first["point"], motion, variables


def merged(drive: Described, entry: dict, reader: Reader) -> Reader:
    """With what a sum of two angles leaves for the one that it replaced."""
    for step in entry["surface"]["made"]:
        if step["step"] == "merged" and step["removed"] not in drive.named:
            reader = reader.at({step["removed"]: CODE.add(reader(step["total"]), reader(step["kept"]), -1)})
    return reader


def check_made(drive: Described, place: str, rng: Random) -> None:
    """The surface's point is the edge carried by its chain."""
    entry = drive.entries[place]
    reader = merged(drive, entry, drive.reader(rng))
    edge, motion, _ = chain_of(entry)
    found = Surface(reader, entry["surface"], []).point
    expected = reader.carried(motion, reader.vector(edge))
    for a, b in zip(found, expected, strict=True):
        require((a.value - b.value) % CODE.PRIME == 0, f"{place}: the point is not the edge carried by its chain")


def check_enveloping(drive: Described, place: str, rng: Random) -> None:
    """n . dr is zero along every parameter of the tool and of the generating motions, or is the condition that is left
    (power of the normal on the blank, which moves against the tool).
    """
    entry = drive.entries[place]
    edge, motion, variables = chain_of(entry)
    steps = entry["surface"]["made"]
    parameters = {q["name"] for q in entry["surface"]["parameters"]} | set(variables)
    parameters |= {step["parameter"] for step in steps if step["step"] == "solved"}
    parameters |= {step["kept"] for step in steps if step["step"] == "merged"}
    along = sorted(parameters & DESCRIBED.names_in(["", *edge, *names_of(motion)], {}))
    solved = merged(drive, entry, drive.reader(rng))
    normal = Surface(solved, entry["surface"], []).outward
    here = {name: solved(name) for name in along}
    moving = solved.at({
        name: Number(number.value, tuple(int(name == other) for other in along), number.form)
        for name, number in here.items()
    })  # fmt: skip
    point = moving.carried(motion, moving.vector(edge))
    left = [] if steps[-1]["step"] == "solved" else [solved(c).value for c in entry["surface"]["conditions"]]
    for k, name in enumerate(along):
        found = inner(normal, [rate(p, k) for p in point]).value
        expected = left[0] if left and name in variables else 0
        require(
            (found + expected) % CODE.PRIME == 0,
            f"{place}: the normal against the motion along {name} is not {'the condition' if expected else 'zero'}",
        )


def names_of(motion: list) -> list[object]:
    """What stands in a motion, as one expression a factor."""
    return [flattened(data) for _, *data in motion]


def flattened(data: object) -> object:
    """Nested lists of expressions as one."""
    return ["", *map(flattened, data)] if isinstance(data, list) else data


def check_contact(drive: Described, rng: Random) -> None:
    """Distance of the placed points, and one flank's normal against two directions in the other's tangent plane."""
    try:
        check_tangency(drive, *drive.description["bodies"], rng)
    except Rejected:
        check_tangency(drive, *reversed(drive.description["bodies"]), rng)


def check_tangency(drive: Described, plane: dict, other: dict, rng: Random) -> None:
    described, reader = drive.description, drive.reader(rng)
    first, second = (Surface(reader, body["surface"], body["motion"]) for body in (plane, other))
    residual = [reader(row) for row in described["contact"]["residual"]]
    apart = [CODE.add(a, b, -1) for a, b in zip(first.point, second.point, strict=True)]
    require(
        (inner(apart, apart).value - inner(residual[:3], residual[:3]).value) % CODE.PRIME == 0,
        "contact: the first three rows are not the distance of the points",
    )
    tangents = [reader.carried(first.motion, reader.vector(t), free=True) for t in plane["surface"]["tangents"][:2]]
    require(any(n.value for n in DESCRIBED.cross(*tangents)), "contact: the two directions are one")
    for row, tangent in zip(residual[3:5], tangents, strict=True):
        require(inner(first.outward, tangent).value == 0, "contact: a direction is not in the tangent plane")
        require(
            (row.value - inner(second.outward, tangent).value) % CODE.PRIME == 0,
            "contact: a row is not one normal against a tangent of the other",
        )


def slopes_of(drive: Described) -> Iterator[tuple[str, str, str]]:
    """Definitions named after another and one of the surfaces' parameters."""
    symbols = {q["name"] for entry in drive.entries.values() for q in entry["surface"]["parameters"]}
    for name in drive.named:
        for symbol in symbols:
            if name.endswith(f"_{symbol}") and name[: -len(symbol) - 1] in drive.named:
                yield name, name[: -len(symbol) - 1], symbol


def check_slope(drive: Described, name: str, of: str, symbol: str, rng: Random) -> None:
    reader = drive.reader(rng, (symbol,))
    number = reader(drive.named[of])
    require(
        (reader(drive.named[name]).value - rate(number, 0).value) % CODE.PRIME == 0,
        f"{name} is not the derivative of {of}",
    )


# ---- all -------------------------------------------------------------------------------------------------------------


def statements_of(name: str, printed: list) -> list[Statement]:
    """What is printed of a drive."""
    common: dict[str, object] = {}
    chosen: list[Statement] = []
    for statement in (s for patterns, found in printed if is_about(name, patterns) for s in found):
        sides = tuple(replaced(side, common) for side in statement.sides)
        if statement.kind == LET_ALONE:
            common[statement.about[0]] = sides[0]
        else:
            chosen.append(replace(statement, sides=sides))
    return chosen


def checks_of(drive: Described, name: str, printed: list) -> Iterator[tuple[str, tuple]]:
    """Words, and a check with its arguments."""
    for statement in statements_of(name, printed):
        if statement.kind != "open":
            yield statement.text, (check_statement, drive, statement)
    for place in drive.entries:
        yield f"chain of {place}", (check_made, drive, place)
        yield f"enveloping of {place}", (check_enveloping, drive, place)
    yield "contact", (check_contact, drive)
    for words in slopes_of(drive):
        yield f"slope {words[0]}", (check_slope, drive, *words)


def check_drive(path: Path, printed: list) -> int:
    """All checks of one description; how many were made."""
    try:
        drive, draws = Described(json.loads(path.read_text(encoding="utf-8"))), (Draws(1), Draws(-1))
        checks = list(checks_of(drive, path.stem, printed))
        known = any(is_about(path.stem, [p for p in patterns if p != "*"]) for patterns, _ in printed)
        require(known, "nothing printed is known of this drive")
        check_said(drive, statements_of(path.stem, printed))
        for words, check in checks:
            try:
                attempt(*check, draws=draws)
            except (LookupError, ValueError, AttributeError, TypeError, ArithmeticError, StopIteration) as error:
                raise Rejected(f"{words}: {error!r}") from error
    except (Rejected, ValueError, LookupError) as error:
        raise Rejected(f"{path.name}: {error}") from error
    return len(checks)


def verify(folder: Path, drives: list[str]) -> tuple[int, int]:
    """Drives and checks, of all drives if none is named; Rejected if one fails."""
    printed = read_printed(Path(__file__).with_name("printed.txt").read_text(encoding="utf-8"))
    described = folder.parent / "descriptions"
    paths = [described / f"{name}.json" for name in drives] or sorted(described.glob("*.json"))
    missing = [path.name for path in paths if not path.is_file()]
    require(paths and not missing, f"{described}: no {', '.join(missing) or 'description'}")
    return len(paths), sum(check_drive(path, printed) for path in paths)


def main(arguments: list[str]) -> int:
    try:
        drives, checks = verify(Path(arguments[0] if arguments else Path(__file__).parent), arguments[1:])
    except Rejected as reason:
        print(f"REJECTED: {reason}", file=sys.stderr)
        return 1
    print(f"{checks} checks of {drives} descriptions hold: as printed, made, enveloping, contact, slopes")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
