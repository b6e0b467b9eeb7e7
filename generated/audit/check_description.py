#!/usr/bin/env python3
"""Check the generated C against the description of its drive: `python check_description.py [folder [drive …]]`,
exit status 0 if everything holds.

The description is plain data (``descriptions/<drive>.json``): motions are lists of factors, expressions prefix lists.
Both it and the C functions are evaluated modulo a prime of 61 bits drawn at random, at random parameters, unknowns and
points of the circle; derivatives are those of dual numbers. Then, for every drive:

  rules      each default and rule of a design, in its order; the change of each along changes of what it reads
  state      the parameters at its end
  systems    of a design: guess, natural sizes, equations with Jacobian, what they fill in, where they are regular,
             changes of equations and of what they fill in
  guards     what must be positive, in its order; divisors by the name in their message
  sizes      derived sizes
  residual   of contact and start; natural sizes, guess and first contact
  chain      a point is carried by the factors of its motions, a normal turned by them and divided by its length, in the
             observation and on each flank; tangents are derivatives, fixed frame
  limits     margins, relative ones and derivatives among them, conditions, recovered parameters, wheel's angle
  regular    the singular function of each flank and region
  forms      tangent basis, second forms by linear algebra of their own, principal curvatures by sum and product
  placement  motions of both bodies; axis and lever arm by what a change of the body's angle moves
  functions  results of whatever else the drive offers

A normal that points the other way has the same length and is refused. A wrong program passes with a probability of
about degree / 2^61. Needs check.py and check_code.py beside it and nothing else.
"""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Callable, Iterator, Mapping
from fractions import Fraction
from pathlib import Path
from random import Random, SystemRandom
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
#: Draws that all checks of a drive share.
KEPT = 200


class Reader:
    """Evaluates a description at one input: named values, and whatever the definitions make of them."""

    def __init__(self, named: Mapping[str, object], values: Mapping[str, Number], run: Machine):
        self.named, self.values, self.run = named, dict(values), run
        self.missing: set[str] = set()

    def at(self, values: Mapping[str, Number]) -> Reader:
        """The same with some values replaced; definitions are evaluated anew."""
        own = {name: value for name, value in self.values.items() if name not in self.named}
        return Reader({name: value for name, value in self.named.items() if name not in values}, own | values, self.run)

    def __call__(self, e: object) -> Number:
        match e:
            case str():
                return self.values[e] if e in self.values else self._defined(e)
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

    def _defined(self, name: str) -> Number:
        """A definition's value; one that rests on a missing root is not looked for twice."""
        require(name in self.named, f"the description does not say what {name} is")
        if name in self.missing:
            raise CODE.NoRoot
        try:
            self.values[name] = self(self.named[name])
        except CODE.NoRoot:
            self.missing.add(name)
            raise
        return self.values[name]

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

    def __init__(self, description: dict, text: str, tangents: str = ""):
        self.description, self.text, self.tangents = description, text, tangents
        self.functions: dict[str, Function] = {}
        self.header = CODE.read_header(text)
        self.prefix = re.search(r"static inline int (\w+)_setup\(", text)[1]
        self.named = {entry["name"]: entry["value"] for entry in description["definitions"]}
        self.parameters = self._names("parameter")
        self.unknowns = self._names("unknown")

    def _names(self, kind: str) -> list[str]:
        table = re.search(rf"_{kind}_names\[\] = {{\n(.*?)\n}};", self.text, re.DOTALL)[1]
        return re.findall(r'^\s*{ "([^"]*)"', table, re.M)

    def function(self, name: str) -> Function:
        """A function of the header by its name without the prefix; what it returns is o[0]."""
        if name not in self.functions:
            self.functions[name] = self._read(name)
        return self.functions[name]

    def _read(self, name: str) -> Function:
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
        body = re.sub(r"if \(q\[(\d+)\] != q\[\1\]\) (?=q\[\1\] = )", "", found[2])
        return Function(name, CODE.read_body(re.sub(r"\breturn (t\d+);", r"o[0] = \1;", body)), table)

    def base(self, rng: Random) -> Machine:
        """Parameters, input angle and unknowns of one draw, after setup and set_phi."""
        return once(rng, "base", lambda: CODE.machine(self.header, "eval", rng, True))

    def design(
        self, name: str, rng: Random, symbols: list[str], filled: tuple[str, ...] = ()
    ) -> tuple[Machine, Reader]:
        """A function of a design system at random q (parameters, share of the path) and y; rates are those along y."""

        def made() -> tuple[Machine, Reader]:
            base = self.base(rng)
            names = [*self.parameters, "path"]
            path = once(rng, "path", lambda: Number(rng.randrange(1, CODE.PRIME)))
            values = {name: path if name == "path" else base.inputs[f"p[{k}]"] for k, name in enumerate(names)}
            inputs = {f"q[{k}]": values[name] for k, name in enumerate(names) if name not in filled}
            for k, symbol in enumerate(symbols):
                rates = tuple(int(j == k) for j in range(len(symbols)))
                number = Number(rng.randrange(1, CODE.PRIME), rates, {f"{name} {k}": Fraction(1)})
                inputs[f"y[{k}]"] = values[symbol] = number
            machine = Machine(inputs, self.function(name), None, base.circle)
            return machine, Reader(self.named, values, machine)

        return once(rng, ("design", name), made)

    def share(self, run: Machine) -> Number:
        """How much of the path of a design system is done."""
        return run.inputs[f"q[{len(self.parameters)}]"]

    def run(self, name: str, rng: Random, letter: str, symbols: list[str]) -> tuple[Machine, Reader]:
        """A function at random inputs, and the description at the same; rates are those along its own arguments."""

        def made() -> tuple[Machine, Reader]:
            base = self.base(rng)
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

        return once(rng, ("run", name), made)


