"""The region of a tooth that a flank, a fillet or a root covers: a surface and the limits that bound it.

The limits are functions of the surface parameters that are negative outside: the margins of the blank and the tool, the
singular lines of the surface itself, and, where neither bounds it, how far contact uses it. The region is what lies
inside all of them and hangs together with where contact is; singular lines may cut it into pieces. It is found on a
lattice of two free parameters (a third one follows from the surface's own condition), and its border is located on the
lattice's lines to rounding, with the corners where two limits meet.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.library import pointer
from meshwright.base.roots import narrowed
from meshwright.flank.lines import SINGULAR, lines
from meshwright.flank.mesh import mesh
from meshwright.flank.sections import lengthwise, lengthwise_slopes, solved
from meshwright.flank.surface import Flank, FlankPoints

#: Name of the limit where nothing in the design bounds the surface, and how far beyond what contact uses it then goes
#: unless more is asked for, in natural sizes of the parameters.
OPEN = "open"
BEYOND = 0.5

#: A ray from inside the region to its end: first step in natural sizes, growth of the steps, how many at most.
FIRST_STEP, GROWTH, MAX_STEPS = 1.0 / 64.0, 1.3, 48

#: The first lattice has this many cells between the ends of the rays, and reaches so many times as far.
CELLS, REACH = 24, 2.0

#: A parameter that changes by less than this part of another one, in natural sizes, does not run along a line.
UNCHANGED = 1e-3

#: Fewer cells than this across the region are too few to show its form.
FEWEST = 8
REFINEMENTS = 6

#: A place outside a limit is moved back this much further than to first order.
OVERSHOOT = 1.05

#: What holds the end of a ray is divided into so many parts, and the end located to so many units in the last place.
PARTS, LAST_PLACES = 32, 4.0

#: Newton's method: so many steps at most; one of no more than this, in natural sizes, is rounding.
NEWTON_STEPS, STILL = 40, 1e-14


@dataclass(frozen=True)
class Uses:
    """Where contact uses the flanks: parameters (P, k) of each by member, and the natural sizes of its parameters by
    member (k,). ``edges`` gives further points (E, 3) of a member's flank in use, body frame. Where nothing ends a
    surface it goes ``beyond`` what is used by so many natural sizes. Right-hand drive. ``known`` are the regions
    found so far, by member and name.
    """

    places: dict[str, np.ndarray]
    sizes: dict[str, np.ndarray]
    edges: Callable[[str], np.ndarray]
    beyond: float
    known: dict = field(default_factory=dict, compare=False, repr=False)

    @classmethod
    def of(cls, drive, unknowns, edges=lambda member: np.empty((0, 3)), beyond=BEYOND):
        """From solutions (P, nx) of the drive's contact."""
        scale = np.empty(drive.model.nx)
        drive.model.scale(pointer(drive.state()), pointer(scale))
        bodies = drive.design.description["bodies"]
        return cls(
            {b["name"]: unknowns[:, b["unknowns"]] for b in bodies},
            {b["name"]: scale[b["unknowns"]] for b in bodies},
            edges,
            beyond,
        )

    def on(self, flank):
        """Places (P, k) and sizes (k,) in the parameters of a flank, or of another region of its member.

        Parameters that the flank lacks, such as a fillet's own, are 0 there and of size 1.
        """
        member = flank.body["name"]
        if member not in self.places:
            count = len(next(iter(self.places.values())))
            return np.zeros((count, len(flank.parameters))), np.ones(len(flank.parameters))
        names = list(Flank.of(flank.drive, member).parameters)
        places, sizes = self.places[member], self.sizes[member]
        column = [names.index(p) if p in names else None for p in flank.parameters]
        return (
            np.stack([np.zeros(len(places)) if c is None else places[:, c] for c in column], axis=1),
            np.array([1.0 if c is None else sizes[c] for c in column]),
        )


