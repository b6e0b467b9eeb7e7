"""Parameters of spiral bevel and hypoid gears: keys of the drive, of either member, and what a design derives."""

from dataclasses import dataclass

import sympy as sp

from derive.language.symbols import Parameter, Table, parameter

POSITIVE = (0, sp.oo)
HALF_TURN = (-sp.pi / 2, sp.pi / 2)

flank = parameter(
    "flank", "s", "side of the gear tooth", table=Table.FLANK, choices=(("convex", 1), ("concave", -1)), default=1
)
pinion_teeth = parameter("pinion_teeth", "N_1", "teeth of the pinion", domain=POSITIVE, integer=True, required=True)
gear_teeth = parameter("gear_teeth", "N_2", "teeth of the gear", domain=POSITIVE, integer=True, required=True)
shaft_angle = parameter(
    "shaft_angle_deg", "Sigma", "angle between the axes, each counted towards its gear's back", domain=(0, sp.pi),
    default=sp.pi / 2,
)  # fmt: skip
offset = parameter(
    "offset_mm", "E", "shortest distance of the axes, above 0 where it makes the pinion's spiral angle the larger",
    default=0,
)  # fmt: skip
blade_groups = parameter(
    "blade_groups", "N_b", "blade groups of a cutter that hobs: as many teeth pass while it turns once",
    domain=POSITIVE, integer=True, required=True,
)  # fmt: skip


@dataclass(frozen=True)
class Settings:
    """The keys of one member: blade, machine settings, blank; ``body`` is "pinion" or "gear"."""

    body: str
    point_radius: Parameter
    blade_angle: Parameter
    blade_curvature: Parameter
    blade_reference: Parameter
    edge_radius: Parameter
    blade_offset: Parameter
    radial: Parameter
    cradle_angle: Parameter
    tilt: Parameter
    swivel: Parameter
    root_angle: Parameter
    blank_offset: Parameter
    sliding_base: Parameter
    center_to_back: Parameter
    ratio_of_roll: Parameter
    modified_roll: tuple[Parameter, ...]
    helical_motion: Parameter
    pitch_angle: Parameter
    pitch_apex: Parameter
    face_angle: Parameter
    face_apex: Parameter
    outer_cone_distance: Parameter
    face_width: Parameter

    def parameters(self, *, formate=False, hobbed=False):
        """All of them, in the order of the design; a ``formate`` member is not rolled, and only the blade of one that
        is ``hobbed`` stands off the radius of the cutter.
        """
        listed = (getattr(self, name) for name in self.__dataclass_fields__ if name != "body")
        every = (q for entry in listed for q in (entry if isinstance(entry, tuple) else (entry,)))
        rolled = (self.ratio_of_roll, *self.modified_roll, self.helical_motion)
        return tuple(q for q in every if not (formate and q in rolled) and (hobbed or q is not self.blade_offset))


def _settings(body):
    def key(name, symbol, meaning, **kind):
        return parameter(name, f"{symbol}_{body}", f"{meaning} of the {body}", table=body, **kind)

    return Settings(
        body=body,
        point_radius=key(
            "point_radius_mm", "r_p", "radius of the blade line in the tip plane", domain=POSITIVE, required=True
        ),
        blade_angle=key(
            "blade_angle_deg", "alpha", "blade angle from the cutter's axis", domain=(-sp.pi / 6, sp.pi / 3),
            required=True,
        ),
        blade_curvature=key(
            "blade_curvature_per_mm", "kappa", "curvature of the edge, above 0 where it crowns the profile", default=0
        ),
        blade_reference=key(
            "blade_reference_mm", "u_0", "distance from the tip at which the edge touches its line", default=0
        ),
        edge_radius=key(
            "edge_radius_mm", "rho_f", "rounding of the blade's tip", domain=POSITIVE, lower_included=True, default=0
        ),
        blade_offset=key(
            "blade_offset_angle_deg", "delta_b", "turn of the blade's plane about its reference point",
            domain=HALF_TURN, default=0,
        ),
        radial=key("radial_setting_mm", "S_r", "radial setting", domain=POSITIVE, required=True),
        cradle_angle=key(
            "cradle_angle_deg", "q", "basic cradle angle from the tooth being cut", domain=(-sp.pi, sp.pi),
            required=True,
        ),
        tilt=key("tilt_deg", "tilt", "tilt of the cutter", domain=HALF_TURN, default=0),
        swivel=key("swivel_deg", "swivel", "swivel angle of the tilt", domain=(-2 * sp.pi, 2 * sp.pi), default=0),
        root_angle=key("root_angle_deg", "gamma_m", "machine root angle", domain=HALF_TURN, required=True),
        blank_offset=key("blank_offset_mm", "E_m", "blank offset", default=0),
        sliding_base=key("sliding_base_mm", "X_B", "sliding base, above 0 away from the cutter", default=0),
        center_to_back=key("center_to_back_mm", "X_D", "machine centre to back", default=0),
        ratio_of_roll=key("ratio_of_roll", "R", "turn of the work over turn of the cradle", required=True),
        modified_roll=tuple(
            key(f"roll_{name}", f"roll_{name}", f"modified roll {name.upper()}", default=0)
            for name in ("2c", "6d", "24e", "120f", "720g")
        ),
        helical_motion=key("helical_motion_mm_per_rad", "H", "helical motion", default=0),
        pitch_angle=key("pitch_angle_deg", "delta", "pitch angle", domain=(0, sp.pi / 2), required=True),
        pitch_apex=key("pitch_apex_mm", "d", "pitch apex beyond the crossing point", default=0),
        face_angle=key("face_angle_deg", "delta_a", "face angle", domain=HALF_TURN, required=True),
        face_apex=key("face_apex_mm", "d_a", "face apex beyond the crossing point", default=0),
        outer_cone_distance=key(
            "outer_cone_distance_mm", "A_o", "outer cone distance", domain=POSITIVE, required=True,
        ),
        face_width=key("face_width_mm", "F", "face width", domain=POSITIVE, required=True),
    )  # fmt: skip


