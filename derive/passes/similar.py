"""Lengths and numbers are not added: a drive of twice the lengths is the same drive, twice as large.

Rules complete the doubled design to the doubled one. Guards, limits and functions grow by the same power of two where
all lengths are doubled, and doubled once more: at the sample's contact, keys that are zero there a little off it, and
at any place of further surfaces and functions. Input: a drive's equations on a tape with a solved contact.
"""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import mpmath
import sympy as sp

from derive.language.refusal import DescriptionError
from derive.language.symbols import Quantity, Table
from derive.passes.plan import Schedule
from derive.passes.sample import DIGITS, Completion, NoSample

#: Numbers closer to zero than this are zero, and ratios closer to a power are one: what rounding leaves is less.
NEGLIGIBLE = 1e-20

#: What stands for a zero.
OFF = mpmath.mpf(1) / 97

#: What stands for a place of a surface or an argument that the sample does not give.
ANYWHERE = mpmath.mpf(3) / 7

#: How much a completed size may be off twice another one, relative, where design systems are solved.
COMPLETED = 1e-12

_REMEDY = "where all lengths are doubled: a length and a number are added or compared in it, or its unit is another one"


def similar(plan: Schedule) -> None:
    """Raise :class:`DescriptionError` for a description that is not the same for all sizes."""
    with mpmath.workdps(DIGITS):
        for message in (*_of_rules(plan), *_of_expressions(plan)):
            raise DescriptionError(f"{plan.drive.name}: {message} {_REMEDY}; correct it")


def _of_rules(plan: Schedule) -> Iterator[str]:
    """Rules and design systems complete a doubled design to the doubled one."""
    drive, given = plan.drive, dict[str, Any]()
    for p in drive.parameters:
        key = p.key if p.table == Table.FLANK else p.place
        if key in drive.sample:
            given[key] = mpmath.mpf(str(drive.sample[key])) * 2 ** _power(p.symbol.unit)
        elif p.default is not None:
            own = plan.sample[p.symbol] / mpmath.mpf(p.factor.evalf(DIGITS))
            given[key] = own * 2 ** _power(p.symbol.unit)
    try:
        doubled = Completion(drive, plan.systems)(given)
    except NoSample:
        return
    for p in drive.parameters:
        value, wanted = doubled[p.symbol], plan.sample[p.symbol] * 2 ** _power(p.symbol.unit)
        if abs(value - wanted) > COMPLETED * (1 + abs(wanted)):
            yield f"the key {p.key!r} follows as {_shown(value)}, not {_shown(wanted)} {p.symbol.unit},"


def _of_expressions(plan: Schedule) -> Iterator[str]:
    """Guards; limits and functions too, unless a surface has a length that is written as a number: it has one size."""
    copy = plan.copy()
    outputs = [("the contact", o) for o in plan.observed]
    outputs += [(f"the {f.region} of the {f.body}", o) for f in (*plan.flanks, *plan.regions) for o in f.outputs]
    surfaces = [(where, o) for where, o in outputs if o.name.startswith(("point", "normal"))]
    # the first function is the placement, whose numbers are of several units
    others = [(f"the function {f.name}", o) for f in plan.functions[1:] for o in f.outputs]
    others += [(where, o) for where, o in outputs if o.name.startswith("margin")]
    guards = [(f"the guard {g.message!r}", copy.lower(g.positive)) for g in plan.drive.guards]
    nodes = [i for _, o in (*surfaces, *others) for i in o.nodes]
    values = _values(copy, [*nodes, *(node for _, node in guards)])

    def wrong(node: int, unit: str) -> bool:
        return (grown := values[node]) is not None and not _homogeneous(grown, _power(unit) if unit else None)

    yield from (f"{what} is another one" for what, node in guards if wrong(node, ""))
    if not any(wrong(i, o.unit) for _, o in surfaces for i in o.nodes):
        unlike = ((where, o) for where, o in others if any(wrong(i, o.unit) for i in o.nodes))
        yield from (f"{o.name} of {where} is another one" for where, o in unlike)


def _homogeneous(grown: list[Any], power: int | None) -> bool:
    """Whether three values, each with lengths doubled from the one before, grow by one power, or by this one."""
    first, second, third = grown
    if any(abs(value) < NEGLIGIBLE for value in grown):
        return True
    wanted = second / first if power is None else mpmath.mpf(2) ** power
    return bool(abs(second / first / wanted - 1) < NEGLIGIBLE and abs(third / second / wanted - 1) < NEGLIGIBLE)


def _values(plan: Schedule, nodes: Iterable[int]) -> dict[int, list[Any] | None]:
    """Node → its value once, with lengths doubled, and doubled again; None where it has none."""
    wanted = sorted(set(nodes))
    columns = [_at(plan, wanted, _inputs(plan, size)) for size in (1, 2, 4)]
    rows = zip(wanted, *columns, strict=True)
    return {node: None if any(map(mpmath.isnan, grown)) else grown for node, *grown in rows}


def _at(plan: Schedule, nodes: list[int], inputs: Mapping[sp.Symbol, Any]) -> list[Any]:
    """Values of nodes, not a number where they have none."""
    try:
        return [mpmath.mpf(value) for value in plan.tape.evaluator(nodes, mpmath)(inputs)]
    except (ArithmeticError, AttributeError, KeyError, TypeError, ValueError):
        return [mpmath.nan] if len(nodes) == 1 else [x for node in nodes for x in _at(plan, [node], inputs)]


def _inputs(plan: Schedule, size: int) -> Mapping[sp.Symbol, Any]:
    """The sample's contact, so many times as large, nothing of it zero, and a place of every other input."""
    drive = plan.drive
    others = [q for region in drive.regions for q in region.surface.parameters]
    others += [q for function in plan.functions for q in function.parameters]
    values: dict[sp.Symbol, Any] = dict.fromkeys(others, ANYWHERE)
    values |= {symbol: value or OFF for symbol, value in plan.sample.items()}
    return {q: v * mpmath.mpf(size) ** _power(q.unit if isinstance(q, Quantity) else "") for q, v in values.items()}


def _power(unit: str) -> int:
    """The power of a length that a unit is."""
    above, _, below = unit.partition("/")
    return above.count("mm") - below.count("mm")


def _shown(value: mpmath.mpf) -> str:
    return f"{float(value):.6g}"
