"""A drive that turns on, all pairs and both flanks: closed forms, brute force over pairs, and what ``ratio`` says."""

import mpmath
import numpy as np
import pytest

from meshwright import Drive
from meshwright.base.errors import UsageError
from meshwright.base.library import library, pointer, record
from meshwright.contact.results import ARCSEC, impossible
from meshwright.cycle.backlash import SAMPLES, backlash
from meshwright.cycle.pairs import Mesh
from meshwright.cycle.rigid import ROUND_OFF
from meshwright.cycle.transmission import envelopes
from tests.contact.test_paths_agree import VARIED, _random
from tests.quick import quick

#: Where errors agree, rad.
AGREED = 1e-9 * ARCSEC

#: Pitches around an end of a window in which either side may be meant.
BESIDE_END = 1e-9

#: Angle, leading pair, errors of both flanks (arcseconds) and ratio of the helical gears of theory.
HELICAL = [
    (0.05, 0, 0.0958699225, 1.3260032071, 0.56084598),
    (0.15, 1, -5.1329091875, -0.4643143480, 0.56139627),
    (0.2, 1, -1.6076182128, 1.1089584618, None),
]


@pytest.mark.parametrize(("angle", "pair", "driven", "coast", "ratio"), HELICAL)
def test_errors_pairs_and_ratios_of_theory(angle, pair, driven, coast, ratio):
    found = Drive.load("helical-crowned").cycle([angle])
    assert found.drive.pairs[0] == pair
    assert found.drive.errors[0] / ARCSEC == pytest.approx(driven, abs=6e-11)
    assert found.coast.errors[0] / ARCSEC == pytest.approx(coast, abs=6e-11)
    assert ratio is None or found.drive.ratios[0] == pytest.approx(ratio, abs=6e-9)


def test_a_drive_far_from_its_start():
    found = Drive.load("helical-crowned").cycle([1e6])
    assert found.drive.pairs[0] == 3660564
    assert found.drive.errors[0] / ARCSEC == pytest.approx(-2.2557720634, abs=6e-11)


def test_backlash_of_theory():
    drive = Drive.load("helical-crowned")
    found = drive.cycle(np.arange(64) / 64 * drive.pitch()).backlash / ARCSEC
    assert [found.min(), found.max()] == pytest.approx([1.0082373729, 4.9216246492], abs=6e-11)


def test_backlash_of_involutes_that_touch_along_lines():
    """2 (1 + m) (inv α_w − inv α_0), cos α_w = (r_b1 + r_b2)/A, inv α_0 = inv α + 2 tan α (x_1 + x_2)/(z_1 + z_2)."""
    pinion, wheel, module, shifts = 12, 24, 3, mpmath.mpf("0.96")
    with mpmath.workdps(30):
        pressure_angle = mpmath.radians(20)
        working = mpmath.acos((pinion + wheel) * module * mpmath.cos(pressure_angle) / 2 / mpmath.mpf("56.6"))
        at_zero = _involute(pressure_angle) + 2 * mpmath.tan(pressure_angle) * shifts / (pinion + wheel)
        expected = float(2 * (1 + mpmath.mpf(pinion) / wheel) * (_involute(working) - at_zero))
    found = Drive.load("spur-profile-shift").with_(design={"center_distance_mm": 56.6}).cycle([0.0, 0.1, 1e9])
    assert set(found.drive.statuses) == set(found.coast.statuses) == {"line_contact"}
    assert found.backlash == pytest.approx(expected, abs=AGREED)


def _involute(angle):
    return mpmath.tan(angle) - angle


def _inside(mesh, angles):
    """Those of the angles at which no pair is at an end of its window."""
    ends, pitch = [mesh.window.begin.angle, mesh.window.end.angle], mesh.drive.pitch()
    away = (angles[:, None] - ends) / pitch
    return angles[(np.abs(away - np.round(away)) > BESIDE_END).all(axis=1)]


def _sample(mesh, generator, count=40):
    return _inside(mesh, np.sort(generator.uniform(-1.5, 2.5, count)) * mesh.drive.pitch())


@pytest.mark.parametrize("name", quick(VARIED, "recess-action-full", "helical-crowned", "spherical-table-2-3"))
def test_the_leading_pair_is_that_of_the_envelope_and_of_all_pairs_by_themselves(name):
    generator = np.random.default_rng(len(name))
    for drive in (Drive.load(name), _random(name, generator)):
        mesh = Mesh.of(drive)
        if not mesh.window.complete or mesh.path is None:
            continue
        angles = _sample(mesh, generator)
        found, known = drive.cycle(angles), envelopes(mesh, angles)
        assert found.drive.errors == pytest.approx(
            known.upper if mesh.sense > 0 else known.lower, abs=AGREED, nan_ok=True
        )
        assert np.array_equal(found.drive.touching, [len(mesh.numbers(angle)) for angle in angles])
        for k in range(0, len(angles), 8):
            error, touching = _of_all_pairs(drive, mesh.sense, angles[k])
            assert found.drive.errors[k] == pytest.approx(error, abs=AGREED, nan_ok=True)
            assert found.drive.touching[k] == touching


