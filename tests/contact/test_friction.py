"""Efficiency and self-locking: power balance by torques about the axes, closed forms of involute worms, tables."""

import json
import math

import numpy as np
import pytest

from meshwright import Drive
from meshwright.base.errors import UsageError
from meshwright.cli import main
from meshwright.contact.friction import Friction, efficiency, mean_efficiency
from meshwright.cycle.pairs import Mesh

ANGLES = np.radians([-40.0, -3.0, 0.0, 11.0, 70.0])


@pytest.mark.parametrize("flank", ["right", "left"])
def test_power_balance_of_a_worm_drive_by_torques_about_its_axes(flank):
    """Force n + μe at the contact; torques about z and about −y through (A, 0, 0); what is lost is μ times sliding."""
    drive = Drive.load("plain-za").with_(flank=flank)
    found, mu = drive.tca(ANGLES), 0.07
    rub = efficiency(drive, found, Friction.of(str(mu)))
    distance = drive.design.value("center_distance_mm")
    for k, (r, n) in enumerate(zip(found.points, found.normals, strict=True)):
        sense = math.copysign(1.0, np.cross([0.0, 0.0, 1.0], r) @ n)
        one, two = sense, sense * found.instantaneous_ratio[k]  # speeds about z and −y
        arms = np.cross([0.0, 0.0, 1.0], r), np.cross([0.0, -1.0, 0.0], r - [distance, 0.0, 0.0])
        sliding = one * arms[0] - two * arms[1]
        for sign, driven in ((1.0, "pinion"), (-1.0, "wheel")):
            force = n + sign * mu * sliding / np.linalg.norm(sliding)
            torques = [arm @ force for arm in arms]
            lost = sign * (torques[0] * one - torques[1] * two)
            assert lost == pytest.approx(mu * np.linalg.norm(sliding), rel=1e-12)
            share = torques[1] * two / (torques[0] * one)
            expected = share if driven == "pinion" else 1.0 / share
            assert getattr(rub, f"{driven}_drives")[k] == pytest.approx(expected, rel=1e-12)


def _involute_worm(lead_angle):
    """A ZI worm as the pinion of crossed helical gears at right angles: at angle 0 they touch at the pitch point."""
    return Drive.from_tables({
        "drive": "cylindrical-gears",
        "design": {
            "normal_module_mm": 3.0, "pressure_angle_deg": 20.0, "pinion_teeth": 2, "wheel_teeth": 41,
            "pinion_helix_angle_deg": 90.0 - lead_angle, "wheel_helix_angle_deg": lead_angle, "shaft_angle_deg": 90.0,
            "face_width_mm": 20.0,
        },
    })  # fmt: skip


@pytest.mark.parametrize("lead_angle", [6.0, 12.0, 30.0])
def test_an_involute_worm_at_its_pitch_point_in_closed_form(lead_angle):
    """η = tan γ/tan(γ + ρ') and tan(γ − ρ')/tan γ with tan ρ' = μ/cos α_n; self-locking from μ = cos α_n tan γ on."""
    drive, gamma, alpha = _involute_worm(lead_angle), math.radians(lead_angle), math.radians(20.0)
    found = drive.tca(np.zeros(1))
    for mu in (0.03, 0.09, 0.3):
        rub, angle = efficiency(drive, found, Friction.of(str(mu))), math.atan(mu / math.cos(alpha))
        assert rub.pinion_drives[0] == pytest.approx(max(0.0, math.tan(gamma) / math.tan(gamma + angle)), rel=1e-9)
        assert rub.wheel_drives[0] == pytest.approx(max(0.0, math.tan(gamma - angle) / math.tan(gamma)), rel=1e-9)
        assert rub.locked[0] == (angle >= gamma)
    assert rub.self_locking[0] == pytest.approx(math.cos(alpha) * math.tan(gamma), rel=1e-9)


def test_no_friction_loses_nothing_and_the_mean_lies_between_the_points():
    mesh = Mesh.of(Drive.load("plain-za"))
    free, rough = (mean_efficiency(mesh, Friction.of(mu)) for mu in ("0", "0.05"))
    assert free.pinion_drives == pytest.approx(1.0, abs=1e-12) and free.wheel_drives == pytest.approx(1.0, abs=1e-12)
    low, high = sorted((mesh.window.begin.angle, mesh.window.end.angle))
    points = efficiency(mesh.drive, mesh.drive.tca(np.linspace(low, high, 9)), Friction.of("0.05")).pinion_drives
    assert points.min() < rough.pinion_drives < points.max()


def test_a_table_is_read_between_its_lines(tmp_path):
    table = tmp_path / "mu.csv"
    table.write_text("# grease\nvelocity_m_per_s,friction\n0,0.1\n1,0.05\n4,0.02\n")
    friction = Friction.of(str(table), 3000.0 / math.pi)  # 100 rad/s
    assert friction.at(np.array([0.0, 5.0, 25.0])) == pytest.approx([0.1, 0.075, 0.035])
    with pytest.raises(UsageError, match="beyond the table"):
        friction.at(np.array([50.0]))


@pytest.mark.parametrize(
    ("text", "rpm", "word"),
    [("x", 10.0, "neither a number nor a file"), ("-0.1", None, "coefficient"), ("nan", None, "coefficient"),
     ("0.1", -1.0, "--pinion-rpm"), ("TABLE", None, "give --pinion-rpm")],
)  # fmt: skip
def test_wrong_friction_is_refused(text, rpm, word):
    with pytest.raises(UsageError, match=word):
        Friction.of(text, rpm)


@pytest.mark.parametrize(
    "content", ["", "a,b\n0,0.1\n", "velocity_m_per_s,friction\n", "velocity_m_per_s,friction\n1,x\n",
                "velocity_m_per_s,friction\n1,0.1\n1,0.2\n", "velocity_m_per_s,friction\n-1,0.1\n",
                "velocity_m_per_s,friction\ninf,0.1\n", "velocity_m_per_s,friction\n1,9\n"],
)  # fmt: skip
def test_wrong_tables_are_refused(content, tmp_path, capsys):
    table = tmp_path / "mu.csv"
    table.write_text(content)
    assert main(["tca", "plain-za", "--phi-deg", "0", "--friction", str(table), "--pinion-rpm", "100"]) == 2
    assert str(table) in capsys.readouterr().err


def test_commands_write_it(capsys):
    assert main(["tca", "crossed-helical-17-23", "--phi-deg", "0", "--friction", "0.05", "--json", "-"]) == 0
    (point,) = json.loads(capsys.readouterr().out)["points"]
    assert point["friction"] == 0.05 and point["self_locking"] is False
    assert 0.0 < point["efficiency"]["wheel_drives"] < 1.0 and 0.0 < point["efficiency"]["pinion_drives"] < 1.0
    main(["tca", "crossed-helical-17-23", "--phi-deg", "0", "--json", "-"])
    (point,) = json.loads(capsys.readouterr().out)["points"]
    assert point["friction"] is None and point["efficiency"]["pinion_drives"] is None
    assert point["self_locking_friction"] == pytest.approx(math.cos(math.radians(20.0)))
