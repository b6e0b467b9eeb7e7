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
  step       the fused Newton step solves J dx = -R
  along      first and second derivatives of the residual along a path of unknowns and input angle
  start      the Jacobian of the start system
  curvature  basis, second form and principal curvatures follow from the normal's derivatives
  lanes      each of two instances is computed as the scalar setup, set_phi and step compute it, guards included
  tangent    changes of the residual and of the contact point along changes of parameters, angle and unknowns
  sine       polynomials and reduction of the sine and cosine kernel, against enclosures
  atan2      its polynomial against the series of the arc, octants and quadrants
  agreement  a flank has the point, the singular function and the limits that the observation of a contact has there

A wrong program passes with a probability of about degree / 2^61. Needs check.py beside it and nothing else.
"""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cache
from itertools import repeat
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
#: A quarter of an angle met before, times up to this, is recognised.
MULTIPLES = 16
#: What the circle's number is modulo the prime, and the largest divisor of the multiples that decimals stand for.
PI = SystemRandom().randrange(1, PRIME)
DIVISOR = 720
#: Which odd function stands for the sign.
SALT = SystemRandom().randrange(1, PRIME)
PI_ENCLOSED = CHECK.number_of("pi").middle


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
        if self.angle is not None:
            return self.angle
        return {self.value: Fraction(1)} if self.value else {}


def combined(a: tuple[int, ...], x: int, b: tuple[int, ...], y: int) -> tuple[int, ...]:
    """x*a + y*b for rates of equal length or none."""
    if not b:
        return tuple(p * x % PRIME for p in a)
    if not a:
        return tuple(q * y % PRIME for q in b)
    return tuple((p * x + q * y) % PRIME for p, q in zip(a, b, strict=True))


def add(a: Number, b: Number, sign: int = 1) -> Number:
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
    """An odd function that is constant; nothing else is asked of the sign, so that no branch stands for the others.

    Where its square has to be 1, or a root of a square it, SALT is 0: 1 for squares, else -1.
    """
    residue = pow(a.value, (PRIME - 1) // 2, PRIME)
    if not residue or not SALT:
        return Number(residue if residue else 1)
    return Number(residue * hash((SALT, a.value * a.value % PRIME)) % PRIME)


@contextmanager
def real_signs() -> Iterator[None]:
    """Signs whose squares are 1, and that are those of roots of squares."""
    kept, globals()["SALT"] = SALT, 0
    try:
        yield
    finally:
        globals()["SALT"] = kept


def scaled(a: Number, literal: Fraction, product: Number) -> Number:
    """A product with a literal keeps its linear form if there is one."""
    angle = None if a.angle is None else {name: factor * literal for name, factor in a.angle.items() if literal}
    return Number(product.value, product.rates, angle)


# ---- programs --------------------------------------------------------------------------------------------------------

STATEMENT = re.compile(r"const double (t\d+m?) = (.+);|(\w+\[\d+\]) = (.+);|\w+_sincos\((.+), &(s\d+m?), &(c\d+m?)\);")
SILENT = re.compile(r"\(void\)|double s\d+m?, c\d+m?;|if \(|int failed|return |[{}]|$")
OPERAND = r"\(?-?[\w.\[\]]+(?:e[+-]?\d+)?\)?"
BINARY = re.compile(rf"({OPERAND}) ([-+*/]) ({OPERAND})")
CALL = re.compile(r"(?:\w+_)?(sqrt|atan2|SIGN)\((.+)\)")

#: Lines of the lanes that hold no value of an instance: loops, guards and sizes of steps.
LANE_SILENT = re.compile(r"MW_LANE_(LOOP|PAIRS)|const int m = |(valid|size)\[[lm]\] = |}$")

#: A result that is no number where a value that it rests on does not exist.
TESTED = re.compile(r"\(.+\) \? (\S+) : NAN")

#: A product and a number: a b + c, a b - c, c - a b.
FUSED = re.compile(rf"MW_(FMA|FMS|FNMA)\(({OPERAND}), ({OPERAND}), ({OPERAND})\)")


@cache
def parsed(text: str) -> tuple[str, ...]:
    """A right-hand side: its operation and operands."""
    if match := TESTED.fullmatch(text):
        return ("value", match[1])
    if match := CALL.fullmatch(text):
        return (match[1], *match[2].split(", "))
    if match := FUSED.fullmatch(text):
        return match.groups()
    if match := BINARY.fullmatch(text):
        return (match[2], match[1], match[3])
    return ("value", text)


@cache
def literal_of(text: str) -> tuple[Fraction, dict | None] | None:
    """A decimal; one of all digits stands for the nearest simple multiple of pi, fraction or short decimal that it is a
    double of.
    """
    if not re.fullmatch(r"-?[\d.]+(e[+-]?\d+)?", text):
        return None
    exact = Fraction(text)
    if len(re.sub(r"e.*|\D", "", text)) >= 15:
        times = Fraction(float(exact) / math.pi).limit_denominator(DIVISOR)
        near = exact.limit_denominator(DIVISOR)
        if times and abs(float(times * PI_ENCLOSED) - float(exact)) <= math.ulp(float(exact)):
            return times, {"pi": times}
        short = Fraction(f"{float(exact):.6g}")
        if float(near) == float(exact):
            exact = near
        elif abs(float(short) - float(exact)) <= math.ulp(float(exact)):
            exact = short
    return exact, None


@dataclass(frozen=True)
class Function:
    """A straight-line function.

    Name -> ("expression", text) or ("sin" | "cos", text of the angle), and its table of outputs.
    """

    name: str
    definitions: dict[str, tuple[str, str]]
    outputs: dict[str, tuple[int, int]]

    @property
    def implicit(self) -> bool:
        """Does an equation of meshing stay beside the surface?"""
        return any(key.startswith("condition_") for key in self.outputs)

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
    guards: tuple[Function, dict[int, str]]
    lanes: str = ""
    tangents: str = ""


def read_header(text: str, lanes: str = "", tangents: str = "") -> Header:
    """The straight-line functions of a header, with the texts of its lanes and of its tangents."""
    prefix = re.search(r"static inline int (\w+)_setup\(", text)[1]
    wanted = rf"{prefix}_(setup|set_phi|eval|step|along|start_eval|observe|(?:curvature_)?(?:flank|fillet)_\w+)"
    found = {}
    pattern = rf"((?:/\*(?:[^*]|\*(?!/))*\*/\s)*)static inline \w+ {wanted}\([^)]*\)\n{{\n(.*?)\n}}"
    for match in re.finditer(pattern, text, re.DOTALL):
        table = {
            name: (int(at), int(size or 1))
            for at, name, size in re.findall(r"^ \* +(\d+) (\w+)(?:\[(\d+)\])?", match[1], re.M)
        }
        found[match[2]] = Function(match[2], read_body(match[3]), table)
    sizes = {name: function.size_of(letter_of(name)) for name, function in found.items()}
    unknowns = {
        body: tuple(map(int, places.split(",")))
        for body, places in re.findall(rf"int {prefix}_(\w+)_unknowns\[\] = {{ ([\d, ]+) }}", text)
    }
    parameters = max(function.size_of("p") for function in found.values())
    guards = guards_of(body_of(text, f"{prefix}_setup"))
    return Header(found, parameters, read_frames(text), sizes, unknowns, guards, lanes, tangents)


def letter_of(name: str) -> str:
    """The argument along which a function is differentiated."""
    return "q" if "flank_" in name or "fillet_" in name else "y" if name == "start_eval" else "x"


def read_companion(path: Path, ending: str) -> str:
    """The text of a header's lanes or tangents; empty where there are none."""
    companion = path.with_name(f"{path.stem}_{ending}.h")
    return companion.read_text(encoding="utf-8") if companion.is_file() else ""


