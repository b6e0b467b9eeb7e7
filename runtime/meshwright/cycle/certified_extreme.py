"""The error of flanks that touch along a line, on an edge or at a corner, enclosed.

No tangency holds the wheel there. But with the wheel turned back by a little the two bounded flanks have no place in
common, and turned on by a little they have one, surely: between both lies the angle at which they touch first. Both are
shown by the search that proves first contacts.
"""

import numpy as np

from meshwright.base.library import library, pointer, record
from meshwright.contact import exact
from meshwright.contact.certificate import OUTCOMES
from meshwright.contact.placement import placed
from meshwright.contact.results import ARCSEC
from meshwright.cycle.certified_first import EFFORT, REACH, ranges
from meshwright.cycle.first_contact import Search, start_values

#: Turned back by more than this, mm of arc at the place of contact, the flanks have no place in common; turned on by so
#: much they have one: the first for which it is shown.
TURNED_BACK = (1e-8, 1e-7, 1e-6)
TURNED_ON = (3e-8, 3e-7, 3e-6, 3e-5)

#: The place from which the flanks are looked at lies this share of the way from that of contact to their middle.
INWARDS = 0.02

#: Operations with doubles that an angle of the wheel has come through, in units of the last place.
ROUNDED = 8.0


def enclosed_extremes(drive, contacts):
    """Bounds (N, 2) of the transmission errors of a TCA, rad, where the flanks touch along a line, on an edge or at a
    corner; NaN elsewhere, and where nothing is shown.
    """
    bounds = np.full((len(contacts.angles), 2), np.nan)
    rows = np.flatnonzero([word in ("line_contact", "edge_contact", "corner_contact") for word in contacts.status])
    mirror = drive.design.mirror
    search, _ = Search.of(drive, mirror.sign * contacts.angles, contacts.solutions)
    if search is None or not rows.size:
        return bounds
    first = search.first(contacts.angles[rows])
    boxes = ranges(drive, np.concatenate([first.solutions, search.solutions]), 0)
    ends = np.array([end for box in boxes.values() for pair in box.values() for end in pair] or [0.0] * 8)
    for k, row in enumerate(rows):
        if np.isfinite(first.solutions[k]).all():
            found = _enclosed(drive, search, first, k, ends)
            bounds[row] = found if mirror.sign > 0 else (-found[1], -found[0])
    return bounds


def certificates_of(drive, contacts):
    """Entries (N) of a certificate of the ``meshwright.tca/1`` schema that say so; empty where nothing is shown."""
    bounds = enclosed_extremes(drive, contacts)
    return [_plain(*row) if np.isfinite(row).all() else {} for row in bounds]


def _plain(low, high):
    away = ROUNDED * np.finfo(float).eps * max(abs(low), abs(high)) / ARCSEC
    low, high = low / ARCSEC - away, high / ARCSEC + away
    return {
        "outcome": "enclosed",
        "reason": None,
        "message": "the flanks surely touch first between these errors",
        "transmission_error_arcsec": [float(low), float(high)],
        "radius": float(np.nextafter(0.5 * (high - low), np.inf)),
    }


def _enclosed(drive, search, first, k, ends):
    """Bounds of the error of first contact k, rad, right hand; NaN where they are not shown."""
    mirror, sense = drive.design.mirror, search.sense
    angle, error = mirror.sign * first.angles[k], mirror.sign * first.errors[k]
    radius = abs(first.levers[k])
    (middle,) = start_values(drive, np.array([drive.design.reference_angle]))
    looked_from = first.solutions[k] + INWARDS * (middle - first.solutions[k])
    reach, nothing = REACH * abs(drive.ratio) * drive.pitch(), np.array([np.nan, np.nan])

    def asked(turn, slack):
        """What is shown with the wheel at an angle, and bounds of that."""
        wheel_angle = drive.ratio * angle + turn
        off = ROUNDED * np.finfo(float).eps * (abs(drive.ratio * angle) + abs(turn))
        return _first(drive, angle, wheel_angle, looked_from, ends, slack, reach), off

    for slack in (arc / radius for arc in TURNED_BACK):
        shown, off = asked(error, slack)
        if shown["outcome"] == 1:
            break
    else:
        return nothing
    earliest = sense * error + slack + off
    for arc in TURNED_ON:
        turned = error - sense * arc / radius
        shown, off = asked(turned, TURNED_BACK[0] / radius)
        if shown["outcome"] == 2:
            apart = abs(float(shown["apart"]["mid"])) - float(shown["apart"]["radius"])
            latest = sense * turned + min(max(apart, 0.0), arc / radius) - off
            return np.array(sorted((sense * latest, sense * earliest)))
    return nothing


def _first(drive, angle, wheel_angle, x, ends, slack, reach):
    """The ``mw_first_certificate`` of a wheel at an angle, looked at from the place x (nx,)."""
    proofs = np.zeros(1, record("mw_certificate"))
    entry = proofs[0]
    entry["outcome"] = OUTCOMES.index("unique")
    entry["x"]["hi"][: drive.model.nx] = x
    entry["wheel_angle"]["mid"] = wheel_angle
    body = drive.design.description["bodies"][0]
    stand = placed(drive, [angle], [wheel_angle]).matrices[body["name"]][0]
    at = drive.flank(body["name"])(x[body["unknowns"]])
    entry["point"]["mid"] = stand[:3, :3] @ at.points[0] + stand[:3, 3]
    entry["normal"]["mid"] = stand[:3, :3] @ at.normals[0]
    found, work = np.zeros(1, record("mw_first_certificate")), np.empty(library().mw_certify_first_work())
    angles = exact.doubles(np.array([angle]))
    library().mw_certify_first(
        drive.enclosed.model, pointer(drive.enclosed.state.copy(), "mw_wide[]"), pointer(angles, "mw_wide[]")[0],
        pointer(proofs, "mw_certificate[]"), pointer(ends), slack, reach, EFFORT, pointer(work),
        pointer(found, "mw_first_certificate[]"),
    )  # fmt: skip
    return found[0]
