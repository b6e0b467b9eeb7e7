"""Side conditions: where the divisions, roots and arcs of a schedule are defined, and what answers where they are not.

Input: a schedule. Output: guards that ``setup`` tests, and for every partial operation of every generated function its
condition, the statement of the record that carries it, and its guard. What no guard holds is an error here.

A guard in ``setup`` tests each design quantity that the solution of a contact divides by or takes the root of. Later
stages test nothing on their way: a quotient by zero is not finite, a root of a negative number is not a number, and
:func:`_caught` proves on the tape that this reaches what the runtime tests (the size of the Newton step) or is the
result itself.
"""

from collections import Counter, defaultdict
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, reduce
from typing import TypeAlias, TypedDict

from derive.language.origin import ARCCOSINE, PARTIAL, Origin
from derive.passes.completion import ParameterTape, SystemTape
from derive.passes.plan import Bound, DesignGuard, Output, Schedule, Tests
from derive.passes.quotients import by_reciprocal
from derive.program.formula import formula
from derive.program.lowering import Lowering
from derive.program.tape import Node, Stage, Tape

#: A node and what it must be, results of which one must show a failure, and of each node a bit for each condition.
Condition: TypeAlias = tuple[int, str]
Group: TypeAlias = tuple[int, ...]
Bits: TypeAlias = Mapping[int, int]

#: What answers where a condition fails, by the name under which side conditions refer to it.
GUARDS = {
    "setup": "setup returns the number of the guard; mw_solve and mw_trace answer bad_input",
    "parameter": "the parameter is not a finite number: setup has a guard for it, a limit of the blank does not apply",
    "step size": "the size of the step is not finite: mw_newton_fused gives up and mw_newton judges the residual",
    "residual": "residual or Jacobian is not finite: mw_newton ends as left_flank or singular",
    "start": "start values only: the contact is refined and judged from whatever they are",
    "system": "mw_newton fails on the design system: mw_complete returns its number, and its message says why",
    "result": "the result is not a finite number",
    "test": "tested where it is formed: the result is not a number",
    "tangent": "the derivative is not a finite number",
    "square": "none is needed: squares added up",
    "origin": "none is needed: the angle of the origin is 0 by definition; its derivative divides by 0",
}


@dataclass(frozen=True)
class Evaluated:
    """A generated function: the nodes it returns, and those it is given by an earlier stage.

    ``groups`` are results of which it is enough that one is not finite; ``guard`` is the name of what answers;
    ``part`` tells apart what is printed as one function from several tapes. The ``leading`` outputs can be had alone.
    ``of`` says what of the description it belongs to, a system, surface or function.
    """

    name: str
    tape: Tape
    lower: Lowering
    groups: tuple[tuple[int, ...], ...]
    known: frozenset[int]
    guard: str
    part: int = 0
    leading: int | None = None
    of: str = ""

    @property
    def key(self) -> str:
        """Its name among all functions, whatever they are called in a description."""
        return f"{self.of} {self.name}".strip()

    @property
    def outputs(self) -> list[int]:
        return [i for group in self.groups for i in group]


#: A condition that fails unseen: the function, the group of results, the node and its kind.
Unseen: TypeAlias = tuple[Evaluated, Group, int, str]

#: Functions that work for later ones, in which their conditions are seen.
EARLY = ("setup", "set_phi")


def guard(plan: Bound) -> Schedule:
    """The functions of a drive with its guards and tests."""
    opened = Schedule(**vars(plan.copy()), guards=(), tests={})
    failing = unseen(opened)
    guarded = replace(opened, guards=design_guards(opened, failing))
    return replace(guarded, tests=tests(guarded, failing))


def solving(plan: Bound) -> list[int]:
    """Nodes that the solution of a contact needs."""
    flat = [e for row in (*plan.jacobian, *plan.start_jacobian) for e in row]
    start = [*plan.start_residual, *plan.start_guess, *plan.start_scales, *plan.start_solution]
    return [*plan.residual, *plan.scales, *plan.newton_step, *start, *flat]


