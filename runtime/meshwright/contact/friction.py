"""Efficiency and self-locking at the contact, with the user's coefficient of friction.

The pinion presses on the wheel with F n, n out of the pinion, and drags it along with μF in the direction e of its
sliding. With the velocities V1, V2 of both bodies, the pinion turning in the sense in which this flank drives, power
F (n + μe)·V1 goes in and F (n + μe)·V2 comes out; the difference is μF|v_g|. Where the wheel drives with the same
flank, everything moves the other way: (n − μe)·V2 goes in, (n − μe)·V1 comes out, none from μ = n·V1/(e·V1) on: the
drive is self-locking. Source of the principle: G. Niemann and H. Winter, Maschinenelemente III, 2nd ed. (1983).
"""

import csv
import math
import os
from dataclasses import dataclass

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.files import read_table
from meshwright.base.plain import finite_or_nones
from meshwright.contact.velocities import velocities

#: Header of a table of friction.
COLUMNS = ("velocity_m_per_s", "friction")

#: A larger coefficient, file or speed is taken for a mistake.
MOST_FRICTION, LARGEST_FILE, MOST_SPEED = 2.0, 2**20, 1e6

#: Angles of one pitch over which efficiency is averaged.
SAMPLES = 48


@dataclass(frozen=True)
class Friction:
    """Coefficients (M,) of friction at sliding ``speeds`` (M,), m/s, ascending; a single one holds at any speed.

    ``pinion_speed`` in rad/s, NaN where it does not matter.
    """

    speeds: np.ndarray
    coefficients: np.ndarray
    pinion_speed: float = math.nan

    @classmethod
    def of(cls, text, pinion_rpm=None):
        """The friction of a number, or of a CSV file with the columns velocity_m_per_s and friction.

        Raises :class:`~meshwright.base.errors.UsageError` for what is neither, and for a table without the speed.
        """
        if pinion_rpm is not None and not 0.0 < pinion_rpm <= MOST_SPEED:
            raise UsageError(f"--pinion-rpm {pinion_rpm:g}: must be above 0 and {MOST_SPEED:g} at most")
        try:
            number = float(text)
        except ValueError:
            return cls.read(text, pinion_rpm)
        _check(f"--friction {text}", number)
        return cls(np.zeros(1), np.array([number]))

    @classmethod
    def read(cls, path, pinion_rpm):
        """The friction of a table."""
        if pinion_rpm is None:
            raise UsageError(f"--friction {path}: a table over the sliding speed needs the pinion's; give --pinion-rpm")
        if not os.path.exists(path):
            raise UsageError(f"--friction {path}: neither a number nor a file; for example 0.05")
        rows = list(csv.reader(read_table(path, LARGEST_FILE, "a table of friction")))
        rows = [(k, row) for k, row in enumerate(rows, 1) if row and not row[0].startswith("#")]
        if not rows or tuple(cell.strip() for cell in rows[0][1]) != COLUMNS:
            raise UsageError(f"{path}: its header is not {','.join(COLUMNS)}; write it above the table")
        pairs = [_pair(path, k, row) for k, row in rows[1:]]
        if not pairs:
            raise UsageError(f"{path}: holds no line below its header; write speed and coefficient")
        speeds, coefficients = map(np.array, zip(*pairs, strict=True))
        if speeds[0] < 0.0 or not (np.diff(speeds) > 0.0).all():
            raise UsageError(f"{path}: {COLUMNS[0]} does not ascend from 0 or more; sort the lines")
        return cls(speeds, coefficients, pinion_rpm * math.pi / 30.0)

    def at(self, sliding):
        """Coefficients (N,) at sliding velocities (N,), mm per rad of the pinion: straight between the table's lines.

        Raises :class:`~meshwright.base.errors.UsageError` for speeds that the table does not hold.
        """
        if len(self.speeds) == 1 and math.isnan(self.pinion_speed):
            return np.where(np.isnan(sliding), np.nan, self.coefficients[0])
        speeds = 1e-3 * self.pinion_speed * np.asarray(sliding)
        beyond = (speeds < self.speeds[0]) | (speeds > self.speeds[-1])
        if beyond.any():
            raise UsageError(
                f"--friction: the contact slides with {speeds[beyond][0]:.4g} m/s, beyond the table from "
                f"{self.speeds[0]:g} to {self.speeds[-1]:g} m/s; add lines to it, or change --pinion-rpm"
            )
        return np.interp(speeds, self.speeds, self.coefficients)


