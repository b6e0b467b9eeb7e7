"""Certified paths: whole cycles of contact without a gap, and what is not one branch is named."""

import json
from fractions import Fraction

import mpmath
import numpy as np
import pytest

from meshwright import Drive
from meshwright.base.library import ffi, library
from meshwright.cli import main
from meshwright.contact.certified_path import certified_path
from meshwright.contact.results import ARCSEC
from meshwright.cycle import certified_first_path
from meshwright.cycle.certified import certified_window
from meshwright.cycle.windows import contact_window
from meshwright.design.design import packaged_names
from tests.certified.test_points import DIGITS, exact_error
from tests.quick import quick


def test_a_turn_of_the_worm_is_one_branch_and_its_error_lies_in_a_narrow_tube():
    drive = Drive.load("recess-action-full")
    path = drive.certify_path(0.0, 2 * np.pi)
    assert path.complete and path.tube < 5e-8 * ARCSEC
    degrees = [Fraction(7), Fraction(180), Fraction(353)]
    result = drive.tca(np.radians([float(d) for d in degrees]))
    with mpmath.workdps(DIGITS):
        for k, angle in enumerate(degrees):
            exact = exact_error(drive.design.given(), result, k, angle) * mpmath.pi / 648000
            low, high = path.error(float(result.angles[k]))
            # the angle of the path is a double, next to the decimal
            assert low - 1e-18 <= exact <= high + 1e-18
            assert high - low < 1e-7 * ARCSEC


def test_bounds_of_the_error_hold_every_point_and_are_narrow():
    drive = Drive.load("recess-action-semi")
    path = certified_path(drive, -3.0, 3.0)
    errors = drive.tca(np.linspace(-3.0, 3.0, 20001)).error
    low, high = path.error_range
    assert low <= errors.min() and errors.max() <= high
    least, most = path.peak_to_peak
    assert least <= np.ptp(errors) + 1e-15 and np.ptp(errors) <= most
    assert most - least < 1e-4 * most


def test_where_branches_cross_the_path_has_a_gap_that_says_so():
    drive = Drive.load("zk-zn-90")
    path = certified_path(drive, np.radians(4.0), np.radians(6.0))
    assert not path.complete
    crossing = np.radians(4.832354)
    assert any(gap.begin - 1e-6 <= crossing <= gap.end + 1e-6 for gap in path.gaps)
    assert sum(gap.end - gap.begin for gap in path.gaps) < np.radians(0.1)


#: Packaged designs that touch in points over a whole pitch about their reference angle.
QUICK = ("recess-action-standard", "plain-zi", "spherical-table-2-2-convex-14-5", "face-worm-conical-convex")


def cycle(name):
    drive = Drive.load(name)
    middle, half = drive.design.reference_angle, 0.5 * drive.pitch()
    return drive, certified_path(drive, middle - half, middle + half)


@pytest.mark.parametrize("name", QUICK)
def test_a_whole_mesh_cycle_is_covered(name):
    _, path = cycle(name)
    assert path.complete and path.tube < 5e-8 * ARCSEC


@pytest.mark.validate
@pytest.mark.parametrize("name", packaged_names())
def test_the_mesh_cycle_of_every_packaged_drive_is_covered_or_the_place_is_named(name):
    drive, path = cycle(name)
    if path.complete:
        assert path.tube < 5e-8 * ARCSEC
        return
    lines = set(drive.tca(np.linspace(path.begin, path.end, 9)).status) == {"line_contact"}
    named = {gap.reason for gap in path.gaps}
    assert named <= {"wide", "fold", "no_contact", "joint", "design", "tube"} and (lines or named)


#: One of a kind: contact that crosses the middle of a face, where its margin has a corner, and reliefs among them.
ENDED = ("recess-action-standard", "plain-za", "spherical-table-2-3", "bevel-formate", "helical-crowned")


@pytest.mark.parametrize("name", quick(packaged_names(), *ENDED))
def test_the_command_bounds_ends_contact_ratio_and_peak_to_peak_error(name, capsys, monkeypatch):
    monkeypatch.setattr(certified_first_path, "BUDGET", 0)  # first contact is asked for elsewhere
    assert main(["ratio", name, "--certify", "--json", "-"]) in (0, 1)
    found = json.loads(capsys.readouterr().out)
    certificate = found["certificate"]
    if certificate is None or certificate["contact_ratio"] is None:
        assert name not in ENDED and (certificate is None or certificate["outcome"] in ("unknown", "enclosed"))
        return
    assert certificate["outcome"] == "unique" and not certificate["gaps"]
    for key, value, width in (
        ("contact_ratio", found["contact_ratio"], 1e-6),
        ("pair_peak_to_peak_arcsec", found["transmission_error"]["pair_peak_to_peak_arcsec"], 1e-5),
    ):
        low, high = certificate[key]
        assert low - 1e-9 <= value <= high + 1e-9 and high - low < width * (1.0 + value)
    ends = sorted(found[end]["pinion_angle_deg"] for end in ("begin", "end"))
    for end, angle in zip(("smaller_angle", "larger_angle"), ends, strict=True):
        low, high = certificate[end]["pinion_angle_deg"]
        assert low - 1e-7 <= angle <= high + 1e-7 and high - low < 1e-3
        assert certificate[end]["event"] in (found["begin"]["event"], found["end"]["event"])


