"""The runtime knows drives by what they offer: no family of gears or kind of tool is named in it."""

import re
from pathlib import Path

RUNTIME = Path(__file__).parent.parent / "runtime"
FAMILY = re.compile(r"worm|spherical|hob|head.?cutter|bevel", re.IGNORECASE)


def sources():
    """The runtime's Python and C, without what is generated and without the examples, which are of single drives."""
    for path in RUNTIME.rglob("*"):
        apart = {"_generated", "examples"} & set(path.relative_to(RUNTIME).parts)
        if path.suffix in (".py", ".c", ".h") and not apart:
            yield path


def test_the_runtime_names_no_family():
    files = list(sources())
    assert len(files) > 100
    named = [
        f"{path.relative_to(RUNTIME)}:{number}: {line.strip()}"
        for path in files
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        if FAMILY.search(line)
    ]
    assert not named, "\n".join(named)
