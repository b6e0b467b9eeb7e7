"""Straight-line functions run modulo the prime, at random inputs and random points of the circle."""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from random import Random

from .modular import PI, PRIME, NoRoot, Number, add, combined, divide, halved, multiply, root, scaled, sign, square_root
from .refusal import foreseen
from .straight_line import Function, Header, letter_of, literal_of, parsed

#: Angles are whole multiples of a quarter of each independent angle.
QUARTER = 4
#: A quarter of an angle met before, times up to this, is recognised.
MULTIPLES = 16


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
        foreseen(self.earlier is not None, f"{name} has no value")
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
        foreseen(square, "an arc of nothing")
        inverse = pow(square, -1, PRIME)
        name = ("arc", y.value, x.value)
        rates = combined(y.rates, x.value * inverse, x.rates, -y.value * inverse)
        return Number(hash(name) % PRIME, rates, {name: Fraction(1)})

    def turned(self, argument: Number) -> tuple[Number, Number]:
        """Cosine and sine of an angle."""
        form = argument.form
        key = frozenset(form.items())
        if key not in self.circle.turns:
            self.circle.turns[key] = self._turned(form)
        cosine, sine = self.circle.turns[key]
        return Number(cosine, combined(argument.rates, -sine, (), 0)), Number(
            sine, combined(argument.rates, cosine, (), 0)
        )

    def _turned(self, form: dict) -> tuple[int, int]:
        """The same of a sum of multiples, by complex multiplication over the independent angles."""
        cosine, sine = 1, 0
        for name, factor in self.circle.split(form).items():
            if name == "pi":
                times = 2 * factor
                c, s = 0, 1
            else:
                c, s, parts = self.circle(name, factor.denominator)
                times = parts * factor
            foreseen(times.denominator == 1, f"an angle is a fraction of {name} that is not foreseen")
            s = s if times > 0 else -s
            for _ in range(abs(times.numerator)):
                cosine, sine = (cosine * c - sine * s) % PRIME, (sine * c + cosine * s) % PRIME
        return cosine, sine


class Circle:
    """A point of the circle modulo PRIME for a quarter of each independent angle.

    Random; with `arcs` the angle atan2(y, x) has the cosine and sine of its sides, which only the normal's identities
    need.
    """

    def __init__(self, rng: Random, arcs: bool):
        self.rng, self.arcs, self.points, self.fine, self.sums, self.turns = rng, arcs, {}, {}, {}, {}

    def split(self, form: dict) -> dict:
        """A sum of numbers as it was first met: of (a + b) c and a c + b c both are the same angle."""
        numbers = {name: factor for name, factor in form.items() if isinstance(name, int)}
        if not numbers:
            return form
        total = sum(factor.numerator * pow(factor.denominator, -1, PRIME) * name for name, factor in numbers.items())
        for known, way in ((total % PRIME, 1), (-total % PRIME, -1)):
            if known in self.sums:
                numbers = {name: way * factor for name, factor in self.sums[known].items()}
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
        foreseen(parts in (1, 2, 4), f"a part of an arc that is not foreseen: {parts}")
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
            for way, other in ((1, known), (-1, PRIME - known)):
                if other in self.fine:
                    return power(self.fine[other], way * times)
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
