"""A tool declares what it needs to know beside its geometry, and nothing else of a drive changes for it."""

from dataclasses import replace

import mpmath
import pytest
import sympy as sp

from derive.drives import cylindrical_worm
from derive.language.outline import m
from derive.language.tool import Datum, Tool, suggestions, tool
from derive.passes.sample import sample_parameters
from derive.passes.schedule import schedule
from tests.outside.drives.crowned_worm import crowned_axial_blade


@pytest.fixture
def crowned(monkeypatch):
    monkeypatch.setitem(cylindrical_worm.TOOLS, "ZX", crowned_axial_blade)
    return cylindrical_worm.cylindrical_worm("ZX", "ZX")


def _keys(drive):
    return [p.key for p in drive.parameters]


def test_a_key_of_the_tool_is_a_key_of_the_drives_that_use_it(crowned):
    assert {"blade_crown_per_mm", "hob_blade_crown_per_mm"} <= {*_keys(crowned)}
    assert crowned.sample["blade_crown_per_mm"] == "0.001"
    assert [(use.body, use.word, use.keys) for use in crowned.tools] == [
        ("worm", "ZX", ("blade_crown_per_mm",)), ("hob", "ZX", ("blade_crown_per_mm", "hob_blade_crown_per_mm")),
    ]  # fmt: skip
    plain = cylindrical_worm.cylindrical_worm("ZA", "ZN")
    assert not [key for key in _keys(plain) if "crown" in key or "grinding" in key or "arc" in key]


def test_the_hob_takes_the_datum_of_the_worm_unless_it_has_its_own(crowned):
    symbol = {p.key: p.symbol for p in crowned.parameters}
    values = sample_parameters(crowned)
    assert values[symbol["hob_blade_crown_per_mm"]] == values[symbol["blade_crown_per_mm"]] == mpmath.mpf("0.001")


def test_the_flank_stands_off_the_straight_one_by_the_parabola(crowned):
    """At a mm from the pitch cylinder by c·a²/cos γ along the axis, whatever else the blade is."""
    straight = cylindrical_worm.cylindrical_worm("ZA", "ZA")
    with_crown, without = (d.pinion.surface.definitions.resolve(d.pinion.surface.point[2]) for d in (crowned, straight))
    symbols = {q.name: q for q in with_crown.free_symbols}
    numbers = {"c_worm": sp.Rational(1, 100), "lambda_worm": sp.pi / 3, "s": 1, "t_worm": 23, "r_worm": 20}
    gap = (with_crown - without).subs({symbols[name]: value for name, value in numbers.items()})
    assert sp.expand(gap) == -sp.Rational(9, 100) * 2


def test_the_whole_drive_follows(crowned):
    """The sample meshes: its residual vanishes with the crowned blade's own coefficient in it."""
    plan = schedule(crowned)
    with mpmath.workdps(40):
        numbers = plan.tape.evaluate(plan.residual, plan.sample, mpmath)
    assert max(map(abs, numbers)) < 1e-20


def test_a_tool_is_called_by_its_docstring_its_module_or_its_name(crowned):
    """Whichever says what it is first."""
    bare = tool()(lambda body, definitions: None)
    assert bare.title == __doc__.splitlines()[0]
    assert all(use.tool.title for use in crowned.tools)


def test_a_first_design_takes_what_a_tool_suggests_or_must_know():
    """Without a suggestion the sample's number of what is required; what has a default stays open."""
    asked = Datum("arc_radius_mm", "rho", "radius of the arc", required=True, sample="2.5")
    own = replace(asked, key="own_mm", suggested=3 * m, why="three modules")
    made = Tool(lambda body, definitions: None, (asked, own))
    other = Tool(lambda body, definitions: None, (asked, Datum("crown_per_mm", "c", "crowning", default=0, sample=1)))
    first, second = suggestions([made, other])
    assert (first.place, first.values) == ("design.arc_radius_mm", (sp.Rational(5, 2),))
    assert (second.place, second.values, second.why) == ("design.own_mm", (3 * m,), "three modules")
