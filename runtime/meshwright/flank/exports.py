"""Grids as files of other programs: VTU (ParaView), STL. Millimetres, body frame."""

import struct
from xml.sax.saxutils import quoteattr

import numpy as np

#: Cell type of a quadrilateral in VTK files.
VTK_QUAD = 9


def quadrilaterals(grid):
    """Corner indices (Q, 4) of a grid's cells, counter-clockwise seen from outside the material."""
    n, m = grid.shape
    index = np.arange(n * m).reshape(n, m)
    cells = np.stack([index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]], axis=-1).reshape(-1, 4)
    corner, across, _, along = (grid.points[cells[:, k]] for k in range(4))
    facing = np.einsum("ij,ij->i", np.cross(across - corner, along - corner), grid.normals[cells[:, 0]])
    return cells if np.sum(facing) >= 0.0 else cells[:, ::-1]


def vtu(grid):
    """The grid as a VTK unstructured grid (XML text): quadrilaterals with normals and parameters at the points."""
    cells = quadrilaterals(grid)
    data = [_array("normal", grid.normals)]
    data += [_array(name, column) for name, column in zip(grid.parameters, grid.values.T, strict=True)]
    parts = [
        '<?xml version="1.0"?>',
        '<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">',
        "<UnstructuredGrid>",
        f'<Piece NumberOfPoints="{len(grid.points)}" NumberOfCells="{len(cells)}">',
        '<PointData Normals="normal">', *data, "</PointData>",
        "<Points>", _array("points", grid.points), "</Points>",
        "<Cells>",
        _array("connectivity", cells.ravel(), "Int64"),
        _array("offsets", 4 * np.arange(1, len(cells) + 1), "Int64"),
        _array("types", np.full(len(cells), VTK_QUAD), "UInt8"),
        "</Cells>", "</Piece>", "</UnstructuredGrid>", "</VTKFile>",
    ]  # fmt: skip
    return "\n".join(parts) + "\n"


def _array(name, values, kind="Float64"):
    rows = np.atleast_2d(values.T).T
    text = "\n".join(" ".join(repr(v) for v in row) for row in rows.tolist())
    kind_and_name = f'type="{kind}" Name={quoteattr(name)} NumberOfComponents="{rows.shape[1]}"'
    return f'<DataArray {kind_and_name} format="ascii">\n{text}\n</DataArray>'


def stl(grid):
    """The grid as binary STL: two triangles a cell, facing out of the material."""
    cells = quadrilaterals(grid)
    corners = grid.points[np.concatenate([cells[:, [0, 1, 2]], cells[:, [0, 2, 3]]])]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    records = np.zeros(len(corners), dtype=[("facet", "<f4", (4, 3)), ("attribute", "<u2")])
    records["facet"] = np.concatenate([normals[:, None, :], corners], axis=1)
    header = f"meshwright {grid.member} {grid.region}, mm".encode().ljust(80)
    return header + struct.pack("<I", len(corners)) + records.tobytes()
