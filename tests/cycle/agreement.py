"""Designs drawn at random over all packaged ones, and what two commands, or two parts of one result, say differently of
whether, how and where their teeth touch.
"""

from dataclasses import dataclass, field
from importlib import resources

import numpy as np

from meshwright import Drive
from meshwright.base.errors import DesignError
from meshwright.contact import analysis
from meshwright.contact.flags import not_first, on_flanks
from meshwright.contact.results import ARCSEC, TOUCHING
from meshwright.cycle.first_results import STATUSES
from meshwright.sweep import samples
from tests.cycle.test_plain_pairs import random_pair

PACKAGED = sorted(
    path.name.removesuffix(".toml")
    for path in resources.files("meshwright.designs").iterdir()
    if path.name.endswith(".toml")
)

#: Errors of an assembly by unit; how often a size changes, and by which shares, of mild and of wild designs.
ERRORS = {"mm": 0.1, "deg": 0.05}
CHANGED = {False: (0.12, (1e-4, 1e-3, 1e-2)), True: (0.25, (1e-2, 3e-2, 1e-1))}

#: Angles of a design, over so many pitches to either side; errors that are one, arcsec.
ANGLES = 4
PITCHES = 2.2
SAME = 1e-6


def equal_hob(drive):
    """The worm drive whose wheel is cut by a hob of the worm's own size."""
    worm = drive.with_(design={"hob_pitch_radius_mm": drive.design.as_solved()["design"]["worm_pitch_radius_mm"]})
    return worm.with_(design={"cutting_center_distance_mm": worm.design.value("center_distance_mm")})


def drawn(rng):
    """A design: a packaged one, a nearly plain pair or an equal hob, with sizes, errors and flank changed at random."""
    while True:
        try:
            drive = Drive.load(str(rng.choice(PACKAGED)))
            if drive.design.family == "cylindrical-worm" and rng.random() < 0.3:
                drive = equal_hob(drive)
            if drive.design.family == "cylindrical-gears" and rng.random() < 0.4:
                drive, _ = random_pair(rng)
            return drive.with_(**_changes(drive.design, rng))
        except DesignError:
            continue


def _changes(design, rng):
    changes, (often, shares) = {}, CHANGED[bool(rng.random() < 0.4)]
    for p in design.description["parameters"]:
        given = design.given().get(p["table"], {})
        if p["table"] == "misalignment" and rng.random() < 0.5:
            deep = 10.0 if p["key"] == "center_distance_mm" and rng.random() < 0.2 else 1.0
            size = ERRORS.get(p["key_unit"], 0.0) * deep * rng.choice([0.01, 0.1, 1.0, 1.0])
            changes.setdefault("misalignment", {})[p["key"]] = float(rng.normal() * size)
        elif p["table"] in ("design", "blank") and isinstance(given.get(p["key"]), float) and rng.random() < often:
            factor = 1.0 + float(rng.normal() * rng.choice(shares))
            changes.setdefault(p["table"], {})[p["key"]] = given[p["key"]] * factor
    if rng.random() < 0.4 and not design.description["flanks_apart"]:
        changes["flank"] = design.other_flank
    return changes


def disagreements(drive, rng):
    """Sentences on what is said differently; none if all agree."""
    return _Compared.of(drive, drive.about_the_middle(np.sort(rng.uniform(-PITCHES, PITCHES, ANGLES)))).all()