PINION, GEAR = _settings("pinion"), _settings("gear")

error_offset = parameter("offset_mm", "dE", "error of the offset (V)", table=Table.MISALIGNMENT, default=0)
error_pinion = parameter(
    "pinion_axial_mm", "dP", "pinion withdrawn along its axis (H)", table=Table.MISALIGNMENT, default=0
)
error_gear = parameter("gear_axial_mm", "dG", "gear withdrawn along its axis (J)", table=Table.MISALIGNMENT, default=0)
error_angle = parameter(
    "shaft_angle_deg", "dSigma", "error of the shaft angle, above 0 opens it", table=Table.MISALIGNMENT, default=0
)
separation = parameter(
    "separation_mm", "delta_sep", "separation for contact ellipses", table=Table.CONTACT, domain=POSITIVE,
    default=sp.Rational(635, 100000),
)  # fmt: skip


def _mean(key, symbol, meaning):
    return parameter(f"mean_{key}", symbol, f"{meaning}, at the mean point", table=Table.PLACEMENT)


mean_u_gear = _mean("w_gear_mm", "w_mean_gear", "distance on the gear's blade line")
mean_u_pinion = _mean("w_pinion_mm", "w_mean_pinion", "distance on the pinion's blade line")
mean_theta_gear = _mean("theta_gear_deg", "theta_mean_gear", "angle of the gear's cutter")
mean_cradle_gear = _mean("phi_cradle_gear_deg", "phi_mean_gear", "turn of the gear's cradle")
mean_theta_pinion = _mean("theta_pinion_deg", "theta_mean_pinion", "angle of the pinion's cutter")
mean_cradle_pinion = _mean("phi_cradle_pinion_deg", "phi_mean_pinion", "turn of the pinion's cradle")
mean_gear_angle = _mean("gear_angle_deg", "phi_2_mean", "angle of the gear")
mean_pinion_angle = _mean("pinion_angle_deg", "phi_1_mean", "angle of the pinion")

mean_point = tuple(_mean(f"point_{a}_mm", f"mean_point_{a}", f"{a} of the gear's flank, gear frame") for a in "xyz")
mean_normal = tuple(_mean(f"normal_{a}", f"mean_normal_{a}", f"{a} of its normal, any length") for a in "xyz")
mean_point_pinion = tuple(
    _mean(f"point_pinion_{a}_mm", f"mean_point_pinion_{a}", f"{a} of the pinion's flank, pinion frame") for a in "xyz"
)

#: Keys of a member's surface parameters at the mean point, by the first word of the parameter's name.
MEAN = {
    "pinion": {"u": mean_u_pinion, "theta": mean_theta_pinion, "phi": mean_cradle_pinion},
    "gear": {"u": mean_u_gear, "theta": mean_theta_gear, "phi": mean_cradle_gear},
}


def parameters(*, formate=False, hobbed=False):
    """The parameter vector of a pair with a generated or a ``formate`` gear, both members ``hobbed`` or milled."""
    indexed, blade = ((blade_groups,), (mean_u_pinion,)) if hobbed else ((), ())
    cradle = () if formate else (mean_cradle_gear,)
    return (
        flank, pinion_teeth, gear_teeth, shaft_angle, offset, *indexed,
        *PINION.parameters(hobbed=hobbed), *GEAR.parameters(formate=formate, hobbed=hobbed),
        *((mean_u_gear,) if formate or hobbed else ()), mean_theta_gear, *cradle, mean_gear_angle,
        *blade, mean_theta_pinion, mean_cradle_pinion, mean_pinion_angle,
        *mean_point, *mean_normal, *mean_point_pinion,
        error_offset, error_pinion, error_gear, error_angle, separation,
    )  # fmt: skip
