"""The page stands alone, escapes what it is given, and says every size with its unit."""

import hashlib
import re
import subprocess
from dataclasses import replace
from html.parser import HTMLParser
from importlib import resources

import numpy as np
import pytest

from meshwright import Drive, cli
from meshwright.contact.results import ARCSEC
from meshwright.report import analyse, page, sensitivity_figures
from meshwright.report.findings import findings, tiles
from meshwright.report.numbers import fixed, number, unit
from meshwright.report.scene import scene
from meshwright.report.tables import groups
from meshwright.sensitivity import on_member, sensitivity
from tests.live.browser import CHROMIUM, HEADLESS, WIDTHS, Browser
from tests.quick import quick

from .conftest import DESIGNS, quiet

VOID = {"meta", "input", "br", "wbr", "path", "use", "rect", "image"}


class Structure(HTMLParser):
    """Open elements, ids, references and cells of a page."""

    def __init__(self, text):
        super().__init__()
        self.open, self.ids, self.references, self.cells = [], [], [], []
        self.goes_on = False
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        self.note(attributes)
        self.goes_on = tag == "wbr"
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.note(attributes)

    def handle_endtag(self, tag):
        if tag not in VOID:
            assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open and self.open[-1] in ("td", "th"):
            word = data.strip()
            self.cells.append(self.cells.pop() + word if self.goes_on else word)
        self.goes_on = False

    def note(self, attributes):
        for name, value in attributes:
            if name == "id":
                self.ids.append(value)
            elif name in ("src", "href", "xlink:href", "srcset", "action", "data", "poster"):
                self.references.append(value)


@pytest.mark.parametrize("name", quick(DESIGNS, DESIGNS[0]))
def test_the_page_is_well_formed_and_needs_no_other_resource(name, paged):
    text = paged(name)
    structure = Structure(text)
    assert structure.open == []
    assert len(set(structure.ids)) == len(structure.ids)
    assert all(r.startswith("#") and r[1:] in structure.ids for r in structure.references)
    assert not re.search(r"@import|\bfetch\(|XMLHttpRequest|WebSocket|import\(|url\((?!#)", text)


@pytest.mark.parametrize("name", DESIGNS)
def test_every_derived_size_stands_in_the_tables_with_its_unit(name, paged, analysed):
    cells = Structure(paged(name)).cells
    for key, value in analysed(name).drive.design.sizes.items():
        rows = [cells[k - 4 : k] for k, cell in enumerate(cells) if cell == key]
        assert any(number(value) in row and unit(key) in row for row in rows), key


def test_a_choice_is_a_word_and_what_is_not_given_is_a_default(paged):
    cells = Structure(paged("spherical-table-3-1-concave")).cells
    rows = {key: cells[cells.index(key) - 4 : cells.index(key)] for key in ("limit", "separation_mm", "vertical_deg")}
    assert rows["limit"][1:4:2] == ["tip", "default"]
    assert rows["separation_mm"][1:4:2] == ["0.00632", "default"]
    assert rows["vertical_deg"][1:4:2] == ["0", "default"]


@pytest.mark.parametrize("name", DESIGNS)
def test_the_page_speaks_of_one_gear_ratio_and_of_the_centre_distance(name, paged):
    text = re.sub(r"<script.*?</script>", "", paged(name), flags=re.DOTALL)
    assert '<div class="label">Gear ratio</div>' in text
    assert "center distance" not in text


def test_a_shift_that_is_round_off_is_zero_in_the_table_and_invisible_in_the_picture():
    """Turning the axis of a convex pinion moves the contact along the faces, not across them."""
    analysis = analyse(Drive.load("spherical-table-3-1-spur"), quiet)
    assert {row[4] for row in groups(analysis)[0].tables[0].rows[1:]} == {"0"}
    panels = sensitivity_figures.path(analysis).axes
    assert all(np.ptp(axes.get_xlim()) >= 1e-3 * (1.0 - 1e-9) for axes in panels)


@pytest.mark.validate
def test_a_misalignment_has_a_panel_if_the_flanks_touch_under_it_wherever_that_is():
    """A concave gear that is tilted about x in the convex one that fills it touches that with an edge. Moved by more
    than both face widths along their axes, gears stand beside each other.
    """
    analysis = analyse(Drive.load("spherical-table-2-1"), quiet)
    assert all(effect.touches for effect in analysis.sensitivities)
    (tilted,) = (effect for effect in analysis.sensitivities if effect.key == "horizontal_deg")
    assert {*tilted.minus.status, *tilted.plus.status} == {"edge_contact"} and tilted.at_points
    assert np.isfinite(tilted.peak_to_peak).all()
    face = analysis.drive.design.value("face_width_mm")
    aside = analyse(Drive.load("spur-profile-shift"), quiet, sizes={"axial_mm": 2.5 * face})
    assert [effect.key for effect in aside.sensitivities if not effect.touches] == ["axial_mm"]
    panels = [axes for axes in sensitivity_figures.error(aside).axes if axes.get_xlabel()]
    assert len(panels) == len(aside.sensitivities) - 1


