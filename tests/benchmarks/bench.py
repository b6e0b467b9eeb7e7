"""``make bench``: points a second of every kernel in one table and one run.

Quote ratios, not seconds: they are what one run on one machine can compare. Nothing here asserts a time. The baselines
start each point from the one before; those named ``extrapolated`` from this runtime's own extrapolation. Of CasADi's
generated C there are two readings: ``casadi-c`` solves the residual that this compiler has reduced, ``casadi-c-chain``
what is written down without a compiler of gear meshing (:mod:`tests.benchmarks.chain`).
"""

import json
import subprocess
import tempfile
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import casadi
import numpy as np

from derive import drives
from derive.passes.schedule import schedule
from derive.program.tape import Stage
from meshwright import Drive
from meshwright.base.library import ffi, library, pointer
from tests.benchmarks import baselines, calls, certified, latency, regeneration, turning
from tests.benchmarks.chain import Chain
from tests.benchmarks.timing import best, compile_c, compiler, instructions

ROOT = Path(__file__).resolve().parents[2]
RUNTIME, GENERATED, HERE = ROOT / "runtime" / "c", ROOT / "generated" / "c", Path(__file__).parent

#: Design, first angle and step (rad) of each drive; the recess-action drive first.
CASES = (
    ("recess-action-full", 0.3, 1.75e-3),
    ("spherical-table-2-3", -0.1, 1e-5),
    ("face-worm-cylindrical-convex", -1.0, 1e-4),
    ("helical-crowned", -0.1, 1e-5),
    ("bevel-crowned-both", -0.1, 1e-5),
    ("bevel-hypoid", 0.6, 1e-5),
)
POINTS = 20000

#: How often each kernel is measured.
TURNS = 5

#: Floating-point operations of one sine and cosine together, the selection by quadrant not counted.
SINCOS = 41


#: Lane kernel → width of its vectors and compiler options; the last for everything that this processor has.
LANE_KERNELS = {
    "AVX2": (4, ("-mavx2", "-mfma")),
    "widest": (0, ("-march=native", "-mprefer-vector-width=512")),
}


@dataclass(frozen=True)
class Case:
    """A design traced over equally spaced angles: what every kernel solves."""

    drive: Drive
    angles: np.ndarray
    points: np.ndarray

    @property
    def parameters(self):
        return self.drive.design.parameters

    @property
    def start(self):
        return self.points[0]

    @property
    def name(self):
        return self.drive.design.description["name"]

    def text(self):
        return _text(self.parameters, self.angles, self.start)


@dataclass(frozen=True)
class Chained:
    """The same angles, solved by the chain as the description states it."""

    case: Case
    chain: Chain

    @classmethod
    def of(cls, case):
        description = json.loads((ROOT / "generated" / "descriptions" / f"{case.name}.json").read_text("utf-8"))
        return cls(case, Chain(description, case.parameters))

    def text(self):
        angles = self.case.angles
        return _text(self.chain.numbers, angles, self.chain.start(angles[0], self.case.start))


def _text(numbers, angles, start):
    """What the programs read: count of numbers, numbers, first angle, step, start values."""
    return f"{len(numbers)} " + " ".join(repr(float(v)) for v in (*numbers, angles[0], angles[1] - angles[0], *start))


def case_of(design, first, step):
    drive = Drive.load(design)
    angles = first + step * np.arange(POINTS)
    return Case(drive, angles, drive.trace(angles)[0])


def lane_points(case, width):
    """Points a second of many designs over the same angles in lanes; None if this processor has none so wide."""
    lanes, lib = library().mw_lanes(width), library()
    if lanes == ffi.NULL:
        return None
    m, n, designs = case.drive.design.model_in_lanes, 250, POINTS // 250
    parameters, angles = np.tile(case.parameters, (designs, 1)), case.angles[:n].copy()
    start, work = case.start.copy(), np.empty(lib.mw_lanes_work(lanes, m, n))
    x, status = np.empty((designs, n, m.nx)), np.empty((designs, n), dtype=np.int32)
    arguments = (lanes, m, pointer(parameters), designs, pointer(angles), n, pointer(start), pointer(work))
    seconds = best(lambda: lib.mw_trace_designs(*arguments, pointer(x), pointer(status, "int[]")), repeats=30)
    assert not status.any()
    return designs * n / seconds


