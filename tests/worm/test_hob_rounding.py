"""Fillets of hobbed wheels: against the balls of the hob's tip swept by hand, and where they join flank and root."""

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar

from meshwright import Drive
from meshwright.base.errors import UsageError
from tests.quick import quick
from tests.worm.hob_tip import Balls

FORMS = [f"plain-{form}" for form in ("za", "zi", "zn", "zk", "zc")]
HOB_TIP, ROUNDING = 4.8, 1.2


def with_rounding(name, flank, rounding=ROUNDING):
    blank = {"hob_tip_addendum_mm": HOB_TIP, "hob_tip_rounding_mm": rounding}
    return Drive.load(name).with_(flank=flank, blank=blank)


def edge(drive):
    """(t, ξ) where the rounding touches the hob's flank, by bisection of the ball's condition and of the margin."""
    fillet = drive.flank("wheel", "fillet")
    middle = drive.tca([0.0]).unknowns["t_hob"][0]
    ends = middle, middle + np.sign(_growth(drive, middle)) * _step(drive)
    t = brentq(lambda t: fillet([[0.0, t, 0.0]]).conditions[0, 0, 0], *ends, xtol=1e-15)
    return t, brentq(lambda xi: fillet([[xi, t, 0.0]]).margins["junction"][0], 0.1, 3.0, xtol=1e-15)


def _growth(drive, t):
    return -drive.flank("wheel", "fillet")([[0.0, t, 0.0]]).conditions[0, 0, 2]


def _step(drive):
    """Twice the blade's height along the profile."""
    middle = drive.tca([0.0]).unknowns["t_hob"][0]
    return 3.0 * HOB_TIP / abs(_growth(drive, middle))


@pytest.mark.parametrize("flank", ["right", "left"])
@pytest.mark.parametrize("name", FORMS)
def test_fillet_joins_flank_and_root(name, flank):
    """Points and normals of the flank at one end; at the other the hob's tip cylinder touches its envelope."""
    drive = with_rounding(name, flank)
    t, turn = edge(drive)
    angles = np.linspace(-0.3, 0.3, 7)
    fillet, same = drive.flank("wheel", "fillet"), np.ones(7)
    upper, lower = (fillet(np.stack([xi * same, t * same, angles], axis=1)) for xi in (turn, 0.0))
    beside = drive.flank("wheel")(np.stack([t * same, angles], axis=1))
    assert np.abs(upper.points - beside.points).max() < 1e-9
    assert np.abs(upper.normals - beside.normals).max() < 1e-11
    assert lower.margins["bottom"] == pytest.approx(0.0) and np.all(upper.margins["bottom"] > 1.0)
    radii, normals = in_hob_frame(drive, lower)
    assert radii == pytest.approx(drive.design.value("hob_pitch_radius_mm") + HOB_TIP, abs=1e-9)
    assert np.abs(normals - 1.0).max() < 1e-12


def in_hob_frame(drive, found):
    """Least distance of points from the hob's axis as the wheel turns, and the part of the normal towards it there."""
    value = drive.design.value
    distance, angle = value("cutting_center_distance_mm"), value("cutting_shaft_angle_deg")

    def placed(turn, vector, offset):
        """Turned about the wheel's axis, then in the frame of the hob, whose axis is z."""
        c, s = np.cos(turn), np.sin(turn)
        y = s * vector[0] + c * vector[1]
        return c * vector[0] - s * vector[1] + offset, np.cos(angle) * y + np.sin(angle) * vector[2]

    def nearest(point):
        facing = np.pi - np.arctan2(point[1], point[0])
        away = minimize_scalar(
            lambda a: np.hypot(*placed(a, point, distance)), (facing - 0.1, facing + 0.1), options={"xtol": 1e-12}
        )
        return away.x

    turns = [nearest(point) for point in found.points]
    axes = [np.array(placed(a, point, distance)) for a, point in zip(turns, found.points, strict=True)]
    normals = [np.array(placed(a, normal, 0.0)) for a, normal in zip(turns, found.normals, strict=True)]
    radii = np.linalg.norm(axes, axis=1)
    return radii, -np.sum(np.array(axes) * normals, axis=1) / radii


@pytest.mark.parametrize("flank", quick(["right", "left"], "left"))
@pytest.mark.parametrize("rounding", [ROUNDING, 0.4, 0.0])
@pytest.mark.parametrize("name", quick(["plain-zn", "recess-action-full"], "plain-zn"))
def test_fillet_is_what_the_balls_leave(name, rounding, flank):
    """Every point is a ball's radius from the nearest place that a ball's centre comes to, also of a sharp edge."""
    drive = with_rounding(name, flank, rounding)
    t, turn = edge(drive)
    balls = Balls(drive, rounding)
    assert t == pytest.approx(balls.t, abs=1e-11)
    fillet = drive.flank("wheel", "fillet")
    grid = np.meshgrid(np.linspace(0.0, turn, 5), t, np.linspace(-0.3, 0.3, 5))
    found = fillet(np.stack([axis.ravel() for axis in grid], axis=1))
    assert np.all(found.regular > 0.0)
    assert [balls.nearest(point) for point in found.points] == pytest.approx([rounding] * 25, abs=1e-7)


def test_a_blank_without_rounding_has_no_fillet():
    """Not a number rather than a sharp edge that nobody asked for."""
    drive = Drive.load("plain-zn")
    assert np.isnan(drive.flank("wheel", "fillet")([[0.5, 12.0, 0.0]]).points).all()
    with pytest.raises(UsageError, match="\\[blank\\] leaves open: give hob_tip_rounding_mm"):
        drive.surface("wheel", (3, 3), "fillet")


def test_fillet_as_a_surface():
    """The grid of the region spans bottom to junction on the wheel's faces."""
    found = with_rounding("plain-zn", "right").surface("wheel", (5, 7), "fillet")
    assert np.isfinite(found.points).all() and found.values[0, 0] == pytest.approx(0.0, abs=1e-9)
