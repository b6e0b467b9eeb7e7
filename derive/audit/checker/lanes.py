"""Each instance of the lanes, and derivatives by parameters, beside the scalar functions."""

import re
from fractions import Fraction
from random import Random

from .machine import Circle, Machine, machine
from .modular import PRIME, Number
from .refusal import require
from .straight_line import Function, Header, body_of, read_body, read_lanes


def check_lanes(header: Header, text: str, rng: Random) -> None:
    """Every instance is computed as the scalar functions compute it: state, state at an angle, step."""
    run = machine(header, "step", rng)
    circle, inputs, setup, instant = run.circle, run.inputs, run.earlier.earlier, run.earlier
    for name, scalar in (("setup", setup), ("set_phi", instant)):
        wide = Machine(inputs, read_lanes(text, name), None if name == "setup" else setup, circle)
        keys = {key for key in wide.function.definitions if key.startswith("s[")}
        read = re.findall(r"\bs\[\d+\]", " ".join(words for _, words in header.functions["step"].definitions.values()))
        missing = set(read) & set(scalar.function.definitions) - keys
        require(not missing, f"lanes: {', '.join(sorted(missing)[:3])} is not set")
        for key in keys:
            require(wide.value(key).value == scalar.value(key).value, f"lanes: {key} is not that of {name}")
    check_lane_guards(header, text, inputs, circle)
    # one design for both instances: every root of the design is needed once
    other = {
        key: Number(rng.randrange(1, PRIME), (), {f"m{key}": Fraction(1)}) for key in inputs if key.startswith("x[")
    }
    names = {key for f in ("setup", "set_phi") for key in header.functions[f].definitions if key.startswith("s[")}
    state = {key: instant.value(key) for key in names}
    own, states = [inputs, inputs | other], [state, state]
    first, second = (
        Machine(inputs | state, header.functions["step"], None, circle)
        for inputs, state in zip(own, states, strict=True)
    )
    partner = {f"m{key}": number for key, number in (own[1] | states[1]).items()}
    wide = Machine(own[0] | states[0] | partner, read_lanes(text, "step"), None, circle)
    for k in range(header.sizes["step"]):
        require(
            wide.value(f"new x[{k}]").value == first.value(f"new x[{k}]").value, f"lanes: x[{k}] is not that of step"
        )
        there = wide.value(f"new mx[{k}]").value
        require(there == second.value(f"new x[{k}]").value, f"lanes: x[{k}] of the partner is not that of step")


def check_lane_guards(header: Header, text: str, inputs: dict[str, Number], circle: Circle) -> None:
    """An instance is valid where all that the scalar setup tests is positive."""
    prefix = re.search(r"MW_LANE_NAME\((\w+)_setup_lanes\)", text)[1]
    body = re.sub(r"\b(\w)\[(\d+) \* MW_LANES \+ l\]", r"\1[\2]", body_of(text, f"{prefix}_setup_lanes"))
    before, _, after = body.partition("valid[l] = ")
    block = read_body(before[before.rindex("{\n") + 2 :])
    tested = re.findall(r"\((\S+) > 0\.0 \? 1\.0 : 0\.0\)", after.partition(";")[0])
    function, places = header.guards
    wide, scalar = (Machine(inputs, f, None, circle) for f in (Function("guards", block, {}), function))
    require(len(tested) == len(places), f"lanes: {len(tested)} guards, setup has {len(places)}")
    for place, name in places.items():
        found, expected = wide.value(tested[place]), scalar.value(name)
        require(found.value == expected.value, f"lanes: guard {place} is not that of setup")


def check_tangent(header: Header, text: str, rng: Random) -> None:
    """The change of the residual and of the contact point along changes of parameters, angle and unknowns."""
    run = machine(header, "eval", rng)
    inputs = dict(run.inputs)
    moved = {}
    for key in list(inputs):
        if key == "phi" or key.startswith(("p[", "x[")):
            rate = rng.randrange(1, PRIME) if key != "p[0]" else 0
            moved[f"d{key}"] = Number(rate)
            inputs[key] = Number(inputs[key].value, (rate,), inputs[key].form if key != "p[0]" else None)
    setup = Machine(inputs, header.functions["setup"], None, run.circle)
    instant = Machine(inputs, header.functions["set_phi"], setup, run.circle)
    residual = Machine(inputs, header.functions["eval"], instant, run.circle)
    seen = Machine(inputs, header.functions["observe"], instant, run.circle)
    own = {key: Number(number.value, (), number.angle) for key, number in inputs.items()}
    name = re.search(r"(\w+)_derive_tangent\(", text)[1] + "_tangent"
    tangent = Machine(own | moved, Function("tangent", read_body(body_of(text, name)), {}), None, run.circle)
    at, _ = seen.function.outputs["point_pinion_f"]
    expected = {f"dR[{i}]": residual.value(f"R[{i}]") for i in range(header.sizes["eval"])}
    expected |= {f"dr[{k}]": seen.value(f"o[{at + k}]") for k in range(3)}
    for key, number in expected.items():
        rate = number.rates[0] if number.rates else 0
        require(tangent.value(key).value == rate, f"tangent: {key} is not the derivative along the change")


def check_flank_tangent(header: Header, text: str, body: str, rng: Random) -> None:
    """The change of a flank's point along changes of parameters, at fixed parameters of the flank."""
    run = machine(header, f"flank_{body}", rng, arcs=True)
    own = {key: Number(number.value, (), number.angle) for key, number in run.inputs.items()}
    inputs, moved = dict(own), {"dp[0]": Number(0)}
    for key in (f"p[{k}]" for k in range(1, header.parameters)):
        rate = rng.randrange(1, PRIME)
        moved[f"d{key}"] = Number(rate)
        inputs[key] = Number(own[key].value, (rate,), own[key].form)
    setup = Machine(inputs, header.functions["setup"], None, run.circle)
    instant = Machine(inputs, header.functions["set_phi"], setup, run.circle)
    there = Machine(inputs, header.functions[f"flank_{body}"], instant, run.circle)
    name = re.search(r"(\w+)_derive_tangent\(", text)[1] + f"_{body}_tangent"
    tangent = Machine(own | moved, Function(name, read_body(body_of(text, name)), {}), None, run.circle)
    at, _ = there.function.outputs["point"]
    for k in range(3):
        number = there.value(f"o[{at + k}]")
        rate = number.rates[0] if number.rates else 0
        require(tangent.value(f"dr[{k}]").value == rate, f"tangent of {body}: dr[{k}] is not the point's derivative")
