"""The C interface under sanitizers: built with the drives of five families, called with bytes that a fuzzer chooses.

With clang, libFuzzer leads the bytes to code that was not reached; with gcc alone they are random. A tool that is
missing is named and nothing is claimed in its place.
"""

import os
import re
import shutil
import subprocess
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path

import numpy as np

from meshwright import Drive
from meshwright.base.compile import DRIVE, IN_LANES, PARTS, PROOFS
from meshwright.base.library import ffi, library, pointer
from meshwright.cycle import certified_first, searched_flank
from meshwright.cycle.search import Search, _matrices
from meshwright.design import design

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SOURCE, GENERATED = ROOT / "runtime" / "c", ROOT / "generated" / "c"

#: A design of every family, and beside it those that hold what the others lack: line contact, an undercut, no blank.
DESIGNS = (
    "zk-zn-45", "zk-zn-90", "spherical-table-2-3", "spherical-table-5-2-convex", "helical-crowned",
    "crossed-helical-17-23", "spur-profile-shift", "face-worm-cylindrical-convex", "face-worm-conical-concave",
    "bevel-formate", "bevel-face-hobbed",
)  # fmt: skip

#: Misalignments of further seeds of each design, by key where the design has it.
ERRORS = {
    "misalignment.center_distance_mm": 0.05, "misalignment.vertical_deg": -0.04, "misalignment.horizontal_deg": 0.06,
}  # fmt: skip

OPTIONS = (
    "-std=gnu11", "-O1", "-g1", "-fno-omit-frame-pointer", "-ffp-contract=off", "-fno-math-errno", "-fopenmp-simd",
    "-Wno-unknown-pragmas",
)  # fmt: skip

#: Sanitizer: (flags of the compiler, whether gcc has it too).
SANITIZERS = {
    "address, undefined": (("-fsanitize=address,undefined", "-fno-sanitize-recover=all"), True),
    "memory": (("-fsanitize=memory", "-fno-sanitize-recover=all"), False),
    "thread": (("-fsanitize=thread",), True),
}
#: Left out of generated code, which is straight lines: there they find nothing and take ten times as long to compile.
STRAIGHT = ("-fno-sanitize=alignment,null,pointer-overflow,object-size",)

ENVIRONMENT = {
    "ASAN_OPTIONS": "detect_leaks=1:allocator_may_return_null=1", "UBSAN_OPTIONS": "print_stacktrace=1",
    "TSAN_OPTIONS": "halt_on_error=1",
}  # fmt: skip


def clang():
    """A clang with its sanitizers, or None."""
    for name in ("clang", *(f"clang-{version}" for version in range(21, 12, -1))):
        if (path := shutil.which(name)) and _links(path, "-fsanitize=fuzzer,address"):
            return path
    return None


def gcc():
    """A gcc with its sanitizers, or None."""
    path = shutil.which("gcc")
    return path if path and _links(path, "-fsanitize=address", main=True) else None


def _links(compiler, option, main=False):
    text = "int main(void) { return 0; }" if main else "int LLVMFuzzerTestOneInput(void) { return 0; }"
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "probe.c").write_text(text, encoding="utf-8")
        line = (compiler, option, f"{folder}/probe.c", "-o", f"{folder}/probe")
        return subprocess.run(line, capture_output=True).returncode == 0


def _array(name, values, kind="double"):
    shown = ", ".join(_number(v) if kind == "double" else str(int(v)) for v in np.ravel(values)) or "0"
    return f"static const {kind} {name}[] = {{ {shown} }};"


def _number(value):
    value = float(value)
    return "NAN" if value != value else ("-" if value < 0 else "") + "HUGE_VAL" if abs(value) == np.inf else value.hex()