@dataclass
class _Compared:
    drive: Drive
    angles: np.ndarray
    result: object
    first: object
    flags: tuple
    said: list = field(default_factory=list)

    @classmethod
    def of(cls, drive, angles):
        result = drive.tca(angles)
        first = drive.first_contact(angles, result)
        return cls(drive, angles, result, first, not_first(result, first).flags)

    def all(self):
        for k in range(len(self.angles)):
            self.one_angle(k)
        self.a_sweep()
        self.the_ratio()
        self.other_orders()
        self.turning_on()
        return self.said

    def unless(self, holds, *words):
        if not holds:
            self.said.append(" ".join(map(str, words)))

    def one_angle(self, k):
        """``tca`` and its ``first_contact``."""
        kind, status, flags = self.first.kinds[k], self.result.status[k], self.flags[k]
        error, levers = self.result.error[k], self.first.levers
        self.unless(np.isfinite(error) == (status in TOUCHING), k, status, "with error", error)
        if kind is None:
            self.unless(status not in ("edge_contact", "corner_contact"), k, status, "without first contact")
            self.unless(status != "line_contact" or not self.first.untouched[k], k, "a line where nothing touches")
            clean = status == "converged" and on_flanks(flags)
            self.unless(not (clean and self.first.untouched[k]), k, "a contact where nothing touches")
        elif status != "converged":
            self.unless(status == STATUSES[kind], k, status, "first contact", kind)
            self.unless(abs(self.first.errors[k] - error) < SAME * ARCSEC, k, status, "another error first")
        elif on_flanks(flags) and "not_first" not in flags:
            self.unless(not (error - self.first.errors[k]) * levers[k] > 2e-6, k, "first contact comes later", kind)

    def a_sweep(self):
        """A sweep with the design as its one sample."""
        drive, result = self.drive, self.result
        keys = [p["key"] for p in drive.design.description["parameters"] if p["table"] == "misalignment"]
        given = drive.design.given().get("misalignment", {})
        values = np.array([[given.get(key) or 0.0 for key in keys]])
        found = samples.solve(drive, [f"misalignment.{key}" for key in keys], values, self.angles)
        words, names = analysis.statuses(), samples.flag_names(drive)
        status = tuple(words[code] for code in found.status[0].tolist())
        self.unless(status == result.status, "sweep", status, result.status)
        self.unless(self._same(found.error[0], result.error), "sweep: other errors")
        for k, bits in enumerate(found.flags[0].tolist()):
            flags = {name for bit, name in enumerate(names) if bits >> bit & 1}
            self.unless(flags == set(result.flags[k]), "sweep", k, flags, result.flags[k])

    def _same(self, here, there):
        return np.allclose(here / ARCSEC, there / ARCSEC, rtol=0.0, atol=SAME, equal_nan=True)

    def the_ratio(self):
        """Between the ends that ``ratio`` states the pair touches as ``tca`` says, beyond them it does not."""
        found = self.drive.contact_ratio()
        mesh, touching = found.mesh, found.status in TOUCHING
        self.unless(touching or not any(self.first.kinds), "ratio", found.status, "first contacts", self.first.kinds)
        if not mesh.window.complete:
            clean = [self._clean(k) for k in range(len(self.angles))]
            ends = found.begin.exists or found.end.exists or self.first.reason
            self.unless(not any(clean) or ends, "ratio: no window", found.status, self.result.status)
            return
        self.unless(touching, "ratio: a window with status", found.status)
        low, high = sorted((mesh.window.begin.angle, mesh.window.end.angle))
        beside, errors = 1e-6 * (high - low), mesh.errors(self.angles)
        for k, angle in enumerate(self.angles):
            if low + beside < angle < high - beside and not found.impossible:
                self._inside(k, mesh, errors[k])
            if not low - beside < angle < high + beside:
                self.unless(self.result.status[k] != "line_contact", k, "a line beyond the window")
                self.unless(mesh.path is None or not self._clean(k), k, "a contact beyond the window")
        there = self.drive.tca([mesh.mirror * mesh.middle])
        flagged = there.status[0] == "converged" and not on_flanks(there.flags[0])
        same = there.status[0] == found.status or found.impossible or flagged
        self.unless(same, "in the middle", there.status[0], "ratio", found.status)

    def _clean(self, k):
        """Whether the flanks touch in a point or along a line inside all their limits."""
        return self.result.status[k] == "line_contact" or (
            self.result.status[k] == "converged" and on_flanks(self.flags[k]) and "not_first" not in self.flags[k]
        )

    def _inside(self, k, mesh, error):
        status = self.result.status[k]
        self.unless(status in TOUCHING, k, "inside the window", status)
        if mesh.path is not None:
            self.unless(status == "converged" and on_flanks(self.result.flags[k]), k, "on a path", status)
        expected = self.result.error[k] if mesh.path is not None else self.first.errors[k]
        differs = abs(error - expected) > SAME * ARCSEC if np.isfinite(expected) else False
        self.unless(not differs, k, "ratio: another error")

    def other_orders(self):
        """What was asked before, and what is asked beside it, changes no result."""
        fresh = Drive.from_tables(self.drive.design.given())
        fresh.contact_ratio()
        again = fresh.tca(self.angles)
        self.unless(again.status == self.result.status, "after ratio", again.status, self.result.status)
        self.unless(self._same(again.error, self.result.error), "after ratio: other errors")
        for k, angle in enumerate(self.angles):
            (alone,) = fresh.tca([angle]).status
            self.unless(alone == self.result.status[k], k, "alone", alone, self.result.status[k])

    def turning_on(self):
        """A drive that turns on, one pair and all of them."""
        turned = self.drive.turn(self.angles)
        own = self.drive.tca(turned.own_angles)
        for k, status in enumerate(turned.statuses):
            self.unless((status == "converged") <= (own.status[k] in TOUCHING), k, "turned on", status, own.status[k])
            if own.status[k] == "converged":
                self.unless(abs(own.error[k] - turned.errors[k]) < SAME * ARCSEC, k, "turned on: another error")
        whole = self.drive.cycle(self.angles).drive
        for k in np.flatnonzero(np.isfinite(whole.pairs)):
            there = self.drive.tca([self.angles[k] - whole.pairs[k] * self.drive.pitch()])
            self.unless(there.status[0] == whole.statuses[k], k, "whole", whole.statuses[k], there.status[0])
            if there.status[0] == "converged":
                self.unless(abs(there.error[0] - whole.errors[k]) < SAME * ARCSEC, k, "whole: another error")
