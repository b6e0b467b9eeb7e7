"""What a description must be before anything is derived from it: every name has one meaning, every limit a known one.

:func:`validate` reads the description alone; its sample design and the outline of its family are looked at by
:mod:`derive.language.validate_sample` and :mod:`derive.language.validate_outlines`.
"""

import re
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Sequence
from math import isfinite
from typing import cast

import mpmath
import sympy as sp

from derive.language.definitions import Definitions
from derive.language.differentiate import partial
from derive.language.drive import PATH, RATIO, Drive, Margin, Region, Role
from derive.language.functions import OUTLINE, SOLID, SOLID_UNITS, WITH_GENERATION, read_of
from derive.language.prefix import COMPUTED
from derive.language.printed import misnamed
from derive.language.refusal import DescriptionError
from derive.language.replace import replaced
from derive.language.sampled import vanishes
from derive.language.surface import Surface
from derive.language.symbols import Parameter, Quantity, Table, Unknown, foreign_unit, interface_unit, unit_suffixes
from derive.language.vectors import Number

#: What a point of a flank may be marked with, "" where a region has no flag of its own.
FLAGS = ("", "undercut", "interference", "beyond_regression", "spurious_sheet", "off_tip", "off_root", "off_face",
         "off_tool", "edge_contact")  # fmt: skip

#: What may end contact, and what may end a region.
EVENTS = ("tip", "throat", "face", "root", "tool_end", "undercut", "regression", "fold", "spurious_sheet", "junction",
          "bottom")  # fmt: skip

#: Events that say by themselves what ends the surface.
OWN_ROLES = frozenset(role.value for role in Role)


def validate(drive: Drive) -> None:
    """Raise :class:`DescriptionError` for the first contradiction in a drive's description."""
    checks = (
        _turns, _expressed, _keys, _units, _names, _words, _exact, _completion, _guards, _sample, _domains, _systems,
        _design_systems, _bodies, _functions, _law, _indexed, _limits, _solids, misnamed,
    )  # fmt: skip
    for check in checks:
        for message in check(drive):
            raise DescriptionError(f"{drive.name}: {message}")


def _expressed(drive: Drive) -> Iterator[str]:
    """What is to be an expression is one, not None or a text."""
    for what, value in _expressions(drive):
        given: object = value if isinstance(value, str) else sp.sympify(value)
        if not isinstance(given, sp.Expr):
            yield f"{what} is {value!r}; give an expression of SymPy"


def _keys(drive: Drive) -> Iterator[str]:
    """Keys are unique; the table of misalignments may repeat a key, as the error of the size of that name.

    A family's own tables, such as one a member, may have the same keys.
    """
    places = Counter((p.table, p.key) for p in drive.parameters)
    for (table, key), count in places.items():
        if count > 1:
            yield f"the key {key!r} is declared {count} times in [{table}]; rename all but one"
    tables: dict[str, str] = {}
    for p in drive.parameters:
        shared = p.table == Table.MISALIGNMENT or p.table not in list(Table)
        if not shared and tables.setdefault(p.key, p.table) != p.table:
            yield f"the key {p.key!r} is declared in [{tables[p.key]}] and in [{p.table}]; rename one"
    flanks = [p.key for p in drive.parameters if p.table is Table.FLANK]
    if len(flanks) != 1 or not all(p.choices for p in drive.parameters if p.table is Table.FLANK):
        yield f"exactly one key of the table 'flank' with its words chooses the flank; found {flanks}"
    known = _places(drive)
    for group in drive.exclusive:
        for key in group:
            if key not in known:
                yield f"the exclusive group {group} names the key {key!r}, which is not declared"
    for place in (place for group in drive.together for place in group):
        if place not in {f"{p.table}.{p.key}" for p in drive.parameters}:
            yield f"the group of keys given together names {place!r}, which is not declared"
    if drive.pinion_teeth not in known:
        yield f"pinion_teeth names the key {drive.pinion_teeth!r}, which is not declared"


