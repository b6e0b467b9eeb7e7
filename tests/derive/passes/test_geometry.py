"""What is emitted beside the contact: placements, axes, lever arms, curvatures, derivatives along a direction."""

import mpmath
import numpy as np
import pytest

from derive import drives
from derive.passes import sample
from derive.passes.schedule import schedule
from meshwright import Drive
from meshwright.base.library import pointer
from meshwright.contact.placement import inverse, placed, placements

FAMILIES = ("recess-action-full", "zk-zn-45", "face-worm-conical-concave", "spherical-table-3-1-convex")
MISALIGNED = {
    "recess-action-full": {"center_distance_mm": 0.1, "horizontal_deg": 0.1, "vertical_deg": 0.05},
    "face-worm-conical-concave": {"axial_mm": 0.05, "offset_mm": -0.02},
    "spherical-table-3-1-convex": {"center_distance_mm": 0.05, "horizontal_deg": 0.02, "vertical_deg": 0.1},
}
ANGLES = np.radians([-7.0, 2.0, 11.0])


@pytest.fixture(scope="module", params=[*FAMILIES, *(f"{name}, misaligned" for name in MISALIGNED)])
def drive(request):
    name, _, errors = request.param.partition(", ")
    return Drive.load(name).with_(misalignment=MISALIGNED[name]) if errors else Drive.load(name)


def _moved(matrices, points):
    return np.einsum("nij,nj->ni", matrices[:, :3, :3], points) + matrices[:, :3, 3]


def test_a_placement_takes_the_contact_point_of_each_body_to_the_one_point_where_they_touch(drive):
    contact, stand = drive.tca(ANGLES), placements(drive, ANGLES)
    for name in ("pinion", "wheel"):
        assert np.allclose(_moved(stand.matrices[name], contact.body_points[name]), contact.points, rtol=0, atol=1e-11)
        rotation = stand.matrices[name][:, :3, :3]
        assert np.allclose(rotation @ np.swapaxes(rotation, 1, 2), np.eye(3), atol=1e-14)


def test_each_body_turns_by_its_own_angle_about_its_own_axis(drive):
    """Rodrigues' formula about the emitted axis takes one placement into another."""
    before, after = placed(drive, [0.3], [0.1]), placed(drive, [1.0], [0.6])
    for name, turned in (("pinion", 0.7), ("wheel", 0.5)):
        (direction,), (point,) = before.axes[name]
        cross = np.cross(direction, np.eye(3)).T
        rotation = np.eye(3) + np.sin(turned) * cross + (1.0 - np.cos(turned)) * cross @ cross
        motion = (after.matrices[name] @ inverse(before.matrices[name]))[0]
        assert np.allclose(motion[:3, :3], rotation, atol=1e-14)
        assert np.allclose(motion[:3, :3] @ point + motion[:3, 3], point, atol=1e-11)


def test_the_law_of_gearing_gives_the_slope_of_the_transmission_error(drive):
    """d(wheel angle)/d(pinion angle) is the quotient of the lever arms n·(d × (r − o))."""
    contact, step = drive.tca(ANGLES), 1e-3
    ahead, behind, twice, back = (drive.tca(ANGLES + h).error for h in (step, -step, 2 * step, -2 * step))
    slope = (8.0 * (ahead - behind) - (twice - back)) / (12.0 * step)
    assert np.allclose(contact.instantaneous_ratio - drive.ratio, slope, rtol=0, atol=1e-10)
    axes = placements(drive, ANGLES).axes
    for name in ("pinion", "wheel"):
        direction, point = axes[name]
        moved = np.cross(direction, contact.points - point)
        assert np.allclose(contact.lever_arms[name], np.sum(moved * contact.normals, axis=1), rtol=1e-12)


def test_the_gap_bends_as_both_flanks_together(drive):
    """The trace of a second fundamental form does not depend on the basis: mean curvatures add up."""
    contact = drive.tca(ANGLES)
    both = sum(
        drive.flank(b["name"]).curvature(contact.solutions[:, b["unknowns"]]).principal.sum(axis=1)
        for b in drive.design.description["bodies"]
    )
    assert np.allclose(contact.curvatures.sum(axis=1), -both, rtol=1e-11)


