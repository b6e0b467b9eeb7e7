"""Changes of a drive, each put before the checks that may notice it."""

import json
import random
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from derive.audit.checker import attempts, check_print
from derive.audit.checker.printed import read_printed
from derive.audit.checker.refusal import UNREADABLE, Rejected
from derive.audit.checker.tables import Table
from derive.audit.mutations.checks import Checks, draws, reads
from derive.audit.mutations.equality import programs, same_programs, same_tables
from derive.audit.mutations.of_c import of_header, of_tables
from derive.audit.mutations.of_casadi import of_casadi, rebuilt
from derive.audit.mutations.of_descriptions import SECTIONS, changed_at, places
from derive.audit.mutations.stages import (
    CASADI,
    DESCRIPTION,
    EQUAL,
    GENERATED,
    HEADERS,
    REFUSED,
    SEED,
    STAGES,
    SURVIVED,
    TABLES,
)  # fmt: skip

PRINTED = Path(__file__).resolve().parents[1] / "printed.txt"

#: Inputs that a check of a change may draw; a check that finds none at which all roots exist refuses.
ATTEMPTS = 600


@dataclass(frozen=True)
class Mutant:
    """One change: where, in words, and how to make it of the drive's texts."""

    drive: str
    stage: str
    function: str
    words: str
    texts: Callable[[], dict]

    @property
    def key(self) -> tuple[str, ...]:
        return self.drive, self.stage, self.function, self.words


@dataclass(frozen=True)
class Outcome:
    mutant: Mutant
    by: str
    reason: str


