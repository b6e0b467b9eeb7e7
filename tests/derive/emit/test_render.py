"""Templates are strict: what a printer forgets to give is an error, not an empty place in C."""

import jinja2
import pytest

from derive.emit.render import render


def test_a_name_that_is_not_given_is_an_error():
    with pytest.raises(jinja2.UndefinedError):
        render("bounded.h.jinja")
