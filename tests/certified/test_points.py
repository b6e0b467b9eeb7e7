"""Certified points: what is shown of published and misaligned contacts is true to sixty digits; no more is shown."""

import json
from fractions import Fraction

import mpmath
import numpy as np
import pytest

from meshwright import Drive
from meshwright.base.library import ffi, library, pointer, proofs, record
from meshwright.cli import main
from meshwright.contact.certificate import certify, certify_boxes, certify_many
from meshwright.contact.results import ARCSEC
from meshwright.design.design import packaged_names
from tests.certified import trials
from tests.independent.chords import chords
from tests.independent.spherical import Gear, Pair
from tests.independent.worm import WormDrive
from tests.lanes import available
from tests.published import published_rows
from tests.quick import ONE_OF_A_KIND, quick
from tests.worm.designs import packaged, plain

DIGITS = 60


def decimals(tables):
    """A design with each of its numbers as the decimal that is written, in the precision of the moment."""
    return {
        name: {k: mpmath.mpf(repr(float(v))) if isinstance(v, float) else v for k, v in entries.items()}
        if isinstance(entries, dict)
        else entries
        for name, entries in tables.items()
    }


def exact_error(tables, result, k, degrees):
    """Transmission error of a worm drive at so many degrees, arcseconds, by other equations in sixty digits."""
    paper, phi = WormDrive.of(decimals(tables)), mpmath.mpf(degrees.numerator) / degrees.denominator * mpmath.pi / 180
    u = {name: values[k] for name, values in result.unknowns.items()}
    start = [u["t_worm"], u["psi_worm"], u["t_hob"], u["psi_hob"], u["phi_hob"], result.wheel_angles[k]]
    wheel_angle = chords(lambda x: paper.residual(x, phi), start)[5]
    return (wheel_angle - mpmath.mpf(paper.threads) / paper.teeth * phi) * 648000 / mpmath.pi


def contains(bounds, value):
    """Whether sixty digits lie between two doubles, with what sixty digits themselves leave open."""
    low, high = map(float, bounds)
    slack = mpmath.mpf(10) ** -30
    return mpmath.mpf(low) - slack <= value <= mpmath.mpf(high) + slack


def test_every_published_contact_is_the_only_one_and_its_error_is_known_to_a_nanosecond_of_arc():
    rows, _ = published_rows()
    for kind in ("standard", "semi", "full"):
        drive = Drive.load(f"recess-action-{kind}")
        degrees = [Fraction(str(row["phi_worm_deg"])) for row in rows if row["type"] == kind]
        result = drive.tca(np.radians([float(d) for d in degrees]))
        found = drive.certify(result.angles, result, degrees)
        assert set(found.outcomes) == {"unique"} and len(degrees) == 5
        errors = found.error_arcsec()
        assert np.all(errors[:, 1] - errors[:, 0] < 2e-9)
        with mpmath.workdps(DIGITS):
            for k in (0, 4):
                assert contains(errors[k], exact_error(drive.design.given(), result, k, degrees[k]))


@pytest.mark.parametrize("profiles", [("ZK", "ZN"), ("ZI", "ZI"), ("ZC", "ZC")])
def test_enclosures_hold_the_solution_of_other_equations_in_sixty_digits(profiles):
    errors = {"center_distance_mm": 0.03, "horizontal_deg": 0.03, "vertical_deg": -0.02, "axial_mm": 0.05}
    tables = plain(*profiles, hob_pitch_radius_mm=21.5) | {"misalignment": errors}
    drive, degrees = Drive.from_tables(tables), [Fraction("-25.1"), Fraction("10.3")]
    result = drive.tca(np.radians([float(d) for d in degrees]))
    found = drive.certify(result.angles, result, degrees)
    assert found.outcomes == ("unique", "unique")
    with mpmath.workdps(DIGITS):
        for k, angle in enumerate(degrees):
            assert contains(found.error_arcsec()[k], exact_error(tables, result, k, angle))


