"""The live page: one HTML file that needs nothing beside itself."""

import base64
import html
import json
from importlib import resources

from meshwright.live.data import data
from meshwright.live.module import compiled


def page(drive):
    """The page of a :class:`~meshwright.drive.Drive`, as text."""
    contents = data(drive)
    parts = {
        "TITLE": html.escape(f"{contents['name']} – {contents['title']}"),
        "STYLE": _part("live.css"),
        "DATA": json.dumps(contents, ensure_ascii=False, allow_nan=False).replace("<", "\\u003c"),
        "MODULE": base64.b64encode(compiled(contents["drive"], drive.design.description["folder"])).decode("ascii"),
        "THREE": _part("three.min.js"),
        "SCRIPT": "\n".join(map(_part, ("solver.js", "teeth.js", "plots.js", "solids.js", "live.js"))),
    }
    text = _part("live.html")
    pieces = text.split("%%")
    return "".join(parts[piece] if k % 2 else piece for k, piece in enumerate(pieces))


def _part(name):
    package = "meshwright.report" if name in ("teeth.js", "three.min.js") else "meshwright.live"
    return resources.files(package).joinpath("page", name).read_text(encoding="utf-8")
