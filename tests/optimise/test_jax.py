"""Contact as functions of JAX: the values of the drive, exact derivatives, and refusals in words."""

import subprocess
import sys

import numpy as np
import pytest

from meshwright import Drive
from meshwright.base.errors import DesignError, UsageError
from meshwright.sweep import samples

jax = pytest.importorskip("jax")
jax.config.update("jax_enable_x64", True)

from meshwright.jax import cycle, follow  # noqa: E402  needs jax

#: Design → free keys, their values, and steps of differences.
FREE = {
    "recess-action-full": {"misalignment.vertical_deg": (0.01, 1e-3), "design.hob_pitch_radius_mm": (20.06, 1e-3)},
    "helical-crowned": {"misalignment.center_distance_mm": (0.01, 1e-3), "misalignment.horizontal_deg": (0.002, 1e-4)},
    "spherical-table-2-3": {"misalignment.center_distance_mm": (0.02, 1e-3)},
    "bevel-hypoid": {"misalignment.gear_axial_mm": (0.01, 1e-3)},
    "plain-zn": {"misalignment.axial_mm": (0.02, 1e-3)},
}
ANGLES = np.array([0.02, -0.03, 1000.01, -12345.678])


def _free(name):
    values, steps = np.array(list(FREE[name].values())).T
    drive = Drive.load(name)
    if name == "plain-zn":
        drive = drive.with_(design={"hand": "left"})
    return drive, tuple(FREE[name]), values, steps


def _differences(of, step):
    """Central differences about 0, of fourth order."""
    far, near = of(2 * step) - of(-2 * step), of(step) - of(-step)
    return (8 * near - far) / 12


@pytest.mark.parametrize("name", FREE)
def test_values_are_those_of_the_drive(name):
    drive, free, v, _ = _free(name)
    own = samples.with_keys(drive, free, v)
    found = jax.jit(jax.vmap(follow(drive, free), (0, None)))(ANGLES, v)
    turned = own.turn(ANGLES)
    for field, value in (("pair", turned.pairs), ("angle", turned.own_angles), ("error", turned.errors)):
        assert np.array_equal(getattr(found, field), value)
    assert (np.asarray(found.status) == 0).all()
    found, whole = jax.vmap(cycle(drive, free), (0, None))(ANGLES, v), own.cycle(ANGLES)
    for field, value in {
        "error": whole.drive.errors,
        "coast_error": whole.coast.errors,
        "backlash": whole.backlash,
        "leading": whole.drive.pairs,
        "coast_leading": whole.coast.pairs,
        "edge": whole.drive.edges,
    }.items():
        assert np.array_equal(getattr(found, field), value, equal_nan=True)


@pytest.mark.parametrize("name", FREE)
def test_derivatives_of_the_pair_in_mesh_are_those_of_its_error(name):
    drive, free, v, steps = _free(name)
    at = follow(drive, free)
    by_angle, by_key = jax.jit(jax.vmap(jax.jacfwd(lambda phi, v: at(phi, v).error, (0, 1)), (0, None)))(ANGLES, v)

    def errors(phi, change):
        return samples.with_keys(drive, free, v + change).turn(ANGLES + phi).errors

    slope = _differences(lambda h: errors(h, 0.0 * v), 1e-3) / 1e-3
    assert by_angle == pytest.approx(slope, rel=1e-6, abs=1e-9)
    for k, one in enumerate(np.eye(len(v))):
        slope = _differences(lambda c, one=one: errors(0.0, c * one), steps[k]) / steps[k]
        assert np.asarray(by_key)[:, k] == pytest.approx(slope, rel=1e-5, abs=1e-6 * np.abs(by_key).max())
    backwards = jax.vmap(jax.grad(lambda phi, v: at(phi, v).error, 1), (0, None))(ANGLES, v)
    assert np.array_equal(backwards, by_key)


