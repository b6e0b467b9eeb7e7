"""The two bounded flanks of a tooth pair touch first where a brute-force search finds it: tangency, edge or corner."""

import json

import numpy as np
import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.commands import loading
from meshwright.contact.results import ARCSEC, impossible
from meshwright.cycle import search
from meshwright.cycle.edge_contact import edge_paths
from meshwright.cycle.first_contact import pair_errors
from meshwright.cycle.pairs import Mesh
from meshwright.report.analysis import analyse
from meshwright.report.findings import findings
from tests.independent.first_touch import FirstTouch
from tests.quick import quick, some
from tests.worm.designs import plain

#: A ZN worm with a ZA hob whose tangency at -40 degrees lies 6 micrometres inside the other flank at its face.
EDGE_FIRST = {
    "drive": "cylindrical-worm", "flank": "right",
    "design": {
        "normal_module_mm": 2.5, "worm_threads": 4, "wheel_teeth": 53, "worm_pitch_radius_mm": 17.0,
        "pressure_angle_deg": 20.0, "worm_profile": "ZN", "hob_profile": "ZA", "hob_pitch_radius_mm": 17.6,
    },
    "misalignment": {"center_distance_mm": -0.03, "vertical_deg": 0.04},
    "blank": {
        "wheel_face_width_mm": 20.0, "worm_tip_radius_mm": 19.5, "worm_root_radius_mm": 14.0,
        "wheel_throat_radius_mm": 71.75,
    },
}  # fmt: skip


def worm(profiles, misalignment, angle, flank="right", face=16.0, tip=24.4, throat=87.62, **design):
    """A plain worm drive with a blank, and a pinion angle in degrees."""
    tables = plain(*profiles, hob_pitch_radius_mm=21.0, **design)
    blank = {
        "wheel_face_width_mm": face, "worm_tip_radius_mm": tip, "worm_root_radius_mm": 15.6,
        "wheel_throat_radius_mm": throat, "wheel_tip_radius_mm": throat + 1.5, "hob_tip_addendum_mm": 4.9,
    }  # fmt: skip
    return tables | {"flank": flank, "misalignment": misalignment, "blank": blank}, angle


def packaged(name, angle, **changes):
    """A packaged design with changes, and a pinion angle in degrees."""
    return (name, changes), angle


