"""Double precision against the recess-action paper's own equations in 50-digit arithmetic."""

import math

import mpmath
import numpy as np
import pytest

from meshwright import DesignError, Drive
from tests.independent.chords import chords
from tests.independent.recess_action import Paper
from tests.lanes import available, trace_designs

DIGITS = 50


def _random_tables(rng):
    """A design drawn widely: threads, teeth, lead, pressure and shaft angles, oversize, shift, misalignments."""
    module = float(rng.uniform(0.5, 8.0))
    threads = int(rng.integers(1, 5))
    lead = float(rng.uniform(2.0, 8.0) * (1 + threads) / 2)
    alpha = float(rng.uniform(8.0, 25.0))
    worm_radius = module * threads / (2 * math.sin(math.radians(lead)))
    largest_shift = math.pi * module / 4 / math.tan(math.radians(alpha))
    return {
        "drive": "cylindrical-worm",
        "flank": str(rng.choice(["right", "left"])),
        "design": {
            "normal_module_mm": module,
            "worm_threads": threads,
            "wheel_teeth": int(rng.integers(25, 300)),
            "worm_lead_angle_deg": lead,
            "pressure_angle_deg": alpha,
            "shaft_angle_deg": float(rng.choice([90.0, rng.uniform(50.0, 120.0)])),
            "worm_profile": "ZN",
            "pitch_line_shift_mm": float(rng.uniform(0.0, 0.6)) * largest_shift,
            "hob_pitch_radius_mm": worm_radius * float(rng.uniform(1.01, 1.10)),
        },
        "misalignment": {
            "center_distance_mm": float(rng.uniform(-0.02, 0.02)) * module,
            "horizontal_deg": float(rng.uniform(-0.05, 0.05)),
            "vertical_deg": float(rng.uniform(-0.05, 0.05)),
        },
    }


def _paper(tables):
    """The paper's system of a design, every input taken as the exact double that the design file gives."""
    design, errors = tables["design"], tables["misalignment"]
    degrees = mpmath.pi / 180
    return Paper(
        {
            "m_n": mpmath.mpf(design["normal_module_mm"]),
            "T1": mpmath.mpf(design["worm_threads"]),
            "T2": mpmath.mpf(design["wheel_teeth"]),
            "lam3": mpmath.mpf(design["worm_lead_angle_deg"]) * degrees,
            "alpha": mpmath.mpf(design["pressure_angle_deg"]) * degrees,
            "dx": mpmath.mpf(design["pitch_line_shift_mm"]),
            "r1": mpmath.mpf(design["hob_pitch_radius_mm"]),
            "sigma": mpmath.mpf(design["shaft_angle_deg"]) * degrees,
            "s": 1 if tables["flank"] == "right" else -1,
            "dC": mpmath.mpf(errors["center_distance_mm"]),
            # the paper turns its errors the other way
            "dgh": -mpmath.mpf(errors["horizontal_deg"]) * degrees,
            "dgv": -mpmath.mpf(errors["vertical_deg"]) * degrees,
        },
        mpmath,
    )


def _solved_cases(count):
    rng = np.random.default_rng(20040531)
    while count:
        tables = _random_tables(rng)
        phi = float(rng.uniform(-1.0, 1.0)) * 2 * math.pi / tables["design"]["worm_threads"]
        try:
            drive = Drive.from_tables(tables)
        except DesignError:
            continue
        result = drive.tca([phi])
        if result.status == ("converged",) and not result.flags[0]:
            count -= 1
            yield drive, tables, phi, result


def _errors_in_lanes(drive, phi, solution):
    """Transmission error by each lane kernel that this processor runs, rad, from a start beside the solution."""
    column = drive.design.description["error"]
    designs, start = drive.design.parameters[None], solution * (1.0 + 1e-6)
    for lanes in available().values():
        x, status, _ = trace_designs(lanes, drive, designs, np.array([phi]), start)
        assert status[0, 0] == 0
        yield x[0, 0, column]


@pytest.fixture(scope="module", params=[20, pytest.param(1000, marks=pytest.mark.validate)])
def differences(request):
    """Per random design: position (mm) and normal residuals; errors of the scalar and each lane kernel, arcsec."""
    rows = []
    with mpmath.workdps(DIGITS):
        for drive, tables, phi, result in _solved_cases(request.param):
            u = result.unknowns
            start = [
                u["t_hob"][0], -u["psi_hob"][0], u["phi_hob"][0],
                u["t_worm"][0], -u["psi_worm"][0], result.wheel_angles[0],
            ]  # fmt: skip
            paper = _paper(tables)
            exact = chords(lambda x, paper=paper, phi=phi: paper.residual(x, mpmath.mpf(phi)), start)
            error = exact[5] - mpmath.mpf(tables["design"]["worm_threads"]) / tables["design"]["wheel_teeth"] * phi
            residual = [abs(float(r)) for r in paper.residual([mpmath.mpf(float(x)) for x in start], mpmath.mpf(phi))]
            found = [result.error[0], *_errors_in_lanes(drive, phi, result.solutions[0])]
            off = [abs(float(error - e)) * 648000 / math.pi for e in found]
            rows.append((max(residual[:3]), max(residual[3:5]), *off))
    return np.array(rows)


def test_transmission_error_of_every_kernel_agrees_with_fifty_digits(differences):
    assert differences[:, 2:].shape[1] == 1 + len(available())
    assert differences[:, 2:].max() < 1e-10


def test_positions_and_normals_meet_to_round_off(differences):
    assert differences[:, 0].max() < 1e-12
    assert differences[:, 1].max() < 1e-12
