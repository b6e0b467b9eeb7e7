"""Everything that a report shows, computed once: the figures and the page only read it."""

import math
from contextlib import suppress
from dataclasses import dataclass, replace

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.worker import in_worker
from meshwright.contact.contact_line import ContactLine
from meshwright.contact.flags import not_first
from meshwright.contact.friction import Efficiency, efficiency
from meshwright.contact.placement import placed
from meshwright.contact.results import TCA, impossible
from meshwright.contact.velocities import Velocities, velocities
from meshwright.cycle.backlash import backlash
from meshwright.cycle.edge_contact import edge_paths
from meshwright.cycle.first_results import FirstContacts
from meshwright.cycle.pairs import Mesh
from meshwright.cycle.transmission import (
    ROUND_OFF,
    Envelopes,
    TransmissionError,
    envelopes,
    fourier,
    transmission_error,
)
from meshwright.drive import Drive
from meshwright.flank.mesh import mesh
from meshwright.pattern.pattern import Contour, along_ellipse, contours
from meshwright.report.branches import breaks
from meshwright.report.patch import Patch, patch
from meshwright.report.sensitivity import Sensitivity, checked_sizes, misalignments, sensitivity
from meshwright.report.whole_flank import WholeFlank, whole_flanks

#: Least number of positions over the contact of one pair, and largest step of the pinion, rad.
POSITIONS, LARGEST_STEP = 120, math.radians(5.0)

#: Pitches shown to either side of angle 0 where no limit ends the contact.
WITHOUT_END = 1.0

#: How many positions a pitch are shown where the flanks touch along lines, or at an end of them.
LINES_PER_PITCH = 12

#: Contours of the contact pattern along the path, and directions in each.
CONTOURS, DIRECTIONS = 9, 96

#: Cells of a flank, across and along, that an edge touches.
FLANK_CELLS = (12, 24)

#: Tooth orders of the Fourier components.
ORDERS = 8


@dataclass(frozen=True)
class Running:
    """All pairs of the drive together.

    ``envelopes`` run over the window, ``pitch`` over one pitch in its middle, with the number of ``teeth`` in contact
    and the ``separations`` (K, N), mm, of the pairs ``pitch.numbers``; ``rigid`` is the pitch once more for rigid
    teeth, whose edges go on where a flank has ended. ``amplitudes`` are those of the transmitted error by tooth order,
    rad; ``backlash`` is a wheel angle, rad.
    """

    mesh: Mesh
    error: TransmissionError
    envelopes: Envelopes
    pitch: Envelopes
    rigid: Envelopes
    teeth: np.ndarray
    separations: np.ndarray
    amplitudes: np.ndarray
    backlash: float

    def transmitted(self, found):
        """The transmitted one of the envelopes ``found``, rad: (N,)."""
        return found.upper if self.error.envelope == "upper" else found.lower

    @property
    def known(self):
        """Whether there is a transmission error anywhere over the pitch in the middle: some pair touches there."""
        return bool(np.isfinite(self.pitch.pairs).any())

    @property
    def constant(self):
        """Whether the transmission error of a pair is constant to round-off; it is not where none is known."""
        known = self.envelopes.pairs[np.isfinite(self.envelopes.pairs)]
        return bool(known.size) and float(np.ptp(known)) < ROUND_OFF

    @property
    def varies(self):
        """Whether the transmission error has Fourier components worth showing."""
        return not self.constant and bool(np.isfinite(self.amplitudes).all())


@dataclass(frozen=True)
class Analysis:
    """The analysis of a drive over one pair's contact.

    ``tca`` is at N ascending angles, ``steps_per_pitch`` of them a pitch; ``pattern`` is at some of them. ``lines`` (N)
    exist only where the flanks touch along lines. They, the ``matrices`` (N, 4, 4) that place the members' frames in
    the fixed frame, and the ``patches`` of the flanks are those of the right-hand drive. ``running`` is None where the
    flanks touch along lines or not at all. ``breaks`` are the positions at which contact passes to another branch,
    ``moving`` and ``efficiency`` the velocities and what friction makes of them, ``first`` where the bounded flanks
    of the pair touch first. ``whole`` are the flanks between their limits, ``marking`` the thickness of the marking
    compound of the composite pattern, mm. ``loaded`` is a document ``meshwright.loaded/1``, if there is one.
    """

    drive: Drive
    running: Running | None
    tca: TCA
    steps_per_pitch: int
    pattern: tuple[Contour, ...]
    lines: tuple[ContactLine, ...]
    matrices: dict[str, np.ndarray]
    patches: dict[str, Patch]
    sensitivities: tuple[Sensitivity, ...]
    breaks: np.ndarray
    moving: Velocities
    efficiency: Efficiency
    first: FirstContacts
    whole: dict[str, WholeFlank]
    marking: float
    loaded: dict | None = None

    @property
    def mirror(self):
        """−1 for a left-hand design, whose flanks and placements are those of its mirror image."""
        return self.drive.design.mirror.sign

    @property
    def teeth(self):
        """Teeth of the members."""
        pinion = 2 * math.pi / self.drive.pitch()
        return {"pinion": round(pinion), "wheel": round(pinion / self.drive.ratio)}

    def patch(self, member):
        """The patch of a member with the design's hand."""
        right = self.patches[member]
        flip = self.drive.design.mirror.flip
        return replace(right, points=right.points * flip, normals=right.normals * flip)

    def in_body(self, member, k, points):
        """Fixed-frame ``points`` (M, 3) at position ``k`` in the frame of a member, mm, with the design's hand."""
        flip = self.drive.design.mirror.flip
        matrix = self.matrices[member][k]
        return ((points * flip - matrix[:3, 3]) @ matrix[:3, :3]) * flip


