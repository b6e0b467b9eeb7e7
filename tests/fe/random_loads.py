"""Random loads on random pairs of every family, and the gates that every result must pass.

Run it as ``python -m tests.fe.random_loads FIRST LAST`` for a table of what became of those seeds.
"""

import collections
import dataclasses
import sys

import numpy as np

from meshwright import Drive
from meshwright.base.errors import DesignError
from meshwright.fe.gate import LARGEST_ROTATION
from meshwright.fe.loaded import loaded_contact
from meshwright.fe.material import contact_modulus
from meshwright.fe.model import Load
from meshwright.fe.pair import first_touches
from meshwright.fe.solids import gear_pair
from tests.fe.line_designs import EQUAL_HOB, FZG_C14, H501
from tests.quick import ONE_OF_A_KIND

LINES = {"FZG C14": FZG_C14, "H501": H501, "equal hob": EQUAL_HOB}
DRIVES = (*ONE_OF_A_KIND, "bevel-crown-pair", "plain-za", "spherical-table-4-4-spur", *LINES)
OUT_OF_LINE = ("", "horizontal_deg", "vertical_deg")
#: Up to how much flanks are out of line, deg.
_TILT = 0.03
#: Powers of ten of the torque, N m.
_TORQUE = 0.0, 2.5
#: Moments of pressures and the torque differ by less than this part.
_EQUILIBRIUM = 1e-3
#: No pressure carries a force with less than this part of its mean over the cells, or of the least that lines need.
_POSSIBLE = 0.98


@dataclasses.dataclass(frozen=True)
class Outcome:
    """What became of one: ``kind`` such as "converged", and the gates that are ``broken``."""

    case: str
    kind: str
    broken: tuple[str, ...] = ()


def random_load(seed: int) -> Outcome:
    """A pair, out of line or not, at an angle within a pitch, under a torque on either member, on rigid teeth."""
    random = np.random.default_rng(seed)
    chosen = DRIVES[random.integers(len(DRIVES))]
    drive = LINES.get(chosen) or Drive.load(chosen)
    if drive in (FZG_C14, H501):
        crowning = random.choice([0.0, 10.0 ** random.uniform(-3.0, 1.3)])
        drive = drive.with_(design={"pinion_lead_crowning_um": float(crowning)})
    key, tilt, share = str(random.choice(OUT_OF_LINE)), float(random.uniform(-_TILT, _TILT)), random.uniform(-0.5, 0.5)
    torque, loaded = 1e3 * float(10.0 ** random.uniform(*_TORQUE)), str(random.choice(["pinion", "wheel"]))
    case = f"{seed}: {chosen} {key} {tilt:.4f} {torque / 1e3:.4g} N m"
    try:
        gear = gear_pair(drive.with_(misalignment={key: tilt}) if key else drive)
        angle = float(share * gear.pinion.pitch)
        if not first_touches(gear, angle, 3):
            return Outcome(case, "no pair touches")
        found = loaded_contact(gear, angle, 3, Load(torque, loaded), None)
    except DesignError as error:
        return Outcome(case, f"refused: {error}")
    except ArithmeticError as error:
        return Outcome(case, f"diverged: {error}")
    if abs(found.rotation) > LARGEST_ROTATION:
        return Outcome(case, "rotation not small")
    if found.unresolved:
        return Outcome(case, f"not resolved: {found.unresolved}")
    member = gear.pinion if loaded == "pinion" else gear.wheel
    modulus = contact_modulus(gear.pinion.material, gear.wheel.material)
    return Outcome(f"{case} {loaded} at {angle:.5f} rad", "converged", tuple(broken(found, member, modulus, torque)))


def broken(found, member, modulus, torque):
    """The gates that a loaded contact breaks, measured anew from cells and pressures."""
    origin, axis = member.axis
    moment = 0.0
    for pair in found.pairs:
        grid, p = pair.grid, pair.pressures
        arms = np.abs(np.cross(grid.points - origin, grid.frame[:, 2]) @ axis)
        moment += float((grid.area * p) @ arms)
        if not (np.isfinite(p).all() and (p >= 0.0).all()):
            yield f"pair {pair.contact.pairs_later} pulls"
        if p[grid.free[1]].any():
            yield f"pair {pair.contact.pairs_later} has pressure at a free border"
        pressed = p > 0.0
        if pair.force > 0.0 and p.max() < pair.force / grid.area[pressed].sum() * (1.0 - 1e-9):
            yield f"pair {pair.contact.pairs_later} has less than the mean pressure"
        if pair.hertz is not None and np.isfinite(pair.hertz.semi_major) and not pair.cut_off:
            # Nothing carries a force in the length that is pressed with less than a line under one pressure does.
            rows = pressed.reshape(grid.rows, -1).any(axis=1)
            length = float(2.0 * grid.half[:, 0].reshape(grid.rows, -1).mean(axis=1)[rows].sum())
            least = np.sqrt(pair.force * modulus * pair.contact.touch.curvature_max / (np.pi * length))
            if p.max() < _POSSIBLE * least:
                yield f"pair {pair.contact.pairs_later} peaks with {p.max():.5g} MPa below {least:.5g} MPa"
    if not abs(moment / torque - 1.0) < _EQUILIBRIUM:
        yield f"moment {moment:.6g} N mm, not {torque:.6g}"


def main(first, last):
    """A line for each seed that has no result or breaks a gate, and the counts."""
    counts = collections.Counter()
    for seed in range(first, last):
        outcome = random_load(seed)
        counts[outcome.kind.split(":")[0]] += 1
        counts["broken"] += bool(outcome.broken)
        if outcome.broken or outcome.kind != "converged":
            print(outcome.case, outcome.kind, *outcome.broken, sep=" | ", flush=True)
        if seed % 20 == 19:
            print(seed + 1, dict(counts), flush=True)
    print(dict(counts))


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
