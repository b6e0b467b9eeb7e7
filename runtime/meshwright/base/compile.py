"""Compile the core library, which knows no drive, and the object of each drive. Needs the standard library alone.

As a program, ``python compile.py GENERATED FOLDER DRIVE…``: what a checkout and the wheel are built by. ``FOLDER`` is
then a folder of drives, in this form::

    <drive>.json, <drive>.casadi …          description, CasADi functions
    include/<drive>.h, _lanes.h, …          generated C
    <drive>.so, <drive>.stamp               shared object, and from what it was made
    <drive>_in_lanes.so, …                  many designs or angles at once (:data:`IN_LANES`)
    <drive>_proofs.so, …                    many proofs of contact at once (:data:`PROOFS`)

Each object may be missing: it is then compiled when it is first asked for (:mod:`meshwright.base.first_use`). The
package's own folder holds beside that the table of families, the core library, its headers and, in ``source/``, what
each drive is compiled from.
"""

import argparse
import hashlib
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path

CORE = "libmeshwright.so"


@dataclass(frozen=True)
class Part:
    """A shared object of a drive.

    ending:  of its file's name, after the drive's
    units:   translation units, relative to runtime/c
    lanes:   generated headers that its lanes include, as :data:`GENERATED` has them
    defines: macros with which they are compiled, beside the drive's name
    """

    ending: str
    units: tuple[str, ...]
    lanes: tuple[str, ...]
    defines: tuple[str, ...] = ()

    def reads(self, unit):
        """The generated headers that a unit includes, by names that its macros make."""
        return READS.get(unit, self.lanes)


#: Generated headers of a drive.
GENERATED = ("{}.h", "{}_lanes.h", "{}_sensitivity.h", "{}_bounded.h", "{}_certified.h", "{}_certify.h")
#: Units of a drive's objects that are no lanes → the generated headers that they include.
READS = {
    "drive/drive.c": ("{}.h",),
    "drive/bounded.c": ("{}.h", "{}_bounded.h"),
    "drive/tangents.c": ("{}.h", "{}_sensitivity.h"),
    "drive/certified.c": ("{}_certified.h",),
    "drive/enclosing.c": ("{}_certify.h",),
    "drive/in_lanes.c": (),
    "drive/proofs.c": (),
}
LANES = ("lanes_native.c", "lanes_avx2.c", "lanes_avx512.c")
#: The drive itself: all that one design asks for.
DRIVE = Part("", ("drive/drive.c", "drive/bounded.c", "drive/tangents.c", "drive/certified.c"), ())
#: Its equations in lanes, and its equations with error bounds: few ask for these, which take longer than all else.
IN_LANES = Part("_in_lanes", ("drive/in_lanes.c", *LANES), ("{}.h", "{}_lanes.h"))
PROOFS = Part("_proofs", ("drive/proofs.c", "drive/enclosing.c", *LANES), ("{}_certify.h",), ("-DMW_PROOFS",))
PARTS = (DRIVE, IN_LANES, PROOFS)
#: What the units need beside the drive's own headers: relative to runtime/c.
DRIVE_HEADERS = (
    "drive/names.h", "drive/parts.h", "drive/casadi.h", "drive/lanes.h", "drive/proven.h", "kernels.h",
    "lane_kernels.h", "mw_certified.h", "exact.h",
)  # fmt: skip
SOURCES = (*dict.fromkeys(unit for part in PARTS for unit in part.units), *DRIVE_HEADERS)
#: What the live page's module is compiled from beside a drive's own header: relative to runtime/c.
LIVE_SOURCES = ("exact.h",)
#: What a device traces samples by beside a drive's own header: relative to runtime/c.
DEVICE_SOURCES = ("drive/device.h",)
#: What programs include; generated headers repeat the parts of the solver.
SOLVER = (
    "basics", "steps", "linear", "newton", "complete", "contact", "touch", "reduce", "warm", "refine", "start",
    "arclength", "branch", "search", "choice", "cold", "follow", "cycle", "self_test",
)  # fmt: skip
PUBLIC_HEADERS = (
    "meshwright.h", "mw_device.h", "mw_arithmetic.h", "mw_model.h", "mw_status.h", "mw_enclosures.h", "mw_certify.h",
    *(f"solver/{part}.h" for part in SOLVER),
)  # fmt: skip
#: What generated headers repeat beside these.
REPEATED = (
    "circular.h", "certify/ball.h", "certify/wide.h", "certify/units.h", "certify/lane.h", "certify/point.h",
)  # fmt: skip

