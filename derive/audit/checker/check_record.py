"""Re-check the audit record with the standard library alone: `python check.py [folder]`, exit status 0 if everything
holds.

The record is two files of canonical JSON, one object per line. `ledger.jsonl` holds sources, steps (definitions),
equations and verdicts; `certificates.jsonl` holds what shows each equation true or false. Every object carries the
sha256 of the rest of itself and names the objects it rests on by their sha256, so the one root hash pins all of them.
`artifacts.json` seals every generated file, these pages included.

What is checked:
  lines         canonical text, no key twice, the keys of its kind and no other, every object used by a verdict
  hashes        every object, every link, the root, every generated file, none missing and none added
  bindings      a verdict judges the source of its own name; its equations are what the source's reading says, read
                anew from the text; a printed number stands in the print; a corrected equation differs from the printed
                one; a statement does not rest on two identical sides
  readings      a definition that was read from a drive's description has its values, computed here from the description
                with the document's letters, at values drawn at random modulo a random prime
  names         symbols, cosines, roots, arcs and jets are different things; equal names of roots are equal roots
  relations     only sin^2 + cos^2 = 1, root^2 = radicand and sign^2 = 1, each angle and root once
  certificates  numerator = sum of cofactor * relation, in exact integers
  trees         lhs - rhs = numerator / denominators: expanded in exact integers where that fits, else at three points,
                each modulo a prime of its own, prime and point drawn at random in this run; cosines, sines and roots
                are independent there, and derivatives are carried out by dual numbers, not by the prover's formulas
  not vacuous   at a point of the variety modulo a random prime, and at the recorded real point, both sides exist and
                agree
  refutations   the sides differ at the recorded point by more than the bounds of the arithmetic (exact fractions, with
                an enclosure wherever pi, a bare angle, a root or an arc enters)
  numbers       a printed number holds if its formula lies within half a unit of its last printed digit
  verdicts      follow from the certificates that they name
Degree and coefficients of lhs - rhs are bounded here, from the trees alone, before anything is evaluated. The bound
that is printed at the end is the probability that a wrong certificate passes three random points.
"""

import math
from pathlib import Path

from .certificates import POINTS
from .command import ended, folder_of
from .origins import check_origins
from .record import check_step, check_use, read_record, root_of
from .refusal import UNREADABLE, Rejected
from .seal import check_files
from .verdicts import check_certificate, check_verdict


def verify(folder: Path) -> dict[str, int | str]:
    """Check everything in a folder; the counts and the root hash, or Rejected."""
    try:
        return verified(folder.resolve())
    except UNREADABLE as error:
        raise Rejected(f"something is not of the form that it must have ({type(error).__name__}: {error})") from error


def verified(folder: Path) -> dict[str, int | str]:
    objects = read_record(folder)
    check_use(objects)
    decided = []
    for item in objects.values():
        if item["object"] == "certificate":
            decided.append(check_certificate(item, objects))
        elif item["object"] == "verdict":
            check_verdict(item, objects)
        elif item["object"] == "step":
            check_step(item, objects)
    root = root_of(objects)
    kinds = [item["object"] for item in objects.values()]
    return {
        **{kind: kinds.count(kind) for kind in sorted(set(kinds))},
        "file": check_files(folder, root, objects),
        "read": check_origins(folder.parent / "descriptions", objects),
        "expanded": sum(each_decided.get("expanded", 0) for each_decided in decided),
        "sampled": sum(not each_decided["expanded"] for each_decided in decided if each_decided),
        "bits of certainty": certainty(decided),
        "root": root,
    }


def certainty(decided: list[dict]) -> int:
    """-log2 of the probability that a wrong certificate, among those not expanded, passes all its random points.

    At one point: degree / prime (Schwartz 1980, Zippel 1979), and the share of primes that divide all coefficients.
    """
    sampled = [item for item in decided if item and not item["expanded"]]
    worst = max((item["degree"] / 2**60 + item["bits"] / 60 / 2**53 for item in sampled), default=2.0**-60)
    return math.floor(-POINTS * math.log2(worst))


def main(arguments: list[str]) -> int:
    def said() -> str:
        report = verify(folder_of(arguments))
        counted = {kind: report[kind] for kind in ("certificate", "equation", "file", "source", "step", "verdict")}
        bound = f", failure below 2^-{report['bits of certainty']}" if report["sampled"] else ""
        return (
            f"{', '.join(f'{count} {kind}' + 's' * (count != 1) for kind, count in counted.items())} hold\n"
            f"proofs expanded in exact integers: {report['expanded']}; checked at {POINTS} random points instead: "
            f"{report['sampled']}{bound}\n"
            f"definitions read from descriptions, read again: {report['read']}\n"
            f"root {report['root']}"
        )

    return ended(said)
