"""Every proof of the record as a theorem that Coq's kernel accepts: `python -m derive.audit kernel`.

translate.py    certificates as Coq theorems
derivatives.py  locus, normal and equation of meshing of the ZN wheel, with derivatives as limits
Certificate.v   what a certificate proves, itself proved in Coq: equalities of rational expressions by computation
"""

from __future__ import annotations

import resource
import shutil
import subprocess
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from derive.audit.kernel import derivatives, translate
from derive.files import replace_text

#: Axioms of the real numbers in Coq's library: all that the certificates rest on.
AXIOMS = frozenset(
    {
        "ClassicalDedekindReals.sig_forall_dec",
        "ClassicalDedekindReals.sig_not_dec",
        "FunctionalExtensionality.functional_extensionality_dep",
    }
)
#: Excluded middle, which Coquelicot's derivatives add.
CLASSICAL = "Classical_Prop.classic"
#: Characters of the longest theorem that is written; longer ones are named and left out.
LARGEST = 900_000
MISSING = "coqc not found: the proofs were not put to the kernel (Debian: apt-get install coq libcoq-coquelicot)"


class Refused(Exception):
    """The kernel does not accept a file; the message is its own."""


@dataclass(frozen=True)
class Report:
    """Theorems and CPU seconds a file, and the axioms that all of them rest on."""

    theorems: dict[str, int]
    seconds: dict[str, float]
    axioms: frozenset[str]
    real_derivatives: bool


def available() -> bool:
    return shutil.which("coqc") is not None


def has_coquelicot() -> bool:
    """Can Coq load the library of real derivatives?"""
    where = subprocess.run(["coqc", "-where"], capture_output=True, text=True, check=True).stdout.strip()
    return (Path(where) / "user-contrib" / "Coquelicot" / "Coquelicot.vo").is_file()


def check_record(objects: Mapping[str, dict], folder: Path, log: Callable[[str], None] = print) -> Report:
    """Write every proof of the record as Coq files into a folder and have them checked; Refused if one is not."""
    replace_text(folder / "Certificate.v", Path(__file__).with_name("Certificate.v").read_text(encoding="utf-8"))
    compile_file(folder / "Certificate.v")
    counts, seconds, axioms = {}, {}, set()
    for document, every in translate.theorems(objects).items():
        stated = [theorem for theorem in every if len(theorem.text) <= LARGEST]
        for theorem in every:
            if len(theorem.text) > LARGEST:
                log(f"{document}: {theorem.name} is too long to be put to the kernel ({len(theorem.text)} characters)")
        path = folder / f"{translate.module_name(document)}.v"
        replace_text(path, translate.file_text(document, stated))
        spent, found = compile_file(path)
        counts[document], seconds[document] = len(stated), spent
        axioms |= found
        log(f"{document:20} {len(stated):4} theorems {spent:6.1f} CPU s")
    real = has_coquelicot()
    if real:
        path = folder / f"{derivatives.CHAIN.capitalize()}.v"
        text = derivatives.file_text()
        replace_text(path, text)
        seconds[derivatives.CHAIN], found = compile_file(path)
        found.discard(CLASSICAL)
        counts[derivatives.CHAIN] = text.count("\nTheorem ") + text.count("\nLemma ")
        axioms |= found
        log(f"{derivatives.CHAIN:20} {counts[derivatives.CHAIN]:4} theorems {seconds[derivatives.CHAIN]:6.1f} CPU s, "
            "derivatives as limits; these also use excluded middle")  # fmt: skip
    else:
        log("Coquelicot not found: the chain with real derivatives was not checked (Debian: libcoq-coquelicot)")
    if not axioms <= AXIOMS:
        raise Refused(f"axioms beyond those of the real numbers: {', '.join(sorted(axioms - AXIOMS))}")
    return Report(counts, seconds, frozenset(axioms), real)


def _deep_stack() -> None:
    """As much stack as may be had: long polynomials are deep terms."""
    _, most = resource.getrlimit(resource.RLIMIT_STACK)
    resource.setrlimit(resource.RLIMIT_STACK, (most, most))


def compile_file(path: Path) -> tuple[float, set[str]]:
    """CPU seconds, and the axioms printed; Refused with the kernel's message."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = subprocess.run(
        ["coqc", "-q", "-w", "none", "-Q", ".", "Meshwright", path.name],
        cwd=path.parent,
        capture_output=True,
        text=True,
        preexec_fn=_deep_stack,
    )
    if done.returncode:
        raise Refused(f"{path.name}: {done.stderr[:2000]}")
    spent = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    listed = done.stdout.partition("Axioms:\n")[2].splitlines()
    return spent, {line.split()[0] for line in listed if line and not line.startswith(" ")}
