"""An identity of bevel and cylindrical gears is false with one sign of a definition the other way."""

import inspect
from dataclasses import replace

import pytest

from derive.audit.identities import bevel, cylindrical_gears
from derive.prove import Outcome, decide


def outcomes_changed(chapter, module, key, name, change):
    """Outcomes of the claim ``key`` of ``chapter``, whose source is ``module``, with one text put in another's place in
    the definition ``name``.
    """
    claim = next(c for c in chapter.claims if c.key == key)
    text = next(line for line in inspect.getsource(module).splitlines() if line.startswith(f"{name} = "))
    wrong = text.replace(*change)
    assert wrong != text
    own = {name: claim.scope.read(wrong.split(" = ", 1)[1])}
    scope = replace(claim.scope, typed=claim.scope.definitions | own, described=dict, extends=None)
    texts = [text for reading in claim.read().values() for text in reading]
    return {decide(scope.statement(key, text)).outcome for text in texts}


#: Claim, a definition that it rests on, and a text of this with one sign or name changed. The claims' own equations are
#: changed in tests/audit/test_mutations.py, what is read from the description in tests/audit/test_described.py.
WRONG = {
    bevel: [
        ("regular", "twice", ("2*a*AV", "-2*a*AV")),
        ("regular", "f_t", ("+ dot(N, VV)", "- dot(N, VV)")),
        ("pole", "pole", ("(u0 + X)", "(u0 - X)")),
        ("linear", "f", ("+ cross(omega, swung)", "+ X*cross(omega, swung)")),
        ("hand", "reflect", ("[0, -1, 0]", "[0, 1, 0]")),
        ("formate-cradle", "flip", ("[0, -1, 0]", "[0, 1, 0]")),
        ("tangent-cones", "wider", ("- change*radial", "+ change*radial")),
        ("epicycloid", "reference_pinion", ("s*u0", "-s*u0")),
        ("hobbed-milled", "reference_gear", ("-s*u0", "s*u0")),
    ],
    cylindrical_gears: [
        ("curvature", "normal_l", ("d(turn", "-d(turn")),
        ("curvature", "rho", ("r*sin_t +", "r*sin_t -")),
        ("zi-worm", "turn_a", ("[s*sin(a)", "[-s*sin(a)")),
        ("zi-worm", "w", ("ap - sin", "ap + sin")),
        ("zi-worm", "linear", ("psi - sin", "psi + sin")),
        ("parallel-crowned", "ratio", ("-s*cos", "s*cos")),
        ("parallel-crowned", "straight", ("+ xm", "- xm")),
    ],
}


@pytest.mark.parametrize(("module", "wrong"), [(module, wrong) for module, listed in WRONG.items() for wrong in listed])
def test_one_sign_the_other_way_is_refuted(module, wrong):
    assert Outcome.REFUTED in outcomes_changed(module.CHAPTER, module, *wrong)
