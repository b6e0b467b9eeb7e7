"""A design from a REXS file, with a report of what was mapped, what was not, and what was assumed."""

import math
from dataclasses import dataclass

from meshwright.base.errors import DesignError
from meshwright.base.expression import completed, value
from meshwright.design import description as metadata
from meshwright.design import design as designs
from meshwright.rexs import values
from meshwright.rexs.document import RexsError
from meshwright.rexs.left_out import left_out, reported
from meshwright.rexs.places import bound, exchanges, stage_of
from meshwright.rexs.report import assumed_of, full, report, words_of

#: Redundant sizes agree to this, relative, or of a unit (mm, degree, 1) where they are smaller.
AGREEMENT = 1e-6

#: A key that rules give anyway agrees with them to this.
SAME = 1e-12


@dataclass(frozen=True)
class Read:
    """What a file says of a design: raw tables and the report."""

    tables: dict
    report: dict


@dataclass(frozen=True)
class Found:
    """What stands in the file for a family: components by name, numbers by symbol, words by key."""

    family: metadata.Family
    components: dict
    numbers: dict
    words: dict


def design_of(document, stage=None):
    """The design of a file's stage, as :class:`Read`; raises :class:`RexsError`."""
    name, component = stage_of(document, stage)
    family, table = metadata.families()[name], exchanges()[name]
    found = _found(document, family, bound(document, table, component))
    read, doubts = _read(family, found.numbers)
    words, others = _chosen_words(found)
    hand = {"hand": "left" if read["hand"] < 0 else "right"} if family.handed and "hand" in read else {}
    tables = _tables(family, component.name, read, words | hand)
    _check_complete(document, family, found, tables)
    try:
        _, symbols = designs.by_rules(tables)
    except DesignError as error:
        raise _at_attribute(document, table, found, error) from error
    _check_agreement(document, table, found, symbols | {"hand": read.get("hand", 1.0)})
    return Read(tables, _report(document, table, found, tables, symbols, doubts + others))


def _found(document, family, components):
    numbers, words = {}, {}
    for spec in family.exchange["attributes"]:
        component = components.get(spec["component"])
        number = component and values.number(document.place, component, spec)
        if number is not None:
            symbol = f"{spec['component']}.{spec['attribute']}"
            array = enumerate(number) if isinstance(number, tuple) else ()
            numbers |= {f"{symbol}.{k}": x for k, x in array} or {symbol: number}
    for spec in family.exchange["words"]:
        component = components.get(spec["component"])
        word = component and values.word(document.place, component, spec)
        if word:
            words.setdefault(spec["key"], []).append((spec, component, word))
    return Found(family, components, numbers, words)


class _Open(dict):
    """Numbers by symbol; what is not known is open."""

    def __missing__(self, symbol):
        return math.nan


def _read(family, numbers):
    """Parameters by symbol as readings give them, and (symbol, taken, left) of those that readings disagree on.

    What a reading needs and no reading gives is what the design's rules give.
    """
    table = family.exchange
    read, doubts, overrides = {}, [], set()
    known = _Open(numbers)
    for _ in range(3):
        for reading in table["readings"]:
            symbol = reading["symbol"]
            number = value(reading["value"], known)
            if math.isnan(number):
                continue
            if symbol not in read:
                read[symbol] = known[symbol] = number
                overrides |= {symbol} if reading["override"] else set()
            elif abs(number - read[symbol]) > table["doubtful"].get(symbol, math.inf):
                doubts.append((symbol, read[symbol], number))
        known = _Open(_by_rules(family, read) | numbers)
    for symbol in overrides:
        by_rule = _by_rules(family, {other: number for other, number in read.items() if other != symbol})[symbol]
        if abs(by_rule - read[symbol]) <= SAME * abs(read[symbol]):
            del read[symbol]
    return read, list(dict.fromkeys(doubts))


def _by_rules(family, read):
    """Parameters by symbol, those that were read completed by the design's rules."""
    return completed(family.exchange["rules"], {p["name"]: math.nan for p in family.parameters} | read)


def _chosen_words(found):
    """Words of the design by key, and what to report of them: contradictions, and what an absence means."""
    chosen, others = {}, []
    for key, entries in found.words.items():
        chosen[key] = entries[0][2]
        for spec, component, word in entries[1:]:
            if word != chosen[key]:
                where = f"{component}, {spec['attribute']}"
                others.append({"key": full(key), "value": word, "reason": f"{where}: not taken"})
    for w in found.family.exchange["without"]:
        component = found.components.get(w["component"])
        if component and w["attribute"] not in component.attributes:
            chosen[w["key"]] = w["word"]
            others.append({"key": full(w["key"]), "value": w["word"], "reason": w["reason"]})
    return chosen, others


def _tables(family, name, read, words):
    """Raw tables: each key that was read, one of each exclusive group, in the order of the family's keys."""
    table = family.exchange
    keys = {p["key"]: p for p in family.parameters if p["table"] == "design"}
    dropped = set()
    for group in table["exclusive"]:
        given = [key for key in group if keys[key]["name"] in read]
        dropped |= set(given[1:])
    unused = family.unused(words)
    tables = {"drive": family.name}
    if name and len(name) <= 200 and name.isprintable():
        tables["name"] = name
    tables["flank"] = next(iter(next(p for p in family.parameters if p["table"] == "flank")["choices"]))
    for p in family.parameters:
        left_out = p["table"] == "design" and p["key"] in dropped or f"{p['table']}.{p['key']}" in unused
        if p["name"] in read and not left_out:
            tables.setdefault(p["table"], {})[p["key"]] = _in_key_unit(p, read[p["name"]])
    for place, word in words.items():
        table_name, key = metadata.table_and_key(place)
        tables.setdefault(table_name, {})[key] = word
    return tables


