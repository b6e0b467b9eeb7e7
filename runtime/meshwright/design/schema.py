"""What a design file may say: its tables and keys, made from the generated descriptions.

One list of keys is the source of the check of a file, of the JSON Schema and of ``meshwright drives``.
"""

import math
import numbers
import re
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Any

from meshwright.base.errors import DesignError
from meshwright.design import description as metadata
from meshwright.design.relations import Drawing

HANDS = ("right", "left")

#: Magnitudes beyond which a number of a design, in the unit of its key, is taken for a mistake: nothing that is made
#: or measured reaches them, and beyond them double precision no longer resolves a contact.
LARGEST = {"mm": 1e9, "um": 1e6, "deg": 360.0, "": 1e5}

#: Largest length of the table [contact], mm: what lies between flanks that touch, or all but touch. Beyond it flanks
#: are no paraboloids any more, and what is drawn of a separation, such as the ellipse, is no contact.
LARGEST_GAP = 1.0

#: Keys of a table that an error about another one names, most.
FEW = 12

#: Longest name of a design, and what it must not hold.
LONGEST_NAME = 200
CONTROLS = r"\x00-\x1f\x7f-\x9f\u2028-\u202e\u2066-\u2069"

#: Name of a comparison that a number must pass → its reason where it fails, the remedy, its word in JSON Schema.
COMPARISONS = {
    "gt": ("must be greater than", "choose a larger value", "exclusiveMinimum"),
    "ge": ("must not be less than", "choose a larger value", "minimum"),
    "lt": ("must be less than", "choose a smaller value", "exclusiveMaximum"),
    "le": ("must not be greater than", "choose a smaller value", "maximum"),
}


@dataclass(frozen=True)
class Key:
    """One key: ``kind`` is "number", "integer", "word" (one of ``words``), "text" or "places" (a list of "table.key").

    ``bounds`` of a number in the unit of its key, by the name of the comparison that holds: ``{"gt": 0.0}``. A key that
    is not ``required`` has a ``default``, None where it is left open.
    """

    kind: str
    meaning: str = ""
    required: bool = False
    default: str | int | tuple[str, ...] | None = None
    bounds: dict[str, float] = field(default_factory=dict)
    words: tuple[str, ...] = ()

    def checked(self, place: str, value: object) -> float | int | str | list[str] | None:
        """The value, a number as Python's own; raises :class:`~meshwright.base.errors.DesignError` naming ``place``."""
        if value is None and not self.required and self.default is None:
            return None
        match self.kind:
            case "word":
                return _word(place, value, self.words)
            case "text":
                return _name(place, value)
            case "places":
                return _places(place, value)
            case "integer":
                return self._bounded(place, value, _whole(place, value))
            case _:
                return self._bounded(place, value, _real(place, value))

    def _bounded(self, place: str, given: object, number: float) -> float:
        for comparison, bound in self.bounds.items():
            if not _COMPARED[comparison](number, bound):
                reason, remedy, _ = COMPARISONS[comparison]
                raise DesignError(place, given, f"{reason} {bound:g}", remedy)
        return number

    def json_schema(self) -> dict[str, object]:
        """The key as JSON Schema; one that may be left open may be null."""
        opened = not self.required and self.default is None
        if self.kind == "word":
            schema: dict[str, object] = {"enum": [*self.words, *([None] if opened else [])]}
        elif self.kind == "places":
            schema = {"type": "array", "items": {"type": "string"}}
        else:
            kind = "string" if self.kind == "text" else self.kind
            schema = {"type": [kind, "null"] if opened else kind}
        schema |= {COMPARISONS[comparison][2]: bound for comparison, bound in self.bounds.items()}
        if self.kind == "text":
            schema |= {"maxLength": LONGEST_NAME, "pattern": f"^[^{CONTROLS}]*$"}
        return schema | ({"description": self.meaning} if self.meaning else {}) | (
            {} if self.required else {"default": self.default}
        )  # fmt: skip


