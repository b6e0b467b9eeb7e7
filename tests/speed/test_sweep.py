"""Sweeps: rows that depend on the plan alone, whatever interrupts it and whoever works on it."""

import json
import os
import signal
import subprocess
import sys
import time
from dataclasses import replace

import numpy as np
import pytest

from meshwright import Drive
from meshwright.base.errors import DesignError, UsageError
from meshwright.base.library import library, text
from meshwright.cli import main
from meshwright.contact import analysis
from meshwright.contact.results import ARCSEC
from meshwright.design import design as designs
from meshwright.sweep import run as sweep
from meshwright.sweep import samples, slices

pytest.importorskip("pyarrow")

ANGLES = tuple(np.radians(np.arange(-100.0, 101.0, 20.0)))


def _plan(samples=50, levels=0, design="recess-action-full"):
    variations = (
        sweep.Variation("misalignment.vertical_deg", "uniform", -0.02, 0.02),
        sweep.Variation("design.hob_pitch_radius_mm", "normal", 20.06, 0.01),
    )
    return sweep.Plan(designs.read(design), variations, ANGLES, samples, levels, seed=4)


def _rows(folder, form="parquet"):
    names = ["sample", "pinion_angle_deg", "transmission_error_arcsec", "contact_x_mm", "contact_y_mm", "contact_z_mm"]
    return np.concatenate([slices.columns(path, names) for path in sorted(folder.glob(f"slice-*.{form}"))], axis=1)


def test_a_sample_of_a_sweep_is_the_tooth_contact_analysis_of_its_design():
    plan = _plan()
    rows = sweep.solve(plan, 0)
    for k in (0, 7, 49):
        drive = Drive.load("recess-action-full").with_(
            misalignment={"vertical_deg": float(rows.values[k, 0])},
            design={"hob_pitch_radius_mm": float(rows.values[k, 1])},
        )
        result = drive.tca(np.array(ANGLES))
        assert np.abs(rows.error[k] - result.error).max() < 1e-12
        assert np.abs(rows.points[k] - result.points).max() < 1e-9


@pytest.mark.parametrize(
    ("name", "changes"),
    [
        ("face-worm-conical-convex", {}),
        ("face-worm-cylindrical-concave", {"head_cutter_radius_mm": 24.0}),
    ],
)
def test_the_placement_of_a_head_cutter_follows_the_keys_of_each_sample(name, changes):
    drive = Drive.load(name).with_(design=changes)
    variations = (
        sweep.Variation("design.axial_module_mm", "normal", 1.334, 0.002),
        sweep.Variation("design.gear_inner_radius_mm", "uniform", 39.5, 40.5),
        sweep.Variation("misalignment.axial_mm", "uniform", -0.05, 0.05),
    )
    plan = sweep.Plan(drive.design.given(), variations, ANGLES, 5, seed=1)
    rows = sweep.solve(plan, 0)
    for k in range(5):
        module, radius, axial = map(float, rows.values[k])
        design = {"axial_module_mm": module, "gear_inner_radius_mm": radius}
        result = drive.with_(design=design, misalignment={"axial_mm": axial}).tca(np.array(ANGLES))
        assert set(result.status) == {"converged"}
        assert np.abs(rows.error[k] - result.error).max() < 1e-12
        assert np.abs(rows.points[k] - result.points).max() < 1e-9


def test_a_placement_that_is_varied_is_given_and_the_rest_follows():
    drive = Drive.load("face-worm-conical-convex")
    nominal = drive.design.as_solved()["placement"]["A1_z_mm"]
    variation = sweep.Variation("placement.A1_z_mm", "uniform", nominal - 1e-4, nominal + 1e-4)
    rows = sweep.solve(sweep.Plan(drive.design.given(), (variation,), ANGLES, 3), 0)
    for k in range(3):
        result = drive.with_(placement={"A1_z_mm": float(rows.values[k, 0])}).tca(np.array(ANGLES))
        assert np.abs(rows.points[k] - result.points).max() < 1e-9
    assert np.ptp(rows.points[:, 0, 0]) > 1e-6


