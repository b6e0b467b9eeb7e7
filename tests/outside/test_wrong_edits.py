"""One-line edits of right drives, drawn at random: refused, or a drive whose surfaces touch and transmit its ratio.

An edit may give teeth another thickness, or the face another width: that is another drive, not a wrong one. Of what is
accepted the contact is looked at once more, by differences of points alone.
"""

import ast
import random

import mpmath as mp
import pytest

from derive.compiler import define, sound
from derive.pages import of_file
from derive.passes.equations import derive
from derive.passes.other_flank import on_other_flank
from derive.passes.pivot_order import reduce
from derive.passes.schedule import scheduled
from derive.refusals import Refused, told
from tests.derive.edits import changes
from tests.independent.vectors import cross
from tests.outside.folder import FILES
from tests.quick import full

pytestmark = pytest.mark.validate

RIGHT = ("crossed_helicoids", "hourglass_worm", "face_gear", "pin_wheel", "beveloid")
#: What of a page is no geometry: names, texts, the sample and what messages say.
APART = ("sample", "sample_angle", "title", "name", "family", "sources", "guards", "loading")
STEP = mp.mpf(10) ** -15


def edits(name):
    """The lines of a page, and its edits: line, columns and what stands there instead."""
    source = (FILES / f"{name}.py").read_text(encoding="utf-8")
    lines, found = source.splitlines(), set()
    for function in (node for node in ast.walk(ast.parse(source)) if isinstance(node, ast.FunctionDef)):
        words = [node for node in ast.walk(function) if isinstance(node, ast.keyword) and node.arg in APART]
        words += [node for node in ast.walk(function) if isinstance(node, ast.JoinedStr)]
        apart = {id(inner) for word in words for inner in ast.walk(word)}
        for node in ast.walk(function):
            if id(node) in apart or getattr(node, "lineno", 0) != getattr(node, "end_lineno", -1):
                continue
            number = isinstance(node, ast.Constant) and type(node.value) is int
            if number or isinstance(node, ast.BinOp | ast.UnaryOp) or _is_of_angle(node):
                found |= {(node.lineno, *change) for change in changes(node, lines[node.lineno - 1])}
    return lines, sorted(found)


def _is_of_angle(node):
    called = isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute)
    return called and node.func.attr in ("sin", "cos", "tan")


def edited(lines, edit):
    number, first, last, new = edit
    line = lines[number - 1].encode()
    line = (line[:first] + new.encode() + line[last:]).decode()
    return "\n".join([*lines[: number - 1], line, *lines[number:]]) + "\n"


def compiled(path):
    """The schedule of a page with the contacts of both flanks, as the compiler accepts it."""
    (page,) = of_file(path)
    with told("emit", page.name):
        plan = scheduled(reduce(derive(define(page.build))))
        sound(plan)
        return [plan, on_other_flank(plan) or plan]


def is_a_drive(plan):
    """Whether the two flanks of a plan's contact are in one place, there in one plane, and transmit the ratio.

    By differences of the generated points of either flank and of the motions, in 40 digits.
    """
    drive = plan.drive
    with mp.workdps(40):
        law = plan.tape.evaluate([plan.lower(drive.turned)], plan.sample, mp)[0]
        angles, spots, normals, arms = (plan.sample[drive.instant], law), [], [], []
        for k, flank in enumerate(plan.flanks):
            point = next(o for o in flank.outputs if o.name == "point")
            rows = next(o for o in plan.placement.outputs if o.name == f"placement_{flank.body}")

            def place(q, turn=0, k=k, flank=flank, point=point, rows=rows):
                given = dict(plan.sample) | dict(zip(flank.parameters, q, strict=True))
                at = dict(zip(plan.placement.parameters, angles, strict=True))
                at[plan.placement.parameters[k]] += turn
                x = plan.tape.evaluate(point.nodes, given, mp)
                m = plan.tape.evaluate(rows.nodes, given | at, mp)
                return mp.matrix([sum(m[4 * i + j] * x[j] for j in range(3)) + m[4 * i + 3] for i in range(3)])

            q = [plan.sample[p] for p in flank.parameters]
            beside = [[v + STEP * (i == n) for i, v in enumerate(q)] for n in range(2)]
            normal = mp.matrix(cross(*[[*(place(there) - place(q)) / STEP] for there in beside]))
            spots.append(place(q))
            normals.append(normal / mp.norm(normal))
            arms.append((place(q, STEP) - place(q)) / STEP)
        levers = [sum(a[i] * normals[0][i] for i in range(3)) for a in arms]
        teeth = plan.sample[next(p.symbol for p in drive.parameters if p.key == drive.pinion_teeth)]
        ratio = plan.tape.evaluate([plan.lower(drive.law)], plan.sample, mp)[0]
        wheel = teeth / ratio
        apart, turned = mp.norm(spots[0] - spots[1]), 1 - abs(sum(a * b for a, b in zip(*normals, strict=True)))
        whole = abs(wheel - mp.nint(wheel)) < 1e-9 and wheel > 0
        return bool(apart < 1e-9 and turned < 1e-9 and whole and abs(levers[0] / levers[1] * wheel - teeth) < teeth / 4)


def test_an_edit_of_a_right_drive_is_refused_or_makes_another_drive(tmp_path):
    rng, count, wrong, refused = random.Random(49), 200 if full() else 25, [], 0
    known = {name: edits(name) for name in RIGHT}
    for k in range(count):
        name = RIGHT[k % len(RIGHT)]
        lines, found = known[name]
        edit, page = rng.choice(found), tmp_path / f"{name}.py"
        page.write_text(edited(lines, edit), encoding="utf-8")
        try:
            plans = compiled(page)
        except Refused as refusal:
            assert len(str(refusal)) > 40 and name in str(refusal)
            refused += 1
            continue
        if not all(map(is_a_drive, plans)):
            wrong.append(f"{name}:{edit[0]}: {lines[edit[0] - 1].strip()} -> {edit}")
    assert len(wrong) <= 0.03 * count, "\n".join(wrong)
    assert refused > count / 3


@pytest.mark.parametrize("name", RIGHT)
def test_a_right_drive_is_one(name):
    assert all(map(is_a_drive, compiled(FILES / f"{name}.py")))
