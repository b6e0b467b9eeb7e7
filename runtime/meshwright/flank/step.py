"""A region of a tooth as a STEP file: B-spline surfaces trimmed along the limits, by Open CASCADE (extra ``cad``)."""

# pyright: reportMissingImports=false
# The extra is large and seldom installed.

import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.flank.border import DEGREE, cornered, loops
from meshwright.flank.lines import corners
from meshwright.flank.mesh import mesh

#: The surface is refined until it departs by no more than this from the exact one, mm, or has as many points as that in
#: a direction: both are refined together over a chart, each as it needs them between lines across the region.
TOLERANCE = 5e-4
MOST, MOST_BETWEEN = 257, 1025

#: Border points and surface points keep so far from the edges of the B-spline's own domain, in parts of it.
ROOM = 0.02


@dataclass(frozen=True)
class StepFile:
    """The file's ``content`` and how far its faces are at most from the region, mm: the surface midway between the
    points that it passes through, the border curves midway between theirs.
    """

    content: bytes
    deviation: float


@dataclass(frozen=True)
class Spline:
    """A tensor-product B-spline: ``poles`` (N, M, 3), full ``knots`` of either direction, ``degrees``."""

    poles: np.ndarray
    knots: tuple[np.ndarray, np.ndarray]
    degrees: tuple[int, int]

    @classmethod
    def through(cls, points):
        """The spline through points (N, M, 3) at equally spaced parameters 0 … 1."""
        from scipy.interpolate import make_interp_spline

        degrees = tuple(min(DEGREE, n - 1) for n in points.shape[:2])
        poles, knots = points, []
        for axis, degree in enumerate(degrees):
            fit = make_interp_spline(np.linspace(0.0, 1.0, points.shape[axis]), poles, k=degree, axis=axis)
            poles = np.moveaxis(fit.c, 0, axis)
            knots.append(fit.t)
        return cls(poles, tuple(knots), degrees)

    def sampled(self, *lines):
        """Its points (N, M, 3) at two lines of parameters."""
        from scipy.interpolate import BSpline

        values = self.poles
        for axis, (line, knots, degree) in enumerate(zip(lines, self.knots, self.degrees, strict=True)):
            spline = BSpline(knots, np.moveaxis(values, axis, 0), degree)
            values = np.moveaxis(spline(line), 0, axis)
        return values


@dataclass(frozen=True)
class Frame:
    """An affine frame of a region's chart that just holds it: coordinates = ``origin`` + (u, v) · ``axes`` (2, 2)."""

    origin: np.ndarray
    axes: np.ndarray

    @classmethod
    def about(cls, coordinates, sizes):
        """The frame about coordinates (P, 2), along their principal directions in natural ``sizes`` (2,)."""
        scaled = coordinates / sizes
        middle = scaled.mean(axis=0)
        spread = np.ptp(scaled, axis=0)
        _, directions = np.linalg.eigh(np.cov(((scaled - middle) / spread).T))
        directions = directions.T * spread
        along = (scaled - middle) @ np.linalg.inv(directions)
        low, high = along.min(axis=0), along.max(axis=0)
        low, high = low - ROOM * (high - low), high + ROOM * (high - low)
        return cls((middle + low @ directions) * sizes, (high - low)[:, None] * directions * sizes)

    def coordinates(self, places):
        """Chart coordinates (..., 2) of places (..., 2) in the frame."""
        return self.origin + places @ self.axes

    def places(self, coordinates):
        """Places in the frame of chart coordinates."""
        return (coordinates - self.origin) @ np.linalg.inv(self.axes)


