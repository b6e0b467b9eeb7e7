"""What a step of a derivation rests on: statements of the audit record, by their ids.

Every step names its statements where it is carried out, so that what a generated function rests on follows from how
the drive was derived. The prove stage refuses an id that the record has not proved.
"""

from collections.abc import Iterable
from dataclasses import dataclass


@dataclass(frozen=True)
class Origin:
    """Where an operation comes from that is not defined everywhere.

    ``statement`` says when it is defined; ``meaning`` is what is divided by, or what the root is taken of, for
    readers, where the formula is too long to be shown.
    """

    statement: str
    meaning: str = ""


#: Operations that are not defined everywhere.
PARTIAL = {
    "div": Origin("derivation/quotient"),
    "sqrt": Origin("derivation/root"),
    "atan2": Origin("derivation/arc"),
}
TANGENT = Origin("derivation/tangent")
ARCCOSINE = Origin("derivation/arccosine", "the argument of an arc cosine or sine")
EXPLICIT = "derivation/explicit"
ELIMINATION = "derivation/elimination"
ANGLES = "derivation/angles"
CONTACT = "cylindrical_worm/contact"
SINGULAR = "cylindrical_worm/undercut"
STEP_SIZE = Origin("derivation/step-size", "natural size of an unknown")
UNIT = Origin("derivation/unit", "length of a normal")


def joined(*groups: Iterable[str]) -> tuple[str, ...]:
    """Statement ids of several steps, each once, in order."""
    return tuple(dict.fromkeys(statement for group in groups for statement in group))
