"""Print a schedule as CasADi functions: the same tapes over CasADi's SX symbols."""

import tempfile
from functools import partial
from pathlib import Path

import casadi

from derive.language.drive import PATH


class _Symbolic:
    """CasADi's operations on SX; its operators look for the types of their arguments first, ten times as long."""

    add, sub, mul, div, atan2 = (
        partial(casadi.SX.binary, code)
        for code in (casadi.OP_ADD, casadi.OP_SUB, casadi.OP_MUL, casadi.OP_DIV, casadi.OP_ATAN2)
    )
    neg, sqrt, sin, cos = (
        partial(casadi.SX.unary, code) for code in (casadi.OP_NEG, casadi.OP_SQRT, casadi.OP_SIN, casadi.OP_COS)
    )

    @staticmethod
    def sign(a):
        return 1 - 2 * (a < 0)


def function(plan):
    """CasADi function of a drive: (p, phi, x) → residual, observation, placement, start residual, start values, guards,
    rules.

    ``placement`` are the results of the drive's function of that name at phi and the wheel angle. The unknowns of the
    start system are read from their places in x. Derivatives are left to CasADi. ``rules`` are the values of the
    defaults and rules that complete a design, each from p alone, in the order in which they run.
    """
    drive, tape = plan.drive, plan.tape
    p, phi, x, inputs = _symbols(plan)
    [wheel_angle] = tape.evaluate([plan.lower(drive.turned)], inputs, _Symbolic)
    inputs |= dict(zip(plan.placement.parameters, (phi, wheel_angle), strict=True))

    def vector(nodes):
        return casadi.vertcat(*tape.evaluate(nodes, inputs, _Symbolic))

    results = {
        "residual": vector(plan.residual),
        "observation": vector([i for o in plan.observed for i in o.nodes]),
        "placement": vector([i for o in plan.placement.outputs for i in o.nodes]),
        "start_residual": vector(plan.start_residual),
        "start_solution": vector(plan.start_solution),
        "start_guess": vector(plan.start_guess),
        "scale": vector(plan.scales),
        "guards": vector([g.node for g in plan.guards]),
        "rules": casadi.vertcat(*plan.completion.tape.evaluate(plan.completion.nodes, inputs, _Symbolic)),
    }
    return casadi.Function(drive.name, [p, phi, x], list(results.values()), ["p", "phi", "x"], list(results))


def edges(plan):
    """CasADi function (p, phi, x) → residual of each system of edge contact, by its name."""
    p, phi, x, inputs = _symbols(plan)
    rows = plan.tape.evaluate(plan.edges.equations, inputs, _Symbolic)
    results = {s.name: casadi.vertcat(*(rows[k] for k in s.equations)) for s in plan.edges.systems}
    name = f"{plan.drive.name}_edges"
    return casadi.Function(name, [p, phi, x], list(results.values()), ["p", "phi", "x"], list(results))


def surfaces(plan):
    """CasADi function of what a drive offers beside its contact: p and, of each surface and function, its own arguments
    under ``q_`` and its name → the results under its name; of a surface also ``curvature_``. Named as in the C header:
    ``flank_pinion``, ``fillet_wheel``, …; slopes of limits are left to CasADi, like all derivatives.
    """
    p, *_, inputs = _symbols(plan)
    arguments, results = {"p": p}, {}

    def put(name, parameters, groups):
        q = arguments[f"q_{name}"] = casadi.SX.sym(f"q_{name}", len(parameters))
        own = inputs | {symbol: q[k] for k, symbol in enumerate(parameters)}
        for result, nodes in groups.items():
            results[result] = casadi.vertcat(*plan.tape.evaluate(nodes, own, _Symbolic))

    for surface in (*plan.flanks, *plan.regions):
        name = f"{surface.region}_{surface.body}"
        put(name, surface.parameters, {name: _nodes(surface.outputs), f"curvature_{name}": _nodes(surface.curvature)})
    for f in plan.functions:
        put(f.name, f.parameters, {f.name: _nodes(f.outputs)})
    name = f"{plan.drive.name}_surfaces"
    return casadi.Function(name, list(arguments.values()), list(results.values()), list(arguments), list(results))


def _nodes(outputs):
    return [i for o in outputs for i in o.nodes]


def _symbols(plan):
    """Symbols p, phi and x of a drive, and what they stand for: symbol of the drive → SX."""
    p = casadi.SX.sym("p", len(plan.drive.parameters))
    phi = casadi.SX.sym("phi")
    x = casadi.SX.sym("x", len(plan.unknowns))
    inputs = {q.symbol: p[k] for k, q in enumerate(plan.drive.parameters)} | {plan.drive.instant: phi}
    return p, phi, x, inputs | {u: x[k] for k, u in enumerate(plan.unknowns)}


def system_function(drive, plan):
    """CasADi function of a design system: (p, path, y) → residual, guess, scale, values that it fills in, watch.

    ``watch`` must be positive along the path; it is empty if there is nothing to watch.
    """
    p, path = casadi.SX.sym("p", len(drive.parameters)), casadi.SX.sym("path")
    y = casadi.SX.sym("y", len(plan.unknowns))
    inputs = {q.symbol: p[k] for k, q in enumerate(drive.parameters)} | {PATH: path}
    inputs |= {u: y[k] for k, u in enumerate(plan.unknowns)}
    results = {
        name: casadi.vertcat(*plan.tape.evaluate(nodes, inputs, _Symbolic))
        for name, nodes in (
            ("residual", plan.residual),
            ("guess", plan.guess),
            ("scale", plan.scales),
            ("values", plan.values),
            ("watch", [] if plan.watch is None else [plan.watch]),
        )
    }
    name = f"{drive.name}_{plan.system.name}"
    return casadi.Function(name, [p, path, y], list(results.values()), ["p", "path", "y"], list(results))


def texts(plan):
    """The drive's function, those of its design systems, of its surfaces and of its edges as ``casadi.Function.load``
    reads them, by name.
    """
    functions = [function(plan), *(system_function(plan.drive, system) for system in plan.systems), surfaces(plan)]
    functions += [edges(plan)] if plan.edges.systems else []
    return {f.name(): _text(f) for f in functions}


def _text(saved):
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "function.casadi"
        saved.save(str(path))
        return path.read_text(encoding="ascii")
