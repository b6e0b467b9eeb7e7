"""Errors of settings, tools and of the part's pose from measured deviations of flanks.

δ_i = Σ_k J_ik q_k + noise with J_ik = n_i · ∂r/∂q_k at fixed parameters of the flank: the normal is perpendicular to
every direction in which those could change, so that this is the exact change along the normal. The changes ∂p/∂q_k of
the complete design follow its rules; parameters that are identified or held keep their values meanwhile. The linear
estimate is corrected with the distances of the exact surface until it stands (Gauss–Newton).
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.library import library, pointer
from meshwright.design import design as designs
from meshwright.design.description import table_and_key
from meshwright.drive import Drive
from meshwright.shop.least_squares import DISTRUSTED, Estimate, estimate
from meshwright.shop.located import along, located, rays

ARCSEC = math.pi / 648000.0

#: Keys of the part's pose on the machine: what a unit of each does to a point P of the body, rotation vector and shift.
POSE = {
    "pose.rotation_arcsec": ((0.0, 0.0, ARCSEC), (0.0, 0.0, 0.0)),
    "pose.axial_mm": ((0.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    "pose.tilt_x_arcsec": ((ARCSEC, 0.0, 0.0), (0.0, 0.0, 0.0)),
    "pose.tilt_y_arcsec": ((0.0, ARCSEC, 0.0), (0.0, 0.0, 0.0)),
    "pose.eccentricity_x_mm": ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0)),
    "pose.eccentricity_y_mm": ((0.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
}

#: Sizes that matter where none are given, by the end of the key; a share of the value for keys without a unit.
TOLERANCES = {"_mm": 0.1, "_um": 10.0, "_deg": 0.1, "_arcmin": 6.0, "_arcsec": 360.0}
SHARE = 0.01

#: A parameter that changes no deviation by more than this for its tolerance, mm, is no parameter of the flank.
NO_EFFECT = 1e-9

ROUNDS = 20
#: The estimate stands when the exact surface changes no deviation by more than this, mm.
SETTLED = 1e-8

#: Estimates of a larger correlation than this are named together.
CORRELATED = 0.99


@dataclass(frozen=True)
class Identification:
    """What :meth:`Parameters.fit` finds; ``estimate`` in units of the keys and mm, ``largest`` residual and ``rms`` in
    mm, those of points that are not distrusted.
    """

    keys: tuple[str, ...]
    nominal: tuple[float | None, ...]
    estimate: Estimate
    rms: float
    largest: float

    def correlated(self):
        """Pairs of determined keys of nearly the same effect, and the correlation of their estimates."""
        spread = np.sqrt(np.diag(self.estimate.covariance))
        for a in range(len(self.keys)):
            for b in range(a):
                if np.isfinite(self.estimate.values[[a, b]]).all():
                    share = self.estimate.covariance[a, b] / (spread[a] * spread[b])
                    if abs(share) > CORRELATED:
                        yield self.keys[b], self.keys[a], float(share)


@dataclass(frozen=True)
class Parameters:
    """Parameters ``keys`` of a member's flanks at measured points, ``columns`` (N, K) in mm per unit of the key."""

    drive: Drive
    member: str
    keys: tuple[str, ...]
    held: tuple[str, ...]
    points: object
    flanks: object
    columns: np.ndarray
    tolerances: np.ndarray

    @classmethod
    def at(cls, drive, member, points, keys, held=(), tolerances=None):
        """The parameters ``keys`` at :class:`~meshwright.shop.tables.Points`; ``held`` are keys that stay as they are
        though rules would change them. Raises :class:`~meshwright.base.errors.UsageError` for a key that cannot be one.
        """
        keys, held = (tuple(_full(drive, key) for key in group) for group in (keys, held))
        if len(set(keys + held)) < len(keys + held):
            twice = next(key for key in keys + held if (keys + held).count(key) > 1)
            raise UsageError(f"--parameters {twice}: named twice; name it once")
        flanks = located(drive, member, points)
        columns = np.empty((len(points.tooth), len(keys)))
        for k, key in enumerate(keys):
            columns[:, k] = _of_pose(key, points) if key in POSE else _of_design(flanks, member, key, keys + held)
        sizes = np.array([_tolerance(drive, key, tolerances or {}) for key in keys])
        for key, effect in zip(keys, np.abs(columns * sizes).max(axis=0), strict=True):
            if not effect > NO_EFFECT:
                raise UsageError(f"--parameters {key}: it does not change the flanks of the {member}; leave it out")
        return cls(drive, member, keys, held, points, flanks, columns, sizes)

    def fit(self, deviations, sigma=None):
        """The :class:`Identification` from deviations (N,), mm, NaN where nothing is measured."""
        known = np.isfinite(deviations)
        if known.sum() <= len(self.keys):
            raise UsageError(
                f"--parameters: {known.sum()} measured points cannot determine {len(self.keys)} parameters; "
                "measure more points or name fewer parameters"
            )
        columns, values, modelled = self.columns[known], np.zeros(len(self.keys)), np.zeros(known.sum())
        for _ in range(ROUNDS):
            # what the exact surface departs by from the linear model counts as measured
            bent = modelled - columns @ values
            found = estimate(columns, deviations[known] - bent, self.tolerances, sigma)
            before, values = modelled, found.fitted
            modelled = self.deviations(values)[known]
            if not np.isfinite(modelled).all():
                raise UsageError(
                    "--measured: the design with the errors that explain the deviations has no flank where they were "
                    "measured; name fewer parameters, or check signs and units of the file"
                )
            if np.abs(modelled - before).max() < SETTLED:
                break
        residuals = np.full(len(known), np.nan)
        residuals[known] = deviations[known] - modelled
        weights = np.full(len(known), np.nan)
        weights[known] = found.weights
        found = replace(found, weights=weights, residuals=residuals)
        trusted = known & ~(weights < DISTRUSTED)
        if not trusted.any():
            middle = 1e3 * float(np.nanmedian(np.abs(residuals)))
            raise UsageError(
                f"--sigma-um {1e3 * found.sigma:g}: no point lies within some standard deviations of what the "
                f"parameters explain, and none is left to trust: the residuals are {middle:.3g} µm "
                "in the middle; give the standard deviation of one measurement, or name more parameters"
            )
        return Identification(
            self.keys, tuple(None if key in POSE else _nominal(self.drive, key) for key in self.keys), found,
            float(np.sqrt(np.mean(residuals[trusted] ** 2))), float(np.abs(residuals[trusted]).max()),
        )  # fmt: skip

    def deviations(self, values):
        """Deviations (N,), mm, of the exact flanks with errors ``values`` (K,) of the keys."""
        drive = self.changed(values)
        rotation, shift = _motion(self.keys, values)
        points = (self.points.points - shift) @ rotation, self.points.normals @ rotation
        found = np.empty(len(self.points.tooth))
        for word, rows, start in zip(self.flanks.words, self.flanks.rows, self.flanks.parameters, strict=True):
            side = drive if word == drive.design.tables["flank"] else drive.with_(flank=word)
            ray = rays(self.drive, self.member, tuple(p[rows] for p in points), self.points.tooth[rows])
            found[rows] = along(side.flank(self.member), start, ray)[1]
        return found

    def changed(self, values):
        """The drive with errors ``values`` (K,) of the keys of its design; what is held stays."""
        errors = dict(zip(self.keys, values, strict=True))
        tables = {}
        for key in self.keys + self.held:
            if key not in POSE:
                table, name = table_and_key(key)
                tables.setdefault(table, {})[name] = _nominal(self.drive, key) + float(errors.get(key, 0.0))
        return self.drive.with_(**tables) if tables else self.drive


