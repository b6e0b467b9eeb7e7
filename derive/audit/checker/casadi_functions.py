"""CasADi's own lists of instructions beside the C functions."""

from pathlib import Path
from random import Random

from .description import Reader
from .design import given_rules
from .draws import once
from .drive import read, same
from .edges import BoundedDrive, systems_of
from .machine import Machine
from .modular import Number
from .refusal import Rejected, require
from .straight_line import Function

try:
    import casadi
except ImportError:
    casadi = None

#: Operations as C writes them, some as several, the last of which has the name: ``a < 0`` is (1 - sign a) / 2.
OPERATIONS = {
    "OP_ADD": ("{} + {}",), "OP_SUB": ("{} - {}",), "OP_MUL": ("{} * {}",), "OP_DIV": ("{} / {}",), "OP_NEG": ("-{}",),
    "OP_SQ": ("{0} * {0}",), "OP_TWICE": ("2.0 * {}",), "OP_INV": ("1.0 / {}",), "OP_SQRT": ("sqrt({})",),
    "OP_ATAN2": ("atan2({}, {})",), "OP_FABS": ("SIGN({0})", "{0} * {name}m"),
    "OP_LT": ("{0} - {1}", "SIGN({name}mmm)", "1.0 - {name}mm", "0.5 * {name}m"),
}  # fmt: skip


def program_of(function) -> tuple[dict[str, tuple[str, str]], list[int]]:
    """A CasADi function as a straight-line program: results o[k] one after the other, inputs as `in i k`."""
    codes = {getattr(casadi, name): name for name in dir(casadi) if name.startswith("OP_")}
    now: dict[int, str] = {}
    made: dict[str, tuple[str, str]] = {}
    sizes = [function.size1_out(k) * function.size2_out(k) for k in range(function.n_out())]
    begins = [sum(sizes[:k]) for k in range(len(sizes))]
    for k in range(function.n_instructions()):
        code = codes[function.instruction_id(k)]
        a, b = function.instruction_input(k), function.instruction_output(k)
        if code == "OP_OUTPUT":
            made[f"o[{begins[b[0]] + b[1]}]"] = ("expression", now[a[0]])
            continue
        if code == "OP_CONST":
            now[b[0]] = f"({function.instruction_constant(k)!r})"
            continue
        name = f"t{k}"
        if code == "OP_INPUT":
            made[name] = ("expression", f"in{a[0]}[{a[1]}]")
        elif code in ("OP_SIN", "OP_COS"):
            made[name] = (code[3:].lower(), now[a[0]])
        else:
            require(code in OPERATIONS, f"CasADi: {code} is not foreseen")
            texts = OPERATIONS[code]
            for left, text in enumerate(texts, 1 - len(texts)):
                made[name + "m" * -left] = ("expression", text.format(*(now[i] for i in a), name=name))
        now[b[0]] = name
    return made, begins


class Casadi:
    """The functions of a drive, read when asked for."""

    def __init__(self, folder: Path, prefix: str):
        self.folder, self.prefix, self.known = folder, prefix, {}

    def __call__(self, ending: str = ""):
        if ending not in self.known:
            self.replace(ending, casadi.Function.load(str(self.folder / f"{self.prefix}{ending}.casadi")))
        return self.known[ending]

    def replace(self, ending: str, function) -> None:
        """Take this function for the one of a file."""
        made, begins = program_of(function)
        names = dict(zip(function.name_out(), begins, strict=True))
        sizes = {name: function.numel_out(name) for name in names}
        self.known[ending] = Function(f"casadi{ending}", made, {k: (names[k], sizes[k]) for k in names}), function


def parts_of(drive: BoundedDrive, ending: str, result: str, size: int) -> list[tuple[int, int]]:
    """What of a result is compared at one input: place and size of each of its named outputs."""
    name = {"": "observe" if result == "observation" else "", "_surfaces": result}.get(ending, "")
    if not name:
        return [(0, size)]
    return [part for key, part in drive.function(name).outputs.items() if key != "curvature_gap"]


def check_casadi(drive: BoundedDrive, functions: Casadi, ending: str, result: str, part: tuple, rng: Random) -> None:
    """A part of one result of one function beside the C function that computes the same."""
    function, loaded = functions(ending)

    def made() -> tuple[Machine, list, Machine]:
        run, texts, given = beside(drive, ending, result, rng)
        own = {
            f"in{k}[{i}]": number
            for k in range(loaded.n_in())
            for i, number in enumerate(given.get(loaded.name_in(k), []))
        }
        return run, texts, Machine(own, function, None, run.circle)

    run, texts, machine = once(rng, ("casadi", ending, result), made)
    at, size = function.outputs[result]
    require(size == len(texts), f"CasADi{ending}: {result} has another length")
    for k in range(part[0], part[0] + part[1]):
        number, text = machine.value(f"o[{at + k}]"), texts[k]
        expected = text if isinstance(text, Number) else run.value(text)
        same(number, expected, f"CasADi{ending}: {result}")


