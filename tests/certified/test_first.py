"""First contact with a proof: shown where nothing else touches, refuted where something does, never shown wrongly."""

import json
import math

import numpy as np
import pytest

from meshwright import Drive
from meshwright.base.library import ffi
from meshwright.cli import main
from meshwright.contact.results import ARCSEC
from meshwright.cycle import certified_first_path
from meshwright.cycle.certified_cycle import leading
from tests.cycle.test_first_contact import EDGE_FIRST
from tests.independent.first_touch import FirstTouch

#: Angles in degrees at which a packaged drive touches first where it is tangent.
FIRST = {"recess-action-full": 100.0, "plain-zn": 0.0, "spherical-table-4-4-concave": 0.0}

#: A ZK worm with a ZN hob, tilted: at -60 degrees an edge touches before the flanks are tangent, at 0 none does.
TILTED = EDGE_FIRST | {
    "design": EDGE_FIRST["design"] | {"worm_profile": "ZK", "hob_profile": "ZN", "grinding_wheel_radius_mm": 50.0},
    "misalignment": {"center_distance_mm": -0.03, "vertical_deg": -0.04},
}


def proved(drive, degrees, neighbours=0):
    """TCA, certificates and proofs of first contact at angles in degrees."""
    contacts = drive.tca(np.radians(degrees))
    certificates = drive.certify(contacts.angles, contacts)
    return contacts, certificates, drive.certify_first(contacts.angles, contacts, certificates, neighbours=neighbours)


def met(drive, contacts, q, starts=9, later=0, along=None):
    """How far places q (N, 2) of the wheel's flank are apart, rad, by the wheel's turn alone, with the pinion's place,
    of a pair so many later; by Newton's method on positions from several places of the pinion, if given from ``along``
    (lowest, highest) of its second parameter, the nearest to a contact of them.
    """
    angle = drive.design.mirror.sign * (contacts.angles[0] - later * drive.pitch())
    search = FirstTouch(drive, angle, contacts.solutions[0], 1.0)
    best = np.full((len(q), len(search.start)), np.nan)
    middle, size = search.start[1], search.sizes[1]
    for place in np.linspace(*(along or (middle - size, middle + size)), starts):
        start = np.tile(search.start, (len(q), 1))
        start[:, 1] = place
        found = search.meet(q, start)
        nearer = ~(np.abs(found[:, -1] - search.start[-1]) >= np.abs(best[:, -1] - search.start[-1]))
        nearer &= np.isfinite(found[:, -1])
        best[nearer] = found[nearer]
    side = np.sign(drive.design.mirror.sign * drive.first_contact(contacts.angles, contacts).levers[0])
    side = side if np.isfinite(side) else _opening(drive, contacts)
    return side * (search.start[-1] - best[:, -1]), best[:, :-1]


def _opening(drive, contacts):
    """+1 where a growing wheel angle opens the gap: lever arms of the tangency itself."""
    return np.sign(drive.design.mirror.sign * contacts.lever_arms["wheel"][0])


def places(rng, box, count):
    return np.stack([rng.uniform(*ends, count) for ends in box.values()], axis=1)


@pytest.mark.parametrize("name", FIRST)
def test_what_touches_first_is_shown_to_and_no_place_overlaps(name):
    drive = Drive.load(name)
    contacts, _, found = proved(drive, [FIRST[name]])
    assert found.outcomes == ("first",) and found.slacks[0] * found.radii[0] < 1e-6
    q = places(np.random.default_rng(3), found.boxes["wheel"], 400)
    away, p = met(drive, contacts, q[_inside(drive, "wheel", q)])
    kept = _inside(drive, "pinion", p) & (np.abs(away) < found.reach)
    assert kept.sum() > 20
    assert np.all(away[kept] > -found.slacks[0])


