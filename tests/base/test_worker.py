"""Work in a forked process: its result and its errors come back, what it changes does not."""

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from derive.language.refusal import DescriptionError
from meshwright.base import worker
from meshwright.base.worker import in_worker, submit


@pytest.fixture
def forks():
    """This process can be forked: tests before may have left it a thread."""
    if not worker._can_fork():
        pytest.skip("one processor, several threads, or a system without fork")


@pytest.fixture(params=["in a worker", "here"])
def anywhere(request, monkeypatch):
    if request.param == "here":
        monkeypatch.setattr(worker, "_can_fork", lambda: False)
    else:
        request.getfixturevalue("forks")


def test_it_is_done_by_another_process(forks):
    with in_worker(os.getpid) as result:
        assert result() != os.getpid()


def test_a_worker_starts_none(forks):
    assert submit(lambda: submit(os.getpid)() == os.getpid())()


def test_beside_a_thread_it_is_done_here():
    over = threading.Event()
    thread = threading.Thread(target=over.wait)
    thread.start()
    try:
        assert submit(os.getpid)() == os.getpid()
    finally:
        over.set()
        thread.join()


def test_results_come_back_once_and_changes_do_not(forks):
    kept = []
    results = [submit(lambda k=k: (kept.append(k), ["x" * 1_000_000 * k])[1]) for k in range(3)]
    assert [len(result()[0]) for result in results] == [0, 1_000_000, 2_000_000]
    assert not kept and results[1]() is results[1]()


def test_its_value_and_its_exception_are_those_of_the_work(anywhere):
    with in_worker(lambda: list(range(100_000))) as result:
        assert result() == list(range(100_000))
    with in_worker(lambda: {}["key"]) as result, pytest.raises(KeyError, match="key"):
        result()


def test_an_error_of_ours_is_raised_where_the_result_is_asked_for(anywhere):
    def fails():
        raise DescriptionError("a normal points into the body")

    result = submit(fails)
    with pytest.raises(DescriptionError, match="points into the body"):
        result()


def test_the_work_of_a_killed_worker_is_done_here(forks):
    mine = os.getpid()
    result = submit(lambda: os.getpid() if os.getpid() == mine else os.kill(os.getpid(), signal.SIGKILL))
    assert result() == mine


def test_a_worker_that_exits_is_an_error(forks):
    with pytest.raises(ChildProcessError, match="exited with 3"):
        submit(lambda: os._exit(3))()


def test_no_worker_is_left_where_nobody_asks(forks, monkeypatch):
    made, fork = [], os.fork
    monkeypatch.setattr(os, "fork", lambda: made.append(fork()) or made[-1])
    with pytest.raises(ValueError, match="stop"), in_worker(lambda: "x" * 10_000_000):
        raise ValueError("stop")
    with pytest.raises(ChildProcessError):
        os.waitpid(made[0], os.WNOHANG)


#: Begins two pieces of work with results that no pipe holds, says which processes do them, and waits.
_WAITS = """
import multiprocessing, time
from meshwright.base.worker import submit
results = [submit(lambda: b"x" * 10_000_000) for _ in range(2)]
print(*(process.pid for process in multiprocessing.active_children()), flush=True)
time.sleep(60)
"""


def _goes_on(process):
    """Whether a process runs or waits; one that has ended may not have been buried."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


def test_workers_end_with_a_process_that_is_killed(forks):
    with subprocess.Popen([sys.executable, "-c", _WAITS], stdout=subprocess.PIPE, text=True) as waits:
        workers = waits.stdout.readline().split()
        waits.kill()
    assert len(workers) == 2
    until = time.monotonic() + 20.0
    while any(map(_goes_on, workers)) and time.monotonic() < until:
        time.sleep(0.05)
    assert not any(map(_goes_on, workers))
