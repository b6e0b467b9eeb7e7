"""Certificates: what shows a decision, as a plain object ready for canonical JSON."""

from fractions import Fraction

from derive.prove.points import Point
from derive.prove.polynomial import Terms, text_of
from derive.prove.prover import Component, Decision, Instance, Outcome

DIGITS = 10


def certificate(decision: Decision) -> dict:
    """The certificate of a decision, without the hash of the equation it belongs to."""
    body = {
        "outcome": str(decision.outcome),
        "angles": [{"symbol": angle.symbol, "divisor": angle.divisor} for angle in decision.statement.angles],
        "arcs": [{"tree": tree, "generator": name} for tree, name in decision.arcs.items()],
    }
    instance = instance_body(decision.instance)
    match decision.outcome:
        case Outcome.PROVED:
            return {"kind": "ring_nf", **body, **instance, **_proof(decision)}
        case Outcome.REFUTED:
            roots = [{"radicand": radicand} for radicand, _, _ in decision.roots]
            differs = [k for k, part in enumerate(decision.components) if part.outcome is Outcome.REFUTED]
            return {"kind": "exact_point", **body, **instance, "roots": roots, "differs": differs}
        case Outcome.UNDECIDED:
            return {"kind": "undecided", **body}


def instance_body(instance: Instance | None) -> dict:
    """A point and the numbers on both sides: exact cosines and sines, decimals that fit a calculator."""
    if instance is None:
        return {}
    return {
        "point": point_body(instance.point),
        "lhs": [decimal(value) for value in instance.lhs],
        "rhs": [decimal(value) for value in instance.rhs],
        "rounded": instance.rounded,
    }


def point_body(point: Point) -> dict:
    return {
        "symbols": {name: str(value) for name, value in sorted(point.symbols.items())},
        "half_tangents": {name: str(value) for name, value in sorted(point.half_tangents.items())},
    }


def decimal(value: Fraction) -> str:
    """Ten significant digits, correctly rounded on every machine."""
    if not value:
        return "0"
    exponent = 0
    scaled = abs(value)
    while scaled >= 10**DIGITS:
        scaled, exponent = scaled / 10, exponent + 1
    while scaled < 10 ** (DIGITS - 1):
        scaled, exponent = scaled * 10, exponent - 1
    digits = str(round(scaled)).rstrip("0") or "0"
    exponent += len(str(round(scaled))) - len(digits)
    sign = "-" if value < 0 else ""
    if 0 <= exponent <= 3:
        return f"{sign}{digits}{'0' * exponent}"
    if -DIGITS - 4 < exponent < 0:
        padded = digits.rjust(1 - exponent, "0")
        return f"{sign}{padded[:exponent]}.{padded[exponent:]}"
    return f"{sign}{digits}e{exponent}"


def _proof(decision: Decision) -> dict:
    kept = [
        k for k in range(len(decision.relations)) if any(component.cofactors[k] for component in decision.components)
    ]
    relations = [decision.relations[k] for k in kept]
    polynomials = [relation.square for relation in relations] + [divisor for _, _, divisor in decision.roots]
    for component in decision.components:
        polynomials += [component.numerator, *(factor for factor, _ in component.denominators), *component.cofactors]
    used = sorted(
        {decision.names.index(name) for _, name, _ in decision.roots}
        | {i for terms in polynomials for powers in terms for i, e in enumerate(powers) if e}
        | {decision.names.index(r.generator) for r in relations}
    )
    return {
        "generators": [decision.names[i] for i in used],
        "roots": [
            {"radicand": radicand, "generator": name, "divisor": text_of(_restricted(divisor, used))}
            for radicand, name, divisor in decision.roots
        ],
        "relations": [
            {"kind": r.kind, "generator": r.generator, "square": text_of(_restricted(r.square, used))}
            for r in relations
        ],
        "components": [_component(component, kept, used) for component in decision.components],
        "degree": max(_degree_bound(component) for component in decision.components),
    }


def _component(component: Component, kept: list[int], used: list[int]) -> dict:
    return {
        "numerator": text_of(_restricted(component.numerator, used)),
        "denominators": [[text_of(_restricted(factor, used)), times] for factor, times in component.denominators],
        "cofactors": [text_of(_restricted(component.cofactors[k], used)) for k in kept],
    }


def _degree_bound(component: Component) -> int:
    return _degree(component.numerator) + sum(_degree(factor) * times for factor, times in component.denominators)


def _degree(terms: Terms) -> int:
    return max(map(sum, terms), default=0)


def _restricted(terms: Terms, used: list[int]) -> Terms:
    return {tuple(powers[i] for i in used): factor for powers, factor in terms.items()}
