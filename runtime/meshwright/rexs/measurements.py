"""Measured deviations in REXS: of each measured flank a list of points, and a data set of deviations that refers to it.

The points are a part (assembly) of the gear, by their coordinates along its axis of rotation u and across it, v and w;
amounts are along the normals, positive for excess material. What REXS has no attribute for stands in the list's name.
"""

import re
from dataclasses import dataclass

import numpy as np

from meshwright.rexs.document import RexsError, parsed, spliced
from meshwright.rexs.places import bound, exchanges, stage_of
from meshwright.rexs.writing import insertion
from meshwright.shop.tables import Points

POINTS, DATA = "point_list", "gear_flank_data_set"
COORDINATES = tuple(f"point_coordinates_{axis}_coord" for axis in "uvw")
AMOUNTS, NORMALS = "topographical_deviation_amounts_point_list", "topographical_deviation_normals"

#: The attributes of either component, with their unit and the element that holds them.
ATTRIBUTES = {
    POINTS: {"kind_of_point_list": ("none", ""), "point_ids": ("none", "array"),
             **dict.fromkeys(COORDINATES, ("mm", "array"))},
    DATA: {"set_ids": ("none", "array"), AMOUNTS: ("mm", "array"), NORMALS: ("none", "matrix")},
}  # fmt: skip
KIND = "gear_flank_mesh"

#: What a list of ours is called; the points' places i, j in the grid follow from their ids, i · along + j + 1.
NAME = "{word} flank of tooth {tooth}, {across} x {along} points"
_NAME = re.compile(r"(\w+) flank of tooth (\d{1,6}), (\d{1,6}) x (\d{1,6}) points")

_ROLES = {"pinion": "gear_1", "wheel": "gear_2"}

#: What REXS leaves open, for the report.
ASSUMED = (
    ("u", "axis of rotation, z of the body frame", "REXS does not fix where u is 0: the design's body frame does"),
    ("v, w", "x and y of the body frame", "REXS does not fix the angle of a gear about its axis"),
    (AMOUNTS, "along the normals, positive for excess material", "sign assumed"),
)


@dataclass(frozen=True)
class Added:
    """The file's bytes with measured points, and entries of the report on what was assumed and left out."""

    content: bytes
    assumed: list
    unmapped: list


def with_points(content, member, points, place="the file", stage=None):
    """A REXS file (bytes) with the measured ones of :class:`~meshwright.shop.tables.Points` of a member."""
    document = parsed(content, place)
    gear = _gear(document, member, stage)
    number = _last(document.components)
    order = _last(r.id for r in document.relations)
    components, relations, left = [], [], int(np.count_nonzero(~np.isfinite(points.deviations)))
    shape = int(points.i.max()) + 1, int(points.j.max()) + 1
    for tooth, word in dict.fromkeys(zip(points.tooth.tolist(), points.flank, strict=True)):
        own = (points.tooth == tooth) & np.array([w == word for w in points.flank]) & np.isfinite(points.deviations)
        rows = np.flatnonzero(own)
        if not len(rows):
            continue
        ids = points.i[rows] * shape[1] + points.j[rows] + 1
        name = NAME.format(word=word, tooth=tooth, across=shape[0], along=shape[1])
        x, y, z = points.points[rows].T
        listed = {"kind_of_point_list": KIND, "point_ids": ids, **dict(zip(COORDINATES, (z, x, y), strict=True))}
        normals = points.normals[rows][:, [2, 0, 1]]
        data = {"set_ids": ids, AMOUNTS: points.deviations[rows], NORMALS: normals}
        components += [_component(number + 1, POINTS, name, listed), _component(number + 2, DATA, name, data)]
        relations += [
            _relation(order + 1, "assembly", {"assembly": gear.id, "part": number + 1}),
            _relation(order + 2, "reference", {"origin": number + 1, "referenced": number + 2}),
        ]
        number, order = number + 2, order + 2
    sections = {child.tag: child for child in document.root.children}
    edits = [insertion(document, sections["components"], components),
             insertion(document, sections["relations"], relations)] if components else []  # fmt: skip
    return Added(
        spliced(document.source, edits),
        [{"key": key, "value": value, "reason": reason} for key, value, reason in ASSUMED],
        [{"component": POINTS, "attribute": "point_ids", "reason": f"{left} points have no deviation"}] if left else [],
    )


def points_of(document, member, stage=None):
    """The :class:`~meshwright.shop.tables.Points` of a member in a :class:`~meshwright.rexs.document.Document`.

    Raises :class:`~meshwright.rexs.document.RexsError` where there are none, or such as cannot be put into a grid.
    """
    gear, parts = _gear(document, member, stage), []
    for relation in document.relations:
        listed = relation.refs.get("part")
        if relation.type != "assembly" or relation.refs.get("assembly") is not gear or listed is None:
            continue
        if listed.type == POINTS and (data := _data_of(document, listed)) is not None:
            parts.append(_flank(document, listed, data))
    if not parts:
        reason = f"it has no {POINTS} with a {DATA} that refers to it"
        raise RexsError(f"{document.place}, {gear}", reason, "name the member that was measured")
    columns = [np.concatenate([part[k] for part in parts]) for k in range(6)]
    words = tuple(word for part in parts for word in part[6])
    return Points(columns[0], words, *columns[1:])