def test_a_left_hand_drive_is_swept_as_it_is_analysed():
    drive = Drive.load("plain-zn").with_(design={"hand": "left"})
    variation = sweep.Variation("misalignment.vertical_deg", "uniform", -0.02, 0.02)
    angles = np.array(ANGLES) / 10
    rows = sweep.solve(sweep.Plan(drive.design.given(), (variation,), tuple(angles), 4), 0)
    for k in range(4):
        result = drive.with_(misalignment={"vertical_deg": float(rows.values[k, 0])}).tca(angles)
        assert np.abs(rows.error[k] - result.error).max() < 1e-12
        assert np.abs(rows.points[k] - result.points).max() < 1e-9


def _words(rows):
    return np.vectorize(analysis.statuses().get)(rows.status)


def _flags(drive, rows, k):
    names = samples.flag_names(drive)
    return tuple({name for bit, name in enumerate(names) if flags >> bit & 1} for flags in rows.flags[k].tolist())


def _assert_judged_alike(plan):
    """Status and flags of each point of each sample are those of its tooth contact analysis."""
    rows = sweep.solve(plan, 0)
    for k, values in enumerate(rows.values.tolist()):
        changes = {v.key: value for v, value in zip(plan.variations, values, strict=True)}
        drive = Drive.from_tables(designs.changed(plan.tables, changes))
        result = drive.tca(np.array(plan.angles))
        assert tuple(_words(rows)[k]) == result.status
        assert _flags(drive, rows, k) == tuple(map(set, result.flags))
        assert np.array_equal(np.isnan(rows.error[k]), np.isnan(result.error))
        assert np.array_equal(np.isnan(rows.points[k]), np.isnan(result.points))
    return rows


def test_teeth_that_do_not_reach_each_other_have_no_contact_in_a_sweep_either(tmp_path):
    """The nominal wheel reaches the worm far above angle 0; with a tip of 270 mm it does not anywhere."""
    radius = sweep.Variation("blank.wheel_tip_radius_mm", "uniform", 270.0, 277.38)
    for tip in (277.38, 270.0):
        tables = designs.changed(designs.read("recess-action-full"), {"blank.wheel_tip_radius_mm": tip})
        plan = sweep.Plan(tables, (radius,), tuple(np.radians([-200.0, -100.0])), 0, levels=2)
        assert _words(_assert_judged_alike(plan)).tolist() == [["no_contact"] * 2, ["converged"] * 2]
    summary = sweep.run(plan, tmp_path / "s")
    assert (summary["points_converged"], summary["samples_complete"]) == (2, 1)
    assert summary["points_by_status"] == {"converged": 2, "no_contact": 2}
    assert len(summary["first_incomplete_samples"]) == 1


def test_a_pair_that_runs_on_an_edge_is_flagged_in_a_sweep_too():
    """Errors of assembly of some signs move the vertex of the face worm's parabola out of its path."""
    variations = tuple(
        sweep.Variation(f"misalignment.{key}", "uniform", -error, error)
        for key, error in (("offset_mm", 0.1), ("axial_mm", 0.1), ("shaft_angle_deg", 0.05))
    )
    plan = sweep.Plan(designs.read("face-worm-conical-concave"), variations, tuple(np.radians([-90.0, 90.0])), 0, 2)
    rows = _assert_judged_alike(plan)
    on_edge = {"edge_contact" in flags for k in range(8) for flags in _flags(sweep.check(plan), rows, k)}
    assert on_edge == {True, False}


def test_points_that_bodies_cannot_make_are_not_good(tmp_path, capsys):
    """Exit status as of the tooth contact analysis, which finds interference there."""
    error = "misalignment.horizontal_deg"
    assert main(["tca", "spherical-table-2-3", "--phi-deg", "15,20", "--set", f"{error}=0.0485"]) == 1
    capsys.readouterr()
    command = ["sweep", "spherical-table-2-3", "--phi-deg", "15,20", "--grid", "1", "--vary", f"{error}=0.0485:0.0485"]
    assert main([*command, "--out", str(tmp_path / "s")]) == 1
    summary = json.loads(capsys.readouterr().out)
    assert (summary["points"], summary["points_converged"], summary["points_impossible"]) == (2, 0, 2)
    assert summary["peak_to_peak_arcsec"] is None
    claim = json.loads((tmp_path / "s" / "sweep.json").read_text(encoding="utf-8"))
    columns = slices.columns(tmp_path / "s" / "slice-000000.parquet", ["status", "flags"])
    assert {claim["statuses"][str(status)] for status in columns[0]} == {"converged"}
    assert all(flags >> claim["flags"].index("interference") & 1 for flags in columns[1].tolist())


