"""Print a schedule as one self-contained C99 header, of the routines that :mod:`derive.passes.arrange` has made.

The header needs only ``sqrt``, has no heap, no writable data and no input or output, compiles as C99 and C++11, and
gives the same bits with every compiler that keeps IEEE arithmetic (no fast-math, no contraction). Compiled with
MW_FUSED it fuses the products that :mod:`derive.passes.fuse` chooses into sums, and needs ``fma`` too.
"""

import math
import re
from dataclasses import dataclass

from derive.emit import approximation, embedded
from derive.emit.render import render
from derive.language.drive import PATH
from derive.language.symbols import Table
from derive.passes.arrange import Routines
from derive.passes.plan import Schedule
from derive.program.names import Names
from derive.program.tape import Stage

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
    """Writes straight-line C for routines of one tape. ``leaves`` maps nodes to what the function can read.

    What is computed ``seldom``, for a design, a start, a solved contact or a point of a flank, calls sine and cosine
    instead of having them written out in place, for the C compiler's sake. Local variables have the ``names`` of their
    nodes, after ``own``; ``words`` are written in a comment where a node is computed.
    """

    def __init__(self, names: Names, prefix, leaves, own="", seldom=False, words=None):
        self.tape = names.tape
        self.prefix = prefix
        self.leaves = leaves
        self.own = own
        self.names = names.apart()
        self.words = words or {}
        self.sincos = f"{prefix}_seldom_sincos" if seldom else f"{prefix}_sincos"

    def body(self, printed, known=None):
        """C of a routine; ``known`` maps nodes to operands of earlier statements of the function.

        Returns the body and ``known`` extended by what it computed.
        """
        operands = dict(known or {})
        statements = tuple(line for i, step in printed.steps for line in self.statement(i, step, operands))
        results = self.results(printed.outputs, operands)
        return Body(statements, results, printed.operations, printed.long), operands

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
        args = [self._operand(a, operands) for a in operation.args]
        if operation.op in ("sin", "cos"):
            return self._sincos(operation.args[0], args[0], operands)
        name = operands[i] = f"{self.own}t_{self.names(i)}"
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
        words = f"  /* {self.words[i]} */" if i in self.words else ""
        return [f"const double {name} = {value};{words}"]

    def _sincos(self, argument, operand, operands):
        sine, cosine = (f"{self.own}{op}_{self.names(argument)}" for op in ("sin", "cos"))
        for op, name in (("sin", sine), ("cos", cosine)):
            if (node := self.tape.find(op, argument)) is not None:
                operands[node] = name
        return [f"double {sine}, {cosine}; {self.turned(argument, operand, f'&{sine}, &{cosine}')}"]

    def turned(self, argument, operand, results):
        """The call that writes sine and cosine of a node."""
        return f"{self.sincos}({operand}, {results});"


class AnchoredPrinter(Printer):
    """Writes sines and cosines by those of an anchor close by, which has them of ``angles`` in their order."""

    def __init__(self, names: Names, prefix, leaves, angles, words=None):
        super().__init__(names, prefix, leaves, words=words)
        self.places = {node: 3 * k for k, node in enumerate(angles)}

    def turned(self, argument, operand, results):
        return f"{self.prefix}_near_sincos({operand}, {results}, at + {self.places[argument]}, &away);"


@dataclass(frozen=True)
class Leaves:
    """What each stage's functions can read: node → C operand."""

    design: dict
    instant: dict
    iterate: dict
    moving: dict  #: of functions of input angle and unknowns
    state: dict

    @classmethod
    def of(cls, plan: Schedule, state=None):
        """``state``: how its values are read, if not by their places."""
        tape, lower = plan.tape, plan.lower
        state = state or {node: f"s[{slot}]" for node, slot in plan.state.items()}
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


def names_of(plan: Schedule):
    """The names of a schedule's values: its page's own, then those of what is read of flanks and of a contact."""
    found = dict(plan.lower.names())
    surfaces = ((f"{f.region}_{f.body}_", f) for f in (*plan.flanks, *plan.regions))
    outputs = [(before + o.name, o) for before, f in surfaces for o in (*f.outputs, *f.curvature)]
    outputs += [(o.name, o) for o in plan.observed]
    for name, nodes in [("R", plan.residual), *((name, o.nodes) for name, o in outputs)]:
        places = "xyz" if len(nodes) == 3 else range(len(nodes))
        for node, place in zip(nodes, places, strict=True):
            if plan.tape.arguments[node]:
                found.setdefault(node, f"{name}_{place}" if len(nodes) > 1 else name)
    return Names(plan.tape, found)