def _units(drive: Drive) -> Iterator[str]:
    """The unit of a key is its suffix, and that of its symbol the inner one that goes with it."""
    for key in (*(p.key for p in drive.parameters), *(key for key, *_ in drive.all_sizes)):
        if word := foreign_unit(key):
            units = ", ".join(unit_suffixes())
            yield f"the key {key!r} has {word!r} of a unit that no key has; end it in one of {units}, or in no unit"
    for p in drive.parameters:
        if (unit := interface_unit(p.key)[1]) != p.symbol.unit:
            yield f"the key {p.key!r} is in {unit!r} inside, its symbol {p.symbol} in {p.symbol.unit!r}; change one"


def _places(drive: Drive) -> set[str]:
    """How keys may be named: as they are, and with their table."""
    return {p.key for p in drive.parameters} | {p.place for p in drive.parameters}


def _in_sample(p: Parameter) -> str:
    """How the sample design names a key."""
    return p.key if p.table == Table.FLANK else p.place


def _names(drive: Drive) -> Iterator[str]:
    """A name stands for one number: two symbols of one name are one symbol to SymPy."""
    taken: dict[str, str] = {}
    groups: list[tuple[str, Sequence[Quantity]]] = [
        ("a parameter", [p.symbol for p in drive.parameters]), ("the input angle", [drive.instant])
    ]  # fmt: skip
    groups += [(f"a coordinate of the {body.name}", body.point) for body in drive.bodies]
    groups += [("the share of a path", [PATH]), ("an unknown", [u.symbol for u in drive.unknowns])]
    groups += [("a named intermediate result", [symbol for symbol, _ in drive.definitions.items()])]
    for what, symbols in groups:
        for symbol in symbols:
            if (other := taken.setdefault(symbol.name, what)) is not what or [*symbols].count(symbol) > 1:
                yield f"the name {symbol.name!r} is that of {other} and of {what}; rename one of them"
    given = {p.symbol.name for p in drive.parameters} | {symbol.name for symbol, _ in drive.definitions.items()}
    for region in drive.regions:
        for q in region.surface.parameters:
            if q.name in given:
                yield f"the {region.name}'s surface parameter {q.name!r} is also {taken[q.name]}; rename one of them"
    for function in drive.functions:
        for q in function.arguments:
            if q.name in given:
                yield f"the argument {q.name!r} of {function.name} is also {taken[q.name]}; rename one of them"
    for p in drive.parameters:
        if not re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", p.symbol.name):
            yield f"the symbol {p.symbol.name!r} of the key {p.key!r} is no name in C; use letters, digits and _"


def _words(drive: Drive) -> Iterator[str]:
    """What is one of a few words or a count."""
    if drive.handed not in ("", "right", "left"):
        yield f"handed = {drive.handed!r}: use 'right', 'left', or '' for a drive that has but one hand"
    if (loading := drive.loading) is None:
        return
    members = [body.name for body in drive.bodies]
    if loading.torque_on not in members:
        yield f"loading: torque_on = {loading.torque_on!r} is no member; use one of {', '.join(members)}"
    if loading.pairs < 1:
        yield f"loading: pairs = {loading.pairs}: at least one pair of teeth bears the load"


def _strangers(drive: Drive, expression: Number, known: Collection[sp.Symbol]) -> list[str]:
    """Names in an expression that nothing gives a value."""
    return sorted(q.name for q in drive.definitions.free(expression) if q not in known)


def _completion(drive: Drive) -> Iterator[str]:
    parameters = {p.symbol for p in drive.parameters}
    for what, rules in (("rule", drive.rules), ("proportion", drive.proportions)):
        for rule in rules:
            if rule.target not in parameters:
                yield f"a {what} fills {rule.target}, which is no parameter"
            if strangers := _strangers(drive, rule.value, parameters):
                yield f"the {what} for {rule.target} needs {', '.join(strangers)}, which no key gives"
    taken = [p.key for p in drive.parameters if p.table == Table.DESIGN]
    for name, value, _ in drive.sizes:
        if name in taken:
            yield f"the size {name!r} is also a key of the design or another size; rename one of them"
        taken.append(name)
        if strangers := _strangers(drive, value, parameters):
            yield f"the size {name} needs {', '.join(strangers)}, which no key gives"
    if strangers := _strangers(drive, drive.reference_angle, parameters):
        yield f"the reference angle needs {', '.join(strangers)}, which no key gives"