def _inside(drive, member, q):
    at = drive.flank(member)(q)
    values = np.stack([at.regular, *at.margins.values()], axis=1)
    return np.isfinite(at.points).all(axis=1) & np.all(np.isnan(values) | (values >= 0.0), axis=1)


def refuted(drive, degrees):
    contacts, _, found = proved(drive, [degrees])
    assert found.outcomes == ("not_first",)
    entry = found.records[0]
    away, p = met(drive, contacts, entry["wheel"][None])
    assert _inside(drive, "wheel", entry["wheel"][None])[0] and _inside(drive, "pinion", p)[0]
    assert abs(away[0] - entry["apart"]["mid"]) <= entry["apart"]["radius"] < -entry["apart"]["mid"]
    assert p[0] == pytest.approx(entry["pinion"], abs=1e-6)
    overlap = drive.first_contact(contacts.angles, contacts).overlaps(contacts.error)[0]
    assert overlap > 1e-4  # mm, by the search of floating point


def test_an_edge_that_touches_before_is_found_with_a_place_that_overlaps():
    drive = Drive.from_tables(TILTED)
    refuted(drive, -60.0)
    assert proved(drive, [0.0])[2].outcomes == ("first",)


@pytest.mark.validate
def test_a_face_that_touches_before_the_tangency_of_a_hob_of_another_profile():
    refuted(Drive.from_tables(EDGE_FIRST), -40.0)


def test_a_wheel_turned_into_the_worm_by_a_second_of_arc_is_never_first():
    drive = Drive.load("plain-zn")
    contacts, certificates, _ = proved(drive, [0.0])
    words = {}
    for turn in (-1.0, 1.0):
        turned = certificates.records.copy()
        turned["wheel_angle"]["mid"] += turn * ARCSEC
        moved = type(certificates)(drive, turned, certificates.angles)
        words[turn] = drive.certify_first(contacts.angles, contacts, moved, neighbours=0).outcomes[0]
    opening = _opening(drive, contacts)
    assert words == {opening: "first", -opening: "not_first"}


def test_a_contact_that_is_not_on_the_flanks_or_not_proved_is_never_first():
    assert proved(Drive.load("recess-action-full"), [0.0])[2].reasons == ("off_flank",)
    assert proved(Drive.load("spur-profile-shift"), [0.0])[2].reasons == ("line_contact",)


def test_left_hand_is_the_mirror_image():
    tables = dict(Drive.load("plain-zn").design.given())
    left = Drive.from_tables(tables | {"flank": "left"}) if tables["flank"] == "right" else Drive.load("plain-zn")
    assert proved(left, [0.0])[2].outcomes == ("first",)


def test_the_command_says_so(capsys):
    assert main(["tca", "plain-zn", "--phi-deg=0", "--certify", "--json", "-"]) == 0
    certificate = json.loads(capsys.readouterr().out)["points"][0]["certificate"]["first_contact"]
    assert certificate["outcome"] == "first" and certificate["overlap_below_mm"] == 1e-6
    assert certificate["flanks"]["wheel"]["ended_by_limits"]
    assert main(["tca", "recess-action-full", "--phi-deg=100", "--certify"]) == 0
    assert "first)" in capsys.readouterr().out


def test_a_neighbouring_pair_overlaps_where_its_own_contact_comes_first():
    drive = Drive.load("recess-action-full")
    contacts, _, found = proved(drive, [100.0], neighbours=1)
    shift = drive.design.mirror.sign * drive.pitch() * np.array(list(found.neighbours))
    own = drive.tca(contacts.angles[0] - shift)
    earlier = _opening(drive, contacts) * drive.design.mirror.sign * (own.error - contacts.error[0]) > 1e-3 * ARCSEC
    assert not own.flags[0] and earlier[0]  # the pair before is on its flanks and comes first
    assert "off_tip" in own.flags[1]  # the one behind is not on them yet
    assert [of.outcomes for of in found.neighbours.values()] == [("not_first",), ("first",)]


