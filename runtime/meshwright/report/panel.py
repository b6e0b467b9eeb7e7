"""Panels of a figure, which draw all ticks of an axis at once.

Matplotlib makes five artists for every tick, and two ticks of every axis before it knows of any: of a figure with few
curves that is a third of the time.
"""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import XAxis, YAxis
from matplotlib.ticker import NullLocator

#: Ticks beyond an end of the axis by no more than this share of its length are drawn.
BEYOND = 1e-10


class _Together:
    """An axis without ticks of its own, whose label has been given its place (:mod:`~meshwright.report.layout`).

    One tick of it stands at all places: its grid line is all grid lines, its mark all marks, and its label goes from
    place to place.
    """

    majorTicks = minorTicks = []  # noqa: N815

    def draw(self, renderer):
        """Ticks, label and the factor of all numbers, as Matplotlib has them."""
        if not self.get_visible():
            return
        renderer.open_group("matplotlib.axis", gid=self.get_gid())
        boxes = self._ticks(renderer, self.major, True) + self._ticks(renderer, self.minor, False)
        self.label.draw(renderer)
        self._update_offset_text_position(boxes, [])
        self.offsetText.draw(renderer)
        renderer.close_group("matplotlib.axis")

    def _ticks(self, renderer, ticker, major):
        """Draw the major or the minor ticks inside the panel; the boxes of their labels, if the factor is to avoid
        them.
        """
        if isinstance(ticker.locator, NullLocator):
            return []
        places = self.get_ticklocs(minor=not major)
        texts = ticker.formatter.format_ticks(places)
        if major:
            self.offsetText.set_text(ticker.formatter.get_offset())
        shown = np.flatnonzero(self._inside(places))
        if not shown.size:
            return []
        tick, at = self._get_tick(major), places[shown]
        tick.gridline.set_clip_path(self.axes.patch)
        tick.gridline.set_data(*self._xy(np.repeat(at, 3), np.tile([0.0, 1.0, np.nan], at.size)))
        tick.tick1line.set_data(*self._xy(at, np.zeros(at.size)))
        tick.gridline.draw(renderer)
        tick.tick1line.draw(renderer)
        boxes = []
        for k in shown if tick.label1.get_visible() else ():
            tick.label1.set_position(self._xy(places[k], 0.0))
            tick.label1.set_text(texts[k])
            tick.label1.draw(renderer)
            if self.offsetText.get_text():
                boxes.append(tick.label1.get_window_extent(renderer))
        return boxes

    def _inside(self, places):
        """Which of the places the panel shows."""
        along = self.get_transform().transform
        low, high = np.sort(along(self.get_view_interval()))
        room = BEYOND * (high - low)
        return (along(places) >= low - room) & (along(places) <= high + room)

    def _xy(self, along, across):
        """Coordinates along and across the axis as x and y."""
        return (along, across) if self.axis_name == "x" else (across, along)


class _XAxis(_Together, XAxis):
    pass


class _YAxis(_Together, YAxis):
    pass


class Panel(Axes):
    """Axes with such ticks."""

    def _init_axis(self):
        self.xaxis, self.yaxis = _XAxis(self, clear=False), _YAxis(self, clear=False)
        for name, spine in self.spines.items():
            spine.register_axis(self.xaxis if name in ("bottom", "top") else self.yaxis)
