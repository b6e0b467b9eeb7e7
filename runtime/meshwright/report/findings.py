"""What the numbers say, in words: headline figures and the sentences under them."""

import math
from collections import Counter
from dataclasses import dataclass

import numpy as np

from meshwright.contact import words
from meshwright.contact.results import ARCSEC, TOUCHING, impossible
from meshwright.cycle import room
from meshwright.cycle.backlash import meaning
from meshwright.cycle.ends import event, why_open, without_contact
from meshwright.cycle.pairs import Mesh
from meshwright.cycle.transmission import ROUND_OFF, changes
from meshwright.flank.pointed import pointed
from meshwright.report.numbers import fixed, number

#: What negative backlash means.
_JAMS = "The teeth are thicker than the spaces (negative backlash): the drive jams."


@dataclass(frozen=True)
class Tile:
    """A headline number with its unit and a line of explanation."""

    label: str
    value: str
    unit: str
    note: str


@dataclass(frozen=True)
class Finding:
    """A sentence; ``kind`` is good, warn or note."""

    kind: str
    text: str


def tiles(analysis):
    """The headline numbers of an analysis."""
    teeth = f"teeth {analysis.teeth['pinion']} : {analysis.teeth['wheel']}"
    shown = [Tile("Gear ratio", number(1.0 / analysis.drive.ratio), "", teeth)]
    running = analysis.running
    if running is not None:
        mesh = running.mesh
        shown += [
            Tile("Contact ratio", fixed(mesh.contact_ratio, 3), "", "pitches from begin to end"),
            Tile("Teeth in contact", _span(running.teeth), "", _averages(mesh)),
            _error_tile(running),
        ]
        if math.isfinite(running.backlash):
            shown.append(_backlash_tile(running.backlash))
    axes = analysis.tca.semi_axes[np.isfinite(analysis.tca.semi_axes).all(axis=1)]
    if len(axes):
        shown.append(
            Tile(
                "Contact ellipse",
                f"{_range(axes[:, 0])} × {_range(axes[:, 1])}",
                "mm",
                f"semi-axes at {number(analysis.drive.design.value('separation_mm', 'contact'))} mm separation",
            )
        )
    return shown


def _error_tile(running):
    if not running.known:
        return Tile("Transmission error", "–", "", "no pair touches within its limits")
    if running.constant:
        return Tile("Transmission error", "0", "arcsec", "constant to round-off")
    drive, pair = (
        number(e / ARCSEC, 4) for e in (running.error.envelope_peak_to_peak, running.error.pair_peak_to_peak)
    )
    return Tile("Transmission error", drive, "arcsec", f"peak to peak of the drive; one pair {pair} arcsec")


def _backlash_tile(backlash):
    value = 0.0 if abs(backlash) < ROUND_OFF else backlash / ARCSEC
    return Tile("Backlash", number(value, 4), "arcsec", meaning(backlash))


def _range(values):
    low, high = number(values.min(), 3), number(values.max(), 3)
    return low if low == high else f"{low}–{high}"


def _span(teeth):
    low, high = int(teeth.min()), int(teeth.max())
    return str(low) if low == high else f"{low}–{high}"


def _averages(mesh):
    return (
        f"average {fixed(mesh.average_over_pitch(), 3)} over a pitch, "
        f"{fixed(mesh.average_begin_to_end(), 3)} from begin to end"
    )


def findings(analysis):
    """What a reader should know before the figures."""
    said = _window(analysis) + _statuses(analysis) + _flags(analysis) + _first(analysis)
    said += [Finding("warn", _sentence(str(member))) for member in pointed(analysis.drive)]
    said += _error(analysis) + _loaded(analysis)
    if not any(f.kind == "warn" for f in said):
        said.insert(0, Finding("good", "Every position was solved to a contact that bodies can make."))
    said.append(Finding("note", _sentence(analysis.drive.certify(analysis.tca.angles, analysis.tca).said())))
    return said


