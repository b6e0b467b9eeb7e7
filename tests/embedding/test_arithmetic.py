"""A header refuses arithmetic that would change its results where the compiler says so; its self-test finds others."""

import platform
import subprocess

import pytest

from tests.embedding import compile as c

DRIVE = "spherical_convex_spur"
SOURCE = f"""
#include <stdio.h>
#ifdef FLUSH
#include <xmmintrin.h>
#endif
#include "{DRIVE}.h"
int main(void)
{{
#ifdef FLUSH
    _mm_setcsr(_mm_getcsr() | 0x8040);
#endif
    printf("%d", {DRIVE}_self_test());
    return 0;
}}
"""

#: Options of GCC that the header refuses, each with a word of what it says.
REFUSED = {
    "-ffast-math": "fast mathematics",
    "-Ofast": "fast mathematics",
    "-ffinite-math-only": "not a number has to be told",
    "-freciprocal-math": "sums and quotients stand as they are",
    "-mfpmath=387": "doubles must be rounded at once",
}


def _program(folder, command, *options, source=SOURCE):
    (folder / "test.c").write_text(source)
    words = [*command, "-std=c99", "-O1", *options, f"-I{c.GENERATED}", folder / "test.c", "-o", folder / "test", "-lm"]
    return subprocess.run(list(map(str, words)), capture_output=True, text=True)


def _said(folder, command, *options, source=SOURCE):
    built = _program(folder, command, *options, source=source)
    assert built.returncode == 0, built.stderr
    return int(subprocess.run([folder / "test"], capture_output=True, check=True).stdout)


@pytest.mark.parametrize("name", sorted(c.compilers()))
def test_exact_arithmetic_is_found_sound(tmp_path, name):
    assert _said(tmp_path, c.compilers()[name][0], *c.EXACT) == 0


@pytest.mark.parametrize("option", REFUSED)
def test_arithmetic_of_another_kind_is_refused_in_words(tmp_path, option):
    if "gcc" not in c.compilers() or (option.startswith("-m") and platform.machine() != "x86_64"):
        pytest.skip("an option of GCC, or of its x86-64")
    built = _program(tmp_path, ["gcc"], option)
    assert built.returncode != 0 and REFUSED[option] in built.stderr and "MW_ANY_ARITHMETIC" in built.stderr


@pytest.mark.parametrize(
    ("options", "found"),
    [
        pytest.param(["-O2", "-mfma", "-ffp-contract=fast"], {1}, marks=pytest.mark.validate),
        pytest.param(["-mfpmath=387", "-DMW_ANY_ARITHMETIC"], {1, 2}, marks=pytest.mark.validate),
        (["-ffast-math", "-DMW_ANY_ARITHMETIC"], {1, 2, 3, 4, 5, 6}),
        (["-DFLUSH"], {5}),
    ],
)
def test_what_no_macro_shows_is_found_by_the_self_test(tmp_path, options, found):
    if "gcc" not in c.compilers() or platform.machine() != "x86_64":
        pytest.skip("options of GCC on x86-64")
    if "-mfma" in options and not _has_fused_products():
        pytest.skip("this processor has no fused products")
    assert _said(tmp_path, ["gcc"], *options) in found


@pytest.mark.validate
@pytest.mark.parametrize("drive", sorted(path.stem for path in c.GENERATED.glob("*.json")))
def test_every_drive_finds_its_own_contact(tmp_path, drive):
    source = SOURCE.replace(DRIVE, drive)
    assert _said(tmp_path, sorted(c.compilers().items())[-1][1][0], "-O0", *c.EXACT, source=source) == 0


def _has_fused_products():
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as stream:
            return " fma " in stream.read()
    except OSError:
        return False
