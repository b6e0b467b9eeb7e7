"""The closed body of a member, some of its teeth or all of them with their rim: a watertight surface and its volume.

Flanks, fillets, tips, root lands, end faces and bore are patches with common edges, refined until the facets of the
flanks, or B-splines through the patches' points, depart from the exact surfaces by no more than is asked for.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from meshwright.base.errors import DesignError, UsageError
from meshwright.drive import Drive
from meshwright.fe.facets import facet_departures, finer_rows
from meshwright.fe.hexahedra import Floats, Ints
from meshwright.fe.rim import DEEPEST_RIM, RIM_MODULES, check_rim
from meshwright.fe.sizes import other_flank, solid_sizes
from meshwright.fe.thread_body import ThreadSide
from meshwright.fe.thread_flanks import thread_sides
from meshwright.fe.tooth_patches import Grid, Rows, Tooth, between
from meshwright.flank.mesh import mesh
from meshwright.flank.patches import Patch, triangulated
from meshwright.flank.region import Region, region
from meshwright.flank.sections import EVEN, Sections
from meshwright.flank.sides import RegionSide, Side
from meshwright.flank.step import Spline

_AnySide = TypeVar("_AnySide", bound=Side)

# Rows over flank and face from which the refinement of facets starts, and at which it ends.
_FEWEST, _MOST = (8, 16), (96, 4096)
# More facets than this, a file of 200 MB, are refused where they are not within the departure all the same.
_MOST_FACETS = 4_000_000
# The same for B-splines; how far they may be from tips, root lands and end faces of the blank, mm.
_FIRST, _LAST, _ON_BLANK = Rows(8, 6, 8, 3, 3), 1024, 5e-7
# The rim is as deep below the root as the teeth are high, so many times.
_RIM_HEIGHTS = 2.0
_SAMPLES = 17
# Sections in which a thread's azimuth is followed: many for each of its turns.
_ALONG_THREAD = 513
# So many turns has a face of it at most.
_MOST_TURNS = 4.0


@dataclass(frozen=True)
class ClosedBody:
    """points (N, 3) in mm, body frame; triangles (M, 3), counter-clockwise seen from outside; volume in mm³.

    departure: how far the facets of the flanks are from the exact flanks at most, mm.
    """

    points: Floats
    triangles: Ints
    volume: float
    departure: float
    teeth: int


@dataclass(frozen=True)
class Body:
    """So many ``teeth`` of a member of ``whole``, as the design's hand has them."""

    tooth: Tooth
    teeth: int
    whole: int
    flip: Floats | None

    def faceted(self, departure: float) -> ClosedBody:
        """Its closed surface of triangles, with flanks within a departure in mm if that takes not too many rows.

        Raises UsageError where so many facets do not suffice.
        """
        with _whole(self.tooth.name):
            grid, reached = _fine_enough(self.tooth, departure)
            patches = self._patches(grid)
            if reached > departure:
                _check_facets(self.tooth.name, patches, reached, departure)
            points, triangles = triangulated(patches)
            _check_closed(triangles)
        return ClosedBody(points, triangles, volume(points, triangles), reached, self.teeth)

    def splined(self, departure: float) -> tuple[list[Patch], float]:
        """Its patches, through whose points B-splines go that are within a departure in mm of the exact surfaces if
        that takes not too many points; and how far they are from them.
        """
        with _whole(self.tooth.name):
            grid, reached = _smooth_enough(self.tooth, departure)
        return self._patches(grid), reached

    def _patches(self, grid: Grid) -> list[Patch]:
        patches = grid.patches(self.teeth, self.whole)
        if self.flip is None:
            return patches
        return [Patch(p.kind, p.points * self.flip).turned_over() for p in patches]


def closed_body(
    drive: Drive, member: str, teeth: int | None = None, departure: float = 1e-3, rim_thickness: float | None = None
) -> ClosedBody:
    """The body of a member with so many teeth, as triangles; None: all of them. Errors as of :func:`solid_body`."""
    return solid_body(drive, member, teeth, rim_thickness).faceted(departure)


