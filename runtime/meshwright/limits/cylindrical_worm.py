"""Limits of the cylindrical worm drive: the wheel's generation as rack and pinion, and what the flanks allow.

Frames: points of contact in the fixed frame of generation (z the hob's axis, x to the wheel). Sections and limit
points in closed form hold at right angles of the cutting axes; undercut and meshing axes hold at any.
"""

from dataclasses import replace

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.limits.branches import branch_points
from meshwright.limits.profile import Profile
from meshwright.limits.results import Axis, ContactPoint, Limits, SurfaceLimit
from meshwright.limits.thickness import tip_thicknesses
from meshwright.limits.zeros import zeros

#: Profiles are searched up to this multiple of the reference radius.
RADIUS_REACH = 2.0

#: How many radii a section profile has unless they are given.
SECTION_POINTS = 11


def limits(drive, request):
    """All limits of the drive; see :class:`~meshwright.limits.results.Limits`."""
    request = _of_right_hand(drive, request)
    if request.section_y is not None:
        need_right_angle(drive)
    hob = Profile(drive, "hob")
    _need_radii(hob, request.radii)
    found = Limits(
        undercut=_undercut(drive, hob, request),
        regression=tuple(_regression(drive)),
        branch_points=branch_points(drive),
        tip_thickness=tip_thicknesses(drive),
        **_axes(drive),
        **_right_angle(drive, hob, request),
    )
    return _seen_in(drive.design.mirror, found)


def _of_right_hand(drive, request):
    """The request as the right-hand drive gets it: the mirror image of a section lies at −y."""
    if request.section_y is None:
        return request
    return replace(request, section_y=drive.design.mirror.sign * request.section_y)


def _seen_in(mirror, found):
    names = ("undercut", "regression", "first_type", "second_type", "axes", "section_profile", "branch_points")
    return replace(found, **{name: tuple(entry.seen_in(mirror) for entry in getattr(found, name)) for name in names})


def _is_right_angle(drive):
    return abs(drive.design.value("cutting_shaft_angle_deg") - np.pi / 2) < 1e-9


def need_right_angle(drive):
    """Raise :class:`~meshwright.base.errors.UsageError` unless hob and blank stand at right angles in cutting."""
    if not _is_right_angle(drive):
        angle = np.degrees(drive.design.value("cutting_shaft_angle_deg"))
        raise UsageError(
            f"section y: the cutting shaft angle is {angle:g}°; sections are planar pairs only at 90°:"
            " set design.cutting_shaft_angle_deg=90, or leave the section out"
        )


def _need_radii(hob, radii):
    """Raise :class:`~meshwright.base.errors.UsageError` for a radius that the hob's profile does not reach."""
    for radius in radii:
        if hob.at_radius(radius) is None:
            least, most = hob.least_radius(), hob.largest_radius()
            raise UsageError(
                f"radius {radius:g} mm: the hob's profile does not reach it; choose one from {least:g} to {most:g} mm"
            )


def _right_angle(drive, hob, request):
    """Limit points and sections, which have closed forms at right angles only."""
    if not _is_right_angle(drive):
        return {}
    return {
        "first_type": _first_type(drive, hob, request.section_y or 0.0),
        "second_type": _second_type(drive, hob, request),
        "section_profile": () if request.section_y is None else _section_profile(drive, hob, request),
    }


def _pitch_radius(drive):
    return drive.design.value("hob_pitch_radius_mm")


def _contact(drive, t, psi):
    """The contact of hob and blank at (t, Ψ)."""
    at = drive.function("generation")(t, psi)
    x, _, z = at["point"]
    radius = np.hypot(at["point"][0], at["point"][1])
    tip = drive.design.value("worm_tip_radius_mm", "blank")
    tool = _pitch_radius(drive) + drive.design.value("hob_tip_addendum_mm", "blank")
    return ContactPoint(
        point=at["point"],
        normal=at["normal"],
        wheel_point=at["point_wheel"],
        angle=float(at["phi_hob"]),
        parameters={"t_hob": float(t), "psi_fixed_hob": float(psi), "psi_hob": float(at["psi_hob"])},
        wheel_radius=float(np.hypot(drive.design.value("cutting_center_distance_mm") - x, z)),
        flags=tuple(flag for flag, limit in (("off_tip", tip), ("off_tool", tool)) if radius > limit),
    )


def _first_type(drive, hob, offset):
    """Limit points of the first type (undercut of the wheel) in the section y = ``offset``."""
    angle, generation = drive.function("section"), drive.function("generation")

    def condition(t):
        return generation(t, angle(t, offset)["psi_fixed_hob"])["first_type"]

    roots = zeros(condition, hob.samples(RADIUS_REACH * _pitch_radius(drive)))
    return tuple(_contact(drive, t, float(angle(t, offset)["psi_fixed_hob"])) for t in roots)


