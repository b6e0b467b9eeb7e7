"""The identities behind cylindrical gears are proved; some are shown to be false with one sign changed."""

import pytest

from derive.audit.identities import cylindrical_gears
from derive.audit.identities.cylindrical_gears import CHAPTER
from derive.prove import Outcome
from tests.prove.chapters import ITSELF, outcomes_changed, proved

#: Claim, a definition that it rests on or its own equations, and a text of these with one sign or name changed. What is
#: read from the description is changed in tests/audit/test_described.py.
WRONG = [
    ("curvature", "normal_l", ("d(turn", "-d(turn")),
    ("curvature", "rho", ("r*sin_t +", "r*sin_t -")),
    ("zi-worm", "turn_a", ("[s*sin(a)", "[-s*sin(a)")),
    ("zi-worm", "w", ("ap - sin", "ap + sin")),
    ("zi-worm", "linear", ("psi - sin", "psi + sin")),
    ("screw-symmetry", ITSELF, ("z2/r2", "z2/r1 + z2/r2")),
    ("parallel-crowned", "ratio", ("-s*cos", "s*cos")),
    ("parallel-crowned", "straight", ("+ xm", "- xm")),
]


@pytest.mark.parametrize("claim", CHAPTER.claims, ids=lambda claim: claim.key)
def test_every_identity_is_proved(claim):
    assert proved(claim)


@pytest.mark.parametrize(("key", "name", "change"), WRONG)
def test_one_sign_the_other_way_is_refuted(key, name, change):
    assert Outcome.REFUTED in outcomes_changed(CHAPTER, cylindrical_gears, key, name, change)
