"""What ends the contact of a tooth pair in plain words, and why nothing does."""

import math

import numpy as np

from meshwright.contact.analysis import status_text
from meshwright.cycle.windows import limits_of

#: What each event at the end of a contact window means.
EVENTS = {
    "tip": "the tip",
    "throat": "the throat",
    "face": "the end of the face",
    "root": "the root",
    "tool_end": "the end of the cutting tool",
    "undercut": "an undercut line",
    "regression": "an edge of regression",
    "fold": "a fold, where the branch of contact turns back",
    "none": "nothing in the design",
}

#: Events that a member is named with.
_OF_A_MEMBER = ("tip", "throat", "face", "root")


def event(reason, member):
    """An event in words: what limits contact."""
    what = EVENTS.get(reason, reason.replace("_", " "))
    return f"{what} of the {member}" if member and reason in _OF_A_MEMBER else what


def why_open(mesh):
    """Why the window of a :class:`~meshwright.cycle.pairs.Mesh` lacks an end, with the remedy; None if it has both."""
    window = mesh.window
    if window.complete:
        return None
    if window.path is None:
        return _unlimited(mesh) if window.status == "line_contact" else _untouched(window.status)
    if not (window.begin.exists or window.end.exists) and (beyond := _exceeded(mesh)):
        return f"no position lies within every limit: contact nearest to angle 0 is beyond {_listed(beyond)}; " + (
            "change [blank] or [design]"
        )
    return _unlimited(mesh)


def without_contact(mesh):
    """What a contact ratio below 1 means: over how much of a pitch no flanks touch; "" with others."""
    if not mesh.gap > 0.0:
        return ""
    gap, pitch = (math.degrees(angle) for angle in (mesh.gap, mesh.drive.pitch()))
    return (
        f"without load a pair leaves contact before the next one begins; over {gap:.4g}° of every {pitch:.4g}° of the "
        "pinion no flanks touch, only an edge can"
    )


def _untouched(status):
    return f"{status_text(status)}; change [blank] or [misalignment], or see `meshwright tca`"


def _exceeded(mesh):
    """The limits that contact is beyond at the stored solution nearest to angle 0, in words."""
    path, limits = mesh.window.path, limits_of(mesh.drive)
    nearest = int(np.argmin(np.abs(path.angles)))
    observed = path.observe(path.angles[[nearest]], path.unknowns[[nearest]])[0]
    return [event(limit.reason, limit.member) for limit in limits if observed[limit.index] < 0.0]


def _unlimited(mesh):
    """For contact that leaves the window open: its branch stops there, or no limit is given."""
    window = mesh.window
    missing = [name for name, end in (("begins", window.begin), ("ends", window.end)) if not end.exists]
    said = f"nothing in the design limits where contact {' or '.join(missing)}"
    stopped = [word for word in (window.path.ended if window.path else ()) if word and word != "fold"]
    if stopped:
        return f"{said}, and the branch of contact stops: {status_text(stopped[0])}; change [design] or [misalignment]"
    keys = _open_limits(mesh.drive.design)
    if keys:
        return f"{said}; give limits under [blank]: {', '.join(keys)}"
    return f"{said} within half a turn of the wheel"


def _open_limits(design):
    """Sizes of the blank that the design leaves open. One that may be zero, such as a rounding, is no limit."""
    entries = [p for p in design.description["parameters"] if p["table"] == "blank" and not p["choices"]]
    limits = [p["key"] for p in entries if not p["lower_included"]]
    return [key for key in limits if math.isnan(design.value(key, "blank"))]


def _listed(words):
    return " and ".join(filter(None, (", ".join(words[:-1]), words[-1])))
