"""Translation validation: every pass computes the same values before and after, modulo a random prime at random inputs.

Field operations are those of the residues; roots, sines, cosines and arcs are random functions with the symmetries that
passes use (odd, even). What is a derivative by √a·√a = a or by sin² + cos² = 1 alone is seen where roots are those of
the residues, at inputs at which all of them exist, and angles have random points of the circle. A wrong pass is let
through with a probability of about its degree over 2^60. Of a new order, it is enough that the same operations come
after their arguments.
"""

import operator
import random
import secrets
import weakref
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from fractions import Fraction
from functools import cache, partial
from typing import Any

import sympy as sp

from derive.program.routine import Routine, routine
from derive.program.tape import Stage, Tape

_SOURCE = random.Random(secrets.randbits(128))

#: Inputs that may be drawn until every radicand is a square, and those at which a derivative may differ before it is
#: held to be none: that of √(a²) is one at half of all inputs, of which root is taken.
DRAWS, REFUSALS = 4000, 24


class PassError(AssertionError):
    """A pass changed what its program computes."""


class NoRoot(ArithmeticError):
    """A radicand is no square modulo the prime: other inputs have to be drawn."""


@cache
def _prime() -> int:
    """3 modulo 4: then −1 is no square, and the root of a square is a power of it."""
    prime = sp.nextprime(secrets.randbits(60) | 1 << 60)
    while prime % 4 != 3:
        prime = sp.nextprime(prime)
    return prime


@cache
def _mixed(name: str, *values: int) -> int:
    """A random function: the same value for the same arguments, as long as this process lives."""
    return _SOURCE.randrange(1, _prime())


def _inverse(a: int) -> int:
    if not a:
        raise ZeroDivisionError("a divisor is zero modulo the prime")
    return pow(a, -1, _prime())


def _odd(name: str, a: int, *others: int) -> int:
    p = _prime()
    sign = 1 if a % p <= -a % p else -1
    return sign * _mixed(name, min(a % p, -a % p), *others) % p if a % p else 0


def _even(name: str, a: int) -> int:
    p = _prime()
    return _mixed(name, min(a % p, -a % p))


def _circle(a: int) -> tuple[int, int]:
    """Cosine and sine of the angle: (1 − t², 2t) / (1 + t²) for a random t that is odd in it."""
    p = _prime()
    t = _odd("tangent of half an angle", a)
    below = _inverse((1 + t * t) % p)
    return (1 - t * t) * below % p, 2 * t * below % p


