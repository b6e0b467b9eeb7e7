"""SymPy expressions and :class:`~derive.language.definitions.Definitions` as nodes of a tape."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable, Mapping
from fractions import Fraction
from typing import ClassVar

import sympy as sp

from derive.language.choice import excess, unit_step
from derive.language.definitions import Definitions
from derive.language.origin import ARCCOSINE, TANGENT
from derive.language.vectors import Number
from derive.program.enclosure import Enclosure
from derive.program.tape import Stage, Tape


class Lowering:
    """Writes SymPy expressions onto a tape, resolving definitions."""

    def __init__(
        self, tape: Tape, inputs: Mapping[sp.Symbol, Stage], definitions: Definitions | None = None
    ) -> None:
        self.tape = tape
        self.inputs = inputs
        self.definitions = definitions if definitions is not None else Definitions()
        self._done: dict[sp.Expr, int] = {}
        self._names: dict[int, str] = {}
        self._hashes: dict[sp.Expr, str] = {}

    def copy(self) -> Lowering:
        """The same on a copy of the tape."""
        other = Lowering(self.tape.copy(), self.inputs, self.definitions)
        other._done, other._names = dict(self._done), dict(self._names)
        return other

    def names(self) -> dict[int, str]:
        """Node → name of the definition whose value it is, for those that have been needed."""
        return self._names

    def stand(self, symbols: Iterable[sp.Symbol], nodes: Iterable[int]) -> None:
        """From now on these symbols stand for these nodes."""
        self._done.update(zip(symbols, nodes, strict=True))

    def __call__(self, expression: Number) -> int:
        """Node of an expression; its symbols are inputs, definitions or stand for nodes."""
        e = sp.sympify(expression)
        if e not in self._done:
            since = len(self.tape.nodes)
            node = self._done[e] = self.tape.means(self._lower(e), since, self._said(e))
            if isinstance(e, sp.Symbol) and e in self.definitions:
                self._names.setdefault(node, str(e))
        return self._done[e]

    def _said(self, e: sp.Expr) -> str:
        """A hash of an expression as it is written, where definitions have their names."""
        if e not in self._hashes:
            parts = sorted(map(self._said, e.args)) if isinstance(e, sp.Add | sp.Mul) else [*map(self._said, e.args)]
            text = " ".join([e.func.__name__, *parts]) if parts else str(e)
            self._hashes[e] = hashlib.sha256(text.encode()).hexdigest()
        return self._hashes[e]

    def _lower(self, e: sp.Expr) -> int:
        t = self.tape
        if isinstance(e, sp.Rational):
            return t.constant(Fraction(int(e.p), int(e.q)))
        if isinstance(e, sp.Symbol):
            if e in self.inputs:
                return t.input(e, self.inputs[e])
            if e in self.definitions:
                with t.within(self.definitions.origin(e)):
                    return self(self.definitions[e])
            raise KeyError(f"{e} is neither an input nor defined")
        if isinstance(e, sp.NumberSymbol | sp.Float):
            return t.constant(float(e), Enclosure.of_symbol(e))
        if isinstance(e, sp.Add):
            return self._sum(e.args)
        if isinstance(e, sp.Mul):
            return self._product(e)
        if isinstance(e, sp.Pow):
            return self._power(e)
        function = self._FUNCTIONS.get(e.func)
        if function is None:
            raise TypeError(f"{e.func} has no operation on the tape")
        return function(self, *map(self, e.args))

    def _sum(self, args: Iterable[sp.Expr]) -> int:
        """Sum with the earliest-bound terms first, so that they fold into one."""
        t = self.tape
        ordered = sorted(map(self, args), key=lambda i: (t.stages[i], i))
        total = ordered[0]
        for node in ordered[1:]:
            total = t.add(total, node)
        return total

    def _product(self, e: sp.Mul) -> int:
        t = self.tape
        top: list[int] = []
        bottom: list[int] = []
        for factor in e.args:
            if isinstance(factor, sp.Rational) and not isinstance(factor, sp.Integer):
                top.append(self(factor)) if factor.p != 1 and factor.p != -1 else bottom.append(t.constant(factor.q))
                if factor.p == -1:
                    top.append(t.constant(-1))
            elif isinstance(factor, sp.Pow) and isinstance(factor.exp, sp.Rational) and factor.exp < 0:
                bottom.append(self(factor.base**-factor.exp))
            else:
                top.append(self(factor))
        latest = max((t.stages[i] for i in top), default=Stage.CONSTANT)
        early = [i for i in bottom if t.stages[i] < latest]
        if early:
            top.append(t.div(t.constant(1), self._multiply(early)))
            bottom = [i for i in bottom if i not in early]
        value = self._multiply(top)
        return t.div(value, self._multiply(bottom)) if bottom else value

    def _multiply(self, nodes: Iterable[int]) -> int:
        """Product with the earliest-bound factors first, so that they fold into one."""
        t = self.tape
        ordered = sorted(nodes, key=lambda i: (t.stages[i], i))
        value = ordered[0] if ordered else t.constant(1)
        for node in ordered[1:]:
            value = t.mul(value, node)
        return value

    def _power(self, e: sp.Pow) -> int:
        base, exponent = e.base, e.exp
        if isinstance(exponent, sp.Integer):
            return self.tape.power(self(base), int(exponent))
        if isinstance(exponent, sp.Rational) and exponent.q == 2:
            return self.tape.power(self.tape.sqrt(self(base)), int(exponent.p))
        raise TypeError(f"power {exponent} has no operation on the tape")

    def _tan(self, a: int) -> int:
        with self.tape.within(TANGENT):
            return self.tape.div(self.tape.sin(a), self.tape.cos(a))

    def _atan(self, a: int) -> int:
        return self.tape.atan2(a, self.tape.constant(1))

    def _complement(self, a: int) -> int:
        """√(1 − a²) without loss near |a| = 1."""
        t, one = self.tape, self.tape.constant(1)
        with t.within(ARCCOSINE):
            return t.sqrt(t.mul(t.sub(one, a), t.add(one, a)))

    def _asin(self, a: int) -> int:
        return self.tape.atan2(a, self._complement(a))

    def _acos(self, a: int) -> int:
        return self.tape.atan2(self._complement(a), a)

    def _abs(self, a: int) -> int:
        """|a| = a·sign(a): exact, and so is its derivative, which √(a²) does not have at 0."""
        return self.tape.mul(a, self.tape.sign(a))

    def _step(self, a: int) -> int:
        t = self.tape
        return t.mul(t.constant(Fraction(1, 2)), t.add(t.constant(1), t.sign(a)))

    def _excess(self, a: int) -> int:
        return self.tape.mul(a, self._step(a))

    def _sign(self, a: int) -> int:
        return self.tape.sign(a)

    def _sin(self, a: int) -> int:
        return self.tape.sin(a)

    def _cos(self, a: int) -> int:
        return self.tape.cos(a)

    def _atan2(self, y: int, x: int) -> int:
        return self.tape.atan2(y, x)

    _FUNCTIONS: ClassVar[dict[type[sp.Expr], Callable[..., int]]] = {
        unit_step: _step,
        excess: _excess,
        sp.Abs: _abs,
        sp.sign: _sign,
        sp.sin: _sin,
        sp.cos: _cos,
        sp.tan: _tan,
        sp.atan: _atan,
        sp.asin: _asin,
        sp.acos: _acos,
        sp.atan2: _atan2,
    }
