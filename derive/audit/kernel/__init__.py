"""Every proof of the record as a theorem that Coq's kernel accepts: `python -m derive.audit kernel`.

translate.py    certificates as Coq theorems
derivatives.py  locus, normal and equation of meshing of the ZN wheel, with derivatives as limits
Certificate.v   what a certificate proves, itself proved in Coq: equalities of rational expressions by computation
"""

import resource
import shutil
import subprocess
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from derive.audit.kernel import derivatives, translate
from derive.files import replace_text

#: Axioms of the real numbers in Coq's library: all that the certificates may rest on.
AXIOMS = frozenset(
    {
        "ClassicalDedekindReals.sig_forall_dec",
        "ClassicalDedekindReals.sig_not_dec",
        "FunctionalExtensionality.functional_extensionality_dep",
    }
)
#: Excluded middle, which Coquelicot's derivatives add: the chain with real derivatives may rest on it too.
CLASSICAL = "Classical_Prop.classic"
NO_COQUELICOT = "the chain with real derivatives: Coquelicot not found (Debian: libcoq-coquelicot)"
MISSING = "coqc not found: the proofs were not put to the kernel (Debian: apt-get install coq libcoq-coquelicot)"


class Refused(Exception):
    """The kernel does not accept a file; the message is its own."""


@dataclass(frozen=True)
class Report:
    """Theorems, CPU seconds and axioms of each file."""

    theorems: dict[str, int]
    seconds: dict[str, float]
    axioms: dict[str, frozenset[str]]

    @property
    def real_derivatives(self) -> bool:
        """Was the chain with derivatives as limits checked?"""
        return derivatives.CHAIN in self.theorems

    def lines(self) -> list[str]:
        """The outcome in words: sums, and the axioms that files rest on."""
        found = [f"{sum(self.theorems.values())} theorems accepted in {sum(self.seconds.values()):.0f} CPU s"]
        for axioms in dict.fromkeys(self.axioms.values()):
            files = [name for name, own in self.axioms.items() if own == axioms]
            words = f"axioms of {', '.join(files)}: {', '.join(sorted(axioms)) or 'none'}"
            found.append(words + (f"; {CLASSICAL} is excluded middle" if CLASSICAL in axioms else ""))
        if not self.real_derivatives:
            found.append(f"left out: {derivatives.CHAIN}, {NO_COQUELICOT}")
        return found


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
    counts, seconds, axioms = {}, {}, {}

    def put(name: str, text: str, count: int, permitted: frozenset[str]) -> None:
        path = folder / f"{translate.module_name(name)}.v"
        replace_text(path, text)
        seconds[name], found = compile_file(path)
        if not found <= permitted:
            raise Refused(f"{path.name}: axioms beyond those permitted: {', '.join(sorted(found - permitted))}")
        counts[name], axioms[name] = count, frozenset(found)
        log(f"{name:20} {count:4} theorems {seconds[name]:6.1f} CPU s")

    for document, stated in translate.theorems(dict(objects)).items():
        put(document, translate.file_text(document, stated), len(stated), AXIOMS)
    if has_coquelicot():
        text = derivatives.file_text()
        put(derivatives.CHAIN, text, text.count("\nTheorem ") + text.count("\nLemma "), AXIOMS | {CLASSICAL})
    return Report(counts, seconds, axioms)


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