def once(rng: Random, key: object, make: Callable[[], object]) -> object:
    """What several checks need at one draw, made by the first of them; anew where numbers are not kept."""
    if not isinstance(rng, Draw):
        return make()
    if key not in rng.kept:
        rng.kept[key] = make()
    return rng.kept[key]


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
    base = drive.base(rng)
    inputs = {key: entry for key, entry in base.inputs.items() if key[0] == "p" and key != f"p[{place}]"}
    run = Machine(inputs, Function("derive", CODE.read_body(body), {}), None, base.circle)
    values = {name: inputs[f"p[{k}]"] for k, name in enumerate(drive.parameters) if k != place}
    same(run.value(f"p[{place}]"), Reader(drive.named, values, run)(value), f"derive: rule {number} for {target}")


def check_unit(drive: Drive, number: int) -> None:
    """What a parameter is multiplied by when it is read: a fraction, times the circle's number or not."""
    entry = drive.description["keys"][number]
    name, factor = entry["symbol"]["name"], entry["factor"]
    table = re.search(r"_parameter_names\[\] = {\n(.*?)\n};", drive.text, re.DOTALL)[1]
    found = re.search(rf'^\s*{{ "{re.escape(name)}", .*", ([\d.e-]+), \S+, \S+ }}', table, re.M)
    require(found, f"the header has no parameter {name}")
    exact = Fraction(1)
    for part in factor[1:] if isinstance(factor, list) and factor[0] == "*" else [factor]:
        exact *= part if isinstance(part, int) else CODE.PI_ENCLOSED if part == ["pi"] else Fraction(*part[1:])
    apart = abs(Fraction(float(found[1])) - exact)
    require(apart <= abs(exact) * Fraction(1, 2**52), f"the unit of {name} is not that of the description")


def given_rules(drive: Drive) -> list[tuple[str, object]]:
    defaults = [(key["symbol"]["name"], key["default"]) for key in drive.description["keys"]]
    return [pair for pair in defaults if pair[1] is not None] + [tuple(rule) for rule in drive.description["rules"]]


def check_kept(drive: Drive, rng: Random) -> None:
    """The state ends with the parameters, which functions that need the design again read there."""
    setup = drive.base(rng).earlier.earlier
    slots = int(re.search(rf"{drive.prefix}_NS (\d+)", drive.text)[1]) - len(drive.parameters)
    for k, name in enumerate(drive.parameters):
        same(setup.value(f"s[{slots + k}]"), setup.inputs[f"p[{k}]"], f"setup: s[{slots + k}] for {name}")


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


