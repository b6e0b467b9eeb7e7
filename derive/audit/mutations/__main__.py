"""Measure what the checkers notice, and print it."""

import argparse
import sys
from pathlib import Path

from derive.audit.mutations import __doc__ as purpose
from derive.audit.mutations.measure import logged, measure
from derive.audit.mutations.stages import EQUAL, GENERATED, REFUSED, STAGES, SURVIVED
from derive.audit.mutations.table import MEASURED, keep, table


def main(arguments: list[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m derive.audit.mutations", description=purpose)
    parser.add_argument("drives", nargs="*", metavar="DRIVE", help="default: all that are generated")
    parser.add_argument("--each", type=int, default=1, help="changes a function")
    parser.add_argument("--sample", type=int, help="of these so many a drive, at random; default: all")
    parser.add_argument("--log", type=Path, help="a line of JSON a change; what stands there is not run again")
    parser.add_argument("--stage", action="append", choices=STAGES, help="these alone")
    parser.add_argument("--write", action="store_true", help=f"replace {MEASURED.name}")
    options = parser.parse_args(arguments)
    drives = options.drives or sorted(path.stem for path in (GENERATED / "descriptions").glob("*.json"))
    outcomes = logged(options.log)
    for outcome in measure(drives, options.each, options.log, tuple(options.stage or STAGES), options.sample):
        outcomes[outcome.mutant.key] = outcome.by, outcome.reason
        if outcome.by != REFUSED:
            print(outcome.by, *outcome.mutant.key, flush=True)
    rows = table(outcomes)
    for row in rows:
        print(f"{row['stage']:12} {row['function']:32}", *(f"{row[by]:4} {by}" for by in (REFUSED, SURVIVED, EQUAL)))
    print({by: sum(row[by] for row in rows) for by in (REFUSED, SURVIVED, EQUAL)})
    if options.write:
        survivors = [list(key) for key, (by, _) in outcomes.items() if by == SURVIVED]
        keep(drives=len({key[0] for key in outcomes}), rows=rows, survivors=survivors)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
