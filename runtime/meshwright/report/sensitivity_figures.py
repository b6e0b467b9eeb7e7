"""Figures of what each misalignment does: one panel for each."""

import textwrap

import numpy as np

from meshwright.contact.results import ARCSEC
from meshwright.report import style
from meshwright.report.branches import broken

_COLUMNS = 2

#: Steps on the abscissa of a panel at most: numbers of a shift by thousandths are long.
_TICKS = 3

#: Longest line of a panel's title, characters.
_TITLE = 28

#: Least span of a scale: arcsec, and mm.
LEAST_ERROR, LEAST_SHIFT = 1e-4, 1e-3


def error(analysis):
    """Change of the relative transmission error over the pinion angle."""
    figure, panels = _panels([effect for effect in analysis.sensitivities if effect.touches], 2.7)
    angles = np.degrees(analysis.tca.angles)
    for axes, effect in panels:
        for sign, tca, colour in _sides(effect):
            change = (tca.relative_error - analysis.tca.relative_error) / ARCSEC
            axes.plot(angles, change, color=colour, label=f"{sign}{effect.label}")
        axes.set(xlabel="pinion angle, deg", ylim=_room(axes.get_ylim(), LEAST_ERROR))
        axes.legend(ncols=2, handlelength=1.2, loc="upper center")
    panels[0][0].set_ylabel("change, arcsec")
    return figure


def path(analysis):
    """Path of contact on the wheel."""
    figure, panels = _panels([effect for effect in analysis.sensitivities if effect.at_points], 3.0)
    tca = analysis.tca
    projection = analysis.patch("wheel").projection
    horizontal, vertical = projection.labels("wheel")
    for axes, effect in panels:
        given = broken(tca.body_points["wheel"], analysis.breaks)
        axes.plot(*projection(given), color=style.INK, linewidth=1.0, label="as given")
        for (sign, moved, colour), breaks in zip(_sides(effect), effect.breaks, strict=True):
            points = broken(moved.body_points["wheel"], breaks)
            axes.plot(*projection(points), color=colour, label=f"{sign}{effect.label}")
        axes.margins(x=0.1)
        axes.locator_params(axis="x", nbins=_TICKS)
        axes.set(xlabel=horizontal, xlim=_widened(axes.get_xlim(), LEAST_SHIFT))
        axes.set_ylim(_room(axes.get_ylim(), LEAST_SHIFT))
        axes.legend(ncols=3, handlelength=1.0, columnspacing=0.8, loc="upper center", fontsize=8)
    panels[0][0].set_ylabel(vertical)
    return figure


def _widened(limits, least):
    """Limits of an axis about their middle, never so near that round-off shows."""
    middle, half = 0.5 * sum(limits), 0.5 * max(limits[1] - limits[0], least)
    return middle - half, middle + half


def _room(limits, least):
    """Like :func:`_widened`, with room above the curves for the legend."""
    low, high = _widened(limits, least)
    return low - 0.05 * (high - low), high + 0.3 * (high - low)


def _sides(effect):
    return ("−", effect.minus, style.PINION), ("+", effect.plus, style.WHEEL)


def _panels(effects, height):
    """The figure and a panel for each of the effects: (axes, effect) pairs."""
    count = len(effects)
    columns = min(count, _COLUMNS)
    rows = -(-count // columns)
    figure = style.figure(6.4, height * rows)
    panels = figure.subplots(rows, columns, squeeze=False).ravel()
    for axes in panels[count:]:
        axes.set_visible(False)
    for axes, effect in zip(panels, effects, strict=False):
        axes.set_title(textwrap.fill(effect.meaning, _TITLE))
    return figure, list(zip(panels, effects, strict=False))
