"""The derived side of a statement is the drive's own description: an edit of the description makes it false.

And a statement says something: no derivative along what is not there, no two sides that are one text.
"""

import copy
import importlib
import sys

import pytest

from derive.audit import described, record
from derive.audit.claims import as_list
from derive.audit.documents import face_worm, rack_and_pinion, recess_action, spherical, zk_zn
from derive.audit.identities import bevel, cylindrical_gears, cylindrical_worm, helicoids
from derive.audit.identities import face_worm as face_worms
from derive.audit.identities import spherical as spherical_gears
from derive.audit.ledger import Ledger, judged
from derive.prove import Outcome, decide
from derive.prove.tree import symbols, walk
from tests.quick import quick

ZN, ZK = "cylindrical_worm_zn_zn", "cylindrical_worm_zk_zn"
CYLINDRICAL, SPHERICAL, BEVEL, FACE = "cylindrical_gears", "spherical_convex_concave", "bevel_generated", "face_worm"


def steps(data, member):
    return next(body for body in data["bodies"] if body["name"] == member)["surface"]["made"]


def made(data, member, word):
    return next(step for step in steps(data, member) if step["step"] == word)


def negated_angle(motion, place):
    motion[place][2] = ["*", -1, motion[place][2]]


def inward(data, number):
    surface = data["bodies"][number]["surface"]
    surface["normal"] = [["*", -1, part] for part in surface["normal"]]


def region(data, name):
    return next(entry for entry in data["regions"] if entry["region"] == name)


def rule(data, target, value):
    data["rules"] = [[name, value if name == target else own] for name, own in data["rules"]]


def definition(data, name, value):
    next(entry for entry in data["definitions"] if entry["name"] == name)["value"] = value


