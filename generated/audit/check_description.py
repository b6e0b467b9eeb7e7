#!/usr/bin/env python3
"""Check the generated C against the description of its drive: `python check_description.py [folder [drive …]]`,
exit status 0 if everything holds.

The description is plain data (``descriptions/<drive>.json``): motions are lists of factors, expressions prefix lists.
Both it and the C functions are evaluated modulo a prime of 61 bits drawn at random, at random parameters, unknowns and
points of the circle; derivatives are those of dual numbers. Then, for every drive:

  rules      each default and each rule of a design, in its order
  sizes      derived sizes
  residual   of contact and start; natural sizes, guess and first contact
  chain      a point is carried by the factors of its motions, a normal turned by them and divided by its length, in the
             observation and on each flank; tangents are derivatives, fixed frame
  limits     margins, relative ones and derivatives among them, conditions, recovered parameters, wheel's angle
  functions  results of whatever else the drive offers

A normal that points the other way has the same length and is refused. A wrong program passes with a probability of
about degree / 2^61. Needs check.py and check_code.py beside it and nothing else.
"""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Iterator, Mapping
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


CODE = _beside("check_code")
Rejected, require, Number, Machine, Function = CODE.Rejected, CODE.require, CODE.Number, CODE.Machine, CODE.Function

#: Axis of a rotation -> the two components that it mixes, in their order.
MIXED = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}
ONE = Number(1)


class Reader:
    """Evaluates a description at one input: named values, and whatever the definitions make of them."""

    def __init__(self, named: Mapping[str, object], values: Mapping[str, Number], run: Machine):
        self.named, self.values, self.run = named, dict(values), run

    def at(self, values: Mapping[str, Number]) -> Reader:
        """The same with some values replaced; definitions are evaluated anew."""
        own = {name: value for name, value in self.values.items() if name not in self.named}
        return Reader({name: value for name, value in self.named.items() if name not in values}, own | values, self.run)

    def __call__(self, e: object) -> Number:
        match e:
            case str():
                if e not in self.values:
                    require(e in self.named, f"the description does not say what {e} is")
                    self.values[e] = self(self.named[e])
                return self.values[e]
            case int():
                return Number(e % CODE.PRIME, (), {})
            case ["/", p, q]:
                return literal(Fraction(p, q))
            case ["pi"]:
                return Number(CODE.PI, (), {"pi": Fraction(1)})
            case ["+", *terms]:
                total = self(terms[0])
                for term in terms[1:]:
                    total = CODE.add(total, self(term))
                return total
            case ["*", *factors]:
                return self._product(factors)
            case ["^", base, exponent]:
                return self._power(self(base), exponent)
            case [name, *operands] if name in FUNCTIONS:
                return FUNCTIONS[name](self.run, *map(self, operands))
        raise Rejected(f"{str(e)[:40]} has no meaning in a description")

    def _product(self, factors: list) -> Number:
        """Exact numbers last: a multiple of an angle stays one."""
        exact, value = Fraction(1), None
        for factor in factors:
            if isinstance(factor, int):
                exact *= factor
            elif isinstance(factor, list) and factor[0] == "/":
                exact *= Fraction(factor[1], factor[2])
            else:
                number = self(factor)
                value = number if value is None else CODE.multiply(value, number)
        if value is None or exact == 1:
            return value or literal(exact)
        form = Number(value.value, value.rates, value.form)
        return CODE.scaled(form, exact, CODE.multiply(form, literal(exact)))

    @staticmethod
    def _power(base: Number, exponent: object) -> Number:
        power = Fraction(exponent) if isinstance(exponent, int) else Fraction(exponent[1], exponent[2])
        require(power.denominator in (1, 2), f"a power of {power} is not foreseen")
        base = base if power.denominator == 1 else CODE.root(base)
        value = ONE
        for _ in range(abs(power.numerator)):
            value = CODE.multiply(value, base)
        return value if power > 0 else CODE.divide(ONE, value)

    def vector(self, components: list) -> list[Number]:
        return [self(component) for component in components]

    def carried(self, motion: list, vector: list[Number], free: bool = False) -> list[Number]:
        """A point, or a free vector, carried by a motion: its last factor acts first."""
        for kind, *data in reversed(motion):
            match kind:
                case "rotation":
                    vector = self._turned(data[0], self(data[1]), vector)
                case "swing":
                    centre = [Number(0)] * 3 if free else self.vector(data[2])
                    arm = [CODE.add(a, c, -1) for a, c in zip(vector, centre, strict=True)]
                    vector = list(map(CODE.add, self._turned(data[0], self(data[1]), arm), centre))
                case "translation" | "station":
                    vector = vector if free else list(map(CODE.add, vector, self.vector(data[0])))
                case "placement":
                    columns = [self.vector(column) for column in data[0]]
                    vector = [inner(vector, [column[i] for column in columns]) for i in range(3)]
                case _:
                    raise Rejected(f"{kind} is no motion")
        return vector

    def _turned(self, axis: str, angle: Number, vector: list[Number]) -> list[Number]:
        cosine, sine = self.run.turned(angle)
        i, j = MIXED[axis]
        turned = list(vector)
        turned[i] = CODE.add(CODE.multiply(cosine, vector[i]), CODE.multiply(sine, vector[j]), -1)
        turned[j] = CODE.add(CODE.multiply(sine, vector[i]), CODE.multiply(cosine, vector[j]))
        return turned


