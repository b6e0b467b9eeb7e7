"""Designs that the worm tests share."""

from importlib.resources import files

from meshwright.design.design import changed, read

PROFILES = ("ZA", "ZI", "ZN", "ZK", "ZC")

#: What only ground flanks need to know.
GROUND = {
    "ZK": {"grinding_wheel_radius_mm": 200.0},
    "ZC": {"grinding_wheel_radius_mm": 200.0, "profile_arc_radius_mm": 40.0},
}


def plain(worm, hob=None, **changes):
    """Tables of a plain two-thread drive with these flank forms; keyword arguments change or add design keys."""
    tables = {
        "drive": "cylindrical-worm",
        "flank": "right",
        "design": {
            "normal_module_mm": 4.0,
            "worm_threads": 2,
            "wheel_teeth": 41,
            "worm_lead_angle_deg": 11.31,
            "pressure_angle_deg": 20.0,
            "worm_profile": worm,
            "hob_profile": hob or worm,
            **GROUND.get(worm, {}),
            **GROUND.get(hob, {}),
        },
    }
    return changed(tables, {key if key == "flank" else f"design.{key}": value for key, value in changes.items()})


def packaged(name, **changes):
    """Tables of a packaged design with ``table__key`` changed."""
    return changed(read(name), {key.replace("__", "."): value for key, value in changes.items()})


def without_blank(name, folder):
    """Path of a packaged design written to ``folder`` without its table of the blank."""
    text = (files("meshwright") / "designs" / f"{name}.toml").read_text(encoding="utf-8")
    design, _, rest = text.partition("[blank]")
    path = folder / f"{name}-bare.toml"
    path.write_text(design + rest[rest.index("[contact]") :], encoding="utf-8")
    return str(path)


def misaligned(worm, hob, shaft_angle, errors, **changes):
    """One of these with an oversize hob, at a shaft angle in degrees, with errors of assembly."""
    tables = plain(worm, hob, hob_pitch_radius_mm=21.5, shaft_angle_deg=shaft_angle, **changes)
    return changed(tables, {f"misalignment.{key}": value for key, value in errors.items()})