def test_text_of_the_design_is_escaped(analysed):
    analysis = analysed("spherical-table-3-1-concave")
    text = page(replace(analysis, drive=analysis.drive.with_(name="</script><script>alert('&')</script>")))
    assert "<script>alert" not in text
    assert "&lt;/script&gt;&lt;script&gt;alert(&#39;&amp;&#39;)&lt;/script&gt;" in text


def test_line_contact_is_reported_as_such_without_invented_points():
    """A convex gear fills a concave one of the same sphere."""
    analysis = analyse(Drive.load("spherical-table-2-1"), quiet)
    text = page(analysis)
    assert set(analysis.tca.status) == {"line_contact"}
    assert "the flanks touch along a line" in text
    assert "Lines along which the flanks touch" in text
    assert "semi-axes at" not in text


def test_figures_for_print_are_those_of_the_page_and_a_pipe_sees_no_progress_bar(tmp_path, paged, capfd):
    folder = tmp_path / "new"
    assert cli.main(["report", "spherical-table-3-1-concave", "--figures", str(folder), "--format", "svg"]) == 0
    assert capfd.readouterr() == ("", "")
    names = {path.stem for path in folder.iterdir()}
    shown = set(re.findall(r'<svg [^>]*data-figure="([^"]+)"', paged("spherical-table-3-1-concave")))
    assert names == shown


def test_nothing_to_write_is_bad_input(capsys):
    assert cli.main(["report", "recess-action-full"]) == 2
    assert "--html" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("value", "text"), [(0.0, "0"), (-2.5, "−2.5"), (1.25e-11, "1.25 × 10⁻¹¹"), (float("nan"), "–"), (277.0, "277")]
)
def test_numbers_are_written_as_a_reader_writes_them(value, text):
    assert number(value) == text


def test_a_rounded_zero_has_no_sign():
    assert fixed(-0.0001, 2) == "0.00"