def words(parameters, found, lost):
    """A sentence for people about parameters that cannot be told apart: an undetermined combination."""
    members = lost.members()
    steps = lost.direction * parameters.tolerances
    effect = np.sqrt(np.mean((parameters.columns @ steps) ** 2))
    change = ", ".join(f"{parameters.keys[k]} by {steps[k]:+.3g}" for k in members)
    if len(members) == 1:
        return (
            f"{change} changes the deviations by {1e3 * effect:.2g} µm rms, too little to be told from "
            f"{1e3 * found.estimate.sigma:.2g} µm of noise"
        )
    return (
        f"{change} together change the deviations by {1e3 * effect:.2g} µm rms only: what is measured does not tell "
        "them apart; measure more, or leave out one of them"
    )


def _full(drive, key):
    """A key with its table; raises for what is no real parameter that the design may be given."""
    if key.startswith("pose."):
        if key not in POSE:
            raise UsageError(f"--parameters {key}: no such key of the pose; use one of {', '.join(POSE)}")
        return key
    table, name = table_and_key(key)
    for number, p in zip(drive.design.parameters, drive.design.description["parameters"], strict=True):
        if (p["table"], p["key"]) == (table, name):
            if not designs.is_real(p) or table == "flank":
                raise UsageError(f"--parameters {key}: a count or a choice has no small errors; name lengths or angles")
            if not math.isfinite(number):
                raise UsageError(f"--parameters {key}: the design leaves it open; give it a value there")
            if table == "design" and designs.has_rival(drive.design, name):
                raise UsageError(f"--parameters {key}: another key of the design determines it; name that one")
            return f"{table}.{name}"
    raise UsageError(f"--parameters {key}: the drive has no such key; `meshwright drives` lists its keys")


