"""A small Newton iteration on the tape itself, used at generation time only: sample solutions and self-tests."""

import math
import sys
from collections.abc import Callable, Generator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any, TypeAlias, TypeVar

import mpmath
import sympy as sp

from derive.language.drive import PATH, Drive
from derive.language.refusal import DescriptionError
from derive.language.symbols import Table
from derive.language.validate_sample import validate_sample
from derive.passes.completion import SystemTape, lower_system
from derive.passes.plan import Derived, Observed
from derive.program.lowering import Lowering
from derive.program.tape import Stage, Tape

#: Inputs and their numbers, of many digits or floats.
Values: TypeAlias = dict[sp.Symbol, Any]

#: :mod:`math` or :mod:`mpmath`, whose functions take and give those numbers.
Arithmetic: TypeAlias = Any

#: What a matrix consists of.
Real = TypeVar("Real", float, mpmath.mpf)

#: Digits of the arithmetic: enough that the result is exact to double precision.
DIGITS = 40

#: How far beside a solution a self-test starts, in natural sizes: far enough for several steps, near enough that none
#: of them is cut short. Exact in binary.
BESIDE = 1.0 / 64.0

#: Steps in which the path of a design system is followed.
PATH_STEPS = 16

#: Newton's last change on the way, and where doubles have found a solution: what is left of the error is its square.
ON_PATH, FOUND = 1e-4, 1e-8

#: What helps where a sample has no contact.
_OTHER = "choose another sample design"


class NoSample(DescriptionError, ArithmeticError):
    """A sample design without a contact at its angle, as far as Newton's method finds it."""


class Completion:
    """What completes the designs of a drive: its rules and its design systems, on tapes."""

    def __init__(self, drive: Drive, systems: Sequence[SystemTape] | None = None) -> None:
        """``systems`` are the drive's design systems where they are on tapes already."""
        lower = Lowering(Tape(), {p.symbol: Stage.DESIGN for p in drive.parameters}, drive.definitions)
        self._parameters = drive.parameters
        self._rules = [(rule.target, lower.tape, lower(rule.value)) for rule in drive.rules]
        self._systems = [lower_system(s, drive.parameters) for s in drive.systems] if systems is None else systems

    def __call__(self, design: Mapping[str, float | int | str], arithmetic: Arithmetic = mpmath) -> Values:
        """Parameter values by symbol for a ``design`` (key → number), complete; parameters left open are NaN."""
        number = real(arithmetic)
        values: Values = {p.symbol: number(math.nan) for p in self._parameters}
        for p in self._parameters:
            key = p.key if p.table == Table.FLANK else p.place
            if key in design:
                values[p.symbol] = number(p.factor.evalf(DIGITS)) * number(design[key])
            elif p.default is not None:
                values[p.symbol] = number(p.default.evalf(DIGITS))
        self._apply_rules(values, arithmetic)
        for system in self._systems:
            _complete(system, values, arithmetic)
            self._apply_rules(values, arithmetic)
        return values

    def _apply_rules(self, values: Values, arithmetic: Arithmetic) -> None:
        for target, tape, node in self._rules:
            if arithmetic.isnan(values[target]):
                (values[target],) = _numbers(f"the rule for {target}", tape.evaluator([node], arithmetic), values)


def sample_parameters(drive: Drive, systems: Sequence[SystemTape] | None = None) -> Values:
    """The drive's sample design as parameter values by symbol: see :class:`Completion`."""
    return Completion(drive, systems)(drive.sample)


def _complete(plan: SystemTape, values: Values, arithmetic: Arithmetic) -> None:
    """Fill in what a design system gives, following its path in equal steps and exactly only at its end."""
    unknowns = plan.unknowns
    name = f"the design system {plan.system.name}"
    equations = Equations(plan.tape, plan.residual, plan.jacobian, unknowns, name)
    near: Values = in_double(values)
    near.update(zip(unknowns, _numbers(name, plan.tape.evaluator(plan.guess, math), near), strict=True))
    for step in range(PATH_STEPS):
        near[PATH] = step / PATH_STEPS
        equations.newton(near, math, ON_PATH)
    number = real(arithmetic)
    inputs = values | {PATH: number(1)} | {symbol: number(near[symbol]) for symbol in unknowns}
    equations.solve(inputs, arithmetic)
    filled = _numbers(name, plan.tape.evaluator(plan.values, arithmetic), inputs)
    for target, value in zip(plan.system.fills, filled, strict=True):
        if arithmetic.isnan(values[target]):
            values[target] = value


