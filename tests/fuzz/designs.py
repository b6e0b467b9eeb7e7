"""Mutated designs loaded, and some of those that load analysed: a design, or one error that says what is wrong with it.

They are loaded in processes of their own: one that dies, or whose design takes more than ten seconds of its processor's
time, is a failure that names the seed which shows it again.
"""

import json
import math
import os
import random
import signal
import struct
import tempfile
import time
import traceback
import warnings
from collections import Counter
from functools import partial
from mmap import mmap
from pathlib import Path

import numpy as np

from meshwright import DesignError, Drive, UsageError
from meshwright.base.library import pointer
from meshwright.design import design
from tests.fuzz.mutate import mutated

#: Seconds of processor time that one design may take.
HANG = 10.0

#: Designs a process handles before the next one begins.
BATCH = 500

#: Share of the analysed designs of which path and limits are sought too.
DEEP = 0.2

LONGEST_MESSAGE = 2000


def loaded(content, folder):
    """The drive of a file with this content, or the DesignError that refused it; anything else is raised."""
    path = Path(folder) / "design.toml"
    path.write_bytes(content)
    try:
        return Drive.from_tables(design.read(path))
    except DesignError as error:
        words = str(error)
        assert words.isprintable(), f"control characters reach the terminal: {words!r}"
        assert len(words) < LONGEST_MESSAGE + len(str(path)), f"a message of {len(words)} characters"
        assert error.reason and error.remedy, f"no reason or no remedy: {words}"
        return error


def false_contacts(drive, result):
    """What is wrong with the points that a trace calls solved: told from both surfaces, evaluated anew at each."""
    m, wrong = drive.model, []
    sign = drive.design.mirror.sign
    for k in np.flatnonzero(result.solved):
        x, o = np.ascontiguousarray(result.solutions[k]), np.empty(m.no)
        s = drive.state(sign * float(result.angles[k]))
        m.observe(pointer(s), pointer(x), pointer(o))
        extent = 1.0 + np.abs(o[:3]).max() + np.abs(o[6:9]).max()
        gap, misfit = np.abs(o[:3] - o[6:9]).max(), np.abs(o[3:6] + o[9:12]).max()
        where = f"at {math.degrees(result.angles[k])!r} deg"
        if not gap <= 1e-8 * extent:
            wrong.append(f"{where}: flanks {gap} mm apart")
        if not misfit <= 1e-7:
            wrong.append(f"{where}: normals not opposed by {misfit}")
        if not all(m.unknowns[i].lower <= x[i] <= m.unknowns[i].upper for i in range(m.nx)):
            wrong.append(f"{where}: beyond the flanks")
        bent = float(result.curvatures[k, 0])
        if bent < -1e-6 and not {"interference", "spurious_sheet"} & set(result.flags[k]):
            wrong.append(f"{where}: curvature {bent} without a flag")
        for b in range(2):
            body = m.bodies[b]
            if o[body.regular] < 0.0 and not result.flags[k]:
                wrong.append(f"{where}: beyond a singular line without a flag")
            for i in range(body.margins):
                if o[body.margin + i] < -1e-9 * extent and not result.flags[k]:
                    wrong.append(f"{where}: outside a limit without a flag")
    return wrong


def analysed(drive, chance, deep):
    """Trace the drive at some angles; if deep also its path and limits. Raises for a false contact."""
    angles = np.array([chance.uniform(-math.pi, math.pi) for _ in range(5)] + [0.0])
    wrong = false_contacts(drive, drive.tca(angles))
    assert not wrong, "; ".join(wrong)
    if deep:
        for analysis in (drive.contact_ratio, drive.limits):
            try:
                analysis()
            except (DesignError, UsageError):
                continue


def _quiet(chance, seed, folder, analyse, deep):
    """Outcome of one mutated design."""
    name, content = mutated(chance)
    found = loaded(content, folder)
    if isinstance(found, DesignError):
        return "refused"
    if not analyse:
        return "loaded"
    analysed(found, chance, deep)
    return "analysed"


def mutation(seed):
    """(name of the seed's design, bytes of the mutated one)."""
    return mutated(_chances(seed)[0])


def _chances(seed):
    """What draws the design of a seed, and two numbers that say whether it is analysed, and how deeply."""
    chance = random.Random(seed)
    analyse, deep = chance.random(), chance.random()
    return chance, analyse, deep


def one(seed, folder, share=1.0, deep=DEEP):
    """The outcome of a seed, counted; of ``share`` the design is analysed, of ``deep`` path and limits are sought."""
    chance, analyse, deeply = _chances(seed)
    return Counter([_quiet(chance, seed, folder, analyse < share, deeply < deep)])


def batch(seeds, at, out, one, hang):
    """In a child process: what ``one(seed, folder)`` counts; the parent reads from ``at`` how far it came."""
    signal.signal(signal.SIGPROF, signal.SIG_DFL)
    warnings.simplefilter("error", RuntimeWarning)
    counted, failures, slowest = Counter(), [], (0.0, seeds[0])
    with tempfile.TemporaryDirectory() as folder:
        for seed in seeds:
            at[:8] = struct.pack("q", seed)
            signal.setitimer(signal.ITIMER_PROF, hang)
            begin = time.process_time()
            try:
                counted.update(one(seed, folder))
            except Exception:
                counted["failed"] += 1
                failures.append({"seed": seed, "error": traceback.format_exc(limit=-6)})
            signal.setitimer(signal.ITIMER_PROF, 0.0)
            slowest = max(slowest, (time.process_time() - begin, seed))
    out.write(json.dumps({"counted": counted, "failures": failures, "slowest": slowest}))


def forked(seeds, one, hang):
    """Counts and failures of a batch, the seeds still to do after one at which the process died, and the slowest: its
    seconds of processor time, its seed.

    ``one(seed, folder)`` counts what becomes of a seed, which may take ``hang`` seconds.
    """
    at = mmap(-1, 8)
    with tempfile.TemporaryFile("w+") as out:
        child = os.fork()
        if child == 0:
            batch(seeds, at, out, one, hang)
            out.flush()
            os._exit(0)
        status = os.waitpid(child, 0)[1]
        if status == 0:
            out.seek(0)
            done = json.load(out)
            return Counter(done["counted"]), done["failures"], [], tuple(done["slowest"])
    last = struct.unpack("q", at[:8])[0]
    number = os.WTERMSIG(status) if os.WIFSIGNALED(status) else 0
    why = f"took more than {hang:g} s" if number == signal.SIGPROF else f"ended the process (status {status})"
    before, after = [s for s in seeds if s < last], [s for s in seeds if s > last]
    open_ = [part for part in (before, after) if part]
    return Counter({"failed": 1}), [{"seed": last, "error": why}], open_, (0.0, last)


def run(count, analyse, seed=0, deep=0.0):
    """Counter of outcomes and the failures of ``count`` mutated designs, until ``analyse`` of them were analysed; the
    slowest: its seconds of processor time, its seed.
    """
    total, failures, slowest = Counter(), [], (0.0, seed)
    for first in range(0, count, BATCH):
        open_ = [list(range(seed + first, seed + min(first + BATCH, count)))]
        while open_:
            wanted, left = analyse - total["analysed"], count - sum(total.values())
            share = min(1.0, 3.5 * wanted / max(left, 1)) if wanted > 0 else 0.0
            counted, failed, again, slow = forked(open_.pop(), partial(one, share=share, deep=deep), HANG)
            total += counted
            failures += failed
            open_ += again
            slowest = max(slowest, slow)
    return total, failures, slowest
