import json

import pytest

from derive.audit import store
from derive.audit.claims import FigureClaim
from derive.audit.documents import rack_and_pinion, recess_action
from derive.audit.ledger import Chapter, build
from derive.files import replace_text

HEADER = """/* A drive.
 * Equations (hash {root}):
 *   rack-and-pinion/eq-1
 */
double x = a - b;
"""


@pytest.fixture(scope="session")
def small_ledger():
    """A record of a few claims: proofs with one and several relations, a refutation, corrections, printed numbers."""
    wanted = {"helicoid", "eq-1", "eq-4", "meshing", "ratio-sign", "twice"}
    claims = [claim for claim in rack_and_pinion.CLAIMS if claim.key in wanted]
    printed = {"eq-1", "eq-7", "eq-12", "eq-16", "lead-angle-hob", "table-1-hob"}
    others = [claim for claim in recess_action.CLAIMS if claim.key in printed or isinstance(claim, FigureClaim)]
    return build([Chapter(rack_and_pinion.DOCUMENT, claims), Chapter(recess_action.DOCUMENT, others)])


@pytest.fixture
def record(small_ledger, tmp_path):
    """That record on disk, with a page and one generated header."""
    texts = store.record_files(small_ledger) | {"index.html": "<p>proved</p>\n", "audit.tex": "proved\n"}
    files = {"c/drive.h": HEADER.format(root=small_ledger.root)}
    files |= {f"audit/{name}": text for name, text in texts.items()}
    files["audit/artifacts.json"] = store.seal(small_ledger, files)
    for name, text in files.items():
        replace_text(tmp_path / name, text)
    return tmp_path / "audit"


@pytest.fixture
def objects(small_ledger):
    """The record in memory, as plain JSON."""
    return {key: json.loads(json.dumps(item)) for key, item in small_ledger.objects.items()}