def literal(exact: Fraction) -> Number:
    return Number(exact.numerator * pow(exact.denominator, -1, CODE.PRIME) % CODE.PRIME, (), {})


def inner(a: list[Number], b: list[Number]) -> Number:
    total = Number(0)
    for p, q in zip(a, b, strict=True):
        total = CODE.add(total, CODE.multiply(p, q))
    return total


def complement(a: Number) -> Number:
    return CODE.root(CODE.add(ONE, CODE.multiply(a, a), -1))


def unit_step(a: Number) -> Number:
    return CODE.multiply(literal(Fraction(1, 2)), CODE.add(ONE, CODE.sign(a)))


FUNCTIONS = {
    "sqrt": lambda run, a: CODE.root(a),
    "abs": lambda run, a: CODE.multiply(a, CODE.sign(a)),
    "sign": lambda run, a: CODE.sign(a),
    "unit_step": lambda run, a: unit_step(a),
    "excess": lambda run, a: CODE.multiply(a, unit_step(a)),
    "sin": lambda run, a: run.turned(a)[1],
    "cos": lambda run, a: run.turned(a)[0],
    "tan": lambda run, a: CODE.divide(*reversed(run.turned(a))),
    "asin": lambda run, a: run.arc(a, complement(a)),
    "acos": lambda run, a: run.arc(complement(a), a),
    "atan": lambda run, a: run.arc(a, ONE),
    "atan2": lambda run, y, x: run.arc(y, x),
}


# ---- a drive: its description beside its functions -------------------------------------------------------------------


class Drive:
    """What is compared: the description, the header, and inputs for both."""

    def __init__(self, description: dict, text: str):
        self.description, self.text = description, text
        self.header = CODE.read_header(text)
        self.prefix = re.search(r"static inline int (\w+)_setup\(", text)[1]
        self.named = {entry["name"]: entry["value"] for entry in description["definitions"]}
        self.parameters = self._names("parameter")
        self.unknowns = self._names("unknown")

    def _names(self, kind: str) -> list[str]:
        table = re.search(rf"_{kind}_names\[\] = {{\n(.*?)\n}};", self.text, re.DOTALL)[1]
        return re.findall(r'^\s*{ "([^"]*)"', table, re.M)

    def function(self, name: str) -> Function:
        """A function of the header by its name without the prefix."""
        found = re.search(
            rf"((?:/\*(?:[^*]|\*(?!/))*\*/\s)*)static inline \w+ {self.prefix}_{name}\([^)]*\)\n{{\n(.*?)\n}}",
            self.text,
            re.DOTALL,
        )
        require(found, f"the header has no function {name}")
        table = {
            key: (int(at), int(size or 1))
            for at, key, size in re.findall(r"^ \* +(\d+) (\w+)(?:\[(\d+)\])?", found[1], re.M)
        }
        return Function(name, CODE.read_body(found[2]), table)

    def run(self, name: str, rng: Random, letter: str, symbols: list[str]) -> tuple[Machine, Reader]:
        """A function at random inputs, and the description at the same; rates are those along its own arguments."""
        base = CODE.machine(self.header, "eval", rng, True)
        inputs = {key: number for key, number in base.inputs.items() if key[:2] != "x["}
        own = {}
        for k in range(len(symbols)):
            key = f"{letter}[{k}]"
            rates = tuple(int(j == k) for j in range(len(symbols)))
            own[key] = Number(rng.randrange(1, CODE.PRIME), rates, {f"{name} {key}": Fraction(1)})
        machine = Machine(inputs | own, self.function(name), base.earlier, base.circle)
        values = {symbol: inputs[f"p[{k}]"] for k, symbol in enumerate(self.parameters)}
        values[self.description["contact"]["instant"]["name"]] = inputs["phi"]
        values |= dict(zip(symbols, own.values(), strict=True))
        return machine, Reader(self.named, values, machine)


