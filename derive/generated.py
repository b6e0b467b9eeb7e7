"""The folder of generated files: what a run replaces in it, adds to it and removes from it, by its manifest."""

from collections.abc import Mapping
from pathlib import Path

from derive import products
from derive.files import remove_parts, replace_text
from derive.products import MANIFEST
from derive.refusals import Refused


def replace(folder: Path, files: Mapping[str, str]) -> None:
    """Write all generated files, and remove what an earlier run wrote and this one does not."""
    for path in _written(folder).keys() - files.keys():
        (folder / path).unlink(missing_ok=True)
    remove_parts(folder)
    _write(folder, {**files, MANIFEST: products.manifest(files)})


def add(folder: Path, files: Mapping[str, str]) -> None:
    """Write the files of some drives, and enter them where there is a manifest."""
    known = _written(folder)
    remove_parts(folder)
    _write(folder, files)
    if known and (now := known | products.hashes(files)) != known:
        _write(folder, {MANIFEST: products.manifest_of(now)})


def _write(folder: Path, files: Mapping[str, str]) -> None:
    for path, text in files.items():
        replace_text(folder / path, text)


def _written(folder: Path) -> dict[str, str]:
    """Path → hash of what earlier runs wrote there, by the manifest; nothing where there is none."""
    if not (folder / MANIFEST).exists():
        return {}
    try:
        return products.listed(folder)
    except products.Damaged as error:
        raise Refused(str(error)) from error
