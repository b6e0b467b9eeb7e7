"""Equations of meshing that are solved in closed form: a pin that rolls along in a ring, in 30 digits."""

import random

import pytest
import sympy as sp

from derive.language.chain import Rz, translation
from derive.language.definitions import Definitions
from derive.language.envelope import envelope, explicit_turn, in_turn
from derive.language.surface import swept
from derive.language.symbols import Quantity, rotation_angle

xi, z = Quantity("xi", "rad", "angle about the pin"), Quantity("z", "mm", "along the pin")
phi = rotation_angle("phi", "turn of the wheel with the pin")


def rolled(distance, radius, pin, ratio):
    """The envelope of a pin at ``radius`` on a wheel that turns by φ at a distance from a ring turning by ratio·φ."""
    section = (radius + pin * sp.cos(xi), pin * sp.sin(xi), sp.Integer(0))
    tube = swept(Definitions(), section, translation(z=z), along=xi, sweep=z, outward=-1)
    return envelope(tube, Rz(-ratio * phi) @ translation(x=distance) @ Rz(phi), phi)


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("seed", range(4))
def test_a_turn_solves_the_equation_of_meshing_between_minus_and_plus_half_a_revolution(seed, sign):
    rng = random.Random(seed)
    distance, radius, pin, ratio = (sp.Rational(rng.randint(100, 900), 100) for _ in range(4))
    ratio /= 10
    surface = rolled(distance, radius, pin, ratio)
    (condition,) = surface.conditions
    solved = explicit_turn(surface, phi, sign)
    assert solved.conditions == () and solved.parameters == (xi, z)
    root = next(solved.definitions.resolve(symbol) for symbol, _ in solved.definitions.items() if symbol.name == "phi")
    found = 0
    for k in range(12):
        at = {xi: sp.Rational(k, 2) - sp.Rational(59, 20)}
        turn = sp.N(root.subs(at), 30)
        if not turn.is_real:
            continue
        found += 1
        assert abs(sp.N(condition.subs({**at, phi: turn}), 30)) < 1e-25
        assert -sp.pi <= turn <= sp.pi
    assert found


def test_what_is_linear_in_cosine_and_sine_only_multiplied_out_is_seen():
    a, b, c = sp.symbols("a b c", real=True)
    cosine, sine = sp.cos(phi), sp.sin(phi)
    form = (a * cosine + 1) * (cosine - b * sine) + a * b * sine * cosine + a * sine**2 + c * sine
    assert [sp.expand(q) for q in in_turn(form, phi)] == [1, c - b, a]
    with pytest.raises(ValueError, match="not linear in the cosine and sine"):
        in_turn(form + cosine * sine, phi)
