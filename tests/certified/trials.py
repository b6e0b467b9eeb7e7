"""Seeded boxes of which it is known how many solutions they hold: nothing else may be claimed of any.

As a program, ``python -m tests.certified.trials 1000000 [seed]``: so many boxes over all kinds, what is shown of each
kind, and exit status 1 at the first wrong claim.
"""

import sys

import numpy as np

from meshwright import Drive
from meshwright.contact.branch import fold_angle
from meshwright.contact.certificate import certify, certify_boxes
from meshwright.contact.results import ARCSEC
from meshwright.cycle.path import Path

#: A design of every kind of drive.
DESIGNS = (
    "recess-action-full", "plain-za", "plain-zi", "plain-zk", "plain-zc", "spherical-table-2-2-convex-14-5",
    "helical-crowned", "face-worm-cylindrical-convex", "bevel-crowned-both", "bevel-formate",
    "bevel-face-hobbed",
)  # fmt: skip


class WrongClaimError(AssertionError):
    """A box is said to hold what it does not hold."""


def judged(drive, angles, centres, half, held):
    """Outcome → how often it is shown, of boxes that hold so many solutions ``held`` (N,)."""
    outcomes = np.array(certify_boxes(drive, angles, centres, half).outcomes)
    wrong = (outcomes == "unique") & (held != 1) | (outcomes == "none") & (held != 0)
    if wrong.any():
        k = int(np.flatnonzero(wrong)[0])
        box = f"{drive.design.family} at {angles[k]!r}: {centres[k].tolist()} +- {half[k].tolist()}"
        raise WrongClaimError(f"said to be {outcomes[k]}, holds {held[k]}: {box}")
    return {word: int(np.sum(outcomes == word)) for word in ("unique", "none", "unknown")}


def _certified(drive, angles, solutions):
    """The solutions (N, nx) to a double, certain to be some."""
    found = certify(drive, angles, solutions, np.zeros(len(angles)))
    assert set(found.outcomes) == {"unique"}
    return found.records["x"]["hi"][:, : drive.model.nx]


def _held(solutions, centres, half):
    """How many of the solutions (M, nx) each box holds, and whether that is sure of solutions that are doubles: none is
    nearer to a side than some of their last places.
    """
    off = np.abs(solutions[None] - centres[:, None]) / half[:, None]
    return np.sum(np.all(off < 1.0, axis=2), axis=1), np.all(np.abs(off - 1.0) * half[:, None] > 1e-13, axis=(1, 2))


def beside(rng, count):
    """The solution just inside or outside of one side, of boxes of many sizes, of every kind of drive."""
    for name in DESIGNS:
        drive, n = Drive.load(name), count // len(DESIGNS)
        angles = drive.design.reference_angle + np.sort(rng.uniform(-0.5, 0.5, n)) * drive.pitch()
        solutions = _certified(drive, angles, drive.trace(angles)[0])
        half = 10.0 ** rng.uniform(-8, -4, (n, 1)) * np.ones(drive.model.nx)
        side, inside = rng.integers(0, drive.model.nx, n), rng.random(n) < 0.5
        shift, gap = rng.uniform(-0.5, 0.5, half.shape), 10.0 ** rng.uniform(-5, -1, n)
        shift[np.arange(n), side] = np.where(inside, 1.0 - gap, 1.0 + gap) * rng.choice([-1.0, 1.0], n)
        yield drive, angles, solutions + shift * half, half, inside.astype(int)


def turned(rng, count):
    """The wheel an arcsecond off, into the pinion or away from it: there is no contact."""
    for name in DESIGNS:
        drive, n = Drive.load(name), count // len(DESIGNS)
        angles = drive.design.reference_angle + np.sort(rng.uniform(-0.5, 0.5, n)) * drive.pitch()
        centres = _certified(drive, angles, drive.trace(angles)[0]).copy()
        half = 10.0 ** rng.uniform(-9, -4, (n, 1)) * np.ones(drive.model.nx)
        error = drive.design.description["error"]
        half[:, error] = rng.uniform(0.01, 0.99, n) * ARCSEC
        centres[:, error] += rng.choice([-1.0, 1.0], n) * ARCSEC
        yield drive, angles, centres, half, np.zeros(n, int)


