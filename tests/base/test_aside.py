"""Work that a copy of the process does."""

import os
import signal

import pytest

from meshwright.base import aside as module
from meshwright.base.aside import aside


@pytest.fixture
def copied():
    """This process can be copied: tests before may have left it a thread."""
    if not module._can_be_copied():
        pytest.skip("one processor, several threads, or a system that copies no process")


def test_it_is_done_by_another_process(copied):
    with aside(os.getpid) as found:
        assert found() != os.getpid()


@pytest.mark.parametrize("alone", [False, True])
def test_its_value_and_its_exception_are_those_of_the_work(monkeypatch, alone):
    if alone:
        monkeypatch.setattr(module, "_can_be_copied", lambda: False)
    with aside(lambda: list(range(100_000))) as found:
        assert found() == list(range(100_000))
    with aside(lambda: {}["key"]) as found, pytest.raises(KeyError, match="key"):
        found()


def test_a_copy_ended_from_outside_is_replaced(copied):
    mine = os.getpid()
    with aside(lambda: os.getpid() if os.getpid() == mine else os.kill(os.getpid(), signal.SIGKILL)) as found:
        assert found() == mine


def test_no_process_is_left_where_nobody_asks(copied, monkeypatch):
    made, fork = [], os.fork
    monkeypatch.setattr(os, "fork", lambda: made.append(fork()) or made[-1])
    with pytest.raises(ValueError, match="stop"), aside(lambda: "x" * 10_000_000):
        raise ValueError("stop")
    with pytest.raises(ChildProcessError):
        os.waitpid(made[0], os.WNOHANG)
