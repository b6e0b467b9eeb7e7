"""First contact: the wheel angle at which the two bounded flanks of a tooth pair touch first, wherever that is.

A tangency satisfies the equations of contact, but the flanks may touch before it: on an edge or at a corner. Every
point of the wheel's bounded flank, turned about the wheel's axis, meets the pinion's flank at one wheel angle; the
extreme of these over what both limits leave is the first contact. C searches a mesh of the wheel's region for it.
"""

import math
from dataclasses import dataclass

import numpy as np

from meshwright.base.library import ffi, library, pointer
from meshwright.contact.placement import placed, placements_at
from meshwright.flank.bounds import OPEN
from meshwright.flank.mesh import mesh
from meshwright.flank.model import DriveModel
from meshwright.flank.region import region
from meshwright.flank.uses import Uses

#: Cells of the mesh over the wheel's flank, across and along.
CELLS = (12, 24)

#: Turn of the wheel by which its sense of rotation is read off, rad.
TURN = 0.01

#: Contacts at so many angles, over so many pitches to either side, show where the flanks are; where nothing ends a
#: flank it is searched so many natural sizes beyond them.
ANGLES, PITCHES, BEYOND = 9, 0.5, 4.0

#: Which of the known contacts, by distance in angle, the search starts from until one leads to the angle asked for.
STARTS = (0, 1, 2, 4, 8, 16, 32)

#: Searches that come to the angle and find places, but no extreme of them, before it is given up.
SEARCHES = 2

#: What stands for a first contact where the flanks meet, but a search for their extreme ends nowhere.
UNKNOWN = object()

#: Steps from the aligned drive.
LEAD = 12

#: Steps of the pinion from an angle at which a contact is known, per pitch.
STEPS_PER_PITCH = 24


@dataclass(frozen=True)
class FirstContacts:
    """First contacts at N pinion ``angles`` (rad), with the design's hand; NaN and None where there is none.

    ``kinds``: "tangency", "edge" or "corner"; ``members``: whose limit holds the place, "both" for two edges that
    cross, None for a tangency; ``limits``: the events. ``errors`` (N,): transmission error, rad. ``points``,
    ``normals`` (N, 3) (out of the pinion), fixed frame; ``levers`` (N,), mm of normal approach per rad of the wheel.
    ``unresolved`` (N,): a place that the search could have missed overlaps by this at most, mm; infinite where flanks
    meet whose first contact was not found. ``reason``: why there is none anywhere, or "".
    """

    angles: np.ndarray
    kinds: tuple[str | None, ...]
    members: tuple[str | None, ...]
    limits: tuple[tuple[str, ...], ...]
    errors: np.ndarray
    points: np.ndarray
    normals: np.ndarray
    levers: np.ndarray
    unresolved: np.ndarray
    reason: str = ""

    def overlaps(self, errors):
        """How far flanks at transmission errors (N,) lie in one another where they should touch first, mm: (N,).

        Along the normal there, by the wheel's turn from the one wheel angle to the other.
        """
        return np.maximum(self.levers * (self.errors - errors), 0.0)

    def words(self, k):
        """First contact k in words, such as "edge of the wheel (face)"; "" if there is none."""
        if self.kinds[k] in (None, "tangency"):
            return self.kinds[k] or ""
        whose = "both members" if self.members[k] == "both" else f"the {self.members[k]}"
        return f"{self.kinds[k]} of {whose} ({', '.join(self.limits[k])})".replace("_", " ")

    def point(self, k, errors):
        """The entry ``first_contact`` of point k of a TCA with transmission errors (N,), rad; None if there is none."""
        if self.kinds[k] is None:
            return None
        overlap = self.overlaps(errors)[k]
        return {
            "kind": self.kinds[k],
            "member": self.members[k],
            "limits": list(self.limits[k]),
            "point_mm": self.points[k].tolist(),
            "transmission_error_arcsec": float(np.degrees(self.errors[k]) * 3600.0),
            "overlap_mm": float(overlap) if math.isfinite(overlap) else None,
            "unresolved_mm": float(self.unresolved[k]),
        }


