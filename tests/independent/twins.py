"""Designs of every family in their independent formulation, each as one square system of equations.

``twin(drive)`` gives for changed keys the residual of all its unknowns – for a face worm those of the head-cutter's
placement too – and what can be read off a solution. Solutions are chords from a double-precision start.
"""

from dataclasses import dataclass

import mpmath
import numpy as np
from mpmath import mpf

from tests.independent import spherical
from tests.independent.chords import chords, jacobian
from tests.independent.cylindrical_gears import pair_of
from tests.independent.face_worm import FaceWorm
from tests.independent.vectors import rotate
from tests.independent.worm import WormDrive


@dataclass(frozen=True)
class Twin:
    """``of(values)``: the drive for ``{"table.key": value}`` (mm, rad) of every real key; ``names`` of what is read.

    ``residual(of, unknowns, phi)``, ``seen(of, unknowns, phi)``: names' values and the contact point. ``start``:
    approximate unknowns.
    """

    of: object
    names: tuple
    residual: object
    seen: object
    start: tuple

    def solved(self, values, phi, near=None, inverse=None):
        """What is seen at the solution near ``start``, or where else it is sought, by :func:`~.chords.chords`."""
        drive = self.of(values)
        near = self.start if near is None else near
        return self.seen(drive, chords(lambda x: self.residual(drive, x, phi), near, inverse), phi)

    def slopes(self, given, phi, changed):
        """d(names and contact point)/d(key) by central differences, a row for each key of ``changed``.

        ``given`` are the values of what the design gives, ``changed`` those of what is changed, as if it were given.
        """
        near, step = [mpf(float(u)) for u in self.start], mpf(10) ** -18
        drive = self.of(given)
        inverse = np.linalg.inv(jacobian(lambda x: self.residual(drive, x, phi), near))
        rows = []
        for key, value in changed.items():
            ends = [self.solved(given | {key: value + h}, phi, near, inverse) for h in (step, -step)]
            rows.append([float((a - b) / (2 * step)) for a, b in zip(*ends, strict=True)])
        return np.array(rows)


def twin(drive, contact):
    """The twin of a right-hand drive with one contact, the only row of a :class:`~meshwright.contact.results.TCA`."""
    solution = {name: float(values[0]) for name, values in contact.unknowns.items()}
    solution["transmission_error"] = float(contact.error[0])
    return _FAMILIES[drive.design.family](drive, solution, float(contact.wheel_angles[0]))


def _tables(drive, values):
    """Tables of the design with values (mm, rad) put in, in the units of the keys."""
    tables = drive.design.given()
    for place, value in values.items():
        table, key = place.split(".")
        unit = 180 / mpmath.pi if key.endswith("_deg") else 1000 if key.endswith("_um") else 1
        tables.setdefault(table, {})[key] = value * unit
    return tables


def _worm(drive, solution, wheel_angle):
    def seen(worm, unknowns, phi):
        t_w, psi_w, t_h, psi_h, phi_h, phi_2 = unknowns
        error = phi_2 - mpf(worm.threads) / worm.teeth * phi
        return [t_w, psi_w, t_h, psi_h + phi_h, error, *rotate("z", phi, worm.thread(t_w, psi_w)[0])]

    return Twin(
        of=lambda values: WormDrive.of(_tables(drive, values)),
        names=("t_worm", "psi_worm", "t_hob", "psi_fixed_hob", "transmission_error"),
        residual=WormDrive.residual,
        seen=seen,
        start=(*(solution[q] for q in ("t_worm", "psi_worm", "t_hob", "psi_hob", "phi_hob")), wheel_angle),
    )


