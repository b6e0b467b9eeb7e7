"""The functions of a header of proofs: middles are those of the drive's own equations, running errors follow the rules.

Their statements are calls on balls and wide numbers; rewritten as sums, products and quotients of what they stand for
they run like any straight-line function.
"""

import re
from collections.abc import Iterator
from fractions import Fraction
from random import Random

from .machine import Machine, machine
from .refusal import require
from .straight_line import Function, Header, body_of, literal_of, read_body
from .tables import PI_FINE, SMALLEST

#: The radius of a constant of two doubles is no larger part of it.
FINEST = Fraction(1, 2**100)

#: A call of the arithmetic, and what it stands for.
CALLS = {
    "add": "{0} + {1}",
    "sub": "{0} - {1}",
    "mul": "{0} * {1}",
    "div": "{0} / {1}",
    "sqr": "{0} * {0}",
    "neg": "-{0}",
    "sqrt": "sqrt({0})",
    "sign": "SIGN({0})",
    "atan2": "atan2({0}, {1})",
}
CALLED = re.compile(
    r"const mw_(?:ball|wide) (\w+) = (?:mwc_of_wide\((?=mwc_wide\())?mwc_(?:wide_)?(\w+)\(([^()]*)\)\)?;"
)
READ = re.compile(
    r"const mw_(?:ball|wide) (\w+) = (?:MWC_(?:SHARED\((?=s)|OWN\((?=t|phi))(\w+), (\d+)\)|(p)\[(\d+)\]);"
)
UNKNOWN = re.compile(r"const mw_ball (\w+) = mwc_make\(x\[(\d+) \* MW_LANES \+ l\], (?:d\[\2\]|0\.0)\);")
TURNED = re.compile(r"const mwc_turn (turn_\w+) = mwc_turned\((?:mwc_make\()?(\w+)(?:, 0\.0\))?\);")
HALVES = re.compile(r"const (?:mw_ball|double) (\w+) = (turn_\w+)\.(sine|cosine)(?:\.mid)?(?:, (\w+) = \2\.cosine)?;")
SINES = re.compile(r"mwc_wide_sincos\((\w+), &(\w+), &(\w+)\);")
KEPT = re.compile(r"MWC_KEEP\((\w+), (\d+), (\w+)\);|mwc_put\((s), (\d+), mwc_of_wide\((\w+)\)\);")
SILENT = re.compile(
    r"\(void\)\w;|MWC_EACH {|}|mw_wide \w+, \w+;|s\[\d+\] = mwc_arithmetic\(\) .*|return s\[\d+\] > 0\.0;|"
)

#: All of a function, and the sizes of a box with which the proof of a contact begins.
WHOLE = re.compile(r"(.*)", re.DOTALL)
SIZES = re.compile(r"for \(int l = 0; l < 1; l\+\+\) {\n(.*)", re.DOTALL)


def plain(text: str, name: str, part: re.Pattern = WHOLE) -> Function:
    """A function of balls, or one part of it, as the straight-line function of their middles."""
    lines, sines, numbers = [], {}, {}
    for line in map(str.strip, part.search(body_of(text, name))[1].splitlines()):
        if found := UNKNOWN.fullmatch(line):
            lines.append(f"const double {found[1]} = x[{found[2]}];")
        elif found := CALLED.fullmatch(line):
            to, call, words = found.groups()
            operands = [numbers.get(word, word) for word in words.split(", ")]
            if call == "magnitude":
                lines.append(f"const double size_{to} = SIGN({words});")
                lines.append(f"const double {to} = {words} * size_{to};")
            elif call in CALLS:
                lines.append(f"const double {to} = {CALLS[call].format(*operands)};")
            else:
                # a multiple of an angle is told by the number beside it
                numbers[to] = constant_of(call, operands)
                lines.append(f"const double {to} = {numbers[to]};")
        elif found := READ.fullmatch(line):
            to, array, place, given, number = found.groups()
            source = "phi" if array == "phi" else f"{array or given}[{place or number}]"
            lines.append(f"const double {to} = {source};")
        elif found := TURNED.fullmatch(line):
            sines[found[1]] = found[2]
        elif found := HALVES.fullmatch(line):
            one, turn, half, other = found.groups()
            require(other and half == "sine" and turn in sines, f"{name}: {line}")
            lines.append(f"double {one}, {other}; X_sincos({sines[turn]}, &{one}, &{other});")
        elif found := SINES.fullmatch(line):
            lines.append(f"double {found[2]}, {found[3]}; X_sincos({found[1]}, &{found[2]}, &{found[3]});")
        elif found := KEPT.fullmatch(line):
            array, place, number = found.groups()[:3] if found[1] else found.groups()[3:]
            lines.append(f"{array}[{place}] = {number};")
        else:
            require(SILENT.fullmatch(line), f"{name}: not a statement that is foreseen: {line}")
    made = Function(name, read_body("\n".join(lines)), {})
    for array in ("R", "J", "s", "t", "sizes"):
        places = [key for key in made.definitions if key.startswith(f"{array}[")]
        require(places == [f"{array}[{k}]" for k in range(len(places))], f"{name}: {array} is not written in a row")
    return made


