"""Dense search of the gap between a ZN worm flank and the wheel flank cut by a ZN hob, without tangency equations.

For every point of a grid on the wheel flank: the wheel angle at which that point, turning with the wheel, lies on the
worm flank. Rigid flanks touch where this angle, less ratio × worm angle, is extreme: largest on the right flank,
smallest on the left. An extreme inside the grid is an interior contact. NumPy, double precision, own formulae.
"""

import math
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Blade:
    """ZN helicoid: apex radius, lead angle, screw parameter, pressure angle, flank sign."""

    r_t: float
    lam: float
    p: float
    alpha: float
    s: int

    def profile(self, t):
        sine = self.s * t * math.sin(self.alpha)
        return self.r_t + t * math.cos(self.alpha), -sine * math.sin(self.lam), sine * math.cos(self.lam)

    def parameter(self, radius):
        """The profile parameter on a radius: root of a quadratic."""
        across = math.sin(self.alpha) * math.sin(self.lam)
        a = math.cos(self.alpha) ** 2 + across**2
        b = self.r_t * math.cos(self.alpha)
        with np.errstate(invalid="ignore"):
            return (-b + np.sqrt(b * b - a * (self.r_t**2 - radius**2))) / a


def blade(radius, lam, alpha, groove, s):
    half = groove * math.sin(lam) / 2
    r_t = math.sqrt(radius**2 - half**2) - groove / (2 * math.tan(alpha))
    return Blade(r_t, lam, radius * math.tan(lam), alpha, s)


@dataclass(frozen=True)
class Extreme:
    """Outcome of the search: transmission error (rad) at the extreme, and whether it lies inside the grid."""

    error: float
    interior: bool


def search(solved, flank, phi, grid=(61, 121)):
    """The extreme over the wheel flank at worm angle ``phi``; ``solved`` is the design as solved, keys and units."""
    height, patch = gap(solved, flank, phi)
    s = 1 if flank == "right" else -1
    t, psi = np.linspace(*patch[0], grid[0]), np.linspace(*patch[1], grid[1])
    values = height(t, psi)
    if not np.isfinite(values).any():
        return Extreme(math.nan, False)
    i, j = np.unravel_index(int(np.nanargmax(values)), values.shape)
    return _climb(height, patch, (t[i], psi[j]), (t[1] - t[0], psi[1] - psi[0]), s)


def _climb(height, patch, centre, cell, s):
    """Follow the rise from a grid point with ever finer windows: a ridge that runs to the edge has no interior top."""
    size = [2 * c for c in cell]
    for _ in range(400):
        axes = [np.linspace(c - w, c + w, 17) for c, w in zip(centre, size, strict=True)]
        values = height(*axes)
        if not np.isfinite(values).all():
            return Extreme(math.nan, False)
        i, j = np.unravel_index(int(np.argmax(values)), values.shape)
        centre = axes[0][i], axes[1][j]
        if any(not low < c < high for c, (low, high) in zip(centre, patch, strict=True)):
            return Extreme(math.nan, False)
        if 0 < i < 16 and 0 < j < 16:
            size = [w / 4 for w in size]
        if size[0] < 1e-5 * cell[0]:
            return Extreme(s * float(values[i, j]), True)
    return Extreme(math.nan, False)


def gap(solved, flank, phi):
    """Height(t, Ψ) of the gap function over the wheel flank, NaN off the regular flank, and the patch to search."""
    d = {
        k: math.radians(v) if k.endswith("_deg") else v
        for k, v in solved["design"].items()
        if v is not None and not isinstance(v, str)
    }
    e = {k: math.radians(v) if k.endswith("_deg") else v for k, v in solved["misalignment"].items()}
    s = 1 if flank == "right" else -1
    groove = math.pi * d["normal_module_mm"] / 2 - 2 * d["pitch_line_shift_mm"] * math.tan(d["pressure_angle_deg"])
    worm = blade(d["worm_pitch_radius_mm"], d["worm_lead_angle_deg"], d["pressure_angle_deg"], groove, s)
    hob = blade(d["hob_pitch_radius_mm"], d["hob_lead_angle_deg"], d["pressure_angle_deg"], groove, s)
    ratio, m_gen = d["worm_threads"] / d["wheel_teeth"], d["hob_threads"] / d["wheel_teeth"]
    pitch_point = groove / (2 * math.sin(d["pressure_angle_deg"]))
    reach = 2.2 * d["normal_module_mm"] / math.cos(d["pressure_angle_deg"])
    regular = _facing(hob, np.array([[pitch_point]]), np.array([[0.0]]), d, m_gen)

    def height(t, psi):
        t, psi = t[:, None], psi[None, :]
        point, _ = wheel_flank(hob, t, psi, d, m_gen)
        good = _facing(hob, t, psi, d, m_gen) * regular > 0
        error = _touching_error(worm, point, phi, ratio, d, e)
        return np.where(good & (_worm_parameter(worm, point, phi, error, ratio, d, e) > 0), s * error, np.nan)

    return height, ((max(pitch_point - reach, 0.0), pitch_point + reach), (-0.4, 0.4))


