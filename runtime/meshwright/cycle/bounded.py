"""Contact of bounded flanks: at every angle the extreme of the wheel's turn over them.

Newton's tangency is it where there is one that no other place precedes. Elsewhere the extreme lies along a line, on an
edge or at a corner, or no turn of the wheel brings the flanks together.
"""

from dataclasses import replace

import numpy as np

from meshwright.contact.analysis import analyse, at_solutions, status_text
from meshwright.contact.placement import inverse, placed
from meshwright.cycle.first_results import STATUSES
from meshwright.cycle.search import FLAT, OVERLAP, Search

#: A smaller principal curvature of the gap below this share of the larger one may be that of a line.
NEARLY_FLAT = 1e-6


def rigid_contact(drive, angles):
    """The :class:`~meshwright.contact.results.TCA` of the bounded flanks at pinion angles (N,), rad: tangencies, lines,
    edges and corners; what lies outside the tips is no contact of teeth that do not reach each other.
    """
    result = analyse(drive, angles)
    outside = result.outside_the_tips
    if outside.any() and drive.past_the_tips:
        result = result.without_contact(outside)
    return bounded(drive, result)


def bounded(drive, result):
    """The :class:`~meshwright.contact.results.TCA` of Newton's method as one of the bounded flanks.

    Rows that it has solved at a point stay as they are, but for those along a line. Where no blank ends the flanks that
    meet, or the search does not come to an extreme, so do the others.
    """
    with np.errstate(invalid="ignore"):
        flat = np.abs(result.curvatures[:, 0]) <= NEARLY_FLAT * np.abs(result.curvatures[:, 1])
    asked = np.flatnonzero(~result.solved | flat)
    if not len(asked):
        return result
    own = drive.design.mirror.sign * result.angles
    search, _ = Search.of(drive, own, result.solutions)
    if search is None:
        return result
    known = np.isfinite(result.solutions).all(axis=1)
    lines = {int(k): search.of_solution(own[k], result.solutions[k]) for k in asked if known[k]}
    with np.errstate(invalid="ignore"):
        isolated = np.abs(result.curvatures[:, 0]) * search.flank.extent**2 / 8.0 > FLAT
    rows = np.array([k for k in asked if lines.get(int(k)) or not (result.solved[k] and isolated[k])], dtype=int)
    if not len(rows):
        return result
    found = search.first(result.angles[rows])
    result = _undecided(result, rows[np.isinf(found.unresolved)])
    late = found.overlaps(result.error[rows]) > OVERLAP
    along = [None if behind else lines.get(int(k)) for k, behind in zip(rows, late, strict=True)]
    judged = zip(along, found.kinds, found.untouched, strict=True)
    told = np.array([line is not None or kind is not None or without for line, kind, without in judged], dtype=bool)
    if not told.any():
        return result
    kinds = ["line" if line else kind for line, kind in zip(along, found.kinds, strict=True)]
    points = _points(drive, result, rows, kinds, along, found)
    return result.with_rows(rows[told], points.only(told))


def _undecided(result, rows):
    """The same, but at these ``rows`` (R,), where flanks meet whose first contact was not found, it is not said that
    nothing touches, as Newton's method may have it.
    """
    words = [*result.status], [*result.messages]
    for k in rows:
        if result.status[k] == "no_contact":
            words[0][k], words[1][k] = "diverged", status_text("diverged")
    return replace(result, status=tuple(words[0]), messages=tuple(words[1]))


def _points(drive, result, rows, kinds, along, found):
    """The :class:`~meshwright.contact.results.TCA` of some rows (R,) that are no tangency of Newton's method."""
    mirror, angles = drive.design.mirror, result.angles[rows]
    own, tangent = mirror.sign * angles, np.array([kind == "tangency" for kind in kinds], dtype=bool)
    points = at_solutions(drive, own, np.where(tangent[:, None], found.solutions, np.nan))
    tangent &= points.solved
    mirrored = [line and line.mirrored(mirror) for line in along]
    lines = [mine or there for mine, there in zip(mirrored, found.lines, strict=True)]
    newton = np.array([line is not None for line in along], dtype=bool)
    on_line = mirror.sign * np.array([np.nan if line is None else line.middle.wheel_turn for line in along])
    error = np.where(newton, on_line, found.errors)
    single = ~tangent & ~newton & np.array([kind not in (None, "line") for kind in kinds], dtype=bool)
    status = ["no_contact" if kind is None else STATUSES[kind] for kind in kinds]
    messages = [status_text(word) for word in status]
    turned = drive.ratio * angles + error
    stand = placed(drive, own, mirror.sign * turned).matrices
    _, wheel = (body["name"] for body in drive.design.description["bodies"])

    def only(there, values):
        return np.where(single[:, None] if values.ndim > 1 else single, values, there)

    def in_body(name):
        back = inverse(stand[name])
        return mirror.flip * (np.einsum("nij,nj->ni", back[:, :3, :3], mirror.flip * found.points) + back[:, :3, 3])

    body_points = {name: only(values, in_body(name)) for name, values in points.body_points.items()}
    on_limits = single & np.array([member is not None for member in found.members], dtype=bool)
    messages = [text if not one else f"{text}: {found.words(i)}, at {_height(found, body_points, i)}"
                for i, (text, one) in enumerate(zip(messages, on_limits, strict=True))]  # fmt: skip

    return replace(
        points,
        angles=angles,
        status=tuple(status),
        messages=tuple(messages),
        error=np.where(tangent, points.error, error),
        wheel_angles=np.where(tangent, points.wheel_angles, turned),
        points=only(points.points, found.points),
        normals=only(points.normals, found.normals),
        body_points=body_points,
        lever_arms=points.lever_arms | {wheel: only(points.lever_arms[wheel], found.levers)},
        solutions=np.where(newton[:, None], result.solutions[rows], points.solutions),
        outside_the_tips=np.array([kind is None for kind in kinds], dtype=bool) & ~tangent,
        lines=tuple(lines),
    )


def _height(found, body_points, i):
    """Where along its own axis the member whose limit holds place i touches, which says at which end of the teeth."""
    member = found.members[i] if found.members[i] != "both" else found.holders[i][0]
    return f"z = {body_points[member][i, 2]:.4g} mm of the {member}"
