"""What the checkers of generated files notice: one change of a generated file at a time, counted by stage and function.

``python -m derive.audit.mutations [DRIVE…] [--each N] [--sample M] [--log FILE] [--write]`` changes each function of
every drive ``N`` times (scalar C, lanes, sensitivities, bounded flanks, certified tables, CasADi, description), or
``M`` of these a drive, and prints a table.
With a log, what stands in it is not run again, and the table is that of the whole log; ``--write`` keeps it in
``measured.json`` beside this module, from where the page of validation takes it. A changed function is put before those
checks alone that may read it; hashes are left out. A change that is not noticed counts as equal where the function,
evaluated at random inputs, returns what it returned.
"""

from __future__ import annotations

import argparse
import copy
import json
import random
import re
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import nullcontext
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, partial
from pathlib import Path
from types import ModuleType

import mpmath

from derive.audit.checker import attempts, check_bounded, check_code, check_description, check_print, modular
from derive.audit.checker.any_root import kept_draws, with_any_root
from derive.audit.checker.casadi_functions import Casadi, casadi, program_of
from derive.audit.checker.design import check_open, check_unit
from derive.audit.checker.draws import Draws, on_both_flanks
from derive.audit.checker.drive import Drive
from derive.audit.checker.edges import BoundedDrive, check_systems
from derive.audit.checker.kernels import check_arc_kernel, check_kernels
from derive.audit.checker.machine import Machine, machine
from derive.audit.checker.printed import read_printed
from derive.audit.checker.refusal import Rejected
from derive.audit.checker.straight_line import Function, literal_of, read_body, read_header, read_lanes
from derive.audit.checker.tables import CODE_OF, OPERATIONS, Table
from derive.files import replace_text

GENERATED = Path(__file__).resolve().parents[2] / "generated"
MEASURED = Path(__file__).with_name("measured.json")
PRINTED = Path(__file__).with_name("printed.txt")
SEED = 18
#: Stage -> what a header's name ends in.
HEADERS = {"scalar C": "", "lanes": "_lanes", "sensitivity": "_sensitivity", "bounded": "_bounded"}
TABLES, CASADI, DESCRIPTION = "tables", "CasADi", "description"
STAGES = (*HEADERS, TABLES, CASADI, DESCRIPTION)
#: Inputs that a check of a change may draw; a check that finds none at which all roots exist refuses.
ATTEMPTS = 600
#: Inputs at which a function and its change are compared, if roots do not exist at the first of them.
COMPARED = 60
REFUSED, SURVIVED, EQUAL = "refused", "survived", "equal"


@dataclass(frozen=True)
class Mutant:
    """One change: where, in words, and how to make it of the drive's texts."""

    drive: str
    stage: str
    function: str
    words: str
    texts: Callable[[], dict]

    @property
    def key(self) -> tuple[str, ...]:
        return self.drive, self.stage, self.function, self.words


@dataclass(frozen=True)
class Outcome:
    mutant: Mutant
    by: str
    reason: str


# ---- changes of C ----------------------------------------------------------------------------------------------------

NUMBER = r"(?<![\w.])-?\d+\.\d+(?:e[+-]?\d+)?"
OPERAND = r"\(?-?[\w.\[\]]+\)?"
#: What stands in a right-hand side, and what it is changed into: signs, constants, operands, terms, indices.
CHANGES = (
    (r" \+ ", lambda m: " - "),
    (r" - ", lambda m: " + "),
    (r"MW_FMA\(", lambda m: "MW_FNMA("),
    (r"MW_FMS\(", lambda m: "MW_FMA("),
    (r"MW_FNMA\(", lambda m: "MW_FMA("),
    (NUMBER, lambda m: repr(float(m[0]) * 1.5 if float(m[0]) else 0.25)),
    (rf"({OPERAND}) ([-/]) ({OPERAND})(?=;)", lambda m: f"{m[3]} {m[2]} {m[1]}"),
    (r"(atan2)\(([^,()]+), ([^,()]+)\)", lambda m: f"{m[1]}({m[3]}, {m[2]})"),
    (rf"({OPERAND}) [-+] {OPERAND}(?=;)", lambda m: m[1]),
    (r"(?<=[= (])([psxqyv])\[(\d+)\]", lambda m: f"{m[1]}[{int(m[2]) + 1}]"),
    (r"&(s\d+m?), &(c\d+m?)\)", lambda m: f"&{m[2]}, &{m[1]})"),
)


