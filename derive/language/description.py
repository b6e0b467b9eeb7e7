"""A drive's description as plain data: what a checker, the runtime or a page reads instead of our Python.

Expressions are nested prefix lists over named symbols and exact numbers, motions are lists of named factors, surfaces
the steps by which they were made. ``derive/language/description.md`` documents the form; nothing in it needs SymPy.
"""

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict
from typing import TypeAlias

from derive.language.chain import Factor, Motion, Placement, Rotation, Station, Swing, Translation
from derive.language.drive import Body, Count, DesignSystem, Drive, Margin, Region, Values
from derive.language.prefix import Prefix, prefix
from derive.language.surface import Step, StepData, Surface
from derive.language.symbols import Parameter, Quantity, Rule, Unknown
from derive.language.vectors import Number

#: What JSON can hold.
Data: TypeAlias = "Mapping[str, Data] | Sequence[Data] | str | int | float | None"

SCHEMA = "meshwright.description/1"


def _vector(vector: Iterable[Number]) -> list[Prefix]:
    return [prefix(c) for c in vector]


def factor(elementary: Factor) -> list[Data]:
    """A factor of a motion: its kind, then what it is made of."""
    match elementary:
        case Rotation():
            return ["rotation", elementary.axis, prefix(elementary.angle)]
        case Swing():
            return ["swing", elementary.axis, prefix(elementary.angle), _vector(elementary.centre)]
        case Station():
            return ["station", _vector(elementary.offset)]
        case Translation():
            return ["translation", _vector(elementary.offset)]
        case Placement():
            return ["placement", [_vector(column) for column in elementary.columns]]


def motion(product: Motion) -> list[list[Data]]:
    """The factors of a motion, leftmost acting last."""
    return [factor(f) for f in product.factors]


def quantity(symbol: Quantity) -> dict[str, Data]:
    """A symbol with what is known of it."""
    lower, upper = (prefix(end) if end.is_finite else None for end in symbol.domain)
    return {
        "name": symbol.name, "unit": symbol.unit, "frame": symbol.frame, "meaning": symbol.meaning,
        "domain": [lower, upper], "parity": symbol.parity,
    }  # fmt: skip


def surface(described: Surface) -> dict[str, Data]:
    """A surface: its parameters, the steps by which it was made, and what they led to."""
    described = described.written_down
    return {
        "parameters": [quantity(q) for q in described.parameters],
        "made": [_step(step) for step in described.made],
        "point": _vector(described.point),
        "tangents": [_vector(t) for t in described.tangents],
        "normal": _vector(described.normal),
        "motion": motion(described.motion),
        "conditions": [prefix(c) for c in described.conditions],
    }


def _step(step: Step) -> dict[str, Data]:
    return {"step": step.word, **{name: _data(value) for name, value in step.data}}


def _data(value: StepData) -> Data:
    if isinstance(value, Motion):
        return motion(value)
    return _vector(value) if isinstance(value, tuple) else prefix(value)


def _key(drive: Drive, p: Parameter) -> dict[str, Data]:
    return {
        "key": p.key, "table": str(p.table), "symbol": quantity(p.symbol), "factor": prefix(p.factor),
        "default": None if p.default is None else prefix(p.default), "required": p.required, "integer": p.integer,
        "lower_included": p.lower_included, "above": p.above, "choices": dict(p.choices),
        "tools": [use.word for use in drive.tools if p.key in use.keys],
    }  # fmt: skip


def _margin(m: Margin) -> dict[str, Data]:
    return {
        "flag": m.flag, "event": m.event, "role": m.role and m.role.value, "joins": m.joins,
        "ends": list(m.ends),
        "positive": prefix(m.positive), "relative": m.relative, "along": m.along and m.along.name,
    }  # fmt: skip


def _named(values: Values) -> dict[str, Prefix]:
    return {symbol.name: prefix(value) for symbol, value in values.items()}


def _body(body: Body) -> dict[str, Data]:
    return {
        "name": body.name,
        "surface": surface(body.surface),
        "motion": motion(body.motion),
        "reference": _named(body.reference),
        "regular": None if body.regular is None else prefix(body.regular),
        "coordinates": [q.name for q in body.point],
        "margins": [_margin(m) for m in body.margins],
        "recovered": [quantity(q) for q in body.recovered],
        "lengthwise": body.lengthwise,
    }


def _region(region: Region) -> dict[str, Data]:
    return {
        "member": region.member,
        "region": region.name,
        "surface": surface(region.surface),
        "regular": prefix(region.regular),
        "margins": [_margin(m) for m in region.margins],
        "lengthwise": region.lengthwise,
    }


def _unknown(unknown: Unknown) -> dict[str, Data]:
    return quantity(unknown.symbol) | {"scale": prefix(unknown.scale)}


def _design_system(system: DesignSystem) -> dict[str, Data]:
    return {
        "name": system.name,
        "unknowns": [_unknown(u) for u in system.unknowns],
        "residual": _vector(system.residual),
        "guess": _named(system.guess),
        "fills": _named(system.fills),
        "fixed": _named(system.fixed),
        "homotopy": system.homotopy,
        "message": system.message,
        "keys": list(system.keys),
        "regular": system.regular and {"surface": surface(system.regular[0]), "sign": prefix(system.regular[1])},
    }


