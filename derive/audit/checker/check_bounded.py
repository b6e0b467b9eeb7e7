"""Check the C of bounded flanks, and CasADi's functions where CasADi can be imported: `python check_bounded.py [folder
[drive …]]`, exit status 0 if everything holds.

Modulo a prime of 61 bits drawn at random, at random inputs, on both flanks:

  edges      equations of edge contact: distance of the placed points, conditions, margin of each edge, tangency of each
             edge to the mating flank, all from the description; their Jacobian by dual numbers; which equations a
             system takes, and which margins it names
  slopes     of each limit of a flank or region by each parameter, by dual numbers
  second     derivatives of point, limits and conditions: of tangents, slopes and recorded slopes, by dual numbers
  casadi     every result of every function, as its own list of instructions computes it, is that of the C function:
             residual, observation, placement, start, natural sizes, guards, rules, surfaces with curvature, functions,
             systems of a design, edges; but for the principal curvatures of the gap, which follow from its form

  tables     the tables of the certified functions, each constant within its radius: setup, instant, equations with
             Jacobian, observation, derivatives along a path, flanks, placement, rules and design systems are those of
             C and description
"""

import json
import sys
from collections.abc import Iterator
from pathlib import Path

from .any_root import kept_draws, with_any_root
from .as_they_stand import CHOSEN, check_as_they_stand
from .casadi_functions import Casadi, casadi, check_casadi, parts_of
from .command import described, ended, folder_of
from .edges import BoundedDrive, check_edge_slopes, check_edges, check_slopes, check_systems
from .refusal import UNREADABLE, Rejected
from .straight_line import read_companion
from .tables import tables_of


def checks_of(drive: BoundedDrive, functions: Casadi | None) -> Iterator[tuple[str, tuple]]:
    """Words, and a check with its arguments."""
    if " " + drive.prefix + "_edges(" in drive.bounded:
        yield "edges", (check_edges, drive)
        yield "slopes of edges", (check_edge_slopes, drive)
    for entry, name in drive.surfaces():
        yield f"slopes and second derivatives of {name}", (check_slopes, drive, entry, name)
    if drive.tables:
        yield from tables_of(drive)
    if functions is None:
        return
    systems = [f"_{system['name']}" for system in drive.description["design_systems"]]
    for ending in ("", "_edges", "_surfaces", *systems):
        if (functions.folder / f"{drive.prefix}{ending}.casadi").is_file():
            for result, (_, size) in functions(ending)[0].outputs.items():
                for part in parts_of(drive, ending, result, size) if size else ():
                    yield f"CasADi{ending}: {result}{list(part)}", (
                        check_casadi, drive, functions, ending, result, part,
                    )  # fmt: skip


def check_drive(description: Path, header: Path, folder: Path) -> int:
    """All checks of one drive; how many were made."""
    try:
        drive = BoundedDrive(
            json.loads(description.read_text(encoding="utf-8")),
            header.read_text(encoding="utf-8"),
            read_companion(header, "bounded"),
            read_companion(header, "certified"),
        )
        functions = Casadi(folder, drive.prefix) if casadi and folder.is_dir() else None
        if drive.bounded:
            check_systems(drive)
            if f" {drive.prefix}_edges(" in drive.bounded:
                check_as_they_stand(drive.bounded, drive.prefix, CHOSEN)
        checks = list(checks_of(drive, functions))
        draws = kept_draws()
        for _, (check, *arguments) in checks:
            with_any_root(check, tuple(arguments), draws)
    except (Rejected, *UNREADABLE) as error:
        raise Rejected(f"{header.name}: {error}") from error
    return len(checks)


def main(arguments: list[str]) -> int:
    def said() -> str:
        folder = folder_of(arguments)
        paths, root = described(folder, arguments[1:]), folder.parent
        checks = sum(check_drive(path, root / "c" / f"{path.stem}.h", root / "casadi") for path in paths)
        words = "edges, limits, second derivatives, tables" + (", CasADi" if casadi else "")
        return f"{checks} checks of {len(paths)} drives hold: {words}"

    if casadi is None:
        print("CasADi is not installed: its functions are not compared", file=sys.stderr)
    return ended(said)
