"""Expressions and motions of a drive's description, evaluated modulo the prime."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

from .machine import Machine
from .modular import PI, PRIME, NoRoot, Number, add, divide, multiply, root, scaled, sign
from .refusal import Rejected, require

#: Axis of a rotation -> the two components that it mixes, in their order.
MIXED = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}
ONE = Number(1)


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
        if isinstance(e, str):
            return self.values[e] if e in self.values else self._defined(e)
        if isinstance(e, int):
            return Number(e % PRIME, (), {})
        if isinstance(e, list) and e and isinstance(e[0], str):
            return self._made(*e)
        raise Rejected(f"{str(e)[:40]} has no meaning in a description")

    def _made(self, operation: str, *operands: object) -> Number:
        if operation == "*":
            return self._product(operands)
        if operation == "+" and operands:
            total = self(operands[0])
            for term in operands[1:]:
                total = add(total, self(term))
            return total
        match operation, *operands:
            case "^", base, exponent:
                return self._power(self(base), exponent)
            case "/", p, q:
                return literal(Fraction(p, q))
            case ("pi",):
                return Number(PI, (), {"pi": 1})
        require(operation in FUNCTIONS, f"{operation[:40]} has no meaning in a description")
        return FUNCTIONS[operation](self.run, *map(self, operands))

    def _defined(self, name: str) -> Number:
        """A definition's value; one that rests on a missing root is not looked for twice."""
        require(name in self.named, f"the description does not say what {name} is")
        if name in self.missing:
            raise NoRoot
        try:
            self.values[name] = self(self.named[name])
        except NoRoot:
            self.missing.add(name)
            raise
        return self.values[name]

    def _product(self, factors: Sequence) -> Number:
        """Exact numbers last: a multiple of an angle stays one."""
        over, under, value = 1, 1, None
        for factor in factors:
            if isinstance(factor, int):
                over *= factor
            elif isinstance(factor, list) and factor[0] == "/":
                over, under = over * factor[1], under * factor[2]
            else:
                number = self(factor)
                value = number if value is None else multiply(value, number)
        exact = over if under == 1 else Fraction(over, under)
        if value is None or exact == 1:
            return value or literal(exact)
        form = Number(value.value, value.rates, value.form)
        return scaled(form, exact, multiply(form, literal(exact)))

    @staticmethod
    def _power(base: Number, exponent: object) -> Number:
        power = Fraction(exponent) if isinstance(exponent, int) else Fraction(exponent[1], exponent[2])
        require(power.denominator in (1, 2), f"a power of {power} is not foreseen")
        base = base if power.denominator == 1 else root(base)
        value = ONE
        for _ in range(abs(power.numerator)):
            value = multiply(value, base)
        return value if power > 0 else divide(ONE, value)

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
                    arm = [add(a, c, -1) for a, c in zip(vector, centre, strict=True)]
                    vector = list(map(add, self._turned(data[0], self(data[1]), arm), centre))
                case "translation" | "station":
                    vector = vector if free else list(map(add, vector, self.vector(data[0])))
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
        turned[i] = add(multiply(cosine, vector[i]), multiply(sine, vector[j]), -1)
        turned[j] = add(multiply(sine, vector[i]), multiply(cosine, vector[j]))
        return turned


def literal(exact: Fraction | int) -> Number:
    inverse = 1 if exact.denominator == 1 else pow(exact.denominator, -1, PRIME)
    return Number(exact.numerator * inverse % PRIME, (), {})


def inner(a: list[Number], b: list[Number]) -> Number:
    total = Number(0)
    for p, q in zip(a, b, strict=True):
        total = add(total, multiply(p, q))
    return total


def complement(a: Number) -> Number:
    return root(add(ONE, multiply(a, a), -1))


def unit_step(a: Number) -> Number:
    return multiply(literal(Fraction(1, 2)), add(ONE, sign(a)))


FUNCTIONS = {
    "sqrt": lambda run, a: root(a),
    "abs": lambda run, a: multiply(a, sign(a)),
    "sign": lambda run, a: sign(a),
    "unit_step": lambda run, a: unit_step(a),
    "excess": lambda run, a: multiply(a, unit_step(a)),
    "sin": lambda run, a: run.turned(a)[1],
    "cos": lambda run, a: run.turned(a)[0],
    "tan": lambda run, a: divide(*reversed(run.turned(a))),
    "asin": lambda run, a: run.arc(a, complement(a)),
    "acos": lambda run, a: run.arc(complement(a), a),
    "atan": lambda run, a: run.arc(a, ONE),
    "atan2": lambda run, y, x: run.arc(y, x),
}


def names_in(e: object, named: Mapping[str, object]) -> set[str]:
    """The names that an expression rests on, definitions followed."""
    if isinstance(e, str):
        return names_in(named[e], named) if e in named else {e}
    return set().union(*(names_in(operand, named) for operand in e[1:])) if isinstance(e, list) else set()