#: Functions begin on a cache line: where one falls else, the widest lanes of some drives are at half their speed.
FLAGS = (
    "-std=c99", "-O3", "-falign-functions=64", "-ffp-contract=off", "-fno-math-errno", "-fno-trapping-math",
    "-fopenmp-simd", "-fPIC", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror",
)  # fmt: skip


class CompileError(RuntimeError):
    """There is no C compiler, or it refused a source."""


def compiler():
    """Command of the C compiler: ``CC``, else the system's, else clang from its Python package."""
    if named := os.environ.get("CC"):
        return tuple(shlex.split(named))
    for name in ("cc", "gcc", "clang"):
        if path := shutil.which(name):
            return (path,)
    probe = subprocess.run([sys.executable, "-c", "import ziglang"], capture_output=True)
    if probe.returncode == 0:
        return (sys.executable, "-m", "ziglang", "cc")
    raise CompileError("there is no C compiler: install gcc or clang, or `pip install ziglang`, or name one in CC")


@dataclass(frozen=True)
class Target:
    """What compiles for a machine, and how its linker is told where a shared object finds the core library.

    command:       the C compiler, as the words of a command
    named:         link options that name the core library to those who use it
    beside:        link options by which a drive's object finds the core library in its own folder
    more:          compile options of this machine
    """

    command: tuple[str, ...]
    named: tuple[str, ...] = (f"-Wl,-soname,{CORE}",)
    beside: tuple[str, ...] = ("-Wl,-rpath,$ORIGIN",)
    more: tuple[str, ...] = ()


def native():
    """This machine."""
    return Target(compiler())


def digest(*parts):
    """SHA-256 of texts and files, each by its length and content."""
    sum_ = hashlib.sha256()
    for part in parts:
        content = part.read_bytes() if isinstance(part, Path) else str(part).encode()
        sum_.update(b"%d:" % len(content))
        sum_.update(content)
    return sum_.hexdigest()


@contextmanager
def replaced(path):
    """An empty file of the same name in a folder beside ``path``; takes its place at the end, unless there is an error.

    The name is the same because a linker may write it into what it makes: a library of Windows is known by it.
    """
    with tempfile.TemporaryDirectory(dir=path.parent, prefix=f".{path.name}.") as folder:
        temporary = Path(folder) / path.name
        temporary.touch()
        yield temporary
        os.chmod(temporary, 0o755 if path.suffix == ".so" else 0o644)
        os.replace(temporary, path)


def _run(command, what):
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    if done.returncode:
        raise CompileError(f"{what} did not compile: {shlex.join(map(str, command))}\n{done.stderr.strip()}")


def _reached(source, folders):
    """The files that a C source includes by name, itself first; names made by macros are not followed."""
    found, open_ = {}, [source]
    while open_:
        path = open_.pop()
        if path in found:
            continue
        found[path] = None
        for name in re.findall(r'^\s*#\s*include\s+"([^"]+)"', path.read_text(encoding="utf-8"), re.MULTILINE):
            places = (folder / name for folder in (path.parent, *folders))
            open_ += [place for place in places if place.exists()][:1]
    return list(found)


def _object(command, source, target, folders, defines, more):
    """Compile one translation unit, unless its object was made from the same text by the same command."""
    line = (*command, *FLAGS, *(f"-I{folder}" for folder in folders), *defines, "-c", source)
    key, stamp = digest(*line, *_reached(source, folders), *more), target.with_suffix(".key")
    if not (target.exists() and stamp.exists() and stamp.read_text() == key):
        target.parent.mkdir(parents=True, exist_ok=True)
        with replaced(target) as temporary:
            _run((*line, "-o", temporary), source)
        stamp.write_text(key)
    return target, key


def _pool():
    """As many workers as there are processors."""
    return ThreadPoolExecutor(len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else 2)


