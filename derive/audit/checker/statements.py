"""Printed statements beside what a description says."""

from random import Random

from .described import Described
from .design import given_rules
from .draws import Draw
from .modular import PRIME, Number, real_signs
from .printed import Statement
from .refusal import require
from .surfaces import unit


def check_statement(drive: Described, statement: Statement, rng: Random) -> None:
    """What is printed is what the description says."""
    SUBJECTS.get(statement.kind, subject_entry)(drive, statement, rng)


def same(found: Number, expected: Number, statement: Statement) -> None:
    require((found.value - expected.value) % PRIME == 0, f"not as printed ({statement.source}): {statement.text}")


def subject_rule(drive: Described, statement: Statement, rng: Random) -> None:
    """Every rule for a parameter, or one by its place among them, satisfies the printed relation."""
    target, *place = statement.about
    values = [value for name, value in given_rules(drive) if name == target]
    require(values, f"no rule for {target}")
    reader = drive.reader(rng)
    for value in [values[int(place[0]) - 1]] if place else values:
        there = reader.at({target: reader(value)})
        same(there(statement.sides[0]), there(statement.sides[1]), statement)


def subject_where(drive: Described, statement: Statement, rng: Random) -> None:
    """A printed relation between what the description defines."""
    reader = drive.reader(rng)
    same(reader(statement.sides[0]), reader(statement.sides[1]), statement)


def subject_signed(drive: Described, statement: Statement, rng: Random) -> None:
    """The same where the square of a sign has to be 1."""
    with real_signs():
        subject_where(drive, statement, Draw(rng.sign))


def subject_entry(drive: Described, statement: Statement, rng: Random) -> None:
    """An entry of the description: what is printed of it, component by component."""
    key = (statement.kind, *statement.about)
    require(key in drive.said, f"the description has no {' '.join(key)}")
    found, printed = drive.said[key], statement.sides[0]
    reader = drive.reader(rng)
    pairs = zip(found, printed, strict=True) if isinstance(printed, tuple) else [(found, printed)]
    for a, b in pairs:
        same(reader(a), reader(b), statement)


def carried_alike(drive: Described, found: list, statement: Statement, rng: Random) -> None:
    """Two motions carry any point to the same place."""
    reader = drive.reader(rng)
    point = [Number(rng.randrange(1, PRIME)) for _ in range(3)]
    (printed,) = statement.sides
    for a, b in zip(reader.carried(found, point), reader.carried(printed, point), strict=True):
        same(a, b, statement)


def subject_root(drive: Described, statement: Statement, rng: Random) -> None:
    """Every value of a result makes an expression zero, and no two are the same."""
    values, reader = drive.said["function", *statement.about], drive.reader(rng)
    found = list(map(reader, values if isinstance(values[0], list) else [values]))
    require(len({str(value.form) for value in found}) == len(found), f"one root twice: {statement.text}")
    for value in found:
        same(reader.at({statement.about[1]: value})(statement.sides[0]), Number(0), statement)


def subject_motion(drive: Described, statement: Statement, rng: Random) -> None:
    carried_alike(drive, drive.entries[statement.about[0]]["motion"], statement, rng)


def subject_generation(drive: Described, statement: Statement, rng: Random) -> None:
    steps = [step for step in drive.entries[statement.about[0]]["surface"]["made"] if step["step"] == "envelope"]
    require(steps, f"{statement.about[0]} is no envelope")
    carried_alike(drive, steps[-1]["motion"], statement, rng)


def subject_sweep(drive: Described, statement: Statement, rng: Random) -> None:
    carried_alike(drive, first_step(drive, statement)["motion"], statement, rng)


def first_step(drive: Described, statement: Statement) -> dict:
    return drive.entries[statement.about[0]]["surface"]["made"][0]


def subject_curve(drive: Described, statement: Statement, rng: Random) -> None:
    step, reader = first_step(drive, statement), drive.reader(rng)
    for a, b in zip(step.get("curve") or step["point"], statement.sides[0], strict=True):
        same(reader(a), reader(b), statement)


def subject_normal(drive: Described, statement: Statement, rng: Random) -> None:
    """The outward normal in the frame of the tool's edge, of any positive length."""
    reader = drive.reader(rng)
    found = unit(reader.vector(drive.entries[statement.about[0]]["surface"]["normal"]))
    printed = unit(reader.vector(list(statement.sides[0])))
    for a, b in zip(found, printed, strict=True):
        same(a, b, statement)


#: Kinds of statements of which more is to be known than that an entry is what is printed.
SUBJECTS = {
    "rule": subject_rule,
    "where": subject_where,
    "signed": subject_signed,
    "root": subject_root,
    "motion": subject_motion,
    "generation": subject_generation,
    "sweep": subject_sweep,
    "curve": subject_curve,
    "normal": subject_normal,
}


def check_said(drive: Described, statements: list[Statement]) -> None:
    """Nothing of the description is left unsaid, but for what is listed as open and what a law says."""
    about = {("function" if s.kind == "root" else s.kind, *s.about) for s in statements}
    about |= {s.about for s in statements if s.kind == "open"}
    for key in drive.said:
        kind, name, *_ = key
        first = key[:-1] if key[-1] == "1" else key
        law = kind == "condition" and len(drive.entries[name]["surface"]["made"]) > 1
        if kind == "rule":
            first = key[:-1]
        require(key in about or first in about or law, f"nothing says what {' '.join(key)} is")