def test_a_range_of_angles_is_first_at_each_and_no_place_overlaps():
    drive = Drive.load("recess-action-full")
    begin, end = np.radians([2400.0, 2418.0])
    found = drive.certify_first_path(begin, end, neighbours=0)
    assert found.outcome == "first" and found.failures == []
    assert [found.spans[0].begin, found.spans[-1].end] == [begin, end]
    assert all(a.end == b.begin for a, b in zip(found.spans, found.spans[1:], strict=False))
    rng = np.random.default_rng(5)
    for angle in rng.uniform(begin, end, 3):
        contacts = drive.tca([angle])
        q = places(rng, found.boxes["wheel"], 150)
        away, p = met(drive, contacts, q[_inside(drive, "wheel", q)])
        kept = _inside(drive, "pinion", p) & (np.abs(away) < found.reach)
        assert kept.sum() > 10
        assert np.all(away[kept] > -found.slack)


def test_over_a_range_a_wheel_turned_into_the_worm_is_never_first(monkeypatch):
    drive = Drive.load("recess-action-full")
    begin, end = np.radians([2400.0, 2402.0])
    words = {}
    for turn in (-ARCSEC, ARCSEC):

        def turned(_, member, __, turn=turn):
            return ffi.new("mw_wide *", [turn if member == "wheel" else 0.0, 0.0, 0.0])[0]

        monkeypatch.setattr(certified_first_path._Search, "_turn", turned)
        words[np.sign(turn)] = drive.certify_first_path(begin, end, neighbours=0).outcome
    opening = _opening(drive, drive.tca([begin]))
    assert words == {opening: "first", -opening: "not_first"}


def test_of_a_range_a_neighbour_that_comes_first_is_named():
    drive = Drive.load("recess-action-full")
    found = drive.certify_first_path(*np.radians([100.0, 101.0]), neighbours=1)
    words = {later: {span.outcome for span in found.of(later)} for later in found.pairs}
    assert words == {0: {"first"}, -1: {"not_first"}, 1: {"first"}} and found.outcome == "not_first"
    (failure,) = found.failures
    assert failure.overlap > 0.0 and failure.begin <= failure.angle <= failure.end
    alone = proved(drive, np.degrees([failure.angle]), neighbours=1)[2]
    assert alone.neighbours[-1].outcomes == ("not_first",)


def test_where_the_contact_leaves_the_flanks_nothing_is_shown():
    drive = Drive.load("recess-action-full")
    found = drive.certify_first_path(*np.radians([48.0, 52.0]), neighbours=0)  # the contact begins at 49.32
    assert found.outcome == "unknown" and {s.reason for s in found.failures} == {"off_flank"}
    assert found.spans[-1].outcome == "first" and 49.3 < np.degrees(found.spans[-1].begin) < 51.0


def test_what_overlaps_at_every_angle_of_a_range_does_so_at_its_named_place():
    drive = Drive.load("recess-action-full")
    found = drive.certify_first_path(*np.radians([2400.0, 2410.0]), neighbours=1)
    (span,) = found.of(-1)  # beyond the end of its tangency an edge of the pair before still touches
    assert span.outcome == "not_first" and span.throughout and span.overlap > found.slack
    for angle in (span.begin, span.angle, span.end):
        along = list(found.boxes["pinion"].values())[1]
        away, p = met(drive, drive.tca([angle]), np.array([span.wheel]), starts=41, later=-1, along=along)
        assert _inside(drive, "wheel", np.array([span.wheel]))[0] and _inside(drive, "pinion", p)[0]
        assert -found.reach < away[0] <= -span.overlap * (1.0 - 1e-6)


def test_work_is_bounded_and_what_is_left_is_said_to_be(monkeypatch):
    drive = Drive.load("plain-zn")
    begin, end = np.radians([-30.0, 30.0])
    monkeypatch.setattr(certified_first_path, "BUDGET", 50)
    found = drive.certify_first_path(begin, end, neighbours=0)
    assert {(span.outcome, span.reason) for span in found.spans} == {("unknown", "effort")}
    assert [found.spans[0].begin, found.spans[-1].end] == [begin, end]
    assert sum(span.parts for span in found.spans) <= 52


