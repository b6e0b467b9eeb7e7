"""STEP files as another program reads them."""

import tempfile
from pathlib import Path


def valid_shape(content):
    """The shape of a STEP file, which is valid."""
    from OCP.BRepCheck import BRepCheck_Analyzer
    from OCP.STEPControl import STEPControl_Reader

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "body.step"
        path.write_bytes(content)
        reader = STEPControl_Reader()
        reader.ReadFile(str(path))
        reader.TransferRoots()
    shape = reader.OneShape()
    assert BRepCheck_Analyzer(shape).IsValid()
    return shape