_COMPARED = {
    "gt": lambda number, bound: number > bound,
    "ge": lambda number, bound: number >= bound,
    "lt": lambda number, bound: number < bound,
    "le": lambda number, bound: number <= bound,
}


def _real(place: str, value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise DesignError(place, value, "must be a number", "write a number without quotes")
    try:
        number = float(value)
    except OverflowError:  # a whole number of more than three hundred digits
        number = math.copysign(1e308, 1.0 if value >= 0 else -1.0)  # type: ignore[operator]
    if not math.isfinite(number):
        raise DesignError(place, value, "not a finite number", "give a finite number")
    return number


def _whole(place: str, value: object) -> int:
    if isinstance(value, bool) or not isinstance(value, numbers.Integral):
        point = isinstance(value, float)
        remedy = "write it without a decimal point" if point else "write a whole number without quotes"
        raise DesignError(place, value, "must be a whole number", remedy)
    return int(value)


def _word(place: str, value: object, words: tuple[str, ...]) -> str:
    if not isinstance(value, str) or value not in words:
        *most, last = map(repr, words)
        listed = f"{', '.join(most)} or {last}" if most else last
        raise DesignError(place, value, "not one of the possible words", f"use {listed}")
    return value


def _places(place: str, value: object) -> list[str]:
    if not isinstance(value, list | tuple) or not all(isinstance(entry, str) for entry in value):
        raise DesignError(place, value, "must be a list of keys", 'write ["design.key", …]')
    return [*value]


def _name(place: str, value: object) -> str:
    if not isinstance(value, str):
        raise DesignError(place, value, "must be text", "write it in quotes")
    if len(value) > LONGEST_NAME:
        raise DesignError(place, value, f"longer than {LONGEST_NAME} letters", "choose a shorter name")
    if re.search(f"[{CONTROLS}]", value):
        raise DesignError(place, value, "holds control characters", "write letters, digits and blanks")
    return value


@dataclass(frozen=True)
class Form:
    """What a design file of a family may say: its ``loose`` keys, the keys of each of its ``tables``, and by table what
    a drawing may give beside and instead of them (``drawn``), from which they follow.
    """

    loose: dict[str, Key]
    tables: dict[str, dict[str, Key]]
    drawn: dict[str, dict[str, Key]]

    def needed(self, table: str) -> bool:
        """Whether a table must be there: it has a required key."""
        return any(key.required for key in self.tables[table].values())


def _parameter(parameter: dict) -> Key:
    """The key of a parameter: a choice of words, or a number with bounds in the key's own unit."""
    meaning, required = parameter["meaning"], parameter["required"]
    if parameter["choices"]:
        return Key("word", meaning, required, words=tuple(parameter["choices"]))
    return Key("integer" if parameter["integer"] else "number", meaning, required, bounds=bounds(parameter))


def bounds(parameter: dict) -> dict[str, float]:
    """Bounds of a number in the unit of its key, by the name of the comparison that holds: ``{"gt": 0.0}``.

    Where the description leaves an end open, it is that of :data:`LARGEST`, or :data:`LARGEST_GAP`.
    """
    gap = parameter["table"] == "contact" and parameter["key_unit"] == "mm"
    largest = LARGEST_GAP if gap else LARGEST.get(parameter["key_unit"], 1e6)
    found = {"le": largest} | ({"ge": -largest} if parameter["lower"] is None else {})
    if parameter["lower"] is not None:
        found["ge" if parameter["lower_included"] else "gt"] = parameter["lower"] / parameter["factor"]
    if parameter["upper"] is not None:
        found["lt"] = parameter["upper"] / parameter["factor"]
        del found["le"]
    return found


def _material_keys() -> dict[str, Key]:
    """Elastic constants of both members, or of one; what is left out is that of both, or steel."""
    return {
        f"{key}{ending}": Key("number", f"{meaning}{of}", bounds=limits)
        for key, limits, meaning in (
            ("youngs_modulus_mpa", {"gt": 0.0}, "Young's modulus"),
            ("poisson_ratio", {"gt": -1.0, "lt": 0.5}, "Poisson's ratio"),
        )
        for ending, of in (("", " of both members"), ("_pinion", " of the pinion"), ("_wheel", " of the wheel"))
    }


def _variant_keys(family: metadata.Family) -> Iterator[tuple[str, str, Key]]:
    """Table, key and :class:`Key` of the words and numbers that choose the drive within the family."""
    words: dict[str, dict[str, None]] = {}
    meanings = {metadata.table_and_key(place): "" for place in family.choosing}
    meanings |= {(p["table"], p["key"]): p["meaning"] for p in family.parameters}
    for variant in family.variants.values():
        for place, allowed in variant.items():
            if isinstance(allowed, list):
                words.setdefault(place, {}).update(dict.fromkeys(allowed))
    for place in family.choosing:
        if place not in words:
            at = metadata.table_and_key(place)
            limits = {"ge": min(variant[place]["least"] for variant in family.variants.values()), "le": LARGEST[""]}
            yield *at, Key("integer", meanings[at], default=family.variant_defaults[place], bounds=limits)
    for place, allowed in words.items():
        required = place not in family.variant_defaults
        default = family.variant_defaults.get(place)
        follows = default in words  # the word of another key, filled in later
        yield *metadata.table_and_key(place), Key(
            "word", required=required, default=None if follows else default, words=tuple(allowed)
        )


def form(family: str, places: tuple | None = None) -> Form:
    """The :class:`Form` of a family's design files; ``places`` are the folders of drives that are searched."""
    return _form(metadata.families(places)[family])


@cache
def _form(family: metadata.Family) -> Form:
    tables: dict[str, dict[str, Key]] = {}
    for parameter in family.parameters:
        if parameter["table"] != "flank":
            tables.setdefault(parameter["table"], {})[parameter["key"]] = _parameter(parameter)
    for table, key, choice in _variant_keys(family):
        tables[table][key] = choice
    if family.handed:
        tables["design"]["hand"] = Key("word", default=family.handed, words=HANDS)
    tables["material"] = _material_keys()
    flanks = tuple(next(p for p in family.parameters if p["table"] == "flank")["choices"])
    loose = {
        "drive": Key("word", required=True, words=(family.name,)),
        "name": Key("text", default=""),
        "flank": Key("word", default=flanks[0], words=flanks),
        "assumed": Key("places", "keys whose values were proposed, not given", default=()),
    }
    drawn: dict[str, dict[str, Key]] = {}
    for size in family.drawing.table["sizes"]:
        if f"{size['table']}.{size['key']}" not in family.drawing.beside:
            continue
        drawn.setdefault(size["table"], {})[size["key"]] = _parameter(size)
    return Form(loose, {"design": tables.pop("design"), **tables}, drawn)


def checked(family: str, tables: dict, places: tuple | None = None) -> dict:
    """The tables with every key of the family, each checked by itself; None where one is left open.

    Raises :class:`~meshwright.base.errors.DesignError` for the first thing wrong with them. A misspelt key is what the
    missing one was meant to be: it is named first.
    """
    known = form(family, places)
    for table, keys in known.tables.items():
        if isinstance(entries := tables.get(table), dict):
            _refuse_unknown(entries, keys, f"{table}.", known)
    _refuse_unknown(tables, known.loose | known.tables, "", known)
    checked_tables: dict[str, Any] = {name: _given(tables, name, name, key) for name, key in known.loose.items()}
    for table, keys in known.tables.items():
        if table not in tables and known.needed(table):
            raise DesignError(table, None, "the key is missing", "add it to the design")
        entries = tables.get(table, {})
        if not isinstance(entries, dict):
            raise DesignError(table, entries, "must be a table", f"write its keys below [{table}]")
        checked_tables[table] = {name: _given(entries, name, f"{table}.{name}", key) for name, key in keys.items()}
    for place in checked_tables["assumed"]:
        table, _, name = place.rpartition(".")
        if not isinstance(entries := tables.get(table), dict) or name not in entries:
            raise DesignError("assumed", place, "no key that the design gives", "leave it out of the list")
    return checked_tables


def drawn(family: str, tables: dict, places: tuple | None = None) -> dict[str, object]:
    """What raw tables give of the sizes of a drawing, by "table.key", each checked by itself: see :func:`checked`."""
    known, drawing = form(family, places), metadata.families(places)[family].drawing
    found: dict[str, object] = {}
    stated = [name for name in known.loose if f"{name}.{name}" in drawing.places and name in tables]
    alone = {name: {name: tables[name]} for name in stated}
    for table, entries in (tables | alone).items():
        for name, value in entries.items() if isinstance(entries, dict) else ():
            place = f"{table}.{name}"
            listed = {table: known.loose} if table in alone else known.tables
            key = listed.get(table, {}).get(name) or known.drawn.get(table, {}).get(name)
            if value is None or not (place in drawing.places or (key is None and drawing.converted(place))):
                continue
            number = (key or Key("number", bounds={"gt": 0.0, "le": LARGEST["mm"]})).checked(place, value)
            found |= {} if number is None else {place: number}
    return found


def _refuse_unknown(entries: dict, known: dict, before: str, whole: Form) -> None:
    for name, value in entries.items():
        if name not in known:
            import difflib

            near = [f"{table}.{name}" for table, keys in whole.tables.items() if name in keys]
            near = near or difflib.get_close_matches(str(name), known, n=1)
            remedy = f"did you mean {near[0]!r}?" if near else "remove it;"
            if len(known) <= FEW:
                remedy += f" {f'[{before[:-1]}]' if before else 'a design'} has {', '.join(known)}"
            elif not near:
                remedy += " `meshwright drives` lists the keys"
            raise DesignError(f"{before}{name}", value, "unknown key", remedy)


def _given(entries: dict, name: str, place: str, key: Key) -> object:
    """The checked value of a key, its default where it is left out."""
    if name in entries:
        return key.checked(place, entries[name])
    if key.required:
        raise DesignError(place, None, "the key is missing", "add it to the design")
    return key.default


def json_schema() -> dict[str, object]:
    """JSON Schema of every family's design file."""
    schemas = {name: _family_schema(form(name), family.drawing) for name, family in metadata.families().items()}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "meshwright design",
        "oneOf": [{"$ref": f"#/$defs/{family}"} for family in schemas],
        "$defs": schemas,
    }


