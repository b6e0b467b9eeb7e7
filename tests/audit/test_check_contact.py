"""Proofs of contacts are verified from the description alone; forged ones are refused."""

import copy
import json
import math
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import mpmath
import numpy as np
import pytest

from derive.audit.checker import check_contact, intervals
from derive.audit.checker.refusal import Rejected
from meshwright import Drive
from meshwright.base.errors import UsageError
from meshwright.cli import main
from meshwright.design.design import packaged_names
from tests.quick import full, quick

GENERATED = Path(__file__).resolve().parents[2] / "generated"
#: Packaged designs whose flanks touch along lines: no point is singled out, and nothing is proved of one.
LINES = {"bevel-crown-pair", "bevel-face-hobbed-crown-pair", "spherical-table-2-1", "spur-profile-shift"}
POINTS = sorted(set(packaged_names()) - LINES)


def accepted(proof, folder):
    path = folder / "proof.json"
    path.write_text(proof if isinstance(proof, str) else json.dumps(proof), encoding="utf-8")
    return check_contact.check(path, GENERATED / "descriptions")


def refused(proof, folder, words):
    with pytest.raises((Rejected, *check_contact.UNREADABLE, check_contact.Open)) as error:
        accepted(proof, folder)
    assert words in str(error.value), error.value


def angles(drive, rng, count):
    """Degrees of some contacts within a pitch, decimals of four places."""
    middle, pitch = np.degrees(drive.about_the_middle(np.array([0.0]))[0]), np.degrees(drive.pitch())
    return [Fraction(round(1e4 * (middle + pitch * rng.uniform(-0.45, 0.45))), 10**4) for _ in range(count)]


@pytest.mark.parametrize(
    "name", quick(POINTS, "recess-action-full", "helical-crowned", "face-worm-conical-concave")
)
def test_contacts_of_packaged_designs_are_verified(name, tmp_path):
    rng = np.random.default_rng(len(name))
    drive = Drive.load(name)
    for degrees in angles(drive, rng, 50 if full() else 4):
        proof = drive.proof(degrees)
        accepted(proof, tmp_path)
        low, high = (float(end) for end in proof["transmission_error_arcsec"])
        plain = math.degrees(drive.tca([math.radians(degrees)]).error[0]) * 3600
        assert low - 1e-9 <= plain <= high + 1e-9 and high - low < 1e-10


@pytest.mark.parametrize("name", sorted(LINES))
def test_no_point_of_a_line_is_proved(name):
    with pytest.raises(UsageError, match="no proof at"):
        Drive.load(name).proof(1)


def test_the_other_hand_and_flank_are_verified(tmp_path):
    drive = Drive.load("plain-za").with_(design={"hand": "left"}, flank="left")
    proof = drive.proof("-3.25")
    accepted(proof, tmp_path)
    ends = [float(end) for end in proof["transmission_error_arcsec"]]
    assert ends[0] <= math.degrees(drive.tca([math.radians(-3.25)]).error[0]) * 3600 + 1e-9


@pytest.fixture(scope="module")
def worm():
    return Drive.load("recess-action-full").proof("2.5")


@pytest.fixture(scope="module")
def gears():
    return Drive.load("helical-crowned").proof("1.5")


def changed(proof, change):
    proof = copy.deepcopy(proof)
    change(proof)
    return proof


def moved(entry, by):
    return (float.fromhex(entry) + by).hex()


def each(proof, key, make):
    proof[key] = [make(float.fromhex(entry)).hex() for entry in proof[key]]


def set_at(key, k, value):
    def change(proof):
        proof[key][k] = value

    return change


def put(key, value):
    def change(proof):
        proof[key] = value

    return change


def swapped(key, i, j):
    def change(proof):
        proof[key][i], proof[key][j] = proof[key][j], proof[key][i]

    return change


def design(key, value):
    def change(proof):
        proof["design"][key] = value

    return change


def without(key):
    return lambda proof: proof.pop(key)


