#!/usr/bin/env python3
"""Check the C of bounded flanks, and CasADi's functions where CasADi can be imported: `python check_bounded.py [folder
[drive …]]`, exit status 0 if everything holds.

Modulo a prime of 61 bits drawn at random, at random inputs, on both flanks:

  edges      equations of edge contact: distance of the placed points, conditions, margin of each edge, tangency of each
             edge to the mating flank, all from the description; their Jacobian by dual numbers; which equations a
             system takes, and which margins it names
  slopes     of each limit of a flank or region by each parameter, by dual numbers
  second     derivatives of point, limits and conditions: of tangents, slopes and recorded slopes, by dual numbers
  casadi     every result of every function, as its own list of instructions computes it, is that of the C function:
             residual, observation, placement, start, natural sizes, guards, rules, surfaces with curvature, functions,
             systems of a design, edges; but for the principal curvatures of the gap, which follow from its form

  tables     the tables of the certified functions, each constant within its radius: setup, instant, equations with
             Jacobian, observation, derivatives along a path, flanks, placement, rules and design systems are those of
             C and description

Needs check.py, check_code.py and check_description.py beside it.
"""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Iterator
from fractions import Fraction
from itertools import combinations_with_replacement, product
from pathlib import Path
from random import Random
from types import ModuleType

try:
    import casadi
except ImportError:
    casadi = None


def _beside(name: str) -> ModuleType:
    """A checker from this file's own folder, wherever they are copied, without leaving compiled files there."""
    module = ModuleType(f"meshwright_{name}_beside")
    module.__file__ = str(Path(__file__).with_name(f"{name}.py"))
    sys.modules[module.__name__] = module
    exec(compile(Path(module.__file__).read_text(encoding="utf-8"), module.__file__, "exec"), module.__dict__)
    return module


DESCRIBED = _beside("check_description")
CODE = DESCRIBED.CODE
Rejected, require, Number, Machine, Function = CODE.Rejected, CODE.require, CODE.Number, CODE.Machine, CODE.Function
Surface, inner, rate, read, same = (
    DESCRIBED.Surface, DESCRIBED.inner, DESCRIBED.rate, DESCRIBED.read, DESCRIBED.same,
)  # fmt: skip
#: Margins beyond which a flank ends in a convex edge.
EDGES = ("tip", "throat", "face")


class Drive(DESCRIBED.Drive):
    """A drive with the header of its bounded flanks."""

    def __init__(self, description: dict, text: str, bounded: str, tables: str = ""):
        super().__init__(description, text)
        self.bounded, self.tables = bounded, tables

    def _read(self, name: str) -> Function:
        text = self.text
        if f" {self.prefix}_{name}(" in self.bounded:
            self.text = self.bounded
        try:
            return super()._read(name)
        finally:
            self.text = text

    def edges_of(self, body: dict) -> list[int]:
        """Numbers of the margins that are edges."""
        return [
            k for k, m in enumerate(body["margins"]) if m["role"] in EDGES and m["along"] is None and not m["relative"]
        ]

    def surfaces(self) -> list[tuple[dict, str]]:
        """Flanks and regions with the names of their functions."""
        described = self.description
        flanks = [(body, f"flank_{body['name']}") for body in described["bodies"]]
        return flanks + [(region, f"{region['region']}_{region['member']}") for region in described["regions"]]


# ---- edges -----------------------------------------------------------------------------------------------------------


def check_edges(drive: Drive, rng: Random) -> None:
    """The equations, from the description."""
    run, reader = drive.run("edges", rng, "x", drive.unknowns)
    bodies = drive.description["bodies"]
    places = {name: k for k, name in enumerate(drive.unknowns)}
    placed = [Surface(reader, body["surface"], body["motion"]) for body in bodies]
    found = [run.value(f"R[{k}]") for k in range(count_of(drive))]
    apart = [CODE.add(a, b, -1) for a, b in zip(*(surface.point for surface in placed), strict=True)]
    same(inner(found[:3], found[:3]), inner(apart, apart), "edges: the distance")
    expected = [reader(condition) for body in bodies for condition in body["surface"]["conditions"]]
    listed = [(member, k) for member, body in enumerate(bodies) for k in drive.edges_of(body)]
    expected += [DESCRIBED.margin_of(reader, bodies[m]["margins"][k], bodies[m], places) for m, k in listed]
    expected += [tangency(reader, bodies[m], placed[m], placed[1 - m], k, places) for m, k in listed]
    require(len(found) == 3 + len(expected), "edges: another number of equations")
    for k, (a, b) in enumerate(zip(found[3:], expected, strict=True), 3):
        same(a, b, f"edges: R[{k}]")