@pytest.mark.parametrize("name", FREE)
def test_derivatives_of_the_whole_drive_are_those_of_its_errors_and_backlash(name):
    """The ratio of the drive is that of its teeth and the slope of the error; keys by differences."""
    drive, free, v, steps = _free(name)
    whole = cycle(drive, free)
    slopes = jax.vmap(jax.jacfwd(lambda phi, v: whole(phi, v)[:3], (0, 1)), (0, None))(ANGLES, v)
    own = samples.with_keys(drive, free, v)
    seen = own.cycle(ANGLES)
    assert np.asarray(slopes[0][0]) == pytest.approx(seen.drive.ratios - own.ratio, rel=1e-6, abs=1e-12)
    coast = np.isfinite(seen.coast.errors)
    assert np.asarray(slopes[1][0])[coast] == pytest.approx(seen.coast.ratios[coast] - own.ratio, rel=1e-6, abs=1e-12)
    assert np.isnan(np.asarray(slopes[1][0])[~coast]).all()

    def values(change):
        found = samples.with_keys(drive, free, v + change).cycle(ANGLES)
        return np.stack([found.drive.errors, found.coast.errors, found.backlash])

    for k, one in enumerate(np.eye(len(v))):
        expected = _differences(lambda c, one=one: values(c * one), steps[k]) / steps[k]
        exact = np.stack([np.asarray(by_key)[:, k] for _, by_key in slopes])
        assert np.array_equal(np.isnan(exact), np.isnan(expected))
        assert exact == pytest.approx(expected, rel=1e-5, abs=1e-6 * np.nanmax(np.abs(exact)), nan_ok=True)


def test_a_fit_by_gradients_finds_the_misalignment_that_was_measured():
    """Gauss and Newton's method on errors at a few angles, in JAX alone."""
    drive, key, hidden = Drive.load("plain-zk"), ("misalignment.center_distance_mm",), 0.03
    angles = np.linspace(-0.4, 0.4, 7)
    measured = samples.with_keys(drive, key, np.array([hidden])).turn(angles).errors
    at = follow(drive, key)
    residual = jax.jit(lambda v: jax.vmap(lambda phi: at(phi, v).error)(angles) - measured)
    slopes, v = jax.jit(jax.jacfwd(residual)), jax.numpy.zeros(1)
    for _ in range(6):
        v = v - jax.numpy.linalg.lstsq(slopes(v), residual(v))[0]
    assert float(v[0]) == pytest.approx(hidden, abs=1e-9)


def test_what_is_no_design_and_no_angle_has_no_contact_and_no_derivative():
    at = follow(Drive.load("recess-action-full"), ("design.hob_pitch_radius_mm",))
    for phi, v in ((0.1, [-1.0]), (1e13, [20.06]), (np.nan, [20.06]), (0.1, [np.nan])):
        found, slope = at(phi, v), jax.grad(lambda v, phi=phi: at(phi, v).error)(jax.numpy.array(v))
        assert np.isnan(found.error) and np.isnan(slope).all() and int(found.status) < 0


@pytest.mark.parametrize(
    ("free", "words"),
    [
        (("design.worm_threads",), "does not vary"),
        (("blank.worm_tip_radius_mm",), "no derivatives"),
        ("design.hob_pitch_radius_mm", "give a tuple"),
        (("design.nothing",), "design.nothing"),
    ],
)
def test_a_key_that_cannot_be_free_is_refused_in_words(free, words):
    with pytest.raises((DesignError, UsageError), match=words):
        follow(Drive.load("recess-action-full"), free)


def test_wrong_shapes_and_single_precision_are_refused_in_words():
    at = follow(Drive.load("recess-action-full"), ("misalignment.axial_mm",))
    with pytest.raises(UsageError, match=r"give shapes \(\) and \(1,\)"):
        at(np.zeros(3), [0.0])
    jax.config.update("jax_enable_x64", False)
    try:
        with pytest.raises(UsageError, match="single precision"):
            at(0.0, [0.0])
    finally:
        jax.config.update("jax_enable_x64", True)


def test_without_jax_the_import_says_what_brings_it():
    program = "import sys; sys.modules['jax'] = None; import meshwright.jax"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.returncode == 1 and "pip install 'meshwright[jax]'" in done.stderr.splitlines()[-1]


def test_a_drive_without_free_keys_is_a_function_of_the_angle_alone():
    drive = Drive.load("helical-crowned")
    found = jax.jit(jax.vmap(follow(drive)))(ANGLES)
    assert np.array_equal(found.error, drive.turn(ANGLES).errors)
