"""Cylindrical gears in REXS 2.0.0: cylindrical_stage, cylindrical_gear and their flanks."""

import sympy as sp

from derive.drives import cylindrical_gears_keys as k
from derive.drives.cylindrical_gears_keys import PINION, WHEEL
from derive.exchange.rexs import (
    Assumption,
    Attribute,
    Component,
    Exchange,
    Reading,
    Relation,
    angle_between_shafts,
    attribute,
    direct,
    place,
    shaft_axes,
)
from derive.language.choice import unit_step

SIDES = ("left", "right")
GEARS = {"pinion": PINION, "wheel": WHEEL}


def _root_diameter(gear):
    return 2 * (gear.reference_radius + gear.shift - k.dedendum.symbol)


def _dedendum(name, gear):
    return gear.reference_radius + gear.shift - attribute(name, "root_diameter") / 2


PAIRS = (
    direct("stage", "center_distance", k.center_distance),
    *(
        pair
        for name, gear in GEARS.items()
        for pair in (
            direct(name, "number_of_teeth", gear.teeth),
            direct(name, "normal_module", k.module),
            direct(name, "helix_angle_reference_diameter", gear.helix_angle),
            direct(name, "tip_diameter", gear.tip_radius, 2),
            *(direct(f"{name}_{side}", "normal_pressure_angle", k.pressure_angle) for side in SIDES),
            *(direct(f"{name}_{side}", "addendum_modification_coefficient", gear.profile_shift) for side in SIDES),
        )
    ),
)

#: Both gears' widths; the pair's is the smaller.
WIDTHS = [attribute(name, "face_width") for name in GEARS]

_HELIX_SUM = PINION.helix_angle.symbol + WHEEL.helix_angle.symbol

EXCHANGE = Exchange(
    components=(
        Component("stage", "cylindrical_stage"),
        *(Component(name, "cylindrical_gear") for name in GEARS),
        Component("unit", "gear_unit", beside="stage"),
        *(Component(f"shaft_{n}", "shaft") for n in (1, 2)),
        *(Component(f"{name}_{side}", "cylindrical_gear_flank") for name in GEARS for side in SIDES),
    ),
    relations=(
        Relation("stage", (("stage", "stage"), ("gear_1", "pinion"), ("gear_2", "wheel")), required=True),
        *(Relation("flank", (("gear", name), *((side, f"{name}_{side}") for side in SIDES))) for name in GEARS),
        Relation("assembly", (("assembly", "unit"), ("part", "stage"))),
        *(Relation("assembly", (("assembly", f"shaft_{n}"), ("part", name))) for n, name in enumerate(GEARS, 1)),
        *(Relation("assembly", (("assembly", "unit"), ("part", f"shaft_{n}"))) for n in (1, 2)),
    ),
    attributes=(
        *(written for written, _ in PAIRS),
        *(
            entry
            for name, gear in GEARS.items()
            for entry in (
                Attribute(name, "face_width", gear.face_width.symbol, (k.face_width, gear.face_width)),
                Attribute(name, "reference_diameter_cylindrical_gear", 2 * gear.reference_radius, (gear.teeth,)),
                Attribute(name, "root_diameter", _root_diameter(gear), (k.dedendum,), agrees=False),
            )
        ),
        *shaft_axes(k.shaft_angle),
    ),
    words=(),
    readings=(
        *(reading for _, reading in PAIRS),
        Reading(k.face_width.symbol, sp.Min(*WIDTHS)),
        *(Reading(k.face_width.symbol, width) for width in WIDTHS),
        *(Reading(gear.face_width.symbol, width, override=True)
          for gear, width in zip(GEARS.values(), WIDTHS, strict=True)),
        *(Reading(k.dedendum.symbol, _dedendum(name, gear), override=True) for name, gear in GEARS.items()),
        Reading(k.shaft_angle.symbol, (2 * unit_step(_HELIX_SUM) - 1) * angle_between_shafts(), override=True),
    ),
    assumptions=(
        *(Assumption(place(gear.helix_angle), "sign assumed: right hand is above zero, on both gears")
          for gear in GEARS.values()),
        Assumption(place(k.dedendum), "the root diameter is taken as that which one basic rack without allowance cuts"),
    ),
    doubtful=((k.dedendum.symbol, sp.Rational(1, 1000)),),
    defaults=(
        ("flank", "REXS holds both flanks and does not say which one is analysed"),
        (place(k.rounding), "no attribute for it: that of the standard basic rack"),
    ),
    absent=(
        ("flank", "REXS holds both flanks and does not say which one is analysed"),
        (place(k.rounding), "REXS has it with a tool, which is not written"),
        *((place(gear.thickness_allowance), "allowances are not written") for gear in GEARS.values()),
        *((place(q), "flank modifications are not written") for gear in GEARS.values() for q in (
            gear.profile_crowning, gear.profile_slope, gear.tip_relief.amount, gear.tip_relief.radius,
            gear.root_relief.amount, gear.root_relief.radius, gear.lead_crowning, gear.lead_slope, gear.flank_twist,
        )),
        (place(k.relief_exponent), "flank modifications are not written"),
        *((place(q), "a cylindrical stage has no errors of assembly") for q in (
            k.error_distance, k.error_horizontal, k.error_vertical, k.error_axial,
        )),
        (place(k.separation), "an assumption of the analysis"),
    ),
)  # fmt: skip