@pytest.mark.parametrize(
    ("name", "tables", "key", "values"),
    [
        ("plain-zn", {}, "contact.elastic_allowance_mm", (0.0, 0.01)),
        ("plain-zn", {}, "design.shaft_angle_deg", (0.0, 180.0)),
        ("plain-zn", {"blank": {"worm_tip_radius_mm": 40.0}}, "blank.worm_root_radius_mm", (30.0, 50.5)),
        ("plain-zn", {"blank": {"worm_root_radius_mm": 30.0}}, "blank.worm_tip_radius_mm", (30.0, 40.0)),
    ],
)
def test_a_sweep_takes_the_values_that_a_design_takes(name, tables, key, values):
    variation = sweep.Variation(key, "uniform", *values)
    plan = sweep.Plan(designs.read(name) | tables, (variation,), ANGLES[5:6], 0, levels=2)
    words = _words(sweep.solve(plan, 0))[:, 0]
    for value, word in zip(values, words, strict=True):
        try:
            expected = Drive.from_tables(designs.changed(plan.tables, {key: value})).tca(plan.angles).status[0]
        except DesignError:
            expected = "bad_input"
        assert word == expected
    assert set(words) <= {"converged", "bad_input"}


def test_a_sample_that_is_no_design_is_bad_input_and_the_others_are_solved():
    """A negative module is out of its domain; without an offset there is no pitch point."""
    for name, variation, bad in (
        ("plain-zn", sweep.Variation("design.normal_module_mm", "uniform", -4.0, 4.0), [0, 1]),
        ("face-worm-conical-convex", sweep.Variation("design.offset_mm", "uniform", 1.0, 35.0), [0]),
    ):
        plan = sweep.Plan(designs.read(name), (variation,), ANGLES[:3], 0, levels=3)
        status = sweep.solve(plan, 0).status
        assert {text(library().mw_status_word(int(code))) for code in status[bad].ravel()} == {"bad_input"}
        assert (status[-1] == 0).all()


@pytest.mark.parametrize(
    ("key", "why"),
    [("design.worm_pitch_radius_mm", "another key of the design determines it"),
     ("design.worm_threads", "whole number"),
     ("design.grinding_wheel_radius_mm", "no key of a 'ZN worm with a wheel cut by a ZN hob'")],
)  # fmt: skip
def test_a_key_that_is_not_free_is_refused(key, why):
    """Determined by the lead angle that is given; a whole number; of another tool."""
    plan = sweep.Plan(designs.read("plain-zn"), (sweep.Variation(key, "uniform", 19.0, 21.0),), ANGLES, 1)
    with pytest.raises(DesignError, match=f"{key.partition('.')[2]}.*{why}"):
        sweep.check(plan)


def test_the_levels_of_a_range_include_its_ends():
    variation = sweep.Variation("misalignment.axial_mm", "uniform", 0.1, 0.3)
    assert variation.levels(np.arange(3), 3) == pytest.approx([0.1, 0.2, 0.3], abs=1e-16)
    assert variation.levels(np.arange(3), 3)[-1] == 0.3
    assert sweep.Variation("", "normal", 1.0, 2.0).levels(np.arange(3), 3).tolist() == [-5.0, 1.0, 7.0]


def test_portable_rows_agree_to_round_off_and_are_another_sweep():
    plan = _plan()
    portable = replace(plan, portable=True)
    assert portable.identity != plan.identity
    assert np.abs(sweep.solve(portable, 0).error - sweep.solve(plan, 0).error).max() < 1e-14


def test_an_interrupted_sweep_goes_on_without_losing_or_repeating_rows(tmp_path, monkeypatch):
    monkeypatch.setattr(sweep, "SLICE_POINTS", 110)
    plan = _plan()
    sweep.run(plan, tmp_path / "whole", threads=2)
    broken, done = tmp_path / "broken", []

    def stop():
        done.append(1)
        if len(done) == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        sweep.run(plan, broken, threads=1, advance=stop)
    (broken / "slice-000004.parquet").unlink(missing_ok=True)
    before = {path: path.stat().st_mtime_ns for path in broken.glob("slice-*")}
    sweep.run(plan, broken, threads=1)
    assert all(path.stat().st_mtime_ns == stamp for path, stamp in before.items())
    rows = _rows(broken)
    assert np.array_equal(rows, _rows(tmp_path / "whole"))
    assert rows.shape[1] == 50 * len(ANGLES)
    assert len({(s, a) for s, a in rows[:2].T}) == rows.shape[1]


