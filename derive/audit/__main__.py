"""``python -m derive.audit verify|kernel|explain EQ|html``: check the committed record, have its proofs accepted by
Coq, walk from an equation or a C function to its sources, write the pages.

Exit status: 0 done, 1 the record or a proof is rejected, 2 bad input.
"""

import argparse
import json
import signal
import sys
import tempfile
from pathlib import Path

from derive import products
from derive.audit import explain
from derive.audit.checker import check_bounded, check_code, check_description, check_print, check_record, check_shipped
from derive.audit.checker.record import read_record
from derive.audit.checker.refusal import Rejected
from derive.files import replace_text

ROOT = Path(__file__).resolve().parents[2]
GENERATED = ROOT / "generated"
RUNTIME = ROOT / "runtime" / "c"


def main(arguments: list[str] | None = None) -> int:
    """Run one command."""
    parser = argparse.ArgumentParser(prog="python -m derive.audit", description=__doc__)
    parser.add_argument("--generated", type=Path, default=GENERATED, help="folder of generated files")
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("verify", help="recompute every hash and re-check every certificate")
    commands.add_parser("kernel", help="have every proof accepted by Coq's kernel").add_argument(
        "--output", type=Path, help="folder that keeps the Coq files; default: a temporary one"
    )
    commands.add_parser("explain", help="walk back to the sources").add_argument(
        "name", metavar="EQ", help="an equation id, the name of a generated function, or a drive"
    )
    commands.add_parser("html", help="write the pages anew").add_argument(
        "--output", type=Path, help="folder; default: generated/audit"
    )
    options = parser.parse_args(arguments)
    folder = options.generated / "audit"
    if (options.generated / products.MANIFEST).exists() and (lacking := products.absent(options.generated)):
        place = options.generated / lacking[0]
        print(f"{place} is missing: `make build` makes what git does not keep", file=sys.stderr)
        return 2
    if options.command == "verify":
        checkers = (check_record, check_code, check_description, check_bounded, check_print)
        ends = [checker.main([str(folder)]) for checker in checkers]
        return max(*ends, check_shipped.main([str(folder), "--runtime", str(RUNTIME)]))
    if options.command == "kernel":
        return _kernel(folder, options.output)
    if options.command == "explain":
        return _explain(options.generated, options.name)
    return _html(options.generated, options.output or folder)


def _explain(generated: Path, name: str) -> int:
    try:
        lines = explain.explain(generated, name)
    except explain.Unknown as error:
        print(error, file=sys.stderr)
        return 2
    print("\n".join(lines))
    return 0


def _kernel(folder: Path, output: Path | None) -> int:
    from derive.audit import kernel

    if not kernel.available():
        print(kernel.MISSING, file=sys.stderr)
        return 0
    try:
        with tempfile.TemporaryDirectory() as temporary:
            report = kernel.check_record(read_record(folder), output or Path(temporary))
    except (Rejected, kernel.Refused) as reason:
        print(f"REJECTED: {reason}", file=sys.stderr)
        return 1
    print("\n".join(report.lines()))
    return 0


def _html(generated: Path, output: Path) -> int:
    from derive.audit import record

    named = json.loads((generated / "audit" / "artifacts.json").read_text(encoding="utf-8"))["files"]
    texts = {name: (generated / name).read_text(encoding="utf-8") for name in named if not name.startswith("audit/")}
    written = record.files(record.ledger(), texts)
    for name, text in written.items():
        replace_text(output / name.removeprefix("audit/"), text)
    if output.resolve() == (generated / "audit").resolve():
        replace_text(generated / "manifest.json", products.manifest({**texts, **written}))
    print(output / "index.html")
    return 0


if __name__ == "__main__":
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    sys.exit(main())
