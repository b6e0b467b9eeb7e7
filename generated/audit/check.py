#!/usr/bin/env python3
"""Re-check the audit record with the standard library alone: `python check.py [folder]`, exit status 0 if everything
holds.

The record is two files of canonical JSON, one object per line. `ledger.jsonl` holds sources, steps (definitions),
equations, verdicts and artifacts; `certificates.jsonl` holds what shows each equation true or false. Every object
carries the sha256 of the rest of itself and names the objects it rests on by their sha256, so the one root hash pins
all of them.

What is checked:
  hashes        every object, every link, the root, and every generated file that the record names
  relations     only sin^2 + cos^2 = 1, root^2 = radicand and sign^2 = 1, each angle and root once
  certificates  numerator = sum of cofactor * relation, in exact integers
  trees         lhs - rhs = numerator / denominators at three points mod 2^61 - 1 with free cosines, sines and roots;
                derivatives are carried out by dual numbers, not by the formulas of the prover
  not vacuous   at a point of the variety mod p no denominator vanishes and both sides agree
  refutations   both sides at the recorded rational point, in exact fractions
  verdicts      follow from the certificates that they name
A wrong certificate passes one of the random points with a probability of at most 2 * degree / 2^61.
"""

from __future__ import annotations

import hashlib
import json
import math
import random
import sys
from fractions import Fraction
from math import isqrt
from pathlib import Path

PRIME = 2**61 - 1
POINTS = 3
SCALE = 10**30
THRESHOLD = Fraction(1, 10**9)


class Rejected(Exception):
    """The record is not what it claims to be; the message says where."""


def require(condition: object, message: str) -> None:
    if not condition:
        raise Rejected(message)


# ---- numbers: integers mod PRIME or Fractions, and dual numbers over either, nested once per derivative --------------


class Dual:
    """value + rate * epsilon, epsilon^2 = 0."""

    __slots__ = ("value", "rate")

    def __init__(self, value, rate):
        self.value, self.rate = value, rate


def parts(number):
    return (number.value, number.rate) if type(number) is Dual else (number, 0)


def add(a, b):
    if type(a) is int and type(b) is int:
        return (a + b) % PRIME
    if type(a) is Dual or type(b) is Dual:
        (u, du), (v, dv) = parts(a), parts(b)
        return Dual(add(u, v), add(du, dv))
    return a + b


def mul(a, b):
    if type(a) is int and type(b) is int:
        return a * b % PRIME
    if type(a) is Dual or type(b) is Dual:
        (u, du), (v, dv) = parts(a), parts(b)
        return Dual(mul(u, v), add(mul(u, dv), mul(du, v)))
    return a * b


def neg(a):
    if type(a) is Dual:
        return Dual(neg(a.value), neg(a.rate))
    return -a % PRIME if type(a) is int else -a


def inverse(a):
    if type(a) is Dual:
        value = inverse(a.value)
        return Dual(value, neg(mul(a.rate, mul(value, value))))
    require(a != 0, "a denominator vanishes")
    return pow(a, -1, PRIME) if type(a) is int else 1 / a


def power(a, exponent):
    base = inverse(a) if exponent < 0 else a
    result = base if exponent else mul(0, a)
    for _ in range(abs(exponent) - 1):
        result = mul(result, base)
    return result if exponent else add(1, result)


# ---- environments: what symbols, cosines, jets and roots are worth ---------------------------------------------------


class Free:
    """A random point mod PRIME at which cosines, sines and roots are independent."""

    def __init__(self, equation: dict, rng: random.Random):
        self.equation, self.rng, self.known, self.memo = equation, rng, {}, {}

    def constant(self, number: int):
        return number % PRIME

    def generator(self, name: str):
        if name not in self.known:
            self.known[name] = self.rng.randrange(1, PRIME)
        return self.known[name]

    def circle(self, name: str):
        return self.generator(f"cos({name})"), self.generator(f"sin({name})")

    def jet(self, name: str, orders: tuple):
        return self.generator(f"{name}[{','.join(map(str, orders))}]")

    def divisor(self, polynomial: dict):
        return at_point(polynomial, [self.generator(name) for name in self.equation["generators"]])

    def root(self, radicand):
        name, divisor = self.equation["roots"][canonical(radicand)]
        return mul(self.generator(name), inverse(self.divisor(divisor)))

    def arc(self, tree):
        return self.generator(self.equation["arcs"][canonical(tree)])


