"""REXS 2.0.0 (FVA GmbH, schema of 10 March 2026): components and attributes in terms of a family's symbols.

A family declares an :class:`Exchange`. Attributes are expressions of the design's parameters, by which a file is
written and redundant sizes are checked; readings are expressions of attributes, by which a file is read. An attribute
in an expression is the symbol that :func:`attribute` gives. All in inner units (mm, rad). Units, types, ranges and the
relations that are allowed come from ``rexs_ids.json``, an extract of the public schema.
"""

import json
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path

import sympy as sp

from derive.language.description import prefix
from derive.language.symbols import Parameter, Quantity
from derive.language.vectors import Number

#: The hand of the drive, +1 right and −1 left.
HAND = Quantity("hand", "", "hand of the drive")


@cache
def schema():
    """The extract of the public schema: components with their attributes, relations with their roles."""
    return json.loads(Path(__file__).with_name("rexs_ids.json").read_text(encoding="utf-8"))


def attribute(component, name, index=None):
    """The symbol of an attribute's value, or of an entry of its array, in expressions of readings."""
    return Quantity(f"{component}.{name}" if index is None else f"{component}.{name}.{index}")


@dataclass(frozen=True)
class Component:
    """A component by a name of the family's own; written where it has attributes, or together with ``beside``."""

    name: str
    kind: str
    beside: str = ""


@dataclass(frozen=True)
class Relation:
    """A relation between components: (role, name) each; ``required`` where a file cannot be read without it."""

    kind: str
    refs: tuple[tuple[str, str], ...]
    required: bool = False


@dataclass(frozen=True)
class Attribute:
    """``value`` of an attribute, which holds the design keys of ``parameters``; a tuple is an array.

    ``given``: written only where the design gives one of the keys. ``agrees``: in a file, it must agree with what its
    other attributes say.
    """

    component: str
    name: str
    value: object
    parameters: tuple[Parameter, ...]
    given: bool = False
    agrees: bool = True


@dataclass(frozen=True)
class Words:
    """An attribute with words of its own for a word of the design: key → {word of the design: word of REXS}."""

    component: str
    name: str
    key: str
    words: dict


@dataclass(frozen=True)
class Reading:
    """``target`` from attributes and parameters; of several for one target the first that has a value is taken.

    ``override``: the key is written only where its value is not what the design's rules give anyway.
    """

    target: Quantity
    value: sp.Expr
    override: bool = False


@dataclass(frozen=True)
class Assumption:
    """What REXS does not say of a key that it holds; with ``when`` only for these words of the design."""

    key: str
    reason: str
    when: dict | None = None


@dataclass(frozen=True)
class Without:
    """A word of the design for a component of a file that has not this attribute, with the reason."""

    key: str
    word: str
    component: str
    attribute: str
    reason: str


@dataclass(frozen=True)
class Exchange:
    """A family in REXS. The first component is the stage.

    ``doubtful``: keys whose several readings may differ, with the difference (inner unit) above which both are
    reported. ``defaults``: what is reported as assumed of a key that a file leaves open: key → reason. ``absent``: why
    REXS cannot hold a key.
    """

    components: tuple[Component, ...]
    relations: tuple[Relation, ...]
    attributes: tuple[Attribute, ...]
    words: tuple[Words, ...]
    readings: tuple[Reading, ...]
    assumptions: tuple[Assumption, ...] = ()
    without: tuple[Without, ...] = ()
    doubtful: tuple[tuple[Quantity, sp.Expr], ...] = ()
    defaults: tuple[tuple[str, str], ...] = ()
    absent: tuple[tuple[str, str], ...] = ()


def place(parameter):
    """Table and key of a parameter, as reports name it."""
    return f"{parameter.table}.{parameter.key}"


def direct(component, name, parameter, factor=1, **kind):
    """An attribute that is a multiple of a parameter, and its reading."""
    written = Attribute(component, name, factor * parameter.symbol, (parameter,), **kind)
    return written, Reading(parameter.symbol, attribute(component, name) / factor)


def shaft_axes(angle, hand: Number = 1):
    """The axes of two shafts ``shaft_1`` and ``shaft_2`` at a shaft angle: the first along w, the second turned from
    it about u; a left-hand drive is the mirror image.
    """
    turned = (sp.S.Zero, hand * sp.sin(angle.symbol), sp.cos(angle.symbol))
    return tuple(
        Attribute(f"shaft_{n}", "u_axis_vector", axis, (angle,), agrees=False)
        for n, axis in ((1, (sp.S.Zero, sp.S.Zero, sp.S.One)), (2, turned))
    )


