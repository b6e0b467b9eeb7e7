"""VTK unstructured grids (``.vtu``) of solved bodies."""

from collections.abc import Iterator

import numpy as np

from meshwright.fe.hexahedra import Floats, HexMesh, Ints

_HEXAHEDRON = 12


def vtu_text(mesh: HexMesh, nodal: dict[str, Floats]) -> str:
    """The file's text; ``nodal`` holds named results (N,) or (N, C) of the nodes."""
    return "\n".join(_lines(mesh, nodal)) + "\n"


def _lines(mesh: HexMesh, nodal: dict[str, Floats]) -> Iterator[str]:
    cells = len(mesh.elements)
    yield '<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">'
    yield "<UnstructuredGrid>"
    yield f'<Piece NumberOfPoints="{len(mesh.nodes)}" NumberOfCells="{cells}">'
    yield "<Points>"
    yield from _array("Points", mesh.nodes)
    yield "</Points><Cells>"
    yield from _array("connectivity", mesh.elements)
    yield from _array("offsets", 8 * np.arange(1, cells + 1))
    yield from _array("types", np.full(cells, _HEXAHEDRON))
    yield "</Cells><PointData>"
    for name, values in nodal.items():
        yield from _array(name, values)
    yield "</PointData></Piece></UnstructuredGrid></VTKFile>"


def _array(name: str, values: Floats | Ints) -> Iterator[str]:
    rows = values.reshape(len(values), -1)
    whole = np.issubdtype(values.dtype, np.integer)
    kind, form = ("Int64", "d") if whole else ("Float64", ".9g")
    yield f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{rows.shape[1]}" format="ascii">'
    yield from (" ".join(format(value, form) for value in row) for row in rows.tolist())
    yield "</DataArray>"
