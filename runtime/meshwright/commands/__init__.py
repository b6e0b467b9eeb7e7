"""Commands: each module has ``add_arguments(parser)`` and ``run(options) -> exit status``."""

from importlib import import_module

#: Command → module, imported when the command is asked for; the order is that of the help.
MODULES = {
    name: f"meshwright.commands.{name}"
    for name in (
        "drives", "new", "show", "explain", "drawing", "tca", "surface", "ratio", "limits", "loaded", "fe", "sweep",
        "report", "live", "schema", "grid", "measured", "identify", "benchmark", "completion",
    )
} | {"import": "meshwright.commands.rexs_import", "export": "meshwright.commands.export"}  # fmt: skip


#: The module of the commands that follow a family's tool over its life, named by the family.
TOOL_LIFE = "meshwright.commands.tool_life"


def every():
    """Command → module: those above, and those that families name."""
    from meshwright.design.description import families

    return MODULES | {f.regrind["command"]: TOOL_LIFE for f in families().values() if f.regrind}


def module(name):
    """The module of a command."""
    return import_module(MODULES[name] if name in MODULES else every()[name])


def summary(name):
    """What a command does, in a line."""
    if name in MODULES:
        return module(name).__doc__.strip().splitlines()[0]
    from meshwright.design.description import families

    return next(f.regrind["summary"] for f in families().values() if f.regrind and f.regrind["command"] == name)
