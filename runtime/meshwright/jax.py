"""Contact in JAX: functions of the pinion angle and of free keys, under ``jit``, ``vmap``, ``jvp`` and ``grad``.

>>> import jax
>>> from meshwright import Drive
>>> jax.config.update("jax_enable_x64", True)
>>> from meshwright.jax import follow
>>> at = follow(Drive.load("recess-action-full"), free=("misalignment.center_distance_mm",))
>>> slope = jax.grad(lambda v: at(0.3, v).error)(jax.numpy.array([0.01]))   # rad/mm

The compiled library solves (``jax.pure_callback``); the derivatives are those of the generated sensitivity headers
(:mod:`meshwright.sensitivity`), exact at the solution, of first order, forwards and backwards. A batch is one call of
the library for each set of values of the keys. Numbers that are counted have the derivative 0, and all that has none is
NaN.
"""

# pyright: reportMissingImports=false, reportAttributeAccessIssue=false
# Without the extra the import is taken for this file.

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from meshwright.base.errors import DesignError, UsageError
from meshwright.base.library import library, pointer
from meshwright.contact.analysis import statuses
from meshwright.drive import Drive
from meshwright.sensitivity import sensitivity
from meshwright.sweep import samples

try:
    import jax
    import jax.numpy as jnp
except ImportError as error:
    raise ImportError("meshwright.jax needs JAX: `pip install 'meshwright[jax]'` brings it") from error

#: Which number of what mw_cycle_setup fills is the pinion's way from one flank to the other: MWI_PINION_OFFSET.
_PINION_OFFSET = 1

#: Designs whose drives are kept, newest first: a value and its derivatives ask for the same.
_KEPT = 64


class Followed(NamedTuple):
    """The contact of the pair in mesh, as of :meth:`meshwright.Drive.turn`; angles in rad.

    ``pair`` its number, ``angle`` its own pinion angle, ``error`` its transmission error, NaN without contact,
    ``status`` the number of a status (``meshwright.contact.analysis.statuses``), negative without contact.
    """

    pair: jax.Array
    angle: jax.Array
    error: jax.Array
    status: jax.Array


class Cycled(NamedTuple):
    """The whole drive, all pairs and both flanks, as of :meth:`meshwright.Drive.cycle`; angles in rad.

    ``error`` and ``coast_error``: transmission errors of the flank that drives and of the other; the instantaneous
    ratio is that of the teeth plus the derivative of ``error`` by the pinion angle. ``backlash`` between both.
    ``leading`` and ``coast_leading``: numbers of the pairs that lead. ``status``, ``coast_status``: as of
    :class:`Followed`. ``edge``: 1 where the edge of another pair may touch before the one that leads. The coast side is
    NaN where it has a design of its own.
    """

    error: jax.Array
    coast_error: jax.Array
    backlash: jax.Array
    leading: jax.Array
    coast_leading: jax.Array
    status: jax.Array
    coast_status: jax.Array
    edge: jax.Array


def follow(drive, free=()):
    """JAX function (phi, v) → :class:`Followed` of a :class:`~meshwright.Drive`.

    ``phi`` is a pinion angle, rad, to 10¹² rad; ``v`` (K,) are values of the keys ``free`` ("table.key") in the units
    of the keys, and may be left out where there are none. What follows from the keys by rules and design systems
    follows them. Values that make no design, and angles beyond that, have no contact. Raises ``DesignError`` or
    :class:`~meshwright.base.errors.UsageError` for a key that does not vary, for what is not of these shapes, and where
    JAX computes in single precision.
    """
    return _function(drive, free, Followed, _followed, _slopes_followed)


def cycle(drive, free=()):
    """JAX function (phi, v) → :class:`Cycled` of a :class:`~meshwright.Drive`; arguments as of :func:`follow`."""
    return _function(drive, free, Cycled, _cycled, _slopes_cycled)


