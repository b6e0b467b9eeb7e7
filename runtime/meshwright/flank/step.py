"""A flank as a STEP file: a B-spline surface through the points of a grid, by Open CASCADE (extra ``cad``)."""

import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.flank.grids import grid

#: Degree of the surface both ways, where the grid has points enough.
DEGREE = 5


@dataclass(frozen=True)
class StepFile:
    """The file's ``content`` and how far the surface is at most from the exact flank, mm: ``deviation`` at the places
    midway between the points that it passes through.
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

    def sampled(self, shape):
        """Its points (N, M, 3) at equally spaced parameters."""
        from scipy.interpolate import BSpline

        values = self.poles
        for axis, (count, knots, degree) in enumerate(zip(shape, self.knots, self.degrees, strict=True)):
            spline = BSpline(knots, np.moveaxis(values, axis, 0), degree)
            values = np.moveaxis(spline(np.linspace(0.0, 1.0, count)), 0, axis)
        return values


def step(drive, member, shape, region="flank"):
    """The :class:`StepFile` of a region; raises :class:`~meshwright.base.errors.UsageError` without Open CASCADE."""
    _needs_open_cascade()
    fine = grid(drive, member, (2 * shape[0] - 1, 2 * shape[1] - 1), region)
    points = fine.points.reshape(*fine.shape, 3)
    spline = Spline.through(points[::2, ::2])
    deviation = np.linalg.norm(spline.sampled(fine.shape) - points, axis=2).max()
    name = f"{drive.design.tables['name'] or drive.design.family} {member} {region}"
    return StepFile(_written(_surface(spline), name), float(deviation))


def _needs_open_cascade():
    try:
        import OCP.TColgp  # noqa: F401
        import scipy.interpolate  # noqa: F401
    except ImportError as error:
        raise UsageError("--step needs Open CASCADE: pip install 'meshwright[cad]'") from error


def _surface(spline):
    """The spline as a surface of Open CASCADE."""
    from OCP.Geom import Geom_BSplineSurface
    from OCP.gp import gp_Pnt
    from OCP.TColgp import TColgp_Array2OfPnt
    from OCP.TColStd import TColStd_Array1OfInteger, TColStd_Array1OfReal

    n, m, _ = spline.poles.shape
    poles = TColgp_Array2OfPnt(1, n, 1, m)
    for i in range(n):
        for j in range(m):
            poles.SetValue(i + 1, j + 1, gp_Pnt(*map(float, spline.poles[i, j])))
    knots, multiplicities = [], []
    for full in spline.knots:
        distinct, counts = np.unique(full, return_counts=True)
        knots.append(_array(TColStd_Array1OfReal, distinct.tolist()))
        multiplicities.append(_array(TColStd_Array1OfInteger, counts.tolist()))
    return Geom_BSplineSurface(poles, *knots, *multiplicities, *spline.degrees)


def _array(kind, values):
    array = kind(1, len(values))
    for k, value in enumerate(values):
        array.SetValue(k + 1, value)
    return array


def _written(surface, name):
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
    from OCP.IFSelect import IFSelect_RetDone
    from OCP.Interface import Interface_Static
    from OCP.Message import Message, Message_Gravity
    from OCP.STEPControl import STEPControl_AsIs, STEPControl_Writer

    for printer in Message.DefaultMessenger_s().Printers():
        printer.SetTraceLevel(Message_Gravity.Message_Fail)
    writer = STEPControl_Writer()
    Interface_Static.SetCVal_s("write.step.unit", "MM")
    Interface_Static.SetCVal_s("write.step.product.name", name)
    writer.Transfer(BRepBuilderAPI_MakeFace(surface, 1e-7).Face(), STEPControl_AsIs)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "flank.step"
        if writer.Write(str(path)) != IFSelect_RetDone:
            raise UsageError("Open CASCADE could not write the surface; ask for a finer --grid")
        return path.read_bytes()
