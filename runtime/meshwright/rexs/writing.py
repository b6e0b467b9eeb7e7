"""A design as a REXS file: a new one, or the one that the design came from with the design's sizes put in.

What is put into a file changes the text of attributes whose number differs, and adds what the file has no place for;
all else stays as it was, to the byte.
"""

import math
import os
import time
from dataclasses import dataclass
from datetime import UTC, datetime
from xml.sax.saxutils import escape, quoteattr

from meshwright.base.errors import UsageError
from meshwright.base.expression import value
from meshwright.design import description as metadata
from meshwright.design import design as designs
from meshwright.rexs import values
from meshwright.rexs.document import NAMESPACE, parsed, spliced
from meshwright.rexs.left_out import left_out, named_in, remark
from meshwright.rexs.places import bound, stage_of
from meshwright.rexs.report import assumed_of, full, place, report, words_of

VERSION = "2.0"


@dataclass(frozen=True)
class Written:
    """The file's bytes and the report."""

    content: bytes
    report: dict


@dataclass(frozen=True)
class Text:
    """What an attribute shall hold: its number or numbers in its unit, or its word."""

    spec: dict
    value: object

    @property
    def content(self):
        if isinstance(self.value, str):
            return escape(self.value)
        if isinstance(self.value, tuple):
            return "<array>" + "".join(f"<c>{x!r}</c>" for x in self.value) + "</array>"
        return values.text_of(self.spec, self.value)

    def element(self):
        """The whole element."""
        return (
            f'<attribute id={quoteattr(self.spec["attribute"])} unit={quoteattr(self.spec["unit"])}>'
            f"{self.content}</attribute>"
        )


def file_of(tables, version, into=None, stage=None):
    """The REXS file of a design (raw tables), as :class:`Written`; ``into`` is the document that it came from,
    ``stage`` the id of its stage there.

    ``version`` is that of this program. Raises :class:`~meshwright.base.errors.DesignError` for a design that is
    wrong, :class:`~meshwright.base.errors.UsageError` for a family that REXS does not have.
    """
    tables = designs.from_drawing(tables)
    family_name, _ = designs.validated(tables)
    family = metadata.families()[family_name]
    if family.exchange is None:
        known = ", ".join(name for name, other in metadata.families().items() if other.exchange)
        raise UsageError(f"drive = {family_name}: REXS has no components for this family; it has those of {known}")
    checked, symbols = designs.by_rules(tables)
    symbols = _solved(tables, family, symbols)
    symbols["hand"] = -1.0 if checked["design"].get("hand") == "left" else 1.0
    texts, refused = _texts(family, checked, symbols)
    if into is None:
        content, ids = _new(family, checked, texts, version)
    else:
        content, ids = _put_in(into, stage, family, checked, texts)
    made = _report(family, checked, symbols, texts, refused, ids)
    return Written(_remarked(content, checked, made["unmapped"]), made)


def _remarked(content, checked, unmapped):
    """The file's bytes with a remark on the keys that the design gives and the file does not hold; those stay that a
    design of the file once had.
    """
    document = parsed(content, "the file")
    keys = [entry["key"] for entry in unmapped if "key" in entry]
    before = left_out(document)
    values = before | named_in(checked, keys)
    if values == before:
        return content
    text = remark(values)
    place = (*document.remark, text.encode()) if document.remark else insertion(document, document.root, [text])
    return spliced(content, [place])


def _solved(tables, family, symbols):
    """The symbols with those that rules leave open and the drive itself finds."""
    if not any(math.isnan(symbols[name]) for name in family.exchange["solved"]):
        return symbols
    design = designs.check(tables)
    found = zip(design.description["parameters"], design.parameters, strict=True)
    return symbols | {p["name"]: float(number) for p, number in found}


def _texts(family, checked, symbols):
    """{component name: {attribute: :class:`Text`}}, and (spec, reason) of what cannot be written."""
    texts, refused = {}, []
    for spec in family.exchange["attributes"]:
        if spec["given"] and not any(_given(checked, key) for key in spec["keys"]):
            continue
        shown = _shown(spec, symbols)
        if shown is None:
            continue
        numbers = shown if isinstance(shown, tuple) else (shown,)
        if reasons := list(filter(None, (values.out_of_range(spec, x) for x in numbers))):
            refused.append((spec, f"REXS does not allow {numbers[0]!r}: it {reasons[0]}"))
        else:
            texts.setdefault(spec["component"], {})[spec["attribute"]] = Text(spec, shown)
    for spec in family.exchange["words"]:
        word = words_of(family, checked)[spec["key"]]
        if word in spec["words"]:
            texts.setdefault(spec["component"], {})[spec["attribute"]] = Text(spec, spec["words"][word])
        else:
            refused.append((spec, f"REXS has no word for {word!r}: it has those for {', '.join(spec['words'])}"))
    return texts, refused


