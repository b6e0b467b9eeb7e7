"""First designs of the families: proportions of the standards, and what makes contact a point.

Sources: ISO/TR 10828:2015 (worm gears), ISO 53:1998 and ISO 21771:2007 (cylindrical gears); the packaged spherical and
face worm designs, scaled, for the families that no standard treats.
"""

from dataclasses import replace

import sympy as sp

from derive.language.choice import only_where_within, only_where_zero, unit_step
from derive.language.outline import Outline, Suggestion, a, m, z_1, z_2
from derive.language.tool import suggestions
from derive.tools.worm_body import SHEET_USED


def _clipped(value, least, most):
    return sp.Min(sp.Max(value, least), most)


#: Sizes of two drawings that differ by no larger part are one: their last digit is rounded.
SAME_SIZE = sp.Rational(1, 10**6)

#: Lead angles from which the pressure angle rises, and by how much (deg): G. Niemann, H. Winter, Maschinenelemente III.
STEEPER = ((15, sp.Rational(5, 2)), (25, sp.Rational(5, 2)), (35, 5))


def worm(tools):
    """Of worms and hobs that these tools make."""
    arc, straight = {"worm_profile": ("ZC",)}, ("ZA", "ZI", "ZN", "ZK")
    shift = Suggestion("", (0 * m,), name="x")
    shift_arc = replace(shift, values=(sp.Rational(1, 2) + 0 * m,), words=arc)
    x = shift.symbol
    quotient = Suggestion(
        "", (_clipped(2 * a / m - z_2 - 2 * x, 7, 20), 10 + 0 * m), name="q", decimals=4,
        why="diameter quotient: the wheel needs no further profile shift at the centre distance given, else 10",
    )  # fmt: skip
    q = quotient.symbol
    radius = Suggestion(
        "design.worm_pitch_radius_mm", (q * m / 2,), "half the module times the diameter quotient", "r_1", 4
    )
    r_1 = radius.symbol
    lead = Suggestion("", (sp.atan2(m * z_1 / 2, r_1),), name="lambda_1")
    lam = lead.symbol
    pressure = Suggestion(
        "design.pressure_angle_deg", (20 + sum(by * unit_step(lam - sp.rad(above)) for above, by in STEEPER),),
        "20 up to a lead angle of 15°, 22.5 up to 25°, 25 up to 35°, then 30", "alpha_deg",
    )  # fmt: skip
    alpha = sp.rad(pressure.symbol)
    shaft = Suggestion("design.shaft_angle_deg", (sp.Integer(90),), name="Sigma_deg")
    normal = m * sp.cos(lam)
    r_2 = normal * z_2 / (2 * sp.sin(sp.rad(shaft.symbol) + lam))
    hob = Suggestion(
        "design.hob_pitch_radius_mm", (r_1 * sp.Rational(105, 100),),
        "5 % larger than the worm: an oversize hob gives contact in a point, an equal one along a line", "r_h", 3,
    )  # fmt: skip
    hob_arc = replace(
        hob, values=(r_1 * sp.Rational(110, 100),), words=arc,
        why="10 % larger than the worm: flanks that nestle touch in a point only if the hob is well oversize",
    )  # fmt: skip
    threads = Suggestion("design.hob_threads", (z_1,), name="z_h", whole=True)
    distance = Suggestion("design.center_distance_mm", (r_1 + r_2,), "sum of the reference radii", "A", 4)
    distance_arc = replace(
        distance, values=(r_1 + r_2 + x * m,), why="reference radii and a profile shift of half a module", words=arc
    )
    distance_asked = replace(distance, values=(a,), why="", decimals=None)
    wheel_shift = Suggestion(
        "", ((distance.symbol - r_1 - r_2) / m,), "profile shift coefficient of the wheel, by the centre distance",
        "x_2", 4, within=(-1, 1),
    )  # fmt: skip
    A = distance.symbol  # noqa: N806 the centre distance, by its usual letter
    nominal = Suggestion("", (0 * m,), name="A_sn")
    thinned = Suggestion(
        "design.worm_thickness_allowance_um",
        (only_where_within(SAME_SIZE * r_1, hob.symbol - r_1, -20 * m / sp.cos(alpha)),),
        "0.02 modules of normal backlash, by a thinner thread: an equal hob keeps its line of contact", "A_sn", 1,
    )  # fmt: skip
    cutting = Suggestion(
        "design.cutting_center_distance_mm",
        (
            A + hob.symbol - r_1 - only_where_zero(nominal.symbol, m / (100 * sp.sin(alpha))),
            A + hob.symbol - r_1,
        ),
        "without backlash; of a thread of nominal thickness deeper, by 0.02 modules of normal backlash", "A_gen", 4,
    )  # fmt: skip
    cutting_equal = replace(
        cutting, values=(only_where_within(SAME_SIZE * r_1, hob.symbol - r_1, A + hob.symbol - r_1),), decimals=None,
        why="where an equal hob is the worm: contact along a line",
    )  # fmt: skip
    hob_screw = hob.symbol * sp.tan(sp.asin(normal * threads.symbol / (2 * hob.symbol)))
    worm_rolls, hob_rolls = A - r_2, cutting.symbol - r_2
    swivel = sp.atan2(m * z_1 / 2, worm_rolls) - sp.atan2(hob_screw, hob_rolls)
    throat = Suggestion(
        "blank.wheel_throat_radius_mm", (A - r_1 + m,), "one module above the worm's reference cylinder", "throat", 3
    )
    chord = 2 * m * (sp.Rational(1, 2) + sp.sqrt(2 * r_1 / m + 1))
    sheet = sp.atan2(sp.tan(alpha), sp.sin(lam))
    land = sp.pi * normal / 2 - sp.Rational(12, 5) * m * sp.tan(alpha)
    return Outline(
        {"m": "axial module", "z": "threads of the worm : teeth of the wheel", "a": "centre distance"},
        {"worm_profile": "ZI", "hob_profile": ""},
        (
            Suggestion("design.axial_module_mm", (m,)),
            Suggestion("design.worm_threads", (z_1,), whole=True),
            Suggestion("design.wheel_teeth", (z_2,), whole=True),
            shaft,
            shift, shift_arc,
            quotient,
            radius,
            lead,
            pressure,
            replace(pressure, values=(sp.Integer(23),), why="usual for form C", words=arc),
            distance, distance_arc, distance_asked, wheel_shift,
            hob, hob_arc,
            threads,
            nominal, thinned,
            cutting, cutting_equal,
            Suggestion(
                "design.cutting_shaft_angle_deg", (shaft.symbol + swivel * 180 / sp.pi,),
                "hob and worm have one direction of the thread where they roll on the wheel", decimals=4,
            ),
            *suggestions(tools),
            Suggestion("blank.worm_tip_radius_mm", (r_1 + m,), "addendum of one axial module", decimals=3),
            Suggestion("blank.worm_root_radius_mm", (r_1 - sp.Rational(6, 5) * m,), "and clearance 0.2", decimals=3),
            throat,
            Suggestion("blank.wheel_tip_radius_mm", (throat.symbol + m / 2,), "half a module beyond it", decimals=3),
            Suggestion(
                "blank.wheel_tip_radius_mm", (throat.symbol + m / 4,),
                "a quarter of a module beyond it: with profile shift the teeth end in a point sooner", decimals=3,
                words=arc,
            ),
            Suggestion(
                "blank.wheel_face_width_mm",
                (sp.Min(chord * sp.Rational(4, 5), 2 * r_1 * sp.sin(SHEET_USED * sheet)),),
                "four fifths of the chord of the worm's tip circle, at most what the hob's flank reaches",
                decimals=1,
            ),
            Suggestion("blank.hob_tip_addendum_mm", (sp.Rational(6, 5) * m,), "cuts the root clearance", decimals=3),
            Suggestion(
                "blank.hob_tip_rounding_mm",
                (sp.Min(m / 5, land * sp.Rational(4, 9) * sp.cos(alpha) / (1 - sp.sin(alpha))),),
                "the root fillet, at most what fits on the hob's tip", decimals=3,
            ),
        ),
        apart=tuple(
            ({own: ("ZC",), mate: straight}, "a hollow thread and a hob of another form do not follow each other")
            for own, mate in (("worm_profile", "hob_profile"), ("hob_profile", "worm_profile"))
        ),
    )  # fmt: skip


