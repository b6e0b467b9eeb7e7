"""The generated descriptions of the drives: what keys a family has, what each number means."""

import json
from functools import cache

from meshwright.base.library import SHIPPED


@cache
def drives():
    """Every drive's description by name."""
    paths = sorted(SHIPPED.glob("*.json"))
    described = (json.loads(path.read_text(encoding="utf-8")) for path in paths)
    return {d["name"]: d for d in described if d.get("schema") == "meshwright.drive/1"}


def families():
    """The descriptions of each family's drives: family name → list."""
    grouped = {}
    for description in drives().values():
        grouped.setdefault(description["family"], []).append(description)
    return grouped


def parameters(family):
    """The parameters of a family in the order of the parameter vector: equal for all its drives."""
    return families()[family][0]["parameters"]


def table_and_key(place):
    """Table and key of "table.key"; a key alone is of [design]."""
    table, _, key = place.rpartition(".")
    return table or "design", key


def choose(family, words):
    """The drive of a family for the design words that choose a variant (for example the flank forms)."""
    for description in families()[family]:
        if all(words[key] in allowed for key, allowed in description["variant"].items()):
            return description
    raise KeyError(words)
