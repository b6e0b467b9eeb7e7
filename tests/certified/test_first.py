"""First contact with a proof: shown where nothing else touches, refuted where something does, never shown wrongly."""

import json

import numpy as np
import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.contact.results import ARCSEC
from tests.independent.first_touch import FirstTouch
from tests.test_first_contact import EDGE_FIRST

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


def met(drive, contacts, q, starts=9):
    """How far places q (N, 2) of the wheel's flank are apart, rad, by the wheel's turn alone, with the pinion's place;
    by Newton's method on positions from several places of the pinion, the nearest to a contact of them.
    """
    search = FirstTouch(drive, drive.design.mirror.sign * contacts.angles[0], contacts.solutions[0], 1.0)
    best = np.full((len(q), len(search.start)), np.nan)
    for shift in np.linspace(-1.0, 1.0, starts):
        start = np.tile(search.start, (len(q), 1))
        start[:, 1] += shift * search.sizes[1]
        found = search.meet(q, start)
        nearer = ~(np.abs(found[:, -1] - search.start[-1]) >= np.abs(best[:, -1] - search.start[-1]))
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
