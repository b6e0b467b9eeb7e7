"""Designs: read, checked and turned into the parameter vector of a drive."""

import hashlib
import json
import math
import operator
import re
import tomllib
from dataclasses import dataclass
from functools import cached_property, partial
from pathlib import Path

import numpy as np

from meshwright.base import expression
from meshwright.base.drives import folders
from meshwright.base.errors import DesignError
from meshwright.base.files import read_bytes
from meshwright.base.library import ffi, library, model, model_in_lanes, pointer, text
from meshwright.design import description as metadata
from meshwright.design import schema
from meshwright.design.mirror import Mirror
from meshwright.design.nearest import filled_nearly
from meshwright.design.relations import GIVEN, Completion, outer

PACKAGED = Path(__file__).parent.parent / "designs"


def packaged_names():
    """Names of the packaged designs."""
    return sorted(path.stem for path in PACKAGED.glob("*.toml"))


def read(name_or_path):
    """The raw tables of a packaged design or of a TOML file."""
    return parsed(text_of(name_or_path), name_or_path)


def text_of(name_or_path):
    """The text of a packaged design or of a design file."""
    if not isinstance(name_or_path, str | Path):
        raise DesignError("DESIGN", name_or_path, "no name and no path", "name a packaged design or a TOML file")
    path = PACKAGED / f"{name_or_path}.toml"
    if not path.exists():
        path = Path(name_or_path)
    if not path.exists():
        import difflib

        near = difflib.get_close_matches(str(name_or_path), packaged_names(), n=3)
        hint = f"did you mean {', '.join(near)}?" if near else "`meshwright drives` lists the packaged designs"
        raise DesignError("DESIGN", str(name_or_path), "no packaged design and no file of that name", hint)
    return _text(path)


#: A design file is some kilobytes; larger ones are taken for a mistake. Bytes.
LARGEST_FILE = 2**20


def _text(path):
    """The text of a file of bounded size, in UTF-8 with or without a byte order mark; line ends as they are."""
    content = read_bytes(path, LARGEST_FILE, partial(DesignError, str(path), None), "name a design file")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise DesignError(str(path), None, f"not a TOML file: {error}", "save it as UTF-8") from error


#: Most names that a key of a design file may join by dots: a design has tables of keys, no more, and the time that it
#: takes to read a key grows with the square of their number.
MOST_NAMES = 32

_NAME = r"""(?:[\w-]++|"(?:[^"\\\n]|\\.)*+"?|'[^'\n]*+'?)"""
_JOINED = rf"(?:[ \t]*+\.[ \t]*+{_NAME})"
#: The parts of TOML text, found from left to right in one pass.
_PARTS = re.compile(
    "|".join(
        (
            r"#[^\n]*+",
            r'"""[\s\S]*?"""',
            r"'''[\s\S]*?'''",
            rf"(?P<deep>{_NAME}{_JOINED}{{{MOST_NAMES},}}+)",
            rf"{_NAME}{_JOINED}*+",
            r"[\s\S]",
        )
    )
)


def parsed(text, place):
    """The tables of TOML text that was found at ``place``."""
    if any(part["deep"] for part in _PARTS.finditer(text)):
        raise _TooDeep(place)
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise DesignError(str(place), None, f"not a TOML file: {error}", "correct the line named") from error
    except ValueError as error:  # more digits than a number may have
        raise DesignError(str(place), None, f"a number that cannot be read: {error}", "write it shorter") from error
    except RecursionError as error:
        raise _TooDeep(place) from error


class _TooDeep(DesignError):
    """Tables in tables, or keys of many names."""

    def __init__(self, place):
        super().__init__(str(place), None, "nested too deeply", "a design has tables of keys, no more")


def toml_text(tables):
    """A design as TOML: nested plain dictionaries of numbers and words."""
    loose = [f"{key} = {_toml(value)}" for key, value in tables.items() if not isinstance(value, dict)]
    for name, entries in tables.items():
        if isinstance(entries, dict) and entries:
            loose += ["", f"[{name}]", *(f"{key} = {_toml(value)}" for key, value in entries.items())]
    return "\n".join(loose) + "\n"


