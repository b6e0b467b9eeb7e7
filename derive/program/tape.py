"""The intermediate form: a straight-line program with value numbering and a forward chain rule.

A :class:`Tape` is a list of nodes in which each value occurs once. Every printer reads the same tape. Nodes are
numbered in the order in which they are first needed, so that the same drive gives the same text on every machine.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Collection, Generator, Iterable, Mapping, Sequence
from contextlib import contextmanager
from copy import copy
from enum import IntEnum
from fractions import Fraction
from typing import Any, NamedTuple

import sympy as sp

from derive.language.origin import PARTIAL, Origin
from derive.program.enclosure import Enclosure

Exact = Fraction | int | float
"""What a constant of a tape is: exact where rational, else a float."""


class Stage(IntEnum):
    """Binding time of a value: when the earliest input it depends on is known."""

    CONSTANT = 0
    DESIGN = 1
    INSTANT = 2
    ITERATE = 3


class Node(NamedTuple):
    """One operation. ``value`` is the constant or the symbol of a leaf."""

    op: str
    args: tuple[int, ...] = ()
    value: Any = None


#: Operations whose arguments may change places.
COMMUTATIVE = {"add", "mul"}

#: Operations by name: how many arguments each takes.
OPERATIONS = {"add": 2, "sub": 2, "mul": 2, "div": 2, "neg": 1, "sqrt": 1, "sin": 1, "cos": 1, "atan2": 2, "sign": 1}


class Tape:
    """A growing straight-line program. Values are referred to by index.

    ``origins`` holds the :class:`~derive.language.origin.Origin` of every operation that is not defined everywhere,
    ``meanings`` what is known of a node beside how it is computed (:meth:`means`).
    """

    def __init__(self) -> None:
        self.nodes: list[Node] = []
        self.arguments: list[tuple[int, ...]] = []
        self.origins: dict[int, Origin] = {}
        self.meanings: dict[int, tuple[int | str, ...]] = {}
        self._within: Origin | None = None
        self.stages: list[Stage] = []
        self._index: dict[tuple[str, tuple[int, ...], object], int] = {}
        self._constants: dict[Exact, int] = {}
        self._exact: dict[int, Exact] = {}
        self._enclosures: dict[int, Enclosure] = {}
        self._derivatives: dict[int, dict[int, int]] = {}
        self._inputs: dict[int, int] = {}
        self._reads: list[int] = []

    def copy(self) -> Tape:
        """A tape with the same values under the same numbers, which grows by itself."""
        other = Tape()
        vars(other).update((name, copy(part)) for name, part in vars(self).items())
        other._derivatives = {}
        return other

    # -- building ---------------------------------------------------------------------------------------------

    @contextmanager
    def within(self, origin: Origin | None) -> Generator[None]:
        """New partial operations are of this :class:`~derive.language.origin.Origin`; None: each of its own kind."""
        before, self._within = self._within, origin
        yield
        self._within = before

    def means(self, i: int, since: int, *what: int | str) -> int:
        """Say what an operation is, in words and nodes, if it is new since there were ``since`` nodes; returns it.

        Of an operation and its negative, of which a tape may read either, one meaning is that of the other.
        """
        if i >= since and self.arguments[i]:
            self.meanings.setdefault(i, what)
            if (inner := self._negated(i)) is not None and inner >= since and self.arguments[inner]:
                self.meanings.setdefault(inner, ("minus", *what))
        return i

    def _new(self, op: str, args: tuple[int, ...] = (), value: object = None, stage: Stage | None = None) -> int:
        if op in COMMUTATIVE and args[0] > args[1]:
            args = args[1], args[0]
        key = (op, args, value)
        i = self._index.get(key)
        if i is None:
            i = self._index[key] = len(self.nodes)
            self.nodes.append(Node(*key))
            self.arguments.append(args)
            stages = self.stages
            stages.append(max(stages[args[0]], stages[args[-1]]) if args else stage or Stage.CONSTANT)
            if op in PARTIAL:
                self.origins[i] = self._within or PARTIAL[op]
        return i

    def constant(self, value: Exact, bounds: Enclosure | None = None) -> int:
        """A constant: exact where rational, else a float that stands for the number within ``bounds``, an
        :class:`~derive.program.enclosure.Enclosure`; without them for itself.
        """
        known = self._constants.get(value)
        if known is None:
            exact = Fraction(value) if isinstance(value, int) else value
            i = self._constants[value] = self._new("const", value=exact)
            self._exact[i] = exact
        else:
            i = known
        if bounds is not None and bounds != Enclosure.of(value):
            if value in (0, 1, -1):
                raise ValueError(f"a constant that is not {value} would be taken for it")
            before = None if known is None else self.enclosure(i)
            self._enclosures[i] = bounds if before is None else bounds.hull(before)
        return i

    def enclosure(self, i: int) -> Enclosure | None:
        """What a constant stands for, an :class:`~derive.program.enclosure.Enclosure`; None if the node is none."""
        if i in self._enclosures:
            return self._enclosures[i]
        return Enclosure.of(self._exact[i]) if i in self._exact else None

    def _folded(self, apply: Callable[..., Any], *args: int) -> int:
        """The constant ``apply`` makes of constants."""
        value = apply(*[self._exact[a] for a in args])
        if not any(a in self._enclosures for a in args) and isinstance(value, Fraction | int):
            return self.constant(value)
        return self.constant(value, apply(*map(self.enclosure, args)))

    def input(self, symbol: sp.Symbol, stage: Stage) -> int:
        """An input that becomes known at ``stage``."""
        return self._new("input", value=symbol, stage=stage)

    def const_value(self, i: int) -> Exact | None:
        """The constant at a node, or None."""
        return self._exact.get(i)

    def find(self, op: str, *args: int) -> int | None:
        """The node of this operation, or None if the tape does not have it."""
        return self._index.get((op, args, None))

    def _negated(self, i: int) -> int | None:
        """The argument if the node is a negation."""
        return self.arguments[i][0] if self.nodes[i].op == "neg" else None

    def neg(self, a: int) -> int:
        if self.const_value(a) is not None:
            return self._folded(operator.neg, a)
        if (inner := self._negated(a)) is not None:
            return inner
        return self._new("neg", (a,))

    def add(self, a: int, b: int) -> int:
        p, q = self._exact.get(a), self._exact.get(b)
        if p is not None and q is not None:
            return self._folded(operator.add, a, b)
        if p == 0:
            return b
        if q == 0:
            return a
        if (inner := self._negated(b)) is not None:
            return self.sub(a, inner)
        if (inner := self._negated(a)) is not None:
            return self.sub(b, inner)
        return self._new("add", (a, b))

    def sub(self, a: int, b: int) -> int:
        p, q = self._exact.get(a), self._exact.get(b)
        if p is not None and q is not None:
            return self._folded(operator.sub, a, b)
        if a == b:
            return self.constant(0)
        if q == 0:
            return a
        if p == 0:
            return self.neg(b)
        if (inner := self._negated(b)) is not None:
            return self.add(a, inner)
        if (inner := self._negated(a)) is not None:
            return self.neg(self.add(inner, b))
        if (opposite := self.find("sub", b, a)) is not None:
            return self.neg(opposite)
        return self._new("sub", (a, b))

    def mul(self, a: int, b: int) -> int:
        p, q = self._exact.get(a), self._exact.get(b)
        if p is not None and q is not None:
            return self._folded(operator.mul, a, b)
        if p is not None:
            a, b, p, q = b, a, q, p
        if q == 0:
            return b
        if q == 1:
            return a
        if q == -1:
            return self.neg(a)
        if (inner := self._negated(a)) is not None:
            return self.neg(self.mul(inner, b))
        if (inner := self._negated(b)) is not None:
            return self.neg(self.mul(a, inner))
        if self.stages[a] > self.stages[b]:
            a, b = b, a
        if (split := self._early_factor(b)) is not None and self.stages[a] < self.stages[b]:
            early, late = split
            return self.mul(self.mul(a, early), late)
        return self._new("mul", (a, b))

    def _early_factor(self, i: int) -> tuple[int, int] | None:
        """(early, late) if the node is the product of an early-bound value and a later one."""
        node = self.nodes[i]
        if node.op != "mul":
            return None
        early, late = sorted(node.args, key=self.stages.__getitem__)
        return (early, late) if self.stages[early] < self.stages[late] else None

    def div(self, a: int, b: int) -> int:
        p, q = self._exact.get(a), self._exact.get(b)
        if p is not None and q is not None and isinstance(p, Fraction) and isinstance(q, Fraction):
            return self.constant(p / q)
        if p == 0:
            return a
        if q is not None and abs(q) == 1:
            return self.mul(a, b)
        if a == b:
            return self.constant(1)
        if (inner := self._negated(a)) is not None:
            return self.neg(self.div(inner, b))
        if (inner := self._negated(b)) is not None:
            return self.neg(self.div(a, inner))
        if self.stages[b] < self.stages[a]:
            return self.mul(a, self.div(self.constant(1), b))
        return self._new("div", (a, b))

    def sqrt(self, a: int) -> int:
        if (value := self.const_value(a)) is not None and value >= 0:
            root = math.isqrt(int(value))
            if root**2 == value:
                return self.constant(root)
            bounds = self.enclosure(a)
            return self.constant(math.sqrt(value), bounds and bounds.sqrt())
        return self._new("sqrt", (a,))

    def sin(self, a: int) -> int:
        if self.const_value(a) == 0:
            return a
        if (inner := self._negated(a)) is not None:
            return self.neg(self.sin(inner))
        return self._new("sin", (a,))

    def cos(self, a: int) -> int:
        if self.const_value(a) == 0:
            return self.constant(1)
        if (inner := self._negated(a)) is not None:
            return self.cos(inner)
        return self._new("cos", (a,))

    def atan2(self, y: int, x: int) -> int:
        return self._new("atan2", (y, x))

    def sign(self, a: int) -> int:
        """−1 below 0, else 1."""
        if (value := self.const_value(a)) is not None:
            return self.constant(-1 if value < 0 else 1)
        if (inner := self._negated(a)) is not None:
            return self.neg(self.sign(inner))
        return self._new("sign", (a,))

    def power(self, a: int, n: int) -> int:
        """Integer power by repeated squaring; negative powers divide."""
        if n < 0:
            return self.div(self.constant(1), self.power(a, -n))
        result, square = None, a
        while n:
            if n & 1:
                result = square if result is None else self.mul(result, square)
            n >>= 1
            if n:
                square = self.mul(square, square)
        return self.constant(1) if result is None else result

    def triple(self, a: Sequence[int], b: Sequence[int], c: Sequence[int]) -> int:
        """a · (b × c) of three vectors of nodes."""
        cross = [self.sub(self.mul(b[i], c[j]), self.mul(b[j], c[i])) for i, j in ((1, 2), (2, 0), (0, 1))]
        total = self.mul(a[0], cross[0])
        for i in (1, 2):
            total = self.add(total, self.mul(a[i], cross[i]))
        return total

    # -- differentiation --------------------------------------------------------------------------------------

    def derivative(self, i: int, variable: int) -> int:
        """Node of ∂(node i)/∂(input node ``variable``), by the forward chain rule."""
        reads, arguments = self._inputs_read(), self.arguments
        own = self._inputs.get(variable, 0)
        known = self._derivatives.setdefault(variable, {})
        stack, since = [i], len(self.nodes)
        while stack:
            top = stack[-1]
            if top in known:
                stack.pop()
            elif not reads[top] & own:
                known[top] = self.constant(0)
            elif missing := [a for a in arguments[top] if a not in known]:
                stack.extend(missing)
            else:
                args = arguments[top]
                slope = self.rule(top, [known[a] for a in args]) if args else self.constant(1)
                known[top] = self.means(slope, since, "slope", top, variable)
        return known[i]

    def _inputs_read(self) -> list[int]:
        """For each node the inputs behind it: a bit for each, that which ``_inputs`` gives it."""
        reads = self._reads
        for i in range(len(reads), len(self.nodes)):
            own = 0
            for a in self.arguments[i]:
                own |= reads[a]
            if self.nodes[i].op == "input":
                own = self._inputs[i] = 1 << len(self._inputs)
            reads.append(own)
        return reads

    def rule(self, i: int, d: Sequence[int]) -> int:
        """The chain rule at one node, given the derivatives of its arguments."""
        zero = self._constants.get(0)
        if zero is not None and d.count(zero) == len(d):
            return zero
        if i not in self.origins:
            return self._chain(i, d)
        with self.within(self.origins[i]):
            return self._chain(i, d)

    def _chain(self, i: int, d: Sequence[int]) -> int:
        node = self.nodes[i]
        a, b = node.args[0], node.args[-1]
        match node.op:
            case "add":
                return self.add(*d)
            case "sub":
                return self.sub(*d)
            case "mul":
                return self.add(self.mul(d[0], b), self.mul(a, d[1]))
            case "div":
                reciprocal = self.div(self.constant(1), b)
                return self.mul(self.sub(d[0], self.mul(i, d[1])), reciprocal)
            case "neg":
                return self.neg(d[0])
            case "sqrt":
                return self.mul(self.div(self.constant(Fraction(1, 2)), i), d[0])
            case "sin":
                return self.mul(self.cos(a), d[0])
            case "cos":
                return self.neg(self.mul(self.sin(a), d[0]))
            case "sign":
                return self.constant(0)
            case "atan2":
                square = self.add(self.mul(a, a), self.mul(b, b))
                return self.div(self.sub(self.mul(b, d[0]), self.mul(a, d[1])), square)
            case _:
                raise AssertionError(node.op)

    def substitute(self, i: int, replacement: Mapping[int, int]) -> int:
        """The node with inputs replaced by other nodes (``replacement``: index → index)."""
        done, since = dict(replacement), len(self.nodes)
        where = [node for pair in sorted(replacement.items()) for node in pair]
        for k in [*self.needed([i], done), i]:
            node = self.nodes[k]
            if k not in done:
                args = [done.get(a, a) for a in node.args]
                with self.within(self.origins.get(k)):
                    there = getattr(self, node.op)(*args) if args else k
                done[k] = self.means(there, since, "where", *where, "is", k)
        return done[i]

    # -- reading ----------------------------------------------------------------------------------------------

    def needed(
        self,
        outputs: Iterable[int],
        known: Iterable[int] = frozenset(),
        instead: Mapping[int, tuple[int, ...]] | None = None,
    ) -> list[int]:
        """Indices of the operations behind ``outputs`` in an order of evaluation, stopping at ``known``.

        ``instead`` holds the arguments of nodes that are computed from others than their own.
        """
        arguments, seen = self.arguments, set(known)
        if instead:
            arguments = [*arguments]
            for i, args in instead.items():
                arguments[i] = args
        order: list[int] = []
        stack = [*outputs][::-1]  # of nodes to visit; ~i: the arguments of i are done
        pop, push, done, see = stack.pop, stack.append, order.append, seen.add
        while stack:
            i = pop()
            if i < 0:
                done(~i)
                continue
            while i not in seen:
                see(i)
                args = arguments[i]
                if not args:
                    break
                push(~i)
                i = args[0]  # on to the first argument at once; the last waits
                if args[-1] not in seen:
                    push(args[-1])
        return order

    def inputs_of(self, outputs: Collection[int]) -> set[sp.Symbol]:
        """Symbols of the inputs that ``outputs`` depend on."""
        read = {a for i in self.needed(outputs) for a in self.nodes[i].args} | set(outputs)
        return {self.nodes[i].value for i in read if self.nodes[i].op == "input"}

    def _pair(self, i: int) -> tuple[int, int | None]:
        """The arguments of an operation; None for a second one that it does not take."""
        args = self.arguments[i]
        return args[0], args[1] if len(args) == 2 else None

    def evaluate(
        self,
        outputs: Collection[int],
        inputs: Mapping[sp.Symbol, Any],
        arithmetic: Any = math,  # noqa: ANN401  a module or alike
    ) -> list[Any]:
        """Values of ``outputs`` for ``inputs`` (symbol → number): see :meth:`evaluator`."""
        return self.evaluator(outputs, arithmetic)(inputs)

    def evaluator(
        self,
        outputs: Collection[int],
        arithmetic: Any = math,  # noqa: ANN401  a module or alike
    ) -> Callable[[Mapping[sp.Symbol, Any]], list[Any]]:
        """Function: inputs (symbol → number) → values of ``outputs``, in any arithmetic that has the functions.

        ``arithmetic`` is :mod:`math`, :mod:`mpmath` or alike: it supplies sqrt, sin, cos, atan2 and, where numbers
        have no operators or faster functions, add, sub, mul, div, neg. Constants have the precision of the moment.
        """
        order = self.needed(outputs)
        leaves = dict.fromkeys(a for i in order for a in self.nodes[i].args) | dict.fromkeys(outputs)
        symbols = {i: self.nodes[i].value for i in leaves if self.nodes[i].op == "input"}
        make = getattr(arithmetic, "mpf", float)
        constants = {i: _number(self._exact[i], make) for i in leaves if i in self._exact}
        apply = {op: getattr(arithmetic, op, None) or _ALGEBRA[op] for op in {self.nodes[i].op for i in order}}
        steps = [(i, apply[self.nodes[i].op], *self._pair(i)) for i in order]

        def run(inputs: Mapping[sp.Symbol, Any]) -> list[Any]:
            values = dict(constants)
            for i, symbol in symbols.items():
                values[i] = inputs[symbol]
            for i, operation, a, b in steps:
                values[i] = operation(values[a]) if b is None else operation(values[a], values[b])
            return [values[i] for i in outputs]

        return run


def _number(exact: Exact, make: Callable[[Any], Any]) -> Any:  # noqa: ANN401  of any arithmetic
    return make(exact.numerator) / exact.denominator if isinstance(exact, Fraction) else make(exact)


def _quotient(a: Any, b: Any) -> Any:  # noqa: ANN401  of any arithmetic
    return a / b


def _sign(a: Any) -> int:  # noqa: ANN401  of any arithmetic
    return -1 if a < 0 else 1


_ALGEBRA: dict[str, Callable[..., Any]] = {
    "add": operator.add,
    "sub": operator.sub,
    "mul": operator.mul,
    "div": _quotient,
    "neg": operator.neg,
    "sign": _sign,
}
