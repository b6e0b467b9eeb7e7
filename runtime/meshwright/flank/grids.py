"""Grids over the flank of a tooth, as far as the blank and the tool let it exist.

A grid has N places across the tooth (the first surface parameter, along the profile) and M along it (axial position,
radius or the last surface parameter, as the drive says). Limits of the design bound it; where the design sets none,
it covers what contact uses.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.library import pointer
from meshwright.cycle.pairs import Mesh
from meshwright.pattern.pattern import contours

#: Steps from the middle towards a limit, in natural sizes, and how many at most.
STEP = 1.0 / 16.0
MAX_STEPS = 640
BISECTIONS = 50

#: Without a limit the grid goes this many natural sizes beyond the path of contact.
BEYOND = 0.5

#: Angles of the window at which contact patches are looked at.
PATCHES = 5


@dataclass(frozen=True)
class Grid:
    """N × M points of a flank or region in the body frame, row-major, the index along the tooth fastest.

    ``parameters`` names; ``values`` (N·M, k) in rad or mm; ``points`` (N·M, 3) mm; ``normals`` (N·M, 3) unit, out of
    the material.
    """

    member: str
    region: str
    parameters: tuple[str, ...]
    shape: tuple[int, int]
    values: np.ndarray
    points: np.ndarray
    normals: np.ndarray


def grid(drive, member, shape=(21, 41), region="flank"):
    """The :class:`Grid` of a region; raises :class:`~meshwright.base.errors.UsageError` if it cannot be spanned."""
    if min(shape) < 2:
        raise UsageError(f"--grid {shape[0]}x{shape[1]}: needs at least 2 points each way; for example --grid 21x41")
    sheet = _Sheet.of(Mesh.of(drive), member, region)
    along = np.linspace(*sheet.lengthwise_range(), shape[1])
    middle = sheet.line(along)
    lower, upper = (sheet.end_of_profile(middle, along, sign) for sign in (-1.0, 1.0))
    rows, start = [], lower
    for share in np.linspace(0.0, 1.0, shape[0]):
        start = sheet.solve(lower[:, 0] + share * (upper[:, 0] - lower[:, 0]), along, start)
        rows.append(start)
    values = np.concatenate(rows)
    if not np.all(np.isfinite(values)):
        raise UsageError(f"the {region} of the {member} cannot be spanned: limit it in [blank]")
    return sheet.grid(shape, values)


@dataclass(frozen=True)
class _Sheet:
    """A flank or region with the place from which it is spanned.

    ``start`` (k,): parameters in its middle; ``used`` (P, k): parameters that contact visits; ``sizes`` (k,): natural
    sizes of the parameters.
    """

    mesh: Mesh
    member: str
    region: str
    flank: object
    start: np.ndarray
    used: np.ndarray
    sizes: np.ndarray

    @classmethod
    def of(cls, mesh, member, region):
        flank, body = mesh.drive.flank(member, region), mesh.drive.flank(member).body
        unknowns, scale = _solutions(mesh), _scale(mesh.drive)
        known = {name: unknowns[:, k] for name, k in zip(body["parameters"], body["unknowns"], strict=True)}
        sizes = {name: scale[k] for name, k in zip(body["parameters"], body["unknowns"], strict=True)}
        used = np.stack([known.get(p, np.zeros(len(unknowns))) for p in flank.parameters], axis=1)
        sizes = np.array([sizes.get(p, 1.0) for p in flank.parameters])
        return cls(mesh, member, region, flank, used[len(used) // 2], used, sizes)

    @property
    def drive(self):
        return self.mesh.drive

    def lengthwise(self, found):
        """The coordinate along the tooth (N,) and its slopes by the parameters (N, k)."""
        match self.flank.body["lengthwise"]:
            case "axial":
                return found.points[:, 2], found.tangents[:, :, 2]
            case "radius":
                radius = np.hypot(found.points[:, 0], found.points[:, 1])
                slopes = np.einsum("nkj,nj->nk", found.tangents[:, :, :2], found.points[:, :2])
                return radius, slopes / radius[:, None]
            case _:
                slopes = np.zeros(found.parameters.shape)
                slopes[:, -1] = 1.0
                return found.parameters[:, -1], slopes

    def solve(self, profile, along, start):
        """Parameters (N, k) at profile parameters and lengthwise coordinates (N,), from nearby ones; NaN for none."""
        q = start.copy()
        for _ in range(40):
            found = self.flank(q)
            reached, slopes = self.lengthwise(found)
            residual = np.concatenate(
                [(q[:, 0] - profile)[:, None], (reached - along)[:, None], found.conditions[:, :, 0]], axis=1
            )
            matrix = np.zeros((len(q), q.shape[1], q.shape[1]))
            matrix[:, 0, 0], matrix[:, 1], matrix[:, 2:] = 1.0, slopes, found.conditions[:, :, 1:]
            step = _solved(matrix, residual)
            largest = np.abs(step / self.sizes).max(axis=1)
            q -= step * np.minimum(1.0, 0.5 / np.maximum(largest, 1e-300))[:, None]
            if not (largest > 1e-12).any():
                break
        q[~(largest < 1e-9)] = np.nan
        return q

    def line(self, along):
        """Parameters (M, k) at mid profile over the lengthwise coordinates, reached from the middle of the tooth."""
        (here,), _ = self.lengthwise(self.flank(self.start[None, :]))
        if not np.isfinite(here):
            raise UsageError(f"the {self.region} of the {self.member} is not defined: give its sizes in [blank]")
        q = np.tile(self.start, (len(along), 1))
        steps = max(8, math.ceil(np.abs(along - here).max() / (4.0 * STEP * self._lengthwise_size())))
        for share in np.linspace(0.0, 1.0, steps + 1)[1:]:
            q = self.solve(np.full(len(along), self.start[0]), here + share * (along - here), q)
        return q

    def lengthwise_range(self):
        """Smallest and largest lengthwise coordinate: the faces, or what contact visits; regions share the flank's."""
        flank = self if self.region == "flank" else _Sheet.of(self.mesh, self.member, "flank")
        return tuple(sorted(flank._end_of_length(sign) for sign in (-1.0, 1.0)))

    def _end_of_length(self, sign):
        start = self.start[None, :]
        here, _ = self.lengthwise(self.flank(start))
        if np.isfinite(self.flank(start).margins.get("face", np.full(1, np.nan))[0]):
            ends, _ = self._outermost(
                lambda c, q: self.solve(q[:, 0], c, q), here, start, sign * self._lengthwise_size(), _faces
            )
            return float(ends[0])
        visited, _ = self.lengthwise(self.flank(self.used))
        visited = np.concatenate([visited, self._patches])
        extreme = visited.max() if sign > 0 else visited.min()
        return float(extreme + sign * BEYOND * self._lengthwise_size())

    def end_of_profile(self, middle, along, sign):
        """Parameters (M, k) where the profile ends on the lines across the tooth through ``middle``.

        A singular line ends it, but where the blank sets no limit only as far as contact goes.
        """
        step = sign * STEP * self.sizes[0]
        ends, q = self._outermost(lambda t, start: self.solve(t, along, start), middle[:, 0], middle, step, _inside)
        used = (self.used[:, 0].max() if sign > 0 else self.used[:, 0].min()) + sign * BEYOND * self.sizes[0]
        past = self.solve(ends + 1e-3 * step, along, q)
        open_ = ~(_blank(self.flank(past)) < 0.0) & (sign * (ends - used) > 0.0)
        return np.where(open_[:, None], self._walked(middle, along, np.full(len(along), used)), q)

    def _walked(self, middle, along, profile):
        q = middle
        for share in np.linspace(0.0, 1.0, 33)[1:]:
            q = self.solve(middle[:, 0] + share * (profile - middle[:, 0]), along, q)
        return q

    def _outermost(self, solve, here, start, step, margin):
        """The last places from ``here`` (N,) in steps at which the margin is not negative: infinite if it never is."""
        inner, q = here.astype(float), start.copy()
        outer = np.full(len(inner), math.copysign(math.inf, step))
        for _ in range(MAX_STEPS):
            going = ~np.isfinite(outer)
            if not going.any():
                break
            trial = solve(inner + step, q)
            valid = margin(self.flank(trial)) >= 0.0
            outer = np.where(going & ~valid, inner + step, outer)
            inner, q = np.where(going & valid, inner + step, inner), np.where((going & valid)[:, None], trial, q)
        found = np.isfinite(outer)
        for _ in range(BISECTIONS):
            middle = np.where(found, 0.5 * (inner + outer), inner)
            trial = solve(middle, q)
            valid = found & (margin(self.flank(trial)) >= 0.0)
            inner, q = np.where(valid, middle, inner), np.where(valid[:, None], trial, q)
            outer = np.where(found & ~valid, middle, outer)
        return np.where(found, inner, outer), q

    @cached_property
    def _patches(self):
        """Lengthwise coordinates of the edges of contact patches over the window; none without a window."""
        window, lengthwise = self.mesh.window, self.flank.body["lengthwise"]
        if window.path is None or not window.complete or not lengthwise:
            return np.empty(0)
        angles = np.linspace(window.begin.angle, window.end.angle, PATCHES)
        patches = [p for p in contours(self.drive, self.drive.tca(angles), 8) if p is not None]
        points = np.concatenate([p.body_points[self.member] for p in patches])
        return points[:, 2] if lengthwise == "axial" else np.hypot(points[:, 0], points[:, 1])

    def _lengthwise_size(self):
        """Natural size of the lengthwise coordinate: that of a length, or of the last parameter."""
        return self.sizes[-1] if not self.flank.body["lengthwise"] else _length(self.drive)

    def grid(self, shape, values):
        """The grid of these parameters, mirrored where the design is."""
        found = self.flank(values)
        mirror = self.drive.design.mirror
        flip, signs = mirror.flip, np.array([mirror.factor(name) for name in self.flank.parameters])
        return Grid(
            self.member, self.region, self.flank.parameters, tuple(shape), signs * values, flip * found.points,
            flip * found.normals,
        )  # fmt: skip


