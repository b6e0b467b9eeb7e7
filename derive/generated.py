"""The folder of generated files: what a run replaces in it, adds to it and removes from it, by its manifest."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path

from derive import compiler
from derive.files import remove_parts, replace_text
from derive.refusals import Refused

MANIFEST = "manifest.json"


def replace(folder: Path, files: Mapping[str, str]) -> None:
    """Write all generated files, and remove what an earlier run wrote and this one does not."""
    for path in _written(folder).keys() - files.keys():
        (folder / path).unlink(missing_ok=True)
    remove_parts(folder)
    _write(folder, {**files, MANIFEST: compiler.manifest(files)})


def add(folder: Path, files: Mapping[str, str]) -> None:
    """Write the files of some drives, and enter them where there is a manifest."""
    known = _written(folder)
    _write(folder, files)
    if known:
        _write(folder, {MANIFEST: compiler.manifest_of(known | compiler.hashes(files))})


def _write(folder: Path, files: Mapping[str, str]) -> None:
    for path, text in files.items():
        replace_text(folder / path, text)


def _written(folder: Path) -> dict[str, str]:
    """Path → hash of what earlier runs wrote there, by the manifest."""
    manifest = folder / MANIFEST
    if not manifest.exists():
        return {}
    try:
        files = json.loads(manifest.read_text(encoding="utf-8"))["files"]
        outside = [path for path in files if Path(path).is_absolute() or ".." in Path(path).parts]
    except (ValueError, KeyError, TypeError) as error:
        raise Refused(f"{manifest} is damaged ({error}): remove it; what it listed stays then") from error
    if outside:
        raise Refused(f"{manifest} names {outside[0]}, which is outside its folder: remove it")
    return files
