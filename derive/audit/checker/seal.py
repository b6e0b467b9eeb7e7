"""The seal of all generated files, and what headers rest on."""

import hashlib
import json
import re
from pathlib import Path

from .lines import read_file, read_json
from .refusal import Rejected, require
from .verdicts import is_proved

#: Folders that other commands make from what is sealed: pages, certified results.
MADE_BESIDE = ("site", "benchmark")


#: Characters of a verdict's hash by which a header names it.
KEY = 16
FUNCTION = re.compile(r"/\* Equations: ([^*]*(?:\*[^/][^*]*)*)\. \*/")


def equations_named(text: str) -> dict[str, str]:
    """Equation id -> key, in the comment at the top of a generated header."""
    head = text.partition("*/")[0].partition(" * Equations, each")[2].partition(" * Open statements")[0]
    lines = [line.strip(" *").split() for line in head.splitlines()[1:] if line.strip(" *")]
    require(all(len(words) == 2 for words in lines), "a header's list of equations has a line of another form")
    return dict(lines)


def equations_of_functions(text: str) -> set[str]:
    """The equation ids that the comments of a header's functions name."""
    return {key.strip(" *\n") for named in FUNCTION.findall(text) for key in named.split(",")}


def check_files(folder: Path, root: str, objects: dict[str, dict]) -> int:
    """The seal names every generated file and no other; each is unchanged and rests on proved statements."""
    seal_text = read_file(folder / "artifacts.json")
    try:
        seal = read_json(seal_text)
    except ValueError as error:
        raise Rejected(f"artifacts.json cannot be read: {error}") from error
    require(seal_text == json.dumps(seal, indent=1, sort_keys=True) + "\n", "artifacts.json is not canonical")
    require(set(seal) == {"root", "files"} and seal["root"] == root, "artifacts.json carries another root hash")
    verdicts = [item for item in objects.values() if item["object"] == "verdict"]
    proved = {item["id"]: item["sha256"][:KEY] for item in verdicts if is_proved(item, objects)}
    files = [path.relative_to(folder.parent) for path in folder.parent.rglob("*") if path.is_file()]
    there = {p.as_posix() for p in files if p.parts[0] not in MADE_BESIDE and p.parent.name != "__pycache__"}
    there -= {f"{folder.name}/artifacts.json", "manifest.json"}
    for name in sorted(there ^ set(seal["files"])):
        raise Rejected(f"{name} is {'not sealed' if name in there else 'missing'}")
    for name, expected in seal["files"].items():
        data = (folder.parent / name).read_bytes()
        require(set(expected) == {"sha256", "equations"}, f"{name}: not the keys of a seal")
        require(hashlib.sha256(data).hexdigest() == expected["sha256"], f"{name} has been changed")
        text = data.decode("utf-8") if name.endswith(".h") else ""
        named = equations_named(text)
        require(named == expected["equations"], f"{name} names other equations than its seal")
        require(named or b"_setup(const double" not in data or not name.endswith(".h"), f"{name} names no equation")
        for equation, key in named.items():
            require(equation in proved, f"{name} rests on {equation}, which is not a proved statement of the record")
            require(key == proved[equation], f"{name} rests on another {equation} than that of the record")
        for equation in sorted(equations_of_functions(text) - named.keys()):
            raise Rejected(f"{name}: a function rests on {equation}, which the header does not list")
    check_manifest(folder, seal)
    return len(seal["files"])


def check_manifest(folder: Path, seal: dict) -> None:
    """The list of all files beside the record, where there is one."""
    path = folder.parent / "manifest.json"
    if path.is_file():
        expected = {name: entry["sha256"] for name, entry in seal["files"].items()}
        expected[f"{folder.name}/artifacts.json"] = hashlib.sha256((folder / "artifacts.json").read_bytes()).hexdigest()
        require(read_json(read_file(path)).get("files") == expected, "manifest.json lists other files than the seal")
