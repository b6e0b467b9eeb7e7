"""What a step of a derivation rests on: statements of the audit record, by their ids.

Every step names its statements where it is carried out, so that what a generated function rests on follows from how
the drive was derived. The prove stage refuses an id that the record has not proved.
"""

from collections.abc import Iterable
from dataclasses import dataclass

from derive.language.written import page_file


class Cited(str):
    """The id of a statement, with the ``page`` whose definitions it is said of: the file that cites it."""

    page: str = ""


def cited(statements: Iterable[str]) -> tuple[Cited, ...]:
    """These statements as cited by the page that calls, each kept that was cited before."""
    found: list[Cited] = []
    for statement in statements:
        if not isinstance(statement, Cited):
            statement = Cited(statement)
            statement.page = page_file()
        found.append(statement)
    return tuple(found)


@dataclass(frozen=True)
class Origin:
    """Where an operation comes from that is not defined everywhere.

    ``statement`` says when it is defined; ``meaning`` is what is divided by, or what the root is taken of, for
    readers, where the formula is too long to be shown.
    """

    statement: Cited | str
    meaning: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "statement", *cited([self.statement]))


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
