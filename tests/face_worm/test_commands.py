"""The command line on face worm drives."""

import json

import pytest

from meshwright.cli import main
from tests.face_worm.designs import NAMES


def _json(capsys, *arguments):
    status = main([*arguments, "--json", "-"])
    return status, json.loads(capsys.readouterr().out)


@pytest.mark.parametrize("name", NAMES)
def test_tca_of_every_packaged_design(capsys, name):
    status, document = _json(capsys, "tca", name, "--phi-deg=-90:90:45")
    assert status == 0
    assert document["schema"] == "meshwright.tca/1" and document["drive"] == "face-worm"
    assert [p["status"] for p in document["points"]] == ["converged"] * 5
    unknowns = {"u_worm", "theta_worm", "psi_worm", "u_gear", "theta_gear"}
    assert set(document["points"][0]["unknowns"]) == unknowns


def test_tca_says_edge_contact(capsys):
    errors = ["misalignment.offset_mm=0.1", "misalignment.axial_mm=0.1", "misalignment.shaft_angle_deg=0.05"]
    settings = [word for setting in errors for word in ("--set", setting)]
    status, document = _json(capsys, "tca", NAMES[1], *settings, "--phi-deg=-90:90:45")
    assert status == 0
    assert all(p["flags"] == ["edge_contact"] for p in document["points"])
    assert all(p["transmission_error_arcsec"] is not None for p in document["points"])


def test_limits_name_all_members_and_judge_the_head_cutter(capsys):
    status, document = _json(capsys, "limits", NAMES[2], "--grid", "3")
    assert status == 0
    assert {u["member"] for u in document["undercut"]} == {"wheel", "reference_wheel"}
    assert not any(u["on_flank"] for u in document["undercut"])
    judged = document["head_cutter"]
    assert not judged["clears"] and judged["clearance_mm"] < 0
    assert judged["least_tilt_deg"] > judged["tilt_deg"]


def test_ratio_runs_from_the_outer_to_the_inner_radius(capsys):
    for name in NAMES[:2]:
        _, document = _json(capsys, "ratio", name)
        ends = document["begin"], document["end"]
        assert [(e["event"], e["member"]) for e in ends] == [("face", "wheel")] * 2
        assert ends[0]["pinion_angle_deg"] < 0 < ends[1]["pinion_angle_deg"]
        assert document["transmission_error"]["envelope"] == ("upper" if name.endswith("convex") else "lower")


@pytest.mark.parametrize(
    ("setting", "words"),
    [
        ("design.profile_angle_deg=91.0", ("profile_angle_deg", "less than 90")),
        ("design.gear_outer_radius_mm=38.0", ("gear_outer_radius_mm", "gear_inner_radius_mm")),
        ("design.gear_inner_radius_mm=36.0", ("gear_inner_radius_mm = 36.0", "undercuts", "change")),
        ("design.head_cutter_radius_mm=-1.0", ("head_cutter_radius_mm", "greater than 0")),
    ],
)
def test_bad_designs_end_with_status_2_and_name_the_key(capsys, setting, words):
    assert main(["tca", NAMES[0], "--set", setting]) == 2
    message = capsys.readouterr().err
    assert all(word in message for word in words)
