"""Runs the CalculiX solver ``ccx`` on an input file, with a time limit and progress."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

INSTALL_HINT = "the solver ccx was not found on the PATH; on Debian or Ubuntu: apt-get install calculix-ccx"

_POLL_SECONDS = 0.2
_PROGRESS = re.compile(r"^\s*(increment \d+ attempt \d+|iteration \d+)", re.MULTILINE)


@dataclass(frozen=True)
class SolverRun:
    """How a run ended: ``return_code`` is None if it was cut at the time limit."""

    return_code: int | None
    seconds: float
    log: str

    @property
    def finished(self) -> bool:
        """The solver ended by itself and says so.  This alone does not make the result sound."""
        return self.return_code == 0 and "Job finished" in self.log and "*ERROR" not in self.log


def find_ccx() -> Path | None:
    """The solver on the PATH, if any."""
    found = shutil.which("ccx")
    return Path(found) if found else None


def run_ccx(
    ccx: Path,
    input_file: Path,
    time_limit: float,
    threads: int = 1,
    progress: Callable[[str], None] = lambda line: None,
) -> SolverRun:
    """Solve ``input_file`` (``*.inp``) in its own folder; results are written beside it.

    time_limit in seconds; ``progress`` receives the solver's newest increment or iteration line.
    """
    log_file = input_file.with_suffix(".log")
    environment = os.environ | {"OMP_NUM_THREADS": str(threads), "CCX_NPROC_EQUATION_SOLVER": str(threads)}
    start = time.monotonic()
    with log_file.open("wb") as log:
        process = subprocess.Popen(
            [str(ccx), "-i", input_file.stem],
            cwd=input_file.parent,
            env=environment,
            stdout=log,
            stderr=subprocess.STDOUT,
        )
        try:
            return_code = _wait(process, log_file, start + time_limit, progress)
        finally:
            if process.poll() is None:
                process.kill()
                process.wait()
    return SolverRun(return_code, time.monotonic() - start, log_file.read_text(errors="replace"))


def _wait(
    process: subprocess.Popen[bytes], log_file: Path, deadline: float, progress: Callable[[str], None]
) -> int | None:
    last = ""
    while time.monotonic() < deadline:
        try:
            return process.wait(timeout=_POLL_SECONDS)
        except subprocess.TimeoutExpired:
            lines = _PROGRESS.findall(log_file.read_text(errors="replace"))
            if lines and lines[-1] != last:
                last = lines[-1]
                progress(last)
    return None
