"""The region of a tooth that a flank, a fillet or a root covers: a surface and the limits that bound it.

The limits are functions of the surface parameters that are negative outside: the margins of the blank and the tool, the
singular lines of the surface itself, and, where neither bounds it, how far contact uses it. The region is what lies
inside all of them and hangs together with where contact is; singular lines may cut it into pieces. It is found on a
lattice of two free parameters (a third one follows from the surface's own condition), and its border is located on the
lattice's lines to rounding, with the corners where two limits meet.
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.flank.bounds import OPEN, Limits, lengthwise_end, parameter_end
from meshwright.flank.chart import Chart
from meshwright.flank.inside import deeper, on_surface, start_inside
from meshwright.flank.lattice import flooded
from meshwright.flank.lines import SINGULAR, lines
from meshwright.flank.mesh import mesh
from meshwright.flank.rays import leave
from meshwright.flank.sections import lengthwise, lengthwise_slopes

#: The first lattice has this many cells between the ends of the rays, and reaches so many times as far.
CELLS, REACH = 24, 2.0

#: A parameter that changes by less than this part of another one, in natural sizes, does not run along a line.
UNCHANGED = 1e-3

#: Fewer cells than this across the region are too few to show its form, unless so many refinements have not helped.
FEWEST, REFINEMENTS = 8, 6


@dataclass(frozen=True)
class Region:
    """A bounded surface: the ``chart`` it is found in, its ``limits``, an inner place ``seed`` (k,), None where the
    limits leave nothing of it, and a ``box`` (2, 2), lower and upper coordinates, that holds it. ``conflict`` names the
    limits exceeded where the surface of an empty region comes nearest to keeping them all.
    """

    chart: Chart
    limits: Limits
    seed: np.ndarray | None
    box: np.ndarray
    conflict: tuple[str, ...] = ()

    @property
    def flank(self):
        return self.chart.flank

    @property
    def empty(self):
        """Whether no part of the surface lies inside all limits."""
        return self.seed is None

    @property
    def why_empty(self):
        """An empty region and what leaves nothing of it, in words."""
        return (
            f"the {self.flank.region} of the {self.flank.body['name']} is empty: no part of its surface lies within "
            + (f"these limits at once: {', '.join(self.conflict)}" if self.conflict else "the limits of the design")
        )

    @cached_property
    def profile(self):
        """Number of the parameter that runs across the tooth: the first one, if lines across the tooth change it."""
        found = self.flank(self.seed)
        slopes = lengthwise_slopes(self.flank, found)
        equations = np.concatenate([slopes[:, None], found.conditions[:, :, 1:]], axis=1)[0] * self.chart.sizes
        way = np.abs(np.linalg.svd(equations)[2][-1])
        return 0 if way[0] > UNCHANGED * way.max() else int(np.argmax(way))

    @cached_property
    def triangles(self):
        """The :class:`~meshwright.flank.mesh.Triangulation` that shows where the region is."""
        return mesh(self, (CELLS, CELLS))

    @cached_property
    def lines(self):
        """The :class:`~meshwright.flank.lines.Lines` across the region."""
        return lines(self)

    def within(self, limit):
        """What is left of the region inside another limit, a :class:`Limit`."""
        limits = self.limits.with_(limit)
        seed, values = self.seed, limits.values(self.flank(self.seed))[0]
        if values.min() < 0.0:
            lattice = self.lattice((CELLS, CELLS))
            nodes = lattice.q[lattice.inside]
            least = limits.least(self.flank(nodes))
            if not least.max(initial=-1.0) >= 0.0:
                return replace(self, limits=limits, seed=None, conflict=(limit.name,))
            seed = nodes[np.argmax(least)]
        return _boxed(self.chart, limits, deeper(self.chart, limits, seed))

    def in_sections(self, sections):
        """The same region, the tooth cut by other :class:`~meshwright.flank.sections.Sections`."""
        flank = replace(self.flank, body=self.flank.body | {"lengthwise": sections})
        return replace(self, chart=replace(self.chart, flank=flank), limits=replace(self.limits, flank=flank))

    def lattice(self, cells):
        """The :class:`Lattice` of cells × cells over the box, a cell more on every side: nodes that hang together with
        the seed through nodes that only singular lines may part.
        """
        margin = (self.box[1] - self.box[0]) / np.asarray(cells)
        lines = tuple(
            np.linspace(low - step, high + step, count + 3)
            for low, high, step, count in zip(*self.box, margin, cells, strict=True)
        )
        return flooded(self.chart, self.limits, lines, self.seed)


def region(drive, member, name, uses):
    """The :class:`Region` ``name`` (flank, fillet, …) of a member; ``uses`` says where contact uses the flanks."""
    if (member, name) not in uses.known:
        uses.known[member, name] = _found(drive, member, name, uses)
    return uses.known[member, name]


def _found(drive, member, name, uses):
    flank = drive.flank(member, name)
    places, sizes = uses.on(flank)
    limits = _limits(drive, flank, uses)
    start, conflict = start_inside(flank, limits, places, sizes)
    if start is None and name != "flank":
        start, conflict = start_inside(flank, limits, _beside(drive, flank, uses), sizes)
    if start is None:
        if not np.isfinite(flank(places).points).all(axis=1).any():
            keys = " or ".join(_open_sizes(drive.design)) or "other sizes"
            raise UsageError(f"the {name} of the {member} is not defined with what [blank] leaves open: give {keys}")
        chart = Chart.at(flank, on_surface(flank, places[:1], sizes)[0], sizes)
        return Region(chart, limits, None, np.zeros((2, 2)), conflict)
    chart = Chart.at(flank, start, sizes)
    limits = _closed(chart, limits, start, places, uses.beyond)
    return _boxed(chart, limits, deeper(chart, limits, start))


def _open_sizes(design):
    """Keys of [blank] that the design leaves open and no rule gives."""
    listed = zip(design.parameters, design.description["parameters"], strict=True)
    return [p["key"] for number, p in listed if p["table"] == "blank" and np.isnan(number) and not p["choices"]]


def _beside(drive, flank, uses):
    """Places (N, k) of another region of a member beside the border of its flank: surfaces that one tool cuts have
    parameters of one kind.
    """
    whole = region(drive, flank.body["name"], "flank", uses)
    found = whole.triangles
    places = found.parameters[np.unique(found.border)]
    return places if places.shape[1] == len(flank.parameters) else np.empty((0, len(flank.parameters)))


def _limits(drive, flank, uses):
    """A surface's own limits; along the tooth a region ends where its member's flank does, and that where its face
    ends, or beyond what contact uses of it.
    """
    limits = Limits(flank)
    if flank.region == "flank":
        places, sizes = uses.on(flank)
        found = flank(places)
        if np.isfinite(found.margins.get("face", np.full(1, np.nan))).any():
            return limits
        visited = lengthwise(flank, found)
        visited = visited[np.isfinite(visited)]
        if flank.sections:
            visited = np.concatenate([visited, flank.sections.at(uses.edges(flank.body["name"]))])
        if not len(visited):
            return limits
        beyond = uses.beyond * _lengthwise_size(flank, found, sizes)
        low, high, name = visited.min() - beyond, visited.max() + beyond, OPEN
    else:
        whole = region(drive, flank.body["name"], "flank", uses)
        if whole.empty:
            raise UsageError(f"{whole.why_empty}; change [blank] or [design]")
        along = whole.lines.along
        low, high, name = along[0], along[-1], "face"
    return limits.with_(lengthwise_end(name, flank, 1.0, low), lengthwise_end(name, flank, -1.0, high))


def _lengthwise_size(flank, found, sizes):
    """Natural size of the lengthwise coordinate: a parameter's own, or the least length of one that is a length."""
    if not flank.body["lengthwise"]:
        return float(sizes[-1])
    units = {u["name"]: u["unit"] for u in flank.drive.design.description["unknowns"]}
    lengths = [size for name, size in zip(flank.parameters, sizes, strict=True) if units.get(name) == "mm"]
    return float(min(lengths)) if lengths else float(np.linalg.norm(found.tangents[0, 0]) * sizes[0])


