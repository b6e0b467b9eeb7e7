"""Tables of the certified functions beside C and description."""

import re
from collections.abc import Iterator
from fractions import Fraction
from random import Random

from .description import Reader
from .design import given_rules
from .drive import rate, read, same
from .edges import BoundedDrive
from .machine import Machine
from .modular import PRIME, Number
from .refusal import require
from .straight_line import Function, literal_of

#: Operations by number: what C writes for register a and register b.
OPERATIONS = ("{a} + {b}", "{a} - {b}", "{a} * {b}", "{a} * {a}", "{a} / {b}", "-{a}", "sqrt({a})", "sincos",
              "atan2({a}, {b})", "magnitude", "SIGN({a})")  # fmt: skip
SINE, MAGNITUDE = OPERATIONS.index("sincos"), OPERATIONS.index("magnitude")
CODE_OF = re.compile(r"{ (\d+), (\d+), (\d+), (\d+), (\d+), (\d+), (\w+)_input, (\w+)_constant, (\w+)_operation, "
                     r"(\w+)_output }")  # fmt: skip


def _arc_of(n: int) -> Fraction:
    """atan(1/n), to 1e-60."""
    return sum(Fraction((-1) ** k, (2 * k + 1) * n ** (2 * k + 1)) for k in range(45))


#: The smallest double, and the circle's number to 1e-60 (Machin).
SMALLEST = Fraction(1, 2**1074)
PI_FINE = 16 * _arc_of(5) - 4 * _arc_of(239)


class Table:
    """A function as a table: its places of inputs, its constants, and the straight-line program of its registers."""

    def __init__(self, text: str, name: str):
        self.name, (sizes, *names) = name, self._sizes(text, name)
        require(set(names) == {name}, f"{name}: a table of another function")
        registers, inputs, constants, instructions, self.first, outputs = sizes
        self.inputs = _numbers(text, f"{name}_input")[:inputs]
        wide = re.search(rf"{name}_constant\[\] = {{(.*?)}};", text)[1]
        self.constants = [constant_of(entry) for entry in re.findall(r"{ ([^{}]*) }", wide)[:constants]]
        flat = _numbers(text, f"{name}_operation")
        self.instructions = [tuple(flat[k : k + 4]) for k in range(0, 4 * instructions, 4)]
        self.outputs = _numbers(text, f"{name}_output")[:outputs]
        lengths = inputs, constants, instructions, outputs
        found = len(self.inputs), len(self.constants), len(self.instructions), len(self.outputs)
        require(found == lengths and all(len(i) == 4 for i in self.instructions), f"{name}: tables of other lengths")
        places = [*self.outputs, *(k for _, *i in self.instructions for k in i)]
        require(all(k < registers for k in places), f"{name}: a register beyond the last")

    @staticmethod
    def _sizes(text: str, name: str) -> tuple:
        found = [m for m in CODE_OF.finditer(text) if m[7] == name]
        require(len(found) == 1, f"{name}: {len(found)} functions of this name")
        *sizes, a, b, c, d = found[0].groups()
        return tuple(map(int, sizes)), a, b, c, d

    def machine(self, inputs: list[Number], run: Machine) -> Machine:
        """The table run on its arguments in a row."""
        given = {f"in[{k}]": inputs[place] for k, place in enumerate(self.inputs)}
        now, made = dict(enumerate([*given, *self.constants])), {}
        leading = dict(now)
        for k, (code, to, a, b) in enumerate(self.instructions):
            require(code < len(OPERATIONS), f"{self.name}: no operation {code}")
            if code == SINE:
                made |= {f"t{k}": ("sin", now[a]), f"t{k}m": ("cos", now[a])}
                now[b] = f"t{k}m"
            elif code == MAGNITUDE:
                made |= {f"t{k}m": ("expression", f"SIGN({now[a]})"), f"t{k}": ("expression", f"{now[a]} * t{k}m")}
            else:
                made[f"t{k}"] = ("expression", OPERATIONS[code].format(a=now[a], b=now[b]))
            now[to] = f"t{k}"
            if k + 1 == self.first:
                leading = dict(now)
        made |= {f"o[{k}]": ("expression", now[register]) for k, register in enumerate(self.outputs)}
        made |= {f"leading[{k}]": ("expression", leading[r]) for k, r in enumerate(self.outputs) if r in leading}
        return Machine(given, Function(self.name, made, {}), None, run.circle)


def _numbers(text: str, name: str) -> list[int]:
    return [int(k) for k in re.findall(r"-?\d+", re.search(rf" {name}\[\] = {{([^}}]*)}};", text)[1])]


def constant_of(entry: str) -> str:
    """A constant as C writes it: its double, what that lacks and the radius of both enclose the exact number."""
    first = entry.split(",")[0].strip()
    exact, angle = literal_of(first)
    high, low, radius = (Fraction(float(part)) for part in entry.split(","))
    apart = abs(high + low - (exact * PI_FINE if angle else exact))
    require(apart <= radius + SMALLEST, f"tables: the constant {first} is not within its radius")
    return f"({first})"