@dataclass(frozen=True)
class Chart:
    """Two of a surface's parameters as coordinates: ``free`` their numbers; the others follow from the surface's
    conditions, from values near ``start`` (k,). ``sizes`` (k,) are natural sizes.
    """

    flank: Flank
    free: tuple[int, int]
    sizes: np.ndarray

    @classmethod
    def at(cls, flank, start, sizes):
        """The chart that leaves out the parameter which the condition at ``start`` (k,) determines best."""
        k, slopes = len(start), flank(start).conditions[0, :, 1:]
        bound = set()
        for row in np.abs(slopes * sizes):
            bound.add(int(max((i for i in range(k) if i not in bound), key=lambda i: row[i])))
        free = tuple(i for i in range(k) if i not in bound)
        if len(free) != 2:
            raise UsageError(f"the {flank.region} of the {flank.body['name']} is no surface of two free parameters")
        return cls(flank, free, sizes)

    def complete(self, coordinates, start):
        """Parameters (N, k) at coordinates (N, 2), from nearby ones (N, k); NaN where there are none."""
        q = start.copy()
        q[:, self.free] = coordinates
        k = q.shape[1]
        if k == 2:
            return q
        factors = np.zeros((2, k + 4))
        factors[[0, 1], self.free] = 1.0
        return self.flank.places(factors, self.sizes, coordinates, q)

    def by_coordinates(self, found, slopes):
        """Slopes (N, L, 2) by the coordinates, conditions kept, of what has the slopes (N, L, k) by the parameters."""
        free, bound = list(self.free), [i for i in range(slopes.shape[2]) if i not in self.free]
        if not bound:
            return slopes[:, :, free]
        conditions = found.conditions[:, :, 1:]
        with np.errstate(divide="ignore", invalid="ignore"):
            follow = np.stack([solved(conditions[:, :, bound], conditions[:, :, i]) for i in free], axis=2)
        return slopes[:, :, free] - slopes[:, :, bound] @ follow


@dataclass(frozen=True)
class Limit:
    """A limit by its name: functions of flank points to its ``values`` (N,), negative outside, and to their ``slopes``
    (N, k) by the parameters.
    """

    name: str
    values: Callable[[FlankPoints], np.ndarray]
    slopes: Callable[[FlankPoints], np.ndarray]


@dataclass(frozen=True)
class Limits:
    """Everything that bounds a surface: its own limits, and ``added`` ones."""

    flank: Flank
    added: tuple[Limit, ...] = ()

    @cached_property
    def names(self):
        """The limits' names, in the order of the columns of :meth:`values`."""
        return ("undercut", *(m["event"] for m in self.flank.body["margins"]), *(limit.name for limit in self.added))

    def values(self, found):
        """The limit functions (N, L) of flank points: +inf where a limit is left open, -inf where there is no point."""
        columns = [found.regular, *found.margins.values(), *(limit.values(found) for limit in self.added)]
        values = np.stack(columns, axis=1)
        values[np.isnan(values)] = np.inf
        values[~(np.isfinite(found.points).all(axis=1) & np.isfinite(found.normals).all(axis=1))] = -np.inf
        return values

    def slopes(self, found):
        """Slopes of the limit functions by the parameters (N, L, k) at flank points; not a number where one is open."""
        added = [limit.slopes(found)[:, None] for limit in self.added]
        return np.concatenate([self.flank.limit_slopes(found.parameters), *added], axis=1)

    def least(self, found):
        """The smallest limit function (N,)."""
        return self.values(found).min(axis=1)

    def with_(self, *more):
        """These and other ones."""
        return replace(self, added=(*self.added, *more))


@dataclass(frozen=True)
class Lattice:
    """Nodes over a chart: ``lines``, two ascending arrays; ``q`` (n, m, k) parameters, ``inside`` (n, m)."""

    lines: tuple[np.ndarray, np.ndarray]
    q: np.ndarray
    inside: np.ndarray

    @property
    def shape(self):
        return self.inside.shape


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
        return _boxed(self.chart, limits, _deeper(self.chart, limits, seed))

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


def _open_sizes(design):
    """Keys of [blank] that the design leaves open and no rule gives."""
    listed = zip(design.parameters, design.description["parameters"], strict=True)
    return [p["key"] for number, p in listed if p["table"] == "blank" and np.isnan(number) and not p["choices"]]


def region(drive, member, name, uses):
    """The :class:`Region` ``name`` (flank, fillet, …) of a member; ``uses`` says where contact uses the flanks."""
    if (member, name) not in uses.known:
        uses.known[member, name] = _found(drive, member, name, uses)
    return uses.known[member, name]


