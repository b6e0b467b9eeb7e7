"""The solver's process: it ends with its children, and what it prints is bounded."""

import os
import time
from pathlib import Path

import pytest

from meshwright.fe.solver import run_ccx


def _program(folder, text):
    path = folder / "ccx"
    path.write_text("#!/bin/sh\n" + text)
    path.chmod(0o755)
    (folder / "model.inp").write_text("")
    return path, folder / "model.inp"


def _alive(pid):
    try:
        state = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0]
    except OSError:
        return False
    return state != "Z"


@pytest.mark.skipif(not os.path.isdir("/proc/self"), reason="the process table is read from /proc")
@pytest.mark.parametrize(("after", "limit"), [("sleep 60", 0.5), ("exit 0", 30.0)])
def test_a_child_of_the_solver_ends_with_it(tmp_path, after, limit):
    ccx, model = _program(tmp_path, f"sleep 60 & echo $! > child\n{after}\n")
    run_ccx(ccx, model, limit)
    child = int((tmp_path / "child").read_text())
    end = time.monotonic() + 5.0
    while _alive(child) and time.monotonic() < end:
        time.sleep(0.02)
    assert not _alive(child)


def test_a_chatty_solver_is_stopped_and_its_log_is_bounded(tmp_path):
    ccx, model = _program(tmp_path, "exec yes iteration 7\n")
    run = run_ccx(ccx, model, 60.0, log_limit=300_000)
    assert not run.finished and run.return_code is None
    assert "300000 bytes" in run.stopped
    assert model.with_suffix(".log").stat().st_size == 300_000
    assert len(run.log) <= 2**16


def test_an_error_is_seen_wherever_it_is_printed(tmp_path):
    text = "echo '*ERROR in model'; i=0; while [ $i -lt 3000 ]; do echo 'a line of forty characters, or about so'; "
    ccx, model = _program(tmp_path, text + "i=$((i+1)); done; echo Job finished\n")
    run = run_ccx(ccx, model, 60.0)
    assert "*ERROR" not in run.log and run.errors and run.return_code == 0 and not run.finished


def test_a_time_limit_is_said(tmp_path):
    ccx, model = _program(tmp_path, "exec sleep 60\n")
    run = run_ccx(ccx, model, 0.3)
    assert run.return_code is None and "time limit of 0.3 s" in run.stopped


def test_progress_is_the_newest_line(tmp_path):
    ccx, model = _program(tmp_path, "echo ' increment 1 attempt 1'; echo ' iteration 4'; sleep 1; echo Job finished\n")
    seen = []
    assert run_ccx(ccx, model, 60.0, progress=seen.append).finished
    assert seen == ["iteration 4"]
