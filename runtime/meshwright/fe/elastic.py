"""Linear elasticity of a hexahedral mesh: its stiffness, and its flexibility under many load cases.

Eight-node elements with incompatible modes that pass the patch test: R. L. Taylor, P. J. Beresford and E. L. Wilson,
A non-conforming element for stress analysis (1976).
"""

import numpy as np
from scipy.sparse import coo_matrix, csc_matrix

from meshwright.fe import repeated
from meshwright.fe.hexahedra import GAUSS_POINTS, Floats, HexMesh, Ints, jacobians, shape_derivatives
from meshwright.fe.material import Material

# Elements whose matrices are made at once: few enough for a cache.
_AT_ONCE = 128


def flexibility(
    mesh: HexMesh, material: Material, held: Ints, rows: int, nodes: Ints, forces: Floats, teeth: int = 1
) -> Floats:
    """(C, C) displacements in mm, each the mean that one of C load cases weighs, by unit loads of the others.

    ``forces`` (K, 3, C) act on distinct ``nodes`` (K,): with the stiffness K it is forces^T K^-1 forces. ``held`` nodes
    do not move. The mesh is made of so many ``teeth``, one after another; ``rows`` elements of each quadrilateral of
    their sections follow one another.
    """
    return repeated.work(
        mesh, lambda corners: element_stiffness(corners, material), held, rows, nodes, forces, teeth
    )


def assemble(mesh: HexMesh, material: Material) -> csc_matrix:
    """Stiffness matrix (3N, 3N) in N/mm, degrees of freedom node by node."""
    blocks = element_stiffness(mesh.nodes[mesh.elements], material)
    dofs = (3 * mesh.elements[:, :, None] + np.arange(3)).reshape(len(mesh.elements), 24)
    rows, columns = np.repeat(dofs, 24, axis=1).ravel(), np.tile(dofs, (1, 24)).ravel()
    size = 3 * len(mesh.nodes)
    return coo_matrix((blocks.ravel(), (rows, columns)), shape=(size, size)).tocsc()


def element_stiffness(corners: Floats, material: Material) -> Floats:
    """Stiffness (M, 24, 24) of elements (M, 8, 3), the incompatible modes condensed out."""
    parts = [corners[first : first + _AT_ONCE] for first in range(0, len(corners), _AT_ONCE)]
    return np.concatenate([_stiffness(part, *material.lame) for part in parts])


def _stiffness(corners: Floats, first: float, second: float) -> Floats:
    """The same with Lamé's constants: the work of the displacement gradients g_a of nodes and modes on one another is
    λ g_a g_b' + μ g_b g_a' + μ (g_a' g_b) 1.
    """
    jacobian = jacobians(corners, GAUSS_POINTS)
    determinant = np.linalg.det(jacobian)
    centre = jacobians(corners, np.zeros((1, 3)))[:, 0]
    gradients = shape_derivatives(GAUSS_POINTS) @ np.linalg.inv(jacobian)
    # Modes 1 - xi^2 with the centre's Jacobian: their strains integrate to zero, so constant strain stays exact.
    scale = np.linalg.det(centre)[:, None] / determinant
    mode_slopes = -2.0 * GAUSS_POINTS[:, :, None] * np.eye(3)
    modes = mode_slopes @ np.linalg.inv(centre)[:, None] * scale[..., None, None]
    slopes = np.concatenate([gradients, modes], axis=2)
    elements, points, shapes, _ = slopes.shape
    slopes = (slopes * np.sqrt(determinant)[..., None, None]).reshape(elements, points, 3 * shapes)
    products = (np.swapaxes(slopes, 1, 2) @ slopes).reshape(elements, shapes, 3, shapes, 3)
    full = first * products + second * products.transpose(0, 1, 4, 3, 2)
    alike = second * np.einsum("maibi->mab", products)
    for axis in range(3):
        full[:, :, axis, :, axis] += alike
    full = full.reshape(elements, 3 * shapes, 3 * shapes)
    coupling = full[:, :24, 24:]
    return full[:, :24, :24] - coupling @ np.linalg.solve(full[:, 24:, 24:], np.swapaxes(coupling, 1, 2))
