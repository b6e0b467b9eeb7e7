"""Certified contact: points a second with one proof each, and paths, for a drive of every kind.

A point's proof takes residual, Jacobian over a box, its inverse and the test; the solution is given. ``certified1`` is
one point after the other in plain doubles with radii, ``certified2`` … are lanes; ``certificate`` is everything that
``mw_certify`` says of a point: the residual in double-double, contact point, normal, curvatures and limits.
"""

import math
import time

import numpy as np

from meshwright import Drive
from meshwright.base.library import ffi, library, pointer, proofs, record
from meshwright.contact.certified_path import certified_path
from meshwright.cycle import certified_first
from tests.benchmarks.timing import best

#: A design of every kind of drive; the first is what others are compared with.
DESIGNS = (
    "recess-action-full", "plain-za", "plain-zi", "plain-zk", "plain-zc", "spherical-table-2-3", "helical-crowned",
    "face-worm-cylindrical-convex", "bevel-crowned-both", "bevel-formate",
)  # fmt: skip
POINTS, FULL = 4096, 256

#: Angle, rad, from the middle of the mesh to where a design's contact lies on both flanks, where the middle does not.
FIRST = {"recess-action-full": math.radians(100.0)}


def points(drive, angles, solutions, width):
    """Certified points a second in lanes of a width, 1 for one after the other; None if this processor has no such."""
    lib, enclosed = library(), drive.enclosed
    lanes = ffi.NULL if width == 1 else lib.mw_lanes(width)
    if lanes == ffi.NULL and width != 1:
        return None
    n, state = min(POINTS, len(angles)), enclosed.state.copy()
    phi = np.zeros(n, record("mw_wide"))
    phi["hi"], x = angles[:n], np.ascontiguousarray(solutions[:n])
    unique, errors = np.zeros(n, np.uint8), np.zeros(n, record("mw_ball"))
    printed = proofs(drive.design.description["name"], drive.design.places)
    arguments = (lanes, printed, enclosed.model, pointer(state, "mw_wide[]"), pointer(phi, "mw_wide[]"), pointer(x), n)
    outputs = (pointer(unique, "unsigned char[]"), pointer(errors, "mw_ball[]"))
    seconds = best(lambda: lib.mw_certify_many(*arguments, *outputs), repeats=30)
    assert unique.all() and errors["radius"].max() < 1e-11
    return n / seconds


