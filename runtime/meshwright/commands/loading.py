"""Options and steps that the commands of loaded contact share."""

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.commands import options as common


def add_arguments(parser):
    common.add_design(parser)
    parser.add_argument("--torque-nm", type=float, required=True, metavar="T", help="torque, N m, above zero")
    parser.add_argument(
        "--torque-on",
        choices=("pinion", "wheel"),
        help="whose torque it is; the rim of the other member is held; default: as is usual for the drive, on the "
        "pinion of gears, on the wheel where a thread drives it",
    )
    parser.add_argument("--pairs", type=int, metavar="N", help="tooth pairs modelled; default: as many as can share")
    parser.add_argument(
        "--rim-mm",
        type=float,
        metavar="MM",
        help="depth of the rim below the root; default 4.5 modules, or twice the height of teeth without a module",
    )


def finite_elements(*parts):
    """The package of loaded contact with these parts of it, whose libraries are an extra."""
    from meshwright import fe

    try:
        for part in ("solids", "compliance", "loaded", *parts):
            getattr(fe, part)
    except ModuleNotFoundError as error:
        raise UsageError(f"{error.name} is not installed; `pip install 'meshwright[fe]'` brings it") from error
    return fe


def checked_drive(options):
    """The drive that the options ask for, with a load that can be asked for."""
    if not (np.isfinite(options.torque_nm) and options.torque_nm > 0.0):
        raise UsageError(f"--torque-nm {options.torque_nm:g}: the torque must be above zero; --torque-on says on what")
    for option, value in (("--torque-nm", options.torque_nm), ("--rim-mm", options.rim_mm)):
        if value is not None and (reason := common.beyond_arithmetic(value)):
            raise UsageError(f"{option} {value:g}: {reason}")
    if options.pairs is not None and not 1 <= options.pairs <= 9:
        raise UsageError(f"--pairs {options.pairs}: choose 1 to 9 pairs")
    return common.drive_of(options)


def loaded_gears(fe, options, drive, step):
    """(gear pair, load, pairs) that the options ask for."""
    step("flanks and blanks")
    gear = fe.solids.gear_pair(drive, options.rim_mm)
    usual = fe.model.usual_loading(drive.design.description)
    load = fe.model.Load(1000.0 * options.torque_nm, options.torque_on or usual["torque_on"])
    return gear, load, options.pairs or usual["pairs"]


def gap_note(gear):
    """Why there are angles at which no tooth pair touches, empty at a contact ratio of 1 and more."""
    if not gear.contact_ratio < 1.0:
        return ""
    ends = f", whose contact ends at the {' and the '.join(gear.ends)}" if gear.ends else ""
    blank, remedy = ("assumed blank", "; give its sizes in [blank]") if gear.assumed else ("blank", "")
    return f"contact ratio {gear.contact_ratio:.3f}: the {blank} leaves gaps between pairs{ends}{remedy}"


def compliances(fe, gear, pairs, step):
    """Smooth tooth compliance of both members, for a model of so many pairs."""
    found = {}
    for name, member in (("pinion", gear.pinion), ("wheel", gear.wheel)):
        step(f"teeth of the {name}")
        found[name] = fe.compliance.tooth_compliance(member, fe.compliance.neighbours_of(pairs))
    return found
