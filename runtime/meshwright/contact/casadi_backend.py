"""CasADi as second backend: the same runtime, with the drive's equations evaluated by CasADi functions.

The generated ``.casadi`` file is read back, its derivatives are CasADi's own, and the model table's function
pointers lead here. Only the arithmetic differs from the C backend; solver, statuses and geometry are the same.
"""

from functools import cache
from pathlib import Path

import numpy as np

from meshwright.base.library import callback, ffi, model
from meshwright.design import description as metadata

#: Entries of the model table that are replaced; each is the name of a method of :class:`_Arithmetic`.
REPLACED = (
    "setup", "set_phi", "eval", "step", "along", "scale", "guess", "start_scale", "start_eval", "start_solution",
    "observe",
)  # fmt: skip


def model_of(design):
    """A model table whose functions are CasADi's. Its state is the parameters followed by the input angle."""
    return _table(design.description["name"], design.places)[0]


@cache
def _table(name, places):
    """A copy of the compiled model table with the arithmetic replaced; returns it with what must stay alive."""
    compiled = model(name, places)
    arithmetic = _Arithmetic(metadata.described(name, places), compiled)
    table = ffi.new("mw_model *", compiled[0])
    table.ns, table.memory = arithmetic.parameters + 1, -1
    table.kernels = table.anchor = table.by_anchor = ffi.NULL  # of the compiled arithmetic
    callbacks = {key: callback(ffi.typeof(getattr(table, key)), getattr(arithmetic, key)) for key in REPLACED}
    for key, function in callbacks.items():
        setattr(table, key, function)
    return table, callbacks


def _numpy(pointer, count):
    return np.frombuffer(ffi.buffer(pointer, 8 * count), dtype=float)


class _Arithmetic:
    """The functions of a model table (``mw_model.h``) on pointers, evaluated by CasADi."""

    def __init__(self, description, compiled):
        import casadi

        self.values = casadi.Function.load(str(Path(description["folder"]) / f"{description['name']}.casadi"))
        self.names = self.values.name_out()
        self.unknowns, self.parameters = len(description["unknowns"]), len(description["parameters"])
        self.observed = compiled.no
        self.columns = description["start_unknowns"]
        p, phi, x = casadi.SX.sym("p", self.parameters), casadi.SX.sym("phi"), casadi.SX.sym("x", self.unknowns)
        out = dict(zip(self.names, self.values(p, phi, x), strict=True))
        y = casadi.vertcat(*(x[k] for k in self.columns))
        self.contact = casadi.Function("contact", [p, phi, x], _with_jacobian(casadi, out["residual"], x))
        v = casadi.SX.sym("v", self.unknowns + 1)
        derivatives = _along(casadi, out["residual"], casadi.vertcat(x, phi), v)
        self.directional = casadi.Function("directional", [p, phi, x, v], derivatives)
        self.start = casadi.Function("start", [p, phi, x], _with_jacobian(casadi, out["start_residual"], y))

    def setup(self, p, s):
        _numpy(s, self.parameters)[:] = _numpy(p, self.parameters)
        failed = np.flatnonzero(~(self._value("guards", s) > 0.0))
        return int(failed[0]) + 1 if failed.size else 0

    def set_phi(self, s, phi):
        _numpy(s, self.parameters + 1)[-1] = phi

    def eval(self, s, x, residual, jacobian):
        self._evaluate(self.contact, s, _numpy(x, self.unknowns), residual, jacobian)

    def step(self, s, x):
        values = _numpy(x, self.unknowns)
        residual, jacobian = self.contact(*self._inputs(s), values)
        try:
            change = np.linalg.solve(np.asarray(jacobian), np.asarray(residual).ravel())
        except np.linalg.LinAlgError:
            return float("nan")
        values -= change
        return float(np.sum(np.abs(change / self._value("scale", s, values))))

    def along(self, s, phi, x, direction, first, second):
        parameters, _ = self._inputs(s)
        derivatives = self.directional(parameters, phi, _numpy(x, self.unknowns), _numpy(direction, self.unknowns + 1))
        for place, values in zip((first, second), derivatives, strict=True):
            if place != ffi.NULL:
                _numpy(place, self.unknowns)[:] = np.asarray(values).ravel()

    def scale(self, s, x):
        _numpy(x, self.unknowns)[:] = self._value("scale", s)

    def guess(self, s, y):
        _numpy(y, len(self.columns))[:] = self._value("start_guess", s)

    def start_scale(self, s, y):
        _numpy(y, len(self.columns))[:] = self._value("scale", s)[self.columns]

    def start_eval(self, s, y, residual, jacobian):
        self._evaluate(self.start, s, self._start_point(y), residual, jacobian)

    def start_solution(self, s, y, x):
        _numpy(x, self.unknowns)[:] = self._value("start_solution", s, self._start_point(y))

    def observe(self, s, x, o):
        _numpy(o, self.observed)[:] = self._value("observation", s, _numpy(x, self.unknowns))

    def _inputs(self, s):
        state = _numpy(s, self.parameters + 1)
        return state[:-1], state[-1]

    def _value(self, name, s, x=None):
        """One output of the drive's function; without ``x``, one that does not depend on it."""
        results = self.values(*self._inputs(s), np.zeros(self.unknowns) if x is None else x)
        return np.asarray(results[self.names.index(name)]).ravel()

    def _start_point(self, y):
        """The unknowns of the start system among zeros."""
        x = np.zeros(self.unknowns)
        x[self.columns] = _numpy(y, len(self.columns))
        return x

    def _evaluate(self, function, s, x, residual, jacobian):
        values, slopes = function(*self._inputs(s), x)
        _numpy(residual, values.numel())[:] = np.asarray(values).ravel()
        if jacobian != ffi.NULL:
            _numpy(jacobian, slopes.numel())[:] = np.asarray(slopes).ravel()


def _along(casadi, residual, y, direction):
    """First and second derivative of the residual along a direction of y = (unknowns, input angle)."""
    first = casadi.jtimes(residual, y, direction)
    return [first, casadi.jtimes(first, y, direction)]


def _with_jacobian(casadi, residual, unknowns):
    return [residual, casadi.jacobian(residual, unknowns) if unknowns.numel() else casadi.SX(0, 0)]
