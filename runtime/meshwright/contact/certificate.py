"""Certified contact: a proof, point by point, that the equations have a solution, that it is the only one nearby, and
how far the transmission error and the contact point can be off.

What is proved is of the equations, for the decimals of the design: see :class:`Certificates`.
"""

import operator
import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from numbers import Rational
from typing import ClassVar, Protocol

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.library import ffi, library, pointer, proofs, record, text
from meshwright.contact import exact
from meshwright.contact.analysis import flag_names
from meshwright.contact.model import DriveModel
from meshwright.contact.results import impossible

#: Transmission errors of one contact that was found twice are as near as this, rad.
SAME = 1e-14

#: Outcomes by their number in the library.
OUTCOMES = ("unknown", "unique", "none")


@dataclass(frozen=True)
class EnclosedDesign:
    """What follows from the decimals of a design, enclosed: the state (slots,) of ``mw_wide``, without an angle.

    ``failed``: name of the design system whose solution cannot be enclosed, None if all can.
    """

    model: object
    state: np.ndarray
    parameters: np.ndarray
    failed: str | None

    @classmethod
    def of(cls, design, m, systems=ffi.NULL):
        """The design, completed by rules and design systems and set up, all in double-double with error bounds.

        ``systems``: ``mw_proof[]``, filled in with the proofs of the design systems.
        """
        numbers = _completed(design.description, _given(design)).values()
        p = exact.wides([None if number is None else (number, number) for number in numbers])
        parameters, slots = pointer(p, "mw_wide[]"), library().mw_enclosed_slots(m)
        failed = library().mw_prove_design(m, parameters, pointer(np.empty(m.np + 1)), systems)
        state = np.full(slots, np.nan, dtype=record("mw_wide"))
        if not failed:
            library().mw_enclose_setup(m, parameters, pointer(state, "mw_wide[]"))
        name = text(m.systems[failed - 1].name) if 0 < failed <= m.nsystems else ("" if failed else None)
        return cls(m, state, p, name)


class ProvedModel(DriveModel, Protocol):
    """A drive as proofs of its contact see it."""

    @property
    def enclosed(self) -> EnclosedDesign:
        """The design's state, enclosed."""
        ...


def _given(design):
    """Exact numbers that the design gives, by symbol, in the unit of the key; None where it leaves one open."""
    for p in design.description["parameters"]:
        word = design.tables["flank"] if p["table"] == "flank" else design.tables[p["table"]].get(p["key"])
        if word is None:
            yield p["name"], None
        else:
            yield p["name"], Fraction(p["choices"][word]) if p["choices"] else exact.decimal(word)


def _completed(description, given):
    """The same with what defaults and rules make of them that are sums: the sum of an angle and its opposite is 0, of
    their enclosures only near it. What another rule may fill is left to it, and to enclosures all that follows.
    """
    numbers, enclosed = dict(given), set()
    names = [description["parameters"][index]["name"] for index in description["rules"]]
    for name, terms in zip(names, description["exact_rules"], strict=True):
        if numbers[name] is not None or name in enclosed:
            continue
        if terms is None or enclosed & terms.keys():
            enclosed.add(name)
        elif None not in (values := [numbers.get(of, Fraction(1)) for of in terms]):
            numbers[name] = sum(map(operator.mul, map(Fraction, terms.values()), values))
    return numbers


class InWords:
    """The ``records`` (N,) of the library in words; ``WORDS`` are those of an outcome, by its number there."""

    WORDS: ClassVar[tuple[str, ...]]
    records: np.ndarray

    @property
    def outcomes(self):
        return tuple(self.WORDS[k] for k in self.records["outcome"])

    @property
    def reasons(self):
        """Why nothing is shown, a word each; empty where something is."""
        return tuple(text(library().mw_reason_word(int(k))) for k in self.records["reason"])

    @property
    def messages(self):
        """The same in a sentence."""
        return tuple(text(library().mw_reason_text(int(k))) for k in self.records["reason"])


