"""What is read of a solved contact: points, normals, tangents, limits, curvature of the gap, lever arms.

Input: a drive's equations on a tape. Output: named results, and where those of each body are found among them.
"""

from collections.abc import Iterable

from derive.language.drive import Body
from derive.language.origin import Origin
from derive.passes import geometry
from derive.passes.flanks import margin, regular, second_form, slopes, vector
from derive.passes.plan import BodyOutputs, Observed, Output, Reduced

#: What the instantaneous ratio divides by.
LEVER = Origin("derivation/quotient", "lever arm of the wheel")


def observe(plan: Reduced) -> Observed:
    """The equations with all that is read of a contact."""
    plan, drive = plan.copy(), plan.drive
    found: list[Output] = []
    for body in drive.bodies:
        placed = body.placed
        normal, _ = geometry.unit(plan.tape, vector(plan, placed.body_normal))
        found.append(Output(f"point_{body.name}_f", tuple(vector(plan, placed.body_point)), "mm", "f"))
        found.append(Output(f"normal_{body.name}_f", tuple(normal), "", "f"))
    for body in drive.bodies:
        local = tuple(vector(plan, body.surface.body_point))
        if body.point:
            plan.lower.stand(body.point, local)
        found.append(Output(f"point_{body.name}", local, "mm", body.name))
    found.append(Output("wheel_angle", (plan.lower(drive.turned),), "rad", "f"))
    for body in drive.bodies:
        found += (Output(f"{q}", (plan.lower(q),), q.unit, q.frame) for q in body.recovered)
    bodies: dict[str, BodyOutputs] = {}
    for body in drive.bodies:
        outputs, bodies[body.name] = _body(plan, body, _count(found))
        found += outputs
    return Observed(**vars(plan), observed=(*found, *_contact(plan)), bodies=bodies)


def _body(plan: Reduced, body: Body, at: int) -> tuple[list[Output], BodyOutputs]:
    """Derivatives of the point by the surface parameters, fixed frame; of its conditions; its margins: the results that
    begin at place ``at``.
    """
    tape = plan.tape
    parameters = [plan.lower(p) for p in body.surface.parameters]
    point = vector(plan, body.placed.body_point)
    found: list[Output] = []
    for symbol, parameter in zip(body.surface.parameters, parameters, strict=True):
        tangent = [tape.derivative(i, parameter) for i in point]
        found.append(Output(f"tangent_{symbol}", tuple(tangent), f"mm/({symbol.unit})", "f"))
    found += (Output(f"condition_{body.name}_{k}", s) for k, s in enumerate(slopes(plan, body.surface)))
    singular = at + _count(found)
    found.append(Output(f"regular_{body.name}", (regular(plan, body),)))
    found += (Output(f"margin_{body.name}_{m.event}", (margin(plan, body, m),)) for m in body.margins)
    margins = tuple(singular + 1 + k for k in range(len(body.margins)))
    return found, BodyOutputs(len(parameters), len(body.surface.conditions), at, singular, margins)


def _contact(plan: Reduced) -> list[Output]:
    """Second fundamental forms of both flanks and of the gap in one tangent basis, its curvatures; lever arms.

    The basis is that of the pinion's first tangent and the contact normal, the pinion's outward normal; both arms are
    those of the pinion's point, which is the wheel's.
    """
    drive, tape = plan.drive, plan.tape
    pinion, _ = drive.bodies
    normal, _ = geometry.unit(tape, vector(plan, pinion.placed.body_normal))
    points = [vector(plan, body.placed.body_point) for body in drive.bodies]
    first = plan.lower(pinion.surface.parameters[0])
    basis = geometry.tangent_basis(tape, normal, [tape.derivative(i, first) for i in points[0]])
    forms = [second_form(plan, body.placed, basis) for body in drive.bodies]
    entries = [tape.sub(tape.neg(a), b) for a, b in zip(*forms, strict=True)]
    gap = entries[0], entries[1], entries[2]
    arms = [
        geometry.lever_arm(plan, body, variable, points[0], normal)
        for body, variable in zip(drive.bodies, (drive.instant, drive.error), strict=True)
    ]
    with tape.within(LEVER):
        ratio = tape.div(*arms)
    return [
        Output("tangent_basis", (*basis[0], *basis[1]), "", "f"),
        *(Output(f"second_form_{b.name}", form, "1/mm", "f") for b, form in zip(drive.bodies, forms, strict=True)),
        Output("second_form_gap", gap, "1/mm", "f"),
        Output("curvature_gap", geometry.principal_curvatures(tape, gap), "1/mm"),
        *(Output(f"lever_arm_{body.name}", (arm,), "mm") for body, arm in zip(drive.bodies, arms, strict=True)),
        Output("instantaneous_ratio", (ratio,)),
    ]

def _count(outputs: Iterable[Output]) -> int:
    return sum(len(o.nodes) for o in outputs)