def _function(drive, free, kind, values, slopes):
    """A JAX function that calls two of a drive and angles: ``values`` (N, fields), ``slopes`` (N, fields, 1 + K)."""
    _checked(drive, free)
    codes = {word: code for code, word in sorted(statuses().items(), reverse=True)}  # of one word the first

    @lru_cache(_KEPT)
    def drive_of(row):
        try:
            return samples.with_keys(drive, free, np.array(row)) if free else drive
        except (DesignError, UsageError):
            return None

    def called(ask, shape):
        def on_host(phi, v):
            """Arguments with leading axes of a batch, the same of both."""
            angles = np.asarray(phi, float).reshape(-1)
            rows = np.asarray(v, float).reshape(angles.size, len(free))
            found = np.full((angles.size, *shape), np.nan)
            sets, of = np.unique(rows, axis=0, return_inverse=True)
            possible = np.abs(angles) <= library().mw_largest_angle()
            for k, row in enumerate(sets):
                own, here = drive_of(tuple(row.tolist())), possible & (of.reshape(-1) == k)
                if own is not None and here.any():
                    found[here] = ask(own, free, angles[here], codes)
            return found.reshape(*np.shape(phi), *shape)

        result = jax.ShapeDtypeStruct(shape, np.dtype(float))
        return lambda phi, v: jax.pure_callback(on_host, result, phi, v, vmap_method="broadcast_all")

    of_values, of_slopes = called(values, (len(kind._fields),)), called(slopes, (len(kind._fields), 1 + len(free)))

    @jax.custom_jvp
    def solved(phi, v):
        return of_values(phi, v)

    @solved.defjvp
    def _(primals, tangents):
        turn, change = tangents
        return solved(*primals), of_slopes(*primals) @ jnp.concatenate([jnp.reshape(turn, 1), change])

    def function(phi, v=()):
        if not jax.config.jax_enable_x64:
            raise UsageError("JAX computes in single precision; call jax.config.update('jax_enable_x64', True) first")
        phi, v = (jnp.asarray(a, float) + 0.0 for a in (phi, v))  # a sum is JAX's own, where vmap holds NumPy's array
        if phi.shape != () or v.shape != (len(free),):
            shapes = f"phi of shape {phi.shape}, v of shape {v.shape}"
            raise UsageError(f"{shapes}: give shapes () and ({len(free)},); jax.vmap takes many at once")
        return kind(*map(_counted, kind._fields, solved(phi, v)))

    return function


def _counted(field, value):
    """Statuses and marks as integers; a status that is none is bad input."""
    if "status" in field:
        return jnp.where(jnp.isnan(value), library().MW_BAD_INPUT, value).astype(jnp.int32)
    return jnp.where(jnp.isnan(value), 0, value).astype(jnp.int32) if field == "edge" else value


def _checked(drive, free):
    if not isinstance(drive, Drive):
        raise UsageError(f"drive = {drive!r}: no drive; give Drive.load(…)")
    if isinstance(free, str) or len({*free}) < len(free):
        raise UsageError(f"free = {free!r}: give a tuple of different keys, each table.key")
    for key in free:
        samples.column(drive, key)
        if key.partition(".")[0] not in ("design", "misalignment"):
            raise DesignError(key, None, "it does not form the flanks, and has no derivatives", "leave it out of free")


def _followed(drive, _, angles, codes):
    found = drive.turn(angles)
    return np.stack([found.pairs, found.own_angles, found.errors, [codes[word] for word in found.statuses]], axis=1)


def _slopes_followed(drive, free, angles, _):
    found = np.zeros((len(angles), len(Followed._fields), 1 + len(free)))
    found[:, 1, 0] = 1.0
    found[:, 2] = _slopes(drive, free, drive.turn(angles).own_angles)
    return found


def _cycled(drive, _, angles, codes):
    found = drive.cycle(angles)
    sides = found.drive, found.coast
    ended = [[codes[word] for word in side.statuses] for side in sides]
    errors, leading = ([getattr(side, what) for side in sides] for what in ("errors", "pairs"))
    return np.stack([*errors, found.backlash, *leading, *ended, found.drive.edges], axis=1)


def _slopes_cycled(drive, free, angles, _):
    at, pitch, sign, other = drive.cycle(angles), drive.pitch(), drive.design.mirror.sign, drive.other_side
    found = np.zeros((len(angles), len(Cycled._fields), 1 + len(free)))
    found[:, 0] = _slopes(drive, free, at.own_angles + pitch * (at.pairs - at.drive.pairs))
    found[:, 1:3] = np.nan
    if other is not None:
        turned = at.own_angles + sign * _offset(drive, other) + pitch * (at.pairs - at.coast.pairs)
        found[:, 1] = _slopes(other, free, turned)
        apart = at.coast.errors - at.drive.errors
        found[:, 2] = (np.sign(apart) * np.sign(at.backlash))[:, None] * (found[:, 1] - found[:, 0])
    return found


def _offset(drive, other):
    """What to add to pinion angles of the right-hand drive to have those of its other flank: a part of a pitch."""
    m, lib = drive.model, library()
    c = np.empty(lib.mw_cycle_size(m))
    lib.mw_cycle_setup(m, pointer(drive.design.parameters), pointer(other.design.parameters), pointer(c))
    return c[_PINION_OFFSET]


def _slopes(drive, free, own_angles):
    """Derivatives (N, 1 + K) of the transmission error of a pair at its own angles by pinion angle and keys, in the
    units of the keys; NaN where it has no contact point, or the angle is none.
    """
    found = np.full((len(own_angles), 1 + len(free)), np.nan)
    rows = np.isfinite(own_angles)
    result = sensitivity(drive, own_angles[rows])
    factors = [samples.column(drive, key)[1]["factor"] for key in free]
    columns = [result.error[:, result.of(key)] * factor for key, factor in zip(free, factors, strict=True)]
    found[rows] = np.stack([result.error_by_angle, *columns], axis=1)
    return found
