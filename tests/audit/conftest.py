import json
import shutil

import pytest

from tests.audit import forger


@pytest.fixture(scope="session")
def small_ledger():
    return forger.small_ledger()


@pytest.fixture(scope="session")
def written(small_ledger, tmp_path_factory):
    return forger.written(small_ledger, tmp_path_factory.mktemp("record"))


@pytest.fixture
def record(written, tmp_path):
    """A copy of its own of the record on disk."""
    return shutil.copytree(written.parent, tmp_path, dirs_exist_ok=True) / written.name


@pytest.fixture
def objects(small_ledger):
    """The record in memory, as plain JSON."""
    return {key: json.loads(json.dumps(item)) for key, item in small_ledger.objects.items()}