ZERO, ONE = "0x0.0p+0", "0x1.0000000000000p+0"
FORGED = {
    "centre moved": (lambda p: set_at("centre", 0, moved(p["centre"][0], 1e-9))(p), "so near"),
    "error moved": (lambda p: set_at("centre", 4, moved(p["centre"][4], 1e-15))(p), "so near"),
    "bounds moved": (lambda p: put("transmission_error_arcsec", ["0.001", "0.002"])(p), "not shown to lie"),
    "bounds exchanged": (lambda p: p["transmission_error_arcsec"].reverse(), "not shown to lie"),
    "bounds rounded inwards": (
        lambda p: put("transmission_error_arcsec", [e[:8] for e in p["transmission_error_arcsec"]])(p),
        "not shown to lie",
    ),
    "box too wide": (lambda p: each(p, "box", lambda d: d * 2.0**24), ""),
    "box 0": (lambda p: each(p, "box", lambda _: 0.0), "must lie in its box"),
    "box negative": (lambda p: each(p, "box", lambda d: -d), "must lie in its box"),
    "box infinite": (set_at("box", 0, "inf"), "not written as it must be"),
    "box no number": (set_at("box", 0, "nan"), "not written as it must be"),
    "box below its error": (lambda p: put("box", [(float.fromhex(e) / 2).hex() for e in p["within"]])(p), "in its box"),
    "error beyond the box": (
        lambda p: put("within", [(2 * float.fromhex(d)).hex() for d in p["box"]])(p), "in its box",
    ),
    "error 0": (lambda p: each(p, "within", lambda _: 0.0), "in its box"),
    "error too small": (lambda p: each(p, "within", lambda e: e / 64), "so near"),
    "preconditioner 0": (lambda p: put("preconditioner", [[ZERO] * 5] * 5)(p), "not shown"),
    "a row 0": (set_at("preconditioner", 2, [ZERO] * 5), "not shown"),
    "a row twice": (lambda p: set_at("preconditioner", 2, p["preconditioner"][1])(p), "not shown"),
    "transposed": (
        lambda p: put("preconditioner", [list(c) for c in zip(*p["preconditioner"], strict=True)])(p), "not shown",
    ),
    "short": (lambda p: p["preconditioner"].pop(), "must have 5 entries"),
    "an unknown dropped": (lambda p: p["unknowns"].pop(), "in this order"),
    "unknowns exchanged": (swapped("unknowns", 0, 1), "in this order"),
    "centres exchanged": (swapped("centre", 0, 1), ""),
    "another angle": (put("pinion_angle_deg", "2.50001"), "not shown"),
    "another hob": (design("design.hob_pitch_radius_mm", "20.1"), ""),
    "another flank": (design("flank", "left"), ""),
    "a misalignment": (design("misalignment.vertical_deg", "0.0001"), "not shown"),
    "a key unknown": (design("design.wheel_colour", "red"), "no key of this drive"),
    "a key missing": (lambda p: p["design"].pop("design.wheel_teeth"), "is missing"),
    "both of a pair": (design("design.axial_module_mm", "2.003"), "not exactly one of"),
    "277.5 teeth": (design("design.wheel_teeth", "277.5"), "whole number"),
    "a module below 0": (design("design.normal_module_mm", "-2.0"), "domain"),
    "another hash": (put("description_sha256", "0" * 64), "another hash"),
    "another drive": (put("drive", "cylindrical_worm_za_za"), "another hash"),
    "a path": (put("drive", "../descriptions/cylindrical_worm_zn_zn"), "not written as it must be"),
    "another schema": (put("schema", "meshwright.contact-proof/2"), "another schema"),
    "a system too many": (put("systems", {"zero_backlash": {}}), "other entries"),
    "an entry too many": (put("note", "sound"), "other entries"),
    "an entry missing": (without("within"), "other entries"),
    "a decimal centre": (set_at("centre", 0, "21.5"), "not written as it must be"),
    "a bare number": (set_at("centre", 0, 21.5), "numbers are texts"),
}  # fmt: skip


@pytest.mark.parametrize("what", FORGED)
def test_a_forged_proof_is_refused(what, worm, tmp_path):
    change, words = FORGED[what]
    refused(changed(worm, change), tmp_path, words)


@pytest.mark.parametrize("key", ["centre", "within", "preconditioner"])
def test_a_forged_proof_of_a_design_system_is_refused(key, gears, tmp_path):
    forged = copy.deepcopy(gears)
    system = forged["systems"]["zero_backlash"]
    forgery = {"centre": [moved(system["centre"][0], 1e-9)], "within": ["0x1.0p-140"], "preconditioner": [[ZERO]]}
    system[key] = forgery[key]
    refused(forged, tmp_path, "zero_backlash")
    refused(changed(gears, put("systems", {})), tmp_path, "zero_backlash is missing")


@pytest.mark.parametrize(
    "text",
    [
        '{"schema": "a", "schema": "a"}', "[" * 100_000, '{"schema"', "", "[]", "1e999", '{"schema": NaN}',
        '"meshwright"',
    ],
)  # fmt: skip
def test_text_that_is_no_proof_is_refused(text, tmp_path):
    path = tmp_path / "proof.json"
    path.write_text(text, encoding="utf-8")
    assert check_contact.main([str(path)]) == 1


SOUND = {
    "a small multiple of the preconditioner": lambda p: put(
        "preconditioner", [[(2.0**-1 * float.fromhex(e)).hex() for e in row] for row in p["preconditioner"]]
    )(p) or each(p, "within", lambda e: 4 * e),
    "one unit off": lambda p: put(
        "preconditioner", [[math.nextafter(float.fromhex(e), 9.0).hex() for e in row] for row in p["preconditioner"]]
    )(p),
    "half the box": lambda p: each(p, "box", lambda d: d / 2),
    "wider bounds": lambda p: put("transmission_error_arcsec", ["-90", "90.0"])(p),
    "keys in another order": lambda p: put("design", dict(reversed(p["design"].items())))(p),
}  # fmt: skip


