"""Commands: each module has ``add_arguments(parser)`` and ``run(options) -> exit status``."""

from importlib import import_module

#: Command → module, imported when the command is asked for; the order is that of the help.
MODULES = {
    name: f"meshwright.commands.{name}"
    for name in (
        "drives", "new", "show", "explain", "tca", "surface", "ratio", "limits", "loaded", "fe", "sweep", "report",
        "live", "schema", "grid", "measured", "identify", "completion",
    )
} | {"import": "meshwright.commands.rexs_import", "export": "meshwright.commands.rexs_export"}  # fmt: skip


def module(name):
    """The module of a command."""
    return import_module(MODULES[name])
