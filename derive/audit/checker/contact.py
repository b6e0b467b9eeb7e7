"""Contact, start, observation, placement, flanks and other functions beside the description."""

from random import Random

from .description import Reader, inner
from .drive import Drive, rate, read, same
from .machine import Machine
from .modular import PRIME, NoRoot, Number, add, divide, multiply
from .refusal import Rejected, require
from .surfaces import Surface, cross, margin_of, regular_of, tangent_basis


def check_contact(drive: Drive, number: int, rng: Random) -> None:
    run, reader = drive.run("eval", rng, "x", drive.unknowns)
    same(run.value(f"R[{number}]"), reader(drive.description["contact"]["residual"][number]), f"eval: R[{number}]")


def check_scales(drive: Drive, rng: Random) -> None:
    run, reader = drive.run("scale", rng, "q", [])
    for k, unknown in enumerate(drive.description["contact"]["unknowns"]):
        require(unknown["name"] == drive.unknowns[k], f"scale: unknown {k} is {drive.unknowns[k]}")
        same(run.value(f"new x[{k}]"), reader(unknown["scale"]), f"scale: of {unknown['name']}")


def check_start(drive: Drive, name: str, key: str, number: int, rng: Random) -> None:
    """A row of a function of the start system: its outputs by the entry of the description."""
    start = drive.description["start"]
    symbols = [unknown["name"] for unknown in start["unknowns"]]
    computed = name in ("start_eval", "start_solution")
    run, reader = drive.run(name, rng, "y" if computed else "q", symbols if computed else [])
    reader = reader.at({symbol: reader(value) for symbol, value in start["fixed"].items()})
    match key:
        case "residual":
            found, expected = f"R[{number}]", start["residual"][number]
        case "scale":
            found, expected = f"y[{number}]", start["unknowns"][number]["scale"]
        case "guess":
            found, expected = f"y[{number}]", start["guess"][symbols[number]]
        case _:
            found, expected = f"new x[{number}]", start["solution"][drive.unknowns[number]]
    same(run.value(found), reader(expected), f"{name}: {found}")


