"""Check the description of each drive against what its sources print and against the laws of enveloping:
`python check_print.py [folder [drive …]]`, exit status 0 if everything holds.

Print: ``printed.txt`` says, family by family, what books, papers and standards print: motions of machine and assembly,
edges of tools, rules, sizes, guards, margins, outward normals. The other side of each statement is read from the
description (``descriptions/<drive>.json``) that the program is made from, never from a copy. Both are evaluated modulo
a prime of 61 bits drawn at random, at random values, on both flanks; a wrong one agrees with a probability of about
degree / 2^61.

Laws, of every surface of every drive:

  made       its point is the tool's edge carried by sweep, moves and generating motion, in this order
  enveloping its normal is at right angles to what moves the tool against the blank, solved or as a condition
  normal     at right angles to both tangents of the tool's surface
  contact    the residual is the difference of the two placed points and the normal of one against the tangents of the
             other
  derived    definitions that are slopes are the derivatives of what they are named after
"""

import json
from collections.abc import Iterator
from pathlib import Path

from .command import described, ended, folder_of
from .described import Described
from .draws import Draws, on_both_flanks
from .laws import check_contact, check_enveloping, check_made, check_slope, slopes_of
from .printed import is_about, read_printed, statements_of
from .refusal import UNREADABLE, Rejected, require
from .statements import check_said, check_statement


def checks_of(drive: Described, name: str, printed: list) -> Iterator[tuple[str, tuple]]:
    """Words, and a check with its arguments."""
    for statement in statements_of(name, printed):
        if statement.kind != "open":
            yield statement.text, (check_statement, drive, statement)
    for place in drive.entries:
        yield f"chain of {place}", (check_made, drive, place)
        yield f"enveloping of {place}", (check_enveloping, drive, place)
    yield "contact", (check_contact, drive)
    for words in slopes_of(drive):
        yield f"slope {words[0]}", (check_slope, drive, *words)


def check_drive(path: Path, printed: list) -> int:
    """All checks of one description; how many were made."""
    try:
        drive, draws = Described(json.loads(path.read_text(encoding="utf-8"))), (Draws(1), Draws(-1))
        checks = list(checks_of(drive, path.stem, printed))
        known = any(is_about(path.stem, [p for p in patterns if p != "*"]) for patterns, _ in printed)
        require(known, "nothing printed is known of this drive")
        check_said(drive, statements_of(path.stem, printed))
        for words, check in checks:
            try:
                on_both_flanks(*check, draws=draws)
            except (*UNREADABLE, StopIteration) as error:
                raise Rejected(f"{words}: {error!r}") from error
    except (Rejected, *UNREADABLE) as error:
        raise Rejected(f"{path.name}: {error}") from error
    return len(checks)


def main(arguments: list[str]) -> int:
    def said() -> str:
        printed = read_printed(Path(__file__).parent.with_name("printed.txt").read_text(encoding="utf-8"))
        paths = described(folder_of(arguments), arguments[1:])
        checks = sum(check_drive(path, printed) for path in paths)
        return f"{checks} checks of {len(paths)} descriptions hold: as printed, made, enveloping, contact, slopes"

    return ended(said)