def _guards(drive: Drive) -> Iterator[str]:
    parameters, keys = {p.symbol for p in drive.parameters}, _places(drive)
    for guard in drive.guards:
        if not guard.keys:
            yield f"the guard {guard.message!r} names no keys; name those that meet in it"
        for key in guard.keys:
            if key not in keys:
                yield f"the guard {guard.message!r} names the key {key!r}, which is not declared"
        if strangers := _strangers(drive, guard.positive, parameters):
            yield f"the guard {guard.message!r} needs {', '.join(strangers)}, which no key gives"


def _sample(drive: Drive) -> Iterator[str]:
    keys = {_in_sample(p) for p in drive.parameters}
    for key in drive.sample:
        if key not in keys:
            yield f"the sample design gives {key!r}, which is no key of the drive"
    for p in drive.parameters:
        if p.required and _in_sample(p) not in drive.sample:
            yield f"the sample design lacks {_in_sample(p)!r}, which is required"
    for group in drive.exclusive:
        if len(drive.sample.keys() & {*group}) != 1:
            yield f"the sample design must give exactly one of {', '.join(group)}"
    try:
        known = isfinite(drive.sample_angle)
    except TypeError:
        known = False
    if not known:
        yield f"the sample angle is {drive.sample_angle!r}; give the input angle of a contact in rad"


def _domains(drive: Drive) -> Iterator[str]:
    for p in drive.parameters:
        if p.default is not None and not within(p, p.default):
            yield f"the default {p.default} of the key {p.key!r} is outside its domain; change one of them"
        if _in_sample(p) not in drive.sample:
            continue
        given = drive.sample[_in_sample(p)]
        try:
            inside = within(p, sp.Rational(str(given)) * p.factor)
        except (TypeError, ValueError):
            yield f"the sample design gives {given!r} for {_in_sample(p)!r}; give a number, or leave the key out"
            continue
        if not inside:
            yield f"the sample design gives {given} for {_in_sample(p)!r}, outside its domain; change one of them"


def within(p: Parameter, value: sp.Expr | mpmath.mpf) -> bool:
    """Whether a number, in inner units, is one that the parameter may have."""
    low, high = map(float, p.symbol.domain)
    return low < float(value) < high or p.lower_included and low == float(value)


def _systems(drive: Drive) -> Iterator[str]:
    if len(drive.residual) != len(drive.unknowns):
        yield f"{len(drive.residual)} equations of contact for {len(drive.unknowns)} unknowns"
    unknowns = {u.symbol for u in drive.unknowns}
    if drive.error not in unknowns:
        yield f"the transmission error {drive.error} is not among the unknowns"
    for missing in unknowns - drive.start.outputs.keys():
        yield f"the start gives no value for the unknown {missing}"
    for missing in {u.symbol for u in drive.start.unknowns} - drive.guess.keys():
        yield f"the start has no guess for its unknown {missing}; give one in guess"
    known = unknowns | {p.symbol for p in drive.parameters} | {drive.instant}
    for equation in drive.residual:
        if strangers := _strangers(drive, equation, known):
            yield f"the equations of contact need {', '.join(strangers)}, which nothing gives"
    parameters = {p.symbol for p in drive.parameters}
    for u in (*drive.unknowns, *drive.start.unknowns):
        if strangers := _strangers(drive, u.scale, parameters):
            yield f"the natural size of the unknown {u.symbol} needs {', '.join(strangers)}, which no key gives"
    if drive.wheel_angle is not None and (
        strangers := _strangers(drive, drive.wheel_angle, parameters | {drive.instant, drive.error})
    ):
        yield f"the wheel's angle needs {', '.join(strangers)}, which nothing gives"
    if drive.ratio is not None and (strangers := _strangers(drive, drive.ratio, parameters)):
        yield f"the ratio needs {', '.join(strangers)}, which nothing gives"
    begun = parameters | {drive.instant} | {u.symbol for u in drive.start.unknowns} | drive.start.fixed.keys()
    parts = [*((f"the start of {symbol}", value) for symbol, value in drive.start.outputs.items())]
    parts += [("an equation of the start", equation) for equation in drive.start.residual]
    parts += [(f"the guess of {symbol}", value) for symbol, value in drive.guess.items()]
    for what, expression in parts:
        if strangers := _strangers(drive, expression, begun):
            yield f"{what} needs {', '.join(strangers)}, which neither design nor input angle gives"


