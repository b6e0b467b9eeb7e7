"""The mesh of a member: any number of teeth joined along their cut rims."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from meshwright.fe.hexahedra import FaceSet, Floats, HexMesh, Ints, merge
from meshwright.fe.tooth import ContactZone, MeshDensity, ToothForm, ToothMesh, face_rows, mesh_tooth

_MERGE_TOLERANCE = 1e-8


@dataclass(frozen=True)
class BodyMesh:
    """Nodes in the body frame; teeth in the order given; rim nodes are those of bore and outer cuts."""

    mesh: HexMesh
    teeth: tuple[dict[str, FaceSet], ...]
    rim: Ints

    def nodes(self, tooth: int, name: str) -> Ints:
        """Distinct nodes of a face set of a tooth."""
        return np.unique(self.mesh.face_nodes(self.teeth[tooth][name]))


@dataclass(frozen=True)
class PlacedTooth:
    """A tooth of the body: 4 x 4 motion of the reference tooth, zone in the reference tooth's own frame."""

    motion: Floats
    zone: ContactZone | None


def mesh_body(form: ToothForm, teeth: Sequence[PlacedTooth], density: MeshDensity) -> BodyMesh:
    """Mesh neighbouring teeth, each graded to its own zone; ``teeth`` in the order of ``form.next_tooth``."""
    rows = max(face_rows(form, tooth.zone, density) for tooth in teeth)
    single = [mesh_tooth(form, tooth.zone, density, rows) for tooth in teeth]
    moved = [
        HexMesh(tooth.mesh.nodes @ place.motion[:3, :3].T + place.motion[:3, 3], tooth.mesh.elements)
        for tooth, place in zip(single, teeth, strict=True)
    ]
    mesh, _ = merge(moved, _MERGE_TOLERANCE)
    offsets = np.cumsum([0] + [len(tooth.mesh.elements) for tooth in single])
    faces = tuple(_shifted(tooth, int(offset)) for tooth, offset in zip(single, offsets[:-1], strict=True))
    rim_faces = [tooth["bore"] for tooth in faces] + [faces[0]["left_cut"], faces[-1]["right_cut"]]
    rim = np.unique(np.concatenate([mesh.face_nodes(f).ravel() for f in rim_faces]))
    return BodyMesh(mesh, faces, rim)


def _shifted(tooth: ToothMesh, offset: int) -> dict[str, FaceSet]:
    return {name: FaceSet(faces.elements + offset, faces.faces) for name, faces in tooth.faces.items()}