def _compiled(jobs):
    """The objects of many units (arguments of :func:`_object`), as many at once as there are processors."""
    with _pool() as pool:
        return list(pool.map(lambda job: _object(*job), jobs))


def _linked(command, compiled, target, options=(), inputs=""):
    """Link a shared object beside its stamp: digests of what it was made from and how, and its own."""
    objects, keys = zip(*compiled, strict=True)
    key, stamp = digest(*command, *options, *keys), target.with_suffix(".stamp")
    if sealed(target).get("key") != key:
        with replaced(target) as temporary:
            _run((*command, "-shared", *objects, "-o", temporary, *options, "-lm"), target.name)
            seal = json.dumps({"key": key, "inputs": inputs, "sha256": digest(temporary)})
        with replaced(stamp) as temporary:
            temporary.write_text(seal + "\n")
    return target


def sealed(target):
    """The stamp of a shared object if the object is the one that was written, whole; else nothing."""
    try:
        stamp = json.loads(target.with_suffix(".stamp").read_text(encoding="utf-8"))
        return stamp if stamp["sha256"] == digest(target) else {}
    except (OSError, ValueError, KeyError, TypeError):
        return {}


def core(source, folder, objects, target=None):
    """Compile the core library from ``source`` (runtime/c) into ``folder``, and copy what drives are compiled from."""
    target = target or native()
    folder.mkdir(parents=True, exist_ok=True)
    sources = (*SOURCES, *LIVE_SOURCES, *DEVICE_SOURCES)
    for names, place in (((*PUBLIC_HEADERS, *REPEATED), "include"), (sources, "source")):
        for name in names:
            _copy(source / name, folder / place / name)
    command = (*target.command, *target.more)
    jobs = [(command, unit, objects / f"{unit.stem}.o", (source,), (), ()) for unit in sorted(source.glob("*.c"))]
    return _linked(target.command, _compiled(jobs), folder / CORE, target.named)


def drives(names, folder, package, objects, target=None, parts=PARTS):
    """Compile objects of drives whose generated headers are in ``folder``; ``package`` holds the core library.

    Each finds the core library where it is now, or beside itself.
    """
    target = target or native()
    made = [(name, part) for name in names for part in parts]
    jobs = [_job(unit, part, name, folder, package, objects, target) for name, part in made for unit in part.units]
    compiled = iter(_compiled(jobs))
    options = (str(package / CORE), *target.beside)
    if folder.resolve() != package.resolve():
        options += (f"-Wl,-rpath,{package.resolve()}",)
    for name, part in made:
        units = [next(compiled) for _ in part.units]
        path = folder / f"{name}{part.ending}.so"
        _linked(target.command, units, path, options, inputs(name, folder, package))


def _job(unit, part, name, folder, package, objects, target):
    """Arguments of :func:`_object` for a unit of a part of a drive."""
    source = package / "source"
    folders = (folder / "include", source, package / "include")
    read = [folder / "include" / pattern.format(name) for pattern in part.reads(unit)]
    made = objects / f"{name}{part.ending}" / f"{Path(unit).stem}.o"
    command = (*target.command, *target.more)
    return command, source / unit, made, folders, (f"-DMW_DRIVE={name}", "-DMW_APART", *part.defines), read


class Begun:
    """A drive's object, whose units begin to compile as soon as the generated headers that they include are written.

    :func:`drives` with the same arguments finds their objects; what does not compile is its to say.
    """

    def __init__(self, name, folder, package, objects, part=DRIVE):
        of = {"name": name, "folder": folder, "package": package, "objects": objects}
        self._job = partial(_job, part=part, target=native(), **of)
        self._waiting = {u: {pattern.format(name) for pattern in part.reads(u)} for u in part.units}
        self._pool, self._written = _pool(), set()

    def __enter__(self):
        return self

    def written(self, header):
        """Say that a generated header is in its place."""
        self._written.add(header)
        for unit in [unit for unit, read in self._waiting.items() if read <= self._written]:
            del self._waiting[unit]
            self._pool.submit(_object, *self._job(unit))

    def wait(self):
        """Return when everything that has begun is made."""
        self._pool.shutdown()

    def __exit__(self, kind, error, traceback):
        self._pool.shutdown(cancel_futures=kind is not None)


