"""Rules, units, sizes, guards and design systems beside the description, and their changes."""

import json
import re
from collections.abc import Iterator
from fractions import Fraction
from random import Random

from .description import ONE, Reader, names_in
from .drive import Drive, rate, same
from .machine import Machine
from .modular import PRIME, Number, add, multiply
from .refusal import require
from .straight_line import PI_ENCLOSED, Function, body_of, read_body
from .surfaces import Surface, singular

BLOCK = re.compile(r"    if \(p\[(\d+)\] != p\[\1\]\) {[^\n]*\n(.*?)\n    }", re.DOTALL)


def check_rules(drive: Drive, number: int, rng: Random) -> None:
    """One default or rule, by its place in their order."""
    given = given_rules(drive)
    blocks = BLOCK.findall(body_of(drive.text, f"{drive.prefix}_derive"))
    require(len(blocks) == len(given), f"derive: {len(blocks)} rules, the description has {len(given)}")
    place, body = int(blocks[number][0]), blocks[number][1]
    target, value = given[number]
    require(drive.parameters[place] == target, f"derive: rule {number} fills in {drive.parameters[place]}")
    base = drive.base(rng)
    inputs = {key: entry for key, entry in base.inputs.items() if key[0] == "p" and key != f"p[{place}]"}
    run = Machine(inputs, Function("derive", read_body(body), {}), None, base.circle)
    values = {name: inputs[f"p[{k}]"] for k, name in enumerate(drive.parameters) if k != place}
    same(run.value(f"p[{place}]"), Reader(drive.named, values, run)(value), f"derive: rule {number} for {target}")


def check_unit(drive: Drive, number: int) -> None:
    """What a parameter is multiplied by when it is read: a fraction, times the circle's number or not."""
    entry = drive.description["keys"][number]
    name, factor = entry["symbol"]["name"], entry["factor"]
    found = re.search(
        rf'^\s*{{ "{re.escape(name)}", .*", ([\d.e-]+), \S+, \S+ }}', drive.table("parameter_names"), re.M
    )
    require(found, f"the header has no parameter {name}")
    exact = Fraction(1)
    for part in factor[1:] if isinstance(factor, list) and factor[0] == "*" else [factor]:
        exact *= part if isinstance(part, int) else PI_ENCLOSED if part == ["pi"] else Fraction(*part[1:])
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
                left = add(ONE, drive.share(run), -1)
                begun = reader.at(guess)(system["residual"][key])
                expected = add(expected, multiply(left, begun), -1)
            same(run.value(f"R[{key}]"), expected, words)
            for j in range(len(symbols)):
                same(run.value(f"J[{key * len(symbols) + j}]"), rate(expected, j), f"{words} by {symbols[j]}")
        case "watch":
            regular = system["regular"]
            places = {q["name"]: k for k, q in enumerate(regular["surface"]["parameters"])}
            along = {symbol: tuple(int(j == k) for j in range(len(places))) for symbol, k in places.items()}
            here = {symbol: reader(symbol) for symbol in places}
            reader = reader.at({s: Number(n.value, along[s], n.form) for s, n in here.items()})
            expected = multiply(reader(regular["sign"]), singular(Surface(reader, regular["surface"], []), places))
            same(run.value("o[0]"), expected, words)


def guessed(reader: Reader, system: dict) -> Iterator[tuple[str, Number]]:
    """Where the path of a system begins."""
    return ((unknown["name"], reader(system["guess"][unknown["name"]])) for unknown in system["unknowns"])


def check_open(drive: Drive, system: dict) -> None:
    """What counts a system's open parameters counts those that it fills in."""
    body = body_of(drive.text, f"{drive.prefix}_{system['name']}_open")
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
        expected = multiply(divisor, divisor)
    same(run.value(tested[number]), expected, f"setup: guard {number}")


def guard_texts(drive: Drive) -> list[str]:
    """Messages of the guards; those of the description stand first."""
    texts = [json.loads(line.strip().rstrip(",")) for line in drive.table("guard_texts").splitlines()]
    for text, guard in zip(texts, drive.description["guards"], strict=False):
        require(text.startswith(guard["message"]), f"setup: the message {text[:30]} stands for another guard")
    return texts


OPEN = re.compile(r"p\[(\d+)\] != p\[\1\]")


def check_missing(drive: Drive, _rng: Random) -> None:
    """Each required key is missed by itself, further ones together, and the text that is chosen begins with them."""
    *lines, last = body_of(drive.text, f"{drive.prefix}_missing").splitlines()
    texts, alone = guard_texts(drive), []
    keys = {entry["symbol"]["name"]: entry for entry in drive.description["keys"]}
    for line in lines if lines != ["    (void)p;"] else []:
        found = re.fullmatch(r"    if \((.*)\) return (\d+);", line)
        require(found and all(map(OPEN.fullmatch, found[1].split(" && "))), f"missing: {line}")
        entries = [keys[drive.parameters[int(k)]] for k in OPEN.findall(found[1])]
        places = [e["key"] if e["table"] == "design" else f"{e['table']}.{e['key']}" for e in entries]
        require(texts[int(found[2]) - 1].startswith(f"{', '.join(places)}: "), f"missing: a text of other keys, {line}")
        alone += entries if len(entries) == 1 else []
    require(last == "    return otherwise;", f"missing: {last}")
    require(alone == [e for e in keys.values() if e["required"]], "missing: other keys than those that are required")


