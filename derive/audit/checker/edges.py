"""Edge contact, and limits and surfaces beyond first order."""

import re
from collections.abc import Iterator
from itertools import combinations_with_replacement, product
from random import Random

from .description import inner
from .drive import Drive, rate, read, same
from .machine import Machine
from .modular import Number, add, multiply
from .refusal import require
from .straight_line import Function
from .surfaces import Surface, determinant, margin_of

#: Margins beyond which a flank ends in a convex edge.
EDGES = ("tip", "throat", "face")


class BoundedDrive(Drive):
    """A drive with the header of its bounded flanks."""

    def __init__(self, description: dict, text: str, bounded: str, tables: str = ""):
        super().__init__(description, text)
        self.bounded, self.tables = bounded, tables

    def _read(self, name: str) -> Function:
        text = self.text
        if f" {self.prefix}_{name}(" in self.bounded:
            self.text = self.bounded
        try:
            return super()._read(name)
        finally:
            self.text = text

    def edges_of(self, body: dict) -> list[int]:
        """Numbers of the margins that are edges."""
        return [
            k for k, m in enumerate(body["margins"]) if m["role"] in EDGES and m["along"] is None and not m["relative"]
        ]

    def surfaces(self) -> list[tuple[dict, str]]:
        """Flanks and regions with the names of their functions."""
        described = self.description
        flanks = [(body, f"flank_{body['name']}") for body in described["bodies"]]
        return flanks + [(region, f"{region['region']}_{region['member']}") for region in described["regions"]]


def check_edges(drive: BoundedDrive, rng: Random) -> None:
    """The equations, from the description."""
    run, reader = drive.run("edges", rng, "x", drive.unknowns)
    bodies = drive.description["bodies"]
    places = {name: k for k, name in enumerate(drive.unknowns)}
    placed = [Surface(reader, body["surface"], body["motion"]) for body in bodies]
    found = [run.value(f"R[{k}]") for k in range(count_of(drive))]
    apart = [add(a, b, -1) for a, b in zip(*(surface.point for surface in placed), strict=True)]
    same(inner(found[:3], found[:3]), inner(apart, apart), "edges: the distance")
    expected = [reader(condition) for body in bodies for condition in body["surface"]["conditions"]]
    listed = [(member, k) for member, body in enumerate(bodies) for k in drive.edges_of(body)]
    expected += [margin_of(reader, bodies[m]["margins"][k], bodies[m], places) for m, k in listed]
    expected += [tangency(reader, bodies[m], placed[m], placed[1 - m], k, places) for m, k in listed]
    require(len(found) == 3 + len(expected), "edges: another number of equations")
    for k, (a, b) in enumerate(zip(found[3:], expected, strict=True), 3):
        same(a, b, f"edges: R[{k}]")


def tangency(reader, body: dict, own: Surface, mate: Surface, number: int, places: dict[str, int]) -> Number:
    """The direction along which neither the margin nor a condition changes, against the mate's normal."""
    columns = [places[q["name"]] for q in body["surface"]["parameters"]]
    margin = margin_of(reader, body["margins"][number], body, places)
    rows = [margin, *map(reader, body["surface"]["conditions"])]
    slopes = [[rate(row, column) for column in columns] for row in rows]
    total = Number(0)
    for j, column in enumerate(columns):
        minor = determinant([[row[k] for k in range(len(columns)) if k != j] for row in slopes])
        along = inner(mate.outward, [rate(p, column) for p in own.point])
        total = add(total, multiply(minor, along), -1 if j % 2 else 1)
    return total


def count_of(drive: BoundedDrive) -> int:
    return int(re.search(rf"{drive.prefix}_EDGE_EQUATIONS = (\d+)", drive.bounded)[1])


