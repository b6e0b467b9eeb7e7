"""Where straight lines and the sections of a tooth meet the flanks that every tooth in contact has."""

import numpy as np
import pytest

from meshwright import Drive
from meshwright.fe.gap import ContactPlane
from meshwright.fe.pair import touches
from meshwright.fe.profile import Cut, Smooth
from meshwright.fe.solids import gear_pair
from meshwright.fe.tooth import moved
from tests.quick import quick

#: A thread and a generated wheel, threads that are envelopes, gears of one and of two parameters along the tooth.
NAMES = ("recess-action-full", "face-worm-conical-convex", "spherical-table-3-1-concave", "bevel-crowned-both")


@pytest.fixture(scope="module", params=quick(NAMES, *NAMES[1:3]))
def pair(request):
    return gear_pair(Drive.load(request.param))


def flank_of(pair, member, angle=0.0):
    """Curves of the working flank, and places (7, 2) with their sections in the middle of it."""
    of = getattr(pair, member)
    form = of.tooth(angle)
    flank = form.side(of.working).flank
    sections = np.linspace(*form.faces, 9)[1:-1]
    profile = 0.5 * (flank.first(sections) + flank.last(sections))
    face = flank.solve(sections, profile[:, None])[:, 0]
    return flank, sections, np.stack([profile, face], axis=1)


@pytest.mark.parametrize("member", ["pinion", "wheel"])
def test_normals_of_a_plane_meet_the_flank_where_it_is(pair, member):
    """Oblique lines through points of a flank, from feet far off it, back to these points."""
    flank, _, places = flank_of(pair, member, 0.1)
    assert isinstance(flank.surface, Smooth)
    points, normals = flank.surface(*places.T)
    way = normals[3] + 0.2 * np.array([0.3, -0.5, 0.4])
    plane = np.linalg.svd(way[None])[2][1:]
    feet = points + np.linspace(-2.0, 2.0, 7)[:, None] * way
    profile, face, met, _ = flank.surface.pierced(feet, plane, tuple(places[3]))
    assert flank.surface(profile, face)[0] == pytest.approx(met, abs=1e-9)
    assert (met - feet) @ plane.T == pytest.approx(np.zeros((7, 2)), abs=1e-9)
    near = slice(2, 5)
    assert np.stack([profile, face], axis=1)[near] == pytest.approx(places[near], abs=1e-8)


def test_lines_that_miss_the_flank_meet_nothing(pair):
    flank, _, places = flank_of(pair, "wheel")
    points, normals = flank.surface(*places.T)
    plane = np.linalg.svd(normals[3:4])[2][1:]
    _, _, met, _ = flank.surface.pierced(points[:1] + 1e6 * plane[0], plane, tuple(places[3]))
    assert np.isnan(met).all()


@pytest.mark.validate
def test_corners_on_the_edges_of_a_flank_lie_on_it():
    """The mesh ends on the edges: a corner there that rounding puts beyond them would keep the gap of its facets."""
    drive = Drive.load("bevel-hypoid")
    gear, window = gear_pair(drive), drive.contact_ratio()
    (contact,) = touches(gear, 0.5 * (window.begin.angle + window.end.angle), 1)
    plane = ContactPlane.of(gear, contact, (contact.touch.pinion_angle, contact.wheel_angle))
    for of in plane.flanks.values():
        curves, (low, high) = of.rail.curves, of.form.faces
        sections = np.linspace(0.7 * low + 0.3 * high, 0.3 * low + 0.7 * high, 40)
        for end in (curves.first, curves.last):
            edge = moved(of.pose, curves.points(sections, end(sections)[:, None])[:, 0])
            found = of.under(edge)
            met = np.linalg.norm(found.points - edge, axis=1) < 1e-8
            assert np.count_nonzero(met) > 5
            assert found.inside[met].all()


@pytest.mark.parametrize("member", ["pinion", "wheel"])
def test_sections_cut_a_flank_as_secants_find_it(pair, member):
    flank, sections, places = flank_of(pair, member, 0.1)
    if not isinstance(flank.surface, Cut):
        pytest.skip("its second parameter is the section itself")
    profile = places[:, :1]
    found, slow = (of(profile) for of in (
        lambda profile: flank.places(sections, profile),
        lambda profile: flank._by_secants(np.broadcast_to(sections[:, None], profile.shape), profile),
    ))  # fmt: skip
    for one, other in zip(found, slow, strict=True):
        assert one == pytest.approx(other, abs=1e-10)
    assert flank.section.at(found[1]) == pytest.approx(sections[:, None], abs=1e-9)
    factors, sums = flank.section.factors(sections)
    coordinates = np.column_stack([found[1][:, 0], np.hypot(*found[1][:, 0, :2].T)])
    assert np.sum(coordinates * factors, axis=1) == pytest.approx(sums, abs=1e-9)


@pytest.mark.parametrize("name", quick(NAMES, *NAMES[1:3]))
def test_normals_of_sections_stand_on_the_curves_in_them(name):
    """Of planes, cylinders, cones and half planes: along the curve of a flank in a section nothing moves across it."""
    of = gear_pair(Drive.load(name)).pinion
    form = of.tooth(0.0)
    flank = form.side(of.working).flank
    section = np.array([0.5 * sum(form.faces)])
    ends = flank.first(section), flank.last(section)
    profile = np.linspace(0.4, 0.6, 201)[None, :] * (ends[1] - ends[0]) + ends[0]
    points = flank.points(section, profile)[0]
    across = flank.section.across(points)
    assert np.linalg.norm(across, axis=1) == pytest.approx(1.0, abs=1e-12)
    steps = np.diff(points, axis=0)
    off = np.sum(steps * (0.5 * (across[1:] + across[:-1])), axis=1)
    assert np.abs(off).max() < 1e-4 * np.linalg.norm(steps, axis=1).max()