def constant_of(call: str, words: list[str]) -> str:
    """The number of a constant, which its radius must reach."""
    literal = literal_of(words[0])
    require({"make": 2, "wide": 3}.get(call) == len(words) and literal, f"{call}({', '.join(words)}): not foreseen")
    exact, angle = literal
    *numbers, radius = (Fraction(float(word)) for word in words)
    apart = abs(sum(numbers) - (exact * PI_FINE if angle else exact))
    require(apart <= radius + SMALLEST, f"the constant {words[0]} is not within its radius")
    require(radius <= sum(map(abs, numbers)) * FINEST, f"the radius of {words[0]} is larger than it must be")
    return f"({words[0]})"


def check_enclosed(header: Header, text: str, prefix: str, rng: Random) -> None:
    """State, sizes, residual and Jacobian over a box, from the design on, have the middles of the drive's own."""
    own = machine(header, "eval", rng)
    setup = Machine(own.inputs, plain(text, f"{prefix}_certify_setup"), None, own.circle)
    instant = Machine(own.inputs, plain(text, f"{prefix}_enclose_instant"), setup, own.circle)
    found = Machine(own.inputs, plain(text, f"{prefix}_enclose"), instant, own.circle)
    written = [(setup, f"s[{k}]") for k in range(number_of(setup, "s"))]
    written += [(instant, f"t[{k}]") for k in range(number_of(instant, "t"))]
    for k, (of, key) in enumerate(written):
        require(of.value(key).value == own.value(f"s[{k}]").value, f"certify: {key} is not that of the drive's state")
    scale = Machine(own.inputs, header.functions["scale"], own.earlier, own.circle)
    sizes = Machine(own.inputs, plain(text, f"{prefix}_certify", SIZES), instant, own.circle)
    require(number_of(sizes, "sizes") == number_of(scale, "new x"), "certify: other sizes than the drive's")
    for k in range(number_of(scale, "new x")):
        same = sizes.value(f"sizes[{k}]").value == scale.value(f"new x[{k}]").value
        require(same, f"certify: another size of x[{k}]")
    for key in own.function.definitions:
        if key[:2] in ("R[", "J["):
            require(key in found.function.definitions, f"enclose: no {key}")
            require(found.value(key).value == own.value(key).value, f"enclose: {key} is not that of the equations")


def number_of(of: Machine, letter: str) -> int:
    """How many numbers a function writes to an array."""
    return sum(key.startswith(f"{letter}[") for key in of.function.definitions)


MIDDLE = re.compile(r"const double m_(\w+) = (.+);")
RADIUS = re.compile(r"const double r_(\w+) = (.+);")
ROW = re.compile(r"MWC_KEEP_AT\(R, rows\[(\d+)\], m_(\w+), r_\2\);")
ENTRY = re.compile(r"J\[\(rows\[(\d+)\] \* (\d+) \+ (\d+)\) \* MW_LANES \+ l\] = m_(\w+);")
LOOKED_AT = re.compile(r"G\[(\d+) \* MW_LANES \+ l\] = (.*);")
BALL = r"mwc_units_ball\(m_(\w+), (r_\w+|0\.0)\)"
NEAR = re.compile(rf"const mw_ball near_m_(\w+) = mwc_atan2\({BALL}, {BALL}\);")