def test_an_enclosed_spherical_contact_holds_every_unknown_to_sixty_digits():
    tables = {
        "drive": "spherical",
        "flank": "left",
        "design": {
            "module_mm": 4.0, "pinion_teeth": 36, "wheel_teeth": 72, "pressure_angle_deg": 20.0, "face_width_mm": 15.0,
            "pinion_form": "convex", "wheel_form": "concave",
            "pinion_sphere_radius_mm": 72.0, "wheel_sphere_radius_mm": 144.0,
        },
        "misalignment": {"center_distance_mm": 0.1, "horizontal_deg": 0.03, "vertical_deg": -0.5},
    }  # fmt: skip
    drive = Drive.from_tables(tables)
    found = drive.certify([0.0625])
    assert found.outcomes == ("unique",)
    with mpmath.workdps(DIGITS):
        gears = [
            Gear(4, teeth, mpmath.radians(20), form, radius, 1)
            for teeth, form, radius in ((36, "convex", mpmath.mpf(72)), (72, "concave", mpmath.mpf(144)))
        ]
        pair = Pair(*gears, mpmath.mpf("0.1"), mpmath.radians(mpmath.mpf("0.03")), mpmath.radians(mpmath.mpf("-0.5")))
        for entry, value in zip(found.records["x"][0], pair.solve(mpmath.mpf("0.0625")), strict=False):
            middle = mpmath.mpf(float(entry["hi"])) + mpmath.mpf(float(entry["lo"]))
            assert abs(value - middle) <= mpmath.mpf(float(entry["radius"])) + mpmath.mpf(10) ** -45
            assert entry["radius"] < 1e-18


@pytest.mark.parametrize("name", quick(packaged_names(), *ONE_OF_A_KIND))
def test_every_packaged_design_is_enclosed_and_its_contact_certain_or_a_line(name):
    drive = Drive.load(name)
    assert drive.enclosed.failed is None
    result = drive.tca([drive.design.mirror.sign * drive.design.reference_angle])
    found = drive.certify(result.angles, result)
    assert found.outcomes == ("unique",) or (found.reasons == result.status == ("line_contact",))
    for given, complete in zip(drive.enclosed.parameters, drive.design.parameters, strict=True):
        assert np.isnan(complete) or abs(float(given["hi"]) - complete) <= 1e-9 * (1.0 + abs(complete))


@pytest.mark.parametrize("given", [("pinion", "wheel"), ("pinion",), ("pinion", "shaft")])
def test_parallel_axes_are_exactly_parallel_whatever_says_so(given):
    """The shaft angle is the sum of the helix angles: 0 exactly, not between bounds about 0."""
    angles = {"pinion_helix_angle_deg": 22.3, "wheel_helix_angle_deg": -22.3, "shaft_angle_deg": 0.0}
    drive = Drive.load("helical-crowned").with_(
        design={key: number if key.startswith(given) else None for key, number in angles.items()}
    )
    assert drive.enclosed.failed is None
    index = [p["name"] for p in drive.design.description["parameters"]].index("Sigma")
    assert drive.enclosed.parameters[index].tolist() == (0.0, 0.0, 0.0)
    assert drive.certify(drive.about_the_middle([0.0, 0.1])).outcomes == ("unique", "unique")


def test_why_nothing_is_certain_is_said_in_a_sentence():
    said = Drive.load("spherical-table-2-1").certify([0.0, 0.1]).said()
    assert said == (
        "not certified: the flanks touch along a line, or nearly: no single point is singled out (at 2 angles)"
    )


def test_contact_along_a_line_is_never_called_a_single_point():
    drive = Drive.load("recess-action-full")
    radius = drive.design.as_solved()["design"]["worm_pitch_radius_mm"]
    for share, outcomes in ((0.0, {"unknown"}), (1e-9, {"unknown", "unique"}), (1e-4, {"unique"})):
        near = drive.with_(design={"hob_pitch_radius_mm": radius * (1.0 + share)})
        found = near.certify(np.radians([0.0, 400.0]))
        assert set(found.outcomes) <= outcomes
    assert set(Drive.load("spherical-table-2-1").certify([0.0, 0.1]).reasons) == {"line_contact"}


def test_at_a_pitchfork_nothing_is_claimed_and_beside_it_the_point_is_certain():
    drive = Drive.load("zk-zn-90")
    (point,) = drive.limits().branch_points
    near = drive.tca(point.angle + np.radians([-0.01, 0.01]))
    assert set(drive.certify(near.angles, near).outcomes) == {"unique"}
    at = certify(drive, [point.angle], near.solutions[:1], [False])
    assert at.outcomes == ("unknown",) and at.reasons[0] in ("fold", "wide")


@pytest.fixture(scope="module")
def folding():
    """A drive, an angle 1e-3 rad before a fold, and its contacts there, two of which are about to meet."""
    drive, fold = trials.fold()
    return drive, fold - 1e-3, drive.contacts(fold - 1e-3).solutions


