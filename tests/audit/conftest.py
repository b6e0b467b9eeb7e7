import json

import pytest

from derive.audit import store
from derive.audit.documents import rack_and_pinion
from derive.audit.ledger import Chapter, build


@pytest.fixture(scope="session")
def small_ledger():
    """A record of a few claims: proofs with one and several relations, a refutation, a correction."""
    wanted = {"helicoid", "eq-1", "eq-4", "meshing", "ratio-sign", "twice"}
    claims = [claim for claim in rack_and_pinion.CLAIMS if claim.key in wanted]
    return build([Chapter(rack_and_pinion.DOCUMENT, claims)])


@pytest.fixture
def record(small_ledger, tmp_path):
    """That record on disk, with one generated header that it names."""
    (tmp_path / "c").mkdir()
    (tmp_path / "c" / "drive.h").write_text(f"/* audit root {small_ledger.root} */\ndouble x = a - b;\n")
    folder = tmp_path / "audit"
    store.write(folder, store.record_files(small_ledger))
    store.write(folder, {"artifacts.json": store.seal(small_ledger, tmp_path, ["c/drive.h"])})
    return folder


@pytest.fixture
def objects(small_ledger):
    """The record in memory, as plain JSON."""
    return {key: json.loads(json.dumps(item)) for key, item in small_ledger.objects.items()}
