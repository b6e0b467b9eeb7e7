"""Work in a process of its own: its result and its errors come back, what it changes does not."""

import os

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