def tangency(reader, body: dict, own: Surface, mate: Surface, number: int, places: dict[str, int]) -> Number:
    """The direction along which neither the margin nor a condition changes, against the mate's normal."""
    columns = [places[q["name"]] for q in body["surface"]["parameters"]]
    margin = DESCRIBED.margin_of(reader, body["margins"][number], body, places)
    rows = [margin, *map(reader, body["surface"]["conditions"])]
    slopes = [[rate(row, column) for column in columns] for row in rows]
    total = Number(0)
    for j, column in enumerate(columns):
        minor = DESCRIBED.determinant([[row[k] for k in range(len(columns)) if k != j] for row in slopes])
        along = inner(mate.outward, [rate(p, column) for p in own.point])
        total = CODE.add(total, CODE.multiply(minor, along), -1 if j % 2 else 1)
    return total


def count_of(drive: Drive) -> int:
    return int(re.search(rf"{drive.prefix}_EDGE_EQUATIONS = (\d+)", drive.bounded)[1])


def check_edge_slopes(drive: Drive, rng: Random) -> None:
    """J is the derivative of R, entry by entry."""
    run, _ = drive.run("edges", rng, "x", drive.unknowns)
    n = len(drive.unknowns)
    for i in range(count_of(drive)):
        row = run.value(f"R[{i}]")
        for j in range(n):
            same(run.value(f"J[{i * n + j}]"), rate(row, j), f"edges: J[{i}][{j}]")


def systems_of(drive: Drive) -> Iterator[tuple[str, tuple, list[int]]]:
    """Name, margins of pinion and wheel (-1: the flank itself), and equations of each system."""
    pinion, wheel = drive.description["bodies"]
    always = 3 + sum(len(body["surface"]["conditions"]) for body in (pinion, wheel))
    listed = [(body, k) for body in (pinion, wheel) for k in drive.edges_of(body)]
    place = {(body["name"], k): always + i for i, (body, k) in enumerate(listed)}

    def name(body: dict, k: int) -> str:
        return f"{body['name']}_{body['margins'][k]['event']}"

    for body, k in listed:
        at = place[body["name"], k]
        margins = (k, -1) if body is pinion else (-1, k)
        yield name(body, k), margins, [*range(always), at, at + len(listed)]
    for i, j in product(drive.edges_of(pinion), drive.edges_of(wheel)):
        rows = [*range(always), place[pinion["name"], i], place[wheel["name"], j]]
        yield f"{name(pinion, i)}_{name(wheel, j)}", (i, j), rows


def check_systems(drive: Drive) -> None:
    """Which equations each system takes, and what the table says of it."""
    chosen = {
        name: [int(k) for k in numbers.split(",")]
        for name, numbers in re.findall(
            rf"{drive.prefix}_edge_(\w+)\(const double[^\n]*\n{{\n    static const int chosen\[\] = {{ ([\d, ]+) }};\n"
            rf"    {drive.prefix}_edges_chosen\(s, x, R, J, chosen\);\n}}",
            drive.bounded,
        )
    }
    table = re.findall(r"{ { (-?\d+), (-?\d+) }, " + drive.prefix + r"_edge_(\w+) }", drive.bounded)
    expected = list(systems_of(drive))
    require(chosen == {name: rows for name, _, rows in expected}, "edges: a system takes other equations")
    require(
        table == [(str(i), str(j), name) for name, (i, j), _ in expected], "edges: the table of systems is another one"
    )


# ---- beyond first order ----------------------------------------------------------------------------------------------


