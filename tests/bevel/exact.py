"""Machine settings of conjugate and crowned pairs, from geometry alone: designs whose contact is known in closed form.

Crown gear: both members are cut by one imaginary crown gear, so that they are conjugate; a cutter that touches the
common cone along the generatrix of the mean point makes point contact without transmission error. Face-hobbed, cutter
and crown gear turn against one another: in the pitch plane its teeth are extended epicycloids, and where the blade's
plane is normal to one, another cutter of the same blade groups touches it along the same generatrix. Formate-cradle:
the cradle of the pinion is the gear itself.
"""

from math import asin, atan2, cos, degrees, hypot, pi, radians, sin, sqrt, tan

import numpy as np


def _blank(pitch, apex, face, face_apex, outer, width):
    return {
        "pitch_angle_deg": degrees(pitch), "pitch_apex_mm": apex, "face_angle_deg": degrees(face),
        "face_apex_mm": face_apex, "outer_cone_distance_mm": outer, "face_width_mm": width,
    }  # fmt: skip


def _centred(mean, radius, spiral, turns):
    """Radial setting, cradle angle and, where the cutter hobs, blade offset angle for a spiral angle at the mean cone
    distance; ``turns`` is the turn of the crown gear over that of the cutter.
    """
    offset = asin(turns * mean * cos(spiral) / radius)
    x, y = mean - radius * sin(spiral - offset), radius * cos(spiral - offset)
    settings = {"radial_setting_mm": hypot(x, y), "cradle_angle_deg": degrees(atan2(y, x))}
    return settings | ({"blade_offset_angle_deg": degrees(offset)} if turns else {})


def crown_pair(
    flank="convex", *, hand="left", teeth=(15, 44), shaft_deg=90.0, module=4.0, width=27.0, radius=76.2,
    spiral_deg=35.0, pressure_deg=20.0, dedendum=3.7, addendum=3.0, lengthwise=0.0, profile=0.0, blade_groups=0,
):  # fmt: skip
    """Uniform depth, both members by the same crown gear. ``lengthwise``: by how much the pinion's cutter radius
    differs, ``profile``: curvature of the pinion's blade; without either the flanks touch along lines. With
    ``blade_groups`` both are face-hobbed.
    """
    (n1, n2), shaft = teeth, radians(shaft_deg)
    pinion_cone = atan2(sin(shaft), n2 / n1 + cos(shaft))
    outer = n2 * module / (2 * sin(shaft - pinion_cone))
    mean, spiral, alpha = outer - width / 2, radians(spiral_deg), radians(pressure_deg)
    turns = blade_groups * sin(pinion_cone) / n1
    side = {"pinion": 1, "gear": -1} if flank == "convex" else {"pinion": -1, "gear": 1}

    def member(name, cone, change, curvature):
        s = side[name]
        settings = {
            "point_radius_mm": radius + change - s * dedendum * tan(alpha),
            "blade_angle_deg": pressure_deg,
            **_centred(mean, radius + change, spiral, turns),
            "root_angle_deg": degrees(cone),
            "sliding_base_mm": -dedendum,
            "ratio_of_roll": 1 / sin(cone),
            **_blank(cone, 0.0, cone, addendum / sin(cone), outer, width),
        }
        if curvature or turns:
            settings |= {"blade_curvature_per_mm": curvature, "blade_reference_mm": dedendum / cos(alpha)}
        return settings

    return {
        "drive": "bevel",
        "flank": flank,
        "design": {
            "pinion_teeth": n1, "gear_teeth": n2, "shaft_angle_deg": shaft_deg, "hand": hand,
            **({"blade_groups": blade_groups} if blade_groups else {}),
        },
        "pinion": member("pinion", pinion_cone, side["pinion"] * lengthwise, profile),
        "gear": member("gear", shaft - pinion_cone, 0.0, 0.0),
    }  # fmt: skip


def _turn(axis, angle):
    c, s = cos(angle), sin(angle)
    return {
        "y": np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]),
        "z": np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]),
    }[axis]


