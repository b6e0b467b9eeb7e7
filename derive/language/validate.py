"""What a description must be before anything is derived from it: every name has one meaning, every limit a known one.

:func:`validate` reads the description alone; :func:`validate_normals` and :func:`validate_ratio` look at a solved
contact of the sample design, :func:`validate_regions` at the places where fillets and flanks of that design join,
:func:`validate_outlines` at what the drives of a family have together.
"""

import re
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any, TypeAlias

import mpmath
import sympy as sp

from derive.language.differentiate import partial
from derive.language.drive import PATH, Body, Drive, Margin, Role
from derive.language.functions import OUTLINE, SOLID, SOLID_UNITS
from derive.language.outline import OPTIONS, Outline
from derive.language.sampled import COMPUTED, NoValue, value_of, vanishes
from derive.language.surface import Surface
from derive.language.symbols import Parameter, Quantity, Table, foreign_unit, interface_unit, unit_suffixes
from derive.language.vectors import Number

#: The observation of a contact, by name, and its inputs.
Observed: TypeAlias = Mapping[str, Sequence[mpmath.mpf]]
Numbers: TypeAlias = Mapping[sp.Symbol, mpmath.mpf]

#: What a point of a flank may be marked with, "" where a region has no flag of its own.
FLAGS = ("", "undercut", "interference", "beyond_regression", "spurious_sheet", "off_tip", "off_root", "off_face",
         "off_tool", "edge_contact")  # fmt: skip

#: What may end contact, and what may end a region.
EVENTS = ("tip", "throat", "face", "root", "tool_end", "undercut", "regression", "fold", "spurious_sheet", "junction",
          "bottom")  # fmt: skip


class DescriptionError(ValueError):
    """A description that contradicts itself; the message names the drive, the part and the remedy."""


@dataclass(frozen=True)
class Joint:
    """A place where the ``region`` of a ``member`` joins the flank, on the ``flank`` of the teeth of that name.

    ``normals``: cosine of the angle between both normals. ``ways``: the same of the direction into the region, across
    the joint, and that out of the flank. ``regular``: of region and flank, what is to be positive on the real surface.
    """

    member: str
    region: str
    flank: str
    normals: float
    ways: float
    regular: tuple[float, float]


def validate(drive: Drive) -> None:
    """Raise :class:`DescriptionError` for the first contradiction in a drive's description."""
    checks = (
        _keys, _units, _names, _words, _exact, _completion, _guards, _sample, _domains, _systems, _turns, _limits,
        _solids,
    )  # fmt: skip
    for check in checks:
        for message in check(drive):
            raise DescriptionError(f"{drive.name}: {message}")


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
    for key in (*(p.key for p in drive.parameters), *(key for key, *_ in drive.sizes)):
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


def _domains(drive: Drive) -> Iterator[str]:
    for p in drive.parameters:
        if p.default is not None and not _within(p, p.default):
            yield f"the default {p.default} of the key {p.key!r} is outside its domain; change one of them"
        if (given := drive.sample.get(_in_sample(p))) is None:
            continue
        try:
            inside = _within(p, sp.Rational(str(given)) * p.factor)
        except (TypeError, ValueError):
            yield f"the sample design gives {given!r} for {_in_sample(p)!r}; give a number"
            continue
        if not inside:
            yield f"the sample design gives {given} for {_in_sample(p)!r}, outside its domain; change one of them"


def _within(p: Parameter, value: sp.Expr) -> bool:
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
    known = unknowns | {p.symbol for p in drive.parameters} | {drive.instant}
    for equation in drive.residual:
        if strangers := _strangers(drive, equation, known):
            yield f"the equations of contact need {', '.join(strangers)}, which nothing gives"
    parameters = {p.symbol for p in drive.parameters}
    for what, expression, given in (
        ("the ratio", drive.ratio, parameters),
        ("the wheel's angle", drive.wheel_angle, parameters | {drive.instant, drive.error}),
    ):
        if strangers := _strangers(drive, expression, given):
            yield f"{what} needs {', '.join(strangers)}, which nothing gives"
    for system in drive.systems:
        for target in system.fills.keys() - parameters:
            yield f"the design system {system.name} fills {target}, which is no parameter"


