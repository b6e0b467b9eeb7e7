"""Each identity of bevel and cylindrical gears is false with one sign the other way."""

import inspect
from dataclasses import replace

import pytest

from derive.audit.identities import bevel, cylindrical_gears
from derive.prove import Outcome, decide

#: In the place of a definition's name: the claim's own equations.
ITSELF = ""


def outcomes_changed(chapter, module, key, name, change):
    """Outcomes of the claim ``key`` of ``chapter``, whose source is ``module``, with one text put in another's place in
    the definition ``name`` or, ``ITSELF``, in its own equations.
    """
    claim = next(c for c in chapter.claims if c.key == key)
    texts, scope = [text for reading in claim.read().values() for text in reading], claim.scope
    if name == ITSELF:
        changed = [text.replace(*change) for text in texts]
        assert changed != texts
        texts = changed
    else:
        text = next(line for line in inspect.getsource(module).splitlines() if line.startswith(f"{name} = "))
        wrong = text.replace(*change)
        assert wrong != text
        own = {name: scope.read(wrong.split(" = ", 1)[1])}
        scope = replace(scope, typed=scope.definitions | own, described=dict, extends=None)
    return {decide(scope.statement(key, text)).outcome for text in texts}


#: Claim, a definition that it rests on or its own equations, and a text of these with one sign or name changed. What is
#: read from the description is changed in tests/audit/test_described.py.
WRONG = {
    bevel: [
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
    ],
    cylindrical_gears: [
        ("curvature", "normal_l", ("d(turn", "-d(turn")),
        ("curvature", "rho", ("r*sin_t +", "r*sin_t -")),
        ("zi-worm", "turn_a", ("[s*sin(a)", "[-s*sin(a)")),
        ("zi-worm", "w", ("ap - sin", "ap + sin")),
        ("zi-worm", "linear", ("psi - sin", "psi + sin")),
        ("screw-symmetry", ITSELF, ("z2/r2", "z2/r1 + z2/r2")),
        ("parallel-crowned", "ratio", ("-s*cos", "s*cos")),
        ("parallel-crowned", "straight", ("+ xm", "- xm")),
    ],
}


@pytest.mark.parametrize(("module", "wrong"), [(module, wrong) for module, listed in WRONG.items() for wrong in listed])
def test_one_sign_the_other_way_is_refuted(module, wrong):
    assert Outcome.REFUTED in outcomes_changed(module.CHAPTER, module, *wrong)
