"""Whole flanks at true scale: contact pattern and ease-off between the limits of the flank, equal axes in mm."""

import math
from functools import cached_property

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.patheffects import withStroke
from matplotlib.tri import Triangulation

from meshwright.flank.bounds import OPEN
from meshwright.report import style
from meshwright.report.branches import broken
from meshwright.report.numbers import fixed, number
from meshwright.report.projection import Projection

#: A flank longer than this many times its height is drawn in rows, one above the other, and in how many at most.
LONG, MOST_ROWS = 16.0, 8

#: Width and least height of a figure, inches; room around a flank, as a share of its extent.
WIDTH, LEAST_HEIGHT, ROOM = 6.4, 2.2, 0.04

#: Width of the line of contact whose pressure is highest, points.
WIDEST = 2.4

#: Where the mate never comes the distance counts as this many times the thickness of the marking compound.
UNMET = 4.0

#: Contour lines of an ease-off, at most, and the least step between them, µm.
LEVELS, LEAST_STEP = 12, 0.01


class Sheet:
    """A whole flank laid flat, mm: ``places`` (V, 2), the picture's ``labels``, and :meth:`flat` for other points."""

    def __init__(self, whole, member):
        self.whole = whole
        self.projection = Projection.of(whole.points, whole.normals)
        radius = np.hypot(whole.points[:, 0], whole.points[:, 1])
        screw = self.projection.screw
        self.scale = 1.0 if screw is None else math.radians(math.hypot(screw, 0.5 * (radius.min() + radius.max())))
        self.places = self.flat(whole.points)
        self.labels = self.projection.labels(member)
        if screw is not None:
            self.labels = f"length along the thread of the {member}, mm", self.labels[1]

    def flat(self, points):
        """Places (N, 2), mm, of points (N, 3) of the body frame."""
        across, up = self.projection(points)
        return np.column_stack([self.scale * across, up])

    def axes(self):
        """A figure and its axes, equal in mm: rows of the flank from left to right, then downwards."""
        low, high = self.places.min(axis=0), self.places.max(axis=0)
        size = high - low
        rows = min(MOST_ROWS, max(1, math.ceil(size[0] / size[1] / LONG)))
        shown = (1.0 + 2.0 * ROOM) * size / np.array([rows, 1.0])
        height = rows * (WIDTH - 0.9) * shown[1] / shown[0] + 0.55 + 0.3 * rows
        figure = style.figure(WIDTH, min(6.4, max(LEAST_HEIGHT, height)))
        panels = figure.subplots(rows, 1, squeeze=False)[:, 0]
        for k, axes in enumerate(panels):
            begin = low[0] + k * size[0] / rows - ROOM * size[0] / rows
            axes.set(xlim=(begin, begin + shown[0]), ylim=(low[1] - ROOM * size[1], high[1] + ROOM * size[1]))
            axes.set_aspect("equal")
            axes.locator_params(axis="y", nbins=max(1, min(8, round(12 * shown[1] / shown[0]))), min_n_ticks=1)
        panels[-1].set_xlabel(self.labels[0])
        figure.supylabel(self.labels[1], fontsize=9.0) if rows > 1 else panels[0].set_ylabel(self.labels[1])
        return figure, panels

    @cached_property
    def triangles(self):
        """The flank for Matplotlib's contours."""
        return Triangulation(*self.places.T, self.whole.triangles)

    def border(self, axes, colour):
        """Draw the border: solid on limits of the design, dashed where nothing ends the flank."""
        open_ = np.array([name == OPEN for name in self.whole.limits], dtype=bool)
        ends = self.places[self.whole.edges]
        for chosen, look in ((~open_, {"color": colour}), (open_, {"color": style.SOFT, "linestyle": "dashed"})):
            shown = np.reshape(_shown(axes, ends[chosen]), (-1, 2))
            edges = broken(shown, np.arange(2, len(shown), 2))
            axes.plot(*edges.T, linewidth=1.0, solid_capstyle="butt", **look)

    def path(self, axes, analysis, member):
        """Draw the path of contact and name its ends."""
        places, tca = self.flat(analysis.tca.body_points[member]), analysis.tca
        if not np.isfinite(tca.points).any():
            return
        axes.plot(*broken(places, analysis.breaks).T, color=style.INK, linewidth=1.2)
        known = np.flatnonzero(np.isfinite(places).all(axis=1))
        for k, side in ((known[0], -1), (known[-1], 1)):
            axes.plot(*places[k], marker="o", markersize=3.5, color=style.INK)
            low, high = sorted(axes.get_xlim())
            if low <= places[k, 0] <= high:
                side = -1 if places[k, 0] > 0.5 * (low + high) else 1
                axes.annotate(
                    f"{fixed(np.degrees(tca.angles[k]), 1)}°", places[k], xytext=(5 * side, 5),
                    ha="left" if side > 0 else "right", textcoords="offset points", fontsize=8.0,
                    bbox={"facecolor": "white", "alpha": 0.7, "edgecolor": "none", "pad": 0.6},
                )  # fmt: skip