def check_system(drive: Drive, system: dict, name: str, key: object, rng: Random) -> None:
    """One output of one function of a design system, rows with their derivatives."""
    symbols = [unknown["name"] for unknown in system["unknowns"]]
    known = name in ("eval", "fill", "watch")
    run, reader = drive.design(
        f"{system['name']}_{name}", rng, symbols if known else [], tuple(system["fills"]) if name == "fill" else ()
    )
    reader = reader.at({symbol: reader(value) for symbol, value in system["fixed"].items()})
    words = f"{system['name']}_{name}: {key}"
    match name:
        case "guess":
            same(run.value(f"y[{key}]"), reader(system["guess"][symbols[key]]), words)
        case "scale":
            same(run.value(f"y[{key}]"), reader(system["unknowns"][key]["scale"]), words)
        case "fill":
            same(run.value(f"q[{drive.parameters.index(key)}]"), reader(system["fills"][key]), words)
        case "eval":
            expected = reader(system["residual"][key])
            if system["homotopy"]:
                guess = {symbol: Number(number.value, (), number.angle) for symbol, number in guessed(reader, system)}
                left = CODE.add(ONE, drive.share(run), -1)
                begun = reader.at(guess)(system["residual"][key])
                expected = CODE.add(expected, CODE.multiply(left, begun), -1)
            same(run.value(f"R[{key}]"), expected, words)
            for j in range(len(symbols)):
                same(run.value(f"J[{key * len(symbols) + j}]"), rate(expected, j), f"{words} by {symbols[j]}")
        case "watch":
            regular = system["regular"]
            places = {q["name"]: k for k, q in enumerate(regular["surface"]["parameters"])}
            along = {symbol: tuple(int(j == k) for j in range(len(places))) for symbol, k in places.items()}
            here = {symbol: reader(symbol) for symbol in places}
            reader = reader.at({s: Number(n.value, along[s], n.form) for s, n in here.items()})
            expected = CODE.multiply(reader(regular["sign"]), singular(Surface(reader, regular["surface"], []), places))
            same(run.value("o[0]"), expected, words)


def guessed(reader: Reader, system: dict) -> Iterator[tuple[str, Number]]:
    """Where the path of a system begins."""
    return ((unknown["name"], reader(system["guess"][unknown["name"]])) for unknown in system["unknowns"])


def check_open(drive: Drive, system: dict) -> None:
    """What counts a system's open parameters counts those that it fills in."""
    body = CODE.body_of(drive.text, f"{drive.prefix}_{system['name']}_open")
    counted = {drive.parameters[int(k)] for k in re.findall(r"\(p\[(\d+)\] != p\[\1\]\)", body)}
    require(counted == set(system["fills"]), f"{system['name']}_open counts other parameters than it fills in")


DIVISOR = re.compile(r"a division by zero: (?:(sin|cos)\((\w+)\)|(\w+)) must not be 0")


def check_guard(drive: Drive, number: int, rng: Random) -> None:
    """A guard by its place: the description's come first, then divisors, of which the square must be positive."""
    function, tested = drive.header.guards
    base = drive.base(rng)
    inputs = {key: entry for key, entry in base.inputs.items() if key[0] == "p"}
    run = Machine(inputs, function, None, base.circle)
    values = {name: inputs[f"p[{k}]"] for k, name in enumerate(drive.parameters)}
    reader, guards = Reader(drive.named, values, run), drive.description["guards"]
    require(number in tested, f"setup: guard {number} is not tested")
    if number < len(guards):
        expected = reader(guards[number]["positive"])
    else:
        function, operand, name = DIVISOR.search(guard_texts(drive)[number]).groups()
        divisor = reader([function, operand] if function else name)
        expected = CODE.multiply(divisor, divisor)
    same(run.value(tested[number]), expected, f"setup: guard {number}")


def guard_texts(drive: Drive) -> list[str]:
    """Messages of the guards; those of the description stand first."""
    table = re.search(r"_guard_texts\[\] = {\n(.*?)\n};", drive.text, re.DOTALL)[1]
    texts = [json.loads(line.strip().rstrip(",")) for line in table.splitlines()]
    for text, guard in zip(texts, drive.description["guards"], strict=False):
        require(text.startswith(guard["message"]), f"setup: the message {text[:30]} stands for another guard")
    return texts


CHANGED = re.compile(
    r"^    if \(known\[(\d+)\] != known\[\1\]((?: && known\[\d+\] == known\[\d+\])*)\) "
    r"(?:{[^\n]*\n(.*?)\n    }|known\[\1\] = p\[\1\];)$",
    re.DOTALL | re.M,
)


