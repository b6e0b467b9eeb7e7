"""A drive inside other software: tables of its error."""