class Measured:
    """A drive as generated: its texts and its checks."""

    def __init__(self, name: str, generated: Path = GENERATED):
        self.name, self.generated = name, generated
        self.texts: dict = {
            stage: (generated / "c" / f"{name}{ending}.h").read_text(encoding="utf-8")
            for stage, ending in {**HEADERS, TABLES: "_certified"}.items()
        }
        path = generated / "descriptions" / f"{name}.json"
        self.texts[DESCRIPTION] = json.loads(path.read_text(encoding="utf-8"))
        self.checks = Checks(name, self.texts, generated / "casadi")

    def wanted(self, mutant: Mutant) -> list[int]:
        """Numbers of the checks that may read what was changed, tables first; of a description all."""
        chosen = [k for k in range(len(self.checks.all)) if self._reads(k, mutant)]
        return sorted(chosen, key=lambda k: not self.checks.all[k].words.startswith(("table", "parameters at")))

    def _reads(self, k: int, mutant: Mutant) -> bool:
        check, name = self.checks.all[k], mutant.function
        match mutant.stage:
            case "lanes":
                return check.words == "lanes"
            case "sensitivity":
                return ("tangent" in check.words and check.module == "code") or check.words.startswith("changes ")
            case "scalar C" if name in ("sincos", "seldom_sincos", "near_sincos", "atan2"):
                return check.words in ("kernels", "near kernel", "arc")
            case "scalar C" if name == "derive":
                return check.words.startswith(("rule ", "table rule"))
            case "scalar C" if name.endswith("_open"):
                return check.words == "open"
            case "scalar C" if name == "setup" and check.words.startswith("guard "):
                return True
            case "bounded" if name.startswith("edge_"):
                return check.words == "systems"
            case "tables":
                return check.words == f"table {name.removesuffix('_values')}"
            case "CasADi":
                return check.words.startswith(f"CasADi{name}: ")
            case "description":
                return check.module != "code"
        return reads(check, name)

    # ---- mutants -----------------------------------------------------------------------------------------------------

    def mutants(self, each: int, rng: random.Random) -> Iterator[Mutant]:
        for stage in (*HEADERS, TABLES):
            text = self.texts[stage]
            for function, found in of_tables(self.name, text) if stage == TABLES else of_header(self.name, text):
                name = function.removesuffix("_lanes") if stage == "lanes" else function
                for words, start, end, other in rng.sample(found, min(each, len(found))):
                    changed = text[:start] + other + text[end:]
                    yield Mutant(self.name, stage, name, words, partial(self._with, stage, changed))
        for path in sorted((self.generated / "casadi").glob(f"{self.name}*.casadi")):
            ending = path.stem.removeprefix(self.name)
            if ending and not ending.startswith("_"):
                continue
            _, function = self.checks.casadi(ending)
            for at, kind in rng.sample(found := list(of_casadi(function)), min(2 * each, len(found))):
                words = f"{kind} of instruction {at}"
                yield Mutant(self.name, CASADI, ending, words, partial(self._rebuilt, ending, function, at, kind))
        for section in SECTIONS:
            found = [(section, *path) for path in places(self.texts[DESCRIPTION][section])]
            for path in rng.sample(found, min(2 * each, len(found))):
                words, changed = changed_at(self.texts[DESCRIPTION], path, rng)
                yield Mutant(self.name, DESCRIPTION, section, words, partial(self._with, DESCRIPTION, changed))

    def _with(self, stage: str, changed: object) -> dict:
        return {**self.texts, stage: changed}

    def _rebuilt(self, ending: str, function, at: int, kind: str) -> dict:
        return self._with(CASADI, {ending: rebuilt(function, at, kind)})

    def judged(self, mutant: Mutant) -> Outcome:
        try:
            texts = mutant.texts()
            checks, kept = Checks(self.name, texts, self.generated / "casadi"), draws()
            if mutant.stage == DESCRIPTION:
                self._printed(texts[DESCRIPTION])
            found = checks.all
            if len(found) != len(self.checks.all):
                return Outcome(mutant, REFUSED, "other checks")
            for k in self.wanted(mutant):
                found[k].run(kept)
        except Rejected as reason:
            return Outcome(mutant, REFUSED, str(reason)[:160])
        except UNREADABLE as reason:
            return Outcome(mutant, REFUSED, repr(reason)[:160])
        return Outcome(mutant, EQUAL if self.is_equal(mutant, texts) else SURVIVED, "")

    def _printed(self, description: dict) -> None:
        printed = read_printed(PRINTED.read_text(encoding="utf-8"))
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / f"{self.name}.json"
            path.write_text(json.dumps(description), encoding="utf-8")
            check_print.check_drive(path, printed)

    # ---- equal ? -----------------------------------------------------------------------------------------------------

    def is_equal(self, mutant: Mutant, texts: dict) -> bool:
        if mutant.stage == CASADI:
            changed = Checks(self.name, texts, self.generated)
            old, new = (checks.casadi(mutant.function)[0] for checks in (self.checks, changed))
            return same_programs([(old.definitions, new.definitions)], self.checks.header)
        if mutant.stage == DESCRIPTION:
            return False
        if mutant.stage == TABLES:
            name = f"{self.name}_certified_{mutant.function}"
            kept, other = (Table(t[TABLES], name) for t in (self.texts, texts))
            return same_tables(kept, other, self.checks.drive)
        old, new = (programs(self.name, t[mutant.stage], mutant.stage)[mutant.function] for t in (self.texts, texts))
        return len(old) == len(new) and same_programs(list(zip(old, new, strict=True)), self.checks.header)


def measure(drives: list[str], each: int, log: Path | None = None, stages: tuple[str, ...] = STAGES,
            sample: int | None = None, generated: Path = GENERATED) -> Iterator[Outcome]:  # fmt: skip
    """Changes of all functions of some drives, ``each`` a function; of these ``sample`` at random, if it is given."""
    known = logged(log)
    with attempts.limited(ATTEMPTS):
        for name in drives:
            drive, rng = Measured(name, generated), random.Random(f"{SEED} {name}")
            chosen = [m for m in drive.mutants(each, rng) if m.stage in stages]
            for mutant in chosen if sample is None else rng.sample(chosen, min(sample, len(chosen))):
                if mutant.key in known:
                    yield Outcome(mutant, *known[mutant.key])
                    continue
                outcome = drive.judged(mutant)
                if log:
                    with log.open("a", encoding="utf-8") as file:
                        file.write(json.dumps([*mutant.key, outcome.by, outcome.reason]) + "\n")
                yield outcome


def logged(log: Path | None) -> dict[tuple[str, ...], tuple[str, str]]:
    lines = map(json.loads, log.read_text(encoding="utf-8").splitlines()) if log and log.is_file() else ()
    return {tuple(key): (by, reason) for *key, by, reason in lines}