class Variety(Free):
    """A random point mod PRIME on which every relation holds."""

    def __init__(self, equation: dict, rng: random.Random):
        super().__init__(equation, rng)
        for name in equation["signs"]:
            self.known[name] = rng.choice((1, PRIME - 1))
        for name in equation["angles"].values():
            t = rng.randrange(1, PRIME)
            below = inverse(add(1, t * t))
            self.known[f"cos({name})"], self.known[f"sin({name})"] = mul(add(1, -t * t), below), mul(2 * t, below)

    def root(self, radicand):
        name, divisor = self.equation["roots"][canonical(radicand)]
        if name not in self.known:
            square = evaluate(radicand, self)
            value = pow(square, (PRIME + 1) // 4, PRIME)
            if value**2 % PRIME != square:
                raise NoRoot
            self.known[name] = mul(value, self.divisor(divisor))
        return super().root(radicand)


class NoRoot(Exception):
    """The radicand is no square mod PRIME at this point; take another."""


class Exact:
    """A rational point with exactly rational cosines and sines.

    Bare angles, pi, roots and dependent angles to 1e-25.
    """

    def __init__(self, equation: dict, point: dict):
        self.equation, self.memo = equation, {}
        self.symbols = {name: Fraction(text) for name, text in point["symbols"].items()}
        self.tangents = {name: Fraction(text) for name, text in point["half_tangents"].items()}
        require(all(abs(self.symbols.get(name, 1)) == 1 for name in equation["signs"]), "a sign is neither +1 nor -1")
        for symbol, name in equation["angles"].items():
            if symbol not in equation["definitions"]:
                self.symbols[symbol] = 2 * divisor_of(name) * arctangent(self.tangents[name])
        self.symbols["pi"] = 4 * arctangent(Fraction(1))

    def constant(self, number: int):
        return Fraction(number)

    def generator(self, name: str):
        return self.symbols[name]

    def circle(self, name: str):
        symbol = name.partition("/")[0]
        if symbol in self.equation["definitions"]:
            return cosine_and_sine(evaluate(symbol, self) / divisor_of(name), self.symbols["pi"])
        t = self.tangents[name]
        return (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)

    def jet(self, name: str, orders: tuple):
        return self.generator(f"{name}[{','.join(map(str, orders))}]")

    def root(self, radicand):
        square = evaluate(radicand, self)
        require(square >= 0, "the root of a negative number")
        return square_root(square)

    def arc(self, tree):
        y, x = (evaluate(part, self) for part in tree[1:])
        require(x > 0, "an arc leaves the right half plane")
        return arctangent(y / x)


class Moving:
    """The same point while some symbols move: every value is dual."""

    def __init__(self, rest, rates: dict):
        self.rest, self.rates, self.equation, self.memo = rest, rates, rest.equation, {}

    def constant(self, number: int):
        return self.rest.constant(number)

    def generator(self, name: str):
        return Dual(self.rest.generator(name), self.rates.get(name, 0))

    def circle(self, name: str):
        symbol = name.partition("/")[0]
        cosine, sine = self.rest.circle(name)
        turning = (
            parts(evaluate(symbol, self))[1] if symbol in self.equation["definitions"] else self.rates.get(symbol, 0)
        )
        if divisor_of(name) > 1:
            turning = mul(turning, inverse(self.constant(divisor_of(name))))
        return Dual(cosine, neg(mul(sine, turning))), Dual(sine, mul(cosine, turning))

    def jet(self, name: str, orders: tuple):
        rate = 0
        for position, variable in enumerate(self.equation["jets"][name]):
            raised = tuple(order + (k == position) for k, order in enumerate(orders))
            if variable in self.rates:
                rate = add(rate, mul(self.rates[variable], self.rest.jet(name, raised)))
        return Dual(self.rest.jet(name, orders), rate)

    def root(self, radicand):
        value = self.rest.root(radicand)
        _, rate = parts(evaluate(radicand, self))
        return Dual(value, mul(rate, inverse(add(value, value))))

    def arc(self, tree):
        (y, dy), (x, dx) = (parts(evaluate(part, self)) for part in tree[1:])
        turning = add(mul(x, dy), neg(mul(y, dx)))
        return Dual(self.rest.arc(tree), mul(turning, inverse(add(mul(x, x), mul(y, y)))))


def divisor_of(name: str) -> int:
    return int(name.partition("/")[2] or 1)


def arctangent(t: Fraction) -> Fraction:
    """arctan t to better than 1e-25, after one halving of the angle where t is large."""
    if t < 0:
        return -arctangent(-t)
    if t > 1:
        return 2 * arctangent(t / (1 + square_root(1 + t * t)))
    square = t * t / (1 + t * t)
    term = total = t / (1 + t * t)
    n = 1
    while term > Fraction(1, 100 * SCALE):
        term = shortened(term * square * 2 * n / (2 * n + 1))
        total += term
        n += 1
    return total


def square_root(value: Fraction) -> Fraction:
    return Fraction(isqrt(value.numerator * SCALE**2 // value.denominator), SCALE)


def cosine_and_sine(angle: Fraction, pi: Fraction) -> tuple:
    """Taylor series after taking off full turns."""
    x = shortened(angle - 2 * pi * round(angle / (2 * pi)))
    totals, term, n = [Fraction(0), Fraction(0)], Fraction(1), 0
    while n < 4 or abs(term) > Fraction(1, 100 * SCALE):
        totals[n % 2] += term * (-1) ** (n // 2)
        n += 1
        term = shortened(term * x / n)
    return totals[0], totals[1]


def shortened(value: Fraction) -> Fraction:
    return Fraction(int(value * SCALE * 1000), SCALE * 1000)


# ---- trees -----------------------------------------------------------------------------------------------------------


def evaluate(tree, env):
    """The value of a tree: a number, a list of three, or a list of three rows."""
    if type(tree) is int:
        return env.constant(tree)
    key = tree if type(tree) is str else id(tree)
    if key not in env.memo:
        env.memo[key] = _symbol(tree, env) if type(tree) is str else _node(tree, env)
    return env.memo[key]


def _symbol(name: str, env):
    definitions = env.equation["definitions"]
    return evaluate(definitions[name], env) if name in definitions else env.generator(name)


def _node(tree: list, env):
    operation, *arguments = tree
    if operation in ("cos", "sin", "tan", "Rx", "Ry", "Rz"):
        cosine, sine = turn(arguments[0], env)
        if operation in ("Rx", "Ry", "Rz"):
            return rotation("xyz".index(operation[1]), cosine, sine)
        return {"cos": lambda: cosine, "sin": lambda: sine, "tan": lambda: mul(sine, inverse(cosine))}[operation]()
    if operation == "jet":
        return env.jet(arguments[0], tuple(arguments[1:]))
    if operation == "sqrt":
        return env.root(arguments[0])
    if operation == "atan2":
        return env.arc(tree)
    if operation == "d":
        rates = {symbol: evaluate(rate, env) for symbol, rate in arguments[1:]}
        require(not set(rates) & set(env.equation["definitions"]), "a derivative is taken along a defined name")
        return each(lambda number: parts(number)[1], evaluate(arguments[0], Moving(env, rates)))
    if operation == "mat":
        return [[evaluate(entry, env) for entry in row] for row in arguments]
    if operation == "^":
        return power(evaluate(arguments[0], env), arguments[1])
    if operation == "at":
        return evaluate(arguments[0], env)[arguments[1]]
    if operation == "entry":
        return evaluate(arguments[0], env)[arguments[1]][arguments[2]]
    require(operation in OPERATIONS, f"{operation!r} is not in the grammar")
    values = [evaluate(argument, env) for argument in arguments]
    return OPERATIONS[operation](*values)


def each(function, value):
    return [each(function, part) for part in value] if type(value) is list else function(value)


def sum_of(first, *rest):
    for value in rest:
        first = [sum_of(a, b) for a, b in zip(first, value, strict=True)] if type(first) is list else add(first, value)
    return first


def product_of(first, *rest):
    for value in rest:
        scalar, other = (value, first) if type(first) is list else (first, value)
        first = each(lambda number, scalar=scalar: mul(scalar, number), other)
    return first


def quotient_of(above, below):
    scale = inverse(below)
    return each(lambda number: mul(number, scale), above)


def dot(u, v):
    return sum_of(*(mul(a, b) for a, b in zip(u, v, strict=True)))


def cross(u, v):
    return [add(mul(u[i - 2], v[i - 1]), neg(mul(u[i - 1], v[i - 2]))) for i in range(3)]


def apply(matrix, other):
    if type(other[0]) is not list:
        return [dot(row, other) for row in matrix]
    return [[dot(row, column) for column in zip(*other, strict=True)] for row in matrix]


OPERATIONS = {
    "+": sum_of,
    "*": product_of,
    "/": quotient_of,
    "-": lambda value: each(neg, value),
    "vec": lambda *values: list(values),
    "dot": dot,
    "cross": cross,
    "triple": lambda u, v, w: dot(cross(u, v), w),
    "@": apply,
    "T": lambda matrix: [list(column) for column in zip(*matrix, strict=True)],
}


def rotation(axis: int, cosine, sine):
    rows = [[int(i == j) for j in range(3)] for i in range(3)]
    first, second = (axis + 1) % 3, (axis + 2) % 3
    rows[first][first], rows[first][second], rows[second][first], rows[second][second] = cosine, neg(sine), sine, cosine
    return rows


def turn(tree, env):
    """Cosine and sine of a rational combination of angles, by complex multiplication."""
    form = linear(tree, env.equation)
    cosine, sine = env.constant(1), env.constant(0)
    for symbol in sorted(set(form) - {"pi"}):
        name = env.equation["angles"][symbol]
        times = form[symbol] * divisor_of(name)
        require(times.denominator == 1, f"no base angle divides {symbol}")
        c, s = env.circle(name)
        s = s if times > 0 else neg(s)
        for _ in range(abs(int(times))):
            cosine, sine = add(mul(cosine, c), neg(mul(sine, s))), add(mul(sine, c), mul(cosine, s))
    quarters = 2 * form.get("pi", Fraction(0))
    require(quarters.denominator == 1, "an angle has a fraction of a right angle")
    for _ in range(int(quarters) % 4):
        cosine, sine = neg(sine), cosine
    return cosine, sine


def linear(tree, equation: dict) -> dict:
    """Base angle or "pi" -> rational factor. A defined name that is listed as a base angle stands for itself."""
    if type(tree) is str:
        opaque = tree in equation["angles"] or tree not in equation["definitions"]
        return {tree: Fraction(1)} if opaque else linear(equation["definitions"][tree], equation)
    if tree == 0:
        return {}
    require(type(tree) is list, "not an angle")
    if tree[0] == "+":
        total = {}
        for term in tree[1:]:
            for symbol, factor in linear(term, equation).items():
                total[symbol] = total.get(symbol, Fraction(0)) + factor
        return {symbol: factor for symbol, factor in total.items() if factor}
    scale = {
        "-": lambda: (Fraction(-1), tree[1]),
        "/": lambda: (Fraction(1, tree[2]), tree[1]),
        "*": lambda: (Fraction(tree[1]), tree[2]),
    }
    require(tree[0] in scale and len(tree) <= 3, "not an angle")
    factor, rest = scale[tree[0]]()
    return {symbol: factor * value for symbol, value in linear(rest, equation).items()}


# ---- polynomials: text `2*0^2*4+-1*1`, coefficient * generator^power -------------------------------------------------


def read_polynomial(text: str) -> dict:
    """Powers ((generator, power), ...) -> coefficient."""
    terms = {}
    for term in text.split("+") if text else ():
        factor, *powers = term.split("*")
        key = tuple((int(index), int(exponent or 1)) for index, _, exponent in (item.partition("^") for item in powers))
        require(key not in terms and int(factor), "a polynomial repeats a term or has a zero term")
        require([i for i, _ in key] == sorted({i for i, _ in key}), "a term is not in canonical order")
        terms[key] = int(factor)
    return terms


def times_relation(cofactor: dict, generator: int, square: dict) -> dict:
    """cofactor * (generator^2 - square)."""
    product = {}
    for key, factor in cofactor.items():
        for other, scale in [(((generator, 2),), 1), *((powers, -value) for powers, value in square.items())]:
            powers = dict(key)
            for index, exponent in other:
                powers[index] = powers.get(index, 0) + exponent
            accumulate(product, tuple(sorted(powers.items())), factor * scale)
    return product


def accumulate(terms: dict, key: tuple, amount: int) -> None:
    total = terms.get(key, 0) + amount
    if total:
        terms[key] = total
    else:
        terms.pop(key, None)


def at_point(polynomial: dict, values: list) -> int:
    total = 0
    for key, factor in polynomial.items():
        for index, exponent in key:
            factor = factor * (values[index] if exponent == 1 else pow(values[index], exponent, PRIME)) % PRIME
        total += factor
    return total % PRIME


# ---- certificates ----------------------------------------------------------------------------------------------------


def canonical(value: object) -> str:
    return json.dumps(value, sort_keys=True, separators=(",", ":"), ensure_ascii=False)


def sha256_of(body: dict) -> str:
    return hashlib.sha256(
        canonical({key: value for key, value in body.items() if key != "sha256"}).encode()
    ).hexdigest()


def scope_of(certificate: dict, equation: dict, definitions: dict) -> dict:
    """What an evaluation needs, after checking that angles, roots, signs and definitions are named once and apart."""
    angles = {
        entry["symbol"]: entry["symbol"] + (f"/{entry['divisor']}" if entry["divisor"] > 1 else "")
        for entry in certificate["angles"]
    }
    require(len(angles) == len(certificate["angles"]), "one angle has two names")
    roots = {
        canonical(root["radicand"]): (root["generator"], read_polynomial(root["divisor"]))
        for root in certificate["roots"]
        if "generator" in root
    }
    require(len(roots) == sum("generator" in root for root in certificate["roots"]), "one root has two names")
    arcs = {canonical(arc["tree"]): arc["generator"] for arc in certificate["arcs"]}
    require(len(arcs) == len(set(arcs.values())) == len(certificate["arcs"]), "arcs and their names do not match")
    taken = [
        *arcs.values(),
        *(set(angles) - set(definitions)),
        *{name for name, _ in roots.values()},
        *equation["signs"],
        *definitions,
    ]
    require(len(taken) == len(set(taken)), "one name means two things")
    return {
        "angles": angles,
        "roots": roots,
        "arcs": arcs,
        "signs": equation["signs"],
        "jets": equation["jets"],
        "definitions": definitions,
        "generators": certificate.get("generators", []),
    }


def relations_of(certificate: dict, scope: dict) -> list:
    """The relations, as (generator index, square), each of an allowed shape and each once."""
    index = {name: position for position, name in enumerate(certificate["generators"])}
    require(len(index) == len(certificate["generators"]), "one generator is listed twice")
    relations = []
    for relation in certificate["relations"]:
        name, square = relation["generator"], read_polynomial(relation["square"])
        require(
            name in index and index[name] not in [known for known, _ in relations],
            f"relation for {name} is invented or repeated",
        )
        if relation["kind"] == "circle":
            angle = name[4:-1]
            require(
                name == f"sin({angle})" and angle in scope["angles"].values(),
                f"{name} is not the sine of a listed angle",
            )
            require(square == {(): 1, ((index[f"cos({angle})"], 2),): -1}, f"the relation of {name} is not the circle")
        elif relation["kind"] == "sign":
            require(name in scope["signs"] and square == {(): 1}, f"{name} is not a sign")
        else:
            require(
                relation["kind"] == "root" and name in [known for known, _ in scope["roots"].values()],
                f"relation {relation['kind']} for {name} is invented",
            )
        relations.append((index[name], square))
    return relations


def check_proof(certificate: dict, equation: dict, definitions: dict) -> None:
    """An identity: the integers, the trees at free points, and one point where nothing vanishes."""
    scope = scope_of(certificate, equation, definitions)
    relations = relations_of(certificate, scope)
    require(certificate["components"], "the certificate has no component")
    polynomials = []
    for component in certificate["components"]:
        numerator = read_polynomial(component["numerator"])
        total: dict = {}
        require(len(component["cofactors"]) == len(relations), "cofactors and relations do not match")
        for text, (generator, square) in zip(component["cofactors"], relations, strict=True):
            for key, amount in times_relation(read_polynomial(text), generator, square).items():
                accumulate(total, key, amount)
        require(total == numerator, "numerator is not the sum of cofactor times relation")
        polynomials.append((numerator, [(read_polynomial(text), times) for text, times in component["denominators"]]))
    rng = random.SystemRandom()
    for _ in range(POINTS):
        check_point(Free(scope, rng), certificate, equation, polynomials, relations)
    check_point(variety_point(scope, rng, equation), certificate, equation, polynomials, relations)


def variety_point(scope: dict, rng: random.Random, equation: dict) -> Variety:
    for _ in range(200):
        point = Variety(scope, rng)
        try:
            evaluate(equation["lhs"], point), evaluate(equation["rhs"], point)
        except NoRoot:
            continue
        return point
    raise Rejected("no point of the variety was found: the statement may be vacuous")


def check_point(env: Free, certificate: dict, equation: dict, polynomials: list, relations: list) -> None:
    left, right = (flat(evaluate(equation[side], env)) for side in ("lhs", "rhs"))
    require(len(left) == len(right) == len(polynomials), "the sides and the certificate have different shapes")
    values = [env.generator(name) for name in certificate["generators"]]
    for relation, (generator, square) in zip(certificate["relations"], relations, strict=True):
        if relation["kind"] == "root":
            for root in certificate["roots"]:
                if root["generator"] == certificate["generators"][generator]:
                    expected = mul(
                        evaluate(root["radicand"], env), power(at_point(read_polynomial(root["divisor"]), values), 2)
                    )
                    require(expected == at_point(square, values), "a root is not of its radicand")
    for a, b, (numerator, denominators) in zip(left, right, polynomials, strict=True):
        below = 1
        for factor, times in denominators:
            below = below * pow(at_point(factor, values), times, PRIME) % PRIME
        require(below, "a denominator is zero")
        require(
            add(a, neg(b)) * below % PRIME == at_point(numerator, values),
            "the trees differ from numerator / denominators",
        )
        require(not isinstance(env, Variety) or a == b, "the sides differ on the variety")


def flat(value) -> list:
    return [number for part in value for number in flat(part)] if type(value) is list else [value]


def check_refutation(certificate: dict, equation: dict, definitions: dict) -> None:
    """The sides at the recorded point, in exact fractions."""
    env = Exact(scope_of(certificate, equation, definitions), certificate["point"])
    left, right = (flat(evaluate(equation[side], env)) for side in ("lhs", "rhs"))
    require(certificate["differs"], "the counterexample names no component that differs")
    for position in certificate["differs"]:
        difference = abs(left[position] - right[position])
        require(difference > (THRESHOLD if certificate["rounded"] else 0), "the sides agree at the counterexample")
    for number, text in zip(left + right, certificate["lhs"] + certificate["rhs"], strict=True):
        require(
            abs(number - Fraction(text)) <= abs(number) * Fraction(1, 10**8),
            "the counterexample's numbers are not those of the sides",
        )


def check_number(certificate: dict, equation: dict, definitions: dict) -> None:
    """A printed number against its formula: within half a unit of its last digit, or not, as recorded."""
    value, printed = number_of(equation["lhs"], definitions), equation["rhs"]
    require(
        abs(value - float(certificate["value"])) <= 1e-8 * max(1.0, abs(value)),
        "the recorded value is not that of the formula",
    )
    if printed in (">0", "<0"):
        within = (value > 0) == (printed == ">0")
    else:
        within = abs(value - Fraction(printed)) <= Fraction(certificate["half_unit"]) + Fraction(1, 10**9)
    require(
        within == (certificate["outcome"] == "proved"),
        "a printed number is not judged by half a unit of its last digit",
    )


NUMERIC = {
    "-": lambda a: -a,
    "/": lambda a, b: a / b,
    "+": lambda *a: math.fsum(a),
    "*": lambda *a: math.prod(a),
    "sqrt": math.sqrt,
    "sin": math.sin,
    "cos": math.cos,
    "tan": math.tan,
    "asin": math.asin,
    "acos": math.acos,
    "atan": math.atan,
    "degrees": math.degrees,
    "radians": math.radians,
}


def number_of(tree, definitions: dict) -> float:
    """A formula with numbers put in, in double precision."""
    if type(tree) is int:
        return float(tree)
    if type(tree) is str:
        return math.pi if tree == "pi" else number_of(definitions[tree], definitions)
    if tree[0] == "^":
        return number_of(tree[1], definitions) ** tree[2]
    return NUMERIC[tree[0]](*(number_of(argument, definitions) for argument in tree[1:]))


CHECKS = {
    "ring_nf": check_proof,
    "exact_point": check_refutation,
    "numeric": check_number,
    "undecided": lambda *_: None,
}
OUTCOME_OF_KIND = {"ring_nf": "proved", "exact_point": "refuted", "undecided": "undecided"}


# ---- the record ------------------------------------------------------------------------------------------------------


def read_lines(path: Path) -> list[dict]:
    try:
        return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]
    except (OSError, ValueError) as error:
        raise Rejected(f"{path.name} cannot be read: {error}") from error


def read_record(folder: Path) -> dict[str, dict]:
    """Every object by its hash, after recomputing it."""
    objects: dict[str, dict] = {}
    for name in ("ledger.jsonl", "certificates.jsonl"):
        for number, item in enumerate(read_lines(folder / name), 1):
            require(item.get("sha256") == sha256_of(item), f"{name} line {number}: the hash is not that of the line")
            require(item["sha256"] not in objects, f"{name} line {number}: repeated")
            objects[item["sha256"]] = item
    return objects


def root_of(objects: dict[str, dict]) -> str:
    """One hash over all objects."""
    return hashlib.sha256("\n".join(sorted(objects)).encode()).hexdigest()


def linked(objects: dict[str, dict], key: str, kind: str) -> dict:
    require(key in objects and objects[key]["object"] == kind, f"a link to a {kind} leads nowhere")
    return objects[key]


def definitions_of(equation: dict, objects: dict[str, dict]) -> dict:
    return {name: linked(objects, key, "step")["tree"] for name, key in equation["where"].items()}


def check_certificate(certificate: dict, objects: dict[str, dict]) -> None:
    equation = linked(objects, certificate["equation"], "equation")
    require(certificate["kind"] in CHECKS, f"unknown kind of certificate {certificate['kind']!r}")
    require(
        certificate["kind"] == "numeric" or OUTCOME_OF_KIND[certificate["kind"]] == certificate["outcome"],
        "kind and outcome contradict",
    )
    try:
        CHECKS[certificate["kind"]](certificate, equation, definitions_of(equation, objects))
    except (Rejected, ArithmeticError, LookupError, TypeError, ValueError, RecursionError) as error:
        raise Rejected(f"{equation['id']}: {error}") from error


def status_of(readings: list[str], corrected: list[str], contradiction: list[str], damaged: bool) -> str:
    """The status that outcomes imply. Several readings stand for several ways in which a text can be read."""
    if contradiction:
        return "undecided" if contradiction != ["proved"] else "ambiguous" if damaged else "false"
    if len(set(readings)) > 1:
        return "ambiguous"
    if readings[0] != "refuted":
        return readings[0]
    return "proved_with_correction" if corrected == ["proved"] else "false"


def outcome_of(reading: dict, verdict: dict, objects: dict[str, dict]) -> str:
    """A reading is proved if all its equations are, refuted if one is."""
    outcomes = set()
    for part in reading["parts"]:
        certificate = linked(objects, part["certificate"], "certificate")
        require(
            certificate["equation"] == part["equation"], f"{verdict['id']}: the certificate is for another equation"
        )
        outcomes.add(certificate["outcome"])
    require(outcomes, f"{verdict['id']}: nothing is judged")
    return next(outcome for outcome in ("refuted", "undecided", "proved") if outcome in outcomes)


def check_verdict(verdict: dict, objects: dict[str, dict]) -> None:
    roles = ("readings", "corrected", "contradiction")
    outcomes = [[outcome_of(reading, verdict, objects) for reading in verdict[role]] for role in roles]
    if outcomes[0] or outcomes[2]:
        require(
            verdict["status"] == status_of(*outcomes, bool(verdict["damage"])),
            f"{verdict['id']}: the status does not follow from the certificates",
        )
    else:
        judged_by_words = ("not_mathematical", "definition") + (("ambiguous",) if verdict["missing"] else ())
        require(verdict["status"] in judged_by_words, f"{verdict['id']}: nothing is judged")


def check_step(step: dict, objects: dict[str, dict]) -> None:
    for key in step["inputs"]:
        linked(objects, key, "step")


def check_files(folder: Path, root: str, objects: dict[str, dict]) -> int:
    """The generated files that the record names, the root hash they carry, and the equations they rest on."""
    try:
        seal = json.loads((folder / "artifacts.json").read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise Rejected(f"artifacts.json cannot be read: {error}") from error
    require(seal["root"] == root, "artifacts.json carries another root hash")
    judged = {item["id"] for item in objects.values() if item["object"] == "verdict"}
    for name, expected in seal["files"].items():
        path = folder.parent / name
        require(path.is_file(), f"{name} is missing")
        data = path.read_bytes()
        require(hashlib.sha256(data).hexdigest() == expected["sha256"], f"{name} has been changed")
        require(not expected["equations"] or root.encode() in data, f"{name} does not carry the root hash")
        require(judged.issuperset(expected["equations"]), f"{name} names an equation that the record does not hold")
    return len(seal["files"])


def verify(folder: Path) -> dict[str, int | str]:
    """Check everything in a folder; the counts and the root hash, or Rejected."""
    objects = read_record(folder)
    for item in objects.values():
        kind = item["object"]
        if kind == "certificate":
            check_certificate(item, objects)
        elif kind == "verdict":
            linked(objects, item["source"], "source")
            check_verdict(item, objects)
        elif kind == "step":
            check_step(item, objects)
        else:
            require(kind in ("source", "equation"), f"unknown object {kind!r}")
    root = root_of(objects)
    kinds = [item["object"] for item in objects.values()]
    return {
        **{kind: kinds.count(kind) for kind in sorted(set(kinds))},
        "file": check_files(folder, root, objects),
        "root": root,
    }


def main(arguments: list[str]) -> int:
    folder = Path(arguments[0] if arguments else Path(__file__).parent)
    try:
        report = verify(folder)
    except Rejected as reason:
        print(f"REJECTED: {reason}", file=sys.stderr)
        return 1
    print(
        ", ".join(f"{count} {kind}{'' if count == 1 else 's'}" for kind, count in report.items() if kind != "root"),
        "hold",
    )
    print("root", report["root"])
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