def _pair(path, number, row):
    try:
        speed, coefficient = map(float, row)
    except ValueError:
        raise UsageError(f"{path}, line {number}: not two numbers {','.join(COLUMNS)}; correct it") from None
    if not math.isfinite(speed):
        raise UsageError(f"{path}, line {number}: {COLUMNS[0]} = {speed} is not finite; correct it")
    _check(f"{path}, line {number}: friction = {row[1].strip()}", coefficient)
    return speed, coefficient


def _check(place, coefficient):
    if not 0.0 <= coefficient <= MOST_FRICTION:
        raise UsageError(f"{place}: not a coefficient from 0 to {MOST_FRICTION:g}; for example 0.05")


@dataclass(frozen=True)
class Efficiency:
    """At N contacts: the coefficient of ``friction``, that from which the drive is ``self_locking``, and the efficiency
    while the pinion or the wheel drives, 0 where it cannot; (N,) each. NaN without contact, infinite where no friction
    locks.
    """

    friction: np.ndarray
    self_locking: np.ndarray
    pinion_drives: np.ndarray
    wheel_drives: np.ndarray

    @property
    def locked(self):
        """Where the wheel cannot drive: (N,) of bool."""
        return self.friction >= self.self_locking

    def plain(self):
        """The points' part of the ``meshwright.tca/1`` document; None for what does not exist."""
        numbers = (self.friction, self.self_locking, self.pinion_drives, self.wheel_drives)
        return [
            {
                "friction": friction,
                "self_locking_friction": locking,
                "self_locking": None if friction is None else locked,
                "efficiency": {"pinion_drives": pinion, "wheel_drives": wheel},
            }
            for friction, locking, pinion, wheel, locked in zip(
                *map(finite_or_nones, numbers), self.locked.tolist(), strict=True
            )
        ]


def efficiency(drive, result, friction=None, moving=None):
    """:class:`Efficiency` at the points of a :class:`~meshwright.contact.results.TCA`.

    Without ``friction`` only what makes the drive self-locking is known. ``moving`` are the velocities, if known.
    """
    moving = velocities(drive, result) if moving is None else moving
    normals = result.normals
    sense = np.sign(_dot(normals, moving.bodies["pinion"]))[:, None]
    one, two = (sense * moving.bodies[name] for name in ("pinion", "wheel"))
    sliding = one - two
    speed = np.linalg.norm(sliding, axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        along = sliding / speed[:, None]
        along[speed == 0.0] = 0.0  # what rolls loses nothing
        lever = _dot(along, one)
        locking = np.where(lever > 0.0, _dot(normals, one) / lever, np.where(np.isnan(lever), np.nan, np.inf))
        mu = np.full(len(speed), np.nan) if friction is None else friction.at(speed)
        drag = mu[:, None] * along
        forward = _dot(normals + drag, two) / _dot(normals + drag, one)
        backward = _dot(normals - drag, one) / _dot(normals - drag, two)
    return Efficiency(mu, locking, np.maximum(forward, 0.0), np.where(mu >= locking, 0.0, np.maximum(backward, 0.0)))


@dataclass(frozen=True)
class Mean:
    """Efficiency over one pitch, of the pair that leads, at constant torque of the wheel; ``self_locking``: least and
    largest coefficient of friction from which the wheel cannot drive. NaN for what does not exist.
    """

    pinion_drives: float
    wheel_drives: float
    self_locking: tuple[float, float]


def mean_efficiency(mesh, friction=None):
    """The :class:`Mean` of a :class:`~meshwright.cycle.pairs.Mesh`; None unless all of a pitch has contact points."""
    if mesh.window.path is None or not mesh.window.complete:
        return None
    drive = mesh.drive
    angles = mesh.window.begin.angle + (np.arange(SAMPLES) + 0.5) / SAMPLES * drive.pitch()
    leading = [mesh.pairs(angle) for angle in angles]
    if not all(leading):
        return None
    result = drive.tca(np.array([pairs[0].angle for pairs in leading]))
    found, ratio = efficiency(drive, result, friction), np.abs(result.instantaneous_ratio)
    with np.errstate(divide="ignore"):
        return Mean(
            float(ratio.mean() / (ratio / found.pinion_drives).mean()),
            float((ratio * found.wheel_drives).mean() / ratio.mean()),
            (float(found.self_locking.min()), float(found.self_locking.max())),
        )


def _dot(a, b):
    return np.einsum("ni,ni->n", a, b)