def _spherical(drive, solution, wheel_angle):
    sign = 1 if drive.design.tables["flank"] == "left" else -1

    def gear(d, member):
        def own(key):
            return d.get(f"{member}_{key}", d.get(key))

        alpha, form = mpmath.radians(d["pressure_angle_deg"]), d[f"{member}_form"]
        sizes = d["module_mm"], d[f"{member}_teeth"], alpha, form, d.get(f"{member}_sphere_radius_mm")
        return spherical.Gear(*sizes, sign, own("edge_offset_mm"), own("half_space_mm"))

    def of(values):
        tables = _tables(drive, values)
        d, errors = tables["design"], tables.get("misalignment", {})
        angles = (mpmath.radians(errors.get(f"{which}_deg", 0)) for which in ("horizontal", "vertical"))
        return spherical.Pair(gear(d, "pinion"), gear(d, "wheel"), errors.get("center_distance_mm", 0), *angles)

    names = tuple(u["name"] for u in drive.design.description["unknowns"])
    return Twin(
        of=of,
        names=names,
        residual=lambda pair, unknowns, phi: pair.residual(phi, *unknowns),
        seen=lambda pair, unknowns, phi: [*unknowns, *pair.pinion_in_mesh(phi, *unknowns[:2])[0]],
        start=(*(solution[name] for name in names[:4]), solution["transmission_error"]),
    )


def _cylindrical_gears(drive, solution, wheel_angle):
    parallel = drive.design.value("shaft_angle_deg") == 0.0
    names = tuple(u["name"] for u in drive.design.description["unknowns"])
    return Twin(
        of=lambda values: pair_of(_tables(drive, values), parallel),
        names=names,
        residual=lambda pair, unknowns, phi: pair.residual(phi, unknowns),
        seen=lambda pair, unknowns, phi: [*unknowns, *pair.placed(phi, unknowns)[0]],
        start=(*(solution[name] for name in names[:4]), solution["transmission_error"]),
    )


_FACE_WORM = {
    "design.axial_module_mm": "module", "design.offset_mm": "offset", "design.worm_axial_position_mm": "position",
    "design.worm_pitch_diameter_mm": "diameter", "design.worm_cone_angle_deg": "cone",
    "design.gear_inner_radius_mm": "inner", "design.gear_outer_radius_mm": "outer",
    "design.profile_angle_deg": "profile", "design.plunge_mm_per_rad2": "plunge",
    "design.blade_parabola_per_mm": "crown", "design.head_cutter_radius_mm": "cutter_radius",
    "design.head_cutter_tilt_change_deg": "tilt_change", "design.blade_angle_deg": "blade_angle",
    "misalignment.offset_mm": "d_offset", "misalignment.axial_mm": "d_axial", "misalignment.shaft_angle_deg": "d_angle",
}  # fmt: skip


def _face_worm(drive, solution, wheel_angle):
    design = drive.design

    def of(values):
        d = design.tables["design"]
        named = {name: values[key] for key, name in _FACE_WORM.items() if key in values}
        rule = design.as_solved()["design"]["pitch_point_rule"]
        return FaceWorm(int(design.flank), d["worm_threads"], d["gear_teeth"], rule=rule, **named)

    def residual(worm, unknowns, phi):
        phase, t_1, psi_1, t_2, psi_2, *pitch = unknowns[:8]
        places = phase, [t_1, psi_1], [t_2, psi_2], pitch
        worm.install(*places)
        return [*worm.placement(*places), *worm.residual(*unknowns[8:], phi)]

    def seen(worm, unknowns, phi):
        *parameters, phi_2 = unknowns[8:]
        return [*parameters, phi_2 - worm.ratio * phi, *worm.in_mesh(*parameters[:3], phi)[0]]

    names = tuple(u["name"] for u in design.description["unknowns"])
    places = [design.value(f"hob_{q}_deg", "placement") for q in ("phase", "theta_A1", "psi_A1", "theta_A2", "psi_A2")]
    pitch = [design.value(f"hob_{q}", "placement") for q in ("u_P_mm", "theta_P_deg", "psi_P_deg")]
    return Twin(
        of=of,
        names=names,
        residual=residual,
        seen=seen,
        start=(*places, *pitch, *(solution[n] for n in names[:5]), wheel_angle),
    )


_FAMILIES = {"cylindrical-worm": _worm, "spherical": _spherical, "face-worm": _face_worm,
             "cylindrical-gears": _cylindrical_gears}  # fmt: skip