def first_contacts(drive, angles, result=None):
    """:class:`FirstContacts` at pinion angles (N,), rad. ``result``: a TCA of the same angles, if there is one."""
    result = drive.tca(angles) if result is None else result
    mirror = drive.design.mirror
    found = [None] * len(angles)
    search, reason = _Search.of(drive, mirror.sign * result.angles, result.solutions)
    if search is not None:
        found = search.at(mirror.sign * np.asarray(angles))
    return _gathered(drive, np.asarray(angles, dtype=float), found, reason)


def first_contact_of(mesh):
    """Function of a pair's own pinion angles (N,), rad, to :class:`FirstContacts`; None if there is no search."""
    search = mesh.search
    if search is None:
        return None

    def contacts(angles):
        angles = np.atleast_1d(np.asarray(angles, dtype=float))
        return _gathered(mesh.drive, angles, search.at(mesh.mirror * angles), "")

    return contacts


def pair_errors(mesh):
    """Function of a pair's own pinion angles (N,), rad, to the transmission error at which its bounded flanks touch
    first, NaN where they never do, infinite where they meet, but it is not found; None where the blank does not bound
    them. Given an error ``until``, a contact that comes no earlier may be a later one of the pair, or missing: it is
    found in less time.
    """
    search = mesh.search
    if search is None:
        return None

    def errors(angles, until=None):
        found = search.at(mesh.mirror * np.asarray(angles), None if until is None else mesh.mirror * until)
        return mesh.mirror * np.array([_wheel_turn(f) for f in found])

    return errors


def _wheel_turn(found):
    if found is None:
        return math.nan
    return math.inf if found is UNKNOWN else found.wheel_turn


def search_from(drive, path):
    """What :func:`first_contact_of` and :func:`pair_errors` search with, from the contacts of a path; None without one,
    or where the blank does not bound the flanks.
    """
    return None if path is None else _Search.of(drive, path.angles, path.unknowns)[0]


def _gathered(drive, angles, found, reason):
    unknown = np.array([f is UNKNOWN for f in found], dtype=bool)
    found = [None if f is UNKNOWN else f for f in found]
    mirror, nothing = drive.design.mirror, np.full(3, np.nan)
    bodies = drive.design.description["bodies"]
    kinds, members, limits = zip(*(_held(bodies, f) for f in found), strict=True) if len(found) else ((), (), ())

    def column(of, missing=math.nan):
        return np.array([missing if f is None else of(f) for f in found])

    return FirstContacts(
        angles=angles,
        kinds=kinds,
        members=members,
        limits=limits,
        errors=mirror.sign * column(lambda f: f.wheel_turn),
        points=mirror.flip * column(lambda f: np.array(list(f.point)), nothing).reshape(-1, 3),
        normals=mirror.flip * column(lambda f: np.array(list(f.normal)), nothing).reshape(-1, 3),
        levers=mirror.sign * column(lambda f: f.lever),
        unresolved=np.where(unknown, np.inf, column(lambda f: f.unresolved)),
        reason=reason,
    )


def _held(bodies, found):
    """Kind, member and limits of a place."""
    if found is None:
        return None, None, ()
    held = [(found.member[k], found.limit[k]) for k in (0, 1) if found.limit[k] >= 0]
    names = tuple("undercut" if i == 0 else bodies[m]["margins"][i - 1]["event"] for m, i in held)
    if not held:
        return "tangency", None, ()
    if len(held) == 1:
        return "edge", bodies[held[0][0]]["name"], names
    if held[0][0] == held[1][0]:
        return "corner", bodies[held[0][0]]["name"], names
    return "edge", "both", names


