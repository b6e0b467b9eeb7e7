"""All contacts of one tooth pair at one angle, sought over the whole sheet of a wheel that a helicoid generates."""

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.library import ffi, library, pointer
from meshwright.contact import analysis, functions
from meshwright.limits.profile import Profile
from meshwright.limits.rack import sizes

#: Lines Ψ = constant on which contacts are sought, and profile points on each.
LINES, POINTS = 41, 120

#: How far from the reference radius the profile is searched, in normal modules.
DEPTH = 3.0

#: Steps in Ψ beside a contact that has been found at which others are sought: near a branch point they lie close.
NEARBY = (-0.1, -0.03, 0.03, 0.1)

#: Two solutions nearer than this, in natural sizes of the unknowns, are one.
SAME = 1e-6


def contacts(drive, angle):
    """Every contact of the pair at a pinion angle (rad): a :class:`~meshwright.contact.results.TCA`, one row each.

    Solutions on the spurious sheet, where the wheel's flank does not lie, are rejected; points that bodies cannot
    make keep their flags. Rows are in ascending order of the rack angle Ψ.
    """
    if not functions.has(drive, "generation"):
        raise UsageError("all contacts: no member of this drive is generated as rack and pinion; leave it out")
    angle = drive.design.mirror.sign * angle
    lines, found = np.linspace(*Profile(drive, "tool").sheet(), LINES), []
    for _ in range(2):
        found = _distinct(drive, [*found, *_solutions(drive, angle, lines)])
        places = np.array([_on_wheel(drive, x)[1] for x in found])
        lines = np.concatenate([(places[:-1] + places[1:]) / 2, *(places + step for step in NEARBY)])
    return analysis.at_solutions(drive, np.full(len(found), angle), np.array(found).reshape(-1, drive.model.nx))


def _on_wheel(drive, x):
    """Parameters (t, Ψ) of the wheel's flank among the unknowns."""
    _, wheel = drive.design.description["bodies"]
    return x[wheel["unknowns"]]


def _solutions(drive, angle, lines):
    refined = (_refined(drive, angle, seed) for seed in _seeds(drive, angle, lines))
    return [x for x in refined if x is not None]


def _seeds(drive, angle, lines):
    """Starts (nx,): points of the tool's flank at the right cutting angle, and the pinion's flank at the same depth.

    The tool replaces the pinion but for its size: equal depth below the reference cylinder, equal polar angle.
    """
    have = sizes(drive)
    tool, pinion = Profile(drive, "tool"), Profile(drive, "pinion")
    cutting_angle = angle * have["turns"]
    t_tool = tool.samples(have["reference_radius_tool"] + DEPTH * have["module"], POINTS)
    t_pinion = pinion.samples(have["reference_radius_pinion"] + DEPTH * have["module"], POINTS)
    pinion_radius, pinion_point = pinion.radius(t_pinion), pinion(t_pinion)["point"]
    pinion_angle = np.unwrap(np.arctan2(pinion_point[:, 1], pinion_point[:, 0]))
    generation = drive.function("generation")
    _, turn_of_tool = generation.recovered
    for psi in lines:
        at = generation(t_tool, psi)
        ahead = at[turn_of_tool] - cutting_angle
        with np.errstate(invalid="ignore"):
            crossings = np.flatnonzero(ahead[:-1] * ahead[1:] <= 0.0)
        for k in crossings:
            share = ahead[k] / (ahead[k] - ahead[k + 1])
            x, y, _ = at["point"][k] + share * (at["point"][k + 1] - at["point"][k])
            depth = np.hypot(x, y) - have["oversize"]
            turn = np.arctan2(y, x) - angle - np.interp(depth, pinion_radius, pinion_angle)
            along = t_tool[k] + share * (t_tool[k + 1] - t_tool[k])
            yield np.interp(depth, pinion_radius, t_pinion), turn, along, psi, 0.0


def _refined(drive, angle, seed):
    """The solution that Newton reaches from a start; None if none, or one on the spurious sheet."""
    m, s = drive.model, drive.state(angle)
    x, info = np.array(seed, dtype=float), ffi.new("mw_info *")
    if library().mw_refine(m, pointer(s), pointer(x), info) < 0:
        return None
    margins = drive.flank("wheel")([_on_wheel(drive, x)]).margins
    return x if margins["spurious_sheet"][0] > 0.0 else None


def _distinct(drive, solutions):
    scale = np.empty(drive.model.nx)
    drive.model.scale(pointer(drive.state()), pointer(scale))
    kept = []
    for x in sorted(solutions, key=lambda x: _on_wheel(drive, x)[1]):
        if all(np.abs((x - other) / scale).max() > SAME for other in kept):
            kept.append(x)
    return kept
