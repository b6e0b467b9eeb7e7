"""Flanks, fillets and singular lines of the face worm drive."""

import numpy as np
import pytest

from meshwright import Drive
from tests.face_worm.designs import NAMES, changed

ANGLES = np.linspace(-0.6, 0.6, 7)


@pytest.mark.parametrize("name", NAMES)
def test_fillet_joins_the_flank_without_gap_or_kink(name):
    drive = Drive.load(name)
    root, end = drive.design.sizes["flank_root_mm"], np.radians(drive.design.sizes["fillet_angle_deg"])
    flank = drive.flank("wheel")(np.column_stack([np.full_like(ANGLES, root), ANGLES]))
    fillet = drive.flank("wheel", "fillet")(np.column_stack([np.full_like(ANGLES, end), ANGLES]))
    assert np.max(np.abs(flank.points - fillet.points)) < 1e-13
    assert np.max(np.abs(flank.normals - fillet.normals)) < 1e-14


@pytest.mark.parametrize("name", NAMES)
def test_fillet_ends_level_at_the_depth_of_the_blade(name):
    drive = Drive.load(name)
    axis = np.array([drive.design.value(f"tool_axis_z_{q}", "placement") for q in "xyz"])
    origin = np.array([drive.design.value(f"tool_origin_{q}_mm", "placement") for q in "xyz"])
    bottom = drive.flank("wheel", "fillet")(np.column_stack([np.zeros_like(ANGLES), ANGLES]))
    assert np.allclose((bottom.points - origin) @ axis, -drive.design.value("blade_depth_mm"), rtol=0, atol=1e-13)
    assert np.allclose(bottom.normals, axis, rtol=0, atol=1e-14)
    assert np.all(bottom.regular > 0)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize(("member", "region"), [("wheel", "flank"), ("wheel", "fillet"), ("pinion", "flank")])
def test_tangents_are_derivatives_and_the_normal_is_normal_to_the_tool(name, member, region):
    surface = Drive.load(name).flank(member, region)
    q = np.full((len(ANGLES), len(surface.parameters)), 0.2)
    q[:, 1] = ANGLES
    found, step = surface(q), 1e-6
    for k in range(q.shape[1]):
        shift = step * np.eye(q.shape[1])[k]
        slope = (surface(q + shift).points - surface(q - shift).points) / (2 * step)
        assert np.allclose(slope, found.tangents[:, k], rtol=0, atol=1e-6)
    assert np.max(np.abs(np.einsum("nki,ni->nk", found.tangents[:, :2], found.normals))) < 1e-10
    assert np.allclose(np.linalg.norm(found.normals, axis=1), 1, rtol=0, atol=1e-14)


@pytest.mark.parametrize("name", NAMES)
def test_contact_stays_on_the_regular_part_of_the_worm(name):
    drive = Drive.load(name)
    result = drive.tca(np.radians(np.arange(-400.0, 401.0, 50.0)))
    places = np.column_stack([result.unknowns[u] for u in ("u_worm", "theta_worm", "psi_worm")])
    worm = drive.flank("pinion")(places)
    assert np.all(worm.regular > 0)
    assert np.max(np.abs(worm.conditions[:, 0, 0])) < 1e-10
    assert np.allclose(worm.points, result.body_points["pinion"], rtol=0, atol=1e-11)


@pytest.mark.parametrize("name", NAMES[:2])
@pytest.mark.parametrize("angle", [-200.0, 150.0])
def test_curvatures_against_the_distance_between_the_flanks(name, angle):
    """Second differences of the distance between neighbouring points of worm and gear along the common normal.

    The worm is kept on its implicit equation by Newton in its own parameters; no curvature formula is used.
    """
    drive = changed(name, misalignment={"offset_mm": 0.05, "axial_mm": -0.05, "shaft_angle_deg": 0.02})
    result = drive.tca(np.radians([angle]))
    normal, major = result.normals[0], result.major[0]
    gap = _Gap(drive, result)
    h = 0.02
    for direction, curvature in ((major, result.curvatures[0, 0]), (np.cross(normal, major), result.curvatures[0, 1])):
        sides = [gap(sign * size * direction) for sign in (-1, 1) for size in (h, 2 * h)]
        coarse, fine = sides[1] + sides[3], sides[0] + sides[2]
        second = (16 * fine - coarse) / (12 * h**2)
        assert second == pytest.approx(curvature, rel=2e-4)


class _Gap:
    """Distance between the flanks along the common normal, at an offset in the tangent plane, fixed frame."""

    def __init__(self, drive, result):
        self.drive, self.normal, self.origin = drive, result.normals[0], result.points[0]
        self.angle, self.wheel_angle = result.angles[0], result.wheel_angles[0]
        self.worm_at = np.array([result.unknowns[u][0] for u in ("u_worm", "theta_worm", "psi_worm")])
        self.gear_at = np.array([result.unknowns[u][0] for u in ("u_gear", "theta_gear")])

    def __call__(self, offset):
        foot = self.origin + offset
        return self._height("wheel", self.gear_at, foot) - self._height("pinion", self.worm_at, foot)

    def _height(self, member, start, foot):
        """Height of the flank over ``foot`` along the normal, by Newton on its parameters and the height."""
        flank, q = self.drive.flank(member), np.append(start, 0.0)
        for _ in range(12):
            at = flank([q[:-1]])
            turn, shift = self._motion(member)
            gap = turn @ at.points[0] + shift - foot - q[-1] * self.normal
            rows = [np.append(turn @ at.tangents[0].T, -self.normal[:, None], axis=1)]
            residual = [gap]
            if at.conditions.size:
                rows.append(np.append(at.conditions[0, 0, 1:], 0.0)[None])
                residual.append(at.conditions[0, 0, :1])
            q = q - np.linalg.solve(np.vstack(rows), np.concatenate(residual))
        return q[-1]

    def _motion(self, member):
        d = self.drive.design
        if member == "wheel":
            c, s = np.cos(self.wheel_angle), np.sin(self.wheel_angle)
            return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]), np.zeros(3)
        c, s = np.cos(self.angle), np.sin(self.angle)
        turn = np.array([[0, 0, 1], [0, 1, 0], [-1, 0, 0]]) @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
        g = d.value("shaft_angle_deg", "misalignment")
        tilt = np.array([[np.cos(g), 0, np.sin(g)], [0, 1, 0], [-np.sin(g), 0, np.cos(g)]])
        along = d.value("worm_axial_position_mm") + d.value("axial_mm", "misalignment")
        across = d.value("offset_mm") + d.value("offset_mm", "misalignment")
        return tilt @ turn, tilt @ [along, 0, 0] + [0, across, 0]
