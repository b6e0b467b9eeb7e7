"""Write the record as files: canonical JSON, one object a line, in the order in which it was built."""

import hashlib
import json
from collections.abc import Iterable, Mapping
from pathlib import Path

from derive.audit.checker.seal import equations_named
from derive.audit.ledger import Ledger
from derive.prove.tree import canonical

HERE = Path(__file__).parent
#: Commands beside the record, and the modules of the checkers' package that they run.
COMMANDS = {
    "check.py": "check_record",
    "check_code.py": "check_code",
    "check_description.py": "check_description",
    "check_bounded.py": "check_bounded",
    "check_print.py": "check_print",
    "check_shipped.py": "check_shipped",
    "check_contact.py": "check_contact",
}
COMMAND = '''#!/usr/bin/env python3
"""Runs checker/{module}.py, which says what it checks; Python's standard library is enough."""

import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).parent))

from checker.{module} import main  # noqa: E402

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
'''


def record_files(ledger: Ledger) -> dict[str, str]:
    """File name -> text: the ledger, the certificates and the checkers with what they read."""
    certificates = [item for item in ledger.objects.values() if item["object"] == "certificate"]
    others = [item for item in ledger.objects.values() if item["object"] != "certificate"]
    return {
        "ledger.jsonl": _lines(others),
        "certificates.jsonl": _lines(certificates),
        **checkers(),
    }


def checkers() -> dict[str, str]:
    """File name -> text: the checkers' package, its commands, and the print that one of them reads."""
    read = [HERE / "printed.txt", *sorted((HERE / "checker").glob("*.py"))]
    return {path.relative_to(HERE).as_posix(): path.read_text(encoding="utf-8") for path in read} | {
        name: COMMAND.format(module=module) for name, module in COMMANDS.items()
    }


def seal(ledger: Ledger, files: Mapping[str, str]) -> str:
    """artifacts.json: the root hash, and per generated file its sha256 and the equations that a header names."""
    entries = {
        name: {
            "sha256": hashlib.sha256(text.encode()).hexdigest(),
            "equations": equations_named(text) if name.endswith(".h") else {},
        }
        for name, text in sorted(files.items())
    }
    return json.dumps({"root": ledger.root, "files": entries}, indent=1, sort_keys=True) + "\n"


def _lines(objects: Iterable[Mapping]) -> str:
    return "".join(canonical(item) + "\n" for item in objects)
