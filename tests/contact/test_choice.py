"""One angle has one contact and one status, whichever other angles are asked for."""

import numpy as np
import pytest

from meshwright import Drive
from tests.quick import quick
from tests.worm.designs import plain

#: A ZN drive whose branch of contact turns back at 17.1143 degrees, and a ZC worm with a ZI hob with two saddles.
FOLD = {
    "drive": "cylindrical-worm",
    "flank": "right",
    "design": {
        "normal_module_mm": 2.662, "worm_threads": 3, "wheel_teeth": 60, "worm_lead_angle_deg": 15.638,
        "pressure_angle_deg": 23.811, "worm_profile": "ZN", "shaft_angle_deg": 80.1, "hob_pitch_radius_mm": 16.42,
    },
}  # fmt: skip
SADDLES = {
    "drive": "cylindrical-worm",
    "flank": "left",
    "design": {
        "normal_module_mm": 2.446, "worm_threads": 3, "wheel_teeth": 41, "worm_lead_angle_deg": 15.134,
        "pressure_angle_deg": 23.923, "worm_profile": "ZC", "hob_profile": "ZI", "hob_pitch_radius_mm": 15.518,
        "grinding_wheel_radius_mm": 168.618, "profile_arc_radius_mm": 27.026,
    },
}  # fmt: skip


@pytest.mark.parametrize("asked", [[20.0], [10.0, 20.0], np.arange(0.0, 21.0, 2.0), [17.2], [-60.0, 17.12, 30.0]])
def test_beyond_a_fold_the_status_is_fold_and_before_it_there_is_contact(asked):
    drive = Drive.from_tables(FOLD)
    fold = np.degrees(max(p.angle for p in drive.limits().branch_points if p.kind == "fold"))
    assert fold == pytest.approx(17.1143, abs=1e-4)
    words = ["converged" if angle < fold else "fold" for angle in asked]
    assert list(drive.tca(np.radians(asked)).status) == words


@pytest.mark.validate
def test_the_branch_that_is_reported_is_that_of_the_reference_angle():
    drive = Drive.from_tables(SADDLES)
    alone = drive.tca([0.0]).error[0]
    for asked in (np.arange(-40.0, 1.0), np.arange(-40.0, 41.0, 20.0), np.array([30.0, 0.0])):
        assert drive.tca(np.radians(asked)).error[asked == 0.0] == pytest.approx(alone, abs=1e-13)


def _designs():
    """Those of drives that are built come first."""
    yield FOLD
    for k, (worm, hob) in enumerate([("ZK", "ZN"), ("ZA", "ZA"), ("ZI", "ZK"), ("ZN", "ZI"), ("ZN", "ZC")], 3):
        for flank in ("right", "left"):
            for radius in (20.4, 19.8, 21.5):
                yield plain(worm, hob, flank=flank, hob_pitch_radius_mm=radius, shaft_angle_deg=(90.0, 80.0)[k % 2])
    yield SADDLES


DESIGNS = [*_designs()]


@pytest.mark.parametrize("tables", quick(DESIGNS, *DESIGNS[:5]))
def test_an_angle_alone_in_a_coarse_list_in_a_fine_grid_and_backwards(tables):
    """Pitchforks, folds, saddles and contacts off the flank among them."""
    drive = Drive.from_tables(tables)
    angles = np.linspace(-1.1, 1.3, 7) * drive.pitch()
    fine = np.union1d(np.linspace(angles[0], angles[-1], 97), angles)
    one = [drive.trace([angle]) for angle in angles]
    error = drive.design.description["error"]
    for asked in (angles, fine, angles[::-1], fine[::-1]):
        x, statuses = drive.trace(asked)
        for (alone, (status,)), angle in zip(one, angles, strict=True):
            k = int(np.flatnonzero(asked == angle)[0])
            assert statuses[k] == status
            if status in ("converged", "line_contact"):
                assert x[k, error] == pytest.approx(alone[0, error], abs=1e-11)