def check_changes(drive: Drive, number: int, rng: Random) -> None:
    """What changes a default or rule, by its place: it waits for all that it reads, and is the derivative along it."""
    given = given_rules(drive)
    blocks = CHANGED.findall(CODE.body_of(drive.tangents, f"{drive.prefix}_derive_tangent"))
    require(len(blocks) == len(given), f"derive_tangent: {len(blocks)} rules, the description has {len(given)}")
    (place, waits, body), (target, value) = blocks[number], given[number]
    words = f"derive_tangent: rule {number} for {target}"
    require(drive.parameters[int(place)] == target, f"{words} fills in {drive.parameters[int(place)]}")
    reads = {drive.parameters.index(name) for name in names_in(value, drive.named) if name in drive.parameters}
    require({int(k) for k in re.findall(r"known\[(\d+)\] ==", waits)} == reads, f"{words} waits for others")
    base = drive.base(rng)
    own = {key: entry for key, entry in base.inputs.items() if key[0] == "p" and key != f"p[{place}]"}
    moved = {f"d{key}": Number(rng.randrange(1, CODE.PRIME)) for key in own}
    run = Machine(own | moved, Function("derive_tangent", CODE.read_body(body), {}), None, base.circle)
    values = {
        name: Number(own[f"p[{k}]"].value, (moved[f"dp[{k}]"].value,), own[f"p[{k}]"].form)
        for k, name in enumerate(drive.parameters)
        if f"p[{k}]" in own
    }
    expected = Reader(drive.named, values, run)(value)
    run.inputs[f"p[{place}]"] = Number(expected.value, (), expected.angle)
    same(run.value(f"dp[{place}]") if body else Number(0), rate(expected, 0), words)
    if body:
        same(run.value(f"known[{place}]"), run.inputs[f"p[{place}]"], f"{words}: known[{place}]")


def check_system_changes(drive: Drive, system: dict, rng: Random) -> None:
    """Changes of a design system's residual along changes of parameters and unknowns, the share of the path fixed."""
    base, name = drive.base(rng), system["name"]
    symbols = [unknown["name"] for unknown in system["unknowns"]]
    share = len(drive.parameters)
    own, moved, values = {f"q[{share}]": Number(rng.randrange(1, CODE.PRIME))}, {}, {}
    values["path"] = own[f"q[{share}]"]
    for key, symbol in [*((f"q[{k}]", s) for k, s in enumerate(drive.parameters)),
                        *((f"y[{k}]", s) for k, s in enumerate(symbols))]:  # fmt: skip
        given = base.inputs[f"p{key[1:]}"] if key[0] == "q" else Number(rng.randrange(1, CODE.PRIME))
        form = given.form if key[0] == "q" else {f"{name} {key}": Fraction(1)}
        own[key], moved[f"d{key}"] = Number(given.value, (), form), Number(rng.randrange(1, CODE.PRIME))
        values[symbol] = Number(given.value, (moved[f"d{key}"].value,), form)
    body = CODE.body_of(drive.tangents, f"{drive.prefix}_{name}_tangent")
    run = Machine(own | moved, Function(f"{name}_tangent", CODE.read_body(body), {}), None, base.circle)
    reader = Reader(drive.named, values, run)
    reader = reader.at({symbol: reader(value) for symbol, value in system["fixed"].items()})
    for k, row in enumerate(system["residual"]):
        expected = reader(row)
        if system["homotopy"]:
            guess = {symbol: reader(system["guess"][symbol]) for symbol in symbols}
            left = CODE.add(ONE, values["path"], -1)
            expected = CODE.add(expected, CODE.multiply(left, reader.at(guess)(row)), -1)
        same(run.value(f"dR[{k}]"), rate(expected, 0), f"{name}_tangent: dR[{k}]")


FILLED = re.compile(r"if \(known\[(\d+)\] != known\[\1\]\) dq\[\1\] = (\S+), known\[\1\] = q\[\1\];")


def check_filled_changes(drive: Drive, system: dict, rng: Random) -> None:
    """Changes of what a design system fills in, along changes of parameters and unknowns."""
    base, name = drive.base(rng), system["name"]
    symbols = [unknown["name"] for unknown in system["unknowns"]]
    body = CODE.body_of(drive.tangents, f"{drive.prefix}_{name}_fill_tangent")
    lines = FILLED.findall(body)
    targets = [drive.parameters[int(place)] for place, _ in lines]
    require(targets == list(system["fills"]), f"{name}_fill_tangent fills in other parameters")
    program = CODE.read_body(FILLED.sub("", body))
    own, moved, values = {}, {}, {}
    for key, symbol in [*((f"q[{k}]", s) for k, s in enumerate(drive.parameters) if s not in targets),
                        *((f"y[{k}]", s) for k, s in enumerate(symbols))]:  # fmt: skip
        given = base.inputs[f"p{key[1:]}"] if key[0] == "q" else Number(rng.randrange(1, CODE.PRIME))
        form = given.form if key[0] == "q" else {f"{name} {key}": Fraction(1)}
        own[key], moved[f"d{key}"] = Number(given.value, (), form), Number(rng.randrange(1, CODE.PRIME))
        values[symbol] = Number(given.value, (moved[f"d{key}"].value,), form)
    end = {f"q[{len(drive.parameters)}]": Number(1, (), {})}
    run = Machine(own | moved | end, Function(f"{name}_fill_tangent", program, {}), None, base.circle)
    reader = Reader(drive.named, values, run)
    reader = reader.at({symbol: reader(value) for symbol, value in system["fixed"].items()})
    for target, (_, text) in zip(targets, lines, strict=True):
        same(run.value(text), rate(reader(system["fills"][target]), 0), f"{name}_fill_tangent: {target}")


