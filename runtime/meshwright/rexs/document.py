"""A REXS file as components and relations, with the place of every element, so that a part can be replaced and all
else stays as it was, to the byte.

No document type and no entities are taken, and no more than :data:`LARGEST_FILE` bytes.
"""

import re
from dataclasses import dataclass, field
from functools import partial
from xml.parsers import expat

from meshwright.base.errors import UsageError, plain
from meshwright.base.files import read_bytes

LARGEST_FILE = 2**26

#: How our remark on what was left out of a file begins.
MARK = " meshwright, left out of this file: "

NAMESPACE = "https://www.rexs.info"

_DEEPEST = 32

#: A tag from < to >, whose quoted values may hold either.
_TAG = re.compile(rb"""<(?:[^>"']|"[^"]*"|'[^']*')*>""")


class RexsError(UsageError):
    """A REXS file that cannot be read: names file, component, attribute, value, reason and remedy."""

    def __init__(self, place, reason, remedy):
        super().__init__(plain(f"{place}: {reason}; {remedy}"))


@dataclass
class Element:
    """An element of the file: bytes ``start`` to ``end``, its content ``inner`` to ``outer``; None if it is empty."""

    tag: str
    attributes: dict
    line: int
    start: int
    inner: int | None = None
    outer: int | None = None
    end: int = 0
    text: str = ""
    children: list = field(default_factory=list)

    def all(self, tag):
        """The children of this tag."""
        return [child for child in self.children if child.tag == tag]


@dataclass
class Component:
    """A component of the file with its attributes by id."""

    id: str
    type: str
    name: str
    element: Element
    attributes: dict

    def __str__(self):
        return f"component {self.id} ({self.type})"


@dataclass
class Relation:
    """A relation of the file: ids of components by role."""

    id: str
    type: str
    order: str
    refs: dict


@dataclass
class Document:
    """A file: its bytes, components by id, relations in their order, and the bytes from start to end of our remark on
    what was left out of it (:mod:`meshwright.rexs.left_out`), None if it has none.
    """

    place: str
    source: bytes
    root: Element
    components: dict
    relations: list
    remark: tuple[int, int] | None = None

    def elsewhere(self):
        """(owner, attribute) elements of attributes that are of no component of the file's own list, such as those of
        load cases, each with the ids and tags of what it stands in.
        """
        own = {id(e) for c in self.components.values() for e in c.attributes.values()}
        open_ = [(self.root, child, ()) for child in reversed(self.root.children)]
        while open_:
            owner, element, path = open_.pop()
            if element.tag == "attribute" and id(element) not in own:
                yield owner, element, path
            within = (*path, " ".join(filter(None, (element.tag.replace("_", " "), element.attributes.get("id")))))
            open_ += [(element, child, within) for child in reversed(element.children)]


def read(path):
    """The :class:`Document` of a file; raises :class:`RexsError`."""
    source = read_bytes(path, LARGEST_FILE, partial(RexsError, path), "take results out of it, such as point lists")
    return parsed(source, path)


def parsed(source, place):
    """The :class:`Document` of bytes that were found at ``place``."""
    builder = _Builder(source, place)
    root = builder.root()
    if root.tag != "model":
        raise RexsError(place, f"the root element is {root.tag!r}", "a REXS file is a <model>")
    version = root.attributes.get("version", "")
    if version.split(".")[0] != "2":
        raise RexsError(place, f"model, version = {version!r}: not REXS 2", "convert it to version 2.0")
    components = _components(root, place)
    return Document(str(place), source, root, components, _relations(root, components, place), builder.remark)