@dataclass(frozen=True)
class SearchedFlank:
    """A mesh over the wheel's bounded flank: a ``table`` for C, of arrays that are ``kept`` with it."""

    table: object
    kept: tuple

    @classmethod
    def of(cls, drive, unknowns):
        """Of the flank that contacts (P, nx) use; None if no part of it lies within its limits."""
        pinion, wheel = (body["name"] for body in drive.design.description["bodies"])
        uses = Uses.of(drive, unknowns, beyond=BEYOND)
        whole = region(drive, wheel, "flank", uses)
        triangles = mesh(whole, CELLS)
        if not len(triangles.triangles):
            return None
        names = np.array(whole.limits.names)
        open_ = np.zeros(len(triangles.points), dtype=np.uint8)
        open_[triangles.border[names[triangles.limit] == OPEN].ravel()] = 1
        _, sizes = uses.on(drive.flank(pinion))
        kept = (
            np.ascontiguousarray(triangles.parameters), np.ascontiguousarray(triangles.triangles, dtype=np.int32),
            open_, np.ascontiguousarray(whole.chart.sizes), np.ascontiguousarray(sizes),
        )  # fmt: skip
        table = ffi.new("mw_flank_mesh *")
        table.vertices, table.triangles = len(triangles.points), len(triangles.triangles)
        names = ("q", "corner", "open", "wheel_sizes", "pinion_sizes")
        kinds = ("double[]", "int[]", "unsigned char[]", "double[]", "double[]")
        views = tuple(ffi.from_buffer(kind, array) for kind, array in zip(kinds, kept, strict=True))
        for name, view in zip(names, views, strict=True):
            setattr(table, name, view)
        table.span = whole.chart.free
        return cls(table, (kept, views))


def about_the_middle(drive):
    """Angles (N,), rad, and solutions (N, nx) there, right hand, that show where the flanks are."""
    angles = np.linspace(-PITCHES, PITCHES, ANGLES) * drive.pitch()
    return angles, drive.trace(angles)[0]


@dataclass(frozen=True)
class _Search:
    """The wheel's ``flank`` and what the search starts from: ``solutions`` (N, nx) at angles ``solved_at``, and
    ``lead``, placements of the bodies that lead there where only the aligned drive has a contact.
    """

    drive: DriveModel
    flank: SearchedFlank
    work: np.ndarray
    solutions: np.ndarray
    solved_at: np.ndarray
    lead: tuple
    turn: float
    sense: float

    @classmethod
    def of(cls, drive, angles, solutions):
        """The search, or None and why there is none; solutions (N, nx) of contacts at angles (N,), right hand."""
        here, about = about_the_middle(drive)
        angles, solutions = np.concatenate([here, angles]), np.concatenate([about, solutions])
        known, errors = np.isfinite(solutions).all(axis=1), None
        if not known.any():
            errors = drive.design.given().get("misalignment", {})
            aligned = drive.with_(misalignment=dict.fromkeys(errors, 0.0))
            solutions[:ANGLES] = aligned.trace(here)[0]
            known = np.isfinite(solutions).all(axis=1)
        if not known.any():
            return None, "the flanks do not touch, not even aligned: there is nothing to start from"
        known_about = known[:ANGLES]
        used = solutions[:ANGLES][known_about] if known_about.any() else solutions[known]
        solutions, angles = solutions[known], angles[known]
        regular = _on_regular_flanks(drive, solutions)
        if regular.any():
            solutions, angles = solutions[regular], angles[regular]
        shared = errors is None and known_about.any()
        flank = drive.searched_flank if shared else SearchedFlank.of(drive, used)
        if flank is None:
            return None, "no part of the wheel's flank lies within its limits"
        middle = int(np.argmin(np.abs(angles)))
        turn, sense = _senses(drive, angles[middle], solutions[middle])
        if errors is not None:
            solutions, angles = solutions[middle : middle + 1], angles[middle : middle + 1]
        lead = () if errors is None else _misaligned(drive, errors, angles)
        work = np.empty(library().mw_first_contact_work(flank.table.vertices))
        return cls(drive, flank, work, solutions, angles, lead, turn, sense), ""

    def at(self, angles, until=None):
        """``mw_first``, None or UNKNOWN at angles (N,) of the right-hand drive; beyond the turn of the wheel ``until``,
        perhaps of a later contact.
        """
        until = -self.sense * math.inf if until is None else until
        design = self.drive.design
        here = zip(*_placed(self.drive, angles), strict=True)
        return [self._one(design.model, design.state, *both, until) for both in zip(angles, here, strict=True)]

    def _one(self, compiled, state, angle, here, until):
        """``mw_first`` at one angle, where the bodies stand ``here``: from the contact known nearest to it, else from
        others.
        """
        order, searches = np.argsort(np.abs(self.solved_at - angle), kind="stable"), 0
        for known in order[[i for i in STARTS if i < len(order)]]:
            found = self._from(known, compiled, state, angle, here, until)
            if found.status >= 0:
                return found
            searches += found.met > 0
            if found.status == library().MW_NO_CONTACT or searches == SEARCHES:
                break
        return UNKNOWN if searches and found.status == library().MW_DIVERGED else None

    def _from(self, known, compiled, state, angle, here, until):
        away, x = angle - self.solved_at[known], self.solutions[known]
        stand = [*self.lead, self._way(known, away) if away else [matrix[None] for matrix in here]]
        pinion, wheel = (np.concatenate([p[k][:, :3].reshape(-1, 12) for p in stand]) for k in (0, 1))
        start = np.concatenate([x[b["unknowns"]] for b in self.drive.design.description["bodies"][::-1]])
        start = np.append(start, x[self.drive.design.description["error"]])
        found = ffi.new("mw_first *")
        library().mw_first_contact(
            compiled, pointer(state), self.flank.table, pointer(pinion), pointer(wheel), len(pinion), self.turn,
            self.sense, pointer(start), until, pointer(self.work), found,
        )  # fmt: skip
        return found

    def _way(self, known, away):
        """Placements from a known contact to an angle ``away`` from it."""
        steps = 1 + math.ceil(abs(away) / self.drive.pitch() * STEPS_PER_PITCH - 1e-9)
        return _placed(self.drive, self.solved_at[known] + away * (np.linspace(0.0, 1.0, steps) if steps > 1 else 1.0))