def _seed(name, k, drive):
    """C text of a seed, and the line that lists it: parameters, a contact, a search for first contact."""
    m, own = drive.model, f"seed_{k}"
    result = drive.tca([0.05])
    x = result.solutions[0] if result.solved[0] else np.zeros(m.nx)
    lines = [
        _array(f"{own}_given", design.given_vector(drive.design)), _array(f"{own}_complete", drive.design.parameters),
        _array(f"{own}_x", x),
    ]  # fmt: skip
    edges = _edges(drive)
    lines += [_array(f"{own}_edge_{n}", start) for n, (_, _, start) in enumerate(edges)]
    if edges:
        entries = (f"{{ {{ {a}, {b} }}, {_number(at)}, {own}_edge_{n} }}" for n, ((a, b), at, _) in enumerate(edges))
        lines.append(f"static const edge_seed {own}_edges[] = {{ {', '.join(entries)} }};")
    proofs = _proofs(drive)
    for n, numbers in enumerate(proofs):
        lines.append(_array(f"{own}_proof_{n}", numbers))
    if proofs:
        named = ", ".join(f"{own}_proof_{n}" for n in range(len(proofs)))
        lines.append(f"static const double *const {own}_proofs[] = {{ {named} }};")
    found = _search(drive) if k % 2 == 0 else None
    if found is not None:
        lines += _first(own, *found)
    compiled = drive.design.description["name"]
    lines.append(f"int fuzz_alone_{compiled}(double *s, double phi, double *x, mw_info *info); /* {name} */")
    lines.append(f"int fuzz_casadi_{compiled}(int which, const double **arg, double **res, double *w);")
    lines.append(f"const mw_in_lanes *mw_in_lanes_{compiled}(void);")
    first, all_edges = f"&{own}_first" if found is not None else "NULL", f"{own}_edges" if edges else "NULL"
    listed = (
        f'{{ "{compiled}", {own}_given, {own}_complete, {own}_x, 0.05, fuzz_alone_{compiled}, fuzz_casadi_{compiled}, '
        f"mw_in_lanes_{compiled}, {first}, {all_edges}, {len(edges)}, {f'{own}_proofs' if proofs else 'NULL'}, "
        f"{len(proofs)} }},"
    )
    return lines, listed


def _edges(drive, most=4):
    """Up to ``most`` contacts of edges: ((margin of pinion, of wheel), angle, unknowns)."""
    m, lib, info, found = drive.model, library(), ffi.new("mw_info *"), []
    angles, sign = drive.pitch() * np.linspace(-1.5, 1.5, 13), drive.design.mirror.sign
    traced = drive.tca(angles)
    for margins in np.ndindex(m.bodies[0].margins + 1, m.bodies[1].margins + 1):
        margins = tuple(k - 1 for k in margins)
        edge = lib.mw_edge(m, *margins)
        for k in np.flatnonzero(traced.solved) if edge >= 0 and len(found) < most else ():
            x, s = traced.solutions[k].copy(), drive.state(sign * float(angles[k]))
            if lib.mw_edge_solve(m, edge, pointer(s), pointer(x), info) >= 0:
                found.append((margins, sign * float(angles[k]), x))
                break
    return found


def _proofs(drive, most=4):
    """Up to ``most`` contacts on both flanks, from one end of the path to the other: angle, slack and reach of a proof
    that they are the first, the eight ends of the flanks' parameters, unknowns.
    """
    angles, sign = drive.pitch() * np.linspace(-1.5, 1.5, 13), drive.design.mirror.sign
    traced = drive.tca(angles)
    good = [k for k in np.flatnonzero(traced.solved) if not traced.flags[k]]
    good = [good[k] for k in np.unique(np.linspace(0, len(good) - 1, most).round().astype(int))] if good else []
    if not good:
        return []
    boxes = certified_first.ranges(drive, traced.solutions[good], 0)
    ends = [end for box in boxes.values() for ends in box.values() for end in ends]
    slacks = certified_first.SLACK / certified_first.distances(drive, traced)
    reach = certified_first.REACH * abs(drive.ratio) * drive.pitch()
    each = [(sign * angles[k], slacks[k], reach, *ends, *traced.solutions[k]) for k in good]
    return [np.array(numbers) for numbers in each] if len(ends) == 8 else []


def _search(drive):
    """The arguments of a search for first contact over a coarse mesh; None where there is none."""
    cells, searched_flank.CELLS = searched_flank.CELLS, (3, 4)
    caught = []
    try:
        angles = np.array([0.05])
        solved = drive.tca(angles)
        search = Search.of(drive, angles, solved.solutions)[0]
        if search is None:
            return None
        table, start = search.flank.table, solved.solutions[0]
        pinion, wheel = _matrices(drive, np.linspace(0.0, 0.05, 2))
        begin = np.concatenate([start[b["unknowns"]] for b in drive.design.description["bodies"][::-1]])
        caught = [search, table, pinion, wheel, np.append(begin, start[drive.design.description["error"]])]
    finally:
        searched_flank.CELLS = cells
    return caught if np.isfinite(caught[4]).all() else None