def functions_of(drive: str, text: str) -> Iterator[tuple[str, int, int]]:
    """Name of each function of a header, and where its body stands."""
    names = rf"(?:static inline|MW_INLINE|MW_CALLED) \w+ (?:MW_LANE_NAME\()?{drive}_(\w+)\)?"
    for found in re.finditer(rf"{names}\([^)]*\)\n{{\n(.*?)\n}}", text, re.DOTALL):
        yield found[1], found.start(2), found.end(2)


def of_header(drive: str, text: str) -> Iterator[tuple[str, list[tuple[str, int, int, str]]]]:
    """Of each function what can be changed: words, place, and what to put there."""
    for function, start, end in functions_of(drive, text):
        found = []
        for line in re.finditer(r"[^\n]+", text[start:end]):
            code = line[0].partition("/*")[0]
            rows = re.search(r"chosen\[\] = {", code)
            if not (rows or re.search(r" = |sincos\(", code)) or re.match(r" *(if|for) ", code):
                continue
            for pattern, other in CHANGES if not rows else ((r"\b\d+\b", lambda m: str(int(m[0]) + 1)),):
                for match in re.finditer(pattern, code):
                    at = start + line.start()
                    words = f"{code.strip()[:60]} @{match.start()}: {match[0]} -> {other(match)}"
                    found.append((words, at + match.start(), at + match.end(), other(match)))
        if found:
            yield function, found


# ---- changes of tables -----------------------------------------------------------------------------------------------

#: Number of an operation -> another: sum, difference, product.
OTHER_OPERATION = {0: 1, 1: 0, 2: 0, 3: 2, 4: 2}


def of_tables(drive: str, text: str) -> Iterator[tuple[str, list[tuple[str, int, int, str]]]]:
    """Of each table what can be changed: an operation, an operand, a constant, a place of an input or an output."""
    for code in re.finditer(rf"\b{drive}_certified_(\w+)_operation\[\] = {{([^}}]*)}};", text):
        name, at, found = code[1], code.start(2), []
        numbers = list(re.finditer(r"\d+", code[2]))
        for k in range(0, len(numbers) - 3, 4):
            operation, _, a, b = numbers[k : k + 4]
            words = f"instruction {k // 4}"
            if int(operation[0]) in OTHER_OPERATION:
                other = str(OTHER_OPERATION[int(operation[0])])
                found.append((f"{words}: operation", at + operation.start(), at + operation.end(), other))
            if int(operation[0]) in (1, 4, 8) and a[0] != b[0]:
                found.append((f"{words}: operands", at + a.start(), at + b.end(), f"{b[0]},{a[0]}"))
            found.append((f"{words}: register", at + a.start(), at + a.end(), str(int(a[0]) - 1 if int(a[0]) else 1)))
        for kind, pattern in (("constant", r"(?<={ )-?[\d.e+-]+"), ("input", r"\d+"), ("output", r"\d+")):
            table = re.search(rf"\b{drive}_certified_{name}_{kind}\[\] = {{(.*)}};", text)
            if table is None:
                continue
            size = _size_of(text, f"{drive}_certified_{name}", kind)
            for k, match in enumerate(list(re.finditer(pattern, table[1]))[:size]):
                value = float(match[0]) if kind == "constant" else int(match[0])
                other = repr(value * 1.5 or 0.25) if kind == "constant" else str(value + 1)
                found.append((f"{kind} {k}", table.start(1) + match.start(), table.start(1) + match.end(), other))
        if found:
            yield name, found


def _size_of(text: str, name: str, kind: str) -> int:
    sizes = next(m for m in CODE_OF.finditer(text) if m[7] == name)
    return int(sizes[{"input": 2, "constant": 3, "output": 6}[kind]])


# ---- changes of a description ----------------------------------------------------------------------------------------

#: Left out: what says how a surface was made and which proportions a new design takes is for readers and for ``new``;
#: no generated function reads it.
SECTIONS = ("keys", "rules", "guards", "sizes", "design_systems", "bodies", "regions", "contact", "start", "functions",
            "definitions")  # fmt: skip
UNREAD = ("made", "tangents", "domain", "parity", "search", "keys", "fixed")
OTHER = {"sin": "cos", "cos": "sin", "tan": "sin", "asin": "acos", "acos": "asin", "x": "y", "y": "z", "z": "x"}


