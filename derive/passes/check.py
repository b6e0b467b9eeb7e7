"""Translation validation: every pass computes the same values before and after, modulo a random prime at random inputs.

Field operations are those of the residues; roots, sines, cosines and arcs are random functions with the symmetries that
passes use (odd, even). A wrong pass is let through with a probability of about its degree over 2^60.
"""

import random
import secrets
import weakref
from fractions import Fraction
from functools import cache

import sympy as sp

from derive.program.routine import Routine, routine
from derive.program.tape import Tape

_SOURCE = random.Random(secrets.randbits(128))


class PassError(AssertionError):
    """A pass changed what its program computes."""


@cache
def _prime():
    return sp.nextprime(secrets.randbits(60) | 1 << 60)


@cache
def _mixed(name, *values):
    """A random function: the same value for the same arguments, as long as this process lives."""
    return _SOURCE.randrange(1, _prime())


def _inverse(a):
    if not a:
        raise ZeroDivisionError("a divisor is zero modulo the prime")
    return pow(a, -1, _prime())


def _even(name, a):
    p = _prime()
    return _mixed(name, min(a % p, -a % p))


def _odd(name, a, *others):
    p = _prime()
    sign = 1 if a % p <= -a % p else -1
    return sign * _mixed(name, min(a % p, -a % p), *others) % p if a % p else 0


_APPLY = {
    "add": lambda a, b: a + b,
    "sub": lambda a, b: a - b,
    "mul": lambda a, b: a * b,
    "neg": lambda a: -a,
    "div": lambda a, b: a * _inverse(b % _prime()),
    "fma": lambda a, b, c: a * b + c,
    "fms": lambda a, b, c: a * b - c,
    "fnma": lambda a, b, c: c - a * b,
    "sin": lambda a: _odd("sin", a),
    "cos": lambda a: _even("cos", a),
    "sqrt": lambda a: _mixed("sqrt", a),
    "sign": lambda a: _odd("sign", a),
    "atan2": lambda y, x: _odd("atan2", y, x),
}


#: Of each tape the residues of its nodes that were needed so far.
_TAPES: weakref.WeakKeyDictionary[Tape, dict[int, int]] = weakref.WeakKeyDictionary()


def _residue(tape, i):
    """The residue of a node: of an input random, of a constant its own, of all else by the tape's operations."""
    values = _TAPES.setdefault(tape, {})
    if i not in values:
        for k in [*tape.needed([i], values), i]:
            node = tape.nodes[k]
            if k not in values:
                args = (values[a] if a in values else _residue(tape, a) for a in node.args)
                values[k] = _APPLY[node.op](*args) % _prime() if node.args else _leaf(tape, k)
    return values[i]


def _leaf(tape, i):
    value = tape.const_value(i)
    if value is None:
        return _SOURCE.randrange(1, _prime())
    exact = Fraction(value)
    return exact.numerator * _inverse(exact.denominator) % _prime()


def residues(program):
    """Values of a routine's outputs modulo the prime, at the inputs' random residues."""
    if "residues" not in program.found:
        program.found["residues"] = _computed(program)
    return program.found["residues"]


def _computed(program):
    p, values = _prime(), {}

    def value(i):
        if i not in values:
            if program.tape.nodes[i].args and i not in program.known:
                raise PassError(f"{program.name or 'a routine'} reads node {i} before it is computed")
            values[i] = _residue(program.tape, i)
        return values[i]

    for i, step in program.steps:
        values[i] = _APPLY[step.op](*map(value, step.args)) % p
    return [value(i) % p for i in program.outputs]


def same(name: str, before: Routine, after: Routine) -> Routine:
    """``after``, which must compute what ``before`` does; raises :class:`PassError` with the pass's name."""
    if before.outputs != after.outputs or residues(before) != residues(after):
        raise PassError(f"{name}: {before.name or 'a routine'} computes other values after it than before")
    return after


def solves(name, tape, matrix, change, right):
    """Raises :class:`PassError` unless matrix · change = right, of nodes."""
    flat = [entry for row in matrix for entry in row]
    numbers = residues(routine(tape, [*flat, *change, *right]))
    changes, wanted = numbers[len(flat) : len(flat) + len(change)], numbers[len(flat) + len(change) :]
    for k, value in enumerate(wanted):
        row = numbers[k * len(change) : (k + 1) * len(change)]
        if (sum(a * b for a, b in zip(row, changes, strict=True)) - value) % _prime():
            raise PassError(f"{name}: equation {k} is not solved")


def derives(name, tape, values, inputs, slopes):
    """Raises :class:`PassError` unless ``slopes`` [i][j] are the derivatives of ``values`` [i] by ``inputs`` [j]."""
    p = _prime()
    flat = [s for row in slopes for s in row]
    found = residues(routine(tape, flat))
    for j, variable in enumerate(inputs):
        rates = _rates(tape, values, variable)
        for i, rate in enumerate(rates):
            if (found[i * len(inputs) + j] - rate) % p:
                raise PassError(f"{name}: entry {i}, {j} is not the derivative")


def _rates(tape, outputs, variable):
    """∂outputs/∂variable modulo the prime, by the chain rule on residues."""
    p, value, rate = _prime(), {}, {variable: 1}

    def at(i):
        if i not in value:
            value[i] = _residue(tape, i)
        return value[i], rate.get(i, 0)

    for i in tape.needed(outputs):
        node = tape.nodes[i]
        (a, da), (b, db) = at(node.args[0]), at(node.args[-1])
        value[i] = v = _APPLY[node.op](*([a] if len(node.args) == 1 else [a, b])) % p
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
                rate[i] = _APPLY["cos"](a) * da
            case "cos":
                rate[i] = -_APPLY["sin"](a) * da
            case "atan2":
                rate[i] = (b * da - a * db) * _inverse((a * a + b * b) % p) if da or db else 0
            case "sign":
                rate[i] = 0
        rate[i] %= p
    return [rate.get(i, 0) for i in outputs]
