"""A description and its program as a person reads them: ``python -m derive show DRIVE [--after PASS]``."""

from derive.language.chain import Rotation, Swing, Translation

_SIGN = {"add": "{} + {}", "sub": "{} - {}", "mul": "{}*{}", "div": "{} / {}", "neg": "-{}", "fma": "{}*{} + {}",
         "fms": "{}*{} - {}", "fnma": "{2} - {0}*{1}"}  # fmt: skip


def program(plan, routines, after):
    """The ``routines`` of a drive after the pass of that name (:mod:`derive.passes.after`), as text."""
    names = _names(plan)
    lines = [f"{plan.drive.name} after {after}: {plan.drive.title}", ""]
    return "\n".join([*lines, *(line for made in routines for line in _routine(made, names))])


def _names(plan):
    """Node → name: inputs, definitions, slots of the state."""
    tape, names = plan.tape, {}
    for i, node in enumerate(tape.nodes):
        if node.op == "input":
            names[i] = str(node.value)
        elif node.op == "const":
            names[i] = str(node.value) if node.value >= 0 else f"({node.value})"
    return {node: f"s[{slot}]" for node, slot in plan.state.items()} | plan.lower.names() | names


def _routine(made, names):
    def shown(i):
        return names.get(i, f"%{i}")

    read = ", ".join(dict.fromkeys(shown(i) for i in made.reads() if made.tape.const_value(i) is None))
    yield f"{made.name}({read}): {made.operations} operations"
    for i, step in made.steps:
        args = [shown(a) for a in step.args]
        text = _SIGN[step.op].format(*args) if step.op in _SIGN else f"{step.op}({', '.join(args)})"
        yield f"    {made.tape.stages[i].name.lower():<8} {shown(i)} = {text}"
    yield f"    return {', '.join(map(shown, made.outputs))}"
    yield ""


def description(drive):
    """What a drive's page says, as text: quantities, parameters, rules, motions, limits, equations."""
    lines = [f"{drive.name}: {drive.title} (family {drive.family})", ""]
    lines += [f"given    {_quantity(drive.instant)}", f"error    {_quantity(drive.error)}", ""]
    lines += [f"unknown  {_quantity(u.symbol)}" for u in drive.unknowns]
    lines += ["", "parameters"]
    for p in drive.parameters:
        default = "" if p.default is None else f", default {p.default}"
        required = ", required" if p.required else ""
        lines.append(f"  {p.table}.{p.key}: {_quantity(p.symbol)}{default}{required}")
    lines += ["", "rules", *(f"  {rule.target} = {rule.value}" for rule in drive.rules)]
    lines += ["", "guards", *(f"  {g.positive} > 0: {g.message}" for g in drive.guards)]
    for body in drive.bodies:
        lines += ["", body.name, f"  surface of ({', '.join(map(str, body.surface.parameters))}) in the body frame by"]
        lines += [f"    {_factor(f)}" for f in body.surface.motion.factors]
        lines += ["  in mesh by", *(f"    {_factor(f)}" for f in body.motion.factors)]
        lines += [f"  condition {c} = 0" for c in body.surface.conditions]
        lines += [f"  limit {m.event}: {m.positive} > 0" for m in body.margins]
    lines += ["", "contact, each 0", *(f"  {r}" for r in drive.residual)]
    lines += ["", "where", *(f"  {name} = {value}" for name, value in drive.definitions.items()), ""]
    return "\n".join(lines)


def _quantity(symbol):
    unit = f" [{symbol.unit}]" if symbol.unit else ""
    frame = f", frame {symbol.frame}" if symbol.frame else ""
    return f"{symbol}{unit} {symbol.meaning}{frame}".rstrip()


def _factor(factor):
    match factor:
        case Rotation():
            return f"rotation about {factor.axis} by {factor.angle}"
        case Swing():
            return f"rotation about {factor.axis} through ({', '.join(map(str, factor.centre))}) by {factor.angle}"
        case Translation():
            return f"translation by ({', '.join(map(str, factor.offset))})"
    return f"frame with columns {factor.columns}"
