"""Say what a flag, status, event, reason or quantity of the results means, or a key; without WORD, all but the keys."""

import difflib

from meshwright.base.errors import UsageError
from meshwright.base.files import write_text
from meshwright.contact import words
from meshwright.contact.analysis import reasons, status_text, statuses
from meshwright.contact.results import impossible
from meshwright.design import description, schema


def add_arguments(parser):
    parser.add_argument(
        "word", nargs="*", metavar="WORD", help="for example off_tip, line_contact, contact ratio, center_distance_mm"
    )


def meanings():
    """``{"status" | "flag" | "event" | "reason" | "quantity": {word: what it means}}``."""
    return {
        "status": {word: status_text(word) for word in dict.fromkeys(statuses().values())},
        "flag": {word: _flag(word) for word in words.FLAGS},
        "event": words.EVENTS,
        "reason": reasons(),
        "quantity": words.QUANTITIES,
    }


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
    known, word = meanings(), "_".join(" ".join(options.word).split())
    if not word:
        lines = [f"{kind:<8} {name:<21} {text}" for kind, meant in known.items() for name, text in meant.items()]
    else:
        lines = [f"{kind} {word}: {meant[word]}" for kind, meant in known.items() if word in meant] or _key(word, known)
    write_text("-", "\n".join(lines) + "\n")
    return 0


def _key(word, known):
    """What a key, alone or as TABLE.KEY, means."""
    listed = keys()
    table, _, key = word.rpartition(".")
    lines = [f"key {key} {text}" for text in listed.get(key, ()) if not table or text.startswith(f"[{table}]")]
    if not lines:
        near = difflib.get_close_matches(word, [*(name for meant in known.values() for name in meant), *listed], n=1)
        remedy = f"did you mean {near[0]!r}?" if near else "`meshwright explain` lists them, `meshwright drives` keys"
        raise UsageError(f"explain {word}: no such flag, status, event, reason, quantity or key; {remedy}")
    return lines


def _flag(word):
    return words.FLAGS[word] + ("; bodies cannot make this contact" if impossible(word) else "")
