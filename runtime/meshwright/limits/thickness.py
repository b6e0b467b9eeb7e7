"""Tooth thickness at the tips: how far a member is from pointed teeth."""

import numpy as np

from meshwright.contact import functions
from meshwright.limits.profile import Profile
from meshwright.limits.rack import sizes
from meshwright.limits.results import Thickness
from meshwright.limits.zeros import zeros


def tip_thicknesses(drive):
    """Thickness of pinion and wheel at the tips that the design gives; nothing for a tip that it leaves open.

    Of drives whose wheel is generated as rack and pinion.
    """
    if not functions.has(drive, "generation"):
        return ()
    have = sizes(drive)
    return (*_pinion(drive, have), *_wheel(drive, have))


def _pinion(drive, have):
    """Axial thickness of the thread: axial distance of the threads less the groove, f(ρ) on either side of it."""
    tip = have["tip_radius_pinion"]
    if not np.isfinite(tip):
        return
    profile = Profile(drive, "pinion")

    def thickness(t):
        return have["axial_pitch_pinion"] - 2 * drive.design.flank * profile(t)["axial"]

    if (at_tip := profile.at_radius(tip)) is None:
        return
    pointed = zeros(thickness, profile.samples(2 * have["reference_radius_pinion"]))
    radius = float(profile.radius(pointed[0])) if pointed else None
    yield Thickness("pinion", tip, float(thickness(at_tip)), radius)


def _wheel(drive, have):
    """Thickness of the wheel tooth in its middle plane z = 0, along the arc, between its two flanks."""
    tips = [have[name] for name in ("tip_radius_wheel", "throat_radius_wheel") if np.isfinite(have[name])]
    if not tips:
        return
    sides = [_middle_section(side) for side in (drive, drive.with_(flank=drive.design.other_flank))]
    if any(side is None for side in sides):
        return
    tip = min(tips)
    reach = np.linspace(max(r[0] for r, _ in sides), min(r[-1] for r, _ in sides), 400)

    def thickness(radius):
        first, second = (np.interp(radius, *side) for side in sides)
        return drive.design.flank * radius * (first - second)

    if not reach[0] <= tip <= reach[-1]:
        return
    pointed = zeros(thickness, reach[reach > 0.5 * tip])
    yield Thickness("wheel", tip, float(thickness(tip)), float(pointed[-1]) if pointed else None)


def _middle_section(drive):
    """Radius and polar angle (N,), from the tooth's middle, of the wheel's flank in its plane z = 0; None if empty."""
    flank, profile = drive.flank("wheel"), Profile(drive, "tool")
    found = []
    for t in profile.samples(1.5 * sizes(drive)["reference_radius_tool"], 80):
        psi = 0.0
        for _ in range(8):
            at = flank([[t, psi]])
            with np.errstate(invalid="ignore", divide="ignore"):
                psi -= at.points[0, 2] / at.tangents[0, 1, 2]
        x, y, z = flank([[t, psi]]).points[0]
        if abs(z) < 1e-9 and abs(psi) < 1.0:
            found.append((np.hypot(x, y), np.arctan2(-y, -x)))
    if len(found) < 2:
        return None
    radius, angle = np.array(sorted(found)).T
    return radius, angle
