"""Commands: each module has ``add_arguments(parser)`` and ``run(options) -> exit status``."""

from meshwright.commands import drives, fe, limits, loaded, ratio, report, schema, tca

ALL = (drives, tca, ratio, limits, loaded, fe, report, schema)
