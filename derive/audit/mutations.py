"""What the checkers of the generated C notice: one token of a generated file changed at a time, counted by function.

``python -m derive.audit.mutations DRIVE… [--each N]`` prints the table and writes it to ``measured.json`` beside this
module, from where the page of validation takes it.
"""

from __future__ import annotations

import argparse
import json
import random
import re
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

from derive.audit import check_bounded, check_code, check_description
from derive.files import replace_text

GENERATED = Path(__file__).resolve().parents[2] / "generated"
MEASURED = Path(__file__).with_name("measured.json")
SEED = 18
ENDINGS = ("", "_lanes", "_sensitivity", "_bounded")
#: What stands in a right-hand side, and what it is changed into.
CHANGES = (
    (r" \+ ", " - "),
    (r" - ", " + "),
    (r"MW_FMA\(", "MW_FNMA("),
    (r"MW_FMS\(", "MW_FMA("),
    (r"MW_FNMA\(", "MW_FMA("),
    (r"\b0\.5\b", "0.25"),
    (r"\b2\.0\b", "3.0"),
    (r"= 1\.0 /", "= 2.0 /"),
)


@dataclass(frozen=True)
class Row:
    """How many changes of one function were made and how many were refused."""

    drive: str
    function: str
    made: int
    refused: int


def measure(drives: list[str], each: int, generated: Path = GENERATED) -> list[Row]:
    """Rows of all functions of some drives, ``each`` changes a function."""
    rng = random.Random(SEED)
    rows = []
    for drive in drives:
        texts = {e: (generated / "c" / f"{drive}{e}.h").read_text(encoding="utf-8") for e in ENDINGS}
        for ending, function, start, end in _functions(drive, texts):
            mutants = list(_mutants(texts[ending], start, end))
            chosen = rng.sample(mutants, min(each, len(mutants)))
            refused = sum(_is_refused(drive, {**texts, ending: mutant}) for mutant in chosen)
            if chosen:
                rows.append(Row(drive, function, len(chosen), refused))
    return rows


def measured() -> dict:
    """The table as last measured, with its sums."""
    rows = json.loads(MEASURED.read_text(encoding="utf-8"))["rows"]
    return {"rows": rows, **{key: sum(row[key] for row in rows) for key in ("made", "refused")}}


def _functions(drive: str, texts: dict[str, str]) -> Iterator[tuple[str, str, int, int]]:
    """Ending of the file, name of the function, and where its body stands."""
    for ending, text in texts.items():
        names = rf"(?:static inline|MW_INLINE|MW_CALLED) \w+ (?:MW_LANE_NAME\()?{drive}_(\w+)\)?"
        for found in re.finditer(rf"{names}\([^)]*\)\n{{\n(.*?)\n}}", text, re.DOTALL):
            yield ending, found[1], found.start(2), found.end(2)


def _mutants(text: str, start: int, end: int) -> Iterator[str]:
    for pattern, other in CHANGES:
        for found in re.finditer(pattern, text[start:end]):
            at = start + found.start()
            line = text[text.rindex("\n", 0, at) + 1 : text.index("\n", at)]
            if " = " in line and "if (" not in line and "for (" not in line:
                yield text[:at] + other + text[start + found.end() :]


def _is_refused(drive: str, texts: dict[str, str]) -> bool:
    with tempfile.TemporaryDirectory() as folder:
        for ending, text in texts.items():
            (Path(folder) / f"{drive}{ending}.h").write_text(text, encoding="utf-8")
        description, header = GENERATED / "descriptions" / f"{drive}.json", Path(folder) / f"{drive}.h"
        try:
            check_code.check_header(header)
            check_description.check_drive(description, header)
            check_bounded.check_drive(description, header, Path(folder) / "casadi")
        except (check_code.Rejected, check_description.Rejected, check_bounded.Rejected):
            return True
    return False


def main(arguments: list[str]) -> int:
    parser = argparse.ArgumentParser(prog="python -m derive.audit.mutations", description=__doc__)
    parser.add_argument("drives", nargs="+", metavar="DRIVE")
    parser.add_argument("--each", type=int, default=4, help="changes a function")
    options = parser.parse_args(arguments)
    rows = measure(options.drives, options.each)
    for row in rows:
        print(f"{row.drive:28} {row.function:28} {row.refused:3} of {row.made:3} refused")
    print(f"{sum(row.refused for row in rows)} of {sum(row.made for row in rows)}")
    replace_text(MEASURED, json.dumps({"seed": SEED, "rows": [asdict(row) for row in rows]}, indent=1) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
