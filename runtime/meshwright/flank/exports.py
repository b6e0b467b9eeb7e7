"""Meshed regions as files of other programs: VTU (ParaView), STL. Millimetres, body frame."""

import struct
from xml.sax.saxutils import quoteattr

import numpy as np

#: Cell type of a triangle in VTK files.
VTK_TRIANGLE = 5


def vtu(grid):
    """The mesh of a grid as a VTK unstructured grid (XML text): triangles with normals and parameters at the points."""
    mesh = grid.mesh
    data = [_array("normal", mesh.normals)]
    data += [_array(name, column) for name, column in zip(grid.parameters, mesh.parameters.T, strict=True)]
    parts = [
        '<?xml version="1.0"?>',
        '<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">',
        "<UnstructuredGrid>",
        f'<Piece NumberOfPoints="{len(mesh.points)}" NumberOfCells="{len(mesh.triangles)}">',
        '<PointData Normals="normal">', *data, "</PointData>",
        "<Points>", _array("points", mesh.points), "</Points>",
        "<Cells>",
        _array("connectivity", mesh.triangles.ravel(), "Int64"),
        _array("offsets", 3 * np.arange(1, len(mesh.triangles) + 1), "Int64"),
        _array("types", np.full(len(mesh.triangles), VTK_TRIANGLE), "UInt8"),
        "</Cells>", "</Piece>", "</UnstructuredGrid>", "</VTKFile>",
    ]  # fmt: skip
    return "\n".join(parts) + "\n"


def _array(name, values, kind="Float64"):
    rows = np.atleast_2d(values.T).T
    text = "\n".join(" ".join(repr(v) for v in row) for row in rows.tolist())
    kind_and_name = f'type="{kind}" Name={quoteattr(name)} NumberOfComponents="{rows.shape[1]}"'
    return f'<DataArray {kind_and_name} format="ascii">\n{text}\n</DataArray>'


def stl(points, triangles, name):
    """Triangles (T, 3) over points (V, 3), counter-clockwise seen from outside, as binary STL."""
    corners = points[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    records = np.zeros(len(corners), dtype=[("facet", "<f4", (4, 3)), ("attribute", "<u2")])
    records["facet"] = np.concatenate([normals[:, None, :], corners], axis=1)
    header = f"meshwright {name}, mm".encode()[:80].ljust(80)
    return header + struct.pack("<I", len(corners)) + records.tobytes()
