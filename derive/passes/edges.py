"""Contact of an edge: where a margin of the blank ends a flank, the edge touches the mating flank or the mating edge.

Input: a plan with its bodies on the tape. Output: equations in the unknowns of contact, with their Jacobian, and
the systems that are chosen among them: one for each edge on the mating flank, one for each pair of edges.

An edge lies where a margin of its member is zero. It touches the mating flank where both have a point in common and the
edge's tangent is normal to the mating flank's normal (F. L. Litvin, A. Fuentes, Gear Geometry and Applied Theory, 2nd
edition, 2004: edge contact as tangency of a curve and a surface). Two edges touch where they have a point in common.
Conditions that the surfaces keep of their own belong to every system.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

from derive.language.contact import common_frame, contact
from derive.language.drive import Body, Role
from derive.passes import check, linearise
from derive.passes.flanks import margin, slopes
from derive.passes.geometry import dot
from derive.passes.plan import Derived, Edges, EdgeSystem
from derive.passes.singular import determinant
from derive.program.tape import Tape

#: Margins beyond which a flank ends in a convex edge. At its root it runs on into a fillet.
EDGES = (Role.TIP, Role.THROAT, Role.FACE)


@dataclass(frozen=True)
class _Member:
    """A body in the common frame of both: margins, parameters, point, normal and slopes of its conditions as nodes."""

    body: Body
    margins: tuple[int, ...]
    parameters: tuple[int, ...]
    point: tuple[int, ...]
    normal: tuple[int, ...]
    slopes: tuple[list[int], ...]

    @property
    def edges(self) -> list[int]:
        """Numbers of the margins that are edges."""
        return [k for k, m in enumerate(self.body.margins) if m.role in EDGES and m.along is None and not m.relative]

    def event(self, k: int) -> str:
        """Name of an edge."""
        return f"{self.body.name}_{self.body.margins[k].event}"


def edge_contact(plan: Derived) -> Edges:
    """The :class:`Edges` of a plan."""
    members = _members(plan)
    pinion, wheel = members
    listed = [(member, k) for member in members for k in member.edges]
    if not listed:
        return Edges((), (), ())
    tape, unknowns = plan.tape, [plan.lower(u) for u in plan.unknowns]
    distance = [tape.sub(a, b) for a, b in zip(pinion.point, wheel.point, strict=True)]
    always = [*distance, *(plan.lower(c) for member in members for c in member.body.surface.conditions)]
    margins = [member.margins[k] for member, k in listed]
    tangency = [dot(tape, _tangent(tape, m, k), (wheel if m is pinion else pinion).normal) for m, k in listed]
    equations = [*always, *margins, *tangency]
    jacobian = linearise.jacobian(tape, linearise.forward(tape, equations, unknowns))
    check.derives("edges", tape, equations, unknowns, jacobian)
    systems = tuple(_systems(pinion, wheel, len(always), len(listed)))
    return Edges(tuple(equations), jacobian, systems)


def _systems(pinion: _Member, wheel: _Member, always: int, count: int) -> Iterator[EdgeSystem]:
    """The systems, when the equations begin with so many that always hold, and there are so many edges."""
    common = tuple(range(always))
    place: dict[tuple[str, int], int] = {}
    for member in (pinion, wheel):
        for k in member.edges:
            place[member.body.name, k] = at = always + len(place)
            ends = (k, None) if member is pinion else (None, k)
            yield EdgeSystem(member.event(k), ends, (*common, at, at + count))
    for i, j in product(pinion.edges, wheel.edges):
        rows = place[pinion.body.name, i], place[wheel.body.name, j]
        yield EdgeSystem(f"{pinion.event(i)}_{wheel.event(j)}", (i, j), (*common, *rows))


def _members(plan: Derived) -> tuple[_Member, _Member]:
    """Pinion and wheel in the frame in which the residual of contact compares them, where their nodes are known."""
    (pinion, wheel), lower = plan.drive.bodies, plan.lower
    orders = ((pinion, wheel), (wheel, pinion))
    first, second = next((p for p in orders if contact(p[0].placed, p[1].placed) == plan.drive.residual), orders[0])
    placed = dict(zip((first.name, second.name), common_frame(first.placed, second.placed), strict=True))

    def member(body: Body) -> _Member:
        surface = placed[body.name]
        parameters = tuple(lower(p) for p in body.surface.parameters)
        conditions = tuple(map(list, slopes(plan, body.surface)))
        point, normal = (tuple(map(lower, vector)) for vector in (surface.body_point, surface.body_normal))
        return _Member(body, tuple(margin(plan, body, m) for m in body.margins), parameters, point, normal, conditions)

    return member(pinion), member(wheel)


def _tangent(tape: Tape, member: _Member, number: int) -> list[int]:
    """Nodes of the direction along which neither a margin nor a condition of the member's surface changes."""
    rows = [[tape.derivative(member.margins[number], p) for p in member.parameters], *member.slopes]
    columns, total = range(len(member.parameters)), [tape.constant(0)] * 3
    for j in columns:
        minor = determinant(tape, [[row[k] for k in columns if k != j] for row in rows])
        along = [tape.mul(minor, tape.derivative(i, member.parameters[j])) for i in member.point]
        total = [(tape.sub if j % 2 else tape.add)(a, b) for a, b in zip(total, along, strict=True)]
    return total
