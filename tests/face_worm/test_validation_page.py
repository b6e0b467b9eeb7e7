"""What the validation page says of the published head-cutter radii is what the compiled drive gives."""

import re

from derive.audit.published import comparisons
from tests.face_worm.designs import NAMES, changed


def test_radii_beside_the_printed_ones_are_those_of_the_drive(reference):
    rows = {row.where.split(",")[0]: row for row in comparisons() if "radius" in row.quantity}
    for table, names in (("Table 1", NAMES[:2]), ("Table 2", NAMES[2:])):
        row = rows[table]
        printed = reference("face-worm")[table.lower().replace(" ", "_")]["mean_head_cutter_radius_mm"]
        assert row.printed == f"{printed} mm"
        shown = [float(number) for number in re.findall(r"\d+\.\d{3}", row.ours)]
        ours = []
        for rule in ("mid", "cones"):
            sides = [changed(n, {"pitch_point_rule": rule}).design.value("head_cutter_radius_mm") for n in names]
            ours += [sum(sides) / 2, *sides]
        assert shown == [round(radius, 3) for radius in ours]