class Point:
    """The equations at one point with running errors: each middle, and the error that it must have."""

    def __init__(self, text: str, prefix: str):
        self.name = f"{prefix}_enclose_point"
        self.middles: dict[str, str] = {}
        self.radii: dict[str, str] = {}
        self.turns: dict[str, str] = {}
        self.arcs: dict[str, tuple[str, ...]] = {}
        self.results: dict[str, str] = {}
        self.looked_at: list[tuple[str, str]] = []
        for line in map(str.strip, body_of(text, self.name).splitlines()):
            self._read(line)
        for name, middle in self.middles.items():
            allowed = self._errors(name, middle)
            if name in self.radii:
                words = f"{self.name}: the error of {name} = {middle} is {self.radii[name]}, not {allowed}"
                require(self.radii[name] in allowed, words)
        for y, ry, x, rx in self.arcs.values():
            require((ry, rx) == (self.error(y), self.error(x)), f"{self.name}: an arc of {y}, {x} with other errors")
        expected = [(str(k), text) for k, text in enumerate(self._guards())]
        require(self.looked_at == expected, f"{self.name}: what is looked at is not what may vanish, in its order")
        for key, name in self.results.items():
            require(key[0] == "J" or name in self.radii or self.exact(name), f"{self.name}: {key} has no error")

    def _read(self, line: str) -> None:
        if found := MIDDLE.fullmatch(line):
            require(found[1] not in self.middles, f"{self.name}: m_{found[1]} is defined twice")
            self.middles[found[1]] = found[2]
        elif found := RADIUS.fullmatch(line):
            self.radii[found[1]] = found[2]
        elif found := TURNED.fullmatch(line):
            self.turns[found[1]] = found[2].removeprefix("m_")
        elif found := NEAR.fullmatch(line):
            self.arcs[found[1]] = found.groups()[1:]
        elif found := ROW.fullmatch(line):
            self.results[f"R[{found[1]}]"] = found[2]
        elif found := ENTRY.fullmatch(line):
            self.results[f"J[{int(found[1]) * int(found[2]) + int(found[3])}]"] = found[4]
        elif found := LOOKED_AT.fullmatch(line):
            self.looked_at.append(found.groups())
        else:
            require(SILENT.fullmatch(line), f"{self.name}: not foreseen: {line}")

    def _guards(self) -> Iterator[str]:
        """What may vanish, jump or be divided, operation by operation: see runtime/c/certify/domain.h."""
        quotients = {name for name, middle in self.middles.items() if " / " in middle}
        for name, middle in self.middles.items():
            if found := re.fullmatch(r"m_(\w+) / m_(\w+)", middle):
                yield from (f"mwc_abs(m_{found[2]})", f"-mwc_abs(m_{found[1]})")
            elif found := re.fullmatch(r"m_(\w+) \* m_(?!\1\b)(\w+)", middle):
                if quotients & set(found.groups()):
                    yield f"-mwc_abs(m_{found[2 if found[1] in quotients else 1]})"
            elif found := re.fullmatch(r"sqrt\((m_\w+)\)", middle):
                yield found[1]
            elif found := re.fullmatch(r"mwc_units_sign\((m_\w+)\)", middle):
                yield f"mwc_abs({found[1]})"
            elif name in self.arcs:
                y, _, x, _ = self.arcs[name]
                yield f"mwc_uncut(m_{y}, m_{x})"

    def exact(self, name: str) -> bool:
        """Is a middle the number itself? An unknown, a sign, a number that a double is, and less such a one."""
        middle = self.middles[name]
        if found := re.fullmatch(r"-m_(\w+)", middle):
            return self.exact(found[1])
        literal = literal_of(middle)
        held = literal and literal[1] is None and literal[0] == Fraction(float(middle))
        return bool(held or re.fullmatch(r"x\[\d+ \* MW_LANES \+ l\]|mwc_units_sign\(m_\w+\)", middle))

    def error(self, name: str) -> str:
        return "0.0" if self.exact(name) else f"r_{name}"

    def _errors(self, name: str, middle: str) -> list[str]:
        """What may be the error of a middle, after the rule of its operation."""
        if found := re.fullmatch(r"s\[(\d+)\]", middle):
            return [f"s[{int(found[1]) + 1}]"]
        if found := re.fullmatch(r"\((MWC_OWN\(t, \d+\))\)\.mid", middle):
            return [f"MWC_UNITS * ({found[1]}).radius"]
        if found := re.fullmatch(r"(turn_\w+)\.(sine|cosine)\.mid", middle):
            turn, of = found.groups()
            angle = self.turns[turn]
            size = f"mwc_units_size(m_{angle}, {turn}.sine.mid)" if of == "sine" else "1.0"
            slope = "cosine" if of == "sine" else "sine"
            return [f"mwc_units_turned({self.error(angle)}, {turn}.{slope}.mid, {size})"]
        if middle.startswith("near_m_"):
            return [f"MWC_UNITS * {middle.removesuffix('.mid')}.radius"]
        if self.exact(name):
            return []
        if found := re.fullmatch(r"-m_(\w+)", middle):
            return [f"r_{found[1]}"]
        if found := re.fullmatch(r"sqrt\(m_(\w+)\)", middle):
            return [f"mwc_units_root({self.error(found[1])}, m_{name})"]
        found = re.fullmatch(r"m_(\w+) ([-+*/]) m_(\w+)", middle)
        require(found, f"{self.name}: {middle} has no rule")
        return self._of_two(name, *found.groups())

    def _of_two(self, name: str, a: str, operation: str, b: str) -> list[str]:
        exact = [c for c in (a, b) if self.exact(c)]
        if operation == "/":
            return [f"mwc_units_quotient({self.error(a)}, m_{b}, {self.error(b)}, m_{name})"]
        if operation in "+-":
            if len(exact) == 2:
                return [f"mwc_abs(m_{name})"]
            other = b if a in exact else a
            return [f"r_{other} + mwc_abs(m_{name})" if exact else f"mwc_units_sum(r_{a}, r_{b}, m_{name})"]
        if len(exact) == 2:
            return [f"mwc_units_rounded(m_{name})"]
        if exact:
            c, other = (a, b) if a in exact else (b, a)
            return [f"mwc_units_share(m_{c}, r_{other}, m_{name})"]
        if a == b:
            return [f"mwc_units_square(m_{a}, r_{a}, m_{name})"]
        rules = []
        for c, d in ((a, b), (b, a)):
            rules.append(f"mwc_units_product(m_{c}, r_{c}, m_{d}, r_{d}, m_{name})")
            if found := re.fullmatch(r"s\[(\d+)\]", self.middles[d]):
                rules.append(f"mwc_units_scaled(m_{c}, r_{c}, s[{int(found[1]) + 2}], r_{d}, m_{name})")
        return rules

    def function(self) -> Function:
        """The middles as a straight-line function; number k of the state is written three times as wide."""
        lines = []
        for turn, angle in self.turns.items():
            halves = {
                of: name for name, m in self.middles.items() for of in ("sine", "cosine") if m == f"{turn}.{of}.mid"
            }
            one, other = halves.get("sine", f"no_{turn}"), halves.get("cosine", f"none_{turn}")
            lines.append(f"double m_{one}, m_{other}; X_sincos(m_{angle}, &m_{one}, &m_{other});")
        numbers = {name: f"({middle})" for name, middle in self.middles.items() if literal_of(middle)}
        for name, middle in self.middles.items():
            if middle.startswith("turn_"):
                continue
            if found := re.fullmatch(r"s\[(\d+)\]", middle):
                require(int(found[1]) % 3 == 0, f"{self.name}: {middle} is no middle")
                middle = f"s[{int(found[1]) // 3}]"
            elif middle.startswith("near_m_"):
                y, _, x, _ = self.arcs[middle.removeprefix("near_m_").removesuffix(".mid")]
                middle = f"atan2(m_{y}, m_{x})"
            else:
                middle = re.sub(r"mwc_units_sign", "SIGN", middle)
                middle = re.sub(r"\bm_(\w+)", lambda found: numbers.get(found[1], found[0]), middle)
                middle = re.sub(r"(\w)\[(\d+) \* MW_LANES \+ l\]", r"\1[\2]", middle)
                middle = re.sub(r"\(MWC_OWN\(t, (\d+)\)\)\.mid", r"t[\1]", middle)
            lines.append(f"const double m_{name} = {middle};")
        lines += [f"{key} = m_{name};" for key, name in self.results.items()]
        return Function(self.name, read_body("\n".join(lines)), {})


def check_point(header: Header, text: str, prefix: str, rng: Random) -> None:
    """The equations at a point have the middles of the drive's own, each error the rule of its operation."""
    own, point = machine(header, "eval", rng), Point(text, prefix)
    setup = Machine(own.inputs, plain(text, f"{prefix}_certify_setup"), None, own.circle)
    instant = Machine(own.inputs, plain(text, f"{prefix}_enclose_instant"), setup, own.circle)
    found = Machine(own.inputs, point.function(), instant, own.circle)
    for key in own.function.definitions:
        if key[:2] in ("R[", "J["):
            require(key in point.results, f"{point.name}: no {key}")
            require(found.value(key).value == own.value(key).value, f"{point.name}: {key} is not that of the equations")
