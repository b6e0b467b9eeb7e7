"""Transmission error of a pair and of the whole drive: envelopes, transfer points, Fourier components, backlash."""

import math
from dataclasses import dataclass

import numpy as np

from meshwright.base.roots import bracketed
from meshwright.cycle.edge_contact import edge_paths
from meshwright.cycle.rigid import ROUND_OFF

#: Samples of one pitch for envelopes; a power of two for the Fourier transform.
SAMPLES = 256

ANGLE_TOLERANCE = 1e-10

#: Samples of a pair's window, and of one pitch, where each takes a search.
PAIR_SAMPLES = 33
PITCH_SAMPLES = 64

#: The ends of a window are left out by this share of it.
INNER = 1e-6


@dataclass(frozen=True)
class TransmissionError:
    """Transmission error of a drive; angles and errors in rad, NaN for what does not exist.

    ``transfers`` are the angles at which a pair takes over from its predecessor and hands over to its successor,
    where neighbours agree: TE(φ) = TE(φ ∓ pitch). ``vertex`` is where the pair's curve is stationary.
    Both are sought up to a pitch beyond the window. The transmitted envelope is over the pairs inside their windows.
    The other one, which rigid bodies do not transmit, is the papers' "kinematic error": where it runs through the
    vertex its peak to peak is the difference of vertex and transfer, even if the limits cut off the transfer.
    ``envelope_with_edges`` is what rigid teeth transmit, the first contact of all pairs: tangency, edge or corner.
    Where the blank does not bound the flanks it is followed from the ends of the path alone.
    ``rides_on_edge``: the pair that leads stands at an end of its window.
    """

    envelope: str
    pair_peak_to_peak: float
    envelope_peak_to_peak: float
    envelope_with_edges_peak_to_peak: float
    other_envelope_peak_to_peak: float
    transfers: tuple[float, ...]
    vertex: float
    rides_on_edge: bool


@dataclass(frozen=True)
class Envelopes:
    """Transmission errors over pinion ``angles`` (N,), rad: of the ``pairs`` (K, N), NaN where they do not touch, and
    the largest and smallest of them. ``numbers`` are the pairs' k, ``leading`` (N,) the k of the pair that drives;
    ``edge_contact`` (K, N): an edge of the pair touches, not its flanks.
    """

    angles: np.ndarray
    numbers: tuple[int, ...]
    pairs: np.ndarray
    upper: np.ndarray
    lower: np.ndarray
    leading: np.ndarray
    edge_contact: np.ndarray


def transmission_error(mesh):
    """:class:`TransmissionError` of a :class:`~meshwright.cycle.pairs.Mesh`."""
    window, nothing = mesh.window, math.nan
    if mesh.path is None and window.complete:
        return _of_extremes(mesh)
    vertex, transfers = _vertex(mesh), _transfers(mesh)
    if not window.complete:
        return TransmissionError(mesh.envelope, nothing, nothing, nothing, nothing, transfers, vertex, False)
    low, high = sorted((window.begin.angle, window.end.angle))
    pair = mesh.errors(_critical(mesh, low, high, vertex))
    upper, lower = _ranges(mesh, (low, high), vertex, transfers)
    teeth = mesh.rigid
    rigid = math.nan if teeth is None else teeth.peak_to_peak()
    if teeth is None or not (math.isfinite(rigid) or teeth.unknown):
        rigid = _ranges(mesh, (low, high), vertex, transfers, edge_paths(mesh))[0 if mesh.sense > 0 else 1]
    transmitted, other = (upper, lower) if mesh.sense > 0 else (lower, upper)
    if transfers and math.isfinite(vertex):
        at_vertex, at_transfer = mesh.errors([vertex, transfers[0]])
        if mesh.sense * (at_transfer - at_vertex) > 0.0:
            other = abs(at_transfer - at_vertex)
    return TransmissionError(
        envelope=mesh.envelope,
        pair_peak_to_peak=float(np.ptp(pair)),
        envelope_peak_to_peak=transmitted,
        envelope_with_edges_peak_to_peak=rigid,
        other_envelope_peak_to_peak=float(other),
        transfers=transfers,
        vertex=vertex,
        rides_on_edge=_extreme_at_an_end(mesh, pair),
    )


def _of_extremes(mesh):
    """The same where no path says where pairs touch: they do along lines, or at an end of one."""
    teeth = mesh.rigid
    if mesh.constant and mesh.contact_ratio >= 1.0:
        return TransmissionError(mesh.envelope, 0.0, 0.0, 0.0, 0.0, (), math.nan, False)
    rigid = math.nan if teeth is None else teeth.peak_to_peak()
    low, high = sorted((mesh.window.begin.angle, mesh.window.end.angle))
    inner = INNER * (high - low)
    pair = mesh.errors(np.linspace(low + inner, high - inner, PAIR_SAMPLES))
    transmitted, other = _over_a_pitch(mesh)
    spreads = _range(pair), transmitted, rigid, other
    return TransmissionError(mesh.envelope, *spreads, (), math.nan, _extreme_at_an_end(mesh, pair))


