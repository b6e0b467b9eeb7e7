"""Tooth thickness at the tips: how far a member is from pointed teeth."""

import numpy as np

from meshwright.limits.profile import Profile
from meshwright.limits.results import Thickness
from meshwright.limits.zeros import zeros


def tip_thicknesses(drive):
    """Thickness of worm and wheel at the tips that the design gives; nothing for a tip that it leaves open."""
    return (*_worm(drive), *_wheel(drive))


def _worm(drive):
    """Axial thickness of the thread: axial distance of the threads less the groove, f(ρ) on either side of it."""
    tip = drive.design.value("worm_tip_radius_mm", "blank")
    if not np.isfinite(tip):
        return
    profile = Profile(drive, "worm")
    lead = drive.design.sizes["lead_worm_mm"]
    threads = drive.design.value("worm_threads")

    def thickness(t):
        return lead / threads - 2 * drive.design.flank * profile(t)["axial"]

    if (at_tip := profile.at_radius(tip)) is None:
        return
    pointed = zeros(thickness, profile.samples(2 * drive.design.value("worm_pitch_radius_mm")))
    radius = float(profile.radius(pointed[0])) if pointed else None
    yield Thickness("pinion", tip, float(thickness(at_tip)), radius)


def _wheel(drive):
    """Thickness of the wheel tooth in its middle plane z = 0, along the arc, between its two flanks."""
    blank = [drive.design.value(f"wheel_{end}_radius_mm", "blank") for end in ("tip", "throat")]
    tips = [value for value in blank if np.isfinite(value)]
    if not tips:
        return
    other = drive.with_(flank="left" if drive.design.flank > 0 else "right")
    sides = [_middle_section(side) for side in (drive, other)]
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
    flank, profile = drive.flank("wheel"), Profile(drive, "hob")
    found = []
    for t in profile.samples(1.5 * drive.design.value("hob_pitch_radius_mm"), 80):
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