def _toml(value):
    return json.dumps(value, ensure_ascii=False) if isinstance(value, str | bool | list) else repr(value)


def changed(tables, changes):
    """The tables with ``{"table.key": value}`` (or top-level ``"key"``) set; what was given is left as it is."""
    tables = {name: dict(entry) if isinstance(entry, dict) else entry for name, entry in tables.items()}
    for place, value in changes.items():
        table, _, key = place.rpartition(".")
        target = tables.setdefault(table, {}) if table else tables
        if not isinstance(target, dict):
            raise DesignError(place, value, f"{table} is not a table", "write table.key=value")
        target[key] = value
    if isinstance(tables.get("assumed"), list):
        tables["assumed"] = [place for place in tables["assumed"] if place not in [*changes]]
    return tables


@dataclass(frozen=True, repr=False)
class Design:
    """A checked design: the drive that solves it and its complete parameter vector (inner units).

    ``sizes`` are derived, in the units of their keys; NaN where they follow from what the design leaves open.
    ``places`` are the folders in which its drive was searched (:func:`meshwright.base.drives.folders`). ``drawn`` are
    the tables as they were given, where these hold sizes from which keys of ``tables`` follow; else None.
    """

    tables: dict
    description: dict
    parameters: np.ndarray
    sizes: dict
    mirrored: bool
    places: tuple[Path, ...]
    drawn: dict | None = None

    @property
    def model(self):
        """The compiled model table of the drive, as a cffi pointer."""
        return model(self.description["name"], self.places)

    @property
    def model_in_lanes(self):
        """The same with its lane kernels, which a checkout compiles when they are first asked for."""
        return model_in_lanes(self.description["name"], self.places)

    @cached_property
    def state(self):
        """What surfaces and functions of the compiled model read (ns,), whatever backend solves the contact."""
        compiled = self.model
        s = np.empty(compiled.ns)
        compiled.setup(pointer(self.parameters), pointer(s))
        return s

    @property
    def label(self):
        """Name, drive, flank and a digest of all parameters, in a line: equal designs have equal digests."""
        name, drive = self.tables.get("name") or "design", self.description["name"]
        digest = hashlib.sha256(self.parameters.tobytes()).hexdigest()[:12]
        return f"{name} ({drive}, {self.tables['flank']} flank, {digest})"

    def __repr__(self):
        return f"<{type(self).__name__} {self.label}>"

    @cached_property
    def mirror(self):
        """The :class:`~meshwright.design.mirror.Mirror` of the design's hand."""
        return Mirror.of(self.description, self.mirrored)

    @property
    def family(self):
        return self.description["family"]

    @property
    def flank(self):
        """The flank sign."""
        return next(
            float(number)
            for number, p in zip(self.parameters, self.description["parameters"], strict=True)
            if p["table"] == "flank"
        )

    @property
    def reference_angle(self):
        """Input angle to which relative errors refer, rad, for the hand in which the equations are written."""
        index = self.description["reference"]
        return 0.0 if index < 0 else float(self.parameters[index])

    @property
    def other_flank(self):
        """The word of the opposite flank."""
        words = next(p["choices"] for p in self.description["parameters"] if p["table"] == "flank")
        return next(word for word in words if word != self.tables["flank"])

    def value(self, key, table="design"):
        """A parameter in inner units by its design key; NaN if the design leaves it open or its tools do not use it."""
        for number, p in zip(self.parameters, self.description["parameters"], strict=True):
            if p["key"] == key and p["table"] == table:
                return float(number)
        if any(p["key"] == key and p["table"] == table for p in metadata.parameters(self.family, self.places)):
            return math.nan
        raise KeyError(f"{table}.{key}")

    def with_whole_blank(self):
        """(design, assumed): the design with the standard proportions where it leaves its blank open, and which these
        are, by key in the units of the keys.
        """
        listed = self.description["parameters"]
        known = {p["name"]: float(number) for number, p in zip(self.parameters, listed, strict=True)}
        whole = expression.completed(self.description["proportions"], known)
        of = {p["name"]: p for p in listed}
        names = dict.fromkeys(name for name, _ in self.description["proportions"])
        filled = [of[name] for name in names if math.isnan(known[name]) and not math.isnan(whole[name])]
        assumed = {p["key"]: whole[p["name"]] / p["factor"] for p in filled}
        changes = {f"{p['table']}.{p['key']}": assumed[p["key"]] for p in filled}
        return (check(changed(self.given(), changes), self.places) if changes else self), assumed

    def given(self):
        """The tables as the design file gives them, without the keys that it leaves open."""
        closed = {}
        for name, entry in self.tables.items():
            if isinstance(entry, dict):
                closed |= {name: kept} if (kept := {k: v for k, v in entry.items() if v is not None}) else {}
            elif entry != ():
                closed[name] = entry
        return closed

    def as_solved(self):
        """The design with every default and derived size filled in, in the units of the keys; None where it is open."""
        solved = {"drive": self.family, "name": self.tables.get("name", ""), "flank": self.tables["flank"]}
        for number, p in zip(self.parameters, self.description["parameters"], strict=True):
            if p["table"] != "flank":
                solved.setdefault(p["table"], {})[p["key"]] = _shown(p, float(number))
        for place in (*self.description["variant"], "hand"):
            table, key = metadata.table_and_key(place)
            if key in self.tables[table]:
                solved[table][key] = self.tables[table][key]
        solved["design"] |= {key: number if math.isfinite(number) else None for key, number in self.sizes.items()}
        if "placement" in solved:
            solved["placement"] |= _vectors(solved["placement"])
        return solved


