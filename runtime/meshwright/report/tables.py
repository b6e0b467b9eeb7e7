"""The tables of a report: the design with every derived size, the results, the sensitivities."""

import re
from dataclasses import dataclass

import numpy as np

from meshwright.contact.results import ARCSEC
from meshwright.cycle.transmission import ROUND_OFF
from meshwright.design.description import families
from meshwright.design.drawing import shortened
from meshwright.report.numbers import fixed, number, title, unit
from meshwright.report.sensitivity import misalignments
from meshwright.sensitivity import on_member, sensitivity

#: Derivatives of a position below this are round-off, mm per unit of a key.
POSITION_ROUND_OFF = 1e-12

#: Shifts of a contact point below this are round-off, mm: a tenth of an atom.
SHIFT_ROUND_OFF = 1e-8

#: Tables of numbers that no one gives.
_UNLISTED = ("flank", "placement")

#: Tables whose keys a drawing states, and the keys of both members that it does.
_DRAWN = ("design", "blank")
_SHARED = re.compile(
    r"(normal_|axial_|transverse_|outer_|mean_)?"
    r"(module|pressure_angle|profile_angle|spiral_angle|shaft_angle|center_distance|offset|face_width)"
)


@dataclass(frozen=True)
class Table:
    """Rows of text under a header; ``numeric`` are the columns to align as numbers, ``style`` names a layout."""

    title: str
    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    numeric: frozenset[int] = frozenset()
    style: str = ""


@dataclass(frozen=True)
class Group:
    """Tables under one heading, one below the other or, where all are narrow, in ``columns``."""

    id: str
    title: str
    note: str
    tables: tuple[Table, ...]
    columns: bool = False


def groups(analysis):
    """Every :class:`Group` of an analysis, in order."""
    found = []
    if analysis.sensitivities and np.isfinite(analysis.tca.error).any():
        found.append(_sensitivities(analysis))
    found += [drawing(analysis), _design(analysis.drive.design), _positions(analysis)]
    return [*found, _sliding(analysis)] if analysis.tca.solved.any() else found


def drawing(analysis):
    """What a drawing of each member and of their assembly states: the :class:`Group` of those keys of the design.

    The first word of the key of a member's number of teeth begins or ends its other keys too, or names its table.
    """
    design, prefixes, sheet = analysis.drive.design, _prefixes(analysis), analysis.drive.drawing()
    stated = {key: size for key, size in sheet.sizes.items() if size.table in (*_DRAWN, *prefixes.values())}
    tables, drawn = [], set()
    for member, prefix in prefixes.items():
        own = {key: size for key, size in stated.items() if prefix in (size.table, *_ends(key.rpartition(".")[2]))}
        tables.append(_stated(member.capitalize(), [_row(key, size) for key, size in own.items()]))
        drawn |= own.keys()
    beside = families(design.places)[design.family].drawing.beside
    both = [_row(key, size) for key, size in stated.items()
            if key not in drawn and (f"{size.table}.{key}" in beside or _SHARED.match(key))]  # fmt: skip
    if design.tables["design"].get("hand"):
        both.append(("hand", design.tables["design"]["hand"], "–", "hand", "–", "given", ""))
    both.append(("gear ratio", number(1.0 / analysis.drive.ratio), "–", "ratio", "–", "derived", ""))
    if analysis.running is not None and np.isfinite(analysis.running.backlash):
        play = number(analysis.running.backlash / ARCSEC, 4)
        both.append(("backlash, angle of the wheel", play, "″", "–", "–", "derived", "distance of the two flanks"))
    tables.append(_stated("Both", both))
    if sheet.checks:
        rows = [(name.replace("_", " "), check.said, number(check.margin)) for name, check in sheet.checks.items()]
        tables.append(Table("Checks", ("check", "finding", "margin"), tuple(rows), frozenset({2})))
    note = (
        "Sizes of the nominal design, without tolerances, and where each is from; those of the tools are in the tables "
        "below. `meshwright drawing` prints long relations whole."
    )
    return Group("drawing", "Drawing data", note, tuple(tables))


def _ends(key):
    """The first and the last word of a key without its unit."""
    words = title(key).split()
    return words[0], words[-1]


def _row(key, size):
    shown = size.value if isinstance(size.value, str) else number(size.value, 9)
    symbol, relation = size.symbol or "–", shortened(size.relation)
    return size.meaning, shown, unit(key), key, symbol, size.provenance, relation


def _stated(heading, rows):
    header = ("meaning", "value", "unit", "key", "symbol", "source", "relation or reason")
    return Table(heading, header, tuple(rows), frozenset({1}), "drawing")


