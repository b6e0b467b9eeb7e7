"""Undercut lines: where a surface that a tool cuts becomes singular, on every surface for which the drive says where.

An explicit surface of two parameters is searched along its profile: on given lines, or in sections across the axis of
the member. An envelope of three parameters, related by its equation of meshing, is followed at fixed places of the
profile (:mod:`meshwright.limits.singular_lines`). Where a drive does not say where to search, the limits of its flanks
do: between their ends across the tooth, and along it beyond its ends too.
"""

from dataclasses import replace
from functools import partial

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.contact.functions import has, offered
from meshwright.flank.region import CELLS, region
from meshwright.limits.rack import generation_range
from meshwright.limits.results import SurfaceLimit
from meshwright.limits.singular_lines import begun, edges
from meshwright.limits.zeros import zeros

#: Samples of a profile between which sign changes of the singular function are sought.
SAMPLES = 100

#: Newton steps to a section.
ITERATIONS = 60

ROUND_OFF = 4e-16

#: A margin within this share of its size at the middle of the profile is at its limit, not beyond it.
AT_LIMIT = 1e-9


def undercut_lines(drive, request):
    """:class:`~meshwright.limits.results.SurfaceLimit` of every surface for which the drive says where to search:
    ``request.grid`` lines, sections or places of the profile, or the axial positions ``request.axial`` (mm).
    """
    names = offered(drive, "undercut_place_")
    return tuple(limit for name in names if _is_told(drive, name) for limit in _on_surface(drive, name, request))


def within_limits(drive, request):
    """The same of every member of which the drive does not say where to search, but other surfaces: between the limits
    of its flank. Second result: {"undercut", or "undercut_of_M" where another member has some: why it is not sought}.
    """
    names = offered(drive, "undercut_place_") or [body["name"] for body in drive.design.description["bodies"]]
    found, unsought = [], {}
    for name in (name for name in names if not _is_told(drive, name)):
        try:
            found += _between_limits(drive, name, request)
        except UsageError as error:
            unsought[name] = str(error)
    if found:
        return tuple(found), {f"undercut_of_{name}": why for name, why in unsought.items()}
    return (), {"undercut": "; ".join(f"{name}: {why}" for name, why in unsought.items())} if unsought else {}


def _is_told(drive, name):
    """Whether functions of the drive say where to search a surface; sections are across an axial tooth."""
    if not has(drive, f"undercut_place_{name}"):
        return False
    surface = drive.flank(name)
    along = len(surface.parameters) == 3 or "along_first" in search_range(drive, name)
    return along or surface.body.get("lengthwise", "axial") == "axial"


def _between_limits(drive, name, request):
    """Undercut within all limits of a flank but the ends of its face, and as far again beyond these."""
    bounded = region(drive, name, "flank", drive.uses)
    if bounded.empty:
        raise UsageError(bounded.why_empty)
    surface, told = bounded.flank, has(drive, f"undercut_range_{name}")
    if len(surface.parameters) == 2:
        low, high = 2.0 * bounded.box[0] - bounded.box[1], 2.0 * bounded.box[1] - bounded.box[0]
        ends = {"first": low[0], "last": high[0], "along_first": low[1], "along_last": high[1]}
        ends["middle"] = bounded.seed[0]
        ends |= search_range(drive, name) if told else {}
        found = _singular(surface, ends, replace(request, axial=()))
        places = [q for q in found if _is_of_tooth(surface, q, AT_LIMIT)]
        if told:
            places += [q for q in _at_ends(surface, ends) if _is_of_tooth(surface, q, -AT_LIMIT)]
    elif len(surface.parameters) == 3:
        lattice = bounded.lattice((CELLS, CELLS))
        nodes = lattice.q[lattice.inside]
        ends = {"first": nodes[:, 0].min(), "last": nodes[:, 0].max(), "middle": bounded.seed[0]}
        ends |= search_range(drive, name) if told else {}
        near = {p: nodes[np.argmin(np.abs(nodes[:, 0] - p)), 1:] for p in _places(ends, request)}
        if all(begun(surface, p, there) is None for p, there in near.items()):
            raise UsageError("no place of its profile is regular where its singular lines could be followed from")
        followed = [q for p, there in near.items() for q in edges(surface, p, there)]
        places = [q for q in followed if _is_of_tooth(surface, q, -AT_LIMIT)]
    else:
        raise UsageError("its flank has more than one equation beside it")
    return [_limit(drive, name, surface, q, ends["middle"]) for q in places]