def _over_a_pitch(mesh):
    """Peak to peak of the transmitted envelope and of the other one, rad, of a window with both ends and no path."""
    if mesh.constant and mesh.contact_ratio >= 1.0:
        return 0.0, 0.0
    low, high = sorted((mesh.window.begin.angle, mesh.window.end.angle))
    first = low + INNER * (high - low)
    found = envelopes(mesh, first + np.arange(PITCH_SAMPLES) / PITCH_SAMPLES * mesh.drive.pitch())
    return tuple(_range(errors) for errors in (found.upper, found.lower)[:: int(mesh.sense)])


def _range(errors):
    """Largest less smallest of errors (N,), rad; NaN where one is none, 0 where it is rounding."""
    spread = float(np.ptp(errors))
    return 0.0 if spread < ROUND_OFF else spread


def changes(mesh, transfers):
    """Those ``transfers`` at which a pair takes over and hands over, both inside its window; empty if it cannot.

    Beyond the window the curves cross, but no flanks touch: pairs then change where one ends.
    """
    if not mesh.window.complete:
        return transfers
    low, high = sorted((mesh.window.begin.angle, mesh.window.end.angle))
    return transfers if all(low <= angle <= high for angle in transfers) else ()


def rides_on_edge(mesh):
    """Whether the pair that leads stands at an end of its window; False if an end does not exist."""
    if not mesh.window.complete:
        return False
    low, high = sorted((mesh.window.begin.angle, mesh.window.end.angle))
    return _extreme_at_an_end(mesh, mesh.errors(_critical(mesh, low, high, _vertex(mesh))))


def _extreme_at_an_end(mesh, pair):
    """For errors of a pair over its window, ascending."""
    return bool(np.ptp(pair) > ROUND_OFF and np.argmax(mesh.sense * pair) in (0, len(pair) - 1))


def peak_to_peak(mesh):
    """Peak to peak of the transmitted envelope alone, rad; NaN for a window without both ends."""
    if not mesh.window.complete:
        return math.nan
    if mesh.path is None:
        return _over_a_pitch(mesh)[0]
    ends = tuple(sorted((mesh.window.begin.angle, mesh.window.end.angle)))
    return _ranges(mesh, ends, _vertex(mesh), _transfers(mesh))[0 if mesh.sense > 0 else 1]


def envelopes(mesh, angles, edges=(None, None)):
    """:class:`Envelopes` at pinion angles (N,), over the pairs inside their windows and, with the mesh's
    :func:`~meshwright.cycle.edge_contact.edge_paths`, those that touch with an edge.
    """
    angles = np.atleast_1d(np.asarray(angles, dtype=float))
    reach = _reach(mesh, edges)
    inside = [mesh.numbers(angle, reach) for angle in angles]
    numbers = tuple(sorted(set().union(*inside)))
    pairs, on_edge = np.full((len(numbers), len(angles)), np.nan), np.zeros((len(numbers), len(angles)), dtype=bool)
    for row, edge_row, number in zip(pairs, on_edge, numbers, strict=True):
        here = np.array([number in present for present in inside])
        row[here], edge_row[here] = _pair_errors(mesh, angles[here] - number * mesh.drive.pitch(), edges)
    touching = ~np.isnan(pairs).all(axis=0)
    upper, lower, leading = (np.full(len(angles), np.nan) for _ in range(3))
    if touching.any():
        upper[touching], lower[touching] = np.nanmax(pairs[:, touching], axis=0), np.nanmin(pairs[:, touching], axis=0)
        leading[touching] = np.array(numbers)[np.nanargmax(mesh.sense * pairs[:, touching], axis=0)]
    return Envelopes(angles, numbers, pairs, upper, lower, leading, on_edge)


def _reach(mesh, edges):
    """Angles between which a pair touches, with the flanks or with an edge, in the mesh's own counting."""
    bounds = [mesh.mirror * b for e in edges if e is not None for b in e.bounds]
    if mesh.window.complete:
        bounds += [mesh.window.begin.angle, mesh.window.end.angle]
    return (min(bounds), max(bounds)) if bounds else None


