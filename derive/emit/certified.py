"""Print a schedule's functions as tables of operations, for arithmetics that enclose what they compute.

The routines are those of :mod:`derive.passes.enclosed`, not fused, each a list of operations on numbered registers. The
C runtime (``runtime/c/certify``) runs them in whichever arithmetic a proof needs: midpoint and radius, the same in
double-double, polynomials with an error bound. Each constant comes with how far its double is off, π included, and each
factor from the unit of a key to the inner unit.
"""

from dataclasses import dataclass
from fractions import Fraction

from derive.emit.c99 import number
from derive.emit.render import render
from derive.language.drive import PATH
from derive.program.enclosure import Enclosure

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


def code(made, leaves, leading=None):
    """The :class:`Code` of a routine that reads ``leaves`` (node → place in the arguments)."""
    return _Writer(made, leaves).code(len(made.outputs) if leading is None else leading)


def operations_of(made):
    """(operation, nodes that it computes, arguments) of a routine, in an order of evaluation."""
    found = list(_operations(made.tape, made.steps))
    read = {*made.outputs}.union(*(args for _, _, args in found))
    return [step for step in found if read & {*step[1]}]  # nobody reads the sign of what is a magnitude


class _Writer:
    """Assigns registers: each is free again after the last operation that reads it."""

    def __init__(self, routine, leaves):
        self.tape, self.outputs = routine.tape, list(routine.outputs)
        self.steps = operations_of(routine)
        made = {i for step in self.steps for i in step[1]}
        read = dict.fromkeys([a for step in self.steps for a in step[2]] + self.outputs)
        self.inputs = [i for i in read if i not in made and self.tape.const_value(i) is None]
        self.constants = [i for i in read if i not in made and self.tape.const_value(i) is not None]
        self.places = [leaves[i] for i in self.inputs]
        self.register = {i: k for k, i in enumerate([*self.inputs, *self.constants])}
        self.fixed = self.count = len(self.register)
        self.free, self.depth = [], {}
        self.last = {a: at for at, step in enumerate(self.steps) for a in (*step[1], *step[2])}
        self.last |= dict.fromkeys(self.outputs, len(self.steps))

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


def header(plan, routines, generator):
    """The text of the drive's header of tables, of a plan whose design systems are at the end of their path."""
    drive, lower = plan.drive, plan.lower
    by_p = {lower(p.symbol): k for k, p in enumerate(drive.parameters)}
    count, by_state = len(plan.state), dict(plan.state)
    before = {node: slot for node, slot in by_state.items() if slot < plan.design_slots}
    by_x = by_state | {lower(u): count + k for k, u in enumerate(plan.unknowns)}

    def table(name, leaves, leading=None):
        return code(routines[name][-1], leaves, leading)

    return render(
        "certified.h.jinja",
        drive=drive,
        X=drive.name,
        generator=generator,
        literal=number,
        slots=count,
        design_slots=plan.design_slots,
        factors=[_exactly(p.factor).parts() for p in drive.parameters],
        rules=list(_rules(plan, routines["derive"])),
        systems=[_system(system, drive, table) for system in plan.systems],
        setup=table("setup", by_p),
        instant=table("set_phi", before | {lower(drive.instant): count}),
        equations=table("eval", by_x, len(plan.residual)),
        observed=table("watched", by_x),
        along=table("along", before | _line(plan, count)),
        flanks=[table(f"on_{f.body}", by_state | _own(plan, f.parameters), 3) for f in plan.flanks],
        placement=table("placed", before | _own(plan, plan.placement.parameters)),
        turning=int(plan.turns_about_z),
    )


def _own(plan, arguments):
    """Places of a function's own arguments, after the numbers of the state."""
    return {plan.lower(q): len(plan.state) + k for k, q in enumerate(arguments)}


def _line(plan, count):
    """Places of the angle, the unknowns and a direction of both, after ``count`` numbers of the state."""
    own = [plan.lower(plan.drive.instant), *(plan.lower(u) for u in plan.unknowns), *plan.along.direction]
    return {node: count + k for k, node in enumerate(own)}


def _exactly(factor):
    if factor.is_Rational:
        return Enclosure.of(Fraction(int(factor.p), int(factor.q)))
    return Enclosure.of_symbol(factor)


def _rules(plan, routines):
    """Each default and rule: parameter index and code of its value, followed by what must not be zero."""
    index = {p.symbol: k for k, p in enumerate(plan.drive.parameters)}
    for rule, program, made in zip(plan.drive.completion, plan.rules, routines, strict=True):
        leaves = {program.lower(p.symbol): j for j, p in enumerate(plan.drive.parameters)}
        yield {"target": index[rule.target], "code": code(made, leaves)}


def _system(plan, drive, table):
    """A design system at the end of its path: its equations and the values that it fills in, of (q, 1, y)."""
    lower, count = plan.lower, len(drive.parameters)
    leaves = {lower(p.symbol): k for k, p in enumerate(drive.parameters)} | {lower(PATH): count}
    leaves |= {lower(u): count + 1 + k for k, u in enumerate(plan.unknowns)}
    index = {p.symbol: k for k, p in enumerate(drive.parameters)}
    name = plan.system.name
    return {
        "name": name,
        "equations": table(f"system {name}_eval", leaves, len(plan.residual)),
        "values": table(f"system {name}_fill", leaves),
        "fills": [index[target] for target in plan.system.fills],
    }
