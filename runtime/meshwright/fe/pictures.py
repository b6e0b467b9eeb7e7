"""Pictures of a solved position: mesh with von Mises stress, pressure over the flanks, stress over the pinion angle."""

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from matplotlib.tri import Triangulation
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from meshwright.fe.hexahedra import FACES, Floats, HexMesh, Ints
from meshwright.fe.material import von_mises
from meshwright.fe.model import BodyName, PairModel
from meshwright.fe.stress import Solution

_DPI = 150
_COLOURS = "viridis"
# More would run into each other on an axis seen nearly end on.
_TICKS = 4
# Degrees above the horizon at least, or below it where the flanks are seen from below; what is level within this.
_LEAST_ELEVATION, _LEVEL = 20.0, 1.0


def draw(model: PairModel, solution: Solution, folder: Path) -> dict[str, str]:
    """Draw mesh with stress of both bodies and the pressures; returns the files by name."""
    files = {}
    for name in model.bodies:
        files[f"von_mises_{name}"] = folder / f"von_mises_{name}.png"
        _von_mises(model, solution, name).savefig(files[f"von_mises_{name}"], dpi=_DPI)
    files["pressure"] = folder / "pressure.png"
    _pressure(model, solution).savefig(files["pressure"], dpi=_DPI)
    return {name: str(path) for name, path in files.items()}


def stress_over_angle(positions: list[dict], path: Path) -> None:
    """Contact and bending stress of ``meshwright.fe/1`` positions over the pinion angle."""
    figure = Figure(figsize=(7.0, 6.0), layout="constrained")
    contact, bending = figure.subplots(2, 1, sharex=True)
    ordered = sorted(positions, key=lambda position: position["pinion_angle_deg"])
    angles = [position["pinion_angle_deg"] for position in ordered]
    for key, label in (("peak_pressure_mpa", "pressure"), ("subsurface_von_mises_mpa", "von Mises below the surface")):
        contact.plot(angles, [max(pair[key] or 0.0 for pair in p["pairs"]) for p in ordered], "o-", label=label)
    for name in ("pinion", "wheel"):
        values = [position["bending"][name]["max_principal_mpa"] for position in ordered]
        bending.plot(angles, values, "o-", label=f"{name}, largest principal")
    for axes, title in ((contact, "contact stress"), (bending, "stress in the fillets")):
        axes.margins(y=0.1)
        axes.set(ylabel=f"{title} / MPa")
        axes.set_ylim(bottom=0.0)
        axes.grid(alpha=0.3)
        axes.legend(loc="lower right")
    bending.set_xlabel("pinion angle / deg")
    figure.savefig(path, dpi=_DPI)


def boundary(mesh: HexMesh) -> Ints:
    """Nodes (F, 4) of the faces that belong to one element only."""
    quads = mesh.elements[:, FACES].reshape(-1, 4)
    _, first, counts = np.unique(np.sort(quads, axis=1), axis=0, return_index=True, return_counts=True)
    return quads[first[counts == 1]]


def _von_mises(model: PairModel, solution: Solution, name: BodyName) -> Figure:
    mesh = _loaded_teeth(model, name)
    stress = von_mises(solution.stresses[name])
    quads = boundary(mesh)
    values = stress[quads].mean(axis=1)
    figure = Figure(figsize=(8.0, 6.5), layout="constrained")
    axes = figure.add_subplot(projection="3d")
    # The contact is a small bright spot: the scale ends where the fillets are still told apart.
    scale = Normalize(0.0, 1.5 * solution.bending[name].von_mises)
    colours = ScalarMappable(scale, _COLOURS)
    faces = Poly3DCollection(mesh.nodes[quads], facecolors=colours.to_rgba(values), edgecolors="0.25", linewidths=0.1)
    axes.add_collection3d(faces)
    low, high = mesh.nodes[quads].min(axis=(0, 1)), mesh.nodes[quads].max(axis=(0, 1))
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    # An upright box would reach into the title.
    zoom: Any = 0.85 if high[2] - low[2] >= (high - low)[:2].max() else 1.0  # matplotlib declares a whole number
    axes.set_box_aspect(high - low, zoom=zoom)
    axes.set(xlabel="x / mm", ylabel="y / mm")
    axes.zaxis.set_rotate_label(False)  # else it may stand on its head
    axes.set_zlabel("z / mm", rotation=90)
    for axis in (axes.xaxis, axes.yaxis, axes.zaxis):
        axis.set_major_locator(MaxNLocator(_TICKS))
    axes.view_init(*view(model, name))
    bar = figure.colorbar(colours, ax=axes, shrink=0.7, extend="max")
    bar.set_label(f"von Mises stress / MPa (largest on the surface {values.max():.0f})")
    figure.suptitle(f"von Mises stress of the {name}; {_position(model)}")
    return figure


