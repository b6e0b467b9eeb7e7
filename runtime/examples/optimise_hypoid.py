"""Choose the pinion's machine settings of a hypoid pair with IPOPT for a wanted contact pattern, the cutters unchanged.

Wanted: at mid face a contact ellipse of given length, a path of contact of given inclination, and a transmission error
of given height over one pitch, symmetrical about the middle of the path. There contact stays at its place in the middle
of the gear's flank, and the pinion's blade at its depth. Of the settings that do so, those nearest to the
ones at hand are chosen. The result is verified by the C solver.

    python runtime/examples/optimise_hypoid.py
"""

from dataclasses import astuple, dataclass, fields

import casadi
import numpy as np

from meshwright import Drive, differentiable
from meshwright.contact.results import ARCSEC

#: Free keys, and the change of each that weighs as much as one of the others.
FREE = {
    "pinion.tilt_deg": 0.5,
    "pinion.swivel_deg": 0.5,
    "pinion.radial_setting_mm": 0.5,
    "pinion.cradle_angle_deg": 0.5,
    "pinion.root_angle_deg": 0.5,
    "pinion.blank_offset_mm": 0.5,
    "pinion.sliding_base_mm": 0.5,
    "pinion.ratio_of_roll": 0.05,
    "pinion.roll_2c": 0.02,
    "pinion.roll_6d": 0.1,
}

#: Where contact is looked at, in pitches of the pinion about the middle of the path.
BEGIN, MIDDLE, END = -0.5, 0.0, 0.5


@dataclass(frozen=True)
class Pattern:
    """Semi-major axis of the ellipse at mid face, mm; inclination of the path to the gear's pitch line, over one pitch
    and in the axial section, 0° from heel to toe, 90° from tip to root; transmission error over one pitch, arcsec.
    """

    semi_major_mm: float
    path_deg: float
    peak_to_peak_arcsec: float


WANTED = Pattern(semi_major_mm=5.5, path_deg=40.0, peak_to_peak_arcsec=8.0)


@dataclass(frozen=True)
class Optimum:
    """What IPOPT found: its word, its count, settings by key; ``slopes`` [pattern, key] in the units of both."""

    status: str
    iterations: int
    settings: dict
    pattern: Pattern
    slopes: np.ndarray


def optimised(drive, wanted=WANTED):
    """The :class:`Optimum` for a hypoid pair."""
    start, sizes = np.array([_value(drive, key) for key in FREE]), np.array([*FREE.values()])
    settings = casadi.MX.sym("settings", len(FREE))
    contact = {pitches: _Contact.at(drive, settings, pitches) for pitches in (BEGIN, MIDDLE, END)}
    lag = [(contact[MIDDLE].error - contact[k].error) / ARCSEC for k in (BEGIN, END)]
    travel = contact[END].place - contact[BEGIN].place
    path = np.degrees(1) * casadi.atan2(-travel[1], -travel[0])
    middle = contact[MIDDLE]
    stays = casadi.vertcat(middle.place, middle.depth)
    stayed = casadi.Function("now", [settings], [stays])(start)
    of_pattern = casadi.vertcat(middle.semi_major, path, (lag[0] + lag[1]) / 2)

    change = casadi.MX.sym("change", len(FREE))
    symmetrical = casadi.vertcat(lag[1] - lag[0], (middle.ratio / drive.ratio - 1) / ARCSEC)
    conditions = casadi.vertcat(of_pattern - casadi.DM(astuple(wanted)), symmetrical, stays - stayed)
    conditions = casadi.Function("conditions", [settings], [conditions])(start + sizes * change)
    problem = {"x": change, "f": casadi.sumsqr(change), "g": conditions}
    ipopt = {"print_level": 0, "sb": "yes", "max_iter": 60, "hessian_approximation": "limited-memory"}
    solver = casadi.nlpsol("settings", "ipopt", problem, {"print_time": False, "ipopt": ipopt})
    best = start + sizes * np.array(solver(x0=0.0, lbg=0.0, ubg=0.0)["x"]).ravel()

    seen = casadi.Function("seen", [settings], [of_pattern, casadi.jacobian(of_pattern, settings)])
    pattern, slopes = map(np.array, seen(best))
    return Optimum(
        status=solver.stats()["return_status"],
        iterations=solver.stats()["iter_count"],
        settings=dict(zip(FREE, map(float, best), strict=True)),
        pattern=Pattern(*map(float, pattern.ravel())),
        slopes=slopes,
    )


