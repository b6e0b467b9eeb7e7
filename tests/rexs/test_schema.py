"""Files that are written, and the tables by which they are read, against the public schema of REXS 2.0.0."""

import json
import re
from datetime import UTC, datetime
from pathlib import Path
from xml.etree import ElementTree

import pytest

from meshwright.rexs.places import exchanges
from tests.rexs.designs import PAIRS, file_text, named

SCHEMA = json.loads((Path(__file__).parents[2] / "derive/exchange/rexs_ids.json").read_text(encoding="utf-8"))
TAG = "{https://www.rexs.info}"


def in_range(entry, number):
    lower, upper = entry.get("rangeMin"), entry.get("rangeMax")
    above = lower is None or number > lower or (number == lower and not entry["rangeMinOpen"])
    below = upper is None or number < upper or (number == upper and not entry["rangeMaxOpen"])
    return above and below


@pytest.mark.parametrize("tables", PAIRS, ids=named)
def test_a_written_file_is_valid(tables):
    assert_valid(file_text(tables))


def assert_valid(text):
    """Components, attributes, units, types, ranges and relations of a file are those of the schema."""
    root = ElementTree.fromstring(text)
    assert root.tag == f"{TAG}model" and {"version", "applicationId", "applicationVersion"} <= set(root.keys())
    assert datetime.fromisoformat(root.get("date")).tzinfo is UTC
    kinds = {}
    for component in root.find(f"{TAG}components"):
        assert component.get("id") not in kinds
        kinds[component.get("id")] = kind = component.get("type")
        for attribute in component:
            entry = SCHEMA["components"][kind][attribute.get("id")]
            assert attribute.get("unit") == entry["unit"]
            texts = [c.text for c in attribute.iter(f"{TAG}c")] or [attribute.text]
            match entry["type"]:
                case "enum":
                    assert texts[0] in entry["enum"]
                case "integer":
                    assert re.fullmatch(r"\d+", texts[0]) and in_range(entry, int(texts[0]))
                case "floating_point":
                    assert in_range(entry, float(texts[0]))
                case "integer_array":
                    assert all(re.fullmatch(r"\d+", text) for text in texts)
                case other:
                    assert other in ("floating_point_array", "floating_point_matrix")
                    assert all(in_range(entry, float(text)) for text in texts)
    relations = root.find(f"{TAG}relations")
    assert len({r.get("id") for r in relations}) == len(relations)
    for relation in relations:
        described = SCHEMA["relations"][relation.get("type")]
        assert [[ref.get("role"), kinds[ref.get("id")]] for ref in relation] in described["allowed"]
        assert (relation.get("order") is not None) == described["orderRequired"]
    held = {ref.get("id") for relation in relations for ref in relation}
    assert held == set(kinds), "every component stands in a relation"


def test_the_tables_say_what_the_schema_says():
    for table in exchanges().values():
        kinds = {c["name"]: c["type"] for c in table["components"]}
        for spec in (*table["attributes"], *table["words"]):
            entry = SCHEMA["components"][kinds[spec["component"]]][spec["attribute"]]
            for ours, theirs in (("unit", "unit"), ("type", "type"), ("lower", "rangeMin"), ("upper", "rangeMax")):
                assert spec.get(ours) == entry.get(theirs)
