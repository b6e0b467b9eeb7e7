"""A line of contact, proved: all along a curve from end to end of both flanks, how far these stand apart.

Rounding leaves no equation that holds exactly along a curve. What is shown is an enclosure: at every point of the curve
both flanks, inside all their limits, lie within so much of one another, with the wheel at the angle at which they touch
first.
"""

from dataclasses import dataclass

import numpy as np

from meshwright.base.library import library, pointer, record, text
from meshwright.contact import exact
from meshwright.contact.certificate import OUTCOMES
from meshwright.contact.placement import placed

#: Points of the line that a polynomial goes through.
TERMS = 5

#: What is left out at either end, mm: there limits are not told.
LEFT_OUT = 1e-7

#: Bounds of the gap are no further apart than this, mm of arc at the wheel, the first for which they can be shown;
#: above the other it is no line.
FINE = (1e-10, 1e-9)
LINE = 1.001e-9


@dataclass(frozen=True)
class CertifiedLine:
    """``apart``: bounds of how far the flanks stand apart along the line, mm of arc of the wheel, which the distance
    between them does not exceed; negative where they overlap. ``ended``: whether, beyond either end, a limit surely
    ends it within twice LEFT_OUT. ``parts``: of the curve that were looked at. ``reason``: why nothing is shown, "".
    ``nearest``: somewhere on it the flanks stand apart by no more than this, rad of the wheel.
    """

    apart: tuple[float, float] | None
    ended: tuple[bool, bool]
    parts: int
    reason: str
    nearest: float

    @property
    def shown(self):
        return self.apart is not None

    def plain(self):
        """The entry ``contact_line`` of a certificate of ``meshwright.tca/1``."""
        return {
            "outcome": "enclosed" if self.shown else "unknown",
            "by": "enclosure" if self.shown else None,
            "reason": self.reason or None,
            "apart_mm": list(self.apart) if self.shown else None,
            "left_out_mm": LEFT_OUT if self.shown else None,
            "ended_by_limits": list(self.ended),
            "parts": self.parts,
        }


class Posed:
    """Flanks at an angle of the right-hand drive, for proofs; ``ends`` (8,): lowest and highest of their parameters."""

    def __init__(self, drive, angle, ends):
        self.drive, self.angle, self.ends = drive, float(angle), ends
        self.work = np.empty(library().mw_certify_first_work())

    def first(self, wheel_angle, x, slack, reach, effort):
        """The ``mw_first_certificate`` of a wheel at an angle, looked at from the place x (nx,)."""
        found = np.zeros(1, record("mw_first_certificate"))
        how = slack, reach, int(effort)
        self._asked(library().mw_certify_first, wheel_angle, x, how, found, "mw_first_certificate[]")
        return found[0]

    def along(self, wheel_angle, x, curve, fine):
        """The ``mw_line_certificate`` of a curve, polynomials (4, TERMS), with the wheel at an angle."""
        found = np.zeros(1, record("mw_line_certificate"))
        curve = np.ascontiguousarray(curve)
        self._asked(library().mw_certify_line, wheel_angle, x, (pointer(curve), fine), found, "mw_line_certificate[]")
        return found[0]

    def _asked(self, of, wheel_angle, x, how, found, kind):
        drive, entry = self.drive, np.zeros(1, record("mw_certificate"))
        entry["outcome"] = OUTCOMES.index("unique")
        entry["x"]["hi"][0, : drive.model.nx] = x
        entry["wheel_angle"]["mid"] = wheel_angle
        body = drive.design.description["bodies"][0]
        stand = placed(drive, [self.angle], [wheel_angle]).matrices[body["name"]][0]
        at = drive.flank(body["name"])(x[body["unknowns"]])
        entry["point"]["mid"] = stand[:3, :3] @ at.points[0] + stand[:3, 3]
        entry["normal"]["mid"] = stand[:3, :3] @ at.normals[0]
        angles, state = exact.doubles(np.array([self.angle])), drive.enclosed.state.copy()
        of(
            drive.enclosed.model, pointer(state, "mw_wide[]"), pointer(angles, "mw_wide[]")[0],
            pointer(entry, "mw_certificate[]"), pointer(self.ends), *how, pointer(self.work), pointer(found, kind),
        )  # fmt: skip


def certified_line(posed, wheel_angle, x, lines, radius):
    """The :class:`CertifiedLine` with the wheel at an angle. ``lines``: one after the other, the same
    :class:`~meshwright.cycle.touching_line.TouchingLine` by points ever closer; ``radius``: the largest distance of its
    points from the wheel's axis, mm.
    """
    parts, reason = 0, ""
    for line, fine in ((line, fine) for line in lines for fine in FINE):
        stretches = _stretches(posed.drive, line)
        found = []
        for curve in stretches[1:-1]:
            found.append(posed.along(wheel_angle, x, curve, fine / radius))
            parts += int(found[-1]["parts"])
            if reason := text(library().mw_reason_word(int(found[-1]["reason"]))):
                break
        if not reason and not all(entry["limit"][0] > 0.0 for entry in found):
            reason = "off_flank"
        if reason:
            continue
        low, high = min(e["apart"][0] for e in found), max(e["apart"][1] for e in found)
        if max(-low, high) * radius > LINE:
            reason = "wide"
            continue
        beyond = [posed.along(wheel_angle, x, curve, fine / radius) for curve in (stretches[0], stretches[-1])]
        ended = tuple(bool(entry["outcome"] and entry["limit"][1] < 0.0) for entry in beyond)
        apart = float(np.nextafter(low * radius, -np.inf)), float(np.nextafter(high * radius, np.inf))
        return CertifiedLine(apart, ended, parts, "", min(float(e["nearest"]) for e in found))
    return CertifiedLine(None, (False, False), parts, reason or "effort", np.inf)


def _stretches(drive, line):
    """Polynomials (4, TERMS) in [-1, 1] of the parameters of the wheel, then of the pinion, along a line but for its
    LEFT_OUT ends; before and after them, of as much beyond either.
    """
    pinion, wheel = (body["unknowns"] for body in drive.design.description["bodies"])
    values = line.unknowns(drive)[:, [*wheel, *pinion]]
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line.points, axis=0), axis=1))])
    kept = np.concatenate([[True], np.diff(along) > LEFT_OUT])
    values, along = values[kept], along[kept]
    first, last = along[0] + LEFT_OUT, along[-1] - LEFT_OUT
    groups = []
    for k in range(0, max(len(along) - 1, 1), TERMS - 1):
        begin = max(min(k, len(along) - TERMS), 0)
        chosen = slice(begin, begin + TERMS)
        low, high = along[k], along[min(k + TERMS - 1, len(along) - 1)]
        groups.append((along[chosen], values[chosen], max(low, first), min(high, last)))
    before = (*groups[0][:2], along[0] - 2.0 * LEFT_OUT, along[0] - LEFT_OUT)
    after = (*groups[-1][:2], along[-1] + LEFT_OUT, along[-1] + 2.0 * LEFT_OUT)
    return [_polynomials(*group) for group in (before, *groups, after)]


def _polynomials(at, values, low, high):
    """Coefficients (4, TERMS) by t in [-1, 1], between two lengths, of what takes ``values`` (n, 4) at lengths (n,)."""
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    far = max(np.abs(at - middle).max(), half)
    matrix = np.vander((at - middle) / far, increasing=True)
    found = np.zeros((TERMS, values.shape[1]))
    found[: len(at)] = np.linalg.solve(matrix, values)
    return (found * ((half / far) ** np.arange(TERMS))[:, None]).T