def names_in(e: object, named: Mapping[str, object]) -> set[str]:
    """The names that an expression rests on, definitions followed."""
    if isinstance(e, str):
        return names_in(named[e], named) if e in named else {e}
    return set().union(*(names_in(operand, named) for operand in e[1:])) if isinstance(e, list) else set()


class Surface:
    """A surface of the description at one input."""

    def __init__(self, reader: Reader, surface: dict, motion: list):
        self.reader, self.surface = reader, surface
        self.motion = [*motion, *surface["motion"]]
        self.point = reader.carried(self.motion, reader.vector(surface["point"]))

    @property
    def outward(self) -> list[Number]:
        """A normal of any length."""
        return self.reader.carried(self.motion, self.reader.vector(self.surface["normal"]), free=True)

    @property
    def normal(self) -> list[Number]:
        return unit(self.outward)

    def tangents(self, places: Mapping[str, int]) -> list[list[Number]]:
        """Derivatives of the point by the surface's parameters."""
        return [[rate(number, places[q["name"]]) for number in self.point] for q in self.surface["parameters"]]

    def slopes(self, places: Mapping[str, int]) -> list[list[Number]]:
        """Derivatives of each implicit condition by the surface's parameters."""
        conditions = map(self.reader, self.surface["conditions"])
        return [[rate(c, places[q["name"]]) for q in self.surface["parameters"]] for c in conditions]

    def second_form(self, places: Mapping[str, int], basis: list[list[Number]]) -> list[Number]:
        """(II11, II12, II22) with [II l] [tangents; slopes] = -(changes of the normal), solved for its rows."""
        outward = self.outward
        length = CODE.root(inner(outward, outward))
        turned = [[rate(n, places[q["name"]]) for n in outward] for q in self.surface["parameters"]]
        tangents, slopes = self.tangents(places), self.slopes(places)
        lines = [[*(inner(e, t) for e in basis), *(s[k] for s in slopes)] for k, t in enumerate(tangents)]
        (a, b), (c, d) = (
            solved(lines, [CODE.divide(inner(e, change), length) for change in turned])[:2] for e in basis
        )
        half = pow(2, -1, CODE.PRIME)
        return [Number(-a % CODE.PRIME), Number(-half * (b + c) % CODE.PRIME), Number(-d % CODE.PRIME)]


def unit(vector: list[Number]) -> list[Number]:
    length = CODE.root(inner(vector, vector))
    return [CODE.divide(component, length) for component in vector]


def cross(a: list[Number], b: list[Number]) -> list[Number]:
    return [
        CODE.add(CODE.multiply(a[i], b[j]), CODE.multiply(a[j], b[i]), -1) for i, j in ((1, 2), (2, 0), (0, 1))
    ]


def solved(lines: list[list[Number]], right: list[Number]) -> list[int]:
    """Solution of a small linear system modulo the prime (Gauss, Jordan)."""
    rows = [[*(n.value for n in line), r.value] for line, r in zip(lines, right, strict=True)]
    for k in range(len(rows)):
        pivot = next((i for i in range(k, len(rows)) if rows[i][k] % CODE.PRIME), None)
        require(pivot is not None, "a singular system")
        rows[k], rows[pivot] = rows[pivot], rows[k]
        inverse = pow(rows[k][k], -1, CODE.PRIME)
        rows[k] = [entry * inverse % CODE.PRIME for entry in rows[k]]
        for i, row in enumerate(rows):
            if i != k and row[k]:
                rows[i] = [(p - row[k] * q) % CODE.PRIME for p, q in zip(row, rows[k], strict=True)]
    return [row[-1] for row in rows]


def determinant(rows: list[list[Number]]) -> Number:
    """By the first row."""
    if len(rows) == 1:
        return rows[0][0]
    total = Number(0)
    for k, entry in enumerate(rows[0]):
        minor = determinant([row[:k] + row[k + 1 :] for row in rows[1:]])
        total = CODE.add(total, CODE.multiply(entry, minor), -1 if k % 2 else 1)
    return total


def singular(surface: Surface, places: Mapping[str, int]) -> Number:
    """Zero where the directions that keep the conditions fall together: the determinant of the slopes and of the
    normal's triple products, expanded by pairs of parameters (Laplace).
    """
    normal, tangents, slopes = surface.outward, surface.tangents(places), surface.slopes(places)
    total = Number(0)
    for a in range(len(tangents)):
        for b in range(a + 1, len(tangents)):
            others = [k for k in range(len(tangents)) if k not in (a, b)]
            odd = sum(o > p for o in others for p in (a, b)) % 2
            term = inner(normal, cross(tangents[a], tangents[b]))
            if slopes:
                term = CODE.multiply(term, determinant([[row[k] for k in others] for row in slopes]))
            total = CODE.add(total, term, -1 if odd else 1)
    return total