@pytest.mark.parametrize("hand", ["left", "right"])
def test_pairs_change_between_bounds(hand, capsys, monkeypatch):
    """At the one bound a pair is ahead of its neighbour, at the other behind it: by contacts certified there."""
    monkeypatch.setattr(certified_first_path, "BUDGET", 0)
    assert main(["ratio", "plain-za", f"--set=design.hand={hand}", "--certify", "--json", "-"]) == 0
    found = json.loads(capsys.readouterr().out)
    drive = Drive.load("plain-za").with_(design={"hand": hand})
    angles = found["transmission_error"]["transfer_angles_deg"]
    for (low, high), angle in zip(found["certificate"]["transfer_angles_deg"], angles, strict=True):
        assert low - 1e-9 <= angle <= high + 1e-9 and high - low < 1e-5
    (low, high), (later, last) = np.radians(found["certificate"]["transfer_angles_deg"])
    assert later == pytest.approx(low + drive.pitch()) and last == pytest.approx(high + drive.pitch())
    here, there = (drive.certify(ends).error_arcsec() for ends in ([low, high], [later, last]))
    signs = [np.sign(there[k] - here[k, ::-1]) for k in range(2)]
    assert (np.abs(signs) == 1.0).all() and (signs[0] == -signs[1]).all()


def test_a_change_of_pairs_beyond_the_window_is_not_stated(capsys, monkeypatch):
    monkeypatch.setattr(certified_first_path, "BUDGET", 0)
    assert main(["ratio", "recess-action-standard", "--certify", "--json", "-"]) == 0
    found = json.loads(capsys.readouterr().out)
    begin, end = sorted(found[key]["pinion_angle_deg"] for key in ("begin", "end"))
    inside = all(begin <= angle <= end for angle in found["transmission_error"]["transfer_angles_deg"] or ())
    assert (found["certificate"]["transfer_angles_deg"] is not None) == inside


def test_what_is_not_shown_widens_the_bounds_of_an_end():
    """A margin that a piece does not enclose is neither positive nor lost there: the end lies between what is shown."""
    drive = Drive.load("recess-action-standard")
    path = certified_window(drive, contact_window(drive)).path
    middle = 0.5 * (path.begin + path.end)
    event, low, _ = path.first_exit(middle, 1)
    blurred = next(k for k, (begin, _) in enumerate(path.ends) if begin > middle)
    path.pieces[blurred].margin[0].radius = np.inf
    found, least, most = path.first_exit(middle, 1)
    assert found == event and least == pytest.approx(path.ends[blurred][0]) and least < low < most


def test_a_line_of_contact_has_ends_and_no_certificate(capsys):
    modified = [f"design.pinion_{side}_crowning_um=0" for side in ("lead", "profile")]
    options = [word for text in modified for word in ("--set", text)]
    assert main(["ratio", "helical-crowned", *options, "--set", "misalignment.horizontal_deg=0"]) in (0, 1)
    assert "certified" not in capsys.readouterr().out


def test_bounds_of_a_polynomial_hold_its_values():
    """Of random polynomials of a piece, against exact evaluation."""
    rng = np.random.default_rng(5)
    piece = ffi.new("mw_piece *", {"centre": 0.3, "half": 0.7})
    for _ in range(50):
        polynomial = ffi.addressof(piece.x[0])
        coefficients = rng.uniform(-1, 1, 9) * 10.0 ** -np.arange(9)
        for k in range(9):
            polynomial.c[k] = coefficients[k]
        polynomial.radius = 1e-12
        bounds = np.empty(2)
        library().mw_piece_range(piece, polynomial, -0.4, 1.0, 8, ffi.from_buffer("double[]", bounds))
        for angle in np.linspace(-0.39, 0.99, 7).tolist():
            share = (Fraction(angle) - Fraction(0.3)) / Fraction(0.7)
            value = sum(Fraction(float(c)) * share**k for k, c in enumerate(coefficients))
            ball = library().mw_piece_at(piece, polynomial, angle)
            assert abs(Fraction(ball.mid) - value) <= Fraction(ball.radius)
            assert Fraction(bounds[0]) <= value <= Fraction(bounds[1])
        exact = [sum(c * s**k for k, c in enumerate(coefficients)) for s in np.linspace(-1, 1, 2001)]
        assert bounds[0] > min(exact) - 1e-4 and bounds[1] < max(exact) + 1e-4
