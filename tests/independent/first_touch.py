"""First contact of two bounded flanks by brute force: no tangent, no normal and no equation of contact is used.

A point of the wheel's flank is turned about the wheel's axis until it lies on the pinion's flank. On each line across
the wheel's flank the largest such angle is looked for between the ends that all limits leave, found by bisection; then
the line with the largest one, in ever finer windows. Only positions of flanks, their limits and the bodies' placements
are used.
"""

from itertools import product

import numpy as np

from meshwright.base.library import pointer
from meshwright.contact.placement import placements_at

#: Samples of a line, lines of a window; how much narrower each window is, and how many.
SAMPLES, LINES, NARROWER, WINDOWS = 33, 13, 5.0, (14, 22)
#: How much narrower in each window the part of a line is that is sampled closely, beside the whole of it.
CLOSER = 0.55
BISECTIONS, STEPS = 46, 24


class Followed:
    """A flank that keeps a condition, as a function of all its parameters but the last, which the condition gives: from
    ``start`` by Newton's method, with slopes from differences; "not a number" where there is none.
    """

    def __init__(self, flank, start):
        self.flank, self.start = flank, start

    def __call__(self, q):
        last, h = np.full(len(q), self.start), 1e-7
        for _ in range(2 * STEPS):
            miss, beside = (self.flank(np.column_stack([q, last + by])).conditions[:, 0, 0] for by in (0.0, h))
            step = miss * h / (beside - miss)
            last = last - np.clip(step, -0.2, 0.2)
            if not (np.abs(step) > 1e-11).any():
                break
        return self.flank(np.column_stack([q, np.where(np.abs(step) < 1e-9, last, np.nan)]))


