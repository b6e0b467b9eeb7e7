"""A drive that turns on: which pair is in mesh, at which angle of its own; one contact whatever was asked before."""

import mpmath
import numpy as np
import pytest

from meshwright import Drive
from meshwright.base.errors import UsageError
from meshwright.base.library import ffi, library, pointer, record
from tests.contact.test_paths_agree import VARIED, _alone, _random
from tests.quick import quick

#: Angles and threads of theory, with pair and own angle to twenty digits.
REDUCED = [
    (1, 1e6, 159155, "-0.35756416708573504402"),
    (19, 1e12, 3023943918746, "0.0037631679347489511445"),
    (3, -123456789.125, -58946275, "0.53932245961837303607"),
]

#: A packaged design of every drive.
OF_EVERY_DRIVE = (
    "bevel-crown-pair", "bevel-face-hobbed", "bevel-formate", "crossed-helical-17-23", "face-worm-conical-concave",
    "plain-za", "plain-zc", "plain-zi", "plain-zk", "plain-zn", "zk-zn-30", "spherical-table-2-1",
    "spherical-table-2-2-concave-14-5", "spherical-table-2-2-convex-14-5", "spherical-table-3-1-convex",
)  # fmt: skip


def _reduce(drive, teeth, phi, reference=0.0):
    m, p = drive.model, np.array(drive.design.parameters)
    p[m.teeth] = teeth
    if m.reference >= 0:
        p[m.reference] = reference
    pair = ffi.new("double *")
    angle = library().mw_reduce(m, pointer(p), phi, pair)
    return pair[0], angle


def _exactly(teeth, reference, phi):
    """Pair and own angle in fifty digits."""
    with mpmath.workdps(60):
        pitch = 2 * mpmath.pi / teeth
        pair = mpmath.floor((mpmath.mpf(phi) - mpmath.mpf(reference)) / pitch + mpmath.mpf(1) / 2)
        return int(pair), mpmath.mpf(phi) - pair * pitch, pitch


@pytest.mark.parametrize(("teeth", "phi", "pair", "angle"), REDUCED)
def test_reduction_of_printed_angles(teeth, phi, pair, angle):
    found, own = _reduce(Drive.load("plain-za"), teeth, phi)
    assert found == pair
    assert abs(mpmath.mpf(own) - mpmath.mpf(angle)) < 7e-16 / teeth


def test_random_angles_are_reduced_to_the_last_digit():
    """Over teeth, sizes and references; beside the end of a pair's half pitch either of the two is right."""
    generator = np.random.default_rng(46)
    drives = [Drive.load("plain-za"), Drive.load("recess-action-full")]
    for _ in range(2000):
        drive, teeth = drives[generator.integers(2)], int(generator.integers(1, 101))
        reference = float(generator.uniform(-3.0, 3.0)) if drive.model.reference >= 0 else 0.0
        phi = float(generator.normal() * 10.0 ** generator.uniform(-2.0, 11.5))
        pair, own = _reduce(drive, teeth, phi, reference)
        exact_pair, exact, pitch = _exactly(teeth, reference, phi)
        shifted = exact + (exact_pair - int(pair)) * pitch
        assert abs(int(pair) - exact_pair) <= 1 and abs(mpmath.mpf(own) - shifted) < 7e-16 * max(1.0, 1.0 / teeth)
        assert -pitch / 2 - 1e-15 <= shifted - reference <= pitch / 2 + 1e-15


def test_what_is_no_angle_is_refused():
    drive = Drive.load("plain-za")
    for phi in (np.nan, np.inf, -np.inf, 1.0000001e12):
        assert all(np.isnan(_reduce(drive, 3, phi)))
        with pytest.raises(UsageError, match="give none beyond 1e\\+12 rad"):
            drive.turn([phi])


def _followed(drive, angles):
    m, n = drive.model, len(angles)
    s, work, x, records = np.empty(m.ns), np.empty(m.np), np.empty((n, m.nx)), np.zeros(n, record("mw_info"))
    angles = np.ascontiguousarray(angles)
    library().mw_turn(
        m, pointer(drive.design.parameters), pointer(angles), n, pointer(s), pointer(work), pointer(x),
        pointer(records, "mw_info[]"),
    )  # fmt: skip
    return x, records


