"""The pages of the record lead from a drive's chain to its C functions and statements, and back."""

import json
import re
from collections import Counter
from functools import cache
from pathlib import Path

import pytest

from derive.audit import drive_pages
from derive.audit.render import MathML
from derive.prove.tree import parse

GENERATED = Path(__file__).resolve().parents[2] / "generated"
DRIVES = sorted(path.stem for path in (GENERATED / "descriptions").glob("*.json"))


@cache
def text(name):
    return (GENERATED / "audit" / name).read_text(encoding="utf-8")


@cache
def anchors(name):
    return re.findall(r'\bid="([^"]+)"', text(name))


@pytest.mark.parametrize("drive", DRIVES)
def test_a_drives_page_leads_to_statements_and_functions_that_are_there(drive):
    page = text(drive_pages.file_name(drive))
    assert 'class="chain"' in page and "generating motion" in page
    for target, key in set(re.findall(r'href="([\w-]+\.html)#([^"]+)"', page)):
        assert key in anchors(target), f"{target}#{key}"
    for key in set(re.findall(r'href="#([^"]+)"', page)):
        assert key in anchors(drive_pages.file_name(drive)), key
    header = (GENERATED / "c" / f"{drive}.h").read_text(encoding="utf-8").splitlines()
    functions = re.findall(r'<tr id="fn-(\w+)"><td><code>\w+</code></td><td class="number">(\d+)</td>', page)
    assert {"eval", "step", "setup"} <= {name for name, _ in functions}
    for name, line in functions:
        assert f" {drive}_{name}(" in header[int(line) - 1]


def test_statements_lead_back_to_the_functions_that_rest_on_them():
    assert "drive-cylindrical_worm_zn_zn.html#fn-" in text("helicoids.html")
    for drive, name in set(re.findall(r'href="drive-(\w+)\.html#(fn-\w+)"', text("helicoids.html"))):
        assert name in anchors(drive_pages.file_name(drive))


@pytest.mark.parametrize("name", ["recess-action.html", "rack-and-pinion.html", "derivation.html"])
def test_definitions_stand_once_on_a_page_and_hashes_in_full(name):
    found = [key for key in anchors(name) if key.startswith("def-")]
    assert found and len(found) == len(set(found))
    assert set(re.findall(r'href="#(def-[^"]+)"', text(name))) == set(found)
    assert re.search(r'href="certificates\.jsonl">[0-9a-f]{64}<', text(name))


def test_generated_c_names_what_it_computes():
    header = (GENERATED / "c" / "cylindrical_worm_zn_zn.h").read_text(encoding="utf-8")
    named = {"psi_hob": "screw angle of the hob flank", r"\w+": "slope of the equation of meshing"}
    for name, words in named.items():
        assert re.search(rf"const double t_{name} = .*;  /\* .*{words}.* \*/", header), words


def test_a_long_formula_breaks_between_its_terms():
    sum_of_products = parse("m*(a*cos(x) + b*sin(x) - c*cos(y)*sin(x) + d*sin(y)) + e*cos(x)*cos(y)")
    pieces = MathML().pieces(sum_of_products)
    assert len(pieces) == 5
    assert pieces[-1].startswith('<mo form="infix">+</mo>') and pieces[2].startswith('<mo form="infix">−</mo>')
    whole = "".join(re.findall(r">([^<>]+)<", "".join(pieces)))
    assert whole == "m(acosx+bsinx−ccosysinx+dsiny)+ecosxcosy"
    assert MathML().pieces(parse("a + b")) == [MathML().write(parse("a + b"))]


def test_a_page_says_where_its_definitions_were_read_and_in_which_letters():
    page = text("recess-action.html")
    told = re.findall(r'read from <a href="drive-(\w+)\.html">(\w+)</a>: ([^<]+)</span>', page)
    assert ("cylindrical_worm_zn_zn",) * 2 + ("operand 1 of the arc function in rule 1 for lambda_hob",) in told
    letters = page[page.index("Letters of the drives") :]
    assert {drive for drive, _, _ in told} == set(re.findall(r'href="drive-(\w+)\.html"', letters))
    assert "Sigma_gen → pi - gamma1" in letters


@pytest.mark.parametrize(
    ("entry", "said"),
    [("helicoid", "Reads the description of <a"), ("inverse-rotation", "Of mathematics in general: it reads no")],
)
def test_a_statement_says_which_descriptions_it_reads_or_that_it_reads_none(entry, said):
    page = text("rack-and-pinion.html")
    assert said in page[page.index(f'id="{entry}"') :].partition("</section>")[0]


def test_the_overview_counts_what_each_check_holds():
    """Identities are put to Coq; each other certificate is recomputed; none is counted twice or left out."""
    record = [json.loads(line) for line in text("certificates.jsonl").splitlines()]
    kinds = Counter(item["kind"] for item in record if item["object"] == "certificate")
    page = text("index.html")
    held = dict(re.findall(r"<tr><th>([^<]+)</th><td class=\"number\">(\d+)</td><td>", page))
    assert list(held) == ["proved by the kernel", "checked modulo primes", "tested", "trusted"]
    assert int(held["proved by the kernel"]) == kinds["ring_nf"]
    assert int(held["tested"]) == kinds["exact_point"] + kinds["numeric"] == kinds.total() - kinds["ring_nf"]
    assert page.index("What is held by what") < page.index("Conventions</h2>")
