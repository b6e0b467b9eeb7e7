"""meshwright: tooth contact analysis on generated gear meshing equations.

>>> import numpy as np
>>> from meshwright import Drive
>>> drive = Drive.load("recess-action-full")
>>> result = drive.tca(np.radians([400.0, 800.0]))
>>> result.status
('converged', 'converged')
"""

from importlib import import_module

#: Public name → module that has it, imported when it is first used: tools that need a part do not wait for the rest.
_PLACES = {
    "DesignError": "meshwright.base.errors",
    "Drive": "meshwright.drive",
    "TCA": "meshwright.contact.results",
    "UsageError": "meshwright.base.errors",
    "get_include": "meshwright.base.drives",
}

__all__ = [*_PLACES]


def __getattr__(name):
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_PLACES[name]), name)
