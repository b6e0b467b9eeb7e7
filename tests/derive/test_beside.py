"""Work in a process of its own: its result and its errors come back, what it changes does not."""

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from derive.beside import begun
from derive.language.refusal import DescriptionError


def test_a_result_comes_back_and_changes_do_not():
    kept = []
    results = [begun(lambda k=k: (kept.append(k), "x" * 1_000_000 * k)[1]) for k in range(3)]
    assert [len(result()) for result in results] == [0, 1_000_000, 2_000_000]
    assert not kept or len(os.sched_getaffinity(0)) < 2


def test_an_error_is_raised_where_the_result_is_asked_for():
    def fails():
        raise DescriptionError("a normal points into the body")

    result = begun(fails)
    with pytest.raises(DescriptionError, match="points into the body"):
        result()


@pytest.mark.skipif(len(os.sched_getaffinity(0)) < 2, reason="with one processor there is no process of its own")
def test_a_process_that_is_killed_is_an_error():
    with pytest.raises(ChildProcessError, match="exit code 3"):
        begun(lambda: os._exit(3))()


#: Begins two pieces of work with results that no pipe holds, says which processes do them, and waits.
_WAITS = """
import multiprocessing, time
from derive.beside import begun
results = [begun(lambda: b"x" * 10_000_000) for _ in range(2)]
print(*(process.pid for process in multiprocessing.active_children()), flush=True)
time.sleep(60)
"""


def _goes_on(process):
    """Whether a process runs or waits; one that has ended may not have been buried."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


@pytest.mark.skipif(len(os.sched_getaffinity(0)) < 2, reason="with one processor there is no process of its own")
def test_what_was_begun_ends_with_a_process_that_is_killed():
    with subprocess.Popen([sys.executable, "-c", _WAITS], stdout=subprocess.PIPE, text=True) as waits:
        begun_by_it = waits.stdout.readline().split()
        waits.kill()
    assert len(begun_by_it) == 2
    until = time.monotonic() + 20.0
    while any(map(_goes_on, begun_by_it)) and time.monotonic() < until:
        time.sleep(0.05)
    assert not any(map(_goes_on, begun_by_it))
