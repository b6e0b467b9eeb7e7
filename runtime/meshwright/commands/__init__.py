"""Commands: each module has ``add_arguments(parser)`` and ``run(options) -> exit status``.

A command is called as its module is, or by the module's ``NAME``.
"""

from meshwright.commands import (
    drives,
    explain,
    fe,
    limits,
    loaded,
    ratio,
    report,
    rexs_export,
    rexs_import,
    schema,
    show,
    surface,
    sweep,
    tca,
)

ALL = (drives, show, explain, tca, surface, ratio, limits, loaded, fe, sweep, report, schema, rexs_import, rexs_export)