#: Least product of a number of teeth and sin²α of the spherical families: away from its equator a convex gear is
#: thinner, and undercut sooner than one with straight axes, for which the standard rack needs 2.
ROOM_FOR_RACK = sp.Rational(33, 10)


def spherical():
    fewest = sp.sqrt(sp.Min(ROOM_FOR_RACK / sp.Min(z_1, z_2), sp.Rational(1, 2)))
    steep = sp.atan2(fewest, sp.sqrt(1 - fewest**2)) * 180 / sp.pi
    return Outline(
        {"m": "module", "z": "teeth of the pinion : teeth of the wheel"},
        {"pinion_form": "convex", "wheel_form": "convex"},
        (
            Suggestion("design.module_mm", (m,)),
            Suggestion("design.pinion_teeth", (z_1,), whole=True),
            Suggestion("design.wheel_teeth", (z_2,), whole=True),
            Suggestion(
                "design.pressure_angle_deg", (sp.Max(20, steep + sp.Rational(1, 2)),),
                "20 (ISO 53), more for few teeth, so that the rack does not undercut them", decimals=0,
            ),
            *(
                suggestion
                for own, mate, z, z_mate in (("pinion", "wheel", z_1, z_2), ("wheel", "pinion", z_2, z_1))
                for suggestion in (
                    Suggestion(
                        f"design.{own}_sphere_radius_mm", (m * z / 2,), "the pitch radius", decimals=4,
                        words={f"{own}_form": ("convex",)},
                    ),
                    Suggestion(
                        f"design.{own}_sphere_radius_mm", (m * z_mate,),
                        f"twice that of the {mate}, which lies in the hollow: contact in a point", decimals=4,
                        words={f"{own}_form": ("concave",)},
                    ),
                )
            ),
            Suggestion("design.face_width_mm", (4 * m,), "four modules", decimals=2),
        ),
        apart=tuple(
            ({f"{own}_form": ("concave",), f"{mate}_form": ("concave", "spur")}, "a hollow tooth takes a convex one")
            for own, mate in (("pinion", "wheel"), ("wheel", "pinion"))
        ),
    )


