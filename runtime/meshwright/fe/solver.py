"""Runs the CalculiX solver ``ccx`` on an input file, with limits on time and on what it prints, and progress.

The solver and every process it starts form one process group, which ends with it: nothing is left that could go on
writing. What it prints goes to a log file and is scanned as it comes; neither memory nor the log grow without bound.
"""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import signal
import subprocess
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import BinaryIO

INSTALL_HINT = "the solver ccx was not found on the PATH; on Debian or Ubuntu: apt-get install calculix-ccx"

#: A solver that prints more than this, bytes, is stopped.
LOG_LIMIT = 64 * 2**20

#: So much of the log's end is kept in memory, bytes.
TAIL = 64 * 2**10

_POLL_SECONDS = 0.2
_PROGRESS = re.compile(rb"^\s*(increment \d+ attempt \d+|iteration \d+)", re.MULTILINE)


@dataclass(frozen=True)
class SolverRun:
    """How a run ended: ``return_code`` is None if it was stopped, for the reason ``stopped``.

    ``log`` is the end of what the solver printed; ``errors`` says that somewhere it printed ``*ERROR``.
    """

    return_code: int | None
    seconds: float
    log: str
    errors: bool = False
    stopped: str = ""

    @property
    def finished(self) -> bool:
        """The solver ended by itself and says so.  This alone does not make the result sound."""
        complains = self.errors or "*ERROR" in self.log
        return self.return_code == 0 and "Job finished" in self.log and not complains


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
    log_limit: int = LOG_LIMIT,
) -> SolverRun:
    """Solve ``input_file`` (``*.inp``) in its own folder; results and log are written beside it.

    time_limit in seconds, log_limit in bytes; ``progress`` receives the solver's newest increment or iteration line.
    """
    environment = os.environ | {"OMP_NUM_THREADS": str(threads), "CCX_NPROC_EQUATION_SOLVER": str(threads)}
    start = time.monotonic()
    with input_file.with_suffix(".log").open("wb") as file:
        log = _Log(file, log_limit)
        process = subprocess.Popen(
            [str(ccx), "-i", input_file.stem],
            cwd=input_file.parent,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
        assert process.stdout is not None
        reader = threading.Thread(target=log.read, args=(process.stdout,), daemon=True)
        reader.start()
        stopped = ""
        try:
            stopped = _wait(process, log, start + time_limit, progress)
        finally:
            _end_group(process)
            reader.join()
            process.stdout.close()
    if log.failure is not None:
        raise OSError(log.failure.errno, log.failure.strerror, str(input_file.with_suffix(".log"))) from log.failure
    if stopped == _TIME:
        stopped = f"the solver was stopped at its time limit of {time_limit:g} s"
    elif log.full.is_set():
        stopped = f"the solver was stopped: it printed more than {log_limit} bytes"
    code = None if stopped else process.returncode
    return SolverRun(code, time.monotonic() - start, log.tail.decode(errors="replace"), log.errors, stopped)


_TIME = "time"


def _wait(process: subprocess.Popen[bytes], log: _Log, deadline: float, progress: Callable[[str], None]) -> str:
    """Wait for the end, which is reported as ``""``, the time limit, or a log that is full."""
    last = ""
    while time.monotonic() < deadline:
        try:
            process.wait(timeout=_POLL_SECONDS)
            return ""
        except subprocess.TimeoutExpired:
            if log.full.is_set():
                return "log"
            if log.progress != last:
                last = log.progress
                progress(last)
    return _TIME


def _end_group(process: subprocess.Popen[bytes]) -> None:
    """End the solver and whatever it has started; a group without members is none any more."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


@dataclass
class _Log:
    """What a process prints: to ``file`` up to ``limit`` bytes, its end, newest progress and any error kept."""

    file: BinaryIO
    limit: int
    tail: bytes = b""
    errors: bool = False
    progress: str = ""
    failure: OSError | None = None
    full: threading.Event = field(default_factory=threading.Event)

    def read(self, stream: BinaryIO) -> None:
        """Read to the end of the stream, or to the limit, or until the file cannot be written."""
        try:
            self._read(stream)
        except OSError as error:
            self.failure = error
            self.full.set()

    def _read(self, stream: BinaryIO) -> None:
        written = 0
        while chunk := os.read(stream.fileno(), TAIL):
            # a word cut by the end of a chunk stands whole in the next round, which begins within the last tail
            seen = self.tail[-len(b"*ERROR") :] + chunk
            self.errors = self.errors or b"*ERROR" in seen
            self.tail = (self.tail + chunk)[-TAIL:]
            lines = _PROGRESS.findall(self.tail)
            if lines:
                self.progress = lines[-1].decode(errors="replace")
            self.file.write(chunk[: self.limit - written])
            written += len(chunk)
            if written >= self.limit:
                self.full.set()
                return