def functions(plan: Schedule) -> Iterator[Evaluated]:
    """Every function of the generated header, in the order in which they are printed."""
    tape, lower = plan.tape, plan.lower
    slots = list(plan.state)
    state, design = frozenset(slots), frozenset(slots[: plan.design_slots])

    def on_tape(
        name: str, outputs: Iterable[int], guard: str, known: frozenset[int] = state, leading: int | None = None
    ) -> Evaluated:
        return Evaluated(name, tape, lower, (tuple(outputs),), known, guard, leading=leading)

    def results(name: str, outputs: Iterable[Output], of: str = "") -> Evaluated:
        return Evaluated(name, tape, lower, tuple(o.nodes for o in outputs), state, "result", of=of)

    for k, rule in enumerate(plan.rules):
        yield _on_parameters("derive", rule, "parameter", k)
    for system in plan.systems:
        yield from _of_system(system)
    yield _on_parameters("size", plan.sizes, "result")
    yield on_tape("setup", [g.node for g in plan.guards], "setup", frozenset())
    yield on_tape("setup", slots[: plan.design_slots], "setup", frozenset())
    yield on_tape("set_phi", slots[plan.design_slots :], "step size", design)
    matrix = [e for row in plan.jacobian for e in row]
    yield on_tape("eval", [*plan.residual, *matrix], "residual", leading=len(plan.residual))
    yield on_tape("step", plan.newton_step, "step size")
    yield on_tape("guess", plan.start_guess, "start")
    yield on_tape("start_scale", plan.start_scales, "start")
    start_matrix = [e for row in plan.start_jacobian for e in row]
    yield on_tape("start_eval", [*plan.start_residual, *start_matrix], "start", leading=len(plan.start_residual))
    yield on_tape("start_solution", plan.start_solution, "start")
    yield on_tape("scale", plan.scales, "residual")
    yield results("observe", plan.observed)
    for table in (*plan.flanks, *plan.regions):
        yield results(f"{table.region}_{table.body}", table.outputs, "surface")
        yield results(f"curvature_{table.region}_{table.body}", table.curvature, "surface")
    for function in plan.functions:
        yield results(function.name, function.outputs, "function")


def moving(plan: Bound) -> Iterator[Evaluated]:
    """The functions of input angle and unknowns that read the design part of the state: the residual by an anchor, and
    its derivatives along a direction.
    """
    design = frozenset(list(plan.state)[: plan.design_slots])

    def on_tape(name: str, groups: Iterable[Iterable[int]], guard: str, leading: int | None = None) -> Evaluated:
        return Evaluated(name, plan.tape, plan.lower, tuple(map(tuple, groups)), design, guard, leading=leading)

    yield on_tape("anchor", [plan.angles], "residual")
    yield on_tape("by_anchor", [plan.residual], "residual")
    yield on_tape("along", [plan.along.first, plan.along.second], "tangent", len(plan.along.first))


def bounded(plan: Bound) -> Iterator[Evaluated]:
    """The functions of bounded flanks; they read parameters and state."""
    known = frozenset(plan.state) | {plan.lower(p.symbol) for p in plan.drive.parameters}

    def on_tape(name: str, outputs: Iterable[int], guard: str, leading: int | None = None) -> Evaluated:
        return Evaluated(name, plan.tape, plan.lower, (tuple(outputs),), known, guard, leading=leading)

    if plan.edges.systems:
        slopes = [e for row in plan.edges.jacobian for e in row]
        yield on_tape("edges", [*plan.edges.equations, *slopes], "residual", len(plan.edges.equations))
    for expansion in plan.expansions:
        name = f"{expansion.of.region}_{expansion.of.body}"
        yield on_tape(f"slopes_{name}", expansion.slopes, "result")
        if expansion.second:
            yield on_tape(f"second_{name}", expansion.second, "result")


def _on_parameters(name: str, program: ParameterTape, guard: str, part: int = 0) -> Evaluated:
    groups = tuple((i,) for i in program.nodes)
    return Evaluated(name, program.tape, program.lower, groups, frozenset(), guard, part)


def _of_system(plan: SystemTape) -> Iterator[Evaluated]:
    name, matrix = plan.system.name, [e for row in plan.jacobian for e in row]
    for suffix, outputs, guard, leading in (
        ("guess", plan.guess, "system", None),
        ("scale", plan.scales, "system", None),
        ("eval", [*plan.residual, *matrix], "system", len(plan.residual)),
        ("watch", [] if plan.watch is None else [plan.watch], "system", None),
        ("fill", plan.values, "parameter", None),
    ):
        groups = (tuple(outputs),)
        f = Evaluated(f"{name}_{suffix}", plan.tape, plan.lower, groups, frozenset(), guard, leading=leading)
        yield replace(f, of="system")


