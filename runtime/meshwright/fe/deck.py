"""A CalculiX model as data, and the readable input file it is written to.

Units N, mm, MPa.  Every node and element number is one-based and contiguous over the parts in their
order; every real number carries an exponent, because CalculiX reads ``1`` where a real is due as 0.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from meshwright.fe.hexahedra import FaceSet, Floats, HexMesh, Ints
from meshwright.fe.material import Material

_NUMBERS_PER_LINE = 12


@dataclass(frozen=True)
class Part:
    """One elastic body."""

    name: str
    mesh: HexMesh
    material: Material


@dataclass(frozen=True)
class Support:
    """Prescribed displacements of nodes (K,) of a part in one direction (1..3); values (K,) in mm."""

    part: str
    nodes: Ints
    direction: int
    values: Floats


@dataclass(frozen=True)
class NodalForces:
    """Forces (K, 3) in N on nodes (K,) of a part."""

    part: str
    nodes: Ints
    forces: Floats


@dataclass(frozen=True)
class RigidRim:
    """Nodes of a part that move as one rigid body about the z axis through ``centre``.

    torque in N mm about +z; None holds the rim.  Keep the nodes apart from every contact surface.
    """

    name: str
    part: str
    nodes: Ints
    centre: tuple[float, float, float]
    torque: float | None


@dataclass(frozen=True)
class ContactPair:
    """Frictionless contact; the slave is the finer surface and carries the pressures."""

    name: str
    slave_part: str
    slave: FaceSet
    master_part: str
    master: FaceSet


@dataclass(frozen=True)
class Deck:
    """A static analysis in one linear-geometry step; element_type is C3D8I (incompatible modes) or C3D8."""

    title: str
    parts: tuple[Part, ...]
    supports: tuple[Support, ...] = ()
    forces: tuple[NodalForces, ...] = ()
    rims: tuple[RigidRim, ...] = ()
    contacts: tuple[ContactPair, ...] = ()
    remarks: tuple[str, ...] = ()
    element_type: str = "C3D8I"

    def part(self, name: str) -> Part:
        """The part of that name."""
        return next(part for part in self.parts if part.name == name)

    def first_node(self, name: str) -> int:
        """One-based number of the first node of a part."""
        return 1 + sum(len(part.mesh.nodes) for part in self._before(name))

    def first_element(self, name: str) -> int:
        """One-based number of the first element of a part."""
        return 1 + sum(len(part.mesh.elements) for part in self._before(name))

    @property
    def node_count(self) -> int:
        """Nodes of all parts, without the reference nodes of the rims."""
        return sum(len(part.mesh.nodes) for part in self.parts)

    @property
    def element_count(self) -> int:
        """Elements of all parts."""
        return sum(len(part.mesh.elements) for part in self.parts)

    def rotation_node(self, rim: RigidRim) -> int:
        """Number of the node whose degrees of freedom 1-3 are the rotations of the rim."""
        return self.node_count + 2 * self.rims.index(rim) + 2

    def _before(self, name: str) -> tuple[Part, ...]:
        names = [part.name for part in self.parts]
        return self.parts[: names.index(name)]


def write(deck: Deck) -> str:
    """The text of the input file."""
    sections = (_heading, _nodes, _elements, _materials, _surfaces, _rims, _step)
    return "\n".join(line for section in sections for line in section(deck)) + "\n"


def _real(value: float) -> str:
    return f"{value:.12e}"


def _heading(deck: Deck) -> Iterator[str]:
    yield "*HEADING"
    yield deck.title
    yield "** Units: N, mm, MPa."
    for part in deck.parts:
        yield (
            f"** {part.name}: nodes {deck.first_node(part.name)} on ({len(part.mesh.nodes)}), "
            f"elements {deck.first_element(part.name)} on ({len(part.mesh.elements)})"
        )
    yield from (f"** {remark}" for remark in deck.remarks)


def _nodes(deck: Deck) -> Iterator[str]:
    for part in deck.parts:
        first = deck.first_node(part.name)
        yield f"*NODE, NSET=N_{part.name}"
        for number, (x, y, z) in enumerate(part.mesh.nodes, start=first):
            yield f"{number}, {_real(x)}, {_real(y)}, {_real(z)}"


def _elements(deck: Deck) -> Iterator[str]:
    for part in deck.parts:
        first_node = deck.first_node(part.name)
        yield f"*ELEMENT, TYPE={deck.element_type}, ELSET=E_{part.name}"
        for number, nodes in enumerate(part.mesh.elements, start=deck.first_element(part.name)):
            yield ", ".join(str(value) for value in (number, *(nodes + first_node)))


def _materials(deck: Deck) -> Iterator[str]:
    for part in deck.parts:
        yield f"*MATERIAL, NAME=M_{part.name}"
        yield "*ELASTIC"
        yield f"{_real(part.material.youngs_modulus)}, {_real(part.material.poisson_ratio)}"
        yield f"*SOLID SECTION, ELSET=E_{part.name}, MATERIAL=M_{part.name}"


def _surfaces(deck: Deck) -> Iterator[str]:
    if not deck.contacts:
        return
    yield "** Frictionless hard contact without penalty, mortar formulation."
    yield "*SURFACE INTERACTION, NAME=FRICTIONLESS"
    yield "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD"
    for pair in deck.contacts:
        for side, part, faces in (("S", pair.slave_part, pair.slave), ("M", pair.master_part, pair.master)):
            first = deck.first_element(part)
            yield f"*SURFACE, NAME={side}_{pair.name}, TYPE=ELEMENT"
            for element, face in zip(faces.elements, faces.faces, strict=True):
                yield f"{element + first}, S{face + 1}"
        yield "*CONTACT PAIR, INTERACTION=FRICTIONLESS, TYPE=MORTAR"
        yield f"S_{pair.name}, M_{pair.name}"
        yield f"*NSET, NSET=NS_{pair.name}"
        yield from _number_lines(_slave_nodes(deck, pair))


def _slave_nodes(deck: Deck, pair: ContactPair) -> Ints:
    mesh = deck.part(pair.slave_part).mesh
    return np.unique(mesh.face_nodes(pair.slave)) + deck.first_node(pair.slave_part)


def _rims(deck: Deck) -> Iterator[str]:
    for rim in deck.rims:
        rotation = deck.rotation_node(rim)
        yield f"** Rigid rim {rim.name}: node {rotation - 1} carries its place, node {rotation} its rotations."
        yield "*NODE"
        for number in (rotation - 1, rotation):
            yield f"{number}, " + ", ".join(_real(value) for value in rim.centre)
        yield f"*NSET, NSET=PLACE_{rim.name}"
        yield f"{rotation - 1},"
        yield f"*NSET, NSET=ROTATION_{rim.name}"
        yield f"{rotation},"
        yield f"*NSET, NSET=RIM_{rim.name}"
        yield from _number_lines(rim.nodes + deck.first_node(rim.part))
        yield f"*RIGID BODY, NSET=RIM_{rim.name}, REF NODE={rotation - 1}, ROT NODE={rotation}"


def _step(deck: Deck) -> Iterator[str]:
    yield "*STEP, INC=1000"
    yield "*STATIC"
    yield f"{_real(1.0)}, {_real(1.0)}"
    yield from _boundary(deck)
    yield from _loads(deck)
    yield "** Displacements and stresses at the nodes, contact results at the slave nodes."
    yield "*NODE FILE"
    yield "U"
    yield "*EL FILE"
    yield "S"
    if deck.contacts:
        yield "*CONTACT FILE"
        yield "CDIS, CSTR"
    for rim in deck.rims:
        for kind in ("PLACE", "ROTATION"):
            yield f"*NODE PRINT, NSET={kind}_{rim.name}"
            yield "U, RF"
    for part in deck.parts:
        yield f"*EL PRINT, ELSET=E_{part.name}"
        yield "S"
    yield "*END STEP"


def _boundary(deck: Deck) -> Iterator[str]:
    if deck.supports or deck.rims:
        yield "*BOUNDARY"
    for support in deck.supports:
        first = deck.first_node(support.part)
        for node, value in zip(support.nodes, support.values, strict=True):
            yield f"{node + first}, {support.direction}, {support.direction}, {_real(value)}"
    for rim in deck.rims:
        free = 2 if rim.torque is not None else 3
        yield f"PLACE_{rim.name}, 1, 3"
        yield f"ROTATION_{rim.name}, 1, {free}"


def _loads(deck: Deck) -> Iterator[str]:
    torques = [rim for rim in deck.rims if rim.torque is not None]
    if deck.forces or torques:
        yield "*CLOAD"
    for load in deck.forces:
        first = deck.first_node(load.part)
        for node, force in zip(load.nodes, load.forces, strict=True):
            for direction, value in enumerate(force, start=1):
                if value != 0.0:
                    yield f"{node + first}, {direction}, {_real(value)}"
    for rim in torques:
        yield f"ROTATION_{rim.name}, 3, {_real(rim.torque or 0.0)}"


def _number_lines(numbers: Iterable[int]) -> Iterator[str]:
    values = [str(number) for number in numbers]
    for start in range(0, len(values), _NUMBERS_PER_LINE):
        yield ", ".join(values[start : start + _NUMBERS_PER_LINE]) + ","
