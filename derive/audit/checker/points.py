"""What symbols, cosines, jets, roots and arcs are worth: modulo a prime, expanded, bounded, or at a real point."""

import random
import re
from fractions import Fraction

from .enclosure import Ball, arctangent, cosine_and_sine
from .lines import canonical
from .numbers import LARGEST_INTEGER, Residue, add, inverse, mul, parts, power, random_prime
from .polynomials import Quotient, Size, degree_of
from .refusal import Rejected, require
from .trees import divisor_of, evaluate


class Point:
    """Generators are independent; what one of them is worth, a subclass says."""

    def __init__(self, scope: dict):
        self.scope, self.known, self.memo = scope, {}, {}

    def generator(self, name: str):
        if name not in self.known:
            self.known[name] = self.drawn(name)
        return self.known[name]

    def circle(self, name: str):
        return self.generator(f"cos({name})"), self.generator(f"sin({name})")

    def jet(self, name: str, orders: tuple):
        require(len(orders) == len(self.scope["jets"][name]), f"{name} has another number of variables")
        return self.generator(f"{name}[{','.join(map(str, orders))}]")

    def polynomial(self, terms: dict):
        """A polynomial of the certificate, in the certificate's generators."""
        total = 0
        for key, amount in terms.items():
            term = self.constant(amount)
            for index, exponent in key:
                term = mul(term, power(self.generator(self.scope["generators"][index]), exponent, self.constant(1)))
            total = add(total, term)
        return total

    def root(self, radicand):
        name, divisor = self.scope["roots"][canonical(radicand)]
        return mul(self.generator(name), inverse(self.polynomial(divisor)))

    def arc(self, tree):
        return self.generator(self.scope["arcs"][canonical(tree)])


class Free(Point):
    """A random point modulo a prime at which cosines, sines and roots are independent."""

    def __init__(self, scope: dict, rng: random.Random):
        super().__init__(scope)
        self.rng, self.prime = rng, random_prime(rng)

    def constant(self, number: int):
        return Residue(number, self.prime)

    def drawn(self, name: str):
        return Residue(self.rng.randrange(1, self.prime), self.prime)


class Variety(Free):
    """A random point modulo a prime on which every relation holds."""

    def __init__(self, scope: dict, rng: random.Random):
        super().__init__(scope, rng)
        for name in scope["signs"]:
            self.known[name] = self.constant(rng.choice((1, -1)))
        for name in scope["angles"].values():
            t = self.drawn(name)
            below = inverse(self.constant(1) + t * t)
            self.known[f"cos({name})"] = (self.constant(1) + -(t * t)) * below
            self.known[f"sin({name})"] = self.constant(2) * t * below

    def root(self, radicand):
        name, divisor = self.scope["roots"][canonical(radicand)]
        if name not in self.known:
            square = parts(evaluate(radicand, self))[0]
            square = square.value if type(square) is Residue else 0
            value = pow(square, (self.prime + 1) // 4, self.prime)
            if value**2 % self.prime != square:
                raise NoRoot
            self.known[name] = Residue(value, self.prime) * self.polynomial(divisor)
        return super().root(radicand)


class NoRoot(Exception):
    """The radicand is no square modulo the prime at this point; take another."""


class Sizes(Point):
    """Bounds instead of values."""

    def constant(self, number: int):
        require(abs(number) <= LARGEST_INTEGER, "an integer is out of range")
        return Size(0, 0, abs(number).bit_length())

    def drawn(self, name: str):
        return Size(1, 0, 0)

    def polynomial(self, terms: dict):
        return Size(degree_of(terms), 0, sum(map(abs, terms.values())).bit_length())


class Expanded(Point):
    """Polynomials in the names of the generators."""

    def __init__(self, scope: dict, budget: int):
        super().__init__(scope)
        self.work = [budget]

    def constant(self, number: int):
        return Quotient({(): number} if number else {}, {}, self.work)

    def drawn(self, name: str):
        return Quotient({((name, 1),): 1}, {}, self.work)

    def named(self, terms: dict) -> dict:
        """A polynomial of the certificate, its generators by name."""
        generators = self.scope["generators"]
        return {tuple(sorted((generators[i], e) for i, e in key)): amount for key, amount in terms.items()}

    def polynomial(self, terms: dict):
        return Quotient(self.named(terms), {}, self.work)


class Exact(Point):
    """A real point with exactly rational cosines and sines; bare angles, pi, roots and arcs as enclosures."""

    def __init__(self, scope: dict, point: dict):
        super().__init__(scope)
        symbols = {name: Ball(fraction(text)) for name, text in point["symbols"].items()}
        self.tangents = {name: fraction(text) for name, text in point["half_tangents"].items()}
        require(set(self.tangents) <= set(scope["angles"].values()), "a point gives the angle of nothing")
        require(
            all(abs(symbols.get(name, Ball(1)).middle) == 1 for name in scope["signs"]), "a sign is neither +1 nor -1"
        )
        require(not set(symbols) & {*scope["angles"], *scope["definitions"], "pi"}, "a point gives one value twice")
        self.pi = Ball(4) * arctangent(Ball(1))
        self.known = symbols | {"pi": self.pi}
        for symbol, name in scope["angles"].items():
            if symbol not in scope["definitions"]:
                self.known[symbol] = Ball(2 * divisor_of(name)) * arctangent(Ball(self.tangents[name]))

    def constant(self, number: int):
        return Ball(number)

    def drawn(self, name: str):
        raise Rejected(f"the point gives no value for {name}")

    def circle(self, name: str):
        symbol = name.partition("/")[0]
        if symbol in self.scope["definitions"]:
            angle = evaluate(symbol, self)
            return cosine_and_sine(mul(angle, inverse(self.constant(divisor_of(name)))) or Ball(0), self.pi)
        t = self.tangents[name]
        return Ball((1 - t * t) / (1 + t * t)), Ball(2 * t / (1 + t * t))

    def root(self, radicand):
        return (evaluate(radicand, self) or Ball(0)).root()

    def arc(self, tree):
        y, x = (evaluate(part, self) for part in tree[1:])
        require(type(x) is Ball and x.middle > x.radius, "an arc leaves the right half plane")
        return arctangent(mul(y, x.inverse())) if type(y) is Ball else 0


def fraction(text: str) -> Fraction:
    require(type(text) is str and re.fullmatch(r"-?\d{1,400}(/\d{1,400})?", text), "a number is no fraction")
    return Fraction(text)
