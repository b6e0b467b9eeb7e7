"""Sweeps on a GPU: its program on the host, thread after thread, and what is said where there is no GPU."""

import ctypes
import sys
from functools import cache

import numpy as np
import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.sweep import device, samples
from tests.embedding import compile as c
from tests.embedding import nvrtc
from tests.quick import quick

#: Design and keys that vary, each with its deviation; of some samples ten times that, which asks for care.
VARIED = {
    "recess-action-full": {"misalignment.vertical_deg": 0.005, "misalignment.center_distance_mm": 0.005},
    "plain-zk": {"misalignment.axial_mm": 0.02, "design.pressure_angle_deg": 0.05},
    "spherical-table-2-3": {"misalignment.vertical_deg": 0.1, "misalignment.center_distance_mm": 0.02},
    "helical-crowned": {"misalignment.horizontal_deg": 0.01},
    "face-worm-conical-convex": {"misalignment.axial_mm": 0.05},
    "bevel-hypoid": {"misalignment.gear_axial_mm": 0.05},
}
ANGLES = 13


def on_host(folder):
    """The device's program compiled for the host: what :func:`meshwright.sweep.device.on_cuda` is on a GPU."""

    @cache
    def compiled(text, folders):
        program, library = folder / "program.cpp", folder / "program.so"
        program.write_text('extern "C" {\n' + text + "}\n")
        (cpp,) = [commands[1] for _, commands in sorted(c.compilers().items())[-1:]]
        options = ("-std=c++11", "-O2", "-ffp-contract=off", "-shared", "-fPIC", *(f"-I{f}" for f in folders))
        c.run(*cpp, *options, program, "-o", library)
        return ctypes.CDLL(str(library)).mw_samples

    def launch(drive, parameters, angles, start):
        shape = len(parameters), len(angles)
        found = [np.empty(s, t) for s, t in ((shape[:1], "i4"), (shape, "i4"), (shape, "u4"), (shape, "f8"))]
        found.append(np.empty((*shape, 3)))

        def at(array):
            return array.ctypes.data_as(ctypes.c_void_p)

        p, phi, x = map(np.ascontiguousarray, (parameters, angles, start))
        sizes = ctypes.c_longlong(shape[0]), ctypes.c_int(shape[1])
        compiled(*device.source(drive))(at(p), sizes[0], at(phi), sizes[1], at(x), *map(at, found))
        launch.through += [found[0]]
        return found[0] != 0, *found[1:]

    launch.through = []
    return launch


def _angles(drive, spacing):
    middle, pitch = drive.design.reference_angle, drive.pitch()
    share = np.linspace(-1.0, 1.0, ANGLES) if spacing == "equal" else np.sin(np.linspace(-1.5, 1.5, ANGLES))
    return middle + share * min(0.5 * pitch, 1.0)


@pytest.mark.parametrize("spacing", quick(["equal", "unequal"], "unequal"))
@pytest.mark.parametrize("name", quick(VARIED, "recess-action-full", "spherical-table-2-3"))
def test_rows_of_a_device_are_those_of_portable_lanes_to_the_last_bit(tmp_path, name, spacing):
    drive, generator, launch = Drive.load(name), np.random.default_rng(9), on_host(tmp_path)
    keys, many = list(VARIED[name]), 800 if name == "recess-action-full" else 100
    nominal = [drive.design.tables[table].get(key) or 0.0 for table, key in (place.split(".") for place in keys)]
    values = nominal + generator.normal(size=(many, len(keys))) * list(VARIED[name].values())
    values[:10] += 9.0 * (values[:10] - nominal)
    values[3, 0] = np.nan  # no design
    batches = [samples.Batch.of(drive, keys, values, True, way) for way in (None, launch)]
    own, other = (batch.points(_angles(drive, spacing)) for batch in batches)
    for field in ("status", "flags", "error", "points"):
        one, two = getattr(own, field), getattr(other, field)
        assert np.array_equal(one, two, equal_nan=field in ("error", "points"))
    (through,) = launch.through
    assert through.sum() >= 0.1 * many and not through[3]


@pytest.mark.skipif(nvrtc.library() is None, reason="NVRTC is not installed: pip install nvidia-cuda-nvrtc-cu12")
@pytest.mark.parametrize("name", quick(VARIED, "spherical-table-2-3"))
def test_nvrtc_compiles_the_program_of_a_device(name):
    text, folders = device.source(Drive.load(name))
    made = nvrtc.ptx(text, *(f"-I{folder}" for folder in folders))
    assert ".entry mw_samples(" in made and "fma.rn" not in made


def _sweep(folder, *options):
    vary = ("--vary", "misalignment.vertical_deg=-0.01:0.01", "--samples", "3", "--phi-deg", "0,1")
    return main(["sweep", "plain-zn", *vary, "--format", "csv", "--out", str(folder), *options])


def test_without_cupy_the_refusal_names_it(tmp_path, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "cupy", None)
    assert _sweep(tmp_path / "out", "--device", "cuda") == 2
    said = capsys.readouterr().err
    assert "CuPy is not installed" in said and "pip install 'meshwright[cuda]'" in said and "--portable" in said
    assert not (tmp_path / "out").exists()


class _NoDriver:
    """CuPy on a machine without NVIDIA's driver."""

    class cuda:
        class runtime:
            @staticmethod
            def getDeviceCount():
                raise RuntimeError("cudaErrorInsufficientDriver: CUDA driver version is insufficient for CUDA runtime")


def test_without_a_gpu_the_refusal_says_what_is_missing(tmp_path, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "cupy", _NoDriver)
    assert _sweep(tmp_path / "out", "--device", "cuda") == 2
    said = capsys.readouterr().err
    assert "no GPU (CUDA driver version is insufficient" in said and "install NVIDIA's driver" in said


def test_a_sweep_on_a_device_goes_on_where_a_portable_one_stopped(tmp_path, monkeypatch):
    monkeypatch.setattr(device, "on_cuda", on_host(tmp_path))
    monkeypatch.setattr(device, "require", lambda name: None)
    for folder, options in ((tmp_path / "one", ("--portable",)), (tmp_path / "two", ("--device", "cuda"))):
        assert _sweep(folder, *options) == 0
    one, two = ((tmp_path / name / "slice-000000.csv").read_bytes() for name in ("one", "two"))
    assert one == two
    assert _sweep(tmp_path / "one", "--device", "cuda") == 0
