"""Tooth compliance beyond the half-space: FE of a coarse tooth less the half-space on the same patches.

The compliance of a flank is C = half-space(fine cells) + W [FE(patches) - half-space(patches)] W^T: the second term is
smooth, so a coarse mesh gives it well, and it is factorised once for a tooth shape and used for every position and
load.  Source of the method: S. Vijayakar, A combined surface integral and finite element solution for a
three-dimensional contact problem (1991).

A coarse mesh is too stiff, most of all right below a pressed patch.  The FE term is therefore taken from two meshes,
the finer one with twice the rows of the other in every direction, and extrapolated as an error of second order (L. F.
Richardson, The approximate arithmetical solution by finite differences of physical problems, 1911).

A load bends the flank within a few patches of itself, and a patch knows only its mean. W is therefore the spline whose
means are those of the patches: the derivative of the cubic spline through their sums (L. I. Boneva, D. Kendall and I.
Stefanov, Spline transformations, 1971). Linear interpolation between centres would put a kink there, and a ripple of
the length of a patch on the pressure.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np
from scipy.interpolate import CubicSpline, PPoly
from scipy.linalg import eigh

from meshwright.fe.body import mesh_body, placed_tooth, tooth_order
from meshwright.fe.elastic import flexibility
from meshwright.fe.grading import MeshDensity
from meshwright.fe.halfspace import mean_displacement
from meshwright.fe.hexahedra import Floats, Ints, nodal_areas
from meshwright.fe.pair import Member

_MOST_NEIGHBOURS = 2
# What is so small a part of the largest singular value is rounding.
_NONE = 1e-13
# Patches along the flank's profile and face.  The portion of a thread is several faces long: patches longer than the
# contact would tell too high a pressure.
TOOTH_PATCHES = (6, 8)
_THREAD_PATCHES = (6, 20)
# Rows with one element to a patch: across the tooth, in a fillet, in the rim and the growth of the last.
_ACROSS, _FILLET, _RIM, _RIM_GROWTH = 3, 2, 2, 2.25
# Where flank and end face meet at less than so many degrees the tooth ends in a wedge, several times as soft as its
# middle. There are then so many rows across and in the rim instead, the former by a part thinner at the flanks, and so
# many to each patch at an end, by a part longer than on average where they begin and shorter where they end.
_WEDGE, _WEDGE_ACROSS, _WEDGE_RIM, _CROWDING, _END_ROWS, _END_GROWTH = 60.0, 4, 3, 0.6, 2, 0.3


@dataclass(frozen=True, eq=False)
class ToothCompliance:
    """Smooth part of the compliance of the working flank of a member.

    shape: patches P along the flank's arc length and Q along its face width, equal fractions of either.
    own: (P Q, P Q) mm/N between patches of one tooth; later: for one, two, … pitches the (P Q, P Q) displacement of
    the tooth so much later (``pairs_later`` + 1, + 2, …) by load on this one; its transpose is the reverse.
    half: half lengths of a patch along profile and face in mm.
    """

    shape: tuple[int, int]
    own: Floats
    later: tuple[Floats, ...]
    half: tuple[float, float]

    def between(self, seen: int, pressed: int) -> Floats | None:
        """Displacement of the tooth of one pair by load on that of another; None beyond the teeth considered."""
        distance = seen - pressed
        if distance == 0:
            return self.own
        if abs(distance) > len(self.later):
            return None
        return self.later[distance - 1] if distance > 0 else self.later[-distance - 1].T

    def weights(self, profile: Floats, face: Floats) -> Floats:
        """Weights (N, P Q) of the patches at N places on the flank, given as fractions of arc length and face width."""
        along, across = (spline_weights(n, at) for n, at in zip(self.shape, (profile, face), strict=True))
        return (along[:, :, None] * across[:, None, :]).reshape(len(profile), -1)

    def span(self, profile: Floats, face: Floats) -> Floats:
        """Orthonormal columns (P Q, R) that span the rows of the :meth:`weights` at N places: few where these are close
        together, since splines are polynomials between the ends of patches.
        """
        bases = []
        for count, at in zip(self.shape, (profile, face), strict=True):
            _, sizes, ways = np.linalg.svd(spline_weights(count, at), full_matrices=False)
            bases.append(ways[sizes > _NONE * sizes.max(initial=0.0)].T)
        return np.kron(*bases)


def neighbours_of(pairs: int) -> int:
    """Neighbours on either side that leave the rim as free as in a finite-element model of so many pairs, or two."""
    return min((pairs + 1) // 2, _MOST_NEIGHBOURS)


def tooth_compliance(member: Member, neighbours: int = 1, per_patch: int = 1) -> ToothCompliance:
    """Compute it from a tooth and its neighbours on either side, whose rim is held at the bore and the outer cuts.

    per_patch: elements on either side of a patch in the coarser of the two meshes; the finer one has one more.
    Of a thread it is the compliance of the portion at member angle 0.
    """
    shape = _THREAD_PATCHES if member.tooth(0.0).cut_ends else TOOTH_PATCHES
    (coarse, _), (fine, half) = (_moved(member, neighbours, shape, rows) for rows in (per_patch, per_patch + 1))
    errors = ((per_patch + 1) / per_patch) ** 2  # of the coarse mesh over that of the fine one
    own, *later = (f + (f - c) / (errors - 1.0) for c, f in zip(coarse, fine, strict=True))
    return ToothCompliance(shape, 0.5 * (own + own.T), tuple(later), half)


def _moved(
    member: Member, neighbours: int, shape: tuple[int, int], per_patch: int
) -> tuple[list[Floats], tuple[float, float]]:
    """(P Q, P Q) mean displacements in mm of patches by unit loads on those of the middle tooth, and half their sizes.

    Those of the middle tooth itself, less what a half-space gives, then those of its later neighbours; from a mesh of
    ``per_patch`` x ``per_patch`` elements to a patch.
    """
    order = tooth_order(member, 0.0, range(-neighbours, neighbours + 1))
    rows = _face_rows(shape, per_patch, _ends_in_wedge(member))
    body = mesh_body([placed_tooth(member, 0.0, k, None) for k in order], _density(shape, per_patch, rows))

    def corners(later: int) -> list[Ints]:
        flank = body.teeth[order.index(later)][f"flank_{member.working}"]
        return _by_patch(body.mesh.face_nodes(flank), shape, per_patch, rows)

    nodes, forces = _patch_loads(body.mesh.nodes, [quads for k in range(neighbours + 1) for quads in corners(k)])
    moved = flexibility(body.mesh, member.material, body.rim, body.rows, nodes, forces, len(order))
    own, *later = moved[:, : shape[0] * shape[1]].reshape(neighbours + 1, -1, shape[0] * shape[1])
    middles = np.array([_middle(body.mesh.nodes, quads) for quads in corners(0)]).reshape(*shape, 3)
    lengths = [float(np.linalg.norm(np.diff(middles, axis=axis), axis=-1).mean()) for axis in (0, 1)]
    half = (0.5 * lengths[0], 0.5 * lengths[1])
    return [own - _half_space(member, shape, half), *later], half


def _ends_in_wedge(member: Member) -> bool:
    """Whether an end face and the working flank meet at an acute angle."""
    form = member.tooth(0.0)
    if form.cut_ends:
        return False
    curves, faces = form.side(member.working).flank, np.array(form.faces)
    profile = 0.5 * (curves.first(faces) + curves.last(faces))[:, None]
    points, normals = (of(faces, profile)[:, 0] for of in (curves.points, curves.normals))
    lean = np.einsum("ki,ki->k", curves.section.across(points), normals)
    return bool(90.0 - np.degrees(np.arcsin(np.abs(lean).max())) < _WEDGE)


def _face_rows(shape: tuple[int, int], per_patch: int, wedge: bool) -> list[Floats]:
    """Where the rows of each of the patches along the face end, in parts of the patch."""
    even = np.linspace(0.0, 1.0, per_patch + 1)[1:]
    if not wedge:
        return [even] * shape[1]
    share = np.linspace(0.0, 1.0, _END_ROWS * per_patch + 1)
    shorter = share + _END_GROWTH * share * (1.0 - share)
    return [1.0 - shorter[-2::-1], *[even] * (shape[1] - 2), shorter[1:]]


def _density(shape: tuple[int, int], per_patch: int, rows: list[Floats]) -> MeshDensity:
    sections = np.concatenate([[0.0], *((number + ends) / shape[1] for number, ends in enumerate(rows))])
    wedge = len(sections) > shape[1] * per_patch + 1
    across, rim = (_WEDGE_ACROSS, _WEDGE_RIM) if wedge else (_ACROSS, _RIM)
    return MeshDensity(
        coarse_rows=(across * per_patch, shape[0] * per_patch, len(sections) - 1),
        coarse_fillet_rows=_FILLET * per_patch,
        coarse_sections=tuple(sections),
        coarse_crowding=_CROWDING if wedge else 0.0,
        rim_rows=rim * per_patch,
        rim_growth=_RIM_GROWTH ** (1.0 / per_patch),
    )


def _by_patch(quads: Ints, shape: tuple[int, int], per_patch: int, rows: list[Floats]) -> list[Ints]:
    """Faces (F, 4) of each of P Q patches, out of those of a flank row by row."""
    by_row = quads.reshape(shape[0], per_patch, -1, 4)
    between = np.cumsum([len(ends) for ends in rows])[:-1]
    return [part.reshape(-1, 4) for patches in by_row for part in np.split(patches, between, axis=1)]


def _middle(nodes: Floats, quads: Ints) -> Floats:
    """The middle (3,) of the area of faces (F, 4)."""
    used, areas = nodal_areas(nodes, quads)
    weights = np.linalg.norm(areas, axis=1)
    return weights @ nodes[used] / weights.sum()


def _patch_loads(nodes: Floats, patches: list[Ints]) -> tuple[Ints, Floats]:
    """Nodes (K,) and consistent forces (K, 3, C) on them of a unit load into each of C patches, spread evenly over it.

    patches: the faces (F, 4) of each.
    """
    loaded = np.unique(np.concatenate(patches))
    forces = np.zeros((len(loaded), 3, len(patches)))
    for case, faces in enumerate(patches):
        used, areas = nodal_areas(nodes, faces)
        forces[np.searchsorted(loaded, used), :, case] = -areas / np.linalg.norm(areas.sum(axis=0))
    return loaded, forces


def _half_space(member: Member, shape: tuple[int, int], half: tuple[float, float]) -> Floats:
    """(P Q, P Q) mean half-space displacement in mm of patches by unit loads, on the flank laid flat."""
    offset = [2.0 * h * np.arange(count) for h, count in zip(half, shape, strict=True)]
    x, y = np.meshgrid(*offset, indexing="ij")
    area = 4.0 * half[0] * half[1]
    kernel = mean_displacement(x, y, half[0], half[1], member.material.plane_strain_modulus) / area
    p, q = (index.ravel() for index in np.meshgrid(*(np.arange(count) for count in shape), indexing="ij"))
    return kernel[np.abs(p[:, None] - p[None]), np.abs(q[:, None] - q[None])]


def spline_weights(count: int, places: Floats) -> Floats:
    """(N, count) values at ``places`` (N,) in 0..1 of the splines whose mean is 1 on one of ``count`` equal patches.

    The mean of each is 0 on all other patches.
    """
    return _spline(count)(places)


@cache
def _spline(count: int) -> PPoly:
    sums = np.tri(count + 1, count, -1) / count
    return CubicSpline(np.linspace(0.0, 1.0, count + 1), sums).derivative()


def without_negative(compliance: Floats) -> Floats:
    """The nearest matrix to a symmetric one (K, K) that has no negative eigenvalue.

    Source: N. J. Higham, Computing a nearest symmetric positive semidefinite matrix, Linear Algebra and its
    Applications 103 (1988).
    """
    rounding = len(compliance) * np.finfo(float).eps * np.abs(compliance).max(initial=0.0)
    try:
        np.linalg.cholesky(compliance + rounding * np.eye(len(compliance)))
    except np.linalg.LinAlgError:
        pass
    else:
        return compliance  # as often as not, and seen much faster
    values, vectors = eigh(compliance, subset_by_value=(-np.inf, -rounding), check_finite=False)
    return compliance - (vectors * values) @ vectors.T
