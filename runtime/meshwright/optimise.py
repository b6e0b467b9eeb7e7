"""Tooth contact analysis as a differentiable CasADi function, for designing by optimisation.

``contact`` solves the generated equations by Newton's method inside CasADi; its derivatives are those of the implicit
function theorem. The rules by which a design's parameters depend on one another come from the compiled library with
their exact derivatives. Needs the extra ``casadi``.
"""

import casadi
import numpy as np

from meshwright import design as designs
from meshwright._library import SHIPPED, ffi, library
from meshwright.errors import UsageError


def _pointer(array):
    return ffi.from_buffer("double[]", array)


class Completion(casadi.Callback):
    """Values of the keys (inner units) → complete parameter vector, with its exact Jacobian.

    CasADi demands a class here; keep the object alive as long as functions made from it.
    """

    def __init__(self, drive, keys):
        super().__init__()
        if drive.model.nsystems:
            raise UsageError(f"{drive.design.description['title']}: its parameters follow from a system of equations")
        self.drive, self.columns = drive, [_column(drive, key) for key in keys]
        self.construct("completion", {})

    def get_n_in(self):
        return 1

    def get_n_out(self):
        return 1

    def get_sparsity_in(self, _):
        return casadi.Sparsity.dense(len(self.columns), 1)

    def get_sparsity_out(self, _):
        return casadi.Sparsity.dense(self.drive.model.np, 1)

    def given(self, values):
        """Parameters as given with these values, and the same completed."""
        given = designs.given_vector(self.drive.design)
        given[self.columns] = np.asarray(values, dtype=float).ravel()
        complete, work, info = given.copy(), np.empty(len(given) + 1), ffi.new("mw_info *")
        library().mw_complete(self.drive.model, _pointer(complete), _pointer(work), info)
        return given, complete

    def eval(self, arguments):
        return [np.nan_to_num(self.given(arguments[0])[1])]

    def has_jacobian(self):
        return True

    def get_jacobian(self, name, inputs, outputs, options):
        self.slopes = _Slopes(self, name, options)
        return self.slopes


class _Slopes(casadi.Callback):
    """Jacobian of a :class:`Completion`."""

    def __init__(self, completion, name, options):
        super().__init__()
        self.completion = completion
        self.construct(name, options)

    def get_n_in(self):
        return 2

    def get_n_out(self):
        return 1

    def get_sparsity_in(self, i):
        rows = (len(self.completion.columns), self.completion.drive.model.np)[i]
        return casadi.Sparsity.dense(rows, 1)

    def get_sparsity_out(self, _):
        return casadi.Sparsity.dense(self.completion.drive.model.np, len(self.completion.columns))

    def eval(self, arguments):
        given, complete = self.completion.given(arguments[0])
        matrix = np.zeros((len(given), len(self.completion.columns)))
        for k, column in enumerate(self.completion.columns):
            change = np.zeros(len(given))
            change[column] = 1.0
            library().mw_complete_tangent(self.completion.drive.model, *map(_pointer, (given, complete, change)))
            matrix[:, k] = np.nan_to_num(change)
        return [matrix]


def _column(drive, key):
    for k, p in enumerate(drive.design.description["parameters"]):
        if f"{p['table']}.{p['key']}" == key:
            return k
    raise UsageError(f"{key}: no parameter of this drive; `meshwright drives` lists the keys as table.key")


def contact(drive):
    """CasADi function (p, phi, start) → (x, o): solved unknowns and observation, differentiable in p and phi.

    ``p`` is the complete parameter vector, ``start`` unknowns close to the solution. Raises CasADi's error where
    Newton's iteration fails.
    """
    values = casadi.Function.load(str(SHIPPED / f"{drive.design.description['name']}.casadi"))
    count, nx = values.size1_in(0), values.size1_in(2)
    x, q = casadi.SX.sym("x", nx), casadi.SX.sym("q", count + 1)
    equations = casadi.Function("equations", [x, q], [values(q[:count], q[count], x)[0]])
    solver = casadi.rootfinder("solver", "newton", equations, {"abstol": 1e-11, "error_on_fail": True})
    p, phi, start = casadi.MX.sym("p", count), casadi.MX.sym("phi"), casadi.MX.sym("start", nx)
    solution = solver(start, casadi.vertcat(p, phi))
    observed = values(p, phi, solution)[values.name_out().index("observation")]
    return casadi.Function("contact", [p, phi, start], [solution, observed], ["p", "phi", "start"], ["x", "o"])


def semi_major(drive, observed, separation):
    """Semi-major axis of the contact ellipse (mm) of an observation, as an expression; explicit flanks only."""
    pinion, wheel = drive.design.description["bodies"]
    if pinion["conditions"] or wheel["conditions"]:
        raise UsageError(f"{drive.design.description['title']}: no expression for the ellipse of an implicit flank")
    normal = observed[3:6]
    first = observed[pinion["at"] : pinion["at"] + 3]
    first = first - casadi.dot(first, normal) * normal
    first = first / casadi.norm_2(first)
    frame = casadi.horzcat(first, casadi.cross(normal, first))
    relative = -_second_form(wheel, observed, frame) - _second_form(pinion, observed, frame)
    mean, half = (relative[0, 0] + relative[1, 1]) / 2, (relative[0, 0] - relative[1, 1]) / 2
    mixed = (relative[0, 1] + relative[1, 0]) / 2
    larger = mean + casadi.sqrt(half**2 + mixed**2)
    smaller = (relative[0, 0] * relative[1, 1] - mixed**2) / larger
    return casadi.sqrt(2 * separation / smaller)


def _second_form(body, observed, frame):
    """Second fundamental form of a flank along its outward normal, in a tangent frame (3, 2)."""
    at = body["at"]
    tangents = casadi.horzcat(observed[at : at + 3], observed[at + 6 : at + 9])
    turnings = casadi.horzcat(observed[at + 3 : at + 6], observed[at + 9 : at + 12])
    return -casadi.mtimes(casadi.mtimes(frame.T, turnings), casadi.inv(casadi.mtimes(frame.T, tangents)))