def edited(node: object, rng: random.Random) -> object:
    """A wrong reading of one node of an expression or motion; None where there is nothing to change."""
    match node:
        case ["+", *terms]:
            k = rng.randrange(len(terms))
            return ["+", *terms[:k], ["*", -1, terms[k]], *terms[k + 1 :]]
        case ["*", *factors] if len(factors) > 1:
            k = rng.randrange(len(factors))
            return ["*", *factors[:k], *factors[k + 1 :]]
        case ["^", base, int() as power] if base != "s":  # the flank's sign: its square is 1
            return ["^", base, -power]
        case ["/", int() as p, int() as q]:
            return ["/", p + q, q]
        case ["sin" | "cos" | "tan" | "asin" | "acos" as name, operand]:
            return [OTHER[name], operand]
        case ["rotation" | "swing" as kind, axis, angle, *rest]:
            turned = (OTHER[axis], angle) if rng.random() < 0.5 else (axis, ["*", -1, angle])
            return [kind, *turned, *rest]
        case ["translation" | "station" as kind, [a, b, c]]:
            return [kind, [b, a, c]]
    return None


def places(node: object, path: tuple = ()) -> Iterator[tuple]:
    """Paths of all nodes that can be changed."""
    if isinstance(node, dict):
        for key, value in node.items():
            if key not in UNREAD:
                yield from places(value, (*path, key))
    elif isinstance(node, list):
        if edited(node, random.Random(0)) is not None:
            yield path
        for k, value in enumerate(node):
            yield from places(value, (*path, k))


def changed_at(description: dict, path: tuple, rng: random.Random) -> tuple[str, dict]:
    """A description with one node changed, and words."""
    changed = copy.deepcopy(description)
    node = changed
    for key in path[:-1]:
        node = node[key]
    old = node[path[-1]]
    node[path[-1]] = edited(old, rng)
    return f"{list(path)}: {str(old)[:50]} -> {str(node[path[-1]])[:50]}", changed


# ---- changes of CasADi's functions -----------------------------------------------------------------------------------

SWAPPED = {"OP_ADD": "-", "OP_SUB": "+", "OP_MUL": "+", "OP_DIV": "*"}


def rebuilt(function, at: int, kind: str):
    """A CasADi function of the same instructions, the one at a place changed: operation, operands or constant."""
    import casadi

    codes = {getattr(casadi, name): name for name in dir(casadi) if name.startswith("OP_")}
    given = function.sx_in()
    made = [casadi.SX.zeros(function.sparsity_out(k)) for k in range(function.n_out())]
    work: dict = {}
    for k in range(function.n_instructions()):
        code = function.instruction_id(k)
        a, b = function.instruction_input(k), function.instruction_output(k)
        match codes[code]:
            case "OP_INPUT":
                work[b[0]] = given[a[0]].nz[a[1]]
            case "OP_CONST":
                constant = function.instruction_constant(k)
                work[b[0]] = casadi.SX(constant + 0.5 if k == at else constant)
            case "OP_OUTPUT":
                made[b[0]].nz[b[1]] = work[a[0]]
            case name:
                operands = [work[i] for i in a]
                if k == at and kind == "swap":
                    operands.reverse()
                if k == at and kind == "operation":
                    x, y = operands
                    work[b[0]] = {"-": x - y, "+": x + y, "*": x * y}[SWAPPED[name]]
                elif k == at and kind == "sign":
                    work[b[0]] = -_operation(casadi, code, operands)
                else:
                    work[b[0]] = _operation(casadi, code, operands)
    return casadi.Function(function.name(), given, made, function.name_in(), function.name_out())


def _operation(casadi: ModuleType, code: int, operands: list):
    return casadi.SX.binary(code, *operands) if len(operands) == 2 else casadi.SX.unary(code, *operands)


def of_casadi(function) -> Iterator[tuple[int, str]]:
    """Instructions and how they can be changed."""
    import casadi

    codes = {getattr(casadi, name): name for name in dir(casadi) if name.startswith("OP_")}
    for k in range(function.n_instructions()):
        match codes[function.instruction_id(k)]:
            case "OP_INPUT" | "OP_OUTPUT":
                continue
            case "OP_CONST":
                yield k, "constant"
            case name:
                if name in SWAPPED and k % 2:
                    yield k, "operation"
                else:
                    yield k, "swap" if name in ("OP_SUB", "OP_DIV") else "sign"