def _second_type(drive, hob, request):
    """Limit points of the second type at the radii asked for: two of each, where there are any."""
    found = []
    for radius in request.radii or (_pitch_radius(drive),):
        t = hob.at_radius(radius)
        if t is None:
            continue
        for psi in drive.function("second_type")(t)["psi_fixed_hob"]:
            if np.isfinite(psi):
                found.append(_contact(drive, t, _principal(psi)))
    return tuple(found)


def _principal(angle):
    """The angle in (−π, π]."""
    return float(np.pi - (np.pi - angle) % (2 * np.pi))


def _section_profile(drive, hob, request):
    found = []
    for radius in request.radii or section_radii(drive, hob, SECTION_POINTS):
        t = hob.at_radius(radius)
        psi = float(drive.function("section")(t, request.section_y)["psi_fixed_hob"]) if t is not None else np.nan
        if np.isfinite(psi):
            found.append(_contact(drive, t, psi))
    if not found:
        raise UsageError(f"section y = {request.section_y:g}: the plane misses the profile; use a value nearer to 0")
    return tuple(found)


def section_radii(drive, profile, count):
    """Radii from root to tip of a profile: the worm's blank, or one module up and 1.2 down where it is not given."""
    pitch, module = (drive.design.value(key) for key in (f"{profile.name}_pitch_radius_mm", "normal_module_mm"))
    root, tip = (drive.design.value(f"worm_{end}_radius_mm", "blank") for end in ("root", "tip"))
    inner = root if np.isfinite(root) else pitch - 1.2 * module
    outer = tip if np.isfinite(tip) else pitch + module
    return np.linspace(max(inner, profile.least_radius() * (1 + 1e-9)), outer, count)


def _axes(drive):
    at = drive.function("meshing_axes")()
    if not at["discriminant"] >= 0.0:
        return {"axes": (), "axes_exist": False}
    axes = [Axis(at[f"point_{k}"], at[f"direction_{k}"] / np.linalg.norm(at[f"direction_{k}"])) for k in (1, 2)]
    axes.sort(key=lambda axis: -axis.inclination)
    return {"axes": tuple(axes), "axes_exist": True}


def _regression(drive):
    """Edges of regression of worm and hob; the hob's only where it differs from the worm."""
    words = drive.design.tables["design"]
    same = words["worm_profile"] == words["hob_profile"] and _pitch_radius(drive) == drive.design.value(
        "worm_pitch_radius_mm"
    )
    for member, name in (("pinion", "worm"), ("hob", "hob")):
        profile = Profile(drive, name)
        if (t := profile.regression) is not None and not (member == "hob" and same):
            point = profile(t)["point"]
            root = drive.design.value("worm_root_radius_mm", "blank")
            yield SurfaceLimit(member, point, {f"t_{name}": t}, on_flank=not np.hypot(*point[:2]) < root)


def _undercut(drive, hob, request):
    """The wheel's undercut line: where its singular function vanishes, along lines Ψ = constant of the flank.

    ``request.grid`` lines, or the points at the axial positions z of the wheel that are asked for.
    """
    flank = drive.flank("wheel")
    samples = hob.samples(RADIUS_REACH * _pitch_radius(drive), 100)

    def line(psi):
        return zeros(lambda t: flank(np.stack([t, np.full_like(t, psi)], axis=1)).regular, samples)

    if request.axial:
        places = _undercut_at(flank, line, np.linspace(*hob.sheet(), 8 * request.grid), request.axial)
    else:
        places = [(t, psi) for psi in np.linspace(*hob.sheet(), request.grid) for t in line(psi)]
    return tuple(_undercut_point(flank, hob, t, psi) for t, psi in places)


def _undercut_at(flank, line, angles, positions):
    """Parameters of the undercut line's points at axial positions z of the wheel."""

    def height(psi):
        roots = line(psi)
        return flank([[roots[0], psi]]).points[0, 2] if roots else np.nan

    def over(values):
        return np.array([height(psi) for psi in np.atleast_1d(values)])

    coarse = over(angles)
    for z in positions:
        with np.errstate(invalid="ignore"):
            near = np.flatnonzero((coarse[:-1] - z) * (coarse[1:] - z) < 0.0)
        for k in near:
            for psi in zeros(lambda q, z=z: over(q) - z, angles[k : k + 2]):
                yield line(psi)[0], psi


def _undercut_point(flank, hob, t, psi):
    at = flank([[t, psi]])
    on_flank = all(not values[0] < 0.0 for values in at.margins.values())
    radius = float(hob.radius(t))
    return SurfaceLimit(
        "wheel", at.points[0], {"t_hob": float(t), "psi_fixed_hob": float(psi)}, on_flank, {"tool_radius_mm": radius}
    )
