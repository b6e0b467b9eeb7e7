"""What the source texts display: counted by this script from the texts themselves.

``python -m derive.audit.displayed FOLDER`` reads the texts (their names are those of the documents) and writes
``displayed.json`` beside this file: every numbered or displayed equation, every "where" line, every row of a table and
every sentence that draws a conclusion, with its place and the hash of its words; and where each entry's verbatim text
stands literally. A text that is found nowhere is a transliteration, of formulas that the extraction has taken apart.
What judges each of them: ``coverage.py``.
"""

import argparse
import hashlib
import json
import re
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from derive.audit import coverage, record
from derive.files import replace_text

#: Words by which a sentence draws a conclusion.
CONCLUSION = re.compile(
    r"\b(always|exactly|unique(?:ly)?|identical|independent|thus|hence|therefore|confirms?|indicates? that|implies"
    r"|reveals?|concluded|it is found|it is known)\b|因此|可知|可發現|值得注意|不至於",
    re.IGNORECASE,
)
NUMBERED = re.compile(r"(?m)\((\d{1,2}(?:\.\d{1,2})?)\)[ ,.;]*$")
#: What a row of a table gives: a number, or a hand.
VALUE = re.compile(r"\d|\b[LR]H\b")
CAPTION = re.compile(r"(?m)^(?:Table (\d)[: ]+[A-Z].*|表 (\d)\. (\d) .*)$")
MARK = re.compile(r"<\|[^|]*\|>")
#: Where the second document of a file begins, and where the first ends.
SECOND, END = "GUD-02\n", "會議名稱"


@dataclass(frozen=True)
class Statement:
    """One displayed statement: its kind, what it is called, its line, its words."""

    kind: str
    label: str
    line: int
    words: str

    @property
    def sha256(self) -> str:
        return hashlib.sha256(" ".join(self.words.split()).encode()).hexdigest()


def statements(key: str, text: str) -> list[Statement]:
    """What a text displays, kind by kind and in its order."""
    begin, end = _part(key, text)
    first, last = _line(text, begin), _line(text, end)
    found = []
    for listed in (_equations, _where, _tables, _claims):
        own = [statement for statement in listed(text) if first <= statement.line <= last]
        found += [replace(s, label=s.label or f"{s.kind} {k}") for k, s in enumerate(own, 1)]
    return found


def _part(key: str, text: str) -> tuple[int, int]:
    """Begin and end of a document within its file."""
    at = text.find(SECOND)
    if at < 0:
        return 0, len(text)
    return (at, len(text)) if key == "zk-zn" else (0, text.index(END))


def _line(text: str, at: int) -> int:
    return text.count("\n", 0, at) + 1


def _equations(text: str) -> Iterator[Statement]:
    displays = [*re.finditer(r"\$\$(.*?)\$\$", text, re.DOTALL)]
    for k, match in enumerate(displays, 1):
        yield Statement("equation", f"display {k}", _line(text, match.start()), match[1])
    seen: set[tuple[bool, str]] = set()
    lines = text.splitlines()
    second = text.find(SECOND)
    for match in NUMBERED.finditer(text) if not displays else ():
        # a number is that of an equation where it first closes a line that is not prose
        line, part = _line(text, match.start()), 0 <= second < match.start()
        before = lines[line - 1][: match.start() - text.rfind("\n", 0, match.start()) - 1]
        if (part, match[1]) in seen or _is_prose(before):
            continue
        seen.add((part, match[1]))
        yield Statement("equation", f"({match[1]})", line, lines[line - 1])


def _is_prose(words: str) -> bool:
    """A line of a sentence, whose closing number refers to an equation elsewhere."""
    plain = re.sub(r"\b(cos|sin|tan|cot|max|convex|concave|rpm|arc|sec)\b", "", words)
    return len(re.findall(r"\b[a-z]{3,}\b", plain)) > 3 or "，" in words


def _where(text: str) -> Iterator[Statement]:
    """Lines that begin with "where", and the formulas that follow such a line."""
    for match in re.finditer(r"(?m)^(?:where|Here:|with \$)(?=\W).*$|^其中.*$", text):
        block = text[match.start() : match.start() + 700].partition("\n\n")[0]
        yield Statement("where", "", _line(text, match.start()), block[:200])


