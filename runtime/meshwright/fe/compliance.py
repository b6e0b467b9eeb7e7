"""Tooth compliance beyond the half-space: FE of a coarse tooth less the half-space on the same patches.

The compliance of a flank is C = half-space(fine cells) + W [FE(patches) - half-space(patches)] W^T: the second term is
smooth, so a coarse mesh gives it well, and it is factorised once for a tooth shape and used for every position and
load.  Source of the method: S. Vijayakar, A combined surface integral and finite element solution for a
three-dimensional contact problem (1991).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from meshwright.fe.body import mesh_body, placed_tooth, tooth_order
from meshwright.fe.elastic import factorise
from meshwright.fe.grading import MeshDensity
from meshwright.fe.halfspace import mean_displacement
from meshwright.fe.hexahedra import Floats, nodal_areas
from meshwright.fe.pair import Member

_PATCH = 2
_MOST_NEIGHBOURS = 2
_TOOTH = MeshDensity(coarse_rows=(4, 12, 16), coarse_fillet_rows=4, rim_rows=4)
# The portion of a thread is several faces long: patches longer than the contact would tell too high a pressure.
_THREAD = replace(_TOOTH, coarse_rows=(4, 12, 40))


@dataclass(frozen=True)
class ToothCompliance:
    """Smooth part of the compliance of the working flank of a member.

    profile, face: patch centres, as fractions of the flank's arc length (P,) and of its face width (Q,).
    own: (P Q, P Q) mm/N between patches of one tooth; later: for one, two, … pitches the (P Q, P Q) displacement of
    the tooth so much later (``pairs_later`` + 1, + 2, …) by load on this one; its transpose is the reverse.
    """

    profile: Floats
    face: Floats
    own: Floats
    later: tuple[Floats, ...]

    def between(self, seen: int, pressed: int) -> Floats | None:
        """Displacement of the tooth of one pair by load on that of another; None beyond the teeth considered."""
        distance = seen - pressed
        if distance == 0:
            return self.own
        if abs(distance) > len(self.later):
            return None
        return self.later[distance - 1] if distance > 0 else self.later[-distance - 1].T

    def weights(self, profile: Floats, face: Floats) -> Floats:
        """Bilinear weights (N, P Q) of the patches at N places on the flank; held constant past the outer centres."""
        along, across = _linear_weights(self.profile, profile), _linear_weights(self.face, face)
        return (along[:, :, None] * across[:, None, :]).reshape(len(profile), -1)


def neighbours_of(pairs: int) -> int:
    """Neighbours on either side that leave the rim as free as in a finite-element model of so many pairs, or two."""
    return min((pairs + 1) // 2, _MOST_NEIGHBOURS)


def tooth_compliance(member: Member, neighbours: int = 1) -> ToothCompliance:
    """Compute it from a tooth and its neighbours on either side, whose rim is held at the bore and the outer cuts.

    Of a thread it is that of the portion at member angle 0.
    """
    order = tooth_order(member, 0.0, range(-neighbours, neighbours + 1))
    density = _THREAD if member.tooth(0.0).cut_ends else _TOOTH
    body = mesh_body([placed_tooth(member, 0.0, k, None) for k in order], density)
    name = f"flank_{member.working}"

    def patches(later: int) -> Floats:
        tooth = body.teeth[order.index(later)]
        return _patch_vectors(body.mesh.nodes, body.mesh.face_nodes(tooth[name]), density)

    forces = np.moveaxis(patches(0), 0, -1)
    moved = factorise(body.mesh, member.material, body.rim).displacements(-forces)
    whole, *later = (-np.einsum("pnd,ndq->pq", patches(k), moved) for k in range(neighbours + 1))
    shape = (density.coarse_rows[1] // _PATCH, density.coarse_rows[2] // _PATCH)
    corners = body.mesh.nodes[body.mesh.face_nodes(body.teeth[order.index(0)][name])]
    own = whole - _half_space(member, corners, shape)
    centres = [(np.arange(count) + 0.5) / count for count in shape]
    return ToothCompliance(centres[0], centres[1], 0.5 * (own + own.T), tuple(later))


def _patch_vectors(nodes: Floats, quads: Floats, density: MeshDensity) -> Floats:
    """(P Q, N, 3) consistent nodal forces of a unit load along the outward normal, spread evenly over each patch."""
    rows, columns = density.coarse_rows[1:]
    by_patch = quads.reshape(rows // _PATCH, _PATCH, columns // _PATCH, _PATCH, 4).transpose(0, 2, 1, 3, 4)
    vectors = np.zeros((rows * columns // _PATCH**2, len(nodes), 3))
    for patch, faces in zip(vectors, by_patch.reshape(len(vectors), -1, 4), strict=True):
        used, areas = nodal_areas(nodes, faces)
        patch[used] = areas / np.linalg.norm(areas.sum(axis=0))
    return vectors


def _half_space(member: Member, corners: Floats, shape: tuple[int, int]) -> Floats:
    """(P Q, P Q) mean half-space displacement in mm of patches by unit loads, on the flank laid flat."""
    rows, columns = (count * _PATCH for count in shape)
    grid = corners.reshape(rows, columns, 4, 3).mean(axis=2)
    steps = [np.linalg.norm(np.diff(grid, axis=axis), axis=-1).mean() for axis in (0, 1)]
    half = [0.5 * _PATCH * step for step in steps]
    offset = [2.0 * h * np.arange(count) for h, count in zip(half, shape, strict=True)]
    x, y = np.meshgrid(*offset, indexing="ij")
    area = 4.0 * half[0] * half[1]
    kernel = mean_displacement(x, y, half[0], half[1], member.material.plane_strain_modulus) / area
    p, q = (index.ravel() for index in np.meshgrid(*(np.arange(count) for count in shape), indexing="ij"))
    return kernel[np.abs(p[:, None] - p[None]), np.abs(q[:, None] - q[None])]


def _linear_weights(centres: Floats, places: Floats) -> Floats:
    """(N, P) weights of linear interpolation between ``centres`` (P,) at ``places`` (N,)."""
    held = np.clip(places, centres[0], centres[-1])
    index = np.clip(np.searchsorted(centres, held) - 1, 0, len(centres) - 2)
    share = (held - centres[index]) / (centres[index + 1] - centres[index])
    weights = np.zeros((len(places), len(centres)))
    rows = np.arange(len(places))
    weights[rows, index], weights[rows, index + 1] = 1.0 - share, share
    return weights