def _design_systems(drive: Drive) -> Iterator[str]:
    parameters, keys = {p.symbol for p in drive.parameters}, _places(drive)
    for system in drive.systems:
        where, unknowns = f"the design system {system.name}", {u.symbol for u in system.unknowns}
        for target in system.fills.keys() - parameters:
            yield f"{where} fills {target}, which is no parameter"
        if len(system.residual) != len(system.unknowns):
            yield f"{where} has {len(system.residual)} equations for {len(system.unknowns)} unknowns"
        for missing in unknowns - system.guess.keys():
            yield f"{where} has no guess for its unknown {missing}; give one in guess"
        for key in system.keys:
            if key not in keys:
                yield f"{where} names the key {key!r}, which is not declared"
        known = parameters | unknowns | {PATH} | system.fixed.keys()
        sign = [*system.regular[0].body_point, system.regular[1]] if system.regular else []
        for expression in (*system.residual, *system.guess.values(), *system.fills.values(), *sign):
            if strangers := sorted(q.name for q in system.definitions.free(expression) if q not in known):
                yield f"{where} needs {', '.join(strangers)}, which is no key and none of its unknowns"


def _functions(drive: Drive) -> Iterator[str]:
    parameters = {p.symbol for p in drive.parameters}
    keys = _places(drive) | {f"{p.table}.{p.key}" for p in drive.parameters}
    for f in drive.functions:
        for name, value in ((r.name, value) for r in f.results for value in r.values):
            if strangers := _strangers(drive, value, parameters | {*f.arguments}):
                yield f"{name!r} of {f.name} needs {', '.join(strangers)}, which neither its arguments nor a key gives"
        if missing := [name for name in read_of(f.name) if name not in {r.name for r in f.results}]:
            yield f"the function {f.name!r} gives no {', '.join(missing)}, which limits are read from; add them"
    names = {f.name for f in drive.functions}
    if 0 < len(names.intersection(WITH_GENERATION)) < len(WITH_GENERATION):
        missing = [name for name in WITH_GENERATION if name not in names]
        yield f"the functions {', '.join(missing)} are missing, which limits read beside the others of its generation"
    for member, least in drive.least_teeth.items():
        if member not in [body.name for body in drive.bodies]:
            yield f"least_teeth names the member {member!r}, which is not there"
        for key in (least.teeth, *least.proportional):
            if key not in keys:
                yield f"least_teeth of the {member} names the key {key!r}, which is not declared"
    for what, key in drive.loading.keys.items() if drive.loading else ():
        if key not in keys:
            yield f"loading: {what} names the key {key!r}, which is not declared"


def _bodies(drive: Drive) -> Iterator[str]:
    """Members are called by the names that every command knows; what a surface is said to be is known of it."""
    parameters = {p.symbol for p in drive.parameters}
    for body, name in zip(drive.bodies, ("pinion", "wheel"), strict=True):
        if body.name != name:
            yield f"the member {name} is named {body.name!r}; name it {name!r}"
        own = parameters | {*body.surface.parameters}
        for q in body.recovered:
            if strangers := _strangers(drive, q, own):
                yield f"the {name} recovers {', '.join(strangers)}, which nothing gives"
        if body.regular is None and (missing := {*body.surface.parameters} - body.reference.keys()):
            names = ", ".join(sorted(q.name for q in missing))
            yield f"the {name} has no sign `regular`, and its reference point gives no {names}; give either"
    for member in (*drive.bodies, *drive.regions):
        if member.regular is not None:
            known = parameters | {*member.surface.parameters}
            if strangers := _strangers(drive, member.regular, known):
                yield f"the sign `regular` of the {member.name} needs {', '.join(strangers)}, which nothing gives"