def words(plan: Schedule):
    """Node → what it means, of definitions, residual rows and what is divided by."""
    meanings = {str(symbol): symbol.meaning for symbol, _ in plan.drive.definitions.items()}
    found = {node: meanings.get(name, "") for node, name in plan.lower.names().items()}
    found |= {node: f"row {k} of the contact equations" for k, node in enumerate(plan.residual)}
    for node, origin in plan.tape.origins.items():
        if origin is not None and origin.meaning and node not in found:
            found[node] = f"{origin.statement}: {origin.meaning}"
    return {node: _comment(told) for node, told in found.items() if told}


def _comment(told):
    """Words that cannot end a comment, nor be taken for operations."""
    return re.sub(r"[^A-Za-z0-9_ ,.:'()/-]|(?<![a-z])-|-(?![a-z])| / ", " ", told)


def header(plan: Schedule, routines: Routines, description: dict, runtime):
    """The text of the drive's header. ``description`` is the drive's metadata (see :mod:`derive.emit.metadata`),
    ``runtime`` the folder of the C runtime.
    """
    drive, prefix, names, told = plan.drive, plan.drive.name, names_of(plan), words(plan)
    unlike = names.apart()
    places = {node: unlike(node) for node in plan.state}
    leaves = Leaves.of(plan, {node: f"MW_S({name})" for node, name in places.items()})
    design = Printer(names, prefix, leaves.design, seldom=True, words=told)
    instant = Printer(names, prefix, leaves.instant)
    iterate = Printer(names, prefix, leaves.iterate, words=told)
    solved = Printer(names, prefix, leaves.iterate, seldom=True, words=told)
    anchored = AnchoredPrinter(names, prefix, leaves.moving, plan.angles, words=told)
    start_unknowns = {plan.lower(u.symbol): f"y[{k}]" for k, u in enumerate(drive.start.unknowns)}
    start = Printer(names, prefix, leaves.iterate | start_unknowns, seldom=True)
    residual, jacobian = linearised(iterate, routines["eval"])
    start_residual, start_jacobian = linearised(start, routines["start_eval"])
    guards, setup = (design.body(part)[0] for part in routines["setup"])

    def body(printer, name):
        return printer.body(*routines[name])[0]

    return render(
        "drive.h.jinja",
        plan=plan,
        drive=drive,
        X=prefix,
        description=description,
        other_flank=_other_flank(drive),
        sample=_sample(description["self_test"]),
        pose=[*plan.pose, *_misalignments(drive, description["shapes"]["s"][0] - len(drive.parameters))],
        tables=embedded.tables(runtime),
        solver=embedded.solver(runtime),
        indices=list(_indices(description)),
        rules=list(_rules(plan, routines)),
        sizes=body(_from_parameters(drive, plan.sizes), "size"),
        guards=guards,
        setup=setup,
        places=list(places.values()),
        set_phi=body(instant, "set_phi"),
        residual=residual,
        jacobian=jacobian,
        step=body(iterate, "step"),
        anchored=body(anchored, "by_anchor"),
        anchor=body(Printer(names, prefix, leaves.moving, seldom=True), "anchor"),
        scale=body(iterate, "scale"),
        guess=body(iterate, "guess"),
        start_scale=body(iterate, "start_scale"),
        start_residual=start_residual,
        start_jacobian=start_jacobian,
        start_solution=body(start, "start_solution"),
        observed=body(solved, "observe"),
        flanks=[_surface(plan, names, flank, leaves.state, routines) for flank in plan.flanks],
        regions=[_surface(plan, names, region, leaves.state, routines) for region in plan.regions],
        along=_along(plan, names, leaves, routines["along"]),
        systems=[_system(system, drive, routines) for system in plan.systems],
        functions=[_function(plan, names, f, leaves.state, routines) for f in plan.functions],
        literal=number,
        approximation=approximation,
        estrin=estrin,
    )


def _other_flank(drive):
    """Index of the parameter whose sign tells two flanks of one design apart; −1 where each has a design of its own."""
    signs = [k for k, p in enumerate(drive.parameters) if p.table == Table.FLANK]
    return -1 if drive.flanks_apart or not signs else signs[0]


def _misalignments(drive, first):
    """Places of the misalignments among the parameters that begin at ``first``."""
    return [first + k for k, p in enumerate(drive.parameters) if p.table == Table.MISALIGNMENT]