def _found(drive, member, name, uses):
    flank = drive.flank(member, name)
    places, sizes = uses.on(flank)
    limits = _limits(drive, flank, uses)
    start, conflict = _start(flank, limits, places, sizes)
    if start is None and name != "flank":
        start, conflict = _start(flank, limits, _beside(drive, flank, uses), sizes)
    if start is None:
        if not np.isfinite(flank(places).points).all(axis=1).any():
            keys = " or ".join(_open_sizes(drive.design)) or "other sizes"
            raise UsageError(f"the {name} of the {member} is not defined with what [blank] leaves open: give {keys}")
        chart = Chart.at(flank, _on_surface(flank, places[:1], sizes)[0], sizes)
        return Region(chart, limits, None, np.zeros((2, 2)), conflict)
    chart = Chart.at(flank, start, sizes)
    limits = _closed(chart, limits, start, places, uses.beyond)
    return _boxed(chart, limits, _deeper(chart, limits, start))


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
    return limits.with_(_lengthwise_end(name, flank, 1.0, low), _lengthwise_end(name, flank, -1.0, high))


def _lengthwise_end(name, flank, sign, end):
    """The :class:`Limit` of how far points are from an end of the tooth."""
    return Limit(
        name,
        lambda found: sign * (lengthwise(flank, found) - end),
        lambda found: sign * lengthwise_slopes(flank, found),
    )


def _lengthwise_size(flank, found, sizes):
    """Natural size of the lengthwise coordinate: a parameter's own, or the least length of one that is a length."""
    if not flank.body["lengthwise"]:
        return float(sizes[-1])
    units = {u["name"]: u["unit"] for u in flank.drive.design.description["unknowns"]}
    lengths = [size for name, size in zip(flank.parameters, sizes, strict=True) if units.get(name) == "mm"]
    return float(min(lengths)) if lengths else float(np.linalg.norm(found.tangents[0, 0]) * sizes[0])


def _on_surface(flank, places, sizes):
    """The places (N, k) moved to where the surface's own conditions hold, by the shortest way in natural sizes."""
    q = places.copy()
    if not flank.body["conditions"]:
        return q
    for _ in range(NEWTON_STEPS):
        conditions = flank(q).conditions
        step = np.linalg.pinv(np.nan_to_num(conditions[:, :, 1:] * sizes)) @ conditions[:, :, :1]
        q = q - step[:, :, 0] * sizes
        if not (np.abs(step) > STILL).any():
            break
    return q


def _start(flank, limits, places, sizes):
    """A place (k,) inside every limit, from the places that contact uses, and (); where no such place is found None
    and the names of the limits exceeded at the place that exceeds them least.
    """
    q = _on_surface(flank, places[np.isfinite(places).all(axis=1)], sizes)
    nearest, conflict = -np.inf, ()
    for _ in range(NEWTON_STEPS):
        if not len(q):
            break
        values = limits.values(flank(q))
        least = values.min(axis=1)
        best = int(np.argmax(least))
        if least[best] >= 0.0:
            return q[best], ()
        if least[best] > nearest:
            exceeded = [name for name, value in zip(limits.names, values[best], strict=True) if value < 0.0]
            nearest, conflict = least[best], tuple(dict.fromkeys(exceeded))
        q = q[np.isfinite(least)]
        if len(q):
            q = _inwards(flank, limits, q, sizes)
    return None, conflict


def _inwards(flank, limits, q, sizes):
    """Places (N, k) moved along the surface against the limits that they exceed, a little further than first order."""
    found = flank(q)
    values, slopes = limits.values(found), limits.slopes(found) * sizes
    short = np.where(values < 0.0, values, 0.0) * OVERSHOOT
    short[~np.isfinite(short)] = 0.0
    slopes = np.nan_to_num(np.where(short[:, :, None] < 0.0, slopes, 0.0), posinf=0.0, neginf=0.0)
    step = (np.linalg.pinv(slopes, rcond=1e-6) @ -short[:, :, None])[:, :, 0]
    step *= np.minimum(1.0, 0.5 / np.maximum(np.abs(step).max(axis=1, keepdims=True), 1e-300))
    return _on_surface(flank, q + step * sizes, sizes)


