"""Commands: each module has ``add_arguments(parser)`` and ``run(options) -> exit status``."""

from meshwright.commands import drives, limits, ratio, report, schema, tca

ALL = (drives, tca, ratio, limits, report, schema)
