"""Laws of enveloping: points made by chains, normals at right angles to the motion, contact, slopes."""

from collections.abc import Iterator
from random import Random

from .described import Described
from .description import Reader, inner, names_in
from .drive import rate
from .modular import PRIME, Number, add
from .refusal import Rejected, require
from .surfaces import Surface, cross


def chain_of(entry: dict) -> tuple[list, list, list[str]]:
    """Edge or given point, the whole motion that carries it, and the variables of its generating motions."""
    first, *steps = entry["surface"]["made"]
    motion, variables = list(first["motion"]), []
    for step in steps:
        if step["step"] in ("moved", "envelope"):
            motion = [*step["motion"], *motion]
        if step["step"] == "envelope":
            variables.append(step["variable"])
    return first.get("curve") or first["point"], motion, variables


def merged(drive: Described, entry: dict, reader: Reader) -> Reader:
    """With what a sum of two angles leaves for the one that it replaced."""
    for step in entry["surface"]["made"]:
        if step["step"] == "merged" and step["removed"] not in drive.named:
            reader = reader.at({step["removed"]: add(reader(step["total"]), reader(step["kept"]), -1)})
    return reader


def check_made(drive: Described, place: str, rng: Random) -> None:
    """The surface's point is the edge carried by its chain."""
    entry = drive.entries[place]
    reader = merged(drive, entry, drive.reader(rng))
    edge, motion, _ = chain_of(entry)
    found = Surface(reader, entry["surface"], []).point
    expected = reader.carried(motion, reader.vector(edge))
    for a, b in zip(found, expected, strict=True):
        require((a.value - b.value) % PRIME == 0, f"{place}: the point is not the edge carried by its chain")


def check_enveloping(drive: Described, place: str, rng: Random) -> None:
    """n . dr is zero along every parameter of the tool and of the generating motions, or is the condition that is left
    (power of the normal on the blank, which moves against the tool).
    """
    entry = drive.entries[place]
    edge, motion, variables = chain_of(entry)
    steps = entry["surface"]["made"]
    parameters = {q["name"] for q in entry["surface"]["parameters"]} | set(variables)
    parameters |= {step["parameter"] for step in steps if step["step"] == "solved"}
    parameters |= {step["kept"] for step in steps if step["step"] == "merged"}
    along = sorted(parameters & names_in(["", *edge, *names_of(motion)], {}))
    solved = merged(drive, entry, drive.reader(rng))
    normal = Surface(solved, entry["surface"], []).outward
    here = {name: solved(name) for name in along}
    moving = solved.at({
        name: Number(number.value, tuple(int(name == other) for other in along), number.form)
        for name, number in here.items()
    })  # fmt: skip
    point = moving.carried(motion, moving.vector(edge))
    left = [] if steps[-1]["step"] == "solved" else [solved(c).value for c in entry["surface"]["conditions"]]
    for k, name in enumerate(along):
        found = inner(normal, [rate(p, k) for p in point]).value
        expected = left[0] if left and name in variables else 0
        require(
            (found + expected) % PRIME == 0,
            f"{place}: the normal against the motion along {name} is not {'the condition' if expected else 'zero'}",
        )


def names_of(motion: list) -> list[object]:
    """What stands in a motion, as one expression a factor."""
    return [flattened(data) for _, *data in motion]


def flattened(data: object) -> object:
    """Nested lists of expressions as one."""
    return ["", *map(flattened, data)] if isinstance(data, list) else data


def check_contact(drive: Described, rng: Random) -> None:
    """Distance of the placed points, and one flank's normal against two directions in the other's tangent plane."""
    try:
        check_tangency(drive, *drive.description["bodies"], rng)
    except Rejected:
        check_tangency(drive, *reversed(drive.description["bodies"]), rng)


def check_tangency(drive: Described, plane: dict, other: dict, rng: Random) -> None:
    described, reader = drive.description, drive.reader(rng)
    first, second = (Surface(reader, body["surface"], body["motion"]) for body in (plane, other))
    residual = [reader(row) for row in described["contact"]["residual"]]
    apart = [add(a, b, -1) for a, b in zip(first.point, second.point, strict=True)]
    require(
        (inner(apart, apart).value - inner(residual[:3], residual[:3]).value) % PRIME == 0,
        "contact: the first three rows are not the distance of the points",
    )
    tangents = [reader.carried(first.motion, reader.vector(t), free=True) for t in plane["surface"]["tangents"][:2]]
    require(any(n.value for n in cross(*tangents)), "contact: the two directions are one")
    for row, tangent in zip(residual[3:5], tangents, strict=True):
        require(inner(first.outward, tangent).value == 0, "contact: a direction is not in the tangent plane")
        require(
            (row.value - inner(second.outward, tangent).value) % PRIME == 0,
            "contact: a row is not one normal against a tangent of the other",
        )


def slopes_of(drive: Described) -> Iterator[tuple[str, str, str]]:
    """Definitions named after another and one of the surfaces' parameters."""
    symbols = {q["name"] for entry in drive.entries.values() for q in entry["surface"]["parameters"]}
    for name in drive.named:
        for symbol in symbols:
            if name.endswith(f"_{symbol}") and name[: -len(symbol) - 1] in drive.named:
                yield name, name[: -len(symbol) - 1], symbol


def check_slope(drive: Described, name: str, of: str, symbol: str, rng: Random) -> None:
    reader = drive.reader(rng, (symbol,))
    number = reader(drive.named[of])
    require(
        (reader(drive.named[name]).value - rate(number, 0).value) % PRIME == 0,
        f"{name} is not the derivative of {of}",
    )
