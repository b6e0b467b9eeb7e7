"""Files of measured points: what is written is read back; what is wrong is named by line and column."""

import random

import numpy as np
import pytest

from meshwright.base.errors import UsageError
from meshwright.shop.deviations import pitch_deviations, trace_deviations
from meshwright.shop.tables import COLUMNS, Points, csv_text, dmis_text, read_csv

SAMPLE = Points(
    np.array([1, 1, 2]), ("right", "left", "right"), np.array([0, 1, 0]), np.array([0, 0, 1]),
    np.array([[1 / 3, 2.0, -3e-17], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]]), np.eye(3), np.array([1.25e-3, np.nan, -2e-3]),
)  # fmt: skip


def test_points_come_back_to_the_last_bit(tmp_path):
    (tmp_path / "p.csv").write_text(csv_text(SAMPLE, {"ball_radius_mm": 1.0}, 1.0))
    found, remarks = read_csv(tmp_path / "p.csv")
    assert remarks == {"ball_radius_mm": "1.0"}
    assert (found.points == SAMPLE.points).all() and (found.normals == SAMPLE.normals).all()
    assert found.flank == SAMPLE.flank and (found.tooth == SAMPLE.tooth).all()
    assert np.allclose(found.deviations, SAMPLE.deviations, rtol=1e-15, equal_nan=True)


def test_a_ball_touches_from_outside():
    last = csv_text(SAMPLE, {}, 2.0).splitlines()[1].split(",")
    assert [float(v) for v in last[-3:]] == pytest.approx([1 / 3 + 2.0, 2.0, -3e-17])


BROKEN = {
    "empty": ("", "holds no table"),
    "no points": (",".join(COLUMNS), "holds no points"),
    "column": (",".join(COLUMNS[:-1]) + "\n", "column deviation_um is missing"),
    "short line": (",".join(COLUMNS) + "\n1,right,0\n", "line 2: 3 cells below 11"),
    "word": (",".join(COLUMNS) + "\n1,right,0,0,x,0,0,1,0,0,1\n", "line 2: x_mm = 'x' is not a finite number"),
    "nan": (",".join(COLUMNS) + "\n1,right,0,0,nan,0,0,1,0,0,1\n", "line 2: x_mm = 'nan' is not a finite number"),
    "index": (",".join(COLUMNS) + "\n1,right,0.5,0,0,0,0,1,0,0,1\n", "line 2: i = '0.5' is not a whole number"),
    "binary": ("\x00\x01", "holds no table|column"),
}


@pytest.mark.parametrize("kind", BROKEN)
def test_a_broken_file_is_refused_with_its_line(tmp_path, kind):
    text, words = BROKEN[kind]
    (tmp_path / "p.csv").write_text(text)
    with pytest.raises(UsageError, match=words):
        read_csv(tmp_path / "p.csv")


def test_dmis_has_a_feature_and_a_measurement_a_point():
    text = dmis_text(SAMPLE, "wheel 'a'")
    assert text.count("FEAT/POINT,CART") == text.count("PTMEAS/CART") == 3
    assert "F(P2)=FEAT/POINT,CART,4.000000000,5.000000000,6.000000000,0.000000000,1.000000000,0.000000000" in text


def test_a_straight_deviation_is_slope_alone_and_a_bow_is_form():
    x = np.linspace(0.0, 10.0, 11)
    straight = trace_deviations(x, 0.2 * x + 3.0)
    assert (straight.total, straight.slope, straight.form) == pytest.approx((2.0, 2.0, 0.0), abs=1e-12)
    bow = trace_deviations(x, (x - 5.0) ** 2)
    assert (bow.total, bow.slope, bow.form) == pytest.approx((25.0, 0.0, 25.0), abs=1e-12)


def test_pitch_deviations_of_an_eccentric_gear():
    """Runout e: arcs e·sin(2πk/T); F_p = 2e, largest single pitch 2e·sin(π/T)."""
    teeth, e = 40, 0.02
    found = pitch_deviations(e * np.sin(2 * np.pi * np.arange(teeth) / teeth))
    assert found.total == pytest.approx(2 * e, rel=1e-12)
    assert found.largest == pytest.approx(2 * e * np.sin(np.pi / teeth), rel=1e-2)
    assert found.single.sum() == pytest.approx(0.0, abs=1e-12)


#: What a table may hold that it should not.
PIECES = (
    "", ",", ",,", "\n", "\r", '"', "#", "\x00", "-", "1e999", "nan", "9" * 40, "9" * 5000, "-1", "1000000", "999999",
    "right", "\ufeff", "\n1,right,0,0,1,2,3,1,0,0,4", "\n1,right,999999,999999,1,2,3,1,0,0,4", "deviation_um",
)  # fmt: skip


def test_a_damaged_table_is_read_or_refused_in_words(tmp_path):
    """Of a thousand, changed at one to four places; what is read are numbers of a grid that a machine can measure."""
    rows = [f"{tooth},{flank},{i},{j},{i},{j},3,1,0,0,{i - j}"
            for tooth in (1, 7) for flank in ("right", "left") for i in range(3) for j in range(2)]  # fmt: skip
    text, chance, path = "\n".join(["# design = x", ",".join(COLUMNS), *rows]), random.Random(1), tmp_path / "m.csv"
    refused = 0
    for _ in range(1000):
        changed = text
        for _ in range(chance.randint(1, 4)):
            at = chance.randrange(len(changed) + 1)
            changed = changed[:at] + chance.choice(PIECES) + changed[at + chance.choice((0, 0, 1, 2, 8)) :]
        path.write_text(changed, encoding="utf-8", newline="")
        try:
            points, _ = read_csv(path)
        except UsageError as error:
            refused += 1
            assert str(path) in str(error) and ";" in str(error)
        else:
            assert points.i.dtype == points.j.dtype == points.tooth.dtype == int
            assert points.i.min() >= 0 <= points.j.min() and (points.i.max() + 1) * (points.j.max() + 1) <= 4_000_000
    assert 300 < refused < 1000
