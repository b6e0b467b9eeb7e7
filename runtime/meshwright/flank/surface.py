"""Generated flanks as functions of their own parameters, body frame."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.library import ffi, library, pointer
from meshwright.contact.model import DriveModel
from meshwright.flank.sections import Sections


@dataclass(frozen=True)
class FlankPoints:
    """A flank at N parameter pairs (or triples, where one condition stays implicit).

    ``points`` (N, 3) mm, ``normals`` (N, 3) unit and out of the material, ``tangents`` (N, k, 3), body frame;
    ``regular`` (N,) is 1 at the reference point and negative beyond a singular line; ``margins[event]`` (N,) are
    negative outside a limit of the design; ``conditions`` (N, c, 1 + k) value and slopes of implicit conditions.
    """

    parameters: np.ndarray
    points: np.ndarray
    normals: np.ndarray
    tangents: np.ndarray
    regular: np.ndarray
    margins: dict[str, np.ndarray]
    conditions: np.ndarray


@dataclass(frozen=True)
class FlankCurvature:
    """Curvature of a flank along its outward normal at N points, 1/mm, negative where it is convex.

    ``second_form`` (N, 2, 2) in the orthonormal ``basis`` (N, 2, 3) of the tangent plane, body frame; ``principal``
    (N, 2) curvatures, the smaller first.
    """

    basis: np.ndarray
    second_form: np.ndarray
    principal: np.ndarray


@dataclass(frozen=True, repr=False)
class Flank:
    """The flank of one member of a drive; call it with parameters (…, k)."""

    drive: DriveModel
    body: dict
    pointer: object
    number: int

    @classmethod
    def of(cls, drive, member, region="flank"):
        """The flank of ``"pinion"`` or ``"wheel"``, or another region that the drive has of a member."""
        description, model = drive.design.description, drive.model
        for k, body in enumerate(description["bodies"]):
            if (body["name"], "flank") == (member, region):
                return cls(drive, body, model.bodies[k], k)
        for k, other in enumerate(description["regions"]):
            if (other["name"], other["region"]) == (member, region):
                return cls(drive, other, model.regions[k], len(description["bodies"]) + k)
        known = [f"flank of {b['name']}" for b in description["bodies"]]
        known += [f"{r['region']} of {r['name']}" for r in description["regions"]]
        raise UsageError(f"this drive has no {region} of {member!r}: its description makes {', '.join(known)}")

    def __repr__(self):
        return f"<{type(self).__name__} {self.region} of the {self.body['name']} of {self.drive.design.label}>"

    @property
    def region(self):
        """"flank", or another region of the member."""
        return self.body.get("region", "flank")

    @property
    def _state(self):
        """The design's state, for C."""
        return pointer(self.drive.design.state)

    @cached_property
    def sizes(self):
        """Natural sizes (k,) of the parameters: those of contact, 1 of what other regions have of their own."""
        compiled, of = self.drive.design.model, Flank.of(self.drive, self.body["name"]).body
        scale = np.empty(compiled.nx)
        compiled.scale(self._state, pointer(scale))
        known = dict(zip(of["parameters"], scale[of["unknowns"]], strict=True))
        return np.array([known.get(name, 1.0) for name in self.parameters])

    @cached_property
    def sections(self):
        """The :class:`~meshwright.flank.sections.Sections` across the teeth; None where a parameter runs along them."""
        return Sections.of(self.body["lengthwise"], self.drive.design)

    @property
    def parameters(self):
        """Names of the surface parameters."""
        return tuple(self.body["parameters"])

    def curvature(self, parameters):
        """:class:`FlankCurvature` at ``parameters`` (N, k); right-hand drive, whatever the design's hand."""
        q = self._rows(parameters)
        outputs = {o["name"]: slice(o["offset"], o["offset"] + o["size"]) for o in self.body["curvature"]}
        rows = np.empty((len(q), max(at.stop for at in outputs.values())))
        library().mw_flank(
            self.pointer.curvature, q.shape[1], rows.shape[1], self._state, pointer(q), len(q), pointer(rows)
        )
        form = rows[:, outputs["second_form"]]
        return FlankCurvature(
            basis=rows[:, outputs["tangent_basis"]].reshape(-1, 2, 3),
            second_form=form[:, [0, 1, 1, 2]].reshape(-1, 2, 2),
            principal=rows[:, outputs["curvature"]],
        )

    def limit_slopes(self, parameters):
        """Slopes (N, 1 + margins, k) by the parameters, at ``parameters`` (N, k), of ``regular`` and of each margin."""
        q = self._rows(parameters)
        slopes = np.empty((len(q), 1 + len(self.body["margins"]), q.shape[1]))
        compiled = self.drive.design.model
        library().mw_bounds(compiled, self.number, 1, self._state, pointer(q), len(q), pointer(slopes))
        return slopes

    def second_derivatives(self, parameters):
        """Second derivatives by the parameters at ``parameters`` (N, k): of the point (N, 3, k, k), body frame, mm, and
        of each implicit condition (N, c, k, k). Flanks have them, other regions do not.
        """
        q = self._rows(parameters)
        k, limits, compiled = q.shape[1], 1 + len(self.body["margins"]), self.drive.design.model
        rows, columns = np.triu_indices(k)
        pairs = np.empty((len(q), 3 + limits + self.body["conditions"], len(rows)))
        if library().mw_bounds(compiled, self.number, 2, self._state, pointer(q), len(q), pointer(pairs)) < 0:
            raise UsageError(f"the {self.region} of the {self.body['name']} has no second derivatives; a flank has")
        full = np.empty((*pairs.shape[:2], k, k))
        full[:, :, rows, columns] = full[:, :, columns, rows] = pairs
        return full[:, :3], full[:, 3 + limits :]

    def places(self, factors, sizes, values, start):
        """Parameters (N, k), from nearby ones (N, k), at values (N, 2) of two coordinates: sums, with ``factors``
        (2, k + 4) or (N, 2, k + 4), of the parameters, of x, y, z in the body frame and of the distance from the
        body's axis. ``sizes`` (k,) are natural sizes. NaN where Newton's method finds none.
        """
        evaluate, state, k, outputs, _, _ = self._evaluated
        q, o = self._rows(start).copy(), np.empty(outputs)
        values = np.ascontiguousarray(values, dtype=float).reshape(len(q), 2)
        apart = factors[0].size if factors.ndim == 3 else 0
        by = ffi.new("mw_coordinates *", (evaluate, k, outputs, apart, pointer(sizes), pointer(factors)))
        if library().mw_places(by, state, pointer(values), len(q), pointer(o), pointer(q)) < 0:
            raise UsageError(f"the {self.region} of the {self.body['name']} is no surface of two free parameters")
        return q

    def met(self, points, along, start, longest, farthest):
        """Where rays from ``points`` (N, 3) along unit vectors (N, 3), body frame, meet the surface: distances (N,) in
        mm, negative behind the points, and parameters (N, k), from nearby ones (N, k). A distance is NaN where Newton's
        method, with steps no longer than ``longest``, finds none without straying to ``farthest``, mm.
        """
        evaluate, state, k, outputs, _, _ = self._evaluated
        q, o = self._rows(start).copy(), np.empty(outputs)
        distance, points, along = np.full(len(q), np.nan), np.ascontiguousarray(points), np.ascontiguousarray(along)
        library().mw_rays(
            evaluate, k, outputs, state, pointer(points), pointer(along), len(q), longest, farthest, pointer(o),
            pointer(q), pointer(distance),
        )  # fmt: skip
        return distance, q

    def __call__(self, parameters):
        """:class:`FlankPoints` at ``parameters`` (N, k); right-hand drive, whatever the design's hand."""
        q = self._rows(parameters)
        evaluate, state, k, outputs, margins, c = self._evaluated
        n = len(q)
        rows = np.empty((n, outputs))
        library().mw_flank(evaluate, k, outputs, state, pointer(q), n, pointer(rows))
        at = 7 + 3 * k
        return FlankPoints(
            parameters=q,
            points=rows[:, 0:3],
            normals=rows[:, 3:6],
            tangents=rows[:, 6 : 6 + 3 * k].reshape(n, k, 3),
            regular=rows[:, at - 1],
            margins={event: rows[:, at + i] for i, event in enumerate(margins)},
            conditions=rows[:, at + len(margins) :].reshape(n, c, 1 + k) if c else np.empty((n, 0, 1 + k)),
        )

    def _rows(self, parameters):
        """Parameters (N, k) as C reads them; one point may come without its axis."""
        try:
            q = np.asarray(parameters, dtype=float, order="C")
        except (TypeError, ValueError):
            q = np.empty(0)
        q, names = q if q.ndim == 2 else np.atleast_2d(q), self.body["parameters"]
        if q.ndim != 2 or q.shape[1] != len(names):
            of = f"the {self.region} of the {self.body['name']}"
            raise UsageError(f"parameters: {of} has {', '.join(names)}; give an array (N, {len(names)}) of numbers")
        return q

    @cached_property
    def _evaluated(self):
        """What a call hands to C: the function, the state, numbers of parameters and results; margins; conditions."""
        margins = tuple(m["event"] for m in self.body["margins"])
        sizes = len(self.parameters), self.body["outputs"], margins, self.body["conditions"]
        return self.pointer.flank, self._state, *sizes