# ---- the checks that read a function ---------------------------------------------------------------------------------


#: Words of a check -> the functions that it reads beside setup and set_phi, where its words do not name them.
READ = (
    (r"jacobian of the residual|residual \d", ("eval",)),
    (r"Newton step", ("eval", "step")),
    (r"derivatives along", ("eval", "along")),
    (r"lanes", ("step",)),
    (r"tangents of parameters|assembly", ("eval", "observe")),
    (r"start", ("start_eval", "start_scale", "guess", "start_solution")),
    (r"natural sizes", ("scale",)),
    (r"observation", ("observe",)),
    (r"edges", ("edges",)),
    (r"placement", ("placement",)),
    (r"size ", ("size",)),
    (r"table (equations|observed)", ("eval", "observe")),
    (r"of the (pinion|wheel)", ("flank_pinion", "flank_wheel", "observe")),
)
#: What is read by all checks but those of rules, sizes and design systems.
STATE = ("setup", "set_phi")


def reads(check: Check, name: str) -> bool:
    """May a check read a function of the scalar C or of the bounded flanks?"""
    bare = re.sub(r"^(curvature|slopes|second)_", "", name)
    if name in STATE or re.search(rf"\b({name}|{bare})\b", check.words):
        return True
    return any(name in names and re.search(pattern, check.words) for pattern, names in READ)


@dataclass
class Check:
    """One check of a drive: the module that it is of, its words, and what runs it with some draws."""

    module: str
    words: str
    run: Callable[[dict], None]


class Checks:
    """All checks of one drive of some texts: header endings, description, CasADi functions by their ending."""

    def __init__(self, name: str, texts: dict, folder: Path):
        self.name, self.texts = name, texts
        described = texts[DESCRIPTION]
        self.header = read_header(texts["scalar C"], texts["lanes"], texts["sensitivity"])
        self.drive = Drive(described, texts["scalar C"], texts["sensitivity"])
        self.bounded = BoundedDrive(described, texts["scalar C"], texts["bounded"], texts[TABLES])
        self.casadi = Casadi(folder, name)
        for ending, function in texts.get(CASADI, {}).items():
            self.casadi.replace(ending, function)

    @cached_property
    def all(self) -> list[Check]:
        found = [
            Check("code", "kernels", lambda _: check_kernels(self.texts["scalar C"])),
            Check("code", "arc", lambda _: check_arc_kernel(self.texts["scalar C"])),
        ]
        for words, (check, *arguments) in check_code.checks_of(self.header):
            found.append(Check("code", words, lambda _, c=check, a=arguments: attempts.attempt(c, *a)))
        for number in range(len(self.drive.description["keys"])):
            found.append(Check("description", "unit", lambda _, k=number: check_unit(self.drive, k)))
        for system in self.drive.description["design_systems"]:
            found.append(Check("description", "open", lambda _, s=system: check_open(self.drive, s)))
        for words, check in check_description.checks_of(self.drive):
            found.append(Check("description", words, lambda d, c=check: on_both_flanks(*c, draws=d["description"])))
        if self.bounded.bounded:
            found.append(Check("bounded", "systems", lambda _: check_systems(self.bounded)))
        for words, (check, *arguments) in check_bounded.checks_of(self.bounded, self.casadi):
            own = tuple(arguments)
            found.append(Check("bounded", words, lambda d, c=check, a=own: with_any_root(c, a, d["any"])))
        return found


def draws() -> dict:
    return {"description": (Draws(1), Draws(-1)), "any": kept_draws()}


#: What a check ends in that cannot read what it is given.
UNREADABLE = (LookupError, ValueError, AttributeError, TypeError, ArithmeticError)