class FirstTouch:
    """The search for one drive (right hand) at one pinion angle; ``side`` +1: the wheel comes from larger angles."""

    def __init__(self, drive, angle, known, side):
        """``known``: unknowns of any contact of the pair; ``side``: from where the wheel comes."""
        pinion, wheel = drive.design.description["bodies"]
        self.error = drive.design.description["error"]
        self.pinion, self.wheel, self.side = drive.flank(pinion["name"]), drive.flank(wheel["name"]), side
        if wheel["conditions"]:
            self.wheel = Followed(self.wheel, known[wheel["unknowns"][-1]])
        still = known.copy()
        still[self.error] = 0.0
        turned = still.copy()
        turned[self.error] = 0.1
        placed = placements_at(drive, np.array([angle, angle]), np.stack([still, turned])).matrices
        self.fixed = placed[pinion["name"]][0]
        self.still = np.linalg.inv(self.fixed) @ placed[wheel["name"]][0]
        turn = placed[wheel["name"]][0, :3, :3].T @ placed[wheel["name"]][1, :3, :3]
        self.turn = np.sign(np.arctan2(turn[1, 0], turn[0, 0]))
        self.start = np.append(known[pinion["unknowns"]], known[self.error])
        scale = np.empty(drive.model.nx)
        drive.model.scale(pointer(drive.state()), pointer(scale))
        self.sizes = np.append(scale[pinion["unknowns"]], 1.0)

    def meet(self, q, start):
        """Pinion parameters and wheel angle (N, k + 1) at which wheel points meet the pinion's flank; NaN for none.

        Newton's method with slopes from differences of positions, until a step is below 1e-9 natural sizes.
        """
        r, x, h = self.wheel(q).points, start.copy(), 1e-7
        met, moving = np.full(x.shape, np.nan), np.arange(len(x))
        for _ in range(STEPS):
            here, at = r[moving], x[moving]
            miss = self._miss(here, at)
            steps = h * self.sizes * np.eye(x.shape[1])
            slopes = np.stack([(self._miss(here, at + e) - miss) / h for e in steps], axis=2)
            good = np.isfinite(slopes).all(axis=(1, 2)) & np.isfinite(miss).all(axis=1)
            good[good] = np.abs(np.linalg.det(slopes[good])) > 1e-14 * self.sizes.prod()
            moving, at = moving[good], at[good]
            step = np.linalg.solve(slopes[good], miss[good][:, :, None])[:, :, 0]
            size = np.abs(step).max(axis=1)
            x[moving] = at - self.sizes * step * np.minimum(1.0, 0.5 / np.maximum(size, 1e-300))[:, None]
            done = size < 1e-9
            met[moving[done]] = x[moving[done]]
            moving = moving[~done]
            if not moving.size:
                break
        return met

    def _miss(self, r, x):
        found = self.pinion(x[:, :-1])
        c, s = np.cos(self.turn * x[:, -1]), np.sin(self.turn * x[:, -1])
        turned = np.stack([c * r[:, 0] - s * r[:, 1], s * r[:, 0] + c * r[:, 1], r[:, 2]], axis=1)
        miss = found.points - turned @ self.still[:3, :3].T - self.still[:3, 3]
        return np.concatenate([miss, found.conditions[:, :, 0]], axis=1)

    def look(self, places, start):
        """Wheel angle times side (N,), -inf outside any limit, and where the points meet (N, k + 1).

        ``places`` (N, 2): on its line, and the line.
        """
        q = np.roll(places, self.along, axis=1)
        x = self.meet(q, start)
        known = np.isfinite(x).all(axis=1)
        inside = known.copy()
        for found in (self.wheel(q), self.pinion(np.where(known[:, None], x[:, :-1], self.start[:-1]))):
            for limit in (found.regular, *found.margins.values()):
                inside &= ~(limit < 0.0)
        return np.where(inside, self.side * x[:, -1], -np.inf), np.where(known[:, None], x, self.start)

    def highest(self, box):
        """The largest angle over a box (2, 2) of the wheel's parameters, rad (times side taken back).

        Of searches by lines along either parameter (a limit that runs along a line leaves little of it): whole lines
        sampled evenly, and the surroundings of the best place ever more closely.
        """
        ways = product((False, True), (0, 1))
        return self.side * max(self._search(box, closely, along) for closely, along in ways)

    def _search(self, box, closely, along):
        self.along = along
        (a_low, b_low), (a_high, b_high) = np.roll(box, -along, axis=1)
        centre, half = 0.5 * (b_low + b_high), 0.5 * (b_high - b_low)
        best, samples = -np.inf, np.linspace(a_low, a_high, SAMPLES)
        for window in range(WINDOWS[closely]):
            lines = np.linspace(centre - half, centre + half, 5 * LINES if window == 0 else LINES)
            values, places = self._on_lines(lines, samples)
            k = int(np.argmax(values))
            best = max(best, values[k])
            centre, half = lines[k], (3.0 * half if window == 0 else half * LINES) / (NARROWER * LINES / 2.0)
            if closely:
                near = 0.5 * (a_high - a_low) * CLOSER ** (window + 1) * np.linspace(-1.0, 1.0, SAMPLES // 2)
                close = np.clip(places[k] + near, a_low, a_high)
                samples = np.union1d(np.linspace(a_low, a_high, SAMPLES // 2 + 1), close)
        return best

    def _on_lines(self, lines, a):
        """The largest value on each line, and where: samples ``a``, the ends of the stretches inside all limits."""
        count = len(a)
        grid = np.stack(np.meshgrid(a, lines, indexing="ij"), axis=-1).reshape(-1, 2)
        values, x = self.look(grid, np.tile(self.start, (len(grid), 1)))
        values, x = values.reshape(count, -1), x.reshape(count, len(lines), -1)
        top = values.argmax(axis=0)
        best, places = values.max(axis=0), a[top]
        inside = np.isfinite(values)

        def take(chosen, found, at):
            order = np.argsort(found)  # the last of several for a line is the largest
            chosen, found, at = chosen[order], found[order], at[order]
            better = found > best[chosen]
            best[chosen[better]], places[chosen[better]] = found[better], at[better]

        pairs = [(i, i + 1) for i in range(count - 1)] + [(i + 1, i) for i in range(count - 1)]
        within, beyond = (np.array(side) for side in zip(*pairs, strict=True))
        pair, line = np.nonzero(inside[within] & ~inside[beyond])
        if pair.size:
            take(line, *self._end(a[within[pair]], a[beyond[pair]], lines[line], x[within[pair], line]))
        some = np.flatnonzero(np.isfinite(best))
        if some.size:
            take(some, *self._top(a, top[some], lines[some], x[top, np.arange(len(lines))][some]))
        return best, places

    def _end(self, inner, outer, lines, x):
        value = np.full(len(lines), -np.inf)
        for _ in range(BISECTIONS):
            middle = 0.5 * (inner + outer)
            found, at = self.look(np.stack([middle, lines], axis=1), x)
            good = np.isfinite(found)
            value, x = np.where(good, found, value), np.where(good[:, None], at, x)
            inner, outer = np.where(good, middle, inner), np.where(good, outer, middle)
        return value, inner

    def _top(self, a, top, lines, x):
        spacing = np.diff(a)
        half = np.maximum(np.append(spacing, 0.0), np.append(0.0, spacing))[top]
        centre, best, rows = a[top], np.full(len(top), -np.inf), np.arange(len(top))
        for _ in range(14):
            trial = centre[:, None] + half[:, None] * np.linspace(-1.0, 1.0, 9)
            places = np.stack([trial, np.broadcast_to(lines[:, None], trial.shape)], axis=-1).reshape(-1, 2)
            values, _ = self.look(places, np.repeat(x, 9, axis=0))
            values = values.reshape(trial.shape)
            k = values.argmax(axis=1)
            best = np.maximum(best, values[rows, k])
            centre, half = trial[rows, k], half / 3.0
        return best, centre
