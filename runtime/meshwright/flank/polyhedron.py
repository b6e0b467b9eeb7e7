"""A closed surface of triangles as a solid in a STEP file, by Open CASCADE (extra ``cad``)."""

from meshwright.base.errors import UsageError
from meshwright.flank.step import needs_open_cascade, written

#: More facets than this are more than programs open.
MOST_FACETS = 60_000


def solid_step(points, triangles, name):
    """The file's content: triangles (M, 3) over points (N, 3) in mm, counter-clockwise seen from outside.

    Raises :class:`~meshwright.base.errors.UsageError` without Open CASCADE, for too many facets, and where it does not
    find the solid valid.
    """
    needs_open_cascade()
    if len(triangles) > MOST_FACETS:
        raise UsageError(f"--step: {len(triangles)} facets, {MOST_FACETS} at most; ask for fewer --teeth, or --stl")
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakePolygon, BRepBuilderAPI_Sewing
    from OCP.BRepCheck import BRepCheck_Analyzer
    from OCP.gp import gp_Pnt
    from OCP.ShapeFix import ShapeFix_Solid
    from OCP.TopoDS import TopoDS

    corners = [gp_Pnt(*map(float, point)) for point in points]
    sewing = BRepBuilderAPI_Sewing(1e-7)
    for triangle in triangles:
        outline = BRepBuilderAPI_MakePolygon(*(corners[k] for k in triangle), True)
        sewing.Add(BRepBuilderAPI_MakeFace(outline.Wire(), True).Face())
    sewing.Perform()
    shell = TopoDS.Shell_s(sewing.SewedShape())
    solid = ShapeFix_Solid().SolidFromShell(shell)
    if not BRepCheck_Analyzer(solid).IsValid():
        raise UsageError("--step: Open CASCADE does not accept this body as a valid solid; write --stl")
    return written([solid], name)
