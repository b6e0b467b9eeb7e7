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


@cache
def parameters(family):
    """The parameters of a family's drives, each once; ``required`` where every one of its drives requires it.

    ``tools`` are the words of the tools whose own it is, empty for a key of the family itself. A drive's own list is
    that of its parameter vector: it has the keys of its tools alone.
    """
    listed, drives_of = {}, families()[family]
    for p in (p for description in drives_of for p in description["parameters"]):
        listed.setdefault((p["table"], p["key"]), []).append(p)
    return [_joint(place, found, len(found) == len(drives_of)) for place, found in listed.items()]


def _joint(place, found, everywhere):
    """One entry for what the drives of a family say of a key."""
    shared = [{k: v for k, v in p.items() if k not in ("tools", "required")} for p in found]
    if any(p != shared[0] for p in shared):
        raise ValueError(f"the drives of a family disagree about the key {'.'.join(place)}")
    tools = sorted({word for p in found for word in p["tools"]})
    return shared[0] | {"tools": tools, "required": everywhere and all(p["required"] for p in found)}


def choose(family, words):
    """The drive of a family for the design words that choose a variant (for example the flank forms)."""
    for description in families()[family]:
        if all(words[key] in allowed for key, allowed in description["variant"].items()):
            return description
    raise KeyError(words)
