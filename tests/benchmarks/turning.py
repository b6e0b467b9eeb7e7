"""What a call of an embedding program costs: a contact after a turn beside one at once, and one followed, warm or cold,
beside bare Newton steps, of every drive; ratios within one process.
"""

import subprocess
import tempfile
from pathlib import Path

from meshwright import Drive
from meshwright.design.design import packaged_names
from tests.benchmarks.timing import compile_c

HERE, GENERATED = Path(__file__).parent, Path(__file__).resolve().parents[2] / "generated" / "c"

#: What the ratios may be: a solve at 1000 rad to one at 0; a warm and a cold follow to bare steps.
FAR, WARM, COLD = 3.0, 4.0, 6.0

#: How often a drive is measured; the least of each time counts.
TURNS = 3


def designs():
    """A packaged design of every drive that one uses, by the name of the drive."""
    found = {}
    for drive in map(Drive.load, packaged_names()):
        found.setdefault(drive.design.description["name"], drive)
    return found


def seconds(name, drive, folder):
    """Of a call: solve at 0 and at 1000 rad, bare steps to a tolerance, warm and cold follow."""
    defines = f'-DHEADER="{name}.h"', f"-DDRIVE(f)={name}_##f"
    program = compile_c([HERE / "follow.c"], Path(folder) / name, f"-I{GENERATED}", f"-I{HERE}", *defines)
    command = [str(program), *(repr(float(value)) for value in drive.design.parameters)]
    runs = [subprocess.run(command, capture_output=True, text=True, check=True).stdout.split() for _ in range(TURNS)]
    return [min(map(float, times)) for times in zip(*runs, strict=True)]


def report():
    """Print the ratios of every drive, beside what they may be."""
    print("\nturning on: drive, ratio of a solve at 1000 rad to one at 0, of a warm and of a cold follow to bare steps")
    print(f"  {'what they may be':<28} {FAR:>6.1f} {WARM:>6.1f} {COLD:>6.1f}")
    with tempfile.TemporaryDirectory() as folder:
        for name, drive in designs().items():
            near, far, bare, warm, cold = seconds(name, drive, folder)
            ratios = f"{far / near:>6.2f} {warm / bare:>6.2f} {cold / bare:>6.2f}"
            print(f"  {name:<28} {ratios}   {1e6 * near:.3g} and {1e6 * bare:.3g} us", flush=True)


if __name__ == "__main__":
    report()
