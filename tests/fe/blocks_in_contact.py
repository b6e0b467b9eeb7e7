"""Two elastic blocks pressed together: the models of the patch test and of the Hertz tests."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from meshwright.fe.blocks import Block, FineZone, graded
from meshwright.fe.deck import ContactPair, Deck, NodalForces, Part, Support, write
from meshwright.fe.hexahedra import nodal_areas
from meshwright.fe.results import read_frd
from meshwright.fe.solver import run_ccx


@dataclass(frozen=True)
class Pressed:
    """Peak pressure, force carried by the nodal pressures, and nodal stresses of (upper, lower)."""

    peak_pressure: float
    pressures: np.ndarray
    force: float
    stresses: tuple[np.ndarray, np.ndarray]


def block(x, y, depths, crown, upper):
    """Points of a block below (or above) z = 0; ``crown(x, y)`` lifts the underside of the upper one."""
    gx, gy, gz = np.meshgrid(x, y, depths, indexing="ij")
    if upper:
        gz = gz + crown(gx, gy) * (1 - gz / depths[-1])
        return Block(np.stack([gx, gy, gz], axis=-1))
    return Block(np.stack([gx, gy, -gz], axis=-1)[:, :, ::-1])


def graded_lengths(half_width, per_half_width, size, layers=4):
    """Positions symmetric about 0 for the contact plane and layers for the depth."""
    side = graded(size, FineZone(0.0, 1.3 * half_width, half_width / per_half_width), 2.0)
    depth = graded(size, FineZone(0.0, 1.2 * half_width, half_width / layers), 2.0)
    return np.concatenate([-side[:0:-1], side]), depth


def press(ccx, folder: Path, lower: Block, upper: Block, material, force, overlap, plane_strain=False) -> Pressed:
    """Press ``upper`` on ``lower`` by a uniform pressure on its top whose resultant is ``force``."""
    upper = Block(upper.points - np.array([0.0, 0.0, overlap]))
    parts = (Part("LOWER", lower.mesh(), material), Part("UPPER", upper.mesh(), material))
    top, areas = nodal_areas(parts[1].mesh.nodes, parts[1].mesh.face_nodes(upper.side("k1")))
    loads = np.zeros_like(areas)
    loads[:, 2] = -force * areas[:, 2] / areas[:, 2].sum()
    base = np.unique(parts[0].mesh.face_nodes(lower.side("k0")))
    supports = [Support("LOWER", base, 3, np.zeros(len(base)))]
    for part, held in zip(parts, (base, top), strict=True):
        supports.append(Support(part.name, held, 1, np.zeros(len(held))))
        side = np.arange(len(part.mesh.nodes)) if plane_strain else held
        supports.append(Support(part.name, side, 2, np.zeros(len(side))))
    pair = ContactPair("C", "UPPER", upper.side("k0"), "LOWER", lower.side("k1"))
    deck = Deck("two blocks", parts, tuple(supports), (NodalForces("UPPER", top, loads),), contacts=(pair,))
    input_file = folder / "blocks.inp"
    input_file.write_text(write(deck))
    run = run_ccx(ccx, input_file, 200.0)
    assert run.finished, run.log[-1000:]
    fields = read_frd(input_file.with_suffix(".frd"))
    nodes, vectors = nodal_areas(parts[1].mesh.nodes, parts[1].mesh.face_nodes(pair.slave))
    column = fields["CONTACT"].components.index("CPRESS")
    pressures = np.nan_to_num(fields["CONTACT"].at(nodes + deck.first_node("UPPER"))[:, column])
    stresses = tuple(
        fields["STRESS"].at(np.arange(len(part.mesh.nodes)) + deck.first_node(part.name)) for part in reversed(parts)
    )
    return Pressed(pressures.max(), pressures, float(-(pressures @ vectors)[2]), stresses)
