"""What a header alone says: which key a design lacks, and the names of several flags at once."""

import subprocess

import pytest

from meshwright import Drive
from tests.embedding import compile as c
from tests.embedding.test_designs_alone import PROGRAM, assignments
from tests.quick import quick

_WITHOUT = (
    "#include <stdlib.h>\n"
    "int main(int count, char **said)\n{\n    const int without = count > 1 ? atoi(said[1]) : -1;"
)

_FLAGS = r"""
#include <stdio.h>
#include "cylindrical_gears.h"
int main(void)
{
    const char *names[cylindrical_gears_NFLAGS];
    for (unsigned flags = 0; flags < 1u << cylindrical_gears_NFLAGS; flags++) {
        const int count = cylindrical_gears_flags(flags, names);
        for (int k = 0; k < count; k++) printf("%s%s", k ? " " : "", names[k]);
        printf("\n");
    }
    for (int bit = -1; bit <= cylindrical_gears_NFLAGS; bit++) {
        const char *name = cylindrical_gears_flag(bit);
        printf("%s\n", name ? name : "-");
    }
    return 0;
}
"""


def program(folder, text):
    source = folder / "said.c"
    source.write_text(text, encoding="utf-8")
    command = sorted(c.compilers().items())[-1][1][0]
    c.run(*command, "-std=c99", "-O1", *c.STRICT, *c.EXACT, f"-I{c.GENERATED}", source, "-o", folder / "said", "-lm")
    return folder / "said"


#: Designs whose sizes follow from rules, from equations of the design, and from keys of which one of two is given.
DESIGNS = ("recess-action-full", "spur-profile-shift", "face-worm-conical-convex")


@pytest.mark.parametrize("name", quick(DESIGNS, "spur-profile-shift"))
def test_a_key_that_a_design_lacks_is_named(tmp_path, name):
    design = Drive.load(name).design
    described = design.description["name"]
    header = (c.GENERATED / f"{described}.h").read_text(encoding="utf-8")
    given = list(assignments(Drive.load(name), header))
    keys = [line.split("X(P_")[1].split(")")[0] for line in given]
    text = PROGRAM.replace("DRIVE", described).replace("PHI", "0.0").replace("int main(void)\n{", _WITHOUT)
    lines = (f"    if (without != {k}) {{\n{line}\n    }}" for k, line in enumerate(given))
    said = program(tmp_path, text.replace("KEYS", "\n".join(lines)))
    lacking = {
        key: subprocess.run([said, str(k)], capture_output=True, text=True, check=False).stdout
        for k, key in enumerate(keys)
    }
    required = {p["key"] for p in design.description["parameters"] if p["required"]}
    assert required <= lacking.keys() and required
    for key in required:
        assert lacking[key] == f"guard: {key}: missing from the design: give it a value\n"
    for group in design.description["exclusive"]:
        (key,) = set(group) & lacking.keys()
        assert lacking[key] == f"guard: {', '.join(group)}: all missing from the design: give one a value\n"


def test_several_flags_have_their_names_at_once_and_no_number_of_a_bit(tmp_path):
    said = subprocess.run([program(tmp_path, _FLAGS)], capture_output=True, text=True, check=True).stdout.splitlines()
    bits = ["undercut", "interference", *2 * ["off_tip", "off_face", "off_root"]]
    for flags, names in enumerate(said[: 1 << len(bits)]):
        wanted = dict.fromkeys(bit for k, bit in enumerate(bits) if flags >> k & 1)
        assert names.split() == [*wanted]
    assert said[1 << len(bits) :] == ["-", *bits, "-"]
