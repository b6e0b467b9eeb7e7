"""What a cylindrical worm drive offers beside its contact: generation of the wheel, limit points, meshing axes."""

from derive.drives import rack_and_pinion as rp
from derive.language import vectors as v
from derive.language.functions import Function, Result
from derive.language.origin import joined
from derive.language.symbols import Quantity, rotation_angle

#: The rack's equation of meshing is the one in space.
MESHING = "rack-and-pinion/rack-form"


def generation_functions(worm, hob, rack, wheel, psi, recovered, sizes):
    """Functions of the two tools, and of the generation of ``wheel`` by the hob as a ``rack`` at rack angle ``psi``.

    ``sizes`` are results by name: what limits and sections need to know of worm, hob and blank.
    """
    t, _ = rack.flank.parameters
    return (
        *(_profile(*named) for named in (("pinion", "worm", worm), ("tool", "hob", hob))),
        *(_profile_range(*named) for named in (("pinion", "worm", worm), ("tool", "hob", hob))),
        _generation(rack, wheel, t, psi, recovered),
        _section(rack, t),
        _tool_point(rack, t),
        _second_type(rack, t),
        _axes(rack),
        Function(
            "rack_sizes",
            "sizes of pinion, tool and their generation",
            (),
            tuple(Result(name, (value,), unit) for name, (value, unit) in sizes.items()),
        ),
        _undercut_place(hob, t, psi),
    )


def _undercut_place(hob, t, psi):
    x, y, _ = hob.flank.point
    return Function(
        "undercut_place_wheel",
        "distance from the axis of the tool of the point that cuts",
        (t, psi),
        (Result("tool_radius", (v.radius(x, y),), "mm", "hob"),),
        hob.flank.steps,
    )


def _profile(role, name, tool):
    flank = tool.flank
    t = tool.parameter
    x, y, z = flank.point
    growth = flank.definitions.derivative(x**2 + y**2, t)
    axial = z - tool.screw_parameter * v.arc(y, x)
    return Function(
        f"profile_{role}",
        f"profile of the {name} flank in its section frame; growth of the squared radius along it; axial section",
        (t,),
        (
            Result("point", flank.point, "mm", name),
            Result("normal", v.unit(flank.normal), "", name),
            Result("growth", (growth,)),
            Result("axial", (axial,), "mm", name),
        ),
        flank.steps,
    )


def _profile_range(role, name, tool):
    results = {"pitch_point": tool.pitch_point, "scale": tool.scale}
    if tool.lower_end is not None:
        results["lower_end"] = tool.lower_end
    unit = tool.parameter.unit
    return Function(
        f"profile_range_{role}",
        f"profile parameter of the {name}: pitch point, natural step, and the lower end where it is not an edge of"
        " regression",
        (),
        tuple(Result(key, (value,), unit, name) for key, value in results.items()),
    )


def _generation(rack, wheel, t, psi, recovered):
    """Contact of hob and blank while the wheel is cut: the rack form, explicit in (t, Ψ)."""
    turn, _ = recovered
    placed = rp.placed_in_generation(rack, psi, turn)
    return Function(
        "generation",
        "contact of hob and blank, fixed frame of cutting; first_type is zero at limit points of the first type",
        (t, psi),
        (
            Result("point", placed.body_point, "mm", "gen"),
            Result("normal", v.unit(placed.body_normal), "", "gen"),
            *(Result(str(symbol), (symbol,), symbol.unit, symbol.frame) for symbol in recovered),
            Result("point_wheel", wheel.body_point, "mm", "wheel"),
            Result("first_type", (rp.first_type(rack, placed.body_point, (t, psi)),)),
        ),
        joined(wheel.rests_on, (MESHING,)),
    )


def _section(rack, t):
    offset = Quantity("section_y", "mm", "offset of the section y = C", "gen")
    return Function(
        "section",
        "rack angle at which the profile point lies in the section y = C, on the wheel's side",
        (t, offset),
        (Result("psi_fixed_hob", (rp.section_angle(rack, offset),), "rad", "gen"),),
        rack.flank.steps,
    )


def _tool_point(rack, t):
    turn = rotation_angle("psi_given", "screw angle of a given point of the hob flank", "hob")
    return Function(
        "tool_point",
        "the two rack angles at which a given point of the hob flank touches the wheel; right angles only",
        (t, turn),
        (Result("psi_fixed_hob", rp.contacts_of_worm_point(rack, turn), "rad", "gen"),),
        joined(rack.flank.rests_on, (MESHING, "derivation/both-turns")),
    )


def _second_type(rack, t):
    return Function(
        "second_type",
        "the two rack angles of the limit points of the second type; right angles only",
        (t,),
        (Result("psi_fixed_hob", rp.second_type_angles(rack), "rad", "gen"),),
        joined(rack.flank.rests_on, ("rack-and-pinion/eq-5", "derivation/both-turns")),
    )


def _axes(rack):
    discriminant, axes = rp.meshing_axes(rack)
    return Function(
        "meshing_axes",
        "the two lines that every normal of contact in cutting meets; not a number where there is none",
        (),
        (
            Result("discriminant", (discriminant,)),
            *(
                result
                for k, (point, direction) in enumerate(axes, 1)
                for result in (Result(f"point_{k}", point, "mm", "gen"), Result(f"direction_{k}", direction, "", "gen"))
            ),
        ),
        tuple(f"cylindrical_worm/{key}" for key in ("twist", "axis", "axis-quadratic")),
    )
