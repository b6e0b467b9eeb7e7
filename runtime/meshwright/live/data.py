"""What the live page knows of a design beside its WebAssembly module: keys, names, words and the wheel's border."""

import math

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.library import library, text
from meshwright.base.plain import finite_or_none
from meshwright.contact import words
from meshwright.contact.analysis import flag_names
from meshwright.contact.results import impossible
from meshwright.cycle.transmission import ROUND_OFF
from meshwright.design.design import given_vector, is_real
from meshwright.design.schema import bounds
from meshwright.live.teeth import teeth

#: Positions of a mesh cycle.
POSITIONS = 200

#: Grid over the wheel flank whose border is drawn.
GRID = (21, 41)


def data(drive):
    """Plain data of the page for a :class:`~meshwright.drive.Drive`; lengths in mm, angles in rad unless named."""
    design, description = drive.design, drive.design.description
    given = given_vector(design)
    border, end_on = _wheel(drive)
    return {
        "drive": description["name"],
        "family": design.family,
        "title": description["title"],
        "name": design.tables.get("name") or "design",
        "label": design.label,
        "given": [finite_or_none(value) for value in given],
        "keys": [_key(k, p, design, given[k]) for k, p in enumerate(description["parameters"]) if _shown(p, given[k])],
        "fixed": _fixed(design),
        "above": _above(description),
        "sizes": description["sizes"],
        "unknowns": description["unknowns"],
        "error": description["error"],
        "wheel_angle": description["wheel_angle"],
        "reference": description["reference"],
        "separation": _index(description, "separation_mm"),
        "wheel_point": next(body["point"] for body in description["bodies"] if body["name"] == "wheel"),
        "placement": _offsets(description),
        "counts": {"parameters": len(given), "unknowns": len(description["unknowns"]),
                   "observation": description["shapes"]["o"][0]},
        "mirror": design.mirror.sign,
        "factors": [design.mirror.factor(u["name"]) for u in description["unknowns"]],
        "pitch": drive.pitch(),
        "from_reference": _from_reference(drive),
        "positions": POSITIONS,
        "round_off": ROUND_OFF,
        "guards": [*description["guards"], *description["missing"]],
        "systems": [{"message": s["message"], "keys": s["keys"]} for s in description["systems"]],
        "status": _status(),
        "flags": [{"name": name, "words": words.flag(name), "impossible": impossible(name)}
                  for name in flag_names(drive.model)],
        "equations": {name: description["equations_of"].get(name, []) for name in ("eval", "observe", "derive")},
        "sources": description["sources"],
        "teeth": teeth(drive),
        "coordinates": [len(body["parameters"]) for body in description["bodies"]],
        "border": border,
        "end_on": end_on,
    }  # fmt: skip


def _from_reference(drive):
    """How far the middle of the mesh cycle is from the reference angle, rad: 0 unless a pair touches elsewhere only."""
    window = drive.window
    if window.path is None or not window.complete:
        return 0.0
    low, high = (end - drive.design.reference_angle for end in window.bounds)
    return 0.0 if low < 0.0 < high else 0.5 * (low + high)


def _shown(parameter, given):
    """Real keys that the design gives, and every misalignment."""
    return is_real(parameter) and (math.isfinite(given) or parameter["table"] == "misalignment")


def _key(k, p, design, given):
    value = design.tables[p["table"]].get(p["key"]) if math.isfinite(given) else 0.0
    return {
        "index": k, "place": f"{p['table']}.{p['key']}", "key": p["key"], "table": p["table"],
        "meaning": p["meaning"], "unit": p["key_unit"], "factor": p["factor"], "value": float(value),
        "bounds": bounds(p),
    }  # fmt: skip


def _fixed(design):
    """Counts and choices that the design gives, which the page shows and does not vary."""
    listed = [("flank", design.tables["flank"])]
    for name, entries in design.tables.items():
        if isinstance(entries, dict):
            real = {p["key"] for p in design.description["parameters"] if p["table"] == name and is_real(p)}
            listed += [(f"{name}.{k}", v) for k, v in entries.items() if v is not None and k not in real]
    return [{"place": place, "value": value} for place, value in listed]


def _above(description):
    """Pairs of parameters of which the first must be greater than the second."""
    places = {(p["table"], p["key"]): k for k, p in enumerate(description["parameters"])}
    return [[k, places[p["table"], p["above"]]] for k, p in enumerate(description["parameters"]) if p["above"]]


def _index(description, key):
    return next(k for k, p in enumerate(description["parameters"]) if p["key"] == key)


def _offsets(description):
    """Where the wheel's motion and axis stand in what the function ``placement`` writes."""
    function = next(f for f in description["functions"] if f["name"] == "placement")
    return {output["name"]: output["offset"] for output in function["outputs"]}


def _status():
    c = library()
    codes = range(c.MW_BAD_INPUT, c.MW_LINE_CONTACT + 1)
    return {str(k): {"word": text(c.mw_status_word(k)), "words": text(c.mw_status_text(k))} for k in codes}


def _wheel(drive):
    """Border of the wheel flank as segments (…, 2, 2) in the picture, and whether that is seen along the axis."""
    try:
        grid = drive.surface("wheel", GRID)
    except UsageError:  # nothing within the limits of the design
        return [], False
    end_on = _seen_along_the_axis(grid.points, grid.normals)
    x, y, z = np.moveaxis(grid.mesh.points, -1, 0)
    flat = np.stack([x, y] if end_on else [z, np.hypot(x, y)], axis=-1)
    return np.round(flat[grid.mesh.border], 5).tolist(), end_on


def _seen_along_the_axis(points, normals):
    """Whether a flank (N, 3) is less foreshortened seen along its body's axis z than in the meridian plane."""
    turning = points[:, 0] * normals[:, 1] - points[:, 1] * normals[:, 0]
    meridian = np.abs(turning) / np.hypot(points[:, 0], points[:, 1])
    return bool(np.nanmean(np.abs(normals[:, 2])) > np.nanmean(meridian))
