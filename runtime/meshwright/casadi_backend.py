"""CasADi as second backend: the same runtime, with the drive's equations evaluated by CasADi functions.

The generated ``.casadi`` file is read back, its derivatives are CasADi's own, and the model table's function
pointers lead here. Only the arithmetic differs from the C backend; solver, statuses and geometry are the same.
"""

from dataclasses import dataclass, field
from functools import cache

import numpy as np

from meshwright._library import SHIPPED, ffi, model


def _numpy(pointer, count):
    return np.frombuffer(ffi.buffer(pointer, 8 * count), dtype=float)


@dataclass
class _Functions:
    """CasADi functions of one drive and the callbacks that keep them reachable from C."""

    description: dict
    nx: int
    np_: int
    values: object
    jacobian: object
    start: object
    start_columns: list
    callbacks: list = field(default_factory=list)


def _functions(description):
    import casadi

    name = description["name"]
    values = casadi.Function.load(str(SHIPPED / f"{name}.casadi"))
    nx, count = len(description["unknowns"]), len(description["parameters"])
    p, phi, x = casadi.SX.sym("p", count), casadi.SX.sym("phi"), casadi.SX.sym("x", nx)
    out = dict(zip(values.name_out(), values(p, phi, x), strict=True))
    columns = description["start_unknowns"]
    y = [x[k] for k in columns]
    start_jacobian = casadi.jacobian(out["start_residual"], casadi.vertcat(*y)) if y else casadi.SX(0, 0)
    return _Functions(
        description,
        nx,
        count,
        values,
        casadi.Function("J", [p, phi, x], [out["residual"], casadi.jacobian(out["residual"], x)]),
        casadi.Function("start", [p, phi, x], [out["start_residual"], start_jacobian]),
        columns,
    )


@cache
def _cached(name):
    from meshwright import metadata

    description = metadata.drives()[name]
    return _table(_functions(description), model(name))


def model_of(description):
    """A model table whose functions are CasADi's. Its state is the parameters followed by the input angle."""
    return _cached(description["name"])[0]


def _table(f, compiled):
    """A copy of the compiled model table with the arithmetic replaced; returns it with what must stay alive."""
    table = ffi.new("mw_model *", compiled[0])
    table.ns = f.np_ + 1

    def callback(signature):
        def wrap(function):
            handle = ffi.callback(signature, function)
            f.callbacks.append(handle)
            return handle

        return wrap

    def inputs(s):
        state = _numpy(s, f.np_ + 1)
        return state[: f.np_], state[f.np_]

    def call(s, x, name):
        p, phi = inputs(s)
        names = f.values.name_out()
        return np.asarray(f.values(p, phi, x)[names.index(name)]).ravel()

    def unknowns(y):
        x = np.zeros(f.nx)
        x[f.start_columns] = _numpy(y, len(f.start_columns))
        return x

    @callback("int(const double *, double *)")
    def setup(p, s):
        _numpy(s, f.np_ + 1)[: f.np_] = _numpy(p, f.np_)
        guards = call(s, np.zeros(f.nx), "guards")
        failed = np.flatnonzero(~(guards > 0.0))
        return int(failed[0]) + 1 if failed.size else 0

    @callback("void(double *, double)")
    def set_phi(s, phi):
        _numpy(s, f.np_ + 1)[f.np_] = phi

    @callback("void(const double *, const double *, double *, double *)")
    def evaluate(s, x, residual, jacobian):
        p, phi = inputs(s)
        r, j = f.jacobian(p, phi, _numpy(x, f.nx))
        _numpy(residual, f.nx)[:] = np.asarray(r).ravel()
        if jacobian != ffi.NULL:
            _numpy(jacobian, f.nx**2)[:] = np.asarray(j).ravel()

    @callback("double(const double *, double *)")
    def step(s, x):
        p, phi = inputs(s)
        values = _numpy(x, f.nx)
        r, j = f.jacobian(p, phi, values)
        try:
            change = np.linalg.solve(np.asarray(j), np.asarray(r).ravel())
        except np.linalg.LinAlgError:
            return float("nan")
        values -= change
        return float(np.sum(np.abs(change / call(s, values, "scale"))))

    @callback("void(const double *, double *)")
    def scale(s, x):
        _numpy(x, f.nx)[:] = call(s, np.zeros(f.nx), "scale")

    @callback("void(const double *, double *)")
    def guess(s, y):
        _numpy(y, len(f.start_columns))[:] = call(s, np.zeros(f.nx), "start_guess")

    @callback("void(const double *, double *)")
    def start_scale(s, y):
        _numpy(y, len(f.start_columns))[:] = call(s, np.zeros(f.nx), "scale")[f.start_columns]

    @callback("void(const double *, const double *, double *, double *)")
    def start_evaluate(s, y, residual, jacobian):
        p, phi = inputs(s)
        r, j = f.start(p, phi, unknowns(y))
        n = len(f.start_columns)
        _numpy(residual, n)[:] = np.asarray(r).ravel()
        if jacobian != ffi.NULL:
            _numpy(jacobian, n * n)[:] = np.asarray(j).ravel()

    @callback("void(const double *, const double *, double *)")
    def start_solution(s, y, x):
        _numpy(x, f.nx)[:] = call(s, unknowns(y), "start_solution")

    @callback("void(const double *, const double *, double *)")
    def observe(s, x, o):
        _numpy(o, compiled.no)[:] = call(s, _numpy(x, f.nx), "observation")

    table.setup, table.set_phi, table.eval, table.step, table.scale = setup, set_phi, evaluate, step, scale
    table.guess, table.start_scale, table.start_eval = guess, start_scale, start_evaluate
    table.start_solution, table.observe = start_solution, observe
    return table, f
