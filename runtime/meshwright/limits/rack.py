"""Generation of a wheel by a helicoid as rack and pinion: regression, limit points, sections, meshing axes, undercut.

Frames: points of contact in the fixed frame of generation (z the tool's axis, x to the wheel). Sections and limit
points in closed form hold at right angles of the cutting axes; meshing axes hold at any. Applies to every drive that
offers the functions named in ``derive.language.functions``.
"""

from dataclasses import replace

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.contact import functions
from meshwright.limits.profile import Profile
from meshwright.limits.results import Axis, ContactPoint, SurfaceLimit
from meshwright.limits.zeros import zeros

#: Profiles are searched up to this multiple of the reference radius.
RADIUS_REACH = 2.0

#: How many radii a section profile has unless they are given.
SECTION_POINTS = 11


def none(request):
    """What a drive without such a generation has of these limits; raises an error for a request that needs it."""
    if request.section_y is not None or request.radii:
        option = "--section-y-mm" if request.section_y is not None else "--radius-mm"
        raise UsageError(f"{option}: no member of this drive is generated as rack and pinion; leave it out")
    return {}


def generation_limits(drive, request):
    """Limits of the generation by name, of the right-hand drive."""
    request = _of_right_hand(drive, request)
    if request.section_y is not None:
        need_right_angle(drive)
    tool = Profile(drive, "tool")
    _need_radii(tool, request.radii)
    return {"regression": tuple(_regression(drive)), **_axes(drive), **_right_angle(drive, tool, request)}


def generation_range(drive):
    """Where undercut of the wheel is sought: the tool's whole profile on lines Ψ = constant over the regular sheet."""
    tool = Profile(drive, "tool")
    samples = tool.samples(RADIUS_REACH * sizes(drive)["reference_radius_tool"])
    along = dict(zip(("along_first", "along_last"), tool.sheet(), strict=True))
    return {"first": samples[0], "middle": tool.pitch_point, "last": samples[-1], **along}


def _of_right_hand(drive, request):
    """The request as the right-hand drive gets it: the mirror image of a section lies at −y."""
    if request.section_y is None:
        return request
    return replace(request, section_y=drive.design.mirror.sign * request.section_y)


def sizes(drive):
    """Results of the drive's function ``rack_sizes`` as numbers by name."""
    return {name: float(value) for name, value in drive.function("rack_sizes")().items()}


def is_right_angle(drive):
    """Whether tool and blank stand at right angles in cutting."""
    return abs(sizes(drive)["cutting_angle"] - np.pi / 2) < 1e-9


def need_right_angle(drive):
    """Raise :class:`~meshwright.base.errors.UsageError` unless tool and blank stand at right angles in cutting."""
    if not functions.has(drive, "generation"):
        raise UsageError("section y: no member of this drive is generated as rack and pinion; leave the section out")
    if not is_right_angle(drive):
        angle = np.degrees(sizes(drive)["cutting_angle"])
        raise UsageError(
            f"section y: the cutting shaft angle is {angle:g}°; sections are planar pairs only at 90°:"
            " set it to 90°, or leave the section out"
        )


def _need_radii(tool, radii):
    """Raise :class:`~meshwright.base.errors.UsageError` for a radius that the tool's profile does not reach."""
    for radius in radii:
        if tool.at_radius(radius) is None:
            least, most = tool.least_radius(), tool.largest_radius()
            raise UsageError(
                f"radius {radius:g} mm: the {tool.name}'s profile does not reach it; choose one from {least:g} to"
                f" {most:g} mm"
            )


def _right_angle(drive, tool, request):
    """Limit points and sections, which have closed forms at right angles only."""
    if not is_right_angle(drive):
        return {}
    return {
        "first_type": _first_type(drive, tool, request.section_y or 0.0),
        "second_type": _second_type(drive, tool, request),
        "section_profile": () if request.section_y is None else _section_profile(drive, tool, request),
    }


def _contact(drive, t, psi):
    """The contact of tool and blank at the profile parameter t and the rack angle Ψ."""
    function = drive.function("generation")
    at, have = function(t, psi), sizes(drive)
    x, _, z = at["point"]
    radius = np.hypot(at["point"][0], at["point"][1])
    turn, own = function.recovered
    limits = (("off_tip", have["tip_radius_pinion"]), ("off_tool", have["end_radius_tool"]))
    return ContactPoint(
        point=at["point"],
        normal=at["normal"],
        wheel_point=at["point_wheel"],
        angle=float(at[own]),
        parameters=dict(zip((*function.arguments, turn), (float(t), float(psi), float(at[turn])), strict=True)),
        wheel_radius=float(np.hypot(have["cutting_distance"] - x, z)),
        body=Profile(drive, "pinion").name,
        flags=tuple(flag for flag, limit in limits if radius > limit),
    )


def _first_type(drive, tool, offset):
    """Limit points of the first type (undercut of the wheel) in the section y = ``offset``."""
    rack_angle, generation = _section_angle(drive), drive.function("generation")

    def condition(t):
        return generation(t, rack_angle(t, offset))["first_type"]

    roots = zeros(condition, tool.samples(RADIUS_REACH * sizes(drive)["reference_radius_tool"]))
    return tuple(_contact(drive, t, float(rack_angle(t, offset))) for t in roots)


def _section_angle(drive):
    """The rack angle Ψ of a profile point in a section y, as a function (t, y)."""
    function = drive.function("section")
    (name,) = function.results
    return lambda t, offset: function(t, offset)[name]


def _second_type(drive, tool, request):
    """Limit points of the second type at the radii asked for: two of each, where there are any."""
    found = []
    for radius in request.radii or (sizes(drive)["reference_radius_tool"],):
        t = tool.at_radius(radius)
        if t is None:
            continue
        (angles,) = drive.function("second_type")(t).values()
        for psi in angles:
            if np.isfinite(psi):
                found.append(_contact(drive, t, _principal(psi)))
    return tuple(found)


def _principal(angle):
    """The angle in (−π, π]."""
    return float(np.pi - (np.pi - angle) % (2 * np.pi))


def _section_profile(drive, tool, request):
    found = []
    for radius in request.radii or section_radii(drive, tool, SECTION_POINTS):
        t = tool.at_radius(radius)
        psi = float(_section_angle(drive)(t, request.section_y)) if t is not None else np.nan
        if np.isfinite(psi):
            found.append(_contact(drive, t, psi))
    if not found:
        raise UsageError(f"section y = {request.section_y:g}: the plane misses the profile; use a value nearer to 0")
    return tuple(found)


def section_radii(drive, profile, count):
    """Radii from root to tip of a profile: the pinion's blank, or one module up and 1.2 down where it is not given."""
    have = sizes(drive)
    pitch, module = have[f"reference_radius_{profile.role}"], have["module"]
    root, tip = have["root_radius_pinion"], have["tip_radius_pinion"]
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
    """Edges of regression of pinion and tool; the tool's only where it differs from the pinion."""
    have = sizes(drive)
    same = have["same_profile"] and have["oversize"] == 0.0
    for role in ("pinion", "tool"):
        profile = Profile(drive, role)
        if (t := profile.regression) is not None and not (role == "tool" and same):
            point = profile(t)["point"]
            member = role if role == "pinion" else profile.name
            on_flank = not np.hypot(*point[:2]) < have["root_radius_pinion"]
            yield SurfaceLimit(member, point, {profile.parameter: t}, on_flank=on_flank)
