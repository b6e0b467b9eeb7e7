"""A description at random values of all that it does not define."""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction
from random import Random

from .description import FUNCTIONS, Reader, literal
from .draws import once
from .drive import rate
from .machine import Circle, Machine, axes
from .modular import PRIME, Number, add, multiply
from .straight_line import Function
from .surfaces import Surface


class Described:
    """A description beside random values of all that it does not define."""

    def __init__(self, description: dict):
        self.description = description
        self.named = {entry["name"]: entry["value"] for entry in description["definitions"]}
        self.parameters = [key["symbol"]["name"] for key in description["keys"]]
        self.entries = {body["name"]: body for body in description["bodies"]} | {
            f"{region['member']}/{region['region']}": region for region in description["regions"]
        }
        self.said = dict(said_of(description))

    def reader(self, rng: Random, along: tuple[str, ...] = (), free: tuple[str, ...] = ()) -> Reader:
        """Values of one draw, with rates along some symbols; ``free`` are drawn although they are defined."""

        def drawn(name: str) -> Number:
            if name == self.parameters[0]:
                return Number(rng.choice((1, PRIME - 1)))
            value = once(rng, ("value", name), lambda: rng.randrange(1, PRIME))
            return Number(value, tuple(int(name == other) for other in along), {name: Fraction(1)})

        def made() -> Reader:
            circle = once(rng, "circle", lambda: Circle(rng, True))
            run = Machine({}, Function("description", {}, {}), None, circle)
            named = {name: value for name, value in self.named.items() if name not in (*along, *free)}
            entries = {name.replace("/", "_"): entry for name, entry in self.entries.items()}
            return Open(named, once(rng, "axes", lambda: axes_of(self.parameters, circle)), run, drawn, entries)

        return once(rng, ("described", along, free), made)


def axes_of(parameters: list[str], circle: object) -> dict[str, Number]:
    """Parameters that are the components of the axes of a placed frame, `xg_x` to `zg_z`: a random rotation."""
    frames = [p[:-3] for p in parameters if p.startswith("xg") and p.endswith("_x")]
    names = [tuple(f"{axis}g_{part}" for axis in "xyz" for part in "xyz")] if frames else []
    return {key: Number(value) for key, value in axes(tuple(names), circle).items()}


class Open(Reader):
    """A reader that draws what is not defined, and knows surfaces, substitutions and derivatives.

    ``r_of_wheel_x``, ``n_of_wheel_x``: point and unit normal of a surface in its body's frame; ``f_of_wheel``: its
    condition; ``at(e, name, value, …)``: an expression at other values; ``d(e, name)``: its derivative.
    """

    def __init__(self, named: dict, values: dict, run: object, draw: object, entries: dict):
        super().__init__(named, values, run)
        self.draw, self.entries = draw, entries

    def at(self, values: dict) -> Open:
        there = super().at(values)
        return Open(there.named, there.values, self.run, self.draw, self.entries)

    def __call__(self, e: object) -> Number:
        match e:
            case ["at", inside, *pairs]:
                return self.at({pairs[k]: self(pairs[k + 1]) for k in range(0, len(pairs), 2)})(inside)
            case ["min", first, *others]:
                least = self(first)
                for other in map(self, others):
                    apart = FUNCTIONS["abs"](self.run, add(least, other, -1))
                    least = multiply(HALF, add(add(least, other), apart, -1))
                return least
            case ["d", inside, str() as name]:
                here = self(name)
                return rate(self.at({name: Number(here.value, (1,), here.form)})(inside), 0)
        return super().__call__(e)

    def _defined(self, name: str) -> Number:
        if name in self.named:
            return super()._defined(name)
        of = OF.fullmatch(name)
        if of and of[2] in self.entries:
            surface = Surface(self, self.entries[of[2]]["surface"], [])
            if of[1] == "f":
                return self(surface.surface["conditions"][0])
            return (surface.point if of[1] == "r" else surface.normal)["xyz".index(of[3])]
        self.values[name] = self.draw(name)
        return self.values[name]


HALF = literal(Fraction(1, 2))
OF = re.compile(r"([rnf])_of_(\w+?)(?:_([xyz]))?")


def said_of(d: dict) -> Iterator[tuple[tuple[str, ...], object]]:
    """Every entry of a description that a statement can be about, and its value. Which curves, motions, rules and
    normals there are follows here too; their own subjects read them.
    """
    places: dict[tuple[str, str], int] = {}
    rules = [(key["symbol"]["name"], key["default"]) for key in d["keys"] if key["default"] is not None]
    for kind, listed in (("rule", [*rules, *d["rules"]]), ("proportion", d["proportions"])):
        for target, value in listed:
            places[kind, target] = places.get((kind, target), 0) + 1
            yield (kind, target, str(places[kind, target])), value
    for k, guard in enumerate(d["guards"], 1):
        yield ("guard", str(k)), guard["positive"]
    for size in d["sizes"]:
        yield ("size", size["key"]), size["value"]
    for entry in (*d["bodies"], *d["regions"]):
        yield from said_of_surface(entry)
    for key in ("ratio", "wheel_angle", "reference_angle"):
        yield ("contact", key), d["contact"][key]
    for unknown in d["contact"]["unknowns"]:
        yield ("scale", unknown["name"]), unknown["scale"]
    start = d["start"]
    for name, value in start["solution"].items():
        yield ("start", name), value
    systems = [("start", start), *((system["name"], system) for system in d["design_systems"])]
    for name, system in systems:
        for unknown in system["unknowns"]:
            yield ("scale", name, unknown["name"]), unknown["scale"]
        for k, row in enumerate(system["residual"], 1):
            yield ("equation", name, str(k)), row
        for key in ("guess", "fills", "fixed"):
            for symbol, value in system.get(key, {}).items():
                yield (key, name, symbol), value
        if system.get("regular"):
            yield ("regular", name), system["regular"]["sign"]
    for function in d["functions"]:
        for result in function["results"]:
            values = result["values"]
            yield ("function", function["name"], result["name"]), values if len(values) > 1 else values[0]


def said_of_surface(entry: dict) -> Iterator[tuple[tuple[str, ...], object]]:
    name = entry.get("name") or f"{entry['member']}/{entry['region']}"
    if "motion" in entry:
        yield ("motion", name), None
    for kind in ("curve", "sweep", "normal"):
        yield (kind, name), None
    if any(step["step"] == "envelope" for step in entry["surface"]["made"]):
        yield ("generation", name), None
    for margin in entry["margins"]:
        along = margin["along"]
        kind = ("margin", name, margin["event"]) if along is None else ("growth", name, margin["event"], along)
        yield kind, margin["positive"]
    if entry["regular"] is not None:
        yield ("regular", name), entry["regular"]
    for symbol, value in entry.get("reference", {}).items():
        yield ("reference", name, symbol), value
    for k, condition in enumerate(entry["surface"]["conditions"], 1):
        yield ("condition", name, str(k)), condition
