"""Contact ratio: where a pair's contact begins and ends and why, teeth in contact, transmission error, backlash.

Exit status 1 if begin or end does not exist, or if flanks cannot make the contact between them; what does not exist is
null. That the other flank leaves no room (negative backlash: the drive jams) or that the contact ratio is below 1 is a
result: it is said, with exit status 0.
"""

import math

import numpy as np

from meshwright.base.files import write_json, write_text
from meshwright.base.plain import finite_or_none
from meshwright.commands import options as common
from meshwright.commands.progress import progress
from meshwright.commands.shown import shown
from meshwright.contact import words
from meshwright.contact.analysis import reasons, status_text
from meshwright.contact.friction import mean_efficiency
from meshwright.contact.results import ARCSEC, TOUCHING
from meshwright.cycle import room
from meshwright.cycle.backlash import meaning
from meshwright.cycle.certified import certified_window
from meshwright.cycle.certified_cycle import certified_cycle
from meshwright.cycle.certified_lines import certified_lines
from meshwright.cycle.ends import event, why_open, without_contact
from meshwright.cycle.transmission import ROUND_OFF, changes, fourier
from meshwright.flank.pointed import Pointed, pointed

#: Part of a contact ratio that is rounding.
RATIO_ROUND_OFF = 1e-9

#: Tooth orders of the Fourier components that are written; ranges of angles that a line names.
ORDERS, MOST_RANGES = 8, 3


def add_arguments(parser):
    common.add_design(parser)
    common.add_angles(parser)
    common.add_friction(parser)
    parser.add_argument(
        "--certify", action="store_true",
        help="prove that the pair has one branch of contact over its window, bound its ends and its error, and prove"
        " at which angles of the mesh cycle nothing else touches first",
    )  # fmt: skip
    parser.add_argument("--json", metavar="FILE|-", help="write as JSON (schema meshwright.ratio/1)")


def run(options):
    drive = common.drive_of(options)
    certify = options.certify or not options.json
    with progress(2 + certify + options.certify) as step:
        step("window, transmission error and backlash")
        found = drive.contact_ratio()
        step("teeth in contact and efficiency")
        contents = document(drive, found, common.angles_of(options, drive), common.friction_of(options))
        if certify:
            step("proof of the branch")
            window = certified_window(drive, found.mesh.window, _changes(found))
            contents["certificate"] = None if window is None else window.plain(drive.design.mirror.sign)
        if options.certify and window is None:
            step("proof of the error along lines")
            lines = certified_lines(drive, found.mesh.window)
            contents["certificate"] = None if lines is None else lines.plain(drive.design.mirror.sign)
        elif options.certify:
            step("proof of first contact")
            contents["certificate"]["first_contact"] = _first_contact(found.mesh, window)
    if options.json:
        write_json(options.json, contents)
    else:
        write_text("-", _page(drive, found, contents))
    return 0 if found.mesh.window.complete and not found.impossible else 1


def _changes(found):
    """Where pairs change inside their windows, rad."""
    return changes(found.mesh, found.transmission_error.transfers) if found.transmission_error else ()


def _first_contact(mesh, window):
    cycle = certified_cycle(mesh, window)
    return None if cycle is None else cycle.plain(mesh.mirror)


def document(drive, found, angles, friction=None):
    """The ``meshwright.ratio/1`` document of a contact ratio; contact teeth at the pinion ``angles``, rad, efficiency
    with a :class:`~meshwright.contact.friction.Friction`.
    """
    return {
        "schema": "meshwright.ratio/1",
        "drive": drive.design.family,
        "design": drive.design.as_solved(),
        "status": found.status,
        "impossible": list(found.impossible),
        "begin": _event(found.begin),
        "end": _event(found.end),
        "contact_ratio": finite_or_none(found.contact_ratio),
        "transverse_contact_ratio": finite_or_none(found.transverse_contact_ratio),
        "overlap_ratio": finite_or_none(found.overlap_ratio),
        "average_contact_teeth": {
            "over_one_pitch": finite_or_none(found.average_over_pitch),
            "begin_to_end": finite_or_none(found.average_begin_to_end),
        },
        "contact_teeth": [_teeth(found.mesh, angle) for angle in angles],
        "transmission_error": _transmission(found),
        "backlash_arcsec": finite_or_none(found.backlash / ARCSEC),
        "backlash_mm": dict(zip(("transverse", "normal"), map(finite_or_none, found.backlash_lengths), strict=True)),
        "room": [entry._asdict() for entry in room.room(drive, found.backlash)],
        "pointed_teeth": [member.plain() for member in pointed(drive)],
        "efficiency": _efficiency(mean_efficiency(found.mesh, friction)),
    }