def _at_ends(surface, ends):
    """Singular places at the ends of the profile."""
    samples = np.linspace(ends["along_first"], ends["along_last"], SAMPLES)
    for profile in (ends["first"], ends["last"]):
        for along in zeros(lambda along, at=profile: _on_line(surface, along, np.full_like(along, at)), samples):
            yield np.array([profile, along])


def _is_of_tooth(surface, q, least):
    """Whether a place is within the limits of a flank across the tooth, by this share of their size: beyond its tip
    nothing is cut, and a singular line along which one of them runs, as of an involute at its base, ends the flank.
    """
    margins = surface([q]).margins.items()
    return all(not values[0] < least * max(1.0, abs(values[0])) for event, values in margins if event != "face")


def search_range(drive, name):
    """Results of the drive's function ``undercut_range_…`` by name; those of a generation by a helicoid otherwise."""
    if not has(drive, f"undercut_range_{name}"):
        return generation_range(drive)
    return {key: float(value) for key, value in drive.function(f"undercut_range_{name}")().items()}


def _on_surface(drive, name, request):
    surface = drive.flank(name)
    ends = search_range(drive, name)
    return [_limit(drive, name, surface, q, ends["middle"]) for q in _singular(surface, ends, request)]


def _singular(surface, ends, request):
    """Parameters of singular points."""
    if len(surface.parameters) == 3:
        for profile in _places(ends, request):
            yield from edges(surface, profile)
    elif request.axial or "along_first" not in ends:
        for z in request.axial or sections_of_face(surface, ends["middle"], request.grid):
            line = np.array(singular_in_section(surface, ends, z))
            yield from np.column_stack([line, at_section(surface, line, np.full(len(line), z))])
    else:
        lines = request.grid if ends["along_last"] > ends["along_first"] else 1
        samples = np.linspace(ends["first"], ends["last"], SAMPLES)
        for along in np.linspace(ends["along_first"], ends["along_last"], lines):
            for profile in zeros(partial(_on_line, surface, along), samples):
                yield np.array([profile, along])


def _places(ends, request):
    """Places of the profile."""
    return np.union1d(np.linspace(ends["first"], ends["last"], request.grid), ends["middle"])


def _on_line(surface, along, profile):
    return surface(np.column_stack([profile, np.full_like(profile, along)])).regular


def sections_of_face(surface, profile, count):
    """Axial positions over the face at a place of the profile; the middle alone where the face has no ends."""
    half = surface([[profile, at_section(surface, np.array([profile]), np.zeros(1))[0]]]).margins.get("face", [np.nan])
    return np.linspace(-half[0], half[0], count) if np.isfinite(half[0]) else np.zeros(1)


def singular_in_section(surface, ends, z):
    """Profile parameters at which an explicit surface is singular in the section at the axial position z, mm."""

    def regular(profile):
        return surface(np.column_stack([profile, at_section(surface, profile, np.full(len(profile), z))])).regular

    return zeros(regular, np.linspace(ends["first"], ends["last"], SAMPLES))


def at_section(surface, profile, sections):
    """The lengthwise parameter (N,) at which a surface at ``profile`` (N,) reaches ``sections`` (N,): Newton along the
    generated tangent; NaN where it does not get there.
    """
    along = np.zeros(len(profile))
    for _ in range(ITERATIONS):
        there = surface(np.column_stack([profile, along]))
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            step = (there.points[:, 2] - sections) / there.tangents[:, 1, 2]
            along = along - step
            moving = np.abs(step) > ROUND_OFF * np.abs(along)
        if not np.any(moving):
            break
    with np.errstate(invalid="ignore"):
        return np.where(np.abs(step) <= 1e-9 * (1.0 + np.abs(along)), along, np.nan)


def _limit(drive, name, surface, q, middle):
    at = surface([q])
    place = drive.function(f"undercut_place_{name}")(*q) if has(drive, f"undercut_place_{name}") else {}
    inside = place.pop("inside", 1.0)
    at_middle = surface([[middle, *q[1:]]]).margins
    sizes = {event: max(1.0, abs(np.nan_to_num(values[0]))) for event, values in at_middle.items()}
    within = all(not values[0] < -AT_LIMIT * sizes[event] for event, values in at.margins.items())
    named = dict(zip(surface.parameters, map(float, q), strict=True))
    of_tool = {"radius": "tool_radius", "axial": "tool_axial"}  # beside those of the member
    extra = {f"{of_tool.get(key, key)}_mm": float(value) for key, value in place.items()}
    return SurfaceLimit(name, at.points[0], named, bool(within and not inside < 0.0), extra)
