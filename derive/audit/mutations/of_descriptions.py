"""Changes of a description: a wrong reading of one node of an expression or motion."""

import copy
import random
from collections.abc import Iterator

#: Left out: what says how a surface was made and which proportions a new design takes is for readers and for ``new``;
#: no generated function reads it.
SECTIONS = ("keys", "rules", "guards", "sizes", "design_systems", "bodies", "regions", "contact", "start", "functions",
            "definitions")  # fmt: skip
UNREAD = ("made", "tangents", "domain", "parity", "search", "keys", "fixed")
OTHER = {"sin": "cos", "cos": "sin", "tan": "sin", "asin": "acos", "acos": "asin", "x": "y", "y": "z", "z": "x"}


def edited(node: object, rng: random.Random) -> object:
    """A wrong reading of one node of an expression or motion; None where there is nothing to change."""
    match node:
        case ["+", *terms]:
            k = rng.randrange(len(terms))
            return ["+", *terms[:k], ["*", -1, terms[k]], *terms[k + 1 :]]
        case ["*", *factors] if len(factors) > 1:
            k = rng.randrange(len(factors))
            return ["*", *factors[:k], *factors[k + 1 :]]
        case ["^", base, int() as power] if base != "s":  # the flank's sign: its square is 1
            return ["^", base, -power]
        case ["/", int() as p, int() as q]:
            return ["/", p + q, q]
        case ["sin" | "cos" | "tan" | "asin" | "acos" as name, operand]:
            return [OTHER[name], operand]
        case ["rotation" | "swing" as kind, axis, angle, *rest]:
            turned = (OTHER[axis], angle) if rng.random() < 0.5 else (axis, ["*", -1, angle])
            return [kind, *turned, *rest]
        case ["translation" | "station" as kind, [a, b, c]]:
            return [kind, [b, a, c]]
    return None


def places(node: object, path: tuple = ()) -> Iterator[tuple]:
    """Paths of all nodes that can be changed."""
    if isinstance(node, dict):
        for key, value in node.items():
            if key not in UNREAD:
                yield from places(value, (*path, key))
    elif isinstance(node, list):
        if edited(node, random.Random(0)) is not None:
            yield path
        for k, value in enumerate(node):
            yield from places(value, (*path, k))


def changed_at(description: dict, path: tuple, rng: random.Random) -> tuple[str, dict]:
    """A description with one node changed, and words."""
    changed = copy.deepcopy(description)
    node = changed
    for key in path[:-1]:
        node = node[key]
    old = node[path[-1]]
    node[path[-1]] = edited(old, rng)
    return f"{list(path)}: {str(old)[:50]} -> {str(node[path[-1]])[:50]}", changed