def solid_body(
    drive: Drive, member: str, teeth: int | None = None, rim_thickness: float | None = None, other: Drive | None = None
) -> Body:
    """The body of a member with so many teeth; None: all of them. rim_thickness in mm. ``other``: the drive of the
    other flank, where flanks have designs of their own; None takes the packaged partner, or this one's other flank.

    Raises UsageError for a member without a closed body, DesignError for teeth that are not whole.
    """
    drive, other = _whole_blank(drive), _other(drive, other)
    sizes, count = solid_sizes(drive, member), drive.teeth(member)
    make = _thread if "tip_radius" in sizes else _gear
    if make is _thread and teeth not in (None, count):
        raise UsageError(f"--teeth {teeth}: the {member} is one body with {count} threads; leave --teeth out")
    if teeth is not None and not 1 <= teeth <= count:
        raise UsageError(f"--teeth {teeth}: the {member} has {count} teeth; choose from 1 to {count}")
    with _whole(member):
        tooth = make((drive, other), member, sizes, rim_thickness)
    flip = drive.design.mirror.flip if drive.design.mirror.sign < 0 else None
    return Body(tooth, teeth or count, count, flip)


def _whole_blank(drive: Drive) -> Drive:
    whole, _ = drive.design.with_whole_blank()
    return Drive(whole, drive.backend)


def _other(drive: Drive, given: Drive | None) -> Drive:
    """The drive of the other flank: the one that is given, if it goes with the drive."""
    apart, flank = drive.design.description["flanks_apart"], drive.design.other_flank
    if given is None:
        try:
            return other_flank(_whole_blank(drive))
        except DesignError as error:
            if not apart:
                raise
            reason = f"with flank = {flank!r}, for the other side of the teeth, the same design is refused: {error}"
            remedy = "give --other-flank a design of that flank, or change this one until both flanks can be made"
            raise DesignError("flank", drive.design.tables["flank"], reason, remedy) from error
    if not apart:
        raise UsageError("--other-flank: one design makes both flanks of these teeth; leave --other-flank out")
    for what, own, its in (
        ("drive", drive.design.family, given.design.family), ("flank", flank, given.design.tables["flank"]),
        ("number of teeth of the pinion", drive.teeth("pinion"), given.teeth("pinion")),
        ("number of teeth of the wheel", drive.teeth("wheel"), given.teeth("wheel")),
        ("hand", drive.design.mirrored, given.design.mirrored),
    ):  # fmt: skip
        if own != its:
            raise UsageError(f"--other-flank {given.design.label}: its {what} is {its}; give a design with {own}")
    return _whole_blank(given)


@contextmanager
def _whole(member: str) -> Iterator[None]:
    """Makes what is missing of the teeth of a member an error of its design."""
    try:
        yield
    except (UsageError, DesignError):
        raise
    except ValueError as error:
        raise DesignError("blank", None, f"the {member} has no whole teeth: {error}", "change its blank") from error


def gear_tooth(drive: Drive, member: str, rim: float | None) -> tuple[Tooth, int]:
    """The tooth of a gear with a whole blank, and which of its sides, 0 or 1, has the flank in hand; errors as of
    :func:`solid_body`.
    """
    with _whole(member):
        sides, faces = _sides((drive, _other(drive, None)), member)
        tooth = _between(drive, member, sides, faces, drive.teeth(member), solid_sizes(drive, member), rim)
    return tooth, 0 if tooth.sides[0] is sides[0] else 1


def _gear(drives: tuple[Drive, Drive], member: str, sizes: dict[str, float], rim: float | None) -> Tooth:
    """The tooth of a gear from the regions of its flank and fillet, of either flank's drive."""
    sides, faces = _sides(drives, member)
    return _between(drives[0], member, sides, faces, drives[0].teeth(member), sizes, rim)


def _sides(drives: tuple[Drive, Drive], member: str) -> tuple[list[RegionSide], tuple[float, float]]:
    """Both sides of the teeth of a gear, the flank in hand first, and the sections at their ends."""
    drive = drives[0]
    fillet = any((r["name"], r["region"]) == (member, "fillet") for r in drive.design.description["regions"])
    sides, sections = [], drive.flank(member).sections
    for one in drives:
        names = ("flank", "fillet") if fillet else ("flank",)
        regions = [region(one, member, name, one.uses) for name in names]
        if regions[0].flank.sections is None:
            sections = sections or _of_blank(regions[0], member)
            regions = [of.in_sections(sections) for of in regions]
        sides.append(RegionSide.of(*regions))
    return sides, (min(s.reach[0] for s in sides), max(s.reach[1] for s in sides))