def _loaded_teeth(model: PairModel, name: BodyName) -> HexMesh:
    """The body without its idle teeth, which would hide the loaded flanks."""
    mesh = model.deck.part(name.upper()).mesh
    touching = {contact.pairs_later for contact in model.contacts}
    count = len(mesh.elements)
    starts = [int(min(faces.elements.min() for faces in tooth.values())) for tooth in model.bodies[name].teeth]
    ends = [*starts[1:], count]
    keep = [
        np.arange(start, end)
        for start, end, later in zip(starts, ends, model.orders[name], strict=True)
        if later in touching
    ]
    return HexMesh(mesh.nodes, mesh.elements[np.concatenate(keep)])


def view(model: PairModel, name: BodyName) -> tuple[float, float]:
    """Elevation and azimuth in degrees that look at the flanks in contact, a little from the tip."""
    rotation = model.frame[:3, :3]
    normal = rotation @ model.contacts[0].touch.normal
    outward = normal if name == "pinion" else -normal
    mesh = model.deck.part(name.upper()).mesh
    up = rotation @ model.contacts[0].touch.point + model.frame[:3, 3] - mesh.nodes.mean(axis=0)
    across = up - (up @ outward) * outward
    sight = outward + 0.5 * across / np.linalg.norm(across)
    elevation = float(np.degrees(np.arctan2(sight[2], np.hypot(sight[0], sight[1]))))
    # What lies level, to round-off, is seen from above.
    below = elevation < -_LEVEL
    slant = min(elevation, -_LEAST_ELEVATION) if below else max(elevation, _LEAST_ELEVATION)
    return slant, float(np.degrees(np.arctan2(sight[1], sight[0])))


def _pressure(model: PairModel, solution: Solution) -> Figure:
    """Each loaded pair in a row: the whole flank, and its contact zone magnified."""
    loaded = [k for k, (_, values) in enumerate(solution.pressures) if values.max() > 0.0]
    figure = Figure(figsize=(10.0, 3.2 * len(loaded) + 0.6), layout="constrained")
    peak = max(solution.pressures[k][1].max() for k in loaded)
    for (whole, zone), k in zip(figure.subplots(len(loaded), 2, squeeze=False), loaded, strict=True):
        title = f"pair {model.contacts[k].pairs_later:+d}: largest pressure {solution.pressures[k][1].max():.0f} MPa"
        drawn = _flank_pressure(whole, model, solution, k, peak)
        whole.set(aspect="equal", title="pinion flank", ylabel="along the minor axis / mm")
        _flank_pressure(zone, model, solution, k, peak)
        reach = 1.6 * np.array([model.hertz[k].semi_major, model.hertz[k].semi_minor])
        zone.set(xlim=(-reach[0], reach[0]), ylim=(-reach[1], reach[1]), title=title)
    bar = figure.colorbar(drawn, ax=figure.axes)
    bar.set_label("contact pressure / MPa")
    figure.suptitle(_position(model))
    return figure


def _flank_pressure(axes: Axes, model: PairModel, solution: Solution, number: int, peak: float) -> ScalarMappable:
    pair = model.deck.contacts[number]
    mesh = model.deck.part(pair.slave_part).mesh
    quads = mesh.face_nodes(pair.slave)
    nodes, values = solution.pressures[number]
    touch = model.contacts[number].touch
    rotation = model.frame[:3, :3]
    centre = rotation @ touch.point + model.frame[:3, 3]
    plane = np.stack([touch.major_direction, np.cross(touch.normal, touch.major_direction)]) @ rotation.T
    local: Floats = (mesh.nodes - centre) @ plane.T
    field = np.zeros(len(mesh.nodes))
    field[nodes] = values
    triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    grid = Triangulation(local[:, 0], local[:, 1], triangles)
    drawn = axes.tripcolor(grid, field, shading="gouraud", vmin=0.0, vmax=peak, cmap=_COLOURS)
    edges = local[quads][:, [0, 1, 2, 3, 0]]
    axes.add_collection(LineCollection(list(edges), colors="white", linewidths=0.15))
    axes.set_xlabel("along the major axis / mm")
    flank = local[np.unique(quads)]
    axes.set(xlim=(flank[:, 0].min(), flank[:, 0].max()), ylim=(flank[:, 1].min(), flank[:, 1].max()))
    return drawn


def _position(model: PairModel) -> str:
    torque = f"{model.load.torque / 1000.0:g} N m on the {model.load.member}"
    return f"pinion at {np.degrees(model.angles['pinion']):.3f} deg, {torque}"
