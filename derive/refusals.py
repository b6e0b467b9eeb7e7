"""What the compiler cannot do, in words: the drive, the stage, the part, the line of the page and the remedy."""

from collections.abc import Iterator
from contextlib import contextmanager
from types import TracebackType

from derive.language import written
from derive.language.drive import Body, DesignSystem, Region, System
from derive.language.functions import Function
from derive.language.refusal import DescriptionError
from derive.language.symbols import Quantity
from derive.passes.guards import Unguarded

#: What a page is made of and has a name.
_PARTS = (Function, Region, Body, DesignSystem, System, Quantity)


class Refused(ValueError):
    """A page, a file or a folder that is refused; the message says all that a person needs."""


@contextmanager
def told(stage: str, name: str) -> Iterator[None]:
    """Say in words what ends a stage of the drive ``name``: :class:`Refused`."""
    try:
        yield
    except Refused:
        raise
    except (DescriptionError, Unguarded) as error:
        raise Refused(_located(str(error))) from error
    except (Exception, SystemExit) as error:  # a page that ends Python has compiled nothing
        if isinstance(error, OSError) and not written.line_of(error.__traceback__):
            raise  # a file of the installation
        raise Refused(words(stage, name, error)) from error


def words(stage: str, name: str, error: BaseException) -> str:
    """What an error of Python's means for a drive in a stage."""
    if isinstance(error, SyntaxError) and error.filename and error.lineno:
        return f"{written.line(error.filename, error.lineno)}: {error.msg}; correct the line"
    said = f"{type(error).__name__}: {error}" if not isinstance(error, ValueError) else str(error)
    if isinstance(error, KeyError):
        said = f"there is no {error}"
    if line := written.line_of(error.__traceback__):
        return f"{name}: {line}: {said}; correct this line or what it is given"
    part = _part_in(error.__traceback__)
    of = f" of {part}" if part else ""
    return _located(f"{name}: the stage {stage} cannot do with the description{of}: {said}; write it in another form")


def _located(message: str) -> str:
    """A message with the line of the page that wrote what it speaks of."""
    place = written.place_of(message)
    return f"{message} [{place}]" if place else message


def _part_in(trace: TracebackType | None) -> str:
    """The part of a description with which the innermost function was busy, or ""."""
    found = ""
    while trace is not None:
        held = [value for value in trace.tb_frame.f_locals.values() if isinstance(value, _PARTS)]
        for value in held:
            name = f"{value.member}/{value.name}" if isinstance(value, Region) else value.name
            found = f"{type(value).__name__.lower()} {name!r}"
        trace = trace.tb_next
    return found
