"""Linearisation by way of the angles and of what equations were solved for.

An angle on which several unknowns act (the sum in a rotation) is treated as a variable of its own: everything behind
it is differentiated by it once, not once for each unknown. So is the solution of an equation: its derivatives are
those of the equation over its slope, shorter than those of the solution. The result is a sparse linear system in the
changes of the unknowns and of these variables; eliminating the variables gives the Jacobian.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from derive.passes import check
from derive.program.tape import Stage, Tape

Rows = list[list[int]]
Matrix = tuple[tuple[int, ...], ...]


@dataclass(frozen=True)
class Linear:
    """The tangent system: ``matrix`` · (changes of the unknowns, changes of the variables) = (−residual, 0).

    The first rows, ``equations`` of them, belong to the residual; row k of the rest says what changes variable k, an
    angle or the solution of an equation, which has −1 there.
    """

    matrix: Matrix
    unknowns: int
    equations: int

    @property
    def variables(self) -> int:
        return len(self.matrix) - self.equations


def linearise(
    tape: Tape, residual: Sequence[int], unknowns: Sequence[int], solutions: Iterable[tuple[int, int, int]] = ()
) -> Linear:
    """The :class:`Linear` system of residual nodes in unknown (input) nodes.

    ``solutions`` are nodes (solution, equation, slope): the equation is 0, its derivative by the solution the slope.
    What is held as a variable, and which way each row is differentiated, is what needs the fewest operations.
    """
    best = _assembled(tape, residual, unknowns, {})
    equations = dict(_positive(tape, *solved) for solved in solutions)
    read = {v: solved for v, solved in equations.items() if _is_read(tape.copy(), v, *solved)}
    if read:
        held = _assembled(tape, residual, unknowns, read)
        best = min(best, held, key=lambda linear: _operations(tape, residual, linear))
    return best


def _is_read(tape: Tape, solution: int, equation: int, slope: int) -> bool:
    """Whether an equation on the tape, to which this adds, reads its solution wherever it stands in it: a product with
    the solution that is rearranged reads a factor of it, and the equation then has not the slope that it should.
    """
    (own,) = _Forward(tape, [solution])(equation)
    return check.equal(tape, own, slope)


def _positive(tape: Tape, solution: int, equation: int, slope: int) -> tuple[int, tuple[int, int]]:
    """A solution and what it solves; of a negative the positive, whose sign its users take up and which they read."""
    node = tape.nodes[solution]
    return (node.args[0], (equation, tape.neg(slope))) if node.op == "neg" else (solution, (equation, slope))


def forward(tape: Tape, residual: Sequence[int], unknowns: Sequence[int]) -> Linear:
    """The :class:`Linear` system by the forward chain rule alone: of equations solved too seldom to seek what needs the
    fewest operations.
    """
    variables = _variables(tape, residual, unknowns, {})
    partial = _Forward(tape, [*unknowns, *variables])
    rows = [partial(row) for row in residual]
    rows += [_closed(tape, partial(v), len(unknowns) + k, None, v) for k, v in enumerate(variables)]
    return Linear(tuple(map(tuple, rows)), len(unknowns), len(residual))


def _assembled(
    tape: Tape, residual: Sequence[int], unknowns: Sequence[int], equations: Mapping[int, tuple[int, int]]
) -> Linear:
    variables = _variables(tape, residual, unknowns, equations)
    columns = [*unknowns, *variables]
    forward, backward = _Forward(tape, columns), _Backward(tape, columns)
    rows = [*residual, *(equations.get(variable, (variable,))[0] for variable in variables)]
    sides = [[side(row) for side in (forward, backward)] for row in rows]
    for k, variable in enumerate(variables):
        for way, row in enumerate(sides[len(residual) + k]):
            sides[len(residual) + k][way] = _closed(tape, row, len(unknowns) + k, equations.get(variable), variable)
    return Linear(tuple(map(tuple, _cheapest(tape, residual, sides))), len(unknowns), len(residual))


def _closed(
    tape: Tape, row: list[int], at: int, equation: tuple[int, int] | None, variable: int
) -> list[int]:
    """The row of a variable, −1 in its own column: what changes it are the columns before."""
    before = row[:at]
    if equation is not None:
        with tape.within(tape.origins.get(variable)):
            over = tape.div(tape.constant(-1), equation[1])
        before = [tape.mul(slope, over) for slope in before]
    return [*before, tape.constant(-1), *[tape.constant(0)] * (len(row) - at - 1)]


def _cheapest(tape: Tape, residual: Sequence[int], sides: Sequence[Rows]) -> Rows:
    """Of two ways to write each row the ones that together need the fewest operations: rows turn alone or in pairs,
    since two rows may share what the one alone would not pay for.
    """
    costs = [[_Cost.of(tape, row) for row in ways] for ways in sides]
    own = _iterated(tape, residual)
    ways, places = [0] * len(sides), range(len(sides))
    least = _counted(own, len(residual), [forward for forward, _ in costs])
    for turned in ((k, m) for k in places for m in places if k <= m):
        tried = [1 if k in turned else way for k, way in enumerate(ways)]
        if (count := _counted(own, len(residual), [costs[k][way] for k, way in enumerate(tried)])) < least:
            ways, least = tried, count
    return [sides[k][way] for k, way in enumerate(ways)]


@dataclass(frozen=True)
class _Cost:
    """What a row of the system costs: the nodes of a Newton step ``behind`` it, and ``eliminated`` operations if its
    variable is.
    """

    behind: frozenset[int]
    eliminated: int

    @classmethod
    def of(cls, tape: Tape, row: Sequence[int]) -> "_Cost":
        varies = [e for e in row if tape.const_value(e) is None]
        return cls(_iterated(tape, varies), 2 * len(varies) * sum(tape.const_value(e) != 0 for e in row))


def _iterated(tape: Tape, nodes: Iterable[int]) -> frozenset[int]:
    """Operations of a Newton step behind nodes."""
    return frozenset(i for i in tape.needed([*dict.fromkeys(nodes)]) if tape.stages[i] == Stage.ITERATE)


def _counted(own: frozenset[int], equations: int, rows: Sequence[_Cost]) -> int:
    """Operations of a Newton step but for the solution of the system in the unknowns; ``own``: the residual's."""
    return len(own.union(*(row.behind for row in rows))) + sum(row.eliminated for row in rows[equations:])