def _turns(drive: Drive) -> Iterator[str]:
    """Each member turns about one axis: the pinion by the input angle, the wheel in proportion to it and by the
    transmission error. The ratio of the drive is that of these motions, and said nowhere else.
    """
    for body, variable in ((drive.pinion, drive.instant), (drive.wheel, drive.error)):
        try:
            body.motion.axis(variable)
        except ValueError as error:
            yield f"the motion of the {body.name}: {error}"
    try:
        ratio = drive.law
    except ValueError as error:
        yield f"the motion of the wheel: {error}; turn it by a ratio times {drive.instant} plus {drive.error}"
    else:
        if ratio.is_zero:
            yield f"the motion of the wheel: the ratio is zero, {drive.instant} does not turn it"
    if any(sp.sympify(e).has(drive.error) for factor in drive.pinion.motion.factors for e in factor.expressions()):
        yield f"the motion of the pinion: {drive.error} moves it; only the wheel turns by the transmission error"


def _law(drive: Drive) -> Iterator[str]:
    """What else a page says of the ratio is what the motion of the wheel has."""
    ratio, keep = drive.law, "it follows from the motion: leave it out, or correct the motion"
    if strangers := _strangers(drive, ratio, {p.symbol for p in drive.parameters}):
        yield f"the motion of the wheel turns it by what needs {', '.join(strangers)}, which nothing gives"
    turned = f"the motion of the wheel turns it by {_short(drive.definitions.resolve(ratio))} for one radian of "
    turned += f"{drive.instant}"
    sizes = (value for name, value, _ in drive.sizes if name == RATIO)
    for what, said in (("the ratio", drive.ratio), ("the size 'ratio'", next(sizes, None))):
        if said is not None and not _same(drive, said, ratio):
            yield f"{turned}, {what} is {_short(drive.definitions.resolve(said))}; {keep}"
    if drive.wheel_angle is not None:
        slopes = [partial(drive.definitions.resolve(drive.wheel_angle), q) for q in (drive.instant, drive.error)]
        for said, wanted in zip(slopes, (ratio, sp.S.One), strict=True):
            if not _same(drive, said, wanted):
                yield (
                    f"{turned}, the wheel's angle by {_short(slopes[0])}, and by {_short(slopes[1])} for one of "
                    f"{drive.error}; {keep}"
                )


def _same(drive: Drive, one: sp.Expr, other: sp.Expr) -> bool:
    difference = drive.definitions.resolve(one) - drive.definitions.resolve(other)
    return difference == 0 or vanishes(difference)


def _short(expression: sp.Expr) -> str:
    """An expression as a message shows it."""
    text = str(expression)
    return text if len(text) < 80 else f"{text[:76]} ..."


#: Designs of whole numbers at which the teeth of the wheel are counted.
COUNTED = 4


def _indexed(drive: Drive) -> Iterator[str]:
    """One tooth on, the pair is the same: teeth of the pinion over the ratio of the motions are whole teeth of the
    wheel, whatever whole numbers a design gives.
    """
    key = next(p for p in drive.parameters if drive.pinion_teeth in (p.key, p.place))
    count = sp.sympify(key.symbol / drive.definitions.resolve(drive.law))
    counted = [p.symbol for p in drive.parameters if p.integer or p.choices]
    whole = {q: -1 if float(q.domain[1]) <= 0.0 else 1 for q in counted}
    if drive.definitions.free(count) - {*whole}:
        return
    for k in range(1, COUNTED + 1):
        places = {q: sense * sp.Integer(sp.prime(k + 3 * n + 2)) for n, (q, sense) in enumerate(whole.items())}
        teeth = replaced(count, places)
        if not (isinstance(teeth, sp.Integer) and int(teeth) > 0):
            at = ", ".join(f"{q} = {places[q]}" for q in whole if drive.definitions.depends(count, q))
            yield (
                f"the motion of the wheel gives it {_short(count)} teeth to {key.symbol} of {key.key!r}: {teeth} where "
                f"{at}; it needs a whole number of them: turn it by {key.symbol} over its teeth times {drive.instant}, "
                f"in the sense of {drive.error}"
            )


