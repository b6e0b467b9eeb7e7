"""A value has a name of its own, which tells what it is and not where it stands."""

import re

import pytest
import sympy as sp

from derive.language.definitions import Definitions
from derive.program.lowering import Lowering
from derive.program.names import Names
from derive.program.tape import Stage, Tape
from tests.derive.small import INPUTS, lowered, p, x, y


def names_of(*expressions, before=()):
    """Names of the values of expressions on a tape that has others from ``before``."""
    tape, lower, _ = lowered(*before)
    return [Names(tape, lower.names()).of(lower(e)) for e in expressions]


def with_section(value, *expressions):
    """Names of expressions of a definition ``section`` of this value, and of the definition."""
    definitions = Definitions()
    section = definitions.let("section", value(x, p))
    lower = Lowering(Tape(), INPUTS, definitions)
    nodes = [lower(section), *(lower(e(section)) for e in expressions)]
    slopes = [lower.tape.derivative(i, lower(y)) for i in nodes[1:]]
    names = Names(lower.tape, lower.names())
    return [names.of(i) for i in (*nodes, *slopes)]


def test_a_name_does_not_depend_on_what_else_is_computed():
    expressions = (x * y + p, sp.sqrt(x + y), sp.cos(x * y), p * sp.sin(y))
    assert names_of(*expressions) == names_of(*expressions, before=(y - x, sp.sqrt(p) * y, x + p, sp.sin(y)))


def test_other_values_have_other_names():
    found = names_of(x + y, x - y, x * y, x / y, x + p, sp.sqrt(x), sp.sin(x), sp.cos(x), 2 * x, 3 * x)
    assert len(set(found)) == len(found)


@pytest.mark.parametrize("value", [lambda x, p: 3 * x + p, lambda x, p: x * p - sp.sqrt(x), lambda x, p: p / x])
def test_what_a_definition_holds_changes_no_name_of_what_depends_on_it(value):
    expressions = (lambda e: e * y + p, lambda e: sp.cos(e * y) * y, lambda e: (e + y) ** 2)
    plain = with_section(lambda x, p: x * p, *expressions)
    assert plain[0] == "section" and with_section(value, *expressions) == plain


def test_sine_and_cosine_are_named_after_their_angle_and_inputs_after_themselves():
    angle, *turned = names_of(x * y, sp.sin(x * y), sp.cos(x * y))
    assert turned == [f"sin_{angle}", f"cos_{angle}"]
    assert names_of(x, sp.sin(x)) == ["x", "sin_x"]


def test_names_are_short_and_none_is_a_word_of_c():
    lower = Lowering(Tape(), INPUTS)
    values = [lower((x + k) * (y - k) / (p + k**2)) for k in range(300)]
    names = Names(lower.tape, lower.names()).apart()
    found = [names(i) for i in range(len(lower.tape.nodes)) if lower.tape.nodes[i].args]
    assert len(set(found)) == len(found) >= len(values)
    assert all(re.fullmatch(r"[b-df-hj-np-tv-z][0-9b-df-hj-np-tv-z]{4,6}", name) for name in found)


def test_two_values_that_would_have_one_name_get_longer_ones(monkeypatch):
    monkeypatch.setattr("derive.program.names.SHORT", 1)
    tape, lower, _ = lowered()
    nodes = [lower(x + k * y) for k in range(2, 60)]
    apart = Names(tape, {}).apart()
    assert len({apart(i) for i in nodes}) == len(nodes) and [apart(i) for i in nodes] == [apart(i) for i in nodes]


def test_a_long_name_of_a_definition_is_left_to_its_comment():
    tape = Tape()
    i = tape.add(tape.input(x, Stage.ITERATE), tape.input(y, Stage.ITERATE))
    assert Names(tape, {i: "short"}).of(i) == "short"
    assert len(Names(tape, {i: "a_name_of_a_definition_that_fills_the_line"}).of(i)) == 5


def test_of_two_values_with_the_name_of_one_definition_the_first_has_it():
    tape, lower, (first, second) = lowered(x + y, x - y)
    above = [tape.mul(i, lower(p)) for i in (first, second)]
    names = Names(tape, {first: "same", second: "same"})
    assert names.of(first) == "same" != names.of(second)
    assert len({names.apart()(i) for i in above}) == len({*map(names.of, above)}) == 2
