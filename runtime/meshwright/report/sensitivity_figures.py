"""Figures of what each misalignment does: one panel for each."""

import numpy as np

from meshwright.report import style
from meshwright.report.numbers import title
from meshwright.results import ARCSEC

_COLUMNS = 4

#: Least span of a scale, arcsec.
LEAST_SPAN = 1e-4


def error(analysis):
    """Change of the relative transmission error over the pinion angle."""
    figure, panels = _panels(analysis, 2.7)
    angles = np.degrees(analysis.tca.angles)
    for axes, effect in zip(panels, analysis.sensitivities, strict=False):
        for sign, tca, colour in _sides(effect):
            change = (tca.relative_error - analysis.tca.relative_error) / ARCSEC
            axes.plot(angles, change, color=colour, label=f"{sign}{effect.label}")
        axes.set(xlabel="pinion angle, deg")
        if not any(np.isfinite(tca.error).any() for _, tca, _ in _sides(effect)):
            axes.text(0.5, 0.45, "no contact found", transform=axes.transAxes, ha="center", color=style.WARN)
        _room(axes)
        axes.legend(ncols=2, handlelength=1.2, loc="upper center")
    panels[0].set_ylabel("change, arcsec")
    return figure


def path(analysis):
    """Path of contact on the wheel."""
    figure, panels = _panels(analysis, 3.0)
    tca = analysis.tca
    projection = analysis.patches["wheel"].projection
    horizontal, vertical = projection.labels("wheel")
    for axes, effect in zip(panels, analysis.sensitivities, strict=False):
        axes.plot(*projection(tca.body_points["wheel"]), color=style.INK, linewidth=1.0, label="as given")
        for sign, moved, colour in _sides(effect):
            axes.plot(*projection(moved.body_points["wheel"]), color=colour, label=f"{sign}{effect.label}")
        axes.set(xlabel=horizontal)
        axes.margins(x=0.1, y=0.3)
        axes.legend(ncols=3, handlelength=1.0, columnspacing=0.8, loc="upper center", fontsize=8)
    panels[0].set_ylabel(vertical)
    return figure


def _room(axes):
    """Room above the curves for the legend, and never so little that round-off shows."""
    low, high = axes.get_ylim()
    span = max(high - low, LEAST_SPAN)
    middle = 0.5 * (low + high)
    axes.set_ylim(middle - 0.55 * span, middle + 0.8 * span)


def _sides(effect):
    return ("−", effect.minus, style.PINION), ("+", effect.plus, style.WHEEL)


def _panels(analysis, height):
    count = len(analysis.sensitivities)
    columns = min(count, _COLUMNS)
    rows = -(-count // columns)
    figure = style.figure(12.8, height * rows)
    panels = figure.subplots(rows, columns, squeeze=False).ravel()
    for axes in panels[count:]:
        axes.set_visible(False)
    for axes, effect in zip(panels, analysis.sensitivities, strict=False):
        axes.set_title(title(effect.key))
    return figure, panels
