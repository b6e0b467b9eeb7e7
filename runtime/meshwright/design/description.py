"""The generated descriptions of the drives: what keys a family has, what each number means.

A family is known from the tables that the compiler writes and from the descriptions in folders of drives; the
description of a drive that is in none of them is made when it is first asked for
(:mod:`meshwright.base.first_use`).
"""

import json
from dataclasses import dataclass
from functools import cache, cached_property

from meshwright.base.drives import SHIPPED, folder_of, folders
from meshwright.base.errors import LibraryError
from meshwright.design.relations import Drawing


@dataclass(frozen=True, eq=False)
class Family:
    """A family of drives: its keys, those of all its drives together, and what words choose which drive.

    ``parameters`` are described as in a drive's own description, each once; ``required`` where every drive requires it,
    ``tools`` are the words of the tools whose own it is, empty for a key of the family itself. ``variants``: drive →
    key → words that mean it, or the ``least`` and ``most`` of numbers that do (None: no most). ``variant_defaults``: a
    key that may be left out → the key that it then follows, or the word or number that it then is. ``handed``: the hand
    in which its equations are written, "" where it has but one.
    ``listed``: drive → its own parameters, in the order of its parameter vector. ``exchange``: what of it a neutral
    file holds (:mod:`meshwright.rexs`), None if nothing.
    ``outline`` says how a first design is made, ``regrind`` how a resharpened tool enters one; None where the family
    does not say it. ``drawn`` is what its drawings state (:class:`~meshwright.design.relations.Drawing`).
    """

    name: str
    parameters: list
    variants: dict
    variant_defaults: dict
    handed: str
    listed: dict
    exchange: dict | None = None
    outline: dict | None = None
    regrind: dict | None = None
    drawn: dict | None = None

    @classmethod
    def of(cls, name, drives):
        """The family of these drives (parts of descriptions)."""
        named = {drive["name"]: drive for drive in reversed(drives)}  # of drives of one name the first counts
        listed, variants, defaults = {}, {}, {}
        for drive in dict.fromkeys(drive["name"] for drive in drives):
            variants[drive] = named[drive]["variant"]
            defaults |= named[drive]["variant_defaults"]
            for parameter in named[drive]["parameters"]:
                listed.setdefault((parameter["table"], parameter["key"]), []).append(parameter)
        parameters = [_joint(name, place, found, len(found) == len(named)) for place, found in listed.items()]
        own = {name: drive["parameters"] for name, drive in named.items()}
        handed = max(drive["handed"] for drive in named.values())
        exchange, outline, regrind, drawn = (
            next((drive[kind] for drive in drives if drive.get(kind)), None)
            for kind in ("exchange", "outline", "regrind", "drawing")
        )
        return cls(name, parameters, variants, defaults, handed, own, exchange, outline, regrind, drawn)

    @cached_property
    def drawing(self):
        """Sizes, relations and defaults of the family's drawings."""
        return Drawing(self.drawn, self.parameters, frozenset(".".join(table_and_key(p)) for p in self.choosing))

    @property
    def choosing(self):
        """Places of the keys that choose the drive, in order."""
        return list(dict.fromkeys(place for variant in self.variants.values() for place in variant))

    def chosen(self, words, but=""):
        """The first drive whose words or numbers these are, by place; None where there is none. The place ``but`` is
        left aside.
        """
        return next((name for name, variant in self.variants.items()
                     if all(agrees(allowed, words[key]) for key, allowed in variant.items() if key != but)), None)

    def unused(self, words):
        """Places of the keys of tools that words of a design choose, but none of these (key → word)."""
        listed = [w for variant in self.variants.values() for w in variant.values() if not isinstance(w, dict)]
        others = {word for meant in listed for word in meant} - {*words.values()}
        return {f"{p['table']}.{p['key']}" for p in self.parameters if p["tools"] and {*p["tools"]} <= others}


def _joint(family, place, found, everywhere):
    """One entry for what the drives of a family say of a key."""
    shared = [{k: v for k, v in p.items() if k not in ("tools", "required")} for p in found]
    if any(p != shared[0] for p in shared):
        raise LibraryError(
            f"the drives of the family {family} disagree about the key {'.'.join(place)}: derive them again, or give "
            "one of them another family"
        )
    tools = sorted({word for p in found for word in p["tools"]})
    return shared[0] | {"tools": tools, "required": everywhere and all(p["required"] for p in found)}


def families(places=None):
    """Every family by name, of the drives in the folders ``places``, by default all that are searched."""
    return _families(places or folders())


@cache
def _families(places):
    grouped = {}
    for place in places:
        for drive in _drives_in(place):
            grouped.setdefault(drive["family"], []).append(drive)
    return {name: Family.of(name, drives) for name, drives in grouped.items()}


def _drives_in(folder):
    """What is known of each drive of a folder: of all that the table of families names, where there is one."""
    table = folder / "families.json"
    if table.exists():
        for family in json.loads(table.read_text(encoding="utf-8"))["families"].values():
            for drive in family["drives"]:
                own = [family["parameters"][k] for k in drive["parameters"]]
                shared = {kind: family.get(kind) for kind in ("exchange", "outline", "drawing")}
                yield drive | {"parameters": own} | shared
    elif folder == SHIPPED:
        raise LibraryError(f"{table} does not exist: run `make build` in the checkout, or install the wheel")
    else:
        described = (json.loads(path.read_text(encoding="utf-8")) for path in sorted(folder.glob("*.json")))
        yield from (d for d in described if d.get("schema") == "meshwright.drive/1")


def described(name, places=None):
    """The description of a drive; ``folder`` in it is the folder that holds it and its CasADi functions."""
    return _described(name, places or folders())


@cache
def _described(name, places):
    folder = folder_of(name, places)
    return json.loads((folder / f"{name}.json").read_text(encoding="utf-8")) | {"folder": str(folder)}


def parameters(family, places=None):
    """The parameters of a family: see :class:`Family`."""
    return families(places)[family].parameters


def drives():
    """The names of all drives."""
    return [name for family in families().values() for name in family.variants]


def table_and_key(place):
    """Table and key of "table.key"; a key alone is of [design]."""
    table, _, key = place.rpartition(".")
    return table or "design", key


def agrees(allowed, value):
    """Whether a word is one of those that choose a drive, or a number lies between theirs."""
    if isinstance(allowed, dict):
        return allowed["least"] <= value and (allowed["most"] is None or value <= allowed["most"])
    return value in allowed