@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium on this machine")
@pytest.mark.parametrize("name", quick(DESIGNS, DESIGNS[0]))
def test_a_browser_runs_the_view_without_an_error(name, paged, tmp_path):
    place = tmp_path / "report.html"
    place.write_text(paged(name), encoding="utf-8")
    options = [*HEADLESS, f"--user-data-dir={tmp_path / 'profile'}"]
    options += ["--enable-logging=stderr", "--virtual-time-budget=3000", "--window-size=1366,900", "--dump-dom"]
    done = subprocess.run([CHROMIUM, *options, place.as_uri()], capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0
    assert "CONSOLE" not in done.stderr
    readout = re.search(r'id="view-readout"[^>]*>([^<]*)', done.stdout).group(1)
    assert re.match(r"pinion −?[\d.]+°, wheel −?[\d.]+°", readout)


@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium on this machine")
def test_without_webgl_the_view_says_so_in_its_place_and_shows_the_contacts(paged, tmp_path):
    place = tmp_path / "report.html"
    place.write_text(paged(DESIGNS[0]), encoding="utf-8")
    browser = Browser(tmp_path / "profile", "--disable-3d-apis")
    try:
        browser._call("Page.navigate", url=place.as_uri())
        browser.wait("document.getElementById('view-readout')?.textContent.startsWith('pinion')")
        assert "no WebGL here" in browser.value("document.querySelector('#view p:not([hidden])').textContent")
        marks = "document.querySelector('#view .marks')"
        pixels = f"{marks}.getContext('2d').getImageData(0, 0, {marks}.width, {marks}.height).data"
        assert browser.value(f"{pixels}.filter((v, i) => i % 4 === 3 && v).length") > 1000
        assert not browser.complaints
    finally:
        browser.close()


def test_the_library_of_the_view_is_the_one_that_its_description_names(paged):
    page_of = resources.files("meshwright.report") / "page"
    contents = (page_of / "three.min.js").read_bytes()
    assert hashlib.sha256(contents).hexdigest() in (page_of / "three.md").read_text(encoding="utf-8")
    text = paged(DESIGNS[0])
    assert contents.decode() in text and "The MIT License" in text


@pytest.mark.parametrize("name", DESIGNS)
def test_exact_derivatives_stand_beside_the_effect_of_a_step_and_agree_with_it(name, analysed):
    """One row a key; for a misalignment the slope times the step is the effect, as far as that is linear.

    A slope near zero is swamped by the cube of the step: agreement is to a share of the largest effect.
    """
    analysis = analysed(name)
    effects, slopes = groups(analysis)[0].tables
    keys = [row[-1] for row in slopes.rows]
    assert {f"misalignment.{effect.key}" for effect in analysis.sensitivities} <= set(keys)
    assert sum(key.startswith("design.") for key in keys) >= 5
    middle = len(analysis.tca.angles) // 2
    exact = sensitivity(analysis.drive, analysis.tca.angles[middle : middle + 1])
    changes = {e.key: 0.5 * (e.plus.error - e.minus.error)[middle] for e in analysis.sensitivities}
    largest = max(map(abs, changes.values()))
    for effect in analysis.sensitivities:
        for member in ("pinion", "wheel"):
            moved = 0.5 * (effect.plus.body_points[member] - effect.minus.body_points[member])[middle]
            slope = on_member(analysis.drive, exact, member)[0, exact.of(f"misalignment.{effect.key}")]
            size = np.radians(effect.step) if effect.key.endswith("_deg") else effect.step
            assert slope * size == pytest.approx(moved, rel=2e-2, abs=1e-2 * np.linalg.norm(moved) + 1e-6)
        step = np.radians(effect.step) if effect.key.endswith("_deg") else effect.step
        slope = exact.error[0, exact.of(f"misalignment.{effect.key}")]
        assert slope * step == pytest.approx(changes[effect.key], rel=1e-2, abs=1e-3 * largest + 1e-8 * ARCSEC)
    assert len(effects.rows) == len(analysis.sensitivities)


@pytest.mark.validate
@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium on this machine")
@pytest.mark.parametrize("name", DESIGNS)
def test_nothing_of_the_page_is_cut_off_in_any_width(name, paged, tmp_path):
    file = tmp_path / "report.html"
    file.write_text(paged(name), encoding="utf-8")
    browser = Browser(tmp_path / "profile")
    try:
        assert [browser.cut_off(file.as_uri(), width) for width in WIDTHS] == [[]] * len(WIDTHS)
    finally:
        browser.close()


#: A spur pair without crowning, aligned and inclined.
PLAIN = {
    "drive": "cylindrical-gears",
    "name": "plain spur pair",
    "design": {"normal_module_mm": 4.5, "pressure_angle_deg": 20.0, "face_width_mm": 14.0, "pinion_teeth": 16,
               "wheel_teeth": 24, "pinion_helix_angle_deg": 0.0, "wheel_helix_angle_deg": 0.0},
}  # fmt: skip


@pytest.mark.validate
@pytest.mark.parametrize(("inclined", "status"), [(0.0, "line_contact"), (0.005, "edge_contact")])
def test_a_plain_pair_has_the_cards_and_pictures_of_others(inclined, status):
    """Contact ratio, teeth, error and backlash, lines from face to face inside the flank, and nothing to warn of."""
    drive = Drive.from_tables(PLAIN | {"misalignment": {"vertical_deg": inclined}})
    drive = drive.with_(design={"center_distance_mm": drive.design.value("center_distance_mm") + 0.1})
    analysis = analyse(drive, quiet)
    assert set(analysis.tca.status) == {status}
    assert {"Contact ratio", "Teeth in contact", "Transmission error", "Backlash"} <= {t.label for t in tiles(analysis)}
    assert not [finding for finding in findings(analysis) if finding.kind == "warn"]
    assert set(analysis.whole) == {"pinion", "wheel"} and scene(analysis) is not None
    for line in analysis.lines:
        for member, points in line.body_points.items():
            margins = drive.flank(member)(line.parameters[member]).margins.values()
            assert min(np.nanmin(margin) for margin in margins if np.isfinite(margin).any()) > -1e-9
            assert np.ptp(points[:, 2]) == pytest.approx(14.0, abs=1e-9)
    window = drive.window
    assert bool(analysis.lines) == (status == "line_contact")
    assert abs(analysis.tca.angles[[0, -1]] - sorted([window.begin.angle, window.end.angle])).max() < drive.pitch() / 12
    assert "the flanks touch along a line" in page(analysis) or "left face" in page(analysis)