#: What is edited, in which drive, and the entries that then no longer hold.
EDITS = {
    "A_gen = A - r_h + r_1": (
        ZN, lambda d: rule(d, "A_gen", ["+", "A", ["*", -1, "r_hob"], "r_worm"]), recess_action, ["eq-37"],
    ),
    "Sigma_gen = Sigma - lambda + lambda_h": (
        ZN,
        lambda d: rule(d, "Sigma_gen", ["+", "Sigma", "lambda_hob", ["*", -1, "lambda_worm"]]),
        recess_action,
        ["eq-38", "eq-37"],
    ),
    "lambda_h = asin(m_n cos lambda/(2 r_h)), as printed": (
        ZN,
        lambda d: rule(
            d, "lambda_hob", ["asin", ["*", ["/", 1, 2], "m_n", ["cos", "lambda_worm"], ["^", "r_hob", -1]]]
        ),
        recess_action,
        ["eq-36"],
    ),
    "blade of the worm turned by -lambda": (
        ZN, lambda d: definition(d, "P_worm_y", ["*", "s", "t_worm", ["sin", "alpha"], ["sin", "lambda_worm"]]),
        recess_action, ["worm-normal"],
    ),
    "wheel turned the other way in mesh": (
        ZN, lambda d: negated_angle(d["bodies"][1]["motion"], -1), rack_and_pinion,
        ["frames", "pitch-radius-wheel", "eq-1", "axis-2", "existence", "uniqueness"],
    ),
    "helix of the other hand": (
        ZN, lambda d: negated_angle(steps(d, "pinion")[0]["motion"], 1), rack_and_pinion, ["worm-surface", "helicoid"],
    ),
    "disc at another distance": (
        ZK, lambda d: steps(d, "pinion")[0]["motion"][1].__setitem__(3, ["r_c_worm", 0, 0]), zk_zn, ["count"],
    ),
    "wheel mounted at the shaft angle's other sign": (
        ZK, lambda d: negated_angle(d["bodies"][1]["motion"], 1), zk_zn, ["assembly-angle"],
    ),
    "blade turned by -lambda": (
        ZN, lambda d: definition(d, "P_hob_y", ["*", "s", "t_hob", ["sin", "alpha_hob"], ["sin", "lambda_hob"]]),
        recess_action, ["eq-1", "eq-5"],
    ),
    "groove + for -": (
        ZN,
        lambda d: definition(d, "r_t_hob", ["+", ["sqrt", ["^", "r_hob", 2]], ["*", ["tan", "alpha_hob"], "dx"]]),
        recess_action,
        ["eq-2"],
    ),
    "wheel turned the other way in cutting": (
        ZN, lambda d: negated_angle(made(d, "wheel", "envelope")["motion"], 0), recess_action, ["eq-8", "eq-9"],
    ),
    "wheel turned by +phi2 in mesh": (
        ZN, lambda d: negated_angle(d["bodies"][1]["motion"], -1), recess_action, ["eq-23", "eq-25"],
    ),
    "shaft angle the other way": (
        ZN, lambda d: negated_angle(made(d, "wheel", "envelope")["motion"], 2), cylindrical_worm, ["meshing"],
    ),
    "disc set at -lambda": (
        ZK, lambda d: negated_angle(steps(d, "pinion")[0]["motion"], 0), zk_zn, ["eq-1", "eq-2"],
    ),
    "rolling the other way": (
        "spherical_convex_concave",
        lambda d: negated_angle(made(d, "pinion", "envelope")["motion"], 0),
        spherical,
        ["eq-2.11", "eq-2.13"],
    ),
    "plunge of the other sign": (
        "face_worm",
        lambda d: made(d, "pinion", "envelope")["motion"][2].__setitem__(
            1, [0, ["*", ["^", "psi_worm", 2], "a_pl"], 0]
        ),
        face_worm,
        ["eq-8", "eq-10"],
    ),
    "normal turned inward": (
        "cylindrical_worm_za_za",
        lambda d: d["bodies"][0]["surface"].__setitem__("normal", [1, *d["bodies"][0]["surface"]["normal"][1:]]),
        helicoids,
        ["za-normal"],
    ),
    "rack of another helix": (
        CYLINDRICAL,
        lambda d: steps(d, "pinion")[0]["motion"].__setitem__(0, ["translation", [0, "z_pinion", "z_pinion"]]),
        cylindrical_gears,
        ["outward", "explicit", "tangent", "involute", "normal", "moment", "screw", "plunge", "mirror"],
    ),
    "rack that rolls on another circle": (
        CYLINDRICAL, lambda d: made(d, "pinion", "envelope")["motion"][1][1].__setitem__(0, "m"), cylindrical_gears,
        ["meshing", "tangent", "involute", "moment", "screw"],
    ),
    "turn of a gear by the solution of the other sign": (
        CYLINDRICAL,
        lambda d: made(d, "pinion", "solved").__setitem__("value", ["*", -1, made(d, "pinion", "solved")["value"]]),
        cylindrical_gears,
        ["explicit", "involute", "moment", "screw"],
    ),
    "rack's normal into the material": (
        CYLINDRICAL, lambda d: inward(d, 0), cylindrical_gears, ["outward", "normal", "common-normal"],
    ),
    "wheel at the shaft angle's other sign": (
        CYLINDRICAL, lambda d: negated_angle(d["bodies"][1]["motion"], 1), cylindrical_gears, ["common-normal"],
    ),
    "arc that curves the other way": (
        SPHERICAL, lambda d: negated_angle(steps(d, "pinion")[0]["motion"], 0), spherical_gears, ["normal"],
    ),
    "arc about another centre": (
        SPHERICAL, lambda d: steps(d, "wheel")[0]["motion"][0].__setitem__(3, [0, 0, "R_wheel"]), spherical_gears,
        ["half-angle", "normal", "explicit", "moment"],
    ),
    "gear rolled the other way": (
        SPHERICAL, lambda d: negated_angle(made(d, "wheel", "envelope")["motion"], 0), spherical_gears,
        ["meshing", "tangent"],
    ),
    "edge inclined the other way": (
        SPHERICAL, lambda d: steps(d, "pinion")[0]["curve"].__setitem__(1, ["*", "s", "l_pinion", ["sin", "alpha"]]),
        spherical_gears, ["normal", "explicit", "tangent", "moment"],
    ),
    "blank offset to the other side": (
        BEVEL, lambda d: made(d, "pinion", "envelope")["motion"][3][1].__setitem__(1, ["*", -1, "E_m_pinion"]), bevel,
        ["hand", "formate-cradle"],
    ),
    "cradle turned the other way": (
        BEVEL, lambda d: negated_angle(made(d, "pinion", "envelope")["motion"], 4), bevel,
        ["meshing", "hand", "crown", "formate-cradle"],
    ),
    "helical motion of the other sign": (
        BEVEL,
        lambda d: made(d, "wheel", "envelope")["motion"][3][1].__setitem__(
            2, ["+", ["*", -1, "X_B_gear"], ["*", "H_gear", "phi_cradle_gear"]]
        ),
        bevel,
        ["meshing", "hand"],
    ),
    "swivel as tilt": (
        BEVEL, lambda d: made(d, "wheel", "envelope")["motion"][6].__setitem__(1, "y"), bevel,
        ["hand", "rotation-of-blade"],
    ),
    "blade's normal along the blade": (
        BEVEL, lambda d: d["bodies"][0]["surface"]["normal"].reverse(), bevel,
        ["swung-edge", "pole", "linear", "cone-normal", "stand-off"],
    ),
    "pinion mounted the other way": (
        BEVEL, lambda d: negated_angle(d["bodies"][0]["motion"], 1), bevel, ["formate-cradle", "assembly-axis"],
    ),
    "rounding about a centre above the tip plane": (
        BEVEL, lambda d: region(d, "fillet")["surface"]["made"][0]["curve"].__setitem__(2, "rho_f_pinion"), bevel,
        ["fillet-join"],
    ),
    "parabola of the other sign": (
        FACE, lambda d: steps(d, "pinion")[0]["curve"].__setitem__(0, ["*", "u_worm", ["sin", "alpha_g"]]), face_worms,
        ["blade-normal"],
    ),
    "blade inclined the other way": (
        FACE, lambda d: steps(d, "wheel")[0]["curve"].__setitem__(0, ["*", -1, "u_gear", ["sin", "alpha_g"]]),
        face_worms, ["cone-normal", "fillet-join"],
    ),
    "rounding of the other half": (
        FACE, lambda d: region(d, "fillet")["surface"]["made"][0]["curve"].__setitem__(2, ["*", -1, "h_d"]), face_worms,
        ["fillet-join", "fillet-tangent"],
    ),
}  # fmt: skip


