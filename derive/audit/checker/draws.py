"""Draws that all checks of a drive share, on both flanks."""

from collections.abc import Callable, Iterator
from random import Random, SystemRandom

from . import attempts
from .modular import PRIME

#: Draws that all checks of a drive share.
KEPT = 200


def once(rng: Random, key: object, make: Callable[[], object]) -> object:
    """What several checks need at one draw, made by the first of them; anew where numbers are not kept."""
    if not isinstance(rng, Draw):
        return make()
    if key not in rng.kept:
        rng.kept[key] = make()
    return rng.kept[key]


class Draw(Random):
    """Numbers from the system's source, one sign of the flank, and what was computed from them."""

    def __init__(self, sign: int):
        super().__init__()
        self.sign, self.source, self.kept = sign, SystemRandom(), {}

    def randrange(self, *bounds: int) -> int:
        return self.source.randrange(*bounds)

    def choice(self, _: object) -> int:
        return self.sign % PRIME


class Draws:
    """Draws in their order; the first are kept, so that checks share what they compute at them."""

    def __init__(self, sign: int):
        self.sign, self.kept = sign, []

    def __iter__(self) -> Iterator[Draw]:
        for k in range(attempts.ATTEMPTS):
            if k >= KEPT:
                yield Draw(self.sign)
                continue
            if k == len(self.kept):
                self.kept.append(Draw(self.sign))
            yield self.kept[k]


def on_both_flanks(check: Callable[..., None], *arguments: object, draws: tuple[Draws, Draws] | None = None) -> None:
    """A check on each of the two flanks; one alone would not notice where a sign of the flank is missing."""
    for flank in draws or (Draws(1), Draws(-1)):
        attempts.attempt(check, *arguments, sources=flank)
