"""What the sample design of a description must be, and what holds of a contact of it.

:func:`validate_sample` looks at the design itself, :func:`validate_place`, :func:`validate_normals`,
:func:`validate_ratio` and :func:`validate_play` at a solved contact of it, :func:`validate_limits` around that,
:func:`validate_regions` at the places where fillets and flanks of that design join.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import mpmath
import sympy as sp

from derive.language.definitions import Definitions
from derive.language.differentiate import partial
from derive.language.drive import Body, Drive, Margin, Role
from derive.language.refusal import DescriptionError
from derive.language.sampled import NoValue, value_of
from derive.language.symbols import Quantity
from derive.language.validate import unknowns, within
from derive.language.vectors import Number

#: The observation of a contact, by name, and its inputs.
Observed: TypeAlias = Mapping[str, Sequence[mpmath.mpf]]
Numbers: TypeAlias = Mapping[sp.Symbol, mpmath.mpf]


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


def validate_sample(drive: Drive, values: Numbers) -> None:
    """Raise :class:`DescriptionError` for a sample design that is none of the drive's own: outside a domain once its
    rules are applied, against a guard, or without a natural size for an unknown.

    ``values``: the parameters of the sample design, completed, symbol → number.
    """
    for message in _of_sample(drive, values):
        raise DescriptionError(f"{drive.name}: {message}")


def _of_sample(drive: Drive, values: Numbers) -> Iterator[str]:
    for p in drive.parameters:
        if not mpmath.isnan(value := values[p.symbol]) and not within(p, value):
            shown = _shown(value / value_of(p.factor, values, drive.definitions))
            yield f"the key {p.place!r} of the sample design follows as {shown}, outside its domain; {_MEND}"
    for guard in drive.guards:
        value = _value_at(guard.positive, values, drive.definitions)
        if not value > 0:
            yield (
                f"the sample design breaks the guard {guard.message!r} of {', '.join(guard.keys)}: what must be above "
                f"0 is {_shown(value)}; {_MEND}"
            )
    for u, definitions in unknowns(drive):
        size = _value_at(u.scale, values, definitions)
        if not (size > 0 and mpmath.isfinite(size)):
            yield (
                f"the natural size of the unknown {u.symbol} is {_shown(size)} at the sample design; give one that is "
                "above 0 at every design"
            )


#: What helps where a sample is no legal design.
_MEND = "correct it, or choose another sample design"


def _shown(value: mpmath.mpf) -> str:
    return "no real number" if mpmath.isnan(value) else f"{float(value):.6g}"


def _value_at(expression: Number, values: Numbers, definitions: Definitions) -> mpmath.mpf:
    """Value of an expression, NaN where it has none."""
    try:
        return value_of(expression, values, definitions)
    except NoValue:
        return mpmath.nan


def validate_place(drive: Drive, observed: Observed) -> None:
    """Raise :class:`DescriptionError` where the sample's contact is none of real teeth: beyond a limit of a flank, or
    on another sheet of its surface. Pivots are chosen there, and normals and ratio looked at.

    ``observed`` as of :func:`validate_normals`. A limit without a value there is not applied.
    """
    for body in drive.bodies:
        (regular,) = observed[f"regular_{body.name}"]
        off = [f"its singular function is {_shown(regular)} there"] if regular < 0 else []
        for m in body.margins:
            (margin,) = observed[f"margin_{body.name}_{m.event}"]
            off += [f"its limit {m.event!r} is {_shown(margin)} there"] if margin < 0 else []
        if off:
            raise DescriptionError(
                f"{drive.name}: at the sample angle {float(drive.sample_angle):.6g} the contact is not on the "
                f"{body.name}'s tooth: {', '.join(off)}, which must not be below 0; choose another sample angle or "
                "design, or turn the sign of what is negative"
            )


#: Places at which a limit is evaluated that has no value at the contact.
TRIED = 96


def validate_limits(drive: Drive, observed: Observed, values: Numbers) -> None:
    """Raise :class:`DescriptionError` for a limit that has no value anywhere, which no point would ever violate.

    Arguments as of :func:`validate_normals`. Looked at are the contact and places around it and around zero, near and
    far. A limit that needs a key which the sample leaves open is not applied, nor looked at.
    """
    reach = max(abs(c) for body in drive.bodies for c in observed[f"point_{body.name}"])
    for place in (*drive.bodies, *drive.regions):
        at: dict[sp.Symbol, mpmath.mpf] = {**values}
        own = [*place.surface.parameters]
        if isinstance(place, Body):
            own += place.point
            at |= dict(zip(place.point, observed[f"point_{place.name}"], strict=bool(place.point)))
        for m in place.margins:
            needed = drive.definitions.free(m.positive)
            if any(mpmath.isnan(values[q]) for q in needed if q in values):
                continue
            moved = [q for q in own if q in needed]
            places = _around(at, moved, reach)
            real, beyond = _reached(m.positive, places, drive.definitions)
            where = place.name if isinstance(place, Body) else f"{place.member}'s {place.name}"
            where = f"{drive.name}: the limit {m.event!r} of the {where} is"
            if not real:
                raise DescriptionError(
                    f"{where} no real number, neither at the sample's contact nor anywhere around: it would never be "
                    "applied; correct it or leave it out"
                )
            if m.along is None and not beyond:
                raise DescriptionError(
                    f"{where} below 0 neither at the sample's contact nor anywhere around: no point would ever lie "
                    "beyond it; correct it or leave it out"
                )


def _reached(limit: Number, places: Iterable[Numbers], definitions: Definitions) -> tuple[bool, bool]:
    """Whether a limit has a value at some of these places, and whether one of them is beyond it."""
    real = False
    for there in places:
        value = _value_at(limit, there, definitions)
        if value < 0:
            return True, True
        real = real or not mpmath.isnan(value)
    return real, False


def _around(at: Numbers, moved: Sequence[Quantity], reach: mpmath.mpf) -> Iterator[Numbers]:
    """Places: where it is known the contact, then others within a few sizes of it and of zero, in three decades."""
    if all(q in at for q in moved):
        yield at
    for k in range(1, TRIED if moved else 1):
        there = {**at}
        for n, q in enumerate(moved):
            turns = k * mpmath.sqrt(sp.prime(n + 1))
            size = (reach if q.unit == "mm" else mpmath.mpf(1)) / 10 ** (k % 3)
            there[q] = (at.get(q, mpmath.mpf(0)) if k % 2 else 0) + size * (4 * (turns - mpmath.floor(turns)) - 2)
        yield there


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


#: Teeth by which a pair may transmit another ratio at one contact than over a turn: an error of motion is far smaller,
#: a tooth too many in a motion four times that.
OFF_TEETH = 0.25


def validate_ratio(drive: Drive, observed: Observed, values: Numbers) -> None:
    """Raise :class:`DescriptionError` unless flanks transmit the ratio of the motions at the sample's contact: where
    they do not, the pair after the next pitch is not in mesh.

    Arguments as of :func:`validate_normals`.
    """
    pinion, wheel = (observed[f"lever_arm_{body.name}"][0] for body in drive.bodies)
    key = next(p for p in drive.parameters if drive.pinion_teeth in (p.key, p.place))
    ratio, found = float(value_of(drive.law, values, drive.definitions)), float(pinion / wheel)
    teeth = float(values[key.symbol])
    off = abs(found / ratio - 1.0) * max(teeth, teeth / abs(ratio))
    if off <= OFF_TEETH:
        return
    if found * ratio < 0.0:
        remedy = f"turn the sense of the wheel's motion, or that of {drive.instant} in one of the motions"
    else:
        remedy = (
            f"so the next pair of teeth is off by {off:.3g} of a pitch: correct the ratio of the wheel's motion, or of "
            "the motions that generate the flanks"
        )
    raise DescriptionError(
        f"{drive.name}: the motion of the wheel turns it by {ratio:.7g} for one turn of the pinion, the flanks "
        f"transmit {found:.7g} at the sample's contact, {teeth:.6g} teeth of the pinion to {abs(teeth / found):.6g} "
        f"of the wheel; {remedy}"
    )


#: By how much the teeth of a sample may be thicker than the spaces, over the pitch.
THICKER = 0.05

#: How much play they may have, over the pitch.
PLAY = 0.25


def validate_play(drive: Drive, contacts: Sequence[tuple[Observed, Numbers]]) -> None:
    """Raise :class:`DescriptionError` where the teeth of the sample jam, or turn idle through a good part of a pitch:
    its two flanks then are not those of one tooth.

    ``contacts`` are those of both flanks, each with its inputs as of :func:`validate_normals`.
    """
    turns: list[float] = []
    for observed, values in contacts:
        # a pinion's normal that has the wheel's lever ahead keeps it from turning back, another from turning on
        ahead = float(observed[f"lever_arm_{drive.wheel.name}"][0]) > 0.0
        turns.append(float(values[drive.error]) * (-1.0 if ahead else 1.0))
    key = next(p for p in drive.parameters if drive.pinion_teeth in (p.key, p.place))
    _, values = contacts[0]
    pitch = 2.0 * float(mpmath.pi) * abs(float(value_of(drive.law, values, drive.definitions) / values[key.symbol]))
    play = sum(turns) / pitch
    play -= round(play)
    if not -THICKER <= play <= PLAY:
        said = f"jam by {-play:.3g}" if play < 0.0 else f"turn idle through {play:.3g}"
        raise DescriptionError(
            f"{drive.name}: between both flanks of the sample the teeth {said} of a pitch at the wheel: correct their "
            "thickness, where that is needed with the sign of the flank, or the places of the wheel and of its tool"
        )


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
