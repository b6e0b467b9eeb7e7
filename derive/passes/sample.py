"""A small Newton iteration on the tape itself, used at generation time only: sample solutions and self-tests."""

import math
import sys
from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeAlias, TypeVar

import mpmath
import sympy as sp

from derive.language.drive import PATH, Drive
from derive.language.symbols import Table
from derive.language.validate import DescriptionError
from derive.passes.completion import SystemTape, lower_system
from derive.passes.plan import Schedule
from derive.program.tape import Lowering, Stage, Tape

#: Inputs and their numbers, of many digits; a matrix, of these or of floats.
Values: TypeAlias = dict[sp.Symbol, mpmath.mpf]
Real = TypeVar("Real", float, mpmath.mpf)

#: Digits of the arithmetic: enough that the result is exact to double precision.
DIGITS = 40

#: How far beside a solution a self-test starts, in natural sizes: far enough for several steps, near enough that none
#: of them is cut short. Exact in binary.
BESIDE = 1.0 / 64.0

#: Steps in which the path of a design system is followed.
PATH_STEPS = 16

#: Newton's last change on the way: what is left of the error is its square.
ON_PATH = 1e-4


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

    def __call__(self, design: Mapping[str, float | int | str]) -> Values:
        """Parameter values by symbol for a ``design`` (key → number), complete; parameters left open are NaN."""
        values: Values = {p.symbol: mpmath.nan for p in self._parameters}
        for p in self._parameters:
            key = p.key if p.table == Table.FLANK else p.place
            if key in design:
                values[p.symbol] = _number(p.factor) * mpmath.mpf(design[key])
            elif p.default is not None:
                values[p.symbol] = _number(p.default)
        self._apply_rules(values)
        for system in self._systems:
            _complete(system, values)
            self._apply_rules(values)
        return values

    def _apply_rules(self, values: Values) -> None:
        for target, tape, node in self._rules:
            if mpmath.isnan(values[target]):
                values[target] = tape.evaluate([node], values, mpmath)[0]


def sample_parameters(drive: Drive, systems: Sequence[SystemTape] | None = None) -> Values:
    """The drive's sample design as parameter values by symbol: see :class:`Completion`."""
    return Completion(drive, systems)(drive.sample)


def _complete(plan: SystemTape, values: Values) -> None:
    """Fill in what a design system gives, following its path in equal steps and double precision, exactly only at its
    end.
    """
    unknowns = plan.unknowns
    inputs = dict(values)
    inputs.update(zip(unknowns, plan.tape.evaluate(plan.guess, inputs, mpmath), strict=True))
    on_path = _iteration(plan.tape, plan.residual, plan.jacobian, unknowns, math)
    near = dict[sp.Symbol, Any](in_double(inputs))
    for step in range(PATH_STEPS):
        near[PATH] = step / PATH_STEPS
        on_path(near, ON_PATH)
    for symbol in unknowns:
        inputs[symbol] = mpmath.mpf(near[symbol])
    inputs[PATH] = mpmath.mpf(1)
    _iteration(plan.tape, plan.residual, plan.jacobian, unknowns)(inputs)
    for target, value in zip(plan.system.fills, plan.tape.evaluate(plan.values, inputs, mpmath), strict=True):
        if mpmath.isnan(values[target]):
            values[target] = value


def _number(expression: sp.Expr) -> mpmath.mpf:
    return mpmath.mpf(expression.evalf(DIGITS))


def sample_contact(plan: Schedule) -> Values:
    """Inputs (symbol → number) at a solved contact of the sample design."""
    with mpmath.workdps(DIGITS):
        return solve(plan, sample_parameters(plan.drive, plan.systems), plan.drive.sample_angle)


def observation(plan: Schedule) -> dict[str, list[mpmath.mpf]]:
    """What is observed of the sample's contact: name → numbers."""
    nodes = [i for output in plan.observed for i in output.nodes]
    with mpmath.workdps(DIGITS):
        numbers = iter(plan.tape.evaluate(nodes, plan.sample, mpmath))
    return {output.name: [next(numbers) for _ in output.nodes] for output in plan.observed}


def in_double(inputs: Values) -> dict[sp.Symbol, float]:
    """The same inputs as floats."""
    return {symbol: float(value) for symbol, value in inputs.items()}


def beside(plan: Schedule) -> list[float]:
    """Start values (nx,) from which Newton comes to the sample's solution in a few steps.

    Each unknown stands off by a share of its natural size. A pair that touches along a line has no Newton step, whose
    matrix is singular: there the solution itself is returned.
    """
    n, flat = len(plan.unknowns), [*(e for row in plan.jacobian for e in row), *plan.scales]
    with mpmath.workdps(DIGITS):
        numbers = plan.tape.evaluate(flat, plan.sample, mpmath)
        _, pivots = _eliminated([[*numbers[i * n : i * n + n], mpmath.mpf(0)] for i in range(n)], mpmath.mpf)
    share = BESIDE if len(pivots) == n else 0.0
    return [float(plan.sample[u] + share * size) for u, size in zip(plan.unknowns, numbers[n * n :], strict=True)]


def solve(plan: Schedule, parameters: Values, angle: float) -> Values:
    """Start system, then contact, by full Newton steps in the current mpmath precision."""
    inputs = near(plan, parameters, angle)
    _iteration(plan.tape, plan.residual, plan.jacobian, plan.unknowns)(inputs)
    return inputs


def near(plan: Schedule, parameters: Values, angle: float) -> Values:
    """Inputs (symbol → number) close to a contact: the solution of the start system."""
    drive = plan.drive
    inputs = dict(parameters)
    inputs[drive.instant] = mpmath.mpf(angle)
    start = [u.symbol for u in drive.start.unknowns]
    inputs.update(zip(start, plan.tape.evaluate(plan.start_guess, inputs, mpmath), strict=True))
    _iteration(plan.tape, plan.start_residual, plan.start_jacobian, start)(inputs)
    solution = plan.tape.evaluate(plan.start_solution, inputs, mpmath)
    inputs.update(zip(plan.unknowns, solution, strict=True))
    return inputs


def _iteration(
    tape: Tape,
    residual: Sequence[int],
    jacobian: Sequence[Sequence[int]],
    unknowns: Sequence[sp.Symbol],
    arithmetic: Any = mpmath,  # noqa: ANN401  a module or alike
) -> Callable[..., None]:
    """Function that changes the unknowns among its inputs (symbol → number) until the residual vanishes, or until a
    change is below the tolerance given.
    """
    n = len(unknowns)
    evaluate = tape.evaluator([*residual, *(e for row in jacobian for e in row)], arithmetic)
    exact = mpmath.mpf(10) ** (-mpmath.mp.dps // 2 - 5)

    def iterate(inputs: Values, tolerance: float | None = None) -> None:
        for _ in range(60):
            try:
                numbers = evaluate(inputs)
            except (AttributeError, TypeError, ValueError) as error:  # what real functions say to complex numbers
                raise NoSample(f"the sample of {unknowns} leaves the real numbers; choose another") from error
            change = solution([[*numbers[n + i * n : n + i * n + n], numbers[i]] for i in range(n)], mpmath.mpf)
            for symbol, value in zip(unknowns, change, strict=True):
                inputs[symbol] -= value
            if max(map(abs, change), default=0) < (tolerance or exact):
                return
        raise NoSample(f"the sample of {unknowns} does not converge; choose another sample design")

    return iterate


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
