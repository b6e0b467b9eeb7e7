"""The drives: one module a family, whose name the names of its drives begin with.

A module offers ``catalogue()``: name → function that builds the drive.
"""

from functools import cache
from importlib import import_module

FAMILIES = ("cylindrical_worm", "spherical", "cylindrical_gears", "internal_gears", "face_worm", "bevel")


def catalogue(wanted=FAMILIES):
    """Every drive by name, in the order of the families; with ``wanted`` names, of their families alone."""
    families = [family for family in FAMILIES if any(name.startswith(family) for name in wanted)]
    return {
        name: build
        for family in families
        for name, build in import_module(f"derive.drives.{family}").catalogue().items()
    }


@cache
def drive(name):
    """A drive of the tree, as its page builds it."""
    return catalogue([name])[name]()