def _tables(text: str) -> Iterator[Statement]:
    """Rows of tables: those of markdown, and lines of numbers below a caption."""
    rows = [m for m in re.finditer(r"(?m)^\|.*\|$", text) if not re.fullmatch(r"[|\- ]+", m[0])]
    for match in rows:
        yield Statement("table", "", _line(text, match.start()), match[0])
    captions = [*CAPTION.finditer(text)] if not rows else []
    for caption in captions:
        name = f"Table {caption[1]}" if caption[1] else f"Table {caption[2]}.{caption[3]}"
        first, blank, k = _line(text, caption.start()), 0, 0
        for line, words in enumerate(MARK.sub("", text).splitlines()[first : first + 60], first + 1):
            blank = 0 if words.strip() else blank + 1
            if blank > 2 or CAPTION.match(words) or re.match(r"圖 |References|Fig|\(a\)|[1-9]\.\d +[^\W\d_a-z]", words):
                break
            if _is_sentence(words) and k:
                break
            if VALUE.search(words) and not _is_sentence(words) and not re.match(r"― |NASA", words):
                k += 1
                yield Statement("table", f"{name}, row {k}", line, words)


def _is_sentence(words: str) -> bool:
    chinese = len(re.findall(r"[一-鿿]", words))
    return bool(re.search(r"[，。]", words)) or chinese > 16 or len(re.findall(r"\b[a-z]{3,}\b", words)) > 5


def _claims(text: str) -> Iterator[Statement]:
    plain = MARK.sub(lambda match: " " * len(match[0]), text)
    begin = 0
    for match in re.finditer(r"(?<=[.])\s+(?=[A-Z0-9*])|(?<=。)|\n\s*\n", plain):
        words, at = plain[begin : match.start()], begin
        begin = match.end()
        if CONCLUSION.search(words.replace("-\n", "")) and "|" not in words:
            yield Statement("claim", "", _line(text, at), words[-600:])


def read_texts(folder: Path, documents: Mapping[str, tuple[str, str]]) -> dict[str, str]:
    """Document -> text of its file; ValueError where it is another one than that of the record."""
    texts = {}
    for key, (file, sha256) in documents.items():
        data = (folder / file).read_bytes()
        if hashlib.sha256(data).hexdigest() != sha256:
            raise ValueError(f"{folder / file} is not the text of the record (sha256 {sha256[:16]})")
        texts[key] = data.decode("utf-8")
    return texts


def measured(folder: Path) -> dict:
    """What ``displayed.json`` holds."""
    sources = [chapter for chapter in record.chapters() if chapter.document.sha256]
    named = {chapter.document.key: (chapter.document.file, chapter.document.sha256) for chapter in sources}
    texts = read_texts(folder, named)
    displayed = {
        key: [[s.kind, s.label, s.line, s.sha256] for s in statements(key, text)] for key, text in texts.items()
    }
    literal = {}
    for chapter in sources:
        for claim in chapter.claims:
            at = texts[chapter.document.key].find(claim.verbatim) if claim.verbatim else -1
            if at >= 0:
                literal[f"{chapter.document.key}/{claim.key}"] = [at, coverage.sha256(claim.verbatim)]
    return {"displayed": displayed, "literal": literal}


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(prog="python -m derive.audit.displayed", description=__doc__)
    parser.add_argument("folder", type=Path, help="folder of the four texts")
    options = parser.parse_args(arguments)
    try:
        found = measured(options.folder)
    except (OSError, ValueError) as error:
        print(error, file=sys.stderr)
        return 2
    lines = ",\n".join(
        f'  "{key}": [\n' + ",\n".join(f"   {json.dumps(one, ensure_ascii=False)}" for one in listed) + "\n  ]"
        for key, listed in found["displayed"].items()
    )
    literal = ",\n".join(f'  "{key}": {json.dumps(value)}' for key, value in found["literal"].items())
    replace_text(coverage.DISPLAYED, f'{{\n "displayed": {{\n{lines}\n }},\n "literal": {{\n{literal}\n }}\n}}\n')
    coverage.read.cache_clear()
    claims = {chapter.document.key: chapter.claims for chapter in record.chapters() if chapter.document.sha256}
    for document, kind, total, entries, reasons, gaps in coverage.summary(coverage.rows(claims)):
        counts = f"{total:4} displayed {entries:4} with entries {reasons:4} with a reason {gaps:4} open"
        print(f"{document:16} {kind:9} {counts}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
