"""The report as one HTML page that needs nothing else: no network, no other file."""

import html
import json
import re
from dataclasses import dataclass
from importlib import resources

import jinja2
from markupsafe import Markup, escape

from meshwright.base.worker import in_worker
from meshwright.report import style, validity
from meshwright.report.figures import pictures
from meshwright.report.findings import findings, tiles
from meshwright.report.numbers import number
from meshwright.report.scene import scene
from meshwright.report.tables import groups

#: So many pictures are drawn with the 3-D view, the others meanwhile.
BESIDE = 4


@dataclass(frozen=True)
class _Drawn:
    title: str
    caption: str
    svg: Markup


def page(analysis):
    """The page as text. Every text of the design is escaped."""
    shown = pictures(analysis)
    with style.drawing(), in_worker(lambda: [_drawn(picture, analysis) for picture in shown[BESIDE:]]) as others:
        tables, view = groups(analysis), scene(analysis)
        drawn = [_drawn(picture, analysis) for picture in shown[:BESIDE]]
        return _filled(analysis, tables, view, drawn + others())


def _filled(analysis, tables, view, drawn):
    """The page with its tables, the data of its 3-D view, if there is one, and its drawn pictures."""
    design = analysis.drive.design
    sections = [("summary", "Summary"), *([("teeth", "Teeth")] if view else []), ("figures", "Figures")]
    sections += [(group.id, group.title) for group in tables] + [("validity", "Limits of validity")]
    return _environment().get_template("report.html.jinja").render(
        name=design.tables["name"] or design.description["title"],
        title=design.description["title"],
        flank=design.tables["flank"],
        hand=design.tables["design"].get("hand"),
        version=design.description["generator"],
        drive=design.description["name"],
        hash=design.description["specification_hash"][:16],
        css=Markup(_file("report.css")),
        three=Markup(_file("three.min.js")),
        script=Markup(_file("teeth.js") + _file("view.js")),
        sections=sections,
        tiles=tiles(analysis),
        findings=findings(analysis),
        lines=bool(analysis.lines),
        apart=design.description["flanks_apart"],
        scene=_json(view) if view else None,
        positions=len(analysis.tca.angles),
        colours=style.MEMBERS,
        separation=number(design.value("separation_mm", "contact")),
        pictures=drawn,
        tables=tables,
        validity=validity.VALIDITY,
    )


def _environment():
    loader = jinja2.FunctionLoader(_file)
    strict = {"autoescape": True, "undefined": jinja2.StrictUndefined}
    environment = jinja2.Environment(loader=loader, trim_blocks=True, lstrip_blocks=True, **strict)
    environment.filters["breakable"] = _breakable
    return environment


def _breakable(cell):
    """The text of a cell, whose long words may break after an underscore or a solidus, and nowhere else."""
    return Markup(re.sub(r"(?<=[a-z])([_/])(?=[a-z])", r"\1<wbr>", str(escape(cell))))


def _file(name):
    return (resources.files("meshwright.report") / "page" / name).read_text(encoding="utf-8")


def _json(data):
    """JSON that may stand inside a script element: nothing in it can end the element."""
    text = json.dumps(data, separators=(",", ":"), allow_nan=False)
    return Markup(text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026"))


def _drawn(picture, analysis):
    svg = style.to_svg(picture.figure(analysis), picture.name, html.escape(picture.title))
    return _Drawn(picture.title, picture.caption, Markup(svg))