def check_slopes(drive: Drive, entry: dict, name: str, rng: Random) -> None:
    """Slopes of limits, and second derivatives, from what the surface's own function computes."""
    symbols = [q["name"] for q in entry["surface"]["parameters"]]
    run, _ = drive.run(name, rng, "q", symbols)
    limits = ["regular", *(f"margin_{m['event']}" for m in entry["margins"])]
    slopes = Machine(run.inputs, drive.function(f"slopes_{name}"), run.earlier, run.circle)
    n = len(symbols)
    for i, key in enumerate(limits):
        (limit,) = read(run, key)
        for j in range(n):
            same(slopes.value(f"o[{i * n + j}]"), rate(limit, j), f"slopes_{name}: {key} by {symbols[j]}")
    if f" {drive.prefix}_second_{name}(" not in drive.bounded:
        return
    second = Machine(run.inputs, drive.function(f"second_{name}"), run.earlier, run.circle)
    tangents = [read(run, f"tangent_{symbol}") for symbol in symbols]
    first = [[tangent[k] for tangent in tangents] for k in range(3)]
    first += [[slopes.value(f"o[{i * n + j}]") for j in range(n)] for i in range(len(limits))]
    first += [read(run, f"condition_{k}_slopes") for k in range(len(entry["surface"]["conditions"]))]
    at = 0
    for i, row in enumerate(first):
        for a, b in combinations_with_replacement(range(n), 2):
            same(second.value(f"o[{at}]"), rate(row[a], b), f"second_{name}: o[{at}] ({i} by {a}, {b})")
            at += 1


# ---- CasADi ----------------------------------------------------------------------------------------------------------


BINARY = {"OP_ADD": "+", "OP_SUB": "-", "OP_MUL": "*", "OP_DIV": "/"}


def program_of(function) -> tuple[dict[str, tuple[str, str]], list[int]]:
    """A CasADi function as a straight-line program: results o[k] one after the other, inputs as `in i k`."""
    codes = {getattr(casadi, name): name for name in dir(casadi) if name.startswith("OP_")}
    now: dict[int, str] = {}
    made: dict[str, tuple[str, str]] = {}
    sizes = [function.size1_out(k) * function.size2_out(k) for k in range(function.n_out())]
    begins = [sum(sizes[:k]) for k in range(len(sizes))]
    for k in range(function.n_instructions()):
        code = codes[function.instruction_id(k)]
        a, b = function.instruction_input(k), function.instruction_output(k)
        if code == "OP_OUTPUT":
            made[f"o[{begins[b[0]] + b[1]}]"] = ("expression", now[a[0]])
            continue
        if code == "OP_CONST":
            now[b[0]] = f"({function.instruction_constant(k)!r})"
            continue
        name = f"t{k}"
        if code == "OP_INPUT":
            made[name] = ("expression", f"in{a[0]}[{a[1]}]")
        elif code in BINARY:
            made[name] = ("expression", f"{now[a[0]]} {BINARY[code]} {now[a[1]]}")
        elif code in ("OP_SIN", "OP_COS"):
            made[name] = (code[3:].lower(), now[a[0]])
        else:
            made.update(unary(code, name, [now[i] for i in a]))
        now[b[0]] = name
    return made, begins


def unary(code: str, name: str, operands: list[str]) -> dict[str, tuple[str, str]]:
    """Operations that C spells otherwise. ``a < 0`` is (1 - sign a) / 2."""
    first = operands[0]
    match code:
        case "OP_NEG":
            return {name: ("expression", f"-{first}")}
        case "OP_SQ":
            return {name: ("expression", f"{first} * {first}")}
        case "OP_TWICE":
            return {name: ("expression", f"2.0 * {first}")}
        case "OP_INV":
            return {name: ("expression", f"1.0 / {first}")}
        case "OP_SQRT":
            return {name: ("expression", f"sqrt({first})")}
        case "OP_ATAN2":
            return {name: ("expression", f"atan2({first}, {operands[1]})")}
        case "OP_FABS":
            return {f"{name}m": ("expression", f"SIGN({first})"), name: ("expression", f"{first} * {name}m")}
        case "OP_LT":
            return {
                f"{name}mm": ("expression", f"{first} - {operands[1]}"),
                f"{name}mmm": ("expression", f"SIGN({name}mm)"),
                f"{name}m": ("expression", f"1.0 - {name}mmm"),
                name: ("expression", f"0.5 * {name}m"),
            }
    raise Rejected(f"CasADi: {code} is not foreseen")


class Casadi:
    """The functions of a drive, read when asked for."""

    def __init__(self, folder: Path, prefix: str):
        self.folder, self.prefix, self.known = folder, prefix, {}

    def __call__(self, ending: str = ""):
        if ending not in self.known:
            self.replace(ending, casadi.Function.load(str(self.folder / f"{self.prefix}{ending}.casadi")))
        return self.known[ending]

    def replace(self, ending: str, function) -> None:
        """Take this function for the one of a file."""
        made, begins = program_of(function)
        names = dict(zip(function.name_out(), begins, strict=True))
        sizes = {name: function.numel_out(name) for name in names}
        self.known[ending] = Function(f"casadi{ending}", made, {k: (names[k], sizes[k]) for k in names}), function


