import json

import pytest

from tests.audit import forger


@pytest.fixture(scope="session")
def small_ledger():
    return forger.small_ledger()


@pytest.fixture
def record(small_ledger, tmp_path):
    return forger.written(small_ledger, tmp_path)


@pytest.fixture
def objects(small_ledger):
    """The record in memory, as plain JSON."""
    return {key: json.loads(json.dumps(item)) for key, item in small_ledger.objects.items()}
