"""Jinja2 environment of all printers: strict, templates beside this file."""

from pathlib import Path

import jinja2

_ENVIRONMENT = jinja2.Environment(
    loader=jinja2.FileSystemLoader(Path(__file__).parent / "templates"),
    undefined=jinja2.StrictUndefined,
    trim_blocks=True,
    lstrip_blocks=True,
    keep_trailing_newline=True,
)


def render(template, **values):
    """The template filled in; an undefined name is an error."""
    return _ENVIRONMENT.get_template(template).render(**values)
