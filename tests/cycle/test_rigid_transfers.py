"""What rigid teeth transmit where the curve of a pair is known in closed form: it crosses, jumps or ends."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from meshwright.cycle.rigid import RigidTeeth

PITCH = 0.7


def teeth(curve, begin, end, sense=1.0):
    """Rigid teeth whose pairs have sense times ``curve`` of their own angle; the angles asked. A contact that comes no
    earlier than is asked for is not found.
    """
    asked = []

    def first(angles, until=None):
        asked.extend(angles)
        errors = np.array([curve(float(angle)) for angle in angles])
        return sense * np.where(errors > (-math.inf if until is None else sense * until), errors, np.nan)

    window = SimpleNamespace(begin=SimpleNamespace(angle=begin), end=SimpleNamespace(angle=end))

    def numbers(angle):
        return range(math.ceil((angle - end) / PITCH), math.floor((angle - begin) / PITCH) + 1)

    drive = SimpleNamespace(pitch=lambda: PITCH)
    return RigidTeeth(SimpleNamespace(drive=drive, window=window, sense=sense, numbers=numbers), first), asked


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_parabolas_cross_half_a_pitch_from_their_vertices(sense):
    """Pairs that fall off as their angle squared hand over at (pitch / 2)²."""
    rigid, _ = teeth(lambda x: -0.003 * (x - 0.123) ** 2, -1.0, 1.2, sense)
    assert rigid.peak_to_peak() == pytest.approx(0.003 * (0.5 * PITCH) ** 2, rel=1e-9)


SLOPE, STEEP = 0.02, 50.0


@pytest.mark.parametrize(
    ("before", "share"),
    [(lambda x: math.nan, 1.0), (lambda x: -4.0, 1.0), (lambda x: STEEP * x, 1.0 - SLOPE / (STEEP + SLOPE))],
    ids=["nowhere", "far behind", "on a steep edge"],
)
@pytest.mark.parametrize("enters", [-0.3, 0.0123, 0.5])
def test_pairs_that_fall_and_lead_from_where_they_enter_transmit_the_fall_of_a_pitch(before, share, enters):
    """Where the next pair enters, the transmitted error jumps back by what a pitch has made, or climbs back steeply."""

    def curve(x):
        return -SLOPE * x if x >= enters else before(x - enters) - SLOPE * enters

    rigid, asked = teeth(curve, enters - 0.2, enters + 2.0)
    assert rigid.peak_to_peak() == pytest.approx(SLOPE * PITCH * share, rel=1e-5)
    assert len(asked) < 300  # a search of two flanks takes milliseconds


def test_the_lower_side_of_a_jump_counts():
    """A pair leads in an interval at one error, then falls: the lowest error is beside a jump, not at a sample."""
    enters, leaves, highest = -0.111, 0.29, 0.01

    def curve(x):
        return math.nan if x < enters else highest if x < leaves else -SLOPE * (x - leaves)

    rigid, _ = teeth(curve, enters, enters + 2 * PITCH)
    lowest = -SLOPE * (PITCH + enters - leaves)  # of the pair before, where the next one comes in
    assert rigid.peak_to_peak() == pytest.approx(highest - lowest, rel=1e-6)


@pytest.mark.parametrize("fall", [0.0, 0.003])
def test_the_upper_side_of_a_jump_counts(fall):
    """A pair rises ever faster, as before a fold, to where its contact is lost: the highest error is just there."""
    leaves = 0.31

    def curve(x):
        return -0.01 * math.sqrt(leaves - x) if x < leaves else -0.02 - fall * (x - leaves)

    rigid, _ = teeth(curve, leaves - PITCH, leaves + 0.2)
    assert rigid.peak_to_peak() == pytest.approx(0.01 * math.sqrt(PITCH), rel=1e-4)


def test_pairs_that_lead_together_to_round_off_transmit_no_error():
    """Each of two pairs leads by rounding alone, until one has gone far behind."""

    def curve(x):
        return -3e-4 + 1e-16 * math.sin(1e9 * x) - 5.0 * max(0.0, abs(x) - 0.9 * PITCH) ** 2

    rigid, _ = teeth(curve, -0.9 * PITCH, 0.9 * PITCH)
    assert rigid.peak_to_peak() < 1e-15


def test_where_no_pair_touches_there_is_no_peak_to_peak():
    rigid, _ = teeth(lambda x: -x * x if abs(x) < 0.45 * PITCH else math.nan, -0.5, 0.5)
    assert math.isnan(rigid.peak_to_peak())


def test_what_is_transmitted_is_unknown_where_the_first_contact_of_a_pair_is():
    """A pair that meets its mate, but whose first contact was not found, may lead: no number is given then."""

    def curve(x):
        return math.inf if 0.30 < x < 0.34 else -0.003 * x * x

    rigid, _ = teeth(curve, -1.0, 1.2)
    found = rigid.transmitted([0.0, 0.32, 0.1])
    assert np.isnan(found).tolist() == [False, True, False]
    assert math.isnan(rigid.peak_to_peak())
