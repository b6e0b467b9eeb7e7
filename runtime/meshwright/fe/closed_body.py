"""The closed body of a member, some of its teeth or all of them with their rim: a watertight surface and its volume.

Flanks, fillets, tip, root lands, end faces and bore are the boundary of the structured mesh of the teeth, refined until
the flanks' facets depart from the exact surfaces by no more than is asked for.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from meshwright.base.errors import DesignError, UsageError
from meshwright.drive import Drive
from meshwright.fe.generated import about_z
from meshwright.fe.grading import MeshDensity
from meshwright.fe.hexahedra import FACES, Floats, HexMesh, Ints, merge
from meshwright.fe.rim import check_rim
from meshwright.fe.sizes import other_flank, solid_sizes
from meshwright.fe.solids import RIM_MODULES, teeth_of
from meshwright.fe.thread_body import facet_departures, finer_rows, thread_body
from meshwright.fe.thread_flanks import thread_sides
from meshwright.fe.tooth import Stations, ToothForm, mesh_tooth, moved

_MERGE_TOLERANCE = 1e-8
# Rows over profile and face from which the refinement starts, and at which it ends.
_FEWEST, _MOST = (8, 8), (96, 96)


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


def closed_body(
    drive: Drive, member: str, teeth: int | None = None, departure: float = 1e-3, rim_thickness: float | None = None
) -> ClosedBody:
    """The body of a member with so many teeth; None: all of them.

    departure, rim_thickness in mm. Raises UsageError for a member without a closed body, DesignError for teeth that are
    not whole.
    """
    whole, _ = drive.design.with_whole_blank()
    drive = Drive(whole, drive.backend)
    sizes = solid_sizes(drive, member)
    if not sizes:
        what = "has no declared sizes of solid teeth"
        raise UsageError(f"--solid: the {member} of this drive {what}; export its flank and fillet instead")
    if "tip_radius" in sizes:
        return _threaded(drive, member, teeth, departure, rim_thickness or RIM_MODULES * sizes["module"])
    count = round(sizes["teeth"])
    if teeth is not None and not 1 <= teeth <= count:
        raise UsageError(f"--teeth {teeth}: the {member} has {count} teeth; choose from 1 to {count}")
    if rim_thickness is not None and "root_radius" in sizes:
        check_rim(rim_thickness, {member: sizes["root_radius"]})
    try:
        form = teeth_of(drive, member, rim_thickness or RIM_MODULES * sizes["module"]).at(0.0)
    except DesignError:
        raise
    except ValueError as error:
        raise DesignError("blank", None, f"the {member} has no whole teeth: {error}", "change its blank") from error
    density, reached = _density(form, departure)
    body = _teeth(form, density, teeth or count, _to_next(form, count))
    return _of_design(drive, *_boundary(body), reached, teeth or count)


def _threaded(drive: Drive, member: str, teeth: int | None, departure: float, rim_thickness: float) -> ClosedBody:
    """All threads of a member, along its axis as far as what contact uses of its flanks."""
    count = round(2.0 * np.pi / drive.pitch())
    if teeth not in (None, count):
        raise UsageError(f"--teeth {teeth}: the {member} is one body with {count} threads; leave --teeth out")
    used = np.concatenate([one.surface(member).mesh.points[:, 2] for one in (drive, other_flank(drive))])
    try:
        sides = thread_sides(drive, member, rim_thickness)
        sections, reached = thread_body(sides, drive.pitch(), (float(used.min()), float(used.max())), departure)
    except DesignError:
        raise
    except ValueError as error:
        raise DesignError("blank", None, f"the {member} has no whole thread: {error}", "change its blank") from error
    return _of_design(drive, *sections.triangles(), reached, count)


def _of_design(drive: Drive, points: Floats, triangles: Ints, reached: float, teeth: int) -> ClosedBody:
    """The body with the hand of the design; raises ValueError where it is not closed."""
    if drive.design.mirror.sign < 0:
        points, triangles = points * drive.design.mirror.flip, triangles[:, ::-1]
    _check_closed(triangles)
    return ClosedBody(points, triangles, volume(points, triangles), reached, teeth)


def volume(points: Floats, triangles: Ints) -> float:
    """Volume in mm³ within a closed surface, by the divergence theorem."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return float(np.sum(np.cross(a, b) * c) / 6.0)


