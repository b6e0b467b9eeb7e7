"""The finite-element model of a gear pair at one position, as a CalculiX deck."""

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from meshwright.contact.placement import about_z
from meshwright.fe.body import BodyMesh, PlacedTooth, mesh_body, placed_tooth, tooth_order
from meshwright.fe.deck import ContactPair, Deck, Part, RigidRim
from meshwright.fe.gap import ContactPlane
from meshwright.fe.grading import ContactZone, MeshDensity
from meshwright.fe.hertz import HertzContact, elliptic_contact
from meshwright.fe.hexahedra import Floats, HexMesh
from meshwright.fe.material import contact_modulus
from meshwright.fe.mortar import fitted_nodes
from meshwright.fe.pair import GearPair, Member, PairTouch, lever_arm, pair_numbers, touches, unloaded_wheel_angle
from meshwright.fe.tooth import moved

# The contact starts from an overlap of this part of the Hertz approach: from a gap the solver diverges.
_START_OVERLAP = 0.5
# Facets have the gap of the flanks as far as that is less than so many Hertz approaches.
_CLOSING = 5.0
# Teeth without a pair beyond the outermost ones, so that no loaded tooth stands beside a held cut.
_IDLE_TEETH = 1
# A pair without load is meshed as if it carried this part of the largest force.
_LEAST_FORCE = 0.02

BodyName = Literal["pinion", "wheel"]


#: Pairs modelled, and the member whose torque is stated, of a drive whose description does not say.
PAIRS, STATED_TORQUE = 3, "pinion"


def usual_loading(description):
    """Pairs modelled and the member whose torque is stated, as is usual for a drive with this description."""
    return description["loading"] or {"pairs": PAIRS, "torque_on": STATED_TORQUE}


@dataclass(frozen=True)
class Load:
    """Torque in N mm (> 0) on one member; the rim of the other member is held."""

    torque: float
    member: BodyName


@dataclass(frozen=True)
class PairModel:
    """A deck in the frame of the loaded member (its axis is z) and what is needed to read its results.

    orders: which pair (``pairs_later``) each tooth of a body belongs to.  frame: 4 x 4 motion from the fixed frame to
    that of the deck.  angles: angle of each member.  hertz: for each pair the contact under
    the force its mesh was graded to.  start_rotation: rotation in rad about +z of the loaded member from the first
    unloaded touch to the overlap at which the analysis starts.
    direction: +1 or -1, sign of the torque about +z.
    """

    deck: Deck
    bodies: dict[BodyName, BodyMesh]
    orders: dict[BodyName, list[int]]
    contacts: tuple[PairTouch, ...]
    hertz: tuple[HertzContact, ...]
    load: Load
    frame: Floats
    angles: dict[BodyName, float]
    start_rotation: float
    direction: int


def loaded_side(gear: GearPair, load: Load) -> tuple[Member, int]:
    """The loaded member and the sign of the torque about +z of its body frame.

    The pinion is pushed in its driving sense, the wheel against the sense in which it is driven.
    """
    if load.member == "pinion":
        return gear.pinion, gear.sense * gear.pinion.turning
    return gear.wheel, -gear.sense * gear.wheel.turning


def hertz_of(gear: GearPair, contact: PairTouch, force: float) -> HertzContact:
    """Hertz contact of a pair under a normal force in N."""
    modulus = contact_modulus(gear.pinion.material, gear.wheel.material)
    touch = contact.touch
    return elliptic_contact(
        force, touch.curvature_min, touch.curvature_max, modulus, gear.pinion.material.poisson_ratio
    )


