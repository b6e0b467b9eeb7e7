"""A drive as a package of another language: a crate of Rust, or an ES module that holds WebAssembly.

Both have the drive's own header and one C file, which knows the design and nothing else; their results have the native
bits.
"""

import math
import re
from pathlib import Path

from meshwright.base.errors import UsageError
from meshwright.base.files import write_bytes
from meshwright.contact.analysis import statuses

TEMPLATES = Path(__file__).parent / "templates"

#: What both registries take for a name.
_NAME = re.compile(r"[a-z][a-z0-9_-]*")


def crate(drive, coast, folder):
    """Write a crate of a drive, and of the drive of its other flank or None, into a new folder."""
    name = _name(folder, "--crate")
    files = {
        "Cargo.toml": filled("Cargo.toml", name=name, said=said(drive)),
        "build.rs": filled("build.rs"),
        "src/lib.rs": filled("lib.rs", said=said(drive)),
        "examples/follow.rs": filled("follow.rs", crate=name.replace("-", "_")),
        f"c/{prefix(drive)}.h": header(drive),
        "c/mesh.c": source(drive, coast),
    }
    _write(folder, files)


def npm(drive, coast, folder):
    """Write an npm package likewise; raises :class:`~meshwright.base.errors.UsageError` without a compiler for it."""
    from meshwright.live.module import to_wasm

    name, text = _name(folder, "--npm"), source(drive, coast)
    exports = ("mesh_begin", "mesh_follow", "mesh_cycle", "mesh_memory", "mesh_result")
    words = ", ".join(f'"{code}": "{word}"' for code, word in statuses().items())
    files = {
        "package.json": filled("package.json", name=name, said=said(drive)),
        "index.js": filled("index.js", words=words),
        "index.d.ts": filled("index.d.ts"),
        "example.mjs": filled("example.mjs"),
        "mesh.wasm": to_wasm(text, exports, drive.design.description["folder"]),
    }
    _write(folder, files)


def source(drive, coast):
    """The C file of a package: the design's parameters, and calls that pass plain numbers."""
    other = drive.design if coast is None else coast.design
    return filled(
        "mesh.c",
        said=said(drive),
        drive=prefix(drive),
        sign=drive.design.mirror.sign,
        driven=numbers(drive.design.parameters),
        coasting=numbers(other.parameters),
        coast=int(coast is not None),
    )


def prefix(drive):
    """Of the drive's C names."""
    return drive.design.description["prefix"]


def header(drive):
    """The text of the drive's own header."""
    folder = Path(drive.design.description["folder"])
    return (folder / "include" / f"{prefix(drive)}.h").read_text(encoding="utf-8")


def said(drive):
    """The design in words that no language takes for its own."""
    return re.sub(r'[*"\\]', "", drive.design.label)


def numbers(values):
    """Numbers as C has them, NAN for one that is none."""
    return ", ".join(repr(float(value)) if math.isfinite(value) else "NAN" for value in values)


def filled(template, **values):
    """The text of a template with the values in their places."""
    text = (TEMPLATES / template).read_text(encoding="utf-8")
    for name, value in values.items():
        text = text.replace(f"@{name}@", str(value))
    return text


def _name(folder, option):
    name = Path(folder).name
    if not _NAME.fullmatch(name):
        raise UsageError(f"{option} {folder}: the folder names the package; use small letters, digits, - and _ alone")
    if Path(folder).exists() and (not Path(folder).is_dir() or any(Path(folder).iterdir())):
        raise UsageError(f"{option} {folder}: is there already; name a new folder or an empty one")
    return name


def _write(folder, files):
    for name, content in files.items():
        path = Path(folder) / name
        path.parent.mkdir(parents=True, exist_ok=True)
        write_bytes(str(path), content if isinstance(content, bytes) else content.encode())
