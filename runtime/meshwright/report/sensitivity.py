"""What each misalignment does: the whole analysis of the drive with it, either way."""

import difflib
import math
from dataclasses import dataclass

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.contact.results import TCA
from meshwright.cycle.pairs import Mesh
from meshwright.cycle.transmission import peak_to_peak
from meshwright.report.branches import breaks
from meshwright.report.numbers import number, unit

#: Size and label of a misalignment that a workshop would call small, by the unit of its key.
STEPS = {"mm": (0.01, "0.01\N{NO-BREAK SPACE}mm"), "deg": (1 / 60, "1′"), "um": (1.0, "1\N{NO-BREAK SPACE}µm")}


@dataclass(frozen=True)
class Sensitivity:
    """Effect of one misalignment of ``step`` (unit of its key, shown as ``label``), N input angles.

    ``minus``, ``plus``: the analyses on either side, and ``breaks`` of their curves. ``peak_to_peak``: of the
    transmitted error, rad, on either side.
    """

    key: str
    meaning: str
    label: str
    step: float
    minus: TCA
    plus: TCA
    breaks: tuple[np.ndarray, np.ndarray]
    peak_to_peak: tuple[float, float]

    @property
    def touches(self):
        """Whether the flanks touch on either side."""
        return bool(np.isfinite([self.minus.error, self.plus.error]).any())

    @property
    def at_points(self):
        """Whether they touch at a point of a flank, an edge or a corner on either side."""
        return bool(np.isfinite([self.minus.points, self.plus.points]).any())


def misalignments(design):
    """The misalignments of a design's family: its parameter entries of that table."""
    return [p for p in design.description["parameters"] if p["table"] == "misalignment"]


def checked_sizes(design, sizes):
    """The ``sizes`` by key that are chosen for misalignments; each must be one of the design's, above zero."""
    known = [p["key"] for p in misalignments(design)]
    for key, size in sizes.items():
        if key not in known:
            near = difflib.get_close_matches(key, known, 1)
            remedy = f"did you mean {near[0]}?" if near else f"choose one of {', '.join(known) or 'none: it has none'}"
            raise UsageError(f"--misalign {key}={size:g}: this drive has no such misalignment; {remedy}")
        if not (math.isfinite(size) and size > 0.0):
            raise UsageError(f"--misalign {key}={size:g}: must be above zero; either way is shown")
    return sizes


def sensitivity(drive, parameter, angles, size=None):
    """The :class:`Sensitivity` of one misalignment at ``angles`` (rad), of ``size`` in the unit of its key."""
    step, label = STEPS[parameter["key_unit"]]
    if size is not None:
        step, label = size, f"{number(size)}\N{NO-BREAK SPACE}{unit(parameter['key'])}"
    key, given = parameter["key"], drive.design.value(parameter["key"], "misalignment") / parameter["factor"]
    minus, plus = (drive.with_(misalignment={key: given + d}) for d in (-step, step))
    below, above = minus.tca(angles), plus.tca(angles)
    return Sensitivity(
        key=key,
        meaning=parameter["meaning"],
        label=label,
        step=step,
        minus=below,
        plus=above,
        breaks=(breaks(minus, below), breaks(plus, above)),
        peak_to_peak=(_peak_to_peak(minus), _peak_to_peak(plus)),
    )


def _peak_to_peak(drive):
    return peak_to_peak(Mesh.of(drive))