DESIGNS = {
    "face edge": (EDGE_FIRST, -40.0),
    "tip edge": (EDGE_FIRST, 30.0),
    "ZA": worm(("ZA",), {"vertical_deg": 0.1}, 20.0, face=10.0),
    "ZA tips": worm(("ZA",), {"center_distance_mm": 0.1}, -60.0, tip=22.0, throat=85.0),
    "ZI": worm(("ZI",), {"vertical_deg": -0.1, "axial_mm": 0.1}, 0.0, face=8.0),
    "ZI left flank": worm(("ZI",), {"horizontal_deg": 0.1}, 45.0, flank="left", face=12.0),
    "ZN": worm(("ZN",), {"vertical_deg": 0.2}, -90.0, face=20.0),
    "ZN short": worm(("ZN",), {"center_distance_mm": -0.05}, 120.0, tip=22.5, throat=86.0),
    "ZK": worm(("ZK",), {"vertical_deg": -0.15}, 60.0, face=14.0),
    "ZC": worm(("ZC",), {"vertical_deg": 0.15, "center_distance_mm": 0.03}, -30.0, face=14.0),
    "ZI by ZN": worm(("ZI", "ZN"), {"axial_mm": 0.2}, 10.0, face=10.0),
    "ZK by ZA": worm(("ZK", "ZA"), {"horizontal_deg": -0.1, "vertical_deg": 0.05}, -15.0, face=18.0),
    "ZK-ZN at 60°": packaged("zk-zn-60", 40.0, misalignment={"vertical_deg": 0.1}, blank={"wheel_face_width_mm": 8.0}),
    "ZK-ZN at 90°": packaged("zk-zn-90", -30.0, misalignment={"vertical_deg": -0.1}),
    "left hand": packaged("plain-zn", 33.0, misalignment={"vertical_deg": 0.1}, design={"hand": "left"},
                          blank={"wheel_face_width_mm": 12.0}),
    "convex": packaged("spherical-table-3-1-convex", 2.0, misalignment={"vertical_deg": 0.3}),
    "concave": packaged("spherical-table-4-4-concave", -3.0, misalignment={"vertical_deg": -0.4},
                        design={"face_width_mm": 12.0}),
    "spur wheel": packaged("spherical-table-5-2-spur", 12.0, misalignment={"center_distance_mm": 0.2}),
    "convex face gear": packaged("face-worm-conical-convex", 60.0, misalignment={"offset_mm": 0.05}),
    "concave face gear": packaged("face-worm-cylindrical-concave", -120.0, misalignment={"shaft_angle_deg": 0.05}),
    "beyond the window, along a curved tip": packaged("plain-zi", -294.5),
    "beyond the window at 90°": packaged("zk-zn-90", -191.2),
    "short face gear": packaged("face-worm-conical-concave", 200.0, misalignment={"axial_mm": 0.05},
                                blank={"gear_addendum_mm": 0.4}),
    "bevel, crowned both ways": packaged("bevel-crowned-both", 9.0, misalignment={"offset_mm": 0.2}),
    "bevel, crowned lengthwise": packaged("bevel-crowned-lengthwise", -7.0, misalignment={"shaft_angle_deg": -0.1}),
    "bevel, crowned in profile": packaged("bevel-crowned-profile", 14.0, misalignment={"gear_axial_mm": -0.15}),
    "bevel, Formate": packaged("bevel-formate", -14.0, misalignment={"offset_mm": -0.3, "pinion_axial_mm": 0.1}),
    "bevel, Formate, at the undercut that begins contact": packaged("bevel-formate", -20.3232),
    "bevel, Formate, undercut and tip": packaged("bevel-formate", -21.3051),
    "bevel, Formate, past its undercut": packaged("bevel-formate", -27.8505),
    "bevel, face-hobbed": packaged("bevel-face-hobbed", 115.0, misalignment={"offset_mm": 0.1}),
    "bevel, face-hobbed in profile": packaged("bevel-face-hobbed-profile", 97.0, misalignment={"shaft_angle_deg": 0.1}),
    "hypoid": packaged("bevel-hypoid", 20.0, misalignment={"shaft_angle_deg": 0.15, "gear_axial_mm": 0.1}),
    "helical, tilted": packaged("helical-crowned", 3.0, misalignment={"horizontal_deg": 0.08}),
    "helical, past its face": packaged("helical-crowned", -19.5, misalignment={"vertical_deg": 0.03}),
    "helical, two edges": packaged("helical-crowned", -24.0, misalignment={"center_distance_mm": 0.03}),
    "helical, short tips": packaged("helical-crowned", 14.0, misalignment={"horizontal_deg": -0.05},
                                    blank={"pinion_tip_radius_mm": 33.5, "wheel_tip_radius_mm": 57.5}),
    "crossed helical": packaged("crossed-helical-17-23", -8.0, misalignment={"vertical_deg": 0.5}),
    "spur, tilted": packaged("spur-profile-shift", 5.0, misalignment={"vertical_deg": 0.05, "horizontal_deg": 0.02}),
}  # fmt: skip


def drive_of(entry):
    if isinstance(entry, dict):
        return Drive.from_tables(entry)
    name, changes = entry
    return Drive.load(name).with_(**changes)


def brute_force(drive, angle, found):
    """Transmission error, rad, of the first contact by the independent search over the wheel's whole region."""
    mirror = drive.design.mirror.sign
    places = np.linspace(-0.5, 0.5, 9) * drive.pitch()
    known, _ = drive.trace(places)
    if not np.isfinite(known).all(axis=1).any():  # only the aligned drive has a tangency
        known, _ = drive.with_(misalignment=dict.fromkeys(drive.design.given()["misalignment"], 0.0)).trace(places)
    at = mirror * angle
    here = drive.tca([angle])
    on_sheet = np.isfinite(here.solutions).all() and not any(map(impossible, here.flags[0]))
    known = here.solutions[0] if on_sheet else known[np.isfinite(known).all(axis=1)][0]
    side = np.sign(mirror * found.levers[0])
    vertices = drive.region("wheel").lattice((24, 24)).q[..., :2].reshape(-1, 2)
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    return mirror * FirstTouch(drive, at, known, side).highest(np.array([low, high]))