def _closed(chart, limits, start, places, beyond):
    """The limits, and those that close the surface in its free parameters where no size of blank or tool does: across
    the tooth, the first one, on either side by itself; along it where the lengthwise limit is such a one too.
    """
    used, along = places[np.isfinite(places).all(axis=1)], OPEN not in limits.names
    for axis, sign in ((0, -1.0), (0, 1.0), (1, -1.0), (1, 1.0)):
        number = chart.free[axis]
        if axis == 0:
            closed = _ends(chart, limits, start, sign)
        if closed if axis == 0 else along:
            continue
        end = max((sign * used[:, number]).max(), sign * start[number]) + beyond * chart.sizes[number]
        limits = limits.with_(parameter_end(number, sign, end))
    return limits


def _ends(chart, limits, start, sign):
    """Whether a size of blank or tool ends the profile on one side: a limit that is reached, or that a singular line
    only keeps from being reached.
    """
    ((_, name, last),) = leave(chart, limits, start, [(0, sign)])
    if name not in (None, OPEN, *SINGULAR):
        return True
    here, there = limits.values(chart.flank(np.stack([start, last])))
    with np.errstate(invalid="ignore"):
        nearer = np.isfinite(here) & (there < here)
    return any(near and n not in (OPEN, "face", *SINGULAR) for near, n in zip(nearer, limits.names, strict=True))


