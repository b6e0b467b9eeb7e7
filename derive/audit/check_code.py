#!/usr/bin/env python3
"""Check the generated C itself against calculus: `python check_code.py [folder]`, exit status 0 if everything holds.

The functions of a generated header are straight-line programs. They are read as text and run modulo a prime of 61 bits
drawn at random, with random parameters, a random point of the circle for every independent angle, and dual numbers
along every unknown.
Then, for every drive:

  jacobian   J is the derivative of R, entry by entry
  tangents   each tangent of a flank is the derivative of its point
  normal     the normal of a flank has length one and is perpendicular to every tangent: an explicit wheel flank is
             therefore an envelope, its equation of meshing solved. Where one equation of meshing is left implicit the
             normal meets the tangent along the motion, and there alone, and the recorded slopes are the derivatives of
             that equation
  assembly   the first three residuals are the vector between the two points in the fixed frame, turned or not
  agreement  a flank has the point, the singular function and the limits that the observation of a contact has there

A wrong program passes with a probability of about degree / 2^61. Needs check.py beside it and nothing else.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path
from random import Random, SystemRandom
from types import ModuleType

#: check.py from this file's own folder, wherever the two are copied, without leaving compiled files there.
CHECK = ModuleType("meshwright_check")
exec(compile(Path(__file__).with_name("check.py").read_text(encoding="utf-8"), "check.py", "exec"), CHECK.__dict__)
Rejected, require = CHECK.Rejected, CHECK.require
#: Drawn anew in every run; 3 modulo 4, so that the root of a square can be had by a power.
PRIME = CHECK.random_prime(SystemRandom())

#: Inputs that may be drawn until every radicand is a square, and inputs at which a check may fail before it is over.
ATTEMPTS = 20000
REFUSALS = 24
#: Angles are whole multiples of a quarter of each independent angle.
QUARTER = 4
LITERALS = {"3.141592653589793": Fraction(1), "1.5707963267948966": Fraction(1, 2)}


class NoRoot(Exception):
    """A radicand is no square at these inputs; others have to be drawn."""


# ---- numbers: value and rates modulo PRIME, and the angle the number stands for --------------------------------------


@dataclass(frozen=True)
class Number:
    """A value with its rates along the directions, and its linear form in independent angles (None: it is its own)."""

    value: int
    rates: tuple[int, ...] = ()
    angle: dict | None = None

    @property
    def form(self) -> dict:
        return {self.value: Fraction(1)} if self.angle is None else self.angle


def combined(a: tuple[int, ...], x: int, b: tuple[int, ...], y: int) -> tuple[int, ...]:
    """x*a + y*b for rates of equal length or none."""
    if not b:
        return tuple(p * x % PRIME for p in a)
    if not a:
        return tuple(q * y % PRIME for q in b)
    return tuple((p * x + q * y) % PRIME for p, q in zip(a, b, strict=True))


def add(a: Number, b: Number, sign: int = 1) -> Number:
    angle = None
    if a.angle is not None or b.angle is not None:
        total = dict(a.form)
        for name, factor in b.form.items():
            total[name] = total.get(name, 0) + sign * factor
        angle = {name: factor for name, factor in total.items() if factor}
    return Number((a.value + sign * b.value) % PRIME, combined(a.rates, 1, b.rates, sign), angle)


def multiply(a: Number, b: Number) -> Number:
    return Number(a.value * b.value % PRIME, combined(a.rates, b.value, b.rates, a.value))


def divide(a: Number, b: Number) -> Number:
    require(b.value, "a division by zero")
    inverse = pow(b.value, -1, PRIME)
    value = a.value * inverse % PRIME
    return Number(value, combined(a.rates, inverse, b.rates, -value * inverse))


def square_root(value: int) -> int:
    root_of_value = pow(value, (PRIME + 1) // 4, PRIME)
    if not root_of_value or (root_of_value**2 - value) % PRIME:
        raise NoRoot
    return root_of_value


def halved(cosine: int, sine: int) -> tuple[int, int]:
    """Cosine and sine of half the angle."""
    half = square_root((1 + cosine) * pow(2, -1, PRIME) % PRIME)
    return half, sine * pow(2 * half, -1, PRIME) % PRIME


def root(a: Number) -> Number:
    value = square_root(a.value)
    return Number(value, combined(a.rates, pow(2 * value, -1, PRIME), (), 0))


def sign(a: Number) -> Number:
    """1 for squares, else -1, which is as odd and as constant as the sign of a real number."""
    return Number(1 if pow(a.value, (PRIME - 1) // 2, PRIME) in (0, 1) else PRIME - 1)


def scaled(a: Number, literal: Fraction, product: Number) -> Number:
    """A product with a literal keeps its linear form if there is one."""
    angle = None if a.angle is None else {name: factor * literal for name, factor in a.angle.items() if literal}
    return Number(product.value, product.rates, angle)


# ---- programs --------------------------------------------------------------------------------------------------------

STATEMENT = re.compile(r"const double (t\d+) = (.+);|(\w+\[\d+\]) = (.+);|\w+_sincos\((.+), &(s\d+), &(c\d+)\);")
SILENT = re.compile(r"\(void\)|double s\d+, c\d+;|if \(|int failed|return |[{}]|$")
OPERAND = r"\(?-?[\w.\[\]]+(?:e[+-]?\d+)?\)?"
BINARY = re.compile(rf"({OPERAND}) ([-+*/]) ({OPERAND})")
CALL = re.compile(r"(?:\w+_)?(sqrt|atan2|SIGN)\((.+)\)")

#: A product and a number: a b + c, a b - c, c - a b.
FUSED = re.compile(rf"MW_(FMA|FMS|FNMA)\(({OPERAND}), ({OPERAND}), ({OPERAND})\)")


@dataclass(frozen=True)
class Function:
    """A straight-line function.

    Name -> ("expression", text) or ("sin" | "cos", text of the angle), and its table of outputs.
    """

    name: str
    definitions: dict[str, tuple[str, str]]
    outputs: dict[str, tuple[int, int]]

    def size_of(self, letter: str) -> int:
        """How many entries of an argument it reads."""
        text = " ".join(text for _, text in self.definitions.values())
        return 1 + max(map(int, re.findall(rf"\b{letter}\[(\d+)\]", text)), default=-1)


@dataclass(frozen=True)
class Header:
    """A generated header: its functions by their names without the prefix, and what they take."""

    functions: dict[str, Function]
    parameters: int
    frames: tuple[tuple[str, ...], ...]
    sizes: dict[str, int]
    unknowns: dict[str, tuple[int, ...]]


def read_header(text: str) -> Header:
    """The straight-line functions of a header."""
    prefix = re.search(r"static inline int (\w+)_setup\(", text)[1]
    wanted = rf"{prefix}_(setup|set_phi|eval|observe|(?:flank|fillet)_\w+)"
    found = {}
    pattern = rf"((?:/\*(?:[^*]|\*(?!/))*\*/\s)*)static inline \w+ {wanted}\([^)]*\)\n{{\n(.*?)\n}}"
    for match in re.finditer(pattern, text, re.DOTALL):
        table = {
            name: (int(at), int(size or 1))
            for at, name, size in re.findall(r"^ \* +(\d+) (\w+)(?:\[(\d+)\])?", match[1], re.M)
        }
        found[match[2]] = Function(match[2], read_body(match[3]), table)
    sizes = {
        name: function.size_of("q" if name.startswith(("flank_", "fillet_")) else "x")
        for name, function in found.items()
    }
    unknowns = {
        body: tuple(map(int, places.split(",")))
        for body, places in re.findall(rf"int {prefix}_(\w+)_unknowns\[\] = {{ ([\d, ]+) }}", text)
    }
    return Header(found, max(function.size_of("p") for function in found.values()), read_frames(text), sizes, unknowns)


def read_frames(text: str) -> tuple[tuple[str, ...], ...]:
    """Parameters that are the components of three axes: `..._axis_x_x` to `..._axis_z_z` in the table of parameters."""
    table = re.search(r"_parameter_names\[\] = {\n(.*?)\n};", text, re.DOTALL)[1]
    keys = [re.findall(r'"([^"]*)"', line)[3] for line in table.splitlines()]
    stems = sorted({key[: -len("_axis_x_x")] for key in keys if key.endswith("_axis_x_x")})
    return tuple(
        tuple(f"p[{keys.index(f'{stem}_axis_{axis}_{part}')}]" for axis in "xyz" for part in "xyz") for stem in stems
    )


def read_body(body: str) -> dict[str, tuple[str, str]]:
    definitions: dict[str, tuple[str, str]] = {}
    for line in without_blocks(body):
        statement = STATEMENT.fullmatch(line)
        if statement is None:
            require(SILENT.match(line), f"not a straight-line statement: {line}")
        elif statement[5]:
            definitions[statement[6]], definitions[statement[7]] = ("sin", statement[5]), ("cos", statement[5])
        else:
            definitions[statement[1] or statement[3]] = ("expression", statement[2] or statement[4])
    return definitions


def without_blocks(body: str) -> Iterator[str]:
    """The lines outside inner braces, which hold the guards of the design."""
    depth = 0
    for line in map(str.strip, body.splitlines()):
        depth += line.count("{")
        if not depth:
            yield line
        depth -= line.count("}")


@dataclass
class Machine:
    """Runs functions at one random input. Values are computed when asked for."""

    inputs: dict[str, Number]
    function: Function
    earlier: Machine | None
    circle: Callable[[object], tuple[int, int]]
    known: dict[str, Number] = field(default_factory=dict)

    def value(self, text: str) -> Number:
        if text not in self.known:
            self.known[text] = self._compute(text)
        return self.known[text]

    def _compute(self, text: str) -> Number:
        name = text.strip("()")
        if name in self.inputs:
            return self.inputs[name]
        if name in self.function.definitions:
            kind, expression = self.function.definitions[name]
            return self._expression(expression) if kind == "expression" else self._turn(expression)[kind == "sin"]
        if re.fullmatch(r"-?[\d.]+(e[+-]?\d+)?", name):
            return self._literal(name)
        require(self.earlier is not None, f"{name} has no value")
        return self.earlier.value(name)

    @staticmethod
    def _literal(text: str) -> Number:
        exact = Fraction(text)
        angle = {"pi": LITERALS[text]} if text in LITERALS else None
        return Number(exact.numerator * pow(exact.denominator, -1, PRIME) % PRIME, (), angle)

    def _expression(self, text: str) -> Number:
        if match := CALL.fullmatch(text):
            arguments = [self.value(argument) for argument in match[2].split(", ")]
            return {"sqrt": root, "SIGN": sign, "atan2": self._arc}[match[1]](*arguments)
        if match := FUSED.fullmatch(text):
            product, number = self._product(match[2], match[3]), self.value(match[4])
            if match[1] == "FNMA":
                return add(number, product, -1)
            return add(product, number, 1 if match[1] == "FMA" else -1)
        if match := BINARY.fullmatch(text):
            return self._binary(match[1], match[2], match[3])
        if text.startswith("-") and text[1:] in self.function.definitions | self.inputs:
            return add(Number(0, (), {}), self.value(text[1:]), -1)
        return self.value(text)

    def _product(self, left: str, right: str) -> Number:
        a, b = self.value(left), self.value(right)
        product = multiply(a, b)
        for number, other in ((a, right), (b, left)):
            literal = other.strip("()")
            if number.angle is not None and re.fullmatch(r"-?[\d.]+", literal):
                return scaled(number, Fraction(literal), product)
        return product

    def _binary(self, left: str, operator: str, right: str) -> Number:
        if operator == "*":
            return self._product(left, right)
        a, b = self.value(left), self.value(right)
        match operator:
            case "+":
                return add(a, b)
            case "-":
                return add(a, b, -1)
        return divide(a, b)

    def _arc(self, y: Number, x: Number) -> Number:
        square = (x.value * x.value + y.value * y.value) % PRIME
        require(square, "an arc of nothing")
        inverse = pow(square, -1, PRIME)
        name = ("arc", y.value, x.value)
        rates = combined(y.rates, x.value * inverse, x.rates, -y.value * inverse)
        return Number(hash(name) % PRIME, rates, {name: Fraction(1)})

    def _turn(self, text: str) -> tuple[Number, Number]:
        """Cosine and sine of an argument, by complex multiplication over the independent angles."""
        argument = self.value(text)
        cosine, sine = 1, 0
        for name, factor in argument.form.items():
            times = QUARTER * factor
            require(times.denominator == 1, f"an angle is a fraction of {name} that is not foreseen")
            c, s = (0, 1) if name == "pi" else self.circle(name)
            times = int(2 * factor) if name == "pi" else int(times)
            s = s if times > 0 else -s
            for _ in range(abs(times)):
                cosine, sine = (cosine * c - sine * s) % PRIME, (sine * c + cosine * s) % PRIME
        return Number(cosine, combined(argument.rates, -sine, (), 0)), Number(
            sine, combined(argument.rates, cosine, (), 0)
        )


class Circle:
    """A point of the circle modulo PRIME for a quarter of each independent angle.

    Random; with `arcs` the angle atan2(y, x) has the cosine and sine of its sides, which only the normal's identities
    need.
    """

    def __init__(self, rng: Random, arcs: bool):
        self.rng, self.arcs, self.points = rng, arcs, {}

    def __call__(self, name: object) -> tuple[int, int]:
        if self.arcs and isinstance(name, tuple) and name not in self.points:
            _, y, x = name
            length = square_root(x * x + y * y)
            scale = pow(length, -1, PRIME)
            self.points[name] = halved(*halved(x * scale % PRIME, y * scale % PRIME))
        if name not in self.points:
            t = self.rng.randrange(2, PRIME)
            below = pow(1 + t * t, -1, PRIME)
            self.points[name] = (1 - t * t) * below % PRIME, 2 * t * below % PRIME
        return self.points[name]


# ---- checks ----------------------------------------------------------------------------------------------------------


def machine(header: Header, name: str, rng: Random, arcs: bool = False) -> Machine:
    """A function at random inputs, after setup and set_phi at random parameters. The flank sign p[0] is +1 or -1."""
    circle = Circle(rng, arcs)

    def drawn(key: str, rates: tuple[int, ...] = ()) -> Number:
        return Number(rng.randrange(1, PRIME), rates, {key: Fraction(1)})

    inputs = {key: drawn(key) for key in (f"p[{k}]" for k in range(header.parameters))}
    inputs |= {"p[0]": Number(rng.choice((1, PRIME - 1))), "phi": drawn("phi")}
    inputs |= {key: Number(value) for key, value in axes(header.frames, circle).items()}
    setup = Machine(inputs, header.functions["setup"], None, circle)
    instant = Machine(inputs, header.functions["set_phi"], setup, circle)
    letter, size = ("q" if name.startswith(("flank_", "fillet_")) else "x"), header.sizes[name]
    own = {f"{letter}[{k}]": drawn(f"{letter}[{k}]", tuple(int(j == k) for j in range(size))) for k in range(size)}
    return Machine(inputs | own, header.functions[name], instant, circle)


def axes(frames: tuple[tuple[str, ...], ...], circle: Circle) -> dict[str, int]:
    """Parameters that are the axes of a placed frame: the columns of a random rotation."""
    values: dict[str, int] = {}
    for frame in frames:
        (a, b), (c, s), (e, f) = (circle(f"axis {k} of {frame[0]}") for k in range(3))
        columns = (
            (c * e, b * s * e + a * f, -a * s * e + b * f),
            (-c * f, a * e - b * s * f, a * s * f + b * e),
            (s, -b * c, a * c),
        )
        values |= dict(zip(frame, (entry % PRIME for column in columns for entry in column), strict=True))
    return values


def check_jacobian(header: Header, rng: Random) -> None:
    run = machine(header, "eval", rng)
    rows = sum(name.startswith("R[") for name in run.function.definitions)
    columns = sum(name.startswith("J[") for name in run.function.definitions) // rows
    for i in range(rows):
        residual = run.value(f"R[{i}]")
        rates = residual.rates + (0,) * (columns - len(residual.rates)) if residual.rates else (0,) * columns
        for j in range(columns):
            require(
                run.value(f"J[{i * columns + j}]").value == rates[j] % PRIME,
                f"eval: J[{i}][{j}] is not the derivative of R[{i}]",
            )


def check_assembly(header: Header, rng: Random) -> None:
    """Residual and observation at one input.

    R[0..2] is the difference of the two points, in whatever frame it was formed.
    """
    run = machine(header, "observe", rng)
    other = Machine(run.inputs, header.functions["eval"], run.earlier, run.circle)
    places = [run.function.outputs[f"point_{body}_f"][0] for body in ("pinion", "wheel")]
    first, second = ([run.value(f"o[{at + k}]").value for k in range(3)] for at in places)
    distance = sum((a - b) ** 2 for a, b in zip(first, second, strict=True))
    require(
        (distance - sum(other.value(f"R[{k}]").value ** 2 for k in range(3))) % PRIME == 0,
        "eval: R[0..2] is not the distance of the two points",
    )


def check_agreement(header: Header, body: str, rng: Random) -> None:
    """Flank and observation at one input: what both give in the body's frame is the same."""
    seen = machine(header, "observe", rng)
    own = {f"q[{k}]": seen.inputs[f"x[{place}]"] for k, place in enumerate(header.unknowns[body])}
    flank = Machine(seen.inputs | own, header.functions[f"flank_{body}"], seen.earlier, seen.circle)
    for key, (at, size) in flank.function.outputs.items():
        first, _, rest = key.partition("_")
        if first in ("point", "regular", "margin"):
            there, _ = seen.function.outputs[f"{first}_{body}" + (f"_{rest}" if rest else "")]
            for k in range(size):
                require(
                    flank.value(f"o[{at + k}]").value == seen.value(f"o[{there + k}]").value,
                    f"flank_{body}: {key} is not that of the observation",
                )