def step(drive, region, shape):
    """The :class:`StepFile` of a :class:`~meshwright.flank.region.Region` with at least ``shape`` points.

    Raises :class:`~meshwright.base.errors.UsageError` without Open CASCADE, or where the surface cannot be continued
    far enough to be trimmed.
    """
    needs_open_cascade()
    if region.empty:
        raise UsageError(f"{region.why_empty}; change [blank] or [design]")
    name = f"{drive.design.tables['name'] or drive.design.family} {region.flank.body['name']} {region.flank.region}"
    flip = drive.design.mirror.flip
    try:
        made = _trimmed(region, shape, flip, name)
    except (UsageError, ValueError, np.linalg.LinAlgError):
        made = None
    if made is None or made.deviation > TOLERANCE:
        # the chart's coordinates are no good measure of the surface everywhere: lengths along lines are
        guides = region.lines
        by_lines = between_lines(guides.at, [guides.along[0], *corners(guides), guides.along[-1]], shape, flip, name)
        made = by_lines if made is None or by_lines.deviation < made.deviation else made
    return made


def _trimmed(region, shape, flip, name):
    """One surface over the region's chart, trimmed along its limits."""
    triangles = _resolved(region, tuple(n - 1 for n in shape))
    free = list(region.chart.free)
    frame = Frame.about(triangles.parameters[:, free], region.chart.sizes[free])
    spline, deviation = _fitted(region, frame, triangles, shape)
    border = loops(region, triangles)
    deviation = max([deviation, *(side.deviation for loop in border for side in loop)])
    spline = Spline(spline.poles * flip, spline.knots, spline.degrees)
    return StepFile(written(_faces(spline, frame, border), name), deviation)


def between_lines(lines_at, ends, shape, flip, name):
    """The :class:`StepFile` of surfaces between lines across a region, from end to end of it, with a seam at each
    corner of its border.

    ``lines_at`` gives the lines at coordinates along the tooth, ``ends`` are those of its ends and corners, ascending.
    """
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace

    faces, deviation = [], 0.0
    for first, last in zip(ends[:-1], ends[1:], strict=True):
        spline, departure = _along_lines(lines_at, first, last, [max(n, DEGREE + 1) for n in shape])
        spline = Spline(spline.poles * flip, spline.knots, spline.degrees)
        faces.append(BRepBuilderAPI_MakeFace(as_surface(spline), 1e-7).Face())
        deviation = max(deviation, departure)
    return StepFile(written(faces, name), deviation)


def _along_lines(lines_at, first, last, counts):
    """The spline over the lines between two coordinates along the tooth and its departure from the surface, mm."""
    while True:
        across = lines_at(np.linspace(first, last, 2 * counts[1] - 1))
        flank, q = across.region.flank, across.even(np.linspace(0.0, 1.0, 2 * counts[0] - 1))
        points = flank(q.reshape(-1, q.shape[2])).points.reshape(*q.shape[:2], 3)
        if not np.isfinite(points).all():
            raise UsageError(
                f"the {flank.region} of the {flank.body['name']} is no surface between two ends of each of its lines; "
                "write --vtu or --stl, or limit it in [blank]"
            )
        spline = Spline.through(points[::2, ::2])
        away = np.linalg.norm(spline.sampled(*(np.linspace(0.0, 1.0, n) for n in points.shape[:2])) - points, axis=2)
        deviation = float(away.max())
        if deviation <= TOLERANCE:
            return spline, deviation
        worst = np.array([away[1::2, ::2].max(), away[::2, 1::2].max()])
        more = (worst > 0.25 * worst.max()) & (2 * np.array(counts) <= MOST_BETWEEN)
        finer = [2 * n - 1 if grows else n for n, grows in zip(counts, more, strict=True)]
        if finer == counts:
            return spline, deviation
        counts = finer


def _resolved(region, cells):
    """Triangles fine enough for every corner of the border to be found, narrow ends of the region among them."""
    while True:
        triangles = mesh(region, cells)
        if cornered(region, triangles) or max(cells) * 2 > MOST:
            return triangles
        cells = tuple(2 * n for n in cells)


