"""Check the generated C against the description of its drive: `python check_description.py [folder [drive …]]`,
exit status 0 if everything holds.

The description is plain data (``descriptions/<drive>.json``): motions are lists of factors, expressions prefix lists.
Both it and the C functions are evaluated modulo a prime of 61 bits drawn at random, at random parameters, unknowns and
points of the circle; derivatives are those of dual numbers. Then, for every drive:

  rules      each default and rule of a design, in its order; the change of each along changes of what it reads
  state      the parameters at its end
  systems    of a design: guess, natural sizes, equations with Jacobian, what they fill in, where they are regular,
             changes of equations and of what they fill in
  guards     what must be positive, in its order; divisors by the name in their message; which keys are missing
  sizes      derived sizes
  residual   of contact and start; natural sizes, guess and first contact
  chain      a point is carried by the factors of its motions, a normal turned by them and divided by its length, in the
             observation and on each flank; tangents are derivatives, fixed frame
  limits     margins, relative ones and derivatives among them, conditions, recovered parameters, wheel's angle
  regular    the singular function of each flank and region
  forms      tangent basis, second forms by linear algebra of their own, principal curvatures by sum and product
  placement  motions of both bodies; axis and lever arm by what a change of the body's angle moves
  functions  results of whatever else the drive offers

A normal that points the other way has the same length and is refused. A wrong program passes with a probability of
about degree / 2^61.
"""

import json
from collections.abc import Iterator
from pathlib import Path

from .command import described, ended, folder_of
from .contact import (
    check_arms,
    check_contact,
    check_curvature,
    check_forms,
    check_function,
    check_gap,
    check_observed,
    check_placement,
    check_scales,
    check_start,
    check_surface,
    observed_keys,
)
from .design import (
    DIVISOR,
    check_changes,
    check_filled_changes,
    check_guard,
    check_kept,
    check_missing,
    check_open,
    check_rules,
    check_sizes,
    check_system,
    check_system_changes,
    check_unit,
    given_rules,
    guard_texts,
)
from .draws import Draws, on_both_flanks
from .drive import Drive
from .refusal import UNREADABLE, Rejected
from .straight_line import read_companion


def checks_of(drive: Drive) -> Iterator[tuple[str, tuple]]:
    """Words, and a check with its arguments."""
    described = drive.description
    for k, (target, _) in enumerate(given_rules(drive)):
        yield f"rule {k} for {target}", (check_rules, drive, k)
        if drive.tangents:
            yield f"changes by rule {k} for {target}", (check_changes, drive, k)
    for system in described["design_systems"]:
        unknowns = range(len(system["unknowns"]))
        keys = {"guess": unknowns, "scale": unknowns, "eval": range(len(system["residual"])), "fill": system["fills"]}
        for name, places in (keys | ({"watch": ["sign"]} if system["regular"] else {})).items():
            for key in places:
                yield f"{key} of {system['name']}_{name}", (check_system, drive, system, name, key)
        if drive.tangents:
            yield f"changes of {system['name']}", (check_system_changes, drive, system)
            yield f"changes by {system['name']}", (check_filled_changes, drive, system)
    yield "parameters at the end of the state", (check_kept, drive)
    for k, words in enumerate(guard_texts(drive)):
        if k < len(described["guards"]) or DIVISOR.search(words):
            yield f"guard {k}", (check_guard, drive, k)
    yield "keys that are missing", (check_missing, drive)
    for k, entry in enumerate(described["sizes"]):
        yield f"size {entry['key']}", (check_sizes, drive, k)
    for k in range(len(described["contact"]["residual"])):
        yield f"residual {k} of the contact", (check_contact, drive, k)
    yield "natural sizes of the unknowns", (check_scales, drive)
    start = described["start"]
    rows = {
        "start_eval": ("residual", len(start["residual"])),
        "start_scale": ("scale", len(start["unknowns"])),
        "guess": ("guess", len(start["unknowns"])),
        "start_solution": ("solution", len(drive.unknowns)),
    }
    for name, (key, count) in rows.items():
        for k in range(count):
            yield f"{key} {k} of the start", (check_start, drive, name, key, k)
    for key in observed_keys(drive):
        yield f"{key} of the observation", (check_observed, drive, key)
    surfaces = [(body, f"flank_{body['name']}") for body in described["bodies"]]
    surfaces += [(region, f"{region['region']}_{region['member']}") for region in described["regions"]]
    for entry, name in surfaces:
        conditions = [f"condition_{k}" for k in range(len(entry["surface"]["conditions"]))]
        margins = [f"margin_{m['event']}" for m in entry["margins"]]
        for key in ("point", "normal", "regular", *conditions, *margins):
            yield f"{key} of {name}", (check_surface, drive, entry, name, key)
        for side in (1, -1):
            yield f"curvature of {name}", (check_curvature, drive, entry, name, side)
    names = [f"second_form_{body['name']}" for body in described["bodies"]]
    for key in ("tangent_basis", *names):
        yield f"{key} of the observation", (check_forms, drive, key)
    for side in (1, -1):
        yield "gap of the observation", (check_gap, drive, side)
    yield "lever arms of the observation", (check_arms, drive)
    for member, body in enumerate(described["bodies"]):
        yield f"placement of the {body['name']}", (check_placement, drive, member)
    for entry in described["functions"]:
        for result in entry["results"]:
            yield f"{result['name']} of {entry['name']}", (check_function, drive, entry, result)


def check_drive(description: Path, header: Path) -> int:
    """All checks of one drive; how many were made."""
    try:
        text, changes = header.read_text(encoding="utf-8"), read_companion(header, "sensitivity")
        drive = Drive(json.loads(description.read_text(encoding="utf-8")), text, changes)
        for number in range(len(drive.description["keys"])):
            check_unit(drive, number)
        for system in drive.description["design_systems"]:
            check_open(drive, system)
        checks, draws = list(checks_of(drive)), (Draws(1), Draws(-1))
        for _, check in checks:
            on_both_flanks(*check, draws=draws)
    except (Rejected, *UNREADABLE) as error:
        raise Rejected(f"{header.name}: {error}") from error
    return len(checks)


def main(arguments: list[str]) -> int:
    def said() -> str:
        folder = folder_of(arguments)
        paths = described(folder, arguments[1:])
        checks = sum(check_drive(path, folder.parent / "c" / f"{path.stem}.h") for path in paths)
        return (
            f"{checks} checks of {len(paths)} drives hold: rules and their changes, design systems, guards, sizes, "
            "residuals, start, points, normals, tangents, curvatures, margins, placements and functions are those of "
            "the description"
        )

    return ended(said)