def _solids(drive: Drive) -> Iterator[str]:
    """Sizes of solid teeth are known ones, in their units."""
    profiles = {(body.name, "flank"): body.surface.parameters[0] for body in drive.bodies}
    profiles |= {(region.member, region.name): region.surface.parameters[0] for region in drive.regions}
    for function in drive.functions:
        if not function.name.startswith(SOLID):
            continue
        member = function.name.removeprefix(SOLID)
        if member not in (names := [body.name for body in drive.bodies]):
            yield f"{function.name} is of no member; use {' or '.join(SOLID + name for name in names)}"
        given = {r.name for r in function.results} | {f.name for f in drive.functions}
        if "tip_radius" in given and not given & {"taper", OUTLINE + member}:
            yield f"{function.name} is of a thread with neither a taper nor the function {OUTLINE}{member}; give one"
        for r in function.results:
            where = f"the size {r.name!r} of {function.name}"
            if (unit := SOLID_UNITS.get(r.name)) is None:
                yield f"{where} is none that a solid has; use one of {', '.join(SOLID_UNITS)}"
            elif unit in ("flank", "fillet"):
                if (profile := profiles.get((member, unit))) is None:
                    yield f"{where} is of a {unit}, which the {member} does not have; leave it out, or add the region"
                elif r.unit != profile.unit:
                    yield f"{where} is in {r.unit!r}; give it in {profile.unit!r}, as the {unit}'s parameter {profile}"
            elif r.unit != unit:
                yield f"{where} is in {r.unit!r}; give it in {unit!r}"


def _exact(drive: Drive) -> Iterator[str]:
    """Numbers are exact and real: an inexact one has no place in a proof, one that is no number none in a gear.
    Functions are those that generated code computes.
    """
    yield from _inexact(_expressions(drive), COMPUTED.keys())
    proportions = ((f"the proportion for {rule.target}", rule.value) for rule in drive.proportions)
    yield from _inexact(proportions, (*COMPUTED, sp.Min, sp.Max))


def _inexact(expressions: Iterable[tuple[str, Number]], functions: Collection[type[sp.Expr]]) -> Iterator[str]:
    seen: set[sp.Expr] = set()
    for what, expression in expressions:
        for part in _parts(sp.sympify(expression), seen):
            if isinstance(part, sp.Float):
                yield f"{what} has the inexact number {part}; write it as a sympy.Rational"
            elif not part.args:
                if not (isinstance(part, sp.Symbol | sp.Rational) or part is sp.pi):
                    yield f"{what} has {part}, which is no real number, or has no exact form in a description"
            elif isinstance(part, sp.Pow):
                if not (isinstance(part.exp, sp.Rational) and part.exp.q in (1, 2)):
                    yield f"{what} has the power {part}; only whole and half powers are computed"
            elif not isinstance(part, sp.Add | sp.Mul) and part.func not in functions:
                names = ", ".join(function.__name__ for function in functions)
                yield f"{what} uses {part.func.__name__}, which is not computed there; use {names} or sqrt"


def _parts(expression: sp.Expr, seen: set[sp.Expr]) -> Iterator[sp.Expr]:
    """Parts of an expression, each before its own, without those ``seen`` before, to which they are added."""
    pending = [expression]
    while pending:
        part = pending.pop()
        if part not in seen:
            seen.add(part)
            yield part
            pending += part.args