def _shown(spec, symbols):
    """An attribute's number or numbers in its unit; None where the design leaves it open."""
    known = _Open(symbols)
    if spec["type"].endswith("_array"):
        entries = tuple(values.in_unit(spec, value(e, known)) for e in spec["value"])
        return None if any(map(math.isnan, entries)) else entries
    number = value(spec["value"], known)
    return None if math.isnan(number) else values.in_unit(spec, number)


class _Open(dict):
    """Numbers by symbol; a parameter that the drive does not have is open."""

    def __missing__(self, symbol):
        return math.nan


def _held(spec):
    """The keys that an attribute holds."""
    return spec.get("keys") or [full(spec["key"])]


def _given(checked, key):
    table, _, name = key.rpartition(".")
    return checked.get(table, {}).get(name) is not None


# -- a new file ------------------------------------------------------------------------------------------------------


def _new(family, checked, texts, version):
    table = family.exchange
    listed = _written_components(table, texts, set())
    ids = {c["name"]: str(n) for n, c in enumerate(listed, 1)}
    relations = [r for r in table["relations"] if all(name in ids for _, name in r["refs"])]
    lines = ['<?xml version="1.0" encoding="UTF-8"?>']
    lines += [f'<model xmlns="{NAMESPACE}" version="{VERSION}" applicationId="meshwright" '
              f'applicationVersion={quoteattr(version)} date="{_date()}">', "  <relations>"]  # fmt: skip
    lines += [_relation(r, n, ids, "    ") for n, r in enumerate(relations, 1)]
    lines += ["  </relations>", "  <components>"]
    lines += [_component(c, ids, checked, texts, "    ") for c in listed]
    lines += ["  </components>", "</model>", ""]
    return "\n".join(lines).encode("utf-8"), {name: (ident, _kind(table, name)) for name, ident in ids.items()}


def _date():
    """Now, or at the instant that SOURCE_DATE_EPOCH names (reproducible-builds.org), in UTC."""
    seconds = int(os.environ.get("SOURCE_DATE_EPOCH", time.time()))
    return datetime.fromtimestamp(seconds, UTC).isoformat()


def _written_components(table, texts, present):
    """Components with attributes of their own, and those that belong beside one that is written or in the file."""
    with_attributes = {c["name"] for c in table["components"] if c["name"] in texts} | present
    return [c for c in table["components"] if c["name"] in with_attributes or c["beside"] in with_attributes]


def _relation(relation, number, ids, indent):
    order = ' order="1"' if relation["order"] else ""
    refs = "".join(f'\n{indent}  <ref id="{ids[name]}" role="{role}"/>' for role, name in relation["refs"])
    return f'{indent}<relation id="{number}" type="{relation["type"]}"{order}>{refs}\n{indent}</relation>'


def _component(component, ids, checked, texts, indent):
    name = checked.get("name") if component["name"] == "stage" else ""
    named = f" name={quoteattr(name)}" if name else ""
    head = f'{indent}<component id="{ids[component["name"]]}" type="{component["type"]}"{named}'
    attributes = texts.get(component["name"], {})
    if not attributes:
        return head + "/>"
    inner = "".join(f"\n{indent}  {text.element()}" for text in attributes.values())
    return f"{head}>{inner}\n{indent}</component>"


def _kind(table, name):
    return next(c["type"] for c in table["components"] if c["name"] == name)


# -- into the file that the design came from ------------------------------------------------------------------------


def _put_in(document, stage, family, checked, texts):
    """The document's bytes with the design's sizes, and (id, type) of components by name."""
    table = family.exchange
    found_family, stage = stage_of(document, stage)
    if found_family != family.name:
        raise UsageError(f"{document.place}: {stage} is of {found_family}, the design of {family.name}")
    found = bound(document, table, stage)
    edits = []
    for name, component in found.items():
        for text in texts.get(name, {}).values():
            edits += _edit(document, component, text, checked)
    ids = {name: component.id for name, component in found.items()}
    edits += _additions(document, table, found, ids, checked, texts)
    kinds = {c["name"]: c["type"] for c in table["components"]}
    return spliced(document.source, edits), {name: (ident, kinds[name]) for name, ident in ids.items()}