def parts_of(drive: Drive, ending: str, result: str, size: int) -> list[tuple[int, int]]:
    """What of a result is compared at one input: place and size of each of its named outputs."""
    name = {"": "observe" if result == "observation" else "", "_surfaces": result}.get(ending, "")
    if not name:
        return [(0, size)]
    return [part for key, part in drive.function(name).outputs.items() if key != "curvature_gap"]


def check_casadi(drive: Drive, functions: Casadi, ending: str, result: str, part: tuple, rng: Random) -> None:
    """A part of one result of one function beside the C function that computes the same."""
    function, loaded = functions(ending)

    def made() -> tuple[Machine, list, Machine]:
        run, texts, given = beside(drive, ending, result, rng)
        own = {
            f"in{k}[{i}]": number
            for k in range(loaded.n_in())
            for i, number in enumerate(given.get(loaded.name_in(k), []))
        }
        return run, texts, Machine(own, function, None, run.circle)

    run, texts, machine = DESCRIBED.once(rng, ("casadi", ending, result), made)
    at, size = function.outputs[result]
    require(size == len(texts), f"CasADi{ending}: {result} has another length")
    for k in range(part[0], part[0] + part[1]):
        number, text = machine.value(f"o[{at + k}]"), texts[k]
        expected = text if isinstance(text, Number) else run.value(text)
        same(number, expected, f"CasADi{ending}: {result}")


def beside(drive: Drive, ending: str, result: str, rng: Random) -> tuple[Machine, list, dict]:
    """The C function of a result, the texts of its outputs, and what CasADi's arguments are."""
    parameters = len(drive.parameters)
    if ending in ("", "_edges"):
        given = main_inputs(drive, rng)
        return *main_texts(drive, result, rng), given
    if ending == "_surfaces":
        name = result.removeprefix("curvature_")
        symbols = arguments_of(drive, name)
        run, _ = drive.run(name, rng, "q", symbols)
        if result != name:
            run = Machine(run.inputs, drive.function(result), run.earlier, run.circle)
        total = max(at + size for at, size in run.function.outputs.values())
        given = {"p": [run.inputs[f"p[{k}]"] for k in range(parameters)]}
        given[f"q_{name}"] = [run.inputs[f"q[{k}]"] for k in range(len(symbols))]
        return run, [f"o[{k}]" for k in range(total)], given
    system = next(s for s in drive.description["design_systems"] if ending == f"_{s['name']}")
    symbols = [unknown["name"] for unknown in system["unknowns"]]
    stem = {"residual": "eval", "values": "fill"}.get(result, result)
    run, _ = drive.design(f"{system['name']}_{stem}", rng, symbols)
    given = {"p": [run.inputs[f"q[{k}]"] for k in range(parameters)], "path": [run.inputs[f"q[{parameters}]"]]}
    given["y"] = [run.inputs[f"y[{k}]"] for k in range(len(symbols))]
    letters = {"residual": "R", "guess": "new y", "scale": "new y", "watch": "o"}
    if result == "values":
        texts = [f"q[{drive.parameters.index(name)}]" for name in system["fills"]]
        run = Machine(
            {k: v for k, v in run.inputs.items() if k not in texts}, run.function, run.earlier, run.circle
        )
        return run, texts, given
    count = (1 if system["regular"] else 0) if result == "watch" else len(symbols)
    letter = letters[result]
    if letter == "new y":
        run = Machine({k: v for k, v in run.inputs.items() if k[0] != "y"}, run.function, run.earlier, run.circle)
        letter = "y"
    return run, [f"{letter}[{k}]" for k in range(count)], given


def arguments_of(drive: Drive, name: str) -> list[str]:
    """Names of the arguments of a surface or of another function."""
    for entry, own in drive.surfaces():
        if own == name:
            return [q["name"] for q in entry["surface"]["parameters"]]
    if name == "placement":
        return ["own angle of the pinion", "own angle of the wheel"]
    return [q["name"] for f in drive.description["functions"] if f["name"] == name for q in f["arguments"]]