def _of_blank(flank: Region, member: str) -> Sections:
    """The sections of a tooth whose flank ends in two of them at the faces of its blank."""
    if flank.empty:
        raise UsageError(f"{flank.why_empty}; change [blank] or [design]")
    found = mesh(flank, (_SAMPLES, _SAMPLES))
    at_face = np.zeros(len(found.points), dtype=bool)
    if "face" in flank.limits.names:
        values = flank.limits.values(flank.flank(found.parameters))
        at_face = np.abs(values[:, flank.limits.names.index("face")]) < EVEN
    sections = Sections.of_faces(found.points, found.border[at_face[found.border].all(axis=1)])
    if sections is None:
        raise UsageError(
            f'--solid: the description of the drive does not say where the {member} ends along its teeth: its body '
            f'"{member}" needs a margin with the event "face", of planes, cylinders or cones about its axis, or, for a '
            f"thread that goes on, the function solid_{member} with its sizes"
        )
    return sections


def _thread(drives: tuple[Drive, Drive], member: str, sizes: dict[str, float], rim: float | None) -> Tooth:
    """The thread of a member, along its axis as far as what contact uses of its flanks, of either flank's drive."""
    drive = drives[0]
    if rim is not None:
        check_rim(rim, {member: sizes["root_radius"]})
    used = np.concatenate([one.surface(member).mesh.points[:, 2] for one in drives])
    ends = float(used.min()), float(used.max())
    threads = thread_sides(drive, member, rim or RIM_MODULES * sizes["module"], drives[1])
    sides = [ThreadSide.of(threads.flanks[name], threads.blank, ends) for name in ("left", "right")]
    bore = threads.blank.bored

    def height(values: Floats) -> Floats:
        at = np.stack(np.broadcast_arrays(1.0, 0.0, values), axis=-1)
        return bore(at)[..., 0]

    low, high, _ = _in_order(member, sides, ends)
    return replace(between(member, low, high, 0.0, drive.pitch(), ends, 1.0, height), parted=_turns(low, ends))


def _turns(side: ThreadSide, ends: tuple[float, float]) -> Floats:
    """Sections that divide a long thread into equal parts.

    Of faces that wind about the axis many times Open CASCADE takes outside for inside, and reads the solid inside out.
    """
    values = np.linspace(*ends, _ALONG_THREAD)
    _, points, _ = side.grids(values, np.array([0.0, 1.0]), np.array([0.0, 0.5, 1.0]))
    azimuth = np.unwrap(np.arctan2(points[:, 1, 1], points[:, 1, 0]))
    wound = np.abs(azimuth - azimuth[0])
    parts = int(np.ceil(wound[-1] / (2.0 * np.pi * _MOST_TURNS)))
    return np.interp(wound[-1] * np.arange(1, parts) / parts, wound, values)


def _between(
    drive: Drive, member: str, sides: list[RegionSide], faces: tuple[float, float], count: int,
    sizes: dict[str, float], rim: float | None,
) -> Tooth:  # fmt: skip
    pitch = 2.0 * np.pi / count
    low, high, swapped = _in_order(member, sides, faces)
    turn = 0.0
    if drive.design.description["flanks_apart"]:
        turn = 0.5 * pitch - _thickness(low, high, 0.5 * sum(faces), sizes.get("middle"))
    values = np.linspace(*faces, _SAMPLES)
    below, above, _ = low.grids(values, np.array([0.0, 1.0]), np.array([0.0, 1.0]))
    heights = [low.sections.height(points) for points in (below[:, 0], above[:, -1])]
    outward = 1.0 if np.mean(heights[1] - heights[0]) > 0.0 else -1.0
    root = float((outward * heights[0]).min())
    # an internal gear's rim lies outside its teeth, away from the axis
    deepest = _deepest(low.sections, values, root) if outward > 0.0 else np.inf
    if rim is None:
        rim = RIM_MODULES * sizes["module"] if "module" in sizes else _RIM_HEIGHTS * float(
            (outward * (heights[1] - heights[0])).max()
        )
        rim = min(rim, deepest)
    elif low.sections.sides[1] > 0.0 and rim > deepest:
        check_rim(rim, {member: deepest / DEEPEST_RIM})
    bore = outward * (root - rim)
    tooth = between(
        member, low, high, turn, pitch, faces, outward, lambda values: np.full(np.shape(values), bore)
    )
    if not swapped or turn == 0.0:
        return tooth
    # the flank in hand keeps its place: the other one is to be turned
    return replace(tooth, turns=(-turn, tooth.turns[1] - turn))


