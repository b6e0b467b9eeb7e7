"""Where a region of a tooth, such as its fillet, joins the flank: at the sample design, for either flank."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import sympy as sp

from derive.language.drive import Drive, Margin
from derive.language.refusal import DescriptionError
from derive.language.sampled import NoValue, value_of
from derive.language.symbols import Table
from derive.language.validate_sample import Joint
from derive.passes.plan import Flank, Schedule
from derive.passes.sample import Completion, NoSample, Values, in_double, near, solution, solve

Row: TypeAlias = list[float]

#: Steps to a joint at most; the step, in natural sizes, at which it is found; and by which share of its diagonal the
#: matrix grows at first, in the method of Levenberg and Marquardt: a place along the joint is as good as another.
STEPS, STILL, DAMPING = 100, 1e-9, 1e-3

#: Where so many steps one after another each leave more than this share of the squares, they are at their least: flank
#: and region come near each other there, and no nearer.
SLOW, LEFT = 3, 0.9

#: Flank and region that are further apart than this, mm, or whose normals' cosine is less, do not join but cross: all
#: that modifications of a flank part and turn is less.
APART, TANGENT = 0.1, 0.9


@dataclass(frozen=True)
class _Place:
    """A surface at a place: ``equations`` are the margin at its joint and its conditions, with their ``slopes`` by the
    parameters.
    """

    point: Row
    normal: Row
    tangents: list[Row]
    regular: float
    equations: Row
    slopes: list[Row]

    def way(self) -> Row:
        """The unit direction across the joint in which the margin there grows, its conditions kept."""
        # least |tangents · q| with slopes · q = (1, 0 …): Lagrange's equations, each parameter in lengths of its own
        lengths = [math.hypot(*t) or 1.0 for t in self.tangents]  # a condition's own parameter may move no point
        tangents = [[c / length for c in t] for t, length in zip(self.tangents, lengths, strict=True)]
        slopes = [_unit([s / length for s, length in zip(row, lengths, strict=True)]) for row in self.slopes]
        rows = [[_dot(a, b) for b in tangents] + [row[k] for row in slopes] for k, a in enumerate(tangents)]
        rows += [[*row, *[0.0] * len(slopes)] for row in slopes]
        wanted = [0.0] * len(tangents) + [1.0] + [0.0] * (len(slopes) - 1)
        change = _solved(rows, wanted)
        return _unit([sum(change[k] * t[axis] for k, t in enumerate(tangents)) for axis in range(3)])


class _Surface:
    """A flank or region, and the number of the margin at which it joins the other one."""

    def __init__(self, plan: Schedule, of: Flank, margin: int) -> None:
        n, outputs = len(of.parameters), {o.name: o.nodes for o in of.outputs}
        expansion = next(e for e in plan.expansions if e.of is of)
        self.parameters = of.parameters
        self._parts = [
            [*outputs["point"]], [*outputs["normal"]],
            *([*outputs[f"tangent_{q}"]] for q in of.parameters),
            [outputs["regular"][0]], [of.limits[1 + margin], *of.conditions],
            [*expansion.slopes[(1 + margin) * n : (2 + margin) * n]],
            *([*outputs[f"condition_{k}_slopes"]] for k in range(len(of.conditions))),
        ]  # fmt: skip
        self._evaluate = plan.tape.evaluator([i for part in self._parts for i in part])

    def at(self, inputs: Mapping[sp.Symbol, float], q: Sequence[float]) -> _Place:
        numbers = iter(self._evaluate({**inputs, **dict(zip(self.parameters, q, strict=True))}))
        point, normal, *rest = [[next(numbers) for _ in part] for part in self._parts]
        n = len(self.parameters)
        return _Place(point, normal, rest[:n], rest[n][0], rest[n + 1], rest[n + 2 :])


def joints(plan: Schedule) -> list[Joint]:
    """The joints of all regions, for each flank with which the sample design has a place to start from. An error where
    a region meets on neither flank the one that it says it joins, and both are of one design.
    """
    pairs = [*_pairs(plan)]
    found = [
        (of, _joint(of, region, flank, inputs, word))
        for word, inputs in (_samples(plan) if pairs else ())
        for of, region, flank in pairs
    ]
    for of, *_ in () if plan.drive.flanks_apart else pairs:
        if not any(isinstance(joint, Joint) for region, joint in found if region is of):
            apart = [distance for region, distance in found if region is of and isinstance(distance, float)]
            if apart:
                raise DescriptionError(
                    f"{plan.drive.name}: the {of.region} of the {of.body} does not meet the flank that it joins: where "
                    f"both end they are {min(apart):.3g} mm apart, or turned against each other; let it begin where "
                    "the flank ends"
                )
    return [joint for _, joint in found if isinstance(joint, Joint)]


def _pairs(plan: Schedule) -> Iterator[tuple[Flank, _Surface, _Surface]]:
    """Regions that join the flank of their member, which joins them."""
    for region, of in zip(plan.drive.regions, plan.regions, strict=True):
        for body, flank in zip(plan.drive.bodies, plan.flanks, strict=True):
            there, here = _joining(region.margins, flank.region), _joining(body.margins, region.name)
            if body.name == region.member and there is not None and here is not None:
                yield of, _Surface(plan, of, there), _Surface(plan, flank, here)


def _joining(margins: Sequence[Margin], name: str) -> int | None:
    return next((k for k, m in enumerate(margins) if m.joins == name), None)


def _samples(plan: Schedule) -> Iterator[tuple[str, Mapping[sp.Symbol, float]]]:
    """Flanks and inputs close to a contact on them: of the sample design, its blank and tools of usual proportions."""
    drive = plan.drive
    complete = Completion(drive, plan.systems)
    which = next(p for p in drive.parameters if p.table is Table.FLANK)
    for word, number in which.choices:
        if float(plan.sample[which.symbol]) == number:
            yield word, _filled(drive, in_double(plan.sample))
            continue
        try:
            design = _filled(drive, complete({**drive.sample, which.key: number}, math))
            yield word, _contact(plan, design)
        except DescriptionError:  # the other flank may need a design of its own
            continue


def _contact(plan: Schedule, design: Values) -> Values:
    try:
        return solve(plan, design, plan.drive.sample_angle, math)
    except NoSample:
        return near(plan, design, plan.drive.sample_angle, math)


def _filled(drive: Drive, design: Values) -> Values:
    """The design with the sizes of blank and tools that it leaves open."""
    design = dict(design)
    for rule in drive.proportions:
        if math.isnan(design[rule.target]):
            try:
                design[rule.target] = float(value_of(rule.value, design, drive.definitions))
            except NoValue as error:
                raise DescriptionError(
                    f"{drive.name}: the proportion for {rule.target} divides by zero or is no real number at the "
                    "sample; choose another sample design, or another proportion"
                ) from error
    return design


def _joint(
    of: Flank, region: _Surface, flank: _Surface, inputs: Mapping[sp.Symbol, float], word: str
) -> Joint | float | None:
    """The joint of a region and a flank; where they have none how far they are apart, None where one is not there."""
    n = len(region.parameters)
    start = [float(inputs.get(q, 0.0)) for q in (*region.parameters, *flank.parameters)]

    def apart(q: Row) -> tuple[Row, list[Row]]:
        one, other = region.at(inputs, q[:n]), flank.at(inputs, q[n:])
        gap = [a - b for a, b in zip(one.point, other.point, strict=True)]
        rows = [[t[k] for t in one.tangents] + [-t[k] for t in other.tangents] for k in range(3)]
        rows += [[*row, *[0.0] * len(flank.parameters)] for row in one.slopes]
        rows += [[*[0.0] * n, *row] for row in other.slopes]
        return [*gap, *one.equations, *other.equations], rows

    try:
        q = _least(apart, start)
        one, other = region.at(inputs, q[:n]), flank.at(inputs, q[n:])
    except (ArithmeticError, ValueError):
        return None
    distance, normals = math.dist(one.point, other.point), _dot(one.normal, other.normal)
    if not (distance < APART and abs(normals) > TANGENT):
        return distance
    try:
        ways = -_dot(one.way(), other.way())
    except ArithmeticError as error:
        raise DescriptionError(
            f"the {of.region} of the {of.body}, with flank {word!r}, or the flank is singular where they join; "
            "choose a sample whose joint is regular"
        ) from error
    return Joint(of.body, of.region, word, normals, ways, (one.regular, other.regular))


def _least(equations: Callable[[Row], tuple[Row, list[Row]]], q: Row) -> Row:
    """Where the sum of squares of some equations, given with their slopes, is least, from a place near it."""
    damping, slow, (values, slopes) = DAMPING, 0, equations(q)
    if not math.isfinite(_dot(values, values)):
        raise ArithmeticError("a size of the sample is missing")
    for _ in range(STEPS):
        step = _damped(values, slopes, damping)
        further = [a - b for a, b in zip(q, step, strict=True)]
        try:
            trial = equations(further)
        except (ArithmeticError, ValueError):
            trial = [math.inf], list[Row]()
        if not _dot(trial[0], trial[0]) <= _dot(values, values):
            damping *= 10.0
        else:
            slow = slow + 1 if _dot(trial[0], trial[0]) > LEFT * _dot(values, values) else 0
            damping, q, (values, slopes) = 0.1 * damping, further, trial
        if max(map(abs, step)) < STILL or slow == SLOW:
            break
    return q


def _damped(values: Row, slopes: list[Row], damping: float) -> Row:
    columns = list(zip(*slopes, strict=True))
    matrix = [[_dot(a, b) for b in columns] for a in columns]
    for k in range(len(columns)):
        matrix[k][k] *= 1.0 + damping
    return _solved(matrix, [_dot(a, values) for a in columns])


def _solved(matrix: list[Row], right: Row) -> Row:
    return solution([[*row, b] for row, b in zip(matrix, right, strict=True)], float)


def _unit(vector: Row) -> Row:
    length = math.hypot(*vector)
    return [c / length for c in vector]


def _dot(a: Sequence[float], b: Sequence[float]) -> float:
    return sum((p * q for p, q in zip(a, b, strict=True)), 0.0)