def test_an_involute_spur_tooth_has_the_radius_of_curvature_of_its_line_of_action():
    drive = Drive.load("spherical-table-3-1-spur")
    flank = drive.flank("wheel")
    found = drive.tca([0.0]).solutions[0][drive.design.description["bodies"][1]["unknowns"]]
    q = found + np.array([[0.0, 0.0], [0.3, 0.0], [-0.4, 0.2]])
    at, bent = flank(q), flank.curvature(q)
    radius = np.hypot(at.points[:, 0], at.points[:, 1])
    base = drive.design.value("wheel_teeth") * drive.design.value("module_mm") / 2
    base *= np.cos(drive.design.value("pressure_angle_deg"))
    assert np.allclose(bent.principal[:, 0], -1.0 / np.sqrt(radius**2 - base**2), rtol=1e-12)
    assert np.allclose(bent.principal[:, 1], 0.0, atol=1e-14)


def test_an_involute_helicoid_is_developable_and_curved_as_its_base_cylinder_says():
    """Across its generator the radius of curvature is √(r² − r_b²)/cos β_b; sin β_b is the normal's axial part."""
    drive = Drive.load("plain-zi")
    flank, sizes = drive.flank("pinion"), drive.design.sizes
    q = drive.tca(ANGLES).solutions[:, drive.design.description["bodies"][0]["unknowns"]]
    at, bent = flank(q), flank.curvature(q)
    axial, lead = at.normals[:, 2], sizes["screw_parameter_worm_mm_per_rad"]
    base = lead * np.abs(axial) / np.sqrt(1.0 - axial**2)
    radius = np.hypot(at.points[:, 0], at.points[:, 1])
    assert np.ptp(base) < 1e-11
    assert np.allclose(bent.principal[:, 1], 0.0, atol=1e-13)
    across = -np.sqrt(1.0 - axial**2) / np.sqrt(radius**2 - base**2)
    assert np.allclose(bent.principal[:, 0], across, rtol=1e-10)


@pytest.mark.parametrize("name", ["cylindrical_worm_zk_zn", "face_worm", "spherical_concave_convex"])
def test_derivatives_along_a_direction_are_those_of_the_residual(name):
    """Against differences of the residual in 60 digits: first and second, the input angle included."""
    plan = schedule(drives.catalogue([name])[name]())
    rng, symbols = np.random.default_rng(7), [*plan.unknowns, plan.drive.instant]
    with mpmath.workdps(60):
        at = dict(plan.sample) | {plan.drive.instant: mpmath.mpf(plan.drive.sample_angle) + mpmath.mpf("0.01")}
        direction = [mpmath.mpf(float(v)) for v in rng.normal(size=len(symbols))]
        residual, step = plan.tape.evaluator(plan.residual, mpmath), mpmath.mpf(10) ** -15

        def moved(share):
            return residual(at | {s: at[s] + share * step * d for s, d in zip(symbols, direction, strict=True)})

        behind, here, ahead = moved(-1), moved(0), moved(1)
        first = [(b - a) / (2 * step) for a, b in zip(behind, ahead, strict=True)]
        second = [(a - 2 * h + b) / step**2 for a, h, b in zip(behind, here, ahead, strict=True)]
    numbers = sample.in_double(at)
    drive_model, state = _state(name, plan, numbers)
    x, v = (np.array(list(map(float, a))) for a in ([at[u] for u in plan.unknowns], direction))
    one, two = np.empty(len(x)), np.empty(len(x))
    drive_model.along(pointer(state), numbers[plan.drive.instant], *map(pointer, (x, v, one, two)))
    assert one == pytest.approx(np.array(first, dtype=float), rel=1e-11, abs=1e-11)
    assert two == pytest.approx(np.array(second, dtype=float), rel=1e-10, abs=1e-10)


def _state(name, plan, numbers):
    from meshwright.base.library import model

    compiled = model(name)
    state = np.empty(compiled.ns)
    parameters = np.array([numbers[p.symbol] for p in plan.drive.parameters])
    assert compiled.setup(pointer(parameters), pointer(state)) == 0
    return compiled, state