class Measured:
    """A drive as generated: its texts and its checks."""

    def __init__(self, name: str, generated: Path = GENERATED):
        self.name, self.generated = name, generated
        self.texts: dict = {
            stage: (generated / "c" / f"{name}{ending}.h").read_text(encoding="utf-8")
            for stage, ending in {**HEADERS, TABLES: "_certified"}.items()
        }
        path = generated / "descriptions" / f"{name}.json"
        self.texts[DESCRIPTION] = json.loads(path.read_text(encoding="utf-8"))
        self.checks = Checks(name, self.texts, generated / "casadi")

    def wanted(self, mutant: Mutant) -> list[int]:
        """Numbers of the checks that may read what was changed, tables first; of a description all."""
        chosen = [k for k in range(len(self.checks.all)) if self._reads(k, mutant)]
        return sorted(chosen, key=lambda k: not self.checks.all[k].words.startswith(("table", "parameters at")))

    def _reads(self, k: int, mutant: Mutant) -> bool:
        check, name = self.checks.all[k], mutant.function
        match mutant.stage:
            case "lanes":
                return check.words == "lanes"
            case "sensitivity":
                return ("tangent" in check.words and check.module == "code") or check.words.startswith("changes ")
            case "scalar C" if name in ("sincos", "seldom_sincos", "atan2"):
                return check.words in ("kernels", "arc")
            case "scalar C" if name == "derive":
                return check.words.startswith(("rule ", "table rule"))
            case "scalar C" if name.endswith("_open"):
                return check.words == "open"
            case "scalar C" if name == "setup" and check.words.startswith("guard "):
                return True
            case "bounded" if name.startswith("edge_"):
                return check.words == "systems"
            case "tables":
                return check.words == f"table {name.removesuffix('_values')}"
            case "CasADi":
                return check.words.startswith(f"CasADi{name}: ")
            case "description":
                return check.module != "code"
        return reads(check, name)

    # ---- mutants -----------------------------------------------------------------------------------------------------

    def mutants(self, each: int, rng: random.Random) -> Iterator[Mutant]:
        for stage in (*HEADERS, TABLES):
            text = self.texts[stage]
            for function, found in of_tables(self.name, text) if stage == TABLES else of_header(self.name, text):
                name = function.removesuffix("_lanes") if stage == "lanes" else function
                for words, start, end, other in rng.sample(found, min(each, len(found))):
                    changed = text[:start] + other + text[end:]
                    yield Mutant(self.name, stage, name, words, partial(self._with, stage, changed))
        for path in sorted((self.generated / "casadi").glob(f"{self.name}*.casadi")):
            ending = path.stem.removeprefix(self.name)
            if ending and not ending.startswith("_"):
                continue
            _, function = self.checks.casadi(ending)
            for at, kind in rng.sample(found := list(of_casadi(function)), min(2 * each, len(found))):
                words = f"{kind} of instruction {at}"
                yield Mutant(self.name, CASADI, ending, words, partial(self._rebuilt, ending, function, at, kind))
        for section in SECTIONS:
            found = [(section, *path) for path in places(self.texts[DESCRIPTION][section])]
            for path in rng.sample(found, min(2 * each, len(found))):
                words, changed = changed_at(self.texts[DESCRIPTION], path, rng)
                yield Mutant(self.name, DESCRIPTION, section, words, partial(self._with, DESCRIPTION, changed))

    def _with(self, stage: str, changed: object) -> dict:
        return {**self.texts, stage: changed}

    def _rebuilt(self, ending: str, function, at: int, kind: str) -> dict:
        return self._with(CASADI, {ending: rebuilt(function, at, kind)})

    def judged(self, mutant: Mutant) -> Outcome:
        try:
            texts = mutant.texts()
            checks, kept = Checks(self.name, texts, self.generated / "casadi"), draws()
            if mutant.stage == DESCRIPTION:
                self._printed(texts[DESCRIPTION])
            found = checks.all
            if len(found) != len(self.checks.all):
                return Outcome(mutant, REFUSED, "other checks")
            for k in self.wanted(mutant):
                found[k].run(kept)
        except Rejected as reason:
            return Outcome(mutant, REFUSED, str(reason)[:160])
        except UNREADABLE as reason:
            return Outcome(mutant, REFUSED, repr(reason)[:160])
        return Outcome(mutant, EQUAL if self.is_equal(mutant, texts) else SURVIVED, "")

    def _printed(self, description: dict) -> None:
        printed = read_printed(PRINTED.read_text(encoding="utf-8"))
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / f"{self.name}.json"
            path.write_text(json.dumps(description), encoding="utf-8")
            check_print.check_drive(path, printed)

    # ---- equal ? -----------------------------------------------------------------------------------------------------

    def is_equal(self, mutant: Mutant, texts: dict) -> bool:
        if mutant.stage == CASADI:
            changed = Checks(self.name, texts, self.generated)
            old, new = (checks.casadi(mutant.function)[0] for checks in (self.checks, changed))
            return same_programs([(old.definitions, new.definitions)], self.checks.header)
        if mutant.stage == DESCRIPTION:
            return False
        if mutant.stage == TABLES:
            name = f"{self.name}_certified_{mutant.function}"
            kept, other = (Table(t[TABLES], name) for t in (self.texts, texts))
            return same_tables(kept, other, self.checks.drive)
        old, new = (programs(self.name, t[mutant.stage], mutant.stage)[mutant.function] for t in (self.texts, texts))
        return len(old) == len(new) and same_programs(list(zip(old, new, strict=True)), self.checks.header)


