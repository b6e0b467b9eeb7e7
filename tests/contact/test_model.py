"""What the rooms below the façade use of a drive is what each of them says it needs."""

import ast
from pathlib import Path

import pytest

import meshwright
from meshwright.contact.certificate import ProvedModel
from meshwright.cycle.model import DriveModel as CycleModel
from meshwright.drive import Drive
from meshwright.flank.model import DriveModel as FlankModel
from meshwright.limits.model import DriveModel as LimitsModel

#: What each room declares; the pattern is that of a cycle.
ROOMS = {"contact": ProvedModel, "flank": FlankModel, "cycle": CycleModel, "pattern": CycleModel, "limits": LimitsModel}


def used(path):
    """Members that a file uses of what it calls a drive: ``drive.x``, ``self.drive.x``, ``mesh.drive.x`` …"""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Attribute):
            of = node.value
            name = of.id if isinstance(of, ast.Name) else of.attr if isinstance(of, ast.Attribute) else ""
            if name == "drive":
                yield node.attr, f"{path.parent.name}/{path.name}:{node.lineno}"


def declared(model):
    return {name for part in model.__mro__ for name in vars(part) if not name.startswith("_")}


@pytest.mark.parametrize("room", ROOMS)
def test_every_member_of_a_drive_that_a_room_uses_is_declared_by_it(room):
    places = [place for path in Path(meshwright.__file__).with_name(room).glob("*.py") for place in used(path)]
    assert "design" in {name for name, _ in places}
    assert [place for place in places if place[0] not in declared(ROOMS[room])] == []


@pytest.mark.parametrize("model", ROOMS.values())
def test_a_drive_has_what_is_declared(model):
    assert declared(model) - {"design"} <= {name for name in dir(Drive) if not name.startswith("_")}
    assert "design" in Drive.__dataclass_fields__