def check_edge_slopes(drive: BoundedDrive, rng: Random) -> None:
    """J is the derivative of R, entry by entry."""
    run, _ = drive.run("edges", rng, "x", drive.unknowns)
    n = len(drive.unknowns)
    for i in range(count_of(drive)):
        row = run.value(f"R[{i}]")
        for j in range(n):
            same(run.value(f"J[{i * n + j}]"), rate(row, j), f"edges: J[{i}][{j}]")


def systems_of(drive: BoundedDrive) -> Iterator[tuple[str, tuple, list[int]]]:
    """Name, margins of pinion and wheel (-1: the flank itself), and equations of each system."""
    pinion, wheel = drive.description["bodies"]
    always = 3 + sum(len(body["surface"]["conditions"]) for body in (pinion, wheel))
    listed = [(body, k) for body in (pinion, wheel) for k in drive.edges_of(body)]
    place = {(body["name"], k): always + i for i, (body, k) in enumerate(listed)}

    def name(body: dict, k: int) -> str:
        return f"{body['name']}_{body['margins'][k]['event']}"

    for body, k in listed:
        at = place[body["name"], k]
        margins = (k, -1) if body is pinion else (-1, k)
        yield name(body, k), margins, [*range(always), at, at + len(listed)]
    for i, j in product(drive.edges_of(pinion), drive.edges_of(wheel)):
        rows = [*range(always), place[pinion["name"], i], place[wheel["name"], j]]
        yield f"{name(pinion, i)}_{name(wheel, j)}", (i, j), rows


def check_systems(drive: BoundedDrive) -> None:
    """Which equations each system takes, and what the table says of it."""
    chosen = {
        name: [int(k) for k in numbers.split(",")]
        for name, numbers in re.findall(
            rf"{drive.prefix}_edge_(\w+)\(const double[^\n]*\n{{\n    static const int chosen\[\] = {{ ([\d, ]+) }};\n"
            rf"    {drive.prefix}_edges_chosen\(s, x, R, J, chosen\);\n}}",
            drive.bounded,
        )
    }
    table = re.findall(r"{ { (-?\d+), (-?\d+) }, " + drive.prefix + r"_edge_(\w+) }", drive.bounded)
    expected = list(systems_of(drive))
    require(chosen == {name: rows for name, _, rows in expected}, "edges: a system takes other equations")
    require(
        table == [(str(i), str(j), name) for name, (i, j), _ in expected], "edges: the table of systems is another one"
    )


def check_slopes(drive: BoundedDrive, entry: dict, name: str, rng: Random) -> None:
    """Slopes of limits, and second derivatives, from what the surface's own function computes."""
    symbols = [q["name"] for q in entry["surface"]["parameters"]]
    run, _ = drive.run(name, rng, "q", symbols)
    limits = ["regular", *(f"margin_{m['event']}" for m in entry["margins"])]
    slopes = Machine(run.inputs, drive.function(f"slopes_{name}"), run.earlier, run.circle)
    n = len(symbols)
    for i, key in enumerate(limits):
        (limit,) = read(run, key)
        for j in range(n):
            same(slopes.value(f"o[{i * n + j}]"), rate(limit, j), f"slopes_{name}: {key} by {symbols[j]}")
    if f" {drive.prefix}_second_{name}(" not in drive.bounded:
        return
    second = Machine(run.inputs, drive.function(f"second_{name}"), run.earlier, run.circle)
    tangents = [read(run, f"tangent_{symbol}") for symbol in symbols]
    first = [[tangent[k] for tangent in tangents] for k in range(3)]
    first += [[slopes.value(f"o[{i * n + j}]") for j in range(n)] for i in range(len(limits))]
    first += [read(run, f"condition_{k}_slopes") for k in range(len(entry["surface"]["conditions"]))]
    at = 0
    for i, row in enumerate(first):
        for a, b in combinations_with_replacement(range(n), 2):
            same(second.value(f"o[{at}]"), rate(row[a], b), f"second_{name}: o[{at}] ({i} by {a}, {b})")
            at += 1
