"""How figures look: one set of colours and sizes for the report and for print, and figures as inline SVG."""

import io
import re
from contextlib import contextmanager
from functools import cache

import matplotlib as mpl
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_svg import RendererSVG
from matplotlib.figure import Figure
from matplotlib.textpath import text_to_path

from meshwright.report.layout import POINTS
from meshwright.report.panel import Panel

PINION, WHEEL, INK, SOFT, WARN = "#1f6f9f", "#b8651b", "#1c2733", "#8593a1", "#c0273d"
MEMBERS = {"pinion": PINION, "wheel": WHEEL}

_SETTINGS = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "font.size": 9.0,
    "axes.titlesize": 9.5,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.labelsize": 9.0,
    "axes.edgecolor": SOFT,
    "axes.labelcolor": INK,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.unicode_minus": True,
    "grid.color": "#e3e8ed",
    "grid.linewidth": 0.8,
    "xtick.color": INK,
    "ytick.color": INK,
    "text.color": INK,
    "lines.linewidth": 1.5,
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "axes.titley": 1.0,
    "axes.formatter.limits": (-9, 9),
    "axes.formatter.useoffset": False,
    "svg.fonttype": "none",
    "svg.hashsalt": "meshwright",
}


@contextmanager
def drawing():
    """Matplotlib settings of all figures."""
    with mpl.rc_context(_SETTINGS):
        yield


def figure(width=6.4, height=3.6):
    """An empty figure, inches; one renderer measures all its texts."""
    empty = _Figure(figsize=(width, height))
    FigureCanvasAgg(empty)
    return empty


class _Figure(Figure):
    """Panels of one ground with the figure."""

    def add_subplot(self, *place, **options):
        axes = super().add_subplot(*place, axes_class=Panel, **options)
        axes.patch.set_visible(False)
        return axes


def to_svg(drawn, name, label):
    """The figure as an ``<svg>`` element to stand inside HTML: no declaration, unique ids, described by ``label``.

    ``name`` prefixes every id, so that several figures can share a page; text stays text. ``label`` is escaped by
    the caller.
    """
    stream = io.StringIO()
    drawn.dpi = POINTS
    renderer = _Renderer(*(POINTS * drawn.get_size_inches()), stream, image_dpi=POINTS)
    drawn.draw(renderer)
    renderer.finalize()
    text = stream.getvalue()
    text = text[text.index("<svg") :]
    text = re.sub(r"<metadata>.*?</metadata>\s*", "", text, flags=re.DOTALL)
    for mark in (' id="', 'href="#', "url(#"):
        text = text.replace(mark, mark + f"{name}-")
    attributes = rf'<svg role="img" data-figure="{name}" aria-label="{label}" \1'
    return re.sub(r'^<svg ([^>]*?)width="[^"]*" height="[^"]*"', attributes, text)


class _Renderer(RendererSVG):
    """Measures a text once for all figures: most numbers stand at several axes."""

    def get_text_width_height_descent(self, s, prop, ismath):
        return _measured(s, prop, ismath)


@cache
def _measured(text, font, is_math):
    return text_to_path.get_text_width_height_descent(text, font, is_math)
