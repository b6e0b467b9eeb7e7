"""The contact of the sample design on its other flank, for what has to hold of both."""

from dataclasses import replace

import mpmath

from derive.language.refusal import DescriptionError
from derive.language.symbols import Table
from derive.passes.plan import Schedule
from derive.passes.sample import DIGITS, Completion, solve


def on_other_flank(plan: Schedule) -> Schedule | None:
    """The plan with the contact of the other flank, of the same design at the same angle, as its sample; None where the
    flanks have designs of their own, or there is no such contact.
    """
    drive = plan.drive
    which = next(p for p in drive.parameters if p.table is Table.FLANK)
    others = [number for _, number in which.choices if number != int(plan.sample[which.symbol])]
    if drive.flanks_apart or len(others) != 1:
        return None
    with mpmath.workdps(DIGITS):
        try:
            design = Completion(drive, plan.systems)({**drive.sample, which.key: others[0]})
            return replace(plan, sample=solve(plan, design, drive.sample_angle))
        except DescriptionError:
            return None