def pattern(analysis, member):
    """The contact pattern on the whole flank of a member: composite pattern, single patches, path."""
    whole = analysis.whole[member]
    sheet, colour = Sheet(whole, member), style.MEMBERS[member]
    figure, panels = sheet.axes()
    flip = analysis.drive.design.mirror.flip
    lines = [sheet.flat(line.body_points[member] * flip) for line in analysis.lines if len(line.points)]
    rings = [sheet.flat(c.body_points[member]) for c in analysis.pattern if np.isfinite(c.body_points[member]).all()]
    rings = [np.vstack([ring, ring[:1]]) for ring in rings]
    lines = lines[:: max(1, len(lines) // 24)]
    for axes in panels:
        for distance, alpha in ((whole.alone, 0.22), (whole.running, 0.38)):
            _fill(axes, sheet, distance, analysis.marking, colour, alpha)
        for drawn, width in ((rings, 0.6), (lines, 0.9)):
            axes.add_collection(LineCollection(_shown(axes, drawn), colors=colour, linewidths=width), autolim=False)
        sheet.border(axes, colour)
        sheet.path(axes, analysis, member)
    return figure


def loaded_lines(analysis, member):
    """Lines of contact under load on the whole flank of a member, as wide as the pair's peak pressure is high."""
    sheet, colour = Sheet(analysis.whole[member], member), style.MEMBERS[member]
    figure, panels = sheet.axes()
    pairs = [pair for point in analysis.loaded["points"] for pair in point["pairs"] if len(pair["line_mm"][member]) > 1]
    highest = max((pair["peak_pressure_mpa"] for pair in pairs), default=1.0)
    for axes in panels:
        for pair in pairs:
            line = sheet.flat(np.array(pair["line_mm"][member]))
            axes.plot(*line.T, color=colour, linewidth=0.4 + WIDEST * pair["peak_pressure_mpa"] / highest, alpha=0.7)
        sheet.border(axes, colour)
        sheet.path(axes, analysis, member)
    return figure


def _shown(axes, lines):
    """Those of the lines (M, 2) each that reach into what the axes show."""
    low, high = axes.get_xlim()
    return [line for line in lines if line[:, 0].max() >= low and line[:, 0].min() <= high]


def _fill(axes, sheet, distance, thickness, colour, alpha):
    shown = np.where(np.isfinite(distance), np.minimum(distance, UNMET * thickness), UNMET * thickness)
    if (shown < thickness).any():
        levels = [min(-1.0, 2.0 * shown.min()), thickness]
        axes.tricontourf(sheet.triangles, shown, levels=levels, colors=[colour], alpha=alpha)


#: No line is drawn so little above the least value, in parts of their distance: it would be the edge of noise.
LEAST_ABOVE = 0.1


def ease_off(analysis, member):
    """The ease-off over the whole flank of a member: contour lines, µm."""
    whole = analysis.whole[member]
    sheet, values = Sheet(whole, member), 1000.0 * whole.ease_off
    figure, panels = sheet.axes()
    known = np.isfinite(values[whole.triangles]).all(axis=1)
    levels = _levels(values)
    triangles = sheet.triangles
    triangles.set_mask(~known)
    for axes in panels:
        if not known.any():
            axes.text(0.5, 0.5, "beyond the positions of a pair", transform=axes.transAxes, ha="center", va="center")
        elif len(levels) > 1:
            shown = np.where(np.isfinite(values), values, 0.0)
            axes.tricontourf(triangles, shown, levels=levels, cmap="viridis_r", alpha=0.55, extend="both")
            lines = levels[levels > np.nanmin(values) + LEAST_ABOVE * (levels[1] - levels[0])]
            drawn = axes.tricontour(triangles, shown, levels=lines, colors=style.INK, linewidths=0.6)
            _spread(axes.clabel(drawn, fmt=lambda v: number(v, 3), fontsize=7.5, inline=False))
        else:
            said = f"within {number(LEVELS * LEAST_STEP)} µm everywhere"
            axes.text(0.5, 0.5, said, transform=axes.transAxes, ha="center", va="center")
        sheet.border(axes, style.MEMBERS[member])
        sheet.path(axes, analysis, member)
    return figure


def _spread(labels):
    """Take away labels that lie on one before them; those that stay are written on a light edge, across their lines."""
    kept = []
    for label in labels:
        box = label.get_window_extent()
        if any(box.overlaps(other) for other in kept):
            label.remove()
        else:
            label.set_path_effects([withStroke(linewidth=2.0, foreground="white", alpha=0.7)])
            kept.append(box)


def _levels(values):
    """Round levels of contour lines through most of the values, µm; fewer than two where they are all the same."""
    known = values[np.isfinite(values)]
    if not known.size:
        return np.empty(0)
    low, high = known.min(), np.percentile(known, 97.0)
    raw = max((high - low) / LEVELS, 0.0)
    if raw < LEAST_STEP:
        return np.empty(0)
    size = 10.0 ** math.floor(math.log10(raw))
    step = next(size * m for m in (1.0, 2.0, 5.0, 10.0) if size * m >= raw)
    return step * np.arange(math.floor(low / step), math.ceil(high / step) + 1)
