"""Eight-node hexahedra: faces, shape functions, Jacobians and meshes made of them.

Node order and face labels are those of CalculiX and Abaqus: nodes 1-4 below, 5-8 above, right-handed.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import KDTree

Floats = NDArray[np.floating[Any]]
Ints = NDArray[np.int64]

# Local nodes of the faces S1..S6, each right-handed about its outward normal.
FACES: Ints = np.array(
    [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]], dtype=np.int64
)
CORNERS: Floats = np.array(
    [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]],
    dtype=np.float64,
)
GAUSS_POINTS: Floats = CORNERS / np.sqrt(3.0)


@dataclass(frozen=True)
class FaceSet:
    """Element faces: zero-based element numbers and faces 0..5 (S1..S6), both (F,)."""

    elements: Ints
    faces: Ints


@dataclass(frozen=True)
class HexMesh:
    """nodes (N, 3) in mm, elements (M, 8) zero-based."""

    nodes: Floats
    elements: Ints

    def face_nodes(self, faces: FaceSet) -> Ints:
        """Nodes (F, 4) of the faces."""
        return self.elements[faces.elements[:, None], FACES[faces.faces]]

    def smallest_jacobian(self) -> float:
        """Least Jacobian determinant over Gauss points and corners over that of the element's centre.

        Positive everywhere means a valid right-handed mesh; 1 means parallelepipeds.
        """
        corners = self.nodes[self.elements]
        centre = _determinants(corners, np.zeros((1, 3)))
        if np.any(centre <= 0.0):
            return float(centre.min())
        everywhere = _determinants(corners, np.concatenate([GAUSS_POINTS, CORNERS]))
        return float((everywhere / centre).min())


def shape_derivatives(points: Floats) -> Floats:
    """Derivatives (P, 8, 3) of the trilinear shape functions at local points (P, 3)."""
    factors = 1.0 + points[:, None, :] * CORNERS[None]
    derivatives = np.empty((len(points), 8, 3))
    for axis in range(3):
        others = [other for other in range(3) if other != axis]
        derivatives[:, :, axis] = CORNERS[:, axis] * factors[:, :, others[0]] * factors[:, :, others[1]] / 8.0
    return derivatives


def jacobians(corners: Floats, points: Floats) -> Floats:
    """Jacobian matrices (M, P, 3, 3), d position / d local, of elements (M, 8, 3) at points (P, 3)."""
    return np.einsum("mni,pnj->mpij", corners, shape_derivatives(points))


def _determinants(corners: Floats, points: Floats) -> Floats:
    return np.linalg.det(jacobians(corners, points))


def nodal_areas(nodes: Floats, quads: Ints) -> tuple[Ints, Floats]:
    """Area vectors that consistent integration over bilinear faces gives to each node.

    nodes (N, 3), quads (F, 4).  Returns the K distinct nodes and (K, 3) vectors along the faces' own
    orientation (right-hand rule over their four nodes); a nodal pressure field q gives the force sum q_k A_k.
    """
    corners = nodes[quads]
    vectors = np.zeros_like(corners)
    g = 1.0 / np.sqrt(3.0)
    signs = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], dtype=np.float64)
    for xi, eta in signs * g:
        shape = (1.0 + xi * signs[:, 0]) * (1.0 + eta * signs[:, 1]) / 4.0
        along_xi = np.einsum("n,fni->fi", signs[:, 0] * (1.0 + eta * signs[:, 1]) / 4.0, corners)
        along_eta = np.einsum("n,fni->fi", signs[:, 1] * (1.0 + xi * signs[:, 0]) / 4.0, corners)
        vectors += shape[None, :, None] * np.cross(along_xi, along_eta)[:, None, :]
    used, where = np.unique(quads, return_inverse=True)
    total = np.zeros((len(used), 3))
    np.add.at(total, where.ravel(), vectors.reshape(-1, 3))
    return used, total


def merge(meshes: list[HexMesh], tolerance: float) -> tuple[HexMesh, list[Ints]]:
    """Join meshes at nodes closer than ``tolerance`` mm.

    Returns the joined mesh and, for each input, the (N_i,) new numbers of its nodes.
    """
    nodes = np.concatenate([mesh.nodes for mesh in meshes])
    pairs = KDTree(nodes).query_pairs(tolerance, output_type="ndarray")
    graph = coo_matrix((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(nodes), len(nodes)))
    labels = connected_components(graph, directed=False)[1]
    _, first, inverse = np.unique(labels, return_index=True, return_inverse=True)
    offsets = np.cumsum([0] + [len(mesh.nodes) for mesh in meshes])
    numbers = [inverse[start:end] for start, end in zip(offsets[:-1], offsets[1:], strict=True)]
    elements = np.concatenate([new[mesh.elements] for mesh, new in zip(meshes, numbers, strict=True)])
    return HexMesh(nodes[first], elements), numbers