def formate_cradle(
    flank="convex", *, hand="left", teeth=(11, 41), shaft_deg=90.0, offset=30.0, gear_radius=95.0, width=27.0,
    gear_pitch_deg=72.0, radius=76.2, spiral_deg=32.0, pressure_deg=20.0, dedendum=4.0, addendum=3.2, lengthwise=2.0,
    taper_deg=0.0,
):  # fmt: skip
    """A Formate gear whose pinion rolls with the gear's own tool cone, or with a cone that touches it.

    Conjugate for any offset; ``gear_radius`` is the gear's mean pitch radius, ``taper_deg`` its dedendum angle.
    """
    (n1, n2), shaft = teeth, radians(shaft_deg)
    gear_cone, alpha, spiral = radians(gear_pitch_deg), radians(pressure_deg), radians(spiral_deg)
    mean, taper = gear_radius / sin(gear_cone), radians(taper_deg)
    root, deep = gear_cone - taper, dedendum * cos(taper)
    apex = deep - mean * sin(taper)  # of the pitch cone, above the root's plane
    s2 = -1 if flank == "convex" else 1
    s1 = -s2
    along = mean * cos(taper)
    centre = along - radius * sin(spiral), radius * cos(spiral)
    gear = {
        "method": "formate",
        "point_radius_mm": radius - s2 * deep * tan(alpha),
        "blade_angle_deg": pressure_deg,
        "radial_setting_mm": hypot(*centre),
        "cradle_angle_deg": degrees(atan2(centre[1], centre[0])),
        "root_angle_deg": degrees(root),
        "sliding_base_mm": -apex,
        **_blank(gear_cone, 0.0, gear_cone, addendum / sin(gear_cone), mean + width / 2, width),
    }
    # Gear machine to gear frame; the pinion's cutter lies on the same axis, its tip plane at the top of the gear tooth.
    lay = _turn("y", root - pi / 2)
    depth = deep + addendum + 0.8
    point = np.array([along, 0.0, -deep])  # the mean point, tip plane at z = 0
    axis_point = np.array([*centre, -depth])
    outward = (point[:2] - centre) / radius
    normal = np.array([*(-s2 * cos(alpha) * outward), -sin(alpha)])
    away = np.array([*(np.array(centre) - point[:2]), 0.0])
    axis_point = axis_point + s1 * lengthwise * away / hypot(*away[:2])
    x, y, z = lay @ (axis_point + np.array([0, 0, apex]))
    q = -atan2(-y, x)
    pinion = {
        "point_radius_mm": radius + s1 * lengthwise + s2 * (depth - deep) * tan(alpha),
        "blade_angle_deg": pressure_deg,
        "radial_setting_mm": hypot(x, y),
        "cradle_angle_deg": degrees(q),
        "tilt_deg": 90.0 - degrees(root),
        "swivel_deg": -degrees(q),
        "root_angle_deg": shaft_deg - 90.0,
        "blank_offset_mm": offset,
        "sliding_base_mm": z,
        "ratio_of_roll": n2 / n1,
        **_pinion_blank(
            lay @ (point + np.array([0, 0, apex])), _turn("y", gear_cone - pi / 2) @ np.array([0, 0, 1.0]),
            lay @ normal, shaft, offset, n1 / n2, width, addendum,
        ),
    }
    return {
        "drive": "bevel",
        "flank": flank,
        "design": {
            "pinion_teeth": n1, "gear_teeth": n2, "shaft_angle_deg": shaft_deg, "offset_mm": offset, "hand": hand,
        },
        "pinion": pinion,
        "gear": gear,
    }  # fmt: skip


def _pinion_blank(mean, pitch_normal, flank_normal, shaft, offset, ratio, width, addendum):
    """Pitch cone that touches the gear's pitch plane where its mean point meets the pinion: n·(v2 − v1) = 0."""
    axis, foot = np.array([sin(shaft), 0, cos(shaft)]), np.array([0, offset, 0])
    def miss(turn):
        point, normal = _turn("z", turn) @ mean, _turn("z", turn) @ flank_normal
        return normal @ (ratio * np.cross([0, 0, 1], point) + np.cross(axis, point - foot))

    turns = np.linspace(-0.9, 0.9, 181)
    misses = np.array([miss(turn) for turn in turns])
    at = min(np.flatnonzero(misses[:-1] * misses[1:] <= 0), key=lambda k: abs(turns[k]))
    low, high = turns[at], turns[at + 1]
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (low, middle) if miss(low) * miss(middle) <= 0 else (middle, high)
    point, up = _turn("z", low) @ mean, _turn("z", low) @ pitch_normal
    cone = asin(abs(axis @ up))
    apex = foot + axis * (up @ (point - foot)) / (up @ axis)
    d = -(apex - foot) @ axis
    distance = sqrt((point - apex) @ (point - apex))
    return _blank(cone, d, cone, d + addendum / sin(cone), distance + width / 2 + 1.0, width + 2.0)
