"""Print a schedule's functions as tables of operations, for arithmetics that enclose what they compute.

The same routines as the C99 printer's (:mod:`derive.emit.c99`), not fused, each a list of operations on numbered
registers. The C runtime (``runtime/c/certify``) runs them in whichever arithmetic a proof needs: midpoint and radius,
the same in double-double, polynomials with an error bound. Each constant comes with how far its double is off, π
included, and each factor from the unit of a key to the inner unit.
"""

from dataclasses import dataclass
from fractions import Fraction

import sympy as sp

from derive.emit.c99 import number
from derive.emit.render import render
from derive.language.chain import Rotation
from derive.language.drive import PATH
from derive.passes.quotients import reciprocals
from derive.program.enclosure import Enclosure
from derive.program.routine import routine

#: Operations by number, as in mw_certified.h. A square is its own operation: it is never negative.
OPERATIONS = ("add", "sub", "mul", "sqr", "div", "neg", "sqrt", "sincos", "atan2", "magnitude", "sign")

#: Most factors 1 + 2⁻⁵³ by which radii of one function may be off: their reader allows for 2⁻⁴⁰.
DEEPEST = 8000


class TooDeep(ValueError):
    """A function whose radii are rounded more often than their reader allows for."""


@dataclass(frozen=True)
class Code:
    """One function. Registers hold inputs, constants, then what is computed.

    ``inputs`` are places in the function's arguments, in a row; ``constants`` (high, low, radius); ``instructions``
    (operation, result, first, second argument), where the cosine of a ``sincos`` goes to the second argument;
    ``outputs`` are registers, of which the first ``leading`` are known after ``first`` instructions.
    """

    registers: int
    inputs: tuple[int, ...]
    constants: tuple[tuple[float, float, float], ...]
    instructions: tuple[tuple[int, int, int, int], ...]
    outputs: tuple[int, ...]
    first: int


def code(tape, outputs, leaves, leading=None):
    """The :class:`Code` that computes these nodes from ``leaves`` (node → place in the arguments)."""
    first = len(outputs) if leading is None else leading
    return _Writer(tape, list(outputs), leaves).code(first)


def operations_of(tape, outputs, known):
    """(operation, nodes that it computes, arguments) in an order of evaluation that leads to ``outputs``."""
    found = list(_operations(tape, reciprocals(routine(tape, outputs, known)).steps))
    read = {*outputs}.union(*(args for _, _, args in found))
    return [step for step in found if read & {*step[1]}]  # nobody reads the sign of what is a magnitude


class _Writer:
    """Assigns registers: each is free again after the last operation that reads it."""

    def __init__(self, tape, outputs, leaves):
        self.tape, self.outputs = tape, outputs
        self.steps = list(operations_of(tape, outputs, leaves.keys()))
        made = {i for step in self.steps for i in step[1]}
        read = dict.fromkeys([a for step in self.steps for a in step[2]] + outputs)
        self.inputs = [i for i in read if i not in made and tape.const_value(i) is None]
        self.constants = [i for i in read if i not in made and tape.const_value(i) is not None]
        self.places = [leaves[i] for i in self.inputs]
        self.register = {i: k for k, i in enumerate([*self.inputs, *self.constants])}
        self.fixed = self.count = len(self.register)
        self.free, self.depth = [], {}
        self.last = {a: at for at, step in enumerate(self.steps) for a in (*step[1], *step[2])}
        self.last |= dict.fromkeys(outputs, len(self.steps))

    def code(self, leading):
        instructions, wanted, first = [], set(self.outputs[:leading]), 0
        for at, (op, results, args) in enumerate(self.steps):
            self._deepen(op, results, args)
            read = [self.register[a] for a in args]
            if op == "sincos":  # writes the one result while it reads for the other
                places = [self._new(), self._new()]
                instructions.append((OPERATIONS.index(op), places[0], read[0], places[1]))
            else:
                self._release(at, args)
                places = [self._new()]
                instructions.append((OPERATIONS.index(op), places[0], read[0], read[-1]))
            self.register |= dict(zip(results, places, strict=False))
            if op == "sincos":
                self._release(at, args)
            self._release(at, results)
            if wanted & set(results):
                first = at + 1
        outputs = tuple(self.register[i] for i in self.outputs)
        constants = tuple(self.tape.enclosure(i).parts() for i in self.constants)
        return Code(self.count, tuple(self.places), constants, tuple(instructions), outputs, first)

    def _new(self):
        if self.free:
            return self.free.pop()
        self.count += 1
        return self.count - 1

    def _release(self, at, nodes):
        for i in dict.fromkeys(nodes):
            if self.last[i] == at and self.register[i] >= self.fixed:
                self.free.append(self.register[i])

    def _deepen(self, op, results, args):
        """Count the factors 1 + 2⁻⁵³ by which the radius of a result may be off: 12 an operation at most, since of two
        radii that are multiplied the one is read.
        """
        through = max(self.depth.get(a, 0) for a in args) + 12
        if through > DEEPEST:
            raise TooDeep(f"an {op} after {through} roundings of radii: let it be read in two functions")
        self.depth |= dict.fromkeys(results, through)


def _operations(tape, steps):
    """(operation, nodes that it computes, arguments); sine and cosine of one angle are one operation."""
    made, done = dict(steps), set()
    for i, step in steps:
        if i in done:
            continue
        if step.op in ("sin", "cos"):
            pair = [tape.find(op, *step.args) for op in ("sin", "cos")]
            done |= {k for k in pair if k is not None}
            # a cosine alone: its sine goes to a register of its own, which nobody reads
            yield "sincos", [("unread", i) if k is None or k not in made else k for k in pair], step.args
        elif step.op == "mul" and step.args[0] == step.args[1]:
            yield "sqr", [i], step.args[:1]
        elif step.op == "mul" and (of := [a for a in step.args if tape.find("sign", a) in step.args]):
            yield "magnitude", [i], of[:1]  # enclosed at 0 too, where a sign alone is not
        else:
            yield step.op, [i], step.args