def statements_held_true(claim):
    """What the ledger says in the place of the print where the print is false, else each reading of it."""
    if instead := claim.corrected or claim.contradiction:
        return [("instead", as_list(instead))]
    return claim.read().items()


def read_again(module, patch):
    """A chapter and all modules of its own, imported anew until ``patch`` is undone."""
    name, (parent, _, leaf) = module.__name__, module.__name__.rpartition(".")
    patch.setattr(sys.modules[parent], leaf, module)
    for own in [other for other in sys.modules if other == name or other.startswith(f"{name}.")]:
        patch.delitem(sys.modules, own)
    return importlib.import_module(name)


#: One of each chapter, which is tried at once.
FIRST = {module: edit for edit, (_, _, module, _) in EDITS.items()}.values()


@pytest.mark.parametrize("edit", quick(EDITS, *FIRST))
def test_an_edit_of_the_description_makes_statements_false(edit, monkeypatch):
    drive, change, module, keys = EDITS[edit]
    honest = described._description

    def edited(name):
        data = honest(name)
        if name == drive:
            data = copy.deepcopy(data)
            change(data)
        return data

    with monkeypatch.context() as patch:
        patch.setattr(described, "_description", edited)
        claims = {claim.key: claim for claim in read_again(module, patch).CHAPTER.claims}
        for key in keys:
            for label, texts in statements_held_true(claims[key]):
                found = {decide(claims[key].scope.statement(label, text)).outcome for text in texts}
                assert Outcome.REFUTED in found, (key, label)