def tables_of(drive: BoundedDrive) -> Iterator[tuple[str, tuple]]:
    """Checks of all tables of a drive."""
    prefix, text = f"{drive.prefix}_certified", drive.tables
    rules = re.findall(rf"^    {{ (-?\d+), {{ [^{{}}]*?{prefix}_rule_(\d+)_output }} }},$", text, re.M)
    given = given_rules(drive)
    expected = [(str(drive.parameters.index(target)), str(k)) for k, (target, _) in enumerate(given)]
    require(rules == expected, "tables: other rules, or in another order")
    check_factors(drive)
    main = text[text.index(f"static const mw_certified {prefix} = ") :]
    order = [m[7] for m in CODE_OF.finditer(main)]
    names = ("setup", "instant", "equations", "observed", "along", "flank_0", "flank_1", "placement")
    require(order == [f"{prefix}_{name}" for name in names], "tables: other order")
    slots, design = map(int, re.search(r"= {\s*(\d+), (\d+),", main).groups())
    for name in names:
        yield f"table {name}", (check_table, drive, Table(text, f"{prefix}_{name}"), name, slots, design)
    for k, _ in enumerate(given):
        yield f"table rule_{k}", (check_rule_table, drive, Table(text, f"{prefix}_rule_{k}"), k)
    for system in drive.description["design_systems"]:
        name = f"{prefix}_{system['name']}"
        fills = _numbers(text, f"{name}_fills")
        require(
            fills == [*(drive.parameters.index(target) for target in system["fills"]), -1],
            f"tables: {system['name']} fills in other parameters",
        )
        tables = Table(text, name), Table(text, f"{name}_values")
        yield f"table {system['name']}", (check_system_table, drive, system, *tables)


def check_factors(drive: BoundedDrive) -> None:
    """What a parameter is multiplied by, within its radius."""
    entries = re.search(rf"{drive.prefix}_certified_factors\[\] = {{(.*?)}};", drive.tables)[1]
    found = [tuple(Fraction(float(part)) for part in e.split(",")) for e in re.findall(r"{ ([^{}]*) }", entries)]
    require(len(found) == len(drive.parameters), "tables: another number of factors")
    for (high, low, radius), key in zip(found, drive.description["keys"], strict=True):
        factor, exact = key["factor"], Fraction(1)
        for part in factor[1:] if isinstance(factor, list) and factor[0] == "*" else [factor]:
            exact *= part if isinstance(part, int) else PI_FINE if part == ["pi"] else Fraction(*part[1:])
        require(abs(high + low - exact) <= radius, f"tables: the unit of {key['key']}")


def check_table(drive: BoundedDrive, table: Table, name: str, slots: int, design: int, rng: Random) -> None:
    """One of the functions of a contact, of a flank or the placement, beside the C function."""
    if name in ("flank_1", "placement"):
        check_own_table(drive, table, name, slots, design, rng)
        return
    seen, _ = drive.run("observe", rng, "x", drive.unknowns)
    setup, instant = seen.earlier.earlier, seen.earlier
    parameters = [seen.inputs[f"p[{k}]"] for k in range(len(drive.parameters))]
    if name == "setup":
        arguments, expected = parameters, [setup.value(f"s[{k}]") for k in range(design)]
    elif name == "instant":
        kept, unset = [setup.value(f"s[{k}]") for k in range(design)], [Number(0)] * (slots - design)
        arguments = [*kept, *unset, seen.inputs["phi"]]
        expected = [instant.value(f"s[{k}]") for k in range(design, slots)]
    elif name == "along":
        count = len(drive.unknowns)
        speed = {f"v[{k}]": Number(rng.randrange(1, PRIME)) for k in range(count + 1)}
        way = Machine(seen.inputs | speed, drive.function("along"), setup, seen.circle)
        kept, unset = [setup.value(f"s[{k}]") for k in range(design)], [Number(0)] * (slots - design)
        unknowns = [seen.inputs[f"x[{k}]"] for k in range(count)]
        arguments = [*kept, *unset, seen.inputs["phi"], *unknowns, *speed.values()]
        expected = [way.value(f"{order}[{k}]") for order in ("d1", "d2") for k in range(count)]
    else:
        unknowns = {name: seen.inputs[f"x[{k}]"] for k, name in enumerate(drive.unknowns)}
        if name == "flank_0":
            own = drive.description["bodies"][0]["surface"]["parameters"]
            unknowns = {q["name"]: unknowns[q["name"]] for q in own}
        arguments = [*((setup if k < design else instant).value(f"s[{k}]") for k in range(slots)), *unknowns.values()]
        made = {"observed": enclosed, "flank_0": pinion_flank, "equations": equated}[name]
        expected = list(made(drive, seen))
    run = table.machine(arguments, seen)
    require(len(table.outputs) == len(expected), f"table {name}: another number of results")
    for k, number in enumerate(expected):
        same(run.value(f"o[{k}]"), number, f"table {name}: {k}")
    for k in range(len(drive.unknowns) if name == "equations" else 0):
        same(run.value(f"leading[{k}]"), expected[k], f"table {name}: {k} after the first instructions")