def _vectors(entries):
    """Vectors whose components are entries of their own: ``P_mm`` of ``P_x_mm``, ``P_y_mm``, ``P_z_mm``."""
    stems = [match.groups() for key in entries if (match := re.fullmatch(r"(.+)_x(_mm)?", key))]
    return {f"{stem}{unit or ''}": [entries[f"{stem}_{axis}{unit or ''}"] for axis in "xyz"] for stem, unit in stems}


def _shown(parameter, number):
    """A parameter in the unit of its key, a choice as its word, None if open."""
    if math.isnan(number):
        return None
    words = {value: word for word, value in parameter["choices"].items()}
    return words.get(number, number / parameter["factor"])


def validated(tables, places=None):
    """Family and tables of a design, each key checked by itself; raises :class:`DesignError`."""
    family = _family(tables, places).name
    return family, schema.checked(family, tables, places)


def check(tables, places=None):
    """The :class:`Design` of raw tables; raises :class:`DesignError` for the first thing wrong with them.

    ``places`` are the folders in which its drive is searched, by default :func:`meshwright.base.drives.folders`.
    """
    places = places or folders()
    given, tables = tables, from_drawing(tables, places)
    family, checked = validated(tables, places)
    description = metadata.described(_chosen(metadata.families(places)[family], checked), places)
    _check_exclusive(description, tables["design"], given.get("design", {}))
    _check_needed(description, checked, places)
    _check_together(description, checked)
    _check_order(description, checked)
    c = model(description["name"], places)
    parameters = _vector(description, checked)
    if failed := complete(c, description, parameters):
        raise _guard_error(description["systems"][failed - 1], checked)
    state = np.empty(c.ns)
    failed = c.setup(pointer(parameters), pointer(state))
    if failed:
        told = [*description["guards"], *description["missing"]]
        raise _guard_error(told[failed - 1], checked, _by_place(description, parameters))
    parameters.flags.writeable = False
    sizes, mirrored = _sizes(c, parameters), _mirrored(description, checked)
    return Design(checked, description, parameters, sizes, mirrored, places, None if tables is given else given)


