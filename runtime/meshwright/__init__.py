"""meshwright: tooth contact analysis on generated gear meshing equations.

>>> import numpy as np
>>> from meshwright import Drive
>>> drive = Drive.load("recess-action-full")
>>> result = drive.tca(np.radians([400.0, 800.0]))
>>> result.status
('converged', 'converged')
"""

from meshwright.base.errors import DesignError, UsageError
from meshwright.contact.results import TCA
from meshwright.drive import Drive

__all__ = ["TCA", "DesignError", "Drive", "UsageError"]
