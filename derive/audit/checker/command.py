"""What the commands of this package have in common: which drives they check, and how they end."""

import sys
from collections.abc import Callable
from pathlib import Path

from .refusal import Rejected, require


def folder_of(arguments: list[str]) -> Path:
    """The folder that is named first, or the one that this package stands in."""
    return Path(arguments[0] if arguments else Path(__file__).parents[1])


def described(folder: Path, drives: list[str]) -> list[Path]:
    """Descriptions of the drives beside a folder, of all if none is named; Rejected if one is missing."""
    place = folder.parent / "descriptions"
    paths = [place / f"{name}.json" for name in drives] or sorted(place.glob("*.json"))
    missing = [path.name for path in paths if not path.is_file()]
    require(paths and not missing, f"{place}: no {', '.join(missing) or 'description'}")
    return paths


def ended(check: Callable[[], str]) -> int:
    """Print what ``check`` says and return 0, or print why it does not accept and return 1."""
    try:
        print(check())
    except Rejected as reason:
        print(f"REJECTED: {reason}", file=sys.stderr)
        return 1
    return 0