def from_drawing(tables, places=None):
    """Raw tables with keys of their family alone, of those that may hold other sizes of a drawing, from which the keys
    follow (:mod:`meshwright.design.relations`); the same object where there is nothing to do. Raises
    :class:`DesignError`.
    """
    family = _family(tables, places)
    drawing = family.drawing
    if error := drawing.refused(tables):
        raise error
    entries = schema.drawn(family.name, tables, places)
    closed = {p["name"] for place, p in drawing.places.items() if place in entries}
    required = [p["name"] for p in drawing.parameters if p["required"] and p["name"] in drawing.follow]
    if entries.keys() <= drawing.places.keys() - drawing.beside and closed >= {*required}:
        return tables
    completion = Completion.of(drawing, entries)
    if error := completion.unsound() or completion.open_ends(required):
        raise error
    own = {place: p for place, p in drawing.places.items() if place not in drawing.beside}
    kept = {name: {k: v for k, v in entry.items() if f"{name}.{k}" not in entries or f"{name}.{k}" in own}
            if isinstance(entry, dict) else entry for name, entry in tables.items()}  # fmt: skip
    changes = {}
    for place, p in own.items():
        known = completion.known.get(p["name"])
        if known and known.provenance != GIVEN and p["name"] not in completion.usual and known.value != p["default"]:
            number = outer(p, known.value)
            if number != family.variant_defaults.get(place.removeprefix("design.")):
                changes[place] = number
    if isinstance(listed := tables.get("assumed"), list):
        kept["assumed"] = [place for place in listed if place not in [*entries] or place in [*own]]
    return changed(kept, changes)


def _family(tables, places):
    """The :class:`~meshwright.design.description.Family` of raw tables; raises :class:`DesignError`."""
    known = metadata.families(places)
    if not isinstance(tables, dict):
        raise DesignError("design", tables, "must be tables", "give a dictionary, as a TOML file is read")
    if "drive" not in tables:
        raise DesignError("drive", None, "the key is missing", f"name one of {', '.join(known)}")
    family = tables["drive"]
    if not isinstance(family, str) or family not in known:
        raise DesignError("drive", family, "no such family of drives", f"use one of {', '.join(known)}")
    return known[family]


def by_rules(tables):
    """A design without its compiled drive: tables with every word filled in, and its parameters by their symbols.

    Numbers are in inner units, NaN where the design leaves them open or a design system finds them. What the drive's
    tools have to say of each other is not checked; raises :class:`DesignError` for all else.
    """
    family, checked = validated(tables)
    known = metadata.families()[family]
    drive = _chosen(known, checked)
    description = {
        "title": f"{family} drive", "family": family, "parameters": known.listed[drive], "together": [],
        "exclusive": known.exchange["exclusive"],
    }  # fmt: skip
    _check_needed(description, checked)
    _check_order(description, checked)
    _check_exclusive(description, tables["design"], tables["design"])
    symbols = {p["name"]: math.nan for p in known.parameters}
    given = zip(description["parameters"], _vector(description, checked), strict=True)
    symbols |= {p["name"]: float(number) for p, number in given}
    symbols = expression.completed(known.exchange["rules"], symbols)
    for guard in known.exchange["guards"]:
        if expression.value(guard["positive"], symbols) <= 0.0:
            raise _guard_error(guard, checked)
    return checked, symbols


def words_of(family, checked):
    """The words that choose the drive of a :class:`~meshwright.design.description.Family`, by place.

    Those left out are filled in, in place, with the word that they default to.
    """
    for place, source in family.variant_defaults.items():
        table, key = metadata.table_and_key(place)
        if checked[table][key] is None:
            checked[table][key] = _given(checked, source)
    return {place: _given(checked, place) for place in family.choosing}


def _chosen(family, checked):
    """The drive that the words of these tables choose; raises :class:`DesignError` where none has all of them."""
    words = words_of(family, checked)
    if (drive := family.chosen(words)) is not None:
        return drive
    apart = [place for place in words if family.chosen(words, but=place)] or [*words]
    first, *others = (_full(place, checked) for place in apart)
    values = ", ".join(f"{place} = {_given(checked, place)}" for place in others)
    reason = f"no drive of the family {family.name} has it together with {values}"
    raise DesignError(first, _given(checked, first), reason, f"change {' or '.join([first, *others])}")


