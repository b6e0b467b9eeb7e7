"""Commands, and parts of what one of them says, agree about whether the teeth touch, how and where."""

import numpy as np
import pytest

from meshwright import Drive
from meshwright.base.errors import DesignError
from meshwright.contact import analysis
from meshwright.contact.results import ARCSEC, TOUCHING
from meshwright.cycle.first_results import STATUSES
from meshwright.cycle.pairs import Mesh
from meshwright.sweep import samples
from tests.cycle.test_plain_pairs import random_pair
from tests.quick import full

#: Packaged designs with a blank, by family, and how far their assembly is put out of line.
PACKAGED = (
    "plain-zi", "zk-zn-90", "helical-crowned", "spur-profile-shift", "crossed-helical-17-23", "bevel-crowned-both",
    "spherical-table-2-1", "spherical-table-3-1-convex", "face-worm-conical-concave",
)  # fmt: skip
KEYS = {"center_distance_mm": 0.1, "vertical_deg": 0.1, "horizontal_deg": 0.1, "offset_mm": 0.1}


def random_design(rng):
    """A nearly plain cylindrical pair, or a packaged design out of line."""
    while rng.random() < 0.6:
        name = str(rng.choice(PACKAGED))
        drive = Drive.load(name)
        known = {p["key"] for p in drive.design.description["parameters"] if p["table"] == "misalignment"}
        errors = {key: float(rng.normal() * size) for key, size in KEYS.items() if key in known}
        try:
            return drive.with_(misalignment=errors)
        except DesignError:
            continue
    return random_pair(rng)[0]


def parts_agree(drive, rng):
    """At angles over more than a pair's window."""
    angles = drive.about_the_middle(np.sort(rng.uniform(-1.5, 1.5, 3)))
    result = drive.tca(angles)
    first = drive.first_contact(angles, result)
    points = result.to_points()
    for k, point in enumerate(points):
        kind, status = first.kinds[k], result.status[k]
        assert (point["transmission_error_arcsec"] is not None) == (status in TOUCHING)
        if status == "no_contact":
            assert kind is None, (drive.design.given(), angles[k])
        if kind is None:
            assert status in ("no_contact", "left_flank", "fold") or result.flags[k] or not first.untouched[k]
        elif status != "converged":
            assert status == STATUSES[kind]
            assert first.errors[k] / ARCSEC == pytest.approx(result.error[k] / ARCSEC, abs=1e-6)
        elif not result.flags[k]:
            assert not first.overlaps(result.error)[k] < 0.0
        assert (point["contact_line"] is not None) >= (status == "line_contact")
    sweep_agrees(drive, angles, result)
    ratio_agrees(drive, angles, result, first)


def sweep_agrees(drive, angles, result):
    """A sweep with the design as its one sample."""
    known = [p["key"] for p in drive.design.description["parameters"] if p["table"] == "misalignment"]
    given = drive.design.given().get("misalignment", {})
    values = np.array([[given.get(key) or 0.0 for key in known]])
    found = samples.solve(drive, [f"misalignment.{key}" for key in known], values, angles)
    words = analysis.statuses()
    assert [words[code] for code in found.status[0].tolist()] == list(result.status), drive.design.given()
    assert found.error[0] / ARCSEC == pytest.approx(result.error / ARCSEC, abs=1e-6, nan_ok=True)


def ratio_agrees(drive, angles, result, first):
    """Between the ends that `ratio` states the pair touches, with the error that it takes for that."""
    mesh = Mesh.of(drive)
    if not mesh.window.complete:
        return
    assert mesh.status in TOUCHING and drive.first_contact([mesh.mirror * mesh.middle]).kinds[0] is not None
    low, high = sorted((mesh.window.begin.angle, mesh.window.end.angle))
    inside = (low < angles) & (angles < high)
    errors = mesh.errors(angles)
    for k in np.flatnonzero(inside):
        assert result.status[k] in TOUCHING, (drive.design.given(), angles[k])
        of_path = result.status[k] == "converged" and mesh.path is not None
        expected = result.error[k] if of_path else first.errors[k]
        if mesh.path is None or of_path:
            assert errors[k] / ARCSEC == pytest.approx(expected / ARCSEC, abs=1e-6), (drive.design.given(), angles[k])


@pytest.mark.parametrize("seed", [5])
def test_parts_of_a_result_agree(seed):
    rng = np.random.default_rng(seed)
    for _ in range(3):
        parts_agree(random_design(rng), rng)


@pytest.mark.validate
@pytest.mark.parametrize("seed", range(10))
def test_parts_of_many_results_agree(seed):
    rng = np.random.default_rng([7, seed])
    for _ in range(300 if full() else 10):
        parts_agree(random_design(rng), rng)
