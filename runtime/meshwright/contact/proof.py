"""A proof of one contact as a file that another program verifies without trust in this one.

``generated/audit/check_contact.py`` does so from the drive's description, in whole numbers; what a proof claims, and
how it is verified (Krawczyk, Computing 4, 1969), is said there.
"""

from fractions import Fraction
from typing import Protocol

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.library import ffi, library, pointer, text
from meshwright.contact import exact
from meshwright.contact.certificate import EnclosedDesign, ProvedModel
from meshwright.design.description import table_and_key

SCHEMA = "meshwright.contact-proof/1"

#: The transmission error of a proof is bounded by multiples of one over this, arcseconds.
DIGITS = 10**30


class Solved(Protocol):
    """A TCA of one angle."""

    angles: np.ndarray
    solutions: np.ndarray
    status: tuple[str, ...]


def proof(drive: ProvedModel, degrees: Fraction, solution: np.ndarray) -> dict[str, object]:
    """The proof of a contact that floating point found at a pinion angle: plain data of the schema
    ``meshwright.contact-proof/1``.

    ``degrees`` is the exact pinion angle of the design's hand, a fraction that a decimal can write; ``solution`` (nx,)
    the unknowns there. Raises :class:`~meshwright.base.errors.UsageError` with the reason where nothing is shown.
    """
    described, model, design = drive.design.description, drive.model, drive.design
    sign = int(design.mirror.sign)
    systems = ffi.new("mw_proof[]", max(1, model.nsystems))
    enclosed = EnclosedDesign.of(design, model, systems)
    if enclosed.failed is not None:
        what = f"a size of the design cannot be enclosed: {enclosed.failed}"
        raise UsageError(f"--proof: {what}; round the design's numbers")
    angle = exact.wides([tuple(sorted(sign * end for end in exact.radians(degrees)))])
    found, x = ffi.new("mw_proof *"), np.ascontiguousarray(solution, dtype=float)
    state = pointer(enclosed.state, "mw_wide[]")
    if reason := library().mw_prove(model, state, pointer(angle, "mw_wide[]")[0], pointer(x), found):
        raise UsageError(f"--proof: no proof at {_decimal(degrees)} degrees: {text(library().mw_reason_text(reason))}")
    names = [unknown["name"] for unknown in described["unknowns"]]
    shown = _shown(found[0], names)
    return {
        "schema": SCHEMA,
        "drive": described["name"],
        "description_sha256": described["description_sha256"],
        "design": _given(design),
        "pinion_angle_deg": _decimal(degrees),
        "systems": {
            system["name"]: _shown(systems[k], system["unknowns"])
            for k, system in enumerate(described["systems"])
            if systems[k].n
        },
        **shown,
        "transmission_error_arcsec": _bounds(found[0], described["error"], sign),
    }


def _shown(found, names):
    """One zero of a system of equations, by the names of its unknowns."""
    n = found.n
    return {
        "unknowns": names,
        "centre": [found.centre[i].hex() for i in range(n)],
        "box": [found.box[i].hex() for i in range(n)],
        "within": [found.within[i].hex() for i in range(n)],
        "preconditioner": [[found.preconditioner[i * n + j].hex() for j in range(n)] for i in range(n)],
    }


def _given(design):
    """Texts of what the design gives of its drive's keys, by place."""
    tables, listed = design.tables, design.description["parameters"]
    given = {
        p["key"] if p["table"] == p["key"] else f"{p['table']}.{p['key']}":
            tables[p["table"]] if p["table"] == p["key"] else tables[p["table"]].get(p["key"])
        for p in listed
    }  # fmt: skip
    for place in (*design.description["variant"], *(["hand"] if design.description["handed"] else [])):
        table, key = table_and_key(place)
        given[f"{table}.{key}"] = tables[table][key]
    return {place: word if isinstance(word, str) else repr(word) for place, word in given.items() if word is not None}


def _bounds(found, k, sign):
    """The transmission error in arcseconds, rounded outwards: two decimals."""
    middle, radius = Fraction(found.centre[k]), Fraction(found.within[k])
    ends = [648000 * sign * (middle + side * radius) / p for side in (-1, 1) for p in exact.PI]
    low, high = min(ends) * DIGITS, max(ends) * DIGITS
    return [_decimal(Fraction(low.__floor__(), DIGITS)), _decimal(Fraction(high.__ceil__(), DIGITS))]


def _decimal(number: Fraction) -> str:
    """A fraction as a decimal, digit by digit."""
    places = 0
    while (number * 10**places).denominator != 1:
        places += 1
        if places > 10**3:
            raise UsageError(f"{number}: no decimal is equal to it; give the angle as one")
    digits = str(abs(int(number * 10**places))).rjust(places + 1, "0")
    whole, part = digits[: len(digits) - places], digits[len(digits) - places :]
    return f"{'-' if number < 0 else ''}{whole}{'.' + part if part else ''}"
