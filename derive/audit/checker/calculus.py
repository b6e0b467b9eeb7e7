"""Jacobian, step, derivatives along a path, flanks and their curvature against calculus."""

import re
from random import Random

from .drive import rate, read
from .machine import Machine, machine
from .modular import PRIME, NoRoot, Number
from .refusal import require
from .straight_line import Function, Header, read_body


def check_jacobian(header: Header, name: str, rng: Random) -> None:
    """J is the derivative of R, entry by entry."""
    run = machine(header, name, rng)
    rows, entries = (sum(entry.startswith(letter) for entry in run.function.definitions) for letter in ("R[", "J["))
    for i in range(rows):
        residual, columns = run.value(f"R[{i}]"), entries // rows
        for j in range(columns):
            found = run.value(f"J[{i * columns + j}]").value
            require(found == rate(residual, j).value % PRIME, f"{name}: J[{i}][{j}] is not the derivative of R[{i}]")


def check_assembly(header: Header, rng: Random) -> None:
    """Residual and observation at one input.

    R[0..2] is the difference of the two points, in whatever frame it was formed.
    """
    run = machine(header, "observe", rng)
    other = Machine(run.inputs, header.functions["eval"], run.earlier, run.circle)
    places = [run.function.outputs[f"point_{body}_f"][0] for body in ("pinion", "wheel")]
    first, second = ([run.value(f"o[{at + k}]").value for k in range(3)] for at in places)
    distance = sum((a - b) ** 2 for a, b in zip(first, second, strict=True))
    require(
        (distance - sum(other.value(f"R[{k}]").value ** 2 for k in range(3))) % PRIME == 0,
        "eval: R[0..2] is not the distance of the two points",
    )


def check_agreement(header: Header, body: str, rng: Random) -> None:
    """Flank and observation at one input: what both give in the body's frame is the same."""
    seen = machine(header, "observe", rng)
    own = {f"q[{k}]": seen.inputs[f"x[{place}]"] for k, place in enumerate(header.unknowns[body])}
    flank = Machine(seen.inputs | own, header.functions[f"flank_{body}"], seen.earlier, seen.circle)
    for key, (at, size) in flank.function.outputs.items():
        first, _, rest = key.partition("_")
        if first in ("point", "regular", "margin"):
            there, _ = seen.function.outputs[f"{first}_{body}" + (f"_{rest}" if rest else "")]
            for k in range(size):
                require(
                    flank.value(f"o[{at + k}]").value == seen.value(f"o[{there + k}]").value,
                    f"flank_{body}: {key} is not that of the observation",
                )


def check_flank(header: Header, name: str, rng: Random) -> None:
    run = machine(header, name, rng, arcs=True)
    outputs = run.function.outputs
    tangents = [key for key in outputs if key.startswith("tangent_")]
    point, normal = read(run, "point"), read(run, "normal")
    require(sum(n.value * n.value for n in normal) % PRIME == 1, f"{name}: the normal has not length one")
    meets = {}
    for position, key in enumerate(tangents):
        tangent = read(run, key)
        for k in range(3):
            found = tangent[k].value == rate(point[k], position).value % PRIME
            require(found, f"{name}: {key} is not the derivative of the point")
        if slope := sum(n.value * t.value for n, t in zip(normal, tangent, strict=True)) % PRIME:
            meets[key] = slope
    implicit = [key for key in outputs if re.fullmatch(r"condition_\d+", key)]
    allowed = len(meets) == len(implicit) or _vanishes_with(header, name, len(implicit), rng)
    require(allowed, f"{name}: the normal is not perpendicular to {', '.join(meets)}")
    for key in implicit:
        (condition,) = read(run, key)
        slopes = [number.value for number in read(run, f"{key}_slopes")]
        require(
            slopes == [rate % PRIME for rate in condition.rates], f"{name}: the slopes of {key} are not its derivatives"
        )


def _vanishes_with(header: Header, name: str, conditions: int, rng: Random) -> bool:
    """Whether the normal meets the tangents only as far as the conditions are not zero.

    Where they are, it is perpendicular to all. So its products with the tangents are those conditions in fixed
    directions of the parameters, whichever way these were summed: at any inputs they have no higher rank.
    """
    rows: list[list[int]] = []
    while conditions and len(rows) <= conditions:
        run = machine(header, name, rng, arcs=True)
        tangents = [key for key in run.function.outputs if key.startswith("tangent_")]
        try:
            normal = read(run, "normal")
            rows.append([
                sum(n.value * t.value for n, t in zip(normal, read(run, key), strict=True)) % PRIME for key in tangents
            ])  # fmt: skip
        except NoRoot:
            continue
    return bool(conditions) and _rank(rows) <= conditions


def _rank(rows: list[list[int]]) -> int:
    """Rank of a matrix modulo the prime."""
    rows, rank = [row for row in rows if any(row)], 0
    while rows:
        first, *others = rows
        at = next(k for k, entry in enumerate(first) if entry)
        inverse = pow(first[at], -1, PRIME)
        lowered = [[(a - row[at] * inverse * b) % PRIME for a, b in zip(row, first, strict=True)] for row in others]
        rows, rank = [row for row in lowered if any(row)], rank + 1
    return rank


