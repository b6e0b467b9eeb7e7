"""The mesh of a member: any number of teeth joined along their cut rims."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from meshwright.fe.grading import ContactZone, MeshDensity
from meshwright.fe.hexahedra import FaceSet, Floats, HexMesh, Ints, merge
from meshwright.fe.pair import Member
from meshwright.fe.tooth import Stations, ToothForm, ToothMesh, face_rows, mesh_tooth, moved, section_values

_MERGE_TOLERANCE = 1e-8


@dataclass(frozen=True)
class BodyMesh:
    """Nodes in the body frame; teeth in the order given; rim nodes are those of bore, outer cuts and cut ends.

    rows: elements from face to face; those of a quadrilateral of the section follow one another.
    """

    mesh: HexMesh
    teeth: tuple[dict[str, FaceSet], ...]
    rim: Ints
    rows: int

    def nodes(self, tooth: int, name: str) -> Ints:
        """Distinct nodes of a face set of a tooth."""
        return np.unique(self.mesh.face_nodes(self.teeth[tooth][name]))


@dataclass(frozen=True)
class PlacedTooth:
    """A tooth of the body: its form, the 4 x 4 motion to its place, the zone in the form's own frame."""

    form: ToothForm
    motion: Floats
    zone: ContactZone | None


def placed_tooth(member: Member, angle: float, pairs_later: int, zone: ContactZone | None) -> PlacedTooth:
    """The tooth that meets ``pairs_later`` pairs behind the reference pair, with the member at an angle in rad."""
    form = member.tooth(angle - pairs_later * member.pitch)
    return PlacedTooth(form, member.tooth_motion(pairs_later), zone)


def tooth_order(member: Member, angle: float, numbers: Sequence[int]) -> list[int]:
    """Consecutive ascending ``pairs_later`` in the order of their teeth from left to right."""
    here, later = (placed_tooth(member, angle, k, None) for k in (0, 1))
    section = np.array([0.5 * sum(here.form.faces)])
    meets = np.allclose(here.form.right_cut(section), moved(later.motion, later.form.left_cut(section)), atol=1e-6)
    return list(numbers) if meets else list(numbers)[::-1]


def mesh_body(teeth: Sequence[PlacedTooth], density: MeshDensity) -> BodyMesh:
    """Mesh neighbouring teeth from left to right, each graded to its own zone."""
    rows = max(face_rows(tooth.form, tooth.zone, density) for tooth in teeth)
    stations = Stations.between(_sections(teeth, density, rows))
    single: list[ToothMesh] = []
    for k, (tooth, at) in enumerate(zip(teeth, stations, strict=True)):
        same = k > 0 and tooth.form is teeth[k - 1].form and tooth.zone is teeth[k - 1].zone
        same = same and all(np.array_equal(a, b) for a, b in zip(at, stations[k - 1], strict=True))
        single.append(single[-1] if same else mesh_tooth(tooth.form, tooth.zone, density, at))
    placed = [
        HexMesh(moved(place.motion, tooth.mesh.nodes), tooth.mesh.elements)
        for tooth, place in zip(single, teeth, strict=True)
    ]
    mesh, _ = merge(placed, _MERGE_TOLERANCE)
    offsets = np.cumsum([0] + [len(tooth.mesh.elements) for tooth in single])
    faces = tuple(_shifted(tooth, int(offset)) for tooth, offset in zip(single, offsets[:-1], strict=True))
    rim_faces = [tooth["bore"] for tooth in faces] + [faces[0]["left_cut"], faces[-1]["right_cut"]]
    rim_faces += [faces[k]["ends"] for k, tooth in enumerate(teeth) if tooth.form.cut_ends]
    rim = np.unique(np.concatenate([mesh.face_nodes(f).ravel() for f in rim_faces]))
    return BodyMesh(mesh, faces, rim, rows)


def _sections(teeth: Sequence[PlacedTooth], density: MeshDensity, rows: int) -> list[Floats]:
    """Section coordinates (rows + 1,) of each tooth; one without a zone takes its shares of the face from the next that
    has one: between sections far apart the rim of a tooth along a spiral would fold.
    """
    values = [section_values(tooth.form, tooth.zone, density, rows) for tooth in teeth]
    zones = [k for k, tooth in enumerate(teeth) if tooth.zone is not None]
    for k, tooth in enumerate(teeth):
        if zones and tooth.zone is None:
            near = min(zones, key=lambda other: abs(other - k))
            values[k] = np.interp(values[near], teeth[near].form.faces, tooth.form.faces)
    return values


def _shifted(tooth: ToothMesh, offset: int) -> dict[str, FaceSet]:
    return {name: FaceSet(faces.elements + offset, faces.faces) for name, faces in tooth.faces.items()}
