"""What an engineer would write without a compiler for gear meshing: the same equations by common means."""

import numpy as np
import sympy as sp
from scipy.optimize import fsolve

from tests.benchmarks.timing import best

#: What the description's own functions of choice are in floating point, under the names that SymPy prints.
CHOICES = {"excess": lambda a: max(a, 0.0), "unit_step": lambda a: 0.0 if a < 0.0 else 1.0}


def _expanded(drive, expression):
    """The expression in inputs alone, its definitions put in."""
    expression, table = sp.sympify(expression), dict(drive.definitions.items())
    while named := expression.free_symbols & table.keys():
        expression = expression.xreplace({s: table[s] for s in named})
    return expression


def lambdified(drive, unknowns):
    """The residual as a function of unknowns, instant and parameters, by ``lambdify(cse=True)``."""
    symbols = [unknowns, drive.instant, [p.symbol for p in drive.parameters]]
    return sp.lambdify(symbols, [_expanded(drive, r) for r in drive.residual], [CHOICES, "numpy"], cse=True)


def scipy_points(plan, case):
    """Points a second of ``fsolve`` on ``lambdify(cse=True)``, each started from the point before."""
    residual, angles = lambdified(plan.drive, plan.unknowns), case.angles[:50]

    def run():
        x = case.start
        for phi in angles:
            x, _, status, message = fsolve(residual, x, args=(phi, case.parameters), full_output=True)
            assert status == 1, message

    return len(angles) / best(run, repeats=40)


def casadi_rootfinder_points(function, case):
    """Points a second of CasADi's own ``rootfinder``, called from Python point by point."""
    import casadi

    solver = casadi.rootfinder("solver", "newton", function, {"abstol": 1e-11})
    angles = case.angles[:100]

    def run():
        x = case.start
        for phi in angles:
            x = solver(x, casadi.vertcat(case.parameters, phi))

    return len(angles) / best(run, repeats=10)


class _Vectorised:
    """NumPy under the names that :meth:`derive.program.tape.Tape.evaluate` wants."""

    sqrt, sin, cos, atan2 = map(staticmethod, (np.sqrt, np.sin, np.cos, np.arctan2))
    sign = staticmethod(lambda a: np.where(a < 0.0, -1.0, 1.0))


def numpy_points(plan, case):
    """Points a second of a Newton iteration over all points at once, started one point off."""
    angles = case.angles
    inputs = dict(zip((p.symbol for p in plan.drive.parameters), case.parameters, strict=True))
    inputs[plan.drive.instant] = angles
    nodes = [*plan.residual, *(e for row in plan.jacobian for e in row)]
    n, first = len(plan.unknowns), np.vstack([case.points[:1], case.points[:-1]])

    def run():
        x = first.copy()
        for _ in range(20):
            values = plan.tape.evaluate(nodes, inputs | dict(zip(plan.unknowns, x.T, strict=True)), _Vectorised)
            table = np.stack([np.broadcast_to(v, angles.shape) for v in values], axis=-1)
            step = np.linalg.solve(table[:, n:].reshape(-1, n, n), table[:, :n, None])[..., 0]
            x -= step
            if np.abs(step).max() < 1e-9:
                return
        raise ArithmeticError("the batched Newton iteration does not converge")

    return len(angles) / best(run, repeats=10)
