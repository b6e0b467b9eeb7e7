"""The drives: one module a family. A module offers ``catalogue()``: name → function that builds the drive."""

from derive.drives import cylindrical_worm, face_worm, spherical

FAMILIES = (cylindrical_worm, spherical, face_worm)


def catalogue():
    """Every drive by name, in the order of the families."""
    return {name: build for family in FAMILIES for name, build in family.catalogue().items()}
