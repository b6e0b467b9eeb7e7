"""What a step of a derivation rests on: statements of the audit record, by their ids.

Every step names its statements where it is carried out, so that what a generated function rests on follows from how
the drive was derived. The prove stage refuses an id that the record has not proved.
"""

from collections.abc import Iterable
from dataclasses import dataclass

from derive.language.written import made_by_hand, page_file


class Cited(str):
    """The id of a statement, with the ``page`` whose definitions it is said of, the file that cites it, and the
    surface that it is said ``of``, as that was then; None where it is said of no surface.
    """

    page: str = ""
    of: object = None


def cited(statements: Iterable[str]) -> tuple[Cited, ...]:
    """These statements as cited by the page that calls.

    One that was cited before is kept, unless a page outside the tree itself makes what rests on it: that page answers
    for all of it.
    """
    listed = tuple(statements)
    if page := made_by_hand():
        return tuple(said(s, getattr(s, "of", None), page) for s in listed)
    return tuple(s if isinstance(s, Cited) else said(s, None, page_file()) for s in listed)


def said(statement: str, of: object, page: str) -> Cited:
    """A statement as a page says it of a surface, whoever has cited it before."""
    found = Cited(statement)
    found.page, found.of = page, of
    return found


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
