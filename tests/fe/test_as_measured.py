"""As-measured flanks under load: no deviation is the nominal pair, another design's difference is that design."""

from dataclasses import replace

import numpy as np
import pytest

from meshwright import Drive
from meshwright.base.errors import UsageError
from meshwright.cli import main
from meshwright.contact.results import ARCSEC
from meshwright.fe.as_measured import as_measured
from meshwright.fe.loaded import loaded_contact
from meshwright.fe.model import Load
from meshwright.fe.solids import gear_pair
from meshwright.shop.located import along, located
from meshwright.shop.nominal import nominal

LOAD, ANGLE = Load(60000.0, "pinion"), 0.03


@pytest.fixture(scope="module")
def nominal_pair():
    drive = Drive.load("helical-crowned")
    return drive, gear_pair(drive), nominal(drive, "pinion", (9, 13), 0.0)


def test_no_deviation_is_the_nominal_pair(nominal_pair):
    drive, gear, points = nominal_pair
    measured = as_measured(gear, drive, "pinion", replace(points, deviations=np.zeros(len(points.tooth))))
    one, two = gear.touch(ANGLE), measured.touch(ANGLE)
    assert two.wheel_angle == pytest.approx(one.wheel_angle, abs=1e-9 * ARCSEC)
    assert two.curvature_min == pytest.approx(one.curvature_min, rel=1e-5)
    assert two.curvature_max == pytest.approx(one.curvature_max, rel=1e-7)
    assert abs(two.major_direction @ one.major_direction) == pytest.approx(1.0, abs=1e-9)
    here, there = (loaded_contact(pair, ANGLE, 1, LOAD, None) for pair in (measured, gear))
    assert here.transmission_error == pytest.approx(there.transmission_error, rel=1e-6)
    assert here.pairs[0].peak_pressure == pytest.approx(there.pairs[0].peak_pressure, rel=1e-5)
    assert here.pairs[0].force == pytest.approx(there.pairs[0].force, rel=1e-5)


@pytest.mark.validate
def test_the_difference_to_another_crowning_carries_as_that_does(nominal_pair):
    """Half-spaces on rigid teeth: transmission error and pressure within 1e-4, where crowning changes them by 10 %."""
    drive, gear, points = nominal_pair
    other = drive.with_(design={"pinion_lead_crowning_um": 14.0})
    found = located(drive, "pinion", points)
    apart = along(other.flank("pinion"), found.parameters[0], found.rays[0])[1]
    pair = as_measured(gear, drive, "pinion", replace(points, deviations=apart))
    here, there, plain = (loaded_contact(g, ANGLE, 3, LOAD, None) for g in (pair, gear_pair(other), gear))
    peaks = [max(p.peak_pressure for p in of.pairs) for of in (here, there, plain)]
    assert here.transmission_error == pytest.approx(there.transmission_error, rel=1e-4)
    assert peaks[0] == pytest.approx(peaks[1], rel=1e-4) and abs(peaks[2] / peaks[1] - 1.0) > 0.03


def test_what_is_not_measured_does_not_touch(nominal_pair):
    """A grid over the middle half of the flank: its end cuts the contact off, and that is said."""
    drive, gear, _ = nominal_pair
    points = nominal(drive, "pinion", (5, 7), 0.25)
    pair = as_measured(gear, drive, "pinion", replace(points, deviations=np.zeros(len(points.tooth))))
    found = loaded_contact(pair, ANGLE, 1, LOAD, None)
    assert "measured grid of the pinion" in found.pairs[0].edges


def test_options_belong_together(nominal_pair, capsys):
    drive, gear, points = nominal_pair
    assert main(["loaded", "helical-crowned", "--torque-nm", "60", "--measured", "x.csv"]) == 2
    assert "--member" in capsys.readouterr().err
    assert main(["loaded", "helical-crowned", "--torque-nm", "60", "--tooth", "2"]) == 2
    with pytest.raises(UsageError, match="not measured"):
        as_measured(gear, drive, "pinion", replace(points, deviations=np.full(len(points.tooth), np.nan)))
