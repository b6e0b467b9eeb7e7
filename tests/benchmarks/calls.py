"""What one call costs a user, processor time of one core: a whole analysis of many angles, a sweep with its files.

``Drive.tca`` gives contact geometry, flags and statuses of every point. The sweep draws its samples, solves them,
writes its rows as Parquet and gathers its statistics; it is run at two sizes, and the time of the size that is promised
is extrapolated from them only where time grows in proportion to the points.
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

#: Angles of a sample of the sweep, its samples at both sizes that are measured, and the points that are promised.
ANGLES, SAMPLES, PROMISED = 100, (4_000, 16_000), 10_000_000

#: Time is proportional to the points where the marginal cost of one is this near to the mean.
PROPORTIONAL = 0.15


def tca_points():
    """Points a second of ``Drive.tca`` over consecutive angles, and the share of them that are solved."""
    drive, angles = Drive.load(DESIGN), 0.3 + 1.75e-3 * np.arange(POINTS)
    solved = drive.tca(angles).solved.mean()
    return POINTS / best(lambda: drive.tca(angles), repeats=7), solved


def sweep_seconds(samples):
    """Processor seconds of a sweep with so many samples, on one thread, and the share of points that converge."""
    errors = ("center_distance_mm", 0.01), ("vertical_deg", 0.004), ("horizontal_deg", 0.004), ("axial_mm", 0.01)
    variations = tuple(sweep.Variation(f"misalignment.{key}", "normal", 0.0, size) for key, size in errors)
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
    (few, _), (many, converged) = (sweep_seconds(samples) for samples in SAMPLES)
    points = [samples * ANGLES for samples in SAMPLES]
    mean, marginal = many / points[1], (many - few) / (points[1] - points[0])
    line = f"sweep, {DESIGN}, {points[1]:.3g} points with Parquet and statistics, {100 * converged:.4g} % converged: "
    line += f"measured {many:.2f} CPU s ({points[0]:.3g} points: {few:.2f} s)"
    if abs(marginal - mean) <= PROPORTIONAL * mean:
        line += f"; in proportion {marginal * PROMISED:.1f} CPU s for {PROMISED:.0e} points"
    else:
        line += f"; not in proportion, {1e6 * marginal:.3g} µs a further point"
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    print(f"{line}; peak memory {peak:.0f} MB with the interpreter")


if __name__ == "__main__":
    report()
