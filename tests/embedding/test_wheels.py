"""Wheels of all machines: tags, exported symbols, and the same bits wherever there is something that runs them.

Slow: run by ``make wheels-run`` on what ``make wheels`` has written, in ``dist`` or the folder of MESHWRIGHT_WHEELS.
"""

import os
import platform
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from tests.embedding import compile as c

pytestmark = pytest.mark.slow

WHEELS = Path(os.environ.get("MESHWRIGHT_WHEELS", c.ROOT / "dist"))
DRIVE = "cylindrical_worm_zn_zn"
CORE, HEADERS = "libmeshwright.so", ("mw_certify.h", "meshwright.h")
COMMAND = ("tca", "recess-action-full", "--phi-deg", "0:2000:100", "--json", "-")

#: Of every platform, by the tag of its wheel: the compiler's name, kind of file, processor.
PLATFORMS = {
    "manylinux_2_17_x86_64": ("x86_64-linux-gnu.2.17", "ELF", "X86_64"),
    "manylinux_2_17_aarch64": ("aarch64-linux-gnu.2.17", "ELF", "AARCH64"),
    "musllinux_1_2_x86_64": ("x86_64-linux-musl", "ELF", "X86_64"),
    "musllinux_1_2_aarch64": ("aarch64-linux-musl", "ELF", "AARCH64"),
    "macosx_11_0_arm64": ("aarch64-macos.11.0", "Mach-O", "ARM64"),
    "macosx_11_0_x86_64": ("x86_64-macos.11.0", "Mach-O", "X86_64"),
    "win_amd64": ("x86_64-windows-gnu", "PE", "AMD64"),
}

#: Packages that make up a Linux of the other processor on which Python runs, and a C library that is not GNU's.
LINUX = (
    "libc6", "zlib1g", "libexpat1", "libffi8", "libgcc-s1", "libstdc++6", "libbz2-1.0", "liblzma5", "libssl3",
    "libcrypt1", "libuuid1", "musl", "python3.11-minimal", "libpython3.11-minimal", "libpython3.11-stdlib",
)  # fmt: skip


def wheel(tag):
    """The wheel of a platform."""
    paths = sorted(WHEELS.glob(f"meshwright-*-{tag}.whl"))
    assert len(paths) == 1, f"{len(paths)} wheels {tag} in {WHEELS}: make wheels writes them"
    return paths[0]


@pytest.fixture(scope="module")
def unpacked(tmp_path_factory):
    """Function of a tag: the folder that its wheel is unpacked to."""
    folder, done = tmp_path_factory.mktemp("unpacked"), {}

    def of(tag):
        if tag not in done:
            done[tag] = folder / tag
            with zipfile.ZipFile(wheel(tag)) as archive:
                archive.extractall(done[tag])
        return done[tag]

    return of


@pytest.fixture(scope="module")
def arm64():
    """Root of a Linux on ARM64, of packages of the system's archive, kept below .venv; what is missing skips."""
    emulator = shutil.which("qemu-aarch64-static")
    if not emulator or not shutil.which("apt-get"):
        pytest.skip("no emulator of ARM64, or no archive to take a Linux for it from")
    root = Path(sys.prefix) / "arm64"
    if not (root / "complete").exists():
        lists, debs = root / "lists", root / "debs"
        (lists / "partial").mkdir(parents=True, exist_ok=True)
        debs.mkdir(exist_ok=True)
        settings = ("APT::Architectures::=arm64", f"Dir::State::lists={lists}", "Dir::Cache::pkgcache=",
                    "Dir::Cache::srcpkgcache=", "APT::Sandbox::User=root")  # fmt: skip
        options = ["-qq", *(word for setting in settings for word in ("-o", setting))]
        for words in (["update"], ["download", *(f"{name}:arm64" for name in LINUX)]):
            if subprocess.run(["apt-get", *options, *words], cwd=debs, capture_output=True).returncode:
                pytest.skip("the packages of a Linux on ARM64 cannot be had here")
        for package in debs.glob("*.deb"):
            c.run("dpkg-deb", "-x", package, root)
        (root / "complete").touch()
    return emulator, root


@pytest.mark.parametrize("tag", PLATFORMS)
def test_a_wheel_has_the_tag_of_its_machine_inside_as_outside(unpacked, tag):
    (description,) = unpacked(tag).glob("*.dist-info/WHEEL")
    assert re.findall(r"^Tag: (.*)$", description.read_text(), re.MULTILINE) == [f"py3-none-{tag}"]


def exported(lief, path):
    """(kind of file, processor, names of the functions that a shared library offers)."""
    library = lief.parse(str(path))
    names = {function.name for function in library.exported_functions}
    if isinstance(library, lief.MachO.Binary):
        return "Mach-O", library.header.cpu_type.name, {name.removeprefix("_") for name in names}
    if isinstance(library, lief.PE.Binary):
        return "PE", library.header.machine.name, {entry.name for entry in library.get_export().entries}
    return "ELF", library.header.machine_type.name, names


