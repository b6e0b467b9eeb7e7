"""Lanes: the same numbers as the scalar trace, for every design and every width that this processor runs."""

import numpy as np
import pytest

from meshwright import Drive
from meshwright._library import ffi, library

DESIGNS = ("recess-action-full", "face-worm-cylindrical-convex", "spherical-table-2-3")


def _pointer(array, kind="double[]"):
    return ffi.from_buffer(kind, array)


@pytest.fixture(params=[2, 4, 8])
def lanes(request):
    found = library().mw_lanes(request.param)
    if found == ffi.NULL:
        pytest.skip(f"this processor has no lanes of width {request.param}")
    return found


def _in_lanes(lanes, drive, angles):
    m, n = drive.model, len(angles)
    width = library().mw_lanes_width(lanes)
    work = np.empty(library().mw_lanes_work(lanes, m, -(-n // width)))
    x, status = np.empty((n, m.nx)), np.empty(n, dtype=np.int32)
    succeeded = library().mw_trace_angles(
        lanes, m, _pointer(drive.design.parameters), _pointer(angles), n, _pointer(work), _pointer(x),
        _pointer(status, "int[]"),
    )  # fmt: skip
    return x, status, succeeded


@pytest.mark.parametrize("name", DESIGNS)
def test_one_design_in_lanes_is_the_scalar_trace(lanes, name):
    drive = Drive.load(name)
    angles = np.linspace(-0.3, 0.3, 203) * drive.pitch()
    x, status, succeeded = _in_lanes(lanes, drive, angles)
    scalar, words = drive.trace(angles)
    assert succeeded == len(angles)
    assert set(words) == {"converged"} and not status.any()
    assert np.abs(x - scalar).max() < 1e-11


def test_unequal_spacing_is_predicted_too(lanes):
    drive = Drive.load("recess-action-full")
    angles = np.sort(np.random.default_rng(3).uniform(0.3, 30.0, 500))
    x, _, succeeded = _in_lanes(lanes, drive, angles)
    assert succeeded == 500
    assert np.abs(x - drive.trace(angles)[0]).max() < 1e-11


def test_a_lane_without_contact_gets_the_status_of_the_scalar_trace(lanes):
    drive = Drive.load("recess-action-full")
    nominal = drive.design.parameters
    designs = np.tile(nominal, (11, 1))
    equal_hob = drive.with_(design={"hob_pitch_radius_mm": drive.design.as_solved()["design"]["worm_pitch_radius_mm"]})
    designs[4] = equal_hob.design.parameters
    angles = np.linspace(5.0, 6.0, 30)
    start, _ = drive.trace(angles[:1])
    m = drive.model
    x, status = np.empty((11, 30, m.nx)), np.empty((11, 30), dtype=np.int32)
    work = np.empty(library().mw_lanes_work(lanes, m, 30))
    library().mw_trace_designs(
        lanes, m, _pointer(designs), 11, _pointer(angles), 30, _pointer(start), _pointer(work), _pointer(x),
        _pointer(status, "int[]"),
    )  # fmt: skip
    words = {library().mw_status_word(int(s)) for s in status[4]}
    assert {ffi.string(w).decode() for w in words} == {"line_contact"}
    others = np.delete(np.arange(11), 4)
    assert not status[others].any()
    scalar = drive.trace(angles)[0]
    assert np.abs(x[others] - scalar).max() < 1e-11