def _facing(hob, t, psi, d, m_gen):
    """(∂r/∂t × ∂r/∂Ψ)·n of the wheel by central differences: changes sign at an undercut line."""
    h = 1e-5
    _, normal = wheel_flank(hob, t, psi, d, m_gen)
    pairs = [
        (wheel_flank(hob, t + a, psi + b, d, m_gen)[0], wheel_flank(hob, t - a, psi - b, d, m_gen)[0])
        for a, b in ((h, 0), (0, h))
    ]
    along, across = (np.stack([p - q for p, q in zip(*pair, strict=True)], axis=-1) for pair in pairs)
    return np.sum(np.cross(along, across) * np.stack(normal, axis=-1), axis=-1)


def wheel_flank(hob, t, psi, d, m_gen):
    """Explicit wheel flank and its normal, wheel frame, from the meshing equation, linear in the axial coordinate."""
    sigma, a_gen = d["cutting_shaft_angle_deg"], d["cutting_center_distance_mm"]
    px, py, pz = hob.profile(t)
    ca, sa, cl, sl = math.cos(hob.alpha), math.sin(hob.alpha), math.cos(hob.lam), math.sin(hob.lam)
    along = ca, -hob.s * sa * sl, hob.s * sa * cl
    normal = (
        along[1] * hob.p - along[2] * px,
        -along[2] * py - along[0] * hob.p,
        along[0] * px + along[1] * py,
    )
    c, s = np.cos(psi), np.sin(psi)
    x, y = c * px - s * py, s * px + c * py
    n_x, n_y, n_z = c * normal[0] - s * normal[1], s * normal[0] + c * normal[1], normal[2]
    arm = x - a_gen
    z = (
        (hob.p * n_z / m_gen - n_y * math.cos(sigma) * arm + n_z * math.sin(sigma) * arm) / n_x + math.cos(sigma) * y
    ) / math.sin(sigma)
    phi_h = psi - (z - pz) / hob.p

    def to_wheel(a, b, c):
        b, c = math.cos(sigma) * b - math.sin(sigma) * c, math.sin(sigma) * b + math.cos(sigma) * c
        cosine, sine = np.cos(m_gen * phi_h), np.sin(m_gen * phi_h)
        return cosine * a - sine * b, sine * a + cosine * b, c + 0 * a

    return to_wheel(arm, y, z), to_wheel(n_x, n_y, n_z)


def _touching_error(worm, point, phi, ratio, d, e):
    """Wheel angle less ratio × phi at which each wheel point lies on the worm flank: secant iteration."""
    near = np.zeros_like(point[0])
    step = 1e-4 * ratio
    far = near + step
    f_near = _off_worm(worm, point, phi, ratio * phi + near, d, e)
    f_far = _off_worm(worm, point, phi, ratio * phi + far, d, e)
    with np.errstate(invalid="ignore", divide="ignore"):
        for _ in range(12):
            near, far = far, far - f_far * (far - near) / (f_far - f_near)
            f_near, f_far = f_far, _off_worm(worm, point, phi, ratio * phi + far, d, e)
            if not np.nanmax(np.abs(f_far)) > 1e-13:
                break
            stuck = f_far == f_near
            far = np.where(stuck, near, far)
    return np.where(np.isfinite(far), far, near)


def _worm_parameter(worm, point, phi, error, ratio, d, e):
    x, y, _ = _in_fixed_frame(point, ratio * phi + error, d, e)
    return worm.parameter(np.hypot(x, y))


def _off_worm(worm, point, phi, phi_wheel, d, e):
    """Angle about the worm axis from the worm flank to a wheel point at a wheel angle."""
    x, y, z = _in_fixed_frame(point, phi_wheel, d, e)
    px, py, pz = worm.profile(worm.parameter(np.hypot(x, y)))
    psi = (z - pz) / worm.p
    return (np.arctan2(y, x) - np.arctan2(py, px)) - psi - phi


def _in_fixed_frame(point, phi_wheel, d, e):
    x, y, z = point
    c, s = np.cos(phi_wheel), np.sin(phi_wheel)
    x, y, z = c * x + s * y, -s * x + c * y, z + e["axial_mm"]
    v = e["vertical_deg"]
    x, z = math.cos(v) * x + math.sin(v) * z, -math.sin(v) * x + math.cos(v) * z
    a = -(d["shaft_angle_deg"] + e["horizontal_deg"])
    y, z = math.cos(a) * y - math.sin(a) * z, math.sin(a) * y + math.cos(a) * z
    return x + d["center_distance_mm"] + e["center_distance_mm"], y, z
