"""Whole flanks: drawn at one scale, inside their blank, with the pattern and ease-off that geometry demands."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.tri import LinearTriInterpolator, Triangulation

from meshwright import Drive, cli
from meshwright.report import whole_figure
from meshwright.report.figures import pictures
from meshwright.report.whole_flank import whole_flanks

CROWNING = 0.010


@pytest.fixture(scope="module")
def spur():
    """Involute spur gears, and the same with 10 µm of lead crowning on the pinion; both flanks of each."""
    drive = Drive.load("spur-profile-shift")
    crowned = drive.with_(design={"pinion_lead_crowning_um": 1000.0 * CROWNING})
    angles = np.radians(np.linspace(-17.0, 22.0, 40))
    return whole_flanks(drive, angles), whole_flanks(crowned, angles)


@pytest.mark.parametrize("member", ["pinion", "wheel"])
def test_involute_gears_are_conjugate(spur, member):
    """The ease-off vanishes all over the flank, but for tips that the mate's involute begins too late to meet."""
    ease_off = spur[0][member].ease_off
    assert np.mean(np.isfinite(ease_off)) > 0.95
    assert np.nanmax(np.abs(ease_off)) < 1e-9


@pytest.mark.parametrize("member", ["pinion", "wheel"])
def test_lead_crowning_is_the_ease_off_of_spur_gears(spur, member):
    """The crowned flank falls off by c (2 z/b)² along the normal, over a face of b = 20 mm."""
    whole = spur[1][member]
    expected = CROWNING * (2.0 * whole.points[:, 2] / 20.0) ** 2
    known = np.isfinite(whole.ease_off)
    assert np.mean(known) > 0.95
    assert whole.ease_off[known] == pytest.approx(expected[known], abs=2e-6)


@pytest.mark.parametrize("name", ["recess-action-full", "spherical-table-3-1-concave", "face-worm-conical-convex"])
def test_lengths_are_drawn_at_one_scale(name, analysed):
    analysis = analysed(name)
    drawn = [whole_figure.pattern(analysis, member) for member in analysis.whole]
    assert len(drawn) == 2
    for figure in [*drawn, whole_figure.ease_off(analysis, "wheel")]:
        figure.draw_without_rendering()
        for axes in figure.axes:
            origin, across, up = axes.transData.transform([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)])
            assert across[0] - origin[0] == pytest.approx(up[1] - origin[1], rel=1e-9)


def test_a_thread_is_unrolled_to_its_true_length(analysed):
    """Neighbouring places on a thread are as far apart in the picture as they are on the thread at mid height."""
    sheet = whole_figure.Sheet(analysed("face-worm-conical-convex").whole["pinion"], "pinion")
    radius = np.hypot(*sheet.whole.points[:, :2].T)
    middle = 0.5 * (radius.min() + radius.max())
    turned = np.array([[middle * np.cos(a), middle * np.sin(a), sheet.projection.screw * a] for a in (0.0, 1e-3)])
    flat = sheet.flat(turned + [0.0, 0.0, sheet.projection.start])
    assert np.linalg.norm(flat[1] - flat[0]) == pytest.approx(np.linalg.norm(turned[1] - turned[0]), rel=1e-6)


def test_the_border_keeps_to_the_blank(analysed):
    """No point of a flank lies beyond its tip or its face; the border lies on the limits it names."""
    analysis = analysed("spherical-table-3-1-concave")
    for member, whole in analysis.whole.items():
        flank, limits = analysis.drive.flank(member), set(whole.limits)
        assert {"tip", "face", "root"} <= limits
        half = 0.5 * analysis.drive.design.value("face_width_mm")
        assert np.abs(whole.points[:, 2]).max() == pytest.approx(half, abs=1e-9)
        ends = np.array([limit == "face" for limit in whole.limits])
        assert np.abs(whole.points[whole.edges[ends], 2]) == pytest.approx(half, abs=1e-9)
        assert flank.body["name"] == member


@pytest.mark.parametrize("name", ["spherical-table-3-1-concave", "recess-action-full", "face-worm-conical-convex"])
def test_the_composite_pattern_holds_every_single_patch(name, analysed):
    """What a patch at one position covers is within the compound: its edge at the separation, half way at a quarter.

    The first and the last patch are cut by the mate's edge, within a cell of the grid.
    """
    analysis = analysed(name)
    whole = analysis.whole["wheel"]
    sheet = whole_figure.Sheet(whole, "wheel")
    shown = np.where(np.isfinite(whole.alone), whole.alone, 0.05)
    between = LinearTriInterpolator(Triangulation(*sheet.places.T, whole.triangles), shown)
    inside = 0
    for patch in analysis.pattern[1:-1]:
        edge = sheet.flat(patch.body_points["wheel"])
        centre = sheet.flat(analysis.tca.body_points["wheel"])[analysis.tca.angles == patch.angle]
        for share, most in ((1.0, 1.05), (0.5, 0.32)):
            values = between(*(centre + share * (edge - centre)).T)
            assert np.ma.max(values) < most * patch.separation
            inside += values.count()
    assert inside > 200

@pytest.mark.parametrize(("name", "most"), [("recess-action-full", 0.001), ("face-worm-conical-convex", 0.02)])
def test_where_another_pair_leads_the_mate_stands_off_the_contact_point_by_what_the_pair_lags(name, most, analysed):
    """By the transmission errors of the pairs; a pair alone touches there. Within the cells of flank and positions."""
    analysis = analysed(name)
    whole = analysis.whole["wheel"]
    sheet = whole_figure.Sheet(whole, "wheel")
    triangles = Triangulation(*sheet.places.T, whole.triangles)
    places = sheet.flat(analysis.tca.body_points["wheel"])
    lags = []
    for patch in analysis.pattern[1:-1]:
        (place,) = places[analysis.tca.angles == patch.angle]
        alone, running = (float(LinearTriInterpolator(triangles, of)(*place)) for of in (whole.alone, whole.running))
        (lag,) = (p.separation for p in analysis.running.mesh.pairs(patch.angle) if p.number == 0)
        assert alone == pytest.approx(0.0, abs=4e-4)
        assert running == pytest.approx(lag, rel=0.05, abs=7e-4)
        lags.append(lag)
    assert max(lags) > most


def test_an_ease_off_known_at_single_places_alone_is_said_not_drawn(analysed):
    """Two known places span no triangle."""
    analysis = analysed("spherical-table-3-1-concave")
    single = np.full_like(analysis.whole["wheel"].ease_off, np.nan)
    single[:2] = 0.01, 0.02
    whole = analysis.whole | {"wheel": replace(analysis.whole["wheel"], ease_off=single)}
    figure = whole_figure.ease_off(replace(analysis, whole=whole), "wheel")
    assert [text.get_text() for axes in figure.axes for text in axes.texts][0] == "beyond the positions of a pair"


def test_a_thicker_compound_is_named(analysed):
    analysis = replace(analysed("spherical-table-3-1-concave"), marking=0.020)
    captions = [p.caption for p in pictures(analysis) if p.name.startswith("whole")]
    assert len(captions) == 2
    assert all("compound of 20 µm" in caption for caption in captions)


def test_a_compound_has_a_thickness(capsys):
    with pytest.raises(SystemExit, match="2"):
        cli.main(["report", "helical-crowned", "--marking-um", "0", "--html", "x.html"])
    assert "--marking-um" in capsys.readouterr().err