def _first(own, search, table, pinion, wheel, start):
    (q, corner, open_, wheel_sizes, pinion_sizes), _ = search.flank.kept
    return [
        _array(f"{own}_q", q), _array(f"{own}_corner", corner, "int"), _array(f"{own}_open", open_, "unsigned char"),
        _array(f"{own}_wheel_sizes", wheel_sizes), _array(f"{own}_pinion_sizes", pinion_sizes),
        _array(f"{own}_pinion", pinion), _array(f"{own}_wheel", wheel), _array(f"{own}_start", start),
        f"static const first_seed {own}_first = {{ {{ {table.vertices}, {table.triangles}, {own}_q, {own}_corner, "
        f"{own}_open, {{ {table.span[0]}, {table.span[1]} }}, {own}_wheel_sizes, {own}_pinion_sizes }}, {own}_pinion, "
        f"{own}_wheel, {len(pinion)}, {_number(search.turn)}, {_number(search.sense)}, {own}_start }};",
    ]  # fmt: skip


def write_seeds(folder, designs=DESIGNS):
    """``seeds.h`` and ``drives.h`` of these packaged designs in ``folder``; the names of their drives."""
    lines, listed, names = [], [], []
    for name in designs:
        plain = Drive.load(name)
        known = {f"{p['table']}.{p['key']}" for p in plain.design.description["parameters"]}
        errors = {key.split(".")[1]: value for key, value in ERRORS.items() if key in known}
        for drive in (plain, plain.with_(misalignment=errors)):
            own, line = _seed(name, len(listed), drive)
            lines += own
            listed.append(line)
        names.append(plain.design.description["name"])
    names = sorted(set(names))
    text = SEEDS.format(arrays="\n".join(lines), listed="\n    ".join(listed))
    (folder / "seeds.h").write_text(text, encoding="utf-8")
    text = " ".join(f"X({name})" for name in names)
    (folder / "drives.h").write_text(f"#define MW_DRIVE_LIST(X) {text}\n", encoding="utf-8")
    return names


SEEDS = """/* Where the fuzzer begins. */
typedef struct first_seed {{
    mw_flank_mesh mesh;
    const double *pinion, *wheel;
    size_t steps;
    double turn, sense;
    const double *start;
}} first_seed;

/* The contact of an edge: the margins, of pinion and wheel, that are zero there. */
typedef struct edge_seed {{
    int margin[2];
    double phi;
    const double *x;
}} edge_seed;

typedef struct seed {{
    const char *drive;
    const double *given, *complete, *x;
    double phi;
    int (*solve)(double *s, double phi, double *x, mw_info *info);
    int (*entry)(int which, const double **arg, double **res, double *w);
    const mw_in_lanes *(*lanes)(void);
    const first_seed *first;
    const edge_seed *edges;
    int nedges;
    const double *const *proofs; /* contacts that may be first: angle, slack, reach, ends of the flanks [8], unknowns */
    int nproofs;
}} seed;

{arrays}

static const seed seeds[] = {{
    {listed}
}};
"""


def build(folder, compiler, flags, defines=(), designs=DESIGNS, link=()):
    """Compile the core library, the drives and the harness with these flags into ``folder/fuzz``; the path of it."""
    objects = _objects(folder, compiler, flags, designs)
    harness = _compiled(folder, compiler, flags, HERE / "interface.c", defines, "interface")
    return _linked(folder / "fuzz", compiler, (*flags, *link), (*objects, harness))


def build_both(folder, compiler, flags, defines, designs, led):
    """A harness for random bytes and, if ``led``, libFuzzer's: (path, path or None)."""
    traced = (*flags, "-fsanitize=fuzzer-no-link") if led else flags
    objects = _objects(folder, compiler, traced, designs)
    alone = _compiled(folder, compiler, traced, HERE / "interface.c", ("-DMW_FUZZ_ALONE", *defines), "random")
    random = _linked(folder / "fuzz", compiler, traced, (*objects, alone))
    if not led:
        return random, None
    every = (*flags, "-fsanitize=fuzzer")
    harness = _compiled(folder, compiler, every, HERE / "interface.c", defines, "led")
    return random, _linked(folder / "led", compiler, every, (*objects, harness))