def beside(drive: BoundedDrive, ending: str, result: str, rng: Random) -> tuple[Machine, list, dict]:
    """The C function of a result, the texts of its outputs, and what CasADi's arguments are."""
    parameters = len(drive.parameters)
    if ending in ("", "_edges"):
        given = main_inputs(drive, rng)
        return *main_texts(drive, result, rng), given
    if ending == "_surfaces":
        name = result.removeprefix("curvature_")
        symbols = arguments_of(drive, name)
        run, _ = drive.run(name, rng, "q", symbols)
        if result != name:
            run = Machine(run.inputs, drive.function(result), run.earlier, run.circle)
        given = {"p": [run.inputs[f"p[{k}]"] for k in range(parameters)]}
        given[f"q_{name}"] = [run.inputs[f"q[{k}]"] for k in range(len(symbols))]
        return run, results_of(run), given
    system = next(s for s in drive.description["design_systems"] if ending == f"_{s['name']}")
    symbols = [unknown["name"] for unknown in system["unknowns"]]
    stem = {"residual": "eval", "values": "fill"}.get(result, result)
    run, _ = drive.design(f"{system['name']}_{stem}", rng, symbols)
    given = {"p": [run.inputs[f"q[{k}]"] for k in range(parameters)], "path": [run.inputs[f"q[{parameters}]"]]}
    given["y"] = [run.inputs[f"y[{k}]"] for k in range(len(symbols))]
    letters = {"residual": "R", "guess": "new y", "scale": "new y", "watch": "o"}
    if result == "values":
        texts = [f"q[{drive.parameters.index(name)}]" for name in system["fills"]]
        run = Machine({k: v for k, v in run.inputs.items() if k not in texts}, run.function, run.earlier, run.circle)
        return run, texts, given
    count = (1 if system["regular"] else 0) if result == "watch" else len(symbols)
    letter = letters[result]
    if letter == "new y":
        run = Machine({k: v for k, v in run.inputs.items() if k[0] != "y"}, run.function, run.earlier, run.circle)
        letter = "y"
    return run, [f"{letter}[{k}]" for k in range(count)], given


def results_of(run: Machine) -> list[str]:
    """Texts of all that a function returns."""
    return [f"o[{k}]" for k in range(max(at + size for at, size in run.function.outputs.values()))]


def arguments_of(drive: BoundedDrive, name: str) -> list[str]:
    """Names of the arguments of a surface or of another function."""
    for entry, own in drive.surfaces():
        if own == name:
            return [q["name"] for q in entry["surface"]["parameters"]]
    if name == "placement":
        return ["own angle of the pinion", "own angle of the wheel"]
    return [q["name"] for f in drive.description["functions"] if f["name"] == name for q in f["arguments"]]


def main_inputs(drive: BoundedDrive, rng: Random) -> dict:
    base, _ = drive.run("observe", rng, "x", drive.unknowns)
    return {
        "p": [base.inputs[f"p[{k}]"] for k in range(len(drive.parameters))],
        "phi": [base.inputs["phi"]],
        "x": [base.inputs[f"x[{k}]"] for k in range(len(drive.unknowns))],
    }


def main_texts(drive: BoundedDrive, result: str, rng: Random) -> tuple[Machine, list]:
    """C function at the same input, and the texts of what the result holds."""
    observed, _ = drive.run("observe", rng, "x", drive.unknowns)
    inputs, n = observed.inputs, len(drive.unknowns)
    start = [unknown["name"] for unknown in drive.description["start"]["unknowns"]]
    own = {f"y[{k}]": inputs[f"x[{drive.unknowns.index(name)}]"] for k, name in enumerate(start)}

    def at(name: str, more: dict | None = None, without: str = "") -> Machine:
        kept = {k: v for k, v in inputs.items() if not without or k[0] != without}
        return Machine(kept | (more or {}), drive.function(name), observed.earlier, observed.circle)

    match result:
        case "residual":
            return at("eval"), [f"R[{k}]" for k in range(n)]
        case "observation":
            return observed, results_of(observed)
        case "placement":
            angle = Number(read(observed, "wheel_angle")[0].value, (), read(observed, "wheel_angle")[0].form)
            run = at("placement", {"q[0]": inputs["phi"], "q[1]": angle})
            return run, results_of(run)
        case "start_residual":
            return (at("start_eval", own), [f"R[{k}]" for k in range(len(start))]) if start else (observed, [])
        case "start_solution":
            return at("start_solution", own, "x"), [f"new x[{k}]" for k in range(n)]
        case "start_guess":
            return (at("guess"), [f"y[{k}]" for k in range(len(start))]) if start else (observed, [])
        case "scale":
            return at("scale", None, "x"), [f"new x[{k}]" for k in range(n)]
        case "guards":
            function, tested = drive.header.guards
            base = {key: entry for key, entry in inputs.items() if key[0] == "p"}
            run = Machine(base, function, None, observed.circle)
            return run, [tested[k] for k in range(len(tested))]
        case "rules":
            reader = Reader(drive.named, {name: inputs[f"p[{k}]"] for k, name in enumerate(drive.parameters)}, observed)
            return observed, [reader(value) for _, value in given_rules(drive)]
    for name, _, rows in systems_of(drive):
        if name == result:
            return at("edges"), [f"R[{k}]" for k in rows]
    raise Rejected(f"CasADi: nothing is known of {result}")
