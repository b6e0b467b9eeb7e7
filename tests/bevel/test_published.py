"""Flank points of a spiral bevel set: Bibel, Reddy, Kumar, NASA CR-191009 (1994), settings and surface coordinates.

Inch and degree as printed. The points are the root at the toe: z = ℓ cos γ − c sin γ, radius z tan γ + c/cos γ with
ℓ = (outer cone distance − face width) cos(dedendum angle); their last digits agree to 8.3e-8 inch, not better.
"""

import numpy as np
import pytest
from scipy.optimize import fsolve

from meshwright import Drive

INCH = 25.4

#: point radius, blade angle, S_r, q, m_cw, E_m, L_m, pitch angle, dedendum angle, point
PRINTED = {
    ("pinion", "concave"): (2.96562137806, 18.045669752, 2.94780202969, 63.9420304635, 0.30838512709, 0.154575896,
                            0.0384999977874, 18.4333333, 1.56666666,
                            (0.7948185893337920, 0.1518771876505158, 2.565573009266192)),
    ("pinion", "convex"): (3.071306157, 24.337423854, 2.80104946, 53.9259945467, 0.3220428536, -0.17426159493,
                           -0.0518138227, 18.4333333, 1.56666666,
                           (0.7093463178422439, 0.3893983454546772, 2.565573009266191)),
    ("gear", "concave"): (3.0325, 22.0, 2.85995004691, 59.2342023, 0.9508646, 0.0, 0.0, 71.5666666, 3.8833333333,
                          (2.474433967420987, -0.3395653327372070, 0.9856358798469023)),
    ("gear", "convex"): (2.9675, 22.0, 2.85995004691, 59.2342023, 0.9508646, 0.0, 0.0, 71.5666666, 3.8833333333,
                         (2.487328996883535, -0.2265447761173172, 0.9856358798469033)),
}  # fmt: skip
CONE_DISTANCE, FACE_WIDTH, CLEARANCE = 3.191, 0.5, {"pinion": 0.03, "gear": 0.0366}


def settings(member, side):
    radius, blade, radial, cradle, m_cw, offset, l_m, pitch, dedendum, _ = PRINTED[member, side]
    root = np.radians(pitch - dedendum)
    return {
        "point_radius_mm": radius * INCH, "blade_angle_deg": blade, "radial_setting_mm": radial * INCH,
        "cradle_angle_deg": cradle, "ratio_of_roll": 1 / m_cw, "blank_offset_mm": offset * INCH,
        "root_angle_deg": pitch - dedendum, "sliding_base_mm": l_m * np.tan(root) * INCH,
        "center_to_back_mm": -l_m / np.cos(root) * INCH, "pitch_angle_deg": pitch, "face_angle_deg": pitch,
        "face_apex_mm": 3.0 / np.sin(np.radians(pitch)), "outer_cone_distance_mm": CONE_DISTANCE * INCH,
        "face_width_mm": FACE_WIDTH * INCH,
    }  # fmt: skip


@pytest.mark.parametrize(("member", "side"), PRINTED)
def test_the_root_at_the_toe_is_where_the_report_has_it(member, side):
    mate = {"convex": "concave", "concave": "convex"}[side]
    own, other = ("pinion", "gear") if member == "pinion" else ("gear", "pinion")
    drive = Drive.from_tables({
        "drive": "bevel", "flank": side if member == "gear" else mate,
        "design": {"pinion_teeth": 12, "gear_teeth": 36}, own: settings(own, side), other: settings(other, mate),
    })  # fmt: skip
    *_, pitch, dedendum, printed = PRINTED[member, side]
    root, clearance = np.radians(pitch - dedendum), CLEARANCE[member]
    reach = (CONE_DISTANCE - FACE_WIDTH) * np.cos(np.radians(dedendum))
    z = reach * np.cos(root) - clearance * np.sin(root)
    radius = z * np.tan(root) + clearance / np.cos(root)
    flank = drive.flank("pinion" if member == "pinion" else "wheel")

    def place(q):
        return flank([q]).points[0] / INCH

    found = fsolve(lambda q: [np.hypot(*place(q)[:2]) - radius, place(q)[2] - z], [0.1, -2.19], xtol=1e-13)
    np.testing.assert_allclose(place(found), printed, atol=1e-7)