def test_two_contacts_about_to_meet_are_two_and_a_box_around_both_is_never_said_to_hold_one(folding):
    drive, angle, solutions = folding
    rows = np.full(len(solutions), angle)
    found = certify(drive, rows, solutions, np.zeros(len(rows)))
    assert set(found.outcomes) == {"unique"}
    pairs = [(a, b) for i, a in enumerate(solutions) for b in solutions[:i]]
    middles, apart = np.array([(a + b) / 2 for a, b in pairs]), np.array([abs(a - b) / 2 for a, b in pairs])
    for share in (1.0001, 1.5, 3.0):
        around = certify_boxes(drive, rows[: len(pairs)], middles, share * apart + 1e-9)
        assert "unique" not in around.outcomes and "none" not in around.outcomes


def test_of_boxes_beside_solutions_about_folds_and_lines_nothing_wrong_is_claimed():
    shown = trials.run(2000, 1)
    assert shown["beside"]["unique"] > 80 and shown["beside"]["none"] > 80
    assert shown["turned"]["none"] > 80 and shown["turned"]["unique"] == 0
    assert shown["lines"]["unique"] == shown["lines"]["none"] == 0
    for kind in ("meeting", "crossing"):
        assert min(shown[kind].values()) > 5


@pytest.mark.validate
def test_of_many_more_boxes_nothing_wrong_is_claimed():
    """A million: ``python -m tests.certified.trials 1000000``."""
    shown = trials.run(100_000, 2)
    assert sum(numbers["unique"] for numbers in shown.values()) > 10_000


def test_a_contact_that_bodies_cannot_make_is_certain_as_a_solution_and_named():
    drive = Drive.from_tables(packaged("zk-zn-90"))
    found = drive.contacts(np.radians(60.0))
    rows = [k for k, flags in enumerate(found.flags) if {"interference", "spurious_sheet"} & set(flags)]
    for k in rows:
        certified = certify(drive, found.angles[k : k + 1], found.solutions[k : k + 1], [False])
        assert certified.outcomes == ("unique",) and certified.impossible(0)


def test_the_command_writes_certificates_of_the_decimals_asked_for(capsys):
    assert main(["tca", "recess-action-full", "--phi-deg", "100:300:100", "--certify", "--json", "-"]) == 0
    points = json.loads(capsys.readouterr().out)["points"]
    for point in points:
        certificate = point["certificate"]
        assert certificate["outcome"] == "unique" and certificate["reason"] is None
        low, high = certificate["transmission_error_arcsec"]
        assert low <= high and certificate["radius"] < 1e-9
        assert abs(point["transmission_error_arcsec"] - low) < 1e-9
        apart = np.subtract(certificate["contact_point_mm"], point["contact_point_mm"])
        assert np.abs(apart).max() < 1e-11 + certificate["contact_point_radius_mm"]
        assert certificate["flags"]["interference"] == "no"


def test_the_mirror_image_is_certified_with_the_other_sign():
    right = Drive.load("recess-action-full")
    left = right.with_(design={"hand": "left"})
    there, mirrored = right.certify([1.0]).error_arcsec()[0], left.certify([-1.0]).error_arcsec()[0]
    assert tuple(mirrored) == (-there[1], -there[0])
    assert left.tca([-1.0]).error[0] / ARCSEC == pytest.approx(mirrored.mean(), abs=1e-9)


@pytest.mark.parametrize("name", quick(["recess-action-full", "helical-crowned"]))
def test_lanes_show_what_points_show_with_bounds_of_plain_doubles(name):
    drive = Drive.load(name)
    angles = np.linspace(-0.4, 0.4, 50) * drive.pitch()
    solutions = drive.trace(angles)[0]
    narrow = certify(drive, angles, solutions, np.zeros(len(angles)))
    for width in (1, *available()):
        unique, bounds = certify_many(drive, angles, solutions, width)
        assert unique.all()
        assert np.all((bounds[:, 1] - bounds[:, 0]) / ARCSEC < 2e-7)
        for k in range(len(angles)):
            low, high = narrow.error(k)
            assert Fraction(bounds[k, 0]) <= low and high <= Fraction(bounds[k, 1])


def certificates_and_bounds(drive, m, proved_by, solutions):
    """Bits of certificates by the table ``m``, and errors of many points by ``proved_by``, a degree apart."""
    n, state = len(solutions), pointer(drive.enclosed.state.copy(), "mw_wide[]")
    phi, found = np.zeros(n, record("mw_wide")), np.zeros(n, record("mw_certificate"))
    phi["hi"] = np.radians(np.arange(n))
    unique, errors = np.zeros(n, np.uint8), np.zeros(n, record("mw_ball"))
    points = pointer(phi, "mw_wide[]"), pointer(solutions)
    lines = pointer(np.zeros(n, np.int32), "int[]")
    shown = library().mw_certify_points(m, state, *points, lines, n, pointer(found, "mw_certificate[]"))
    many = pointer(unique, "unsigned char[]"), pointer(errors, "mw_ball[]")
    assert library().mw_certify_many(ffi.NULL, proved_by, m, state, *points, n, *many) == shown == n
    return found.tobytes(), errors


