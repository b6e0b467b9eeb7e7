"""Crossed involute helicoids whose pinion flank carries conditions more: parameters that are the roll angle once more.

The flank is the same; only how many parameters and conditions it is described with differs.
"""

from dataclasses import replace
from functools import partial

from crossed_helicoids import crossed_helicoids

from derive.language.contact import contact
from derive.language.drive import Unknown
from derive.language.symbols import Quantity


def with_conditions(count):
    """The drive with ``count`` conditions on the flank of its pinion, e_1 = roll, e_2 = e_1 …; half the roll is e_n."""
    drive = crossed_helicoids()
    flank, define = drive.pinion.surface, drive.definitions.resolve
    roll, turn = flank.parameters
    more = [Quantity(f"e_{k}", "rad", "the roll angle once more", "pinion") for k in range(1, count + 1)]

    def described(vector):
        return tuple(define(component).subs(roll, (roll + more[-1]) / 2) for component in vector)

    surface = replace(
        flank,
        parameters=(roll, turn, *more),
        point=described(flank.point),
        normal=described(flank.normal),
        tangents=tuple(map(described, flank.tangents)),
        conditions=tuple(b - a for a, b in zip((roll, *more[:-1]), more, strict=True)),
    )
    reference = drive.pinion.reference
    pinion = replace(drive.pinion, surface=surface, reference=reference | dict.fromkeys(more, reference[roll]))
    words = {1: "one_condition", 2: "two_conditions"}
    return replace(
        drive,
        name=words[count],
        family=words[count].replace("_", "-"),
        pinion=pinion,
        start=replace(drive.start, outputs=drive.start.outputs | dict.fromkeys(more, drive.start.outputs[roll])),
        unknowns=(*drive.unknowns[:2], *map(Unknown, more), *drive.unknowns[2:]),
        residual=contact(pinion.placed, drive.wheel.placed),
    )


def catalogue():
    """The drives of this file."""
    return {"one_condition": partial(with_conditions, 1), "two_conditions": partial(with_conditions, 2)}
