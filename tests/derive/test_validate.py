"""A description that contradicts itself is refused before anything is derived from it, and the message says where."""

from contextlib import nullcontext
from dataclasses import replace

import mpmath
import pytest
import sympy as sp

from derive import drives
from derive.language import vectors as v
from derive.language.chain import Motion, Rz, translation
from derive.language.contact import contact
from derive.language.drive import DesignSystem, Loading, Margin, Role
from derive.language.functions import Function, Result, solid
from derive.language.outline import Suggestion, m
from derive.language.refusal import DescriptionError
from derive.language.symbols import Guard, Parameter, Quantity, Rule, Table, Unknown, parameter
from derive.language.validate import validate
from derive.language.validate_outlines import validate_outlines
from derive.language.validate_sample import (
    validate_limits,
    validate_normals,
    validate_place,
    validate_play,
    validate_ratio,
    validate_regions,
)
from derive.passes.equations import derive
from derive.passes.joints import joints
from derive.passes.other_flank import on_other_flank
from derive.passes.sample import observation, sample_contact
from derive.passes.schedule import schedule
from derive.passes.similar import similar
from tests.quick import quick

POINT, SMALL = "spherical_convex_concave", "spherical_convex_spur"


def _drive(name=POINT):
    return drives.catalogue([name])[name]()


@pytest.fixture(scope="module")
def drive():
    return _drive()


def _with_key(drive, *keys, **changes):
    return replace(drive, parameters=(*drive.parameters, *keys), **changes)


def _with_margin(drive, margin):
    """The drive with this limit of its pinion, in place of that of the same event."""
    others = (m for m in drive.pinion.margins if m.event != margin.event)
    return replace(drive, pinion=replace(drive.pinion, margins=(*others, margin)))


def _with_scale(drive, scale):
    return replace(drive, unknowns=(Unknown(drive.unknowns[0].symbol, scale), *drive.unknowns[1:]))


@pytest.mark.parametrize("name", [*drives.catalogue(["spherical", "face_worm", "cylindrical_gears"]),
                                  "cylindrical_worm_zk_zn", "cylindrical_worm_zc_za"])  # fmt: skip
def test_every_drive_is_consistent(name):
    validate(_drive(name))


def _with_solid(drive, member, **sizes):
    return replace(drive, functions=(solid(member, sizes),))


def _with_function(drive, name, value=sp.S.One):
    return replace(drive, functions=(Function(name, "a function", (), (Result("one", (value,)),)),))


def _with_system(drive, *equations):
    one = DesignSystem("one", (Unknown(X),), equations, {X: sp.Integer(1)}, {MODULE: X}, "none", ("module_mm",))
    return replace(drive, systems=(one,))


def _without_regions(drive):
    pinion, wheel = (replace(body, margins=()) for body in drive.bodies)
    return replace(drive, pinion=pinion, wheel=wheel, regions=())


def _turning(drive, ratio):
    """The drive with a wheel that its motion turns by another ratio."""
    motion = drive.wheel.motion.substitute({drive.instant: ratio / drive.law * drive.instant})
    sizes = tuple(size for size in drive.sizes if size[0] != "ratio")
    return replace(drive, wheel=replace(drive.wheel, motion=motion), sizes=sizes, ratio=None, wheel_angle=None)


