"""Divisions, roots and arcs of the generated code: each has a side condition, and a broken one ends as promised."""

import math
import re
from collections import Counter
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from derive.audit.identities.derivation import UNKNOWNS
from derive.drives import catalogue
from derive.passes import guards
from derive.passes.sample import sample_parameters
from derive.passes.schedule import schedule
from meshwright.base.library import ffi, library, model, text
from meshwright.design.description import described
from tests.quick import quick

GENERATED = Path(__file__).resolve().parents[2] / "generated"
DRIVES = sorted(path.stem for path in (GENERATED / "c").glob("*.json"))
ELEMENTARY = ("sincos", "atan2")
PARTIAL = {"division": r"= [^;?]*? / (?![\d.]+(?:e[-+]?\d+)?;)", "root": r"= sqrt\(", "arc": r"= \w+_atan2\("}


@cache
def scheduled(drive):
    """The schedule of a drive, to be read."""
    return schedule(catalogue()[drive]())


def functions_in(header, prefix):
    """Name without prefix → text of each function of a generated header."""
    start = rf"^(?:MW_DEVICE )?(?:static inline|MW_INLINE) [\w ]+?\*?(?:MW_LANE_NAME\()?{prefix}_(\w+)\)?\("
    parts = re.split(start, header, flags=re.MULTILINE)
    return {name: text.partition("\n}\n")[0] for name, text in zip(parts[1::2], parts[2::2], strict=True)}


def partial_operations(body):
    return Counter({kind: len(found) for kind, pattern in PARTIAL.items() if (found := re.findall(pattern, body))})


def listed(drive):
    found = {}
    for entry in described(drive)["side_conditions"]:
        kind = "root" if entry["operation"] == "arccosine" else entry["operation"]
        for name, use in entry["functions"].items():
            found.setdefault(name, Counter())[kind] += use["count"]
    return found


@pytest.mark.parametrize("drive", DRIVES)
def test_no_division_root_or_arc_of_a_header_lacks_its_side_condition(drive):
    wanted = listed(drive)
    for suffix in ("", "_lanes", "_bounded", "_sensitivity"):
        header = (GENERATED / "c" / f"{drive}{suffix}.h").read_text(encoding="utf-8")
        for name, body in functions_in(header, drive).items():
            if name not in ELEMENTARY:
                name = name.removesuffix("_lanes") if suffix == "_lanes" else name
                copies = 2 if (name, suffix) == ("step", "_lanes") else 1  # a step takes two lanes side by side
                expected = {kind: copies * count for kind, count in wanted.get(name, {}).items()}
                assert partial_operations(body) == expected, name


@pytest.mark.parametrize("drive", DRIVES)
def test_every_side_condition_names_a_proved_statement_and_a_guard(drive):
    told = described(drive)
    for entry in told["side_conditions"]:
        assert entry["condition"] and entry["equations"]
        assert set(entry["equations"]) <= set(told["equations"]) | {"derivation/quotient", "derivation/root"}
        for use in entry["functions"].values():
            assert use["guards"]
            for guard in use["guards"]:
                number = re.fullmatch(r"setup (\d+)", guard)
                assert guard in guards.GUARDS or 1 <= int(number[1]) <= len(told["guards"])


# -- every condition, broken on the tape: what is not finite arrives --------------------------------------------------

REPRESENTATIVE = ("cylindrical_worm_zn_zn", "cylindrical_worm_zc_zc", "spherical_convex_spur", "face_worm")


def run(tape, outputs, inputs, broken):
    """IEEE arithmetic on the tape; operations in ``broken`` divide by zero or take the root of −1."""
    values = {}

    def value(i):
        node = tape.nodes[i]
        if node.op == "const":
            return np.float64(node.value)
        return np.float64(inputs.get(node.value, 0.3)) if node.op == "input" else values[i]

    apply = {
        "add": np.add, "sub": np.subtract, "mul": np.multiply, "div": np.divide, "neg": np.negative, "sqrt": np.sqrt,
        "sin": np.sin, "cos": np.cos, "atan2": np.arctan2,
        "sign": np.sign,
    }  # fmt: skip
    for i in tape.needed(outputs):
        args = [value(a) for a in tape.nodes[i].args]
        if i in broken:
            args[-1] = np.float64(0.0 if tape.nodes[i].op == "div" else -1.0)
        values[i] = apply[tape.nodes[i].op](*args)
    return {i: value(i) for i in outputs}