def moved(name, folder, place, part=DRIVE):
    """Put a shared object that was made in ``folder`` into another folder of drives, its stamp last."""
    made = folder / f"{name}{part.ending}.so"
    for path in (made, made.with_suffix(".stamp")):
        _copy(path, place / path.name)


def inputs(name, folder, package):
    """Digest of the sources of a drive's objects and of the place of the core library, whatever compiles them."""
    return digest(str(package.resolve()), *FLAGS, *shared(package), *headers(name, folder))


def drop_superseded(names, folder, package):
    """Remove objects of drives that were made from other sources than those of today."""
    for name in names:
        wanted = inputs(name, folder, package)
        for path in (folder / f"{name}{part.ending}.so" for part in PARTS):
            if path.exists() and sealed(path).get("inputs") != wanted:
                path.unlink()
                path.with_suffix(".stamp").unlink(missing_ok=True)


def shared(package):
    """What every drive's object is compiled from beside its own headers."""
    sources = (package / "source" / name for name in SOURCES)
    return [*sources, *(package / "include" / header for header in PUBLIC_HEADERS)]


def headers(name, folder):
    """The generated headers of a drive in a folder of drives."""
    return [folder / "include" / pattern.format(name) for pattern in GENERATED]


def _copy(source, target):
    """Copy a file, atomically; one that is equal keeps its time."""
    content = source.read_bytes()
    if target.exists() and target.read_bytes() == content:
        return
    target.parent.mkdir(parents=True, exist_ok=True)
    with replaced(target) as temporary:
        temporary.write_bytes(content)


def ahead(names, generated, folder, objects):
    """Compile those units of drives that include one generated header, where it is there; :func:`drives` finds them.

    Two headers may be of different runs of derive as long as not all have been made.
    """
    target, jobs = native(), []
    for name, unit in ((name, unit) for name in names for unit in DRIVE.units):
        job = _job(unit, DRIVE, name, folder, folder, objects, target)
        *others, header = job[-1]
        if not others and (generated / "c" / header.name).exists():
            _copy(generated / "c" / header.name, header)
            jobs.append(job)
    _compiled(jobs)


def take(names, generated, folder):
    """Copy the generated files of drives from ``generated`` (c/, casadi/) into a folder of drives."""
    for name in names:
        for header in headers(name, folder):
            _copy(generated / "c" / header.name, header)
        _copy(generated / "c" / f"{name}.json", folder / f"{name}.json")
        description = json.loads((generated / "c" / f"{name}.json").read_text(encoding="utf-8"))
        functions = [*(system["name"] for system in description["systems"]), "surfaces"]
        for function in (name, *(f"{name}_{part}" for part in functions + ["edges"] * bool(description["edges"]))):
            _copy(generated / "casadi" / f"{function}.casadi", folder / f"{function}.casadi")


def main(arguments=None):
    """Exit status 0, or 2 if something does not compile."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("generated", type=Path, help="generated files: c/, casadi/")
    parser.add_argument("folder", type=Path, help="folder of drives to write")
    parser.add_argument("drive", nargs="*", help="drives that the folder holds")
    parser.add_argument("--objects", type=Path, required=True, help="folder for object files")
    parser.add_argument("--now", nargs="*", metavar="DRIVE", help="compile these only; default: all that it holds")
    parser.add_argument("--whole", action="store_true", help="compile also what solves and proves many at once")
    parser.add_argument("--ahead", action="store_true", help="only what needs one generated header that is there")
    options = parser.parse_args(arguments)
    source = Path(__file__).resolve().parents[2] / "c"
    try:
        core(source, options.folder, options.objects)
        now = options.drive if options.now is None else options.now
        if options.ahead:
            ahead(now, options.generated, options.folder, options.objects)
            return 0
        take(options.drive, options.generated, options.folder)
        _copy(options.generated / "families.json", options.folder / "families.json")
        drop_superseded(options.drive, options.folder, options.folder)
        parts = PARTS if options.whole else (DRIVE,)
        drives(now, options.folder, options.folder, options.objects, parts=parts)
    except (CompileError, OSError) as error:
        print(error, file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