def _numbers(program, case, *arguments):
    command = [str(program), *map(str, arguments)]
    done = subprocess.run(command, input=case.text(), capture_output=True, text=True, check=True)
    return [float(number) for number in done.stdout.split()]


def _run(program, case, *arguments):
    return _numbers(program, case, *arguments)[0]


def _counted(program, case, folder, *options):
    """Instructions a point, from the difference of two runs."""
    stdin = folder / "input"
    stdin.write_text(case.text())
    few, many = (instructions(stdin, program, n, *options) for n in (1000, 3000))
    return None if few is None else (many - few) / 2000


def scalar_program(case, folder, *options):
    every_drive = ("lanes", "library", "sensitivity", "casadi")
    sources = [HERE / "scalar_trace.c", *(p for p in RUNTIME.glob("*.c") if not p.name.startswith(every_drive))]
    name = case.name
    defines = [f'-DHEADER="{name}.h"', f"-DMODEL={name}_model", f"-DMODEL_NX={name}_NX"]
    return compile_c(sources, folder / "scalar", f"-I{GENERATED}", f"-I{RUNTIME}", *defines, *options)


def kernel_steps(case, folder, options):
    """Of each turn, Newton steps a second of a lane kernel alone, without what a trace adds, and the peak of fused
    multiply-adds with the same vectors measured between, floating-point operations a second."""
    name = case.name
    functions = {"SETUP": "setup_lanes", "SET_PHI": "set_phi_lanes", "STEP": "step_lanes"}
    defines = [f"-D{key}={name}_{function}" for key, function in functions.items()]
    defines += [f'-DHEADER="{name}_lanes.h"', f"-DMODEL_NX={name}_NX"]
    peak = compile_c([HERE / "peak.c"], folder / "peak.o", "-c", *options, "-ffp-contract=fast", "-funroll-loops")
    program = compile_c([HERE / "lane_step.c", peak], folder / "step", f"-I{GENERATED}", *options, *defines)
    return [_numbers(program, case)[:2] for _ in range(TURNS)]


def casadi_function(case):
    values = casadi.Function.load(str(ROOT / "generated" / "casadi" / f"{case.name}.casadi"))
    count = values.size1_in(0)
    x, q = casadi.SX.sym("x", values.size1_in(2)), casadi.SX.sym("q", count + 1)
    return casadi.Function("g", [x, q], [values(q[:count], q[count], x)[0]])


def casadi_program(function, folder, name):
    """A trace with CasADi's own C of the solver of function (x, q) → residual."""
    solver = casadi.rootfinder("solver", "fast_newton", function, {"abstol": 1e-11, "abstolStep": 1e-9})
    generator = casadi.CodeGenerator("solver.c", {"with_header": True})
    generator.add(solver)
    generator.generate(f"{folder}/")
    options = f"-I{folder}", f"-DUNKNOWNS={function.size1_in(0)}"
    return compile_c([HERE / "casadi_trace.c", folder / "solver.c"], folder / name, *options)


def _in_turns(kernels):
    """The highest rate of each kernel; as the clock changes from second to second, each has its turn several times."""
    rates = dict.fromkeys(kernels)
    for _ in range(TURNS):
        for name, points_a_second in kernels.items():
            rate = points_a_second()
            rates[name] = rate and max(rate, rates[name] or 0.0)
    return rates