def test_a_killed_process_leaves_no_part_of_a_slice(tmp_path):
    command = [
        sys.executable, "-m", "meshwright.cli", "sweep", "recess-action-full", "--samples", "60000",
        "--vary", "misalignment.vertical_deg=-0.02:0.02", "--phi-deg=-100:100:5", "--out", str(tmp_path / "s"),
    ]  # fmt: skip
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    deadline = time.monotonic() + 30
    while not list(tmp_path.glob("s/slice-*")) and time.monotonic() < deadline:
        time.sleep(0.01)
    process.kill()
    process.wait()
    for path in tmp_path.glob("s/slice-*.parquet"):
        assert len(slices.columns(path, ["sample"])[0]) % 41 == 0
    again = subprocess.run(command, capture_output=True, text=True, check=True)
    assert json.loads(again.stdout)["points"] == 60000 * 41
    assert [path.name for path in tmp_path.glob("s/.*")] == [".lock"]
    assert again.stderr == ""  # no progress bar outside a terminal
    samples = np.concatenate([slices.columns(path, ["sample"])[0] for path in tmp_path.glob("s/slice-*.parquet")])
    assert np.array_equal(np.bincount(samples.astype(int)), np.full(60000, 41))


def test_a_grid_combines_all_levels_and_csv_holds_the_same_rows(tmp_path):
    plan = _plan(samples=0, levels=3)
    first = sweep.run(plan, tmp_path / "a")
    second = sweep.run(plan, tmp_path / "b", form="csv")
    assert first["samples"] == 9 and first == second
    assert np.allclose(_rows(tmp_path / "a"), _rows(tmp_path / "b", "csv"), rtol=1e-14)


def test_quantiles_are_those_of_the_samples(tmp_path):
    summary = sweep.run(_plan(), tmp_path / "s")
    rows = sweep.solve(_plan(), 0)
    peaks = np.ptp(rows.error / ARCSEC, axis=1)
    assert summary["peak_to_peak_arcsec"][0] == pytest.approx(peaks.min())
    assert summary["peak_to_peak_arcsec"][4] == pytest.approx(np.median(peaks))


def test_slices_are_begun_as_others_end(tmp_path, monkeypatch):
    """A sweep of many slices begins at once and can be stopped: it holds none of them ready."""
    monkeypatch.setattr(sweep, "SLICE_POINTS", 11)
    monkeypatch.setattr(sweep, "write_slice", lambda plan, identity, folder, number, *_: begun.append(number))
    begun = []

    def stop():
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        sweep.run(_plan(samples=100_000), tmp_path, threads=2, advance=stop)
    assert len(begun) <= 4


def test_another_compiled_drive_is_another_sweep(monkeypatch):
    """A sweep is not resumed with another model, or by another version: its rows would not be of one kind."""
    plan = _plan()
    known = {plan.identity}
    for key in ("specification_hash", "generator"):
        description = Drive.from_tables(plan.tables).design.description
        monkeypatch.setitem(description, key, "another")
        known.add(plan.identity)
    assert len(known) == 3


def test_a_damaged_mark_is_named(tmp_path):
    sweep.run(_plan(samples=2), tmp_path / "s")
    mark = tmp_path / "s" / "sweep.json"
    mark.write_bytes(mark.read_bytes()[:40])
    with pytest.raises(UsageError, match=r"sweep\.json: is damaged; remove"):
        sweep.run(_plan(samples=2), tmp_path / "s")


def test_without_the_extra_csv_is_written_and_parquet_says_what_to_install(tmp_path, monkeypatch):
    expected = sweep.run(_plan(samples=2), tmp_path / "parquet")
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    monkeypatch.setitem(sys.modules, "pyarrow.parquet", None)
    assert sweep.run(_plan(samples=2), tmp_path / "csv", form="csv") == expected
    with pytest.raises(UsageError, match=r"pyarrow is not installed; `pip install 'meshwright\[sweep\]'`"):
        sweep.run(_plan(samples=2), tmp_path / "other")
    assert not (tmp_path / "other").exists()


def test_a_folder_of_another_sweep_is_left_alone(tmp_path):
    sweep.run(_plan(), tmp_path / "s")
    with pytest.raises(UsageError, match="another sweep"):
        sweep.run(_plan(samples=51), tmp_path / "s")