def _given(tables, place):
    """The value of a key of these tables by its place, None where it is open; a word of its own is its own place."""
    if place in tables:
        return tables[place]
    table, key = metadata.table_and_key(place)
    return tables[table].get(key)


def _full(place, checked):
    """A place with its table; a key alone is of [design] if that has it, else of the table that does.

    What is no table but a word of its own, as the flank, is its own place.
    """
    table, _, key = place.rpartition(".")
    if table:
        return place if isinstance(checked[table], dict) else key
    tables = ["design", *(name for name, table in checked.items() if isinstance(table, dict) and name != "design")]
    return f"{next((name for name in tables if place in checked[name]), 'design')}.{place}"


def _mirrored(description, checked):
    """Whether the design has the other hand than the one for which its equations are written."""
    return bool(description["handed"]) and checked["design"]["hand"] != description["handed"]


def _check_exclusive(description, known, given):
    """Of keys that determine each other one is ``known``; the design has ``given`` one at most, others by relations."""
    for group in description["exclusive"]:
        present = [key for key in group if given.get(key) is not None]
        pair = " and ".join(group)
        if len(present) > 1:
            raise DesignError(
                f"design.{present[1]}", given[present[1]], f"{pair} determine each other", "give exactly one of them"
            )
        if all(known.get(key) is None for key in group):
            raise DesignError(f"design.{group[0]}", None, f"neither of {pair} is given", "give exactly one of them")


def _check_needed(description, checked, places=None):
    """Every key that the drive requires is given, and none that its tools do not use."""
    kind = f"a drive of the kind {description['title']!r}"
    own = {(p["table"], p["key"]) for p in description["parameters"]}
    family = metadata.families(places)[description["family"]]
    own |= {metadata.table_and_key(place) for place in family.choosing}
    for p in description["parameters"]:
        if p["required"] and p["table"] != "flank" and checked[p["table"]].get(p["key"]) is None:
            place = f"{p['table']}.{p['key']}"
            raise DesignError(place, None, f"{kind} cannot be made without it", "add it")
    for p in family.parameters:
        table, key = p["table"], p["key"]
        if table != "flank" and (table, key) not in own and (value := checked[table].get(key)) is not None:
            of = f"; it is a key of {', '.join(p['tools'])}" if p["tools"] else _counted(family, table, key)
            raise DesignError(f"{table}.{key}", value, f"{kind} does not use it{of}", "remove it")


def _counted(family, table, key):
    """For which numbers of a key that chooses the drive another key is one of the design's; "" if that is no matter."""
    users = [name for name, own in family.listed.items() if any((p["table"], p["key"]) == (table, key) for p in own)]
    for place in family.choosing:
        numbers = [family.variants[name][place] for name in users]
        if all(isinstance(n, dict) for n in numbers) and (least := min(n["least"] for n in numbers)) > 0:
            return f"; it is a key of designs whose {place} is {least} or more"
    return ""


def _check_together(description, checked):
    """Of keys that make sense together alone, such as the components of a vector, all are given or none."""
    for group in description["together"]:
        values = {place: checked[table].get(key) for place in group for table, key in [place.split(".")]}
        missing = [place for place, value in values.items() if value is None]
        if missing and len(missing) < len(group):
            given = next(place for place in group if place not in missing)
            reason = f"given without {', '.join(missing)}, which belong to it"
            raise DesignError(given, values[given], reason, "give all of them or none")


def _check_order(description, checked):
    for p in description["parameters"]:
        if p["above"] is None:
            continue
        value, least = (checked[p["table"]][key] for key in (p["key"], p["above"]))
        if not _in_order(value, least):
            reason = f"must be greater than {p['above']}, which is {least:g}"
            raise DesignError(f"{p['table']}.{p['key']}", value, reason, "choose a larger value")


def _in_order(value, least):
    """Whether a number, or each of an array, is above the one that it must be above; an open one, None, is."""
    return True if value is None or least is None else np.greater(value, least)


