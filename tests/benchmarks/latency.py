"""What a user waits for: processor seconds, user and system, of whole commands, beside what they may take."""

import os
import resource
import subprocess
import sys
import tempfile

from meshwright.design import description, design

#: Command → processor seconds that it may take on an idle machine, and how often it is measured.
COMMANDS = {
    "tca recess-action-full": (0.35, 5),
    "ratio recess-action-full": (0.6, 5),
    "loaded recess-action-full --torque-nm 5": (10.0, 1),
}

#: Processor seconds that the report of any packaged design may take, and how often the slowest of a family is measured.
REPORT, REPORTS = 2.5, 3


def seconds(command):
    """Processor seconds of a ``meshwright`` command and of all that it starts; raises where it fails, but not where it
    has found that flanks do not touch, exit status 1.
    """
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    one_thread = os.environ | {"OPENBLAS_NUM_THREADS": "1"}
    words = [sys.executable, "-m", "meshwright", *command.split()]
    done = subprocess.run(words, check=False, stdout=subprocess.DEVNULL, env=one_thread)
    if done.returncode > 1:
        done.check_returncode()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def slowest_report(family, folder):
    """The packaged design of a family whose report takes longest, measured once each, and the least of several runs."""
    names = [name for name in design.packaged_names() if design.read(name)["drive"] == family]
    commands = {name: f"report {name} --html {folder}/report.html" for name in names}
    once = {name: seconds(command) for name, command in commands.items()}
    name = max(once, key=once.get)
    return name, min(once[name], *(seconds(commands[name]) for _ in range(REPORTS - 1)))


def report():
    """Print the least of several runs of every command, and of the slowest report of every family."""
    print("\nwhat a user waits for: command, processor seconds (least of several runs), what it may take")
    seconds("tca recess-action-full")  # the first run keeps what later ones read
    for command, (most, times) in COMMANDS.items():
        _print(command, min(seconds(command) for _ in range(times)), most)
    with tempfile.TemporaryDirectory() as folder:
        for family in description.families():
            name, least = slowest_report(family, folder)
            _print(f"report {name}", least, REPORT)


def _print(command, least, most):
    print(f"  {command:<42} {least:>6.2f} {most:>6.2f}", flush=True)