def _efficiency(mean):
    """Means over one pitch; None where they do not exist."""
    if mean is None:
        return dict.fromkeys(("pinion_drives", "wheel_drives", "self_locking_friction"))
    locking = [finite_or_none(value) for value in mean.self_locking]
    return {
        "pinion_drives": finite_or_none(mean.pinion_drives), "wheel_drives": finite_or_none(mean.wheel_drives),
        "self_locking_friction": {"least": locking[0], "largest": locking[1]},
    }  # fmt: skip


def _event(event):
    angle = finite_or_none(math.degrees(event.angle))
    return {"pinion_angle_deg": angle, "event": event.reason, "member": event.member}


def _teeth(mesh, angle):
    entry = {"pinion_angle_deg": math.degrees(angle), "teeth": None, "separations_mm": []}
    if mesh.window.complete:
        entry["teeth"] = mesh.teeth_in_contact(angle)
        entry["separations_mm"] = [finite_or_none(pair.separation) for pair in mesh.pairs(angle)]
    return entry


def _transmission(ratio):
    keys = (
        "pair_peak_to_peak_arcsec", "envelope_peak_to_peak_arcsec", "envelope", "other_envelope_peak_to_peak_arcsec",
        "envelope_with_edges_peak_to_peak_arcsec", "transfer_angles_deg", "vertex_deg", "rides_on_edge", "orders",
    )  # fmt: skip
    found = ratio.transmission_error
    if found is None:
        return dict.fromkeys(keys)
    values = (
        finite_or_none(found.pair_peak_to_peak / ARCSEC),
        finite_or_none(found.envelope_peak_to_peak / ARCSEC),
        found.envelope,
        finite_or_none(found.other_envelope_peak_to_peak / ARCSEC),
        finite_or_none(found.envelope_with_edges_peak_to_peak / ARCSEC),
        [math.degrees(a) for a in found.transfers] or None,
        finite_or_none(math.degrees(found.vertex)),
        found.rides_on_edge,
        _orders(ratio.mesh),
    )
    return dict(zip(keys, values, strict=True))


def _orders(mesh):
    """Fourier components of the transmitted envelope by tooth order."""
    if not mesh.window.complete:
        return None
    amplitudes, phases = fourier(mesh, ORDERS)
    if not np.isfinite(amplitudes).all():
        return None
    return [
        {"order": k + 1, "amplitude_arcsec": float(a / ARCSEC), "phase_deg": float(np.degrees(p))}
        for k, (a, p) in enumerate(zip(amplitudes, phases, strict=True))
    ]


def _page(drive, found, contents):
    lines = [f"{drive.design.description['title']}, {drive.design.tables['name'] or 'design'}"]
    if found.mesh.path is None and found.status in TOUCHING:
        lines.append(status_text(found.status))
    if why := why_open(found.mesh):
        lines.append(f"no complete window of contact: {why}")
    if found.impossible:
        instead = "; the figures are of where the flanks touch first" if found.mesh.path is None else ""
        flags = ", ".join(found.impossible)
        lines.append(f"bodies cannot make this contact everywhere from begin to end: {flags}{instead}")
    lines += [f"{name:<34} {', '.join(filter(None, values))}" for name, *values in _rows(found, contents)]
    lines += _certified(contents.get("certificate"))
    if contents["room"]:
        helps = room.said(room.Room(**entry) for entry in contents["room"])
        lines.append(f"what gives it room, one at a time: {helps}")
    lines += [str(Pointed(*member.values())) for member in contents["pointed_teeth"]]
    if apart := without_contact(found.mesh):
        lines.append(f"contact ratio below 1: {apart}")
    if contents["transmission_error"]["rides_on_edge"]:
        lines.append("the pair that drives stands at an end of its contact: the drive rides on an edge")
    return "\n".join(lines) + "\n"