def lines(rng, count):
    """Boxes about points of a line of contact: a hob as large as the worm, a rack that cuts both."""
    worm = Drive.load("recess-action-full")
    radius = worm.design.as_solved()["design"]["worm_pitch_radius_mm"]
    for drive in (worm.with_(design={"hob_pitch_radius_mm": radius}), Drive.load("spherical-table-2-1")):
        angle, n = float(drive.design.reference_angle), count // 2
        found = drive.tca([angle])
        assert found.status == ("line_contact",)
        centre = found.solutions[0]
        half = 10.0 ** rng.uniform(-8, -2, (n, 1)) * np.ones(drive.model.nx)
        yield drive, np.full(n, angle), centre + rng.uniform(-0.1, 0.1, half.shape) * half, half, np.full(n, 9)


def fold():
    """A drive, the angle of a fold, and the sense in which its two contacts lie."""
    drive = Drive.load("zk-zn-90").with_(misalignment={"center_distance_mm": 0.02})
    start = np.radians(-60.0)
    for solution in drive.contacts(start).solutions:
        path = Path.through(drive, start, solution).extended(start + drive.pitch())
        if path.ended[1]:
            return drive, fold_angle(path, -1)
    raise AssertionError("no fold")


def _around(rng, drive, angle, solutions, n):
    """Boxes about, between and beside the solutions at one angle, all of them known."""
    spread = np.ptp(solutions, axis=0) + 1e-9
    shape = (n, solutions.shape[1])
    half = spread * rng.choice([1e-6, 1e-4, 1e-2, 0.2, 0.6, 1.1, 3.0], (n, 1)) * rng.uniform(0.5, 1.5, shape)
    half = np.maximum(half, 1e-12)
    between = solutions.mean(axis=0) + rng.uniform(-1.5, 1.5, shape) * spread
    near = solutions[rng.integers(0, len(solutions), n)] + rng.uniform(-1.1, 1.1, shape) * half
    centres = np.where(rng.random((n, 1)) < 0.7, near, between)
    held, clear = _held(solutions, centres, half)
    return drive, np.full(int(clear.sum()), angle), centres[clear], half[clear], held[clear]


def meeting(rng, count):
    """Two contacts that are about to meet in a fold: double roots but for a step in the angle."""
    drive, at = fold()
    for _ in range(10):
        angle = at - 10.0 ** rng.uniform(-6.0, -2.5)
        found = drive.contacts(angle).solutions
        apart = [np.abs(a - b).max() for a in found for b in found if a is not b]
        assert len(found) >= 2 and min(apart) < 1.0
        yield _around(rng, drive, angle, _certified(drive, np.full(len(found), angle), found), count // 10)


def crossing(rng, count):
    """About a pitchfork, at it and beside it: the branch that goes on, and those that leave it."""
    drive = Drive.load("zk-zn-90")
    (point,) = drive.limits().branch_points
    for off in np.radians([-0.3, -0.1, -0.03, 0.03, 0.1, 0.3]):
        angle = point.angle + float(off)
        found = drive.contacts(angle).solutions
        yield _around(rng, drive, angle, _certified(drive, np.full(len(found), angle), found), count // 8)
    n = count // 4
    beside = drive.tca([point.angle - 1e-5, point.angle + 1e-5]).solutions.mean(axis=0)
    half = 10.0 ** rng.uniform(-4, -2, (n, 1)) * np.ones(drive.model.nx)
    angles = point.angle + rng.choice([0.0, 1e-12, -1e-12], n)
    yield drive, angles, beside + rng.uniform(-0.3, 0.3, half.shape) * half, half, np.full(n, 3)


#: Kinds of boxes and their shares of a run.
KINDS = {beside: 0.4, turned: 0.2, lines: 0.1, meeting: 0.2, crossing: 0.1}


def run(count, seed, chunk=20_000):
    """Kind → outcome → how often it is shown, over ``count`` boxes; raises :class:`WrongClaimError`."""
    rng, shown = np.random.default_rng(seed), {}
    for kind, share in KINDS.items():
        total, left = dict.fromkeys(("unique", "none", "unknown"), 0), int(share * count)
        while left > 0:
            for boxes in kind(rng, min(left, chunk)):
                for word, number in judged(*boxes).items():
                    total[word] += number
            left -= chunk
        shown[kind.__name__] = total
    return shown


def main():
    count, seed = int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 1
    try:
        shown = run(count, seed)
    except WrongClaimError as wrong:
        print(f"wrong claim: {wrong}")
        return 1
    for kind, numbers in shown.items():
        print(f"{kind:<10}" + "".join(f" {word} {number:>8}" for word, number in numbers.items()))
    print(f"{sum(sum(numbers.values()) for numbers in shown.values())} boxes, no wrong claim")
    return 0


if __name__ == "__main__":
    sys.exit(main())
