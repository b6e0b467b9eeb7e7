"""The identities behind cylindrical gears are proved; some are shown to be false with one sign changed."""

import inspect
from dataclasses import replace

import pytest

from derive.audit.identities import cylindrical_gears
from derive.audit.identities.cylindrical_gears import CHAPTER
from derive.prove import Outcome, decide

#: Claim, a definition that it rests on, and the text of that definition with one sign or name changed.
WRONG = [
    ("curvature", "normal_l", ("d(turn", "-d(turn")),
    ("curvature", "rho", ("r*sin_t +", "r*sin_t -")),
    ("zi-worm", "turn_a", ("[s*sin(a)", "[-s*sin(a)")),
    ("zi-worm", "worm_height", ("/cos(a) - a", "/cos(a) + a")),
    ("zi-worm", "linear", ("psi - sin", "psi + sin")),
    ("screw-symmetry", "r2", ("z2", "z1")),
    ("parallel-crowned", "ratio", ("-s*cos", "s*cos")),
    ("parallel-crowned", "straight", ("+ xm", "- xm")),
]


def statements(claim):
    return [claim.scope.statement(claim.key, text) for texts in claim.read().values() for text in texts]


@pytest.mark.parametrize("claim", CHAPTER.claims, ids=lambda claim: claim.key)
def test_every_identity_is_proved(claim):
    assert all(decide(s).outcome is Outcome.PROVED for s in statements(claim))


@pytest.mark.parametrize(("key", "name", "change"), WRONG)
def test_one_change_is_refuted(key, name, change):
    claim = next(c for c in CHAPTER.claims if c.key == key)
    text = next(line for line in inspect.getsource(cylindrical_gears).splitlines() if line.startswith(f"{name} = "))
    wrong, right = text.replace(*change).split(" = ", 1)[1], text.split(" = ", 1)[1]
    assert wrong != right
    scope = replace(claim.scope, definitions=dict(claim.scope.definitions) | {name: claim.scope.read(wrong)})
    outcomes = {decide(scope.statement(key, text)).outcome for texts in claim.read().values() for text in texts}
    assert Outcome.REFUTED in outcomes