@pytest.mark.parametrize("drive", quick(DRIVES, *DRIVES[::4]))
def test_elimination_is_proved_for_as_many_unknowns(drive):
    assert len(scheduled(drive).linear.matrix) <= UNKNOWNS


@pytest.mark.parametrize("drive", REPRESENTATIVE)
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_a_broken_condition_is_seen_in_every_result_that_depends_on_it(drive):
    plan = scheduled(drive)
    guarded = {guard.of for guard in plan.guards}
    inputs = {symbol: float(value) for symbol, value in sample_parameters(plan.drive).items()}
    tried = 0
    for f in guards.functions(plan):
        if f.tape is not plan.tape or f.name in guards.EARLY or f.guard == "start":
            continue
        tested = plan.tests.get((f.name, f.part), {})
        order = f.tape.needed(f.outputs)
        demands = dict.fromkeys(c for i in order for c in guards.demanded(f.tape, i))
        for node, kind in demands:
            if node in guarded:
                continue
            broken = {i for i in order if (node, kind) in guards.demanded(f.tape, i)}
            whole, harmed = run(f.tape, f.outputs, inputs, ()), run(f.tape, f.outputs, inputs, broken)
            for group in f.groups:
                changed = any(whole[i] != harmed[i] and math.isfinite(whole[i]) for i in group)
                if changed and node not in tested.get(group, ()):
                    tried += 1
                    assert not all(math.isfinite(harmed[i]) for i in group), (f.name, node)
    assert tried > 20


# -- the compiled library ---------------------------------------------------------------------------------------------


class Case:
    """A drive of the library at its self-test."""

    def __init__(self, name):
        self.c, self.told = model(name), described(name)
        test = self.told["self_test"]
        self.p = np.array([math.nan if v == "nan" else float.fromhex(v) for v in test["p"]])
        self.x = np.array([float.fromhex(v) for v in test["x"]])
        self.phi, self.s = float.fromhex(test["phi"]), np.empty(self.c.ns)

    def buffer(self, array):
        return ffi.from_buffer("double[]", array)

    def setup(self, **change):
        """The guard that fails, or what is missing, as a message; "" if nothing is."""
        p = self.p.copy()
        names = [text(self.c.parameters[k].name) for k in range(self.c.np)]
        for name, value in change.items():
            p[names.index(name)] = value
        failed = self.c.setup(self.buffer(p), self.buffer(self.s))
        self.c.set_phi(self.buffer(self.s), self.phi)
        self.last = p
        return [*self.told["guards"], *self.told["missing"]][failed - 1]["message"] if failed else ""

    def status(self):
        """Of mw_solve and of mw_trace for the parameters of the last setup."""
        work, x, info = np.empty(self.c.np), np.empty(self.c.nx), ffi.new("mw_info *")
        phi = np.array([self.phi])
        p, s, w = self.buffer(self.last), self.buffer(self.s), self.buffer(work)
        solved = library().mw_solve(self.c, p, self.phi, s, w, self.buffer(x), info)
        library().mw_trace(self.c, p, self.buffer(phi), 1, s, w, self.buffer(x), info)
        assert info.status == solved
        return text(library().mw_status_word(solved))

    def step_from(self, **change):
        """Size of the Newton step, and status of following contact from there, with these unknowns changed."""
        assert self.setup() == ""
        x = self.x.copy()
        for name, value in change.items():
            x[[u["name"] for u in self.told["unknowns"]].index(name)] = value
        stepped, out, info = x.copy(), np.empty(self.c.nx), ffi.new("mw_info *")
        size = self.c.step(self.buffer(self.s), self.buffer(stepped))
        phi = np.array([self.phi + 1e-3])
        follow = library().mw_follow
        follow(self.c, self.buffer(self.s), self.phi, self.buffer(x), self.buffer(phi), 1, self.buffer(out), info)
        return size, text(library().mw_status_word(info.status))


