"""What gears on parallel axes have beside others: a transverse section, and backlash as a length."""

import math

import numpy as np

from meshwright.base.library import pointer
from meshwright.base.roots import bracketed
from meshwright.contact.placement import placed
from meshwright.cycle.searched_flank import start_values
from meshwright.cycle.windows import limits_of

#: Axes whose directions differ by less, rad, are parallel.
PARALLEL = 1e-12

#: Steps of Newton's method to the point of a line in a section, and the length of the last one, in natural sizes.
STEPS = 20
LAST_STEP = 1e-12

#: Steps per pitch from the middle of the window to where the section leaves the flanks, found to this angle, rad.
SAMPLES_PER_PITCH = 8
ANGLE_TOLERANCE = 1e-11


def centre_distance(drive):
    """Distance of the axes as assembled, mm; NaN where they are not parallel."""
    (one, at), (other, there) = (axis for axis in placed(drive, [0.0], [0.0]).axes.values())
    if np.linalg.norm(np.cross(one[0], other[0])) > PARALLEL:
        return math.nan
    apart = there[0] - at[0]
    return float(np.linalg.norm(apart - (apart @ one[0]) * one[0]))


def working_radius(drive):
    """Radius of the wheel's working pitch circle, on parallel axes, mm: members that turn in one direction about their
    axes roll on circles one in the other.
    """
    (one, _), (other, _) = placed(drive, [0.0], [0.0]).axes.values()
    return centre_distance(drive) / abs(1.0 - float(one[0] @ other[0]) * drive.ratio)


def backlash_lengths(mesh, backlash):
    """Backlash (rad of the wheel) on the working pitch circles and along the normal, mm; NaN off parallel axes."""
    if not math.isfinite(centre_distance(mesh.drive)) or mesh.contact is None:
        return math.nan, math.nan
    lever = abs(float(mesh.contact.levers([mesh.middle])[0]))
    return backlash * working_radius(mesh.drive), backlash * lever


def transverse_contact_ratio(mesh):
    """Pitches over which a transverse section of a pair touches, the one in the middle of the pinion's face; NaN where
    flanks do not touch along lines or axes are not parallel.
    """
    window, drive = mesh.window, mesh.drive
    if window.status != "line_contact" or not window.complete or math.isnan(centre_distance(drive)):
        return math.nan
    limits, middle = [limit.index for limit in limits_of(drive) if limit.reason != "face"], mesh.middle

    def depth(angle):
        return _depth(drive, angle, limits)

    ends = [_end(depth, middle, sign * drive.pitch() / SAMPLES_PER_PITCH) for sign in (-1.0, 1.0)]
    return (ends[1] - ends[0]) / drive.pitch()


def _end(depth, inside, step):
    if not depth(inside) >= 0.0:
        return math.nan
    while (beyond := depth(inside + step)) >= 0.0:
        inside += step
    return math.nan if math.isnan(beyond) else float(bracketed(depth, inside, inside + step, ANGLE_TOLERANCE))


def _depth(drive, angle, limits):
    """How deep inside the limits the point of the line in the section lies, mm."""
    body, model, state = drive.design.description["bodies"][0], drive.model, drive.state(angle)
    flank, x, scale = drive.flank(body["name"]), start_values(drive, [angle])[0], np.empty(drive.model.nx)
    model.scale(pointer(state), pointer(scale))
    residual, jacobian = np.empty(model.nx), np.empty((model.nx, model.nx))
    for _ in range(STEPS):
        model.eval(pointer(state), pointer(x), pointer(residual), pointer(jacobian))
        found, row = flank(x[body["unknowns"]]), np.zeros(model.nx)
        row[body["unknowns"]] = found.tangents[0, :, 2]
        equations = np.vstack([jacobian, row]) * scale
        step = np.linalg.lstsq(equations, np.append(residual, found.points[0, 2]), rcond=None)[0]
        x -= step * scale
        if np.abs(step).max() < LAST_STEP:
            break
    observed = np.empty(model.no)
    model.observe(pointer(state), pointer(x), pointer(observed))
    return float(np.nanmin(observed[limits]))