class _Builder:
    """Elements from the events of expat."""

    def __init__(self, source, place):
        self.source, self.place, self.open, self.found, self.remark = source, place, [], None, None
        parser = expat.ParserCreate(namespace_separator=" ")
        parser.buffer_text = True
        parser.XmlDeclHandler = self._declared
        parser.StartDoctypeDeclHandler = self._refuse
        parser.StartElementHandler = self._start
        parser.EndElementHandler = self._end
        parser.CharacterDataHandler = self._text
        parser.CommentHandler = self._commented
        self.parser = parser

    def root(self):
        try:
            self.parser.Parse(self.source, True)
        except expat.ExpatError as error:
            reason = f"not well-formed XML: {expat.ErrorString(error.code)}"
            raise RexsError(f"{self.place}, line {error.lineno}", reason, "correct the line") from error
        return self.found

    def _declared(self, _version, encoding, _standalone):
        if encoding and encoding.lower() not in ("utf-8", "us-ascii", "ascii"):
            raise RexsError(self.place, f"encoding {encoding}", "save it as UTF-8")

    def _refuse(self, *_):
        raise RexsError(self.place, "has a document type (DOCTYPE)", "remove it; REXS has none")

    def _start(self, name, attributes):
        if len(self.open) >= _DEEPEST:
            raise RexsError(self.place, "nested too deeply", "a REXS file has fewer levels")
        namespace, _, tag = name.rpartition(" ")
        if namespace not in ("", NAMESPACE):
            tag = name  # of another vocabulary
        place, line = self.parser.CurrentByteIndex, self.parser.CurrentLineNumber
        element = Element(tag, attributes, line, place)
        close = self._close(place)
        if self.source[close - 1 : close] != b"/":
            element.inner = close + 1
        else:
            element.end = close + 1
        if self.open:
            self.open[-1].children.append(element)
        self.open.append(element)

    def _close(self, at):
        """The place of the > that ends a tag."""
        return _TAG.match(self.source, at).end() - 1

    def _end(self, _name):
        element = self.open.pop()
        if element.inner is not None:
            element.outer = self.parser.CurrentByteIndex
            element.end = self._close(element.outer) + 1
        if not self.open:
            self.found = element

    def _commented(self, text):
        if text.startswith(MARK) and len(self.open) == 1:
            start = self.parser.CurrentByteIndex
            self.remark = start, self.source.index(b"-->", start) + 3

    def _text(self, text):
        self.open[-1].text += text


def _section(root, tag):
    return [child for section in root.all(tag) for child in section.children]


def _components(root, place):
    found = {}
    for element in _section(root, "components"):
        if element.tag != "component":
            continue
        ident, kind = (_needed(element, name, f"{place}, component") for name in ("id", "type"))
        component = Component(ident, kind, element.attributes.get("name", ""), element, {})
        if ident in found:
            raise RexsError(f"{place}, {component}, line {element.line}", "its id occurs twice", "give each its own")
        for attribute in element.all("attribute"):
            name = _needed(attribute, "id", f"{place}, {component}, attribute")
            if name in component.attributes:
                raise RexsError(f"{place}, {component}, attribute {name}", "given twice", "remove one of them")
            component.attributes[name] = attribute
        found[ident] = component
    return found


def _relations(root, components, place):
    found = []
    for element in _section(root, "relations"):
        if element.tag != "relation":
            continue
        ident = element.attributes.get("id", "")
        kind = _needed(element, "type", f"{place}, relation {ident}")
        refs = {}
        for ref in element.all("ref"):
            target, role = (_needed(ref, name, f"{place}, relation {ident} ({kind}), ref") for name in ("id", "role"))
            if target not in components:
                raise RexsError(
                    f"{place}, relation {ident} ({kind}), {role} = component {target}", "there is no such component",
                    "correct the id",
                )  # fmt: skip
            refs[role] = components[target]
        found.append(Relation(ident, kind, element.attributes.get("order", ""), refs))
    return found


def _needed(element, name, place):
    try:
        return element.attributes[name]
    except KeyError:
        raise RexsError(f"{place}, line {element.line}", f"{name} is missing", "add it") from None


def spliced(source, edits):
    """The bytes with each (start, end, replacement) made; an insertion has start = end. Edits do not overlap."""
    parts, at = [], 0
    for start, end, replacement in sorted(edits, key=lambda edit: edit[:2]):
        parts += [source[at:start], replacement]
        at = end
    return b"".join([*parts, source[at:]])