X = Quantity("x_at_pinion", "mm")
TEETH = Quantity("T_2")
MODULE = Quantity("m", "mm")
GUARD = Guard(sp.Symbol("m"), "never", ())
CASES = {
    "symbol is a body coordinate": (
        lambda d: _with_key(d, parameter("crown_mm", "x_at_pinion", "clash")), "x_at_pinion.*parameter.*coordinate"
    ),
    "symbol is an unknown": (
        lambda d: _with_key(d, parameter("crown_mm", "l_pinion", "clash")), "l_pinion.*parameter.*unknown"
    ),
    "symbol is a named intermediate result": (
        lambda d: _with_key(d, parameter("crown_mm", "ratio", "clash")), "ratio.*parameter.*intermediate"
    ),
    "two keys of one symbol": (lambda d: _with_key(d, parameter("crown_mm", "m", "clash")), "name 'm'"),
    "symbol that is no name": (lambda d: _with_key(d, parameter("crown_mm", "c-1", "bad")), "no name in C"),
    "key twice": (lambda d: _with_key(d, parameter("module_mm", "m_again", "twice")), "module_mm.*2 times"),
    "key in two tables": (
        lambda d: _with_key(d, parameter("module_mm", "m_blank", "twice", table=Table.BLANK)),
        r"module_mm.*\[design\].*\[blank\]",
    ),
    "sample lacks a required key": (
        lambda d: replace(d, sample={k: x for k, x in d.sample.items() if k != "module_mm"}), "lacks 'module_mm'"
    ),
    "sample gives an unknown key": (lambda d: replace(d, sample={**d.sample, "modul_mm": 4}), "gives 'modul_mm'"),
    "rule for no parameter": (lambda d: replace(d, rules=(*d.rules, Rule(Quantity("q"), sp.S.One))), "fills q"),
    "rule from no parameter": (
        lambda d: replace(d, rules=(*d.rules, Rule(d.parameters[1].symbol, sp.Symbol("q")))), "needs q"
    ),
    "proportion from no parameter": (
        lambda d: replace(d, proportions=(Rule(d.parameters[1].symbol, sp.Symbol("q")),)), "proportion.*needs q"
    ),
    "guard without keys": (lambda d: replace(d, guards=(*d.guards, GUARD)), "names no keys"),
    "guard with an unknown key": (
        lambda d: replace(d, guards=(replace(GUARD, keys=("modul_mm",)),)), "'modul_mm', which is not declared"
    ),
    "unknown flag": (lambda d: _with_margin(d, Margin("of_tip", "tip", X)), "unknown flag 'of_tip'"),
    "unknown event": (lambda d: _with_margin(d, Margin("off_tip", "top", X, Role.TIP)), "'top'.*no known event"),
    "unknown role": (lambda d: _with_margin(d, Margin("off_tip", "tip", X, "crest")), "unknown role 'crest'"),
    "role of another event": (
        lambda d: _with_margin(d, Margin("off_tip", "tip", X, Role.ROOT)), "'tip'.*role ROOT of another event"
    ),
    "junction with nothing": (
        lambda d: _with_margin(d, Margin("off_tip", "tip", X, Role.JUNCTION)), "'tip'.*is a junction and joins nothing"
    ),
    "ends of no face": (
        lambda d: _with_margin(d, Margin("off_tip", "tip", X, ends=("toe", "heel"))), "two words to a face"
    ),
    "margin of strangers": (lambda d: _with_margin(d, Margin("off_tip", "tip", sp.Symbol("q"))), "needs q"),
    "margin that joins nothing": (
        lambda d: _with_margin(d, Margin("off_tip", "tip", X, joins="filet")), "joins the region 'filet'"
    ),
    "equation too many": (lambda d: replace(d, residual=(*d.residual, sp.S.Zero)), "6 equations.*5 unknowns"),
    "exclusive group of no keys": (lambda d: replace(d, exclusive=(("module_mm", "modul_mm"),)), "'modul_mm'"),
    "teeth of no key": (lambda d: replace(d, pinion_teeth="teeth"), "pinion_teeth.*'teeth'"),
    "together of no keys": (lambda d: replace(d, together=(("design.modul_mm",),)), "design.modul_mm"),
    "reference angle of strangers": (lambda d: replace(d, reference_angle=sp.Symbol("q")), "reference angle needs q"),
    "sample that is no number": (
        lambda d: replace(d, sample={**d.sample, "module_mm": "wide"}), "'wide' for 'module_mm'"
    ),
    "sample outside its domain": (
        lambda d: replace(d, sample={**d.sample, "pressure_angle_deg": 90}), "gives 90.*domain"
    ),
    "default outside its domain": (
        lambda d: _with_key(d, parameter("crown_mm", "c", "crown", domain=(0, 1), default=0)), "default 0.*'crown_mm'"
    ),
    "size twice": (lambda d: replace(d, sizes=(*d.sizes, d.sizes[0])), "size 'center_distance_mm' is also"),
    "size of a key's name": (
        lambda d: replace(d, sizes=(*d.sizes, ("module_mm", sp.S.One, "one"))), "size 'module_mm' is also"
    ),
    "hand that is none": (lambda d: replace(d, handed="upright"), "handed = 'upright': use 'right', 'left'"),
    "key in a unit that is none": (
        lambda d: _with_key(d, parameter("crown_cm", "c", "crown")), "crown_cm.*'cm' of a unit.*end it in one of mm, um"
    ),
    "key of a compound unit that is none": (
        lambda d: _with_key(d, parameter("lead_mm_per_deg", "c", "lead")), "lead_mm_per_deg.*'per' of.*mm_per_rad"
    ),
    "size in a unit that is none": (
        lambda d: replace(d, sizes=(*d.sizes, ("lead_inch", sp.S.One, "lead"))), "lead_inch.*'inch' of a unit"
    ),
    "symbol in another unit than its key": (
        lambda d: _with_key(d, Parameter(Quantity("c", "rad"), "crown_mm")), "'crown_mm' is in 'mm'.*c in 'rad'"
    ),
    "event that is none": (
        lambda d: _with_margin(d, Margin("off_tip", "tipp", X)), "'tipp' of the pinion.*no known event; use one of tip"
    ),
    "event without a role of its own": (
        lambda d: _with_margin(d, Margin("off_tip", "fold", X)), "'fold' of the pinion.*role None; use one of TIP"
    ),
    "ratio that the wheel does not follow": (
        lambda d: replace(d, ratio=1 / d.law), r"motion of the wheel turns it by T_1/T_2 .*ratio is T_2/T_1"
    ),
    "size that the wheel does not follow": (
        lambda d: replace(d, sizes=(("ratio", 2 * d.law, "twice"),)), r"by T_1/T_2 .*the size 'ratio' is 2\*T_1"
    ),
    "motion that is told otherwise": (
        lambda d: replace(_turning(d, d.law * TEETH / (TEETH + 1)), ratio=d.law), r"by T_1/\(T_2 \+ 1\).*is T_1/T_2"
    ),
    "motion of a tooth that is not whole": (
        lambda d: _turning(d, 2 * d.law / 3), r"gives it 3\*T_2/2 teeth .* it needs a whole number of them"
    ),
    "motion of another sense than the error": (lambda d: _turning(d, -d.law), "-T_2 teeth.*in the sense of"),
    "motion of strangers": (lambda d: _turning(d, sp.Symbol("q")), "turns it by what needs q, which nothing gives"),
    "motion at rest": (lambda d: _turning(d, sp.S.Zero), "the ratio is zero, phi_pinion does not turn it"),
    "motion that travels too": (
        lambda d: replace(d, wheel=replace(d.wheel, motion=translation(x=d.instant) @ d.wheel.motion)),
        "phi_pinion moves the body otherwise than about the axis of transmission_error",
    ),
    "motion faster and faster": (
        lambda d: _turning(d, d.law * d.instant), "turns the body by .*phi_pinion.* for a radian, which is no fixed"
    ),
    "error of the pinion": (
        lambda d: replace(d, pinion=replace(d.pinion, motion=translation(x=d.error) @ d.pinion.motion)),
        "transmission_error moves it; only the wheel",
    ),
    "solid of no member": (
        lambda d: _with_solid(d, "gear", module=(1, "mm")), "solid_gear is of no member; use solid_pinion or solid_"
    ),
    "size that no solid has": (
        lambda d: _with_solid(d, "wheel", tip_frist=(1, "mm")), "'tip_frist' of solid_wheel is none.*use one of module"
    ),
    "size of a solid in another unit": (
        lambda d: _with_solid(d, "wheel", module=(1, "rad")), "'module' of solid_wheel is in 'rad'; give it in 'mm'"
    ),
    "thread that ends nowhere": (
        lambda d: _with_solid(d, "pinion", tip_radius=(1, "mm")), "neither a taper nor the function outline_pinion"
    ),
    "end of a flank in another unit than the flank": (
        lambda d: _with_solid(d, "wheel", tip_last=(1, "rad")), "'tip_last' of solid_wheel is in 'rad'; give it in 'mm'"
    ),
    "end of a fillet that is not there": (
        lambda d: _with_solid(_without_regions(d), "wheel", fillet_land=(1, "rad")), "of a fillet, which the wheel does"
    ),
    "torque on nobody": (lambda d: replace(d, loading=Loading(3, "gear")), "torque_on = 'gear'.*pinion, wheel"),
    "load on no pair": (lambda d: replace(d, loading=Loading(0, "wheel")), "pairs = 0"),
    "inexact number": (
        lambda d: replace(d, rules=(*d.rules, Rule(d.parameters[1].symbol, sp.Float("0.3")))), "rule for m.*Rational"
    ),
    "number that is none": (lambda d: _with_margin(d, Margin("off_tip", "tip", X / 0)), "'tip' of the pinion has zoo"),
    "function that is not computed": (
        lambda d: _with_margin(d, Margin("off_tip", "tip", sp.Max(X, 1))), "'tip' of the pinion uses Max.*use sin"
    ),
    "power that is not computed": (
        lambda d: _with_margin(d, Margin("off_tip", "tip", 2**X)), r"'tip' of the pinion has the power 2\*\*x_at_pinion"
    ),
    "angle of the wheel that needs what nobody gives": (
        lambda d: replace(d, wheel_angle=d.turned + sp.Symbol("hugo")), "wheel's angle needs hugo"
    ),
    "wheel that turns faster and faster": (
        lambda d: replace(d, wheel_angle=d.turned + d.law * (d.instant**3 - d.instant)), "the wheel's angle by"
    ),
    "body without a motion": (
        lambda d: replace(d, pinion=replace(d.pinion, motion=Motion())), "motion of the pinion.*does not turn the body"
    ),
    "limit that is nothing": (lambda d: _with_margin(d, Margin("off_tip", "tip", None)), "'tip' of the pinion is None"),
    "rule that is a text": (lambda d: replace(d, rules=(Rule(MODULE, "m"),)), "rule for m is 'm'; give"),
    "sample that is nothing": (
        lambda d: replace(d, sample={**d.sample, "module_mm": None}), "gives None for 'module_mm'; give a number, or"
    ),
    "sample angle that is nothing": (lambda d: replace(d, sample_angle=None), "sample angle is None; give.*in rad"),
    "sample angle that is no number": (lambda d: replace(d, sample_angle=float("nan")), "sample angle is nan; give"),
    "natural size that is none": (lambda d: _with_scale(d, sp.nan), "natural size of the unknown l_pinion has nan"),
    "natural size of strangers": (lambda d: _with_scale(d, sp.Symbol("q")), "size of the unknown l_pinion needs q"),
    "start without a guess": (
        lambda d: replace(d, start=replace(d.start, unknowns=(Unknown(X),))), "no guess for its unknown x_at_pinion"
    ),
    "limit twice": (
        lambda d: replace(d, pinion=replace(d.pinion, margins=2 * (Margin("off_tip", "tip", X),))), "2 limits 'tip'"
    ),
    "function of strangers": (
        lambda d: _with_function(d, "extra", sp.Symbol("q")), "'one' of extra needs q, which neither its arguments nor"
    ),
    "function that is no name": (lambda d: _with_function(d, "ex-tra"), "function 'ex-tra' is no name in C; use"),
    "function of a surface's name": (lambda d: _with_function(d, "flank_pinion"), "'flank_pinion' has the name of one"),
    "function twice": (
        lambda d: replace(d, functions=2 * (solid("wheel", {"module": (1, "mm")}),)), "'solid_wheel' is there 2 times"
    ),
    "family that is no text": (lambda d: replace(d, family=None), r"the family is None; give a text"),
    "family of two words": (lambda d: replace(d, family="a b"), r"the family 'a b' is no name in a design file"),
    "variant of a number": (lambda d: replace(d, variant={"form": 3}), r"the variant 'form' is 3; give a word"),
    "text that ends a comment": (lambda d: replace(d, title="a */ b"), r"title 'a \*/ b' has '\*/', which would end"),
    "sign of strangers": (
        lambda d: replace(d, pinion=replace(d.pinion, regular=sp.Symbol("q"))), "`regular` of the pinion needs q"
    ),
    "neither sign nor reference": (
        lambda d: replace(d, pinion=replace(d.pinion, regular=None, reference={})), "reference point gives no l_pinion"
    ),
    "member of another name": (
        lambda d: replace(d, wheel=replace(d.wheel, name="gear"), loading=None, functions=(), regions=()),
        "the member wheel is named 'gear'; name it 'wheel'",
    ),
    "start of strangers": (
        lambda d: replace(d, start=replace(d.start, outputs={**d.start.outputs, d.error: sp.Symbol("q")})),
        "start of transmission_error needs q",
    ),
    "design system of strangers": (lambda d: _with_system(d, X - sp.Symbol("q")), "system one needs q, which is"),
    "design system of too many equations": (lambda d: _with_system(d, X, X - 1), "one has 2 equations for 1 unknowns"),
    "wheel that does not turn": (
        lambda d: replace(d, wheel=replace(d.wheel, motion=d.pinion.motion)), "motion of the wheel.*does not turn"
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", CASES)
def test_a_contradiction_is_refused(drive, case):
    change, message = CASES[case]
    with pytest.raises(DescriptionError, match=message):
        validate(change(drive))


def test_an_event_has_its_role_without_saying_so():
    assert Margin("off_tip", "tip", X).role is Role.TIP
    assert Margin("off_tip", "crest", X).role is None


OUTLINES = {
    "key": (Suggestion("design.modul_mm", (m,)), "design.modul_mm: no drive has this key; use design.module_mm"),
    "word": (Suggestion("design.module_mm", (m,), words={"pinion_form": ("round",)}), "pinion_form = round.*use con"),
    "key of a word": (Suggestion("design.module_mm", (m,), words={"form": ("convex",)}), "form = convex.*pinion_form"),
    "name": (Suggestion("design.module_mm", (2 * sp.Symbol("n"),)), "uses n, which no option and none before it gives"),
}  # fmt: skip


@pytest.mark.parametrize("case", OUTLINES)
def test_an_outline_that_names_what_no_drive_of_the_family_has_is_refused(drive, case):
    added, message = OUTLINES[case]
    outline = drive.outline()
    changed = replace(drive, outline=lambda: replace(outline, suggestions=(*outline.suggestions, added)))
    others = [build() for name, build in drives.catalogue([POINT]).items() if name != POINT]
    with pytest.raises(DescriptionError, match=f"outline of the family spherical: .*{message}"):
        validate_outlines([changed, *others])


def test_an_outline_has_the_options_and_words_that_there_are(drive):
    outline = drive.outline()
    for change, message in (
        ({"options": {"n": "teeth"}}, "options n are none of m, z and a"),
        ({"words": {"pinion_from": "convex"}}, "pinion_from = 'convex' chooses no drive; use pinion_form or wheel"),
    ):
        with pytest.raises(DescriptionError, match=message):
            validate_outlines([replace(drive, outline=lambda change=change: replace(outline, **change))])


@pytest.mark.parametrize("family", ["spherical", "face_worm", "cylindrical_gears"])
def test_an_outline_names_keys_of_its_family(family):
    validate_outlines([build() for build in drives.catalogue([family]).values()])


@pytest.mark.parametrize("name", [POINT, "cylindrical_gears", "cylindrical_worm_zn_zn"])
def test_a_motion_that_is_not_what_the_flanks_transmit_is_refused(name):
    """Turned round, the other way up, or for one tooth more on the member that has more of them."""
    drive = _drive(name)
    plan = schedule(drive)
    (teeth,) = (p.symbol for p in drive.parameters if p.key == drive.pinion_teeth)
    count = sp.together(teeth / drive.definitions.resolve(drive.law))
    with mpmath.workdps(30):
        observed = observation(plan)
        validate_ratio(drive, observed, plan.sample)
        for wrong in (1 / drive.law, -drive.law, teeth / (count + 1), teeth / (count - 1)):
            with pytest.raises(DescriptionError, match=r"motion of the wheel turns it by .*the flanks transmit "):
                validate_ratio(_turning(drive, wrong), observed, plan.sample)


@pytest.mark.parametrize("name", [POINT, "cylindrical_gears", "face_worm", "bevel_formate"])
def test_a_drive_has_its_ratio_from_the_motion_of_the_wheel(name):
    drive = _drive(name)
    bare = replace(drive, sizes=drive.sizes[:0], ratio=None, wheel_angle=None)
    validate(bare)
    ((key, value, _),) = bare.all_sizes
    (teeth,) = (p.symbol for p in drive.parameters if p.key == drive.pinion_teeth)
    assert key == "ratio" and 1 / (value / teeth) in {p.symbol for p in drive.parameters if p.integer}
    assert sp.diff(bare.turned, drive.error) == 1


def _turned_round(body):
    return replace(body, surface=replace(body.surface, normal=v.scale(-1, body.surface.normal)))


def _checked(drive):
    plan = schedule(drive)
    with mpmath.workdps(30):
        validate_normals(drive, observation(plan), plan.sample)


#: Drives with point contact, line contact, and interference.
INWARD = (
    POINT, "spherical_spur_spur", "cylindrical_gears", "spherical_concave_concave", "cylindrical_worm_zn_zn",
    "cylindrical_worm_zc_zn", "face_worm",
)  # fmt: skip


@pytest.mark.parametrize("name", quick(INWARD, *INWARD[:3]))
def test_normals_that_point_inward_are_found(name):
    """One alone, or both, which no equation of contact sees: with point contact, line contact, and interference."""
    drive = _drive(name)
    _checked(drive)
    pinion, wheel = map(_turned_round, drive.bodies)
    for change in ({"pinion": pinion}, {"wheel": wheel}):
        with pytest.raises(DescriptionError, match="point the same way in contact; one points inward"):
            _checked(_meshing(drive, **change))
    with pytest.raises(DescriptionError, match="both normals point inward"):
        _checked(_meshing(drive, pinion=pinion, wheel=wheel))


def _meshing(drive, **bodies):
    changed = replace(drive, **bodies)
    order = (changed.wheel, changed.pinion) if changed.family == "face-worm" else changed.bodies
    return replace(changed, residual=contact(*(body.placed for body in order)))





def _joined(drive):
    """The joints of a drive's fillets, if they are as they have to be."""
    plan = schedule(drive)
    found = joints(plan)
    validate_regions(drive, found)
    return found


def _with_fillet(drive, **changes):
    """The drive with another fillet of its pinion."""
    (fillet,) = (r for r in drive.regions if r.member == "pinion")
    regions = [r if r is not fillet else replace(r, **{k: of(r) for k, of in changes.items()}) for r in drive.regions]
    return replace(drive, regions=tuple(regions))


@pytest.mark.parametrize("name", [SMALL, "cylindrical_worm_zn_zn"])
def test_a_fillet_goes_on_from_the_flank_on_either_side_of_the_tooth(name):
    drive = _drive(name)
    found = _joined(drive)
    flanks = {"left", "right"}
    assert {(j.member, j.flank) for j in found} == {(r.member, word) for r in drive.regions for word in flanks}
    assert all(j.normals > 0.99 and j.ways > 0.99 and min(j.regular) > 0.0 for j in found)


def test_a_fillet_that_is_regular_on_one_flank_alone_is_refused():
    drive = _drive(SMALL)
    one_sided = _with_fillet(drive, regular=lambda r: sp.Integer(1))
    with pytest.raises(DescriptionError, match="fillet of the pinion, with flank 'right'.*wrong sign of `regular`"):
        _joined(one_sided)


def test_a_fillet_whose_normal_points_into_the_tooth_is_refused():
    drive = _drive(SMALL)
    inward = _with_fillet(drive, surface=lambda r: r.surface.turned_over())
    with pytest.raises(DescriptionError, match="fillet of the pinion, with flank 'left'.*points into the body"):
        _joined(inward)


def test_a_fillet_is_checked_on_large_teeth_as_on_small_ones():
    drive = _drive("cylindrical_gears")
    large = replace(drive, sample={k: 400 * n if k.endswith("_mm") else n for k, n in drive.sample.items()})
    assert len(_joined(large)) == len(_joined(drive)) == 4
    inward = _with_fillet(large, surface=lambda r: r.surface.turned_over())
    with pytest.raises(DescriptionError, match="fillet of the pinion.*points into the body"):
        _joined(inward)


@pytest.mark.parametrize("limit", [sp.sqrt(-1 - X**2), sp.acos(2 + X**2), 1 / (sp.cos(X) ** 2 + sp.sin(X) ** 2 - 1)])
def test_a_limit_without_a_value_at_the_contact_is_not_looked_at(limit):
    """As in the compiled drive, which does not apply it."""
    drive = _with_margin(_drive(POINT), Margin("off_tip", "tip", limit))
    validate(drive)
    _checked(drive)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda d: _with_scale(d, sp.Integer(0)), "natural size of the unknown l_pinion is 0 at the sample.*above 0"),
        (lambda d: _with_scale(d, -MODULE), "natural size of the unknown l_pinion is -4 at"),
        (lambda d: _with_scale(d, sp.sqrt(-MODULE)), "natural size of the unknown l_pinion is no real number"),
        (lambda d: replace(d, guards=(Guard(3 - MODULE, "too large", ("module_mm",)),)),
         "sample design breaks the guard 'too large' of module_mm: what must be above 0 is -1; correct it"),
        (lambda d: replace(d, guards=(Guard(sp.sqrt(-MODULE), "no root", ("module_mm",)),)),
         "guard 'no root'.*is no real number"),
        (lambda d: _with_key(d, parameter("crown_mm", "c", "crown", domain=(0, 1)),
                             rules=(*d.rules, Rule(Quantity("c", "mm"), MODULE))),
         "key 'crown_mm' of the sample design follows as 4, outside its domain"),
    ],
)  # fmt: skip
def test_a_sample_that_is_no_design_of_its_drive_is_refused(drive, change, message):
    changed = change(drive)
    validate(changed)
    with pytest.raises(DescriptionError, match=f"{POINT}: .*{message}"):
        sample_contact(derive(changed))


