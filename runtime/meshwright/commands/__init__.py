"""Commands: each module has ``add_arguments(parser)`` and ``run(options) -> exit status``."""

from meshwright.commands import drives, explain, fe, limits, loaded, ratio, report, schema, show, surface, sweep, tca

ALL = (drives, show, explain, tca, surface, ratio, limits, loaded, fe, sweep, report, schema)