def main_inputs(drive: Drive, rng: Random) -> dict:
    base, _ = drive.run("observe", rng, "x", drive.unknowns)
    return {
        "p": [base.inputs[f"p[{k}]"] for k in range(len(drive.parameters))],
        "phi": [base.inputs["phi"]],
        "x": [base.inputs[f"x[{k}]"] for k in range(len(drive.unknowns))],
    }


def main_texts(drive: Drive, result: str, rng: Random) -> tuple[Machine, list]:
    """C function at the same input, and the texts of what the result holds."""
    observed, _ = drive.run("observe", rng, "x", drive.unknowns)
    inputs, n = observed.inputs, len(drive.unknowns)

    def at(name: str, more: dict | None = None, without: str = "") -> Machine:
        own = {k: v for k, v in inputs.items() if not without or k[0] != without}
        return Machine(own | (more or {}), drive.function(name), observed.earlier, observed.circle)

    match result:
        case "residual":
            return at("eval"), [f"R[{k}]" for k in range(n)]
        case "observation":
            total = max(a + size for a, size in observed.function.outputs.values())
            return observed, [f"o[{k}]" for k in range(total)]
        case "placement":
            angle = Number(read(observed, "wheel_angle")[0].value, (), read(observed, "wheel_angle")[0].form)
            run = at("placement", {"q[0]": inputs["phi"], "q[1]": angle})
            total = max(a + size for a, size in run.function.outputs.values())
            return run, [f"o[{k}]" for k in range(total)]
        case "start_residual":
            start = [unknown["name"] for unknown in drive.description["start"]["unknowns"]]
            own = {f"y[{k}]": inputs[f"x[{drive.unknowns.index(name)}]"] for k, name in enumerate(start)}
            return (at("start_eval", own), [f"R[{k}]" for k in range(len(start))]) if start else (observed, [])
        case "start_solution":
            start = [unknown["name"] for unknown in drive.description["start"]["unknowns"]]
            own = {f"y[{k}]": inputs[f"x[{drive.unknowns.index(name)}]"] for k, name in enumerate(start)}
            return at("start_solution", own, "x"), [f"new x[{k}]" for k in range(n)]
        case "start_guess":
            count = len(drive.description["start"]["unknowns"])
            return (at("guess"), [f"y[{k}]" for k in range(count)]) if count else (observed, [])
        case "scale":
            return at("scale", None, "x"), [f"new x[{k}]" for k in range(n)]
        case "guards":
            function, tested = drive.header.guards
            base = {key: entry for key, entry in inputs.items() if key[0] == "p"}
            run = Machine(base, function, None, observed.circle)
            return run, [tested[k] for k in range(len(tested))]
        case "rules":
            reader = DESCRIBED.Reader(
                drive.named, {name: inputs[f"p[{k}]"] for k, name in enumerate(drive.parameters)}, observed
            )
            return observed, [reader(value) for _, value in DESCRIBED.given_rules(drive)]
    for name, _, rows in systems_of(drive):
        if name == result:
            return at("edges"), [f"R[{k}]" for k in rows]
    raise Rejected(f"CasADi: nothing is known of {result}")


# ---- tables ----------------------------------------------------------------------------------------------------------

#: Operations by number: what C writes for register a and register b.
OPERATIONS = ("{a} + {b}", "{a} - {b}", "{a} * {b}", "{a} * {a}", "{a} / {b}", "-{a}", "sqrt({a})", "sincos",
              "atan2({a}, {b})", "{a} * SIGN({a})", "SIGN({a})")  # fmt: skip
SINE = OPERATIONS.index("sincos")
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
    exact, angle = CODE.literal_of(first)
    high, low, radius = (Fraction(float(part)) for part in entry.split(","))
    apart = abs(high + low - (exact * PI_FINE if angle else exact))
    require(apart <= radius + SMALLEST, f"tables: the constant {first} is not within its radius")
    return f"({first})"


def tables_of(drive: Drive) -> Iterator[tuple[str, tuple]]:
    """Checks of all tables of a drive."""
    prefix, text = f"{drive.prefix}_certified", drive.tables
    rules = re.findall(rf"^    {{ (-?\d+), {{ [^{{}}]*?{prefix}_rule_(\d+)_output }} }},$", text, re.M)
    given = DESCRIBED.given_rules(drive)
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


