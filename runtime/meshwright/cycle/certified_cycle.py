"""First contact over a mesh cycle with a proof: at which angles nothing else touches before the flanks of the pair that
leads do, at which something does, and where neither is shown.
"""

import math
from dataclasses import dataclass

import numpy as np

from meshwright.contact.results import ARCSEC
from meshwright.cycle import certified_first
from meshwright.cycle.certified_first_path import FirstAlongPath, certify_first_path
from meshwright.cycle.rigid import ROUND_OFF

#: Samples of a pair's window at which it is asked whether it leads, and halvings of what lies between two of them.
SAMPLES, HALVINGS = 257, 30

#: Neighbouring pairs on either side; what is kept from an end of contact, in pitches.
NEIGHBOURS, INSIDE = 1, 1e-6


@dataclass(frozen=True)
class CertifiedCycle:
    """``parts``: of each range of angles of the mesh cycle, in which the pair leads, what is shown there."""

    parts: tuple[FirstAlongPath, ...]

    @property
    def outcome(self):
        """``first`` at every angle of the cycle, ``not_first`` at one surely, or ``unknown``."""
        words = {part.outcome for part in self.parts}
        return "not_first" if "not_first" in words else "first" if words == {"first"} else "unknown"

    @property
    def clear(self):
        """Ranges (begin, end), rad, ascending, right-hand drive, at no angle of which something touches first."""
        return tuple(found for part in self.parts for found in _clear(part))

    def plain(self, sign):
        """``first_contact`` of the ``certificate`` of ``meshwright.ratio/1``; ``sign``: that of the design's hand."""
        spans = [span for part in self.parts for span in part.spans]
        return {
            "outcome": self.outcome,
            "overlap_below_mm": certified_first.SLACK,
            "turned_back_arcsec": max((part.reach / ARCSEC for part in self.parts), default=None),
            "cycle_deg": sorted(_degrees(sign, part.begin, part.end) for part in self.parts),
            "first_deg": sorted(_degrees(sign, *ends) for ends in self.clear),
            "spans": [_span(span, sign) for span in spans],
        }


def _degrees(sign, begin, end):
    return sorted((sign * math.degrees(begin), sign * math.degrees(end)))


def _span(span, sign):
    named, overlaps = math.isfinite(span.angle), span.outcome == "not_first"
    return {
        "pairs_later": span.later,
        "pinion_angle_deg": _degrees(sign, span.begin, span.end),
        "outcome": span.outcome,
        "reason": span.reason or None,
        "message": span.message,
        "at_pinion_angle_deg": sign * math.degrees(span.angle) if named else None,
        "overlap_arcsec": span.overlap / ARCSEC if overlaps else None,
        "at_every_angle": span.throughout if overlaps else None,
    }


def _clear(part):
    """Where all pairs of a part are first: the ranges of the first pair cut by those of the others."""
    kept = [(part.begin, part.end)]
    for later in part.pairs:
        held = [(span.begin, span.end) for span in part.of(later) if span.outcome == "first"]
        kept = [(max(a, c), min(b, d)) for a, b in kept for c, d in held if max(a, c) < min(b, d)]
    joined = []
    for begin, end in sorted(kept):
        if joined and begin <= joined[-1][1]:
            joined[-1] = (joined[-1][0], max(end, joined[-1][1]))
        else:
            joined.append((begin, end))
    return joined


def certified_cycle(mesh, window):
    """The :class:`CertifiedCycle` of a :class:`~meshwright.cycle.pairs.Mesh` and its
    :class:`~meshwright.cycle.certified.CertifiedWindow`; None where its ends are not shown.
    """
    if None in window.ends:
        return None
    drive, sign = mesh.drive, mesh.mirror
    inside = INSIDE * drive.pitch()
    low, high = window.ends[0][2] + inside, window.ends[1][1] - inside
    ranges = [sorted((sign * a, sign * b)) for a, b in leading(mesh)]
    ranges = sorted((max(a, low), min(b, high)) for a, b in ranges if max(a, low) < min(b, high))
    return CertifiedCycle(tuple(certify_first_path(drive, a, b, neighbours=NEIGHBOURS) for a, b in ranges))


def leading(mesh):
    """Ranges (begin, end) of a pair's own angles, rad, at which it leads those that are inside their windows with it:
    a pitch in all, or the window where that is shorter. Of pairs that touch together the one nearest the middle leads.
    """
    ends = sorted((mesh.window.begin.angle, mesh.window.end.angle))
    angles = np.linspace(*ends, SAMPLES)
    leads = _leads(mesh, angles)
    cuts = [ends[0], *(_cut(mesh, *angles[k : k + 2]) for k in np.flatnonzero(leads[1:] != leads[:-1])), ends[1]]
    return [(a, b) for a, b in zip(cuts, cuts[1:], strict=False) if _leads(mesh, np.array([0.5 * (a + b)]))[0]]


def _leads(mesh, angles):
    """Whether a pair leads, at its own angles (M,)."""
    pitch, own = mesh.drive.pitch(), mesh.errors(angles)
    low, high = sorted((mesh.window.begin.angle, mesh.window.end.angle))
    middle, reach = 0.5 * (low + high), math.ceil((high - low) / pitch)
    leads = np.ones(len(angles), dtype=bool)
    for k in (*range(-reach, 0), *range(1, reach + 1)):
        other = angles + k * pitch
        meshing = (low <= other) & (other <= high)
        if not meshing.any():
            continue
        other, before = other[meshing], mesh.sense * (mesh.errors(other[meshing]) - own[meshing])
        nearer = np.abs(other - middle) < np.abs(angles[meshing] - middle)
        leads[meshing] &= (before < -ROUND_OFF) | ((before <= ROUND_OFF) & ~nearer)
    return leads


def _cut(mesh, low, high):
    """Where between two angles a pair begins or ends to lead."""
    before = _leads(mesh, np.array([low]))[0]
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if _leads(mesh, np.array([middle]))[0] == before:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)
