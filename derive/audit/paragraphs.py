r"""Claims, and what pages say in words, as they are written down: a paragraph each.

    key | where it stands | SCOPE
    > what is printed, word for word
    What it says, in plain words.
        left = right
        another equation
    where: a condition under which it holds

A line that is indented by eight goes on with the one before. A printed number stands in the place of an equation, as
``formula -> number unit``. ``reading LABEL:`` begins the equations of one of several readings, ``corrected:`` and
``contradiction:`` those that should be printed and those that speak against the print. ``damage:``, ``missing:``,
``drops:``, ``kind:``, ``confusable:`` and ``final:`` are what :class:`Claim` and :class:`FigureClaim` say of them.
``\n`` is the end of a printed line.
"""

import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from derive.audit.claims import AS_PRINTED, DERIVED, Claim, Figure, FigureClaim, as_list

#: What writes out an equation for all that the names in its braces stand for.
Each = Callable[[str], list[str]]

#: Lines that say what they are: words that a claim has once or several times, and those that begin equations.
WORD = re.compile(r"(where|damage|missing|drops|kind|confusable|final): (.*)")
GROUP = re.compile(r"(?:reading (.+)|(corrected|contradiction)):")
FIGURE = re.compile(r"(.*) -> (\S+) ?(.*)")


def claims(text: str, scopes: Mapping[str, Any]) -> tuple[Claim | FigureClaim, ...]:
    """The claims of a text; ``scopes`` are scopes by their names."""
    return tuple(_claim(paragraph, scopes, AS_PRINTED) for paragraph in _paragraphs(text))


def identities(text: str, scopes: Mapping[str, Any], each: Each = as_list) -> tuple[Claim, ...]:
    """Claims of our own; ``each`` writes out an equation for all that the names in its braces stand for."""
    found = (_claim(paragraph, scopes, DERIVED, each) for paragraph in _paragraphs(text))
    return tuple(replace(claim, kind="identity") for claim in found if isinstance(claim, Claim))


def paragraphs(text: str) -> list[str]:
    """Paragraphs of prose, each on one line."""
    return [paragraph.replace("\n", " ") for paragraph in _paragraphs(text)]


def titled(text: str, sources: bool = False) -> list[tuple[str, ...]]:
    """Paragraphs whose first line is their title: (title, prose), and with ``sources`` what is quoted in the end."""
    found = []
    for paragraph in _paragraphs(text):
        title, _, body = paragraph.partition("\n")
        prose, _, source = body.partition("\n> ")
        found.append((title, prose.replace("\n", " "), *([source] if sources else ())))
    return found


def _paragraphs(text: str) -> list[str]:
    return text.strip("\n").replace("\n" + " " * 8, " ").split("\n\n")


def _claim(paragraph: str, scopes: Mapping[str, Any], group: str, each: Each = as_list) -> Claim | FigureClaim:
    head, *lines = paragraph.splitlines()
    key, where, *names = head.split(" | ")
    printed: list[str] = []
    plain: list[str] = []
    said: dict[str, list[str]] = {}
    equations: dict[str, list[str]] = {}
    for line in lines:
        if line.startswith(" " * 4):
            equations.setdefault(group, []).extend(each(line[4:]) if "{" in line else [line[4:]])
        elif line.startswith("> "):
            printed.append(line[2:])
        elif word := WORD.fullmatch(line):
            said.setdefault(word[1], []).append(word[2])
        elif begun := GROUP.fullmatch(line):
            group = begun[1] or begun[2]
        elif said or equations:
            raise ValueError(f"{key}: {line!r} is neither an equation nor begins with a word that is known")
        else:
            plain.append(line)
    texts = (key, where, " ".join(printed).replace("\\n ", "\n").replace("\\n", "\n"), " ".join(plain))
    corrected, contradiction = equations.pop("corrected", []), equations.pop("contradiction", [])
    if any(map(FIGURE.fullmatch, sum(equations.values(), []))):
        return FigureClaim(*texts, *map(_figures, (*equations.values(), corrected)), final="final" in said)
    conditions, confusable = said.pop("where", []), [line.split() for line in said.pop("confusable", [])]
    words: dict[str, Any] = {word: line for word, (line,) in said.items()}
    scope = scopes[names[0]] if names else None
    return Claim(*texts, scope, equations, corrected, contradiction, conditions, confusable=confusable, **words)


def _figures(lines: list[str]) -> list[Figure]:
    return [Figure(*found.groups()) for found in map(FIGURE.fullmatch, lines) if found]