def same_tables(old, new, drive) -> bool:
    """Do two tables return the same at random inputs, with any function for the root, or of real numbers?"""
    return _same_residues(old, new, drive) or _same_reals(old, new)


def _same_reals(old, new) -> bool:
    """What holds of real numbers alone, where the root of a square is positive: to 30 of 50 digits, at random."""
    rng, agreed = random.Random(SEED), 0
    with mpmath.workdps(50):
        for _ in range(COMPARED):
            row = [mpmath.mpf(rng.uniform(-2.0, 2.0)) for _ in range(1 + max([*old.inputs, *new.inputs], default=0))]
            try:
                first, second = real_values(old, row), real_values(new, row)
            except (ZeroDivisionError, ValueError):
                continue
            pairs = zip(first, second, strict=False)
            if len(first) != len(second) or any(abs(a - b) > abs(a) * 1e-30 for a, b in pairs):
                return False
            agreed += 1
    return agreed > COMPARED // 10


def real_values(table, row: list) -> list:
    """What a table returns of a row of real numbers; ValueError where a root has none."""
    constants = (_real_constant(c) for c in table.constants)
    now = dict(enumerate([*(row[place] for place in table.inputs), *constants]))
    for code, to, a, b in table.instructions:
        x, y = now[a], now.get(b)
        match OPERATIONS[code]:
            case "sincos":
                now[b], now[to] = mpmath.cos(x), mpmath.sin(x)
            case "sqrt({a})" if x < 0:
                raise ValueError("a root of a negative number")
            case words:
                now[to] = REAL[words](x, y)
    return [now[k] for k in table.outputs]


def _real_constant(text: str):
    found = literal_of(text.strip("()"))
    if found is None:
        raise ValueError(f"{text} is no constant")
    exact, angle = found
    return mpmath.mpf(exact.numerator) / exact.denominator * (mpmath.pi if angle else 1)


#: What the operations of a table make of real numbers.
REAL = {
    "{a} + {b}": lambda a, b: a + b,
    "{a} - {b}": lambda a, b: a - b,
    "{a} * {b}": lambda a, b: a * b,
    "{a} * {a}": lambda a, b: a * a,
    "{a} / {b}": lambda a, b: a / b,
    "-{a}": lambda a, b: -a,
    "sqrt({a})": lambda a, b: mpmath.sqrt(a),
    "atan2({a}, {b})": mpmath.atan2,
    "magnitude": lambda a, b: abs(a),
    "SIGN({a})": lambda a, b: (a > 0) - (a < 0),
}


def _same_residues(old, new, drive) -> bool:
    with modular.any_root(random.randrange(modular.PRIME)):
        try:
            run = machine(drive.header, "eval", random.SystemRandom(), True)
            row = [
                modular.Number(random.randrange(1, modular.PRIME), (), {f"in {k}": Fraction(1)})
                for k in range(1 + max([*old.inputs, *new.inputs], default=0))
            ]
            first, second = old.machine(row, run), new.machine(row, run)
            return len(old.outputs) == len(new.outputs) and all(
                first.value(f"o[{k}]").value == second.value(f"o[{k}]").value for k in range(len(old.outputs))
            )
        except (Rejected, modular.NoRoot, *UNREADABLE):
            return False


