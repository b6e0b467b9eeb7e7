"""Certified contacts of every family hold the solutions of other equations, written down by hand, in sixty digits.

A design's numbers are the decimals that are written; angles are exact decimals of a degree.
"""

from fractions import Fraction

import mpmath
import numpy as np
import pytest

from meshwright import Drive
from tests.bevel.test_fifty_digits import exact_contact, random_design
from tests.certified.test_points import DIGITS, decimals
from tests.face_worm.designs import ERRORS
from tests.independent.twins import twin

#: What sixty digits leave open of a number of some hundred millimetres, after chords that stop ten digits earlier.
OPEN = mpmath.mpf(10) ** -45


def inside(entry, value):
    """Whether a value lies in an enclosure of the library (hi, lo, radius or mid, radius)."""
    parts = [mpmath.mpf(float(entry[name])) for name in entry.dtype.names]
    return abs(value - sum(parts[:-1])) <= parts[-1] + OPEN


def certified(drive, degrees):
    """TCA and certificate at one angle, exact degrees."""
    result = drive.tca([np.radians(float(degrees))])
    found = drive.certify(result.angles, result, [degrees])
    assert found.outcomes == ("unique",)
    return result, found


def decimals_of(drive):
    """``{"table.key": value}`` (mm, rad) of every real key that the design gives, each the decimal that is written."""
    values = {}
    for p in drive.design.description["parameters"]:
        word = drive.design.tables.get(p["table"], {}).get(p["key"]) if p["table"] != "flank" else None
        if word is not None and not p["choices"] and isinstance(word, float):
            units = {"deg": mpmath.pi / 180, "um": mpmath.mpf("0.001")}
            values[f"{p['table']}.{p['key']}"] = mpmath.mpf(repr(word)) * units.get(p["key"].rsplit("_", 1)[1], 1)
    return values


FACE_WORM = ("face-worm-conical-convex", {"misalignment": ERRORS}, "-31.7")
CASES = (
    ("recess-action-full", {"misalignment": {"center_distance_mm": 0.03, "vertical_deg": -0.02}}, "141.7"),
    ("spherical-table-2-3", {"misalignment": {"center_distance_mm": 0.1, "horizontal_deg": 0.03}}, "1.25"),
    ("helical-crowned", {"misalignment": {"horizontal_deg": 0.01, "vertical_deg": 0.013}}, "-2.3"),
    ("crossed-helical-17-23", {"misalignment": {"axial_mm": 0.11}}, "3.9"),
)


def holds(name, changes, degrees):
    drive = Drive.load(name).with_(**changes)
    degrees = Fraction(degrees)
    result, found = certified(drive, degrees)
    with mpmath.workdps(DIGITS):
        other, phi = twin(drive, result), mpmath.mpf(degrees.numerator) / degrees.denominator * mpmath.pi / 180
        seen = other.solved(decimals_of(drive), phi)
        names = [u["name"] for u in drive.design.description["unknowns"]]
        for name, value in zip(other.names, seen, strict=False):
            entry = found.records["x"][0][names.index(name)]
            assert inside(entry, value) and entry["radius"] < 1e-16, name
        for entry, value in zip(found.records["point"][0], seen[len(other.names) :], strict=True):
            assert inside(entry, value) and entry["radius"] < 1e-9


@pytest.mark.parametrize("case", CASES, ids=lambda case: case[0])
def test_unknowns_and_contact_point_hold_those_of_the_twin(case):
    holds(*case)


@pytest.mark.validate
def test_so_do_those_of_a_face_worm_with_the_placement_of_its_cutter():
    holds(*FACE_WORM)


@pytest.mark.parametrize("seed", [1, pytest.param(2, marks=pytest.mark.validate)])
def test_error_and_contact_point_of_a_random_bevel_pair_hold_those_of_the_machine(seed):
    tables = random_design(seed)  # generated (1) and Formate (2) gears
    drive = Drive.from_tables(tables)
    degrees = Fraction(repr(round(float(np.degrees(drive.design.reference_angle)) + 2.0, 4)))
    result, found = certified(drive, degrees)
    with mpmath.workdps(DIGITS):
        phi = mpmath.mpf(degrees.numerator) / degrees.denominator * mpmath.pi / 180
        pair, x = exact_contact(decimals(tables), result, 0, phi)
        error = found.records["x"][0][drive.design.description["error"]]
        assert inside(error, pair.error(x, phi)) and error["radius"] < 1e-16
        point, _, _ = pair.pinion.surface(*x[:3])
        place, _ = pair.place_pinion(point, point, phi)
        for entry, value in zip(found.records["point"][0], place, strict=True):
            assert inside(entry, value) and entry["radius"] < 1e-9
