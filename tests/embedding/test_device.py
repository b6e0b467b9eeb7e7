"""Generated headers on processors beside the host: what NVRTC makes of them, and the same source on the host."""

import ctypes
import re
import subprocess

import numpy as np
import pytest

from meshwright import Drive
from meshwright.base.library import pointer
from tests import snippets
from tests.embedding import compile as c
from tests.embedding import nvrtc
from tests.embedding.test_headers import DRIVES, FAMILIES
from tests.quick import quick

DESIGNS = ("spherical-table-2-3", "recess-action-full", "helical-crowned", "face-worm-conical-convex", "bevel-hypoid")

#: Every function of a device, a thread one point.
KERNEL = """
#include "DRIVE.h"
extern "C" __global__ void kernel(const double *p, double phi, double *s, double *x, double *o, double *R, int *ended)
{
    mw_info info;
    mw_contact contact;
    double pair;
    ended[0] = DRIVE_setup(p, s);
    DRIVE_set_phi(s, DRIVE_reduce(s, phi, &pair));
    DRIVE_eval(s, x, R, R + DRIVE_NX);
    R[0] += DRIVE_step(s, x);
    DRIVE_observe(s, x, o);
    DRIVE_along(s, phi, x, R, o, o + DRIVE_NX);
    ended[1] = DRIVE_follow(s, phi, x, &info);
    ended[2] = DRIVE_geometry(s, x, o, &contact);
}
"""

#: A drive that turns on from a state of the host: at each angle x, observation, what is known of the contact, pair.
FOLLOWED = """
#include <string.h>
#include "DRIVE.h"
#ifdef __cplusplus
extern "C" {
#endif
int sizes(void);
int sizes(void) { return sizeof(mw_contact); }
void followed(double *s, double *x, const double *phi, int n, double *out, char *contacts, int *ended);
void followed(double *s, double *x, const double *phi, int n, double *out, char *contacts, int *ended)
{
    mw_info info;
    mw_contact contact;
    for (int i = 0; i < n; i++, out += DRIVE_NX + DRIVE_NO + 2, contacts += sizeof contact) {
        memset(&contact, 0, sizeof contact);
        ended[i] = DRIVE_follow(s, phi[i], x, &info);
        memcpy(out, x, sizeof(double) * DRIVE_NX);
        if (ended[i] >= 0) ended[i] = DRIVE_geometry(s, x, out + DRIVE_NX, &contact);
        memcpy(contacts, &contact, sizeof contact);
        out[DRIVE_NX + DRIVE_NO] = info.pair;
        out[DRIVE_NX + DRIVE_NO + 1] = info.cold;
    }
}
#ifdef __cplusplus
}
#endif
"""

#: How a device is played: nothing but its part of the header, in C and C++, with qualifiers that mean nothing here.
PLAYED = {
    "c": ("-DMW_DEVICE_ONLY", "-DMW_DEVICE=__attribute__((unused))"),
    "cuda": ("-DMW_DEVICE_ONLY", "-D__CUDACC__", "-D__host__=", "-D__device__=", "-D__global__="),
    "both": ("-D__CUDACC__", "-D__host__=", "-D__device__="),
}


@pytest.mark.skipif(nvrtc.library() is None, reason="NVRTC is not installed: pip install nvidia-cuda-nvrtc-cu12")
@pytest.mark.parametrize("drive", quick(DRIVES, *FAMILIES))
def test_nvrtc_compiles_every_header_alone_and_fuses_nothing(drive):
    made = nvrtc.ptx(KERNEL.replace("DRIVE", drive), f"-I{c.GENERATED}")
    assert ".visible .entry kernel(" in made
    assert "sqrt.rn.f64" in made and "div.rn.f64" in made
    assert not re.search(r"\bfma\b|\.approx|\.ftz|\.extern", made)


@pytest.mark.skipif(nvrtc.library() is None, reason="NVRTC is not installed: pip install nvidia-cuda-nvrtc-cu12")
def test_nvrtc_compiles_what_the_page_says():
    page = (c.ROOT / "runtime" / "site" / "tutorial" / "embedding.md").read_text(encoding="utf-8")
    (text,) = (block for language, block in snippets.blocks(page) if language == "c" and "__global__" in block)
    assert "entry" in nvrtc.ptx(text, f"-I{c.GENERATED}")