@dataclass(frozen=True)
class Shown:
    """Of how many contacts, of a ``total``, it is shown that each is the only one nearby; the largest ``width``,
    arcseconds to either side, of their transmission errors; why others are not, counted; of how many ``besides`` the
    like is shown otherwise.
    """

    count: int = 0
    total: int = 0
    width: float = 0.0
    others: Counter = field(default_factory=Counter)
    besides: int = 0

    def __add__(self, more):
        width = max(self.width, more.width)
        sums = self.count + more.count, self.total + more.total
        return Shown(*sums, width, self.others + more.others, self.besides + more.besides)

    def said(self):
        """The same in a sentence."""
        if not self.total:
            return ""
        why = "; ".join(f"{message} (at {_angles(count)})" for message, count in self.others.items())
        if not self.count:
            return f"not certified: {why}"
        every = self.count == self.total and not self.besides
        number = "every contact" if every else f"{self.count} of {self.total} contacts"
        rest = f"; not: {why}" if why else ""
        return f"certified: {number} the only one nearby, transmission error within {self.width:.0e} arcsec{rest}"


@dataclass(frozen=True)
class Certificates(InWords):
    """What is shown at N pinion angles.

    ``outcomes``: ``unique``: the equations of contact have exactly one solution within ``boxes`` (N, nx) of the one
    found, and it lies in the enclosures; ``none``: they have none in the box asked for; ``unknown``: neither is shown,
    for the reason in ``reasons``, which is evidence of nothing. ``records`` (N,) are the library's own, ``angles`` (N,)
    of ``mw_wide`` the pinion angles of the right-hand drive. Each is for the exact decimals of the design and for the
    exact angle; that floating point found the same is not assumed.
    """

    WORDS: ClassVar = OUTCOMES
    drive: ProvedModel
    records: np.ndarray
    angles: np.ndarray

    @property
    def boxes(self):
        """Half-widths (N, nx) of the boxes in which the solution is the only one."""
        return self.records["box"][:, : self.drive.model.nx]

    def error(self, k):
        """Bounds of the transmission error at point k, rad, as fractions; None where it is not enclosed."""
        entry = self.records["x"][k, self.drive.design.description["error"]]
        if self.records["outcome"][k] != OUTCOMES.index("unique"):
            return None
        low, high = exact.bounds(entry)
        return (low, high) if self.drive.design.mirror.sign > 0.0 else (-high, -low)

    def error_arcsec(self):
        """Bounds (N, 2) of the transmission error, arcseconds, rounded outwards; NaN where it is not enclosed."""
        ends = [self.error(k) for k in range(len(self.records))]
        return np.array([(np.nan, np.nan) if e is None else exact.arcseconds(*e) for e in ends]).reshape(-1, 2)

    def flags(self, k):
        """(name → "yes", "no" or "undecided") of every flag of the model at point k."""
        yes, open_ = int(self.records["flags"][k]), int(self.records["undecided"][k])
        found = {}
        for bit, name in enumerate(flag_names(self.drive.model)):
            word = "yes" if yes >> bit & 1 else "undecided" if open_ >> bit & 1 else "no"
            found[name] = max(found.get(name, "no"), word, key=("no", "undecided", "yes").index)
        return found

    def impossible(self, k):
        """Names of the flags by which bodies surely cannot make the contact at point k."""
        return [name for name, word in self.flags(k).items() if word == "yes" and impossible(name)]

    def shown(self, without=()):
        """What is :class:`Shown` of all but those at some rows, of which the like is shown otherwise."""
        left = [k for k in range(len(self.records)) if k not in without]
        errors = self.error_arcsec()[left]
        outcomes, reasons, messages = self.outcomes, self.reasons, self.messages
        count = sum(outcomes[k] == "unique" for k in left)
        width = float(np.nanmax(errors[:, 1] - errors[:, 0])) / 2 if count else 0.0
        return Shown(count, len(left), width, Counter(messages[k] for k in left if reasons[k]), len(without))

    def said(self, without=()):
        """In a sentence, how many contacts are certain, and why others are not; of all but those at some rows."""
        return self.shown(without).said()

    def to_plain(self):
        """A certificate each, as plain data of the ``meshwright.tca/1`` schema."""
        errors = self.error_arcsec()
        return [self._plain(k, *errors[k]) for k in range(len(self.records))]

    def _plain(self, k, low, high):
        outcome, reason = self.outcomes[k], self.reasons[k]
        shown = outcome == "unique"
        names = [u["name"] for u in self.drive.design.description["unknowns"]]
        entry = self.records[k]
        return {
            "outcome": outcome,
            "reason": reason or None,
            "message": self.messages[k],
            "transmission_error_arcsec": [float(low), float(high)] if shown else None,
            "radius": exact.upwards((Fraction(float(high)) - Fraction(float(low))) / 2) if shown else None,
            "contact_point_mm": self._point(entry["point"]) if shown else None,
            "contact_point_radius_mm": float(entry["point"]["radius"].max()) if shown else None,
            "unique_within": dict(zip(names, map(float, self.boxes[k]), strict=True)) if shown else None,
            "flags": self.flags(k) if shown else {},
            "impossible": self.impossible(k) if shown else [],
        }

    def _point(self, balls):
        return (balls["mid"] * self.drive.design.mirror.flip).tolist()


