"""Write the record as files: canonical JSON, one object a line, in the order in which it was built."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Mapping
from pathlib import Path

from derive.audit.check import equations_named
from derive.audit.ledger import Ledger
from derive.prove.tree import canonical

CHECKERS = tuple(
    Path(__file__).with_name(name)
    for name in (
        "check.py", "check_code.py", "check_description.py", "check_bounded.py", "check_print.py", "printed.txt",
    )  # fmt: skip
)


def record_files(ledger: Ledger) -> dict[str, str]:
    """File name -> text: the ledger, the certificates and the checkers with what they read."""
    certificates = [item for item in ledger.objects.values() if item["object"] == "certificate"]
    others = [item for item in ledger.objects.values() if item["object"] != "certificate"]
    return {
        "ledger.jsonl": _lines(others),
        "certificates.jsonl": _lines(certificates),
        **{path.name: path.read_text(encoding="utf-8") for path in CHECKERS},
    }


def seal(ledger: Ledger, files: Mapping[str, str]) -> str:
    """artifacts.json: the root hash, and per generated file its sha256 and the equations that a header names."""
    entries = {
        name: {
            "sha256": hashlib.sha256(text.encode()).hexdigest(),
            "equations": equations_named(text) if name.endswith(".h") else [],
        }
        for name, text in sorted(files.items())
    }
    return json.dumps({"root": ledger.root, "files": entries}, indent=1, sort_keys=True) + "\n"


def _lines(objects: Iterable[Mapping]) -> str:
    return "".join(canonical(item) + "\n" for item in objects)
