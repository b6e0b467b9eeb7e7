"""Designs from drawings: named sizes, completed by the relations that their family declares.

Given sizes stay as they are. A relation with one open size derives it; where nothing moves, the family's next default
is assumed; a relation without open sizes is a check. Nothing here knows a key by its name.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from itertools import combinations
from typing import Any

from meshwright.base.errors import DesignError
from meshwright.base.expression import names, text, value
from meshwright.base.roots import bracketed

#: By how much two values of a size may differ: mm (half a micrometre), rad (a thousandth of a degree), a number.
TOLERANCES = {"mm": 0.5e-3, "rad": math.radians(0.001)}
TOLERANCE = 1e-6

#: Of a root, in its own unit.
RESOLUTION = 1e-15

#: Sets of sizes that a message offers at most, and sizes in each.
OFFERED = 4
TOGETHER = 2

#: Numbers that are no double, or lead to some, are left to the checks of their keys.
LARGEST = 1e300

#: Where the value of a size comes from.
GIVEN = "given"
DERIVED = "derived"
ASSUMED = "assumed"


@dataclass(frozen=True)
class Known:
    """A size: its ``value`` in inner units, where it is from, the relation or the reason, and the given sizes in which
    it ends.
    """

    value: float
    provenance: str
    by: Relation | str = ""
    ends: frozenset[str] = frozenset()

    def why(self, name: str) -> str:
        """The relation that gives the size of this name, or the reason for which it is assumed."""
        return self.by if isinstance(self.by, str) else self.by.text(name)


@dataclass(frozen=True)
class Relation:
    """Sizes of which any with a solution follows from the others; the first solution is what a check compares."""

    size: str
    solutions: dict[str, Any]

    @cached_property
    def sizes(self) -> frozenset[str]:
        """Every size of the relation."""
        return frozenset().union(*({name} | _read(solution) for name, solution in self.solutions.items()))

    def solved(self, name: str, symbols: Mapping[str, float]) -> float:
        """What a size is by the others; not a number where they do not determine it."""
        return _solved(self.solutions[name], symbols)

    def text(self, name: str) -> str:
        """The solution for a size, as an equation."""
        return _equation(self.solutions[name], name)


def _solved(solution: Any, symbols: Mapping[str, float]) -> float:
    """The value of an expression, or the root that is described."""
    if not isinstance(solution, dict):
        return value(solution, symbols)

    def residual(unknown: float) -> float:
        known = {**symbols, solution["unknown"]: unknown}
        for name, found in solution["where"]:
            known[name] = _solved(found, Symbols(known))
        return value(solution["residual"], Symbols(known))

    low, high = (value(end, symbols) for end in solution["between"])
    ends = residual(low), residual(high)
    return bracketed(residual, low, high, RESOLUTION, ends) if ends[0] * ends[1] <= 0.0 else math.nan


def _read(solution: Any) -> frozenset[str]:
    """The names in a solution that are none of its own."""
    if not isinstance(solution, dict):
        return names(solution)
    parts = [solution["residual"], *solution["between"]]
    read = [*map(names, parts), *(_read(found) for _, found in solution["where"])]
    return frozenset().union(*read) - {solution["unknown"], *(name for name, _ in solution["where"])}


def _equation(solution: Any, name: str) -> str:
    """A solution for a size as an equation."""
    if not isinstance(solution, dict):
        return f"{name} = {text(solution)}"
    where = "".join(f", {_equation(found, known)}" for known, found in solution["where"])
    return f"{text(solution['residual'])} = 0 for {solution['unknown']} = {name}" + (where and f" with{where[1:]}")


@dataclass(frozen=True, eq=False)
class Drawing:
    """The sizes, relations and defaults of a family as its table has them (``derive/emit/drawing.py``).

    ``parameters`` are the keys of its designs, which come first in the family's order, ``choosing`` the places of those
    that choose the drive.
    """

    table: dict[str, Any]
    parameters: list[dict[str, Any]]
    choosing: frozenset[str] = frozenset()

    @cached_property
    def listed(self) -> list[dict[str, Any]]:
        """Every key and size that a drawing states, in the family's order."""
        return [p for p in self.parameters if p["table"] in self.table["tables"]] + self.table["sizes"]

    @cached_property
    def places(self) -> dict[str, dict[str, Any]]:
        """Keys and sizes by "table.key"."""
        return {f"{p['table']}.{p['key']}": p for p in self.listed}

    @cached_property
    def relations(self) -> list[Relation]:
        return [Relation(**r) for r in self.table["relations"]]

    @cached_property
    def follow(self) -> set[str]:
        """Names of what relations or defaults may give."""
        return {name for r in self.relations for name in r.solutions} | {d["target"] for d in self.table["defaults"]}

    @cached_property
    def beside(self) -> set[str]:
        """Places of the sizes that are no keys of a design's own."""
        return {f"{p['table']}.{p['key']}" for p in self.table["sizes"]} - self.choosing

    def refused(self, tables: Mapping[str, Any]) -> DesignError | None:
        """The error for what raw tables say of a kind of drive that no drive of the family is; None where it is one."""
        here = [f"{place} = {shown}" for place, shown, other in self._families(tables) if not other]
        for place, shown, other in self._families(tables):
            if other and here:
                return DesignError(place, shown, f"contradicts {', '.join(here)}", "leave one of them out")
            if other:
                reason = f"{other['what']}: such drives are of the family {other['family']}"
                return DesignError(place, shown, reason, f'write drive = "{other["family"]}"')
        for place, shown, symbols in self._numbers(tables):
            key = place.partition(".")[2]
            for guard in self.table["guards"]:
                if key in guard["keys"] and value(guard["positive"], symbols) <= 0.0:
                    return DesignError(place, shown, guard["message"], f"change {key}")
        return None

    def other_family(self, tables: Mapping[str, Any]) -> str:
        """The other family of which a drive with these sizes, raw tables, is; "" where there is none."""
        found = ["" if other is None else str(other["family"]) for _, _, other in self._families(tables)]
        return found[0] if found and all(found) else ""

    def _families(self, tables: Mapping[str, Any]) -> Iterator[tuple[str, Any, dict[str, Any] | None]]:
        """Place and entry of each size given that decides of which family a drive is, and what says that it is not of
        this one.
        """
        for place, shown, symbols in self._numbers(tables):
            for entry in self.table["elsewhere"]:
                if names(entry["positive"]) <= symbols.keys():
                    yield place, shown, entry if value(entry["positive"], symbols) > 0.0 else None

    def _numbers(self, tables: Mapping[str, Any]) -> Iterator[tuple[str, Any, Symbols]]:
        """Place and entry of each size that raw tables give, and its number in the inner unit, by name."""
        for place, size in self.places.items():
            table, _, key = place.partition(".")
            entries = tables.get(table)
            shown = entries.get(key) if isinstance(entries, dict) else None
            number = size["choices"].get(shown, shown) if isinstance(shown, str) else shown
            if isinstance(number, int | float) and abs(number) < LARGEST:
                yield place, shown, Symbols({size["name"]: number * size["factor"]})

    def converted(self, place: str) -> tuple[dict[str, Any], list[Relation]] | None:
        """What stands for another key, as inches for millimetres: its size, and the relations that lead to that key;
        None where it stands for none.
        """
        for c in self.table["conversions"]:
            other = place.removesuffix(c["ending"]) + c["of"]
            if not place.endswith(c["ending"]):
                continue
            size, relations = self.places.get(other), []
            if size is None and c["factor"] != 1.0:
                size, relations = self.converted(other) or (None, [])
            if size is not None:
                name, key = size["name"], place.partition(".")[2]
                relation = Relation(place, {place: ["*", c["times"], name], name: ["*", place, ["^", c["times"], -1]]})
                return size | {"key": key, "name": place, "factor": c["factor"]}, [relation, *relations]
        return None


