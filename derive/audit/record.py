"""The whole record: which chapters there are, and the ledger built from them."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cache

from derive.audit import store
from derive.audit.documents import face_worm, rack_and_pinion, recess_action, spherical, zk_zn
from derive.audit.guarded import by_family
from derive.audit.identities import bevel as bevel_gears
from derive.audit.identities import conventions, cylindrical_gears, cylindrical_worm, derivation, helicoids
from derive.audit.identities import face_worm as face_worm_drives
from derive.audit.identities import spherical as spherical_gears
from derive.audit.ledger import Chapter, Ledger, build


def chapters() -> list[Chapter]:
    """Sources in reading order, then our own identities."""
    sources = (recess_action, rack_and_pinion, zk_zn, spherical, face_worm)
    identities = (
        conventions, derivation, helicoids, cylindrical_worm, spherical_gears, cylindrical_gears, face_worm_drives,
        bevel_gears,
    )  # fmt: skip
    return [module.CHAPTER for module in (*sources, *identities)]


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
    found = re.finditer(r"/\* Equations: ([^*]*(?:\*[^/][^*]*)*)\. \*/\nstatic inline \w+ (\w+)\(", header)
    return {match[2]: [key.strip(" *\n") for key in match[1].split(",")] for match in found}