HELIX = Suggestion("design.pinion_helix_angle_deg", (sp.Integer(0),), "spur; positive is right hand", "beta_deg")


def cylindrical():
    """External involute gears on parallel axes."""
    opposite = Suggestion(
        "design.wheel_helix_angle_deg", (-HELIX.symbol,), "the opposite hand on parallel axes"
    )
    return _involute(z_1 + z_2, 1, "teeth of the pinion : teeth of the wheel", opposite)


#: By how many teeth a pinion cutter of 20° that is fed in radially has fewer than its ring gear.
FEWER_IN_CUTTER = 18

#: Fewest teeth of a pinion cutter with a tip of some width.
LEAST_IN_CUTTER = 10


def internal():
    """A pinion in a ring gear, whose number of teeth is negative."""
    cutter = Suggestion(
        "design.shaper_teeth", (sp.Min(z_1, sp.Max(-z_2 - FEWER_IN_CUTTER, LEAST_IN_CUTTER)),),
        "those of the pinion, but so many fewer than the ring gear has that the cutter does not trim its tips",
        whole=True,
    )  # fmt: skip
    return _involute(-z_2 - z_1, -1, "teeth of the pinion : teeth of the ring gear, a negative number", cutter)


def _involute(teeth, side, z, *mate):
    """Involute gears on parallel axes; a centre distance that is given is met without backlash by profile shift, half
    of it each (ISO 21771:2007, working transverse pressure angle and sum of profile shift coefficients). ``teeth`` is
    the sum of the numbers of teeth, without its sign ``side``.
    """
    pressure = Suggestion("design.pressure_angle_deg", (sp.Integer(20),), "ISO 53", "alpha_deg")
    beta, alpha = sp.rad(HELIX.symbol), sp.rad(pressure.symbol)
    reference = Suggestion("", (m * teeth / (2 * sp.cos(beta)),), "reference centre distance", "a_0", 4)
    transverse = sp.atan2(sp.tan(alpha), sp.cos(beta))
    cosine = m * teeth * sp.cos(transverse) / (2 * sp.cos(beta) * a)
    working = sp.atan2(sp.sqrt(1 - cosine**2), cosine)
    shifts = side * teeth * (sp.tan(working) - working - sp.tan(transverse) + transverse) / (2 * sp.tan(alpha))
    apart = Suggestion(
        "", ((a - reference.symbol) / m,), "centre distance modification coefficient", "y", 4, within=(-1, 2)
    )
    shift = Suggestion("", (shifts,), "sum of the profile shift coefficients, by the centre distance", "x_sum", 4)
    half = "half of what meets the centre distance without backlash"
    return Outline(
        {"m": "normal module", "z": z, "a": "centre distance"},
        {},
        (
            Suggestion("design.normal_module_mm", (m,)),
            pressure,
            Suggestion("design.pinion_teeth", (z_1,), whole=True),
            Suggestion("design.wheel_teeth", (z_2,), whole=True),
            HELIX,
            *mate,
            reference, apart,
            Suggestion("design.center_distance_mm", (a,)),
            shift,
            Suggestion("design.pinion_profile_shift_coefficient", (shift.symbol / 2,), half),
            Suggestion("design.wheel_profile_shift_coefficient", (shift.symbol / 2,), half),
            Suggestion("design.face_width_mm", (10 * m,), "ten modules", decimals=2),
            Suggestion(
                "design.pinion_lead_crowning_um", (sp.Integer(8),),
                "crowning makes contact a point; unmodified involute flanks touch along a line",
            ),
            Suggestion("design.pinion_profile_crowning_um", (sp.Integer(5),), "the same across the profile"),
        ),
    )  # fmt: skip