def _faces(found):
    return found.margins["face"]


def _blank(found):
    """The smallest limit of the profile that the blank or the tool sets: all margins but the faces."""
    smallest = np.full(len(found.points), np.inf)
    for event, values in found.margins.items():
        if event not in ("face", "regression", "spurious_sheet"):
            smallest = np.fmin(smallest, values)
    return smallest


def _inside(found):
    """The smallest limit of the profile, singular lines included; negative where there is no flank."""
    smallest = np.fmin(_blank(found), found.regular)
    for event in ("regression", "spurious_sheet"):
        smallest = np.fmin(smallest, found.margins.get(event, np.inf))
    return np.where(np.isfinite(found.points).all(axis=1), smallest, -np.inf)


def _solved(matrix, residual):
    step = np.full(residual.shape, np.nan)
    good = np.isfinite(matrix).all(axis=(1, 2)) & np.isfinite(residual).all(axis=1)
    good[good] = np.abs(np.linalg.det(matrix[good])) > 0.0
    step[good] = np.linalg.solve(matrix[good], residual[good][:, :, None])[:, :, 0]
    return step


def _scale(drive):
    scale = np.empty(drive.model.nx)
    drive.model.scale(pointer(drive.state()), pointer(scale))
    return scale


def _length(drive):
    """The natural length of a drive, mm: of its first unknown that is one."""
    units = [u["unit"] for u in drive.design.description["unknowns"]]
    return float(_scale(drive)[units.index("mm")]) if "mm" in units else 1.0


def _solutions(mesh):
    """Solutions that contact visits (P, nx), right hand: the window of a pair, or what there is about angle 0."""
    window, pitch = mesh.window, mesh.drive.pitch()
    if window.path is None:
        unknowns, _ = mesh.drive.trace(np.array([-0.25, 0.0, 0.25]) * pitch)
        unknowns = unknowns[np.isfinite(unknowns).all(axis=1)]
        if not len(unknowns):
            raise UsageError("the flanks do not touch: no part of them is in use; change the design or misalignment")
        return unknowns
    low, high = window.bounds if window.complete else (-pitch, pitch)
    return window.path.unknowns[(window.path.angles >= low) & (window.path.angles <= high)]
