"""Claims are read from paragraphs: what is printed, what it says, equations, numbers, conditions."""

import pytest

from derive.audit.claims import Claim, FigureClaim, scope
from derive.audit.paragraphs import claims, identities

SCOPES = {"FLAT": scope("flat", "y = 2*x"), "STEEP": scope("steep", "y = 3*x")}
TEXT = r"""
first | Eq (1) | FLAT
> y is two x,\n or so
It says
what it says.
    y = 2*x
    y - 2*x
        = 0
where: x ≠ 0
damage: a smudge

second | Table 1
> 3.14
Half a turn.
    pi -> 3.14 rad
corrected:
    2*pi -> 6.28 rad

third | §2 | STEEP
Two readings.
reading the one:
    y = 2*x
reading the other:
    y = 3*x
corrected:
    y = 3*x + 0
confusable: x y
"""


def test_a_paragraph_is_a_claim():
    first, second, third = claims(TEXT, SCOPES)
    assert isinstance(first, Claim) and isinstance(second, FigureClaim) and isinstance(third, Claim)
    assert (first.key, first.where, first.scope) == ("first", "Eq (1)", SCOPES["FLAT"])
    assert (first.verbatim, first.plain) == ("y is two x,\nor so", "It says what it says.")
    assert first.read() == {"as printed": ["y = 2*x", "y - 2*x = 0"]}
    assert (first.conditions, first.damage) == (["x ≠ 0"], "a smudge")
    assert [(f.formula, f.printed, f.unit) for f in second.figures] == [("pi", "3.14", "rad")]
    assert [f.printed for f in second.corrected] == ["6.28"] and not second.final
    assert third.read() == {"the one": ["y = 2*x"], "the other": ["y = 3*x"]}
    assert (third.corrected, third.confusable) == (["y = 3*x + 0"], [["x", "y"]])


def test_names_in_braces_are_written_out():
    (claim,) = identities("one | here | FLAT\nOf each.\n    {q} = {q}", SCOPES, lambda e: [e.format(q=q) for q in "uv"])
    assert claim.kind == "identity" and claim.read() == {"derived": ["u = u", "v = v"]}


def test_a_line_that_is_nothing_is_refused():
    with pytest.raises(ValueError, match="one: 'mising: a page' is neither an equation nor"):
        claims("one | here\nIt says.\nwhere: x ≠ 0\nmising: a page", SCOPES)