def check(name):
    entry, degrees = DESIGNS[name]
    drive, angle = drive_of(entry), np.radians(degrees)
    tangency = drive.tca([angle])
    found = drive.first_contact([angle], tangency)
    assert found.unresolved[0] <= 1e-4
    expected = brute_force(drive, angle, found)
    assert found.errors[0] == pytest.approx(expected, abs=1e-6 * ARCSEC)
    if tangency.solved[0] and not tangency.flags[0]:
        overlap = found.overlaps(tangency.error)[0]
        assert overlap == pytest.approx(max(found.levers[0] * (expected - tangency.error[0]), 0.0), abs=1e-7)
        assert (expected - tangency.error[0]) * found.levers[0] > -1e-6


#: One of each kind of drive and of what touches first; brute force takes minutes for each.
KINDS = (
    "tip edge", "ZI", "ZN short", "left hand", "concave", "short face gear", "beyond the window, along a curved tip",
    "bevel, face-hobbed", "hypoid", "helical, tilted", "helical, two edges", "crossed helical",
)  # fmt: skip


@pytest.mark.validate
@pytest.mark.parametrize("name", ["face edge"])
def test_first_contact_is_what_brute_force_finds(name):
    check(name)


@pytest.mark.validate
@pytest.mark.parametrize("name", some((n for n in DESIGNS if n != "face edge"), *KINDS))
def test_first_contact_is_what_brute_force_finds_on_other_designs(name):
    check(name)


@pytest.mark.validate
def test_a_tangency_that_the_edge_of_the_face_precedes_is_not_first(tmp_path, capsys):
    """At −40° the tangency of the equations, −36.64″, overlaps by 6 µm where the face's edge touches at −16.84″."""
    design = tmp_path / "edge.toml"
    design.write_text(_toml(EDGE_FIRST), encoding="utf-8")
    assert main(["tca", str(design), "--phi-deg=-40", "--json", "-"]) == 1
    (point,) = json.loads(capsys.readouterr().out)["points"]
    first = point["first_contact"]
    assert point["flags"] == ["not_first"] and (first["kind"], first["member"]) == ("edge", "wheel")
    assert first["transmission_error_arcsec"] == pytest.approx(-16.83688, abs=1e-5)
    assert first["overlap_mm"] == pytest.approx(6.03e-3, abs=5e-6)


def test_the_load_is_on_the_edge_that_touches_first_of_all_pairs(tmp_path, capsys, monkeypatch):
    """Rigid teeth of one pair would touch at -16.83688", its tangency 6 um inside: the tip of another one is ahead."""
    monkeypatch.setattr(loading, "compliances", lambda *_: None)
    design = tmp_path / "edge.toml"
    design.write_text(_toml(EDGE_FIRST), encoding="utf-8")
    drive = Drive.load(str(design))
    first = drive.first_contact(np.radians(-40.0) - drive.pitch() * np.array([-1, 0, 1]))
    lead = int(np.nanargmax(Mesh.of(drive).sense * first.errors))
    assert first.errors[1] / ARCSEC == pytest.approx(-16.83688, abs=1e-5) and first.kinds[lead] == "edge"
    command = ["loaded", str(design), "--torque-nm", "20", "--pairs", "1", "--phi-deg=-40", "--json", "-"]
    assert main(command) == 0
    (point,) = json.loads(capsys.readouterr().out)["points"]
    assert point["unloaded_transmission_error_arcsec"] == pytest.approx(first.errors[lead] / ARCSEC, abs=1e-6)
    (edge,) = [pair for pair in point["pairs"] if pair["force_n"] > 0.0]
    assert (edge["pairs_later"], edge["kind"], edge["gap_um"]) == (lead - 1, "edge", 0.0)
    assert edge["first_contact"] == first.words(lead) and edge["share"] == pytest.approx(1.0)
    unloaded, lagging = (point[f"{key}_transmission_error_arcsec"] for key in ("unloaded", "loaded"))
    assert Mesh.of(drive).sense * (unloaded - lagging) > 0.0


@pytest.mark.validate
def test_the_edge_of_another_pair_carries_that_touches_before_every_tangency(capsys):
    """Tilted crowned gears: one pair is tangent, the pair before it still rides on the edge of a face, 17″ ahead."""
    (name, changes), _ = DESIGNS["helical, tilted"]
    drive = Drive.load(name).with_(**changes)
    first = drive.first_contact(np.radians(10.83) - drive.pitch() * np.array([0, 1]))
    assert first.kinds == ("edge", "tangency") and first.errors[0] > first.errors[1] + 10.0 * ARCSEC
    misalignment = [f"--set=misalignment.{key}={value}" for key, value in changes["misalignment"].items()]
    assert main(["loaded", name, *misalignment, "--torque-nm", "20", "--phi-deg=10.83", "--json", "-"]) == 0
    (point,) = json.loads(capsys.readouterr().out)["points"]
    edge = next(pair for pair in point["pairs"] if pair["pairs_later"] == 0)
    assert (edge["kind"], edge["first_contact"]) == ("edge", "edge of the pinion (left face)") and edge["force_n"] > 0.0
    assert point["unloaded_transmission_error_arcsec"] == pytest.approx(first.errors[0] / ARCSEC, abs=1e-6)
    assert "pair +0 touches first with the edge of the pinion (left face)" in point["message"]