def programs(drive: str, text: str, stage: str) -> dict[str, list[dict]]:
    """The straight-line programs of each function: that outside all inner braces, and each inner block."""
    found = {}
    for name, start, end in functions_of(drive, text):
        body = text[start:end]
        if stage == "lanes":
            name = name.removesuffix("_lanes")
            found[name] = [read_lanes(text, name).definitions]
            continue
        body = re.sub(r"\breturn (t\d+);", r"o[0] = \1;", body)
        blocks = re.findall(r"^    if \([^\n]*\) {[^\n]*\n(.*?)\n    }", body, re.DOTALL | re.M)
        blocks += re.findall(r"^    {\n(.*?)^    }", body, re.DOTALL | re.M)
        try:
            found[name] = [read_body(block) for block in (body, *blocks)]
        except Rejected:
            found[name] = [{"body": ("text", body)}]
    return found


def same_programs(pairs: list[tuple[dict, dict]], header) -> bool:
    """Do both return the same at random inputs? With any function for the root, or with the root."""
    return all(_same(old, new, header) for old, new in pairs)


def _same(old: dict, new: dict, header, other=None) -> bool:
    """With another header, each reads the state that its own setup makes."""
    if "body" in old or "body" in new:
        return old == new
    if old == new and (other is None or not any("s[" in text for _, text in old.values())):
        return True
    targets = [name for name in old if "[" in name]
    if {name for name in new if "[" in name} != set(targets):
        return False
    for k in range(COMPARED):
        salt = random.randrange(modular.PRIME)
        try:
            with nullcontext() if k else modular.any_root(salt):
                agree = _agree(old, new, targets, header, other)
            if agree:
                return True
            if k > 8:
                return False
        except modular.NoRoot:
            continue
        except (Rejected, *UNREADABLE):
            return False
    return False


def _agree(old: dict, new: dict, targets: list[str], header, other=None) -> bool:
    base = machine(header, "eval", random.SystemRandom(), True)
    inputs = _Anything({name: number for name, number in base.inputs.items() if name not in targets})
    inputs.own, inputs.states = {*targets}, other is None
    instants: list[Machine | None] = [None, None]
    if other is not None:
        instants = [_instant(own, base.inputs, base.circle) for own in (header, other)]
    first, second = (
        Machine(inputs, Function("any", made, {}), instant, base.circle)
        for made, instant in zip((old, new), instants, strict=True)
    )
    return all(first.value(name).value == second.value(name).value for name in targets)


def _instant(header, inputs: dict, circle) -> Machine:
    """A state at an input angle."""
    setup = Machine(inputs, header.functions["setup"], None, circle)
    return Machine(inputs, header.functions["set_phi"], setup, circle)


class _Anything(dict):
    """Inputs: a number for whatever is asked for that a function may read."""

    own: set[str]
    states: bool
    READ = re.compile(r"m?(in\d+|[a-z]+)\[\d+\]|phi|dphi")

    def __contains__(self, name: object) -> bool:
        if isinstance(name, str) and name[:2] == "s[" and not self.states:
            return False
        known = name in self.own or super().__contains__(name)
        if not known and isinstance(name, str) and self.READ.fullmatch(name):
            self[name] = modular.Number(random.randrange(1, modular.PRIME), (), {name: Fraction(1)})
        return super().__contains__(name)


def different(drive: str, made: Path, kept: Path) -> str:
    """The first function of a drive's C or CasADi in one folder that returns something else than in another; empty
    where all return the same. Slots of the state may have other places: each reads the state that its own setup makes.
    """
    folders = kept, made
    texts = [{s: (f / "c" / f"{drive}{e}.h").read_text("utf-8") for s, e in HEADERS.items()} for f in folders]
    headers = [read_header(own["scalar C"]) for own in texts]
    for stage in ("scalar C", "sensitivity", "bounded"):
        first, second = (programs(drive, own[stage], stage) for own in texts)
        if first.keys() != second.keys():
            return f"{stage}: other functions"
        for name, parts in first.items():
            if name in STATE and stage == "scalar C":
                continue
            pairs = list(zip(parts, second[name], strict=False))
            if len(parts) != len(second[name]) or not all(_same(*pair, *headers) for pair in pairs):
                return f"{stage}: {name}"
    for path in sorted((kept / "casadi").glob(f"{drive}*.casadi")):
        files = [folder / "casadi" / path.name for folder in folders]
        if not files[1].is_file():
            return f"no {path.name}"
        loaded = (casadi.Function.load(str(file)) for file in files)
        before, after = (program_of(function)[0] for function in loaded)
        if not _same(before, after, headers[0]):
            return path.name
    return ""


# ---- the table -------------------------------------------------------------------------------------------------------


