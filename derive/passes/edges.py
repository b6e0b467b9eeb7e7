"""Contact of an edge: where a margin of the blank ends a flank, the edge touches the mating flank or the mating edge.

Input: a schedule with its bodies on the tape. Output: equations in the unknowns of contact, with their Jacobian, and
the systems that are chosen among them: one for each edge on the mating flank, one for each pair of edges.

An edge lies where a margin of its member is zero. It touches the mating flank where both have a point in common and the
edge's tangent is normal to the mating flank's normal (F. L. Litvin, A. Fuentes, Gear Geometry and Applied Theory, 2nd
edition, 2004: edge contact as tangency of a curve and a surface). Two edges touch where they have a point in common.
Conditions that the surfaces keep of their own belong to every system.
"""

from dataclasses import dataclass
from itertools import permutations, product

from derive.language.contact import common_frame, contact
from derive.language.drive import Role
from derive.passes import check, linearise
from derive.passes.geometry import determinant, dot

#: Margins beyond which a flank ends in a convex edge. At its root it runs on into a fillet.
EDGES = (Role.TIP, Role.THROAT, Role.FACE)


@dataclass(frozen=True)
class EdgeSystem:
    """A system by the numbers of its ``equations``, as many as there are unknowns.

    ``margins``: of pinion and wheel the number of the margin that is zero, None where the flank itself touches.
    """

    name: str
    margins: tuple
    equations: tuple


@dataclass(frozen=True)
class Edges:
    """Equations (nodes) and their Jacobian: three components of the distance, mm; the surfaces' own conditions; of each
    edge its margin, then of each edge its tangency to the mating flank. No equations where no margin is an edge.
    """

    equations: list
    jacobian: list
    systems: tuple[EdgeSystem, ...]


@dataclass(frozen=True)
class _Member:
    """A body in the common frame of both: margins, parameters, point, normal and slopes of its conditions as nodes."""

    body: object
    margins: tuple
    parameters: tuple
    point: tuple
    normal: tuple
    slopes: tuple

    @property
    def edges(self):
        """Numbers of the margins that are edges."""
        return [k for k, m in enumerate(self.body.margins) if m.role in EDGES and m.along is None and not m.relative]

    def event(self, k):
        """Name of an edge."""
        return f"{self.body.name}_{self.body.margins[k].event}"


def edge_contact(plan, margin):
    """The :class:`Edges` of a schedule; ``margin(body, margin)`` is the node of a margin."""
    members = _members(plan, margin)
    pinion, wheel = members
    listed = [(member, k) for member in members for k in member.edges]
    if not listed:
        return Edges([], [], ())
    tape, unknowns = plan.tape, [plan.lower(u) for u in plan.unknowns]
    distance = [tape.sub(a, b) for a, b in zip(pinion.point, wheel.point, strict=True)]
    always = [*distance, *(plan.lower(c) for member in members for c in member.body.surface.conditions)]
    margins = [member.margins[k] for member, k in listed]
    tangency = [dot(tape, _tangent(tape, m, k), (wheel if m is pinion else pinion).normal) for m, k in listed]
    equations = [*always, *margins, *tangency]
    jacobian = linearise.jacobian(tape, linearise.forward(tape, equations, unknowns))
    check.derives("edges", tape, equations, unknowns, jacobian)
    return Edges(equations, jacobian, tuple(_systems(pinion, wheel, len(always), len(listed))))


def _systems(pinion, wheel, always, count):
    """The systems, when the equations begin with so many that always hold, and there are so many edges."""
    common, place = tuple(range(always)), {}
    for member in (pinion, wheel):
        for k in member.edges:
            place[member.body.name, k] = at = always + len(place)
            margins = (k, None) if member is pinion else (None, k)
            yield EdgeSystem(member.event(k), margins, (*common, at, at + count))
    for i, j in product(pinion.edges, wheel.edges):
        rows = place[pinion.body.name, i], place[wheel.body.name, j]
        yield EdgeSystem(f"{pinion.event(i)}_{wheel.event(j)}", (i, j), (*common, *rows))


def _members(plan, margin):
    """Pinion and wheel in the frame in which the residual of contact compares them, where their nodes are known."""
    bodies, tape, lower = plan.drive.bodies, plan.tape, plan.lower
    order = next((p for p in permutations(bodies) if contact(*(b.placed for b in p)) == plan.drive.residual), bodies)
    placed = dict(zip((b.name for b in order), common_frame(*(b.placed for b in order)), strict=True))

    def member(body):
        surface = placed[body.name]
        parameters = tuple(lower(p) for p in body.surface.parameters)
        slopes = tuple([tape.derivative(lower(c), p) for p in parameters] for c in body.surface.conditions)
        point, normal = (tuple(map(lower, vector)) for vector in (surface.body_point(), surface.body_normal()))
        return _Member(body, tuple(margin(body, m) for m in body.margins), parameters, point, normal, slopes)

    return tuple(map(member, bodies))


def _tangent(tape, member, number):
    """Nodes of the direction along which neither a margin nor a condition of the member's surface changes."""
    rows = [[tape.derivative(member.margins[number], p) for p in member.parameters], *member.slopes]
    columns, total = range(len(member.parameters)), [tape.constant(0)] * 3
    for j in columns:
        minor = determinant(tape, [[row[k] for k in columns if k != j] for row in rows])
        along = [tape.mul(minor, tape.derivative(i, member.parameters[j])) for i in member.point]
        total = [(tape.sub if j % 2 else tape.add)(a, b) for a, b in zip(total, along, strict=True)]
    return total