def _certified(certificate):
    """What is proved of the window, if that was asked for."""
    if certificate is None:
        return
    if "held_deg" in certificate:
        yield from _along_lines(certificate)
        return
    if certificate["gaps"]:
        gap = certificate["gaps"][0]
        low, high = gap["pinion_angle_deg"]
        yield f"not certified: from {low:.6f}° to {high:.6f}° no single branch is shown: {_why(gap['reason'])}"
        return
    yield f"certified: one branch of contact, {certificate['pieces']} pieces without a gap"
    if certificate["contact_ratio"]:
        low, high = certificate["contact_ratio"]
        yield f"certified: contact ratio from {low:.12f} to {high:.12f}"
        low, high = certificate["pair_peak_to_peak_arcsec"]
        yield f"certified: peak to peak of the pair from {low:.9f} to {high:.9f} arcsec"
    for low, high in certificate["transfer_angles_deg"] or ():
        yield f"certified: pairs change at an angle from {low:.9f}° to {high:.9f}°"
    yield from _first(certificate.get("first_contact"))


def _along_lines(certificate):
    """What is proved of a window of contact along lines."""
    shown = [at for at in certificate["at_angles"] if at["transmission_error_arcsec"]]
    lines = [at["contact_line"]["apart_mm"] for at in shown if at["contact_line"] and at["contact_line"]["apart_mm"]]
    if shown:
        low, high = (of(at["transmission_error_arcsec"][k] for at in shown) for k, of in enumerate((min, max)))
        count = f"{len(shown)} of {len(certificate['at_angles'])} angles of the window"
        yield f"certified: at {count} the pair touches first at an error from {low:.6f} to {high:.6f} arcsec"
    if lines:
        most = max(abs(end) for apart in lines for end in apart)
        yield f"certified: at {len(lines)} of them all along a line, both flanks within {most:.0e} mm of one another"
    if certificate["held_deg"]:
        low, high = certificate["transmission_error_arcsec"]
        yield f"certified: error from {low:.6f} to {high:.6f} arcsec at every angle {_ranges(certificate['held_deg'])}"
    for reason in dict.fromkeys(gap["reason"] for gap in certificate["gaps"]):
        left = [gap["pinion_angle_deg"] for gap in certificate["gaps"] if gap["reason"] == reason]
        yield f"  not shown of every angle {_ranges(left)}: {_why(reason)}"


def _why(reason):
    return {**reasons(), **words.GAPS}.get(reason, reason)


def _first(found):
    """What is proved of first contact over the mesh cycle, if that was asked for."""
    if found is None:
        return
    if found["outcome"] == "first":
        yield f"certified: nothing else touches first at any angle of the mesh cycle, {_ranges(found['cycle_deg'])}"
        return
    clear = _ranges(found["first_deg"])
    proved = f"nothing else touches first {clear}" if clear else "no angle at which nothing else touches first"
    yield f"certified: {proved}"
    for pair in sorted({span["pairs_later"] for span in found["spans"]}, key=abs):
        own = [span for span in found["spans"] if span["pairs_later"] == pair]
        overlaps = [span for span in own if span["outcome"] == "not_first"]
        if overlaps:
            worst = max(overlaps, key=lambda span: span["overlap_arcsec"])
            where = _ranges(_together(overlaps))
            yield (
                f"  not first: {_pair(pair)} touches before, {where}; overlap of more than"
                f" {worst['overlap_arcsec']:.6g} arcsec at {worst['at_pinion_angle_deg']:.6f}°"
            )
        for message in dict.fromkeys(span["message"] for span in own if span["outcome"] == "unknown"):
            open_ = [span for span in own if span["message"] == message]
            yield f"  not shown of {_pair(pair)}, {_ranges(_together(open_))}: {message}"