def build_quickly(folder, compiler, built, design):
    """As :func:`build` for one drive, without sanitizers, of the objects in ``built`` that ``make build`` left."""
    folder.mkdir(parents=True, exist_ok=True)
    (name,) = write_seeds(folder, (design,))
    first, *others = DRIVE.units
    left = [path for path in built.glob("*.o") if path.name != "library.o"]
    left += [built / name / f"{Path(unit).stem}.o" for unit in others]
    apart = replace(DRIVE, units=(first,))
    own = [
        _compiled(folder, compiler, ("-O0",), SOURCE / "library.c", ('-DMW_DRIVES="drives.h"',), "library"),
        _compiled(folder, compiler, ("-O0",), HERE / "alone.c", (f"-DMW_DRIVE={name}",), "alone"),
        _compiled(folder, compiler, ("-O0",), HERE / "interface.c", ("-DMW_FUZZ_ALONE",), "interface"),
        # what is in objects of its own beside the drive's, and the unit that refers to it where all is linked together
        *(_compiled(folder, compiler, ("-O1",), *unit) for unit in _units(name, apart, IN_LANES, PROOFS)),
    ]
    return _linked(folder / "fuzz", compiler, (), (*own, *map(str, left)))


def _objects(folder, compiler, flags, designs):
    """Objects of the core library and of the drives, and what the harness says of them."""
    folder.mkdir(parents=True, exist_ok=True)
    names = write_seeds(folder, designs)
    units = [(unit, ('-DMW_DRIVES="drives.h"',), f"core_{unit.stem}") for unit in sorted(SOURCE.glob("*.c"))]
    straight = STRAIGHT if any("undefined" in flag for flag in flags) else ()
    for name in names:
        drive = (f"-DMW_DRIVE={name}", *straight)
        units += [(path, (*own, *straight), stem) for path, own, stem in _units(name, *PARTS)]
        units.append((HERE / "alone.c", drive, f"alone_{name}"))
    with ThreadPoolExecutor(2) as pool:
        return list(pool.map(lambda unit: _compiled(folder, compiler, flags, *unit), units))


def _units(drive, *parts):
    """Sources of objects of a drive, the macros they are compiled with, and names for what is made of them."""
    return [
        (SOURCE / unit, (f"-DMW_DRIVE={drive}", *part.defines), f"{drive}{part.ending}_{Path(unit).stem}")
        for part in parts
        for unit in part.units
    ]


def _compiled(folder, compiler, flags, path, own, stem):
    target = folder / f"{stem}.o"
    includes = (f"-I{folder}", f"-I{SOURCE}", f"-I{SOURCE / 'drive'}", f"-I{GENERATED}")
    line = (*compiler.split(), *OPTIONS, *flags, *includes, *own, "-c", str(path), "-o", str(target))
    done = subprocess.run(line, capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(f"{path} did not compile:\n{done.stderr}")
    return str(target)


def _linked(program, compiler, flags, objects):
    done = subprocess.run(
        (*compiler.split(), *flags, *objects, "-o", str(program), "-lm", "-lpthread"), capture_output=True, text=True
    )
    if done.returncode:
        raise RuntimeError(f"the fuzzer did not link:\n{done.stderr}")
    return program


def counted(text):
    """Calls and successes that runs report of themselves; several threads report one after the other."""
    found = re.findall(r"fuzz: (\d+) inputs, (\d+) calls, (\d+) successes", text)
    return {key: sum(int(row[k]) for row in found) for k, key in enumerate(("inputs", "calls", "successes"))}


def counted_by_kind(text):
    """Calls by what most of them are of, and of ``mw_certify_first`` alone, which others count among theirs."""
    found = Counter()
    for count, kind in re.findall(r"fuzz: (\d+) calls of (.+)", text):
        found[kind] += int(count)
    return found


def run(program, arguments, timeout):
    """(exit status, what the program wrote) of a fuzzer."""
    done = subprocess.run(
        (str(program), *map(str, arguments)), capture_output=True, text=True, errors="replace", timeout=timeout,
        env=os.environ | ENVIRONMENT, cwd=program.parent,
    )  # fmt: skip
    return done.returncode, done.stdout + done.stderr
