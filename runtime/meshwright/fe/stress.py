"""Reads pressures, forces, contact and bending stress out of a solved model.

Contact stress: ``peak_pressure`` is the largest nodal pressure on the driving flank; ``subsurface_von_mises`` the
largest von Mises stress below the surface of either flank inside the contact zone.  Bending stress: the largest von
Mises and the largest principal stress on the surface of the fillets of the teeth in contact.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from meshwright.fe.hertz import HertzContact
from meshwright.fe.hexahedra import Floats, Ints
from meshwright.fe.material import max_principal, von_mises
from meshwright.fe.model import BodyName, PairModel
from meshwright.fe.mortar import pressed
from meshwright.fe.results import DatTable, NodalField, read_dat, read_frd

# The zone below a contact in which its largest stress lies: (major, minor, least and largest depth) in semi-axes.
_ZONE_MAJOR, _ZONE_MINOR, _ZONE_DEPTHS = 1.0, 1.5, (0.2, 2.5)


@dataclass(frozen=True)
class PairStress:
    """One pair: force (3,) in N on the wheel, moment in N mm of it about the loaded member's axis, MPa.

    A pair whose mesh is too coarse for the zone below its contact, as one that carries nothing, has no
    ``subsurface_von_mises``.
    """

    force: Floats
    moment: float
    peak_pressure: float
    subsurface_von_mises: float | None
    elements_per_semi_minor: float


@dataclass(frozen=True)
class Bending:
    """Fillet stress of one member in MPa."""

    von_mises: float
    max_principal: float


@dataclass(frozen=True)
class Solution:
    """What a run gives, before it is judged.

    rotation: of the loaded member in rad in the sense of its torque, from the first unloaded touch.  reaction: moment
    in N mm about the same axis on the held rim.  pressures: nodes (K,) of the pinion's mesh and MPa of each pair.
    """

    pairs: tuple[PairStress, ...]
    bending: dict[BodyName, Bending]
    rotation: float
    reaction: float
    displacements: dict[BodyName, Floats]
    stresses: dict[BodyName, Floats]
    pressures: tuple[tuple[Ints, Floats], ...]


def read_solution(model: PairModel, input_file: Path) -> Solution:
    """Read the result files beside ``input_file``.  Raises KeyError or OSError if they lack a result."""
    fields = read_frd(input_file.with_suffix(".frd"))
    tables = read_dat(input_file.with_suffix(".dat"))
    stresses: dict[BodyName, Floats] = {name: _of_body(model, fields["STRESS"], name) for name in model.bodies}
    pressures = tuple(_pressures(model, fields["CONTACT"], number) for number in range(len(model.contacts)))
    pairs = tuple(_pair(model, number, pressures[number], stresses) for number in range(len(model.contacts)))
    turned = tables["displacements", f"ROTATION_{model.load.member.upper()}"].values[0, 2]
    return Solution(
        pairs,
        {name: _bending(model, name, stresses[name]) for name in model.bodies},
        model.direction * float(turned + model.start_rotation),
        _reaction(model, tables),
        {name: _of_body(model, fields["DISP"], name) for name in model.bodies},
        stresses,
        pressures,
    )


def _of_body(model: PairModel, field: NodalField, name: BodyName) -> Floats:
    part = name.upper()
    first = model.deck.first_node(part)
    return field.at(np.arange(first, first + len(model.deck.part(part).mesh.nodes)))


def _pressures(model: PairModel, field: NodalField, number: int) -> tuple[Ints, Floats]:
    pair = model.deck.contacts[number]
    nodes = np.unique(model.deck.part(pair.slave_part).mesh.face_nodes(pair.slave))
    column = field.components.index("CPRESS")
    return nodes, np.nan_to_num(field.at(nodes + model.deck.first_node(pair.slave_part))[:, column])


def _pair(model: PairModel, number: int, pressure: tuple[Ints, Floats], stresses: dict[BodyName, Floats]) -> PairStress:
    pair, hertz = model.deck.contacts[number], model.hertz[number]
    mesh = model.deck.part(pair.slave_part).mesh
    quads = mesh.face_nodes(pair.slave)
    axes = _zone_axes(model, number)
    corners = np.zeros(len(mesh.nodes))
    corners[pressure[0]] = pressure[1]
    other = model.deck.part(pair.master_part).mesh
    places, forces = pressed(*axes, mesh.nodes[quads], corners[quads], other.nodes[other.face_nodes(pair.master)])
    moment = np.cross(places, forces).sum(axis=0)[2]
    found = [_subsurface(model, name, axes, hertz, stresses[name]) for name in model.bodies]
    carries = bool(pressure[1].max() > 0.0)
    deepest = [stress for stress in found if stress is not None and carries]
    return PairStress(
        forces.sum(axis=0),
        float(moment),
        float(pressure[1].max()),
        max(deepest, default=None),
        _elements_per_semi_minor(mesh.nodes[quads], axes, hertz),
    )


def _zone_axes(model: PairModel, number: int) -> tuple[Floats, Floats]:
    """Centre (3,) and rows (3, 3) major, minor, normal of a contact in the deck's frame."""
    touch = model.contacts[number].touch
    rotation = model.frame[:3, :3]
    axes = np.stack([touch.major_direction, np.cross(touch.normal, touch.major_direction), touch.normal])
    return rotation @ touch.point + model.frame[:3, 3], axes @ rotation.T


def _subsurface(
    model: PairModel, name: BodyName, axes: tuple[Floats, Floats], hertz: HertzContact, stress: Floats
) -> float | None:
    local = (model.deck.part(name.upper()).mesh.nodes - axes[0]) @ axes[1].T
    depth = -local[:, 2] if name == "pinion" else local[:, 2]
    scaled = depth / hertz.semi_minor
    below = (
        (np.abs(local[:, 0]) < _ZONE_MAJOR * hertz.semi_major)
        & (np.abs(local[:, 1]) < _ZONE_MINOR * hertz.semi_minor)
        & (scaled > _ZONE_DEPTHS[0])
        & (scaled < _ZONE_DEPTHS[1])
    )
    return float(von_mises(stress[below]).max()) if below.any() else None


def _elements_per_semi_minor(quads: Floats, axes: tuple[Floats, Floats], hertz: HertzContact) -> float:
    """Hertz semi-axis b over the largest extent along b of the slave faces (F, 4, 3) that meet the ellipse."""
    local = (quads - axes[0]) @ axes[1].T
    scaled = local[..., :2] / [hertz.semi_major, hertz.semi_minor]
    loaded = np.hypot(*np.moveaxis(scaled, -1, 0)).min(axis=1) < 1.0
    if not loaded.any():
        return 0.0
    return float(hertz.semi_minor / np.ptp(local[loaded, :, 1], axis=1).max())


def _bending(model: PairModel, name: BodyName, stress: Floats) -> Bending:
    body = model.bodies[name]
    touching = {contact.pairs_later for contact in model.contacts}
    teeth = [place for place, later in enumerate(model.orders[name]) if later in touching]
    fillets = np.unique(
        np.concatenate([body.nodes(place, f"fillet_{side}") for place in teeth for side in ("left", "right")])
    )
    return Bending(float(von_mises(stress[fillets]).max()), float(max_principal(stress[fillets]).max()))


def _reaction(model: PairModel, tables: dict[tuple[str, str], DatTable]) -> float:
    """Moment on the held rim about the loaded member's axis; both rims have their node on that axis."""
    held = next(rim for rim in model.deck.rims if rim.torque is None)
    return float(tables["forces", f"ROTATION_{held.name}"].values[0, 2])
