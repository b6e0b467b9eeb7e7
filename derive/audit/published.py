"""Published numbers that do not follow from the text they stand in, beside what does follow, and why they differ.

Numbers here come from a drive's own placement, solved in 40-digit arithmetic from the printed design; nothing is
tuned to the print.
"""

from dataclasses import dataclass

import mpmath

from derive.drives import face_worm
from derive.passes import sample


@dataclass(frozen=True)
class Comparison:
    """One printed number (or claim) with ours; texts as shown, units included."""

    source: str
    where: str
    quantity: str
    printed: str
    ours: str
    why: str


FACE_WORM = "001_d957fec2e26e51c5.txt"

#: Tables 1 and 2: keys that differ from the sample design (Table 1, convex side), and the printed mean radius.
_TABLES: tuple[tuple[str, dict, str], ...] = (
    ("Table 1, conical worm", {}, "24.398 mm"),
    (
        "Table 2, cylindrical worm",
        {"worm_cone_angle_deg": 0, "gear_inner_radius_mm": "39.763", "gear_outer_radius_mm": "49.753"},
        "23.105 mm",
    ),
)
_SIDES: tuple[dict, ...] = ({}, {"flank": -1, "profile_angle_deg": 30, "plunge_mm_per_rad2": "-0.003"})
_RULES = (("P in the section L", 0), ("P where the pitch cones touch", 1))

_RADIUS_REASON = (
    "The circle through A1, P and A2 gives one radius a flank; the text does not say how one mean radius comes from "
    "two flanks, and the figure that shows P is lost. Neither reading of P gives both numbers, for single flanks or "
    "for their mean. The circle is ill-conditioned: P moved by 0.2 mm along the profile changes the radius by 0.7 to "
    "4.3 mm. Nothing is tuned to the print; head_cutter_radius_mm forces a value."
)
_TILT_REASON = (
    "With P in the section L the cylindrical design has the smaller tilt, and its head-cutter would cut into the teeth "
    "across the tool: there the tilt must indeed be increased. The claim can be meant so; it is not a property of the "
    "placement."
)


def comparisons():
    """Every :class:`Comparison`, in the order of the sources."""
    drive = face_worm.face_worm()
    complete = sample.Completion(drive)
    placed = {
        (table, rule): [_placement(drive, complete, changes | side | {"pitch_point_rule": rule}) for side in _SIDES]
        for table, changes, _ in _TABLES
        for _, rule in _RULES
    }
    rows = [
        Comparison(FACE_WORM, table, "mean radius of the head-cutter", printed, _radii(placed, table), _RADIUS_REASON)
        for table, _, printed in _TABLES
    ]
    rows.append(
        Comparison(
            FACE_WORM,
            "section 7",
            "tilt of the head-cutter, conical against cylindrical worm",
            "generally larger for the cylindrical worm",
            "; ".join(f"{name}: {_tilts(placed, rule)}" for name, rule in _RULES),
            _TILT_REASON,
        )
    )
    return tuple(rows)


def _placement(drive, complete, changes):
    """Head-cutter radius, mm, and tilt, degrees, of the sample design with keys changed."""
    with mpmath.workdps(sample.DIGITS):
        values = complete(drive.sample | changes)
        by_key = {p.key: values[p.symbol] for p in drive.parameters}
        return by_key["head_cutter_radius_mm"], mpmath.degrees(mpmath.acos(by_key["tool_axis_z_z"]))


def _radii(placed, table):
    texts = []
    for name, rule in _RULES:
        convex, concave = (radius for radius, _ in placed[table, rule])
        mean = (convex + concave) / 2
        texts.append(f"{name}: {_fixed(mean)} mm (convex {_fixed(convex)}, concave {_fixed(concave)})")
    return "; ".join(texts)


def _tilts(placed, rule):
    sides = [" and ".join(f"{_fixed(tilt, 1)}°" for _, tilt in placed[table, rule]) for table, _, _ in _TABLES]
    return f"{sides[0]} against {sides[1]} (convex and concave)"


def _fixed(value, decimals=3):
    return f"{float(value):.{decimals}f}"
