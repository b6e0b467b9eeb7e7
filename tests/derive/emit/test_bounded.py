"""The header of bounded flanks has a system for every pair of what may meet, and C that a compiler accepts as text."""

from derive.emit import bounded
from tests.derive.small import plan


def test_every_system_of_edge_contact_is_printed():
    made = plan()
    text = bounded.header(made, "test")
    assert made.edges.systems
    for expansion in made.expansions:
        assert f"{expansion.of.region}_{expansion.of.body}" in text
    assert text.count("{") == text.count("}")
