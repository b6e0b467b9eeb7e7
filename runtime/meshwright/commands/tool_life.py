"""The life of a resharpened tool, and the oversize that meets given bounds.

Resharpening brings the tool's profile nearer to its axis at an unchanged lead; the machine is set so that the wheel
keeps the thickness of its teeth, and settings that the design gives are moved as much. At every grind: transmission
error of the drive, backlash, the contact pattern on the wheel's flank, and whether an edge leads, nominally and with
the errors of assembly after --error, each with either sign. With bounds also the smallest and the largest new tool that
meets all of them from the first to the last grind, and the bound that is active at both. Exit status 1 if a state has
no contact.
"""

import math

from meshwright.base.errors import UsageError
from meshwright.base.files import write_json, write_text
from meshwright.base.plain import finite_or_none
from meshwright.commands import options as common
from meshwright.commands.progress import progress
from meshwright.commands.shown import shown
from meshwright.contact.results import ARCSEC
from meshwright.design import design as designs
from meshwright.shop.tool_life import Bounds, ToolLife

#: More grinds than this, or errors of assembly at once, are taken for a mistake.
MOST_GRINDS, MOST_ERRORS = 1000, 4

#: How often a search for an oversize may say what it does, for the progress bar.
TRIALS = 24

#: What is less than this is round-off; columns of the table.
ROUND_OFF, WIDTHS = 1e-8, (11, 16, 15, 11, 10)


def add_arguments(parser):
    common.add_design(parser)
    parser.add_argument("--life-mm", type=common.positive, metavar="L", help="ground off in all; default: the oversize")
    parser.add_argument("--grinds", type=common.count, default=4, metavar="N", help="equal grinds; default 4")
    parser.add_argument(
        "--error", action="append", default=[], metavar="KEY=SIZE",
        help="error of assembly with either sign, e.g. misalignment.vertical_deg=0.02; repeatable",
    )  # fmt: skip
    parser.add_argument("--te-arcsec", type=common.positive, metavar="T", help="bound: transmission error of the drive")
    parser.add_argument("--pattern-percent", type=common.positive, metavar="P", help="bound: pattern of the new tool")
    parser.add_argument(
        "--oversize-percent", type=common.number, default=None, metavar="E",
        help="bound: least oversize that is left at the last grind; default 0",
    )  # fmt: skip
    parser.add_argument("--no-edge-contact", action="store_true", help="bound: no edge may lead at any grind")
    parser.add_argument("--toml", metavar="FILE|-", help="write the design with the largest new tool that meets all")
    parser.add_argument("--json", metavar="FILE|-", help="write as JSON (schema meshwright.tool-life/1)")


def run(options):
    drive = common.drive_of(options)
    example = "misalignment.vertical_deg=0.02"
    errors = dict(common.key_and_size("--error", text, example) for text in options.error)
    if len(errors) > MOST_ERRORS:
        raise UsageError(f"--error: {len(errors)} errors; {MOST_ERRORS} at most, as every sign of each is combined")
    life = ToolLife.of(drive, errors)
    bounds = _bounds(options)
    whole = _whole_life(options, life)
    if options.grinds > MOST_GRINDS:
        raise UsageError(f"--grinds {options.grinds}: {MOST_GRINDS} at most; choose fewer")
    amounts = [whole * k / options.grinds for k in range(options.grinds + 1)]
    for amount in reversed(amounts):
        life.at(amount)  # what cannot be is said before anything takes long
    with progress(len(amounts) + (TRIALS if bounds else 0)) as step:
        states = [_computed(life.state(amount), step) for amount in amounts]
        found = life.range(amounts, bounds, step) if bounds else None
    if options.toml:
        write_text(options.toml, designs.toml_text(life.at(0.0, found.largest.radius).design.given()))
    if options.json:
        write_json(options.json, document(life, states, found))
    elif options.toml != "-":
        write_text("-", _page(life, states, found))
    return 0 if all(math.isfinite(state.error) for state in states) else 1


def _computed(state, step):
    """The state, with all that is written of it."""
    step(f"{state.ground_off:g} mm ground off")
    _ = state.error, state.backlash, state.pattern, state.edges
    return state