UNREADABLE = {
    "outside the grammar": lambda d: definition(d, "P_worm_y", ["abs", "t_worm"]),
    "an angle that is a square": lambda d: d["bodies"][1]["motion"][-1].__setitem__(2, ["^", "phi_wheel", 2]),
    "a factor less": lambda d: d["bodies"][1]["motion"].pop(0),
    "no envelope": lambda d: [steps(d, member).__setitem__(slice(1, None), []) for member in ("pinion", "wheel")],
    "a division by zero": lambda d: d["definitions"][0].__setitem__("value", ["^", 0, -1]),
}


@pytest.mark.parametrize("edit", UNREADABLE)
def test_what_an_edit_makes_unreadable_is_said_and_nothing_else(edit, monkeypatch):
    data = copy.deepcopy(described._description(ZN))
    UNREADABLE[edit](data)
    with monkeypatch.context() as patch:
        patch.setitem(described.AT_HAND, ZN, data)
        chapter = read_again(recess_action, patch).CHAPTER
        verdicts = [judged(Ledger(), chapter.document, claim) for claim in chapter.claims]
    statuses = [verdict.status for verdict in verdicts]
    assert "undecided" in statuses or edit == "a factor less"
    assert statuses.count("proved") > statuses.count("undecided")
    assert not any(verdict.unreadable for verdict in verdicts if verdict.status != "undecided")


def statements():
    for chapter in record.chapters():
        for claim in chapter.claims:
            texts = [text for part in getattr(claim, "read", dict)().values() for text in part]
            texts += [text for text in as_list(getattr(claim, "contradiction", ())) if claim.scope]
            for text in filter(None, texts):
                yield f"{chapter.document.key}/{claim.key}", text, claim.scope.statement("", text)


def names_within(tree, statement):
    """Every symbol that a tree depends on, through definitions and unspecified functions."""
    found, pending = set(), [tree]
    while pending:
        part = pending.pop()
        for node in walk(part):
            if isinstance(node, tuple) and node[0] == "jet":
                found |= set(statement.jets[node[1]])
        for name in symbols(part) - found:
            found.add(name)
            if name in statement.definitions:
                pending.append(statement.definitions[name])
    return found


#: That this derivative is 0 is the statement: the cone's normal does not change along its blade.
CONSTANT = {"bevel/cone-normal"}


def test_derivatives_are_along_what_is_there():
    vacuous = [
        (name, text)
        for name, text, statement in statements()
        if name not in CONSTANT
        for tree in statement.trees()
        for node in walk(tree)
        if isinstance(node, tuple) and node[0] == "d"
        if not {symbol for symbol, _ in node[2:]} <= names_within(node[1], statement)
    ]
    assert not vacuous


#: Print and description, or two parts of the description, say it in the same words.
IN_THE_SAME_WORDS = {
    "recess-action/eq-3", "recess-action/eq-37", "recess-action/worm-normal", "zk-zn/eq-6",
    "bevel/fillet-join", "bevel/tangent-cones", "face_worm/fillet-join",
}  # fmt: skip


def test_no_two_sides_are_one_text():
    def inlined(tree, definitions):
        if isinstance(tree, tuple):
            return (tree[0], *(inlined(part, definitions) for part in tree[1:]))
        return inlined(definitions[tree], definitions) if tree in definitions else tree

    same = {
        name
        for name, _, statement in statements()
        if inlined(statement.lhs, statement.definitions) == inlined(statement.rhs, statement.definitions)
    }
    assert same <= IN_THE_SAME_WORDS
