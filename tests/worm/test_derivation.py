"""What the derivation itself guarantees for every flank form: explicit surfaces, helicoids exactly."""

import pytest
import sympy as sp

from derive import drives
from derive.drives.cylindrical_worm import TOOLS
from derive.language import vectors as v
from derive.language.chain import screw
from derive.prove import Outcome, Statement, decide
from derive.prove.tree import parse
from tests.quick import quick

NAMES = [n for n in drives.catalogue() if n.startswith("cylindrical_worm_") and not n.endswith("_reground")]


def test_every_form_serves_as_worm_and_as_hob():
    assert len(TOOLS) == 5 and len(NAMES) == 25


@pytest.mark.parametrize("name", quick(NAMES, *NAMES[::5]))
def test_reduction_makes_worm_and_wheel_explicit_whatever_the_forms(name):
    drive = drives.catalogue()[name]()
    for body in drive.bodies:
        assert body.surface.conditions == ()
        assert len(body.surface.parameters) == 2
    assert len(drive.unknowns) == len(drive.residual) == 5


def _helicoid_condition(point, normal, parameter):
    """n·(k × r + p k), which vanishes on a helicoid of screw parameter p."""
    return v.dot(normal, v.add(v.cross(v.K, point), v.scale(parameter, v.K)))


def _behind(symbols, definitions):
    """The symbols that are defined, and those behind their definitions."""
    found = symbols & definitions.keys()
    return found.union(*(_behind(definitions[k].free_symbols, definitions) for k in found))


def _decide(expression, definitions, equal_to=0):
    needed = _behind(sp.sympify(expression).free_symbols, definitions)
    named = {str(k): parse(str(definitions[k]), {}) for k in needed if not definitions[k].has(sp.atan2)}
    statement = Statement(
        "helicoid", parse(str(expression), {}), parse(str(equal_to), {}), named, {}, frozenset({"s"})
    )
    return decide(statement).outcome


@pytest.mark.parametrize("form", ["ZA", "ZN", "ZK"])
def test_the_helicoid_condition_holds_exactly(form):
    """Decided by the prover for symbolic data; ZI and ZC below, where an inverse tangent stands in between."""
    drive = drives.catalogue()[f"cylindrical_worm_{form.lower()}_{form.lower()}"]()
    flank = drive.pinion.surface
    lead, r = sp.Symbol("lambda_worm", real=True), sp.Symbol("r_worm", real=True)
    condition = _helicoid_condition(flank.point, flank.normal, r * sp.tan(lead))
    assert _decide(condition, dict(drive.definitions.items())) is Outcome.PROVED
    wrong = _helicoid_condition(flank.point, flank.normal, 2 * r * sp.tan(lead))
    assert _decide(wrong, dict(drive.definitions.items())) is Outcome.REFUTED


def test_any_profile_in_screw_motion_is_a_helicoid():
    """The normal is a cross product with the screw's own velocity: so for ZI, and for every profile whatever."""
    a, b, p = sp.symbols("a_x a_y a_z"), sp.symbols("P_x P_y P_z"), sp.Symbol("p")
    velocity = screw(sp.Symbol("psi"), p).local_velocity(sp.Symbol("psi"), b)
    assert sp.expand(_helicoid_condition(b, v.cross(a, velocity), p)) == 0


def test_the_arc_ground_form_is_a_helicoid_because_its_meshing_equation_may_be_formed_at_the_arc_centre():
    """ZC: the helicoid condition at the point equals the equation of meshing at any other point of the normal."""
    point, normal = sp.symbols("x y z"), sp.symbols("n_x n_y n_z")
    p, rho = sp.symbols("p rho")
    centre = v.add(point, v.scale(rho, normal))
    difference = _helicoid_condition(point, normal, p) - _helicoid_condition(centre, normal, p)
    assert sp.expand(difference) == 0