def _density(form: ToothForm, departure: float) -> tuple[MeshDensity, float]:
    """The rows at which the sagitta of the flanks' facets is below ``departure``, and that sagitta."""
    profile, face = _FEWEST
    while True:
        across, along, reached = np.max([_off(form, name, profile, face) for name in ("left", "right")], axis=0)
        finer = finer_rows((profile, face), (across, max(along, reached - across)), departure, _MOST)
        if reached <= departure or finer == (profile, face):
            break
        profile, face = finer
    fillet = max(8, 2 * (profile // 4))
    return MeshDensity(coarse_rows=(2, profile, face), coarse_fillet_rows=fillet), reached


def _off(form: ToothForm, name: str, profile: int, face: int) -> tuple[float, float, float]:
    """:func:`~meshwright.fe.thread_body.facet_departures` of one flank's facets."""
    values = np.linspace(*form.faces, 2 * face + 1)
    fractions = np.broadcast_to(np.linspace(0.0, 1.0, 2 * profile + 1), (len(values), 2 * profile + 1))
    rail = form.side(name).flank.rail(values)
    places = rail.parameters(fractions)
    return facet_departures(*rail.curves.surface(places, rail.curves.solve(values, places)))


def _to_next(form: ToothForm, count: int) -> Floats:
    """4 x 4 motion from a tooth to its right neighbour, on whose left cut its own right cut lies."""
    section = np.array([0.5 * sum(form.faces)])
    right, left = form.right_cut(section), form.left_cut(section)
    for sign in (-1.0, 1.0):
        motion = about_z(sign * 2.0 * np.pi / count)
        if np.allclose(right, moved(motion, left), atol=1e-6):
            return motion
    raise ValueError("neighbouring teeth do not join")


def _teeth(form: ToothForm, density: MeshDensity, teeth: int, to_next: Floats) -> HexMesh:
    stations = np.linspace(*form.faces, density.coarse_rows[2] + 1)
    (own,) = Stations.between([stations])
    single = mesh_tooth(form, None, density, own).mesh
    placed, motion = [], np.eye(4)
    for _ in range(teeth):
        placed.append(HexMesh(moved(motion, single.nodes), single.elements))
        motion = to_next @ motion
    return merge(placed, _MERGE_TOLERANCE)[0]


def _boundary(mesh: HexMesh) -> tuple[Floats, Ints]:
    """Points and triangles of the element faces that no other element shares."""
    quads = mesh.elements[:, FACES].reshape(-1, 4)
    _, inverse, counts = np.unique(np.sort(quads, axis=1), axis=0, return_inverse=True, return_counts=True)
    outer = quads[counts[inverse.ravel()] == 1]
    triangles = np.concatenate([outer[:, [0, 1, 2]], outer[:, [0, 2, 3]]])
    distinct = np.sort(triangles, axis=1)
    triangles = triangles[(np.diff(distinct, axis=1) > 0).all(axis=1)]
    used, numbered = np.unique(triangles, return_inverse=True)
    return mesh.nodes[used], numbered.reshape(-1, 3)


def _check_closed(triangles: Ints) -> None:
    """Every edge belongs to two triangles that run along it in opposite senses."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    forward, counts = np.unique(edges, axis=0, return_counts=True)
    backward = np.unique(edges[:, ::-1], axis=0)
    if (counts != 1).any() or len(forward) != len(backward) or (forward != backward).any():
        raise ValueError("the surface of the body is not closed")
