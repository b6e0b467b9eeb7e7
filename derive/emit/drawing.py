"""Print what drawings of a family state, as data for the completion of designs (:mod:`meshwright.design.relations`).

``sizes`` and ``relations`` hold the family's own sizes too: each is a relation that is solved for the size alone.
``defaults`` end with what completes every design of the family; ``conversions`` are of keys that stand for others.
``tables`` hold the keys, with what goes before a key where sizes are listed.
"""

from derive.emit import metadata
from derive.language.description import prefix
from derive.language.drawing import Assumed, Drawing, Root
from derive.language.symbols import CONVERSIONS, Table, interface_unit, parameter

#: Tables of which no drawing states anything, but what it has a default for.
UNDRAWN = Table.FLANK, Table.MISALIGNMENT, Table.CONTACT

#: Why a design has what its family's page says where nothing else is given.
USUAL = "the family's default"


def table(drives):
    """The drawing of a family as plain data; of families that declare none, the conversions of their keys."""
    drawing = next((drive.drawing for drive in drives if drive.drawing), None)
    stated = {d.target for d in drawing.defaults} if drawing else set()
    tables = dict.fromkeys(
        str(p.table) for drive in drives for p in drive.parameters if p.table not in UNDRAWN or p.symbol in stated
    )
    return {
        "conversions": _conversions(),
        "tables": {name: "" if name in list(Table) else f"{name}." for name in tables},
        **_table(drawing or Drawing((), (), ()), drives if drawing else []),
    }


def _conversions():
    return [
        {"ending": ending, "of": of, "times": prefix(times), "factor": float(interface_unit(f"a{ending}")[2])}
        for ending, of, times in CONVERSIONS
    ]


def _table(drawing, drives):
    named = {(p.table, p.key): p for p in drawing.sizes}
    own = {}
    for key, value, meaning in (size for drive in drives for size in drive.all_sizes):
        _, unit, _ = interface_unit(key)
        own.setdefault((Table.DESIGN, key), (named.get((Table.DESIGN, key)) or parameter(key, key, meaning), value))
    relations = [_relation(r.size, r.value, r.solutions) for r in drawing.relations]
    relations += [_relation(size.symbol, value, {}) for size, value in own.values()]
    targets = {d.target for d in drawing.defaults}
    usual = [rule for drive in drives for rule in drive.completion if rule.target not in targets]
    return {
        "sizes": [metadata.parameter(p) for p in {**{key: size for key, (size, _) in own.items()}, **named}.values()],
        "relations": relations,
        "defaults": list({str(d): d for d in map(_default, (*drawing.defaults, *usual))}.values()),
        "checks": [
            {"name": c.name, "meaning": c.meaning, "occurs": c.occurs, "margin": prefix(c.margin)}
            for c in drawing.checks
        ],
        "guards": [
            {"positive": prefix(g.positive), "message": g.message, "keys": list(g.keys)} for g in drawing.guards
        ],
        "elsewhere": [{"positive": prefix(e.positive), "family": e.family, "what": e.what} for e in drawing.elsewhere],
    }  # fmt: skip


def _relation(size, value, solutions):
    found = {size: value, **solutions}
    return {"size": size.name, "solutions": {q.name: _solution(solution) for q, solution in found.items()}}


def _solution(found):
    if not isinstance(found, Root):
        return prefix(found)
    return {
        "unknown": found.unknown.name,
        "residual": prefix(found.residual),
        "between": [prefix(found.low), prefix(found.high)],
        "where": [[q.name, _solution(solution)] for q, solution in found.where],
    }


def _default(rule):
    special = rule if isinstance(rule, Assumed) else Assumed(rule.target, rule.value, rule.why or USUAL)
    return {
        "target": special.target.name, "value": prefix(special.value), "why": special.why, "usual": special is not rule,
        "needs": [q.name for q in special.needs], "unless": [q.name for q in special.unless],
    }  # fmt: skip