def check_own_table(drive: BoundedDrive, table: Table, name: str, slots: int, design: int, rng: Random) -> None:
    """A function of arguments of its own: the wheel's flank, its point, limits and tangents; the placement whole."""
    if name == "placement":
        function, own = name, ["own angle of the pinion", "own angle of the wheel"]
    else:
        body = drive.description["bodies"][int(name[-1])]
        own = [q["name"] for q in body["surface"]["parameters"]]
        function = f"flank_{body['name']}"
    run, _ = drive.run(function, rng, "q", own)
    setup = run.earlier.earlier
    state = [setup.value(f"s[{k}]") if k < design else Number(0) for k in range(slots)]
    keys = list(run.function.outputs)
    if name != "placement":
        keys = ["point", "regular", *(k for k in keys if k.startswith("margin_")), *(f"tangent_{q}" for q in own)]
    expected = [number for key in keys for number in read(run, key)]
    found = table.machine([*state, *(run.inputs[f"q[{k}]"] for k in range(len(own)))], run)
    require(len(table.outputs) == len(expected), f"table {name}: another number of results")
    for k, number in enumerate(expected):
        same(found.value(f"o[{k}]"), number, f"table {name}: {k}")


def equated(drive: BoundedDrive, seen: Machine) -> Iterator[Number]:
    """Residual and Jacobian."""
    run, n = Machine(seen.inputs, drive.function("eval"), seen.earlier, seen.circle), len(drive.unknowns)
    yield from (run.value(f"R[{k}]") for k in range(n))
    yield from (run.value(f"J[{k}]") for k in range(n * n))


def pinion_flank(drive: BoundedDrive, seen: Machine) -> Iterator[Number]:
    """The point of the pinion's flank in the fixed frame, whether it is regular, its margins, its tangents there."""
    body = drive.description["bodies"][0]
    keys = [f"point_{body['name']}_f", f"regular_{body['name']}"]
    keys += [f"margin_{body['name']}_{margin['event']}" for margin in body["margins"]]
    for key in (*keys, *(f"tangent_{q['name']}" for q in body["surface"]["parameters"])):
        yield from read(seen, key)


def enclosed(drive: BoundedDrive, seen: Machine) -> Iterator[Number]:
    """Points and normals, wheel angle, curvatures of the gap, of each body whether it is regular, and its margins."""
    bodies = [body["name"] for body in drive.description["bodies"]]
    keys = [f"{key}_{body}_f" for body in bodies for key in ("point", "normal")] + ["wheel_angle", "curvature_gap"]
    for body in drive.description["bodies"]:
        keys += [f"regular_{body['name']}", *(f"margin_{body['name']}_{m['event']}" for m in body["margins"])]
    for key in keys:
        yield from read(seen, key)


def check_rule_table(drive: BoundedDrive, table: Table, number: int, rng: Random) -> None:
    """A rule beside the description; what must not be zero is not."""
    base = drive.base(rng)
    parameters = [base.inputs[f"p[{k}]"] for k in range(len(drive.parameters))]
    run = table.machine(parameters, base)
    values = dict(zip(drive.parameters, parameters, strict=True))
    target, value = given_rules(drive)[number]
    expected = Reader(drive.named, {k: v for k, v in values.items() if k != target}, run)(value)
    same(run.value("o[0]"), expected, f"table of rule {number} for {target}")
    for k in range(1, len(table.outputs)):
        require(run.value(f"o[{k}]").value, f"table of rule {number}: a divisor that is zero")


def check_system_table(drive: BoundedDrive, system: dict, equations: Table, values: Table, rng: Random) -> None:
    """A design system at the end of its path: equations, Jacobian, what it fills in."""
    symbols = [unknown["name"] for unknown in system["unknowns"]]
    run, reader = drive.design(f"{system['name']}_eval", rng, symbols)
    fixed = {symbol: reader(value) for symbol, value in system["fixed"].items()}
    reader = reader.at({"path": Number(1, (), {}), **fixed})
    count = len(drive.parameters)
    arguments = [*(run.inputs[f"q[{k}]"] for k in range(count)), Number(1, (), {})]
    arguments += [run.inputs[f"y[{k}]"] for k in range(len(symbols))]
    rows = [reader(row) for row in system["residual"]]
    slopes = [rate(row, j) for row in rows for j in range(len(symbols))]
    found, words = equations.machine(arguments, run), f"table {system['name']}"
    require(len(equations.outputs) == len(rows) + len(slopes), f"{words}: another number of equations")
    for k, number in enumerate([*rows, *slopes]):
        same(found.value(f"o[{k}]"), number, f"{words}: {k}")
    for k, row in enumerate(rows):
        same(found.value(f"leading[{k}]"), row, f"{words}: {k} after the first instructions")
    found = values.machine(arguments, run)
    require(len(values.outputs) == len(system["fills"]), f"{words}: fills in another number of parameters")
    for k, (target, value) in enumerate(system["fills"].items()):
        same(found.value(f"o[{k}]"), reader(value), f"{words}: {target}")