def _angles(count):
    return "1 angle" if count == 1 else f"{count} angles"


def certify(drive, angles, solutions, lines, degrees=None):
    """:class:`Certificates` of contacts found in floating point.

    ``angles`` (N,) rad, of the design's hand, each the exact double that it is; ``solutions`` (N, nx) the unknowns
    there, ``lines`` (N,) where the flanks touch along a line. ``degrees``: the angles as exact fractions of degrees, if
    they were given so.
    """
    sign = int(drive.design.mirror.sign)
    if degrees is not None and not (
        isinstance(degrees, Sequence) and len(degrees) == len(angles) and all(isinstance(d, Rational) for d in degrees)
    ):
        raise UsageError(f"degrees: must be exact; give {len(angles)} fractions, one an angle")
    phi = exact.doubles(sign * np.asarray(angles)) if degrees is None else exact.angles(degrees, sign)
    solutions, lines = np.ascontiguousarray(solutions, dtype=float), np.ascontiguousarray(lines, dtype=np.int32)
    return _all(drive, phi, library().mw_certify_points, pointer(solutions), pointer(lines, "int[]"))


def refined(drive, result, certificates):
    """The :class:`~meshwright.contact.results.TCA` with the transmission errors of its :class:`Certificates`, each the
    double nearest to the middle of its enclosure, and wheel angles that go with them; as it was where nothing is shown.

    In plain doubles an error is off by some 1e-11 arcseconds, with sizes above 100 mm by 1e-10.
    """
    shown = certificates.records["outcome"] == OUTCOMES.index("unique")
    nearest = drive.design.mirror.sign * certificates.records["x"][:, drive.design.description["error"]]["hi"]
    error = np.where(shown, nearest, result.error)
    same = np.flatnonzero(result.error == result.reference_error)
    if same.size or not np.isfinite(result.reference_error):
        reference = error[same[0]] if same.size else result.reference_error
    else:
        reference = _reference(drive, result.reference_error)
    wheel_angles = result.wheel_angles + (error - result.error)
    return replace(result, error=error, wheel_angles=wheel_angles, reference_error=float(reference))


def certify_contacts(drive, result, degrees=None):
    """The :class:`Certificates` of a TCA; ``degrees`` as of :func:`certify`."""
    lines = [word == "line_contact" for word in result.status]
    return certify(drive, result.angles, result.solutions, lines, degrees)


def checked_certificates(drive, result, certificates):
    """The :class:`Certificates` of a TCA: ``certificates``, if they can be these, or made anew if they are None."""
    if certificates is None:
        return certify_contacts(drive, result)
    if not isinstance(certificates, Certificates) or len(certificates.records) != len(result.angles):
        raise UsageError("certificates: no proofs of these contacts; give what certify(angles, result) returns")
    return certificates


def _reference(drive, error):
    """The transmission error at the reference angle, refined; as it is if that is of another contact."""
    one = drive.tca([drive.design.mirror.sign * drive.design.reference_angle])
    if not abs(one.error[0] - error) < SAME:
        return error
    return refined(drive, one, certify_contacts(drive, one)).error[0]


def certify_boxes(drive, angles, centres, half_widths):
    """:class:`Certificates` of given boxes: unknowns ``centres`` ± ``half_widths`` (N, nx), of the right-hand model at
    its own angles (N,), rad.
    """
    phi = exact.doubles(angles)
    centres, half_widths = (np.ascontiguousarray(a, dtype=float) for a in (centres, half_widths))
    if centres.shape != (len(phi), drive.model.nx) or half_widths.shape != centres.shape:
        raise UsageError(f"boxes: centres and half-widths must be arrays ({len(phi)}, {drive.model.nx})")
    return _all(drive, phi, library().mw_certify_boxes, pointer(centres), pointer(half_widths))


