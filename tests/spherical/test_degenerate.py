"""Spherical pairs that touch along a line, interfere, or cannot be made are reported as such."""

import math

import pytest

from meshwright import DesignError
from tests.quick import quick


def test_equal_spheres_touch_along_a_line(pair):
    result = pair("convex", "concave", wheel_sphere_radius_mm=72.0).tca([-0.05, 0.0, 0.05])
    assert result.status == ("line_contact",) * 3
    assert result.error == pytest.approx([0, 0, 0], abs=1e-14)


def test_spur_gears_touch_along_a_line(pair):
    result = pair("spur", "spur", misalignment={"center_distance_mm": 0.2}).tca([0.0, 0.05])
    assert result.status == ("line_contact",) * 2
    working = math.acos(216 * math.cos(math.radians(20)) / 216.2)
    offset = -1.5 * (math.tan(working) - working - math.tan(math.radians(20)) + math.radians(20))
    assert result.error == pytest.approx([offset] * 2, abs=1e-13)


def test_misaligned_spur_gears_touch_on_an_edge(pair):
    result = pair("spur", "spur", misalignment={"vertical_deg": 0.5}).tca([0.0])
    assert result.status == ("edge_contact",)


#: The forms of a pair and the radii of their spheres.
WAISTS = (
    (("convex", "concave"), (144.0, 72.0)), (("concave", "concave"), (72.0, 144.0)),
    (("concave", "convex"), (72.0, 144.0)),
)  # fmt: skip


@pytest.mark.parametrize(("forms", "radii"), quick(WAISTS, WAISTS[0], WAISTS[2]))
def test_a_waist_smaller_than_the_barrel_in_it_interferes(pair, forms, radii):
    result = pair(*forms, pinion_sphere_radius_mm=radii[0], wheel_sphere_radius_mm=radii[1]).tca([0.0])
    assert result.status == ("converged",)
    assert result.flags == (("interference",),)
    assert not result.complete


def test_a_centre_distance_below_the_base_circles_has_no_contact(pair):
    result = pair("convex", "spur", misalignment={"center_distance_mm": -14.0}).tca([0.0])
    assert result.status == ("no_contact",)


def test_contact_off_the_face_is_flagged(pair):
    result = pair("convex", "concave", misalignment={"horizontal_deg": 1.5}).tca([0.0])
    assert result.status == ("converged",)
    assert "off_face" in result.flags[0]


@pytest.mark.parametrize(
    ("changes", "key"),
    [
        ({"pinion_sphere_radius_mm": 4.0}, "pinion_sphere_radius_mm"),
        ({"face_width_mm": 140.0}, "pinion_sphere_radius_mm"),
        ({"pinion_form": "barrel"}, "pinion_form"),
        ({"wheel_form": "spur", "wheel_sphere_radius_mm": 144.0}, "wheel_sphere_radius_mm"),
        ({"pinion_teeth": 1, "edge_offset_mm": 4.0}, "edge_offset_mm"),
        ({"module_mm": 0.0}, "module_mm"),
        ({"pressure_angle_deg": 90.0}, "pressure_angle_deg"),
    ],
)
def test_impossible_designs_name_their_key(pair, changes, key):
    with pytest.raises(DesignError) as error:
        pair("convex", "concave", **changes)
    assert key in str(error.value)


def test_a_sphere_radius_is_needed_for_a_curved_gear(pair):
    with pytest.raises(DesignError, match="wheel_sphere_radius_mm.*cannot be made without it"):
        pair("convex", "spur").with_(design={"wheel_form": "convex"})


@pytest.mark.parametrize(("error", "reached"), [(5.0, True), (7.5, True), (8.0, False), (50.0, False)])
def test_teeth_that_reach_each_other_nowhere_have_no_contact(pair, error, reached):
    """The path of contact, along the line of action, runs from the wheel's tip circle to the pinion's."""
    drive = pair("convex", "convex", misalignment={"center_distance_mm": error})
    sizes, distance = drive.design.sizes, 216.0 + error
    inclination = math.acos(216.0 * math.cos(math.radians(20.0)) / distance)
    length = -distance * math.sin(inclination)
    for name in ("pinion", "wheel"):
        length += math.sqrt(sizes[f"{name}_tip_radius_mm"] ** 2 - sizes[f"{name}_base_radius_mm"] ** 2)
    assert (length > 0.0) == reached
    result, ratio = drive.tca([-0.3, 0.0, 0.04, 0.3]), drive.contact_ratio()
    if reached:
        assert set(result.status) == {"converged"} and "off_tip" in result.flags[0]
        assert ratio.begin.exists and ratio.end.exists
        assert ratio.contact_ratio == pytest.approx(length / (math.pi * 4.0 * math.cos(math.radians(20.0))), abs=1e-6)
    else:
        assert set(result.status) == {"no_contact"} and not result.complete
        assert ratio.status == "no_contact" and not ratio.begin.exists and not ratio.end.exists
