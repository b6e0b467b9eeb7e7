"""The contact pattern on one member's flank."""

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

from meshwright.report import style
from meshwright.report.branches import broken
from meshwright.report.numbers import fixed

#: About how many lines of contact are drawn.
LINES = 24

#: An ellipse is drawn if it reaches no farther beyond flank and contact than this share of their extent: the quadratic
#: approximation says nothing of flanks that are not there.
BEYOND = 0.15


def draw(analysis, member):
    """Flank, path of contact and ellipses on ``member``, laid flat."""
    figure = style.figure(6.4, 4.2)
    axes = figure.subplots()
    colour, tca, flank = style.MEMBERS[member], analysis.tca, analysis.patch(member)
    projection = flank.projection
    _flank(axes, projection, flank, colour)
    contours, lines = ([_flat(projection, p) for p in of(analysis, member)] for of in (_contours, _lines))
    path = _flat(projection, tca.body_points[member])
    held = [path, *contours, *lines]
    if projection.end_on:
        held.append(_flat(projection, flank.points[flank.inside >= 0.0]))
    ellipses = _near(np.vstack(held), [_flat(projection, ring) for ring in _ellipses(analysis, member)])
    for drawn in (
        PolyCollection(contours, facecolors=colour, alpha=0.35, edgecolors=colour, linewidths=1.0),
        LineCollection(ellipses, colors=colour, linewidths=0.6, alpha=0.8),
        LineCollection(lines, colors=colour, linewidths=1.1),
    ):
        axes.add_collection(drawn, autolim=False)
    axes.plot(*broken(path, analysis.breaks).T, color=style.INK, linewidth=0.7 if projection.end_on else 1.3)
    if tca.solved.any():
        _name_ends(axes, path, tca.angles)
    horizontal, vertical = projection.labels(member)
    axes.set(xlabel=horizontal, ylabel=vertical)
    _limit(axes, np.vstack([*held, *ellipses]))
    if projection.end_on:
        axes.set_aspect("equal")
    return figure


def _flat(projection, points):
    """Places (N, 2) of points (N, 3)."""
    return np.column_stack(projection(points))


def _near(places, rings):
    """The rings that reach beyond the places by no more than :data:`BEYOND` of their extent."""
    low, high = np.nanmin(places, axis=0), np.nanmax(places, axis=0)
    room = BEYOND * (high - low)
    return [ring for ring in rings if (ring >= low - room).all() and (ring <= high + room).all()]


def _limit(axes, places):
    """Show these places and a little around them."""
    low, high = np.nanmin(places, axis=0), np.nanmax(places, axis=0)
    room = 0.12 * (high - low) + 1e-3 * (high - low).max()
    axes.set(xlim=(low[0] - room[0], high[0] + room[0]), ylim=(low[1] - room[1], high[1] + room[1]))


def _flank(axes, projection, flank, colour):
    """Outline of the drawn part of the flank, and where a limit of the design ends it."""
    across, up = (np.ma.masked_invalid(v) for v in projection(flank.points))
    places = np.where((flank.inside >= 0.0)[..., None], np.stack(projection(flank.points), axis=-1), np.nan)
    edges = [places[:, 0], places[:, -1], places[0], places[-1]]
    breaks = np.cumsum([len(edge) for edge in edges[:-1]])
    axes.plot(*broken(np.vstack(edges), breaks).T, color=colour, linewidth=0.6, alpha=0.6)
    if not projection.end_on:
        axes.contourf(across, up, flank.inside, levels=[0.0, np.inf], colors=[colour], alpha=0.08)
    if np.nanmin(flank.inside) < 0.0 < np.nanmax(flank.inside):
        axes.contour(across, up, flank.inside, levels=[0.0], colors=[style.WARN], linewidths=1.0, linestyles="dashed")


def _contours(analysis, member):
    """Edges of the patches of contact, body frame: (M, 3) each, mm."""
    found = [contour.body_points[member] for contour in analysis.pattern]
    return [points for points in found if np.isfinite(points).all()]


def _ellipses(analysis, member):
    """The quadratic ellipses at the same positions, body frame: (97, 3) each, mm."""
    tca = analysis.tca
    places = (int(np.argmin(np.abs(tca.angles - contour.angle))) for contour in analysis.pattern)
    return [analysis.in_body(member, k, tca.ellipse(k)) for k in places]


def _lines(analysis, member):
    """Lines of contact, body frame: (M, 3) each, mm."""
    flip = analysis.drive.design.mirror.flip
    touching = [line.body_points[member] * flip for line in analysis.lines if len(line.points)]
    return touching[:: max(1, len(touching) // LINES)]


def _name_ends(axes, path, angles):
    known = np.flatnonzero(np.isfinite(path[:, 0]))
    for k in (known[0], known[-1]):
        axes.plot(*path[k], marker="o", markersize=4.5, color=style.INK)
        axes.annotate(
            f"{fixed(np.degrees(angles[k]), 1)}°",
            path[k],
            xytext=(6, 6),
            textcoords="offset points",
            fontsize=8.5,
            bbox={"facecolor": "white", "alpha": 0.75, "edgecolor": "none", "pad": 0.8},
        )
