"""Work aside gives the value that it gives here, wherever it is done."""

import os

import pytest

from derive import aside


@pytest.fixture(params=(1, 2), ids=("one processor", "two processors"))
def processors(request, monkeypatch):
    monkeypatch.setattr(aside, "processors", lambda: request.param)
    return request.param


def test_the_value_is_that_of_the_function(processors):
    value = aside.aside(lambda n: {"process": os.getpid(), "text": "x" * n}, 10**6)()
    assert value["text"] == "x" * 10**6
    assert (value["process"] == os.getpid()) == (processors == 1)


def test_shared_items_are_taken_once_by_all_processes_together(processors):
    items = [f"item {k}" for k in range(100)]
    queue = aside.shared(items)
    others = [aside.aside(list, queue) for _ in range(processors - 1)]
    taken = [*queue, *(item for other in others for item in other())]
    assert sorted(taken) == sorted(items)


def test_work_that_fails_is_an_error_where_its_value_is_asked_for(processors, capfd):
    value = aside.aside(lambda: 1 / 0)
    with pytest.raises((ChildProcessError, ZeroDivisionError)):
        value()
    assert processors == 1 or "ZeroDivisionError" in capfd.readouterr().err