def partial_operations(evaluated: Evaluated) -> list[int]:
    """Nodes of a function that are not defined everywhere; quotients by a constant, and products, are."""
    tape = evaluated.tape
    needed = tape.needed(evaluated.outputs, evaluated.known)
    if products := by_reciprocal(tape, needed, evaluated.known):
        needed = tape.needed(evaluated.outputs, evaluated.known, products)
    return [i for i in needed if i in tape.origins and i not in products and not _by_constant(tape, i)]


def _by_constant(tape: Tape, i: int) -> bool:
    return tape.nodes[i].op == "div" and bool(tape.const_value(tape.nodes[i].args[1]))


# -- factors --------------------------------------------------------------------------------------------------------


def factors(tape: Tape, i: int) -> Counter[int]:
    """Factor node → power of a product; constants left out. Of a quotient only the dividend: the divisor is not 0."""
    node = tape.nodes[i]
    match node.op:
        case "mul":
            return factors(tape, node.args[0]) + factors(tape, node.args[1])
        case "neg" | "div":
            return factors(tape, node.args[0])
        case "const" | "sign":
            return Counter()
        case _:
            return Counter({i: 1})


def _square(tape: Tape, i: int) -> bool:
    """Whether a node is a sum of products of even powers, or less than that: certainly not negative."""
    node = tape.nodes[i]
    if node.op == "add":
        return all(_square(tape, a) for a in node.args)
    powers, sign = _powers(tape, i)
    return sign > 0 and all(power % 2 == 0 for power in powers.values())


def _positive(tape: Tape, i: int) -> bool:
    """Whether a node is a positive constant and squares, added up."""
    node = tape.nodes[i]
    if node.op == "add":
        return _square(tape, i) and any(_positive(tape, a) for a in node.args)
    return node.op == "const" and node.value > 0


def _powers(tape: Tape, i: int) -> tuple[Counter[int], int]:
    """Node → power of a product, and the sign of its constant."""
    node = tape.nodes[i]
    if node.op == "const":
        return Counter(), 1 if node.value >= 0 else -1
    if node.op == "mul":
        (first, one), (second, other) = (_powers(tape, a) for a in node.args)
        return first + second, one * other
    return Counter({i: 1}), 1


def demanded(tape: Tape, i: int) -> list[Condition]:
    """What must hold for a partial operation: (node, "nonzero" or "nonnegative") of each factor, none where it always
    does.
    """
    node = tape.nodes[i]
    if node.op == "div" and not _by_constant(tape, i):
        return [(k, "nonzero") for k in factors(tape, node.args[1]) if not _positive(tape, k)]
    if node.op == "sqrt" and not _square(tape, node.args[0]):
        return [(node.args[0], "nonnegative")]
    return []


# -- guards of the design -------------------------------------------------------------------------------------------


def design_guards(plan: Bound, unseen: Iterable[Unseen]) -> tuple[DesignGuard, ...]:
    """A drive's own guards; one for each design quantity by which the solution divides, of which it takes a root, or
    whose failure a later result would not show (``unseen``); one for parameters that are not finite.
    """
    tape = plan.tape
    guards: list[DesignGuard] = []
    for g in plan.drive.guards:
        node = plan.lower(g.positive)
        guards.append(DesignGuard(node, g.message, g.keys, node))
    needed = tape.needed([*(g.node for g in guards), *solving(plan)])
    wanted = [condition for i in needed for condition in demanded(tape, i)]
    wanted += [(k, kind) for f, _, k, kind in unseen if f.guard == "result" and tape.stages[k] <= Stage.DESIGN]
    done = {g.of for g in guards}
    for node, kind in wanted:
        if tape.stages[node] <= Stage.DESIGN and node not in done:
            done.add(node)
            guards.append(_guard(plan, node, kind))
    inputs = {a for i in needed for a in tape.nodes[i].args if _is_parameter(tape, a)}
    return (*guards, _finite(plan, sorted(inputs)))


def unseen(plan: Schedule) -> list[Unseen]:
    """Conditions that fail unseen in a function, but for those of a start, which the solution shows."""
    found: list[Unseen] = []
    for f in functions(plan):
        if f.guard != "start" and f.name not in EARLY:
            order = f.tape.needed(f.outputs)
            failing = _failing(f.tape, order)
            for (node, kind), groups in zip(failing, lost(f, order, failing.values()), strict=True):
                found += ((f, group, node, kind) for group in groups)
    return found


