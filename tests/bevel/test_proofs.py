"""The identities behind the bevel description are proved, and each of them false with one sign the other way."""

import inspect
from dataclasses import replace

import pytest

from derive.audit.identities import bevel
from derive.audit.identities.bevel import CHAPTER
from derive.prove import Outcome, decide

#: Claim, a definition that it rests on, and the text of that definition with one sign changed.
WRONG = [
    ("meshing", "screw", ("axis, r_gen - origin) - H*k", "axis, r_gen - origin) + H*k")),
    ("meshing", "screw", ("h*cross(k, r_gen)", "-h*cross(k, r_gen)")),
    ("meshing", "screw", ("- h*rate", "+ h*rate")),
    ("regular", "twice", ("2*a*AV", "-2*a*AV")),
    ("regular", "f_t", ("+ dot(N, VV)", "- dot(N, VV)")),
    ("edge-normal", "arc", ("kappa)*t0 - (2", "kappa)*t0 + (2")),
    ("swung-edge", "swung", ("secant)*t0 - (", "secant)*t0 + (")),
    ("pole", "pole", ("(u0 + X)", "(u0 - X)")),
    ("hand", "r_other", ("vec(0, -h*Em", "vec(0, h*Em")),
    ("rotation-of-blade", "turn_sum", ("cos(theta + j), -h", "cos(theta - j), -h")),
    ("formate-cradle", "axis_of_work", ("-cos(Sigma)", "cos(Sigma)")),
    ("assembly-axis", "half", ("[-1, 0, 0]", "[1, 0, 0]")),
    ("fillet-join", "joint", ("1 - sin", "1 + sin")),
    ("cone-normal", "n0", ("0, -sin(alpha)", "0, sin(alpha)")),
    ("stand-off", "swung", ("secant)*t0 - (", "secant)*t0 + (")),
    ("rounding", "m_round", ("0, -sin(alpha + lam)", "0, sin(alpha + lam)")),
    ("tangent-cones", "wider", ("- change*radial", "+ change*radial")),
    ("scale", "base_larger", ("c*XB + c*H", "c*XB + H")),
    ("crown", "axis", ("0, sin(gamma)", "0, -sin(gamma)")),
    ("offset", "hypoid", ("vec(0, E, 0)", "vec(0, -E, 0)")),
]


def statements(claim):
    return [claim.scope.statement(claim.key, text) for texts in claim.read().values() for text in texts]


@pytest.mark.parametrize("claim", CHAPTER.claims, ids=lambda claim: claim.key)
def test_every_identity_is_proved(claim):
    assert all(decide(s).outcome is Outcome.PROVED for s in statements(claim))


@pytest.mark.parametrize(("key", "name", "change"), WRONG)
def test_one_sign_the_other_way_is_refuted(key, name, change):
    claim = next(c for c in CHAPTER.claims if c.key == key)
    text = next(line for line in inspect.getsource(bevel).splitlines() if line.startswith(f"{name} = "))
    wrong, right = text.replace(*change).split(" = ", 1)[1], text.split(" = ", 1)[1]
    assert wrong != right
    scope = replace(claim.scope, definitions=dict(claim.scope.definitions) | {name: claim.scope.read(wrong)})
    outcomes = {decide(scope.statement(key, text)).outcome for texts in claim.read().values() for text in texts}
    assert Outcome.REFUTED in outcomes
