"""What the outlines of families name must be keys and words of their drives."""

from collections.abc import Iterable, Iterator, Sequence
from difflib import get_close_matches

import sympy as sp

from derive.language.drive import Drive
from derive.language.outline import OPTIONS, Outline
from derive.language.refusal import DescriptionError


def validate_outlines(drives: Iterable[Drive]) -> None:
    """Raise :class:`DescriptionError` for what the outlines of families, of which these are all drives, name but none
    has.
    """
    families: dict[str, list[Drive]] = {}
    for drive in drives:
        families.setdefault(drive.family, []).append(drive)
    for family, members in families.items():
        outline = next((drive.outline for drive in members if drive.outline), None)
        for message in _outline(outline(), members) if outline else ():
            raise DescriptionError(f"outline of the family {family}: {message}")


def _outline(outline: Outline, drives: Sequence[Drive]) -> Iterator[str]:
    words: dict[str, set[str]] = {}
    for key, word in ((key, word) for drive in drives for key, word in drive.variant.items()):
        words.setdefault(key, set()).update({word} if isinstance(word, str) else ())
    sizes = [p for drive in drives for p in (*drive.parameters, *(drive.drawing.sizes if drive.drawing else ()))]
    places = {f"{p.table}.{p.key}" for p in sizes} | {f"design.{key}" for key in words}
    known = {q.name for q in OPTIONS}
    if unknown := outline.options.keys() - {"m", "z", "a"}:
        yield f"the options {', '.join(sorted(unknown))} are none of m, z and a; leave them out"
    for key, word in outline.words.items():
        if word not in words.get(key, ()) and word:
            yield f"{key} = {word!r} chooses no drive; {_offer(words.get(key) or words)}"
    for named, _ in outline.apart:
        for key, meant in named.items():
            if unknown := {*meant} - words.get(key, set()):
                yield f"{key} = {', '.join(sorted(unknown))} chooses no drive; {_offer(words.get(key) or words)}"
    for s in outline.suggestions:
        what = f"the suggestion for {s.place or s.name}"
        if s.place and s.place not in places and s.place != "design.hand":
            yield f"{what}: no drive has this key; {_offer(get_close_matches(s.place, places, n=1))}"
        for key, meant in s.words.items():
            if unknown := {*meant} - words.get(key, set()):
                chosen = f"{key} = {', '.join(sorted(unknown))}"
                yield f"{what}: {chosen} chooses no drive; {_offer(words.get(key) or words)}"
        for value in (*s.values, *(s.within or ())):
            if unknown := {str(q) for q in sp.sympify(value).free_symbols} - known:
                yield f"{what} uses {', '.join(sorted(unknown))}, which no option and none before it gives"
        known.add(s.symbol.name)


def _offer(names: Iterable[str]) -> str:
    return f"use {' or '.join(listed)}" if (listed := sorted(names)) else "leave it out"
