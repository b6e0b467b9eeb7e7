"""What one call costs a user, processor time of one core: a whole analysis of many angles, a sweep with its files.

``Drive.tca`` gives contact geometry, flags and statuses of every point. The sweep draws its samples, solves them,
writes its rows as Parquet and gathers its statistics.
"""

import resource
import tempfile
import time
from pathlib import Path

import numpy as np

from meshwright import Drive
from meshwright.design.design import read
from meshwright.sweep import run as sweep
from tests.benchmarks.timing import best

DESIGN, POINTS = "recess-action-full", 20_000

#: Angles of a sample of the sweep, and its samples.
ANGLES, SAMPLES = 100, 100_000

#: So much larger errors take the contact away from some samples.
LARGE = 5.0


def tca_points():
    """Points a second of ``Drive.tca`` over consecutive angles, and the share of them that are solved."""
    drive, angles = Drive.load(DESIGN), 0.3 + 1.75e-3 * np.arange(POINTS)
    solved = drive.tca(angles).solved.mean()
    return POINTS / best(lambda: drive.tca(angles), repeats=7), solved


def sweep_seconds(samples, share=1.0):
    """Processor seconds of a sweep with so many samples, on one thread, and the share of points that converge.

    ``share``: of the usual errors of assembly.
    """
    errors = ("center_distance_mm", 0.01), ("vertical_deg", 0.004), ("horizontal_deg", 0.004), ("axial_mm", 0.01)
    variations = tuple(sweep.Variation(f"misalignment.{key}", "normal", 0.0, share * size) for key, size in errors)
    plan = sweep.Plan(read(DESIGN), variations, tuple(np.linspace(0.0, 2.0, ANGLES)), samples)
    with tempfile.TemporaryDirectory() as folder:
        begin = time.process_time()
        summary = sweep.run(plan, Path(folder) / "sweep", threads=1)
        return time.process_time() - begin, summary["points_converged"] / summary["points"]


def report():
    """Print both lines."""
    rate, solved = tca_points()
    print(f"Drive.tca, {DESIGN}, {POINTS} angles with geometry: {rate:.3g} points/s, {100 * solved:.4g} % solved")
    sweep_seconds(10)  # what is imported with the first sweep is no part of one
    for samples, share, words in ((SAMPLES, 1.0, ""), (SAMPLES // 10, LARGE, f" and errors {LARGE:g} times as large")):
        seconds, converged = sweep_seconds(samples, share)
        said = f"{samples * ANGLES:.0e} points with Parquet and statistics{words}, {100 * converged:.4g} % converged"
        print(f"sweep, {DESIGN}, {said}: {seconds:.2f} CPU s")
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    print(f"peak memory {peak:.0f} MB with the interpreter")


if __name__ == "__main__":
    report()