def same(found: Number, expected: Number, words: str) -> None:
    require((found.value - expected.value) % CODE.PRIME == 0, f"{words} is not that of the description")


def rate(number: Number, place: int) -> Number:
    """Derivative along an argument."""
    return Number(number.rates[place] if number.rates else 0)


BLOCK = re.compile(r"    if \(p\[(\d+)\] != p\[\1\]\) {[^\n]*\n(.*?)\n    }", re.DOTALL)


def check_rules(drive: Drive, number: int, rng: Random) -> None:
    """One default or rule, by its place in their order."""
    given = given_rules(drive)
    blocks = BLOCK.findall(CODE.body_of(drive.text, f"{drive.prefix}_derive"))
    require(len(blocks) == len(given), f"derive: {len(blocks)} rules, the description has {len(given)}")
    place, body = int(blocks[number][0]), blocks[number][1]
    target, value = given[number]
    require(drive.parameters[place] == target, f"derive: rule {number} fills in {drive.parameters[place]}")
    base = CODE.machine(drive.header, "eval", rng, True)
    inputs = {key: entry for key, entry in base.inputs.items() if key[0] == "p" and key != f"p[{place}]"}
    run = Machine(inputs, Function("derive", CODE.read_body(body), {}), None, base.circle)
    values = {name: inputs[f"p[{k}]"] for k, name in enumerate(drive.parameters) if k != place}
    same(run.value(f"p[{place}]"), Reader(drive.named, values, run)(value), f"derive: rule {number} for {target}")


def given_rules(drive: Drive) -> list[tuple[str, object]]:
    defaults = [(key["symbol"]["name"], key["default"]) for key in drive.description["keys"]]
    return [pair for pair in defaults if pair[1] is not None] + [tuple(rule) for rule in drive.description["rules"]]


def check_sizes(drive: Drive, number: int, rng: Random) -> None:
    run, reader = drive.run("size", rng, "q", [])
    entry = drive.description["sizes"][number]
    same(run.value(f"d[{number}]"), reader(entry["value"]), f"size: {entry['key']}")


def check_contact(drive: Drive, number: int, rng: Random) -> None:
    run, reader = drive.run("eval", rng, "x", drive.unknowns)
    same(run.value(f"R[{number}]"), reader(drive.description["contact"]["residual"][number]), f"eval: R[{number}]")


def check_scales(drive: Drive, rng: Random) -> None:
    run, reader = drive.run("scale", rng, "q", [])
    for k, unknown in enumerate(drive.description["contact"]["unknowns"]):
        require(unknown["name"] == drive.unknowns[k], f"scale: unknown {k} is {drive.unknowns[k]}")
        same(run.value(f"new x[{k}]"), reader(unknown["scale"]), f"scale: of {unknown['name']}")


def check_start(drive: Drive, name: str, key: str, number: int, rng: Random) -> None:
    """A row of a function of the start system: its outputs by the entry of the description."""
    start = drive.description["start"]
    symbols = [unknown["name"] for unknown in start["unknowns"]]
    computed = name in ("start_eval", "start_solution")
    run, reader = drive.run(name, rng, "y" if computed else "q", symbols if computed else [])
    reader = reader.at({symbol: reader(value) for symbol, value in start["fixed"].items()})
    match key:
        case "residual":
            found, expected = f"R[{number}]", start["residual"][number]
        case "scale":
            found, expected = f"y[{number}]", start["unknowns"][number]["scale"]
        case "guess":
            found, expected = f"y[{number}]", start["guess"][symbols[number]]
        case _:
            found, expected = f"new x[{number}]", start["solution"][drive.unknowns[number]]
    same(run.value(found), reader(expected), f"{name}: {found}")


