"""What the rooms below the façade use of a drive is what they say they know of it."""

import ast
from pathlib import Path

import meshwright
from meshwright.contact.model import DriveModel

ROOMS = ("contact", "flank", "cycle", "pattern", "limits")


def used(path):
    """Members that a file uses of what it calls a drive: ``drive.x``, ``self.drive.x``, ``mesh.drive.x`` …"""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Attribute):
            of = node.value
            name = of.id if isinstance(of, ast.Name) else of.attr if isinstance(of, ast.Attribute) else ""
            if name == "drive":
                yield node.attr, f"{path.parent.name}/{path.name}:{node.lineno}"


def test_every_member_of_a_drive_that_is_used_below_it_is_declared():
    folder = Path(meshwright.__file__).parent
    declared = {name for name in vars(DriveModel) if not name.startswith("_")}
    places = [place for room in ROOMS for path in (folder / room).glob("*.py") for place in used(path)]
    assert {name for name, _ in places} >= {"design", "ratio", "pitch"}
    assert [place for place in places if place[0] not in declared] == []
