"""What shows an equation true or false: identities by integers, trees and points; refutations by a real point."""

import random
import re
from fractions import Fraction

from .enclosure import Ball, check_number
from .lines import canonical
from .numbers import LARGEST_EXPONENT, add, mul, neg, power, same
from .points import Exact, Expanded, Free, NoRoot, Point, Sizes, Variety
from .polynomials import Quotient, Size, TooLarge, accumulate, degree_of, read_polynomial, times_relation
from .refusal import Rejected, require
from .trees import NAME, RESERVED, evaluate, flat

POINTS = 3
#: Products of terms that the exact expansion of one certificate may take.
EXPANSION = 12_000
#: The recorded decimals of values that are not rational may be off by this.
ROUNDED = Fraction(1, 10**20)


def scope_of(certificate: dict, equation: dict, definitions: dict) -> dict:
    """What an evaluation needs, after checking that angles, roots, signs and definitions are named once and apart."""
    for key in ("angles", "arcs", "components", "generators", "relations", "roots"):
        require(type(certificate.get(key, [])) is list, f"{key} of a certificate is no list")
    for entry in certificate["angles"]:
        require(type(entry["divisor"]) is int and 1 <= entry["divisor"] <= LARGEST_EXPONENT, "an angle has no divisor")
    angles = {
        entry["symbol"]: entry["symbol"] + (f"/{entry['divisor']}" if entry["divisor"] > 1 else "")
        for entry in certificate["angles"]
    }
    symbols = [entry["symbol"] for entry in certificate["angles"]]
    require(symbols == sorted(angles), "one angle has two names, or angles are not in order")
    named = [root for root in certificate["roots"] if "generator" in root]
    roots = {canonical(root["radicand"]): (root["generator"], read_polynomial(root["divisor"])) for root in named}
    require(len(roots) == len(named), "one root has two names")
    arcs = {canonical(arc["tree"]): arc["generator"] for arc in certificate["arcs"]}
    require(len(arcs) == len(set(arcs.values())) == len(certificate["arcs"]), "arcs and their names do not match")
    for names, stem in (({name for name, _ in roots.values()}, "sqrt"), (arcs.values(), "arc")):
        for name in names:
            require(re.fullmatch(rf"{stem}\d+", name), f"{name!r} cannot be the name of a {stem}")
    jets = equation["jets"]
    plain = [*(set(angles) - set(definitions)), *equation["signs"], *definitions, *jets]
    require(len(plain) == len(set(plain)) and "pi" not in plain, "one name means two things")
    require(all(NAME.fullmatch(name) and not RESERVED.fullmatch(name) for name in plain), "a name is no name")
    return {
        "angles": angles,
        "roots": roots,
        "arcs": arcs,
        "signs": equation["signs"],
        "jets": jets,
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


def check_proof(certificate: dict, equation: dict, definitions: dict) -> dict:
    """An identity: the integers, the trees, and one point where nothing vanishes.

    How it was decided: {"expanded": 0 or 1, "degree": bound, "bits": bound}.
    """
    scope = scope_of(certificate, equation, definitions)
    relations = relations_of(certificate, scope)
    require(certificate["components"], "the certificate has no component")
    components = []
    for component in certificate["components"]:
        numerator = read_polynomial(component["numerator"])
        total: dict = {}
        require(len(component["cofactors"]) == len(relations), "cofactors and relations do not match")
        for text, (generator, square) in zip(component["cofactors"], relations, strict=True):
            for key, amount in times_relation(read_polynomial(text), generator, square).items():
                accumulate(total, key, amount)
        require(total == numerator, "numerator is not the sum of cofactor times relation")
        denominators = [(read_polynomial(text), times) for text, times in component["denominators"]]
        require(all(factor for factor, _ in denominators), "a denominator is zero")
        require(all(type(n) is int and 0 < n <= LARGEST_EXPONENT for _, n in denominators), "no power of a denominator")
        components.append((numerator, denominators))
    bound = size_of(scope, equation, certificate, components)
    expanded = agrees_expanded(scope, certificate, equation, components, relations)
    rng = random.SystemRandom()
    for _ in range(0 if expanded else POINTS):
        check_point(Free(scope, rng), certificate, equation, components, relations)
    check_variety(scope, rng, equation)
    check_instance(certificate, equation, scope)
    degree = max(degree_of(above) + sum(degree_of(f) * n for f, n in below) for above, below in components)
    require(degree == certificate["degree"], "the recorded degree is not that of the certificate")
    return {"expanded": int(expanded), "degree": bound.above + bound.below, "bits": bound.bits}


def size_of(scope: dict, equation: dict, certificate: dict, components: list) -> Size:
    """Bounds on (lhs - rhs) * denominators - numerator, over all components and root relations."""
    env = Sizes(scope)
    left, right = (flat(evaluate(equation[side], env)) for side in ("lhs", "rhs"))
    require(len(left) == len(right) == len(components), "the sides and the certificate have different shapes")
    worst = Size(0, 0, 0)
    for a, b, (numerator, denominators) in zip(left, right, components, strict=True):
        total = add(a, b) or Size(0, 0, 0)
        for factor, times in denominators:
            for _ in range(times):
                total = total * env.polynomial(factor)
        total = total + env.polynomial(numerator)
        worst = Size(max(worst.above, total.above), max(worst.below, total.below), max(worst.bits, total.bits))
    for root in certificate["roots"]:
        square = evaluate(root["radicand"], env) or Size(0, 0, 0)
        worst = worst + square * Size(2 * degree_of(read_polynomial(root["divisor"])), 0, 64)
    return worst


def agrees_expanded(scope: dict, certificate: dict, equation: dict, components: list, relations: list) -> bool:
    """Are the trees the recorded quotients, and the roots those of their radicands, in exact integers?

    False if that takes more than the budget.
    """
    env = Expanded(scope, EXPANSION)
    try:
        check_roots(env, certificate, relations)
        left, right = (flat(evaluate(equation[side], env)) for side in ("lhs", "rhs"))
        for a, b, (numerator, denominators) in zip(left, right, components, strict=True):
            difference = add(a, neg(b))
            if type(difference) is int:
                require(not numerator, "the trees differ from numerator / denominators")
                continue
            below: dict = {}
            for factor, times in denominators:
                key = tuple(sorted(env.named(factor).items()))
                below[key] = below.get(key, 0) + times
            recorded = Quotient(env.named(numerator), below, env.work)
            require((difference + -recorded).vanishes(), "the trees differ from numerator / denominators")
    except TooLarge:
        return False
    return True


def check_roots(env: Point, certificate: dict, relations: list) -> None:
    """root^2 = radicand * divisor^2, and roots of one name have one radicand and one divisor."""
    squares = {
        certificate["generators"][generator]: env.polynomial(square)
        for relation, (generator, square) in zip(certificate["relations"], relations, strict=True)
        if relation["kind"] == "root"
    }
    divisors: dict = {}
    for root in certificate["roots"]:
        name, divisor = root["generator"], env.polynomial(read_polynomial(root["divisor"]))
        require(type(divisor) is not int, "a root is divided by zero")
        square = mul(evaluate(root["radicand"], env), mul(divisor, divisor))
        require(same(square, squares.setdefault(name, square)), "a root is not of its radicand")
        require(same(divisor, divisors.setdefault(name, divisor)), "roots of one name have two divisors")


def check_point(env: Free, certificate: dict, equation: dict, components: list, relations: list) -> None:
    check_roots(env, certificate, relations)
    left, right = (flat(evaluate(equation[side], env)) for side in ("lhs", "rhs"))
    for a, b, (numerator, denominators) in zip(left, right, components, strict=True):
        below = env.constant(1)
        for factor, times in denominators:
            below = mul(below, power(env.polynomial(factor), times, env.constant(1)))
        require(not below.vanishes(), "a denominator is zero")
        require(
            same(mul(add(a, neg(b)), below), env.polynomial(numerator)),
            "the trees differ from numerator / denominators",
        )


def check_variety(scope: dict, rng: random.Random, equation: dict) -> None:
    """Both sides exist and agree at a random point on which every relation holds."""
    for _ in range(200):
        point = Variety(scope, rng)
        try:
            left, right = (flat(evaluate(equation[side], point)) for side in ("lhs", "rhs"))
        except NoRoot:
            continue
        require(all(same(a, b) for a, b in zip(left, right, strict=True)), "the sides differ on the variety")
        return
    raise Rejected("no point of the variety was found: the statement may be vacuous")


def check_instance(certificate: dict, equation: dict, scope: dict) -> tuple:
    """Both sides at the recorded real point, which must exist; the recorded numbers are those of the sides."""
    env = Exact(scope, certificate["point"])
    left, right = ([number or Ball(0) for number in flat(evaluate(equation[s], env))] for s in ("lhs", "rhs"))
    for number, text in zip(left + right, certificate["lhs"] + certificate["rhs"], strict=True):
        room = abs(number.middle) * Fraction(1, 10**9) + (number.radius and ROUNDED)
        require(
            abs(number.middle - Fraction(text)) <= room,
            "the recorded numbers are not those of the sides",
        )
    if certificate["kind"] == "ring_nf":
        require(all(same(a, b) for a, b in zip(left, right, strict=True)), "the sides differ at the recorded point")
    return left, right


def check_refutation(certificate: dict, equation: dict, definitions: dict) -> None:
    """The sides differ at the recorded point by more than the enclosures of both."""
    left, right = check_instance(certificate, equation, scope_of(certificate, equation, definitions))
    require(certificate["differs"], "the counterexample names no component that differs")
    require(certificate["differs"] == sorted(set(certificate["differs"])), "the counterexample repeats a component")
    for position in certificate["differs"]:
        require(type(position) is int and 0 <= position < len(left), "the counterexample names no component")
        require(not same(left[position], right[position]), "the sides agree at the counterexample")


CHECKS = {
    "ring_nf": check_proof,
    "exact_point": check_refutation,
    "numeric": check_number,
    "undecided": lambda *_: None,
}
OUTCOME_OF_KIND = {"ring_nf": "proved", "exact_point": "refuted", "undecided": "undecided"}
