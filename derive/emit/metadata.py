"""Describe a schedule as plain data: the JSON beside each header, and the tables inside it."""

import hashlib
import json
import math
from dataclasses import asdict
from functools import cache

import mpmath
import sympy as sp

from derive.language.description import prefix, rules, sources, text
from derive.language.drive import Count
from derive.language.replace import replaced
from derive.language.symbols import interface_unit
from derive.program.tape import Stage

GENERATOR = "0.1.0"

#: Version of the model table in runtime/c/mw_model.h, for which headers are generated.
ABI = 7


def describe(plan, provenance):
    """Names, units, shapes, operations per stage, hashes and a self-test of one drive.

    ``provenance`` is what the prove stage says of the drive (:class:`derive.audit.provenance.Provenance`).
    """
    drive = plan.drive
    offsets = _offsets(plan)
    return {
        "schema": "meshwright.drive/1",
        "generator": GENERATOR,
        **identity(drive),
        "abi": ABI,
        "specification_hash": specification_hash(plan),
        "description_sha256": hashlib.sha256(text(drive).encode()).hexdigest(),
        **provenance,
        "instant": {"name": drive.instant.name, "unit": "rad", "meaning": drive.instant.meaning},
        "unknowns": [_name(u.symbol) for u in drive.unknowns],
        "parameters": parameters(drive),
        "quantities": _quantities(drive),
        "tools": [
            {"body": use.body, "word": use.word, "name": use.tool.name, "title": use.tool.title, "keys": list(use.keys)}
            for use in drive.tools
        ],
        "loading": drive.loading and asdict(drive.loading),
        "pinion_teeth": drive.pinion_teeth,
        "exclusive": [list(group) for group in drive.exclusive],
        "reference_angle": prefix(drive.reference_angle),
        "proportions": rules(drive.proportions),
        "sources": sources(drive),
        "together": [list(group) for group in drive.together],
        "ascending_path": drive.ascending_path,
        "flanks_apart": drive.flanks_apart,
        "absorbs_errors": drive.absorbs_errors,
        "sizes": [_size(*entry) for entry in drive.all_sizes],
        "systems": [_system(drive, system) for system in drive.systems],
        "rules": _rules(drive),
        "exact_rules": [_terms(drive, rule) for rule in drive.completion],
        "guards": [{"message": g.message, "keys": list(g.keys)} for g in plan.guards],
        "missing": _missing(drive),
        "outputs": _named(plan.observed),
        "start_unknowns": [plan.unknowns.index(u.symbol) for u in drive.start.unknowns],
        "error": plan.unknowns.index(drive.error),
        "wheel_angle": offsets["wheel_angle"],
        "reference": _reference(drive),
        "teeth": [p.key for p in drive.parameters].index(drive.pinion_teeth),
        "geometry": offsets["tangent_basis"],
        "bodies": [_body(plan, body, offsets) for body in drive.bodies],
        "regions": [_region(*pair) for pair in zip(plan.regions, drive.regions, strict=True)],
        "edges": [{"name": s.name, "margins": list(s.margins)} for s in plan.edges.systems],
        "functions": [_function(function) for function in plan.functions],
        "least_teeth": {member: asdict(search) for member, search in drive.least_teeth.items()},
        "tool_clearance": drive.tool_clearance and asdict(drive.tool_clearance),
        "shapes": {
            "p": [len(drive.parameters)],
            "s": [parameters_at(plan) + len(drive.parameters)],
            "x": [len(drive.unknowns)],
            "R": [len(drive.unknowns)],
            "J": [len(drive.unknowns)] * 2,
            "o": [sum(len(o.nodes) for o in plan.observed)],
        },
        "operations": operations(plan),
        "self_test": self_test(plan),
    }


def identity(drive):
    """What tells a drive from the others of its family."""
    return {
        "name": drive.name,
        "prefix": drive.name,
        "family": drive.family,
        "title": drive.title,
        "variant": {
            key: asdict(chosen) if isinstance(chosen, Count) else [chosen] for key, chosen in drive.variant.items()
        },
        "variant_defaults": drive.variant_defaults,
        "handed": drive.handed,
        "regrind": drive.regrind and asdict(drive.regrind),
    }


def parameters(drive):
    """The parameters of a drive in the order of its parameter vector."""
    return [parameter(p) | {"tools": [use.word for use in drive.tools if p.key in use.keys]} for p in drive.parameters]


