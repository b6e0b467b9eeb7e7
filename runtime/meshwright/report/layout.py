"""Room for the labels of a figure's panels, told from their texts.

Matplotlib's own layout engines draw every figure three times to learn how large its texts are. These figures have few
kinds of text in one font, whose sizes are known beforehand: that is a third of the time of a report.
"""

import matplotlib as mpl
import numpy as np
from matplotlib.text import Annotation
from matplotlib.transforms import ScaledTranslation

#: Advance widths of DejaVu Sans, em: of the characters of numbers, and of any other one.
WIDTHS, WIDTH = dict.fromkeys("0123456789", 0.64) | {".": 0.32, "\N{MINUS SIGN}": 0.84, "-": 0.37, "+": 0.84}, 0.65

#: Height of a line, em; distance of a label from what it stands beside, and of anything from the figure's edge, points.
LINE, PAD, EDGE = 1.25, 4.0, 3.0

#: A legend anchored at least so high on its panel stands above it.
ON_TOP = 0.9

POINTS = 72.0


def arrange(figure):
    """Set the panels of one grid so that tick labels, axis labels, titles and legends have room in the figure."""
    grid = figure.axes[0].get_subplotspec().get_gridspec()
    shown = [axes for axes in figure.axes if axes.get_visible()]
    for axes in shown:
        axes.apply_aspect()
    for _ in range(2):  # ticks follow the size of the panel
        _place(figure, grid, shown)
    for axes in shown:
        _label(axes.yaxis, (0.0, 0.5), (-_ticks(axes.yaxis) - PAD, 0.0))
        _label(axes.xaxis, (0.5, 0.0), (0.0, -_ticks(axes.xaxis) - PAD))


def _place(figure, grid, shown):
    rows, columns = grid.get_geometry()
    left, right, below, above = (np.full(n, EDGE) for n in (columns, columns, rows, rows))
    places = [_row_and_column(axes) for axes in shown]
    for axes, (row, column) in zip(shown, places, strict=True):
        left[column] = max(left[column], EDGE + _ticks(axes.yaxis) + _height(axes.yaxis.label))
        below[row] = max(below[row], EDGE + _ticks(axes.xaxis) + _height(axes.xaxis.label))
        above[row] = max(above[row], EDGE + _above(axes))
        right[column] = max(right[column], EDGE + 0.5 * _widest(axes.xaxis))
    if figure._supylabel:
        left[0] += _height(figure._supylabel)
    width, height = POINTS * figure.get_size_inches()
    wide = _shared(width - left.sum() - right.sum(), grid.get_width_ratios())
    high = _shared(height - below.sum() - above.sum(), grid.get_height_ratios())
    for axes, (row, column) in zip(shown, places, strict=True):
        x = left[: column + 1].sum() + wide[:column].sum() + right[:column].sum()
        y = height - above[: row + 1].sum() - high[: row + 1].sum() - below[:row].sum()
        axes.set_position([x / width, y / height, wide[column] / width, high[row] / height])
        axes.apply_aspect()


def _row_and_column(axes):
    place = axes.get_subplotspec()
    return place.rowspan.start, place.colspan.start


def _shared(length, ratios):
    """The length in parts of these ratios: (N,)."""
    ratios = np.asarray(ratios, dtype=float)
    return max(length, 1.0) * ratios / ratios.sum()


def _height(label):
    """Height of a label's lines with its distance, points; 0 if it is empty."""
    text = label.get_text()
    return PAD + LINE * label.get_fontsize() * (1 + text.count("\n")) if text and label.get_visible() else 0.0


def _above(axes):
    """What stands above a panel, points: its title, a legend, notes at points, half of a number at its very top."""
    notes = any(isinstance(text, Annotation) for text in axes.texts)
    line = LINE * axes.yaxis.label.get_fontsize() * (1.0 if notes else 0.5)
    return max(_height(axes.title), _height(axes._left_title), _legend(axes), line)


def _legend(axes):
    """Height of a panel's legend of one line, points, if it stands on the panel; 0 elsewhere."""
    legend = axes.get_legend()
    if legend is None or axes.transAxes.inverted().transform(legend.get_bbox_to_anchor().min)[1] < ON_TOP:
        return 0.0
    return legend.prop.get_size_in_points() * (LINE + 2.0 * (legend.borderpad + legend.borderaxespad))


def _ticks(axis):
    """How far the marks and labels of an axis reach away from its panel, points."""
    kind, size = axis.axis_name + "tick.major.", axis.label.get_fontsize()
    mark = mpl.rcParams[kind + "size"]
    if not _labelled(axis):
        return mark
    return mark + mpl.rcParams[kind + "pad"] + (_widest(axis) if axis.axis_name == "y" else size * LINE)


def _labelled(axis):
    """Whether the ticks of an axis have labels: those that share another's have none."""
    return axis.get_tick_params()["labelleft" if axis.axis_name == "y" else "labelbottom"]


def _widest(axis):
    """Width of the widest label of an axis, points; 0 if none are shown."""
    if not _labelled(axis):
        return 0.0
    low, high = sorted(axis.get_view_interval())
    ticks = [tick for tick in axis.get_majorticklocs() if low <= tick <= high]
    texts = axis.get_major_formatter().format_ticks(ticks)
    return max((_width(text) for text in texts), default=0.0) * axis.label.get_fontsize()


def _width(text):
    """Width of a text, em."""
    return sum(WIDTHS.get(letter, WIDTH) for letter in text)


def _label(axis, place, away):
    """Put the label of an axis at a place of its panel and points away from there."""
    figure = axis.get_figure()
    off = ScaledTranslation(away[0] / POINTS, away[1] / POINTS, figure.dpi_scale_trans)
    axis.set_label_coords(*place, transform=axis.axes.transAxes + off)
