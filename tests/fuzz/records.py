"""Records of proof with something in an object changed, then every hash, link, root and seal made anew.

The checker refuses each with a reason, or what was changed says nothing that it vouches for: prose. Anything but a
reason is a failure, and so is a change that it accepts of what it does vouch for.
"""

import copy
import json
import random
import tempfile
import traceback
from collections import Counter
from pathlib import Path

from derive.audit.checker import check_record
from derive.audit.checker.refusal import Rejected
from tests.audit import forger

#: What the checker does not read, by object and key: where a statement stands, what a reader may think of it, under
#: which conditions, in words, it holds; the folder, as it were, of a step's name; whether a sample shown is rounded.
PROSE = {
    ("source", "document"), ("source", "document_sha256"), ("source", "locator"), ("source", "ocr_doubt"),
    ("source", "verbatim"), ("verdict", "plain"), ("verdict", "missing"), ("equation", "unit"),
    ("equation", "side_conditions"), ("verdict", "drops"), ("verdict", "change"), ("step", "id"),
    ("certificate", "rounded"),
}  # fmt: skip

#: What may be otherwise in a true record: the point at which both sides are compared is free, as long as the recorded
#: numbers are those at this point.
FREE = {("certificate", "point")}

ODD = (
    None, True, 0, 1, -1, 2, 10**30, 1.5, "", "0", "x", "sqrt0", "proved", "1/0", "9" * 5000, [], {}, ["*"],
    ["sqrt", 2],
)  # fmt: skip


def _places(value, path=()):
    """Every place inside a JSON value."""
    yield path
    parts = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, part in parts:
        yield from _places(part, (*path, key))


def _changed(chance, value):
    """A value near this one, or an odd one."""
    if chance.random() < 0.25:
        return copy.deepcopy(chance.choice(ODD))
    if isinstance(value, bool):
        return not value
    if isinstance(value, int | float):
        return value + chance.choice((-1, 1, 2, 7))
    if isinstance(value, str):
        at = chance.randrange(len(value) + 1)
        return value[:at] + chance.choice(("", "0", "1", "x", "-", "*", " ", "é")) + value[at + chance.choice((0, 1)) :]
    if isinstance(value, list) and value:
        how, k = chance.choice(("drop", "twice", "turn", "odd")), chance.randrange(len(value))
        if how == "drop":
            return value[:k] + value[k + 1 :]
        if how == "twice":
            return [*value[: k + 1], *value[k:]]
        return value[::-1] if how == "turn" else [*value[:k], copy.deepcopy(chance.choice(ODD)), *value[k + 1 :]]
    if isinstance(value, dict) and value:
        key, left = chance.choice(sorted(value)), dict(value)
        left["x" if chance.random() < 0.3 else key + "0"] = left.pop(key) if chance.random() < 0.7 else left[key]
        return left
    return chance.choice(ODD)


def mutate(chance, objects):
    """Change one place of one object, in place: (kind of object, top-level key) of it, or None if nothing changed."""
    item = chance.choice(objects)
    path = chance.choice([p for p in _places(item) if p and p[0] not in ("object", "sha256")])
    before, target = _said(item), item
    for key in path[:-1]:
        target = target[key]
    target[path[-1]] = _changed(chance, target[path[-1]])
    return None if _said(item) == before else (item["object"], path[0])


def _said(item):
    """An object as text, without what says nothing: blanks inside a formula or a number, and names of variables of
    functions that no derivative is taken along.
    """
    jets = item.get("jets")
    if isinstance(jets, dict) and all(isinstance(variables, list) for variables in jets.values()):
        moved = [rate[0] for node in _nodes(item) if node[:1] == ["d"] for rate in node[2:]]
        item = {**item, "jets": {name: [v if v in moved else "" for v in jets[name]] for name in jets}}
    return "".join(json.dumps(item, sort_keys=True).split())


def _nodes(value):
    """The lists inside a JSON value, itself included."""
    if isinstance(value, list):
        yield value
    parts = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    for part in parts:
        yield from _nodes(part)


def one(chance, ledger, folder):
    """(outcome, what is wrong): outcome is refused, prose, as true or same."""
    record = forger.written(ledger, folder)
    forged = forger.Forger(record)
    forged.objects = forged.used()
    place = mutate(chance, forged.objects)
    forged.sealed(everything=True)
    try:
        check_record.verify(record)
    except Rejected:
        return "refused", ""
    if place is None:
        return "same", ""
    if place in PROSE | FREE:
        return ("prose" if place in PROSE else "as true"), ""
    return "accepted", f"a change of {place[0]}.{place[1]} is accepted"


def run(count, seed=0):
    """Counter of outcomes and the failures of ``count`` changed records."""
    ledger, total, failures = forger.small_ledger(), Counter(), []
    for k in range(seed, seed + count):
        with tempfile.TemporaryDirectory() as folder:
            try:
                outcome, wrong = one(random.Random(k), ledger, Path(folder))
            except Exception:
                outcome, wrong = "failed", traceback.format_exc(limit=-5)
        total[outcome] += 1
        failures += [f"seed {k}: {wrong}"] if wrong else []
    return f"{total.total()} changed: {dict(total)}", failures
