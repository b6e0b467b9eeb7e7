"""The header of bounded flanks has a system for every pair of what may meet, and C that a compiler accepts as text."""

from derive.emit import bounded
from derive.passes import arrange, guards
from tests.derive.small import plan


def header(made):
    return bounded.header(made, arrange.arrange(made, guards.bounded(made)), "test")


def test_every_system_of_edge_contact_is_printed():
    made = plan()
    text = header(made)
    assert made.edges.systems
    for expansion in made.expansions:
        assert f"{expansion.of.region}_{expansion.of.body}" in text
    assert text.count("{") == text.count("}")


def test_long_functions_are_compiled_as_they_stand(monkeypatch):
    made = plan()
    plain = header(made)
    monkeypatch.setattr(arrange, "LONG", 1)
    text = header(made)
    assert '"O0"' not in plain and text.count('"O0"') > len(made.expansions)
    assert text.count("push_options") == text.count("pop_options")