def _gear(document, member, stage):
    family, component = stage_of(document, stage)
    table = exchanges()[family]
    found = bound(document, table, component)
    name = next(n for r in table["relations"] if r["type"] == "stage" for role, n in r["refs"]
                if role == _ROLES[member])  # fmt: skip
    return found[name]


def _last(idents):
    return max((int(i) for i in idents if i.isdecimal()), default=0)


def _component(number, kind, name, values):
    inner = "".join(
        f'<attribute id="{key}" unit="{ATTRIBUTES[kind][key][0]}">{_value(ATTRIBUTES[kind][key][1], value)}</attribute>'
        for key, value in values.items()
    )
    return f'<component id="{number}" type="{kind}" name="{name}">{inner}</component>'


def _value(shape, value):
    if shape == "matrix":
        return f"<matrix>{''.join(f'<r>{_cells(row)}</r>' for row in value)}</matrix>"
    return f"<array>{_cells(value)}</array>" if shape == "array" else value


def _cells(values):
    return "".join(f"<c>{value!r}</c>" for value in np.asarray(values).tolist())


def _relation(number, kind, refs):
    inner = "".join(f'<ref id="{ident}" role="{role}"/>' for role, ident in refs.items())
    return f'<relation id="{number}" type="{kind}">{inner}</relation>'


def _data_of(document, listed):
    """The data set that refers to a list of points, None if there is none with deviations."""
    found = (r.refs.get("referenced") for r in document.relations
             if r.type == "reference" and r.refs.get("origin") is listed)  # fmt: skip
    return next((c for c in found if c is not None and c.type == DATA and AMOUNTS in c.attributes), None)


def _flank(document, listed, data):
    """Columns tooth, i, j, points, normals, deviations, and words of a measured flank."""
    named = _NAME.fullmatch(listed.name)
    if named is None:
        raise RexsError(
            f"{document.place}, {listed}, name = {listed.name[:60]!r}", "does not say which flank and grid it is",
            f"name it as {NAME.format(word='right', tooth=1, across=5, along=9)!r}",
        )  # fmt: skip
    tooth, across, along = (int(named[k]) for k in (2, 3, 4))
    ids = _numbers(document, listed, "point_ids").astype(int)
    z, x, y = (_numbers(document, listed, key) for key in COORDINATES)
    sets = _numbers(document, data, "set_ids").astype(int)
    amounts, normals = _numbers(document, data, AMOUNTS), _rows(document, data, NORMALS)
    for component, key, count, wanted in (
        *((listed, key, len(v), len(ids)) for key, v in zip(COORDINATES, (z, x, y), strict=True)),
        (data, "set_ids", len(sets), len(ids)), (data, AMOUNTS, len(amounts), len(sets)),
        (data, NORMALS, len(normals), len(sets)),
    ):  # fmt: skip
        if count != wanted:
            raise _error(document, component, key, f"{count} entries", f"it must have {wanted}, one a point")
    if len(set(ids.tolist())) < len(ids) or ids.min() < 1 or ids.max() > across * along:
        raise _error(document, listed, "point_ids", "twice the same, or beyond the grid", f"1 to {across * along}")
    at = {ident: k for k, ident in enumerate(ids.tolist())}
    if set(sets.tolist()) != set(at):
        raise _error(document, data, "set_ids", "not those of the points", "give every point of the list one deviation")
    order = np.array([at[ident] for ident in sets.tolist()])
    places = np.stack([x, y, z], axis=1)[order]
    return (
        np.full(len(sets), tooth), (sets - 1) // along, (sets - 1) % along, places, normals[:, [1, 2, 0]], amounts,
        (named[1],) * len(sets),
    )  # fmt: skip


def _numbers(document, component, key):
    arrays = _element(document, component, key).all("array")
    if len(arrays) != 1 or not arrays[0].all("c"):
        raise _error(document, component, key, "not an array", "write <array><c>…</c>…</array>")
    return _floats(document, component, key, arrays[0].all("c"))


def _rows(document, component, key):
    matrices = _element(document, component, key).all("matrix")
    rows = matrices[0].all("r") if len(matrices) == 1 else []
    if not rows or any(len(row.all("c")) != 3 for row in rows):
        raise _error(document, component, key, "no matrix of three columns", "write <matrix><r><c>…</c>…</r></matrix>")
    return np.array([_floats(document, component, key, row.all("c")) for row in rows])


def _element(document, component, key):
    element = component.attributes.get(key)
    if element is None:
        raise _error(document, component, key, "is missing", "add it")
    unit, wanted = element.attributes.get("unit", ""), ATTRIBUTES[component.type][key][0]
    if unit != wanted:
        raise _error(document, component, key, f"unit {unit!r}", f"REXS has it in {wanted!r}: convert it")
    return element


def _floats(document, component, key, cells):
    try:
        values = np.array([float(cell.text) for cell in cells])
    except ValueError:
        values = np.array([np.nan])
    whole = not key.endswith("ids") or (values == np.round(values)).all()
    if not (np.isfinite(values).all() and whole):
        raise _error(document, component, key, "holds what is no number", "write finite numbers, and whole ones as ids")
    return values


def _error(document, component, key, reason, remedy):
    return RexsError(f"{document.place}, {component}, attribute {key}", reason, remedy)