@pytest.mark.parametrize("name", ["recess-action-full", "plain-zn", "spherical-table-4-4-concave"])
def test_the_pairs_that_lead_share_one_pitch(name):
    drive = Drive.load(name)
    mesh = drive.contact_ratio().mesh
    ranges = leading(mesh)
    assert sum(b - a for a, b in ranges) == pytest.approx(drive.pitch(), abs=1e-6)
    for begin, end in ranges:
        angle = begin + 0.3 * (end - begin)
        assert mesh.pairs(angle)[0].number == 0 or mesh.pairs(angle)[0].separation < 1e-6


def certified_cycle_of(drive, capsys):
    """What ``ratio --certify`` says of first contact over the mesh cycle."""
    assert main(["ratio", drive.design.tables["name"], "--certify", "--json", "-"]) == 0
    found = json.loads(capsys.readouterr().out)["certificate"]["first_contact"]
    assert found["outcome"] == "not_first" and found["overlap_below_mm"] == 1e-6
    assert sum(b - a for a, b in found["cycle_deg"]) == pytest.approx(math.degrees(drive.pitch()), abs=0.01)
    overlaps = [span for span in found["spans"] if span["outcome"] == "not_first"]
    assert all(span["overlap_arcsec"] > 0.0 for span in overlaps)
    assert not any(
        max(a, span["pinion_angle_deg"][0]) < min(b, span["pinion_angle_deg"][1])
        for a, b in found["first_deg"] for span in found["spans"] if span["outcome"] != "first"
    )  # fmt: skip
    return found, overlaps


def test_of_a_drive_that_rides_on_an_edge_that_is_said_over_its_whole_mesh_cycle(capsys):
    found, overlaps = certified_cycle_of(Drive.load("recess-action-full"), capsys)
    assert found["first_deg"] == [] and {span["pairs_later"] for span in overlaps} == {-1}
    ends = sorted(span["pinion_angle_deg"] for span in overlaps)
    assert [ends[0][0], ends[-1][1]] == found["cycle_deg"][0]
    assert all(a[1] >= b[0] for a, b in zip(ends, ends[1:], strict=False))
    assert any(span["at_every_angle"] for span in overlaps)


@pytest.mark.validate
def test_of_a_mesh_cycle_it_is_said_where_nothing_touches_first(capsys):
    drive = Drive.load("plain-zn")
    found, overlaps = certified_cycle_of(drive, capsys)
    mesh = drive.contact_ratio().mesh
    clear = [a + share * (b - a) for a, b in found["first_deg"] for share in (0.1, 0.9)]
    for angle, later in [(angle, k) for angle in clear for k in (-1, 0, 1)]:
        assert _ahead(mesh, math.radians(angle), later) < 1e-8
    for span in overlaps[:3]:
        angle = math.radians(span["at_pinion_angle_deg"])
        assert _ahead(mesh, angle, span["pairs_later"]) >= span["overlap_arcsec"] * ARCSEC * (1.0 - 1e-6)


def _ahead(mesh, angle, later):
    """How far before the tangency of the pair 0 a pair touches first, rad, by the search of floating point."""
    return mesh.rigid.ahead(later, angle) - mesh.sense * mesh.errors(np.array([angle]))[0]


@pytest.mark.validate
def test_an_edge_that_touches_before_is_found_in_a_range():
    drive = Drive.from_tables(TILTED)
    found = drive.certify_first_path(*np.radians([-60.0, -40.0]), neighbours=0)
    assert found.outcome == "not_first"
    worst = max(found.failures, key=lambda span: span.overlap)
    assert proved(drive, np.degrees([worst.angle]))[2].outcomes == ("not_first",)