TWICE_DIVIDED = "crossed-helical-17-23"  # its equations divide by one number more than once


@pytest.mark.parametrize(
    "name", quick(["recess-action-full", "face-worm-cylindrical-convex", TWICE_DIVIDED], TWICE_DIVIDED)
)
def test_certificates_by_tables_have_the_bits_of_those_by_printed_code(name):
    """With the object of proofs, which is compiled only for many of them, and without it. Of many points, printed code
    shares bounds among them: its errors and the tables' are two enclosures of the same numbers, those in certificates.
    """
    drive = Drive.load(name)
    solutions = np.ascontiguousarray(drive.trace(np.radians(np.arange(12.0)))[0])
    printed, room = proofs(drive.design.description["name"]), ffi.new("double[]", library().mw_joined_size() // 8 + 1)
    joined = library().mw_joined(drive.model, ffi.NULL, printed, room)
    by_tables, one_by_one = certificates_and_bounds(drive, drive.model, ffi.NULL, solutions)
    by_printed_code, together = certificates_and_bounds(drive, joined, printed, solutions)
    assert by_printed_code == by_tables
    error = np.frombuffer(by_tables, record("mw_certificate"))["x"][:, drive.design.description["error"]]
    for errors in (one_by_one, together):
        assert (np.abs(error["hi"] - errors["mid"]) + error["radius"] <= errors["radius"]).all()
        assert (errors["radius"] < 1e-13).all()
    assert library().mw_joined(Drive.load("plain-za").model, ffi.NULL, printed, room) == ffi.NULL


@pytest.mark.parametrize("name", ["bevel-crowned-both", "plain-za"])
@pytest.mark.parametrize("hand", ["left", "right"])
def test_reported_errors_are_those_of_the_proofs(name, hand, capsys):
    """The nearest double of each enclosed transmission error, and relative ones that refer to one such."""
    drive = Drive.load(name).with_(design={"hand": hand})
    middle = np.degrees(drive.design.mirror.sign * drive.design.reference_angle)
    angles = [f"{middle + share * np.degrees(drive.pitch()):.3f}" for share in (-0.3, 0.1, 0.3)]
    command = ["tca", name, f"--set=design.hand={hand}", f"--phi-deg={','.join(angles)}", "--json", "-"]
    assert main(command) == 0
    points = json.loads(capsys.readouterr().out)["points"]
    degrees = [Fraction(angle) for angle in angles]
    bounds = drive.certify(np.radians([float(a) for a in degrees]), degrees=degrees).error_arcsec()
    at_reference = drive.certify([np.radians(middle)]).error_arcsec()[0].mean()
    for point, (low, high) in zip(points, bounds, strict=True):
        error = point["transmission_error_arcsec"]
        assert low - 4e-16 * abs(low) - 1e-22 <= error <= high + 4e-16 * abs(high) + 1e-22
        assert point["transmission_error_relative_arcsec"] == pytest.approx(error - at_reference, abs=1e-12)


@pytest.mark.parametrize("width", [1, 0])
def test_points_in_any_order_are_shown_beside_some_that_are_none(width):
    """Points that share bounds may be anywhere; what is no solution, or no number, is never shown to be one."""
    drive, rng = Drive.load("helical-crowned"), np.random.default_rng(5)
    angles = drive.design.reference_angle + rng.permutation(np.linspace(-0.5, 0.5, 600)) * drive.pitch()
    solutions = drive.trace(np.sort(angles))[0][np.argsort(np.argsort(angles))]
    narrow = certify(drive, angles, solutions, np.zeros(len(angles)))
    solutions[7], solutions[300, 2], solutions[550, drive.design.description["error"]] = np.nan, np.inf, 0.5
    unique, bounds = certify_many(drive, angles, solutions, width)
    none = [7, 300, 550]
    assert not unique[none].any() and np.delete(unique, none).all()
    for k in np.flatnonzero(unique):
        low, high = narrow.error(k)
        assert Fraction(bounds[k, 0]) <= low and high <= Fraction(bounds[k, 1])