def _is_parameter(tape: Tape, i: int) -> bool:
    return tape.nodes[i].op == "input" and tape.stages[i] == Stage.DESIGN


def _guard(plan: Bound, node: int, kind: str) -> DesignGuard:
    tape = plan.tape
    text = formula(tape, node, plan.lower)
    if kind == "nonzero":
        return DesignGuard(tape.mul(node, node), f"a division by zero: {text} must not be 0", _keys(plan, [node]), node)
    return DesignGuard(node, f"a root of a negative number: {text} must be above 0", _keys(plan, [node]), node)


def _finite(plan: Bound, inputs: Iterable[int]) -> DesignGuard:
    """Σp² over itself: 1, or not a number where a parameter is infinite or not a number."""
    tape = plan.tape
    total = tape.constant(1)
    for i in inputs:
        total = tape.add(total, tape.mul(i, i))
    share = tape.div(total, tape.add(total, tape.constant(1)))
    required = tuple(p.place for p in plan.drive.parameters if p.required)
    return DesignGuard(share, "a value that the contact needs is missing or not finite", required)


def _keys(plan: Bound, nodes: Sequence[int]) -> tuple[str, ...]:
    tape = plan.tape
    found = {tape.nodes[a].value for i in tape.needed(nodes) for a in tape.nodes[i].args if _is_parameter(tape, a)}
    found |= {tape.nodes[i].value for i in nodes if _is_parameter(tape, i)}
    return tuple(p.place for p in plan.drive.parameters if p.symbol in found)


# -- what is not finite reaches the test ----------------------------------------------------------------------------

INFINITE, NAN = "infinite or not a number", "not a number"


def _failing(tape: Tape, order: Iterable[int]) -> dict[Condition, dict[int, str]]:
    """(node, kind) → operations that are not defined where this fails, and what is certain of their values."""
    found: dict[Condition, dict[int, str]] = {}
    for i in order:
        for node, kind in demanded(tape, i):
            found.setdefault((node, kind), {})[i] = INFINITE if kind == "nonzero" else NAN
    return found


def _reached(tape: Tape, order: Iterable[int], failing: Iterable[Mapping[int, str]]) -> tuple[Bits, Bits]:
    """Node → which conditions change its value where they fail, and which make it certainly infinite or not a number.

    ``failing`` lists for each condition the operations that are then not defined; condition k is bit k of a number.
    A quotient by an infinite number, the angle of an infinite point and a sign may be finite; all else passes it on.
    """
    changed, infinite, nan = (defaultdict[int, int](int) for _ in range(3))
    for k, operations in enumerate(failing):
        for i, certain in operations.items():
            changed[i] |= 1 << k
            infinite[i] |= 1 << k
            nan[i] |= (certain == NAN) << k
    for i in order:
        node = tape.nodes[i]
        a, b = node.args[0], node.args[-1]
        changed[i] |= changed[a] | changed[b]
        passed = nan[a] | nan[b]
        match node.op:
            case "div":
                infinite[i] |= infinite[a] | passed
            case "sin" | "cos":
                passed = infinite[a]
            case "sqrt" if tape.origins[i] == ARCCOSINE:
                passed = infinite[a]  # of (1 − a)(1 + a), −∞ for any infinite a
            case "atan2":
                pass
            case "sign":
                passed = 0
            case _:
                infinite[i] |= infinite[a] | infinite[b]
        nan[i] |= passed
        infinite[i] |= passed
    return changed, infinite


def lost(evaluated: Evaluated, order: Iterable[int], failing: Collection[Mapping[int, str]]) -> list[list[Group]]:
    """For each condition the groups of results that its ``failing`` operations change and leave finite."""
    changed, infinite = _reached(evaluated.tape, order, failing)
    unseen = [_any(changed, group) & ~_any(infinite, group) for group in evaluated.groups]
    return [
        [group for group, bits in zip(evaluated.groups, unseen, strict=True) if bits >> k & 1]
        for k in range(len(failing))
    ]


def _any(bits: Bits, group: Iterable[int]) -> int:
    return reduce(int.__or__, (bits[i] for i in group), 0)


# -- the list -------------------------------------------------------------------------------------------------------

OPERATIONS = {"div": "division", "sqrt": "root", "atan2": "arc"}


class Unguarded(ValueError):
    """A condition that no guard holds."""


class Use(TypedDict):
    """How often a function evaluates an operation, and the guards that answer."""

    count: int
    guards: list[str]


