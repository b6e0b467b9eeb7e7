"""Which equations of the record each generated function rests on.

The table names verdicts by family; the prove stage refuses a name that the record does not hold or has not proved.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypedDict

from derive.audit.check import root_of

#: Rotations and constant frames are in every function.
COMMON = ("conventions/rotations", "conventions/frames", "conventions/sums")

#: Worm flanks by ISO 10828 letter.
PROFILES = {
    "ZN": ("helicoids/zn-width", "helicoids/zn-straight"),
    "ZA": ("helicoids/za-normal",),
    "ZI": ("helicoids/zi-normal",),
    "ZK": ("helicoids/zk-normal", "zk-zn/eq-4"),
    "ZC": ("helicoids/zc-normal", "helicoids/zc-limit"),
}
HELICOID = ("helicoids/helicoid", "helicoids/normal")
HOBBED = tuple(f"cylindrical_worm/{key}" for key in ("meshing", "normal", "sum-angle", "explicit", "linear"))
SWEPT = tuple(f"spherical_gears/{key}" for key in ("half-angle", "normal", "meshing", "explicit", "tangent"))
ENVELOPED = ("face-worm/eq-10", "face_worm/blade-normal")


class Provenance(TypedDict):
    """What a generated file says of its origin."""

    root_hash: str
    equations: list[str]
    equations_of: dict[str, list[str]]


def provenance(objects: Mapping[str, dict], family: str, variant: dict[str, str]) -> Provenance:
    """Root hash and equation ids of a drive, by function name without the drive's prefix.

    ``objects`` are those of the record by their hash, just proved or read from where it was written.
    """
    functions = {name: list(dict.fromkeys(COMMON + keys)) for name, keys in _functions(family, variant).items()}
    used = sorted({key for keys in functions.values() for key in keys})
    _require_proved(objects, used)
    return {"root_hash": root_of(objects), "equations": used, "equations_of": functions}


def _functions(family: str, variant: dict[str, str]) -> dict[str, tuple[str, ...]]:
    match family:
        case "cylindrical-worm":
            worm = HELICOID + PROFILES[variant["worm_profile"]]
            wheel = HELICOID + PROFILES[variant["hob_profile"]] + HOBBED
            mesh = (*worm, *wheel, "conventions/wheel-axis", "cylindrical_worm/contact")
            return {
                "flank_pinion": worm,
                "flank_wheel": wheel,
                "eval": mesh,
                "step": mesh,
                "observe": (*mesh, "cylindrical_worm/undercut"),
            }
        case "spherical":
            mesh = (*SWEPT, "cylindrical_worm/contact")
            return {
                "flank_pinion": SWEPT,
                "flank_wheel": SWEPT,
                "eval": mesh,
                "step": mesh,
                "observe": (*mesh, "spherical_gears/undercut", "spherical_gears/moment"),
            }
        case "face-worm":
            gear = ("face_worm/cone-normal",)
            mesh = (*ENVELOPED, *gear, "cylindrical_worm/contact")
            fillet = ("face_worm/fillet-join", "face_worm/fillet-tangent")
            return {
                "flank_pinion": ENVELOPED,
                "flank_wheel": gear,
                "fillet_wheel": fillet,
                "eval": mesh,
                "step": mesh,
                "observe": mesh,
            }
    raise KeyError(f"no table of equations for the family {family!r}; add one here")


def _require_proved(objects: Mapping[str, dict], names: list[str]) -> None:
    verdicts = {item["id"]: item for item in objects.values() if item["object"] == "verdict"}
    for name in names:
        if name not in verdicts or not _holds(objects, verdicts[name]):
            raise ValueError(f"{name} is not a proved statement of the record")


def _holds(objects: Mapping[str, dict], verdict: dict) -> bool:
    """Proved, or ambiguous with a proved reading (damaged print)."""
    return verdict["status"] in ("proved", "proved_with_correction") or any(
        reading["parts"] and all(objects[part["certificate"]]["outcome"] == "proved" for part in reading["parts"])
        for reading in verdict["readings"]
    )
