"""The header of bounded flanks has a system for every pair of what may meet, and C that a compiler accepts as text."""

from derive.emit import bounded, c99
from tests.derive.small import plan


def test_every_system_of_edge_contact_is_printed():
    made = plan()
    text = bounded.header(made, "test")
    assert made.edges.systems
    for expansion in made.expansions:
        assert f"{expansion.of.region}_{expansion.of.body}" in text
    assert text.count("{") == text.count("}")


def test_long_functions_are_compiled_as_they_stand(monkeypatch):
    made = plan()
    plain = bounded.header(made, "test")
    monkeypatch.setattr(c99, "LONG", 1)
    text = bounded.header(made, "test")
    assert '"O0"' not in plain and text.count('"O0"') > len(made.expansions)
    assert text.count("push_options") == text.count("pop_options")