def _deeper(chart, limits, start):
    """A place about as far from the limits on either side of it, by halving chords through ``start`` (k,)."""
    q = start
    for axis in (0, 1, 0, 1):
        ends = [end for end, _, _ in _rays(chart, limits, q, [(axis, -1.0), (axis, 1.0)])]
        if not all(math.isfinite(e) for e in ends):
            continue
        at = q[list(chart.free)].copy()
        at[axis] = 0.5 * (ends[0] + ends[1])
        moved = chart.complete(at[None], q[None])[0]
        if limits.least(chart.flank(moved))[0] > 0.0:
            q = moved
    return q


def _rays(chart, limits, start, ways):
    """Where a chart's lines through an inner place leave the region, one for each of the ``ways``, an axis and a sign:
    coordinate (infinite if it does not), the limit that ends it, and the last place (k,) inside.
    """
    rays = _Rays.of(chart, limits, start, ways)
    ended = np.flatnonzero(np.isfinite(rays.outer))
    ends, sizes = rays.divided(ended), np.maximum(*np.abs([rays.inner[ended], rays.outer[ended]]))
    exact = LAST_PLACES * np.spacing(sizes)
    rays.inner[ended], rays.outer[ended] = narrowed(
        lambda at, which: rays.least(at, ended[which]), rays.inner[ended], rays.outer[ended], ends, exact
    )
    rays.divided(ended)
    names = [limits.names[k] if np.isfinite(end) else None for end, k in zip(rays.outer, rays.limit, strict=True)]
    reached = np.where(np.isfinite(rays.outer), rays.inner, rays.outer)
    return list(zip(reached.tolist(), names, rays.q, strict=True))


@dataclass(frozen=True)
class _Rays:
    """Lines of a chart through the coordinates ``here`` (2,), R of them, along ``axes`` (R,). Each leaves the region
    between its coordinates ``inner`` and ``outer`` (R,), the latter infinite if it does not, by a limit's number
    ``limit`` (R,); ``q`` (R, k) are the last places inside.
    """

    chart: Chart
    limits: Limits
    here: np.ndarray
    axes: np.ndarray
    inner: np.ndarray
    outer: np.ndarray
    limit: np.ndarray
    q: np.ndarray

    @classmethod
    def of(cls, chart, limits, start, ways):
        """Followed from an inner place, in ever longer steps, until they have left the region."""
        here, axes = start[list(chart.free)], np.array([axis for axis, _ in ways])
        steps = np.array([sign for _, sign in ways]) * FIRST_STEP * chart.sizes[list(chart.free)][axes]
        limit, q = np.zeros(len(ways), dtype=int), np.tile(start, (len(ways), 1))
        rays = cls(chart, limits, here, axes, here[axes], np.copysign(np.inf, steps), limit, q)
        going = np.arange(len(ways))
        for _ in range(MAX_STEPS):
            further = rays.inner[going] + steps[going]
            inside = rays.least(further, going) >= 0.0
            rays.outer[going[~inside]] = further[~inside]
            going = going[inside]
            if not going.size:
                break
            rays.inner[going], steps[going] = further[inside], GROWTH * steps[going]
        return rays

    def least(self, at, which):
        """The least limit (M,) at coordinates (M,) of the rays ``which`` (M,), which keep what they meet."""
        trials, values = self._at(at, which)
        least = values.min(axis=1)
        inside = least >= 0.0
        self.q[which[inside]], self.limit[which[~inside]] = trials[inside], np.argmin(values[~inside], axis=1)
        return least

    def divided(self, which):
        """Narrow some rays to the first of the places between at which they are outside; the least limit inside, and
        that outside.
        """
        at = self.inner[which, None] + np.arange(PARTS + 1) / PARTS * (self.outer - self.inner)[which, None]
        trials, values = self._at(at[:, 1:].ravel(), np.repeat(which, PARTS))
        trials, values = (found.reshape(len(which), PARTS, found.shape[1]) for found in (trials, values))
        outside = ~(values.min(axis=2) >= 0.0)
        outside[:, -1] = True  # the outer end, whose coordinate rounding may have moved
        rows, first = np.arange(len(which)), np.argmax(outside, axis=1)
        self.limit[which] = np.argmin(values[rows, first], axis=1)
        self.q[which] = np.where(first[:, None] > 0, trials[rows, first - 1], self.q[which])
        self.inner[which], self.outer[which] = at[rows, first], at[rows, first + 1]
        return self.limits.least(self.chart.flank(self.q[which])), values[rows, first].min(axis=1)

    def _at(self, at, which):
        places = np.tile(self.here, (len(at), 1))
        places[np.arange(len(at)), self.axes[which]] = at
        trials = self.chart.complete(places, self.q[which])
        return trials, self.limits.values(self.chart.flank(trials))


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
        limits = limits.with_(_parameter_end(number, sign, end))
    return limits


