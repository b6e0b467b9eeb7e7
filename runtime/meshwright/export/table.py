"""The error of a drive over one pitch as polynomials with one bound: what both flanks transmit, all pairs together.

Between two changes of the leading pair its certified path gives Chebyshev series; what they lack of the true error of
that pair is bounded by the half-width of the certificate's tube, the coefficients that are left out, and rounding.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import chebyshev

from meshwright.base.errors import UsageError
from meshwright.base.library import ffi, library
from meshwright.contact.certified_path import TUBE, certified_path
from meshwright.contact.results import ARCSEC
from meshwright.cycle.backlash import backlash, offsets
from meshwright.cycle.certified_cycle import leading
from meshwright.cycle.certified_extreme import enclosed_extremes
from meshwright.cycle.pairs import Mesh

#: Degree of the certified polynomials, which a part of one has too.
DEGREE = 8

#: Units in the last place that evaluating a series and forming its coefficients cost, of the sum of their sizes.
ROUNDED = 8.0

#: Parts of a pitch below which nothing is a piece of its own, nor between two pieces.
SHORTEST = 1e-9

#: Pieces whose values differ by less where they meet, rad, go on without a jump.
STEP = 1e-7 * ARCSEC

#: Beside a place where the flanks' curvature is singular no tube is narrow: how much wider ones are tried.
WIDER = (1e1, 1e3, 1e5)

#: Samples of a pitch: at which it is asked whether an edge may touch first, and at which a constant error is enclosed.
EDGE_SAMPLES, CONSTANT_SAMPLES = 257, 5


@dataclass(frozen=True)
class Piece:
    """The error, rad, from one pinion angle to another, rad, where ``pair`` leads: a Chebyshev series over them."""

    begin: float
    end: float
    pair: int
    chebyshev: np.ndarray

    def at(self, angles):
        """Errors at angles (M,) of the piece."""
        return chebyshev.chebval(self._shares(angles), self.chebyshev)

    def slopes(self, angles):
        """Their derivatives by the angle."""
        return chebyshev.chebval(self._shares(angles), self.derivative)

    def _shares(self, angles):
        return (2.0 * np.asarray(angles) - (self.begin + self.end)) / (self.end - self.begin)

    @property
    def derivative(self):
        """Chebyshev series of the derivative by the angle."""
        return chebyshev.chebder(self.chebyshev) * (2.0 / (self.end - self.begin))


@dataclass(frozen=True)
class Table:
    """Errors of a drive over one ``pitch`` of the pinion from angle 0, as the user counts angles, and on from pitch to
    pitch; rad. ``drive`` and ``coast``: pieces of either flank in the angles of the first, ascending; none where a
    flank has no design here. ``bound``: what a series lacks at most of the error of the pair that leads. ``sense``: 1
    where the pinion pushes the wheel to larger angles, −1 to smaller. ``edges``: of ``drive`` and ``coast`` those of
    which an edge may touch before the pair that leads; ``open``: those of which no pair touches at some angles.
    """

    pitch: float
    teeth: int
    ratio: float
    sense: int
    bound: float
    backlash: float
    drive: tuple[Piece, ...]
    coast: tuple[Piece, ...]
    edges: tuple[str, ...]
    open: tuple[str, ...]

    def errors(self, angles, side="drive"):
        """Errors of a side at angles (M,) from 0 to a pitch, NaN where no pair touches."""
        return self._by_piece(angles, side, Piece.at)

    def ratios(self, angles):
        """d(wheel angle)/d(pinion angle) of the driving flank there."""
        return self.ratio + self._by_piece(angles, "drive", Piece.slopes)

    def _by_piece(self, angles, side, of):
        found = np.full(len(angles), np.nan)
        for piece in getattr(self, side):
            here = (piece.begin <= angles) & (angles <= piece.end)
            found[here] = of(piece, angles[here])
        return found


def table(drive, tolerance, coast=None):
    """The :class:`Table` of a drive, as few terms as a tolerance, rad, allows; ``coast``: the drive of the other flank,
    where that has a design of its own. Raises :class:`~meshwright.base.errors.UsageError` where there is no proof.
    """
    coast = drive.other_side if coast is None else coast
    found = drive.cycle(np.linspace(0.0, drive.pitch(), EDGE_SAMPLES), coast)
    here = Mesh.of(drive)
    sides, bounds = {"drive": (), "coast": ()}, {}
    sides["drive"], bounds["drive"] = _side(here, tolerance, 0.0, 0.0)
    if coast is not None:
        there = Mesh.of(coast)
        pinion, wheel = (drive.design.mirror.sign * offset for offset in offsets(here, there))
        sides["coast"], bounds["coast"] = _side(there, tolerance, pinion, drive.ratio * pinion + wheel)
        sides["coast"] = _beside(sides["coast"], found.coast.errors, drive)
    covered = {name: sum(piece.end - piece.begin for piece in pieces) for name, pieces in sides.items() if pieces}
    return Table(
        pitch=drive.pitch(),
        teeth=drive.teeth("pinion"),
        ratio=drive.ratio,
        sense=int(here.sense),
        bound=float(max(bounds.values())),
        backlash=backlash(drive) if coast is drive.other_side else _least(found.backlash),
        **sides,
        edges=tuple(name for name in sides if sides[name] and getattr(found, name).edges.any()),
        open=tuple(name for name, length in covered.items() if length < drive.pitch() * (1.0 - SHORTEST)),
    )


def _least(values):
    """The least of the values; NaN where one is none."""
    return float(np.min(values)) if np.isfinite(values).all() else math.nan


def _beside(pieces, errors, drive):
    """Pieces of the other flank of the tooth space that the drive's cycle looks at."""
    known = np.flatnonzero(np.isfinite(errors))
    tooth, angles = drive.pitch() * drive.ratio, np.linspace(0.0, drive.pitch(), len(errors))
    for k in known:
        for piece in pieces:
            if piece.begin <= angles[k] <= piece.end:
                behind = tooth * round((float(piece.at(angles[k])) - errors[k]) / tooth)
                return tuple(
                    Piece(p.begin, p.end, p.pair, np.concatenate([[p.chebyshev[0] - behind], p.chebyshev[1:]]))
                    for p in pieces
                )
    return pieces


