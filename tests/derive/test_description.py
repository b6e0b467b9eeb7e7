"""The description as data: an evaluator of some lines, which knows nothing of our Python, finds the same contact."""

import json
import math
from dataclasses import fields
from functools import reduce
from pathlib import Path

import mpmath
import pytest

from derive import drives
from derive.language.description import describe, prefix, text
from derive.language.drive import Drive
from derive.passes.sample import observation
from derive.passes.schedule import schedule

mp = mpmath.mp
ROOT = Path(__file__).parents[2]
NAMES = ("cylindrical_worm_zk_zn", "cylindrical_worm_zi_zi", "spherical_convex_concave", "face_worm")

OPERATIONS = {
    "+": lambda *a: sum(a),
    "*": lambda *a: reduce(lambda x, y: x * y, a),
    "/": lambda p, q: mpmath.mpf(p) / q,
    "^": lambda x, n: mpmath.mpf(x) ** n,
    "pi": lambda: +mpmath.pi,
    "abs": abs,
    "min": min,
    "max": max,
    "sqrt": mpmath.sqrt,
    **{name: getattr(mpmath, name) for name in ("sin", "cos", "tan", "asin", "acos", "atan", "atan2")},
}
#: The program's π is the double nearest to it: as near as it comes to the description, mm.
PROGRAM = 1e-14

OTHERS = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}


class Reader:
    """Numbers of a description at given values of its symbols; definitions are evaluated as they are needed."""

    def __init__(self, description, values):
        self.values = dict(values)
        self.named = {entry["name"]: entry["value"] for entry in description["definitions"]}

    def __call__(self, e):
        if isinstance(e, list):
            return OPERATIONS[e[0]](*map(self, e[1:]))
        if not isinstance(e, str):
            return mpmath.mpf(e)
        if e not in self.values:
            self.values[e] = self(self.named[e])
        return self.values[e]

    def vector(self, es):
        return [self(e) for e in es]

    def moved(self, motion, point, free=False):
        """A point, or a free vector, carried by a motion, its rightmost factor first."""
        for kind, *data in reversed(motion):
            match kind:
                case "rotation":
                    point = self._turned(data[0], self(data[1]), point)
                case "swing":
                    centre = [0, 0, 0] if free else self.vector(data[2])
                    arm = [a - c for a, c in zip(point, centre, strict=True)]
                    point = [c + a for a, c in zip(self._turned(data[0], self(data[1]), arm), centre, strict=True)]
                case "translation" | "station":
                    point = point if free else [a + b for a, b in zip(point, self.vector(data[0]), strict=True)]
                case "placement":
                    columns = [self.vector(c) for c in data[0]]
                    point = [sum(a * c[i] for a, c in zip(point, columns, strict=True)) for i in range(3)]
        return point

    def _turned(self, axis, angle, a):
        i, j = OTHERS[axis]
        out = list(a)
        out[i] = mpmath.cos(angle) * a[i] - mpmath.sin(angle) * a[j]
        out[j] = mpmath.sin(angle) * a[i] + mpmath.cos(angle) * a[j]
        return out


@pytest.fixture(scope="module", params=NAMES)
def solved(request):
    drive = drives.catalogue([request.param])[request.param]()
    plan = schedule(drive)
    with mpmath.workdps(40):
        observed = observation(plan)
        values = {symbol.name: value for symbol, value in plan.sample.items() if symbol.name != "ratio"}
    return json.loads(text(drive)), values, observed


def test_both_flanks_carried_by_their_chains_meet_in_the_sample_contact(solved):
    """The tool's curve or surface, its steps and the assembly, from the data alone; no envelope but its motion."""
    description, values, observed = solved
    with mpmath.workdps(40):
        read = Reader(description, values)
        for body in description["bodies"]:
            point = read.moved(body["motion"], _made(read, body["surface"]["made"]))
            assert _distance(point, observed[f"point_{body['name']}_f"]) < PROGRAM
        assert max(map(abs, read.vector(description["contact"]["residual"]))) < PROGRAM


def _made(read, steps):
    """The body-frame point: the curve or surface at the start, then every motion in order."""
    point = None
    for step in steps:
        match step["step"]:
            case "swept":
                point = read.moved(step["motion"], read.vector(step["curve"]))
            case "given":
                point = read.moved(step["motion"], read.vector(step["point"]))
            case "envelope" | "moved":
                point = read.moved(step["motion"], point)
            case "merged":
                kept, total = read(step["kept"]), read(step["total"])
                assert abs(read(step["removed"]) - (total - kept)) < 1e-25
            case "solved":
                assert abs(read(step["value"]) - read(step["parameter"])) < 1e-25
    return point