def sample_contact(plan: Derived) -> Values:
    """Inputs (symbol → number) at a solved contact of the sample design."""
    with mpmath.workdps(DIGITS), _of(plan.drive):
        parameters = sample_parameters(plan.drive, plan.systems)
        validate_sample(plan.drive, parameters)
        return solve(plan, parameters, plan.drive.sample_angle)


@contextmanager
def _of(drive: Drive) -> Generator[None]:
    """An error says whose sample it is."""
    try:
        yield
    except NoSample as error:
        raise NoSample(f"{drive.name}: {error}") from error


def observation(plan: Observed) -> dict[str, list[mpmath.mpf]]:
    """What is observed of the sample's contact: name → numbers; "not a number" is what has no real value there, as a
    limit that is not applied.
    """
    nodes = [i for output in plan.observed for i in output.nodes]
    with mpmath.workdps(DIGITS):
        try:
            numbers = iter(_numbers("the contact", plan.tape.evaluator(nodes, mpmath), plan.sample))
            return {output.name: [next(numbers) for _ in output.nodes] for output in plan.observed}
        except NoSample:
            return {output.name: [_value(plan, i) for i in output.nodes] for output in plan.observed}


def _value(plan: Observed, node: int) -> mpmath.mpf:
    try:
        return _numbers("the contact", plan.tape.evaluator([node], mpmath), plan.sample)[0]
    except NoSample:
        return mpmath.nan


def real(arithmetic: Arithmetic) -> type[Any]:
    """The real numbers of an arithmetic."""
    return getattr(arithmetic, "mpf", float)


def in_double(inputs: Mapping[sp.Symbol, Any]) -> dict[sp.Symbol, float]:
    """The same inputs as floats."""
    return {symbol: float(value) for symbol, value in inputs.items()}


def beside(plan: Derived, contact: Values) -> tuple[float, ...]:
    """Start values (nx,) from which Newton comes to the sample's ``contact`` in a few steps.

    Each unknown stands off by a share of its natural size. A pair that touches along a line has no Newton step, whose
    matrix is singular: there the solution itself is returned.
    """
    n, flat = len(plan.unknowns), [*(e for row in plan.jacobian for e in row), *plan.scales]
    with mpmath.workdps(DIGITS):
        numbers = plan.tape.evaluate(flat, contact, mpmath)
        _, pivots = _eliminated([[*numbers[i * n : i * n + n], mpmath.mpf(0)] for i in range(n)], mpmath.mpf)
    share = BESIDE if len(pivots) == n else 0.0
    return tuple(float(contact[u] + share * size) for u, size in zip(plan.unknowns, numbers[n * n :], strict=True))


def solve(plan: Derived, parameters: Values, angle: float, arithmetic: Arithmetic = mpmath) -> Values:
    """Inputs (symbol → number) at a contact: start system, then contact, by full Newton steps."""
    inputs = near(plan, parameters, angle, arithmetic)
    Equations(plan.tape, plan.residual, plan.jacobian, plan.unknowns, "the contact").solve(inputs, arithmetic)
    return inputs


def near(plan: Derived, parameters: Values, angle: float, arithmetic: Arithmetic = mpmath) -> Values:
    """Inputs (symbol → number) close to a contact: the solution of the start system."""
    drive = plan.drive
    inputs = dict(parameters)
    inputs[drive.instant] = real(arithmetic)(angle)
    start, name = [u.symbol for u in drive.start.unknowns], "the start system"
    guess = _numbers(name, plan.tape.evaluator(plan.start_guess, arithmetic), inputs)
    inputs.update(zip(start, guess, strict=True))
    Equations(plan.tape, plan.start_residual, plan.start_jacobian, start, name).solve(inputs, arithmetic)
    solution = _numbers(name, plan.tape.evaluator(plan.start_solution, arithmetic), inputs)
    inputs.update(zip(plan.unknowns, solution, strict=True))
    return inputs


def _numbers(what: str, evaluate: Callable[..., list[Any]], inputs: Mapping[sp.Symbol, Any]) -> list[Any]:
    """What ``evaluate`` makes of the inputs; raises :class:`NoSample` where that divides by zero or is not real."""
    try:
        numbers = evaluate(inputs)
    except ArithmeticError as error:
        raise NoSample(f"{what} divides by zero or overflows at the sample; {_OTHER}") from error
    except (AttributeError, TypeError, ValueError) as error:  # what real functions say to complex numbers
        raise NoSample(f"{what} leaves the real numbers at the sample; {_OTHER}") from error
    if any(isinstance(value, mpmath.mpc) for value in numbers):
        raise NoSample(f"{what} leaves the real numbers at the sample; {_OTHER}")
    return numbers