def check_factors(drive: Drive) -> None:
    """What a parameter is multiplied by, within its radius."""
    entries = re.search(rf"{drive.prefix}_certified_factors\[\] = {{(.*?)}};", drive.tables)[1]
    found = [tuple(Fraction(float(part)) for part in e.split(",")) for e in re.findall(r"{ ([^{}]*) }", entries)]
    require(len(found) == len(drive.parameters), "tables: another number of factors")
    for (high, low, radius), key in zip(found, drive.description["keys"], strict=True):
        factor, exact = key["factor"], Fraction(1)
        for part in factor[1:] if isinstance(factor, list) and factor[0] == "*" else [factor]:
            exact *= part if isinstance(part, int) else PI_FINE if part == ["pi"] else Fraction(*part[1:])
        require(abs(high + low - exact) <= radius, f"tables: the unit of {key['key']}")


def check_table(drive: Drive, table: Table, name: str, slots: int, design: int, rng: Random) -> None:
    """One of the functions of a contact, of a flank or the placement, beside the C function."""
    if name not in ("setup", "instant", "equations", "observed", "along"):
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
        speed = {f"v[{k}]": Number(rng.randrange(1, CODE.PRIME)) for k in range(count + 1)}
        way = Machine(seen.inputs | speed, drive.function("along"), setup, seen.circle)
        kept, unset = [setup.value(f"s[{k}]") for k in range(design)], [Number(0)] * (slots - design)
        unknowns = [seen.inputs[f"x[{k}]"] for k in range(count)]
        arguments = [*kept, *unset, seen.inputs["phi"], *unknowns, *speed.values()]
        expected = [way.value(f"{order}[{k}]") for order in ("d1", "d2") for k in range(count)]
    else:
        unknowns = [seen.inputs[f"x[{k}]"] for k in range(len(drive.unknowns))]
        arguments = [*((setup if k < design else instant).value(f"s[{k}]") for k in range(slots)), *unknowns]
        expected = list(enclosed(drive, seen)) if name == "observed" else list(equated(drive, seen))
    run = table.machine(arguments, seen)
    require(len(table.outputs) == len(expected), f"table {name}: another number of results")
    for k, number in enumerate(expected):
        same(run.value(f"o[{k}]"), number, f"table {name}: {k}")
    for k in range(len(drive.unknowns) if name == "equations" else 0):
        same(run.value(f"leading[{k}]"), expected[k], f"table {name}: {k} after the first instructions")


def check_own_table(drive: Drive, table: Table, name: str, slots: int, design: int, rng: Random) -> None:
    """A function of arguments of its own: a flank, its point, limits and tangents; the placement, all of it."""
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


def equated(drive: Drive, seen: Machine) -> Iterator[Number]:
    """Residual and Jacobian."""
    run, n = Machine(seen.inputs, drive.function("eval"), seen.earlier, seen.circle), len(drive.unknowns)
    yield from (run.value(f"R[{k}]") for k in range(n))
    yield from (run.value(f"J[{k}]") for k in range(n * n))


def enclosed(drive: Drive, seen: Machine) -> Iterator[Number]:
    """Points and normals, wheel angle, curvatures of the gap, of each body whether it is regular, and its margins."""
    bodies = [body["name"] for body in drive.description["bodies"]]
    keys = [f"{key}_{body}_f" for body in bodies for key in ("point", "normal")] + ["wheel_angle", "curvature_gap"]
    for body in drive.description["bodies"]:
        keys += [f"regular_{body['name']}", *(f"margin_{body['name']}_{m['event']}" for m in body["margins"])]
    for key in keys:
        yield from read(seen, key)


def check_rule_table(drive: Drive, table: Table, number: int, rng: Random) -> None:
    """A rule beside the description; what must not be zero is not."""
    base = drive.base(rng)
    parameters = [base.inputs[f"p[{k}]"] for k in range(len(drive.parameters))]
    run = table.machine(parameters, base)
    values = dict(zip(drive.parameters, parameters, strict=True))
    target, value = DESCRIBED.given_rules(drive)[number]
    expected = DESCRIBED.Reader(drive.named, {k: v for k, v in values.items() if k != target}, run)(value)
    same(run.value("o[0]"), expected, f"table of rule {number} for {target}")
    for k in range(1, len(table.outputs)):
        require(run.value(f"o[{k}]").value, f"table of rule {number}: a divisor that is zero")


def check_system_table(drive: Drive, system: dict, equations: Table, values: Table, rng: Random) -> None:
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


# ---- roots -----------------------------------------------------------------------------------------------------------


