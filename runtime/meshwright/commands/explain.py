"""Say what a flag, status, event, reason or quantity of the results means, or a key; without WORD, all but the keys.

Of a statement of the audit record, or of a drive, it says what is proved and what is open.

A name of the JSON, with its unit, is that of the quantity; a word that has no entry is sought in those of the others.
"""

import difflib
import re

from meshwright.base.drives import folders
from meshwright.base.errors import UsageError
from meshwright.base.files import write_text
from meshwright.contact import words
from meshwright.contact.analysis import reasons, status_text, statuses
from meshwright.contact.results import impossible
from meshwright.design import description, schema

#: Units with which names of the JSON end.
_UNIT = re.compile(r"(_mm_per_rad|_per_mm|_mm|_deg|_arcsec|_um|_mpa|_n_per_um|_n)$")

#: A word so like another one is that, misspelt; a less similar one is proposed where there is nothing better.
MISSPELT, SIMILAR = 0.8, 0.6

#: Entries of others that are shown for a word without one, most.
MOST = 8


def add_arguments(parser):
    parser.add_argument(
        "word", nargs="*", metavar="WORD", help="for example off_tip, line_contact, contact ratio, center_distance_mm"
    )


def meanings():
    """``{"status" | "flag" | "event" | "reason" | "outcome" | "check" | "quantity": {word: what it means}}``."""
    return {
        "status": {word: status_text(word) for word in dict.fromkeys(statuses().values())},
        "flag": {word: _flag(word) for word in words.FLAGS},
        "event": words.EVENTS,
        "reason": reasons() | words.GAPS,
        "outcome": words.OUTCOMES,
        "check": _checks(),
        "quantity": words.QUANTITIES,
    }


def _checks():
    """What the checks of drawings say, by name."""
    families = description.families().values()
    return {check["name"]: check["meaning"] for family in families for check in family.drawing.table["checks"]}


def keys():
    """{"key": [sentence …]}: what each key of a design is, for every table and family that means something else."""
    found = {}
    for family in description.families():
        for entry in schema.keys(family):
            said = "; ".join(filter(None, (entry["meaning"], " | ".join(map(str, entry["words"])))))
            by_meaning = found.setdefault(entry["key"], {})
            by_meaning.setdefault((entry["table"], said), []).append(family)
    return {
        key: [f"[{table}] {said} ({', '.join(families)})" for (table, said), families in meanings.items()]
        for key, meanings in found.items()
    }


def run(options):
    known, word = meanings(), "_".join(" ".join(options.word).lower().replace("-", " ").split())
    if not word:
        lines = [f"{kind:<8} {name:<21} {text}" for kind, meant in known.items() for name, text in meant.items()]
    else:
        typed = "_".join(" ".join(options.word).split())
        names = [name for meant in known.values() for name in meant]
        misspelt = difflib.get_close_matches(word, [*names, *keys()], 1, MISSPELT)
        lines = _entries(word, known) or _key(typed) or _unknowns(typed) or _statements(typed)
        lines = lines or ([] if misspelt else _spoken_of(word, known))
        if not lines:
            near = misspelt or _held(word, names) or difflib.get_close_matches(word, [*names, *keys()], 1, SIMILAR)
            remedy = "`meshwright explain` lists them, `meshwright drives` keys"
            remedy = f"did you mean {near[0]!r}?" if near else remedy
            raise UsageError(f"explain {typed}: no such flag, status, event, reason, quantity or key; {remedy}")
    write_text("-", "\n".join(lines) + "\n")
    return 0


def _held(word, names):
    """The longest name that a word holds, or that begins with it, in a list; an empty one where none is."""
    held = [name for name in names if f"_{name}_" in f"_{word}_" or name.startswith(f"{_UNIT.sub('', word)}_")]
    return sorted(held, key=len)[-1:]


def _entries(word, known):
    """What a word of the results means, or a name of the JSON with its unit; one letter s more makes no other word."""
    bare = _UNIT.sub("", word)
    for name in dict.fromkeys((word, bare, f"{bare}s", bare.removesuffix("s"))):
        if lines := [f"{kind} {name}: {meant[name]}" for kind, meant in known.items() if name in meant]:
            return lines
    return []


def _key(word):
    """What a key, alone or as TABLE.KEY, means."""
    table, _, key = word.rpartition(".")
    return [f"key {key} {text}" for text in keys().get(key, ()) if not table or text.startswith(f"[{table}]")]


def _made():
    """The names of the drives that are made already."""
    return [name for name in description.drives() if any((folder / f"{name}.json").exists() for folder in folders())]


def _unknowns(word):
    """What an unknown of the equations of contact means, in the drives that are made already."""
    found = {}
    for drive in map(description.described, _made()):
        for text in (f"{u['meaning']}, {u['unit']}" for u in drive["unknowns"] if u["name"] == word):
            found.setdefault(f"unknown {word}: {text}", {})[drive["family"]] = None
    return [f"{text} ({', '.join(families)})" for text, families in found.items()]


def _statements(word):
    """How a statement of the audit record stands for each drive that is made already; or what is open for a drive."""
    lines = []
    for name in _made():
        drive = description.described(name)
        if word in drive["keys"]:
            lines.append(f"statement {word}: proved of the definitions of {name} (key {drive['keys'][word]})")
        for statement, reason in drive["open"].items():
            if word in (statement, name):
                lines.append(f"statement {statement}: open for {name}: {reason}")
        if word == name and not lines:
            lines.append(f"drive {name}: {drive['title']}; {len(drive['keys'])} statements proved, none open")
    return lines


def _spoken_of(word, known):
    """Entries whose names or sentences hold a word that has none of its own."""
    whole = re.compile(rf"\b{re.escape(word.replace('_', ' '))}s?\b")
    entries = {(kind, name): text for kind, meant in known.items() for name, text in meant.items()}
    entries |= {("key", key): text for key, texts in keys().items() for text in texts[:1]}
    found = [
        f"{kind} {name}: {text}" for (kind, name), text in entries.items()
        if whole.search(name.replace("_", " ")) or whole.search(text.lower())
    ]  # fmt: skip
    if len(found) > MOST:
        found = [*found[:MOST], f"and {len(found) - MOST} more"]
    return found and [f"{word.replace('_', ' ')} has no entry of its own; it is in those of", *found]


def _flag(word):
    return words.FLAGS[word] + ("; bodies cannot make this contact" if impossible(word) else "")
