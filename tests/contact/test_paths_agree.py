"""One contact, whoever solves it: by itself, in a trace, in lanes, in a sweep, by the header alone, by CasADi, in fifty
digits by formulations of their own; and from starts that mislead.

Random misalignments of random designs of every family, angles in random order.
"""

import casadi
import mpmath
import numpy as np
import pytest

from meshwright import Drive
from meshwright.base.errors import DesignError
from meshwright.base.library import SHIPPED, ffi, library, pointer
from meshwright.contact import analysis
from meshwright.design.design import is_real
from meshwright.sweep import samples
from tests import lanes
from tests.bevel.test_fifty_digits import exact_contact
from tests.independent.twins import twin
from tests.quick import quick

#: Packaged designs and the key of each that is varied, with the range.
VARIED = {
    "recess-action-full": ("pitch_line_shift_mm", 3.0, 4.5),
    "zk-zn-45": ("hob_pitch_radius_mm", 1.0, 1.1),
    "plain-za": ("pressure_angle_deg", 18.0, 24.0),
    "spherical-table-2-3": ("normal_module_mm", 3.0, 6.0),
    "face-worm-cylindrical-convex": ("shaft_angle_deg", 90.0, 90.0),
    "helical-crowned": ("normal_module_mm", 1.9, 2.1),
    "crossed-helical-17-23": ("pressure_angle_deg", 19.0, 21.0),
    "bevel-formate": ("", 0.0, 0.0),
    "bevel-face-hobbed": ("", 0.0, 0.0),
}
NOW = ("recess-action-full", "spherical-table-2-3", "crossed-helical-17-23")


def _random(name, generator):
    drive = Drive.load(name)
    keys = [p for p in drive.design.description["parameters"] if p["table"] == "misalignment"]
    sizes = {p["key"]: generator.normal() * (0.05 if p["unit"] == "rad" else 0.03) for p in keys}
    key, low, high = VARIED[name]
    values = {key: float(generator.uniform(low, high))} if low < high and key in drive.design.tables["design"] else {}
    try:
        return drive.with_(misalignment=sizes, design=values)
    except DesignError:
        return drive.with_(misalignment=sizes)


def _by_header(drive, angle, start):
    """The contact near ``start`` by ``solve`` of the drive's header alone: the entry for CasADi calls it."""
    name = drive.design.description["name"]
    solve = casadi.external(f"{name}_contact", str(SHIPPED / f"{name}.so"))
    return np.asarray(solve(drive.design.parameters, angle, start)[0]).ravel()


def _alone(drive, angle):
    m, p = drive.model, drive.design.parameters
    s, work, x, info = np.empty(m.ns), np.empty(m.np), np.empty(m.nx), ffi.new("mw_info *")
    return library().mw_solve(m, pointer(p), angle, pointer(s), pointer(work), pointer(x), info), x


@pytest.mark.parametrize("name", quick(VARIED, *NOW))
def test_every_path_of_evaluation_finds_the_same_contact(name):
    generator = np.random.default_rng(len(name))
    for _ in range(4):
        drive = _random(name, generator)
        angles = np.sort(generator.uniform(-2.0, 2.0, 12))
        x, records = analysis.trace(drive, angles)
        status, good = records["status"], records["status"] >= 0
        scale = np.maximum(1.0, np.abs(x))
        for k, angle in enumerate(angles):
            ended, own = _alone(drive, angle)
            assert (ended >= 0) == good[k]
            assert ended >= 0 or (ended == status[k] and np.isnan(own).all() and np.isnan(x[k]).all())
            assert ended < 0 or np.abs((own - x[k]) / scale[k]).max() < 1e-9
        flags = drive.tca(angles).flags
        for k in np.flatnonzero(good)[:3]:
            near = _by_header(drive, angles[k], x[k] + 1e-4 * generator.normal(size=len(x[k])))
            if {"interference", "spurious_sheet"}.intersection(flags[k]):
                assert np.isnan(near).all()
            else:
                assert np.abs((near - x[k]) / scale[k]).max() < 1e-8
        shuffled = generator.permutation(angles)
        result = drive.tca(shuffled)
        order = np.argsort(shuffled)
        assert np.abs(result.solutions[order] - x)[good].max(initial=0.0) < 1e-9 * np.nanmax(scale, initial=1.0)
        for lane_set in lanes.available().values():
            many, codes, _ = lanes.trace(lane_set, drive, angles)
            assert ((codes >= 0) == good).all()
            assert (np.abs(many - x) / scale)[good].max(initial=0.0) < 1e-9
        swept = samples.solve(drive, [], np.empty((1, 0)), angles)
        assert np.array_equal(np.isfinite(swept.error[0]), np.isfinite(result.error[order]))
        assert np.allclose(swept.error[0], result.error[order], rtol=0.0, atol=1e-12, equal_nan=True)


@pytest.mark.parametrize("name", quick(VARIED, "spherical-table-2-3"))
def test_casadi_finds_the_same_contact(name):
    generator = np.random.default_rng(5)
    drive = _random(name, generator)
    angles = np.sort(generator.uniform(-1.0, 1.0, 3))
    own, other = drive.tca(angles), Drive(drive.design, backend="casadi").tca(angles)
    assert own.status == other.status
    assert np.allclose(own.error, other.error, rtol=0.0, atol=1e-12, equal_nan=True)


