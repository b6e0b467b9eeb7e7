"""Mutated designs: packaged ones and a corpus of texts that were once trouble, changed in values, keys, words or bytes.

A mutation is a function of ``random.Random`` and the text of a design; the same seed gives the same designs anywhere.
"""

import math
from functools import cache
from pathlib import Path

from meshwright.design import description, design, schema

CORPUS = Path(__file__).parent / "corpus"

#: Values where arithmetic, comparison or text may end.
EXTREMES = (
    0.0, -0.0, 5e-324, -5e-324, 2.2e-308, 1e-300, 1e-15, 1e15, 1e17, 1e300, 1.7976931348623157e308, math.inf, -math.inf,
    math.nan, 0, 1, -1, 2**31, 2**53 + 1, 2**63, 10**400, 90.0, 89.999999999, 180.0, 360.0, True, False, "", "0", "ZX",
    "right", "\x1b[31m", "a" * 300, [], [1.0], {}, {"x": 1.0},
)  # fmt: skip

#: Bytes that a TOML reader treats specially, and some that it should not meet.
PIECES = (
    b"", b"=", b"[", b"]", b"[[", b'"', b"'''", b"#", b"\n", b"\r", b"\r\n", b"\x00", b"\x1b[31m", b"\xff",
    b"\xef\xbb\xbf",
    b"-", b"+", b"0", b"9" * 40, b"1e400", b"1e-400", b"nan", b"-inf", b"0x", b"_", b".", b",", b"{", b"}", b"true",
    b"1979-05-27", b"\\u0000", b"\\", "π".encode(), b" = 1.0\n",
)  # fmt: skip


@cache
def seeds():
    """Texts of the packaged designs and of the corpus, each with its name."""
    packaged = [(name, (design.PACKAGED / f"{name}.toml").read_bytes()) for name in design.packaged_names()]
    return packaged + [(path.name, path.read_bytes()) for path in sorted(CORPUS.glob("*.toml"))]


@cache
def places(family):
    """(table, key) of every key of a family."""
    return sorted({(entry["table"], entry["key"]) for entry in schema.keys(family)})


@cache
def _words(family):
    """The words, by place, of the family's drives that packaged designs use: others would have to be derived first."""
    used = {design.check(design.read(name)).description["name"] for name in design.packaged_names()}
    return [variant for name, variant in description.families()[family].variants.items() if name in used]


def _number(chance, value):
    """A changed number: often near, so that much of what is made can be solved; sometimes far or none."""
    how = chance.random()
    if how < 0.15:
        return chance.choice(EXTREMES)
    if isinstance(value, int):
        near = value + chance.choice((-10, -2, -1, 1, 2, 10))
        return near if how < 0.9 else value * chance.choice((-1, 0, 10, 10**6))
    if how < 0.6:
        return value * (1.0 + chance.gauss(0.0, 0.05)) + chance.gauss(0.0, 0.02)
    if how < 0.85:
        return value * chance.choice((0.5, 0.9, 1.1, 2.0)) + chance.choice((0.0, 0.1, -0.1, 1.0))
    return value * chance.choice((-1.0, 0.0, 1e-9, 1e-3, 10.0, 1e3, 1e9))


def _one_change(chance, tables):
    """Change one key of the tables, in place."""
    family = tables.get("drive")
    known = isinstance(family, str) and family in description.families()
    inner = [(t, k) for t, entries in tables.items() if isinstance(entries, dict) for k in entries]
    how = chance.random()
    if how < 0.7 and inner:
        table, key = chance.choice(inner)
        value = tables[table][key]
        number = isinstance(value, int | float) and not isinstance(value, bool)
        tables[table][key] = _number(chance, value) if number else chance.choice(EXTREMES)
    elif how < 0.85 and known:
        table, key = chance.choice(places(family))
        value = chance.choice((chance.gauss(0.0, 0.02), chance.uniform(0.0, 100.0), chance.choice(EXTREMES)))
        entries = tables if table in ("", "flank") else tables.setdefault(table, {})
        if isinstance(entries, dict):
            entries[key] = value
    elif how < 0.9 and inner:
        table, key = chance.choice(inner)
        del tables[table][key]
    elif how < 0.95 and known and _words(family):
        for place, word in chance.choice(_words(family)).items():
            table, key = description.table_and_key(place)
            if isinstance(entries := tables.setdefault(table, {}), dict):
                entries[key] = word["least"] if isinstance(word, dict) else word[0]
    elif how < 0.98:
        key = chance.choice(("drive", "name", "flank", "design", "misalignment", "blank", "contact", "x" * 200))
        tables[key] = chance.choice((*EXTREMES, "left", *description.families()))
    else:
        tables.pop(chance.choice(list(tables) or ["drive"]), None)


def _bytes(chance, text):
    text = bytearray(text)
    for _ in range(chance.randint(1, 4)):
        at = chance.randrange(len(text) + 1)
        text[at : at + chance.choice((0, 0, 1, 1, 2, 8, 60))] = chance.choice(PIECES)
    return bytes(text)


def _key(text):
    bare = text.isascii() and text.replace("_", "").replace("-", "").isalnum()
    return text if bare else _value(text)


def _value(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return '"' + "".join(c if c.isprintable() and c not in '"\\' else f"\\u{ord(c):04x}" for c in value) + '"'
    if isinstance(value, list):
        return "[" + ", ".join(map(_value, value)) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_key(k)} = {_value(v)}" for k, v in value.items()) + "}"
    return str(value) if isinstance(value, int) else repr(value)


def toml(tables):
    """Any tables as TOML, whatever is wrong with them as a design."""
    loose = [f"{_key(k)} = {_value(v)}" for k, v in tables.items() if not isinstance(v, dict)]
    for name, entries in tables.items():
        if isinstance(entries, dict):
            loose += [f"[{_key(name)}]", *(f"{_key(k)} = {_value(v)}" for k, v in entries.items())]
    return ("\n".join(loose) + "\n").encode("utf-8", "surrogatepass")


@cache
def _tables(text):
    try:
        return design.parsed(text.decode("utf-8-sig"), "SEED")
    except ValueError:
        return None


def mutated(chance):
    """(name of the seed, bytes of a mutated design)."""
    name, text = chance.choice(seeds())
    tables = _tables(text)
    if tables is None or chance.random() < 0.15:
        return name, _bytes(chance, text)
    tables = {k: dict(v) if isinstance(v, dict) else v for k, v in tables.items()}
    for _ in range(chance.choice((1, 1, 1, 2, 2, 3, 6))):
        _one_change(chance, tables)
    return name, toml(tables) if chance.random() < 0.95 else _bytes(chance, toml(tables))
