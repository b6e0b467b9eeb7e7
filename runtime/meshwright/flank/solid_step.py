"""A closed body of patches as a solid of B-spline faces in a STEP file, by Open CASCADE (extra ``cad``)."""

# pyright: reportMissingImports=false
# The extra is large and seldom installed.

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from scipy.spatial import KDTree

from meshwright.base.errors import UsageError
from meshwright.flank.patches import TOGETHER, Floats, Ints, Patch, first_of_groups
from meshwright.flank.step import Spline, as_surface, knots, needs_open_cascade, written

#: Edges and faces agree to this, mm.
TOLERANCE = 1e-7


def solid_step(patches: list[Patch], name: str) -> tuple[bytes, float]:
    """The file's content and the volume in mm³ of the solid whose faces are B-splines through the points of patches.

    Raises :class:`~meshwright.base.errors.UsageError` without Open CASCADE, and where it does not find the solid valid.
    """
    needs_open_cascade()
    from OCP.BRepCheck import BRepCheck_Analyzer
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    solid = _solid(patches)
    if not BRepCheck_Analyzer(solid).IsValid():
        raise UsageError("--step: Open CASCADE does not accept this body as a valid solid; write --stl")
    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(solid, properties)
    return written([solid], name), properties.Mass()


def _solid(patches: list[Patch]):
    from OCP.BRep import BRep_Builder
    from OCP.TopoDS import TopoDS_Shell, TopoDS_Solid

    edges = _Edges.of(patches)
    builder, shell, solid = BRep_Builder(), TopoDS_Shell(), TopoDS_Solid()
    builder.MakeShell(shell)
    for number, patch in enumerate(patches):
        builder.Add(shell, edges.face(number, Spline.through(patch.points)))
    shell.Closed(True)
    builder.MakeSolid(solid)
    builder.Add(solid, shell)
    return solid


@dataclass
class _Edges:
    """Corners and edges that patches share: ``corner`` (P, 4) and ``side`` (P, 4) say which, counter-clockwise about
    each patch. Those of Open CASCADE are made when a face first needs them.
    """

    places: Floats
    corner: Ints
    side: Ints
    vertices: dict = field(default_factory=dict)
    made: dict = field(default_factory=dict)

    @classmethod
    def of(cls, patches: list[Patch]) -> _Edges:
        corners = np.array([[p.points[i, j] for i, j in ((0, 0), (-1, 0), (-1, -1), (0, -1))] for p in patches])
        middles = np.array([[_middle(line) for line in _sides(p.points)] for p in patches])
        corner, side = (_same(of.reshape(-1, 3)).reshape(len(patches), 4) for of in (corners, middles))
        return cls(corners.reshape(-1, 3), corner, side)

    def face(self, number: int, spline: Spline):
        from OCP.BRep import BRep_Builder
        from OCP.TopAbs import TopAbs_FORWARD, TopAbs_REVERSED
        from OCP.TopLoc import TopLoc_Location
        from OCP.TopoDS import TopoDS_Face, TopoDS_Wire

        builder, face, wire = BRep_Builder(), TopoDS_Face(), TopoDS_Wire()
        surface, here = as_surface(spline), TopLoc_Location()
        builder.MakeFace(face, surface, here, TOLERANCE)
        builder.MakeWire(wire)
        for k, curve in enumerate(_boundary(spline)):
            start, end = self.corner[number, k], self.corner[number, (k + 1) % 4]
            edge, first = self._edge(self.side[number, k], start, end, curve)
            forward = first == start
            builder.UpdateEdge(edge, _parameter_line(k, forward), surface, here, TOLERANCE)
            builder.Range(edge, surface, here, 0.0, 1.0)
            builder.Add(wire, edge.Oriented(TopAbs_FORWARD if forward else TopAbs_REVERSED))
        wire.Closed(True)
        builder.Add(face, wire)
        return face

    def _edge(self, name: int, start: int, end: int, curve):
        """The edge of a name and the corner that it begins at."""
        from OCP.BRep import BRep_Builder
        from OCP.TopAbs import TopAbs_FORWARD, TopAbs_REVERSED
        from OCP.TopoDS import TopoDS_Edge

        if name not in self.made:
            builder, edge = BRep_Builder(), TopoDS_Edge()
            builder.MakeEdge(edge, curve, TOLERANCE)
            builder.Add(edge, self._vertex(start).Oriented(TopAbs_FORWARD))
            builder.Add(edge, self._vertex(end).Oriented(TopAbs_REVERSED))
            builder.Range(edge, 0.0, 1.0)
            builder.SameParameter(edge, True)
            builder.SameRange(edge, True)
            self.made[name] = edge, start
        return self.made[name]

    def _vertex(self, number: int):
        from OCP.BRep import BRep_Builder
        from OCP.gp import gp_Pnt
        from OCP.TopoDS import TopoDS_Vertex

        if number not in self.vertices:
            vertex = TopoDS_Vertex()
            BRep_Builder().MakeVertex(vertex, gp_Pnt(*map(float, self.places[number])), TOLERANCE)
            self.vertices[number] = vertex
        return self.vertices[number]


def _sides(points: Floats) -> tuple[Floats, ...]:
    """The edges of a grid (I, J, 3), counter-clockwise."""
    return points[:, 0], points[-1], points[::-1, -1], points[0, ::-1]


def _middle(line: Floats) -> Floats:
    """A point that a line (N, 3) has either way along it."""
    return 0.5 * (line[(len(line) - 1) // 2] + line[len(line) // 2])


def _same(points: Floats) -> Ints:
    return first_of_groups(KDTree(points).query_pairs(TOGETHER, output_type="ndarray"), len(points))


def _boundary(spline: Spline):
    """The four edges of a surface as curves over 0 … 1, counter-clockwise."""
    (u, v), (p, q) = spline.knots, spline.degrees
    poles = spline.poles
    for line, full, degree in ((poles[:, 0], u, p), (poles[-1], v, q), (poles[::-1, -1], u, p), (poles[0, ::-1], v, q)):
        yield _curve(line, full, degree)


def _curve(poles: Floats, full: Floats, degree: int):
    from OCP.Geom import Geom_BSplineCurve
    from OCP.gp import gp_Pnt
    from OCP.TColgp import TColgp_Array1OfPnt

    array = TColgp_Array1OfPnt(1, len(poles))
    for k, pole in enumerate(poles):
        array.SetValue(k + 1, gp_Pnt(*map(float, pole)))
    return Geom_BSplineCurve(array, *knots(full), degree)


def _parameter_line(side: int, forward: bool):
    """An edge in the parameters of its surface, both over 0 … 1, along the boundary or against it."""
    from OCP.Geom2d import Geom2d_Line
    from OCP.gp import gp_Dir2d, gp_Pnt2d

    starts, ways = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)), ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))
    start, way = starts[side], ways[side]
    if not forward:
        start, way = starts[(side + 1) % 4], (-way[0], -way[1])
    return Geom2d_Line(gp_Pnt2d(*start), gp_Dir2d(*way))
