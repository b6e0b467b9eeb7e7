"""Trees of the record as one line of text, and in words where one was read."""

import re
from collections.abc import Sequence

from derive.prove.tree import Tree

PRECEDENCE = {"+": 1, "-": 1, "*": 2, "/": 2, "@": 2, "^": 3}


def text(tree: Tree | list) -> str:
    """One line, in the notation of the document modules."""
    return re.sub(r"\+ -", "- ", _text(tree)[0])


def _text(tree: Tree | list) -> tuple[str, int]:
    if not isinstance(tree, (list, tuple)):
        return str(tree), 9
    operation, *arguments = tree
    if operation in ("+", "*", "/", "@"):
        level = PRECEDENCE[operation]
        joiner = {"+": " + ", "*": "*", "/": "/", "@": " @ "}[operation]
        return joiner.join(
            _within(argument, level + (k > 0 and operation in "/@")) for k, argument in enumerate(arguments)
        ), level
    if operation == "-":
        return "-" + _within(arguments[0], 2), 1
    if operation == "^":
        return f"{_within(arguments[0], 4)}^{arguments[1]}", 3
    if operation == "jet":
        return arguments[0] + (
            "'" * arguments[1]
            if len(arguments) == 2
            else f"[{', '.join(map(str, arguments[1:]))}]"
            if any(arguments[1:])
            else ""
        ), 9
    if operation == "at":
        return f"{_within(arguments[0], 9)}.{'xyz'[arguments[1]]}", 9
    if operation == "entry":
        return f"{_within(arguments[0], 9)}[{arguments[1] + 1},{arguments[2] + 1}]", 9
    if operation == "mat":
        return "mat(" + "; ".join(", ".join(_text(entry)[0] for entry in row) for row in arguments) + ")", 9
    if operation == "d":
        along = ", ".join(symbol if rate == 1 else f"{symbol} at {_text(rate)[0]}" for symbol, rate in arguments[1:])
        return f"d({_text(arguments[0])[0]}; {along})", 9
    return f"{operation}({', '.join(_text(argument)[0] for argument in arguments)})", 9


def _within(tree, level: int) -> str:
    shown, own = _text(tree)
    return f"({shown})" if own < level else shown


#: Parts of a description, in words.
WORDS = {
    "edge": "the edge of {}", "edge_normal": "the normal of the edge of {}", "normal": "the normal of {}",
    "rule": "rule {1} for {0}", "size": "the size {}", "name": "{}", "contact": "the contact's {}",
    "margin": "the margin {1} of {0}", "condition": "condition {1} of {0}", "solved": "what {} was solved by",
    "sweep": "the sweep of {}", "moved": "the moves of {}", "generation": "the generating motion of {}",
    "motion": "the motion of {} in the mesh",
}  # fmt: skip


def words_of(part: Sequence) -> str:
    """What part of a description a tree was read from."""
    kind, *words = part
    match kind:
        case "carried" | "turned":
            motion, vector = words
            return f"{words_of(vector)} {kind} by {_motion(motion)}"
        case "given":
            return text(words[0])
        case "matrix":
            return f"the rotation of {_motion(words[0])}"
        case "arc":
            return f"operand {words[0]} of the arc function in {words_of(words[1])}"
    return WORDS[kind].format(*words)


def _motion(part: Sequence) -> str:
    kind, place, first, last = part
    factors = f"factor {last}" if last == first + 1 else f"factors {first + 1} to {last}"
    return f"{factors} of {WORDS[kind].format(place)}"
