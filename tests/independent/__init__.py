"""Formulations written from the sources, independent of the compiler: what physics is tested against."""
