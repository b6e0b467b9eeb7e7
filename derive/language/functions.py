"""Functions that a drive offers beside its contact: placements, limit points, axes, of arguments of their own.

A function's results are expressions in the design, the drive's definitions and the function's arguments; it is
scheduled on the drive's tape and printed like a flank.
"""

from dataclasses import dataclass

from derive.language import vectors as v


@dataclass(frozen=True)
class Result:
    """A named result: one number or several, with their unit and frame."""

    name: str
    values: tuple
    unit: str = ""
    frame: str = ""


@dataclass(frozen=True)
class Function:
    """``results`` as a function of ``arguments`` (symbols) and the design.

    ``rests_on`` are statements of the audit record.
    """

    name: str
    meaning: str
    arguments: tuple
    results: tuple[Result, ...]
    rests_on: tuple[str, ...] = ()


def both_turns(a, b, c):
    """Both angles with a·cos + b·sin + c = 0; not a number where there is none (a² + b² < c²)."""
    middle, half = v.arc(b, a), v.arc(v.root(a**2 + b**2 - c**2), -c)
    return middle + half, middle - half