@pytest.mark.validate
def test_the_report_says_what_touches_before_a_tangency():
    analysis = analyse(Drive.from_tables(EDGE_FIRST), lambda text: None)
    said = [f.text for f in findings(analysis) if "first contact is" in f.text]
    assert len(said) == 1 and "edge of the wheel (right face)" in said[0] and "µm inside the other flank" in said[0]


@pytest.mark.parametrize("name", ["face-worm-conical-convex", "plain-zc", "bevel-formate"])
def test_first_contact_of_a_pair_is_continuous(name):
    """Over a pair's window and a quarter of a pitch past either end, nothing jumps to another tooth or is lost.

    Errors of neighbours a thousandth of a pitch apart differ by less than a tooth could turn the wheel by then.
    """
    mesh = Mesh.of(Drive.load(name))
    first, pitch = pair_errors(mesh), mesh.drive.pitch()
    low, high = sorted((mesh.window.begin.angle, mesh.window.end.angle))
    places = np.linspace(low - 0.25 * pitch, high + 0.25 * pitch, 25)
    here, there = first(places), first(places + 1e-3 * pitch)
    assert np.isfinite(here).all() and np.isfinite(there).all()
    assert np.abs(there - here).max() < 1e-3 * mesh.drive.ratio * pitch


def test_a_contact_asked_for_up_to_an_angle_is_the_first_before_it_and_no_earlier_one_beyond():
    mesh = Mesh.of(Drive.load("face-worm-conical-convex"))
    first, begin = pair_errors(mesh), mesh.window.begin.angle
    for angle in begin + mesh.drive.pitch() * np.array([-0.3, 0.2, 0.7]):
        (error,) = first([angle])
        for further in (1e-3, 1e-9):
            assert first([angle], error - mesh.sense * further) == error
            (found,) = first([angle], error + mesh.sense * further)
            assert not mesh.sense * (found - error) > 0.0


def _toml(tables):
    lines = [f"{key} = {json.dumps(value)}" for key, value in tables.items() if not isinstance(value, dict)]
    for name, table in tables.items():
        if isinstance(table, dict):
            lines += [f"[{name}]", *(f"{key} = {json.dumps(value)}" for key, value in table.items())]
    return "\n".join(lines) + "\n"


def test_a_pair_whose_contact_begins_at_an_undercut_touches_there_on_the_undercut_line():
    """From the very begin of contact on and before it: where the tangency goes over the line that ends the flank."""
    drive = Drive.load("bevel-formate")
    begin, pitch = Mesh.of(drive).window.begin, drive.pitch()
    assert (begin.reason, begin.member) == ("undercut", "pinion")
    found = drive.first_contact(begin.angle + pitch * np.array([-0.02, -0.005, 0.0, 0.005, 0.02]))
    assert found.kinds[:2] == ("edge", "edge") and found.kinds[3:] == ("tangency", "tangency")
    assert found.limits[:2] == (("undercut",), ("undercut",)) and found.members[:2] == ("pinion", "pinion")
    assert np.abs(found.errors).max() < 0.05 * ARCSEC and found.unresolved.max() <= 1e-4


def test_an_aligned_drive_touches_first_where_its_tangency_is():
    drive = Drive.load("plain-zi")
    tangency = drive.tca(np.radians([-30.0, 0.0, 30.0]))
    found = drive.first_contact(tangency.angles, tangency)
    assert found.kinds == ("tangency",) * 3
    assert found.errors == pytest.approx(tangency.error, abs=1e-11)
    assert found.points == pytest.approx(tangency.points, abs=1e-6)


