"""The report of an exchange: schema ``meshwright.rexs/1``."""

import math

from meshwright.design import description as metadata
from meshwright.rexs import values

SCHEMA = "meshwright.rexs/1"


def report(mapped, unmapped, assumed):
    """The report as plain data."""
    return {"schema": SCHEMA, "mapped": mapped, "unmapped": unmapped, "assumed": assumed}


def assumed_of(family, tables, symbols, mapped, defaults):
    """What REXS does not say of the keys that were mapped and, with ``defaults``, of keys that it leaves open.

    ``symbols`` are the design's parameters, complete, by symbol.
    """
    table = family.exchange
    words = words_of(family, tables)
    held = {"flank"} | {entry["key"] for entry in mapped} | {place(t, k) for t, k in _keys(tables)}
    found = [
        {"key": a["key"], "value": _shown(family, tables, symbols, a["key"]), "reason": a["reason"]}
        for a in table["assumptions"]
        if a["key"] in held and all(words.get(key) in allowed for key, allowed in a["when"].items())
    ]
    if defaults:
        found += [{"key": key, "value": _shown(family, tables, symbols, key), "reason": reason}
                  for key, reason in table["defaults"].items() if _value(tables, key) is None or key == "flank"]
    return found  # fmt: skip


def place(table, key):
    """The name of a key in a report."""
    return f"{table}.{key}"


def full(name):
    """The name of a word's key in a report: with its table."""
    return place(*metadata.table_and_key(name))


def words_of(family, tables):
    """The words of a design by their keys: those that choose the drive, and its hand.

    What the tables leave out is the word that it defaults to.
    """
    words = {key: _value(tables, full(key)) for key in family.choosing}
    for key, source in family.variant_defaults.items():
        words[key] = words[key] or words.get(source, source)
    return words | ({"hand": _value(tables, full("hand")) or family.handed} if family.handed else {})


def _keys(tables):
    return [(table, key) for table, entries in tables.items() if isinstance(entries, dict)
            for key, value in entries.items() if value is not None]  # fmt: skip


def _value(tables, name):
    table, _, key = name.rpartition(".")
    return tables.get(table, {}).get(key) if table else tables.get(key)


def _shown(family, tables, symbols, name):
    """The value of a key in its unit: the design's, or what its rules give."""
    if (given := _value(tables, name)) is not None:
        return given
    if (word := {full(key): w for key, w in words_of(family, tables).items()}.get(name)) is not None:
        return word
    p = next(p for p in family.parameters if place(p["table"], p["key"]) == name)
    number = symbols[p["name"]]
    return None if math.isnan(number) else values.converted(number, p["factor"])


def lines(made):
    """The report as text: a line each of what was not mapped and what was assumed."""
    yield f"mapped: {len(made['mapped'])} attributes"
    for entry in made["unmapped"]:
        where = entry.get("key") or " ".join(filter(None, [entry["component"], entry.get("id"), entry["attribute"]]))
        yield f"unmapped: {where}: {entry['reason']}"
    for entry in made["assumed"]:
        yield f"assumed: {entry['key']} = {entry['value']}: {entry['reason']}"