def _sample(test):
    """The numbers of a self-test as C has them; NAN is an open parameter."""
    def literal(text):
        value = float.fromhex(text)
        return number(value) if math.isfinite(value) else "NAN"

    return {"p": [*map(literal, test["p"])], "phi": literal(test["phi"]), "x": [*map(literal, test["x"])]}


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


def linearised(printer, routines):
    """Bodies of one function: of the residual, and of the Jacobian that may follow it."""
    residual, jacobian = routines
    body, known = printer.body(residual)
    return body, printer.body(jacobian, known)[0]


def _surface(plan, names, flank, state, routines):
    printer, name = _on_arguments(plan, names, flank.parameters, state), f"{flank.region}_{flank.body}"
    body, curvature = (printer.body(*routines[f"surface {of}"])[0] for of in (name, f"curvature_{name}"))
    return {"flank": flank, "body": body, "curvature": curvature}


def _function(plan, names, function, state, routines):
    printer, groups = _on_arguments(plan, names, function.parameters, state), [o.nodes for o in function.outputs]
    [made], tests = routines[f"function {function.name}"], plan.tests.get((function.name, 0), {})
    return {"function": function, "body": _tested(printer, made, groups, tests)}


def _on_arguments(plan, names, arguments, state):
    """A printer of functions of their own arguments q and the state."""
    own = {plan.lower(q): f"q[{k}]" for k, q in enumerate(arguments)}
    return Printer(names, plan.drive.name, state | own, seldom=True)


def _along(plan, names, leaves, routines):
    """Bodies of the residual's first derivative along a direction v, and of the second that may follow it."""
    own = {node: f"v[{k}]" for k, node in enumerate(plan.along.direction)}
    first, second = linearised(Printer(names, plan.drive.name, leaves.moving | own, seldom=True), routines)
    return {"first": first, "second": second}


def _system(plan, drive, routines):
    """A design system's C: functions of q, the parameters followed by the share of the path, and of y."""
    lower, count = plan.lower, len(drive.parameters)
    known = {lower(p.symbol): f"q[{k}]" for k, p in enumerate(drive.parameters)} | {lower(PATH): f"q[{count}]"}
    leaves = known | {lower(u): f"y[{k}]" for k, u in enumerate(plan.unknowns)}
    printer = Printer(Names(plan.tape, lower.names()), drive.name, leaves, seldom=True)
    index, name = {p.symbol: k for k, p in enumerate(drive.parameters)}, plan.system.name
    residual, jacobian = linearised(printer, routines[f"system {name}_eval"])
    guess, scale, watch, values = (
        printer.body(*routines[f"system {name}_{part}"])[0] for part in ("guess", "scale", "watch", "fill")
    )
    return {
        "name": name,
        "unknowns": plan.unknowns,
        "guess": guess,
        "scale": scale,
        "residual": residual,
        "jacobian": jacobian,
        "watch": None if plan.watch is None else watch,
        "values": values,
        "fills": [index[target] for target in plan.system.fills],
    }


def _rules(plan, routines):
    """Each default and rule of the drive: parameter index, statements, value, name."""
    drive = plan.drive
    index = {p.symbol: k for k, p in enumerate(drive.parameters)}
    for k, (rule, program) in enumerate(zip(drive.completion, plan.rules, strict=True)):
        printer, tests = _from_parameters(drive, program), plan.tests.get(("derive", k), {})
        body = _tested(printer, routines["derive"][k], [program.nodes], tests)
        target = rule.target
        yield {"index": index[target], "statements": body.statements, "value": body.results[0], "name": target.name}


def _tested(printer, made, groups, tests):
    """The body of a function; where a node of ``tests`` (group of results → nodes) is zero, they are not numbers."""
    outputs = [i for group in groups for i in group]
    wanted = [tests.get(tuple(group), ()) for group in groups for _ in group]
    nodes = [i for each in wanted for i in each]
    body, _ = printer.body(made)
    operand = dict(zip(nodes, body.results[len(outputs) :], strict=True))

    def result(value, each):
        holds = " && ".join(f"({operand[i]} > 0.0 || {operand[i]} < 0.0)" for i in each)
        return f"{holds} ? {value} : NAN" if each else value

    return Body(body.statements, tuple(map(result, body.results[: len(outputs)], wanted)), body.operations)


def _from_parameters(drive, program):
    """A printer of expressions of the parameter vector alone."""
    leaves = {program.lower(p.symbol): f"p[{k}]" for k, p in enumerate(drive.parameters)}
    return Printer(Names(program.tape, program.lower.names()), drive.name, leaves, seldom=True)