def analyse(drive, step, friction=None, marking=None, sizes=None, crossings=None):
    """The :class:`Analysis` of a drive; ``step(text)`` is called before each part of the work.

    ``friction`` is a :class:`~meshwright.contact.friction.Friction` or None; ``marking`` the thickness of the marking
    compound, mm, by default the design's separation; ``sizes`` of misalignments by key, in the unit of the key.
    ``crossings`` gives what :meth:`~meshwright.drive.Drive.crossings` does, where that has been begun before.
    """
    sizes = checked_sizes(drive.design, sizes or {})
    step("window of contact")
    pairs = Mesh.of(drive)
    angles, per_pitch = _line_positions(drive, pairs.window) if pairs.path is None else _positions(drive, pairs)
    step("contact over the pinion angle")
    tca = drive.tca(angles)
    with (
        in_worker(lambda: drive.first_contact(angles, tca)) as first_contact,
        in_worker(lambda: _sensitivities(drive, angles, sizes)) as sensitivities,
    ):
        step("all pairs together")
        known = pairs.path is not None or (pairs.window.complete and pairs.contact is not None)
        running = _running(pairs, angles) if known else None
        first = first_contact()
        tca = not_first(tca, first)
        step("contact pattern")
        pattern = _pattern(drive, tca)
        lines = _lines(drive, tca)
        step("flanks")
        matrices = _matrices(drive, tca)
        places = np.where(tca.solved[:, None], tca.solutions, first.solutions)
        patches = _patches(drive, tca, matrices) or _line_patches(drive, lines) or _edge_patches(drive, tca)
        step("whole flanks")
        if crossings is not None:
            with suppress(UsageError):  # who asks for a region is told so
                drive.know(crossings())
        transmitted = None if running is None else running.transmitted(running.envelopes)
        whole = whole_flanks(drive, angles, transmitted, places)
        step("misalignments")
        misaligned = sensitivities()
    moving = velocities(drive, tca)
    return Analysis(
        drive, running, tca, per_pitch, pattern, lines, matrices, patches, misaligned, breaks(drive, tca),
        moving, efficiency(drive, tca, friction, moving), first, whole,
        drive.design.value("separation_mm", "contact") if marking is None else marking,
    )  # fmt: skip


def steps(drive):
    """How often :func:`analyse` calls ``step``."""
    return 7


def _sensitivities(drive, angles, sizes):
    return tuple(sensitivity(drive, p, angles, sizes.get(p["key"])) for p in misalignments(drive.design))


def _positions(drive, mesh):
    """Ascending angles at whole fractions of a pitch from end to end of the contact, and how many make a pitch."""
    pitch = drive.pitch()
    low, high = -WITHOUT_END * pitch, WITHOUT_END * pitch
    known = sorted(e.angle for e in (mesh.window.begin, mesh.window.end) if e.exists)
    if len(known) == 2:
        low, high = known
    elif known:
        low, high = min(low, *known), max(high, *known)
    per_pitch = math.ceil(max(pitch / LARGEST_STEP, POSITIONS * pitch / (high - low)))
    step = pitch / per_pitch
    return np.arange(math.ceil(low / step), math.floor(high / step) + 1) * step, per_pitch


def _line_positions(drive, window):
    """Like :func:`_positions`, where the flanks touch along lines or at an end of them."""
    step, middle = drive.pitch() / LINES_PER_PITCH, drive.design.mirror.sign * drive.design.reference_angle
    ends = sorted((window.begin.angle, window.end.angle))
    low, high = ends if window.complete else (middle - drive.pitch(), middle + drive.pitch())
    return np.arange(math.ceil(low / step), math.floor(high / step) + 1) * step, LINES_PER_PITCH