def _prefixes(analysis):
    """The first word of the keys of each member: that of its number of teeth, whatever they are called; of a wheel
    whose number no key counts, its own.
    """
    design = analysis.drive.design
    pinion = design.description["pinion_teeth"]
    counted = [p["key"] for p in design.description["parameters"] if p["table"] == "design" and p["integer"]]
    wheel = [key for key in counted if key != pinion and abs(design.value(key)) == analysis.teeth["wheel"]]
    wheel.sort(key=lambda key: key.rpartition("_")[2] not in ("teeth", "threads"))
    return {"pinion": pinion.partition("_")[0], "wheel": (wheel or ["wheel"])[0].partition("_")[0]}


def _design(design):
    tables = []
    names = dict.fromkeys(("design", *(p["table"] for p in design.description["parameters"])))
    for name in (table for table in names if table not in _UNLISTED):
        rows = [_parameter(design, p) for p in design.description["parameters"] if p["table"] == name]
        rows = [row for row in rows if row[1] != "–"]
        rows = [(title(key), str(word), "–", "given", key) for key, word in _words(design, name)] + rows
        if rows:
            tables.append(_keys(name.capitalize(), rows))
    sizes = [
        (s["meaning"], number(design.sizes[s["key"]]), unit(s["key"]), "derived", s["key"])
        for s in design.description["sizes"]
    ]
    tables.append(_keys("Derived sizes", sizes))
    note = (
        "Values are in the unit of their key; derived ones follow from the given ones, defaults stand where nothing is "
        "given or assumed. Keys left open set no limit and are not listed."
    )
    return Group("design", "Design and derived sizes", note, tuple(tables), columns=True)


def _keys(heading, rows):
    return Table(heading, ("meaning", "value", "unit", "source", "key"), tuple(rows), frozenset({1}), "keys")


def _words(design, table):
    """Keys of a table that are given by a word, with it."""
    places = [key.rpartition(".") for key in (*design.description["variant"], "hand")]
    keys = [key for where, _, key in places if (where or "design") == table]
    words = design.tables[table]
    return [(key, words[key]) for key in keys if isinstance(words.get(key), str)]


def _parameter(design, parameter):
    key, table = parameter["key"], parameter["table"]
    value = design.value(key, table) / parameter["factor"]
    words = {choice: word for word, choice in parameter["choices"].items()}
    return parameter["meaning"], words.get(value, number(value, 9)), unit(key), _source(design, parameter), key


def _source(design, parameter):
    """Where the value of a parameter is from."""
    table, key = parameter["table"], parameter["key"]
    if design.tables[table].get(key) is not None:
        if design.drawn is not None and key not in design.drawn.get(table, ()):
            return "derived"
        return "assumed" if f"{table}.{key}" in design.tables["assumed"] else "given"
    return "derived" if parameter["default"] is None else "default"


def _sensitivities(analysis):
    middle = len(analysis.tca.angles) // 2
    exact = sensitivity(analysis.drive, analysis.tca.angles[middle : middle + 1])
    moved = {member: _meridional(analysis, exact, member, middle) for member in ("pinion", "wheel")}
    rows = [_effect(analysis, effect, exact, moved) for effect in analysis.sensitivities]
    header = (
        "misalignment",
        "step",
        "transmission error, arcsec",
        "on pinion: axial, mm",
        "radial, mm",
        "on wheel: axial, mm",
        "radial, mm",
        "peak to peak at −step, arcsec",
        "at +step, arcsec",
    )
    note = (
        f"Change for one step, by the exact derivative, at {fixed(np.degrees(analysis.tca.angles[middle]), 2)}° of the "
        "pinion: of the transmission error and of the contact point on both members. Peak to peak: of the drive's "
        f"transmitted error{_nominal(analysis)}."
    )
    table = Table("", header, tuple(rows), frozenset(range(2, 9)))
    tables = (table, _slopes(analysis.drive, exact)) if np.isfinite(exact.points).any() else (table,)
    return Group("sensitivity", "Sensitivity to misalignment and design", note, tables)


def _slopes(drive, exact):
    """Derivatives by every key, exact, at one angle; what follows from a key follows it."""
    entries = {f"{p['table']}.{p['key']}": p for p in drive.design.description["parameters"]}
    rows = []
    for k, place in enumerate(exact.keys):
        parameter = entries[place]
        error, point = exact.error[0, k] * parameter["factor"], exact.points[0, k] * parameter["factor"]
        shifts = (_above(v, POSITION_ROUND_OFF) for v in point)
        rows.append((parameter["meaning"], unit(parameter["key"]), _arcsec(error), *shifts, place))
    header = ("derivative by", "per", "transmission error, arcsec", "contact x, mm", "y, mm", "z, mm", "key")
    return Table("Exact derivatives at the same angle, fixed frame", header, tuple(rows), frozenset(range(2, 6)))