COMMENT = re.compile(r" */\*.*?\*/", re.DOTALL)


def body_of(text: str, name: str) -> str:
    """What stands between the braces of a function, by its name."""
    return COMMENT.sub("", re.search(rf"\b{name}\)?\([^)]*\)\n{{\n(.*?)\n}}", text, re.DOTALL)[1])


def read_lanes(text: str, name: str) -> Function:
    """A function over many instances as one over two: entry k of instance l is x[k], of its partner m mx[k]."""
    prefix = re.search(r"MW_LANE_NAME\((\w+)_setup_lanes\)", text)[1]
    body = re.sub(r"\b(\w)\[(\d+) \* MW_LANES \+ l\]", r"\1[\2]", body_of(text, f"{prefix}_{name}_lanes"))
    body = re.sub(r"\b(\w)\[(\d+) \* MW_LANES \+ m\]", r"m\1[\2]", body).replace("phi[l]", "phi")
    lines = [line for line in map(str.strip, body.splitlines()) if not LANE_SILENT.match(line)]
    return Function(name, read_body("\n".join(lines)), {})


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
            target = statement[1] or statement[3]
            # an argument that is also the result keeps its first value under its own name
            target = f"new {target}" if target[0] == "x" or target.startswith("mx") else target
            definitions[target] = ("expression", statement[2] or statement[4])
    return definitions