def _in_fifty_digits(drive, contact, angle):
    """Transmission error and contact point of the only row of ``contact``, by the family's independent formulation."""
    if drive.design.family == "bevel":
        pair, x = exact_contact(drive.design.given(), contact, 0, angle)
        r, n, _ = pair.pinion.surface(*x[:3])
        return pair.error(x, angle), pair.place_pinion(r, n, mpmath.mpf(angle))[0]
    keys = [p for p in drive.design.description["parameters"] if is_real(p) and _given(drive, p)]
    given = {f"{p['table']}.{p['key']}": mpmath.mpf(drive.design.value(p["key"], p["table"])) for p in keys}
    exact, phi = twin(drive, contact), mpmath.mpf(angle)
    seen = exact.solved(given, phi)
    return seen[exact.names.index("transmission_error")], seen[len(exact.names) :]


def _given(drive, parameter):
    table, key = parameter["table"], parameter["key"]
    return table == "misalignment" or table == "design" and drive.design.tables[table].get(key) is not None


@pytest.mark.parametrize("name", quick(VARIED, "spherical-table-2-3", "plain-za"))
def test_fifty_digits_find_the_same_contact(name):
    generator, solved = np.random.default_rng(11), 0
    for _ in range(3):
        drive = _random(name, generator)
        assert not drive.design.mirrored
        angle = drive.design.reference_angle + 0.3 * drive.pitch() * generator.uniform(-1.0, 1.0)
        contact = drive.tca([angle])
        if contact.status != ("converged",):
            continue
        with mpmath.workdps(50):
            error, point = _in_fifty_digits(drive, contact, angle)
        assert abs(float(error - mpmath.mpf(contact.error[0]))) < 1e-12
        assert np.abs(contact.points[0] - np.array([float(x) for x in point])).max() < 1e-9
        solved += 1
    assert solved > 0


@pytest.mark.parametrize("name", VARIED)
def test_a_start_that_misleads_ends_in_a_contact_or_in_a_reason(name):
    """Newton from anywhere: what it calls a success touches, as the two surfaces themselves say."""
    generator = np.random.default_rng(7)
    drive, solved = _random(name, generator), 0
    m, lib, o, info = drive.model, library(), np.empty(drive.model.no), ffi.new("mw_info *")
    scale = np.empty(m.nx)
    for _ in range(400):
        angle = generator.uniform(-3.0, 3.0)
        s = drive.state(angle)
        m.scale(pointer(s), pointer(scale))
        x = generator.normal(size=m.nx) * scale * generator.choice([1.0, 10.0, 100.0])
        if lib.mw_refine(m, pointer(s), pointer(x), info) < 0:
            assert lib.mw_status_text(info.status) != ffi.NULL
            continue
        solved += 1
        m.observe(pointer(s), pointer(x), pointer(o))
        size = 1.0 + np.abs(o[:3]).max()
        assert np.abs(o[0:3] - o[6:9]).max() < 1e-9 * size
        assert np.abs(o[3:6] + o[9:12]).max() < 1e-9
        assert all(m.unknowns[k].lower <= x[k] <= m.unknowns[k].upper for k in range(m.nx))
    assert solved > 0


@pytest.mark.parametrize("name", ["plain-za", "zk-zn-60"])
def test_one_angle_has_one_status_whichever_others_are_asked_for(name):
    """Also of teeth so short that they do not reach each other."""
    drive = Drive.load(name)
    tip = drive.design.value("worm_pitch_radius_mm", "design")
    for blank in ({}, {"worm_tip_radius_mm": tip - 1.0, "wheel_tip_radius_mm": 1.0}, {"worm_tip_radius_mm": tip - 0.5}):
        short = drive.with_(blank=blank)
        angles = np.radians([-40.107, -3.0, 0.0, 20.0, 40.107, 200.0])
        together = short.tca(angles).status
        for k, angle in enumerate(angles):
            assert short.tca([angle]).status == (together[k],)
            assert short.tca([angle, 0.0]).status[0] == together[k]


@pytest.mark.parametrize("shorter", [2.0, -4.0], ids=["past the tips", "wide tips"])
def test_random_subsets_of_angles_have_the_same_statuses(shorter):
    """Where the branch folds and the teeth do not reach each other either, at 40.107° alone or with others."""
    changes = {"hob_pitch_radius_mm": 12.996704, "shaft_angle_deg": 75.5278}
    errors = {"center_distance_mm": -0.042, "vertical_deg": 0.019, "horizontal_deg": -0.1448}
    blank = {"worm_tip_radius_mm": 16.62 - shorter, "wheel_tip_radius_mm": 62.62 - shorter}
    drive = Drive.load("zk-zn-60").with_(design=changes, misalignment=errors, blank=blank)
    angles = np.radians([40.107, 0.0, -40.107, 170.0, -200.0, 200.0, 240.0, -80.0])
    assert "fold" in analysis.analyse(drive, angles).status
    alone = [drive.tca([angle]).status[0] for angle in angles]
    assert ("no_contact" in alone) == (shorter > 0.0)
    generator = np.random.default_rng(3)
    for _ in range(12):
        chosen = generator.permutation(len(angles))[: generator.integers(2, len(angles) + 1)]
        assert drive.tca(angles[chosen]).status == tuple(alone[k] for k in chosen)
