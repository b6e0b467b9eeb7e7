"""Print a schedule as one self-contained C99 header.

The header needs only ``sqrt``, has no heap, no writable data and no input or output, compiles as C99 and C++11, and
gives the same bits with every compiler that keeps IEEE arithmetic (no fast-math, no contraction). Compiled with
MW_FUSED it fuses the products that :mod:`derive.passes.fuse` chooses into sums, and needs ``fma`` too.
"""

import re
from dataclasses import dataclass

from derive.emit import approximation, embedded
from derive.emit.render import render
from derive.language.drive import PATH
from derive.passes.fuse import fuse
from derive.passes.order import interleaved
from derive.passes.plan import Schedule
from derive.passes.quotients import reciprocals
from derive.program.routine import routine
from derive.program.tape import Stage

#: Operations from which on a function that is seldom called is compiled as it stands: the time that a compiler takes to
#: allot registers grows with the square of them, and is then seconds, more than any analysis spends in the function.
LONG = 2500

_INFIX = {"add": "+", "sub": "-", "mul": "*", "div": "/"}


def number(value):
    """A C literal that reads back as exactly the double nearest to ``value``."""
    text = repr(float(value))
    return text if any(c in text for c in ".en") else text + ".0"


@dataclass(frozen=True)
class Body:
    """Statements of one C function and the operand of each of its results."""

    statements: tuple[str, ...]
    results: tuple[str, ...]
    operations: int
    long: bool = False  #: whether it is to be compiled as it stands


def estrin(name, variable, coefficients):
    """A polynomial (lowest power first) by Estrin's scheme: few operations wait for one another."""
    statements, terms, power, degree = [], [number(c) for c in coefficients], variable, 1
    while len(terms) > 1:
        joined = []
        for k in range(0, len(terms) - 1, 2):
            value = f"MW_FMA({power}, {terms[k + 1]}, {terms[k]})"
            if len(terms) == 2:
                joined.append(value)
            else:
                joined.append(f"{name}{degree}_{k // 2}")
                statements.append(f"const double {joined[-1]} = {value};")
        terms = joined + terms[len(terms) - len(terms) % 2 :]
        if len(terms) > 1:
            degree *= 2
            statements.append(f"const double {name}_{variable}{degree} = {power} * {power};")
            power = f"{name}_{variable}{degree}"
    return Body(tuple(statements), tuple(terms), 0)


class Printer:
    """Writes straight-line C for sets of nodes of one tape. ``leaves`` maps nodes to what the function can read.

    What is computed ``seldom``, for a design, a start, a solved contact or a point of a flank, calls sine and cosine
    instead of having them written out in place, for the C compiler's sake. ``names`` are words for nodes, written in a
    comment where they are computed.
    """

    def __init__(self, tape, prefix, leaves, suffix="", seldom=False, names=None):
        self.tape = tape
        self.prefix = prefix
        self.leaves = leaves
        self.suffix = suffix  # of local names
        self.names = names or {}
        self.seldom = seldom
        self.sincos = f"{prefix}_seldom_sincos" if seldom else f"{prefix}_sincos"

    def body(self, outputs, known=None, later=()):
        """C that computes ``outputs``; ``known`` maps nodes to operands of earlier statements of the function.

        Returns the body and ``known`` extended by what it computed. The function goes on to ``later``.
        """
        operands = dict(known or {})
        printed = self.routine(outputs, operands, later)
        if not self.seldom or printed.operations < LONG:
            return side_by_side([self], printed, [operands]), operands
        statements = [line for i, step in printed.steps for line in self.statement(i, step, operands)]
        return Body(tuple(statements), self.results(outputs, operands), printed.operations, long=True), operands

    def routine(self, outputs, known, later=()):
        """The routine behind ``outputs`` as it is printed, in an order of evaluation."""
        readable = known.keys() | self.leaves.keys()
        return fuse(reciprocals(routine(self.tape, outputs, readable, later)))

    def results(self, outputs, operands):
        """The operands of ``outputs``."""
        return tuple(self._operand(i, operands) for i in outputs)

    def _operand(self, i, operands):
        value = self.tape.const_value(i)
        if value is not None:
            return number(value) if value >= 0 else f"({number(value)})"
        return operands[i] if i in operands else self.leaves[i]

    def statement(self, i, operation, operands):
        """Statements that compute a node, which is added to ``operands``; none if it is there already."""
        if i in operands:
            return []
        serial, args = f"{len(operands)}{self.suffix}", [self._operand(a, operands) for a in operation.args]
        if operation.op in ("sin", "cos"):
            return self._sincos(operation.args[0], args[0], serial, operands)
        operands[i] = f"t{serial}"
        match operation.op:
            case "fma" | "fms" | "fnma":
                value = f"MW_{operation.op.upper()}({', '.join(args)})"
            case "neg":
                value = f"-{args[0]}"
            case "sqrt":
                value = f"sqrt({args[0]})"
            case "sign":
                value = f"MW_SIGN({args[0]})"
            case "atan2":
                value = f"{self.prefix}_atan2({args[0]}, {args[1]})"
            case op:
                value = f"{args[0]} {_INFIX[op]} {args[1]}"
        words = f"  /* {self.names[i]} */" if i in self.names else ""
        return [f"const double t{serial} = {value};{words}"]

    def _sincos(self, argument, operand, serial, operands):
        for op, letter in (("sin", "s"), ("cos", "c")):
            if (node := self.tape.find(op, argument)) is not None:
                operands[node] = f"{letter}{serial}"
        words = f"  /* of {self.names[argument]} */" if argument in self.names else ""
        return [f"double s{serial}, c{serial};{words}", self.turned(argument, operand, f"&s{serial}, &c{serial}")]

    def turned(self, argument, operand, results):
        """The call that writes sine and cosine of a node."""
        return f"{self.sincos}({operand}, {results});"


