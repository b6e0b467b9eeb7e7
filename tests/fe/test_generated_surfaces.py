"""Flank and fillet of the generated drives against the surfaces written out by hand."""

from dataclasses import replace

import numpy as np
import pytest
from spherical_gear import SphericalGear

from meshwright import Drive

GEARS = {
    ("concave", "pinion"): SphericalGear(33, 1, 66.0),
    ("concave", "wheel"): SphericalGear(47, -1, 94.0),
    ("convex", "wheel"): SphericalGear(47, 1, 94.0),
    ("spur", "wheel"): SphericalGear(47, 0, 94.0),
}


@pytest.mark.parametrize("flank", ["left", "right"])
@pytest.mark.parametrize(("mate", "member"), list(GEARS))
def test_flank_and_fillet(mate, member, flank):
    """Points and normals of both regions; the fillet is regular all over."""
    drive = Drive.load(f"spherical-table-4-4-{mate}").with_(flank=flank)
    gear = replace(GEARS[mate, member], flank=1 if flank == "left" else -1)
    face = np.linspace(-0.1, 0.1, 7) * (1.0 if gear.sigma else 94.0)
    # The product's rounding begins at the end of the edge, X = -a; that fixes the depth of the rack's tip.
    gear = replace(gear, dedendum=1.0 + gear.tool_tip * (1.0 - np.sin(gear.alpha)))
    rounding = np.linspace(0.0, np.pi / 2 - gear.alpha, 7)
    edge = np.linspace(0.0, 8.0, 7)
    fillet = drive.flank(member, "fillet")(np.stack([rounding, face], axis=1))
    flanks = drive.flank(member)(np.stack([edge, face], axis=1))
    by_hand = (
        gear.fillet_surface(gear.alpha + rounding, face),
        gear.flank_surface(edge * np.cos(gear.alpha) - 4.0, face),
    )
    for generated, (points, normals) in zip((fillet, flanks), by_hand, strict=True):
        assert np.abs(generated.points - points).max() < 1e-12
        assert np.abs(generated.normals - normals).max() < 1e-13
    assert np.all(fillet.regular > 0.0)
