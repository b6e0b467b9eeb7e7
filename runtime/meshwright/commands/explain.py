"""Say what a flag, a status or an event of the results means; without WORD, all of them."""

import difflib

from meshwright.base.errors import UsageError
from meshwright.base.files import write_text
from meshwright.contact import words
from meshwright.contact.analysis import status_text, statuses
from meshwright.contact.results import impossible


def add_arguments(parser):
    parser.add_argument("word", nargs="?", metavar="WORD", help="for example off_tip, line_contact, throat")


def meanings():
    """``{"status" | "flag" | "event": {word: what it means}}``."""
    return {
        "status": {word: status_text(word) for word in dict.fromkeys(statuses().values())},
        "flag": {word: _flag(word) for word in words.FLAGS},
        "event": words.EVENTS,
    }


def run(options):
    known = meanings()
    found = [(kind, meant[options.word]) for kind, meant in known.items() if options.word in meant]
    if options.word is None:
        lines = [f"{kind:<7} {word:<18} {text}" for kind, meant in known.items() for word, text in meant.items()]
    elif found:
        lines = [f"{kind} {options.word}: {text}" for kind, text in found]
    else:
        every = [word for meant in known.values() for word in meant]
        near = difflib.get_close_matches(options.word, every, n=1)
        remedy = f"did you mean {near[0]!r}?" if near else "`meshwright explain` lists them"
        raise UsageError(f"explain {options.word}: no such flag, status or event; {remedy}")
    write_text("-", "\n".join(lines) + "\n")
    return 0


def _flag(word):
    return words.FLAGS[word] + ("; bodies cannot make this contact" if impossible(word) else "")
