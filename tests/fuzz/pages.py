"""Mutated designs through the commands ``surface`` and ``report``: files, or one error that says what is wrong.

Of the first mutated designs that load, in processes of their own: a traceback, a status that is none of the commands',
an answer without its file, JSON with what is not a number and minutes without an end are failures that name the seed
which shows them again.
"""

import contextlib
import io
import json
import random
from collections import Counter
from pathlib import Path

from meshwright import cli
from meshwright.base.errors import DesignError
from tests.fuzz.designs import LONGEST_MESSAGE, forked, loaded
from tests.fuzz.mutate import mutated

#: Seconds of processor time that all commands of one design may take, and designs of a process.
HANG, BATCH = 300.0, 10

#: The exit statuses that a command has.
STATUSES = (0, 1, 2)


def _refused_constant(word):
    raise AssertionError(f"{word} is not JSON")


def called(arguments, written):
    """Exit status of a command that should leave the file ``written``; raises for what it must not do."""
    out, err = io.StringIO(), io.StringIO()
    written.unlink(missing_ok=True)
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        status = cli.main(arguments)
    said, words = err.getvalue(), " ".join(arguments[:1] + arguments[2:])
    assert status in STATUSES, f"{words}: exit status {status!r}"
    if status == 2:
        assert said.startswith("meshwright: "), f"{words}: exit status 2 without an error: {said!r}"
        assert len(said) < LONGEST_MESSAGE, f"{words}: a message of {len(said)} characters"
        assert not written.exists(), f"{words}: exit status 2, and yet a file"
        return status
    assert written.exists() and written.stat().st_size, f"{words}: exit status {status} without a file"
    if written.suffix == ".json":
        json.loads(written.read_text(encoding="utf-8"), parse_constant=_refused_constant)
    return status


def analysed(path):
    """Every ``surface`` and the ``report`` of the design in a file; the exit statuses counted."""
    found, folder = Counter(), path.parent
    for member in ("pinion", "wheel"):
        for region in ("flank", "fillet"):
            target = folder / "surface.json"
            words = ["surface", str(path), "--member", member, "--region", region, "--grid", "7x9"]
            found[f"surface {called([*words, '--json', str(target)], target)}"] += 1
    target = folder / "report.html"
    found[f"report {called(['report', str(path), '--html', str(target)], target)}"] += 1
    return found


def mutation(seed):
    """(name of the seed's design, bytes of the mutated one)."""
    return mutated(random.Random(seed))


def one(seed, folder):
    """What becomes of one mutated design: exit statuses counted, {} if it is refused."""
    return outcomes(mutation(seed)[1], folder)


def outcomes(content, folder):
    """The same of the text of a design."""
    if isinstance(loaded(content, folder), DesignError):
        return Counter()
    return analysed(Path(folder) / "design.toml")


def _counted(seed, folder):
    """The same, and whether it is refused."""
    found = one(seed, folder)
    return found + Counter(["analysed" if found else "refused"])


def run(count, seed=0):
    """Counter of outcomes and failures of mutated designs, until ``count`` of them were not refused."""
    total, failures, first = Counter(), [], seed
    while total["analysed"] + total["failed"] < count:
        open_ = [list(range(first, first + min(BATCH, 2 * (count - total["analysed"] - total["failed"]))))]
        first += len(open_[0])
        while open_:
            counted, failed, again, _ = forked(open_.pop(), _counted, HANG)
            total += counted
            failures += failed
            open_ += again
    return total, failures
