"""Print the table of families: what is known of every drive before it is derived.

``families.json``: ``families`` holds by name, in order, a ``parameters`` list without repeats, the ``exchange`` with
other programs (:mod:`derive.exchange.rexs`), the ``drawing`` (:mod:`derive.emit.drawing`) and the ``drives``: for each
what its own description says
(:mod:`derive.emit.metadata`) of its name, title and variant, and its ``parameters``, as places in that list. Checks,
JSON Schema and errors offer from it what is derived and compiled on first use.
``outline`` says how a first design is made (:mod:`derive.language.outline`), where the family has one.
"""

import json

import sympy as sp

from derive.emit import drawing, metadata
from derive.exchange import rexs
from derive.language.description import prefix


def table(drives):
    """The table of these drives (:class:`~derive.language.drive.Drive`), as plain data."""
    members = {}
    for drive in drives:
        members.setdefault(drive.family, []).append(drive)
    families = {}
    for name, listed in members.items():
        parameters = []
        described = [_drive(drive, parameters) for drive in listed]
        common = shared(listed)
        families[name] = {
            "parameters": parameters, "exchange": common["exchange"], "drives": described, "outline": common["outline"],
            "drawing": common["drawing"],
        }  # fmt: skip
    return {"schema": "meshwright.families/1", "families": families}


def shared(drives):
    """What the drives of a family have in common: ``exchange`` and ``outline``, None where none declares it, and their
    ``drawing`` (:mod:`derive.emit.drawing`).
    """
    outline = next((drive.outline for drive in drives if drive.outline), None)
    return {
        "exchange": rexs.table(drives), "outline": outline and _outline(outline()), "drawing": drawing.table(drives)
    }  # fmt: skip


def _outline(outline):
    suggestions = [
        {
            "place": s.place, "name": s.symbol.name, "values": [prefix(v) for v in s.values], "why": s.why,
            "decimals": s.decimals, "whole": s.whole, "words": s.words,
            "within": s.within and [prefix(sp.sympify(bound)) for bound in s.within],
        }
        for s in outline.suggestions
    ]  # fmt: skip
    apart = [{"words": words, "why": why} for words, why in outline.apart]
    return {"options": outline.options, "words": outline.words, "suggestions": suggestions, "apart": apart}


def agrees(families, described, shared):
    """Whether a table says of a drive what its own description (:mod:`derive.emit.metadata`) and what it shares with
    its family say.
    """
    family = families["families"].get(described["family"], {"drives": [], "outline": None})
    known = [entry for entry in family["drives"] if entry["name"] == described["name"]]
    said = [{**entry, "parameters": [family["parameters"][k] for k in entry["parameters"]]} for entry in known]
    return said == [{key: described[key] for key in entry} for entry in known] != [] and (
        shared["outline"] in (None, family["outline"]) and shared["drawing"] == family.get("drawing")
    )


def text(families):
    """The file of a table; an exchange and a drawing, whose expressions are nested, take a line each."""
    nested = "exchange", "drawing"
    compact = {(name, kind): json.dumps(f[kind], ensure_ascii=False)
               for name, f in families["families"].items() for kind in nested}  # fmt: skip
    marked = {
        name: f | {kind: f"@{name} {kind}" for kind in nested} for name, f in families["families"].items()
    }
    written = json.dumps(families | {"families": marked}, indent=1, ensure_ascii=False) + "\n"
    for (name, kind), line in compact.items():
        written = written.replace(f'"{kind}": "@{name} {kind}"', f'"{kind}": {line}')
    return written


def _drive(drive, known):
    own = metadata.parameters(drive)
    known += [parameter for parameter in own if parameter not in known]
    return {**metadata.identity(drive), "parameters": [known.index(parameter) for parameter in own]}