@pytest.mark.parametrize("tag", PLATFORMS)
def test_the_libraries_of_a_wheel_export_all_that_the_package_calls(unpacked, tag):
    """Every function that the wheel's headers declare for the package by the core, its table by the drive; a library of
    Windows asks for the core by its name.
    """
    lief = pytest.importorskip("lief")
    folder = unpacked(tag) / "meshwright" / "_generated"
    headers = [(folder / "include" / name).read_text(encoding="utf-8") for name in HEADERS]
    declared = "".join(re.search(r"BEGIN INTERFACE.*?\*/(.*)END INTERFACE", text, re.DOTALL)[1] for text in headers)
    names = set(re.findall(r"^[\w *]*\b(mw_\w+)\(", declared, re.MULTILINE))
    kind, processor, offered = exported(lief, folder / CORE)
    assert (kind, processor) == PLATFORMS[tag][1:]
    assert names and names <= offered
    for ending in ("", "_in_lanes", "_proofs"):
        name = f"mw{ending or '_drive'}_{DRIVE}"
        kind, processor, offered = exported(lief, folder / f"{DRIVE}{ending}.so")
        assert (kind, processor) == PLATFORMS[tag][1:]
        assert name in offered
    if kind == "PE":
        library = lief.parse(str(folder / f"{DRIVE}.so"))
        assert CORE in {entry.name for entry in library.imports}


def program(tag, unpacked, folder):
    """The C program that loads the libraries of a wheel, compiled for its machine."""
    output = folder / ("loaded.exe" if tag.startswith("win") else "loaded")
    include = unpacked(tag) / "meshwright" / "_generated" / "include"
    # a shared C library, which loads others, is not zig's choice for musl
    dynamic = ("-dynamic",) if "musl" in tag else ()
    c.run(*c.CLANG, "cc", "-target", PLATFORMS[tag][0], *dynamic, "-O1", *c.EXACT, f'-DCORE="{CORE}"', f"-I{include}",
          Path(__file__).with_name("loaded.c"), "-o", output)  # fmt: skip
    return output


def bits(tag, unpacked, folder, *runner, **environment):
    """What the program prints when ``runner`` runs it."""
    made = program(tag, unpacked, folder)
    libraries = str(unpacked(tag) / "meshwright" / "_generated")
    if tag.startswith("win"):
        libraries = "Z:" + libraries.replace("/", "\\")
    done = subprocess.run([*runner, made, libraries], capture_output=True, text=True, env={**os.environ, **environment})
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout.split()


@pytest.fixture(scope="module")
def native():
    """Bits of the same trace by the library of this checkout."""
    import numpy as np

    from meshwright import Drive

    angles = np.array([100.0 * (3.141592653589793 / 180.0) * k for k in range(21)])
    drive = Drive.load("recess-action-full")
    return [f"{word:016x}" for word in drive.tca(angles).solutions.astype("<f8").view("<u8").ravel()]


def test_the_wheel_of_this_machine_is_installed_and_runs(tmp_path):
    tag = f"manylinux_2_17_{platform.machine()}"
    c.run(sys.executable, "-m", "pip", "install", "--quiet", "--target", tmp_path / "site", wheel(tag))
    told = c.run(sys.executable, "-m", "meshwright", *COMMAND, env={**os.environ, "PYTHONPATH": str(tmp_path / "site")},
                 cwd=tmp_path)  # fmt: skip
    assert told == c.run(sys.executable, "-m", "meshwright", *COMMAND)


def test_the_wheel_of_arm64_is_installed_and_runs_in_an_emulated_python(tmp_path, arm64):
    """Python itself, NumPy and the libraries of the wheel, all of the other processor."""
    emulator, root = arm64
    platforms = [f"--platform=manylinux_2_{k}_aarch64" for k in (17, 28)]
    c.run(sys.executable, "-m", "pip", "install", "--quiet", *platforms, "--python-version=3.11", "--implementation=cp",
          "--only-binary=:all:", "--target", tmp_path / "site", wheel("manylinux_2_17_aarch64"))  # fmt: skip
    environment = {"QEMU_LD_PREFIX": str(root), "PYTHONHOME": str(root / "usr"), "PYTHONPATH": str(tmp_path / "site")}
    told = c.run(emulator, root / "usr/bin/python3.11", "-m", "meshwright", *COMMAND, cwd=tmp_path,
                 env={**os.environ, **environment})  # fmt: skip
    assert told == c.run(sys.executable, "-m", "meshwright", *COMMAND)


def test_libraries_for_musl_give_the_native_bits(tmp_path, unpacked, native):
    loader = Path(f"/lib/ld-musl-{platform.machine()}.so.1")
    if not loader.exists():
        pytest.skip("musl is not installed")
    assert bits(f"musllinux_1_2_{platform.machine()}", unpacked, tmp_path) == native


def test_libraries_for_musl_on_arm64_give_the_native_bits(tmp_path, unpacked, native, arm64):
    emulator, root = arm64
    assert bits("musllinux_1_2_aarch64", unpacked, tmp_path, emulator, "-L", root) == native


def test_libraries_for_windows_give_the_native_bits(tmp_path, unpacked, native):
    wine = shutil.which("wine64") or shutil.which("wine")
    if not wine:
        pytest.skip("Wine is not installed")
    prefix = {"WINEPREFIX": str(tmp_path / "prefix"), "WINEDEBUG": "-all", "DISPLAY": ""}
    assert bits("win_amd64", unpacked, tmp_path, wine, **prefix) == native