class AnchoredPrinter(Printer):
    """Writes sines and cosines by those of an anchor close by, which has them of ``angles`` in their order."""

    def __init__(self, tape, prefix, leaves, angles, names=None):
        super().__init__(tape, prefix, leaves, names=names)
        self.places = {node: 3 * k for k, node in enumerate(angles)}

    def turned(self, argument, operand, results):
        return f"{self.prefix}_near_sincos({operand}, {results}, at + {self.places[argument]}, &away);"


#: Cycles by which a second copy of a program lags behind the first: one is wide where the other waits.
LAG = 80


def side_by_side(printers, printed, operands):
    """One body that computes a routine's outputs by each of several printers of the same tape, statement beside
    statement.

    ``operands`` holds what is known to each printer and receives what is computed. Results come printer by printer.
    """
    program, statements = dict(printed.steps), []
    for copy, i in interleaved(printed, tuple(LAG * k for k in range(len(printers)))):
        statements += printers[copy].statement(i, program[i], operands[copy])
    results = [
        r for printer, known in zip(printers, operands, strict=True) for r in printer.results(printed.outputs, known)
    ]
    return Body(tuple(statements), tuple(results), printed.operations)


@dataclass(frozen=True)
class Leaves:
    """What each stage's functions can read: node → C operand."""

    design: dict
    instant: dict
    iterate: dict
    moving: dict  #: of functions of input angle and unknowns
    state: dict

    @classmethod
    def of(cls, plan: Schedule):
        tape, lower = plan.tape, plan.lower
        state = {node: f"s[{slot}]" for node, slot in plan.state.items()}
        before = {n: text for n, text in state.items() if tape.stages[n] == Stage.DESIGN}
        instant = before | {lower(plan.drive.instant): "phi"}
        unknowns = {lower(u): f"x[{k}]" for k, u in enumerate(plan.unknowns)}
        return cls(
            design={lower(p.symbol): f"p[{k}]" for k, p in enumerate(plan.drive.parameters)},
            instant=instant,
            iterate=state | unknowns,
            moving=instant | unknowns,
            state=state,
        )


def words(plan: Schedule):
    """Node → name and meaning, of definitions, residual rows, the wheel's angle and what is divided by."""
    drive, tape, lower = plan.drive, plan.tape, plan.lower
    meanings = {str(symbol): symbol.meaning for symbol, _ in drive.definitions.items()}
    found = {node: (name, meanings.get(name, "")) for node, name in lower.names().items()}
    found |= {node: (f"row {k} of the contact equations", "") for k, node in enumerate(plan.residual)}
    found |= {lower(u): (u.name, "") for u in plan.unknowns}
    found.setdefault(lower(drive.wheel_angle), ("wheel angle", ""))
    for node, origin in tape.origins.items():
        if origin is not None and origin.meaning and node not in found:
            found[node] = (origin.statement, origin.meaning)
    return {node: _comment(*told) for node, told in found.items()}