def needs_open_cascade():
    """Raise :class:`~meshwright.base.errors.UsageError` where Open CASCADE is not installed."""
    try:
        import OCP.TColgp  # noqa: F401
        import scipy.interpolate  # noqa: F401
    except ImportError as error:
        raise UsageError("--step needs Open CASCADE: pip install 'meshwright[cad]'") from error


def _fitted(region, frame, triangles, shape):
    """The spline over a frame and its largest departure from the surface inside the region, mm."""
    counts = [max(n, DEGREE + 1) for n in shape]
    inside = frame.places(triangles.parameters[:, list(region.chart.free)])
    while True:
        fine = [np.linspace(0.0, 1.0, 2 * n - 1) for n in counts]
        points = _points(region, frame, fine)
        if not np.isfinite(points).all():
            raise UsageError(
                f"the {region.flank.region} of the {region.flank.body['name']} cannot be continued beyond its border "
                "everywhere, as a trimmed surface needs it; write --vtu or --stl, or limit it in [blank]"
            )
        spline = Spline.through(points[::2, ::2])
        away = np.linalg.norm(spline.sampled(*fine) - points, axis=2)
        near = _cells_in_use(inside, away.shape)
        deviation = float(away[near].max())
        if deviation <= TOLERANCE or max(counts) * 2 > MOST:
            return spline, deviation
        counts = [2 * n - 1 for n in counts]


def _cells_in_use(places, shape):
    """Which nodes of a grid over the frame are next to a place (P, 2) of the region."""
    near = np.zeros(shape, dtype=bool)
    at = np.clip((places * (np.array(shape) - 1)).round().astype(int), 0, np.array(shape) - 1)
    near[at[:, 0], at[:, 1]] = True
    return near


def _points(region, frame, lines):
    """Points (N, M, 3) of the surface over a grid of the frame, border or not."""
    chart = region.chart
    grid = np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1)
    coordinates = frame.coordinates(grid)
    if len(chart.sizes) == 2:
        return chart.flank(coordinates.reshape(-1, 2)).points.reshape(*grid.shape[:2], 3)
    start = region.seed[None]
    middle = len(lines[0]) // 2, len(lines[1]) // 2
    q = np.full((*grid.shape[:2], len(chart.sizes)), np.nan)
    here = region.seed[list(chart.free)]
    for share in np.linspace(0.0, 1.0, 17)[1:]:
        start = chart.complete((here + share * (coordinates[middle] - here))[None], start)
    q[middle] = start[0]
    for order in (range(middle[1] + 1, grid.shape[1]), range(middle[1] - 1, -1, -1)):
        near = q[middle][None]
        for j in order:
            q[middle[0], j] = near = chart.complete(coordinates[middle[0], j][None], near)
    for order in (range(middle[0] + 1, grid.shape[0]), range(middle[0] - 1, -1, -1)):
        near = q[middle[0]]
        for i in order:
            q[i] = near = chart.complete(coordinates[i], near)
    return chart.flank(q.reshape(-1, q.shape[2])).points.reshape(*grid.shape[:2], 3)


def _faces(spline, frame, border):
    """The pieces of a region as faces of Open CASCADE."""
    surface, found = as_surface(spline), []
    areas = [_area(frame, loop) for loop in border]
    outer = [k for k, area in enumerate(areas) if area > 0.0]
    for k in outer:
        holes = [loop for j, loop in enumerate(border) if j not in outer and _within(frame, loop, border[k])]
        found.append(_face(surface, frame, border[k], holes))
    return found


def _outline(frame, loop):
    return np.concatenate([frame.places(side.coordinates)[:-1] for side in loop])


def _area(frame, loop):
    x, y = frame.coordinates(_outline(frame, loop)).T
    return 0.5 * float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))


def _within(frame, loop, other):
    """Whether a loop lies in another one, by the winding of the latter about one of its points."""
    place, around = _outline(frame, loop)[0], _outline(frame, other)
    away = around - place
    angle = np.arctan2(away[:, 1], away[:, 0])
    turned = (np.diff(np.append(angle, angle[0])) + np.pi) % (2.0 * np.pi) - np.pi
    return abs(turned.sum()) > np.pi


