"""Print the table of families: what is known of every drive before it is derived.

``families.json``: ``families`` holds by name, in order, a ``parameters`` list without repeats and the ``drives``: for
each what its own description says (:mod:`derive.emit.metadata`) of its name, title and variant, and its ``parameters``,
as places in that list. Checks, JSON Schema and errors offer from it what is derived and compiled on first use.
"""

import json

from derive.emit import metadata


def table(drives):
    """The table of these drives (:class:`~derive.language.drive.Drive`), as plain data."""
    families = {}
    for drive in drives:
        family = families.setdefault(drive.family, {"parameters": [], "drives": []})
        family["drives"].append(_drive(drive, family["parameters"]))
    return {"schema": "meshwright.families/1", "families": families}


def text(families):
    """The file of a table."""
    return json.dumps(families, indent=1, ensure_ascii=False) + "\n"


def _drive(drive, known):
    own = metadata.parameters(drive)
    known += [parameter for parameter in own if parameter not in known]
    return {**metadata.identity(drive), "parameters": [known.index(parameter) for parameter in own]}
