"""What a tooth contact analysis returns: arrays in inner units (mm, rad), one row a point."""

from dataclasses import dataclass, fields, replace
from functools import cached_property

import numpy as np

from meshwright.base.library import library, text
from meshwright.base.plain import finite_or_nones

ARCSEC = np.pi / 648000.0

#: Status words of points that have numbers.
SOLVED = ("converged",)

#: Status words of angles at which the bounded flanks touch: at a point, along a line, on an edge or at a corner.
TOUCHING = ("converged", "line_contact", "edge_contact", "corner_contact")

#: Those at which they touch with more than an edge.
ON_FLANKS = ("converged", "line_contact")

#: Those of contacts that no tangency is.
ON_EDGES = ("edge_contact", "corner_contact")

#: Flag of points beyond the tip of a member.
OFF_TIP = "off_tip"


def impossible(flag):
    """Whether a flag marks points that satisfy the equations but that bodies cannot make."""
    return bool(library().mw_impossible(flag.encode()))


@dataclass(frozen=True)
class TCA:
    """Tooth contact analysis over N input angles.

    Angles in rad, lengths in mm. ``points``, ``normals`` (out of the pinion) and ``major`` in the fixed frame,
    ``body_points[name]`` in the frame of each body: (N, 3). ``unknowns[name]``: (N,). ``curvatures``: (N, 2), relative,
    smaller first, 1/mm. ``lever_arms[name]``: (N,), velocity of a member's point along the normal for a unit velocity
    of its own angle, mm; ``instantaneous_ratio`` (N,): d(wheel angle)/d(pinion angle), the pinion's lever over the
    wheel's. Where a point has no contact the numbers are NaN; ``error`` remains for line contact.
    ``reference_error`` is the transmission error at the reference angle. ``solutions`` (N, nx) are the unknowns of
    the right-hand model in its own order, NaN where there is no solution. ``outside_the_tips`` says which points have
    no contact within the tips of both members: (N,) of bool. On an edge and at a corner ``points``, ``normals``,
    ``body_points`` and the wheel's lever are those there, and what belongs to a tangency is NaN. ``lines``: the
    :class:`~meshwright.cycle.touching_line.TouchingLine` along which the flanks, or an edge and a flank, touch, else
    None.
    """

    angles: np.ndarray
    status: tuple[str, ...]
    messages: tuple[str, ...]
    iterations: np.ndarray
    residual: np.ndarray
    wheel_angles: np.ndarray
    error: np.ndarray
    reference_error: float
    unknowns: dict[str, np.ndarray]
    units: dict[str, str]
    points: np.ndarray
    normals: np.ndarray
    body_points: dict[str, np.ndarray]
    curvatures: np.ndarray
    major: np.ndarray
    lever_arms: dict[str, np.ndarray]
    instantaneous_ratio: np.ndarray
    semi_axes: np.ndarray
    flags: tuple[tuple[str, ...], ...]
    margins: dict[str, np.ndarray]
    solutions: np.ndarray
    outside_the_tips: np.ndarray
    lines: tuple

    @property
    def relative_error(self):
        """Transmission error less its value at the reference angle, rad: (N,)."""
        return self.error - self.reference_error

    def relative_to(self, reference_error):
        """The same with relative errors that refer to another transmission error, rad."""
        return replace(self, reference_error=reference_error)

    @cached_property
    def solved(self):
        """Which points have a contact point: (N,) of bool."""
        if set(self.status) <= set(SOLVED):
            return np.ones(len(self.status), dtype=bool)
        return np.array([s in SOLVED for s in self.status], dtype=bool)

    def only(self, rows):
        """The points of some rows, (N,) of bool or their numbers."""
        return replace(self, **{name: _chosen(getattr(self, name), rows) for name in self._columns})

    def with_rows(self, rows, others):
        """The same, but in rows (R,), by number, the points of another one, and with a reference error where it has
        none.
        """
        error = _put(self.error, rows, others.error)
        known, reference = np.flatnonzero(np.isfinite(error)), self.reference_error
        if (same := np.flatnonzero(self.error == reference)).size:  # it stays the error of that point
            reference = float(error[same[0]])
        if not np.isfinite(reference) and known.size:
            reference = float(error[known[np.argmin(np.abs(self.angles[known]))]])
        columns = {name: _put(getattr(self, name), rows, getattr(others, name)) for name in self._columns}
        return replace(self, reference_error=reference, **columns)

    @property
    def _columns(self):
        """Names of what has an entry for every point."""
        return [f.name for f in fields(self) if f.name not in ("reference_error", "units")]

    @property
    def complete(self):
        """Whether at every point the flanks touch as bodies can."""
        return all(word in TOUCHING for word in self.status) and not any(
            impossible(f) for flags in self.flags for f in flags
        )

    def without_contact(self, rows):
        """The same, but at these points (N,) of bool the flanks do not touch."""
        if not rows.any():
            return self

        def only(values):
            return np.where(rows if values.ndim == 1 else rows[:, None], np.nan, values)

        def words(values, instead):
            return tuple(instead if row else value for row, value in zip(rows.tolist(), values, strict=True))

        code = library().MW_NO_CONTACT
        word, message = text(library().mw_status_word(code)), text(library().mw_status_text(code))
        arrays = ("residual", "wheel_angles", "error", "points", "normals", "curvatures", "major", "semi_axes")
        arrays += ("instantaneous_ratio", "solutions")
        groups = ("unknowns", "body_points", "lever_arms", "margins")
        error = only(self.error)
        left = np.flatnonzero(np.isfinite(error))
        nearest = error[left[np.argmin(np.abs(self.angles[left]))]] if left.size else np.nan
        return replace(
            self,
            status=words(self.status, word),
            messages=words(self.messages, message),
            iterations=np.where(rows, 0, self.iterations),
            flags=words(self.flags, ()),
            lines=words(self.lines, None),
            reference_error=float(nearest),
            **{name: only(getattr(self, name)) for name in arrays},
            **{name: {key: only(values) for key, values in getattr(self, name).items()} for name in groups},
        )

    def ellipse(self, k, points=97):
        """Closed outline (points, 3) of the contact ellipse at point ``k``, fixed frame, mm; NaN without one."""
        angle = np.linspace(0.0, 2.0 * np.pi, points)[:, None]
        along, across = self.major[k], np.cross(self.normals[k], self.major[k])
        major, minor = self.semi_axes[k]
        return self.points[k] + major * np.cos(angle) * along + minor * np.sin(angle) * across

    def to_xarray(self):
        """The same as an ``xarray.Dataset`` over the pinion angle (needs xarray)."""
        import xarray  # pyright: ignore[reportMissingImports]  of no extra

        angle, axis = ("pinion_angle",), ("pinion_angle", "axis")
        data = {
            "status": (angle, list(self.status)),
            "wheel_angle": (angle, self.wheel_angles, {"units": "rad"}),
            "transmission_error": (angle, self.error, {"units": "rad"}),
            "contact_point": (axis, self.points, {"units": "mm"}),
            "contact_normal": (axis, self.normals),
        }
        data |= {name: (angle, values, {"units": self.units[name]}) for name, values in self.unknowns.items()}
        return xarray.Dataset(data, coords={"pinion_angle": self.angles, "axis": list("xyz")})

    def to_points(self):
        """The points as the plain data of the ``meshwright.tca/1`` schema."""
        unknowns, arms = _grouped(self.unknowns), _grouped(self.lever_arms)
        columns = {
            "pinion_angle_deg": np.degrees(self.angles).tolist(),
            "status": self.status,
            "message": self.messages,
            "iterations": self.iterations.tolist(),
            "residual": finite_or_nones(self.residual),
            "wheel_angle_deg": finite_or_nones(np.degrees(self.wheel_angles)),
            "transmission_error_arcsec": finite_or_nones(self.error / ARCSEC),
            "transmission_error_relative_arcsec": finite_or_nones(self.relative_error / ARCSEC),
            "unknowns": [found if solved else {} for found, solved in zip(unknowns, self.solved.tolist(), strict=True)],
            "contact_point_mm": finite_or_nones(self.points),
            "contact_normal": finite_or_nones(self.normals),
            **{f"contact_point_{name}_mm": finite_or_nones(points) for name, points in self.body_points.items()},
            "curvature": _grouped(
                {
                    "relative_min_per_mm": self.curvatures[:, 0],
                    "relative_max_per_mm": self.curvatures[:, 1],
                    "major_direction": self.major,
                }
            ),
            "ellipse": _grouped({"semi_major_mm": self.semi_axes[:, 0], "semi_minor_mm": self.semi_axes[:, 1]}),
            "lever_arms_mm": arms,
            "instantaneous_ratio": finite_or_nones(self.instantaneous_ratio),
            "flags": list(map(list, self.flags)),
            "contact_line": [line and line.plain() for line in self.lines],
        }
        return [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)]


def _chosen(column, rows):
    """Rows of a column of a TCA: an array, a tuple, or a dictionary of those."""
    if isinstance(column, dict):
        return {key: _chosen(values, rows) for key, values in column.items()}
    if isinstance(column, tuple):
        return tuple(column[k] for k in np.arange(len(column))[rows])
    return column[rows]


def _put(column, rows, values):
    """A column of a TCA with other values in some rows."""
    if isinstance(column, dict):
        return {key: _put(old, rows, values[key]) for key, old in column.items()}
    if isinstance(column, tuple):
        new = list(column)
        for k, value in zip(rows, values, strict=True):
            new[k] = value
        return tuple(new)
    new = np.array(column)
    new[rows] = values
    return new


def _grouped(columns):
    """A dictionary a point of columns by name, as plain data."""
    rows = zip(*map(finite_or_nones, columns.values()), strict=True)
    return [dict(zip(columns, row, strict=True)) for row in rows]
