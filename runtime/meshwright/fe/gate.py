"""The acceptance gate: a finite-element run is believed only if it passes every check.

CalculiX may print "Job finished", return 0 and be wrong by orders of magnitude, so what it returns is checked
against equilibrium, against the contact theory and against the mesh it was given.
"""

import math
from dataclasses import dataclass

from meshwright.fe.solver import SolverRun
from meshwright.fe.stress import Solution

#: Rotation in rad up to which rotations are taken for small: both the finite elements and the semi-analytic method do.
LARGEST_ROTATION = 0.01

_EQUILIBRIUM = 1e-3
_PRESSURE = 0.05
_ELEMENTS_PER_SEMI_MINOR = 2.5


@dataclass(frozen=True)
class Check:
    """A checked value and its limit; value is None where the run does not give it."""

    value: float | None
    limit: float
    held: bool


def accept(run: SolverRun, solution: Solution | None, torque: float, references: list[list[float]]) -> dict[str, Check]:
    """The checks by name.

    torque in N mm.  references: for each pair the peak pressures in MPa (Hertz, semi-analytic) one of which must be
    met; empty for a pair whose contact ellipse is cut by an edge of the flank or that carries no load.
    """
    checks = {"finished": Check(float(run.finished), 1.0, run.finished)}
    if not run.finished or solution is None:
        missing = {
            "pair_moment_error": _EQUILIBRIUM,
            "reaction_moment_error": _EQUILIBRIUM,
            "rotation_rad": LARGEST_ROTATION,
            "pressure_error": _PRESSURE,
            "elements_per_semi_minor": _ELEMENTS_PER_SEMI_MINOR,
        }
        return checks | {name: Check(None, limit, False) for name, limit in missing.items()}
    moments = abs(sum(pair.moment for pair in solution.pairs))
    checks["pair_moment_error"] = _at_most(abs(moments / torque - 1.0), _EQUILIBRIUM)
    checks["reaction_moment_error"] = _at_most(abs(abs(solution.reaction) / torque - 1.0), _EQUILIBRIUM)
    checks["rotation_rad"] = _at_most(abs(solution.rotation), LARGEST_ROTATION)
    errors = [
        min(abs(pair.peak_pressure / reference - 1.0) for reference in known)
        for pair, known in zip(solution.pairs, references, strict=True)
        if known
    ]
    checks["pressure_error"] = _at_most(max(errors, default=0.0), _PRESSURE)
    finest = [pair.elements_per_semi_minor for pair, known in zip(solution.pairs, references, strict=True) if known]
    least = min(finest, default=math.inf)
    checks["elements_per_semi_minor"] = Check(
        least if math.isfinite(least) else None, _ELEMENTS_PER_SEMI_MINOR, least >= _ELEMENTS_PER_SEMI_MINOR
    )
    return checks


def _at_most(value: float, limit: float) -> Check:
    return Check(value if math.isfinite(value) else None, limit, bool(value <= limit))
