"""What the tests of certified contact share."""

import flint
import pytest


@pytest.fixture
def many_digits():
    """Balls of 300 bits for what is exact."""
    before, flint.ctx.prec = flint.ctx.prec, 300
    yield
    flint.ctx.prec = before
