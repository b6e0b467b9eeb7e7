"""A check at inputs drawn anew until one is found at which all roots exist."""

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from itertools import repeat
from random import Random, SystemRandom

from .modular import NoRoot
from .refusal import Rejected, Undecided

#: Inputs that may be drawn until every radicand is a square, and inputs at which a check may fail before it is over.
ATTEMPTS = 20000
REFUSALS = 24


@contextmanager
def limited(count: int) -> Iterator[None]:
    """So many inputs at most, where many checks are to fail; the limit of before afterwards."""
    global ATTEMPTS
    before, ATTEMPTS = ATTEMPTS, count
    try:
        yield
    finally:
        ATTEMPTS = before


def attempt(check: Callable[..., None], *arguments: object, sources: Iterable[Random] | None = None) -> None:
    """Repeat a check with new inputs until every radicand is a square and every root has the sign that its real value
    has.

    Modulo a prime, sqrt(x*y*y) is y*sqrt(x) only up to sign, so a right program passes at a share of all inputs. A
    wrong one passes at none: one input at which everything holds is enough. Where none is found, what was not foreseen
    at one of them goes before what failed: it may be why.
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
    if not refusals:
        raise Undecided("no input was found at which every root exists")
    raise next((reason for reason in refusals if isinstance(reason, Undecided)), refusals[-1])