def test_the_envelope_is_where_the_moving_surface_touches_it(solved):
    """n·∂r/∂φ = 0 by differences of the chain in 40 digits: the equation of meshing, derived without ours."""
    description, values, _ = solved
    checked = 0
    with mpmath.workdps(40):
        for body in description["bodies"]:
            steps = body["surface"]["made"]
            for at, step in enumerate(steps):
                last = len(steps) == at + 1 + _after(steps, at)
                if step["step"] != "envelope" or steps[at - 1]["step"] != "swept" or not last:
                    continue
                read = Reader(description, values)
                inner = steps[:at]
                normal = _swept_normal(description, read, inner[0])
                normal = read.moved(inner[0]["motion"], normal, free=True)
                point = _made(read, inner)
                angle = _variable(steps, at, read)
                h = mpmath.mpf(10) ** -13

                def carried(phi, step=step, point=point, read=read):
                    moving = Reader({"definitions": []}, read.values | {step["variable"]: phi})
                    moving.named = read.named
                    return moving.moved(step["motion"], point)

                turned = Reader({"definitions": []}, read.values | {step["variable"]: angle})
                turned.named = read.named
                ahead, behind = carried(angle + h), carried(angle - h)
                speed = [(a - b) / (2 * h) for a, b in zip(ahead, behind, strict=True)]
                outward = turned.moved(step["motion"], normal, free=True)
                power = sum(a * b for a, b in zip(speed, outward, strict=True))
                size = math.sqrt(sum(float(a) ** 2 for a in speed) * sum(float(a) ** 2 for a in outward))
                assert abs(power) < 1e-15 * size
                checked += 1
    assert checked or description["family"] == "face-worm"


def _after(steps, at):
    return len([s for s in steps[at + 1 :] if s["step"] in ("merged", "solved")])


def _variable(steps, at, read):
    """The generating angle at this point: given, or its value after the steps that removed it."""
    for step in steps[at + 1 :]:
        if step["step"] == "merged":
            return read(step["total"]) - read(step["kept"])
    return read(steps[at]["variable"])


def _swept_normal(description, read, step):
    """∂r/∂along × ∂r/∂sweep of a swept curve in its own frame, by differences."""
    h = mpmath.mpf(10) ** -13

    def point(name, change):
        moved = Reader(description, {k: v for k, v in read.values.items() if k not in read.named})
        moved.values[name] = read(name) + change
        for other in (step["along"], step["sweep"]):
            moved.values.setdefault(other, read(other))
        return moved.moved(step["motion"], moved.vector(step["curve"]))

    rows = []
    for name in (step["along"], step["sweep"]):
        rows.append([(a - b) / (2 * h) for a, b in zip(point(name, h), point(name, -h), strict=True)])
    (a, b, c), (d, e, f) = rows
    outward = [b * f - c * e, c * d - a * f, a * e - b * d]
    return _undone(Reader(description, read.values), step["motion"], outward)


def _undone(read, motion, vector):
    """A free vector carried back by a motion."""
    columns = [read.moved(motion, [mpmath.mpf(i == k) for i in range(3)], free=True) for k in range(3)]
    return [sum(a * b for a, b in zip(column, vector, strict=True)) for column in columns]


def _distance(a, b):
    return math.sqrt(sum(float(p - q) ** 2 for p, q in zip(a, b, strict=True)))


def test_numbers_are_exact_and_floating_ones_are_refused():
    import sympy as sp

    x = sp.Symbol("x")
    assert prefix(sp.Rational(1, 3) * sp.sqrt(x)) == ["*", ["/", 1, 3], ["sqrt", "x"]]
    assert prefix(sp.atan2(x, 2)) == ["atan2", "x", 2]
    with pytest.raises(TypeError, match="exact"):
        prefix(sp.Float("0.1") * x)


def test_every_generated_description_is_plain_data_with_sources():
    drive = drives.catalogue(["spherical_spur_spur"])["spherical_spur_spur"]()
    data = describe(drive)
    assert json.loads(text(drive)) == json.loads(json.dumps(data))
    assert data["sources"] and all(s["author"] and s["title"] and s["year"] for s in data["sources"])
    roles = {m["role"] for part in (*data["bodies"], *data["regions"]) for m in part["margins"]}
    assert {"tip", "face", "junction", "bottom"} <= roles
    parities = {q["name"]: q["parity"] for q in [data["contact"]["instant"], *data["contact"]["unknowns"]]}
    assert parities["phi_pinion"] == parities["transmission_error"] == -1
    assert parities["l_pinion"] == 1


def test_all_that_a_drive_has_is_in_its_description():
    """By the same name, or as a part of another entry; the two that a family shares are in the table of families."""
    parts = {
        "parameters": "keys", "systems": "design_systems", "pinion": "bodies", "wheel": "bodies", "guess": "start",
    }  # fmt: skip
    of_contact = ("instant", "error", "ratio", "wheel_angle", "unknowns", "residual", "reference_angle")
    parts |= dict.fromkeys(of_contact, "contact")
    described = describe(drives.catalogue(["face_worm"])["face_worm"]())
    shared = json.loads((ROOT / "generated" / "families.json").read_text(encoding="utf-8"))["families"]["face-worm"]
    for field in fields(Drive):
        assert parts.get(field.name, field.name) in {**described, **shared}, field.name