def rules(listed: Iterable[Rule]) -> list[list[Prefix]]:
    """Rules as pairs of a symbol's name and its value."""
    return [[rule.target.name, prefix(rule.value)] for rule in listed]


def sources(drive: Drive) -> list[dict[str, Data]]:
    """What the drive's page follows."""
    return [{"author": s.author, "title": s.title, "year": s.year, "where": s.where} for s in drive.sources]


def _words(data: Data) -> set[str]:
    """Every text in plain data, of which the same list may be in many places."""
    found, seen = set[str](), set[int]()
    left = [data]
    while left:
        part = left.pop()
        if isinstance(part, str):
            found.add(part)
        elif id(part) not in seen:
            seen.add(id(part))
            if isinstance(part, Mapping):
                left.extend(part.values())
            elif isinstance(part, Sequence):
                left.extend(part)
    return found


def _definitions(drive: Drive, described: dict[str, Data]) -> list[dict[str, Data]]:
    """The named intermediate results that the rest of the description refers to, in their order."""
    values = drive.definitions.items()
    named = {symbol.name: quantity(symbol) | {"value": prefix(value)} for symbol, value in values}
    wanted: list[Data] = [described]
    found: dict[str, dict[str, Data]] = {}
    while wanted:
        new = named.keys() & _words(wanted) - found.keys()
        found |= {name: named[name] for name in new}
        wanted = [named[name]["value"] for name in new]
    return [entry for name, entry in named.items() if name in found]


def text(drive: Drive) -> str:
    """The description as JSON, one line an entry."""
    described = describe(drive)
    lines: list[str] = []
    for name, value in described.items():
        if isinstance(value, list) and value:
            entries = ",\n".join("  " + _compact(entry) for entry in value)
            lines.append(f' {_compact(name)}: [\n{entries}\n ]')
        else:
            lines.append(f" {_compact(name)}: {_compact(value)}")
    return "{\n" + ",\n".join(lines) + "\n}\n"


def _compact(data: Data) -> str:
    return json.dumps(data, ensure_ascii=False, separators=(",", ":"))


def describe(drive: Drive) -> dict[str, Data]:
    """The whole description of a drive."""
    described = _describe(drive)
    return described | {"definitions": _definitions(drive, described)}


def _describe(drive: Drive) -> dict[str, Data]:
    return {
        "schema": SCHEMA,
        "name": drive.name,
        "family": drive.family,
        "title": drive.title,
        "variant": {
            key: asdict(chosen) if isinstance(chosen, Count) else chosen for key, chosen in drive.variant.items()
        },
        "variant_defaults": dict(drive.variant_defaults),
        "handed": drive.handed,
        "sources": sources(drive),
        "keys": [_key(drive, p) for p in drive.parameters],
        "pinion_teeth": drive.pinion_teeth,
        "exclusive": [list(group) for group in drive.exclusive],
        "together": [list(group) for group in drive.together],
        "tools": [
            {"body": use.body, "word": use.word, "name": use.tool.name, "title": use.tool.title, "keys": list(use.keys)}
            for use in drive.tools
        ],
        "rules": rules(drive.rules),
        "proportions": rules(drive.proportions),
        "guards": [
            {"positive": prefix(g.positive), "message": g.message, "keys": list(g.keys)} for g in drive.guards
        ],
        "design_systems": [_design_system(system) for system in drive.systems],
        "sizes": [{"key": key, "value": prefix(value), "meaning": meaning} for key, value, meaning in drive.all_sizes],
        "bodies": [_body(body) for body in drive.bodies],
        "regions": [_region(region) for region in drive.regions],
        "contact": {
            "instant": quantity(drive.instant),
            "error": drive.error.name,
            "ratio": prefix(drive.law),
            "wheel_angle": prefix(drive.turned),
            "reference_angle": prefix(drive.reference_angle),
            "unknowns": [_unknown(u) for u in drive.unknowns],
            "residual": _vector(drive.residual),
        },
        "start": {
            "unknowns": [_unknown(u) for u in drive.start.unknowns],
            "residual": _vector(drive.start.residual),
            "guess": _named(drive.guess),
            "solution": _named(drive.start.outputs),
            "fixed": _named(drive.start.fixed),
        },
        "functions": [
            {
                "name": f.name, "meaning": f.meaning, "arguments": [quantity(q) for q in f.arguments],
                "results": [
                    {"name": r.name, "unit": r.unit, "frame": r.frame, "values": _vector(r.values)} for r in f.results
                ],
            }
            for f in drive.functions
        ],
        "ascending_path": drive.ascending_path,
        "flanks_apart": drive.flanks_apart,
        "absorbs_errors": drive.absorbs_errors,
        "least_teeth": {member: asdict(search) for member, search in drive.least_teeth.items()},
        "tool_clearance": drive.tool_clearance and asdict(drive.tool_clearance),
        "loading": drive.loading and asdict(drive.loading),
        "regrind": drive.regrind and asdict(drive.regrind),
        "sample": {key: str(value) for key, value in drive.sample.items()},
        "sample_angle": str(drive.sample_angle),
    }  # fmt: skip