def _turns(drive: Drive) -> Iterator[str]:
    """Each member turns about one axis: the pinion by the input angle, the wheel by the transmission error too."""
    for body, variable in ((drive.pinion, drive.instant), (drive.wheel, drive.error)):
        try:
            body.motion.axis(variable)
        except ValueError as error:
            yield f"the motion of the {body.name}: {error}"
    angle, ratio = map(drive.definitions.resolve, (drive.wheel_angle, drive.ratio))
    slope = partial(angle, drive.instant)
    if slope != ratio and not vanishes(slope - ratio):
        yield f"the wheel turns by {slope} for one radian of {drive.instant}, the ratio is {ratio}; make both the same"


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
    yield from _inexact(_expressions(drive), COMPUTED)
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
    yield from ((f"the size {name}", value) for name, value, _ in drive.sizes)
    yield from (("an equation of contact", equation) for equation in drive.residual)
    yield from ((f"the start of {symbol}", value) for symbol, value in drive.start.outputs.items())
    yield from (("the ratio", drive.ratio), ("the wheel's angle", drive.wheel_angle))
    for member in (*drive.bodies, *drive.regions):
        yield from ((f"the limit {m.event!r} of the {member.name}", m.positive) for m in member.margins)
    for function in drive.functions:
        yield from ((f"{r.name} of {function.name}", value) for r in function.results for value in r.values)


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
            if strangers := _strangers(drive, m.positive, known):
                yield f"{where} needs {', '.join(strangers)}, which neither surface nor design gives"
            if m.along is not None and m.along not in surface.parameters:
                yield f"{where} runs along {m.along}, which is no parameter of the surface"
            if m.joins and (member, m.joins) not in there:
                yield f"{where} joins the region {m.joins!r}, which the {member} does not have"
        if len(surface.parameters) != len(surface.conditions) + 2:
            count = f"{len(surface.parameters)} parameters for {len(surface.conditions)} conditions"
            yield f"the {member}'s {name} has {count}; a surface has two more"
    if sp.sympify(drive.ratio).is_zero:
        yield "the ratio is zero"


#: Components of two opposite unit normals add up to less than this: the sample's contact is solved in many digits.
OPPOSITE = 1e-9


def validate_normals(drive: Drive, observed: Observed, values: Numbers) -> None:
    """Raise :class:`DescriptionError` unless both normals point out of their bodies at the sample's contact.

    ``observed`` holds the observation of that contact, name → numbers, ``values`` its inputs, symbol → number. Two
    normals out of two bodies that touch are opposite. Along them the bodies part: where all relative curvatures have
    one sign it is positive, and both normals turned round make it negative, since each body is then taken for the space
    beside it. A sample that interferes in one direction and parts in the other leaves that open; there a tooth must
    narrow towards its tip: the normal has a component towards it.
    """
    first, second = (observed[f"normal_{body.name}_f"] for body in drive.bodies)
    names = " and ".join(body.name for body in drive.bodies)
    if not _dot(first, second) < 0:
        raise DescriptionError(
            f"{drive.name}: the normals of {names} point the same way in contact; one points inward, or the sample's "
            "contact lies off the teeth: choose another sample design or angle then"
        )
    if not max(abs(a + b) for a, b in zip(first, second, strict=True)) < OPPOSITE:
        raise DescriptionError(
            f"{drive.name}: the normals of {names} are not opposite where the sample's surfaces should touch: it has "
            "no contact at its angle; choose another sample design or angle"
        )
    low, high = observed["curvature_gap"]
    least = max(abs(low), abs(high)) / 10**6
    if high < least or (low < -least and not _narrows(drive, observed, values)):
        raise DescriptionError(
            f"{drive.name}: both normals point inward: the bodies overlap along them (relative curvatures "
            f"{float(low):.3g} and {float(high):.3g} per mm); turn round the surfaces from which the chains begin"
        )


#: Share by which a pair may transmit another ratio at one contact than over a turn: an error of motion is far smaller.
OFF_RATIO = 0.05


def validate_ratio(drive: Drive, observed: Observed, values: Numbers) -> None:
    """Raise :class:`DescriptionError` unless flanks transmit the ratio of the description at the sample's contact.

    Arguments as of :func:`validate_normals`.
    """
    pinion, wheel = (observed[f"lever_arm_{body.name}"][0] for body in drive.bodies)
    ratio, found = float(value_of(drive.ratio, values, drive.definitions)), float(pinion / wheel)
    if not abs(found - ratio) <= OFF_RATIO * abs(ratio):
        raise DescriptionError(
            f"{drive.name}: the ratio is {ratio:.6g}, but the flanks transmit {found:.6g} at the sample's "
            "contact; give turns of the wheel per turn of the pinion: pinion teeth over wheel teeth"
        )


def validate_outlines(drives: Iterable[Drive]) -> None:
    """Raise :class:`DescriptionError` for what the outlines of families, of which these are all drives, name but none
    has.
    """
    families: dict[str, list[Drive]] = {}
    for drive in drives:
        families.setdefault(drive.family, []).append(drive)
    for family, members in families.items():
        outline = next((drive.outline for drive in members if drive.outline), None)
        for message in _outline(outline(), members) if outline else ():
            raise DescriptionError(f"outline of the family {family}: {message}")