def _edit(document, component, text, checked):
    """The edits that make an attribute of the file hold the design's value; none where it holds it already."""
    spec, element = text.spec, component.attributes.get(text.spec["attribute"])
    if element is None:
        if not any(_given(checked, key) for key in _held(spec)):
            return []
        return [insertion(document, component.element, [text.element()])]
    if _holds(document, component, text):
        return []
    if element.inner is None:
        return [(element.start, element.end, text.element().encode())]
    return [(element.inner, element.outer, text.content.encode())]


def _holds(document, component, text):
    """Whether the file's value is the design's, to the last digits but those of a conversion."""
    spec = text.spec
    if isinstance(text.value, str):
        return values.word(document.place, component, spec) == next(
            ours for ours, theirs in spec["words"].items() if theirs == text.value
        )
    here = values.number(document.place, component, spec)
    if isinstance(text.value, tuple):
        return not spec["agrees"] or here == text.value
    return abs(here / values.FACTORS[spec["unit"]] - text.value) <= 1e-13 * max(1.0, abs(text.value))


def insertion(document, element, parts):
    """The edit that adds elements at the end of an element's content."""
    source = document.source
    line = source.rfind(b"\n", 0, element.start) + 1
    indent = source[line : element.start].decode() if not source[line : element.start].strip() else ""
    inner = "".join(f"\n{indent}  {part}" for part in parts)
    if element.inner is None:
        tag = source[element.start : element.end - 2].rstrip().decode()
        name = tag[1:].split(maxsplit=1)[0]
        return (element.start, element.end, f"{tag}>{inner}\n{indent}</{name}>".encode())
    end = len(source[: element.outer].rstrip())
    return (end, end, inner.encode())


def _additions(document, table, found, ids, checked, texts):
    """Components that the file does not have and the design needs, with their relations; ``ids`` gains them."""
    needed = {name for name, entries in texts.items() if name not in found
              and any(_given(checked, key) for t in entries.values() for key in t.spec.get("keys", []))}  # fmt: skip
    new = [c for c in table["components"] if c["name"] not in found
           and (c["name"] in needed or c["beside"] in needed)]  # fmt: skip
    if not new:
        return []
    number = max((int(i) for i in document.components if i.isdecimal()), default=0)
    ids |= {c["name"]: str(number + k) for k, c in enumerate(new, 1)}
    added = {c["name"] for c in new}
    relations = [r for r in table["relations"] if added & {n for _, n in r["refs"]}
                 and all(n in ids for _, n in r["refs"])]  # fmt: skip
    last = max((int(r.id) for r in document.relations if r.id.isdecimal()), default=0)
    sections = {child.tag: child for child in document.root.children}
    return [
        insertion(document, sections["components"], [_component(c, ids, checked, texts, "    ").strip() for c in new]),
        insertion(document, sections["relations"],
                   [_relation(r, last + k, ids, "    ").strip() for k, r in enumerate(relations, 1)]),
    ]  # fmt: skip


# -- the report ------------------------------------------------------------------------------------------------------


def _report(family, checked, symbols, texts, refused, ids):
    mapped = []
    for name, entries in texts.items():
        if name in ids:
            ident, kind = ids[name]
            mapped += [
                {"key": key, "component": kind, "id": ident, "attribute": attribute}
                for attribute, text in entries.items()
                for key in _held(text.spec)
            ]
    held = {entry["key"] for entry in mapped}
    absent = family.exchange["absent"]
    keys = [place(table, key) for table, entries in checked.items() if isinstance(entries, dict)
            for key, number in entries.items() if number is not None]  # fmt: skip
    unmapped = [{"key": key, "attribute": None, "reason": absent.get(key, "REXS has no attribute for it")}
                for key in ["flank", *keys] if key not in held]  # fmt: skip
    kinds = {c["name"]: c["type"] for c in family.exchange["components"]}
    unmapped += [{"component": kinds[spec["component"]], "attribute": spec["attribute"], "reason": reason}
                 for spec, reason in refused]  # fmt: skip
    return report(mapped, unmapped, assumed_of(family, checked, symbols, mapped, defaults=False))
