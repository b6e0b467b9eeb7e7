"""Write the record as files: canonical JSON, one object a line, in the order in which it was built."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterable, Mapping
from pathlib import Path

from derive.audit.ledger import Ledger
from derive.prove.tree import canonical

CHECKER = Path(__file__).with_name("check.py")


def record_files(ledger: Ledger) -> dict[str, str]:
    """File name -> text: the ledger, the certificates and the checker."""
    certificates = [item for item in ledger.objects.values() if item["object"] == "certificate"]
    others = [item for item in ledger.objects.values() if item["object"] != "certificate"]
    return {
        "ledger.jsonl": _lines(others),
        "certificates.jsonl": _lines(certificates),
        "check.py": CHECKER.read_text(encoding="utf-8"),
    }


def seal(ledger: Ledger, folder: Path, names: Iterable[str]) -> str:
    """artifacts.json: the root hash and the sha256 of generated files, named relative to the generated folder."""
    files = {name: hashlib.sha256((folder / name).read_bytes()).hexdigest() for name in sorted(names)}
    return json.dumps({"root": ledger.root, "files": files}, indent=1, sort_keys=True) + "\n"


def write(folder: Path, files: Mapping[str, str]) -> None:
    """Replace each file in one step."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in files.items():
        part = folder / f".{name}.part"
        part.write_text(text, encoding="utf-8", newline="\n")
        os.replace(part, folder / name)


def _lines(objects: Iterable[Mapping]) -> str:
    return "".join(canonical(item) + "\n" for item in objects)