def _expressions(drive: Drive) -> Iterator[tuple[str, Number]]:
    """Every expression of the description, and what it is."""
    yield from ((f"the definition of {symbol}", value) for symbol, value in drive.definitions.items())
    yield from ((f"the default of {p.key}", p.default) for p in drive.parameters if p.default is not None)
    yield from ((f"the rule for {rule.target}", rule.value) for rule in drive.rules)
    yield from ((f"the guard {guard.message!r}", guard.positive) for guard in drive.guards)
    yield from ((f"the size {name}", value) for name, value, _ in drive.all_sizes)
    yield from (("an equation of contact", equation) for equation in drive.residual)
    yield from ((f"the start of {symbol}", value) for symbol, value in drive.start.outputs.items())
    yield from (("an equation of the start", equation) for equation in drive.start.residual)
    yield from ((f"the guess of {symbol}", value) for symbol, value in drive.guess.items())
    yield from ((f"the natural size of the unknown {u.symbol}", u.scale) for u, _ in unknowns(drive))
    said = (("the ratio", drive.ratio), ("the wheel's angle", drive.wheel_angle))
    yield from ((what, value) for what, value in said if value is not None)
    yield ("the reference angle", drive.reference_angle)
    for member in (*drive.bodies, *drive.regions):
        if isinstance(member, Region) or member.regular is not None:
            yield f"the sign `regular` of the {member.name}", cast("Number", member.regular)
        yield from ((f"the limit {m.event!r} of the {member.name}", m.positive) for m in member.margins)
    for function in drive.functions:
        yield from ((f"{r.name} of {function.name}", value) for r in function.results for value in r.values)


def unknowns(drive: Drive) -> Iterator[tuple[Unknown, Definitions]]:
    """The unknowns of contact, start and design systems, and what their natural sizes may name."""
    yield from ((u, drive.definitions) for u in (*drive.unknowns, *drive.start.unknowns))
    yield from ((u, system.definitions) for system in drive.systems for u in system.unknowns)


def _limits(drive: Drive) -> Iterator[str]:
    surfaces: list[tuple[str, str, Surface, tuple[Quantity, ...], tuple[Margin, ...]]] = [
        *((body.name, "flank", body.surface, body.point, body.margins) for body in drive.bodies),
        *((r.member, r.name, r.surface, (), r.margins) for r in drive.regions),
    ]
    there = {(member, name) for member, name, *_ in surfaces}
    parameters = {p.symbol for p in drive.parameters}
    for member, name, surface, point, margins in surfaces:
        known = parameters | {*surface.parameters} | {*point}
        for m in margins:
            where = f"the limit {m.event!r} of the {member}'s {name}"
            if m.event not in EVENTS:
                yield f"{where} is no known event; use one of {', '.join(EVENTS)}"
            if m.flag not in FLAGS:
                yield f"{where} has the unknown flag {m.flag!r}; use one of {', '.join(filter(None, FLAGS))}"
            if not isinstance(m.role, Role):
                yield f"{where} has the unknown role {m.role!r}; use one of {', '.join(r.name for r in Role)}"
            elif m.role is Role.JUNCTION and not m.joins:
                yield f"{where} is a junction and joins nothing; name the region of the {member} that goes on there"
            elif m.role is not Role.JUNCTION and m.event in OWN_ROLES and m.role.value != m.event:
                yield f"{where} has the role {m.role.name} of another event; leave the role out, or name that event"
            if m.ends and (m.role is not Role.FACE or len(m.ends) != 2):
                yield f"{where} has the ends {m.ends!r}; give two words to a face, and none to another limit"
            if strangers := _strangers(drive, m.positive, known):
                yield f"{where} needs {', '.join(strangers)}, which neither surface nor design gives"
            if m.along is not None and m.along not in surface.parameters:
                yield f"{where} runs along {m.along}, which is no parameter of the surface"
            if m.joins and (member, m.joins) not in there:
                yield f"{where} joins the region {m.joins!r}, which the {member} does not have"
        for event, count in Counter(m.event for m in margins).items():
            if count > 1:
                yield f"the {member}'s {name} has {count} limits {event!r}; give each an event of its own, or join them"
        if len(surface.parameters) != len(surface.conditions) + 2:
            count = f"{len(surface.parameters)} parameters for {len(surface.conditions)} conditions"
            yield f"the {member}'s {name} has {count}; a surface has two more"
