"""The chain language: products, merging, velocities, and the equation of meshing as a sum of powers."""

import mpmath
import pytest
import sympy as sp

from derive.language import vectors as v
from derive.language.chain import Motion, Rotation, Rx, Ry, Rz, placement, screw, station, swing, translation
from derive.language.differentiate import partial
from derive.language.replace import replaced

a, b, p, q, t = sp.symbols("a b p q t", real=True)
POINT = sp.symbols("x y z", real=True)
NUMBERS = dict(
    zip(
        (a, b, p, q, t, *POINT),
        map(sp.Rational, ("0.7", "-1.3", "2.5", "0.4", "0.9", "1.1", "-2.2", "3.3")),
        strict=True,
    )
)


DIGITS = {symbol: sp.Float(number, 40) for symbol, number in NUMBERS.items()}


def _close(left, right):
    for lhs, rhs in zip(left, right, strict=True):
        difference = replaced(lhs, DIGITS) - replaced(rhs, DIGITS)
        assert abs(sp.N(difference, 30, chop=1e-28)) < 1e-25


CHAINS = [
    Rz(a) @ Rz(b) @ translation(z=p * b),
    Rx(a) @ translation(q, p * a, 0) @ Ry(b) @ screw(t, p),
    translation(x=-p) @ swing("y", a * b, (p, 0, q)) @ Rz(b),
    Rz(-a) @ placement((0, 1, 0), (-1, 0, 0), (0, 0, 1), (p, q, 3)) @ Rx(b),
    station(p, q, 1) @ Ry(sp.pi / 2) @ Rz(a * b) @ translation(y=b**2) @ swing("x", b, (q, 2, p)) @ station(y=t),
    Rz(b + t) @ Ry(p) @ translation(q, 1, b * p) @ Rz(q + b) @ translation(x=p) @ Rx(q) @ Ry(t) @ Rz(a),
    Rx(t) @ Rz(a * b) @ Ry(q) @ swing("x", b**2, (q, 2, p)) @ Rz(p)
    @ placement((0, 1, 0), (-1, 0, 0), (0, 0, 1), (p, q, 3)) @ Ry(a) @ Rx(b) @ translation(z=p) @ Ry(q),
]


@pytest.mark.parametrize("motion", CHAINS)
@pytest.mark.parametrize("variable", [a, b])
def test_local_velocity_is_the_derivative_turned_into_the_body(motion, variable):
    moved = motion.point(POINT)
    derivative = tuple(partial(c, variable) for c in moved)
    _close(motion.direction(motion.local_velocity(variable, POINT)), derivative)


@pytest.mark.parametrize("motion", CHAINS)
@pytest.mark.parametrize("variable", [a, b])
def test_turn_and_advance_give_the_velocity_of_every_point(motion, variable):
    turn, advance = motion.screw(variable)
    _close(v.add(advance, v.cross(turn, POINT)), motion.local_velocity(variable, POINT))


@pytest.mark.parametrize("motion", CHAINS)
def test_power_is_the_normal_component_of_the_velocity(motion):
    normal = (sp.Rational(1, 3), q, sp.Integer(2))
    derivative = tuple(partial(c, b) for c in motion.point(POINT))
    _close([motion.power(b, POINT, normal)], [v.dot(motion.direction(normal), derivative)])


@pytest.mark.parametrize("motion", CHAINS)
def test_a_motion_is_one_factor_after_the_other(motion):
    point, direction = POINT, POINT
    for factor in reversed(motion.factors):
        point, direction = factor.point(point), factor.direction(direction)
    _close(motion.point(POINT), point)
    _close(motion.direction(POINT), direction)


def test_a_motion_has_no_power_in_what_does_not_move_it():
    assert [motion.power(sp.Symbol("c"), POINT, v.I) for motion in CHAINS] == [0] * len(CHAINS)


@pytest.mark.parametrize("motion", CHAINS)
def test_the_inverse_undoes_a_motion(motion):
    _close(motion.inverse().point(motion.point(POINT)), POINT)


def test_rotations_about_one_axis_merge_through_a_translation_along_it():
    motion = Rz(a) @ translation(z=p) @ Rz(b)
    assert [f.angle for f in motion.factors if isinstance(f, Rotation)] == [a + b]


def test_opposite_rotations_vanish():
    assert (Rz(a) @ Rz(-a)) == Motion()


def test_substitution_merges_what_becomes_equal():
    motion = Rz(a) @ Rx(t) @ Rz(b)
    assert motion.substitute({t: sp.Integer(0)}) == Rz(a + b)
    assert (Rz(a) @ Rz(b)).substitute({b: -a}) == Motion()


def test_a_station_moves_left_and_changes_no_point():
    near = Ry(sp.pi / 2) @ Rz(a) @ translation(y=b) @ station(p, q, t) @ Rx(b)
    plain = Ry(sp.pi / 2) @ Rz(a) @ translation(y=b) @ translation(p, q, t) @ Rx(b)
    assert [type(f).__name__ for f in near.factors] == ["Station", "Rotation", "Swing", "Translation", "Rotation"]
    _close(near.point(POINT), plain.point(POINT))
    _close(near.direction(POINT), plain.direction(POINT))


def test_stations_of_chains_that_meet_cancel_as_symbols():
    """A body on a far axis, seen from another chain to the same place: what is left vanishes with the motion."""
    met = (station(p, q, t) @ Rx(b)).inverse() @ Rz(a) @ station(p, q, t)
    assert not [f for f in met.factors if type(f).__name__ == "Station"]
    assert all(c == 0 for c in met.substitute({a: sp.Integer(0), b: sp.Integer(0)}).point((0, 0, 0)))


def test_swings_about_one_axis_merge():
    assert Rz(a) @ Rx(0) @ station(x=p) == station(x=p) @ swing("z", a, (-p, 0, 0))
    assert swing("z", a, (p, 0, 0)) @ swing("z", -a, (p, 0, 0)) == Motion()


def test_a_swing_about_a_far_axis_keeps_its_digits():
    radius, point = 1e12, (0.5, 0.0, 0.0)
    r = sp.Symbol("r", real=True)
    moved = swing("y", sp.Float(2) / r, (-r, 0, 0)).point(tuple(map(sp.sympify, point)))
    function = sp.lambdify(r, moved, "math")
    x, _, z = function(radius)
    with mpmath.workdps(50):
        exact = (mpmath.mpf(radius) + 0.5) * mpmath.cos(2 / mpmath.mpf(radius)) - mpmath.mpf(radius)
        assert x == pytest.approx(float(exact), abs=1e-15)
        assert z == pytest.approx(float(-(mpmath.mpf(radius) + 0.5) * mpmath.sin(2 / mpmath.mpf(radius))), abs=1e-15)