def angle_between_shafts():
    """The angle between the axes of ``shaft_1`` and ``shaft_2``, 0 to π."""
    a, b = ([attribute(f"shaft_{n}", "u_axis_vector", i) for i in range(3)] for n in (1, 2))
    normal = [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]
    return sp.atan2(sp.sqrt(sum(c**2 for c in normal)), sum(p * q for p, q in zip(a, b, strict=True)))


def table(drives):
    """The exchange of a family as plain data, None if it has none: what writing and reading needs, and the rules,
    guards and exclusive keys by which a design is complete without a compiled drive. Drives without one do not count.
    """
    drives = [drive for drive in drives if drive.exchange is not None]
    if not drives:
        return None
    exchange = drives[0].exchange
    check(exchange)
    rules = {(rule.target.name, str(rule.value)): rule for drive in drives for rule in drive.completion}
    solved = {target for drive in drives for system in drive.systems for target in system.fills}
    used = set().union(*(sp.Tuple(a.value).free_symbols for a in exchange.attributes))
    kinds = {c.name: c.kind for c in exchange.components}
    return {
        "components": [{"name": c.name, "type": c.kind, "beside": c.beside} for c in exchange.components],
        "relations": [{"type": r.kind, "refs": [list(x) for x in r.refs], "required": r.required,
                       "order": schema()["relations"][r.kind]["orderRequired"]} for r in exchange.relations],
        "attributes": [
            {"component": a.component, "attribute": a.name, **_known(kinds[a.component], a.name),
             "value": [prefix(e) for e in a.value] if isinstance(a.value, tuple) else prefix(a.value),
             "keys": _keys(a), "given": a.given, "agrees": a.agrees}
            for a in exchange.attributes
        ],
        "words": [
            {"component": w.component, "attribute": w.name, **_known(kinds[w.component], w.name), "key": w.key,
             "words": w.words} for w in exchange.words
        ],
        "readings": [{"symbol": r.target.name, "value": prefix(r.value), "override": r.override}
                     for r in exchange.readings],
        "assumptions": [{"key": a.key, "reason": a.reason, "when": a.when or {}} for a in exchange.assumptions],
        "without": [asdict(w) for w in exchange.without],
        "doubtful": {symbol.name: float(limit) for symbol, limit in exchange.doubtful},
        "defaults": dict(exchange.defaults),
        "absent": dict(exchange.absent),
        "rules": [[rule.target.name, prefix(rule.value)] for rule in rules.values()],
        "solved": sorted(q.name for q in solved & used),
        "guards": [{"positive": prefix(g.positive), "message": g.message, "keys": list(g.keys)}
                   for g in _common_guards(drives)],
        "exclusive": [list(group) for group in drives[0].exclusive],
    }  # fmt: skip


def _keys(written):
    """The design keys that an attribute holds."""
    hand = ["design.hand"] if written.agrees and HAND in sp.Tuple(written.value).free_symbols else []
    return [place(p) for p in written.parameters] + hand


def _common_guards(drives):
    """Guards on parameters alone that every drive of the family has."""
    symbols = set.intersection(*({p.symbol for p in drive.parameters} for drive in drives))
    return [g for g in drives[0].guards if all(g in drive.guards for drive in drives)
            and sp.sympify(g.positive).free_symbols <= symbols]  # fmt: skip


#: What is known of an attribute in the schema, by our names.
_KNOWN = {"unit": "unit", "type": "type", "enum": "enum", "lower": "rangeMin", "lower_open": "rangeMinOpen",
          "upper": "rangeMax", "upper_open": "rangeMaxOpen"}  # fmt: skip


def _known(kind, name):
    entry = schema()["components"][kind][name]
    return {ours: entry[theirs] for ours, theirs in _KNOWN.items() if theirs in entry}


def check(exchange):
    """Whether the schema has all of it; raises ValueError."""
    kinds = {c.name: c.kind for c in exchange.components}
    for relation in exchange.relations:
        refs = [[role, kinds[name]] for role, name in relation.refs]
        if refs not in schema()["relations"][relation.kind]["allowed"]:
            raise ValueError(f"REXS has no relation {relation.kind} between {refs}")
    for a in (*exchange.attributes, *exchange.words):
        if a.name not in schema()["components"][kinds[a.component]]:
            raise ValueError(f"REXS has no attribute {a.name} of {kinds[a.component]}")
