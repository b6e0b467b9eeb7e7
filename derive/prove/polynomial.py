"""Integer polynomial rings.

Python-flint where it is installed, SymPy's rings otherwise, one interface and equal results.
"""

from functools import cached_property
from typing import Any, TypeAlias

flint: Any
try:
    import flint
except ImportError:
    flint = None

Poly: TypeAlias = Any
Terms: TypeAlias = dict[tuple[int, ...], int]

BACKENDS = ("flint", "sympy") if flint else ("sympy",)


class PolynomialRing:
    """Z[names] with lexicographic order. Polynomials are the back end's own and support + - * and **."""

    _context: Any  # of FLINT or of SymPy

    def __init__(self, names: tuple[str, ...], backend: str = BACKENDS[0]):
        self.names = names
        self.backend = backend
        if backend == "flint":
            self._context = flint.fmpz_mpoly_ctx.get(tuple(f"x{i}" for i in range(len(names))), "lex")
            generators = self._context.gens()
        else:
            from sympy import ZZ, lex, ring

            self._context, *generators = ring([f"x{i}" for i in range(len(names))], ZZ, lex)
        self._generators = dict(zip(names, generators, strict=True))

    def generator(self, name: str) -> Poly:
        return self._generators[name]

    @cached_property
    def index(self) -> dict[str, int]:
        return {name: position for position, name in enumerate(self.names)}

    def constant(self, value: int) -> Poly:
        if self.backend == "flint":
            return self._context.constant(value)
        return self._context.domain_new(value) * self._context.one

    def terms(self, poly: Poly) -> Terms:
        """Exponents -> integer coefficient."""
        if self.backend == "flint":
            return {tuple(map(int, powers)): int(factor) for powers, factor in poly.to_dict().items()}
        return {powers: int(factor) for powers, factor in poly.items()}

    def partial(self, poly: Poly, name: str) -> Poly:
        """Derivative with respect to one generator."""
        if self.backend == "flint":
            return poly.derivative(self.index[name])
        return poly.diff(self._generators[name])


def text_of(terms: Terms) -> str:
    """Canonical text.

    `3*0^2*4 - ...` is written as terms `coefficient*generator^power` joined by `+`, highest first.
    """
    return "+".join(
        "*".join([str(terms[powers]), *(f"{i}^{e}" if e > 1 else str(i) for i, e in enumerate(powers) if e)])
        for powers in sorted(terms, reverse=True)
    )
