"""The whole record: which chapters there are, and the ledger built from them."""

import re
from collections.abc import Collection, Mapping
from functools import cache
from importlib import import_module

from derive.audit import store
from derive.audit.claims import Document
from derive.audit.guarded import by_family
from derive.audit.ledger import Chapter, Ledger, build

#: Document → module of its chapter: sources in reading order, then our own identities.
CHAPTERS = {
    "recess-action": "documents.recess_action",
    "rack-and-pinion": "documents.rack_and_pinion",
    "zk-zn": "documents.zk_zn",
    "spherical": "documents.spherical",
    "face-worm": "documents.face_worm",
    "conventions": "identities.conventions",
    "derivation": "identities.derivation",
    "helicoids": "identities.helicoids",
    "cylindrical_worm": "identities.cylindrical_worm",
    "spherical_gears": "identities.spherical",
    "cylindrical_gears": "identities.cylindrical_gears",
    "internal_gears": "identities.internal_gears",
    "face_worm": "identities.face_worm",
    "bevel": "identities.bevel",
}


def chapters(keys: Collection[str] = CHAPTERS) -> list[Chapter]:
    """The chapters of these documents, by default of all, in reading order."""
    return [_chapter(key) for key in CHAPTERS if key in keys]


def _chapter(key: str) -> Chapter:
    """A chapter; one whose own words cannot be read of today's descriptions has no claims, and says why."""
    try:
        return import_module(f"derive.audit.{CHAPTERS[key]}").CHAPTER
    except Exception as error:  # noqa: BLE001  whatever a description holds now where the chapter read something else
        words = f"{type(error).__name__}: {error}"
        return Chapter(Document(key, key, f"derive/audit/{CHAPTERS[key].replace('.', '/')}", "", words), (), words)


@cache
def ledger() -> Ledger:
    """The record, built once a process."""
    return build(chapters())


def files(record: Ledger, generated: Mapping[str, str]) -> dict[str, str]:
    """Relative path -> text of everything under audit/. `generated` are the other files, sealed as well."""
    from derive.audit.pages import pages  # with SymPy, which the record does without

    functions = {path: functions_of(text) for path, text in sorted(generated.items()) if path.endswith(".h")}
    used = {path: table for path, table in functions.items() if table}
    texts = store.record_files(record) | pages(record, chapters(), used, by_family(generated), generated)
    written = {f"audit/{name}": text for name, text in texts.items()}
    return {**written, "audit/artifacts.json": store.seal(record, {**generated, **written})}


def functions_of(header: str) -> dict[str, list[str]]:
    """Function name -> equation ids, from the comments of a generated header."""
    stated = r"/\* Equations: ([^*]*(?:\*[^/][^*]*)*)\. \*/\n"
    found = re.finditer(stated + r"(?:MW_DEVICE )?static inline \w+ (\w+)\(", header)
    return {match[2]: [key.strip(" *\n") for key in match[1].split(",")] for match in found}