@pytest.mark.parametrize("name", quick(VARIED, "zk-zn-45", "helical-crowned", "spherical-table-2-3"))
def test_a_contact_has_the_same_bits_whatever_was_asked_before(name):
    """Forwards, backwards, shuffled and alone; random misalignments, over some pitches and far away."""
    generator = np.random.default_rng(len(name))
    for far in (0.0, 1e9):
        drive = _random(name, generator)
        angles = far + np.sort(generator.uniform(-2.0, 3.0, 60)) * drive.pitch()
        x, records = _followed(drive, angles)
        order = generator.permutation(len(angles))
        for rows in (slice(None, None, -1), order):
            again, other = _followed(drive, angles[rows])
            assert again.tobytes() == x[rows].tobytes()
            assert np.array_equal(other["status"], records["status"][rows])
            assert np.array_equal(other["angle"], records["angle"][rows])
        for k in range(0, len(angles), 7):
            status, alone = _alone(drive, records["angle"][k])
            assert status == records["status"][k] and alone.tobytes() == x[k].tobytes()


@pytest.mark.parametrize("name", quick(OF_EVERY_DRIVE, "plain-zc", "spherical-table-2-1"))
def test_every_drive_has_the_same_bits_in_any_order_and_the_same_errors_after_any_turns(name):
    drive, generator = Drive.load(name), np.random.default_rng(15)
    sample = np.linspace(-0.45, 0.45, 25) * drive.pitch() + drive.about_the_middle([0.0])
    _, here = _followed(drive, sample)
    assert (here["status"] >= 0).all()
    for turns in (0.0, 1e6, 9.9e11):
        angles = turns + sample
        x, records = _followed(drive, angles)
        for rows in (slice(None, None, -1), generator.permutation(len(angles))):
            assert _followed(drive, angles[rows])[0].tobytes() == x[rows].tobytes()
        wrapped, _ = _followed(drive, records["angle"])
        assert np.abs(wrapped - x)[:, drive.model.error].max() < 1e-12


@pytest.mark.parametrize("name", quick(VARIED, "recess-action-full", "helical-crowned"))
def test_pairs_repeat(name):
    """What a pair does at an angle the next does a pitch later, after many turns too."""
    drive = Drive.load(name)
    sample = np.linspace(-0.45, 0.45, 7) * drive.pitch() + drive.about_the_middle([0.0])
    itself = drive.tca(sample)
    for pair in (0, 1, -3, 10**5, 10**9):
        angles = np.array([float(mpmath.mpf(a) + pair * mpmath.mpf(drive.pitch())) for a in sample])
        turned = drive.turn(angles)
        again = drive.tca(turned.own_angles)
        held = [s in ("converged", "line_contact") for s in turned.statuses]
        assert all(held), turned.statuses
        assert np.abs(again.error - turned.errors).max() < 1e-12
        if abs(pair) <= 1:
            near = turned.pairs == turned.pairs[3]
            assert np.abs(itself.error - turned.errors)[near].max() < 1e-12


def test_a_warm_step_is_taken_and_a_foreign_start_is_not():
    """From the solution before, near by, and from nothing else."""
    drive = Drive.load("recess-action-full")
    x, records = _followed(drive, np.linspace(0.0, 1.0, 101))
    assert records["cold"][0] == 1 and not records["cold"][1:].any()
    _, apart = _followed(drive, np.array([0.0, 0.3, 0.6]))
    assert apart["cold"].all()
    assert np.array_equal(x[0], _alone(drive, 0.0)[1])


def test_a_pair_is_not_followed_where_its_tooth_faces_away():
    """At the other side of the wheel there is no contact, which is said at once and not after a walk."""
    drive = Drive.load("helical-crowned")
    away = np.pi / drive.ratio
    for angle in (1.01 * away, -1.01 * away, 1e5, 1e12):
        status, x = _alone(drive, angle)
        assert library().mw_status_word(status) == library().mw_status_word(-1)
        assert np.isnan(x).all()
