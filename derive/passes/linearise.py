"""Linearisation by way of the angles.

An angle on which several unknowns act (the sum in a rotation) is treated as a variable of its own: everything behind
it is differentiated by it once, not once for each unknown. The result is a sparse linear system in the changes of the
unknowns and of these angles; eliminating the angles gives the Jacobian.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Linear:
    """The tangent system: ``matrix`` · (changes of the unknowns, changes of the angles) = (−residual, 0).

    The first rows, ``equations`` of them, belong to the residual; row k of the rest says what changes angle k, which
    has −1 there.
    """

    matrix: list
    unknowns: int
    equations: int

    @property
    def angles(self):
        return len(self.matrix) - self.equations


def linearise(tape, residual, unknowns):
    """The :class:`Linear` system of residual nodes in unknown (input) nodes."""
    angles = _angles(tape, residual, unknowns)
    partial = _Partials(tape, angles)
    columns = [*unknowns, *angles]
    matrix = [[partial(row, x) for x in columns] for row in residual]
    for k, angle in enumerate(angles):
        later = len(angles) - k - 1
        row = [partial(angle, x) for x in columns[: len(unknowns) + k]]
        matrix.append([*row, tape.constant(-1), *[tape.constant(0)] * later])
    return Linear(matrix, len(unknowns), len(residual))


def jacobian(tape, linear):
    """Nodes of ∂residual/∂unknowns, row by row: the angles eliminated in the order in which they are computed."""
    n = linear.unknowns
    turning = []

    def total(row):
        values = row[:n]
        for slope, change in zip(row[n:], turning, strict=False):
            values = [tape.add(v, tape.mul(slope, c)) for v, c in zip(values, change, strict=True)]
        return values

    for row in linear.matrix[linear.equations :]:
        turning.append(total(row))
    return [total(row) for row in linear.matrix[: linear.equations]]


def _angles(tape, outputs, inputs):
    """Arguments of sines and cosines that depend on more than one input, in order of evaluation."""
    acting = {i: {i} for i in inputs}
    turned = set()
    order = tape.needed(outputs, set(inputs))
    for i in order:
        node = tape.nodes[i]
        acting[i] = set().union(*(acting.get(a, ()) for a in node.args))
        if node.op in ("sin", "cos") and len(acting[i]) > 1:
            turned.add(node.args[0])
    return [i for i in order if i in turned]


class _Partials:
    """Derivatives by a variable while the other angles are held."""

    def __init__(self, tape, angles):
        self.tape = tape
        self.angles = set(angles)
        self._done = {}

    def __call__(self, i, variable):
        """∂(node i)/∂variable; node i itself may be an angle."""
        stack = [i]
        while stack:
            top = stack[-1]
            args = self.tape.nodes[top].args
            missing = [a for a in args if not self._held(a, variable) and (a, variable) not in self._done]
            if missing:
                stack.extend(missing)
                continue
            slopes = {a: self._slope(a, variable) for a in args}
            self._done[top, variable] = self.tape.rule(top, slopes) if args else self._slope(top, variable)
            stack.pop()
        return self._slope(i, variable) if i == variable else self._done[i, variable]

    def _held(self, i, variable):
        return i == variable or i in self.angles or not self.tape.nodes[i].args

    def _slope(self, i, variable):
        if self._held(i, variable):
            return self.tape.constant(1 if i == variable else 0)
        return self._done[i, variable]