def without_blocks(body: str) -> Iterator[str]:
    """The lines outside inner braces, which hold the guards of the design."""
    depth = 0
    for line in map(str.strip, COMMENT.sub("", body).splitlines()):
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
    circle: Circle
    known: dict[str, Number | None] = field(default_factory=dict)
    pairs: dict[str, tuple[Number, Number]] = field(default_factory=dict)

    def value(self, text: str) -> Number:
        """A value by its name or text; one that rests on a missing root is not looked for twice."""
        if text not in self.known:
            try:
                self.known[text] = self._compute(text)
            except NoRoot:
                self.known[text] = None
                raise
        number = self.known[text]
        if number is None:
            raise NoRoot
        return number

    def _compute(self, text: str) -> Number:
        name = text.strip("()")
        if name in self.inputs:
            return self.inputs[name]
        if name in self.function.definitions:
            kind, expression = self.function.definitions[name]
            if kind == "expression":
                return self._expression(expression)
            if expression not in self.pairs:
                self.pairs[expression] = self.turned(self.value(expression))
            return self.pairs[expression][kind == "sin"]
        if literal := literal_of(name):
            exact, angle = literal
            unit = PI if angle else 1
            return Number(unit * exact.numerator * pow(exact.denominator, -1, PRIME) % PRIME, (), angle)
        require(self.earlier is not None, f"{name} has no value")
        return self.earlier.value(name)

    def _expression(self, text: str) -> Number:
        operation, *operands = parsed(text)
        match operation:
            case "sqrt":
                return root(self.value(*operands))
            case "SIGN":
                return sign(self.value(*operands))
            case "atan2":
                return self.arc(*map(self.value, operands))
            case "FMA" | "FMS" | "FNMA":
                product, number = self._product(*operands[:2]), self.value(operands[2])
                if operation == "FNMA":
                    return add(number, product, -1)
                return add(product, number, 1 if operation == "FMA" else -1)
            case "+" | "-" | "*" | "/":
                return self._binary(operands[0], operation, operands[1])
        (text,) = operands
        if text[0] == "-" and literal_of(text) is None:
            return add(Number(0, (), {}), self.value(text[1:]), -1)
        return self.value(text)

    def _product(self, left: str, right: str) -> Number:
        a, b = self.value(left), self.value(right)
        product = multiply(a, b)
        for number, other in ((a, right), (b, left)):
            literal = None if number.angle is None else literal_of(other.strip("()"))
            if literal and literal[1] is None:
                return scaled(number, literal[0], product)
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

    def arc(self, y: Number, x: Number) -> Number:
        square = (x.value * x.value + y.value * y.value) % PRIME
        require(square, "an arc of nothing")
        inverse = pow(square, -1, PRIME)
        name = ("arc", y.value, x.value)
        rates = combined(y.rates, x.value * inverse, x.rates, -y.value * inverse)
        return Number(hash(name) % PRIME, rates, {name: Fraction(1)})

    def turned(self, argument: Number) -> tuple[Number, Number]:
        """Cosine and sine of an angle, by complex multiplication over the independent angles."""
        cosine, sine = 1, 0
        for name, factor in self.circle.split(argument.form).items():
            if name == "pi":
                times = 2 * factor
                c, s = 0, 1
            else:
                c, s, parts = self.circle(name, factor.denominator)
                times = parts * factor
            require(times.denominator == 1, f"an angle is a fraction of {name} that is not foreseen")
            s = s if times > 0 else -s
            for _ in range(abs(times.numerator)):
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
        self.rng, self.arcs, self.points, self.fine, self.sums = rng, arcs, {}, {}, {}

    def split(self, form: dict) -> dict:
        """A sum of numbers as it was first met: of (a + b) c and a c + b c both are the same angle."""
        numbers = {name: factor for name, factor in form.items() if isinstance(name, int)}
        if not numbers:
            return form
        total = sum(factor.numerator * pow(factor.denominator, -1, PRIME) * name for name, factor in numbers.items())
        for known, sign in ((total % PRIME, 1), (-total % PRIME, -1)):
            if known in self.sums:
                numbers = {name: sign * factor for name, factor in self.sums[known].items()}
                break
        else:
            self.sums[total % PRIME] = numbers
        return {name: factor for name, factor in form.items() if not isinstance(name, int)} | numbers

    def __call__(self, name: object, parts: int = 1) -> tuple[int, int, int]:
        """Cosine and sine of a part of an angle, and how many of them it has; at least as many as are asked for."""
        if self.arcs and isinstance(name, tuple):
            return *self._of_arc(name, parts), parts
        if name not in self.points:
            self.points[name] = self._of_number(name) if isinstance(name, int) else self._random()
        return *self.points[name], QUARTER

    def _of_arc(self, name: tuple, parts: int) -> tuple[int, int]:
        """A part of an arc that has the cosine and sine of its sides: halves are roots, so only where they are met."""
        require(parts in (1, 2, 4), f"a part of an arc that is not foreseen: {parts}")
        if (name, parts) not in self.points:
            if parts == 1:
                _, y, x = name
                scale = pow(square_root(x * x + y * y), -1, PRIME)
                self.points[name, parts] = x * scale % PRIME, y * scale % PRIME
            else:
                self.points[name, parts] = halved(*self._of_arc(name, parts // 2))
        return self.points[name, parts]

    def _of_number(self, value: int) -> tuple[int, int]:
        """An angle that is a product is known by its value: a multiple of one met before lies at its multiple."""
        for times in range(1, MULTIPLES + 1):
            known = QUARTER * value * pow(times, -1, PRIME) % PRIME
            for sign, other in ((1, known), (-1, PRIME - known)):
                if other in self.fine:
                    return power(self.fine[other], sign * times)
        self.fine[value] = self._random()
        return power(self.fine[value], QUARTER)

    def _random(self) -> tuple[int, int]:
        t = self.rng.randrange(2, PRIME)
        below = pow(1 + t * t, -1, PRIME)
        return (1 - t * t) * below % PRIME, 2 * t * below % PRIME


def power(point: tuple[int, int], times: int) -> tuple[int, int]:
    """Cosine and sine of a multiple of an angle."""
    (c, s), cosine, sine = point, 1, 0
    s = s if times > 0 else -s
    for _ in range(abs(times)):
        cosine, sine = (cosine * c - sine * s) % PRIME, (sine * c + cosine * s) % PRIME
    return cosine, sine


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
    letter, size = letter_of(name), header.sizes[name]
    own = {f"{letter}[{k}]": drawn(f"{letter}[{k}]", tuple(int(j == k) for j in range(size))) for k in range(size)}
    return Machine(inputs | own, header.functions[name], instant, circle)


def axes(frames: tuple[tuple[str, ...], ...], circle: Circle) -> dict[str, int]:
    """Parameters that are the axes of a placed frame: the columns of a random rotation."""
    values: dict[str, int] = {}
    for frame in frames:
        (a, b), (c, s), (e, f) = (circle(f"axis {k} of {frame[0]}")[:2] for k in range(3))
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


def check_step(header: Header, rng: Random) -> None:
    """J (x - new x) = R: the fused step solves the linear system that R and J state."""
    run = machine(header, "eval", rng)
    step = Machine(run.inputs, header.functions["step"], run.earlier, run.circle)
    n = sum(name.startswith("R[") for name in run.function.definitions)
    change = [run.inputs[f"x[{k}]"].value - step.value(f"new x[{k}]").value for k in range(n)]
    for i in range(n):
        moved = sum(run.value(f"J[{i * n + j}]").value * change[j] for j in range(n))
        require((moved - run.value(f"R[{i}]").value) % PRIME == 0, f"step: row {i} of J dx = -R does not hold")


def check_along(header: Header, rng: Random) -> None:
    """d1 is the derivative of R along v, a direction of (x, phi), and d2 that of d1."""
    n = header.sizes["eval"]
    run = machine(header, "eval", rng)
    rates = {f"x[{k}]": k for k in range(n)} | {"phi": n}
    inputs = dict(run.inputs)
    for key, place in rates.items():
        inputs[key] = Number(inputs[key].value, tuple(int(j == place) for j in range(n + 1)), inputs[key].form)
    setup = Machine(inputs, header.functions["setup"], None, run.circle)
    instant = Machine(inputs, header.functions["set_phi"], setup, run.circle)
    residual = Machine(inputs, header.functions["eval"], instant, run.circle)
    speed = {f"v[{k}]": Number(rng.randrange(1, PRIME)) for k in range(n + 1)}
    along = Machine(inputs | speed, header.functions["along"], setup, run.circle)

    def slope(number: Number) -> int:
        return sum(rate * speed[f"v[{k}]"].value for k, rate in enumerate(number.rates)) % PRIME

    for i in range(n):
        first = along.value(f"d1[{i}]")
        require(first.value == slope(residual.value(f"R[{i}]")), f"along: d1[{i}] is not the derivative of R[{i}]")
        require(along.value(f"d2[{i}]").value == slope(first), f"along: d2[{i}] is not the derivative of d1[{i}]")


def check_start(header: Header, rng: Random) -> None:
    """The Jacobian of the start system."""
    run = machine(header, "start_eval", rng)
    n = sum(name.startswith("R[") for name in run.function.definitions)
    for i in range(n):
        rates = run.value(f"R[{i}]").rates or (0,) * n
        for j in range(n):
            require(run.value(f"J[{i * n + j}]").value == rates[j] % PRIME, f"start_eval: J[{i}][{j}] is no derivative")


def check_curvature(header: Header, name: str, rng: Random) -> None:
    """An orthonormal basis of the tangent plane, the second form from the change of the normal, its trace and
    determinant from the principal curvatures.
    """
    run = machine(header, name, rng, arcs=True)
    curved = Machine(run.inputs, header.functions[f"curvature_{name}"], run.earlier, run.circle)

    def read(machine_: Machine, key: str) -> list[Number]:
        at, size = machine_.function.outputs[key]
        return [machine_.value(f"o[{at + k}]") for k in range(size)]

    def product(a: list[int], b: list[int]) -> int:
        return sum(x * y for x, y in zip(a, b, strict=True)) % PRIME

    basis = [number.value for number in read(curved, "tangent_basis")]
    axes_ = basis[:3], basis[3:]
    normal = read(run, "normal")
    lengths = [product(axes_[0], axes_[0]), product(axes_[1], axes_[1]), product(axes_[0], axes_[1])]
    require(lengths == [1, 1, 0], f"curvature_{name}: the basis is not orthonormal")
    require(
        all(product(a, [n.value for n in normal]) == 0 for a in axes_), f"curvature_{name}: the basis is not tangent"
    )
    form = [number.value for number in read(curved, "second_form")]
    tangents = [[n.value for n in read(run, key)] for key in run.function.outputs if key.startswith("tangent_")]
    for first in tangents:
        for j in range(len(tangents)):
            turned = [n.rates[j] if n.rates else 0 for n in normal]
            (a, b), (c, d) = ([product(v, e) for e in axes_] for v in (first, tangents[j]))
            expected = a * c * form[0] + (a * d + b * c) * form[1] + b * d * form[2]
            require((expected + product(first, turned)) % PRIME == 0, f"curvature_{name}: not the change of the normal")
    low, high = (number.value for number in read(curved, "curvature"))
    require((low + high - form[0] - form[2]) % PRIME == 0, f"curvature_{name}: the curvatures have another sum")
    require((low * high - form[0] * form[2] + form[1] ** 2) % PRIME == 0, f"curvature_{name}: another product")


def check_lanes(header: Header, text: str, rng: Random) -> None:
    """Every instance is computed as the scalar functions compute it: state, state at an angle, step."""
    run = machine(header, "step", rng)
    circle, inputs, setup, instant = run.circle, run.inputs, run.earlier.earlier, run.earlier
    for name, scalar in (("setup", setup), ("set_phi", instant)):
        wide = Machine(inputs, read_lanes(text, name), None if name == "setup" else setup, circle)
        keys = {key for key in wide.function.definitions if key.startswith("s[")}
        read = re.findall(r"\bs\[\d+\]", " ".join(words for _, words in header.functions["step"].definitions.values()))
        missing = set(read) & set(scalar.function.definitions) - keys
        require(not missing, f"lanes: {', '.join(sorted(missing)[:3])} is not set")
        for key in keys:
            require(wide.value(key).value == scalar.value(key).value, f"lanes: {key} is not that of {name}")
    check_lane_guards(header, text, inputs, circle)
    # one design for both instances: every root of the design is needed once
    other = {
        key: Number(rng.randrange(1, PRIME), (), {f"m{key}": Fraction(1)}) for key in inputs if key.startswith("x[")
    }
    names = {key for f in ("setup", "set_phi") for key in header.functions[f].definitions if key.startswith("s[")}
    state = {key: instant.value(key) for key in names}
    own, states = [inputs, inputs | other], [state, state]
    first, second = (
        Machine(inputs | state, header.functions["step"], None, circle)
        for inputs, state in zip(own, states, strict=True)
    )
    partner = {f"m{key}": number for key, number in (own[1] | states[1]).items()}
    wide = Machine(own[0] | states[0] | partner, read_lanes(text, "step"), None, circle)
    for k in range(header.sizes["step"]):
        require(
            wide.value(f"new x[{k}]").value == first.value(f"new x[{k}]").value, f"lanes: x[{k}] is not that of step"
        )
        there = wide.value(f"new mx[{k}]").value
        require(there == second.value(f"new x[{k}]").value, f"lanes: x[{k}] of the partner is not that of step")


GUARD = re.compile(r"if \(!\((\S+) > 0\.0\)\) failed = (\d+);")


def guards_of(body: str) -> tuple[Function, dict[int, str]]:
    """The block of a setup that holds its guards, and place -> what must be positive."""
    block = re.search(r"^    {\n(.*?)^    }", body, re.DOTALL | re.M)[1]
    return Function("guards", read_body(block), {}), {int(place) - 1: name for name, place in GUARD.findall(block)}


def check_lane_guards(header: Header, text: str, inputs: dict[str, Number], circle: Circle) -> None:
    """An instance is valid where all that the scalar setup tests is positive."""
    prefix = re.search(r"MW_LANE_NAME\((\w+)_setup_lanes\)", text)[1]
    body = re.sub(r"\b(\w)\[(\d+) \* MW_LANES \+ l\]", r"\1[\2]", body_of(text, f"{prefix}_setup_lanes"))
    before, _, after = body.partition("valid[l] = ")
    block = read_body(before[before.rindex("{\n") + 2 :])
    tested = re.findall(r"\((\S+) > 0\.0 \? 1\.0 : 0\.0\)", after.partition(";")[0])
    function, places = header.guards
    wide, scalar = (Machine(inputs, f, None, circle) for f in (Function("guards", block, {}), function))
    require(len(tested) == len(places), f"lanes: {len(tested)} guards, setup has {len(places)}")
    for place, name in places.items():
        found, expected = wide.value(tested[place]), scalar.value(name)
        require(found.value == expected.value, f"lanes: guard {place} is not that of setup")


def check_tangent(header: Header, text: str, rng: Random) -> None:
    """The change of the residual and of the contact point along changes of parameters, angle and unknowns."""
    run = machine(header, "eval", rng)
    inputs = dict(run.inputs)
    moved = {}
    for key in list(inputs):
        if key == "phi" or key.startswith(("p[", "x[")):
            rate = rng.randrange(1, PRIME) if key != "p[0]" else 0
            moved[f"d{key}"] = Number(rate)
            inputs[key] = Number(inputs[key].value, (rate,), inputs[key].form if key != "p[0]" else None)
    setup = Machine(inputs, header.functions["setup"], None, run.circle)
    instant = Machine(inputs, header.functions["set_phi"], setup, run.circle)
    residual = Machine(inputs, header.functions["eval"], instant, run.circle)
    seen = Machine(inputs, header.functions["observe"], instant, run.circle)
    own = {key: Number(number.value, (), number.angle) for key, number in inputs.items()}
    name = re.search(r"(\w+)_derive_tangent\(", text)[1] + "_tangent"
    tangent = Machine(own | moved, Function("tangent", read_body(body_of(text, name)), {}), None, run.circle)
    at, _ = seen.function.outputs["point_pinion_f"]
    expected = {f"dR[{i}]": residual.value(f"R[{i}]") for i in range(header.sizes["eval"])}
    expected |= {f"dr[{k}]": seen.value(f"o[{at + k}]") for k in range(3)}
    for key, number in expected.items():
        rate = number.rates[0] if number.rates else 0
        require(tangent.value(key).value == rate, f"tangent: {key} is not the derivative along the change")


def check_flank_tangent(header: Header, text: str, body: str, rng: Random) -> None:
    """The change of a flank's point along changes of parameters, at fixed parameters of the flank."""
    run = machine(header, f"flank_{body}", rng, arcs=True)
    own = {key: Number(number.value, (), number.angle) for key, number in run.inputs.items()}
    inputs, moved = dict(own), {"dp[0]": Number(0)}
    for key in (f"p[{k}]" for k in range(1, header.parameters)):
        rate = rng.randrange(1, PRIME)
        moved[f"d{key}"] = Number(rate)
        inputs[key] = Number(own[key].value, (rate,), own[key].form)
    setup = Machine(inputs, header.functions["setup"], None, run.circle)
    instant = Machine(inputs, header.functions["set_phi"], setup, run.circle)
    there = Machine(inputs, header.functions[f"flank_{body}"], instant, run.circle)
    name = re.search(r"(\w+)_derive_tangent\(", text)[1] + f"_{body}_tangent"
    tangent = Machine(own | moved, Function(name, read_body(body_of(text, name)), {}), None, run.circle)
    at, _ = there.function.outputs["point"]
    for k in range(3):
        number = there.value(f"o[{at + k}]")
        rate = number.rates[0] if number.rates else 0
        require(tangent.value(f"dr[{k}]").value == rate, f"tangent of {body}: dr[{k}] is not the point's derivative")


def attempt(check: Callable[..., None], *arguments: object, sources: Iterable[Random] | None = None) -> None:
    """Repeat a check with new inputs until every radicand is a square and every root has the sign that its real value
    has.

    Modulo a prime, sqrt(x*y*y) is y*sqrt(x) only up to sign, so a right program passes at a share of all inputs. A
    wrong one passes at none: one input at which everything holds is enough.
    """
    refusals: list[Rejected] = []
    for rng in sources or repeat(SystemRandom(), ATTEMPTS):
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
    yield "Newton step", (check_step, header)
    yield "derivatives along a path", (check_along, header)
    if header.lanes:
        yield "lanes", (check_lanes, header, header.lanes)
    if header.tangents:
        yield "tangents of parameters", (check_tangent, header, header.tangents)
        for body in header.unknowns:
            yield f"tangents of the {body}", (check_flank_tangent, header, header.tangents, body)
    if "start_eval" in header.functions:
        yield "jacobian of the start system", (check_start, header)
    yield "assembly of the two points", (check_assembly, header)
    for name in header.functions:
        if name.startswith(("flank_", "fillet_")):
            yield f"tangents and normal of {name}", (check_flank, header, name)
        if f"curvature_{name}" in header.functions and not header.functions[name].implicit:
            yield f"curvature of {name}", (check_curvature, header, name)
    for body in header.unknowns:
        yield f"agreement of flank and observation of the {body}", (check_agreement, header, body)


def check_header(path: Path) -> int:
    """All checks of one header; how many were made."""
    try:
        text = path.read_text(encoding="utf-8")
        check_kernels(text)
        check_arc_kernel(text)
        header = read_header(text, read_companion(path, "lanes"), read_companion(path, "sensitivity"))
        checks = list(checks_of(header))
        for _, check in checks:
            attempt(*check)
    except (Rejected, LookupError, ValueError, AttributeError, TypeError, ArithmeticError) as error:
        raise Rejected(f"{path.name}: {error}") from error
    return len(checks) + 1


#: What stands around the polynomials of sine and cosine: nearest quarter turn, rest, exchange and signs by quadrant.
SINE_LINES = (
    "const double magic = 6755399441055744.0;",
    "const double k = turned.number - magic;",
    "const double z = r * r;",
    "s.number = MW_FMA(r * z, u, r);",
    "const double w = MW_FNMA(z, 0.5, 1.0);",
    "c.number = w + MW_FMA(z * z, v, MW_FNMA(z, 0.5, 1.0 - w));",
    "const unsigned long long quadrant = turned.bits, odd = 0 - (quadrant & 1);",
    "const unsigned long long exchanged = (s.bits ^ c.bits) & odd;",
    "const unsigned long long sign = quadrant << 62 & 0x8000000000000000;",
    "s.bits ^= exchanged ^ sign;",
    "c.bits ^= exchanged ^ (sign ^ (odd & 0x8000000000000000));",
    "*sine = s.number;",
    "*cosine = c.number;",
)


def check_kernels(text: str) -> None:
    """Sine and cosine: polynomials and constants against enclosures in exact arithmetic, and what stands around."""
    body = re.search(r"_sincos\(double a, double \*sine, double \*cosine\)\n{\n(.*?)\n}", text, re.DOTALL)
    require(body, "no kernel of sine and cosine")
    for line in SINE_LINES:
        require(line in body[1], f"sincos: {line} is not there")
    pi = CHECK.number_of("pi").middle
    reduced = re.search(
        r"turned\.number = MW_FMA\(a, ([\d.]+), magic\);.*?"
        r"const double r = \(\(a - k \* ([\d.e-]+)\) - k \* ([\d.e-]+)\) - k \* ([\d.e-]+);",
        body[1],
        re.DOTALL,
    )
    require(reduced, "sincos: no reduction to a quarter turn")
    half, first, second, third = (Fraction(float(found)) for found in reduced.groups())
    require(abs(half - 2 / pi) < Fraction(1, 2**53), "sincos: 2/pi is another number")
    require(abs(first + second + third - pi / 2) < Fraction(1, 10**35), "sincos: pi/2 is another number")
    fused = re.search(r"const double r = MW_FNMA\(k, ([\d.e-]+), MW_FNMA\(k, ([\d.e-]+), a\)\);", body[1])
    require(fused, "sincos: no reduction to a quarter turn")
    turns = sum(Fraction(float(found)) for found in fused.groups())
    require(abs(turns - pi / 2) < Fraction(1, 10**30), "sincos: pi/2 is another number")
    lines = re.findall(r"const double (\w+) = (.+?);", body[1])
    for step in range(-8, 9):
        r = Fraction(step, 8) * Fraction(785, 1000)
        known = {"r": r, "z": r * r}
        for name, expression in lines:
            if re.fullmatch(r"[uv]\d?_?\w*", name):
                known[name] = kernel_value(expression, known)
        u, v, z = known["u"], known["v"], known["z"]
        cosine, sine = CHECK.cosine_and_sine(CHECK.Ball(r), CHECK.number_of("pi"))
        require(abs(r + r * z * u - sine.middle) <= abs(r) * Fraction(1, 2**53), "sincos: the polynomial of the sine")
        require(
            abs(1 - z / 2 + z * z * v - cosine.middle) <= Fraction(1, 2**53), "sincos: the polynomial of the cosine"
        )


#: What stands around the polynomial of atan2: the ratio to the nearest of 0 and 45 degrees, octants, quadrants.
ARC_LINES = (
    "const double ax = x < 0.0 ? -x : x, ay = y < 0.0 ? -y : y;",
    "const double large = ax > ay ? ax : ay, small = ax > ay ? ay : ax;",
    "const double top = upper ? small - large : small, bottom = upper ? small + large : large;",
    "const double r = bottom > 0.0 ? top / bottom : (x + y);",
    "const double z = r * r;",
    "const double octant = ax >= ay ? first : 1.5707963267948966 - first;",
    "const double half = x < 0.0 ? 3.141592653589793 - octant : octant;",
    "return y < 0.0 ? -half : half;",
)


def check_arc_kernel(text: str) -> None:
    """atan2: its polynomial against the series of the arc, in exact arithmetic, and the words of its reduction."""
    body = re.search(r"_atan2\(double y, double x\)\n{\n(.*?)\n}", text, re.DOTALL)
    if body is None:
        return
    for line in ARC_LINES:
        require(line in body[1], f"atan2: {line} is not there")
    border = re.search(r"upper = small > ([\d.]+) \* large;", body[1])
    require(border, "atan2: no border of the octants")
    eighth = Fraction(float(border[1]))
    require(abs(eighth * eighth + 2 * eighth - 1) < Fraction(1, 2**49), "atan2: the octants part elsewhere")
    turn = re.search(r"first = \(upper \? ([\d.]+) : 0\.0\) \+ MW_FMA\(r \* z, u, r\);", body[1])
    require(turn and float(turn[1]) == math.pi / 4, "atan2: another eighth of a turn")
    lines = re.findall(r"const double (u\w*) = (.+?);", body[1])
    for step in range(-8, 9):
        r = Fraction(step, 8) * eighth
        known = {"r": r, "z": r * r}
        for name, expression in lines:
            known[name] = kernel_value(expression, known)
        arc = sum(Fraction((-1) ** k, 2 * k + 1) * r ** (2 * k + 1) for k in range(24))
        require(abs(r + r * known["z"] * known["u"] - arc) <= abs(r) * Fraction(1, 2**52), "atan2: the polynomial")


def kernel_value(expression: str, known: dict[str, Fraction]) -> Fraction:
    """A product, or a product and a number."""

    def number(text: str) -> Fraction:
        return known[text] if text in known else Fraction(float(text))

    if match := re.fullmatch(r"MW_FMA\(([^,]+), ([^,]+), ([^,]+)\)", expression):
        return number(match[1]) * number(match[2]) + number(match[3])
    left, right = expression.split(" * ")
    return number(left) * number(right)


def verify(folder: Path) -> tuple[int, int]:
    """Headers and checks; Rejected if one fails."""
    drives = "_setup(const double *p, double *s)"
    headers = [path for path in sorted((folder.parent / "c").glob("*.h")) if drives in path.read_text(encoding="utf-8")]
    return len(headers), sum(map(check_header, headers))


def main(arguments: list[str]) -> int:
    try:
        headers, checks = verify(Path(arguments[0] if arguments else Path(__file__).parent))
    except Rejected as reason:
        print(f"REJECTED: {reason}", file=sys.stderr)
        return 1
    print(
        f"{checks} checks of {headers} generated headers hold: J = dR/dx, step, paths, start, tangents, normals, "
        "curvature, lanes, parameters, sine, assembly, agreement"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