DESIGNS = [
    ("cylindrical_worm_zn_zn", {"T_2": 0}, "T_2 must not be 0"),
    ("cylindrical_worm_zn_zn", {"m_n": 0, "dx": -1}, "m_n must not be 0"),
    ("cylindrical_worm_zn_zn", {"alpha": 0}, "sin(alpha) must not be 0"),
    ("cylindrical_worm_zn_zn", {"dx": -20000.0}, "the groove is wider than the pitch cylinder"),
    ("cylindrical_worm_zk_zk", {"r_c_hob": 0}, "r_c_hob must not be 0"),
    ("cylindrical_worm_zc_zc", {"rho_c_hob": -1}, "the arc's centre lies inside the groove"),
    ("cylindrical_worm_zi_zi", {"lambda_worm": 0}, "sin(lambda_worm) must not be 0"),
    ("cylindrical_worm_za_za", {"r_hob": 0, "dx": -1}, ""),
    ("spherical_convex_spur", {"alpha": 0}, "sin(alpha) must not be 0"),
    ("spherical_convex_spur", {"T_2": 0, "a_wheel": -1}, "T_2 must not be 0"),
    ("face_worm", {"N_2": 0}, "N_2 must not be 0"),
    ("face_worm", {"m_ax": 0}, "m_ax must not be 0"),
]


@pytest.mark.parametrize(("drive", "change", "message"), DESIGNS)
def test_a_design_that_divides_by_zero_or_takes_an_impossible_root_is_bad_input(drive, change, message):
    case = Case(drive)
    assert case.setup() == ""
    told = case.setup(**change)
    assert told and message in told
    assert case.status() == "bad_input"


@pytest.mark.parametrize("drive", REPRESENTATIVE)
@pytest.mark.parametrize("value", [math.inf, -math.inf, math.nan])
def test_every_parameter_that_the_contact_needs_has_to_be_finite(drive, value):
    case = Case(drive)
    needed = [k for k, p in enumerate(case.told["parameters"]) if math.isfinite(case.p[k])]
    refused = [k for k in needed if case.setup(**{case.told["parameters"][k]["name"]: value})]
    contact = [k for k in needed if case.told["parameters"][k]["table"] in ("flank", "design", "misalignment")]
    read = {p["name"] for k, p in enumerate(case.told["parameters"]) if k in contact}
    missed = {case.told["parameters"][k]["name"] for k in contact if k not in refused}
    assert read and not missed & _read_by_the_residual(drive)


def _read_by_the_residual(drive):
    """Names of the inputs of the residual."""
    plan = scheduled(drive)
    nodes = plan.tape.nodes
    return {str(nodes[a].value) for i in plan.tape.needed(plan.residual) for a in nodes[i].args if nodes[a].value}


POINTS = [
    ("cylindrical_worm_za_za", {"t_hob": 0.0, "psi_fixed_hob": 0.0}, "slope of the equation of meshing"),
    ("cylindrical_worm_zi_zi", {"t_worm": 1.0}, "r_b_worm"),
    ("cylindrical_worm_zi_zi", {"t_hob": 1.0}, "r_b_hob"),
    ("spherical_convex_spur", {"theta_pinion": math.inf}, "cos(theta_pinion)"),
    ("face_worm", {"u_gear": math.inf}, "pivot"),
]


@pytest.mark.parametrize(("drive", "change", "condition"), POINTS)
def test_a_point_where_the_equations_do_not_exist_has_no_step_and_no_contact(drive, change, condition):
    case = Case(drive)
    of_step = [entry["condition"] for entry in case.told["side_conditions"] if "step" in entry["functions"]]
    assert any(condition in text for text in of_step)
    size, status = case.step_from(**change)
    assert not math.isfinite(size)
    assert status in ("left_flank", "singular")


@pytest.mark.validate
def test_a_zero_pivot_is_line_contact_or_singular_and_never_a_point():
    """Equal flanks touch along a line: the last pivot vanishes."""
    case = Case("spherical_spur_spur")
    assert case.setup() == ""
    assert case.status() == "line_contact"


def test_an_undefined_rule_leaves_its_parameter_open():
    """A head-cutter axis for which the blade angle has no direction."""
    case = Case("face_worm")
    index = {p["name"]: k for k, p in enumerate(case.told["parameters"])}
    p = case.p.copy()
    p[[index[f"{axis}g_{part}"] for axis in "xyz" for part in "xyz"]] = 0.0
    p[index["alpha_g"]] = math.nan
    case.c.derive(case.buffer(p))
    assert math.isnan(p[index["alpha_g"]])
    assert case.c.setup(case.buffer(p), case.buffer(case.s)) != 0
