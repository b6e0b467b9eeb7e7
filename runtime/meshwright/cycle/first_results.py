"""First contacts as results: kinds, limits and whose they are, places, errors."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from meshwright.base.library import ffi, record
from meshwright.base.plain import finite_or_nones
from meshwright.cycle.searched_flank import start_values
from meshwright.cycle.touching_line import TouchingLine

#: What stands for a first contact where the flanks meet, but a search for their extreme ends nowhere.
UNKNOWN = object()

#: And where flanks meet that nothing ends.
OPEN_ENDED = object()

#: Status words of first contacts by their kinds.
STATUSES = {"tangency": "converged", "line": "line_contact", "edge": "edge_contact", "corner": "corner_contact"}


@dataclass(frozen=True)
class FirstContacts:
    """First contacts at N pinion ``angles`` (rad), with the design's hand; NaN and None where there is none.

    ``kinds``: "tangency", "line", "edge" or "corner"; ``members``: whose limit holds the place, "both" for two edges
    that cross, None for a tangency and a line; ``limits``: the events, ``holders`` the members whose they are, and
    ``edges`` their words, which tell the ends of a face: left and right (at larger z of its member), or toe and heel.
    ``errors`` (N,): transmission error, rad. ``points``, ``normals`` (N, 3) (out of the pinion's flank), fixed frame,
    of a line those in its middle; ``levers`` (N,), mm of normal approach per rad of the wheel; ``solutions`` (N, nx),
    the unknowns of contact there, right hand, which solve its equations at a tangency alone. ``lines``: the
    :class:`TouchingLine` along which flanks, or an edge and a flank, touch, else None. ``unresolved`` (N,): a place
    that the search could have missed overlaps by this at most, mm; infinite where flanks meet whose first contact was
    not found. ``untouched`` (N,) of bool: where no turn of the wheel brings the bounded flanks together. ``reason``:
    why there is none anywhere, or "".
    """

    angles: np.ndarray
    kinds: tuple[str | None, ...]
    members: tuple[str | None, ...]
    limits: tuple[tuple[str, ...], ...]
    holders: tuple[tuple[str, ...], ...]
    edges: tuple[tuple[str, ...], ...]
    errors: np.ndarray
    points: np.ndarray
    normals: np.ndarray
    levers: np.ndarray
    solutions: np.ndarray
    lines: tuple[TouchingLine | None, ...]
    unresolved: np.ndarray
    untouched: np.ndarray
    reason: str = ""

    def overlaps(self, errors):
        """How far flanks at transmission errors (N,) lie in one another where they should touch first, mm: (N,).

        Along the normal there, by the wheel's turn from the one wheel angle to the other.
        """
        return np.maximum(self.levers * (self.errors - errors), 0.0)

    def words(self, k):
        """First contact k in words, such as "edge of the wheel (face)"; "" if there is none."""
        if self.kinds[k] in (None, "tangency", "line"):
            return self.kinds[k] or ""
        if self.members[k] == "both":
            pairs = zip(self.edges[k], self.holders[k], strict=True)
            return " on ".join(f"{edge} of the {member}" for edge, member in pairs)
        return f"{self.kinds[k]} of the {self.members[k]} ({', '.join(self.edges[k])})"

    def plain(self, errors):
        """The entries ``first_contact`` of a TCA with transmission errors (N,), rad; None where there is none."""
        columns = (
            self.kinds, self.members, self.limits, self.edges, self.holders, self.points.tolist(),
            (np.degrees(self.errors) * 3600.0).tolist(), finite_or_nones(self.overlaps(errors)),
            self.unresolved.tolist(),
        )  # fmt: skip
        return [None if row[0] is None else _entry(*row) for row in zip(*columns, strict=True)]


def _entry(kind, member, limits, edges, holders, point, error, overlap, unresolved):
    return {
        "kind": kind,
        "member": member,
        "limits": list(limits),
        "edges": [f"{edge} of the {holder}" for edge, holder in zip(edges, holders, strict=True)],
        "point_mm": point,
        "transmission_error_arcsec": error,
        "overlap_mm": overlap,
        "unresolved_mm": unresolved,
    }


def gathered(drive, angles, found, lines, reason=""):
    """First contacts ``found`` at angles (N,), with their ``lines``."""
    unknown, untouched = (np.array([f is what for f in found], dtype=bool) for what in (UNKNOWN, None))
    found = [None if f in (None, UNKNOWN, OPEN_ENDED) else f for f in found]
    mirror = drive.design.mirror
    shown = _records([f if line is None else line.middle for f, line in zip(found, lines, strict=True)])
    solutions = _all_unknowns(drive, shown)
    kinds, members, limits, holders = _held(drive.design.description["bodies"], found, shown, lines)
    return FirstContacts(
        angles=angles,
        kinds=kinds,
        members=members,
        limits=limits,
        holders=holders,
        edges=_edges(drive, solutions, holders, limits),
        errors=mirror.sign * shown["wheel_turn"],
        points=mirror.flip * shown["point"],
        normals=mirror.flip * shown["normal"],
        levers=mirror.sign * shown["lever"],
        solutions=solutions,
        lines=tuple(line if line is None else line.mirrored(mirror) for line in lines),
        unresolved=np.where(unknown, np.inf, _records(found)["unresolved"]),
        untouched=untouched,
        reason=reason,
    )


def _records(places):
    """What C has of places (N,), an array of ``mw_first``; its numbers are not numbers where there is none."""
    found = np.zeros(len(places), record("mw_first"))
    size, view = found.itemsize, ffi.from_buffer(found) if len(places) else None
    for k, place in enumerate(places):
        if place is not None:
            ffi.memmove(view + k * size, place, size)
    missing = np.array([place is None for place in places], dtype=bool)
    for name, (kind, _) in found.dtype.fields.items():
        if kind.base == np.float64:
            found[name][missing] = np.nan
    return found


def _all_unknowns(drive, records):
    """Unknowns (N, nx) of the contacts at places."""
    description, x = drive.design.description, np.empty((len(records), drive.model.nx))
    for body, own in zip(description["bodies"], ("q_pinion", "q_wheel"), strict=True):
        x[:, body["unknowns"]] = records[own][:, : len(body["unknowns"])]
    x[:, description["error"]] = records["wheel_turn"]
    return x


def _held(bodies, found, shown, lines):
    """Kinds, members, limits and whose they are of places, or of lines through them: (N,) each."""
    held = zip(shown["member"].tolist(), shown["limit"].tolist(), found, lines, strict=True)
    known = {}
    keys = [None if f is None else (*member, *limit, line is None) for member, limit, f, line in held]
    for key in set(keys):
        known[key] = (None, None, (), ()) if key is None else _held_by(bodies, *key)
    return tuple(zip(*(known[key] for key in keys), strict=True)) or ((), (), (), ())


def _held_by(bodies, first, second, its_limit, other_limit, single):
    """Of one place: members and limits that hold it, -1 for none; ``single``: no line through it."""
    held = [(member, limit) for member, limit in ((first, its_limit), (second, other_limit)) if limit >= 0]
    names, whose = tuple(event_of(bodies, *which) for which in held), tuple(bodies[m]["name"] for m, _ in held)
    if not held:
        return "tangency" if single else "line", None, names, whose
    if len(held) == 1:
        return "edge", whose[0], names, whose
    if first == second:
        return "corner", whose[0], names, whose
    return "edge", "both", names, whose


def _edges(drive, solutions, holders, limits):
    """Words for the limits that hold places with these unknowns (N, nx), which tell the two ends of a face."""
    edges = [[name.replace("_", " ") for name in names] for names in limits]
    bodies = {body["name"]: body for body in drive.design.description["bodies"]}
    faces = {}
    for k, (whose, names) in enumerate(zip(holders, limits, strict=True)):
        for place, which in enumerate(zip(whose, names, strict=True)):
            faces.setdefault(which, []).append((k, place))
    (middle,) = start_values(drive, np.array([drive.design.reference_angle])) if faces else (None,)
    for (member, name), where in faces.items():
        margin = next((m for m in bodies[member]["margins"] if m["event"] == name), None)
        if margin is None or margin["role"] != "face":
            continue
        own = bodies[member]["unknowns"]
        both = drive.flank(member)(np.vstack([solutions[[k for k, _ in where]][:, own], middle[own]])).points
        both = both * drive.design.mirror.flip
        if margin.get("ends"):
            words, far = margin["ends"], np.linalg.norm(both, axis=1)
        else:
            words, far = ("left face", "right face"), both[:, 2]
        for (k, place), beyond in zip(where, far[:-1] > far[-1], strict=True):
            edges[k][place] = words[int(beyond)]
    return tuple(map(tuple, edges))


def event_of(bodies, member, limit):
    return "undercut" if limit == 0 else bodies[member]["margins"][limit - 1]["event"]
