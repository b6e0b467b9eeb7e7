"""The identities behind cylindrical gears are proved; some are shown to be false with one sign changed."""

import inspect
from dataclasses import replace

import pytest

from derive.audit.identities import cylindrical_gears
from derive.audit.identities.cylindrical_gears import CHAPTER
from derive.prove import Outcome, decide

#: Claim, a definition that it rests on or its own equations, and a text of these with one sign or name changed. What is
#: read from the description is changed in tests/audit/test_described.py.
ITSELF = ""
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


def statements(claim):
    return [claim.scope.statement(claim.key, text) for texts in claim.read().values() for text in texts]


@pytest.mark.parametrize("claim", CHAPTER.claims, ids=lambda claim: claim.key)
def test_every_identity_is_proved(claim):
    assert all(decide(s).outcome is Outcome.PROVED for s in statements(claim))


@pytest.mark.parametrize(("key", "name", "change"), WRONG)
def test_one_sign_the_other_way_is_refuted(key, name, change):
    claim = next(c for c in CHAPTER.claims if c.key == key)
    texts, scope = [text for reading in claim.read().values() for text in reading], claim.scope
    if name:
        text = next(line for line in inspect.getsource(cylindrical_gears).splitlines() if line.startswith(f"{name} = "))
        wrong = text.replace(*change)
        assert wrong != text
        own = {name: scope.read(wrong.split(" = ", 1)[1])}
        scope = replace(scope, definitions=dict(scope.definitions) | own)
    else:
        changed = [text.replace(*change) for text in texts]
        assert changed != texts
        texts = changed
    assert Outcome.REFUTED in {decide(scope.statement(key, text)).outcome for text in texts}
