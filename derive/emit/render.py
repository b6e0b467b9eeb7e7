"""Jinja2 environment of all printers: strict, templates beside this file."""

import os
import sys
from pathlib import Path

import jinja2

_TEMPLATES = Path(__file__).parent / "templates"


def _compiled_templates():
    """Where compiled templates are kept, as Python keeps compiled modules: beside them, if that can be written."""
    folder = _TEMPLATES / "__pycache__"
    if sys.dont_write_bytecode:
        return None
    try:
        folder.mkdir(exist_ok=True)
    except OSError:
        return None
    return jinja2.FileSystemBytecodeCache(str(folder), "%s.bin") if os.access(folder, os.W_OK) else None


_ENVIRONMENT = jinja2.Environment(
    loader=jinja2.FileSystemLoader(_TEMPLATES),
    bytecode_cache=_compiled_templates(),
    undefined=jinja2.StrictUndefined,
    trim_blocks=True,
    lstrip_blocks=True,
    keep_trailing_newline=True,
)


def render(template, **values):
    """The template filled in; an undefined name is an error."""
    return _ENVIRONMENT.get_template(template).render(**values)
