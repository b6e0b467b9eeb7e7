"""What an engineer with CasADi and no compiler of gear meshing writes: the chain as matrices, derivatives by CasADi.

Everything comes from the description as data. The tool's curve or surface is carried by its motions, factor by factor.
Nothing is solved by hand: each angle of generation is an unknown beside the two parameters of the tool, with its
equation of meshing n · ∂r/∂ψ = 0. What depends on the design alone, sines of its angles too, is evaluated outside of
the solver, once, and handed to it: more than most would do, and to CasADi's favour.
"""

import json
import math
import operator
from functools import reduce

import casadi

OPERATIONS = {
    "+": lambda *a: sum(a),
    "*": lambda *a: reduce(operator.mul, a),
    "/": operator.truediv,
    "^": operator.pow,
    "pi": lambda: math.pi,
    "abs": casadi.fabs,
    "min": lambda *a: reduce(casadi.fmin, a),
    "max": lambda *a: reduce(casadi.fmax, a),
    "sign": lambda a: 1 - 2 * (a < 0),
    "unit_step": lambda a: a >= 0,
    "excess": lambda a: casadi.fmax(a, 0),
    **{name: getattr(casadi, name) for name in ("sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "atan2")},
}

#: Axis → the two that a rotation about it mixes, in their order.
MIXED = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}


class Reader:
    """Values of a description's expressions: numbers, or CasADi's where its names stand for such."""

    def __init__(self, named, values):
        self.named, self.values = named, dict(values)

    def __call__(self, e):
        if isinstance(e, int):
            return e
        if isinstance(e, str):
            if e not in self.values:
                self.values[e] = self(self.named[e])
            return self.values[e]
        return OPERATIONS[e[0]](*map(self, e[1:]))


class Chain:
    """Contact of a drive at one design: ``function`` (x, q) → residual, q the ``numbers`` of the design and the input
    angle at the end; ``names`` are what the unknowns x are called in the description.
    """

    def __init__(self, description, parameters):
        self.description = description
        self.named = {entry["name"]: entry["value"] for entry in description["definitions"]}
        keys = (key["symbol"]["name"] for key in description["keys"])
        self.design = dict(zip(keys, map(float, parameters), strict=True))
        self.evaluate = Reader(self.named, self.design)
        contact, steps = description["contact"], [s for b in description["bodies"] for s in b["surface"]["made"]]
        self.instant = contact["instant"]["name"]
        moving = [u["name"] for u in contact["unknowns"]]
        moving += [s[key] for s in steps for key in ("parameter", "kept", "removed") if key in s]
        self.read = Reader(self.named, {name: casadi.SX.sym(name) for name in (*moving, self.instant)})
        self.moving, self.hoisted = set(self.read.values), {}
        pinion, wheel = (self._surface(body) for body in description["bodies"])
        self.names = [*pinion["names"], *wheel["names"], contact["error"]]
        normal = casadi.cross(*wheel["tangents"])
        rows = [pinion["point"] - wheel["point"], *(casadi.dot(normal, t) for t in pinion["tangents"])]
        rows += [*pinion["conditions"], *wheel["conditions"]]
        symbols, numbers = zip(*self.hoisted.values(), strict=True)
        self.numbers = list(numbers)
        x = casadi.vertcat(*(self.read(name) for name in self.names))
        q = casadi.vertcat(*symbols, self.read(self.instant))
        self.function = casadi.Function("g", [x, q], [casadi.vertcat(*rows)])

    def start(self, phi, x):
        """The unknowns where the description's own, of which it solved some, are ``x`` at the input angle ``phi``."""
        unknowns = [u["name"] for u in self.description["contact"]["unknowns"]]
        read = Reader(self.named, self.design | {self.instant: phi} | dict(zip(unknowns, map(float, x), strict=True)))
        for body in self.description["bodies"]:
            for step in body["surface"]["made"]:
                if step["step"] == "merged":
                    read.values[step["removed"]] = read(step["total"]) - read(step["kept"])
        return [float(read(name)) for name in self.names]

    def _surface(self, body):
        """Point and tangents of the tool's surface in mesh, equations of meshing, and what it has for parameters."""
        first, *steps = body["surface"]["made"]
        point = self._carried(first["motion"], self._vector(first.get("curve") or first["point"]))
        names = [first["along"], first["sweep"]] if "along" in first else sorted(self._names(first) & self.moving)
        for step in steps:
            if "motion" in step:
                point = self._carried(step["motion"], point)
            if step["step"] == "envelope" and step["variable"] not in names:
                names.append(step["variable"])
        slopes = casadi.horzsplit(casadi.jacobian(point, casadi.vertcat(*map(self.read, names))))
        normal = casadi.cross(*slopes[:2])
        return {
            "names": names,
            "point": self._carried(body["motion"], point),
            "tangents": [self._carried(body["motion"], t, free=True) for t in slopes[:2]],
            "conditions": [casadi.dot(normal, slope) for slope in slopes[2:]],
        }

    def _carried(self, motion, vector, free=False):
        """A point, or a free vector, multiplied by the motion's matrices, its last factor first."""
        for kind, *data in reversed(motion):
            turn, centre, offset = casadi.SX.eye(3), casadi.SX(3, 1), casadi.SX(3, 1)
            match kind:
                case "rotation":
                    turn = self._rotation(*data)
                case "swing":
                    turn, centre = self._rotation(*data[:2]), self._vector(data[2])
                case "translation" | "station":
                    offset = self._vector(data[0])
                case "placement":
                    turn = casadi.horzcat(*map(self._vector, data[0]))
            vector = turn @ vector if free else centre + offset + turn @ (vector - centre)
        return vector

    def _rotation(self, axis, angle):
        turn, cosine, sine = casadi.SX.eye(3), self._value(["cos", angle]), self._value(["sin", angle])
        i, j = MIXED[axis]
        turn[i, i], turn[i, j], turn[j, i], turn[j, j] = cosine, -sine, sine, cosine
        return turn

    def _vector(self, components):
        return casadi.vertcat(*map(self._value, components))

    def _value(self, e):
        """An expression of the solver; the parts of it that depend on the design alone are numbers handed to it."""
        names = self._names(e)
        if not names & self.moving:
            return self._number(e) if names else self.evaluate(e)
        if isinstance(e, str):
            if e not in self.read.values:
                self.read.values[e] = self._value(self.named[e])
            return self.read.values[e]
        operation, *operands = e
        if operation in ("+", "*"):
            fixed = [o for o in operands if not self._names(o) & self.moving]
            operands = [o for o in operands if o not in fixed] + ([[operation, *fixed]] if fixed else [])
        return OPERATIONS[operation](*map(self._value, operands))

    def _number(self, e):
        entry = self.hoisted.setdefault(json.dumps(e), (casadi.SX.sym("d"), float(self.evaluate(e))))
        return entry[0]

    def _names(self, e):
        """Names in an expression and in the definitions that it uses; a solved parameter is an unknown here."""
        if isinstance(e, str):
            deeper = e in self.named and e not in self.moving
            return {e} | (self._names(self.named[e]) if deeper else set())
        if isinstance(e, dict):
            e = ["", *e.values()]
        return set().union(*map(self._names, e[1:])) if isinstance(e, list) else set()
