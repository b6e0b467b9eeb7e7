"""Limits of spherical gears: the line on the cutter beyond which it undercuts, and the least number of teeth.

A section of the face is undercut if the flank's singular function changes sign within the edge, l > 0. That function
is, up to a positive factor, r sin²α + X_c [1 + cos²α (R/ρ) tan²θ / cos θ] (spur: r sin²α + X_c), which is proved in
the audit; it has one simple zero a section, unlike the minors of the rank condition that the spherical report solves.
"""

import itertools

import numpy as np

from meshwright.base.errors import DesignError
from meshwright.limits.results import Limits, SurfaceLimit

MEMBERS = ("pinion", "wheel")

#: Newton and secant steps; both converge in fewer than ten.
ITERATIONS = 60

ROUND_OFF = 4e-16

#: The singular function is 1 at the pitch point; a zero exactly at the end of the edge is not undercut.
TOUCHING = -1e-12

#: No gear of practical use has more teeth.
MOST_TEETH = 2**24


def limits(drive, request):
    """Undercut lines of both gears, at ``request.axial`` or on ``request.grid`` sections of the face; least teeth."""
    return Limits(
        undercut=tuple(itertools.chain(*(_undercut(drive, member, request) for member in MEMBERS))),
        least_teeth={member: least_teeth(drive, member) for member in MEMBERS},
    )


def _undercut(drive, member, request):
    flank, half = drive.flank(member), _half_face(drive, member)
    sections = np.array(request.axial or np.linspace(-half, half, request.grid))
    along = undercut_line(drive, member, sections)
    there = np.isfinite(along)
    places = np.column_stack([along, _sweep(flank, along, sections)])[there]
    for section, place, point in zip(sections[there], places, flank(places).points, strict=True):
        yield SurfaceLimit(
            member,
            point,
            dict(zip(flank.parameters, map(float, place), strict=True)),
            on_flank=bool(place[0] > 0.0 and abs(section) <= half),
            extra={"edge_position_mm": float(place[0])},
        )


def undercut_line(drive, member, sections):
    """Edge position l, mm, at which the flank is singular in each section z (N,), mm; NaN where it is nowhere so."""
    flank, z = drive.flank(member), np.asarray(sections, dtype=float)
    before, l = np.full(len(z), drive.design.sizes[f"{member}_edge_end_mm"]), np.zeros(len(z))
    value_before, value = _singular(flank, before, z), _singular(flank, l, z)
    for _ in range(ITERATIONS):
        rise = value - value_before
        step = np.divide(value * (l - before), rise, out=np.zeros(len(z)), where=rise != 0.0)
        before, value_before = l, value
        l = l - step
        value = _singular(flank, l, z)
        if not np.any(np.abs(step) > ROUND_OFF * np.abs(l)):
            break
    return np.where(np.abs(value) < -TOUCHING, l, np.nan)


def least_teeth(drive, member):
    """The least number of teeth without undercut anywhere on the face; None if there is none below 2²⁴.

    The ratio of sphere radius to pitch radius, the edge and the face width are kept. The middle of the face is the
    worst section of a concave or spur gear, its ends are that of a convex gear; more teeth are always better.
    """
    most = 1
    while not _is_free(drive, member, most):
        most *= 2
        if most > MOST_TEETH:
            return None
    least = most // 2
    while most - least > 1:
        middle = (most + least) // 2
        least, most = (least, middle) if _is_free(drive, member, middle) else (middle, most)
    return most


def _is_free(drive, member, teeth):
    """Whether the gear with another number of teeth is a gear and is not undercut."""
    teeth_key, radius_key = f"{member}_teeth", f"{member}_sphere_radius_mm"
    changes, radius = {teeth_key: teeth}, drive.design.value(radius_key)
    if np.isfinite(radius):
        changes[radius_key] = radius * teeth / drive.design.value(teeth_key)
    try:
        flank = drive.with_(design=changes).flank(member)
    except DesignError:
        return False
    sections = np.array([0.0, _half_face(drive, member)])
    return bool(np.all(_singular(flank, np.zeros(2), sections) >= TOUCHING))


def _half_face(drive, member):
    return 0.5 * drive.design.value(f"{member}_face_width_mm")


def _singular(flank, along, sections):
    """The flank's singular function, 1 at the pitch point, at edge positions and axial positions (N,)."""
    return flank(np.column_stack([along, _sweep(flank, along, sections)])).regular


def _sweep(flank, along, sections):
    """The sweep parameter at which the point of the edge lies in the section: Newton along the generated tangent."""
    sweep = np.zeros(len(along))
    for _ in range(ITERATIONS):
        there = flank(np.column_stack([along, sweep]))
        step = (there.points[:, 2] - sections) / there.tangents[:, 1, 2]
        sweep = sweep - step
        if not np.any(np.abs(step) > ROUND_OFF * np.abs(sweep)):
            break
    return sweep
