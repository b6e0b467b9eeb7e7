"""Wrong physics in a description is noticed by its own C: a sign, factor, exponent, axis or function changed at a time.

The C stays as it was generated. What changes no value (the sign of a zero) is a survivor, printed with its place.
"""

import copy
import json
import random
from pathlib import Path

import pytest

from derive.audit import check_description as checker
from tests.quick import quick

GENERATED = Path(__file__).resolve().parents[2] / "generated"
SPUR = "spherical_convex_spur"
SEED = 21
#: Left out: what says how a surface was made and which proportions a new design takes is for readers and for ``new``;
#: no generated function reads it.
SECTIONS = ("keys", "rules", "guards", "sizes", "bodies", "regions", "contact", "start", "functions", "definitions")
UNREAD = ("made", "tangents", "domain", "parity", "search")
OTHER = {"sin": "cos", "cos": "sin", "tan": "sin", "asin": "acos", "acos": "asin", "x": "y", "y": "z", "z": "x"}


def edited(node, rng):
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


def places(node, path=()):
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


def wrong_descriptions(description, count):
    """Section by section in turn: words, and a description with one change."""
    rng = random.Random(SEED)
    queues = {s: rng.sample(found, len(found)) for s in SECTIONS if (found := list(places(description[s])))}
    made = 0
    while made < count and any(queues.values()):
        for section, queue in queues.items():
            if queue and made < count:
                path = queue.pop()
                changed = copy.deepcopy(description)
                node = changed[section]
                for key in path[:-1]:
                    node = node[key]
                old = node[path[-1]]
                node[path[-1]] = edited(old, rng)
                made += 1
                yield f"{section}{list(path)}: {str(old)[:70]} -> {str(node[path[-1]])[:70]}", changed


def is_refused(description, header, tangents):
    drive = checker.Drive(description, header, tangents)
    try:
        for number in range(len(description["keys"])):
            checker.check_unit(drive, number)
        for _, check in checker.checks_of(drive):
            checker.attempt(*check)
    except checker.Rejected:
        return True
    return False


@pytest.mark.parametrize(("count", "least"), quick([(200, 0.97), (12, 0.9)], (12, 0.9)))
def test_a_wrong_description_is_refused(count, least, capsys, monkeypatch):
    monkeypatch.setattr(checker.CODE, "ATTEMPTS", 2000)
    monkeypatch.setattr(checker.CODE, "REFUSALS", 8)
    description = json.loads((GENERATED / "descriptions" / f"{SPUR}.json").read_text(encoding="utf-8"))
    header, tangents = (
        (GENERATED / "c" / f"{SPUR}{end}.h").read_text(encoding="utf-8") for end in ("", "_sensitivity")
    )
    made, survivors = 0, []
    for words, wrong in wrong_descriptions(description, count):
        made += 1
        if not is_refused(wrong, header, tangents):
            survivors.append(words)
    with capsys.disabled():
        print(f"\n{made - len(survivors)} of {made} wrong descriptions refused", *survivors, sep="\n  ")
    assert made == count
    assert made - len(survivors) >= least * made
