"""Checks with any function in the place of the square root."""

from random import SystemRandom

from .casadi_functions import check_casadi
from .draws import Draws, on_both_flanks
from .modular import PRIME, NoRoot, any_root, real_signs
from .refusal import Rejected


def with_any_root(check, arguments: tuple, draws: tuple) -> None:
    """A check with any function in the place of the square root, and where that fails with the root itself.

    Two programs that agree whatever that function is agree for the root; and no radicand has to be a square.
    """
    try:
        with any_root(draws[0].salt):
            for flank in draws[:2]:
                check(*arguments, next(iter(flank)))
        return
    except (Rejected, NoRoot):
        pass
    if check is check_casadi and arguments[3].startswith("curvature_"):
        # CasADi makes the magnitude of the root of a square, which principal curvatures rest on
        with real_signs():
            on_both_flanks(check, *arguments, draws=draws[4:])
    else:
        on_both_flanks(check, *arguments, draws=draws[2:4])


class Salted(Draws):
    """Draws with a number of their own."""

    def __init__(self, sign: int):
        super().__init__(sign)
        self.salt = SystemRandom().randrange(PRIME)


def kept_draws() -> tuple:
    """What all checks of a drive share, two flanks each: with any function for the root, with roots, with signs too."""
    return *map(Salted, (1, -1)), *map(Draws, (1, -1, 1, -1))