def _jams(analysis):
    """That the drive jams, and which sizes of its design would give it room."""
    helps = room.said(room.room(analysis.drive, analysis.running.backlash))
    return Finding("warn", _JAMS + (f" What gives it room, one at a time: {helps}." if helps else ""))


def _sentence(words):
    return f"{words[0].upper()}{words[1:]}."


def _loaded(analysis):
    """Why there are no figures under load at some angles, and where an edge cuts a contact off."""
    if analysis.loaded is None:
        return []
    counted = Counter(point["message"] for point in analysis.loaded["points"] if point["message"])
    total = len(analysis.loaded["points"])
    return [Finding("note", f"Under load, at {n} of {total} angles: {message}.") for message, n in counted.items()]


def _window(analysis):
    mesh = Mesh.of(analysis.drive)
    said = [Finding("warn", f"Contact ratio {fixed(mesh.contact_ratio, 3)}, below 1: {apart}.")] if (
        apart := without_contact(mesh)) else []  # fmt: skip
    if analysis.running is None:
        return said
    window, why = mesh.window, why_open(mesh)
    said += [
        Finding("note", f"Contact {name} at {_deg(end.angle, 3)} of the pinion, at {event(end.reason, end.member)}.")
        for name, end in (("begins", window.begin), ("ends", window.end))
        if end.exists
    ]
    return said + ([Finding("note", _sentence(why))] if why else [])


def _deg(angle, decimals):
    return f"{fixed(math.degrees(angle), decimals)}°"


def _statuses(analysis):
    tca = analysis.tca
    counted = Counter(m for s, m in zip(tca.status, tca.messages, strict=True) if s != "converged")
    total = len(tca.status)
    word = dict(zip(tca.messages, tca.status, strict=True))
    return [
        Finding("note" if word[message] in TOUCHING else "warn", f"At {n} of {total} positions {message}.")
        for message, n in counted.items()
    ]


def _flags(analysis):
    counted = Counter(flag for flags in analysis.tca.flags for flag in flags)
    total = len(analysis.tca.flags)
    return [
        Finding("warn" if impossible(flag) else "note", f"At {n} of {total} positions {words.flag(flag)}.")
        for flag, n in counted.items()
    ]


def _first(analysis):
    """Where a tangency that is not the first contact lies deepest in the other flank, and what touches before it."""
    late = np.array(["not_first" in flags for flags in analysis.tca.flags], dtype=bool)
    if not late.any():
        return []
    overlaps = np.where(late, analysis.first.overlaps(analysis.tca.error), -np.inf)
    k = int(np.argmax(overlaps))
    where = ", ".join(number(v, 4) for v in analysis.first.points[k])
    return [
        Finding(
            "warn",
            f"At {_deg(analysis.tca.angles[k], 2)} the tangency of the equations lies "
            f"{number(1000.0 * overlaps[k], 4)} µm inside the other flank: first contact is "
            f"{analysis.first.words(k)}, at ({where}) mm in the fixed frame, "
            f"with {number(analysis.first.errors[k] / ARCSEC, 4)} arcsec instead of "
            f"{number(analysis.tca.error[k] / ARCSEC, 4)}.",
        )
    ]


def _error(analysis):
    if analysis.running is None:
        return []
    error, said = analysis.running.error, []
    if error.rides_on_edge:
        said.append(
            Finding(
                "note",
                "The leading pair stands at an end of its window when it hands over: the drive's transmission error "
                "steps there instead of passing smoothly from pair to pair. With the edges of rigid teeth it is "
                f"{number(error.envelope_with_edges_peak_to_peak / ARCSEC, 4)} arcsec peak to peak.",
            )
        )
    if analysis.running.constant:
        said.append(Finding("note", "The transmission error is constant to round-off: the drive turns uniformly."))
    if analysis.running.backlash < -ROUND_OFF:
        said.append(_jams(analysis))
    if at := " and ".join(_deg(a, 2) for a in changes(analysis.running.mesh, error.transfers)):
        said.append(Finding("note", f"Neighbouring pairs agree, so that one can take over from the other, at {at}."))
    return said