@pytest.mark.parametrize("limit", [sp.sqrt(-1 - X**2), sp.acos(2 + X**2) + MODULE])
def test_a_limit_without_a_value_anywhere_is_refused(drive, limit):
    _limited(drive)
    with pytest.raises(DescriptionError, match="'tip' of the pinion is no real number, neither .* nor anywhere around"):
        _limited(_with_margin(drive, Margin("off_tip", "tip", limit)))


def test_a_limit_that_has_a_value_elsewhere_or_none_for_an_open_key_is_not_refused(drive):
    _limited(_with_margin(drive, Margin("off_tip", "tip", sp.sqrt(1 - X**2) - sp.Rational(1, 2))))
    reach = parameter("reach_mm", "reach", "where it ends")
    _limited(_with_margin(_with_key(drive, reach), Margin("off_tip", "tip", sp.sqrt(-1 - X**2) + reach.symbol)))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda d: d, ""),
        (lambda d: replace(d, sample_angle=1), "at the sample angle 1 the contact is not on the .*'s tooth: its"),
        (lambda d: _with_margin(d, Margin("off_tip", "tip", -1 - X**2)), "on the pinion's tooth: its limit 'tip' is -"),
        (lambda d: replace(d, wheel=replace(d.wheel, regular=sp.S.One)),
         "not on the wheel's tooth: its singular function is -.* there, which must not be below 0; choose another"),
    ],
)  # fmt: skip
def test_a_sample_whose_contact_is_off_its_teeth_is_refused(drive, change, message):
    plan = schedule(change(drive))
    with mpmath.workdps(30), pytest.raises(DescriptionError, match=message) if message else nullcontext():
        validate_place(plan.drive, observation(plan))