def _bounds(options):
    """The bounds of the options, None if there are none."""
    given = (options.te_arcsec, options.pattern_percent, options.oversize_percent)
    if all(bound is None for bound in given) and not options.no_edge_contact:
        if options.toml:
            raise UsageError("--toml holds the largest tool that meets bounds: give --te-arcsec or another bound")
        return None
    oversize = options.oversize_percent or 0.0
    if oversize < 0.0:
        raise UsageError(f"--oversize-percent {oversize:g}: a tool smaller than its mate interferes; give 0 or more")
    if options.pattern_percent is not None and options.pattern_percent > 100.0:
        raise UsageError(f"--pattern-percent {options.pattern_percent:g}: a share of the flank; give 100 at most")
    return Bounds(
        None if options.te_arcsec is None else options.te_arcsec * ARCSEC,
        None if options.pattern_percent is None else 0.01 * options.pattern_percent,
        0.01 * oversize,
        options.no_edge_contact,
    )


def _whole_life(options, life):
    if options.life_mm is not None:
        return options.life_mm
    whole = life.life()
    if not whole > 0.0:
        raise UsageError(
            f"{life.regrind['radius']} = {life.radius:g}: not larger than that of its mate, {life.mate:g}, so that "
            "nothing can be ground off; give an oversize, or --life-mm L"
        )
    return whole


def document(life, states, found):
    """The ``meshwright.tool-life/1`` document; None for what does not exist."""
    return {
        "schema": "meshwright.tool-life/1",
        "drive": life.drive.design.family,
        "design": life.drive.design.as_solved(),
        "errors": life.errors,
        "states": [_state(state) for state in states],
        "oversize": found and {
            "smallest": _limit(life, found.smallest), "largest": _limit(life, found.largest), "life_mm": found.life,
        },
    }  # fmt: skip


def _state(state):
    pattern = state.pattern
    return {
        "ground_off_mm": state.ground_off,
        "working_radius_mm": state.working,
        "status": state.status,
        "transmission_error_arcsec": finite_or_none(state.error / ARCSEC),
        "backlash_arcsec": finite_or_none(state.backlash / ARCSEC),
        "pattern": pattern and {
            "share": pattern.share, "centre_axial_mm": finite_or_none(pattern.centre[0]),
            "centre_radius_mm": finite_or_none(pattern.centre[1]),
        },
        "edge_contact": [
            {"errors": edge.errors, "member": edge.member, "limits": list(edge.limits)} for edge in state.edges
        ],
        "design": state.drive.design.as_solved(),
    }  # fmt: skip


def _limit(life, limit):
    return {
        "radius_mm": limit.radius, "oversize_percent": 100.0 * (limit.radius / life.mate - 1.0), "bound": limit.bound,
        "ground_off_mm": limit.ground_off,
    }  # fmt: skip


def _page(life, states, found):
    heads = ("ground off", "working radius", "transmission", "backlash", "pattern")
    lines = ["".join(f"{head:>{width}}" for head, width in zip(heads, WIDTHS, strict=True)) + "  edge contact"]
    lines.append(f"{'mm':>11}{'mm':>16}{'error, arcsec':>15}{'arcsec':>11}{'% flank':>10}")
    for state in states:
        share = None if state.pattern is None else 100.0 * state.pattern.share
        angles = [finite_or_none(angle / ARCSEC) for angle in (state.error, state.backlash)]
        numbers = [state.ground_off, state.working, *angles, share]
        cells = (shown(v, round_off=ROUND_OFF) for v in numbers)
        row = "".join(f"{cell:>{width}}" for cell, width in zip(cells, WIDTHS, strict=True))
        lines.append(f"{row}  {_edges(state)}")
    if found:
        for name, limit in (("smallest", found.smallest), ("largest", found.largest)):
            share = 100.0 * (limit.radius / life.mate - 1.0)
            lines.append(
                f"{name} new tool {limit.radius:.4f} mm, {share:.3f} % oversize: {limit.bound} at "
                f"{limit.ground_off:g} mm ground off"
            )
        lines.append(f"the largest can lose {found.life:.4f} mm")
    return "\n".join(lines) + "\n"


def _edges(state):
    if state.status == "line_contact":
        return "contact along a line"
    words = []
    for edge in state.edges:
        at = ", ".join(f"{key.partition('.')[2]} {value:+g}" for key, value in edge.errors.items()) or "nominal"
        words.append(f"{' '.join(edge.limits)} of {edge.member} ({at})")
    return "; ".join(words) or "none"