CHANGED = re.compile(
    r"^    if \(known\[(\d+)\] != known\[\1\]((?: && known\[\d+\] == known\[\d+\])*)\) "
    r"(?:{[^\n]*\n(.*?)\n    }|known\[\1\] = p\[\1\];)$",
    re.DOTALL | re.M,
)


def check_changes(drive: Drive, number: int, rng: Random) -> None:
    """What changes a default or rule, by its place: it waits for all that it reads, and is the derivative along it."""
    given = given_rules(drive)
    blocks = CHANGED.findall(body_of(drive.tangents, f"{drive.prefix}_derive_tangent"))
    require(len(blocks) == len(given), f"derive_tangent: {len(blocks)} rules, the description has {len(given)}")
    (place, waits, body), (target, value) = blocks[number], given[number]
    words = f"derive_tangent: rule {number} for {target}"
    require(drive.parameters[int(place)] == target, f"{words} fills in {drive.parameters[int(place)]}")
    reads = {drive.parameters.index(name) for name in names_in(value, drive.named) if name in drive.parameters}
    require({int(k) for k in re.findall(r"known\[(\d+)\] ==", waits)} == reads, f"{words} waits for others")
    base = drive.base(rng)
    own = {key: entry for key, entry in base.inputs.items() if key[0] == "p" and key != f"p[{place}]"}
    moved = {f"d{key}": Number(rng.randrange(1, PRIME)) for key in own}
    run = Machine(own | moved, Function("derive_tangent", read_body(body), {}), None, base.circle)
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
    own, moved, values = {f"q[{share}]": Number(rng.randrange(1, PRIME))}, {}, {}
    values["path"] = own[f"q[{share}]"]
    for key, symbol in [*((f"q[{k}]", s) for k, s in enumerate(drive.parameters)),
                        *((f"y[{k}]", s) for k, s in enumerate(symbols))]:  # fmt: skip
        given = base.inputs[f"p{key[1:]}"] if key[0] == "q" else Number(rng.randrange(1, PRIME))
        form = given.form if key[0] == "q" else {f"{name} {key}": Fraction(1)}
        own[key], moved[f"d{key}"] = Number(given.value, (), form), Number(rng.randrange(1, PRIME))
        values[symbol] = Number(given.value, (moved[f"d{key}"].value,), form)
    body = body_of(drive.tangents, f"{drive.prefix}_{name}_tangent")
    run = Machine(own | moved, Function(f"{name}_tangent", read_body(body), {}), None, base.circle)
    reader = Reader(drive.named, values, run)
    reader = reader.at({symbol: reader(value) for symbol, value in system["fixed"].items()})
    for k, row in enumerate(system["residual"]):
        expected = reader(row)
        if system["homotopy"]:
            guess = {symbol: reader(system["guess"][symbol]) for symbol in symbols}
            left = add(ONE, values["path"], -1)
            expected = add(expected, multiply(left, reader.at(guess)(row)), -1)
        same(run.value(f"dR[{k}]"), rate(expected, 0), f"{name}_tangent: dR[{k}]")


FILLED = re.compile(r"if \(known\[(\d+)\] != known\[\1\]\) dq\[\1\] = (\S+), known\[\1\] = q\[\1\];")


def check_filled_changes(drive: Drive, system: dict, rng: Random) -> None:
    """Changes of what a design system fills in, along changes of parameters and unknowns."""
    base, name = drive.base(rng), system["name"]
    symbols = [unknown["name"] for unknown in system["unknowns"]]
    body = body_of(drive.tangents, f"{drive.prefix}_{name}_fill_tangent")
    lines = FILLED.findall(body)
    targets = [drive.parameters[int(place)] for place, _ in lines]
    require(targets == list(system["fills"]), f"{name}_fill_tangent fills in other parameters")
    program = read_body(FILLED.sub("", body))
    own, moved, values = {}, {}, {}
    for key, symbol in [*((f"q[{k}]", s) for k, s in enumerate(drive.parameters) if s not in targets),
                        *((f"y[{k}]", s) for k, s in enumerate(symbols))]:  # fmt: skip
        given = base.inputs[f"p{key[1:]}"] if key[0] == "q" else Number(rng.randrange(1, PRIME))
        form = given.form if key[0] == "q" else {f"{name} {key}": Fraction(1)}
        own[key], moved[f"d{key}"] = Number(given.value, (), form), Number(rng.randrange(1, PRIME))
        values[symbol] = Number(given.value, (moved[f"d{key}"].value,), form)
    end = {f"q[{len(drive.parameters)}]": Number(1, (), {})}
    run = Machine(own | moved | end, Function(f"{name}_fill_tangent", program, {}), None, base.circle)
    reader = Reader(drive.named, values, run)
    reader = reader.at({symbol: reader(value) for symbol, value in system["fixed"].items()})
    for target, (_, text) in zip(targets, lines, strict=True):
        same(run.value(text), rate(reader(system["fills"][target]), 0), f"{name}_fill_tangent: {target}")