def _deepest(sections: Sections, values: Floats, root: float) -> float:
    """The deepest rim in mm that leaves a bore in all sections; without end where sections do not meet the axis."""
    sine, cosine = sections.sides
    if not cosine:
        return np.inf
    return DEEPEST_RIM * float((sine * values + cosine * root).min()) / cosine


def _in_order(
    member: str, sides: Sequence[_AnySide], faces: tuple[float, float]
) -> tuple[_AnySide, _AnySide, bool]:
    """The sides at the smaller and larger azimuth of the tooth, told by their normals, and whether they are swapped."""
    at = np.array([0.5 * sum(faces)])
    signs = []
    for side in sides:
        _, points, normals = side.grids(at, np.array([0.0, 1.0]), np.array([0.0, 0.5, 1.0]))
        point, normal = points[0, 1], normals[0, 1]
        signs.append(np.sign(point[0] * normal[1] - point[1] * normal[0]))
    if signs[0] == signs[1]:
        raise UsageError(
            f"--solid: both flanks of the {member} face the same way round its axis; the description of the drive has "
            "to make the one the other side of its teeth where the flank's sign changes"
        )
    low, high = sides if signs[0] < 0.0 else sides[::-1]
    return low, high, bool(signs[0] > 0.0)


def _thickness(low: RegionSide, high: RegionSide, section: float, profile: float | None) -> float:
    """Angle in rad from one side to the other at a profile parameter, else half-way up the flank."""
    azimuths = []
    for side in (low, high):
        line = side.flank.at(np.array([section]))
        q = line.even(np.array([0.0, 0.5, 1.0]))[1]
        if profile is not None:
            q[:, line.region.profile] = profile
            q = line.onto(q)
        point = line.region.flank(q).points[0]
        azimuths.append(np.arctan2(point[1], point[0]))
    return float(azimuths[1] - azimuths[0])