def header(plan, systems, generator):
    """The text of the drive's header of tables; ``systems`` are its design systems at the end of their path."""
    drive, tape, lower = plan.drive, plan.tape, plan.lower
    by_p = {lower(p.symbol): k for k, p in enumerate(drive.parameters)}
    slots, count = list(plan.state), len(plan.state)
    by_state = dict(plan.state)
    before = {node: slot for node, slot in by_state.items() if slot < plan.design_slots}
    by_x = by_state | {lower(u): count + k for k, u in enumerate(plan.unknowns)}
    jacobian = [e for row in plan.jacobian for e in row]
    return render(
        "certified.h.jinja",
        drive=drive,
        X=drive.name,
        generator=generator,
        literal=number,
        slots=count,
        design_slots=plan.design_slots,
        factors=[_exactly(p.factor).parts() for p in drive.parameters],
        rules=list(_rules(plan)),
        systems=[_system(system, drive) for system in systems],
        setup=code(tape, slots[: plan.design_slots], by_p),
        instant=code(tape, slots[plan.design_slots :], before | {lower(drive.instant): count}),
        equations=code(tape, [*plan.residual, *jacobian], by_x, len(plan.residual)),
        observed=code(tape, _watched(plan), by_x),
        along=code(tape, [*plan.along.first, *plan.along.second], before | _line(plan, count)),
        flanks=list(_flanks(plan)),
        placement=_placement(plan, before),
        turning=int(_turns_about_z(drive)),
    )


def _flanks(plan):
    """Both flanks: point, then regular and margins, then its tangents. The pinion's in the fixed frame, where its turn
    and its parameters meet in fewer angles; the wheel's in its own.
    """
    found, slots = {o.name: o.nodes for o in plan.observed}, dict(plan.state)
    for body, flank in zip(plan.drive.bodies, plan.flanks, strict=True):
        local = {o.name: o.nodes for o in flank.outputs}
        fixed = body is plan.drive.bodies[0]
        point = found[f"point_{body.name}_f"] if fixed else local["point"]
        tangents = [i for q in flank.parameters for i in (found if fixed else local)[f"tangent_{q}"]]
        own = {plan.lower(q): len(plan.state) + k for k, q in enumerate(flank.parameters)}
        yield code(plan.tape, [*point, *flank.limits, *tangents], slots | own, len(point))


def _placement(plan, before):
    own = {plan.lower(q): len(plan.state) + k for k, q in enumerate(plan.placement.parameters)}
    return code(plan.tape, [i for o in plan.placement.outputs for i in o.nodes], before | own)


def _turns_about_z(drive):
    """Whether the wheel's angle is that of the last of its rotations, about the z axis of its own frame, alone."""
    *others, last = drive.wheel.motion.factors
    moves = any(sp.sympify(e).has(drive.error) for factor in others for e in factor.expressions())
    return isinstance(last, Rotation) and last.axis == "z" and sp.diff(last.angle, drive.error) in (1, -1) and not moves


def _line(plan, count):
    """Places of the angle, the unknowns and a direction of both, after ``count`` numbers of the state."""
    own = [plan.lower(plan.drive.instant), *(plan.lower(u) for u in plan.unknowns), *plan.along.direction]
    return {node: count + k for k, node in enumerate(own)}


def _exactly(factor):
    if factor.is_Rational:
        return Enclosure.of(Fraction(int(factor.p), int(factor.q)))
    return Enclosure.of_symbol(factor)


def _watched(plan):
    """What is enclosed at a contact: points and normals of both members in the fixed frame, the pinion's first; wheel
    angle; principal curvatures of the gap; of each body whether it is regular, and its margins.
    """
    found, flat = {o.name: o.nodes for o in plan.observed}, [i for o in plan.observed for i in o.nodes]
    nodes = []
    for body in plan.drive.bodies:
        nodes += [*found[f"point_{body.name}_f"], *found[f"normal_{body.name}_f"]]
    nodes += [*found["wheel_angle"], *found["curvature_gap"]]
    for body in plan.drive.bodies:
        places = plan.bodies[body.name]
        nodes += [flat[at] for at in (places.singular, *places.margins)]
    return nodes


def _rules(plan):
    """Each default and rule: parameter index and code of its value, followed by what must not be zero."""
    index = {p.symbol: k for k, p in enumerate(plan.drive.parameters)}
    for k, (rule, program) in enumerate(zip(plan.drive.completion, plan.rules, strict=True)):
        tests = [i for nodes in plan.tests.get(("derive", k), {}).values() for i in nodes]
        leaves = {program.lower(p.symbol): j for j, p in enumerate(plan.drive.parameters)}
        yield {"target": index[rule.target], "code": code(program.tape, [*program.nodes, *tests], leaves)}


def _system(plan, drive):
    """A design system at the end of its path: its equations and the values that it fills in, of (q, 1, y)."""
    lower, count = plan.lower, len(drive.parameters)
    leaves = {lower(p.symbol): k for k, p in enumerate(drive.parameters)} | {lower(PATH): count}
    leaves |= {lower(u): count + 1 + k for k, u in enumerate(plan.unknowns)}
    index = {p.symbol: k for k, p in enumerate(drive.parameters)}
    equations = [*plan.residual, *(e for row in plan.jacobian for e in row)]
    return {
        "name": plan.system.name,
        "equations": code(plan.tape, equations, leaves, len(plan.residual)),
        "values": code(plan.tape, plan.values, leaves),
        "fills": [index[target] for target in plan.system.fills],
    }
