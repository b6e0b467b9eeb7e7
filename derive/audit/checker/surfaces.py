"""Surfaces of a description: points, normals, tangents, second forms, singular functions, margins."""

from collections.abc import Mapping

from .description import Reader, inner
from .drive import rate
from .modular import PRIME, Number, add, divide, multiply, root
from .refusal import require


class Surface:
    """A surface of the description at one input."""

    def __init__(self, reader: Reader, surface: dict, motion: list):
        self.reader, self.surface = reader, surface
        self.motion = [*motion, *surface["motion"]]
        self.point = reader.carried(self.motion, reader.vector(surface["point"]))

    @property
    def outward(self) -> list[Number]:
        """A normal of any length."""
        return self.reader.carried(self.motion, self.reader.vector(self.surface["normal"]), free=True)

    @property
    def normal(self) -> list[Number]:
        return unit(self.outward)

    def tangents(self, places: Mapping[str, int]) -> list[list[Number]]:
        """Derivatives of the point by the surface's parameters."""
        return [[rate(number, places[q["name"]]) for number in self.point] for q in self.surface["parameters"]]

    def slopes(self, places: Mapping[str, int]) -> list[list[Number]]:
        """Derivatives of each implicit condition by the surface's parameters."""
        conditions = map(self.reader, self.surface["conditions"])
        return [[rate(c, places[q["name"]]) for q in self.surface["parameters"]] for c in conditions]

    def second_form(self, places: Mapping[str, int], basis: list[list[Number]]) -> list[Number]:
        """(II11, II12, II22) with [II l] [tangents; slopes] = -(changes of the normal), solved for its rows."""
        outward = self.outward
        length = root(inner(outward, outward))
        turned = [[rate(n, places[q["name"]]) for n in outward] for q in self.surface["parameters"]]
        tangents, slopes = self.tangents(places), self.slopes(places)
        lines = [[*(inner(e, t) for e in basis), *(s[k] for s in slopes)] for k, t in enumerate(tangents)]
        (a, b), (c, d) = (solved(lines, [divide(inner(e, change), length) for change in turned])[:2] for e in basis)
        half = pow(2, -1, PRIME)
        return [Number(-a % PRIME), Number(-half * (b + c) % PRIME), Number(-d % PRIME)]


def unit(vector: list[Number]) -> list[Number]:
    length = root(inner(vector, vector))
    return [divide(component, length) for component in vector]


def cross(a: list[Number], b: list[Number]) -> list[Number]:
    return [add(multiply(a[i], b[j]), multiply(a[j], b[i]), -1) for i, j in ((1, 2), (2, 0), (0, 1))]


def solved(lines: list[list[Number]], right: list[Number]) -> list[int]:
    """Solution of a small linear system modulo the prime (Gauss, Jordan)."""
    rows = [[*(n.value for n in line), r.value] for line, r in zip(lines, right, strict=True)]
    for k in range(len(rows)):
        pivot = next((i for i in range(k, len(rows)) if rows[i][k] % PRIME), None)
        require(pivot is not None, "a singular system")
        rows[k], rows[pivot] = rows[pivot], rows[k]
        inverse = pow(rows[k][k], -1, PRIME)
        rows[k] = [entry * inverse % PRIME for entry in rows[k]]
        for i, row in enumerate(rows):
            if i != k and row[k]:
                rows[i] = [(p - row[k] * q) % PRIME for p, q in zip(row, rows[k], strict=True)]
    return [row[-1] for row in rows]


def determinant(rows: list[list[Number]]) -> Number:
    """By the first row."""
    if len(rows) == 1:
        return rows[0][0]
    total = Number(0)
    for k, entry in enumerate(rows[0]):
        minor = determinant([row[:k] + row[k + 1 :] for row in rows[1:]])
        total = add(total, multiply(entry, minor), -1 if k % 2 else 1)
    return total


def singular(surface: Surface, places: Mapping[str, int]) -> Number:
    """Zero where the directions that keep the conditions fall together: the determinant of the slopes and of the
    normal's triple products, expanded by pairs of parameters (Laplace).
    """
    normal, tangents, slopes = surface.outward, surface.tangents(places), surface.slopes(places)
    total = Number(0)
    for a in range(len(tangents)):
        for b in range(a + 1, len(tangents)):
            others = [k for k in range(len(tangents)) if k not in (a, b)]
            odd = sum(o > p for o in others for p in (a, b)) % 2
            term = inner(normal, cross(tangents[a], tangents[b]))
            if slopes:
                term = multiply(term, determinant([[row[k] for k in others] for row in slopes]))
            total = add(total, term, -1 if odd else 1)
    return total


def at_reference(reader: Reader, entry: dict) -> Reader:
    """The same at the body's reference point; what is differentiated by a parameter still is."""
    there = {}
    for symbol, value in entry["reference"].items():
        number = reader(value)
        there[symbol] = Number(number.value, reader.values[symbol].rates, number.form)
    return reader.at(there)


def regular_of(reader: Reader, entry: dict, places: Mapping[str, int]) -> Number:
    """The singular function with its good sign, or divided by its value at the reference point."""
    here = singular(Surface(reader, entry["surface"], []), places)
    if entry["regular"] is not None:
        return multiply(reader(entry["regular"]), here)
    return divide(here, singular(Surface(at_reference(reader, entry), entry["surface"], []), places))


def tangent_basis(normal: list[Number], tangent: list[Number]) -> list[list[Number]]:
    along = inner(tangent, normal)
    first = unit([add(t, multiply(along, n), -1) for t, n in zip(tangent, normal, strict=True)])
    return [first, cross(normal, first)]


def margin_of(reader: Reader, margin: dict, entry: dict, places: dict[str, int]) -> Number:
    """Value of a margin; coordinates of its body stand for the surface's own point."""

    def at(values: Reader) -> Number:
        names = entry.get("coordinates") or []
        if names:
            local = Surface(values, entry["surface"], []).point
            values = values.at(dict(zip(names, local, strict=True)))
        number = values(margin["positive"])
        return number if margin["along"] is None else rate(number, places[margin["along"]])

    if not margin["relative"]:
        return at(reader)
    return divide(at(reader), at(at_reference(reader, entry)))