def _lines(drive, tca):
    """The line of contact at each position, empty where there is none; none at all where there is none anywhere."""
    mirror = drive.design.mirror
    if not any(tca.lines):
        return ()

    def line(angle, found):
        x = np.empty((0, drive.model.nx)) if found is None else found.unknowns(drive)
        parameters = {body["name"]: x[:, body["unknowns"]] for body in drive.design.description["bodies"]}
        places = {name: drive.flank(name)(q).points if len(q) else np.empty((0, 3)) for name, q in parameters.items()}
        points = np.empty((0, 3)) if found is None else found.points * mirror.flip
        return ContactLine(mirror.sign * float(angle), points, places, parameters)

    return tuple(map(line, tca.angles, tca.lines))


def _running(mesh, angles):
    pitch = mesh.drive.pitch()
    middle = 0.5 * (angles[0] + angles[-1])
    over_pitch = envelopes(mesh, middle + np.linspace(-0.5, 0.5, 97) * pitch)
    separations = np.full(over_pitch.pairs.shape, np.nan)
    for column, angle in enumerate(over_pitch.angles):
        for pair in mesh.pairs(angle):
            separations[over_pitch.numbers.index(pair.number), column] = pair.separation
    return Running(
        mesh=mesh,
        error=transmission_error(mesh),
        envelopes=envelopes(mesh, angles),
        pitch=over_pitch,
        rigid=envelopes(mesh, over_pitch.angles, edge_paths(mesh)),
        teeth=np.array([mesh.teeth_in_contact(angle) for angle in over_pitch.angles]),
        separations=separations,
        amplitudes=fourier(mesh, ORDERS)[0],
        backlash=backlash(mesh.drive),
    )


def _pattern(drive, tca):
    """Contours at the design's separation, spread over the positions at which bodies touch with an ellipse."""
    possible = [not any(impossible(flag) for flag in flags) for flags in tca.flags]
    solved = np.flatnonzero(tca.solved & possible & np.isfinite(tca.semi_axes).all(axis=1))
    if not solved.size:
        return ()
    chosen = solved[np.unique(np.linspace(0, solved.size - 1, CONTOURS).round().astype(int))]
    return contours(drive, tca, DIRECTIONS, spacing=along_ellipse, rows=chosen)


def _matrices(drive, tca):
    """Placements (N, 4, 4) of the right-hand drive by member; NaN where nothing touches."""
    mirror = drive.design.mirror.sign
    return placed(drive, mirror * tca.angles, mirror * tca.wheel_angles).matrices


def _patches(drive, tca, matrices):
    """Both flanks around the path of contact; none where there are no contact points."""
    solved = tca.solved & np.isfinite(tca.solutions).all(axis=1)  # Newton has none of some lines
    if not solved.any():
        return {}
    flip = drive.design.mirror.flip
    major, normal = flip * tca.major[solved], flip * tca.normals[solved]
    lengths = np.nan_to_num(tca.semi_axes[solved])
    ellipses = np.stack([major, np.cross(normal, major)], axis=1) * lengths[:, :, None]
    size = np.linalg.norm(np.ptp(tca.points[solved], axis=0)) + lengths.max()
    patches = {}
    for body in drive.design.description["bodies"]:
        rotations = matrices[body["name"]][solved, :3, :3]
        axes = np.einsum("nxb,nax->nab", rotations, ellipses)
        path = tca.solutions[solved][:, body["unknowns"]]
        patches[body["name"]] = patch(drive.flank(body["name"]), path, axes, size / 70)
    return patches


def _line_patches(drive, lines):
    """Both flanks around the lines of contact; none where there are no lines but points."""
    touching = [line for line in lines if len(line.points) > 1]
    if not touching:
        return {}
    size = max(np.linalg.norm(np.ptp(line.points, axis=0)) for line in touching)
    patches = {}
    for body in drive.design.description["bodies"]:
        path = np.vstack([line.parameters[body["name"]] for line in touching])
        patches[body["name"]] = patch(drive.flank(body["name"]), path, np.zeros((len(path), 2, 3)), size / 40)
    return patches


def _edge_patches(drive, tca):
    """Both whole flanks; none where nothing touches, or one of them cannot be bounded though they touch on edges alone.

    Raises :class:`~meshwright.base.errors.UsageError` where a flank that touches along a line cannot be bounded.
    """
    if not np.isfinite(tca.points).all(axis=1).any():
        return {}
    patches = {}
    for body in drive.design.description["bodies"]:
        try:
            triangles = mesh(drive.region(body["name"]), FLANK_CELLS)
        except UsageError:
            if tca.solved.any():
                raise
            return {}
        size, path = np.linalg.norm(np.ptp(triangles.points, axis=0)), triangles.parameters
        patches[body["name"]] = patch(drive.flank(body["name"]), path, np.zeros((len(path), 2, 3)), size / 40)
    return patches