def volume(points: Floats, triangles: Ints) -> float:
    """Volume in mm³ within a closed surface, by the divergence theorem."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return float(np.sum(np.cross(a, b) * c) / 6.0)


def _fine_enough(tooth: Tooth, departure: float) -> tuple[Grid, float]:
    """The tooth at steps with which the facets of its flanks are within ``departure``, and how far they are."""
    flank, along = _FEWEST
    most = _MOST[0], _MOST[1] // (len(tooth.ends) - 1)
    while True:
        grid = tooth.grid(Rows(2 * along, 2, 2 * flank, 1, 1))
        found = [facet_departures(points, normals) for _, points, normals in (grid.low, grid.high)]
        across, by_length, reached = np.max(found, axis=0)
        finer = finer_rows((flank, along), (across, max(by_length, reached - across)), departure, most)
        if reached <= departure or finer == (flank, along):
            break
        flank, along = finer
    bore = tooth.sections.points(grid.values, tooth.bore(grid.values), 0.0)
    radius = max(float(np.hypot(of[..., 0], of[..., 1]).max()) for of in (grid.low[1], bore))
    step = np.sqrt(8.0 * departure / radius)
    tip, land = (max(1, int(np.ceil(angle / step))) for angle in _widths(tooth, grid))
    return tooth.grid(Rows(along, max(8, flank // 2), flank, tip, land)), float(reached)


def _widths(tooth: Tooth, grid: Grid) -> tuple[float, float]:
    """Largest angles in rad of a tooth, at tip or root, below which lies as much of the bore, and of a root land."""
    ends = [np.arctan2(side[part][:, place, 1], side[part][:, place, 0]) for part, place in ((1, -1), (0, 0))
            for side in (grid.low, grid.high)]  # fmt: skip
    tip, root = (ends[1] - ends[0]) % (2.0 * np.pi), (ends[3] - ends[2]) % (2.0 * np.pi)
    return float(max(tip.max(), root.max())), float((tooth.pitch - root).max())


def _smooth_enough(tooth: Tooth, departure: float) -> tuple[Grid, float]:
    """The tooth at steps with which B-splines are within half of ``departure``, and how far they are."""
    rows = _FIRST
    while True:
        fine = tooth.grid(rows.times(along=2, fillet=2, flank=2, tip=2, land=2))
        patches = fine.patches(1, 1)
        along, growth, reached = 1.0, {}, 0.0
        for patch in patches:
            if patch.kind == "end":
                across, around = _off_face(tooth, patch)
                for kind, size in (("tip", around), ("land", around), ("flank", across), ("fillet", across)):
                    growth[kind] = max(growth.get(kind, 1.0), _growth(size / _ON_BLANK))
                continue
            if patch.kind not in ("flank", "fillet", "tip", "land", "bore"):
                continue
            if tooth.outward < 0.0:  # sections along the second axis of all but bores, as where height grows outwards
                patch = patch.turned_over()
            off, blank = _off(tooth, patch)
            reached = max(reached, float(off.max()))
            excess = np.maximum(off / (0.5 * departure), blank / _ON_BLANK)
            if patch.kind != "bore":
                growth[patch.kind] = max(growth.get(patch.kind, 1.0), _growth(excess[1::2, ::2]))
                along = max(along, _growth(excess[::2, 1::2]))
            else:
                along = max(along, _growth(excess[1::2, ::2]))
        wanted = rows.times(along=along, **growth)
        wanted = Rows(*(min(n, _LAST) for n in (wanted.along, wanted.fillet, wanted.flank, wanted.tip, wanted.land)))
        if wanted == rows:
            return tooth.grid(rows), reached
        rows = wanted


def _off_face(tooth: Tooth, patch: Patch) -> tuple[Floats, Floats]:
    """How far the spline through every other point of an end face is off its section, mm: midway between points along
    its height, and around the axis.
    """
    points, at = patch.points, tooth.sections.at
    value = float(at(points).mean())
    if (value < 0.5 * sum(tooth.faces)) == (tooth.outward > 0.0):
        points = np.swapaxes(points, 0, 1)
    if len(points) == 2:  # straight lines
        points = points[[0, 0, 1]] * [[[1.0]], [[0.5]], [[1.0]]] + points[[0, 1, 1]] * [[[0.0]], [[0.5]], [[0.0]]]
    found = Spline.through(points[::2, ::2]).sampled(*(np.linspace(0.0, 1.0, n) for n in points.shape[:2]))
    off = np.abs(at(found) - value)
    return off[1::2, ::2], off[::2, 1::2]


def _growth(excess: Floats) -> float:
    """How many times more steps bring an excess below 1, of splines of the fifth degree."""
    most = float(excess.max(initial=0.0))
    return min(3.0, 1.1 * most ** (1.0 / 5.0)) if most > 1.0 else 1.0


def _off(tooth: Tooth, patch: Patch) -> tuple[Floats, Floats]:
    """Distances (I, J) in mm of the spline through every other point of a patch from all of them: in space on flanks
    and fillets, and off the blank on tips, root lands and bores.
    """
    points = patch.points
    spline = Spline.through(points[::2, ::2])
    found = spline.sampled(*(np.linspace(0.0, 1.0, n) for n in points.shape[:2]))
    if patch.kind in ("flank", "fillet"):
        return np.linalg.norm(found - points, axis=2), np.zeros(points.shape[:2])
    return np.zeros(points.shape[:2]), np.abs(tooth.sections.height(found) - tooth.sections.height(points))


def _check_facets(member: str, patches: list[Patch], reached: float, departure: float) -> None:
    """Refuse patches of which too many facets would be made that are not within the departure, mm."""
    count = sum(2 * (len(p.points) - 1) * (p.points.shape[1] - 1) for p in patches)
    if count > _MOST_FACETS:
        raise UsageError(
            f"--stl: {count / 1e6:.3g} million facets are off the flanks of the {member} by {1000.0 * reached:.3g} µm, "
            f"not {1000.0 * departure:g} µm: the body is long and winds often; write its B-spline faces with --step"
        )


def _check_closed(triangles: Ints) -> None:
    """Every edge belongs to two triangles that run along it in opposite senses."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    count = int(edges.max()) + 1
    forward = np.sort(edges[:, 0] * count + edges[:, 1])
    backward = np.sort(edges[:, 1] * count + edges[:, 0])
    if (np.diff(forward) == 0).any() or not np.array_equal(forward, backward):
        raise ValueError("the surface of the body is not closed")