def _root(a: int) -> int:
    p = _prime()
    root = pow(a, (p + 1) // 4, p)
    if (root * root - a) % p:
        raise NoRoot
    return root


def _cos(a: int) -> int:
    return _circle(a)[0]


def _sin(a: int) -> int:
    return _circle(a)[1]


def _quotient(a: int, b: int) -> int:
    return a * _inverse(b % _prime())


def _fma(a: int, b: int, c: int) -> int:
    return a * b + c


def _fms(a: int, b: int, c: int) -> int:
    return a * b - c


def _fnma(a: int, b: int, c: int) -> int:
    return c - a * b


_APPLY: dict[str, Callable[..., Any]] = {
    "add": operator.add,
    "sub": operator.sub,
    "mul": operator.mul,
    "neg": operator.neg,
    "div": _quotient,
    "fma": _fma,
    "fms": _fms,
    "fnma": _fnma,
    "sin": partial(_odd, "sin"),
    "cos": partial(_even, "cos"),
    "sqrt": partial(_mixed, "sqrt"),
    "sign": partial(_odd, "sign"),
    "atan2": partial(_odd, "atan2"),
}


#: The same with the identities of roots and of sine and cosine.
_IDENTICAL: dict[str, Callable[..., Any]] = {**_APPLY, "sqrt": _root, "cos": _cos, "sin": _sin}

#: Of each tape the residues of its nodes that were needed so far.
_TAPES: weakref.WeakKeyDictionary[Tape, dict[int, int]] = weakref.WeakKeyDictionary()


class _Draw:
    """Residues of a tape's nodes: of an input random, of a constant its own, of all else by the tape's operations."""

    def __init__(self, tape: Tape, values: dict[int, int], apply: Mapping[str, Callable[..., Any]]) -> None:
        self.tape, self.values, self.apply = tape, values, apply

    def __call__(self, i: int) -> int:
        tape, values = self.tape, self.values
        if i not in values:
            at_hand = all(a in values for a in tape.arguments[i])
            for k in [i] if at_hand else tape.needed([i], values):
                node = tape.nodes[k]
                args = (values[a] if a in values else self(a) for a in node.args)
                values[k] = self.apply[node.op](*args) % _prime() if node.args else _leaf(tape, k)
        return values[i]


def _residue(tape: Tape, i: int) -> int:
    """The residue of a node with any functions, at the tape's own inputs."""
    return _Draw(tape, _TAPES.setdefault(tape, {}), _APPLY)(i)


def _leaf(tape: Tape, i: int) -> int:
    value = tape.const_value(i)
    if value is None:
        return _SOURCE.randrange(1, _prime())
    exact = Fraction(value)
    return exact.numerator * _inverse(exact.denominator) % _prime()


def residues(program: Routine) -> list[int]:
    """Values of a routine's outputs modulo the prime, at the inputs' random residues."""
    if "residues" not in program.found:
        program.found["residues"] = _computed(program)
    return program.found["residues"]


def _computed(program: Routine) -> list[int]:
    p, values = _prime(), _Values(program)
    value = values.__getitem__
    for i, (op, args, _) in program.steps:
        values[i] = _APPLY[op](*map(value, args)) % p
    return [value(i) % p for i in program.outputs]


class _Values(dict[int, int]):
    """Residues of what a routine has computed so far, and of the nodes that it reads."""

    def __init__(self, program: Routine) -> None:
        super().__init__()
        self._program = program

    def __missing__(self, i: int) -> int:
        program = self._program
        if program.tape.nodes[i].args and i not in program.known:
            raise PassError(f"{program.name or 'a routine'} reads node {i} before it is computed")
        self[i] = value = _residue(program.tape, i)
        return value


def same(name: str, before: Routine, after: Routine) -> Routine:
    """``after``, which must compute what ``before`` does; raises :class:`PassError` with the pass's name."""
    if before.outputs != after.outputs or residues(before) != residues(after):
        raise PassError(f"{name}: {before.name or 'a routine'} computes other values after it than before")
    return after


def reordered(name: str, before: Routine, after: Routine) -> Routine:
    """``after``, which must have the operations of ``before``, each after its arguments, and so computes the same."""
    coming = dict(after.steps)
    if len(coming) != len(after.steps) or coming != dict(before.steps) or before.outputs != after.outputs:
        raise PassError(f"{name}: {before.name or 'a routine'} has other operations after it than before")
    for i, (_, args, _) in after.steps:
        for a in args:
            if a in coming:
                raise PassError(f"{name}: {before.name or 'a routine'} reads node {a} before it is computed")
        del coming[i]
    return after


def solves(
    name: str, tape: Tape, matrix: Sequence[Sequence[int]], change: Sequence[int], right: Sequence[int]
) -> None:
    """Raises :class:`PassError` unless matrix · change = right, of nodes."""
    flat = [entry for row in matrix for entry in row]
    numbers = residues(routine(tape, [*flat, *change, *right]))
    changes, wanted = numbers[len(flat) : len(flat) + len(change)], numbers[len(flat) + len(change) :]
    for k, value in enumerate(wanted):
        row = numbers[k * len(change) : (k + 1) * len(change)]
        if (sum(a * b for a, b in zip(row, changes, strict=True)) - value) % _prime():
            raise PassError(f"{name}: equation {k} is not solved")


def bound(name: str, tape: Tape, outputs: Iterable[int], known: Iterable[int], stages: Collection[Stage]) -> None:
    """Raises :class:`PassError` unless what is computed from ``known`` on for ``outputs`` has these binding times."""
    for i in tape.needed(outputs, known):
        if tape.stages[i] not in stages and tape.stages[i] != Stage.CONSTANT:
            raise PassError(f"binding times: {name} computes node {i}, which is of the {tape.stages[i].name.lower()}")


def derives(
    name: str, tape: Tape, values: Sequence[int], inputs: Sequence[int], slopes: Sequence[Sequence[int]]
) -> None:
    """Raises :class:`PassError` unless ``slopes`` [i][j] are the derivatives of ``values`` [i] by ``inputs`` [j]."""
    wrong = _wrong_slope(_Draw(tape, _TAPES.setdefault(tape, {}), _APPLY), values, inputs, slopes)
    if wrong and not _derives_identically(tape, values, inputs, slopes):
        raise PassError(f"{name}: entry {wrong[0]}, {wrong[1]} is not the derivative")


def _derives_identically(
    tape: Tape, values: Sequence[int], inputs: Sequence[int], slopes: Sequence[Sequence[int]]
) -> bool:
    """Whether the slopes are the derivatives at some input at which every root exists; wrong ones are so at none."""
    return _holds_somewhere(tape, lambda draw: not _wrong_slope(draw, values, inputs, slopes))


def equal(tape: Tape, one: int, other: int) -> bool:
    """Whether two nodes have one value."""

    def agree(draw: _Draw) -> bool:
        return (draw(one) - draw(other)) % _prime() == 0

    return agree(_Draw(tape, _TAPES.setdefault(tape, {}), _APPLY)) or _holds_somewhere(tape, agree)


def _holds_somewhere(tape: Tape, holds: Callable[[_Draw], bool]) -> bool:
    """Whether something holds at some input at which every root exists, with the identities of roots and angles."""
    refusals = 0
    for _ in range(DRAWS):
        try:
            if holds(_Draw(tape, {}, _IDENTICAL)):
                return True
        except ArithmeticError:  # no root, or a divisor that is zero
            continue
        refusals += 1
        if refusals == REFUSALS:
            break
    return False


def _wrong_slope(
    draw: _Draw, values: Sequence[int], inputs: Sequence[int], slopes: Sequence[Sequence[int]]
) -> tuple[int, int] | None:
    """The first entry that is not the derivative, None if there is none."""
    found = [[draw(s) for s in row] for row in slopes]
    for j, variable in enumerate(inputs):
        for i, rate in enumerate(_rates(draw, values, {variable: 1})):
            if (found[i][j] - rate) % _prime():
                return i, j
    return None


def moves(
    name: str, tape: Tape, values: Sequence[int], seeds: Mapping[int, int], tangents: Sequence[int]
) -> None:
    """Raises :class:`PassError` unless ``tangents`` are how ``values`` change if inputs do by their ``seeds``."""
    draw = _Draw(tape, _TAPES.setdefault(tape, {}), _APPLY)
    rates = _rates(draw, values, {i: draw(seed) for i, seed in seeds.items()})
    for i, (tangent, rate) in enumerate(zip(tangents, rates, strict=True)):
        if (draw(tangent) - rate) % _prime():
            raise PassError(f"{name}: entry {i} is not the derivative along the direction")


def _rates(draw: _Draw, outputs: Sequence[int], changes: Mapping[int, int]) -> list[int]:
    """Changes of the outputs for ``changes`` of inputs modulo the prime, by the chain rule on residues."""
    p, rate, tape = _prime(), dict(changes), draw.tape

    def at(i: int) -> tuple[int, int]:
        return draw(i), rate.get(i, 0)

    for i in tape.needed(outputs):
        node = tape.nodes[i]
        (a, da), (b, db), v = at(node.args[0]), at(node.args[-1]), draw(i)
        match node.op:
            case "add" | "sub":
                rate[i] = da + db if node.op == "add" else da - db
            case "mul":
                rate[i] = da * b + a * db
            case "div":
                rate[i] = (da - v * db) * _inverse(b) if da or db else 0
            case "neg":
                rate[i] = -da
            case "sqrt":
                rate[i] = da * _inverse(2 * v % p)
            case "sin":
                rate[i] = draw.apply["cos"](a) * da
            case "cos":
                rate[i] = -draw.apply["sin"](a) * da
            case "atan2":
                rate[i] = (b * da - a * db) * _inverse((a * a + b * b) % p) if da or db else 0
            case _:  # a sign
                rate[i] = 0
        rate[i] %= p
    return [rate.get(i, 0) for i in outputs]
