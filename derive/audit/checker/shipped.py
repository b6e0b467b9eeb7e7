"""A generated header as a list of items, tokens without comments, and what of it is the runtime's own text."""

import re
from collections.abc import Iterator
from pathlib import Path

from .refusal import require

COMMENT = re.compile(r'("(?:[^"\\\n]|\\.)*")|/\*.*?\*/', re.DOTALL)
TOKEN = re.compile(
    r'"(?:[^"\\\n]|\\.)*"|\d[\w.]*(?:(?<=[eEpP])[+-]\w+)?|\w+|[-+*/%&|^=<>!]=|&&|\|\||<<|>>|->|\+\+|--|\S'
)
INCLUDE = re.compile(r'^#include "(.+)"\n', re.M)


def tokens(text: str) -> str:
    """A text's tokens, one space between them."""
    return " ".join(TOKEN.findall(text))


def without_comments(text: str) -> str:
    return COMMENT.sub(lambda found: found[1] or " ", text)


def items(text: str) -> list[str]:
    """Directives, declarations and functions, in their order, each as its tokens."""
    found, kept, depth, body = [], "", 0, False
    for line in without_comments(text).replace("\\\n", " ").splitlines():
        if line.lstrip().startswith("#") and not kept.strip():
            found.append(tokens(line))
            continue
        # a directive within a function or a list is one of its tokens
        for part in re.split(r"([{};])", line) if not line.lstrip().startswith("#") else [f" {line} "]:
            kept += f" {part}"
            if part == "{":
                body = body or (depth == 0 and kept.rstrip(" {").endswith(")"))
                depth += 1
            elif part == "}":
                depth -= 1
            if depth == 0 and (part == ";" or (part == "}" and body)):
                found.append(tokens(kept))
                kept, body = "", False
    require(depth == 0 and not kept.strip(), "a declaration does not end")
    return found


def opening(item: str) -> str:
    """What stands before the first brace of a function: its signature."""
    return item.split(" {", 1)[0]


def name_of(item: str) -> str:
    """The name that an item defines: of a macro, a function, a table or an enumeration's first entry."""
    if item.startswith("# define "):
        return item.split()[2]
    head = re.sub(r" (=|\[) .*", "", opening(item))
    if item.startswith("enum {"):
        return item.split()[2]
    found = re.search(r"(\w+) (?:\) )?\(", head) or re.search(r"(\w+)(?: ;)?$", head)
    return found[1] if found else ""


class Runtime:
    """The texts of the C runtime that generated headers repeat."""

    def __init__(self, folder: Path):
        self.folder = folder
        require(folder.is_dir(), f"{folder}: the runtime's text, with which headers are compared, is not there")

    def text(self, name: str) -> str:
        return (self.folder / name).read_text(encoding="utf-8")

    def items(self, *names: str) -> list[str]:
        """Those of some files, one after the other, without what they include."""
        return [item for name in names for item in items(INCLUDE.sub("", self.text(name)))]

    def reached(self, *roots: str) -> list[str]:
        """Items of the solver's headers that some need, each after those that it includes."""
        seen: set[Path] = set()
        return [item for root in roots for item in self._reached((self.folder / "solver" / root).resolve(), seen)]

    def _reached(self, path: Path, seen: set[Path]) -> Iterator[str]:
        if path in seen or path.parent.name != "solver":
            return
        seen.add(path)
        text = path.read_text(encoding="utf-8")
        for name in INCLUDE.findall(text):
            yield from self._reached((path.parent / name).resolve(), seen)
        yield from items(INCLUDE.sub("", text))


def without(found: list[str], part: list[str], words: str) -> list[str]:
    """Items without a run of them, which must be there, once."""
    size = len(part)
    starts = [k for k in range(len(found) - size + 1) if found[k] == part[0] and found[k : k + size] == part]
    if len(starts) != 1:
        own = set(found)
        first = next((item for item in part if item not in own), "in this order")
        require(False, f"{words}: not there as the runtime has it, {first[:90]}")
    return found[: starts[0]] + found[starts[0] + size :]