def _column(drive, key):
    """Number of a key in the parameter vector, and its factor to inner units."""
    for k, p in enumerate(drive.design.description["parameters"]):
        if f"{p['table']}.{p['key']}" == key:
            return k, p["factor"]
    raise KeyError(key)


def _nominal(drive, key):
    k, factor = _column(drive, key)
    return float(drive.design.parameters[k]) / factor


def _tolerance(drive, key, given):
    if key in given:
        return given[key]
    for ending, size in TOLERANCES.items():
        if key.endswith(ending):
            return size
    return SHARE * max(abs(_nominal(drive, key)), 1.0)


def _of_pose(key, points):
    turn, shift = map(np.array, POSE[key])
    return np.einsum("ni,ni->n", points.normals, np.cross(turn, points.points) + shift)


def _motion(keys, values):
    """Rotation (3, 3) and shift (3,) of the part for errors of the keys of its pose."""
    turn, shift = np.zeros(3), np.zeros(3)
    for key, value in zip(keys, values, strict=True):
        if key in POSE:
            a, b = POSE[key]
            turn, shift = turn + value * np.array(a), shift + value * np.array(b)
    angle = np.linalg.norm(turn)
    if not angle > 0.0:
        return np.eye(3), shift
    x, y, z = turn / angle
    k = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + math.sin(angle) * k + 2.0 * math.sin(0.5 * angle) ** 2 * (k @ k), shift


def _of_design(flanks, member, key, fixed):
    """Column (N,) of a key of the design, mm per unit of the key; the keys ``fixed`` do not follow it."""
    column = np.empty(sum(len(rows) for rows in flanks.rows))
    for drive, rows, q in zip(flanks.drives, flanks.rows, flanks.parameters, strict=True):
        m, p = drive.design.model, drive.design.parameters
        given, change = designs.given_vector(drive.design), np.zeros(m.np)
        for other in fixed:
            if other not in POSE:
                k, _ = _column(drive, other)
                given[k] = p[k]
        k, factor = _column(drive, key)
        change[k] = factor
        if library().mw_complete_tangent(m, pointer(given), pointer(p), pointer(change)) < 0:
            raise UsageError(f"--parameters {key}: the rules of the design have no derivative here; leave it out")
        body = [b["name"] for b in drive.design.description["bodies"]].index(member)
        places, moved = np.ascontiguousarray(q), np.empty((len(q), 3))
        library().mw_flank_tangent(m, body, pointer(p), pointer(change), pointer(places), len(q), pointer(moved))
        column[rows] = np.einsum("ni,ni->n", drive.flank(member)(q).normals, moved)
    return column