def check_flank(header: Header, name: str, rng: Random) -> None:
    run = machine(header, name, rng, arcs=True)
    outputs = run.function.outputs

    def vector(key: str) -> list[Number]:
        at, size = outputs[key]
        return [run.value(f"o[{at + k}]") for k in range(size)]

    tangents = [key for key in outputs if key.startswith("tangent_")]
    point, normal = vector("point"), vector("normal")
    require(sum(n.value * n.value for n in normal) % PRIME == 1, f"{name}: the normal has not length one")
    meets = []
    for position, key in enumerate(tangents):
        tangent = vector(key)
        for k in range(3):
            rate = point[k].rates[position] if len(point[k].rates) > position else 0
            require(tangent[k].value == rate % PRIME, f"{name}: {key} is not the derivative of the point")
        if sum(n.value * t.value for n, t in zip(normal, tangent, strict=True)) % PRIME:
            meets.append(key)
    implicit = [key for key in outputs if re.fullmatch(r"condition_\d+", key)]
    require(len(meets) == len(implicit), f"{name}: the normal is not perpendicular to {', '.join(meets)}")
    for key in implicit:
        (condition,) = vector(key)
        slopes = [number.value for number in vector(f"{key}_slopes")]
        require(
            slopes == [rate % PRIME for rate in condition.rates], f"{name}: the slopes of {key} are not its derivatives"
        )