class Equations:
    """Equations on a tape, with their slopes by the unknowns, for Newton's method in any arithmetic; ``name`` is what
    an error calls them.
    """

    def __init__(
        self,
        tape: Tape,
        residual: Sequence[int],
        jacobian: Sequence[Sequence[int]],
        unknowns: Sequence[sp.Symbol],
        name: str,
    ) -> None:
        self._tape, self._nodes = tape, [*residual, *(e for row in jacobian for e in row)]
        self._unknowns, self._name = unknowns, name
        self._evaluators: dict[Arithmetic, Callable[[Values], list[Any]]] = {}

    def solve(self, inputs: Values, arithmetic: Arithmetic) -> None:
        """Change the unknowns among ``inputs`` (symbol → number) to a solution: by doubles, whose last two steps are
        done again where the arithmetic has more digits, or all of them where doubles find none.
        """
        near: Values = in_double(inputs)
        number = real(arithmetic)
        try:
            self.newton(near, math, FOUND)
            inputs.update((symbol, number(near[symbol])) for symbol in self._unknowns)
        except NoSample:
            if number is float:
                raise
        if number is not float:
            self.newton(inputs, arithmetic, 10.0 ** (-mpmath.mp.dps // 2 - 5))

    def newton(self, inputs: Values, arithmetic: Arithmetic, tolerance: float) -> None:
        """Change the unknowns among ``inputs`` until a change is below the tolerance."""
        unknowns, n, number = self._unknowns, len(self._unknowns), real(arithmetic)
        if arithmetic not in self._evaluators:
            self._evaluators[arithmetic] = self._tape.evaluator(self._nodes, arithmetic)
        evaluate = self._evaluators[arithmetic]
        for _ in range(60):
            numbers = _numbers(self._name, evaluate, inputs)
            rows = [[*numbers[n + i * n : n + i * n + n], numbers[i]] for i in range(n)]
            change = solution(rows, number)
            for symbol, value in zip(unknowns, change, strict=True):
                inputs[symbol] -= value
            if max(map(abs, change), default=0) < tolerance and (number is float or _held(rows, tolerance)):
                return
        if missing := [q for q in self._tape.inputs_of(self._nodes) if mpmath.isnan(inputs[q]) and q not in unknowns]:
            names = ", ".join(sorted(f"{q} ({getattr(q, 'meaning', '')})" for q in missing))
            raise NoSample(f"{self._name} of the sample needs {names}, which nothing gives; give it in the sample")
        raise NoSample(f"{self._name} of the sample does not converge in {unknowns}; {_OTHER}")


def _held(rows: list[list[Any]], tolerance: float) -> bool:
    """Whether equations, rows (matrix | residual), hold but for a small change: one that no change sees may not."""
    return all(abs(miss) <= tolerance * (1 + sum(map(abs, slopes))) for *slopes, miss in rows)


def solution(rows: list[list[Real]], number: type[Real]) -> list[Real]:
    """Solution of matrix · change = residual, given as rows (matrix | residual); directions that the equations do not
    see stay put.

    A pair that touches along a line has such a direction at every contact. The arithmetic is that of ``number``.
    """
    change = [number(0)] * len(rows)
    rows, pivots = _eliminated(rows, number)
    for step, j in reversed(pivots):
        known = sum((rows[step][k] * change[k] for _, k in pivots if k != j), number(0))
        change[j] = (rows[step][-1] - known) / rows[step][j]
    return change


def _eliminated(rows: list[list[Real]], number: type[Real]) -> tuple[list[list[Real]], list[tuple[int, int]]]:
    """Rows (matrix | residual) after elimination with complete pivoting, and the pivots (row, column) worth using."""
    digits = sys.float_info.dig if number is float else mpmath.mp.dps
    n, rows, negligible = len(rows), list(rows), number(10) ** (-digits // 2)
    pivots: list[tuple[int, int]] = []
    for step in range(n):
        free = [j for j in range(n) if j not in [column for _, column in pivots]]
        i, j = max(((i, j) for i in range(step, n) for j in free), key=lambda at: abs(rows[at[0]][at[1]]))
        if abs(rows[i][j]) <= negligible * abs(rows[0][pivots[0][1]] if pivots else 1):
            break
        rows[step], rows[i] = rows[i], rows[step]
        for k in range(step + 1, n):
            factor = rows[k][j] / rows[step][j]
            rows[k] = [a - factor * b for a, b in zip(rows[k], rows[step], strict=True)]
        pivots.append((step, j))
    return rows, pivots