def _of_all_pairs(drive, sense, angle, reach=12):
    """Largest error, times ``sense``, of the pairs that touch within all limits, and how many do."""
    own = np.array([float(mpmath.mpf(angle) - k * mpmath.mpf(drive.pitch())) for k in range(-reach, reach + 1)])
    own = own[np.abs(own) * drive.ratio < np.pi]
    at = drive.tca(own)
    limits = np.stack([*at.margins.values()])
    within = ~(limits < 0.0).any(axis=0) & np.array([status == "converged" for status in at.status])
    within &= [not any(impossible(f) or f == "undercut" for f in flags) for flags in at.flags]
    errors = at.error[within]
    return (sense * np.max(sense * errors), len(errors)) if len(errors) else (np.nan, 0)


@pytest.mark.parametrize("name", quick(VARIED, "helical-crowned", "zk-zn-45", "spherical-table-2-3"))
def test_where_no_edge_is_flagged_none_touches_first(name):
    """The first contact of all pairs, edges and corners too, is then that of the leading pair; else not after it."""
    generator = np.random.default_rng(len(name))
    for drive in (Drive.load(name), _random(name, generator)):
        mesh = Mesh.of(drive)
        if mesh.rigid is None or mesh.path is None:
            continue
        angles = _sample(mesh, generator, 12)
        found = drive.cycle(angles).drive
        ahead = mesh.sense * (mesh.rigid.transmitted(angles) - found.errors)
        assert np.all(np.abs(ahead[~found.edges]) < ROUND_OFF)
        assert not np.any(ahead[found.edges] < -ROUND_OFF)
        assert found.edges[np.isnan(found.errors)].all()


@pytest.mark.parametrize("name", quick(VARIED, "helical-crowned", "plain-za"))
def test_backlash_is_that_of_the_drive(name):
    drive = Drive.load(name)
    if drive.other_side is None:
        assert np.isnan(drive.cycle([0.0]).backlash).all()
        assert drive.cycle([0.0]).coast.statuses == ["bad_input"]
        return
    found = drive.cycle(np.arange(SAMPLES) / SAMPLES * drive.pitch()).backlash
    assert found.min() == pytest.approx(backlash(drive), abs=AGREED)


def test_each_flank_with_a_design_of_its_own():
    convex, concave = Drive.load("face-worm-conical-convex"), Drive.load("face-worm-conical-concave")
    angles = np.linspace(0.0, 1.0, 7) * convex.pitch()
    found = convex.cycle(angles, concave)
    assert set(found.coast.statuses) == {"converged"} and np.isfinite(found.backlash).all()
    assert np.array_equal(found.drive.errors, convex.cycle(angles).drive.errors)
    with pytest.raises(UsageError, match="not the other flank of"):
        convex.cycle(angles, convex)


def test_the_mirror_image_runs_alike():
    right = Drive.load("recess-action-full").with_(misalignment={"center_distance_mm": -0.1})
    left = right.with_(design={"hand": "left"})
    angles = np.linspace(-1.0, 2.0, 9)
    one, other = right.cycle(angles), left.cycle(-angles)
    for a, b in ((one.drive, other.drive), (one.coast, other.coast)):
        assert np.array_equal(a.errors, -b.errors) and np.array_equal(a.pairs, -b.pairs)
        assert np.array_equal(a.ratios, b.ratios)
    assert np.array_equal(one.backlash, other.backlash)


@pytest.mark.parametrize("name", quick(VARIED, "helical-crowned", "face-worm-cylindrical-convex"))
def test_a_drive_has_the_same_bits_whatever_was_asked_before(name):
    generator = np.random.default_rng(len(name))
    drive = _random(name, generator)
    angles = np.concatenate([far + np.sort(generator.uniform(-2.0, 3.0, 25)) * drive.pitch() for far in (0.0, 1e9)])
    found = _fields(drive, angles)
    for rows in (slice(None, None, -1), generator.permutation(len(angles))):
        assert _fields(drive, angles[rows]).tobytes() == np.ascontiguousarray(found[rows]).tobytes()