class Surface:
    """A surface of the description at one input."""

    def __init__(self, reader: Reader, surface: dict, motion: list):
        self.reader, self.surface = reader, surface
        self.motion = [*motion, *surface["motion"]]
        self.point = reader.carried(self.motion, reader.vector(surface["point"]))

    @property
    def normal(self) -> list[Number]:
        normal = self.reader.carried(self.motion, self.reader.vector(self.surface["normal"]), free=True)
        length = CODE.root(inner(normal, normal))
        return [CODE.divide(component, length) for component in normal]


def margin_of(reader: Reader, margin: dict, entry: dict, places: dict[str, int]) -> Number:
    """Value of a margin; coordinates of its body stand for the surface's own point."""

    def at(values: Reader) -> Number:
        names = entry.get("coordinates") or []
        if names:
            local = Surface(values, entry["surface"], []).point
            values = values.at(dict(zip(names, local, strict=True)))
        number = values(margin["positive"])
        return number if margin["along"] is None else rate(number, places[margin["along"]])

    if not margin["relative"]:
        return at(reader)
    there = {}
    for symbol, value in entry["reference"].items():
        own = reader.values[symbol].rates
        number = reader(value)
        there[symbol] = Number(number.value, own, number.form)
    return CODE.divide(at(reader), at(reader.at(there)))


def check_observed(drive: Drive, key: str, rng: Random) -> None:
    """One named output of the observation."""
    run, reader = drive.run("observe", rng, "x", drive.unknowns)
    found, expected = read(run, key), observed(drive, reader, key)
    for k, number in enumerate(found):
        same(number, expected[k], f"observe: {key}[{k}]")


def observed(drive: Drive, reader: Reader, key: str) -> list[Number]:
    places = {name: k for k, name in enumerate(drive.unknowns)}
    for body in drive.description["bodies"]:
        name = body["name"]
        if key in (f"point_{name}_f", f"normal_{name}_f"):
            placed = Surface(reader, body["surface"], body["motion"])
            return placed.point if key.startswith("point") else placed.normal
        if key == f"point_{name}":
            return Surface(reader, body["surface"], []).point
        for parameter in body["surface"]["parameters"]:
            if key == f"tangent_{parameter['name']}":
                placed = Surface(reader, body["surface"], body["motion"])
                return [rate(number, places[parameter["name"]]) for number in placed.point]
        for margin in body["margins"]:
            if key == f"margin_{name}_{margin['event']}":
                return [margin_of(reader, margin, body, places)]
    return [reader(drive.description["contact"]["wheel_angle"] if key == "wheel_angle" else key)]


def observed_keys(drive: Drive) -> list[str]:
    """Outputs of the observation of which the description says the value."""
    bodies = drive.description["bodies"]
    keys = ["wheel_angle", *(q["name"] for body in bodies for q in body["recovered"])]
    for body in bodies:
        name = body["name"]
        keys += [f"point_{name}_f", f"normal_{name}_f", f"point_{name}"]
        keys += [f"tangent_{q['name']}" for q in body["surface"]["parameters"]]
        keys += [f"margin_{name}_{margin['event']}" for margin in body["margins"]]
    return keys


def read(run: Machine, key: str) -> list[Number]:
    require(key in run.function.outputs, f"{run.function.name}: no output {key}")
    at, size = run.function.outputs[key]
    return [run.value(f"o[{at + k}]") for k in range(size)]


