"""Internal gears by the commands: a first design in the words of a drawing, and what goes on from there."""

import json
import random

import pytest

from meshwright import Drive
from meshwright.cli import main


@pytest.fixture
def first(tmp_path, monkeypatch, capsys):
    """The design that ``new`` writes for these words."""

    def made(words):
        monkeypatch.chdir(tmp_path)
        status = main(f"new {words} --out first.toml".split())
        said = capsys.readouterr()
        return status, said.out + said.err, tmp_path / "first.toml"

    return made


@pytest.mark.parametrize("words", [
    "cylindrical-gears --m 2 --z 20:-60", "internal-gears --m 2 --z 20:-60 --a 39.5",
    "cylindrical-gears --m 2 --z 45:-60 --helix-angle 20 --pinion-hand left",
    "cylindrical-gears --m 2 --z 20:-60 --normal-backlash 0.1 --wheel-tip-diameter 117.4 --shaper-teeth 18",
])  # fmt: skip
def test_a_negative_number_of_teeth_gives_a_pair_that_meshes(first, capsys, words):
    status, said, path = first(words)
    assert status == 0 and "the flanks touch" in said
    drive = Drive.load(str(path))
    assert drive.design.family == "internal-gears"
    assert drive.contact_ratio().contact_ratio > 1.0
    assert main(["tca", str(path), "--certify", "--json", "-"]) == 0
    points = json.loads(capsys.readouterr().out)["points"]
    assert {p["certificate"]["outcome"] for p in points if p["status"] == "converged"} == {"unique"}


def test_outer_teeth_lead_back_to_external_gears(first):
    status, _, path = first("internal-gears --m 2 --z 20:60")
    assert status == 0 and Drive.load(str(path)).design.family == "cylindrical-gears"


@pytest.mark.parametrize("seed", range(4))
def test_first_designs_mesh_or_name_a_size_to_change(first, seed):
    """Random numbers of teeth, modules and helix angles: exit 0 with contact, or 2 with a size."""
    rng = random.Random(seed)
    z_1 = rng.randint(10, 60)
    z_2, beta = z_1 + rng.randint(3, 80), rng.choice([0, rng.uniform(5, 30)])
    m = rng.uniform(0.5, 8)
    status, said, path = first(f"cylindrical-gears --m {m:.3g} --z {z_1}:-{z_2} --helix-angle {beta:.4g}")
    if status == 0:
        assert "the flanks touch" in said and Drive.load(str(path)).contact_ratio().contact_ratio > 1.0
    else:
        assert status == 2 and not path.exists()
        assert any(word in said for word in ("teeth", "tip", "pressure angle", "profile shift"))


def test_commands_run(first, capsys):
    _, _, path = first("cylindrical-gears --m 2 --z 20:-60")
    for words in ("ratio", "limits", "drawing"):
        assert main([words, str(path), "--json", "-"]) == 0
        json.loads(capsys.readouterr().out)
    assert main(["surface", str(path), "--member", "wheel", "--region", "fillet", "--grid", "5x3", "--json", "-"]) == 0
    points = json.loads(capsys.readouterr().out)["points_mm"]
    radii = [(p[0] ** 2 + p[1] ** 2) ** 0.5 for p in points if p]
    root = Drive.load(str(path)).drawing().sizes["wheel_root_radius_mm"].value
    assert max(radii) == pytest.approx(root, abs=1e-9)