def _face(surface, frame, outer, holes):
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
    from OCP.BRepLib import BRepLib
    from OCP.ShapeFix import ShapeFix_Face

    maker = BRepBuilderAPI_MakeFace(surface, _wire(surface, frame, outer), True)
    for hole in holes:
        maker.Add(_wire(surface, frame, hole))
    face = maker.Face()
    BRepLib.BuildCurves3d_s(face, 1e-7)
    BRepLib.SameParameter_s(face, 1e-7, True)
    fixed = ShapeFix_Face(face)
    fixed.FixOrientation()
    fixed.Perform()
    return fixed.Face()


def _wire(surface, frame, loop):
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeWire
    from OCP.BRepLib import BRepLib

    wire = BRepBuilderAPI_MakeWire()
    for side in loop:
        edge = BRepBuilderAPI_MakeEdge(_plane_curve(frame, side), surface).Edge()
        BRepLib.BuildCurve3d_s(edge, 1e-7)
        wire.Add(edge)
    return wire.Wire()


def _plane_curve(frame, side):
    """A border curve in the parameters of the spline surface."""
    from OCP.Geom2d import Geom2d_BSplineCurve
    from OCP.gp import gp_Pnt2d
    from OCP.TColgp import TColgp_Array1OfPnt2d

    spline = side.spline
    poles = TColgp_Array1OfPnt2d(1, len(spline.c))
    for k, place in enumerate(frame.places(spline.c)):
        poles.SetValue(k + 1, gp_Pnt2d(*map(float, place)))
    return Geom2d_BSplineCurve(poles, *knots(spline.t), spline.k)


def as_surface(spline):
    """A :class:`Spline` as a surface of Open CASCADE."""
    from OCP.Geom import Geom_BSplineSurface
    from OCP.gp import gp_Pnt
    from OCP.TColgp import TColgp_Array2OfPnt

    n, m, _ = spline.poles.shape
    poles = TColgp_Array2OfPnt(1, n, 1, m)
    for i in range(n):
        for j in range(m):
            poles.SetValue(i + 1, j + 1, gp_Pnt(*map(float, spline.poles[i, j])))
    (u, at_u), (v, at_v) = (knots(full) for full in spline.knots)
    return Geom_BSplineSurface(poles, u, v, at_u, at_v, *spline.degrees)


def knots(full):
    """Distinct knots and their multiplicities."""
    from OCP.TColStd import TColStd_Array1OfInteger, TColStd_Array1OfReal

    distinct, counts = np.unique(full, return_counts=True)
    return _array(TColStd_Array1OfReal, distinct.tolist()), _array(TColStd_Array1OfInteger, counts.tolist())


def _array(kind, values):
    array = kind(1, len(values))
    for k, value in enumerate(values):
        array.SetValue(k + 1, value)
    return array


def written(shapes, name):
    """The bytes of a STEP file of shapes, in millimetres."""
    from OCP.IFSelect import IFSelect_RetDone
    from OCP.Interface import Interface_Static
    from OCP.Message import Message, Message_Gravity
    from OCP.STEPControl import STEPControl_AsIs, STEPControl_Writer

    for printer in Message.DefaultMessenger_s().Printers():
        printer.SetTraceLevel(Message_Gravity.Message_Fail)
    writer = STEPControl_Writer()
    Interface_Static.SetCVal_s("write.step.unit", "MM")
    Interface_Static.SetCVal_s("write.step.product.name", name)
    for shape in shapes:
        writer.Transfer(shape, STEPControl_AsIs)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "flank.step"
        if writer.Write(str(path)) != IFSelect_RetDone:
            raise UsageError("Open CASCADE could not write the surface; ask for a finer --grid")
        return path.read_bytes()