def check_step(header: Header, rng: Random) -> None:
    """J (x - new x) = R: the fused step solves the linear system that R and J state."""
    run = machine(header, "eval", rng)
    step = Machine(run.inputs, header.functions["step"], run.earlier, run.circle)
    n = sum(name.startswith("R[") for name in run.function.definitions)
    change = [run.inputs[f"x[{k}]"].value - step.value(f"new x[{k}]").value for k in range(n)]
    for i in range(n):
        moved = sum(run.value(f"J[{i * n + j}]").value * change[j] for j in range(n))
        require((moved - run.value(f"R[{i}]").value) % PRIME == 0, f"step: row {i} of J dx = -R does not hold")


#: How the anchor writes sine and cosine of an angle, and how they are read.
ANCHORED = re.compile(r"\w+_seldom_sincos\(at\[(\d+)\], at \+ (\d+), at \+ (\d+)\);")
TAKEN = re.compile(r"\w+_near_sincos\((.+), &\w+, &\w+, at \+ (\d+), &away\);")


def check_by_anchor(header: Header, rng: Random) -> None:
    """R is that of eval; each sine is of the angle at whose place it is looked for."""
    run = machine(header, "eval", rng)
    setup, (written, read) = run.earlier.earlier, header.anchored
    close = Machine(run.inputs, header.functions["by_anchor"], setup, run.circle)
    anchor = Machine(run.inputs, Function("anchor", read_body(ANCHORED.sub("", written)), {}), setup, run.circle)
    for k in range(header.sizes["eval"]):
        require(close.value(f"R[{k}]").value == run.value(f"R[{k}]").value, f"by_anchor: R[{k}] is not that of eval")
    places, taken = [tuple(map(int, found)) for found in ANCHORED.findall(written)], TAKEN.findall(read)
    require(places == [(k, k + 1, k + 2) for k in range(0, 3 * len(places), 3)], "anchor: sines at other places")
    for angle, place in taken:
        require(anchor.value(f"at[{place}]").value == close.value(angle).value, f"anchor: at[{place}] is another angle")


def check_along(header: Header, rng: Random) -> None:
    """d1 is the derivative of R along v, a direction of (x, phi), and d2 that of d1."""
    n = header.sizes["eval"]
    run = machine(header, "eval", rng)
    rates = {f"x[{k}]": k for k in range(n)} | {"phi": n}
    inputs = dict(run.inputs)
    for key, place in rates.items():
        inputs[key] = Number(inputs[key].value, tuple(int(j == place) for j in range(n + 1)), inputs[key].form)
    setup = Machine(inputs, header.functions["setup"], None, run.circle)
    instant = Machine(inputs, header.functions["set_phi"], setup, run.circle)
    residual = Machine(inputs, header.functions["eval"], instant, run.circle)
    speed = {f"v[{k}]": Number(rng.randrange(1, PRIME)) for k in range(n + 1)}
    along = Machine(inputs | speed, header.functions["along"], setup, run.circle)

    def slope(number: Number) -> int:
        return sum(rate * speed[f"v[{k}]"].value for k, rate in enumerate(number.rates)) % PRIME

    for i in range(n):
        first = along.value(f"d1[{i}]")
        require(first.value == slope(residual.value(f"R[{i}]")), f"along: d1[{i}] is not the derivative of R[{i}]")
        require(along.value(f"d2[{i}]").value == slope(first), f"along: d2[{i}] is not the derivative of d1[{i}]")


def check_curvature(header: Header, name: str, rng: Random) -> None:
    """An orthonormal basis of the tangent plane, the second form from the change of the normal, its trace and
    determinant from the principal curvatures.
    """
    run = machine(header, name, rng, arcs=True)
    curved = Machine(run.inputs, header.functions[f"curvature_{name}"], run.earlier, run.circle)

    def product(a: list[int], b: list[int]) -> int:
        return sum(x * y for x, y in zip(a, b, strict=True)) % PRIME

    basis = [number.value for number in read(curved, "tangent_basis")]
    axes_ = basis[:3], basis[3:]
    normal = read(run, "normal")
    lengths = [product(axes_[0], axes_[0]), product(axes_[1], axes_[1]), product(axes_[0], axes_[1])]
    require(lengths == [1, 1, 0], f"curvature_{name}: the basis is not orthonormal")
    require(
        all(product(a, [n.value for n in normal]) == 0 for a in axes_), f"curvature_{name}: the basis is not tangent"
    )
    form = [number.value for number in read(curved, "second_form")]
    tangents = [[n.value for n in read(run, key)] for key in run.function.outputs if key.startswith("tangent_")]
    for first in tangents:
        for j in range(len(tangents)):
            turned = [rate(n, j).value for n in normal]
            (a, b), (c, d) = ([product(v, e) for e in axes_] for v in (first, tangents[j]))
            expected = a * c * form[0] + (a * d + b * c) * form[1] + b * d * form[2]
            require((expected + product(first, turned)) % PRIME == 0, f"curvature_{name}: not the change of the normal")
    low, high = (number.value for number in read(curved, "curvature"))
    require((low + high - form[0] - form[2]) % PRIME == 0, f"curvature_{name}: the curvatures have another sum")
    require((low * high - form[0] * form[2] + form[1] ** 2) % PRIME == 0, f"curvature_{name}: another product")
