"""The library in several threads."""

import subprocess
import sys

FIRST_USE = """
from concurrent.futures import ThreadPoolExecutor
from threading import Barrier
from meshwright import Drive

together = Barrier(8)

def error(_):
    together.wait()
    return float(Drive.load("recess-action-full").tca([0.01]).error[0])

with ThreadPoolExecutor(8) as threads:
    assert len({*threads.map(error, range(8))}) == 1
"""


def test_the_first_use_may_come_from_several_threads():
    done = subprocess.run([sys.executable, "-c", FIRST_USE], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
