"""A node of a tape as a formula to read, in the names of inputs and definitions."""

from fractions import Fraction

from derive.program.lowering import Lowering
from derive.program.tape import Tape

#: Longest formula shown in full; of longer ones the innermost parts are left out.
LONGEST = 100

_LEVEL = {"add": 1, "sub": 1, "neg": 2, "mul": 3, "div": 3}
_SIGN = {"add": " + ", "sub": " − ", "mul": "·", "div": "/"}


def formula(tape: Tape, node: int, lower: Lowering) -> str:
    """The text of a node; a definition is shown by its value at the top, by its name within."""
    names = lower.names()
    text = ""
    for depth in range(1, 40):
        longer = _text(tape, node, names, depth, top=True)[0]
        if len(longer) > LONGEST and text:
            return text
        if longer == text:
            break
        text = longer
    return text


def _text(tape: Tape, i: int, names: dict[int, str], depth: int, top: bool = False) -> tuple[str, int]:
    node = tape.nodes[i]
    if node.op == "const":
        exact = node.value
        shown = str(exact) if isinstance(exact, Fraction) else f"{exact:.6g}"
        return shown, 9 if exact >= 0 and "/" not in shown else 1
    if node.op == "input":
        return str(node.value), 9
    if i in names and not top:
        return names[i], 9
    if depth == 0:
        return "…", 9
    level = _LEVEL.get(node.op)
    parts = [_text(tape, a, names, depth - 1) for a in node.args]
    if level is None:
        return f"{node.op}({', '.join(text for text, _ in parts)})", 9
    held = [text if own > level or (own == level and k == 0) else f"({text})" for k, (text, own) in enumerate(parts)]
    if node.op == "neg":
        return "−" + held[0], level
    return _SIGN[node.op].join(held), level
