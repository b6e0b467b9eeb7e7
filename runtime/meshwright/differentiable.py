"""CasADi as the design tool: contact analysis as a differentiable function of a drive's parameters.

:func:`differentiable_tca` is implicit in the contact residual, so its derivatives are exact at the solution.
:func:`parameters` lets what follows from a free parameter follow it: the rules are those of the drive, generated.
Lengths in mm, angles in rad, right-hand drive, except where a design key names its unit.
"""

import casadi
import numpy as np

from meshwright import design as designs
from meshwright._library import SHIPPED
from meshwright.errors import UsageError

#: Largest residual (mm of position, components of unit normals) of what counts as a contact.
RESIDUAL = 1e-9

_NEWTON = {"abstol": 1e-12, "abstolStep": 1e-14, "max_iter": 30, "error_on_fail": False}


def differentiable_tca(description):
    """Contact of the drive described (:mod:`meshwright.metadata`) as a CasADi function of its parameters.

    In: ``p`` complete parameter vector, ``phi`` pinion angle, ``x0`` start values of the unknowns, near the contact
    that is meant: Newton's method has no cold start here, :meth:`meshwright.Drive.trace` has.

    Out: ``x`` unknowns; ``error`` transmission error; ``observation`` as ``outputs`` of the description lists it;
    ``curvatures`` (smaller, larger) relative principal curvatures, 1/mm; ``semi_axes`` (major, minor) of the contact
    ellipse; ``guards`` of the design, positive where it is legal; ``residual`` its largest component where the
    iteration ended. Where that exceeds :data:`RESIDUAL`, or is not a number, every output but ``guards`` and
    ``residual`` is NaN.
    """
    values, p, phi, x, out = _generated(description)
    curvatures = relative_curvatures(description, out["observation"])
    at_contact = {
        "x": x,
        "error": x[description["error"]],
        "observation": out["observation"],
        "curvatures": curvatures,
        "semi_axes": casadi.sqrt(2 * p[_place(description, "contact.separation_mm")] / curvatures),
    }
    look = casadi.Function("look", [p, phi, x], [*at_contact.values(), out["guards"], casadi.norm_inf(out["residual"])])
    solver = casadi.rootfinder(
        "contact", "newton", {"x": x, "p": casadi.vertcat(p, phi), "g": out["residual"]}, _NEWTON
    )

    p, phi = casadi.MX.sym("p", values.size1_in("p")), casadi.MX.sym("phi")
    x0 = casadi.MX.sym("x0", values.size1_in("x"))
    *seen, guards, residual = look(p, phi, solver(x0=x0, p=casadi.vertcat(p, phi))["x"])
    touches = residual <= RESIDUAL
    names = [*at_contact, "guards", "residual"]
    results = [*(casadi.if_else(touches, value, np.nan) for value in seen), guards, residual]
    return casadi.Function(f"{description['name']}_tca", [p, phi, x0], results, ["p", "phi", "x0"], names)


def parameters(design, free):
    """CasADi function v → p: the parameter vector of a :class:`~meshwright.design.Design` with keys left free.

    ``free`` are places such as ``"design.hob_pitch_radius_mm"``, ``v`` their values in the units of the keys. What
    the design leaves open follows from ``v`` by the drive's rules, as it does when a design file is read. Raises
    :class:`~meshwright.errors.UsageError` for an unknown place and for a drive that completes its designs by solving
    equations.
    """
    description = design.description
    if description["systems"]:
        names = ", ".join(system["name"] for system in description["systems"])
        raise UsageError(f"{description['name']}: designs are completed by solving equations ({names}), not by rules")
    _, q, _, _, out = _generated(description)
    rules = casadi.Function("rules", [q], [out["rules"]])
    needs = np.array(casadi.DM(rules.jac_sparsity(0, 0), 1.0)) > 0.0

    given = designs.given_vector(design)
    known, p = ~np.isnan(given), casadi.SX(given)
    v = casadi.SX.sym("v", len(free))
    for k, key in enumerate(free):
        place = _place(description, key)
        p[place], known[place] = v[k] * description["parameters"][place]["factor"], True
    for k, target in enumerate(description["rules"]):
        if not known[target] and known[needs[k]].all():
            p[target], known[target] = rules(p)[k], True
    return casadi.Function("parameters", [v], [p], ["v"], ["p"])


def relative_curvatures(description, observation):
    """Smaller and larger principal curvature of the gap, 1/mm, from an observation: CasADi expressions (2).

    Positive without interference. The contact normal is the pinion's outward normal.
    """
    pinion, wheel = description["bodies"]
    normal = observation[3:6]
    along = observation[pinion["at"] : pinion["at"] + 3]
    along -= casadi.dot(along, normal) * normal
    along /= casadi.norm_2(along)
    basis = casadi.horzcat(along, casadi.cross(normal, along)).T
    gap = -_second_form(pinion, observation, basis) - _second_form(wheel, observation, basis)
    mean, half = (gap[0, 0] + gap[1, 1]) / 2, (gap[0, 0] - gap[1, 1]) / 2
    radius = casadi.sqrt(half**2 + gap[0, 1] ** 2)
    largest = mean + radius
    smallest = casadi.if_else(mean > 0.0, (gap[0, 0] * gap[1, 1] - gap[0, 1] ** 2) / largest, mean - radius)
    return casadi.vertcat(smallest, largest)


def _second_form(body, observation, basis):
    """Second fundamental form (2, 2) along the body's own outward normal, in a basis (2, 3) of the tangent plane.

    The normal turns by −K times the way along the surface: for all parameter changes n that keep the conditions,
    slopes·n = 0, turnings·n = −K tangents·n. With multipliers λ that is [K λ] [tangents; slopes] = −turnings.
    """
    count, at = len(body["parameters"]), body["at"]
    derivatives = casadi.reshape(observation[at : at + 6 * count], 6, count)
    tangents, turnings = basis @ derivatives[:3, :], basis @ derivatives[3:, :]
    end = at + 6 * count
    slopes = casadi.reshape(observation[end : end + body["conditions"] * count], count, body["conditions"]).T
    form = (-turnings @ casadi.inv_minor(casadi.vertcat(tangents, slopes)))[:, :2]
    return (form + form.T) / 2


def _generated(description):
    """The generated function of a drive, symbols for its inputs p, phi, x, and its outputs by name."""
    values = casadi.Function.load(str(SHIPPED / f"{description['name']}.casadi"))
    inputs = [casadi.SX.sym(name, values.size1_in(name)) for name in values.name_in()]
    return values, *inputs, dict(zip(values.name_out(), values(*inputs), strict=True))


def _place(description, key):
    """Index of a parameter by ``table.key``."""
    places = {f"{p['table']}.{p['key']}": k for k, p in enumerate(description["parameters"])}
    if key not in places:
        raise UsageError(f"{key}: {description['name']} has no such parameter; use one of {', '.join(places)}")
    return places[key]