def certificates(drive, angles, solutions):
    """Whole certificates a second, by printed code."""
    n, state = FULL, drive.enclosed.state.copy()
    phi = np.zeros(n, record("mw_wide"))
    phi["hi"], x, line = angles[:n], np.ascontiguousarray(solutions[:n]), np.zeros(n, np.int32)
    found = np.zeros(n, record("mw_certificate"))
    printed = proofs(drive.design.description["name"], drive.design.places)
    room = ffi.new("double[]", library().mw_joined_size() // 8 + 1)
    joined = library().mw_joined(drive.enclosed.model, ffi.NULL, printed, room)
    arguments = (joined, pointer(state, "mw_wide[]"), pointer(phi, "mw_wide[]"), pointer(x))
    more = (pointer(line, "int[]"), n, pointer(found, "mw_certificate[]"))
    seconds = best(lambda: library().mw_certify_points(*arguments, *more), repeats=15)
    assert (found["outcome"] == 1).all()
    return n / seconds


def path_seconds(drive, begin, end):
    """Seconds of the proof of a path from given solutions, how many pieces it takes, the half-width of the error's
    tube, rad, and whether there is no gap.
    """
    path, nodes = certified_path(drive, begin, end), np.empty(9)
    library().mw_piece_nodes(pointer(nodes))
    model, state = drive.enclosed.model, pointer(drive.enclosed.state, "mw_wide[]")
    solved = [drive.trace(0.5 * (a + b) + 0.5 * (b - a) * nodes)[0] for a, b in path.ends]
    arrays = map(np.ascontiguousarray, solved)
    jobs = [(*ends, pointer(x), ffi.new("mw_piece *")) for ends, x in zip(path.ends, arrays, strict=True)]

    def run():
        for a, b, x, piece in jobs:
            library().mw_certify_piece(model, state, a, b, x, piece)

    seconds = best(run)
    assert all(piece.outcome == 1 for *_, piece in jobs)
    return seconds, len(jobs), path.tube, path.complete


def first_contact(drive, angle):
    """CPU seconds of the proof that a pair touches first at a pinion angle, what it says, parts that it looks at."""
    contacts = drive.tca(np.array([angle]))
    certificates = drive.certify(contacts.angles, contacts)
    boxes, radii = certified_first.ranges(drive, contacts.solutions, 0), certified_first.distances(drive, contacts)
    begin = time.process_time()
    found = certified_first._pair(drive, certificates.records, certificates.angles, boxes, radii)
    return time.process_time() - begin, found.reasons[0] or found.outcomes[0], int(found.records["parts"][0])


def first_over_turn(drive, begin, end, neighbours):
    """CPU seconds of what is proved of first contact at every angle of a range, of a pair and so many neighbours on
    either side: what it says of each, and how many parts of the wheel's flank it looks at.
    """
    start = time.process_time()
    found = drive.certify_first_path(begin, end, neighbours=neighbours)
    seconds = time.process_time() - start
    words = [f"{later:+d} {' '.join(sorted({s.outcome for s in found.of(later)}))}" for later in sorted(found.pairs)]
    return seconds, ", ".join(words), sum(span.parts for span in found.spans)


def case(name):
    """Drive, angles (POINTS,) about the middle of its mesh, and the solutions there."""
    drive = Drive.load(name)
    angles = drive.design.reference_angle + np.linspace(-0.01, 0.01, POINTS) * drive.pitch()
    return drive, angles, drive.trace(angles)[0]


def report():
    """Print a line for each design, and the turn of the first."""
    print("\ncertified contact, one core: points/s one by one, lanes4, lanes8, whole certificates/s; ns a point and")
    print("unknown in the widest lanes and how many times the first line's; a pitch as certified path: ms, pieces")
    first = None
    for name in DESIGNS:
        drive, angles, solutions = case(name)
        rates = [points(drive, angles, solutions, width) for width in (1, 4, 8)]
        rates.append(certificates(drive, angles, solutions))
        each = 1e9 / max(rate for rate in rates if rate) / drive.model.nx
        first = first or each
        middle, half = drive.design.reference_angle, 0.5 * drive.pitch()
        seconds, pieces, _, complete = path_seconds(drive, middle - half, middle + half)
        shown = " ".join(f"{rate:>9.3g}" if rate else "        –" for rate in rates)
        path = f"{1e3 * seconds:>7.3f} {pieces:>3}{'' if complete else ' with gaps'}"
        print(f"  {name:<30} {shown} {each:>7.1f} {each / first:>5.2f} {path}", flush=True)
    drive = Drive.load(DESIGNS[0])
    seconds, pieces, tube, _ = path_seconds(drive, 0.0, 2.0 * math.pi)
    said = f"{pieces} pieces, transmission error within {math.degrees(tube) * 3600:.1e} arcsec"
    print(f"  {DESIGNS[0]}, a turn as certified path: {1e3 * seconds:.3f} ms, {said}")
    for neighbours, pairs in ((0, "one pair"), (1, "all neighbouring pairs")):
        seconds, words, parts = first_over_turn(drive, math.radians(1000.0), math.radians(1360.0), neighbours)
        said = f"{seconds:.3f} s, {parts} parts, {words}"
        print(f"  {DESIGNS[0]}, first contact of {pairs} at every angle of a turn: {said}")
    print("first contact of one pair at one angle, proved: ms, times the first line's per unknown, parts of the flank")
    first = None
    for name in DESIGNS:
        drive = Drive.load(name)
        seconds, word, parts = first_contact(drive, drive.design.reference_angle + FIRST.get(name, 0.0))
        each = seconds / drive.model.nx
        first = first or each
        print(f"  {name:<30} {1e3 * seconds:>9.1f} {each / first:>7.1f} {parts:>6} {word}", flush=True)


if __name__ == "__main__":
    report()