@dataclass(frozen=True)
class _Contact:
    """CasADi expressions of the settings, at one angle: transmission error (rad), ratio of the speeds, semi-major axis,
    place on the gear as distance along its pitch cone and height above it, depth on the pinion's blade (mm).
    """

    error: object
    ratio: object
    semi_major: object
    place: object
    depth: object

    @classmethod
    def at(cls, drive, settings, pitches):
        """Start values come from the C solver."""
        description, angle = drive.design.description, _angle(drive, pitches)
        outputs = {o["name"]: slice(o["offset"], o["offset"] + o["size"]) for o in description["outputs"]}
        p = differentiable.parameters(drive.design, tuple(FREE))(settings)
        (start,), _ = drive.trace([angle])
        tca = differentiable.differentiable_tca(description, drive.design.mirrored)
        seen = tca(p=p, phi=angle, x0=start)
        x, y, z = casadi.vertsplit(seen["observation"][outputs["point_wheel"]])
        cone = drive.design.value("pitch_angle_deg", "gear")
        radius, height = casadi.sqrt(x**2 + y**2), z + drive.design.value("pitch_apex_mm", "gear")
        place = casadi.vertcat(
            height * np.cos(cone) + radius * np.sin(cone), radius * np.cos(cone) - height * np.sin(cone)
        )
        observed = seen["observation"]
        ratio, depth = observed[outputs["instantaneous_ratio"]], observed[outputs["u_pinion"]]
        return cls(seen["error"], ratio, seen["semi_axes"][0], place, depth)


def _angle(drive, pitches):
    middle = drive.design.reference_angle * (-1 if drive.design.mirrored else 1)
    return middle + pitches * drive.pitch()


def _value(drive, key):
    """A key's value in its own unit."""
    table, name = key.split(".")
    factors = {(p["table"], p["key"]): p["factor"] for p in drive.design.description["parameters"]}
    return drive.design.value(name, table) / factors[table, name]


def with_settings(drive, settings):
    """The drive with these values by ``table.key``."""
    return drive.with_(pinion={key.removeprefix("pinion."): value for key, value in settings.items()})


def verified(drive, optimum):
    """The :class:`Pattern` that the C solver finds, over a whole pitch, and the contact ratio."""
    best = with_settings(drive, optimum.settings)
    found = best.tca([_angle(drive, pitches) for pitches in (BEGIN, MIDDLE, END)])
    points = found.body_points["wheel"]
    cone = drive.design.value("pitch_angle_deg", "gear")
    radius, height = np.hypot(points[:, 0], points[:, 1]), points[:, 2] + drive.design.value("pitch_apex_mm", "gear")
    along, above = height * np.cos(cone) + radius * np.sin(cone), radius * np.cos(cone) - height * np.sin(cone)
    ratio = best.contact_ratio()
    pattern = Pattern(
        semi_major_mm=float(found.semi_axes[1, 0]),
        path_deg=float(np.degrees(np.arctan2(above[0] - above[2], along[0] - along[2]))),
        peak_to_peak_arcsec=float(ratio.transmission_error.envelope_peak_to_peak / ARCSEC),
    )
    return pattern, ratio.contact_ratio


def main():
    drive = Drive.load("bevel-hypoid")
    best = optimised(drive)
    found, contact_ratio = verified(drive, best)
    print(f"IPOPT: {best.status}, {best.iterations} iterations\n")
    print(f"{'setting':28}{'at hand':>12}{'chosen':>14}")
    for key, value in best.settings.items():
        print(f"{key:28}{_value(drive, key):12.4f}{value:14.6f}")
    print(f"\n{'':28}{'wanted':>12}{'IPOPT':>14}{'C solver':>14}")
    for field, *values in zip(fields(Pattern), *map(astuple, (WANTED, best.pattern, found)), strict=True):
        print(f"{field.name:28}{values[0]:12.4f}{values[1]:14.8f}{values[2]:14.8f}")
    print(f"{'contact ratio':28}{'':26}{contact_ratio:14.4f}")
    print(f"\n{'change a unit of':28}" + "".join(f"{field.name:>20}" for field in fields(Pattern)))
    for key, slopes in zip(best.settings, best.slopes.T, strict=True):
        print(f"{key:28}" + "".join(f"{slope:20.5f}" for slope in slopes))


if __name__ == "__main__":
    main()
