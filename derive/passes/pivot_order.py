"""One fused Newton step: x − J⁻¹R as straight-line operations with a pivot order chosen offline.

The system solved is the one in the unknowns and further variables (see :mod:`derive.passes.linearise`), sparser than J.

The order is found at a sample solution: among the entries that are large enough to be stable, the one that costs
least fill (Markowitz). The runtime checks the step and falls back on complete pivoting where the order fails.
"""

from collections.abc import Mapping, Sequence
from typing import TypeAlias

import sympy as sp

from derive.language.origin import ELIMINATION, STEP_SIZE, Origin
from derive.passes import check, sample
from derive.passes.plan import Derived, Reduced
from derive.program.tape import Tape

#: Row and column; numbers at the sample, row by row, and whether they are ever other than zero.
Pivot: TypeAlias = tuple[int, int]
Rows: TypeAlias = list[list[float]]
Present: TypeAlias = list[list[bool]]

#: A pivot must reach this share of the largest scaled entry left in its row.
STABLE_SHARE = 0.1


def reduce(plan: Derived) -> Reduced:
    """The equations with their linear system solved: Newton's step, in the order of pivots of the sample's contact."""
    plan = plan.copy()
    tape, contact = plan.tape, sample.sample_contact(plan)
    step, change = newton_step(plan, sample.in_double(contact))
    check.solves("pivot order", tape, plan.jacobian, change, plan.residual)
    with tape.within(STEP_SIZE):
        weight = tuple(tape.div(tape.constant(1), s) for s in plan.scales)
    return Reduced(
        **vars(plan),
        sample=contact,
        step=tuple(step),
        change=tuple(change),
        weight=weight,
        beside=sample.beside(plan, contact),
    )


def newton_step(plan: Derived, inputs: Mapping[sp.Symbol, float]) -> tuple[list[int], list[int]]:
    """Nodes of the updated unknowns and of their changes; ``inputs`` are those of the sample."""
    tape, linear = plan.tape, plan.linear
    order = _pivot_order(plan, inputs)
    right = [*plan.residual, *[tape.constant(0)] * linear.variables]
    changes = _solve(tape, linear.matrix, right, order)[: linear.unknowns]
    unknowns = [plan.lower(u) for u in plan.unknowns]
    updated = [tape.sub(x, d) for x, d in zip(unknowns, changes, strict=True)]
    return updated, changes


def _pivot_order(plan: Derived, inputs: Mapping[sp.Symbol, float]) -> list[Pivot]:
    matrix = plan.linear.matrix
    n = len(matrix)
    flat = [e for row in matrix for e in row]
    scales = [*plan.scales, *[plan.tape.constant(1)] * plan.linear.variables]
    numbers = plan.tape.evaluate(flat + scales, inputs)
    size = numbers[n * n :]
    values = [[numbers[i * n + j] * size[j] for j in range(n)] for i in range(n)]
    present = [[plan.tape.const_value(e) != 0 for e in row] for row in matrix]
    rows, columns = set(range(n)), set(range(n))
    order: list[Pivot] = []
    while rows:
        pivot = _best(values, present, rows, columns)
        order.append(pivot)
        _eliminate(values, present, rows, columns, pivot)
    return order


def _best(values: Rows, present: Present, rows: set[int], columns: set[int]) -> Pivot:
    """The cheapest stable pivot; a row that vanishes at the sample (line contact) comes last, in any order."""
    best: tuple[tuple[bool, int, float, int, int], Pivot] | None = None
    for i in sorted(rows):
        largest = max(abs(values[i][j]) for j in columns)
        for j in sorted(columns):
            if not present[i][j] or abs(values[i][j]) < STABLE_SHARE * largest:
                continue
            in_row = sum(present[i][k] for k in columns) - 1
            in_column = sum(present[k][j] for k in rows) - 1
            share = abs(values[i][j]) / largest if largest > 0 else 0
            cost = (largest == 0, in_row * in_column, -share, i, j)
            if best is None or cost < best[0]:
                best = cost, (i, j)
    if best is None:
        raise ArithmeticError("an unknown occurs in no equation")
    return best[1]


def _eliminate(values: Rows, present: Present, rows: set[int], columns: set[int], pivot: Pivot) -> None:
    i, j = pivot
    rows.discard(i)
    columns.discard(j)
    for k in rows:
        if present[k][j]:
            factor = values[k][j] / values[i][j] if values[i][j] else 0.0
            for m in columns:
                values[k][m] -= factor * values[i][m]
                present[k][m] = present[k][m] or present[i][m]


def _solve(tape: Tape, matrix: Sequence[Sequence[int]], right: Sequence[int], order: Sequence[Pivot]) -> list[int]:
    """Gaussian elimination on nodes in the given pivot order; entries known to be zero cost nothing.

    The last two unknowns follow together from Cramer's rule: for as many operations, one division less in the chain
    in which each waits for the one before.
    """
    a, b = [list(row) for row in matrix], list(right)
    singly, last, since = order[:-2], order[-2:], len(tape.nodes)
    inverse: dict[int, int] = {}
    for step, (i, j) in enumerate(singly):
        inverse[i] = _reciprocal(tape, a[i][j], f"pivot {step + 1}")
        for k, _ in order[step + 1 :]:
            if tape.const_value(a[k][j]) == 0:
                continue
            factor = tape.mul(a[k][j], inverse[i])
            for _, m in order[step + 1 :]:
                a[k][m] = tape.sub(a[k][m], tape.mul(factor, a[i][m]))
                tape.means(a[k][m], since, f"entry {k} {m} after pivot {i} {j}")
            b[k] = tape.sub(b[k], tape.mul(factor, b[i]))
            tape.means(b[k], since, f"right side {k} after pivot {i} {j}")
    solution = _cramer(tape, a, b, last)
    for step, (i, j) in reversed([*enumerate(singly)]):
        total = b[i]
        for _, m in order[step + 1 :]:
            total = tape.sub(total, tape.mul(a[i][m], solution[m]))
        solution[j] = tape.mul(total, inverse[i])
    return [solution[j] for j in range(len(order))]


def _cramer(tape: Tape, a: Sequence[Sequence[int]], b: Sequence[int], pivots: Sequence[Pivot]) -> dict[int, int]:
    """Column → unknown, of the one or two equations that are left."""
    if len(pivots) == 1:
        [(i, j)] = pivots
        return {j: tape.mul(b[i], _reciprocal(tape, a[i][j], "last pivot"))}
    (i, j), (k, m) = pivots

    def determinant(p: int, q: int, r: int, s: int) -> int:
        return tape.sub(tape.mul(p, s), tape.mul(q, r))

    over = _reciprocal(tape, determinant(a[i][j], a[i][m], a[k][j], a[k][m]), "determinant of the last two pivots")
    return {
        j: tape.mul(determinant(b[i], a[i][m], b[k], a[k][m]), over),
        m: tape.mul(determinant(a[i][j], b[i], a[k][j], b[k]), over),
    }


def _reciprocal(tape: Tape, divisor: int, meaning: str) -> int:
    with tape.within(Origin(ELIMINATION, f"{meaning} of the Newton step")):
        return tape.div(tape.constant(1), divisor)
