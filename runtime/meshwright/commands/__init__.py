"""Commands: each module has ``add_arguments(parser)`` and ``run(options) -> exit status``."""

from meshwright.commands import drives, fe, limits, loaded, ratio, report, schema, surface, sweep, tca

ALL = (drives, tca, surface, ratio, limits, loaded, fe, sweep, report, schema)