def certify_many(drive, angles, solutions, width=0):
    """Uniqueness (N,) and bounds of the transmission error (N, 2), rad, of many contacts of one design, in lanes.

    ``angles`` (N,) rad and ``solutions`` (N, nx) of the right-hand drive; ``width``: numbers in a vector, 0 for the
    widest that this processor has, 1 for one contact after the other. The bounds are those of doubles, about 1e-8
    arcseconds apart. What does that in lanes is compiled when a drive is first asked for it, unless the package has it.
    """
    lanes = ffi.NULL if width == 1 else library().mw_lanes(width)
    if lanes == ffi.NULL and width != 1:
        raise UsageError(f"width = {width}: this processor has no such vectors; use 1, 2, or 0 for its widest")
    phi, x = exact.doubles(angles), np.ascontiguousarray(solutions, dtype=float)
    unique, errors = np.zeros(len(phi), np.uint8), np.zeros(len(phi), record("mw_ball"))
    design = drive.design
    in_lanes = ffi.NULL if width == 1 else proofs(design.description["name"], design.places)
    library().mw_certify_many(
        lanes, in_lanes, drive.enclosed.model, pointer(drive.enclosed.state.copy(), "mw_wide[]"),
        pointer(phi, "mw_wide[]"), pointer(x), len(phi),
        pointer(unique, "unsigned char[]"), pointer(errors, "mw_ball[]"),
    )  # fmt: skip
    radius = errors["radius"] * (1.0 + 1e-12)
    low, high = np.nextafter(errors["mid"] - radius, -np.inf), np.nextafter(errors["mid"] + radius, np.inf)
    return unique.astype(bool), np.stack([low, high], axis=1)


@dataclass(frozen=True)
class BranchCertificate:
    """What is shown of a fold or crossing of branches.

    ``unique``: the equations have exactly one singular point nearby, at an input angle between ``angle`` (low, high),
    rad; of a crossing, the equations changed by a number between ``unfolding`` (low, high), in shares of their slopes.
    ``unknown``: that is not shown, for the ``reason``.
    """

    outcome: str
    reason: str
    angle: tuple[float, float] | None = None
    unfolding: tuple[float, float] | None = None

    def seen_in(self, mirror):
        """The same of the drive of a :class:`~meshwright.design.mirror.Mirror`."""
        if self.angle is None or mirror.sign > 0.0:
            return self
        return replace(self, angle=(-self.angle[1], -self.angle[0]))

    def plain(self):
        """As plain data, the angle in degrees, rounded outwards."""
        degrees = None
        if self.angle is not None:
            degrees = [float(np.degrees(a)) for a in self.angle]
            degrees = [end - side * 4e-16 * abs(end) for end, side in zip(degrees, (1, -1), strict=True)]
        return {
            "outcome": self.outcome, "reason": self.reason or None, "pinion_angle_deg": degrees,
            "unfolding": self.unfolding and list(self.unfolding),
        }  # fmt: skip


def certify_branch(drive, angle, unknowns, crossing):
    """The :class:`BranchCertificate` of a fold or ``crossing`` that floating point found, of the right-hand drive."""
    found, x = ffi.new("mw_branch_certificate *"), np.ascontiguousarray(unknowns, dtype=float)
    state = pointer(drive.enclosed.state, "mw_wide[]")
    library().mw_certify_branch(drive.enclosed.model, state, int(crossing), float(angle), pointer(x), found)
    outcome, reason = OUTCOMES[found.outcome], text(library().mw_reason_word(found.reason))
    if outcome != "unique":
        return BranchCertificate(outcome, reason)
    return BranchCertificate(outcome, reason, *(_ends(ball) for ball in (found.angle, found.unfolding)))


def _ends(ball):
    """Doubles around a ball."""
    middle, radius = Fraction(ball.mid), Fraction(ball.radius) * (1 + Fraction(1, 2**40))
    return exact.downwards(middle - radius), exact.upwards(middle + radius)


def _all(drive, phi, each, first, second):
    records, state = np.zeros(len(phi), record("mw_certificate")), drive.enclosed.state.copy()
    each(
        drive.enclosed.model, pointer(state, "mw_wide[]"), pointer(phi, "mw_wide[]"), first, second, len(phi),
        pointer(records, "mw_certificate[]"),
    )  # fmt: skip
    return Certificates(drive, records, phi)


def degrees_of(words):
    """Exact degrees of ``A:B:STEP`` or ``v1,v2,…`` as they are written, fractions."""
    if ":" in words:
        begin, end, step = map(Fraction, words.split(":"))
        count = int(np.floor(float((end - begin) / step) + 1e-9)) + 1
        return [begin + k * step for k in range(count)]
    return [Fraction(word) for word in re.split(",", words)]