def _parameter_end(number, sign, end):
    """The :class:`Limit` of how far a parameter, times a sign, is from an end."""

    def slopes(found):
        by_parameters = np.zeros(found.parameters.shape)
        by_parameters[:, number] = -sign
        return by_parameters

    return Limit(OPEN, lambda found: end - sign * found.parameters[:, number], slopes)


def _ends(chart, limits, start, sign):
    """Whether a size of blank or tool ends the profile on one side: a limit that is reached, or that a singular line
    only keeps from being reached.
    """
    ((_, name, last),) = _rays(chart, limits, start, [(0, sign)])
    if name not in (None, OPEN, *SINGULAR):
        return True
    here, there = limits.values(chart.flank(np.stack([start, last])))
    with np.errstate(invalid="ignore"):
        nearer = np.isfinite(here) & (there < here)
    return any(near and n not in (OPEN, "face", *SINGULAR) for near, n in zip(nearer, limits.names, strict=True))


def _boxed(chart, limits, start):
    """The region with a box that just holds it, found on ever finer lattices; none if narrower than rounding."""
    here = start[list(chart.free)]
    found = _rays(chart, limits, start, [(axis, sign) for sign in (-1.0, 1.0) for axis in (0, 1)])
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


def flooded(chart, limits, lines, seed):
    """The :class:`Lattice` on two lines: nodes inside the limits that can be reached from ``seed`` (k,) node by node
    without leaving any but singular limits.
    """
    if len(chart.sizes) == 2:
        grid = np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1)
        q = grid.reshape(-1, 2)
    else:
        q = _completed_outwards(chart, lines, seed).reshape(-1, len(chart.sizes))
    values = limits.values(chart.flank(q))
    shape = tuple(len(line) for line in lines)
    singular = np.array([name in SINGULAR for name in limits.names])
    inside = (values.min(axis=1) >= 0.0).reshape(shape)
    exists = np.isfinite(values.min(axis=1))
    within = (exists & (values[:, ~singular].min(axis=1, initial=np.inf) >= 0.0)).reshape(shape)
    return Lattice(lines, q.reshape(*shape, -1), inside & _connected(within, _nearest(lines, seed[list(chart.free)])))


def _nearest(lines, place):
    return tuple(int(np.argmin(np.abs(line - x))) for line, x in zip(lines, place, strict=True))


def _connected(within, start):
    """The nodes of a mask that hang together with the node ``start``, or with the nearest one in it."""
    if not within.any():
        return within
    if not within[start]:
        nodes = np.argwhere(within)
        start = tuple(nodes[np.argmin(((nodes - start) ** 2).sum(axis=1))])
    reached = np.zeros_like(within)
    reached[start] = True
    while True:
        grown = reached.copy()
        grown[1:] |= reached[:-1]
        grown[:-1] |= reached[1:]
        grown[:, 1:] |= reached[:, :-1]
        grown[:, :-1] |= reached[:, 1:]
        grown &= within
        if (grown == reached).all():
            return reached
        reached = grown


def _completed_outwards(chart, lines, seed):
    """Parameters (n, m, k) on the lattice, each line solved from its neighbour on the side of the seed."""
    shape, (i, j) = tuple(len(line) for line in lines), _nearest(lines, seed[list(chart.free)])
    q = np.full((*shape, len(seed)), np.nan)
    start = seed[None]
    for order in (range(j, shape[1]), range(j - 1, -1, -1)):
        near = start if order.step > 0 else q[i, j][None]
        for b in order:
            q[i, b] = near = chart.complete(np.array([[lines[0][i], lines[1][b]]]), near)
    for order in (range(i + 1, shape[0]), range(i - 1, -1, -1)):
        near = q[i]
        for a in order:
            places = np.stack([np.full(shape[1], lines[0][a]), lines[1]], axis=1)
            q[a] = chart.complete(places, near)
            near = np.where(np.isfinite(q[a]), q[a], near)
    return q



