"""The generator is Sphinx: pages of this folder, the API from docstrings, and what ``make site`` puts beside them."""

from importlib import metadata

project = "meshwright"
author = "the meshwright project"
version = release = metadata.version("meshwright")
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.viewcode"]
myst_enable_extensions = ["dollarmath", "deflist"]
source_suffix = {".md": "markdown"}
html_theme = "furo"
html_title = "meshwright"
html_show_sphinx = False
html_copy_source = False
autodoc_member_order = "bysource"
autodoc_typehints = "description"
autodoc_default_options = {"members": True, "show-inheritance": False}
suppress_warnings = ["autodoc.mocked_object"]
html_show_copyright = False
