"""Values of expression trees in any kind of number; derivatives by dual numbers."""

import re
from fractions import Fraction

from .numbers import LARGEST_EXPONENT, Dual, add, inverse, mul, neg, parts, power
from .refusal import require

NAME = re.compile(r"[A-Za-z]\w*", re.ASCII)
RESERVED = re.compile(r"(sqrt|arc)\d+")


class Moving:
    """The same point while some symbols move: every value is dual."""

    def __init__(self, rest, rates: dict):
        self.rest, self.rates, self.scope, self.memo = rest, rates, rest.scope, {}

    def constant(self, number: int):
        return self.rest.constant(number)

    def generator(self, name: str):
        return Dual(self.rest.generator(name), self.rates.get(name, 0))

    def circle(self, name: str):
        symbol = name.partition("/")[0]
        cosine, sine = self.rest.circle(name)
        turning = parts(evaluate(symbol, self))[1] if symbol in self.scope["definitions"] else self.rates.get(symbol, 0)
        if divisor_of(name) > 1:
            turning = mul(turning, inverse(self.constant(divisor_of(name))))
        return Dual(cosine, neg(mul(sine, turning))), Dual(sine, mul(cosine, turning))

    def jet(self, name: str, orders: tuple):
        rate = 0
        for position, variable in enumerate(self.scope["jets"][name]):
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


def evaluate(tree, env):
    """The value of a tree: a number, a list of three, or a list of three rows."""
    if type(tree) is int:
        return env.constant(tree)
    require(type(tree) in (str, list), "a tree holds something that is neither a name nor a node")
    key = tree if type(tree) is str else id(tree)
    if key not in env.memo:
        env.memo[key] = _symbol(tree, env) if type(tree) is str else _node(tree, env)
    return env.memo[key]


def _symbol(name: str, env):
    require(NAME.fullmatch(name) and not RESERVED.fullmatch(name), f"{name!r} is no name of a symbol")
    definitions = env.scope["definitions"]
    return evaluate(definitions[name], env) if name in definitions else env.generator(name)


def _node(tree: list, env):
    operation, *arguments = tree
    if operation in ("cos", "sin", "tan", "Rx", "Ry", "Rz"):
        (angle,) = arguments
        cosine, sine = turn(angle, env)
        if operation in ("Rx", "Ry", "Rz"):
            return rotation("xyz".index(operation[1]), cosine, sine, env.constant(1))
        return {"cos": lambda: cosine, "sin": lambda: sine, "tan": lambda: mul(sine, inverse(cosine))}[operation]()
    if operation == "jet":
        require(all(type(order) is int and 0 <= order <= LARGEST_EXPONENT for order in arguments[1:]), "not a jet")
        return env.jet(arguments[0], tuple(arguments[1:]))
    if operation == "sqrt":
        (radicand,) = arguments
        return env.root(radicand)
    if operation == "atan2":
        require(len(arguments) == 2, "an arc has two sides")
        return env.arc(tree)
    if operation == "d":
        rates = {symbol: evaluate(rate, env) for symbol, rate in arguments[1:]}
        require(len(rates) == len(arguments) - 1 > 0, "a derivative moves each of its symbols once")
        require(not set(rates) & {*env.scope["definitions"], "pi"}, "a derivative is taken along a defined name")
        require(all(NAME.fullmatch(symbol) for symbol in rates), "a derivative is taken along a symbol")
        return each(lambda number: parts(number)[1], evaluate(arguments[0], Moving(env, rates)))
    if operation == "mat":
        return [[evaluate(entry, env) for entry in row] for row in arguments]
    if operation == "^":
        base, exponent = arguments
        require(type(exponent) is int, "an exponent is an integer")
        return power(evaluate(base, env), exponent, env.constant(1))
    if operation in ("at", "entry"):
        value = evaluate(arguments[0], env)
        for place in arguments[1:]:
            require(type(place) is int and 0 <= place < 3 and type(value) is list, "no such component")
            value = value[place]
        return value
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
    "vec": lambda x, y, z: [x, y, z],
    "dot": dot,
    "cross": cross,
    "triple": lambda u, v, w: dot(cross(u, v), w),
    "@": apply,
    "T": lambda matrix: [list(column) for column in zip(*matrix, strict=True)],
}


def rotation(axis: int, cosine, sine, one):
    rows = [[one if i == j else 0 for j in range(3)] for i in range(3)]
    first, second = (axis + 1) % 3, (axis + 2) % 3
    rows[first][first], rows[first][second], rows[second][first], rows[second][second] = cosine, neg(sine), sine, cosine
    return rows


def turn(tree, env):
    """Cosine and sine of a rational combination of angles, by complex multiplication."""
    form = linear(tree, env.scope)
    cosine, sine = env.constant(1), 0
    for symbol in sorted(set(form) - {"pi"}):
        name = env.scope["angles"][symbol]
        times = form[symbol] * divisor_of(name)
        require(times.denominator == 1, f"no base angle divides {symbol}")
        require(abs(times) <= LARGEST_EXPONENT, f"a multiple of {symbol} is out of range")
        c, s = env.circle(name)
        s = s if times > 0 else neg(s)
        for _ in range(abs(int(times))):
            cosine, sine = add(mul(cosine, c), neg(mul(sine, s))), add(mul(sine, c), mul(cosine, s))
    quarters = 2 * form.get("pi", Fraction(0))
    require(quarters.denominator == 1, "an angle has a fraction of a right angle")
    for _ in range(int(quarters) % 4):
        cosine, sine = neg(sine), cosine
    return cosine, sine


def linear(tree, scope: dict) -> dict:
    """Base angle or "pi" -> rational factor. A defined name that is listed as a base angle stands for itself."""
    if type(tree) is str:
        opaque = tree in scope["angles"] or tree not in scope["definitions"]
        return {tree: Fraction(1)} if opaque else linear(scope["definitions"][tree], scope)
    if tree == 0:
        return {}
    require(type(tree) is list, "not an angle")
    if tree[0] == "+":
        total = {}
        for term in tree[1:]:
            for symbol, factor in linear(term, scope).items():
                total[symbol] = total.get(symbol, Fraction(0)) + factor
        return {symbol: factor for symbol, factor in total.items() if factor}
    scale = {
        "-": lambda: (Fraction(-1), tree[1]),
        "/": lambda: (Fraction(1, whole(tree[2])), tree[1]),
        "*": lambda: (Fraction(whole(tree[1])), tree[2]),
    }
    require(tree[0] in scale and len(tree) <= 3, "not an angle")
    factor, rest = scale[tree[0]]()
    return {symbol: factor * value for symbol, value in linear(rest, scope).items()}


def whole(tree) -> int:
    require(type(tree) is int, "not an angle")
    return tree


def flat(value) -> list:
    return [number for part in value for number in flat(part)] if type(value) is list else [value]
