"""What of a description is printed as it stands, into C and other texts: its names, and what it says of them."""

import re
from collections import Counter
from collections.abc import Iterable, Iterator

from derive.language.drive import Count, Drive

#: A name in C and in a design file.
NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
#: The name of a family in a design file.
FAMILY = re.compile(r"[a-z][a-z0-9]*([-_][a-z0-9]+)*")
#: What ends a text or a comment of C before its time.
ENDS = re.compile(r'["\\\n\r]|\*/|/\*')


def misnamed(drive: Drive) -> Iterator[str]:
    """What is wrong with the names and texts of a drive."""
    if wrong := [*_no_texts(drive)]:
        yield from wrong
        return
    if not FAMILY.fullmatch(drive.family):
        yield f"the family {drive.family!r} is no name in a design file; use small letters, digits and -"
    for what, name in _names(drive):
        if not NAME.fullmatch(name):
            yield f"{what} {name!r} is no name in C; use letters, digits and _"
    for what, text in _texts(drive):
        if found := ENDS.search(text):
            yield f"{what} {text!r} has {found[0]!r}, which would end it in C; leave that out"
    yield from _again("function", (f.name for f in drive.functions), "rename one")
    yield from _again("design system", (system.name for system in drive.systems), "rename one")
    yield from _again("region", (f"{r.member}/{r.name}" for r in drive.regions), "rename one")
    for f in drive.functions:
        yield from _again(f"result of {f.name}", (r.name for r in f.results), "rename one")
        if not f.results or not all(r.values for r in f.results):
            yield f"the function {f.name} has no results, or one without values; give some, or leave it out"
        if f.name in _taken(drive):
            yield f"the function {f.name!r} has the name of one that is derived; rename it"


def _again(what: str, names: Iterable[str], remedy: str) -> Iterator[str]:
    for name, count in Counter(names).items():
        if count > 1:
            yield f"the {what} {name!r} is there {count} times; {remedy}"


def _taken(drive: Drive) -> set[str]:
    """Functions of the description's surfaces, by name."""
    surfaces = {f"flank_{body.name}" for body in drive.bodies} | {f"{r.name}_{r.member}" for r in drive.regions}
    return surfaces | {f"curvature_{name}" for name in surfaces} | {"placement"}


def _no_texts(drive: Drive) -> Iterator[str]:
    """What is no text and has to be one, or no word or count where a design chooses by it."""
    texts: list[tuple[str, object]] = [("the family", drive.family), *_names(drive), *_texts(drive)]
    for source in drive.sources:
        texts += [("the author of a source", source.author), ("the title of a source", source.title)]
    for what, text in texts:
        if not isinstance(text, str):
            yield f"{what} is {text!r}; give a text"
    chosen: dict[str, object] = {**drive.variant}
    for key, word in chosen.items():
        if not isinstance(word, str | Count):
            yield f"the variant {key!r} is {word!r}; give a word of the design file, or a Count"


def _names(drive: Drive) -> Iterator[tuple[str, str]]:
    yield from (("the key", p.key) for p in drive.parameters)
    yield from (("the table", p.table) for p in drive.parameters)
    yield from (("the size", name) for name, *_ in drive.all_sizes)
    yield from (("the region", region.name) for region in drive.regions)
    yield from (("the design system", system.name) for system in drive.systems)
    for f in drive.functions:
        yield "the function", f.name
        yield from ((f"the result of {f.name}", r.name) for r in f.results)


def _texts(drive: Drive) -> Iterator[tuple[str, str]]:
    yield "the title", drive.title
    yield from ((f"the meaning of {p.key}", p.symbol.meaning) for p in drive.parameters)
    yield from ((f"the meaning of the size {name}", meaning) for name, _, meaning in drive.all_sizes)
    yield from (("the message of a guard", guard.message) for guard in drive.guards)
    yield from ((f"the message of {system.name}", system.message) for system in drive.systems)
    for f in drive.functions:
        yield f"the meaning of {f.name}", f.meaning
        yield from ((f"the meaning of {q}, argument of {f.name},", q.meaning) for q in f.arguments)
