"""Print what teaches a shell to complete commands, options, packaged designs and files.

bash: eval "$(meshwright completion bash)" in ~/.bashrc; zsh: into a file _meshwright in a folder of $fpath;
fish: into ~/.config/fish/completions/meshwright.fish.
"""

import argparse
import shlex

import shtab

from meshwright.base.files import write_text
from meshwright.commands.explain import meanings
from meshwright.design import description, design

SHELLS = "bash", "zsh", "fish"


def add_arguments(parser):
    parser.add_argument("shell", choices=SHELLS, help="the shell it is for")


def run(options):
    from meshwright.cli import parser

    write_text("-", script(parser(), options.shell))
    return 0


def script(parser, shell):
    """The completion script of a parser for one of SHELLS; an argument's metavar says what can stand there."""
    known = {
        "DESIGN": design.packaged_names(),
        "FAMILY": description.families(),
        "WORD": [word for kind in meanings().values() for word in kind],
    }
    for action in _arguments(parser):
        kind = (action.metavar or "").partition("|")[0].partition(".")[0]
        if kind in known:
            action.complete = _one_of(kind, known[kind], files=kind == "DESIGN")
        elif kind in ("FOLDER", "DIR"):
            action.complete = shtab.DIRECTORY
        elif kind in ("FILE", "OUT", "REPORT"):
            action.complete = shtab.FILE
    functions = "".join(_bash_function(kind, words, files=kind == "DESIGN") for kind, words in known.items())
    return shtab.complete(parser, shell, preamble={"bash": functions, "zsh": "", "fish": ""}) + "\n"


def _arguments(parser):
    """Every argument of a parser and of its commands' parsers."""
    for action in parser._actions:
        yield action
        if isinstance(action, argparse._SubParsersAction):
            for command in action.choices.values():
                yield from _arguments(command)


def _one_of(kind, words, files):
    listed = " ".join(map(shlex.quote, words))
    zsh = f" _alternative 'words:{kind}:({listed})' 'files:file:_files'" if files else f"({listed})"
    fish = f"printf '%s\\n' {listed}" + ("; __fish_complete_path (commandline -ct)" if files else "")
    return {"bash": f"_meshwright_{kind}", "zsh": zsh, "fish": f"({fish})"}


def _bash_function(kind, words, files):
    also = '; compgen -f -- "$1"' if files else ""
    return f"_meshwright_{kind}() {{ compgen -W {shlex.quote(' '.join(words))} -- \"$1\"{also}; }}\n"
