import json

import pytest

from derive.audit import store
from derive.audit.documents import rack_and_pinion
from derive.audit.ledger import Chapter, build
from derive.files import replace_text


@pytest.fixture(scope="session")
def small_ledger():
    """A record of a few claims: proofs with one and several relations, a refutation, a correction."""
    wanted = {"helicoid", "eq-1", "eq-4", "meshing", "ratio-sign", "twice"}
    claims = [claim for claim in rack_and_pinion.CLAIMS if claim.key in wanted]
    return build([Chapter(rack_and_pinion.DOCUMENT, claims)])


@pytest.fixture
def record(small_ledger, tmp_path):
    """That record on disk, with one generated header that it names."""
    header = (
        f"/* A drive.\n * Equations (hash {small_ledger.root}):\n *   rack-and-pinion/eq-1\n */\ndouble x = a - b;\n"
    )
    replace_text(tmp_path / "c" / "drive.h", header)
    folder = tmp_path / "audit"
    for name, text in (
        store.record_files(small_ledger) | {"artifacts.json": store.seal(small_ledger, {"c/drive.h": header})}
    ).items():
        replace_text(folder / name, text)
    return folder


@pytest.fixture
def objects(small_ledger):
    """The record in memory, as plain JSON."""
    return {key: json.loads(json.dumps(item)) for key, item in small_ledger.objects.items()}
