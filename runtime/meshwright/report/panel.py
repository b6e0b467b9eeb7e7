"""Panels of a figure, which draw their ticks as one tick that goes from place to place.

Matplotlib makes five artists for every tick, and two ticks of every axis before it knows of any: of a figure with few
curves that is a third of the time.
"""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import XAxis, YAxis
from matplotlib.ticker import NullLocator

#: Ticks beyond an end of the axis by no more than this share of its length are drawn.
BEYOND = 1e-10


class _Travelling:
    """An axis without ticks of its own, whose label has been given its place (:mod:`~meshwright.report.layout`)."""

    majorTicks = minorTicks = []  # noqa: N815

    def draw(self, renderer):
        """Ticks, label and the factor of all numbers, as Matplotlib has them."""
        if not self.get_visible():
            return
        renderer.open_group("matplotlib.axis", gid=self.get_gid())
        boxes = []
        for tick in self._travelling():
            tick.draw(renderer)
            if self.offsetText.get_text():
                boxes.append(tick.label1.get_window_extent(renderer))
        self.label.draw(renderer)
        self._update_offset_text_position(boxes, [])
        self.offsetText.draw(renderer)
        renderer.close_group("matplotlib.axis")

    def _travelling(self):
        """The major tick at each of its places inside the panel, then the minor one."""
        low, high = np.sort(self.get_transform().transform(self.get_view_interval()))
        room = BEYOND * (high - low)
        for ticker, major in ((self.major, True), (self.minor, False)):
            if isinstance(ticker.locator, NullLocator):
                continue
            places = self.get_ticklocs(minor=not major)
            texts = ticker.formatter.format_ticks(places)
            if major:
                self.offsetText.set_text(ticker.formatter.get_offset())
            along = self.get_transform().transform(places)
            shown = np.flatnonzero((along >= low - room) & (along <= high + room))
            if shown.size:
                tick = self._get_tick(major)
                tick.set_clip_path(self.axes.patch)
            for k in shown:
                tick.update_position(places[k])
                tick.label1.set_text(texts[k])
                yield tick


class _XAxis(_Travelling, XAxis):
    pass


class _YAxis(_Travelling, YAxis):
    pass


class Panel(Axes):
    """Axes with such ticks."""

    def _init_axis(self):
        self.xaxis, self.yaxis = _XAxis(self, clear=False), _YAxis(self, clear=False)
        for name, spine in self.spines.items():
            spine.register_axis(self.xaxis if name in ("bottom", "top") else self.yaxis)
