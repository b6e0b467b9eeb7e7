"""The identities behind the bevel description are proved, and each of them false with one sign the other way."""

import pytest

from derive.audit.identities import bevel
from derive.audit.identities.bevel import CHAPTER
from derive.prove import Outcome
from tests.prove.chapters import ITSELF, outcomes_changed, proved

#: Claim, a definition that it rests on or its own equations, and a text of these with one sign changed. What is read
#: from the description is changed in tests/audit/test_described.py.
WRONG = [
    ("meshing", ITSELF, ("- H*k", "+ H*k")),
    ("meshing", ITSELF, ("cross(k, gen_", "cross(-k, gen_")),
    ("meshing", ITSELF, ("+ base_", "- base_")),
    ("regular", "twice", ("2*a*AV", "-2*a*AV")),
    ("regular", "f_t", ("+ dot(N, VV)", "- dot(N, VV)")),
    ("edge-normal", ITSELF, ("- sin(t)*d(arc", "+ sin(t)*d(arc")),
    ("swung-edge", ITSELF, ("t0 - kappa", "t0 + kappa")),
    ("pole", "pole", ("(u0 + X)", "(u0 - X)")),
    ("linear", "f", ("+ cross(omega, swung)", "+ X*cross(omega, swung)")),
    ("hand", "reflect", ("[0, -1, 0]", "[0, 1, 0]")),
    ("rotation-of-blade", ITSELF, (" = d", " = -d")),
    ("plain-roll", ITSELF, ("R*cross(k", "R*cross(-k")),
    ("formate-cradle", "flip", ("[0, -1, 0]", "[0, 1, 0]")),
    ("assembly-axis", ITSELF, ("= -cross", "= cross")),
    ("fillet-join", ITSELF, ("1 - sin", "1 + sin")),
    ("cone-normal", ITSELF, ("d(cone, u)", "d(cone, u) + n_cone")),
    ("stand-off", ITSELF, ("= -kappa", "= kappa")),
    ("rounding", ITSELF, ("- at_centre.z", "+ at_centre.z")),
    ("tangent-cones", "wider", ("- change*radial", "+ change*radial")),
    ("scale", ITSELF, ("= c*", "= -c*")),
    ("crown", ITSELF, ("cos(gamma)", "-cos(gamma)")),
    ("offset", ITSELF, ("vec(0, E, 0)", "vec(0, -E, 0)")),
    ("hobbed-crown", ITSELF, ("work - index", "work + index")),
    ("hobbed-crown", ITSELF, ("phi - nu", "nu - phi")),
    ("epicycloid", ITSELF, ("q + nu + theta", "q + nu - theta")),
    ("epicycloid", "reference_pinion", ("s*u0", "-s*u0")),
    ("hobbed-milled", "reference_gear", ("-s*u0", "s*u0")),
]


@pytest.mark.parametrize("claim", CHAPTER.claims, ids=lambda claim: claim.key)
def test_every_identity_is_proved(claim):
    assert proved(claim)


@pytest.mark.parametrize(("key", "name", "change"), WRONG)
def test_one_sign_the_other_way_is_refuted(key, name, change):
    assert Outcome.REFUTED in outcomes_changed(CHAPTER, bevel, key, name, change)
