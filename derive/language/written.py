"""Where a page has written what a message speaks of: file and line of the call that gave a thing its name."""

import dataclasses
import os
import re
import sys
from pathlib import Path
from types import FrameType, TracebackType

_DERIVE = Path(__file__).resolve().parents[1]
#: Rooms of the tree that hold pages.
_PAGES = tuple(str(_DERIVE / room) + os.sep for room in ("tools", "drives"))
#: Folders whose code is no page's: the compiler, the runtime, Python's own library.
_ENGINE = tuple(str(folder) + os.sep for folder in (_DERIVE, _DERIVE.parent / "runtime", os.path.dirname(os.__file__)))
_WORD = re.compile(r"[A-Za-z_]\w*(?:[./][A-Za-z_]\w*)*")
_places: dict[str, tuple[str, int]] = {}


def remember(*names: str) -> None:
    """Keep the line of the page from which this is called as that of these names."""
    if (frame := _calling()) is not None:
        _places.update(dict.fromkeys(names, (frame.f_code.co_filename, frame.f_lineno)))


def made_by_hand() -> str:
    """The page outside the tree that makes the data object that is being made, itself and not by a word of the
    language or a page of the tree; or "".
    """
    frame = sys._getframe(2)  # pyright: ignore[reportPrivateUsage]
    made = frame.f_code.co_name == "__post_init__"
    while made and _makes(frame) and frame.f_back is not None:
        frame = frame.f_back
    file = frame.f_code.co_filename
    return file if made and is_page(file) and not file.startswith(_PAGES) else ""


def _makes(frame: FrameType) -> bool:
    """Whether a frame is one of those that data classes put between an object and what makes it."""
    return frame.f_code.co_name in ("__post_init__", "__init__") or frame.f_globals["__name__"] == dataclasses.__name__


def is_tool(file: str) -> bool:
    """Whether a file is a generating tool's of the tree."""
    return file.startswith(_PAGES[0])


def page_file() -> str:
    """The page from which this is called, "" where no page is."""
    frame = _calling()
    return "" if frame is None else frame.f_code.co_filename


def _calling() -> FrameType | None:
    """The innermost frame of a page."""
    frame: FrameType | None = sys._getframe(2)  # pyright: ignore[reportPrivateUsage]
    while frame is not None and not is_page(frame.f_code.co_filename):
        frame = frame.f_back
    return frame


def is_page(file: str) -> bool:
    """Whether a file may be a drive's page: neither the compiler's own, nor a library's, nor none at all."""
    library = file.startswith(("<", *_ENGINE)) or "site-packages" in file
    return file.startswith(_PAGES) or not library


def place_of(message: str) -> str:
    """The line of the page that wrote the first name in a message of which that is known, or "".

    What is quoted comes first, the drive with which the message begins last.
    """
    drive, _, rest = message.partition(": ")
    quoted = re.findall(r"'([^']*)'", rest)
    for word in (*quoted, *_WORD.findall(rest), drive):
        for name in (word, word.rpartition(".")[2]):
            if name in _places:
                return line(*_places[name])
    return ""


def line_of(trace: TracebackType | None) -> str:
    """The innermost line of a page through which an error came, with its text, or ""."""
    found = ""
    while trace is not None:
        file, number = trace.tb_frame.f_code.co_filename, trace.tb_lineno
        if is_page(file):
            found = line(file, number)
        trace = trace.tb_next
    return found


def line(file: str, number: int) -> str:
    """A line of a file, in words: where it is and what it says."""
    path = Path(file)
    try:
        text = path.read_text("utf-8").splitlines()[number - 1].strip()
    except (OSError, ValueError, IndexError):
        text = ""
    return f"{shown(file)}, line {number}" + (f": `{text}`" if text else "")


def shown(file: str) -> str:
    """A file as a reader here would name it."""
    near = os.path.relpath(file) if file else "no page"
    return file if near.startswith("..") else near