def _family_schema(known: Form, drawing: Drawing) -> dict[str, object]:
    named = {place for place, p in drawing.places.items() if p["name"] in drawing.follow}
    tables = {
        name: _object({
            key: replace(entry, required=entry.required and f"{name}.{key}" not in named) for key, entry in keys.items()
        } | known.drawn.get(name, {})) for name, keys in known.tables.items()
    }  # fmt: skip
    whole = _object(known.loose)
    properties = {name: key.json_schema() for name, key in known.loose.items()} | tables
    required = [*whole.get("required", []), *(name for name, table in tables.items() if "required" in table)]
    return whole | {"properties": properties, "required": required}


def _object(keys: dict[str, Key]) -> dict:
    required = [name for name, key in keys.items() if key.required]
    properties = {name: key.json_schema() for name, key in keys.items()}
    schema = {"type": "object", "additionalProperties": False, "properties": properties}
    return schema | ({"required": required} if required else {})


def keys(family: str, places: tuple | None = None) -> list[dict]:
    """Keys of a family's tables as plain data, for ``meshwright drives``."""
    return [
        {"table": table, "key": name, "required": key.required, "meaning": key.meaning, "words": list(key.words)}
        for tables in (form(family, places).tables, form(family, places).drawn)
        for table, entries in tables.items()
        for name, key in entries.items()
    ]