def test_an_unknown_key_is_named():
    bad = (sweep.Variation("misalignment.vertikal_deg", "uniform", 0.0, 1.0),)
    plan = sweep.Plan(designs.read("recess-action-full"), bad, ANGLES, 1)
    with pytest.raises(DesignError, match="vertikal_deg"):
        sweep.check(plan)


def test_bad_ranges_end_in_status_2(tmp_path, capsys):
    arguments = ["sweep", "recess-action-full", "--samples", "5", "--out", str(tmp_path / "s"), "--vary"]
    assert main([*arguments, "misalignment.vertical_deg=1"]) == 2
    assert main([*arguments, "misalignment.vertical_deg=1:0"]) == 2
    assert "low:high" in capsys.readouterr().err


@pytest.mark.validate
def test_an_embedded_dask_cluster_writes_the_same_rows(tmp_path):
    pytest.importorskip("distributed")
    sweep.run(_plan(), tmp_path / "a")
    sweep.run(_plan(), tmp_path / "b", threads=1, scheduler="local")
    assert np.array_equal(_rows(tmp_path / "a"), _rows(tmp_path / "b"))


@pytest.mark.validate
def test_a_killed_dask_worker_loses_nothing(tmp_path):
    """Workers are killed while they write; the cluster's address is that of any cluster."""
    distributed = pytest.importorskip("distributed")
    plan = _plan(samples=60000)
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        killed = []

        def kill():
            if len(killed) < 2:
                (pid, *_) = {w.pid for w in cluster.workers.values() if w.pid} - set(killed)
                os.kill(pid, signal.SIGKILL)
                killed.append(pid)

        summary = sweep.run(plan, tmp_path / "s", scheduler=cluster.scheduler_address, advance=kill)
    assert len(killed) == 2
    assert summary["points"] == 60000 * len(ANGLES)
    samples = np.concatenate([slices.columns(path, ["sample"])[0] for path in tmp_path.glob("s/slice-*.parquet")])
    assert np.array_equal(np.bincount(samples.astype(int)), np.full(60000, len(ANGLES)))


SEALED = {
    "truncated": lambda a, b: a.write_bytes(a.read_bytes()[:-100]),
    "empty": lambda a, b: a.write_bytes(b""),
    "missing": lambda a, b: a.unlink(),
    "of another slice": lambda a, b: a.write_bytes(b.read_bytes()),
}


@pytest.mark.parametrize("damage", SEALED)
@pytest.mark.parametrize("form", ["parquet", "csv"])
def test_a_damaged_slice_is_named_or_made_anew(tmp_path, monkeypatch, damage, form):
    monkeypatch.setattr(sweep, "SLICE_POINTS", 110)
    plan = _plan(30)
    want = sweep.run(plan, tmp_path, form)
    first, second = (tmp_path / f"slice-00000{k}.{form}" for k in (0, 1))
    good = first.read_bytes()
    SEALED[damage](first, second)
    if damage == "missing":
        assert sweep.run(plan, tmp_path, form) == want
        assert first.read_bytes() == good
        return
    with pytest.raises(UsageError, match=rf"slice-000000\.{form}.*remove it and run the sweep again"):
        sweep.run(plan, tmp_path, form)
    first.unlink()
    assert sweep.run(plan, tmp_path, form) == want


def test_a_slice_with_the_seal_of_another_is_made_anew(tmp_path, monkeypatch):
    monkeypatch.setattr(sweep, "SLICE_POINTS", 110)
    plan = _plan(30)
    want = sweep.run(plan, tmp_path, "csv")
    for ending in ("", ".seal"):
        (tmp_path / f"slice-000000.csv{ending}").write_bytes((tmp_path / f"slice-000001.csv{ending}").read_bytes())
    assert sweep.run(plan, tmp_path, "csv") == want


def test_a_folder_has_one_sweep_at_a_time(tmp_path):
    from meshwright.base.files import locked

    with locked(tmp_path, "sweep"), pytest.raises(UsageError, match="another sweep is at work here"):
        sweep.run(_plan(), tmp_path)
    assert sweep.run(_plan(), tmp_path)["samples"] == 50


def test_a_full_disk_is_called_that(tmp_path, monkeypatch):
    import errno

    def full(handle):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(UsageError, match="No space left on device.*make room"):
        sweep.run(_plan(), tmp_path)