def face_worm():
    size = m / sp.Rational(1334, 1000)
    share = z_2 / 60

    def scaled(key, value, why=""):
        return Suggestion(key, (sp.Rational(value) * size * share,), why, decimals=3)

    return Outline(
        {"m": "axial module", "z": "threads of the worm : teeth of the gear"},
        {},
        (
            Suggestion("design.worm_threads", (z_1,), whole=True),
            Suggestion("design.gear_teeth", (z_2,), whole=True),
            Suggestion("design.axial_module_mm", (m,)),
            scaled("design.offset_mm", "35", "proportions of NASA/CR-2002-211895, Table 1, from here on"),
            scaled("design.worm_axial_position_mm", "29.907"),
            scaled("design.worm_pitch_diameter_mm", "11.48"),
            Suggestion("design.worm_cone_angle_deg", (sp.Integer(5),)),
            scaled("design.gear_inner_radius_mm", "38.53"),
            scaled("design.gear_outer_radius_mm", "52.5"),
            Suggestion("design.profile_angle_deg", (sp.Integer(10),)),
            Suggestion(
                "design.plunge_mm_per_rad2", (sp.Rational(3, 1000) * size,), "crowning along the path", decimals=5
            ),
            Suggestion("design.blade_parabola_per_mm", (sp.Rational(1, 100) / size,), "crowning across it", decimals=5),
        ),
    )


def bevel():
    """Everything but module and teeth is the drawing's (:mod:`derive.drives.bevel_drawing`)."""
    return Outline(
        {"m": "outer transverse module", "z": "teeth of the pinion : teeth of the gear"},
        {},
        (
            Suggestion("design.outer_transverse_module_mm", (m,)),
            Suggestion("design.pinion_teeth", (z_1,), whole=True),
            Suggestion("design.gear_teeth", (z_2,), whole=True),
        ),
    )