def measure(drives: list[str], each: int, log: Path | None = None, stages: tuple[str, ...] = STAGES,
            sample: int | None = None, generated: Path = GENERATED) -> Iterator[Outcome]:  # fmt: skip
    """Changes of all functions of some drives, ``each`` a function; of these ``sample`` at random, if it is given."""
    known = _logged(log)
    with attempts.limited(ATTEMPTS):
        for name in drives:
            drive, rng = Measured(name, generated), random.Random(f"{SEED} {name}")
            chosen = [m for m in drive.mutants(each, rng) if m.stage in stages]
            for mutant in chosen if sample is None else rng.sample(chosen, min(sample, len(chosen))):
                if mutant.key in known:
                    yield Outcome(mutant, *known[mutant.key])
                    continue
                outcome = drive.judged(mutant)
                if log:
                    with log.open("a", encoding="utf-8") as file:
                        file.write(json.dumps([*mutant.key, outcome.by, outcome.reason]) + "\n")
                yield outcome


def _logged(log: Path | None) -> dict[tuple[str, ...], tuple[str, str]]:
    lines = map(json.loads, log.read_text(encoding="utf-8").splitlines()) if log and log.is_file() else ()
    return {tuple(key): (by, reason) for *key, by, reason in lines}


def kind_of(function: str) -> str:
    """A function without the names of its system and margin, so that drives can be added up."""
    return re.sub(r"^(edge|rule)_.*", r"\1_*", function) or "contact"


def table(outcomes: dict[tuple[str, ...], tuple[str, str]]) -> list[dict]:
    """Rows by stage and function, over all drives."""
    rows: dict[tuple[str, str], dict] = {}
    for (_, stage, function, _), (by, _) in outcomes.items():
        key = stage, kind_of(function)
        row = rows.setdefault(key, {"stage": key[0], "function": key[1], REFUSED: 0, SURVIVED: 0, EQUAL: 0})
        row[by] += 1
    return [rows[key] for key in sorted(rows, key=lambda key: (STAGES.index(key[0]), key[1]))]


def measured() -> dict:
    """The tables as last measured, with their sums."""
    kept = json.loads(MEASURED.read_text(encoding="utf-8"))
    edits = kept["edits"]
    names = [name for name in edits["rows"][0] if name != "file"]
    edits |= {name: sum(row[name] for row in edits["rows"]) for name in names}
    return kept | {key: sum(row[key] for row in kept["rows"]) for key in (REFUSED, SURVIVED, EQUAL)}


def main(arguments: list[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m derive.audit.mutations", description=__doc__)
    parser.add_argument("drives", nargs="*", metavar="DRIVE", help="default: all that are generated")
    parser.add_argument("--each", type=int, default=1, help="changes a function")
    parser.add_argument("--sample", type=int, help="of these so many a drive, at random; default: all")
    parser.add_argument("--log", type=Path, help="a line of JSON a change; what stands there is not run again")
    parser.add_argument("--stage", action="append", choices=STAGES, help="these alone")
    parser.add_argument("--write", action="store_true", help=f"replace {MEASURED.name}")
    options = parser.parse_args(arguments)
    drives = options.drives or sorted(path.stem for path in (GENERATED / "descriptions").glob("*.json"))
    outcomes = _logged(options.log)
    for outcome in measure(drives, options.each, options.log, tuple(options.stage or STAGES), options.sample):
        outcomes[outcome.mutant.key] = outcome.by, outcome.reason
        if outcome.by != REFUSED:
            print(outcome.by, *outcome.mutant.key, flush=True)
    rows = table(outcomes)
    for row in rows:
        print(f"{row['stage']:12} {row['function']:32}", *(f"{row[by]:4} {by}" for by in (REFUSED, SURVIVED, EQUAL)))
    print({by: sum(row[by] for row in rows) for by in (REFUSED, SURVIVED, EQUAL)})
    if options.write:
        survivors = [list(key) for key, (by, _) in outcomes.items() if by == SURVIVED]
        keep(drives=len({key[0] for key in outcomes}), rows=rows, survivors=survivors)
    return 0


def keep(**found: object) -> None:
    """Replace a part of what was last measured."""
    kept = json.loads(MEASURED.read_text(encoding="utf-8")) | found
    replace_text(MEASURED, json.dumps(kept, indent=1, ensure_ascii=False) + "\n")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