def _comment(name, meaning):
    """Words that cannot end a comment, nor be taken for operations."""
    told = f"{name}: {meaning}" if meaning else name
    return re.sub(r"[^A-Za-z0-9_ ,.:'()/-]|(?<![a-z])-|-(?![a-z])| / ", " ", told)


def header(plan: Schedule, description: dict, runtime):
    """The text of the drive's header. ``description`` is the drive's metadata (see :mod:`derive.emit.metadata`),
    ``runtime`` the folder of the C runtime.
    """
    drive, prefix, tape = plan.drive, plan.drive.name, plan.tape
    leaves = Leaves.of(plan)
    names = words(plan)
    design = Printer(tape, prefix, leaves.design, seldom=True, names=names)
    instant = Printer(tape, prefix, leaves.instant)
    iterate = Printer(tape, prefix, leaves.iterate, names=names)
    solved = Printer(tape, prefix, leaves.iterate, seldom=True, names=names)
    anchored = AnchoredPrinter(tape, prefix, leaves.moving, plan.angles, names=names)
    start_unknowns = {plan.lower(u.symbol): f"y[{k}]" for k, u in enumerate(drive.start.unknowns)}
    start = Printer(tape, prefix, leaves.iterate | start_unknowns, seldom=True)
    slots = list(plan.state)
    residual, jacobian = linearised(iterate, plan.residual, plan.jacobian)
    start_residual, start_jacobian = linearised(start, plan.start_residual, plan.start_jacobian)
    return render(
        "drive.h.jinja",
        plan=plan,
        drive=drive,
        X=prefix,
        description=description,
        tables=embedded.tables(runtime),
        solver=embedded.solver(runtime),
        indices=list(_indices(description)),
        rules=list(_rules(plan)),
        sizes=_from_parameters(drive, plan.sizes).body(plan.sizes.nodes)[0],
        guards=design.body([g.node for g in plan.guards])[0],
        setup=design.body(slots[: plan.design_slots])[0],
        kept=[f"p[{k}]" for k in range(len(drive.parameters))],
        set_phi=instant.body(slots[plan.design_slots :])[0],
        residual=residual,
        jacobian=jacobian,
        step=iterate.body(plan.newton_step)[0],
        anchored=anchored.body(plan.residual)[0],
        anchor=Printer(tape, prefix, leaves.moving, seldom=True).body(plan.angles)[0],
        scale=iterate.body(plan.scales)[0],
        guess=iterate.body(plan.start_guess)[0],
        start_scale=iterate.body(plan.start_scales)[0],
        start_residual=start_residual,
        start_jacobian=start_jacobian,
        start_solution=start.body(plan.start_solution)[0],
        observed=solved.body([i for o in plan.observed for i in o.nodes])[0],
        flanks=[_surface(plan, flank, leaves.state) for flank in plan.flanks],
        regions=[_surface(plan, region, leaves.state) for region in plan.regions],
        along=_along(plan, leaves),
        systems=[_system(system, drive) for system in plan.systems],
        functions=[_function(plan, f, leaves.state) for f in plan.functions],
        literal=number,
        approximation=approximation,
        estrin=estrin,
    )


def _indices(description):
    """Names and values of the index macros: parameters by key and the words of those that are choices, unknowns and
    outputs by name.

    A key that several tables of a design have is the design's own; that of another table begins with its name.
    """
    keys = [p["key"] or p["name"] for p in description["parameters"]]
    for k, (key, p) in enumerate(zip(keys, description["parameters"], strict=True)):
        name = key if keys.count(key) == 1 or p["table"] == "design" else f"{p['table']}_{key}"
        yield f"P_{name}", k
        yield from ((f"W_{name}_{word.replace('-', '_')}", f"({number})") for word, number in p["choices"].items())
    yield from ((f"U_{u['name']}", k) for k, u in enumerate(description["unknowns"]))
    yield from ((f"O_{o['name']}", o["offset"]) for o in description["outputs"])