@pytest.mark.parametrize("name", ["bevel-face-hobbed-crown-pair", "bevel-crown-pair", "spur-profile-shift"])
def test_conjugate_flanks_touch_first_somewhere_on_their_line_of_contact(name, capsys):
    """All of a line is as high as its highest place: the search says which error that is, and leaves nothing open."""
    assert main(["tca", name, "--json", "-"]) == 0
    printed = capsys.readouterr()
    first = [point["first_contact"] for point in json.loads(printed.out)["points"]]
    assert len(first) >= 10 and "missed" not in printed.err
    assert max(abs(found["transmission_error_arcsec"]) for found in first) < 1e-9
    assert max(found["unresolved_mm"] for found in first) < 1e-9


def test_one_angle_has_one_first_contact_whichever_others_are_asked_for():
    drive = Drive.from_tables(EDGE_FIRST)
    angles = np.radians(np.arange(-40.0, 41.0, 20.0))
    together = drive.first_contact(angles).errors
    assert [drive.first_contact([a]).errors[0] for a in angles] == pytest.approx(together, abs=1e-14)


def test_flanks_without_any_tangency_touch_on_an_edge():
    """A tilt of 0.15° takes the tangency away at every angle; the bodies touch at the edge of the face."""
    drive = Drive.from_tables(DESIGNS["ZK"][0])
    assert not drive.tca([0.0]).solved[0]
    found = drive.first_contact([0.0])
    assert (found.kinds, found.members, found.limits) == (("edge",), ("wheel",), (("face",),))


def test_a_wheel_without_face_has_no_first_contact(capsys):
    """The recess-action blank leaves the face open: nothing says where the flank would touch beyond what is known."""
    assert main(["tca", "recess-action-full", "--phi-deg", "400", "--json", "-"]) == 0
    assert json.loads(capsys.readouterr().out)["points"][0]["first_contact"] is None


def test_the_mirror_image_touches_first_at_the_mirrored_place():
    right = Drive.from_tables(EDGE_FIRST)
    left = right.with_(design={"hand": "left"})
    one, other = right.first_contact([-0.7]), left.first_contact([0.7])
    assert (one.kinds, one.members) == (other.kinds, other.members)
    assert other.errors == pytest.approx(-one.errors, abs=1e-12)
    assert other.points == pytest.approx(one.points * [1.0, -1.0, 1.0], abs=1e-9)


def test_where_a_path_of_contact_has_left_the_face_the_edge_that_touches_is_found():
    """Over a face and on from where two edges cross: first contact is the edge contact that its own equations give."""
    drive = Drive.load("helical-crowned")
    angles = np.radians([-17.9, -19.4, -20.9, -22.4, -23.9, -25.4])
    found = drive.first_contact(angles)
    edges = [edge for edge in edge_paths(Mesh.of(drive)) if edge is not None and (edge.angles < 0.0).any()]
    (expected,) = (edge.errors(angles) for edge in edges)
    assert np.isfinite(expected).all()
    assert found.errors == pytest.approx(expected, abs=1e-6 * ARCSEC)
    assert set(found.members) == {"pinion", "both"}


@pytest.mark.parametrize(
    ("name", "begin", "end"),
    quick(
        [
            ("helical-crowned", -1.2, 1.2), ("plain-zi", -1.3, -0.6), ("bevel-crowned-both", -0.9, -0.6),
            ("face-worm-conical-convex", -1.0, 1.0), ("spherical-table-2-2-convex-20", -1.0, 1.0),
        ],
        ("helical-crowned", -1.2, 1.2),
    ),
)  # fmt: skip
def test_first_contacts_followed_between_angles_are_those_searched_for(name, begin, end):
    """Over changes from tangencies to edges and corners: at some angles of many, a search of its own."""
    drive, rows = Drive.load(name), np.random.default_rng(3).choice(3000, 25, replace=False)
    angles = np.linspace(begin, end, 3000) * drive.pitch()
    many = drive.first_contact(angles)
    for k in rows:
        alone = Drive.load(name).first_contact(angles[[k]])
        assert (many.kinds[k], many.limits[k], many.edges[k]) == (alone.kinds[0], alone.limits[0], alone.edges[0])
        assert many.errors[k] == pytest.approx(alone.errors[0], abs=1e-9 * ARCSEC, nan_ok=True)
        assert many.untouched[k] == alone.untouched[0]


def test_many_angles_are_searched_for_at_few_of_them(monkeypatch):
    searches = []
    one = search.Search._one
    monkeypatch.setattr(search.Search, "_one", lambda self, *at: searches.append(at) or one(self, *at))
    drive = Drive.load("helical-crowned")
    drive.first_contact(np.linspace(-0.5, 0.5, 20_000) * drive.pitch())
    assert len(searches) < 400