def _fields(drive, angles):
    """Every number of ``mw_cycle`` at angles (N,): (N, 13)."""
    m, other = drive.model, drive.other_side or drive
    c, found = np.empty(library().mw_cycle_size(m)), np.zeros(len(angles), record("mw_cycle"))
    library().mw_cycle_setup(m, pointer(drive.design.parameters), pointer(other.design.parameters), pointer(c))
    library().mw_cycles(
        m, pointer(c), pointer(np.ascontiguousarray(angles)), len(angles), pointer(found, "mw_cycle[]")
    )
    sides = [found[side][field] for side in ("drive", "coast") for field in found["drive"].dtype.names]
    return np.stack([found["pair"], found["angle"], found["backlash"], *sides], axis=1)


@pytest.mark.parametrize("name", quick(VARIED, "recess-action-full", "helical-crowned"))
def test_a_drive_repeats_from_pitch_to_pitch(name):
    """Wrapped and absolute angles give one error, and the pairs count on."""
    drive = Drive.load(name)
    sample = np.linspace(0.03, 0.97, 5) * drive.pitch()
    here = drive.cycle(sample)
    for pair in (1, -3, 10**5, 10**9):
        turned = drive.cycle([float(mpmath.mpf(a) + pair * mpmath.mpf(drive.pitch())) for a in sample])
        slopes = np.abs(here.drive.ratios - drive.ratio)
        rounding = np.spacing(np.abs(turned.angles)) * (1.0 + slopes)
        assert np.all(np.abs(here.drive.errors - turned.drive.errors) < 1e-12 + rounding * slopes)
        assert np.array_equal(turned.drive.pairs - here.drive.pairs, np.full(5, pair))


def test_bounded_flanks_that_touch_at_edges_alone_are_said_to():
    """Tilted spur gears without crowning touch at an end of their faces: no pair touches within its limits."""
    found = Drive.load("spur-profile-shift").with_(misalignment={"vertical_deg": 0.05}).cycle([0.0, 0.1])
    assert found.drive.statuses == ["no_contact"] * 2 and found.drive.edges.all()
    assert np.isnan(found.drive.errors).all() and np.isnan(found.backlash).all()


@pytest.mark.parametrize("angle", [np.nan, np.inf, 1.1e12])
def test_what_is_no_angle_is_refused(angle):
    with pytest.raises(UsageError, match="give none beyond 1e\\+12 rad"):
        Drive.load("plain-za").cycle([angle])


EDGED = {
    "bevel-hypoid-formate": {},
    "spur-profile-shift": {"misalignment": {"vertical_deg": 0.05}},
    "helical-crowned": {"misalignment": {"vertical_deg": 0.3}},
    "plain-zn": {"design": {"hand": "left"}, "blank": {"wheel_face_width_mm": 9.0}},
}


@pytest.mark.parametrize("name", quick(EDGED, "bevel-hypoid-formate"))
def test_edges_that_touch_first_are_found_over_all_pairs(name):
    """Brute force: the first contacts of all pairs within four pitches, the one that leads; the ratio as it changes."""
    drive = Drive.load(name).with_(**EDGED[name])
    pitch, numbers, turned = drive.pitch(), np.arange(-4, 5), 1e-6
    angles = np.linspace(0.013, 1.013, 6) * pitch
    without, found = drive.cycle(angles), drive.cycle(angles, edges=True)
    assert without.drive.edges.any() and not found.drive.edges.any()
    for k, angle in enumerate(angles):
        alone = drive.first_contact(angle - numbers * pitch)
        touching = ~np.isnan(alone.errors)
        ahead = np.where(touching, Mesh.of(drive).sense * alone.errors, -np.inf)
        assert found.drive.errors[k] == pytest.approx(alone.errors[np.argmax(ahead)], abs=AGREED)
        kind = alone.kinds[np.argmax(ahead)]
        assert found.drive.statuses[k] == {"tangency": "converged"}.get(kind, f"{kind}_contact")
        sides = drive.cycle([angle - turned, angle + turned], edges=True).drive.errors
        slope = drive.ratio + (sides[1] - sides[0]) / (2.0 * turned)
        assert found.drive.ratios[k] == pytest.approx(slope, abs=2e-7)
        assert found.drive.pairs[k] == numbers[np.argmax(ahead)]


def test_backlash_on_edges_is_that_of_both_flanks():
    """A misaligned spur pair: as ``ratio`` has its least."""
    drive = Drive.load("spur-profile-shift").with_(
        design={"center_distance_mm": 56.6}, misalignment={"vertical_deg": 0.05}
    )
    found = drive.cycle(np.arange(8) / 8 * drive.pitch(), edges=True)
    assert np.min(found.backlash) == pytest.approx(backlash(drive), abs=AGREED)
