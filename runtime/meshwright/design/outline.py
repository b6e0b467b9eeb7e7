"""A first design: the suggestions that a family declares, as a commented design file."""

import json
import math
import textwrap
from dataclasses import dataclass

from meshwright.base.errors import UsageError
from meshwright.base.expression import names, value
from meshwright.design import schema
from meshwright.design.relations import Completion

#: Sizes farther from the family's proportions than this share are told where flanks do not meet.
ASTRAY = 0.1

#: How the list of what is assumed is written.
WIDTH = 100
INDENTED = {"initial_indent": "  ", "subsequent_indent": "  ", "break_long_words": False, "break_on_hyphens": False}

#: Digits that round-off adds to a number, at least.
ROUND_OFF = 4

#: Why a value of one's own that no suggestion knows is there: whoever sets it has to see to the rest.
ALONE = "as given; no other size follows it"


@dataclass(frozen=True)
class FirstDesign:
    """The text of a design file, and what it assumes: (key or name, value, reason)."""

    text: str
    assumed: tuple[tuple[str, object, str], ...]


def first_design(family, name, words, given, own, determined=None, follow=None):
    """The :class:`FirstDesign` of a :class:`~meshwright.design.description.Family`.

    ``words`` choose its drive, ``given`` are the options by name, ``own`` values by "table.key" (or "key", above the
    tables) that replace suggestions or stand beside them, ``determined`` those that follow from sizes of one's own and
    need no suggestion; ``follow`` gives those that follow only with suggestions beside them, by "table.key". Raises
    :class:`UsageError` where the options contradict each other.
    """
    determined = dict(determined or {})
    unused = family.unused(words)
    symbols, chosen, told, read = dict(given), {}, [], set()
    suggested = {suggestion["place"] for suggestion in family.outline["suggestions"]}
    for suggestion in family.outline["suggestions"]:
        place = suggestion["place"]
        if place in unused or not _meant(suggestion, words):
            continue
        number = _number(suggestion, symbols)
        found = own.get(place, determined.get(place))
        if found is None and place and follow:
            found = follow({size: chosen[size][0] for size in chosen}).get(place)
            determined |= {} if found is None else {place: found}
        if isinstance(found, int | float):
            number = found
        if suggestion["name"] in symbols and math.isnan(number):
            continue
        if unsound := _unsound(suggestion, number, symbols):
            asked = ", ".join(f"--{name}" for name in family.outline["options"])
            raise UsageError(f"{unsound}: change one of {asked}")
        symbols[suggestion["name"]] = number
        if not place and suggestion["why"] and math.isfinite(number):
            told.append((suggestion["name"], number, suggestion["why"]))
        if place and place not in own | determined and math.isfinite(number):
            chosen[place] = number, suggestion["why"]
            read.update(*map(names, suggestion["values"]))
    followed = {name for relation in family.drawing.relations for name in relation.sizes}
    unfollowed = {f"{p['table']}.{p['key']}" for p in family.parameters if p["name"] not in followed} - suggested
    alone = {place: (number, ALONE) for place, number in own.items() if place in unfollowed or "." not in place}
    written = chosen | {place: (number, "as given") for place, number in own.items()} | alone
    flank = next(p for p in family.parameters if p["table"] == "flank")["choices"]
    above = {"drive": family.name, "name": name, "flank": next(iter(flank))}
    above |= {key: number for key, (number, _) in written.items() if "." not in key}
    proposed = [place for place, (_, why) in chosen.items() if why]
    lines = [f"{key} = {_toml(number)}" for key, number in above.items()]
    if proposed:
        lines += ["assumed = [", *textwrap.wrap(", ".join(map(_toml, proposed)), WIDTH, **INDENTED), "]"]
    taken = _taken(family, above | {"design": {**words}}, written)
    tables = dict.fromkeys(["design", *(place.partition(".")[0] for place in [*written, *taken] if "." in place)])
    for table in tables:
        lines += ["", f"[{table}]"]
        if table == "design":
            lines += [f'{key} = "{word}"' for key, word in words.items()]
        for place, (number, why) in written.items():
            if place.partition(".")[0] == table:
                entry = f"{place.partition('.')[2]} = {_toml(number)}"
                said = f"assumed: {why}" if place in chosen and why else why
                lines.append(f"{entry:<44}  # {said}" if said else entry)
        for place, (number, why) in taken.items():
            if place.partition(".")[0] == table:
                entry = f"# {place.partition('.')[2]} = {_toml(number)}"
                lines.append(f"{entry:<44}  # assumed: {why}")
    assumed = tuple((place, number, why) for place, (number, why) in (chosen | taken | alone).items())
    told = [entry for entry in told if entry[0] in read]
    return FirstDesign("\n".join(lines) + "\n", (*told, *assumed))