def _pair_errors(mesh, own, edges):
    """Transmission errors at a pair's own angles (N,), and where an edge touches."""
    errors, on_edge = mesh.errors(own), np.zeros(len(own), dtype=bool)
    if not mesh.window.complete:
        return errors, on_edge
    low, high = sorted((mesh.window.begin.angle, mesh.window.end.angle))
    for edge, beyond in zip(edges[:: int(mesh.mirror)], (own < low, own > high), strict=True):
        if beyond.any():
            errors[beyond] = np.nan if edge is None else mesh.mirror * edge.errors(mesh.mirror * own[beyond])
            on_edge |= beyond
    return errors, on_edge


def fourier(mesh, orders=8):
    """Amplitudes and phases (rad) of the transmitted envelope at tooth orders 1 … ``orders``: two arrays (orders,).

    TE(φ) = mean + Σ a_n cos(n·2π·φ/pitch + p_n), from 256 samples of one pitch, 64 without a path.
    """
    samples = SAMPLES if mesh.path is not None else PITCH_SAMPLES
    if mesh.constant:
        return np.zeros(orders), np.zeros(orders)
    found = envelopes(mesh, np.arange(samples) / samples * mesh.drive.pitch())
    spectrum = np.fft.rfft(found.upper if mesh.sense > 0 else found.lower) / samples
    return 2.0 * np.abs(spectrum[1 : orders + 1]), np.angle(spectrum[1 : orders + 1])


def _searched(mesh):
    """Ascending samples of where vertex and transfers are sought: the window and a pitch to either side."""
    path, pitch = mesh.window.path, mesh.drive.pitch()
    reach = sorted((mesh.mirror * path.angles[0], mesh.mirror * path.angles[-1]))
    if mesh.window.complete:
        ends = sorted((mesh.window.begin.angle, mesh.window.end.angle))
        reach = max(reach[0], ends[0] - pitch), min(reach[1], ends[1] + pitch)
    return _samples(mesh, *reach)


def _samples(mesh, low, high):
    return np.linspace(low, high, max(33, math.ceil((high - low) / mesh.drive.pitch() * 32)))


def _middle(mesh):
    """Middle of the window, or angle 0 without one."""
    return 0.5 * (mesh.window.begin.angle + mesh.window.end.angle) if mesh.window.complete else 0.0


def _slope(mesh, angle):
    return float(mesh.window.path.error_slopes([mesh.mirror * angle])[0])


def _vertex(mesh):
    """Where the pair's error is stationary, nearest to the middle of the window; NaN if nowhere."""
    angles = _searched(mesh)
    if np.ptp(mesh.errors(angles)) < ROUND_OFF:
        return math.nan
    slopes = mesh.window.path.error_slopes(mesh.mirror * angles)
    roots = _roots(lambda a: _slope(mesh, a), angles, slopes)
    return min(roots, key=lambda a: abs(a - _middle(mesh)), default=math.nan)


def _transfers(mesh):
    """The angles at which a pair takes over and hands over; empty if neighbours never agree."""
    pitch, angles = mesh.drive.pitch(), _searched(mesh)
    angles = angles[angles <= angles[-1] - pitch]
    if len(angles) < 2:
        return ()

    def step(angle):
        first, last = mesh.errors([angle, angle + pitch])
        return last - first

    steps = mesh.errors(angles + pitch) - mesh.errors(angles)
    if np.abs(steps).max() < ROUND_OFF:
        return ()
    roots = _roots(step, angles, steps)
    if not roots:
        return ()
    first = min(roots, key=lambda a: abs(a + pitch / 2 - _middle(mesh)))
    return (first, first + pitch)


def _roots(function, angles, values):
    return [
        float(bracketed(function, a, b, ANGLE_TOLERANCE, (fa, fb)))
        for a, b, fa, fb in zip(angles, angles[1:], values, values[1:], strict=False)
        if fa * fb < 0.0 or fa == 0.0
    ]


def _critical(mesh, low, high, *places):
    """Ascending angles of a window at which an extreme can be: its ends, samples between, and given places."""
    inner = [p for p in places if math.isfinite(p) and low < p < high]
    return np.unique(np.concatenate([_samples(mesh, low, high), inner]))


def _ranges(mesh, ends, vertex, transfers, edges=(None, None)):
    """Peak to peak of the upper and the lower envelope over one pitch, with both sides of every jump."""
    pitch, low = mesh.drive.pitch(), ends[0]
    special = [*ends, *transfers, *([vertex] if math.isfinite(vertex) else [])]
    sides = np.array([s + side * 1e-9 * pitch for s in special for side in (-1, 0, 1)])
    angles = low + np.concatenate([np.arange(SAMPLES) / SAMPLES * pitch, (sides - low) % pitch])
    found = envelopes(mesh, angles, edges)
    return tuple(float(np.nanmax(e) - np.nanmin(e)) for e in (found.upper, found.lower))
