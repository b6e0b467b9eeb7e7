"""Which drives a checkout holds and the package ships: those that a packaged design uses.

Read from the designs and from the table of families; as a program, it prints them, or those of the designs that its
arguments name. Needs the standard library alone.
"""

import json
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
DESIGNS = ROOT / "runtime" / "meshwright" / "designs"


def packaged(families, names=()):
    """Names of the drives that packaged designs use, in the order of the table (:mod:`derive.emit.families`): all
    designs, or those named.
    """
    designs = [DESIGNS / f"{name}.toml" for name in names] or DESIGNS.glob("*.toml")
    used = {_drive_of(families, path) for path in designs}
    drives = (entry["name"] for family in families["families"].values() for entry in family["drives"])
    return [name for name in drives if name in used]


def _drive_of(families, path):
    """The drive that a design uses: that of its words, those left out following the word they default to."""
    design = tomllib.loads(path.read_text(encoding="utf-8"))
    family = families["families"].get(design["drive"])
    if family is None:
        raise LookupError(f"{path}: drive = {design['drive']!r}: there is no such family")
    for entry in family["drives"]:
        variant = entry["variant"]
        given = {place: _word(design, place, entry["variant_defaults"]) for place in variant}
        if all(_agrees(allowed, given[key]) for key, allowed in variant.items()):
            return entry["name"]
    raise LookupError(f"{path}: no drive of the family {design['drive']} has the words that this design gives")


def _agrees(allowed, value):
    """Whether a word is one of those that choose a drive, or a number lies between theirs."""
    if isinstance(allowed, dict):
        return allowed["least"] <= value and (allowed["most"] is None or value <= allowed["most"])
    return value in allowed


def _word(design, place, defaults):
    """The word or number of a key by its place ("table.key", or a key of [design]); left out, that of its default."""
    table, _, key = place.rpartition(".")
    word = design.get(table or "design", {}).get(key)
    if word is None and place in defaults:
        default = defaults[place]
        return default if isinstance(default, int) else _word(design, default, {}) or default
    return word


if __name__ == "__main__":
    table = json.loads((ROOT / "generated" / "families.json").read_text(encoding="utf-8"))
    sys.stdout.write(" ".join(packaged(table, sys.argv[1:])) + "\n")