def attempt(check: Callable[..., None], *arguments: object) -> None:
    """Repeat a check with new inputs until every radicand is a square and every root has the sign that its real value
    has.

    Modulo a prime, sqrt(x*y*y) is y*sqrt(x) only up to sign, so a right program passes at a share of all inputs. A
    wrong one passes at none: one input at which everything holds is enough.
    """
    rng = SystemRandom()
    refusals: list[Rejected] = []
    for _ in range(ATTEMPTS):
        try:
            return check(*arguments, rng)
        except NoRoot:
            continue
        except Rejected as reason:
            refusals.append(reason)
            if len(refusals) == REFUSALS:
                break
    raise refusals[-1] if refusals else Rejected("no input was found at which every root exists")


def checks_of(header: Header) -> Iterator[tuple[str, tuple]]:
    """What is checked of a header: words, and the check with its arguments."""
    yield "jacobian of the residual", (check_jacobian, header)
    yield "assembly of the two points", (check_assembly, header)
    for name in header.functions:
        if name.startswith(("flank_", "fillet_")):
            yield f"tangents and normal of {name}", (check_flank, header, name)
    for body in header.unknowns:
        yield f"agreement of flank and observation of the {body}", (check_agreement, header, body)


def check_header(path: Path) -> int:
    """All checks of one header; how many were made."""
    try:
        checks = list(checks_of(read_header(path.read_text(encoding="utf-8"))))
        for _, check in checks:
            attempt(*check)
    except (Rejected, LookupError, ValueError) as error:
        raise Rejected(f"{path.name}: {error}") from error
    return len(checks)


def verify(folder: Path) -> tuple[int, int]:
    """Headers and checks; Rejected if one fails."""
    headers = [
        path for path in sorted((folder.parent / "c").glob("*.h")) if "_setup(" in path.read_text(encoding="utf-8")
    ]
    return len(headers), sum(map(check_header, headers))


def main(arguments: list[str]) -> int:
    try:
        headers, checks = verify(Path(arguments[0] if arguments else Path(__file__).parent))
    except Rejected as reason:
        print(f"REJECTED: {reason}", file=sys.stderr)
        return 1
    print(f"{checks} checks of {headers} generated headers hold: J = dR/dx, tangents, normals, assembly, agreement")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
