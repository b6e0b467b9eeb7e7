"""Lanes: the same numbers as the scalar trace, for every design and every width that this processor runs."""

import numpy as np
import pytest

from meshwright import Drive
from meshwright.base.library import ffi, library
from tests.lanes import WIDTHS, available, trace, trace_designs
from tests.quick import quick

DESIGNS = ("recess-action-full", "face-worm-cylindrical-convex", "spherical-table-2-3")


@pytest.fixture(params=WIDTHS)
def lanes(request):
    found = available().get(request.param)
    if found is None:
        pytest.skip(f"this processor has no lanes of width {request.param}")
    return found


@pytest.mark.parametrize("name", quick(DESIGNS, "spherical-table-2-3"))
def test_one_design_in_lanes_is_the_scalar_trace(lanes, name):
    drive = Drive.load(name)
    angles = np.linspace(-0.3, 0.3, 203) * drive.pitch()
    x, status, succeeded = trace(lanes, drive, angles)
    scalar, words = drive.trace(angles)
    assert succeeded == len(angles)
    assert set(words) == {"converged"} and not status.any()
    assert np.abs(x - scalar).max() < 1e-11


def test_unequal_spacing_is_predicted_too(lanes):
    drive = Drive.load("recess-action-full")
    angles = np.sort(np.random.default_rng(3).uniform(0.3, 30.0, 500))
    x, _, succeeded = trace(lanes, drive, angles)
    assert succeeded == 500
    assert np.abs(x - drive.trace(angles)[0]).max() < 1e-11


def test_a_lane_without_contact_gets_the_status_of_the_scalar_trace(lanes):
    drive = Drive.load("recess-action-full")
    designs = np.tile(drive.design.parameters, (11, 1))
    equal_hob = drive.with_(design={"hob_pitch_radius_mm": drive.design.as_solved()["design"]["worm_pitch_radius_mm"]})
    designs[4] = equal_hob.design.parameters
    angles = np.linspace(5.0, 6.0, 30)
    x, status, _ = trace_designs(lanes, drive, designs, angles)
    words = {library().mw_status_word(int(s)) for s in status[4]}
    assert {ffi.string(w).decode() for w in words} == {"line_contact"}
    others = np.delete(np.arange(11), 4)
    assert not status[others].any()
    scalar = drive.trace(angles)[0]
    assert np.abs(x[others] - scalar).max() < 1e-11


@pytest.mark.parametrize("name", DESIGNS)
@pytest.mark.parametrize("points", [1, 31, 100])
def test_a_design_has_the_same_bits_in_any_lane_among_any_others(lanes, name, points):
    drive = Drive.load(name)
    rng = np.random.default_rng(points)
    # of a frame the components belong together: one that is no frame any more is refused
    free = [p["table"] != "placement" for p in drive.design.description["parameters"]]
    designs = drive.design.parameters * (1.0 + 1e-7 * rng.normal(size=(21, drive.model.np)) * free)
    angles = np.linspace(0.0, 0.2, points) * drive.pitch()
    x, status, succeeded = trace_designs(lanes, drive, designs, angles)
    assert succeeded == 21 * points and not status.any()
    order = rng.permutation(21)
    assert x[order].tobytes() == trace_designs(lanes, drive, designs[order], angles)[0].tobytes()


@pytest.mark.parametrize("name", DESIGNS)
def test_lanes_that_fuse_products_agree_to_the_last_bit(name):
    fusing = [lanes for width, lanes in available().items() if width > 2]
    if len(fusing) < 2:
        pytest.skip("this processor has fewer than two sets of lanes with fused operations")
    drive = Drive.load(name)
    designs, angles = np.tile(drive.design.parameters, (5, 1)), np.linspace(0.0, 0.2, 70) * drive.pitch()
    first, *others = (trace_designs(lanes, drive, designs, angles)[0].tobytes() for lanes in fusing)
    assert all(x == first for x in others)


def test_a_model_without_lane_kernels_and_angles_out_of_range_are_traced_one_by_one(lanes):
    """The user's own model table: its name is none of the library's."""
    drive = Drive.load("recess-action-full")
    own = ffi.new("mw_model *", drive.model[0])
    name = own.drive = ffi.new("char[]", b"own_drive")
    object.__setattr__(drive, "model", own)
    angles = np.linspace(0.0, 0.5, 5)
    for x, status, succeeded in (trace(lanes, drive, angles), _first_of_two(lanes, drive, angles)):
        assert succeeded % len(angles) == 0 and not status.any(), ffi.string(name)
        assert np.abs(x - drive.trace(angles)[0]).max() < 1e-12
    angles[2] = np.inf
    _, status, succeeded = trace(lanes, Drive.load("recess-action-full"), angles)
    assert succeeded == 4
    assert ffi.string(library().mw_status_word(int(status[2]))) == b"bad_input"


def _first_of_two(lanes, drive, angles):
    x, status, succeeded = trace_designs(lanes, drive, np.tile(drive.design.parameters, (2, 1)), angles)
    return x[0], status[0], succeeded


def test_no_angle_is_no_point(lanes):
    x, _, succeeded = trace(lanes, Drive.load("recess-action-full"), np.empty(0))
    assert len(x) == 0 and succeeded == 0


@pytest.mark.parametrize("name", DESIGNS)
def test_angles_far_apart_are_reached_over_others_between(lanes, name):
    """Thirteen angles of a sample: as of the scalar trace, in the order in which they are asked for."""
    drive = Drive.load(name)
    angles = np.linspace(-0.6, 0.6, 13)[:: -1 if name == DESIGNS[0] else 1].copy()
    x, status, succeeded = trace_designs(lanes, drive, drive.design.parameters[None], angles)
    order = np.argsort(angles)
    known, words = drive.trace(angles[order])
    there = np.array([word == "converged" for word in words])
    assert there.any() and succeeded == there.sum()
    assert x[0][order][there] == pytest.approx(known[there], rel=1e-11, abs=1e-11)
