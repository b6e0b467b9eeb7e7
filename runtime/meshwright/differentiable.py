"""CasADi as the design tool: contact analysis as a differentiable function of a drive's parameters.

:func:`differentiable_tca` is implicit in the contact residual, so its derivatives are exact at the solution.
:func:`parameters` lets what follows from a free parameter follow it: rules and design systems are those of the drive,
generated.
Lengths in mm, angles in rad, except where a design key names its unit.
"""

from pathlib import Path

import casadi
import numpy as np

from meshwright.base.errors import UsageError
from meshwright.design import design as designs

#: Largest residual (mm of position, components of unit normals) of what counts as a contact.
RESIDUAL = 1e-9

#: Steps in which the path of a design system is followed.
PATH_STEPS = 16

_NEWTON = {"abstol": 1e-12, "abstolStep": 1e-14, "max_iter": 30, "error_on_fail": False, "show_eval_warnings": False}


def differentiable_tca(description, mirrored=False):
    """Contact of the drive described (:mod:`meshwright.design.description`) as a CasADi function of its parameters.

    ``mirrored`` as in :class:`~meshwright.design.design.Design`: pinion angle and transmission error are those of the
    left-hand drive, everything else is that of the right-hand drive, its mirror image.

    In: ``p`` complete parameter vector, ``phi`` pinion angle, ``x0`` start values of the unknowns, near the contact
    that is meant: Newton's method has no cold start here, :meth:`meshwright.Drive.trace` has.

    Out: ``x`` unknowns; ``error`` transmission error; ``observation`` as ``outputs`` of the description lists it;
    ``curvatures`` (smaller, larger) relative principal curvatures, 1/mm; ``semi_axes`` (major, minor) of the contact
    ellipse; ``guards`` of the design, positive where it is legal; ``residual`` its largest component where the
    iteration ended. Where that exceeds :data:`RESIDUAL`, or is not a number, every output but ``guards`` and
    ``residual`` is NaN.
    """
    sign = -1.0 if mirrored else 1.0
    values, p, phi, x, out = _generated(description)
    at = next(o["offset"] for o in description["outputs"] if o["name"] == "curvature_gap")
    curvatures = out["observation"][at : at + 2]
    at_contact = {
        "x": x,
        "error": sign * x[description["error"]],
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
    turned = sign * phi
    *seen, guards, residual = look(p, turned, solver(x0=x0, p=casadi.vertcat(p, turned))["x"])
    touches = residual <= RESIDUAL
    names = [*at_contact, "guards", "residual"]
    results = [*(casadi.if_else(touches, value, np.nan) for value in seen), guards, residual]
    return casadi.Function(f"{description['name']}_tca", [p, phi, x0], results, ["p", "phi", "x0"], names)


def parameters(design, free):
    """CasADi function v → p: the parameter vector of a :class:`~meshwright.design.design.Design` with keys left free.

    ``free`` are places such as ``"design.pinion_helix_angle_deg"``, ``v`` their values in the units of the keys. What
    the design leaves open follows from ``v`` by the drive's rules and design systems, as it does when a design file
    is read; where a design system has no regular solution, what it would give is NaN. Raises
    :class:`~meshwright.base.errors.UsageError` for an unknown place.
    """
    description = design.description
    if isinstance(free, str) or len({*free}) < len(free):
        raise UsageError(f"free = {free!r}: give a tuple of different places, each table.key")
    given = designs.given_vector(design)
    places = [_place(description, key) for key in free]
    known = ~np.isnan(given)
    known[places] = True
    v, p = casadi.SX.sym("v", len(free)), casadi.SX(given)
    for k, place in enumerate(places):
        p[place] = v[k] * description["parameters"][place]["factor"]
    first = casadi.Function("given", [v], [_by_rules(description, p, known)])
    symbols = casadi.MX.sym("v", len(free))
    p = first(symbols)
    for system in description["systems"]:
        filled = [k for k in system["fills"] if not known[k]]
        if filled:
            p = _by_system(description, system, p, known)
    return casadi.Function("parameters", [symbols], [p], ["v"], ["p"])


def _by_rules(description, p, known):
    """The parameters (SX) with what follows from the known ones by defaults and rules; ``known`` is updated."""
    _, q, _, _, out = _generated(description)
    rules = casadi.Function("rules", [q], [out["rules"]])
    needs = np.array(casadi.DM(rules.jac_sparsity(0, 0), 1.0)) > 0.0
    for k, target in enumerate(description["rules"]):
        if not known[target] and known[needs[k]].all():
            p[target], known[target] = rules(p)[k], True
    return p


def _by_system(description, system, p, known):
    """The parameters (MX) with what a design system and then the rules give; ``known`` is updated."""
    q, values = casadi.SX.sym("p", p.numel()), casadi.SX.sym("values", len(system["fills"]))
    filled = casadi.SX(q)
    for k, target in enumerate(system["fills"]):
        if not known[target]:
            filled[target], known[target] = values[k], True
    then = casadi.Function("then", [q, values], [_by_rules(description, filled, known)])
    return then(p, _system_values(description, system)(p))


def _system_values(description, system):
    """CasADi function p → values of a design system, its solution followed along its path in equal steps."""
    name = f"{description['name']}_{system['name']}"
    generated = _loaded(description, name)
    p, path, y = (casadi.SX.sym(q, generated.size1_in(q)) for q in ("p", "path", "y"))
    out = dict(zip(generated.name_out(), generated(p, path, y), strict=True))
    regular = casadi.logic_all(casadi.vertcat(casadi.norm_inf(out["residual"]) <= RESIDUAL, out["watch"] > 0.0))
    look = casadi.Function("look", [p, path, y], [out["guess"], out["values"], regular])
    solver = casadi.rootfinder(
        name, "newton", {"x": y, "p": casadi.vertcat(p, path), "g": out["residual"]}, _NEWTON
    )

    p = casadi.MX.sym("p", p.numel())
    y, legal = look(p, 0.0, np.zeros(len(system["unknowns"])))[0], True
    for path in np.linspace(0.0, 1.0, PATH_STEPS + 1):
        y = solver(x0=y, p=casadi.vertcat(p, path))["x"]
        legal = casadi.logic_and(legal, look(p, path, y)[2])
    return casadi.Function(name, [p], [casadi.if_else(legal, look(p, 1.0, y)[1], np.nan)])


def _generated(description):
    """The generated function of a drive, symbols for its inputs p, phi, x, and its outputs by name."""
    values = _loaded(description, description["name"])
    inputs = [casadi.SX.sym(name, values.size1_in(name)) for name in values.name_in()]
    return values, *inputs, dict(zip(values.name_out(), values(*inputs), strict=True))


def _loaded(description, name):
    return casadi.Function.load(str(Path(description["folder"]) / f"{name}.casadi"))


def _place(description, key):
    """Index of a parameter by ``table.key``."""
    places = {f"{p['table']}.{p['key']}": k for k, p in enumerate(description["parameters"])}
    if key not in places:
        raise UsageError(f"{key}: {description['name']} has no such parameter; use one of {', '.join(places)}")
    return places[key]