def _taken(family, tables, written):
    """What the drawing of a design assumes beside the sizes ``written``: "table.key" → number or word, reason."""
    for place, (number, _) in written.items():
        table, _, key = place.rpartition(".")
        if table:
            tables.setdefault(table, {})[key] = number
    entries = schema.drawn(family.name, tables)
    if entries.keys() <= family.drawing.places.keys() - family.drawing.beside:
        return {}
    assumed = Completion.of(family.drawing, entries).assumed()
    return {place: (_short(number), why) for place, (number, why) in assumed.items() if place != "flank.flank"}


def _short(number):
    """A number to as many digits as a comment needs."""
    return float(f"{number:.6g}") if isinstance(number, float) else number


def beside_proportions(family, given):
    """Where a design leaves what the family's proportions make of its other sizes, a sentence each, the farthest first.

    ``given``: numbers and words by "table.key". It is no judgement: a sound design may have proportions of its own. But
    where flanks do not meet, these sizes are the first to look at.
    """
    outline = family.outline or {"words": {}, "suggestions": []}
    words = {key: given.get(f"design.{key}") or word for key, word in outline["words"].items()}
    symbols: dict[str, float] = {}
    for suggestion in outline["suggestions"]:  # an option is the size that is suggested to be just that
        own, names = given.get(suggestion["place"]), suggestion["values"]
        if own is not None and len(names) == 1 and isinstance(names[0], str) and names[0] in ("m", "z_1", "z_2", "a"):
            symbols.setdefault(names[0], own)
    if not {"m", "z_1", "z_2"} <= symbols.keys():
        return _beyond(family, given)
    symbols.setdefault("a", math.nan)
    found = []
    for suggestion in outline["suggestions"]:
        if not _meant(suggestion, words):
            continue
        number, own = _number(suggestion, symbols), given.get(suggestion["place"])
        if suggestion["name"] in symbols and math.isnan(number):
            continue
        if unsound := _unsound(suggestion, number, symbols):
            found.append((math.inf, unsound))
        if isinstance(own, int | float) and math.isfinite(number):
            off = abs(own - number) / max(abs(own), abs(number), 1e-300)
            if off > (0.0 if suggestion["whole"] else ASTRAY):
                found.append((off, f"{suggestion['place']} = {own:g}: {number:.5g} by the proportions of this family"))
        symbols[suggestion["name"]] = own if isinstance(own, int | float) else number
    return [sentence for _, sentence in sorted(found, key=lambda entry: -entry[0])] + _beyond(family, given)


def _beyond(family, given):
    """Sizes that the proportions leave at their defaults and the design does not, a sentence each."""
    suggested = {suggestion["place"] for suggestion in family.outline["suggestions"]} if family.outline else set()
    tables = {place.partition(".")[0] for place in suggested if place}
    places = {f"{p['table']}.{p['key']}": p["default"] and p["default"] / p["factor"]
              for p in family.parameters if p["table"] in tables}  # fmt: skip
    return [
        f"{place} = {given[place]:g}: {default:g} by the proportions of this family, whose other sizes do not follow it"
        for place, default in places.items()
        if place not in suggested and isinstance(default, int | float) and isinstance(given.get(place), int | float)
        and not math.isclose(given[place], default, abs_tol=1e-12)
    ]  # fmt: skip


def _unsound(suggestion, number, symbols):
    """What is wrong with a number beyond those of a sound design; "" with others."""
    if not suggestion.get("within") or math.isnan(number):
        return ""
    least, most = (value(bound, symbols) for bound in suggestion["within"])
    said = f"{suggestion['name']} = {number:.4g}: {suggestion['why']}; sound designs have {least:g} to {most:g}"
    return "" if least <= number <= most else said


def _meant(suggestion, words):
    """Whether a suggestion is for the drive of these words."""
    return all(words.get(key) in meant for key, meant in suggestion["words"].items())


def _number(suggestion, symbols):
    """The first of a suggestion's values that is a number, rounded as it says; NaN if none is."""
    found = next((v for e in suggestion["values"] if math.isfinite(v := value(e, symbols))), math.nan)
    if suggestion["whole"] and math.isfinite(found):
        return int(found)
    found = _plain(found) if suggestion["decimals"] is None else round(found, suggestion["decimals"])
    return found + 0.0  # no minus before 0


def _plain(number):
    """The number without round-off, where it is a shorter one but for that: others keep every digit."""
    short = float(f"{number:.14g}")
    return short if len(repr(short)) + ROUND_OFF < len(repr(number)) else number


def _toml(number):
    if isinstance(number, str):
        return json.dumps(number, ensure_ascii=False)
    if isinstance(number, bool):
        return "true" if number else "false"
    return repr(number)