def measure(case, folder):
    """Points a second of every kernel, and instructions a point where callgrind counts them."""
    plan = schedule(drives.catalogue()[case.name]())
    scalar, generated = scalar_program(case, folder), casadi_program(casadi_function(case), folder, "casadi")
    chained = Chained.of(case)
    by_chain = casadi_program(chained.chain.function, folder, "chain")
    rates = _in_turns(
        {
            "scalar": lambda: _run(scalar, case, POINTS, 20),
            **{f"lanes{w}": partial(lane_points, case, w) for w in (2, 4, 8)},
            **{
                f"certified{w}": partial(certified.points, case.drive, case.angles, case.points, w)
                for w in (1, 2, 4, 8)
            },
            "casadi-c": lambda: _run(generated, case, POINTS, 20, 0),
            "casadi-c-extrapolated": lambda: _run(generated, case, POINTS, 20, 1),
            "casadi-c-chain": lambda: _run(by_chain, chained, POINTS, 20, 0),
            "casadi-c-chain-extrapolated": lambda: _run(by_chain, chained, POINTS, 20, 1),
            "casadi-rootfinder": lambda: baselines.casadi_rootfinder_points(casadi_function(case), case),
            "scipy": lambda: baselines.scipy_points(plan, case),
            "numpy-batched": lambda: baselines.numpy_points(plan, case),
        }
    )
    counts = {
        "scalar": _counted(scalar, case, folder),
        "casadi-c": _counted(generated, case, folder, 1, 0),
        "casadi-c-extrapolated": _counted(generated, case, folder, 1, 1),
        "casadi-c-chain": _counted(by_chain, chained, folder, 1, 0),
        "casadi-c-chain-extrapolated": _counted(by_chain, chained, folder, 1, 1),
    }
    return rates, counts, plan


def operations(plan):
    """Floating-point operations of one Newton step and its size."""
    tape = plan.tape
    known = {i for i, stage in enumerate(tape.stages) if stage <= Stage.INSTANT}
    order = tape.needed(plan.newton_step, known)
    turned = {tape.nodes[i].args[0] for i in order if tape.nodes[i].op in ("sin", "cos")}
    weighed = sum(tape.const_value(i) != 1 for i in plan.weight)
    size = weighed + len(plan.weight) - 1
    return sum(tape.nodes[i].op not in ("sin", "cos") for i in order) + SINCOS * len(turned) + size


def main():
    print(f"compiler {' '.join(compiler())}; one core; quote the ratios")
    print("products are fused into sums in lanes4 and lanes8 alone")
    growth = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for design, first, step in CASES:
            case = case_of(design, first, step)
            rates, counts, plan = measure(case, folder)
            for kernel, rate in rates.items():
                shown = f"{rate:.4g} points/s {rate / rates['scipy']:.1f}x SciPy" if rate else "not on this processor"
                print(f"{case.name} {kernel} {shown}", flush=True)
            top = _kernels(case, folder, operations(plan))
            _remarks(rates, counts, operations(plan) / top)
            growth.append((case.name, len(case.start), operations(plan), rates["scalar"]))
    print("\ncost over the number of unknowns: drive, unknowns, operations a step, ns a point, ns an unknown")
    for name, unknowns, count, rate in growth:
        print(f"  {name:<28} {unknowns:>2} {count:>5} {1e9 / rate:>7.1f} {1e9 / rate / unknowns:>6.1f}")
    certified.report()
    calls.report()
    turning.report()
    latency.report()
    regeneration.report(growth[0][0])


def _kernels(case, folder, count):
    """Print each lane kernel's share of its peak, ``count`` operations a step; returns the peak of the widest."""
    for name, (width, options) in LANE_KERNELS.items():
        if library().mw_lanes(width) == ffi.NULL:
            continue
        turns = kernel_steps(case, folder, options)
        share, top = max((count * steps / top, top) for steps, top in turns)
        print(f"  lane kernel, {name}: {count} operations a step, {100 * share:.1f} % of the peak {top:.3g}/s")
    return top


def _remarks(rates, counts, share_of_peak):
    if None not in counts.values():
        for kernel, count in counts.items():
            print(f"  {kernel}: {count:.0f} instructions a point, {count / counts['scalar']:.1f} times the scalar's")
    widest = max(r for k, r in rates.items() if k.startswith("lanes") and r)
    print(f"  widest lanes, whole trace: {100 * widest * share_of_peak:.0f} % of the measured peak")


if __name__ == "__main__":
    main()