def specification_hash(plan):
    """SHA-256 of the tape, its inputs and what is read from it: equal for equal generated arithmetic."""
    nodes = _nodes(plan.tape)
    reads = [plan.residual, plan.jacobian, plan.step, plan.start_residual, plan.start_solution]
    reads += [[g.node for g in plan.guards]]
    reads += [[o.name, list(o.nodes)] for o in plan.observed]
    reads += [[f.body, [[o.name, list(o.nodes)] for o in f.outputs]] for f in plan.flanks]
    reads += [[f.body, f.region, [[o.name, list(o.nodes)] for o in f.outputs]] for f in plan.regions]
    reads += [[f.body, f.region, [[o.name, list(o.nodes)] for o in f.curvature]] for f in (*plan.flanks, *plan.regions)]
    reads += [[e.slopes, e.second] for e in plan.expansions]
    reads += [plan.edges.equations, plan.edges.jacobian, [[s.name, s.equations] for s in plan.edges.systems]]
    reads += [[plan.along.direction, plan.along.first, plan.along.second]]
    reads += [_system_content(system) for system in plan.systems]
    reads += [[f.name, [[o.name, list(o.nodes)] for o in f.outputs]] for f in plan.functions]
    rules = [[r.target.name, str(r.value)] for r in plan.drive.rules]
    text = json.dumps([nodes, reads, rules], separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()


def _nodes(tape):
    return [[n.op, list(n.args), str(n.value) if n.value is not None else ""] for n in tape.nodes]


def _system_content(plan):
    return [plan.system.name, _nodes(plan.tape), plan.residual, plan.guess, plan.values, plan.watch]


def operations(plan):
    """Number of operations of each stage."""
    tape = plan.tape

    @cache
    def known(reached):
        return {i for i, stage in enumerate(tape.stages) if stage <= reached}

    def count(outputs, reached):
        return len(tape.needed(outputs, known(reached)))

    flat = [e for row in plan.jacobian for e in row]
    slots = list(plan.state)
    return {
        "setup": count(slots[: plan.design_slots], Stage.CONSTANT),
        "set_phi": count(slots[plan.design_slots :], Stage.DESIGN),
        "residual": count(plan.residual, Stage.INSTANT),
        "residual_and_jacobian": count([*plan.residual, *flat], Stage.INSTANT),
        "step": count(plan.newton_step, Stage.INSTANT),
        "observe": count([i for o in plan.observed for i in o.nodes], Stage.INSTANT),
    }


def self_test(plan):
    """A contact of the sample design, for any implementation to check its Newton step against: from ``x_start`` it
    reaches ``x``. Hex floats.
    """
    inputs = {symbol: float(value) for symbol, value in plan.sample.items()}
    return {
        "p": [inputs[p.symbol].hex() if math.isfinite(inputs[p.symbol]) else "nan" for p in plan.drive.parameters],
        "phi": float(plan.drive.sample_angle).hex(),
        "x_start": [x.hex() for x in plan.beside],
        "x": [inputs[u].hex() for u in plan.unknowns],
    }


def parameters_at(plan):
    """Where the parameters, at the end of the state, begin: after the plan's state and what X_follow keeps, which is
    MWI_KEPT numbers of runtime/c/solver/warm.h and two solutions.
    """
    return len(plan.state) + 3 + 2 * len(plan.unknowns)


def _reference(drive):
    """Index of the parameter that is the reference angle, −1 where that is 0."""
    return -1 if drive.reference_angle == 0 else [p.symbol for p in drive.parameters].index(drive.reference_angle)


def _plain(name, unit, frame=""):
    return {
        "name": name, "unit": unit, "frame": frame, "meaning": "",
        "key": "", "table": "", "factor": 1.0, "lower": None, "upper": None,
    }  # fmt: skip


def _name(symbol):
    return _plain(symbol.name, symbol.unit, symbol.frame) | {"meaning": symbol.meaning} | _bounds(symbol)


def _bounds(symbol):
    """The open domain of a symbol, inner unit; None where it has no end."""
    ends = zip(("lower", "upper"), symbol.domain, strict=True)
    return {name: _float(end) if end.is_finite else None for name, end in ends}


def _float(expression):
    return float(mpmath.mpf(expression.evalf(30)))


def _quantities(drive):
    """What is known of every number of a surface, a contact or a function, by name: unit, frame, meaning, parity."""
    symbols = [drive.instant, *(u.symbol for u in drive.unknowns)]
    symbols += [q for body in drive.bodies for q in body.recovered]
    symbols += [q for region in drive.regions for q in region.surface.parameters]
    symbols += [q for function in drive.functions for q in function.arguments]
    return {
        q.name: {"unit": q.unit, "frame": q.frame, "meaning": q.meaning, "parity": q.parity} for q in symbols
    }


def _margins(margins):
    return [
        {"flag": m.flag, "event": m.event, "role": m.role.value, "joins": m.joins, "ends": list(m.ends)}
        for m in margins
    ]


def parameter(p):
    """A key as plain data."""
    return {
        "name": p.symbol.name,
        "unit": p.symbol.unit,
        "meaning": p.symbol.meaning,
        "key": p.key,
        "table": str(p.table),
        "factor": _float(p.factor),
        "key_unit": interface_unit(p.key)[0],
        "default": None if p.default is None else _float(p.default),
        **_bounds(p.symbol),
        "lower_included": p.lower_included,
        "above": p.above,
        "integer": p.integer,
        "required": p.required,
        "choices": dict(p.choices),
    }


def _missing(drive):
    """What a design lacks of which all parameters of an entry are open, numbered on from the guards."""
    places = {p.place: k for k, p in enumerate(drive.parameters)}
    alone, together = "missing from the design: give it a value", "all missing from the design: give one a value"
    groups = [(alone, [p.place]) for p in drive.parameters if p.required]
    groups += [(together, [*group]) for group in drive.exclusive]
    return [{"message": words, "keys": keys, "places": [places[key] for key in keys]} for words, keys in groups]


def _rules(drive):
    """Which parameter each default and rule fills, in the order in which they run."""
    index = {p.symbol: k for k, p in enumerate(drive.parameters)}
    return [index[rule.target] for rule in drive.completion]


def _terms(drive, rule):
    """A rule that is a sum of keys with rational factors, in the units of the keys: factor by symbol, and of a constant
    by "1"; None for all others.
    """
    if rule.value.has(sp.Pow, sp.Function):
        return None
    used = {rule.target, *rule.value.free_symbols}
    factors = {p.symbol: p.factor for p in drive.parameters if p.symbol in used}
    numbers = replaced(rule.value, {q: factor * q for q, factor in factors.items()}) / factors[rule.target]
    terms = sp.expand(numbers).as_coefficients_dict()
    if any(not factor.is_Rational or (of != 1 and of not in factors) for of, factor in terms.items()):
        return None
    return {str(of): str(factor) for of, factor in terms.items()}


def _system(drive, system):
    """A design system: why it may have no solution, its unknowns by name, which parameters it fills in, and whether
    that is only where the search for contact starts.
    """
    symbols = [p.symbol for p in drive.parameters]
    return {
        "name": system.name,
        "message": system.message,
        "keys": list(system.keys),
        "unknowns": [unknown.symbol.name for unknown in system.unknowns],
        "fills": [symbols.index(target) for target in system.fills],
        "start": system.start,
    }


def _size(key, _value, meaning):
    _, unit, factor = interface_unit(key)
    return _plain(key, unit) | {"meaning": meaning, "key": key, "factor": _float(factor)}


def _region(scheduled, region):
    return {
        "name": region.member,
        "region": region.name,
        "parameters": [p.name for p in scheduled.parameters],
        "conditions": sum(o.name.endswith("_slopes") for o in scheduled.outputs),
        "margins": _margins(region.margins),
        "lengthwise": region.lengthwise,
        "outputs": sum(len(o.nodes) for o in scheduled.outputs),
        "curvature": _named(scheduled.curvature),
    }


def _function(function):
    return {
        "name": function.name,
        "meaning": function.meaning,
        "arguments": [_name(q) for q in function.parameters],
        "outputs": _named(function.outputs),
    }


def _named(outputs):
    """Name, unit, frame, place and size of consecutive outputs."""
    places = _places(outputs)
    return [{**_plain(o.name, o.unit, o.frame), "offset": places[o.name], "size": len(o.nodes)} for o in outputs]


def _offsets(plan):
    return _places(plan.observed)


def _places(outputs):
    offsets, at = {}, 0
    for output in outputs:
        offsets[output.name] = at
        at += len(output.nodes)
    return offsets


def _body(plan, body, offsets):
    places = plan.bodies[body.name]
    flank = next(f for f in plan.flanks if f.body == body.name)
    return {
        "name": body.name,
        "parameters": [p.name for p in body.surface.parameters],
        "unknowns": [plan.unknowns.index(p) for p in body.surface.parameters],
        "conditions": places.conditions,
        "point": offsets[f"point_{body.name}"],
        "at": places.at,
        "regular": places.singular,
        "margin": places.singular + 1,
        "margins": _margins(body.margins),
        "lengthwise": body.lengthwise,
        "recovered": [s.name for s in body.recovered],
        "outputs": sum(len(o.nodes) for o in flank.outputs),
        "curvature": _named(flank.curvature),
    }