def check_surface(drive: Drive, entry: dict, name: str, key: str, rng: Random) -> None:
    """One named output of a flank or region, in its body's frame."""
    symbols = [q["name"] for q in entry["surface"]["parameters"]]
    run, reader = drive.run(name, rng, "q", symbols)
    surface = Surface(reader, entry["surface"], [])
    if key in ("point", "normal"):
        expected = getattr(surface, key)
    elif key.startswith("condition_"):
        expected = [reader(entry["surface"]["conditions"][int(key[len("condition_") :])])]
    else:
        margin = next(m for m in entry["margins"] if key == f"margin_{m['event']}")
        expected = [margin_of(reader, margin, entry, {symbol: k for k, symbol in enumerate(symbols)})]
    for k, number in enumerate(read(run, key)):
        same(number, expected[k], f"{name}: {key}[{k}]")


def check_function(drive: Drive, entry: dict, result: dict, rng: Random) -> None:
    """One result of a function that the drive offers."""
    run, reader = drive.run(entry["name"], rng, "q", [q["name"] for q in entry["arguments"]])
    found = read(run, result["name"])
    require(len(found) == len(result["values"]), f"{entry['name']}: {result['name']} has another length")
    for k, (number, value) in enumerate(zip(found, result["values"], strict=True)):
        same(number, reader(value), f"{entry['name']}: {result['name']}[{k}]")


def checks_of(drive: Drive) -> Iterator[tuple[str, tuple]]:
    """Words, and a check with its arguments."""
    described = drive.description
    for k, (target, _) in enumerate(given_rules(drive)):
        yield f"rule {k} for {target}", (check_rules, drive, k)
    for k, entry in enumerate(described["sizes"]):
        yield f"size {entry['key']}", (check_sizes, drive, k)
    for k in range(len(described["contact"]["residual"])):
        yield f"residual {k} of the contact", (check_contact, drive, k)
    yield "natural sizes of the unknowns", (check_scales, drive)
    start = described["start"]
    rows = {
        "start_eval": ("residual", len(start["residual"])),
        "start_scale": ("scale", len(start["unknowns"])),
        "guess": ("guess", len(start["unknowns"])),
        "start_solution": ("solution", len(drive.unknowns)),
    }
    for name, (key, count) in rows.items():
        for k in range(count):
            yield f"{key} {k} of the start", (check_start, drive, name, key, k)
    for key in observed_keys(drive):
        yield f"{key} of the observation", (check_observed, drive, key)
    surfaces = [(body, f"flank_{body['name']}") for body in described["bodies"]]
    surfaces += [(region, f"{region['region']}_{region['member']}") for region in described["regions"]]
    for entry, name in surfaces:
        conditions = [f"condition_{k}" for k in range(len(entry["surface"]["conditions"]))]
        for key in ("point", "normal", *conditions, *(f"margin_{m['event']}" for m in entry["margins"])):
            yield f"{key} of {name}", (check_surface, drive, entry, name, key)
    for entry in described["functions"]:
        for result in entry["results"]:
            yield f"{result['name']} of {entry['name']}", (check_function, drive, entry, result)


def check_drive(description: Path, header: Path) -> int:
    """All checks of one drive; how many were made."""
    try:
        drive = Drive(
            json.loads(description.read_text(encoding="utf-8")), header.read_text(encoding="utf-8")
        )
        checks = list(checks_of(drive))
        for _, check in checks:
            CODE.attempt(*check)
    except (Rejected, LookupError, ValueError, AttributeError, TypeError, ArithmeticError) as error:
        raise Rejected(f"{header.name}: {error}") from error
    return len(checks)


def verify(folder: Path, drives: list[str]) -> tuple[int, int]:
    """Drives and checks, of all drives if none is named; Rejected if one fails."""
    described = folder.parent / "descriptions"
    descriptions = [described / f"{name}.json" for name in drives] or sorted(described.glob("*.json"))
    missing = [path.name for path in descriptions if not path.is_file()]
    require(descriptions and not missing, f"{described}: no {', '.join(missing) or 'description'}")
    return len(descriptions), sum(check_drive(path, folder.parent / "c" / f"{path.stem}.h") for path in descriptions)


def main(arguments: list[str]) -> int:
    try:
        drives, checks = verify(Path(arguments[0] if arguments else Path(__file__).parent), arguments[1:])
    except Rejected as reason:
        print(f"REJECTED: {reason}", file=sys.stderr)
        return 1
    print(
        f"{checks} checks of {drives} drives hold: rules, sizes, residuals, start, points, normals, tangents, margins "
        "and functions are those of the description"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
