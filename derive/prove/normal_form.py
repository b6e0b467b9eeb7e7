"""Division by the ring's relations.

Their leading terms are coprime, so they are a Groebner basis and the remainder is unique.
"""

from dataclasses import dataclass

from derive.prove.polynomial import Terms


@dataclass(frozen=True)
class Relation:
    """generator**2 = square, a polynomial without that generator: a sine, a root or a sign."""

    kind: str
    generator: str
    square: Terms

    def polynomial(self, index: dict[str, int]) -> Terms:
        """generator**2 - square, as terms."""
        powers = [0] * len(index)
        powers[index[self.generator]] = 2
        return _combined({tuple(powers): 1}, {key: -factor for key, factor in self.square.items()})


@dataclass(frozen=True)
class Reduction:
    """numerator = remainder + sum of cofactor * (generator**2 - square) over the relations."""

    remainder: Terms
    cofactors: tuple[Terms, ...]


def reduce(numerator: Terms, relations: tuple[Relation, ...], index: dict[str, int]) -> Reduction:
    """Divide by each relation in turn; `relations` lists roots before the sines their radicands contain."""
    remainder = numerator
    cofactors = []
    for relation in relations:
        remainder, cofactor = _divide(remainder, index[relation.generator], relation.square)
        cofactors.append(cofactor)
    return Reduction(remainder, tuple(cofactors))


def _divide(terms: Terms, position: int, square: Terms) -> tuple[Terms, Terms]:
    """Quotient and remainder of division by generator**2 - square."""
    by_power: dict[int, Terms] = {}
    for powers, factor in terms.items():
        by_power.setdefault(powers[position], {})[powers] = factor
    quotient: Terms = {}
    for power in range(max(by_power, default=0), 1, -1):
        for powers, factor in by_power.pop(power, {}).items():
            lowered = powers[:position] + (power - 2,) + powers[position + 1 :]
            quotient[lowered] = factor
            target = by_power.setdefault(power - 2, {})
            for extra, scale in square.items():
                _accumulate(target, tuple(a + b for a, b in zip(lowered, extra, strict=True)), factor * scale)
    remainder = {powers: factor for group in by_power.values() for powers, factor in group.items()}
    return remainder, quotient


def _accumulate(target: Terms, powers: tuple[int, ...], amount: int) -> None:
    total = target.get(powers, 0) + amount
    if total:
        target[powers] = total
    else:
        target.pop(powers, None)


def _combined(*parts: Terms) -> Terms:
    total: Terms = {}
    for part in parts:
        for powers, factor in part.items():
            _accumulate(total, powers, factor)
    return total
