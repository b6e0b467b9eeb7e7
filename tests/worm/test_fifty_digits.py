"""Every flank form, in double precision, against a second formulation in 50-digit arithmetic."""

import itertools

import mpmath
import numpy as np
import pytest

from meshwright import Drive
from tests.independent.chords import chords
from tests.independent.worm import WormDrive
from tests.quick import quick
from tests.worm.designs import PROFILES, misaligned

SHAFT_ANGLES = (45.0, 70.0, 90.0, 110.0)
ERRORS = (
    {},
    {"center_distance_mm": 0.03, "horizontal_deg": 0.03, "vertical_deg": -0.02, "axial_mm": 0.05},
)
BUILT = [*((p, p) for p in PROFILES), ("ZK", "ZN")]

#: The others take long, or are derived and compiled when they are first asked for.
PAIRS = quick([*BUILT, ("ZC", "ZK"), ("ZI", "ZA"), ("ZA", "ZI"), ("ZN", "ZC")], *[p for p in BUILT if "ZC" not in p])


@pytest.mark.parametrize("worm, hob", PAIRS)
def test_flank_forms_at_any_shaft_angle_agree_with_fifty_digits(worm, hob):
    compared = folded = 0
    with mpmath.workdps(50):
        for shaft_angle, errors, flank in itertools.product(SHAFT_ANGLES, ERRORS, ("right", "left")):
            tables = misaligned(worm, hob, shaft_angle, errors, flank=flank)
            exact = WormDrive.of(tables)
            angles = np.radians([-25.0, 10.0])
            result = Drive.from_tables(tables).tca(angles)
            for k, phi in enumerate(angles):
                if result.status[k] != "converged":
                    assert result.status[k] == "fold"
                    folded += 1
                    continue
                compared += 1
                u = {name: values[k] for name, values in result.unknowns.items()}
                start = [u["t_worm"], u["psi_worm"], u["t_hob"], u["psi_hob"], u["phi_hob"], result.wheel_angles[k]]
                solved = chords(lambda x, exact=exact, phi=phi: exact.residual(x, mpmath.mpf(phi)), start)
                error = solved[5] - mpmath.mpf(exact.threads) / exact.teeth * mpmath.mpf(phi)
                assert abs(float(error - result.error[k])) * 648000 / np.pi < 1e-10
                as_solved = exact.residual([mpmath.mpf(float(x)) for x in start], mpmath.mpf(phi))
                assert max(map(abs, as_solved[:5])) < 1e-12
    assert compared > 4 * folded  # beyond a fold there is no contact to compare