@pytest.mark.parametrize("what", SOUND)
def test_what_proves_the_same_otherwise_is_accepted(what, worm, tmp_path):
    assert "one contact of ZN worm" in accepted(changed(worm, SOUND[what]), tmp_path)


def test_the_command_and_the_verifier_alone(tmp_path, capsys):
    """As a reader of the README does it: two commands, the second with nothing but Python."""
    target = tmp_path / "proof.json"
    words = ["tca", "plain-zk", "--certify", "--proof", str(target)]
    assert main([*words, "--phi-deg", "0.75"]) == 0 and main([*words, "--phi-deg", "0,0.1"]) == 0
    assert main(words) == 2 and "needs --certify and --phi-deg" in capsys.readouterr().err
    paths = [target, tmp_path / "proof-1.json", tmp_path / "proof-2.json"]
    command = [sys.executable, "-I", GENERATED / "audit" / "check_contact.py"]
    done = subprocess.run([*command, *paths], capture_output=True, text=True)
    assert done.returncode == 0 and done.stdout.count("one contact of ZK worm") == 3, done.stderr
    paths[1].write_text(paths[1].read_text().replace('"pinion_angle_deg": "0"', '"pinion_angle_deg": "0.1"'))
    done = subprocess.run([*command, *paths], capture_output=True, text=True)
    assert done.returncode == 1 and "proof-1.json: contact" in done.stderr


FUNCTIONS = {
    "sin": mpmath.sin, "cos": mpmath.cos, "tan": mpmath.tan, "asin": mpmath.asin, "acos": mpmath.acos,
    "atan": mpmath.atan, "sqrt": mpmath.sqrt, "atan2": mpmath.atan2,
}  # fmt: skip


@pytest.mark.parametrize("name", FUNCTIONS)
def test_intervals_hold_the_values_and_derivatives_of_eighty_digits(name):
    """At random intervals, some of one point: the function of points inside, and differences of it by derivatives."""
    rng = np.random.default_rng(len(name))
    with mpmath.workdps(80):
        for _ in range(60):
            places = [Fraction(float(n)) for n in rng.uniform(-0.9, 0.9, 2) * 10.0 ** rng.integers(-6, 1)]
            places = [abs(n) for n in places] if name == "sqrt" else places
            places = [n * 50 for n in places] if name in ("sin", "cos", "atan", "atan2") else places
            places = places if name == "atan2" else places[:1]
            width = Fraction(int(rng.integers(0, 2)), 2**60)
            arguments = [
                intervals.Enclosed((intervals.enclosed(n)[0], intervals.enclosed(n + width)[1]), along)
                for n, along in zip(places, ((intervals.UNIT,) * 2, (0,) * 2), strict=False)
            ]
            arguments = [intervals.Enclosed(a.pair, (tuple(a.rates),)) for a in arguments]
            made = intervals.OPERATIONS[name](*arguments)
            for share in (0, 1):
                at = [mpmath.mpf(n.numerator) / n.denominator + share * float(width) for n in places]
                value = FUNCTIONS[name](*at) * mpmath.mpf(2) ** intervals.BITS
                slope = mpmath.diff(lambda x, rest=at[1:]: FUNCTIONS[name](x, *rest), at[0]) * mpmath.mpf(2) ** 200
                assert made.pair[0] <= value <= made.pair[1]
                assert made.rates[0][0] - 2**120 <= slope <= made.rates[0][1] + 2**120
            assert width or made.pair[1] - made.pair[0] < 2**40


def test_what_is_surely_no_number_is_told_from_what_may_be_none():
    one = intervals.enclosed(1)
    for name, sure, doubtful in (("sqrt", (-2, -1), (-1, 1)), ("asin", (one[0] + 1, one[0] + 2), (one[0], one[0] + 1))):
        with pytest.raises(intervals.Undefined):
            intervals.OPERATIONS[name](intervals.Enclosed(sure))
        with pytest.raises(Rejected):
            intervals.OPERATIONS[name](intervals.Enclosed(doubtful))
    for around in ((0, 1), (-1, 1)):
        with pytest.raises(Rejected):
            intervals.inverse(intervals.Enclosed(around))
    kinks = intervals.size(intervals.Enclosed((-1, 1), (one,))), intervals.excess(intervals.Enclosed((-1, 1), (one,)))
    assert [kink.rates for kink in kinks] == [((-intervals.UNIT, intervals.UNIT),), ((0, intervals.UNIT),)]
    with pytest.raises(Rejected):
        intervals.OPERATIONS["sign"](intervals.Enclosed((-1, 1)))
