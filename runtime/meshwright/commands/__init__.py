"""Commands: each module has ``add_arguments(parser)`` and ``run(options) -> exit status``."""

from meshwright.commands import drives, ratio, report, schema, tca

ALL = (drives, tca, ratio, report, schema)
