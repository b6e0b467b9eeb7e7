"""What is read anywhere on a flank or another region of a tooth: point, normal, tangents, limits, curvature, and what
limits and surfaces are beyond their tangents.

Input: a drive's equations on a tape. Output: tables of nodes, functions of the surface's own parameters.
"""

from collections.abc import Iterable
from itertools import combinations_with_replacement

import sympy as sp

from derive.language.drive import Body, Margin, Region
from derive.language.origin import Origin
from derive.language.surface import Surface
from derive.passes import check, geometry
from derive.passes.equations import fixed
from derive.passes.plan import Derived, Expansion, Flank, Output
from derive.passes.singular import singular_function


def flank(plan: Derived, body: Body) -> Flank:
    """The :class:`~derive.passes.plan.Flank` of a body."""
    limits = [Output(f"margin_{m.event}", (margin(plan, body, m),)) for m in body.margins]
    outputs, curvature = _surface(plan, body.surface, body.name, regular(plan, body), limits)
    return Flank(body.name, tuple(body.surface.parameters), outputs, curvature)


def region(plan: Derived, of: Region) -> Flank:
    """The :class:`~derive.passes.plan.Flank` of another region of a member."""
    singular = plan.tape.mul(plan.lower(of.regular), singular_function(plan.lower, of.surface))
    limits = [Output(f"margin_{m.event}", (plan.lower(m.positive),)) for m in of.margins]
    outputs, curvature = _surface(plan, of.surface, of.member, singular, limits)
    return Flank(of.member, tuple(of.surface.parameters), outputs, curvature, of.name)


def expansion(plan: Derived, of: Flank, *, second: bool) -> Expansion:
    """The :class:`~derive.passes.plan.Expansion` of a flank or region."""
    tape, parameters = plan.tape, [plan.lower(p) for p in of.parameters]
    rising = [[tape.derivative(i, p) for p in parameters] for i in of.limits]
    check.derives("expansion", tape, of.limits, parameters, rising)
    point = next(o.nodes for o in of.outputs if o.name == "point")
    pairs = [
        (tape.derivative(i, p), q)
        for i in (*point, *of.limits, *of.conditions)
        for p, q in combinations_with_replacement(parameters, 2)
        if second
    ]
    bent = tuple(tape.derivative(i, q) for i, q in pairs)
    for q in parameters:
        own = [(i, slope) for (i, by), slope in zip(pairs, bent, strict=True) if by == q]
        check.derives("expansion", tape, [i for i, _ in own], [q], [[slope] for _, slope in own])
    return Expansion(of, tuple(i for row in rising for i in row), bent)


def regular(plan: Derived, body: Body) -> int:
    """Node that is positive where a body's flank is regular."""
    if body.regular is not None:
        return plan.tape.mul(plan.lower(body.regular), singular_function(plan.lower, body.surface))
    return _relative(plan, body, singular_function(plan.lower, body.surface))


def margin(plan: Derived, body: Body, of: Margin) -> int:
    """A margin in terms of surface parameters; body coordinates stand for the surface's own."""
    node = plan.lower(of.positive)
    if of.along is not None:
        node = plan.tape.derivative(node, plan.lower(of.along))
    return _relative(plan, body, node) if of.relative else node


def _relative(plan: Derived, body: Body, node: int) -> int:
    at_reference = fixed(plan.lower, node, body.reference)
    with plan.tape.within(Origin("derivation/relative", f"the same at the reference point of the {body.name}")):
        return plan.tape.div(node, at_reference)


def vector(plan: Derived, components: Iterable[sp.Expr]) -> list[int]:
    """Nodes of a vector."""
    return [plan.lower(c) for c in components]


def slopes(plan: Derived, surface: Surface) -> list[tuple[int, ...]]:
    """Derivatives of each implicit condition of a surface by its parameters."""
    parameters = [plan.lower(p) for p in surface.parameters]
    conditions = [plan.lower(c) for c in surface.conditions]
    found = [tuple(plan.tape.derivative(c, p) for p in parameters) for c in conditions]
    check.derives("conditions", plan.tape, conditions, parameters, found)
    return found


def second_form(plan: Derived, surface: Surface, basis: geometry.Basis) -> geometry.Form:
    """Nodes of a surface's second fundamental form in a basis of its tangent plane."""
    parameters = [plan.lower(p) for p in surface.parameters]
    point, normal = vector(plan, surface.body_point), vector(plan, surface.body_normal)
    return geometry.second_form(plan.tape, parameters, point, normal, slopes(plan, surface), basis)


def _surface(
    plan: Derived, surface: Surface, frame: str, singular: int, limits: Iterable[Output]
) -> tuple[tuple[Output, ...], tuple[Output, ...]]:
    """What is known at the parameters of a surface, and its curvature there, body frame."""
    normal, _ = geometry.unit(plan.tape, vector(plan, surface.body_normal))
    parameters = [plan.lower(p) for p in surface.parameters]
    point = vector(plan, surface.body_point)
    outputs = [
        Output("point", tuple(point), "mm", frame),
        Output("normal", tuple(normal), "", frame),
        *(
            Output(f"tangent_{s}", tuple(plan.tape.derivative(i, p) for i in point), f"mm/({s.unit})", frame)
            for s, p in zip(surface.parameters, parameters, strict=True)
        ),
        Output("regular", (singular,)),
        *limits,
    ]
    for k, (condition, row) in enumerate(zip(surface.conditions, slopes(plan, surface), strict=True)):
        outputs += [Output(f"condition_{k}", (plan.lower(condition),)), Output(f"condition_{k}_slopes", row)]
    basis = geometry.tangent_basis(plan.tape, normal, outputs[2].nodes)
    form = second_form(plan, surface, basis)
    curvature = (
        Output("tangent_basis", (*basis[0], *basis[1]), "", frame),
        Output("second_form", form, "1/mm", frame),
        Output("curvature", geometry.principal_curvatures(plan.tape, form), "1/mm"),
    )
    return tuple(outputs), curvature
