"""Double precision against the hand-written formulation in 50-digit arithmetic: modified, shifted, misaligned pairs."""

import mpmath
import numpy as np
import pytest

from meshwright import DesignError, Drive
from tests.cylindrical_gears.designs import ARCSEC, random_modified
from tests.independent.chords import chords
from tests.independent.cylindrical_gears import pair_of

DIGITS, DESIGNS = 50, 60


@pytest.fixture(scope="module")
def differences():
    """Per case: transmission error (arcsec); residual distance (mm) and normals of our solution; point (mm) and normal
    against the exact ones.
    """
    rng, rows = np.random.default_rng(21771), []
    with mpmath.workdps(DIGITS):
        while len(rows) < DESIGNS:
            design, phi = random_modified(rng), float(rng.uniform(-0.15, 0.15))
            try:
                found = Drive.from_tables(design).tca([phi])
            except DesignError:
                continue
            if found.status != ("converged",):
                continue
            exact, angle = pair_of(design), mpmath.mpf(phi)
            x = chords(lambda x, exact=exact, angle=angle: exact.residual(angle, x), found.solutions[0])
            residual = exact.residual(angle, [mpmath.mpf(float(u)) for u in found.solutions[0]])
            point, normal, _, _ = exact.placed(angle, x)
            rows.append((
                abs(float(x[4] - mpmath.mpf(float(found.error[0])))) / ARCSEC,
                max(abs(float(r)) for r in residual[:3]),
                max(abs(float(r)) for r in residual[3:]),
                max(abs(float(a - mpmath.mpf(float(b)))) for a, b in zip(point, found.points[0], strict=True)),
                max(abs(float(a - mpmath.mpf(float(b)))) for a, b in zip(normal, found.normals[0], strict=True)),
            ))  # fmt: skip
    return np.array(rows)


def test_transmission_error_agrees_with_fifty_digits(differences):
    assert differences[:, 0].max() < 1e-10


def test_positions_and_normals_agree_with_fifty_digits(differences):
    assert differences[:, 1:].max() < 1e-12