def _nominal(analysis):
    if analysis.running is None:
        return ""
    return f", as designed {_arcsec(analysis.running.error.envelope_peak_to_peak)} arcsec"


def _meridional(analysis, exact, member, k):
    """Derivatives (K, 2) of the axial position and the radius of contact k on a member."""
    (change,) = on_member(analysis.drive, exact, member)
    x, y, _ = analysis.tca.body_points[member][k]
    return np.stack([change[:, 2], (x * change[:, 0] + y * change[:, 1]) / np.hypot(x, y)], axis=1)


def _effect(analysis, effect, exact, moved):
    factors = {p["key"]: p["factor"] for p in misalignments(analysis.drive.design)}
    column, size = exact.of(f"misalignment.{effect.key}"), effect.step * factors[effect.key]
    shifts = [_above(size * v, SHIFT_ROUND_OFF) for member in moved.values() for v in member[column]]
    peaks = [_arcsec(p) for p in effect.peak_to_peak]
    return (effect.meaning, effect.label, _arcsec(size * exact.error[0, column]), *shifts, *peaks)


def _arcsec(angle):
    """An angle (rad) in arcsec as text."""
    return number(0.0 if abs(angle) < ROUND_OFF else angle / ARCSEC, 4)


def _above(value, round_off):
    """A number as text, 0 below ``round_off``."""
    return number(0.0 if abs(value) < round_off else value, 4)


def _positions(analysis):
    tca, overlaps = analysis.tca, analysis.first.overlaps(analysis.tca.error)
    rows = []
    for k in range(0, len(tca.angles), max(1, analysis.steps_per_pitch // 4)):
        rows.append(
            (
                fixed(np.degrees(tca.angles[k]), 2),
                fixed(np.degrees(tca.wheel_angles[k]), 6),
                fixed(tca.error[k] / ARCSEC, 5),
                fixed(tca.relative_error[k] / ARCSEC, 5),
                *(fixed(v, 4) for v in tca.points[k]),
                fixed(tca.semi_axes[k, 0], 4),
                fixed(tca.semi_axes[k, 1], 4),
                " ".join((tca.status[k], *tca.flags[k])).replace("_", " "),
                analysis.first.words(k),
                fixed(1000.0 * overlaps[k], 3),
            )
        )
    header = (
        "pinion, °",
        "wheel, °",
        "transmission error, arcsec",
        "relative, arcsec",
        "x, mm",
        "y, mm",
        "z, mm",
        "major semi-axis, mm",
        "minor, mm",
        "status and flags",
        "first contact of the bounded flanks",
        "overlap of the tangency there, µm",
    )
    note = "Contact of one pair over the pinion angle, four positions a pitch; contact point in the fixed frame."
    table = Table("", header, tuple(rows), frozenset(range(9)))
    return Group("positions", "Contact, position by position", note, (table,))


def _sliding(analysis):
    """Velocities and efficiency, position by position."""
    tca, moving, found = analysis.tca, analysis.moving, analysis.efficiency
    sliding, entraining = (np.linalg.norm(v, axis=1) for v in (moving.sliding, moving.entraining))
    specific = moving.specific_sliding
    columns = {
        "pinion, °": (np.degrees(tca.angles), 2),
        "sliding, mm/rad": (sliding, 4),
        "entraining, mm/rad": (entraining, 4),
        "specific sliding, pinion": (specific["pinion"], 3),
        "wheel": (specific["wheel"], 3),
        "self-locking from friction": (found.self_locking, 4),
    }
    if np.isfinite(found.friction).any():
        columns |= {
            "friction": (found.friction, 4),
            "efficiency, pinion drives": (found.pinion_drives, 4),
            "wheel drives": (found.wheel_drives, 4),
        }
    steps = range(0, len(tca.angles), max(1, analysis.steps_per_pitch // 4))
    rows = tuple(tuple(fixed(values[k], decimals) for values, decimals in columns.values()) for k in steps)
    note = (
        "Velocities for one radian of the pinion a second: of the pinion's flank relative to the wheel's, and the mean "
        "of both through the contact. Specific sliding is infinite where a flank rests in the contact. From the "
        "coefficient of friction given, the wheel cannot drive the pinion; vibration undoes it."
    )
    return Group("sliding", "Sliding and efficiency", note, (Table("", tuple(columns), rows, frozenset(range(9))),))