def _outline(outline: Outline, drives: Sequence[Drive]) -> Iterator[str]:
    words: dict[str, set[str]] = {}
    for key, word in ((key, word) for drive in drives for key, word in drive.variant.items()):
        words.setdefault(key, set()).update({word} if isinstance(word, str) else ())
    places = {f"{p.table}.{p.key}" for drive in drives for p in drive.parameters} | {f"design.{key}" for key in words}
    known = {q.name for q in OPTIONS}
    if unknown := outline.options.keys() - {"m", "z", "a"}:
        yield f"the options {', '.join(sorted(unknown))} are none of m, z and a; leave them out"
    for key, word in outline.words.items():
        if word not in words.get(key, ()) and word:
            yield f"{key} = {word!r} chooses no drive; {_offer(words.get(key) or words)}"
    for s in outline.suggestions:
        what = f"the suggestion for {s.place or s.name}"
        if s.place and s.place not in places and s.place != "design.hand":
            yield f"{what}: no drive has this key; {_offer(get_close_matches(s.place, places, n=1))}"
        for key, meant in s.words.items():
            if unknown := {*meant} - words.get(key, set()):
                chosen = f"{key} = {', '.join(sorted(unknown))}"
                yield f"{what}: {chosen} chooses no drive; {_offer(words.get(key) or words)}"
        for value in (*s.values, *(s.within or ())):
            if unknown := {str(q) for q in sp.sympify(value).free_symbols} - known:
                yield f"{what} uses {', '.join(sorted(unknown))}, which no option and none before it gives"
        known.add(s.symbol.name)


def _offer(names: Iterable[str]) -> str:
    return f"use {' or '.join(listed)}" if (listed := sorted(names)) else "leave it out"


def validate_regions(drive: Drive, joints: Iterable[Joint]) -> None:
    """Raise :class:`DescriptionError` unless regions that join a flank are regular where they go on from it.

    One tool with a profile that has no corner there cuts both: they have one tangent plane, and normals out of one body
    are one. The region begins where the flank ends; past a singular line a surface turns back, each of them by itself.
    So the region is real where it goes on from a real flank, or back beside one that is past its singular line.
    """
    for joint in joints:
        where = f"{drive.name}: the {joint.region} of the {joint.member}, with flank {joint.flank!r},"
        if joint.normals < 0.0:
            raise DescriptionError(
                f"{where} has a normal that points into the body: at the joint it is opposite to that of the flank; "
                "turn round the surface, where that is needed with the sign of the flank"
            )
        own, other = joint.regular
        if own * other * joint.ways < 0.0:
            raise DescriptionError(
                f"{where} has the wrong sign of `regular`: where it {'goes on from' if joint.ways > 0 else 'turns at'} "
                f"the flank, which is {'regular' if other > 0 else 'past its singular line'} there, `regular` times "
                f"its singular function is {own:.3g}; give the other sign, where that is needed with that of the flank"
            )


def _narrows(drive: Drive, observed: Observed, values: Numbers) -> bool:
    """Whether a tooth whose tip is a limit of its body coordinates is the narrower the nearer to it.

    Where no tip is such a limit, or the teeth disagree, this decides nothing: the normals are taken as they are.
    """
    found = [
        _dot(_body_normal(drive, body, observed, values), slope) < 0
        for body in drive.bodies
        for m in body.margins
        if m.role is Role.TIP
        and {*body.point} & m.positive.free_symbols
        and (slope := _slope(drive, body, m, observed, values)) is not None
    ]
    return not found or any(found)


def _body_normal(drive: Drive, body: Body, observed: Observed, values: Numbers) -> list[mpmath.mpf]:
    turned = body.motion.inverse().direction(tuple(map(sp.Float, observed[f"normal_{body.name}_f"])))
    return [value_of(c, values, drive.definitions) for c in turned]


def _slope(drive: Drive, body: Body, margin: Margin, observed: Observed, values: Numbers) -> list[mpmath.mpf] | None:
    """Gradient of a margin by the body coordinates; None where it has none or hangs on keys that the sample leaves
    open.
    """
    at = {**values, **dict(zip(body.point, observed[f"point_{body.name}"], strict=True))}
    try:
        slope = [value_of(partial(margin.positive, q), at, drive.definitions) for q in body.point]
    except NoValue:
        return None
    return slope if all(map(mpmath.isfinite, slope)) else None


def _dot(a: Sequence[Any], b: Sequence[Any]) -> Any:
    return sum(p * q for p, q in zip(a, b, strict=True))
