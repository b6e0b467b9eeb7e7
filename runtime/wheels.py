"""Wheels for the machines people have, all made on one: the package once, its C compiled for each by ``ziglang``.

``python runtime/wheels.py FOLDER [--target NAME …] [--drive NAME …]`` writes one wheel a target. What runs on no
machine at hand is checked by the symbols that its objects export; who made it says which were run.
"""

import argparse
import json
import runpy
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace

ROOT = Path(__file__).resolve().parent.parent


def _program(path):
    return SimpleNamespace(**runpy.run_path(str(ROOT / path)))


build = _program("runtime/meshwright/base/compile.py")

LINUX = build.Target(command=())
#: Position-independent code is Windows' only kind; a library is found by its name once it is loaded.
WINDOWS = build.Target(command=(), named=("-Wl,--export-all-symbols",), beside=("-Wl,--export-all-symbols",))
MACOS = build.Target(
    command=(),
    named=(f"-Wl,-install_name,@rpath/{build.CORE}",),
    beside=("-Wl,-rpath,@loader_path",),
)


@dataclass(frozen=True)
class Platform:
    """A machine: its name in the words of zig, the tag of its wheels (PEP 425, 600, 656), how its linker works."""

    zig: str
    tag: str
    linker: object

    def target(self):
        """The compiler for it; that a loop of lanes is not made of vectors there is no error."""
        command = (sys.executable, "-m", "ziglang", "cc", "-target", self.zig)
        quiet = ("-Wno-unused-command-line-argument", "-Wno-pass-failed")
        return build.Target(command, self.linker.named, self.linker.beside, quiet)


PLATFORMS = {
    "linux-x86_64": Platform("x86_64-linux-gnu.2.17", "manylinux_2_17_x86_64", LINUX),
    "linux-aarch64": Platform("aarch64-linux-gnu.2.17", "manylinux_2_17_aarch64", LINUX),
    "musl-x86_64": Platform("x86_64-linux-musl", "musllinux_1_2_x86_64", LINUX),
    "musl-aarch64": Platform("aarch64-linux-musl", "musllinux_1_2_aarch64", LINUX),
    "macos-arm64": Platform("aarch64-macos.11.0", "macosx_11_0_arm64", MACOS),
    "macos-x86_64": Platform("x86_64-macos.11.0", "macosx_11_0_x86_64", MACOS),
    "windows-x86_64": Platform("x86_64-windows-gnu", "win_amd64", WINDOWS),
}


def package(folder):
    """The package as ``make build`` has left it, as a wheel unpacked below ``folder``."""
    made = folder / "made"
    _run("-m", "pip", "wheel", "--no-deps", "--wheel-dir", made, "--config-settings", "libraries=built", ROOT)
    _run("-m", "wheel", "unpack", "--dest", folder / "unpacked", *made.glob("*.whl"))
    (place,) = (folder / "unpacked").iterdir()
    return place


def wheel(platform, unpacked, objects, out, drives):
    """Compile the C of an unpacked wheel for a platform and pack it again under the platform's tag; its path."""
    shipped = unpacked / "meshwright" / "_generated"
    for path in (*shipped.glob("*.so"), *shipped.glob("*.stamp")):
        path.unlink()
    target = platform.target()
    build.core(ROOT / "runtime" / "c", shipped, objects, target)
    build.drives(drives, shipped, shipped, objects, target)
    for path in (*shipped.glob("*.lib"), *shipped.glob("*.pdb")):  # beside a library of Windows; nobody links to these
        path.unlink()
    (description,) = unpacked.glob("*.dist-info/WHEEL")
    lines = description.read_text(encoding="utf-8").splitlines()
    kept = [line for line in lines if line and not line.startswith("Tag:")]
    description.write_text("\n".join([*kept, f"Tag: py3-none-{platform.tag}", ""]), encoding="utf-8")
    _run("-m", "wheel", "pack", "--dest-dir", out, unpacked)
    (packed,) = out.glob(f"*-{platform.tag}.whl")
    return packed


def _run(*words):
    done = subprocess.run([sys.executable, *map(str, words)], capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"{' '.join(map(str, words))}\n{done.stdout}{done.stderr}")


def main(arguments=None):
    """Exit status 0; what fails ends the program with its words."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path, metavar="FOLDER", help="where the wheels are written")
    parser.add_argument("--target", action="append", choices=PLATFORMS, help="default: all")
    parser.add_argument("--drive", action="append", help="ship these drives only; default: those of packaged designs")
    options = parser.parse_args(arguments)
    families = json.loads((ROOT / "generated" / "families.json").read_text(encoding="utf-8"))
    drives = options.drive or _program("derive/packaged.py").packaged(families)
    options.out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        unpacked = package(Path(folder))
        for name in options.target or PLATFORMS:
            copy = Path(folder) / name / unpacked.name
            shutil.copytree(unpacked, copy)
            print(wheel(PLATFORMS[name], copy, ROOT / "build" / "wheels" / name, options.out, drives), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