def check_principal(found: list[Number], form: list[Number], side: int, words: str) -> None:
    """Two curvatures by sum and product. Their mean has to be a square, or the opposite of one: a program may take the
    root of the mean's square, and is right on one side where it is wrong on the other.
    """
    low, high = found
    mean = add(form[0], form[2]).value * pow(2, -1, PRIME) % PRIME
    if pow(mean, (PRIME - 1) // 2, PRIME) != side % PRIME:
        raise NoRoot
    same(add(low, high), add(form[0], form[2]), f"{words}: the sum")
    product = add(multiply(form[0], form[2]), multiply(form[1], form[1]), -1)
    same(multiply(low, high), product, f"{words}: the product")


def check_curvature(drive: Drive, entry: dict, name: str, side: int, rng: Random) -> None:
    """Tangent basis, second form and principal curvatures of a flank or region, in its body's frame."""
    symbols = [q["name"] for q in entry["surface"]["parameters"]]
    run, reader = drive.run(f"curvature_{name}", rng, "q", symbols)
    places = {symbol: k for k, symbol in enumerate(symbols)}
    surface = Surface(reader, entry["surface"], [])
    basis = tangent_basis(surface.normal, surface.tangents(places)[0])
    form = surface.second_form(places, basis)
    for key, expected in (("tangent_basis", [*basis[0], *basis[1]]), ("second_form", form)):
        for k, number in enumerate(read(run, key)):
            same(number, expected[k], f"curvature_{name}: {key}[{k}]")
    check_principal(read(run, "curvature"), form, side, f"curvature_{name}: curvature")


def check_forms(drive: Drive, key: str, rng: Random) -> None:
    """Tangent basis of the contact and second forms of both flanks in it."""
    run, reader = drive.run("observe", rng, "x", drive.unknowns)
    places = {name: k for k, name in enumerate(drive.unknowns)}
    bodies = {body["name"]: body for body in drive.description["bodies"]}
    if key == "tangent_basis":
        pinion = Surface(reader, bodies["pinion"]["surface"], bodies["pinion"]["motion"])
        first, second = tangent_basis(pinion.normal, pinion.tangents(places)[0])
        expected = [*first, *second]
    else:
        body = bodies[key.removeprefix("second_form_")]
        basis = read(run, "tangent_basis")
        expected = Surface(reader, body["surface"], body["motion"]).second_form(places, [basis[:3], basis[3:]])
    for k, number in enumerate(read(run, key)):
        same(number, expected[k], f"observe: {key}[{k}]")


def check_gap(drive: Drive, side: int, rng: Random) -> None:
    """Second form of the gap and its principal curvatures follow from the forms of both flanks.

    Where the program reads them where it writes them, any numbers stand for them: it then rests on no root of theirs.
    """
    run, _ = drive.run("observe", rng, "x", drive.unknowns)
    forms = [f"second_form_{body['name']}" for body in drive.description["bodies"]]
    try:
        check_gap_of(cut(run, forms, rng), forms, side)
    except Rejected:
        check_gap_of(run, forms, side)


def check_gap_of(run: Machine, forms: list[str], side: int) -> None:
    gap = read(run, "second_form_gap")
    for k, (number, a, b) in enumerate(zip(gap, *(read(run, name) for name in forms), strict=True)):
        same(number, Number(-(a.value + b.value)), f"observe: second_form_gap[{k}]")
    check_principal(read(run, "curvature_gap"), gap, side, "observe: curvature_gap")


def turning(reader: Reader, motion: list, place: int, point: list[Number]) -> list[Number]:
    """Velocity of the body's point that is there, of what is carried by the motion, along one direction."""
    columns = [reader.carried(motion, [Number(int(i == k)) for i in range(3)], free=True) for k in range(3)]
    origin = reader.carried(motion, [Number(0)] * 3)
    arm = [add(p, o, -1) for p, o in zip(point, origin, strict=True)]
    local = [Number(inner(column, arm).value) for column in columns]
    return [add(rate(origin[i], place), inner([rate(column[i], place) for column in columns], local)) for i in range(3)]


def check_arms(drive: Drive, rng: Random) -> None:
    """Lever arms: how fast each body's own angle moves the contact point along the normal, and their quotient."""
    run, reader = drive.run("observe", rng, "x", drive.unknowns)
    described = drive.description
    instant, error = described["contact"]["instant"]["name"], described["contact"]["error"]
    moving = reader.at({
        name: Number(reader(name).value, (int(name == instant), int(name == error)), reader(name).form)
        for name in (*drive.unknowns, instant)
    })  # fmt: skip
    pinion, wheel = described["bodies"]
    contact = Surface(reader, pinion["surface"], pinion["motion"])
    normal, point = contact.normal, [Number(n.value) for n in contact.point]
    arms = [inner(normal, turning(moving, body["motion"], k, point)) for k, body in enumerate((pinion, wheel))]
    for body, arm in zip((pinion, wheel), arms, strict=True):
        same(read(run, f"lever_arm_{body['name']}")[0], arm, f"observe: lever_arm_{body['name']}")
    same(read(run, "instantaneous_ratio")[0], divide(*arms), "observe: instantaneous_ratio")


def check_placement(drive: Drive, member: int, rng: Random) -> None:
    """A motion, its rows, and the axis: what its own angle moves is direction x (point - point of the axis)."""
    contact = drive.description["contact"]
    run, reader = drive.run("placement", rng, "q", ["own angle of the pinion", "own angle of the wheel"])
    own = [reader("own angle of the pinion"), reader("own angle of the wheel")]
    there = reader.at({contact["instant"]["name"]: own[0], contact["error"]: Number(0, (), {})})
    error = add(own[1], there(contact["wheel_angle"]), -1)
    there = there.at({contact["error"]: Number(error.value, error.rates, error.form)})
    body = drive.description["bodies"][member]
    motion, name = body["motion"], body["name"]
    columns = [there.carried(motion, [Number(int(i == k)) for i in range(3)], free=True) for k in range(3)]
    columns.append(there.carried(motion, [Number(0)] * 3))
    rows = [column[i] for i in range(3) for column in columns]
    for k, number in enumerate(read(run, f"placement_{name}")):
        same(number, rows[k], f"placement: placement_{name}[{k}]")
    direction, through = read(run, f"axis_{name}"), read(run, f"axis_point_{name}")
    for k, column in enumerate(columns):
        arm = column if k < 3 else [add(c, t, -1) for c, t in zip(column, through, strict=True)]
        for i, number in enumerate(cross(direction, arm)):
            same(number, rate(column[i], member), f"placement: axis of the {name}")


def check_observed(drive: Drive, key: str, rng: Random) -> None:
    """One named output of the observation."""
    run, reader = drive.run("observe", rng, "x", drive.unknowns)
    found, expected = read(run, key), observed(drive, reader, key)
    for k, number in enumerate(found):
        same(number, expected[k], f"observe: {key}[{k}]")


def observed(drive: Drive, reader: Reader, key: str) -> list[Number]:
    places = {name: k for k, name in enumerate(drive.unknowns)}
    for body in drive.description["bodies"]:
        name = body["name"]
        if key in (f"point_{name}_f", f"normal_{name}_f"):
            placed = Surface(reader, body["surface"], body["motion"])
            return placed.point if key.startswith("point") else placed.normal
        if key == f"point_{name}":
            return Surface(reader, body["surface"], []).point
        for parameter in body["surface"]["parameters"]:
            if key == f"tangent_{parameter['name']}":
                placed = Surface(reader, body["surface"], body["motion"])
                return [rate(number, places[parameter["name"]]) for number in placed.point]
        if key == f"regular_{name}":
            return [regular_of(reader, body, places)]
        for k in range(len(body["surface"]["conditions"])):
            if key == f"condition_{name}_{k}":
                return Surface(reader, body["surface"], []).slopes(places)[k]
        for margin in body["margins"]:
            if key == f"margin_{name}_{margin['event']}":
                return [margin_of(reader, margin, body, places)]
    return [reader(drive.description["contact"]["wheel_angle"] if key == "wheel_angle" else key)]


def observed_keys(drive: Drive) -> list[str]:
    """Outputs of the observation of which the description says the value."""
    bodies = drive.description["bodies"]
    keys = ["wheel_angle", *(q["name"] for body in bodies for q in body["recovered"])]
    for body in bodies:
        name = body["name"]
        keys += [f"point_{name}_f", f"normal_{name}_f", f"point_{name}"]
        keys += [f"tangent_{q['name']}" for q in body["surface"]["parameters"]]
        keys += [f"regular_{name}", *(f"condition_{name}_{k}" for k in range(len(body["surface"]["conditions"])))]
        keys += [f"margin_{name}_{margin['event']}" for margin in body["margins"]]
    return keys


def cut(run: Machine, keys: list[str], rng: Random) -> Machine:
    """The same program where some of its outputs are any numbers: what follows from them rests on no root of theirs."""
    free = {}
    for at, size in (run.function.outputs[key] for key in keys):
        for k in range(size):
            name = run.function.definitions[f"o[{at + k}]"][1].strip("()-")
            free[name] = Number(rng.randrange(1, PRIME))
    return Machine(run.inputs | free, run.function, run.earlier, run.circle)


def check_surface(drive: Drive, entry: dict, name: str, key: str, rng: Random) -> None:
    """One named output of a flank or region, in its body's frame."""
    symbols = [q["name"] for q in entry["surface"]["parameters"]]
    run, reader = drive.run(name, rng, "q", symbols)
    surface = Surface(reader, entry["surface"], [])
    if key in ("point", "normal"):
        expected = getattr(surface, key)
    elif key == "regular":
        expected = [regular_of(reader, entry, {symbol: k for k, symbol in enumerate(symbols)})]
    elif key.startswith("condition_"):
        expected = [reader(entry["surface"]["conditions"][int(key[len("condition_") :])])]
    else:
        margin = next(m for m in entry["margins"] if key == f"margin_{m['event']}")
        expected = [margin_of(reader, margin, entry, {symbol: k for k, symbol in enumerate(symbols)})]
    for k, number in enumerate(read(run, key)):
        same(number, expected[k], f"{name}: {key}[{k}]")


def check_function(drive: Drive, entry: dict, result: dict, rng: Random) -> None:
    """One result of a function that the drive offers."""
    run, reader = drive.run(entry["name"], rng, "q", [q["name"] for q in entry["arguments"]])
    found = read(run, result["name"])
    require(len(found) == len(result["values"]), f"{entry['name']}: {result['name']} has another length")
    for k, (number, value) in enumerate(zip(found, result["values"], strict=True)):
        same(number, reader(value), f"{entry['name']}: {result['name']}[{k}]")