def _side(mesh, tolerance, pinion, error):
    """Pieces over one pitch of a mesh whose own angles are ``pinion`` more than the driving flank's, and whose errors
    are ``error`` less, rad; and their bound.
    """
    if mesh.path is None:
        return _constant(mesh, pinion, error)
    pitch, sign = mesh.drive.pitch(), mesh.mirror
    pieces, bound = [], 0.0
    for own in leading(mesh):
        low, high = sorted(sign * end for end in own)
        path = _proved(mesh.drive, low, high, min(TUBE, tolerance / 8.0))
        if path.gaps:
            gap = path.gaps[0]
            raise UsageError(
                f"--table: no proof of contact from {math.degrees(gap.begin):g} to {math.degrees(gap.end):g} degrees of"
                f" a pair's own angle ({gap.reason}): without it nothing bounds the table; change the design"
            )
        for piece, ends in zip(path.pieces, path.ends, strict=True):
            for k, begin, end in _in_pitch(sorted(float(sign * e - pinion) for e in ends), pitch):
                series, off = _series(mesh, piece, begin, end, pinion - k * pitch, error, tolerance / 8.0)
                pieces.append(Piece(float(begin), float(end), k, series))
                bound = max(bound, off)
    pieces, stretched = _joined(sorted(pieces, key=lambda piece: piece.begin), pitch)
    steps = [abs(float(a.at(a.end)) - float(b.at(b.begin))) for a, b in zip(pieces, pieces[1:], strict=False)]
    return tuple(pieces), bound + stretched + max((step for step in steps if step < STEP), default=0.0)


def _proved(drive, low, high, tube):
    """The certified path within ``tube``, rad, or the narrowest of :data:`WIDER` in which there is one."""
    for wide in (tube, *(tube * factor for factor in WIDER)):
        path = certified_path(drive, low, high, wide, drive.pitch())
        if path.complete:
            break
    return path


def _in_pitch(ends, pitch):
    """Parts (k, begin, end) of a range of a pair's angles that pair k passes between angle 0 and a pitch."""
    low, high = ends
    for k in range(math.floor(-high / pitch), math.ceil((pitch - low) / pitch) + 1):
        begin, end = max(low + k * pitch, 0.0), min(high + k * pitch, pitch)
        if end - begin > SHORTEST * pitch:
            yield k, begin, end


def _series(mesh, piece, begin, end, shift, error, allowed):
    """Chebyshev coefficients of a part of a certified piece, right hand at the mirrored own angle, and their bound."""
    nodes = np.cos(np.pi * (np.arange(DEGREE + 1) + 0.5) / (DEGREE + 1))
    angles = 0.5 * (begin + end) + 0.5 * (end - begin) * nodes + shift
    of = ffi.addressof(piece.x[mesh.drive.design.description["error"]])
    balls = [library().mw_piece_at(piece, of, mesh.mirror * angle) for angle in angles]
    values = mesh.mirror * np.array([ball.mid for ball in balls]) + error
    series = chebyshev.chebfit(nodes, values, DEGREE)
    left_out, kept = 0.0, len(series)
    while kept > 1 and left_out + abs(series[kept - 1]) <= allowed:
        kept -= 1
        left_out += abs(series[kept])
    rounding = ROUNDED * np.finfo(float).eps * np.abs(series).sum()
    return series[:kept], max(ball.radius for ball in balls) + left_out + rounding


def _joined(pieces, pitch):
    """Pieces stretched to meet, from 0 to a pitch, where they nearly do; and what that adds to a bound."""
    found, added, near = [], 0.0, SHORTEST * pitch
    for k, piece in enumerate(pieces):
        after = pieces[k + 1].begin if k + 1 < len(pieces) else pitch
        end = after if abs(after - piece.end) < near else piece.end
        begin = 0.0 if k == 0 and piece.begin < near else piece.begin
        away = max(abs(end - piece.end), abs(begin - piece.begin))
        added = max(added, away * float(np.max(np.abs(piece.slopes([piece.begin, piece.end])))))
        found.append(Piece(begin, end, piece.pair, piece.chebyshev))
    return found, 2.0 * added


def _constant(mesh, pinion, error):
    """The piece of flanks that touch along lines with one error, as their first contact encloses it."""
    if not (mesh.constant and mesh.contact_ratio >= 1.0):
        raise UsageError(
            "--table: the flanks touch on edges, whose errors no proof bounds over a range; `meshwright ratio` has them"
        )
    drive, pitch = mesh.drive, mesh.drive.pitch()
    angles = mesh.mirror * mesh.middle + np.linspace(-0.5, 0.5, CONSTANT_SAMPLES) * pitch
    contacts = drive.tca(angles)
    bounds = enclosed_extremes(drive, contacts).bounds
    value = float(np.mean(contacts.error))
    off = float(np.max(np.abs(bounds - value)))
    if not math.isfinite(off):
        raise UsageError("--table: nothing proves where these flanks touch first; change the design")
    return (Piece(0.0, pitch, 0, np.array([value + error])),), off