def with_any_root(check, arguments: tuple, draws: tuple) -> None:
    """A check with any function in the place of the square root, and where that fails with the root itself.

    Two programs that agree whatever that function is agree for the root; and no radicand has to be a square.
    """
    salt, root = draws[0].salt, CODE.square_root
    CODE.__dict__["square_root"] = lambda value: hash((salt, value % CODE.PRIME)) % CODE.PRIME
    try:
        for flank in draws[:2]:
            check(*arguments, next(iter(flank)))
        return
    except (Rejected, CODE.NoRoot):
        pass
    finally:
        CODE.__dict__["square_root"] = root
    if check is check_casadi and arguments[3].startswith("curvature_"):
        # CasADi makes the magnitude of the root of a square, which principal curvatures rest on
        with CODE.real_signs():
            DESCRIBED.attempt(check, *arguments, draws=draws[4:])
    else:
        DESCRIBED.attempt(check, *arguments, draws=draws[2:4])


class Salted(DESCRIBED.Draws):
    """Draws with a number of their own."""

    def __init__(self, sign: int):
        super().__init__(sign)
        self.salt = DESCRIBED.SystemRandom().randrange(CODE.PRIME)


def kept_draws() -> tuple:
    """What all checks of a drive share, two flanks each: with any function for the root, with roots, with signs too."""
    return *map(Salted, (1, -1)), *map(DESCRIBED.Draws, (1, -1, 1, -1))


# ---- all -------------------------------------------------------------------------------------------------------------


def checks_of(drive: Drive, functions: Casadi | None) -> Iterator[tuple[str, tuple]]:
    """Words, and a check with its arguments."""
    if " " + drive.prefix + "_edges(" in drive.bounded:
        yield "edges", (check_edges, drive)
        yield "slopes of edges", (check_edge_slopes, drive)
    for entry, name in drive.surfaces():
        yield f"slopes and second derivatives of {name}", (check_slopes, drive, entry, name)
    if drive.tables:
        yield from tables_of(drive)
    if functions is None:
        return
    systems = [f"_{system['name']}" for system in drive.description["design_systems"]]
    for ending in ("", "_edges", "_surfaces", *systems):
        if (functions.folder / f"{drive.prefix}{ending}.casadi").is_file():
            for result, (_, size) in functions(ending)[0].outputs.items():
                for part in parts_of(drive, ending, result, size) if size else ():
                    yield f"CasADi{ending}: {result}{list(part)}", (
                        check_casadi, drive, functions, ending, result, part,
                    )  # fmt: skip


def check_drive(description: Path, header: Path, folder: Path) -> int:
    """All checks of one drive; how many were made."""
    try:
        drive = Drive(
            json.loads(description.read_text(encoding="utf-8")),
            header.read_text(encoding="utf-8"),
            CODE.read_companion(header, "bounded"),
            CODE.read_companion(header, "certified"),
        )
        functions = Casadi(folder, drive.prefix) if casadi and folder.is_dir() else None
        if drive.bounded:
            check_systems(drive)
        checks = list(checks_of(drive, functions))
        draws = kept_draws()
        for _, (check, *arguments) in checks:
            with_any_root(check, tuple(arguments), draws)
    except (Rejected, LookupError, ValueError, AttributeError, TypeError, ArithmeticError) as error:
        raise Rejected(f"{header.name}: {error}") from error
    return len(checks)


def verify(folder: Path, drives: list[str]) -> tuple[int, int]:
    """Drives and checks, of all drives if none is named; Rejected if one fails."""
    root = folder.parent
    described = root / "descriptions"
    descriptions = [described / f"{name}.json" for name in drives] or sorted(described.glob("*.json"))
    missing = [path.name for path in descriptions if not path.is_file()]
    require(descriptions and not missing, f"{described}: no {', '.join(missing) or 'description'}")
    return len(descriptions), sum(
        check_drive(path, root / "c" / f"{path.stem}.h", root / "casadi") for path in descriptions
    )


def main(arguments: list[str]) -> int:
    try:
        drives, checks = verify(Path(arguments[0] if arguments else Path(__file__).parent), arguments[1:])
    except Rejected as reason:
        print(f"REJECTED: {reason}", file=sys.stderr)
        return 1
    if casadi is None:
        print("CasADi is not installed: its functions are not compared", file=sys.stderr)
    words = "edges, limits, second derivatives, tables" + (", CasADi" if casadi else "")
    print(f"{checks} checks of {drives} drives hold: {words}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