def test_a_limit_beyond_which_nothing_lies_is_refused(drive):
    for limit in (1 + X**2, sp.Abs(X) + MODULE, sp.sqrt(1 - X**2)):
        with pytest.raises(DescriptionError, match="'tip' of the pinion is below 0 neither .* would ever lie"):
            _limited(_with_margin(drive, Margin("off_tip", "tip", limit)))


def test_a_fillet_that_does_not_meet_its_flank_is_refused():
    away = _with_fillet(_drive(SMALL), surface=lambda r: r.surface.placed(translation(x=MODULE)))
    with pytest.raises(DescriptionError, match="fillet of the pinion does not meet the flank that it joins"):
        _joined(away)


@pytest.mark.parametrize(
    ("share", "said"), [(0.1, {"jam by 0.1", ""}), (0.4, {"jam by 0.4", "turn idle through 0.4"})]
)
def test_both_flanks_of_a_sample_are_those_of_one_tooth(drive, share, said):
    """A wheel that each flank turns by half this share of a pitch, towards the other one or away from it."""
    (which,) = (p.symbol for p in drive.parameters if p.table is Table.FLANK)
    (teeth,) = (p.symbol for p in drive.parameters if p.key == drive.pinion_teeth)
    turn = sp.Rational(share).limit_denominator(10) * which * sp.pi / teeth * drive.law

    def answer(turn):
        wheel = replace(drive.wheel, motion=drive.wheel.motion @ Rz(turn))
        plan = schedule(_meshing(drive, wheel=wheel))
        try:
            validate_play(plan.drive, [(observation(q), q.sample) for q in (plan, on_other_flank(plan))])
        except DescriptionError as error:
            return str(error).partition("the teeth ")[2].partition(" of a pitch")[0]
        return ""

    assert answer(sp.S.Zero) == ""
    assert {answer(turn), answer(-turn)} == said