def at_reference(reader: Reader, entry: dict) -> Reader:
    """The same at the body's reference point; what is differentiated by a parameter still is."""
    there = {}
    for symbol, value in entry["reference"].items():
        number = reader(value)
        there[symbol] = Number(number.value, reader.values[symbol].rates, number.form)
    return reader.at(there)


def regular_of(reader: Reader, entry: dict, places: Mapping[str, int]) -> Number:
    """The singular function with its good sign, or divided by its value at the reference point."""
    here = singular(Surface(reader, entry["surface"], []), places)
    if entry["regular"] is not None:
        return CODE.multiply(reader(entry["regular"]), here)
    return CODE.divide(here, singular(Surface(at_reference(reader, entry), entry["surface"], []), places))


def tangent_basis(normal: list[Number], tangent: list[Number]) -> list[list[Number]]:
    along = inner(tangent, normal)
    first = unit([CODE.add(t, CODE.multiply(along, n), -1) for t, n in zip(tangent, normal, strict=True)])
    return [first, cross(normal, first)]


def check_principal(found: list[Number], form: list[Number], side: int, words: str) -> None:
    """Two curvatures by sum and product. Their mean has to be a square, or the opposite of one: a program may take the
    root of the mean's square, and is right on one side where it is wrong on the other.
    """
    low, high = found
    mean = CODE.add(form[0], form[2]).value * pow(2, -1, CODE.PRIME) % CODE.PRIME
    if pow(mean, (CODE.PRIME - 1) // 2, CODE.PRIME) != side % CODE.PRIME:
        raise CODE.NoRoot
    same(CODE.add(low, high), CODE.add(form[0], form[2]), f"{words}: the sum")
    product = CODE.add(CODE.multiply(form[0], form[2]), CODE.multiply(form[1], form[1]), -1)
    same(CODE.multiply(low, high), product, f"{words}: the product")


def check_curvature(drive: Drive, entry: dict, name: str, side: int, rng: Random) -> None:
    """Tangent basis, second form and principal curvatures of a flank or region, in its body's frame."""
    symbols = [q["name"] for q in entry["surface"]["parameters"]]
    run, reader = drive.run(f"curvature_{name}", rng, "q", symbols)
    places = {symbol: k for k, symbol in enumerate(symbols)}
    surface = Surface(reader, entry["surface"], [])
    basis = tangent_basis(surface.normal, surface.tangents(places)[0])
    form = surface.second_form(places, basis)
    for key, expected in (("tangent_basis", [*basis[0], *basis[1]]), ("second_form", form)):
        for k, number in enumerate(read(run, key)):
            same(number, expected[k], f"curvature_{name}: {key}[{k}]")
    check_principal(read(run, "curvature"), form, side, f"curvature_{name}: curvature")


def check_forms(drive: Drive, key: str, rng: Random) -> None:
    """Tangent basis of the contact and second forms of both flanks in it."""
    run, reader = drive.run("observe", rng, "x", drive.unknowns)
    places = {name: k for k, name in enumerate(drive.unknowns)}
    bodies = {body["name"]: body for body in drive.description["bodies"]}
    if key == "tangent_basis":
        pinion = Surface(reader, bodies["pinion"]["surface"], bodies["pinion"]["motion"])
        first, second = tangent_basis(pinion.normal, pinion.tangents(places)[0])
        expected = [*first, *second]
    else:
        body = bodies[key.removeprefix("second_form_")]
        basis = read(run, "tangent_basis")
        expected = Surface(reader, body["surface"], body["motion"]).second_form(places, [basis[:3], basis[3:]])
    for k, number in enumerate(read(run, key)):
        same(number, expected[k], f"observe: {key}[{k}]")


def check_gap(drive: Drive, side: int, rng: Random) -> None:
    """Second form of the gap and its principal curvatures follow from the forms of both flanks.

    Where the program reads them where it writes them, any numbers stand for them: it then rests on no root of theirs.
    """
    run, _ = drive.run("observe", rng, "x", drive.unknowns)
    forms = [f"second_form_{body['name']}" for body in drive.description["bodies"]]
    try:
        check_gap_of(cut(run, forms, rng), forms, side)
    except Rejected:
        check_gap_of(run, forms, side)


def check_gap_of(run: Machine, forms: list[str], side: int) -> None:
    gap = read(run, "second_form_gap")
    for k, (number, a, b) in enumerate(zip(gap, *(read(run, name) for name in forms), strict=True)):
        same(number, Number(-(a.value + b.value)), f"observe: second_form_gap[{k}]")
    check_principal(read(run, "curvature_gap"), gap, side, "observe: curvature_gap")


def turning(reader: Reader, motion: list, place: int, point: list[Number]) -> list[Number]:
    """Velocity of the body's point that is there, of what is carried by the motion, along one direction."""
    columns = [reader.carried(motion, [Number(int(i == k)) for i in range(3)], free=True) for k in range(3)]
    origin = reader.carried(motion, [Number(0)] * 3)
    arm = [CODE.add(p, o, -1) for p, o in zip(point, origin, strict=True)]
    local = [Number(inner(column, arm).value) for column in columns]
    return [
        CODE.add(rate(origin[i], place), inner([rate(column[i], place) for column in columns], local)) for i in range(3)
    ]


def check_arms(drive: Drive, rng: Random) -> None:
    """Lever arms: how fast each body's own angle moves the contact point along the normal, and their quotient."""
    run, reader = drive.run("observe", rng, "x", drive.unknowns)
    described = drive.description
    instant, error = described["contact"]["instant"]["name"], described["contact"]["error"]
    moving = reader.at({
        name: Number(reader(name).value, (int(name == instant), int(name == error)), reader(name).form)
        for name in (*drive.unknowns, instant)
    })  # fmt: skip
    pinion, wheel = described["bodies"]
    contact = Surface(reader, pinion["surface"], pinion["motion"])
    normal, point = contact.normal, [Number(n.value) for n in contact.point]
    arms = [inner(normal, turning(moving, body["motion"], k, point)) for k, body in enumerate((pinion, wheel))]
    for body, arm in zip((pinion, wheel), arms, strict=True):
        same(read(run, f"lever_arm_{body['name']}")[0], arm, f"observe: lever_arm_{body['name']}")
    same(read(run, "instantaneous_ratio")[0], CODE.divide(*arms), "observe: instantaneous_ratio")


def check_placement(drive: Drive, member: int, rng: Random) -> None:
    """A motion, its rows, and the axis: what its own angle moves is direction x (point - point of the axis)."""
    contact = drive.description["contact"]
    run, reader = drive.run("placement", rng, "q", ["own angle of the pinion", "own angle of the wheel"])
    own = [reader("own angle of the pinion"), reader("own angle of the wheel")]
    there = reader.at({contact["instant"]["name"]: own[0], contact["error"]: Number(0, (), {})})
    error = CODE.add(own[1], there(contact["wheel_angle"]), -1)
    there = there.at({contact["error"]: Number(error.value, error.rates, error.form)})
    body = drive.description["bodies"][member]
    motion, name = body["motion"], body["name"]
    columns = [there.carried(motion, [Number(int(i == k)) for i in range(3)], free=True) for k in range(3)]
    columns.append(there.carried(motion, [Number(0)] * 3))
    rows = [column[i] for i in range(3) for column in columns]
    for k, number in enumerate(read(run, f"placement_{name}")):
        same(number, rows[k], f"placement: placement_{name}[{k}]")
    direction, through = read(run, f"axis_{name}"), read(run, f"axis_point_{name}")
    for k, column in enumerate(columns):
        arm = column if k < 3 else [CODE.add(c, t, -1) for c, t in zip(column, through, strict=True)]
        for i, number in enumerate(cross(direction, arm)):
            same(number, rate(column[i], member), f"placement: axis of the {name}")


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
    return CODE.divide(at(reader), at(at_reference(reader, entry)))


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
        if key == f"regular_{name}":
            return [regular_of(reader, body, places)]
        for k in range(len(body["surface"]["conditions"])):
            if key == f"condition_{name}_{k}":
                return Surface(reader, body["surface"], []).slopes(places)[k]
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
        keys += [f"regular_{name}", *(f"condition_{name}_{k}" for k in range(len(body["surface"]["conditions"])))]
        keys += [f"margin_{name}_{margin['event']}" for margin in body["margins"]]
    return keys


def read(run: Machine, key: str) -> list[Number]:
    require(key in run.function.outputs, f"{run.function.name}: no output {key}")
    at, size = run.function.outputs[key]
    return [run.value(f"o[{at + k}]") for k in range(size)]


def cut(run: Machine, keys: list[str], rng: Random) -> Machine:
    """The same program where some of its outputs are any numbers: what follows from them rests on no root of theirs."""
    free = {}
    for at, size in (run.function.outputs[key] for key in keys):
        for k in range(size):
            name = run.function.definitions[f"o[{at + k}]"][1].strip("()-")
            free[name] = Number(rng.randrange(1, CODE.PRIME))
    return Machine(run.inputs | free, run.function, run.earlier, run.circle)


def check_surface(drive: Drive, entry: dict, name: str, key: str, rng: Random) -> None:
    """One named output of a flank or region, in its body's frame."""
    symbols = [q["name"] for q in entry["surface"]["parameters"]]
    run, reader = drive.run(name, rng, "q", symbols)
    surface = Surface(reader, entry["surface"], [])
    if key in ("point", "normal"):
        expected = getattr(surface, key)
    elif key == "regular":
        expected = [regular_of(reader, entry, {symbol: k for k, symbol in enumerate(symbols)})]
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
        if drive.tangents:
            yield f"changes by rule {k} for {target}", (check_changes, drive, k)
    for system in described["design_systems"]:
        unknowns = range(len(system["unknowns"]))
        keys = {"guess": unknowns, "scale": unknowns, "eval": range(len(system["residual"])), "fill": system["fills"]}
        for name, places in (keys | ({"watch": ["sign"]} if system["regular"] else {})).items():
            for key in places:
                yield f"{key} of {system['name']}_{name}", (check_system, drive, system, name, key)
        if drive.tangents:
            yield f"changes of {system['name']}", (check_system_changes, drive, system)
            yield f"changes by {system['name']}", (check_filled_changes, drive, system)
    yield "parameters at the end of the state", (check_kept, drive)
    for k, words in enumerate(guard_texts(drive)):
        if k < len(described["guards"]) or DIVISOR.search(words):
            yield f"guard {k}", (check_guard, drive, k)
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
        margins = [f"margin_{m['event']}" for m in entry["margins"]]
        for key in ("point", "normal", "regular", *conditions, *margins):
            yield f"{key} of {name}", (check_surface, drive, entry, name, key)
        for side in (1, -1):
            yield f"curvature of {name}", (check_curvature, drive, entry, name, side)
    names = [f"second_form_{body['name']}" for body in described["bodies"]]
    for key in ("tangent_basis", *names):
        yield f"{key} of the observation", (check_forms, drive, key)
    for side in (1, -1):
        yield "gap of the observation", (check_gap, drive, side)
    yield "lever arms of the observation", (check_arms, drive)
    for member, body in enumerate(described["bodies"]):
        yield f"placement of the {body['name']}", (check_placement, drive, member)
    for entry in described["functions"]:
        for result in entry["results"]:
            yield f"{result['name']} of {entry['name']}", (check_function, drive, entry, result)


class Draw(Random):
    """Numbers from the system's source, one sign of the flank, and what was computed from them."""

    def __init__(self, sign: int):
        super().__init__()
        self.sign, self.source, self.kept = sign, SystemRandom(), {}

    def randrange(self, *bounds: int) -> int:
        return self.source.randrange(*bounds)

    def choice(self, _: object) -> int:
        return self.sign % CODE.PRIME


class Draws:
    """Draws in their order; the first are kept, so that checks share what they compute at them."""

    def __init__(self, sign: int):
        self.sign, self.kept = sign, []

    def __iter__(self) -> Iterator[Draw]:
        for k in range(CODE.ATTEMPTS):
            if k >= KEPT:
                yield Draw(self.sign)
                continue
            if k == len(self.kept):
                self.kept.append(Draw(self.sign))
            yield self.kept[k]


def attempt(check: Callable[..., None], *arguments: object, draws: tuple[Draws, Draws] | None = None) -> None:
    """A check on each of the two flanks; one alone would not notice where a sign of the flank is missing."""
    for flank in draws or (Draws(1), Draws(-1)):
        CODE.attempt(check, *arguments, sources=flank)


def check_drive(description: Path, header: Path) -> int:
    """All checks of one drive; how many were made."""
    try:
        text, changes = header.read_text(encoding="utf-8"), CODE.read_companion(header, "sensitivity")
        drive = Drive(json.loads(description.read_text(encoding="utf-8")), text, changes)
        for number in range(len(drive.description["keys"])):
            check_unit(drive, number)
        for system in drive.description["design_systems"]:
            check_open(drive, system)
        checks, draws = list(checks_of(drive)), (Draws(1), Draws(-1))
        for _, check in checks:
            attempt(*check, draws=draws)
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
        f"{checks} checks of {drives} drives hold: rules and their changes, design systems, guards, sizes, residuals, "
        "start, points, normals, tangents, curvatures, margins, placements and functions are those of the description"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