def _together(spans):
    """Ranges of angles of spans, those that meet as one."""
    joined = []
    for low, high in sorted(span["pinion_angle_deg"] for span in spans):
        if joined and low <= joined[-1][1]:
            joined[-1][1] = max(joined[-1][1], high)
        else:
            joined.append([low, high])
    return joined


def _ranges(ranges):
    more = f" and {len(ranges) - MOST_RANGES} more" if len(ranges) > MOST_RANGES else ""
    return ", ".join(f"from {low:.4f}° to {high:.4f}°" for low, high in ranges[:MOST_RANGES]) + more


def _pair(later):
    if later == 0:
        return "another place of the pair"
    return f"the pair {abs(later)} {'later' if later > 0 else 'earlier'}"


def _rows(found, contents):
    """Name, value and remark of each line."""
    error, average = contents["transmission_error"], contents["average_contact_teeth"]
    return [
        ("contact begins at", *_at(contents["begin"])),
        ("contact ends at", *_at(contents["end"])),
        ("contact ratio", shown(contents["contact_ratio"])),
        *_by_sections(contents),
        ("teeth in contact, over one pitch", shown(average["over_one_pitch"])),
        ("teeth in contact, begin to end", shown(average["begin_to_end"])),
        ("transmission error of a pair", _arcsec(error["pair_peak_to_peak_arcsec"], "peak to peak"), _constant(found)),
        ("  of the drive", _arcsec(error["envelope_peak_to_peak_arcsec"], "peak to peak"),
         f"{error['envelope'] or 'no'} envelope"),
        ("  of the drive, edges included", _arcsec(error["envelope_with_edges_peak_to_peak_arcsec"])),
        ("  of the other envelope", _arcsec(error["other_envelope_peak_to_peak_arcsec"], "peak to peak")),
        ("pairs change at", *_change(found)),
        ("vertex at", shown(error["vertex_deg"], "deg")),
        ("backlash", _arcsec(contents["backlash_arcsec"], "of the wheel"), _backlash(found)),
        *_lengths(contents["backlash_mm"]),
        *_efficiency_rows(contents["efficiency"]),
    ]  # fmt: skip


def _by_sections(contents):
    """Parts of the contact ratio of flanks that touch along lines, on parallel axes."""
    if contents["transverse_contact_ratio"] is None:
        return []
    keys = (("  transverse", "transverse_contact_ratio"), ("  overlap", "overlap_ratio"))
    return [(name, shown(contents[key], "", RATIO_ROUND_OFF)) for name, key in keys]


def _lengths(found):
    """Backlash as a length, on parallel axes."""
    if found["transverse"] is None:
        return []
    names = (("  on the pitch circles", "transverse"), ("  along the normal", "normal"))
    return [(name, shown(found[key], "mm")) for name, key in names]


def _efficiency_rows(found):
    """Efficiency with the friction given, and the friction from which the wheel cannot drive."""
    rows = []
    if found["pinion_drives"] is not None:
        rows = [("efficiency, pinion drives", shown(found["pinion_drives"])),
                ("  wheel drives", shown(found["wheel_drives"]))]  # fmt: skip
    if (locking := found["self_locking_friction"]) is not None and locking["least"] is not None:
        rows.append(("self-locking from friction", shown(locking["least"]), f"everywhere {shown(locking['largest'])}"))
    return rows


def _at(found):
    return shown(found["pinion_angle_deg"], "deg"), event(found["event"], found["member"])


def _arcsec(value, of=""):
    return shown(value, f"arcsec {of}".strip(), ROUND_OFF / ARCSEC)


def _change(found):
    """Where the next pair takes over, and why not where the errors of both are equal."""
    inside = _changes(found)
    beyond = found.transmission_error.transfers if found.transmission_error and not inside else ()
    return _angles(inside), f"their curves cross outside of contact: {_angles(beyond)}" if beyond else ""


def _angles(angles):
    return ", ".join(shown(math.degrees(angle), "deg") for angle in angles) or shown(None)


def _constant(found):
    error = found.transmission_error
    return "constant to round-off" if error and error.pair_peak_to_peak < ROUND_OFF else ""


def _backlash(found):
    """A remark on a backlash that is not an ordinary one."""
    return meaning(found.backlash) if found.backlash < ROUND_OFF else ""