def _operations(tape: Tape, residual: Sequence[int], linear: Linear) -> int:
    """Operations of a Newton step but for the solution of the system in the unknowns: those behind its numbers, and two
    for each entry of a variable's row wherever that variable is put in.
    """
    rows, at = linear.matrix, linear.unknowns
    present = [[tape.const_value(e) != 0 for e in row] for row in rows]
    entries = [e for row in rows for e in row if tape.const_value(e) is None]
    put_in = (
        2 * (sum(own) - 1) * (sum(row[at + k] for row in present) - 1)
        for k, own in enumerate(present[linear.equations :])
    )
    return len(_iterated(tape, [*residual, *entries])) + sum(put_in)


def jacobian(tape: Tape, linear: Linear) -> Matrix:
    """Nodes of ∂residual/∂unknowns, row by row: the angles eliminated in the order in which they are computed."""
    n = linear.unknowns
    turning: list[tuple[int, ...]] = []

    def total(row: tuple[int, ...]) -> tuple[int, ...]:
        values = row[:n]
        for slope, change in zip(row[n:], turning, strict=False):
            values = tuple(tape.add(v, tape.mul(slope, c)) for v, c in zip(values, change, strict=True))
        return values

    for row in linear.matrix[linear.equations :]:
        turning.append(total(row))
    return tuple(total(row) for row in linear.matrix[: linear.equations])


def _variables(
    tape: Tape, outputs: Iterable[int], inputs: Iterable[int], equations: Mapping[int, tuple[int, int]]
) -> list[int]:
    """Solutions of equations, and arguments of sines and cosines that depend on more than one input, as evaluated."""
    inputs = set(inputs)
    acting = {i: {i} for i in inputs}
    held: set[int] = set()
    order = tape.needed(outputs, inputs)
    for i in order:
        node = tape.nodes[i]
        acting[i] = {x for a in node.args for x in acting.get(a, ())}
        if node.op in ("sin", "cos") and len(acting[i]) > 1:
            held.add(node.args[0])
        if i in equations and len(acting[i]) > 1:
            held.add(i)
    return [i for i in order if i in held]


class _Forward:
    """Derivatives by each column, an input or a variable, while the others are held: by the chain rule from them on."""

    def __init__(self, tape: Tape, columns: Sequence[int]) -> None:
        self.tape, self.columns = tape, columns
        self._bits = {column: 1 << k for k, column in enumerate(columns)}
        self._moved: dict[int, int] = {}  # operation behind the rows → the bits of what moves it
        self._done: list[dict[int, int]] = [{} for _ in columns]

    def __call__(self, i: int) -> list[int]:
        """∂(node i)/∂(each column); node i itself may be one of them."""
        arguments, bits, moved = self.tape.arguments, self._bits, self._moved
        for k in self.tape.needed(arguments[i], {*bits, *moved}):
            moved[k] = 0
            for a in arguments[k]:
                moved[k] |= bits[a] if a in bits else moved.get(a, 0)
        return [self._by(i, column, done) for column, done in zip(self.columns, self._done, strict=True)]

    def _by(self, i: int, column: int, done: dict[int, int]) -> int:
        tape, arguments, moved, own = self.tape, self.tape.arguments, self._moved, self._bits[column]

        def slopes(k: int) -> list[int]:
            return [done[a] if a in done else tape.constant(int(a == column)) for a in arguments[k]]

        stack, since = [a for a in arguments[i] if a in moved], len(tape.nodes)
        while stack:
            top = stack[-1]
            if top in done:
                stack.pop()
            elif not moved[top] & own:
                done[top] = tape.constant(0)
            elif missing := [a for a in arguments[top] if a in moved and a not in done]:
                stack.extend(missing)
            else:
                done[top] = tape.means(tape.rule(top, slopes(top)), since, "slope", top, column, "alone")
        return tape.rule(i, slopes(i)) if arguments[i] and i != column else tape.constant(int(i == column))


class _Backward:
    """The same by the adjoint chain rule, from the result back: once for all columns."""

    def __init__(self, tape: Tape, columns: Sequence[int]) -> None:
        self.tape, self.columns = tape, columns

    def __call__(self, i: int) -> list[int]:
        tape, known = self.tape, set(self.columns) - {i}
        order = tape.needed([i], known)
        moved = set(known)
        for k in order:
            if any(a in moved for a in tape.nodes[k].args):
                moved.add(k)
        adjoint, since = {i: tape.constant(1)}, len(tape.nodes)
        for k in reversed(order):
            if k not in adjoint or k not in moved:
                continue
            tape.means(adjoint[k], since, "slope", i, k, "back")
            for a in dict.fromkeys(tape.nodes[k].args):
                if a in moved:
                    slopes = [tape.constant(int(b == a)) for b in tape.arguments[k]]
                    share = tape.mul(adjoint[k], tape.rule(k, slopes))
                    adjoint[a] = tape.add(adjoint[a], share) if a in adjoint else share
        return [adjoint.get(x, tape.constant(0)) if x != i else tape.constant(1) for x in self.columns]