def build_model(
    gear: GearPair,
    pinion_angle: float,
    pairs: int,
    load: Load,
    forces: Floats,
    density: MeshDensity,
    idle: int = _IDLE_TEETH,
) -> PairModel:
    """Model ``pairs`` tooth pairs around a pinion angle and ``idle`` more teeth of each member on either side.

    forces: expected normal force in N of each pair that touches, by which its mesh is graded.  A tooth that carries
    nothing gets a coarse mesh.  Raises ValueError if no pair touches at this angle.
    """
    contacts = touches(gear, pinion_angle, pairs)
    if not contacts:
        raise ValueError(f"no tooth pair touches at a pinion angle of {np.degrees(pinion_angle):g} deg")
    loaded, direction = loaded_side(gear, load)
    arms = [abs(lever_arm(loaded, contact.touch.point, contact.touch.normal)) for contact in contacts]
    least = _LEAST_FORCE * float(max(forces))
    hertz = tuple(hertz_of(gear, c, max(float(f), least)) for c, f in zip(contacts, forces, strict=True))
    angles: dict[BodyName, float] = {"pinion": pinion_angle, "wheel": unloaded_wheel_angle(gear, contacts)}
    carrying = [(c, h) for c, h, f in zip(contacts, hertz, forces, strict=True) if f > 0.0]
    numbers = pair_numbers(gear, pinion_angle, pairs)
    numbers = range(numbers.start - idle, numbers.stop + idle)
    members = _members(gear).items()
    orders: dict[BodyName, list[int]] = {name: tooth_order(member, angles[name], numbers) for name, member in members}
    bodies: dict[BodyName, BodyMesh] = {
        name: mesh_body(_teeth(gear, name, angles[name], orders[name], carrying), density) for name in _members(gear)
    }
    pairs_in_mesh = _contact_pairs(bodies, gear, contacts, orders)
    closing = _CLOSING * max(one.approach for one in hertz)
    bodies["pinion"] = _with_true_gaps(gear, bodies, contacts, angles, pairs_in_mesh, closing)
    lead = int(np.argmax(forces))
    start = direction * _START_OVERLAP * hertz[lead].approach / arms[lead]
    frame = np.linalg.inv(loaded.pose(0.0))
    parts = []
    for name, member in _members(gear).items():
        motion = frame @ member.pose(angles[name])
        if name == load.member:
            motion = about_z(start) @ motion
        nodes = bodies[name].mesh.nodes @ motion[:3, :3].T + motion[:3, 3]
        parts.append(Part(name.upper(), HexMesh(nodes, bodies[name].mesh.elements), member.material))
    deck = Deck(
        f"meshwright: {len(contacts)} tooth pairs, pinion at {np.degrees(pinion_angle):.6f} deg",
        tuple(parts),
        rims=_rims(bodies, load, direction),
        contacts=pairs_in_mesh,
        remarks=(
            f"{load.torque / 1000.0:g} N m about z of the {load.member}; the rim of the other member is held.",
            f"The {load.member} starts {abs(start):.3e} rad past the first touch.",
        ),
    )
    return PairModel(deck, bodies, orders, contacts, hertz, load, frame, angles, start, direction)


def _members(gear: GearPair) -> dict[BodyName, Member]:
    return {"pinion": gear.pinion, "wheel": gear.wheel}


def _teeth(
    gear: GearPair,
    name: BodyName,
    angle: float,
    order: list[int],
    carrying: list[tuple[PairTouch, HertzContact]],
) -> list[PlacedTooth]:
    member = _members(gear)[name]
    zones = {}
    for contact, ellipse in carrying:
        touch = contact.touch
        touched = touch.pinion_angle if name == "pinion" else touch.wheel_angle
        to_body = np.linalg.inv(member.pose(touched))
        zones[contact.pairs_later] = ContactZone(
            member.working,
            to_body[:3, :3] @ touch.point + to_body[:3, 3],
            to_body[:3, :3] @ touch.major_direction,
            to_body[:3, :3] @ touch.normal,
            ellipse.semi_major,
            ellipse.semi_minor,
        )
    return [placed_tooth(member, angle, later, zones.get(later)) for later in order]


def _contact_pairs(
    bodies: dict[BodyName, BodyMesh], gear: GearPair, contacts: tuple[PairTouch, ...], orders: dict[BodyName, list[int]]
) -> tuple[ContactPair, ...]:
    faces = {}
    for name, member in _members(gear).items():
        flank = f"flank_{member.working}"
        faces[name] = {later: bodies[name].teeth[place][flank] for place, later in enumerate(orders[name])}
    return tuple(
        ContactPair(f"PAIR{number}", "PINION", faces["pinion"][c.pairs_later], "WHEEL", faces["wheel"][c.pairs_later])
        for number, c in enumerate(contacts, start=1)
    )


def _with_true_gaps(
    gear: GearPair,
    bodies: dict[BodyName, BodyMesh],
    contacts: tuple[PairTouch, ...],
    angles: dict[BodyName, float],
    pairs: tuple[ContactPair, ...],
    closing: float,
) -> BodyMesh:
    """The pinion with the nodes of its flanks moved so that facets have the gap of the flanks up to ``closing`` mm."""
    nodes = bodies["pinion"].mesh.nodes.copy()
    members = _members(gear).items()
    placed = {name: moved(member.pose(angles[name]), bodies[name].mesh.nodes) for name, member in members}
    to_body = gear.pinion.pose(angles["pinion"])[:3, :3]
    for contact, pair in zip(contacts, pairs, strict=True):
        plane = ContactPlane.of(gear, contact, (angles["pinion"], angles["wheel"]))
        quads = bodies["pinion"].mesh.face_nodes(pair.slave)
        slave, master = placed["pinion"][quads], placed["wheel"][bodies["wheel"].mesh.face_nodes(pair.master)]
        found, shifts = fitted_nodes(contact.touch.point, plane.axes, plane.gaps, slave, master, quads, closing)
        nodes[found] += shifts @ to_body
    return replace(bodies["pinion"], mesh=HexMesh(nodes, bodies["pinion"].mesh.elements))


def _rims(bodies: dict[BodyName, BodyMesh], load: Load, direction: int) -> tuple[RigidRim, ...]:
    return tuple(
        RigidRim(
            name.upper(),
            name.upper(),
            body.rim,
            (0.0, 0.0, 0.0),
            direction * load.torque if name == load.member else None,
        )
        for name, body in bodies.items()
    )
