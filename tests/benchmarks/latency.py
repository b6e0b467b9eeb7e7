"""What a user waits for: processor seconds, user and system, of whole commands, beside what they may take."""

import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

#: Command → processor seconds that it may take on an idle machine, and how often it is measured.
COMMANDS = {
    "tca recess-action-full": (0.35, 5),
    "ratio recess-action-full": (0.6, 5),
    "report recess-action-full --html {folder}/report.html": (2.5, 3),
    "loaded recess-action-full --torque-nm 5": (10.0, 1),
}


def seconds(command):
    """Processor seconds of a ``meshwright`` command and of all that it starts; raises where it fails."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    one_thread = os.environ | {"OPENBLAS_NUM_THREADS": "1"}
    words = [sys.executable, "-m", "meshwright", *command.split()]
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL, env=one_thread)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def report():
    """Print the least of several runs of every command."""
    print("\nwhat a user waits for: command, processor seconds (least of several runs), what it may take")
    with tempfile.TemporaryDirectory() as folder:
        seconds("tca recess-action-full")  # the first run keeps what later ones read
        for command, (most, times) in COMMANDS.items():
            least = min(seconds(command.format(folder=Path(folder))) for _ in range(times))
            print(f"  {command.split(' --html')[0]:<42} {least:>6.2f} {most:>6.2f}", flush=True)