def _followed(drive, folder, how):
    folder.mkdir()
    source, library = folder / ("device.c" if how in ("", "c") else "device.cpp"), folder / "device.so"
    source.write_text(FOLLOWED.replace("DRIVE", drive))
    c_command, cpp_command = sorted(c.compilers().items())[-1][1]
    command = (c_command, "-std=c99") if how in ("", "c") else (cpp_command, "-std=c++11")
    options = ("-O1", *c.STRICT, *c.EXACT, "-shared", "-fPIC", f"-I{c.GENERATED}", *PLAYED.get(how, ()))
    c.run(*command[0], command[1], *options, source, "-o", library, "-lm")
    return ctypes.CDLL(str(library))


def _address(array):
    return array.ctypes.data_as(ctypes.c_void_p)


def _turned(library, s, x, angles, no):
    """What the drive says at angles from a copy of a state: numbers, contacts, how each ended."""
    s, x, n = s.copy(), x.copy(), len(angles)
    out, ended = np.zeros((n, len(x) + no + 2)), np.empty(n, np.int32)
    contacts = np.zeros((n, library.sizes()), np.uint8)
    library.followed(*map(_address, (s, x, angles)), n, *map(_address, (out, contacts, ended)))
    return s, x, out, contacts, ended


@pytest.mark.parametrize("name", quick(DESIGNS, DESIGNS[0]))
@pytest.mark.parametrize("how", quick(PLAYED, "both"))
def test_the_device_s_part_of_a_header_has_the_host_s_bits(tmp_path, name, how):
    """A state and a contact of the host go to the device, which goes on; where that does not serve it says so."""
    drive = Drive.load(name)
    m, prefix = drive.model, drive.design.description["name"]
    host, device = (_followed(prefix, tmp_path / f"at-{h}", h) for h in ("", how))
    s, x, generator = np.empty(m.ns), np.full(m.nx, np.nan), np.random.default_rng(5)
    assert m.setup(pointer(drive.design.parameters), pointer(s)) == 0
    middle = drive.design.reference_angle
    s, x, *_ = _turned(host, s, x, np.array([middle]), m.no)
    angles = middle + np.cumsum(generator.uniform(-0.1, 0.1, 200) * drive.pitch() / 4.0)
    angles = np.clip(angles, middle - 0.4 * drive.pitch(), middle + 0.4 * drive.pitch())
    one, other = (_turned(library, s, x, angles, m.no) for library in (host, device))
    assert (one[4] >= 0).all() and not one[2][:, -1].any()
    assert all(a.tobytes() == b.tobytes() for a, b in zip(one, other, strict=True))
    far = np.array([middle + 1000.4 * drive.pitch()])
    x[:] = np.nan
    *_, out, _, ended = _turned(device, s, x, far, m.no)
    solved = how == "both"
    assert (ended[0] >= 0) == solved and np.isfinite(out[0, : m.nx]).all() == solved and out[0, -1] == 1.0


def test_a_translation_unit_of_a_device_holds_one_drive(tmp_path):
    source = tmp_path / "two.c"
    source.write_text('#include "spherical_convex_spur.h"\n#include "face_worm.h"\n')
    command = ["gcc", "-fsyntax-only", f"-I{c.GENERATED}", "-DMW_DEVICE_ONLY", source]
    command = [*sorted(c.compilers().items())[-1][1][0], *command[1:]]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode != 0 and "a translation unit holds one drive" in done.stderr


@pytest.mark.parametrize("name", DESIGNS)
def test_a_misalignment_changes_the_numbers_of_the_pose_and_no_others(name):
    drive = Drive.load(name)
    m, prefix, generator = drive.model, drive.design.description["name"], np.random.default_rng(7)
    text = (c.GENERATED / f"{prefix}.h").read_text(encoding="utf-8")
    pose = {int(place) for place in re.search(r"_POSE\[\] = { ([\d, ]+) };", text)[1].split(", ")}

    def state(p):
        s = np.zeros(m.ns)
        assert m.setup(pointer(p), pointer(s)) == 0
        return s

    p = drive.design.parameters.copy()
    places = [k for k, q in enumerate(drive.design.description["parameters"]) if q["table"] == "misalignment"]
    one, changed = state(p), np.zeros(m.ns, bool)
    for _ in range(5):
        p[places] = generator.normal(size=len(places)) * 1e-3
        changed |= ~((state(p) == one) | np.isnan(one))
    moved = set(np.flatnonzero(changed))
    assert moved <= pose
    assert moved == pose or name == "helical-crowned"  # whose reliefs of size 0 no misalignment moves