def allowed(design, varied):
    """Which samples keep the bounds and the order of the keys: (S,) of bool.

    ``varied`` are values (S,) by key ("table.key"), in the units of the keys; the other keys are the design's.
    """
    values = {f"{table}.{key}": v for table, entries in design.tables.items() if isinstance(entries, dict)
              for key, v in entries.items()} | varied  # fmt: skip
    keeps = np.logical_and.reduce([np.isfinite(column) for column in varied.values()])
    for p in design.description["parameters"]:
        place = f"{p['table']}.{p['key']}"
        if place in varied:
            for comparison, bound in schema.bounds(p).items():
                keeps = keeps & getattr(operator, comparison)(varied[place], bound)
        if p["above"] is not None:
            keeps = keeps & _in_order(values[place], values[f"{p['table']}.{p['above']}"])
    return keeps


def _vector(description, checked):
    vector = np.full(len(description["parameters"]), np.nan)
    for k, p in enumerate(description["parameters"]):
        if p["table"] == "flank":
            vector[k] = p["choices"][checked["flank"]]
        elif (value := checked[p["table"]].get(p["key"])) is not None:
            vector[k] = p["choices"][value] if p["choices"] else float(value) * p["factor"]
    return vector


def given_vector(design):
    """The parameter vector as the design file gives it: NaN where rules and defaults fill in."""
    return _vector(design.description, design.tables)


def is_real(parameter):
    """Whether a parameter is a real number: neither a count nor a choice."""
    return not (parameter["integer"] or parameter["choices"])


def has_rival(design, key):
    """Whether a design key is the other name of one that is given, and so determined by it."""
    given = {k for k, value in design.tables["design"].items() if value is not None}
    return key not in given and any(key in group and given & set(group) for group in design.description["exclusive"])


def complete(c, description, parameters):
    """Fill in what follows from the design in ``parameters`` (np,). 0, or 1 + the number of the design system that has
    no solution, and of which more than a start for the search of contact is asked.
    """
    work, info, before = np.empty(c.np + 1), ffi.new("mw_info *"), 0
    while failed := library().mw_complete(c, pointer(parameters), pointer(work), info):
        starts = failed > before and description["systems"][failed - 1]["start"]
        if not (starts and filled_nearly(c, failed - 1, parameters)):
            return failed
        before = failed
    return 0


def _sizes(c, parameters):
    numbers = np.empty(c.nd)
    c.size(pointer(parameters), pointer(numbers))
    names = (c.sizes[k] for k in range(c.nd))
    return {text(n.name): float(x) / n.factor for n, x in zip(names, numbers, strict=True)}


def _by_place(description, parameters):
    """Completed parameters by their places, in the units of the keys."""
    numbers = zip(description["parameters"], parameters, strict=True)
    return {f"{p['table']}.{p['key']}": _shown(p, float(number)) for p, number in numbers}


#: Magnitude below which products and quotients of a number leave the range of doubles.
SMALLEST = 1e-100


def _guard_error(guard, checked, completed=None):
    """The error of a guard: with the values that the design gives its keys; if none, with those that follow. A number
    too small to compute with is named first: every size that follows from it may be what a guard finds.
    """
    for table, entries in checked.items():
        for key, value in entries.items() if isinstance(entries, dict) else ():
            if isinstance(value, float) and 0.0 < abs(value) < SMALLEST:
                reason = f"too small to compute with: {guard['message']}"
                return DesignError(f"{table}.{key}", value, reason, "choose a larger value")
    given = {_full(key, checked): _given(checked, _full(key, checked)) for key in guard["keys"]}
    shown = {key: value for key, value in given.items() if value is not None}
    if not shown and completed:
        shown = {key: float(f"{completed[key]:.6g}") for key in given if isinstance(completed.get(key), float)}
    shown = dict(sorted(shown.items(), key=lambda entry: isinstance(entry[1], str)))  # numbers, then words
    first = next(iter(shown or given))
    others = ", ".join(f"{k.removeprefix('design.')} = {v}" for k, v in shown.items() if k != first)
    reason = guard["message"] + (f" (with {others})" if others else "")
    keys = " or ".join(key.removeprefix("design.") for key in given)
    return DesignError(first, shown.get(first), reason, f"change {keys}")
