"""Stresses by finite elements (CalculiX): contact pressure, stress below the surface, bending stress in the fillets.

Writes input, results, VTU and pictures into a folder; an accepted position is not solved twice. Without the solver
ccx it writes the input and says how to install it. A terminal shows how far it is.
Exit status 1 if a run misses its acceptance gate, or there is no solver; such a position has no stress in it.
"""

import sys
from pathlib import Path

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.files import locked, write_json, write_text
from meshwright.commands import loading
from meshwright.commands import options as common
from meshwright.commands.progress import progress
from meshwright.commands.shown import blank_note
from meshwright.contact.flags import OVERLAP

# What is asked for has so much to spare over what the gate wants.
_SPARE = 1.1


def add_arguments(parser):
    loading.add_arguments(parser)
    parser.add_argument("--phi-deg", metavar="A:B:STEP|v1,v2,…", default="0", help="pinion angles, degrees; default 0")
    parser.add_argument("--folder", metavar="DIR", help="where the runs are kept; default: NAME-fe")
    parser.add_argument(
        "--time-limit-s",
        type=common.positive,
        default=1800.0,
        metavar="S",
        help="of the solver at one angle; default 1800. What comes before is not limited: the teeth, once, and the "
        "mesh of each angle, some seconds",
    )
    parser.add_argument(
        "--threads", type=common.count, default=1, metavar="N", help="of the solver; a second one gains little"
    )
    parser.add_argument(
        "--refine",
        type=common.positive,
        default=1.0,
        metavar="F",
        help="elements in the contact zone so many times smaller, for a run that misses its gate; default 1",
    )
    parser.add_argument("--json", metavar="FILE|-", help="write as JSON (schema meshwright.fe/1)")


def run(options):
    fe = loading.finite_elements("analysis", "pictures")
    drive = loading.checked_drive(options)
    angles = common.angles(options.phi_deg)
    density = fe.grading.MeshDensity().refined(options.refine)
    ccx = fe.solver.find_ccx()
    folder = Path(options.folder or f"{Path(options.design).stem}-fe")
    positions = []
    _make(folder)
    with locked(folder, "finite-element run"), progress(2 * len(angles) + 3) as step:
        gear, load, pairs = loading.loaded_gears(fe, options, drive, step)
        _check_touches(fe, gear, angles, pairs)
        if ccx is None:
            print(f"meshwright: {fe.solver.INSTALL_HINT}; the input is written, not solved", file=sys.stderr)
        settings = fe.analysis.Settings(pairs, options.time_limit_s, options.threads, density)
        compliance = loading.compliances(fe, gear, pairs, step)
        for angle in angles:
            step(f"mesh at {np.degrees(angle):.4g} deg")
            place = folder / f"{options.torque_nm:g}nm_{np.degrees(angle):+.4f}deg"
            try:
                prepared = fe.analysis.prepare(gear, compliance, angle, load, settings, place)
            except ArithmeticError as error:
                raise UsageError(f"--torque-nm {options.torque_nm:g} at {np.degrees(angle):g} deg: {error}") from error
            step(f"solve {prepared.model.deck.element_count} elements at {np.degrees(angle):.4g} deg")
            positions.append(_position(fe, prepared, ccx, settings))
    if len(positions) > 1:
        _picture_of_cycle(fe, positions, folder)
    _write(options, gear, positions)
    return 0 if all(_accepted(position) for position in positions) else 1


def _make(folder):
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UsageError(f"--folder {folder}: cannot be made ({error.strerror}); name another folder") from error


def _check_touches(fe, gear, angles, pairs):
    for angle in angles:
        found = fe.pair.touches(gear, angle, pairs)
        if any(contact.touch.curvature_min == 0.0 for contact in found):
            raise UsageError(
                f"--phi-deg {np.degrees(angle):g}: the flanks touch along a line, and the mesh is made about a contact "
                "ellipse; crown a flank by some um; `meshwright loaded` has lines"
            )
        if not found:
            raise UsageError(
                f"--phi-deg {np.degrees(angle):g}: no tooth pair touches there; "
                f"{loading.gap_note(gear) or '`meshwright ratio` says where'}"
            )
        first = fe.pair.leading_edge(gear, angle, pairs)
        if first is not None and first[1] > OVERLAP:
            raise UsageError(
                f"--phi-deg {np.degrees(angle):g}: the {first[0].touch.edge} touches {1000.0 * first[1]:.3g} um before "
                "any tangency, about which the mesh is made; `meshwright loaded` has the edges in it"
            )


def _position(fe, prepared, ccx, settings):
    earlier = fe.analysis.earlier_result(prepared)
    if earlier is not None:
        return earlier
    if ccx is None:
        return fe.analysis.without_solver(prepared)
    return fe.analysis.solve(prepared, ccx, settings)


def _accepted(position):
    return all(check["held"] for check in position["gate"].values())


def _picture_of_cycle(fe, positions, folder):
    accepted = [position for position in positions if _accepted(position)]
    if len(accepted) > 1:
        path = folder / "stress_over_angle.png"
        fe.pictures.stress_over_angle(accepted, path)
        for position in accepted:
            position["files"]["stress_over_angle"] = str(path)


def _write(options, gear, positions):
    positions = [position | {"assumed_blank": gear.assumed} for position in positions]
    whole = {"schema": positions[0]["schema"], "torque_nm": options.torque_nm, "points": positions}
    if options.json:
        write_json(options.json, positions[0] if len(positions) == 1 else whole)
    else:
        write_text("-", blank_note(gear.assumed) + "".join(map(page, positions)))


def _or_none(value):
    return "–" if value is None else f"{value:.5g}"


def _remedy(position):
    """What a run that misses its gate needs: as many elements as its ellipse asks for, else finer ones to see more."""
    rows, refine = position["gate"]["elements_per_semi_minor"], position["refine"]
    if rows["held"] or not rows["value"]:
        return f"--refine {1.3 * refine:.3g} divides the contact zone more finely"
    finer = _SPARE * rows["limit"] / rows["value"]
    return (
        f"--refine {finer * refine:.3g} makes elements {finer:.2g} times smaller, as the contact ellipse needs, about "
        f"{finer**2 * position['elements']:.2g} in all"
    )


def page(position):
    """What the command prints of one position."""
    lines = [
        f"{position['torque_nm']:g} N m on the {position['torque_on']}, "
        f"pinion at {position['pinion_angle_deg']:.6g} deg: "
        f"{position['elements']} elements, {position['nodes']} nodes"
    ]
    for name, check in position["gate"].items():
        value = "no value" if check["value"] is None else f"{check['value']:.4g}"
        lines.append(
            f"  gate {name:<24} {value:>10}  limit {check['limit']:<8g} {'held' if check['held'] else 'MISSED'}"
        )
    if position.get("message"):  # one kept by an earlier version has none
        lines.append(f"  {position['message']}")
    if position["gate"]["finished"]["held"] and not _accepted(position):
        lines.append(f"  no stress is given; {_remedy(position)}")
    for pair in position["pairs"]:
        lines.append(
            f"  pair {pair['pairs_later']:+d}: force {pair['force_n']:.5g} N, "
            f"contact pressure {pair['peak_pressure_mpa']:.5g} MPa, "
            f"von Mises below the surface {_or_none(pair['subsurface_von_mises_mpa'])} MPa"
        )
    for name, stress in (position["bending"] or {}).items():
        lines.append(
            f"  fillets of the {name}: von Mises {stress['von_mises_mpa']:.5g} MPa, "
            f"largest principal {stress['max_principal_mpa']:.5g} MPa"
        )
    return "\n".join(lines) + "\n"