def linearised(printer, residual, jacobian):
    """Bodies of one function: of the residual, and of the Jacobian that may follow it."""
    flat = [e for row in jacobian for e in row]
    body, known = printer.body(residual, later=flat)
    return body, printer.body(flat, known)[0]


def _surface(plan, flank, state):
    body, curvature = (_on_arguments(plan, flank.parameters, o, state) for o in (flank.outputs, flank.curvature))
    return {"flank": flank, "body": body, "curvature": curvature}


def _function(plan, function, state):
    tests = plan.tests.get((function.name, 0))
    return {"function": function, "body": _on_arguments(plan, function.parameters, function.outputs, state, tests)}


def _on_arguments(plan, arguments, outputs, state, tests=None):
    """The body of a function of its own arguments q and the state."""
    own = {plan.lower(q): f"q[{k}]" for k, q in enumerate(arguments)}
    printer = Printer(plan.tape, plan.drive.name, state | own, seldom=True)
    return _tested(printer, [o.nodes for o in outputs], tests or {})


def _along(plan, leaves):
    """Bodies of the residual's first derivative along a direction v, and of the second that may follow it."""
    own = {node: f"v[{k}]" for k, node in enumerate(plan.along.direction)}
    printer = Printer(plan.tape, plan.drive.name, leaves.moving | own, seldom=True)
    body, known = printer.body(plan.along.first, later=plan.along.second)
    return {"first": body, "second": printer.body(plan.along.second, known)[0]}


def _system(plan, drive):
    """A design system's C: functions of q, the parameters followed by the share of the path, and of y."""
    lower, count = plan.lower, len(drive.parameters)
    known = {lower(p.symbol): f"q[{k}]" for k, p in enumerate(drive.parameters)} | {lower(PATH): f"q[{count}]"}
    leaves = known | {lower(u): f"y[{k}]" for k, u in enumerate(plan.unknowns)}
    printer = Printer(plan.tape, drive.name, leaves, seldom=True)
    index = {p.symbol: k for k, p in enumerate(drive.parameters)}
    residual, jacobian = linearised(printer, plan.residual, plan.jacobian)
    return {
        "name": plan.system.name,
        "unknowns": plan.unknowns,
        "guess": printer.body(plan.guess)[0],
        "scale": printer.body(plan.scales)[0],
        "residual": residual,
        "jacobian": jacobian,
        "watch": None if plan.watch is None else printer.body([plan.watch])[0],
        "values": printer.body(plan.values)[0],
        "fills": [index[target] for target in plan.system.fills],
    }


def _rules(plan):
    """Each default and rule of the drive: parameter index, statements, value, name."""
    drive = plan.drive
    index = {p.symbol: k for k, p in enumerate(drive.parameters)}
    for k, (rule, program) in enumerate(zip(drive.completion, plan.rules, strict=True)):
        body = _tested(_from_parameters(drive, program), [program.nodes], plan.tests.get(("derive", k), {}))
        target = rule.target
        yield {"index": index[target], "statements": body.statements, "value": body.results[0], "name": target.name}


def _tested(printer, groups, tests):
    """The body of a function; where a node of ``tests`` (group of results → nodes) is zero, they are not numbers."""
    outputs = [i for group in groups for i in group]
    wanted = [tests.get(tuple(group), ()) for group in groups for _ in group]
    nodes = [i for each in wanted for i in each]
    body, _ = printer.body([*outputs, *nodes])
    operand = dict(zip(nodes, body.results[len(outputs) :], strict=True))

    def result(value, each):
        holds = " && ".join(f"({operand[i]} > 0.0 || {operand[i]} < 0.0)" for i in each)
        return f"{holds} ? {value} : NAN" if each else value

    return Body(body.statements, tuple(map(result, body.results[: len(outputs)], wanted)), body.operations)


def _from_parameters(drive, program):
    """A printer of expressions of the parameter vector alone."""
    leaves = {program.lower(p.symbol): f"p[{k}]" for k, p in enumerate(drive.parameters)}
    return Printer(program.tape, drive.name, leaves, seldom=True)
