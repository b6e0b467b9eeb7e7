"""Whether a changed function, table or CasADi function returns what it returned, evaluated at random inputs."""

import random
import re
from contextlib import nullcontext
from fractions import Fraction
from pathlib import Path

import mpmath

from derive.audit.checker import modular
from derive.audit.checker.casadi_functions import casadi, program_of
from derive.audit.checker.machine import Machine, machine
from derive.audit.checker.refusal import UNREADABLE, Rejected
from derive.audit.checker.straight_line import Function, literal_of, numbered, read_body, read_header, read_lanes
from derive.audit.checker.tables import OPERATIONS
from derive.audit.mutations.checks import STATE
from derive.audit.mutations.of_c import functions_of
from derive.audit.mutations.stages import HEADERS, SEED

#: Inputs at which a function and its change are compared, if roots do not exist at the first of them.
COMPARED = 60


def same_tables(old, new, drive) -> bool:
    """Do two tables return the same at random inputs, with any function for the root, or of real numbers?"""
    return _same_residues(old, new, drive) or same_reals(old, new)


def same_reals(old, new) -> bool:
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
    text = numbered(text) if stage == "scalar C" else text
    for name, start, end in functions_of(drive, text):
        body = text[start:end]
        if stage == "lanes":
            name = name.removesuffix("_lanes")
            found[name] = [read_lanes(text, name).definitions]
            continue
        body = re.sub(r"\breturn (-?t_\w+);", r"o[0] = \1;", body)
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
