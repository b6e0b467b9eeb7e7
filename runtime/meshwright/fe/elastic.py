"""Linear elasticity of a hexahedral mesh: its stiffness, and its flexibility under many load cases.

Eight-node elements with incompatible modes that pass the patch test: R. L. Taylor, P. J. Beresford and E. L. Wilson,
A non-conforming element for stress analysis (1976).
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_matrix, csc_matrix

from meshwright.fe import factor
from meshwright.fe.dissection import dissected
from meshwright.fe.hexahedra import GAUSS_POINTS, Floats, HexMesh, Ints, jacobians, shape_derivatives
from meshwright.fe.material import Material

# Elements whose matrices are made at once: few enough for a cache.
_AT_ONCE = 128


def flexibility(mesh: HexMesh, material: Material, held: Ints, rows: int, nodes: Ints, forces: Floats) -> Floats:
    """(C, C) displacements in mm, each the mean that one of C load cases weighs, by unit loads of the others.

    ``forces`` (K, 3, C) act on distinct ``nodes`` (K,): with the stiffness K it is forces^T K^-1 forces. ``held`` nodes
    do not move; ``rows`` elements of each quadrilateral of the mesh's section follow one another.
    """
    return factor.work(
        dissected(mesh, rows, held), mesh.elements, element_stiffness(mesh.nodes[mesh.elements], material.stiffness),
        nodes, forces,
    )  # fmt: skip


def assemble(mesh: HexMesh, material: Material) -> csc_matrix:
    """Stiffness matrix (3N, 3N) in N/mm, degrees of freedom node by node."""
    blocks = element_stiffness(mesh.nodes[mesh.elements], material.stiffness)
    dofs = (3 * mesh.elements[:, :, None] + np.arange(3)).reshape(len(mesh.elements), 24)
    rows, columns = np.repeat(dofs, 24, axis=1).ravel(), np.tile(dofs, (1, 24)).ravel()
    size = 3 * len(mesh.nodes)
    return coo_matrix((blocks.ravel(), (rows, columns)), shape=(size, size)).tocsc()


def element_stiffness(corners: Floats, elasticity: Floats) -> Floats:
    """Stiffness (M, 24, 24) of elements (M, 8, 3), the incompatible modes condensed out."""
    parts = [corners[first : first + _AT_ONCE] for first in range(0, len(corners), _AT_ONCE)]
    return np.concatenate([_stiffness(part, elasticity) for part in parts])


def _stiffness(corners: Floats, elasticity: Floats) -> Floats:
    jacobian = jacobians(corners, GAUSS_POINTS)
    determinant = np.linalg.det(jacobian)
    centre = jacobians(corners, np.zeros((1, 3)))[:, 0]
    gradients = np.einsum("pnj,mpji->mpni", shape_derivatives(GAUSS_POINTS), np.linalg.inv(jacobian))
    # Modes 1 - xi^2 with the centre's Jacobian: their strains integrate to zero, so constant strain stays exact.
    scale = np.linalg.det(centre)[:, None] / determinant
    mode_slopes = -2.0 * GAUSS_POINTS[:, :, None] * np.eye(3)
    modes = np.einsum("pnj,mji->mpni", mode_slopes, np.linalg.inv(centre)) * scale[..., None, None]
    strain = _strain_matrix(np.concatenate([gradients, modes], axis=2))
    stress = (elasticity @ strain) * determinant[..., None, None]
    elements, points, components, dofs = strain.shape
    rows = (elements, points * components, dofs)
    full = np.swapaxes(strain.reshape(rows), 1, 2) @ stress.reshape(rows)
    coupling = full[:, :24, 24:]
    return full[:, :24, :24] - coupling @ np.linalg.solve(full[:, 24:, 24:], np.swapaxes(coupling, 1, 2))


def _strain_matrix(gradients: Floats) -> Floats:
    """(M, P, 6, 3N) strain matrices, order xx yy zz xy yz zx, of shape gradients (M, P, N, 3)."""
    m, p, n, _ = gradients.shape
    matrix = np.zeros((m, p, 6, n, 3))
    for axis in range(3):
        matrix[:, :, axis, :, axis] = gradients[..., axis]
    for row, (first, second) in enumerate(((0, 1), (1, 2), (2, 0)), start=3):
        matrix[:, :, row, :, first] = gradients[..., second]
        matrix[:, :, row, :, second] = gradients[..., first]
    return matrix.reshape(m, p, 6, 3 * n)
