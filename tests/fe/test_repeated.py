"""Bodies of teeth, alike or not, against the sparse system of the whole body."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.linalg import block_diag
from scipy.sparse.linalg import spsolve

from meshwright.fe import repeated
from meshwright.fe.blocks import Block
from meshwright.fe.dissection import dissected
from meshwright.fe.elastic import assemble, flexibility
from meshwright.fe.hexahedra import HexMesh, merge
from meshwright.fe.material import Material

STEEL = Material(2.06e5, 0.3)
PITCH = np.radians(20.0)
SHAPE = (3, 4, 2)
CASES = 2


def turn(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])  # rows to rows


def freedoms(nodes):
    return (3 * nodes[:, None] + np.arange(3)).ravel()


def body(bent):
    """Four sectors of a ring, the sector ``bent`` with an inner node elsewhere; its mesh and each sector's nodes."""
    steps = [np.linspace(-0.5, 0.5, SHAPE[0] + 1) * PITCH, np.linspace(20.0, 26.0, SHAPE[1] + 1) ** 1.02,
             np.array([0.0, 3.0, 5.0])]  # fmt: skip
    azimuth, radius, z = np.meshgrid(*steps, indexing="ij")
    points = np.stack([-radius * np.sin(azimuth), radius * np.cos(azimuth), z + 0.02 * radius], axis=-1)[::-1]
    points[1, 2, 1] += [0.2, 0.1, -0.1]
    single = []
    for number in range(4):
        own = points.copy()
        own[2, 3, 1] += [0.0, 0.3 if number == bent else 0.0, 0.0]
        own = Block(own).mesh()
        single.append(HexMesh(own.nodes @ turn(number * PITCH), own.elements))
    return merge(single, 1e-8)


@pytest.mark.parametrize("bent", [None, 0, 2, 3])
@pytest.mark.parametrize("loaded", [(1,), (1, 2), (0, 3)])
def test_work_of_loads_is_that_of_the_whole_body(bent, loaded, monkeypatch):
    """Held below and at the outer cuts; the same loads, turned, on the outer circle of some sectors."""
    mesh, sectors = body(bent)
    assert mesh.smallest_jacobian() > 0.1
    number = np.arange(np.prod(np.array(SHAPE) + 1)).reshape(np.array(SHAPE) + 1)
    right, left = number[-1].ravel(), number[0].ravel()
    assert all(np.array_equal(a[left], b[right]) for a, b in pairwise(sectors))
    held = np.unique(np.concatenate([*(of[number[:, 0].ravel()] for of in sectors), sectors[0][right],
                                     sectors[-1][left]]))  # fmt: skip
    inner = number[1:-1, -1].ravel()
    nodes = np.concatenate([sectors[k][inner] for k in loaded])
    own = np.random.default_rng(3).normal(size=(len(inner), 3, CASES))
    forces = block_diag(*(np.einsum("nia,ij->nja", own, turn(k * PITCH)).reshape(-1, CASES) for k in loaded))
    shapes = []
    monkeypatch.setattr(repeated, "dissected", lambda *of: shapes.append(of) or dissected(*of))
    found = flexibility(mesh, STEEL, held, SHAPE[2], nodes, forces.reshape(len(nodes), 3, -1), 4)
    assert len(shapes) == (1 if bent is None else 2)
    free = np.setdiff1d(np.arange(3 * len(mesh.nodes)), freedoms(held))
    load = np.zeros((3 * len(mesh.nodes), forces.shape[1]))
    load[freedoms(nodes)] = forces
    moved = spsolve(assemble(mesh, STEEL)[free][:, free], load[free])
    assert found == pytest.approx(load[free].T @ moved, rel=1e-10, abs=1e-12 * np.abs(found).max())