class SideCondition(TypedDict):
    """The condition of a partial operation, as plain data: see :func:`side_conditions`."""

    operation: str
    stage: str
    condition: str
    equations: list[str]
    functions: dict[str, Use]


def tests(plan: Schedule, unseen: Iterable[Unseen]) -> Tests:
    """Nodes to test: (function, part) → group of results → nodes; where one is zero they shall be "not a number".

    Flanks and observations are not tested: a failing condition must be seen in the results themselves, as in the
    iteration. Raises :class:`Unguarded` where it is not.
    """
    held = {g.of for g in plan.guards}
    testing = {"derive", *(f.name for f in plan.functions)}
    found: dict[tuple[str, int], dict[Group, list[int]]] = {}
    for f, group, node, kind in unseen:
        if f.tape is plan.tape and node in held:
            continue
        if f.name not in testing or kind != "nonzero":
            text = formula(f.tape, node, f.lower)
            raise Unguarded(f"{plan.drive.name}: nothing shows in {f.name} that {text} is not {kind}")
        found.setdefault((f.name, f.part), {}).setdefault(group, []).append(node)
    return found


def side_conditions(plan: Schedule, evaluated: Iterable[Evaluated]) -> list[SideCondition]:
    """The condition of every partial operation of these generated functions, as plain data in order of appearance.

    Each has the ``operation``, the ``stage``, the ``condition``, the ``equations`` of the record that carry it, and
    ``functions``: for each, how often it is evaluated and the guards that answer.
    """
    numbers = {g.of: k for k, g in enumerate(plan.guards, 1)}
    shown = cache(formula)
    entries: dict[tuple[str, int, str, str], SideCondition] = {}
    for f in evaluated:
        for i in partial_operations(f):
            node, origin = f.tape.nodes[i], f.tape.origins[i]
            operation = "arccosine" if _is_complement(node, origin) else OPERATIONS[node.op]
            text = _condition(f, i, shown)
            entry = entries.setdefault(
                (operation, f.tape.stages[i], text, origin.statement),
                {
                    "operation": operation,
                    "stage": f.tape.stages[i].name.lower(),
                    "condition": text,
                    "equations": list(dict.fromkeys((origin.statement, PARTIAL[node.op].statement))),
                    "functions": {},
                },
            )
            use = entry["functions"].setdefault(f.name, {"count": 0, "guards": []})
            use["count"] += 1
            use["guards"] = list(dict.fromkeys((*use["guards"], *_answers(plan, f, i, numbers))))
    return list(entries.values())


def _condition(f: Evaluated, i: int, shown: Callable[[Tape, int, Lowering], str]) -> str:
    """The condition of a partial operation to read; ``shown`` writes a node as :mod:`derive.program.formula` does."""
    tape, origin = f.tape, f.tape.origins[i]
    node = tape.nodes[i]

    def text(k: int) -> str:
        full = shown(tape, k, f.lower)
        return origin.meaning if origin.meaning and "…" in full else full

    if _is_complement(node, origin):
        return f"|{text(_argument(tape, node.args[0]))}| ≤ 1"
    if node.op == "atan2":
        return f"({text(node.args[1])}, {text(node.args[0])}) ≠ (0, 0)"
    if node.op == "sqrt":
        return f"{text(node.args[0])} ≥ 0"
    return ", ".join(dict.fromkeys(f"{text(k)} ≠ 0" for k in factors(tape, node.args[1])))


def _is_complement(node: Node, origin: Origin) -> bool:
    return node.op == "sqrt" and origin == ARCCOSINE


def _argument(tape: Tape, product: int) -> int:
    """a of (1 − a)(1 + a)."""
    return next(tape.nodes[k].args[1] for k in tape.nodes[product].args if tape.nodes[k].op == "sub")


def _answers(plan: Schedule, f: Evaluated, i: int, numbers: Mapping[int | None, int]) -> list[str]:
    if f.tape.nodes[i].op == "atan2":
        return ["origin"]
    conditions = demanded(f.tape, i)
    if not conditions:
        return ["square"]
    return [_answer(plan, f, node, numbers) for node, _ in conditions]


def _answer(plan: Schedule, f: Evaluated, node: int, numbers: Mapping[int | None, int]) -> str:
    if f.tape is plan.tape and node in numbers:
        return f"setup {numbers[node]}"
    if any(node in nodes for nodes in plan.tests.get((f.name, f.part), {}).values()):
        return "test"
    return "result" if f.guard == "setup" else f.guard