def _on_regular_flanks(drive, solutions):
    """Whether solutions (N, nx) lie before the singular lines of both flanks: beyond them is another sheet."""
    bodies = drive.design.description["bodies"]
    return np.all([~(drive.flank(b["name"])(solutions[:, b["unknowns"]]).regular < 0.0) for b in bodies], axis=0)


def _placed(drive, angles):
    """Placements (N, 4, 4) of pinion and wheel at angles (N,), the wheel without transmission error."""
    angles = np.atleast_1d(angles)
    matrices = placed(drive, angles, drive.ratio * angles).matrices
    return [matrices[b["name"]] for b in drive.design.description["bodies"]]


def _misaligned(drive, errors, angles):
    """Placements that lead from the aligned drive to the given one."""
    shares = np.arange(LEAD) / LEAD
    drives = [drive.with_(misalignment={key: share * value for key, value in errors.items()}) for share in shares]
    return [_placed(part, angles) for part in drives]


def _senses(drive, angle, x):
    """Sense of the wheel's rotation about its own z with the transmission error; the side on which the gap opens."""
    turned = np.stack([x, x])
    turned[1, drive.design.description["error"]] += TURN
    pinion, wheel = (b["name"] for b in drive.design.description["bodies"])
    stand = placements_at(drive, np.array([angle, angle]), turned).matrices
    rotation = stand[wheel][0, :3, :3].T @ stand[wheel][1, :3, :3]
    turn = math.copysign(1.0, math.atan2(rotation[1, 0], rotation[0, 0]))
    flank = drive.flank(wheel)
    at = flank(x[drive.design.description["bodies"][1]["unknowns"]][None])
    outward = -at.normals[0]
    moved = turn * np.array([-at.points[0, 1], at.points[0, 0], 0.0])
    return turn, math.copysign(1.0, float(outward @ moved))