UNLIKE = {
    "limit": (
        lambda d: _with_margin(d, Margin("off_tip", "tip", MODULE + 5 - X / 9)), "margin_pinion_tip of the contact"
    ),
    "guard": (lambda d: replace(d, guards=(Guard(MODULE - 1, "small", ("module_mm",)),)), "guard 'small'"),
    "rule": (
        lambda d: _with_key(
            d, parameter("crown_mm", "c", "crown"), rules=(*d.rules, Rule(Quantity("c", "mm"), MODULE**2))
        ),
        "key 'crown_mm' follows as 64, not 32 mm",
    ),
    "function": (lambda d: _with_function(d, "extra", MODULE + 1), "one of the function extra"),
}  # fmt: skip


@pytest.mark.parametrize("case", UNLIKE)
def test_a_drive_that_is_another_one_in_another_size_is_refused(drive, case):
    change, message = UNLIKE[case]
    with pytest.raises(DescriptionError, match=f"{message}.* where all lengths are doubled"):
        similar(schedule(change(drive)))


@pytest.mark.parametrize("name", [POINT, "cylindrical_worm_zk_zn", "bevel_face_hobbed", "face_worm"])
def test_a_drive_is_the_same_in_every_size(name):
    similar(schedule(_drive(name)))


def _limited(drive):
    plan = schedule(drive)
    with mpmath.workdps(30):
        validate_limits(drive, observation(plan), plan.sample)


def test_surfaces_that_cannot_touch_are_no_sample():
    plan = schedule(_drive(SMALL))
    observed = dict(observation(plan))
    observed["normal_wheel_f"] = [n + mpmath.mpf(1) / 1000 for n in observed["normal_wheel_f"]]
    with pytest.raises(DescriptionError, match="are not opposite where the sample's surfaces should touch"):
        validate_normals(plan.drive, observed, plan.sample)