def _boxed(chart, limits, start):
    """The region with a box that just holds it, found on ever finer lattices; none if narrower than rounding."""
    here = start[list(chart.free)]
    found = leave(chart, limits, start, [(axis, sign) for sign in (-1.0, 1.0) for axis in (0, 1)])
    rays = found[:2], found[2:]
    ends = np.array([[end for end, _, _ in side] for side in rays])
    ends = np.where(np.isfinite(ends), ends, here + np.array([[-1.0], [1.0]]) * chart.sizes[list(chart.free)])
    low, high = here + REACH * (ends[0] - here), here + REACH * (ends[1] - here)
    for _ in range(REFINEMENTS):
        narrow = ~(high - low > 2 * CELLS * np.spacing(np.abs(here)))
        if narrow.any():
            names = (side[axis][1] for axis in np.flatnonzero(narrow) for side in rays)
            return Region(chart, limits, None, np.zeros((2, 2)), tuple(dict.fromkeys(filter(None, names))))
        lines = tuple(_through(*row) for row in zip(low, high, here, strict=True))
        lattice = flooded(chart, limits, lines, start)
        rows, columns = np.flatnonzero(lattice.inside.any(axis=1)), np.flatnonzero(lattice.inside.any(axis=0))
        grown, spans = False, []
        for axis, found in enumerate((rows, columns)):
            line = lines[axis]
            spans.append(len(found))
            width = line[-1] - line[0]
            if found[0] == 0:
                low[axis], grown = line[0] - 0.5 * width, True
            else:
                low[axis] = line[found[0] - 1]
            if found[-1] == len(line) - 1:
                high[axis], grown = line[-1] + 0.5 * width, True
            else:
                high[axis] = line[found[-1] + 1]
        if not grown and min(spans) >= FEWEST:
            break
    return Region(chart, limits, start, np.array([low, high]))


def _through(low, high, here):
    """An ascending line from low to high with a node at ``here``."""
    step = (high - low) / (2 * CELLS)
    return here + step * np.arange(-math.ceil((here - low) / step), math.ceil((high - here) / step) + 1)