def _in_key_unit(p, number):
    shown = values.converted(number, p["factor"])
    return round(shown) if p["integer"] else shown


def _check_complete(document, family, found, tables):
    """Every key that the design cannot do without is in the file."""
    needed = (f"{p['table']}.{p['key']}" for p in _needed(family, tables))
    missing = [place for place in needed if not _has(tables, place)]
    groups = [[f"design.{key}" for key in group] for group in family.exchange["exclusive"]]
    missing_groups = [group for group in groups if not any(_has(tables, place) for place in group)]
    missing_words = [
        [full(place)] for place in family.choosing
        if place not in family.variant_defaults and not _has(tables, full(place))
    ]  # fmt: skip
    for places in ([place] for place in missing), missing_groups, missing_words:
        for keys in places:
            raise _absent(document, found, keys)


def _needed(family, tables):
    drive = family.chosen(words_of(family, tables))
    listed = family.listed[drive] if drive else family.parameters
    return [p for p in listed if p["required"] and p["table"] != "flank"]


def _has(tables, place):
    table, _, key = place.rpartition(".")
    return key in tables.get(table, {})


def _absent(document, found, keys):
    """The error for keys of which the file has none."""
    table = found.family.exchange
    specs = [s for s in table["attributes"] if set(s["keys"]) & set(keys)]
    specs += [s for s in table["words"] if full(s["key"]) in keys]
    kinds = {c["name"]: c["type"] for c in table["components"]}
    here = [s for s in specs if s["component"] in found.components] or specs
    spec = here[0]
    place = found.components.get(spec["component"]) or f"component {kinds[spec['component']]}"
    names = " or ".join(dict.fromkeys(s["attribute"] for s in here if s["component"] == spec["component"]))
    return RexsError(
        f"{document.place}, {place}, attribute {names}", f"missing: it gives {' or '.join(keys)}", "add it"
    )


def _at_attribute(document, table, found, error):
    """A design's error at the attribute that its key was read from."""
    specs = [s for s in table["attributes"] if error.key in s["keys"] and s["component"] in found.components
             and s["attribute"] in found.components[s["component"]].attributes]  # fmt: skip
    where = f"{found.components[specs[0]['component']]}, attribute {specs[0]['attribute']}, " if specs else ""
    return RexsError(f"{document.place}, {where}{error.key}", f"{error.value}: {error.reason}", error.remedy)


def _check_agreement(document, table, found, symbols):
    """Every attribute is what the design, complete, has there."""
    for spec in table["attributes"]:
        number = found.numbers.get(f"{spec['component']}.{spec['attribute']}")
        if number is None or not spec["agrees"]:
            continue
        factor = values.FACTORS[spec["unit"]]
        given, follows = number / factor, value(spec["value"], symbols) / factor
        if not abs(given - follows) <= AGREEMENT * max(1.0, abs(given)) and not math.isnan(follows):
            raise RexsError(
                f"{document.place}, {found.components[spec['component']]}, attribute {spec['attribute']}",
                f"= {given!r} contradicts the other attributes, from which {follows!r} follows",
                f"correct it, or those of {', '.join(spec['keys'])}",
            )


def _report(document, table, found, tables, symbols, doubts):
    mapped, seen, unused = [], set(), found.family.unused(words_of(found.family, tables))
    for spec in (*table["attributes"], *table["words"]):
        component = found.components.get(spec["component"])
        if component is None or spec["attribute"] not in component.attributes:
            continue
        keys = spec.get("keys") or [full(spec["key"])]
        for key in (key for key in keys if key not in unused):
            mapped.append({"key": key, "component": component.type, "id": component.id, "attribute": spec["attribute"]})
            seen.add((component.id, spec["attribute"]))
    unmapped = [
        {"component": c.type, "id": c.id, "attribute": name, "reason": _why_not(table, found, c, name)}
        for c in document.components.values() for name in c.attributes if (c.id, name) not in seen
    ]  # fmt: skip
    unmapped += [
        {"component": _kind_of(document, owner), "id": owner.attributes.get("id"),
         "attribute": element.attributes.get("id"), "reason": f"under {', '.join(path)}: no part of a design"}
        for owner, element, path in document.elsewhere()
    ]  # fmt: skip
    unmapped += reported(found.family, left_out(document), tables)
    unmapped += [{"component": c.type, "id": c.id, "attribute": None, "reason": "not of the stage that was read"}
                 for c in document.components.values() if c not in found.components.values()]  # fmt: skip
    doubtful = [entry if isinstance(entry, dict) else _doubt(found.family, entry) for entry in doubts]
    return report(mapped, unmapped, doubtful + assumed_of(found.family, tables, symbols, mapped, defaults=True))


def _kind_of(document, owner):
    """The type of the component that an element is or refers to, else its tag."""
    component = document.components.get(owner.attributes.get("id")) if owner.tag == "component" else None
    return owner.attributes.get("type") or (component.type if component else owner.tag)


def _why_not(table, found, component, name):
    if component not in found.components.values():
        return "its component is not of the stage that was read"
    kinds = {c["name"] for c in table["components"] if found.components.get(c["name"]) is component}
    if any(s["component"] in kinds and s["attribute"] == name for s in (*table["attributes"], *table["words"])):
        return "the design has no use for it"
    return "the design has no key for it"


def _doubt(family, entry):
    symbol, taken, left = entry
    p = next(p for p in family.parameters if p["name"] == symbol)
    return {
        "key": f"{p['table']}.{p['key']}", "value": values.converted(taken, p["factor"]),
        "reason": f"two ways of deriving it differ; {values.converted(left, p['factor'])!r} is not taken",
    }  # fmt: skip
