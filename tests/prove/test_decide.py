"""The prover decides: true identities are proved, false ones refuted by numbers, and neither back end matters."""

import math
from fractions import Fraction

import pytest

from derive.prove import Outcome, Statement, decide
from derive.prove.polynomial import BACKENDS
from derive.prove.tree import NotationError, parse

PROFILE = {"xi": ("u",), "eta": ("u",), "zeta": ("u",)}


def claim(text, definitions=None, jets=None, signs=()):
    left, right = text.split(" = ")
    jets = jets or {}
    return Statement(
        text,
        parse(left, jets),
        parse(right, jets),
        {name: parse(tree, jets) for name, tree in (definitions or {}).items()},
        jets,
        frozenset(signs),
    )


TRUE = [
    "sin(a + b) = sin(a)*cos(b) + cos(a)*sin(b)",
    "cos(2*a) = 1 - 2*sin(a)**2",
    "R*cos(a) - R = -2*R*sin(a/2)**2",
    "tan(a)**2 + 1 = 1/cos(a)**2",
    "sin(pi/2 - a) = cos(a)",
    "cos(a + 3*pi/2) = sin(a)",
    "Rz(a)@Rz(b) = Rz(a + b)",
    "T(Rx(a))@Rx(a) = mat([1, 0, 0], [0, 1, 0], [0, 0, 1])",
    "Rx(pi)@Ry(a) = Ry(-a)@Rx(pi)",
    "cross(u, cross(v, w)) = v*dot(u, w) - w*dot(u, v)",
    "sqrt(r**2 - h**2)**2 = r**2 - h**2",
    "d(sqrt(r**2 - h**2), h) = -h/sqrt(r**2 - h**2)",
    "d(tan(a), a) = 1 + tan(a)**2",
    "d(d(sin(a)*a**2, a), a) = 2*sin(a) + 4*a*cos(a) - a**2*sin(a)",
    "(1/x - 1/y)*x*y = y - x",
    "d(atan2(y, x), x) = -y/(x**2 + y**2)",
    "d(sin(turn)*t, t) = sin(turn) + t*rate*cos(turn)",
]
VECTORS = {name: f"vec({name}1, {name}2, {name}3)" for name in "uvw"} | {"turn": "rate*t"}


@pytest.mark.parametrize("text", TRUE)
def test_true_identity_is_a_theorem(text):
    assert decide(claim(text, VECTORS)).outcome is Outcome.PROVED


@pytest.mark.parametrize(
    "text",
    [
        "sin(a + b) = sin(a)*cos(b) - cos(a)*sin(b)",
        "cos(a/2)**2 = (1 - cos(a))/2",
        "Rx(a)@Rz(b) = Rz(b)@Rx(a)",
        "cross(u, v) = cross(v, u)",
        "s*x = x",
        "d(a*cos(a), a) = cos(a) + a*sin(a)",
        "sqrt(x**2 + y**2) = x + y",
    ],
)
def test_false_identity_is_refuted_by_a_point(text):
    decision = decide(claim(text, VECTORS, signs="s"))
    assert decision.outcome is Outcome.REFUTED
    assert decision.instance.lhs != decision.instance.rhs


def test_counterexample_is_what_a_calculator_shows():
    """The recorded numbers are those of ordinary trigonometry at the recorded angle."""
    instance = decide(claim("x*sin(a) = x*cos(a)")).instance
    angle = 2 * math.atan(float(instance.point.half_tangents["a"]))
    x = float(instance.point.symbols["x"])
    assert float(instance.lhs[0]) == pytest.approx(x * math.sin(angle), rel=1e-14)
    assert float(instance.rhs[0]) == pytest.approx(x * math.cos(angle), rel=1e-14)
    assert isinstance(instance.lhs[0], Fraction)


def test_root_of_a_square_is_not_the_base():
    """sqrt(cos^2) is |cos|: not a theorem, and at an angle with positive cosine not refuted either."""
    assert decide(claim("sqrt(cos(a)**2) = cos(a)")).outcome is Outcome.UNDECIDED


def test_one_proof_covers_every_profile():
    helicoid = {
        "r": "Rz(psi)@vec(xi, eta, zeta) + vec(0, 0, p*psi)",
        "n": "cross(d(r, u), d(r, psi))",
    }
    assert (
        decide(claim("dot(n, cross(vec(0, 0, 1), r) + vec(0, 0, p)) = 0", helicoid, PROFILE)).outcome is Outcome.PROVED
    )
    assert (
        decide(claim("dot(n, cross(vec(0, 0, 1), r) - vec(0, 0, p)) = 0", helicoid, PROFILE)).outcome is Outcome.REFUTED
    )


def test_a_sign_stands_for_both_flanks():
    assert decide(claim("(s*x + y)*(s*x - y) = x**2 - y**2", signs="s")).outcome is Outcome.PROVED


def test_denominators_become_side_conditions():
    decision = decide(claim("(x**2 - y**2)/(x - y) = x + y"))
    assert decision.outcome is Outcome.PROVED
    assert len(decision.components[0].denominators) == 1


def test_division_by_an_identical_zero_is_an_error():
    with pytest.raises(ZeroDivisionError):
        decide(claim("x/(y - y) = x"))


@pytest.mark.skipif(len(BACKENDS) < 2, reason="python-flint is not installed")
@pytest.mark.parametrize("text", [*TRUE, "x*sin(a) = cos(b)/x", "d(sqrt(x**2 + y), x)*tan(a) = 1"])
def test_both_back_ends_give_the_same_normal_form(text):
    first, *others = (
        (found.names, [(c.remainder, c.denominators) for c in found.components])
        for found in (decide(claim(text, VECTORS), backend) for backend in BACKENDS)
    )
    assert all(other == first for other in others)


@pytest.mark.parametrize(
    "text", ["x = __import__('os')", "f(x) = x", "x = 1.5", "x[1] = x", "cos(x*y) = 1", "x**y = x", "sin(pi/7 + a) = 0"]
)
def test_what_the_grammar_does_not_contain_is_an_error(text):
    with pytest.raises(NotationError):
        decide(claim(text))