class _ContradictionError(Exception):
    """A relation between known sizes that does not hold, and the given sizes in which these end."""

    def __init__(self, relation: Relation, ends: frozenset[str]):
        super().__init__(relation, ends)
        self.relation, self.ends = relation, ends


class Symbols(dict[str, float]):
    """Numbers by name; what is not known is not a number."""

    def __missing__(self, name: str) -> float:
        return math.nan


@dataclass
class Completion:
    """The sizes of a design that is given by some of them, by name."""

    drawing: Drawing
    given: dict[str, dict[str, Any]]  # name → size, with its value in the inner unit as "given"
    relations: list[Relation]
    judged: bool = True  # whether sizes that contradict each other are an error
    known: dict[str, Known] = field(default_factory=dict)
    usual: set[str] = field(default_factory=set)  # assumed as every design of the family is completed
    led: set[str] = field(default_factory=set)  # assumed because of a size that is given
    unsolved: dict[str, Relation] = field(default_factory=dict)  # size → relation that has no root for it

    @classmethod
    def of(cls, drawing: Drawing, entries: Mapping[str, Any], judged: bool = True) -> Completion:
        """Of values by "table.key", in the units of the keys; raises :class:`DesignError` where two contradict and that
        is ``judged``.
        """
        given, relations = {}, list(drawing.relations)
        for place, number in entries.items():
            size = drawing.places.get(place)
            if size is None:
                size, leading = drawing.converted(place) or (None, [])
                if size is None:
                    continue
                relations = [*leading, *relations]
            given[size["name"]] = size | {"place": place, "shown": number, "given": _inner(size, number)}
        completion = cls(drawing, given, relations, judged)
        completion.complete()
        return completion

    def complete(self) -> None:
        """Derive and assume what follows from the sizes given; raises :class:`DesignError` where two contradict."""
        self._begin()
        self.close()

    def _begin(self) -> None:
        self.known = {name: Known(size["given"], GIVEN, "", frozenset({name})) for name, size in self.given.items()}
        self.usual, self.led, self.unsolved = set(), set(), {}

    def _holds(self) -> bool:
        """Complete; whether no two sizes contradict, of which nothing else is asked."""
        self._begin()
        try:
            self._close()
        except _ContradictionError:
            return False
        return True

    def close(self) -> None:
        """Derive and assume what follows from the sizes known; raises :class:`DesignError` where two contradict."""
        try:
            self._close()
        except _ContradictionError as found:
            raise self._contradiction(found.ends, found.relation) from None

    def _close(self) -> None:
        self._symbols = Symbols({name: k.value for name, k in self.known.items()})
        waiting, defaults = list(self.relations), self.drawing.table["defaults"]
        while True:
            waiting = self._derive(waiting)
            if not self._assume(defaults):
                break

    def _derive(self, waiting: list[Relation]) -> list[Relation]:
        """Use every relation that has at most one open size, until none has; those that are left."""
        moved = True
        while moved:
            moved, left = False, []
            for r in waiting:
                opened = r.sizes - self.known.keys()
                if len(opened) > 1:
                    left.append(r)
                elif not opened:
                    self._check(r)
                    moved = True
                elif (name := next(iter(opened))) in r.solutions and math.isfinite(
                    number := r.solved(name, self._symbols)
                ):
                    self._know(name, number, DERIVED, r, r.sizes - {name})
                    moved = True
                elif name not in r.solutions:
                    left.append(r)
                elif isinstance(r.solutions[name], dict):
                    self.unsolved[name] = r
            waiting = left
        return waiting

    def _assume(self, defaults: list[dict[str, Any]]) -> bool:
        """Assume the first default that has a value."""
        for default in defaults:
            target = default["target"]
            needs, unless = ({*default[kind]} for kind in ("needs", "unless"))
            if target in self.known or not self.known.keys() >= needs or self.given.keys() & unless:
                continue
            number = value(default["value"], self._symbols)
            if math.isfinite(number):
                integer = any(p["name"] == target and p["integer"] for p in self.drawing.listed)
                number = float(round(number)) if integer else number
                self._know(target, number, ASSUMED, default["why"], names(default["value"]))
                self.usual |= {target} if default["usual"] else set()
                own = any(p["name"] == target for p in self.drawing.parameters)
                self.led |= {target} if default["needs"] and own else set()
                return True
        return False

    def _know(self, name: str, number: float, provenance: str, by: Relation | str, of: Iterable[str]) -> None:
        ends = frozenset().union(*(self.known[q].ends for q in of))
        self.known[name] = Known(number, provenance, by, ends)
        self._symbols[name] = number

    def _check(self, r: Relation) -> None:
        """Whether a relation between sizes that are all known holds; it does where it does not apply."""
        if not self.judged:
            return
        theirs, own = r.solved(r.size, self._symbols), self.known[r.size].value
        unit = next((p["unit"] for p in [*self.given.values(), *self.drawing.listed] if p["name"] == r.size), "")
        if not math.isfinite(theirs) or abs(theirs - own) <= TOLERANCES.get(unit, TOLERANCE):
            return
        raise _ContradictionError(r, frozenset().union(*(self.known[name].ends for name in r.sizes)))

    def _contradiction(self, ends: frozenset[str], r: Relation) -> DesignError:
        """The error that names the given sizes which contradict: those that follow, differently, without themselves."""
        found = []
        for name in (name for name in self.given if name in ends):
            others = Completion(self.drawing, {n: s for n, s in self.given.items() if n != name}, self.relations)
            if not others._holds():
                continue
            if name in others.known and others.known[name].provenance == DERIVED:
                found.append((self.given[name], others.known[name].value, others.known[name].ends))
        size, number, others = found[0] if found else (self.given[min(ends)], math.nan, ends - {min(ends)})
        rest = [s for s, _, _ in found[1:]] or [s for n, s in self.given.items() if n in others]
        reason = "contradicts {}, ".format(", ".join(f"{s['place']} = {s['shown']}" for s in rest))
        if found:
            off = (size["given"] - number) / size["factor"]
            reason += f"by which it is {_outer(size, number)} (difference {off:.4g})"
        else:
            reason += f"by {r.text(r.size)}"
        return DesignError(size["place"], size["shown"], reason, "leave one of them out")

    def determined(self) -> dict[str, Any]:
        """Keys and sizes that follow from those given, by "table.key", in their units."""
        settled = (DERIVED, ASSUMED) if self.led else (DERIVED,)
        return {place: outer(p, known.value) for place, p, known in self._found() if known.provenance in settled}

    def assumed(self) -> dict[str, tuple[Any, str]]:
        """Keys and sizes that are assumed as drawings of the family are completed, with the reason."""
        found = [(place, p, known) for place, p, known in self._found() if known.provenance == ASSUMED]
        return {place: (outer(p, known.value), known.why(p["name"])) for place, p, known in found}

    def _found(self) -> Iterator[tuple[str, dict[str, Any], Known]]:
        """Place, size and value of what relations derive, or defaults assume that are not those of every design."""
        for place, p in self.drawing.places.items():
            known = self.known.get(p["name"])
            if known and known.provenance != GIVEN and p["name"] not in self.usual:
                yield place, p, known

    def unsound(self) -> DesignError | None:
        """The error for sizes that no drive of the family has together; None where there are none."""
        for guard in self.drawing.table["guards"]:
            if value(guard["positive"], self._symbols) <= 0.0:
                given = [s for s in self.given.values() if s["key"] in guard["keys"]]
                shown = [f"{s['place']} = {s['shown']}" for s in given[1:]]
                place, number = (given[0]["place"], given[0]["shown"]) if given else (guard["keys"][0], None)
                reason = guard["message"] + (f" (with {', '.join(shown)})" if shown else "")
                return DesignError(place, number, reason, f"change {' or '.join(guard['keys'])}")
        return None

    def open_ends(self, required: Iterable[str]) -> DesignError | None:
        """The error that names what would close the design: what is ``required`` and open, or is given and leads to
        nothing. None where it is closed.
        """
        used = frozenset().union(*(
            frozenset().union(*(self.known[q].ends for q in r.sizes)) for r in self.relations
            if r.sizes <= self.known.keys()
        ))  # fmt: skip
        keys = {p["name"] for p in self.drawing.parameters}
        related = frozenset().union(*(r.sizes for r in self.relations))
        idle = [name for name in self.given if name in related and name not in keys | used]
        missing = [name for name in required if name not in self.known]
        for r in self.unsolved.values() if missing else ():
            if not r.sizes <= self.known.keys():
                return self._rootless(r)
        if (idle or missing) and (apart := self._apart()):
            return apart
        for name in (*idle, *missing):
            size = self.given.get(name) or next(p for p in self.drawing.listed if p["name"] == name)
            place = f"{size['table']}.{size['key']}"
            sets = self._closing(name)
            remedy = " or ".join(" and ".join(s) for s in sets) if sets else "other sizes"
            if name in idle:
                reason = "does not determine a size of the design by itself"
                return DesignError(place, size["shown"], reason, f"give {remedy} too")
            instead = f", or give {remedy}" if sets else ""
            return DesignError(place, None, "the key is missing", f"add it to the design{instead}")
        return None

    def _apart(self) -> DesignError | None:
        """The error for a size of a drawing beside a key with which nothing is assumed; None where there are none."""
        unless = frozenset().union(*(default["unless"] for default in self.drawing.table["defaults"]))
        keys = self.drawing.places.keys() - self.drawing.beside
        drawn = [s for s in self.given.values() if s["place"] not in keys]
        own = [s for name, s in self.given.items() if name in unless and s not in drawn]
        if not (own and drawn):
            return None
        shown = ", ".join(f"{s['place']} = {s['shown']}" for s in drawn)
        reason = f"contradicts {shown}: it follows from a drawing"
        return DesignError(own[0]["place"], own[0]["shown"], reason, "leave it out, or all sizes of the drawing")

    def _rootless(self, r: Relation) -> DesignError:
        """The error that names the given sizes for which a relation has no solution."""
        known = frozenset().union(*(self.known[name].ends for name in r.sizes if name in self.known))
        first, *others = (s for name, s in self.given.items() if name in known)
        shown = ", ".join(f"{s['place']} = {s['shown']}" for s in others)
        sought = r.sizes - self.known.keys()
        meaning = next(p["meaning"] for p in self.drawing.listed if p["name"] in sought)
        reason = f"no {meaning} goes with {shown}"
        return DesignError(first["place"], first["shown"], reason, "change one of them")

    def _closing(self, name: str) -> list[list[str]]:
        """The smallest sets of places of sizes that, given too, would close a relation of a size."""
        own = [r for r in self.relations if name in r.sizes and (name in self.known or name in r.solutions)]
        places = {p["name"]: place for place, p in self.drawing.places.items()}
        opened = [sorted(r.sizes - self.known.keys() - {name}) for r in own]
        if name in self.known:  # what is left open but one size follows
            opened = [list(c) for o, r in zip(opened, own, strict=True) for c in combinations(o, max(len(o) - 1, 1))
                      if len(o) <= 1 or {*o} - {*c} <= r.solutions.keys()]  # fmt: skip
        sets = [[places[q] for q in s] for s in opened if 0 < len(s) <= TOGETHER and {*s} <= places.keys()]
        least = min(map(len, sets), default=0)
        return [s for s in sets if len(s) == least][:OFFERED]


def _inner(size: dict[str, Any], number: Any) -> float:
    return float(size["choices"][number]) if size["choices"] else float(number) * size["factor"]


def outer(size: Mapping[str, Any], number: float) -> Any:
    """An inner number in the unit of its key, or its word."""
    words = {choice: word for word, choice in size["choices"].items()}
    if number in words:
        return words[number]
    return round(number) if size["integer"] else number / size["factor"]


def _outer(size: dict[str, Any], number: float) -> str:
    shown = outer(size, number)
    return shown if isinstance(shown, str) else f"{shown:.9g}"
