"""Contact of random misaligned designs against mpmath in 50 digits, written from the machine's kinematics."""

import numpy as np
import pytest
from mpmath import mp

from meshwright import Drive
from meshwright.sensitivity import sensitivity
from tests.bevel.exact import crown_pair, formate_cradle
from tests.certified.test_points import decimals
from tests.independent.bevel import Pair
from tests.independent.chords import jacobian

ARCSEC = np.pi / 648000


def random_design(seed, blade_groups=0):
    """A valid design near a crowned exact one: every setting that the machine has is in use.

    With ``blade_groups`` both members are face-hobbed, their blades near normal to the tooth.
    """
    random = np.random.default_rng(seed)
    flank, formate = ("convex", "concave")[seed % 2], seed % 4 >= 2 and not blade_groups
    crowned = {"lengthwise": random.uniform(3.0, 5.0), "pressure_deg": random.uniform(17.0, 22.0)}
    if formate:
        tables = formate_cradle(flank, offset=random.uniform(5.0, 30.0), **crowned)
    else:
        crowned |= {"profile": random.uniform(0.0005, 0.002), "shaft_deg": random.uniform(80.0, 100.0)}
        tables = crown_pair(flank, blade_groups=blade_groups, **crowned)
    pinion, gear = tables["pinion"], tables["gear"]
    pinion |= {"roll_2c": random.uniform(-0.03, 0.03), "roll_6d": random.uniform(-0.03, 0.03),
               "roll_24e": random.uniform(-0.05, 0.05), "roll_120f": random.uniform(-0.1, 0.1),
               "roll_720g": random.uniform(-0.1, 0.1), "helical_motion_mm_per_rad": random.uniform(-0.2, 0.2),
               "blade_curvature_per_mm": random.uniform(0.0005, 0.002), "blade_reference_mm": 4.0}  # fmt: skip
    pinion["tilt_deg"] = pinion.get("tilt_deg", 0.0) + random.uniform(-0.1, 0.1)
    pinion["swivel_deg"] = pinion.get("swivel_deg", 0.0) + random.uniform(-0.2, 0.2)
    pinion["blank_offset_mm"] = pinion.get("blank_offset_mm", 0.0) + random.uniform(-0.02, 0.02)
    pinion["center_to_back_mm"] = random.uniform(-0.02, 0.02)
    gear |= {"blade_curvature_per_mm": random.uniform(-0.0002, 0.0002), "tilt_deg": random.uniform(-0.05, 0.05),
             "swivel_deg": random.uniform(-90.0, 90.0), "blank_offset_mm": random.uniform(-0.02, 0.02)}  # fmt: skip
    tables["misalignment"] = {
        "offset_mm": random.uniform(-0.03, 0.03), "pinion_axial_mm": random.uniform(-0.03, 0.03),
        "gear_axial_mm": random.uniform(-0.03, 0.03), "shaft_angle_deg": random.uniform(-0.02, 0.02),
    }  # fmt: skip
    return tables


NAMES = ("u_pinion", "theta_pinion", "phi_cradle_pinion", "u_gear", "theta_gear", "phi_cradle_gear")


def exact_contact(tables, found, k, angle):
    """The pair in mpmath and its unknowns at an angle, from the k-th contact found."""
    names = NAMES[:-1] if tables["gear"].get("method") == "formate" else NAMES
    pair = Pair(tables)
    start = [float(found.unknowns[name][k]) for name in names] + [float(found.wheel_angles[k])]
    return pair, pair.solve(start, angle)


def compared(tables):
    """Largest differences (error in arcsec, position in mm, normal) over three angles of a design from those of the
    decimals of its numbers.
    """
    drive = Drive.from_tables(tables)
    angles = drive.design.reference_angle + np.radians([-4.0, 0.0, 4.0])
    found = drive.refined(drive.tca(angles))
    assert set(found.status) == {"converged"}
    with mp.workdps(50):
        worst = np.zeros(3)
        for k, angle in enumerate(angles):
            pair, x = exact_contact(decimals(tables), found, k, angle)
            r, n, _ = pair.pinion.surface(*x[:3])
            r, n = pair.place_pinion(r, n, mp.mpf(angle))
            error = abs(pair.error(x, angle) - mp.mpf(found.error[k])) / mp.mpf(ARCSEC)
            place = max(abs(a - mp.mpf(b)) for a, b in zip(r, found.points[k], strict=True))
            normal = max(abs(a - mp.mpf(b)) for a, b in zip(n, found.normals[k], strict=True))
            worst = np.maximum(worst, [float(error), float(place), float(normal)])
    return worst


@pytest.mark.parametrize("seed", range(4))
def test_a_random_misaligned_design_agrees_with_fifty_digits(seed):
    error, place, normal = compared(random_design(seed))
    assert error < 1e-11
    assert place < 1e-12
    assert normal < 1e-12


@pytest.mark.parametrize(("seed", "blade_groups"), [(4, 5), (5, 13), (6, 17), (7, 11)])
def test_a_random_face_hobbed_design_agrees_with_fifty_digits(seed, blade_groups):
    tables = random_design(seed, blade_groups)
    for member, turn in (("pinion", 1.5), ("gear", -2.5)):  # a blade that is not normal to the tooth
        tables[member]["blade_offset_angle_deg"] += turn
    error, place, normal = compared(tables)
    assert error < 1e-11
    assert place < 1e-12
    assert normal < 1e-12


@pytest.mark.validate
@pytest.mark.parametrize(("seed", "blade_groups"), [(1, 0), (2, 0), (5, 13)])
def test_sensitivities_agree_with_fifty_digits(seed, blade_groups):
    """d(transmission error)/d(every setting, position of the blanks and error of assembly), by the implicit function
    theorem on the machine's kinematics.
    """
    tables = random_design(seed, blade_groups)
    drive = Drive.from_tables(tables)
    angle = float(drive.design.reference_angle)
    seen, found = sensitivity(drive, [angle]), drive.tca([angle])
    factors = {f"{p['table']}.{p['key']}": p["factor"] for p in drive.design.description["parameters"]}
    with mp.workdps(50):
        pair, x = exact_contact(tables, found, 0, angle)
        slopes = {key: exact_slope(tables, pair, x, angle, key) for key in seen.keys}
    assert {"pinion.tilt_deg", "pinion.roll_720g", "misalignment.offset_mm", "gear.swivel_deg"} < slopes.keys()
    exact = np.array([slopes[key] / factors[key] for key in seen.keys])
    np.testing.assert_allclose(seen.error[0], exact, rtol=1e-9, atol=1e-13)


def exact_slope(tables, pair, x, angle, key):
    """d(transmission error)/d(key), rad per unit of the key."""
    table, name = key.split(".")
    step, sides = mp.mpf(10) ** -15, []
    for sign in (1, -1):
        changed = {k: dict(v) if isinstance(v, dict) else v for k, v in tables.items()}
        old = changed.get(table, {}).get(name, 90 if name == "shaft_angle_deg" and table == "design" else 0)
        changed.setdefault(table, {})[name] = mp.mpf(old) + sign * step
        sides.append(Pair(changed).residual(x, mp.mpf(angle)))
    changes = [float((a - b) / (2 * step)) for a, b in zip(*sides, strict=True)]
    return -np.linalg.solve(jacobian(lambda x: pair.residual(x, mp.mpf(angle)), x), changes)[-1]
