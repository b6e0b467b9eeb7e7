"""Contact ratio of a drive: where contact begins and ends and why, teeth in contact, transmission error, backlash."""

from dataclasses import dataclass

from meshwright.contact import analysis, results
from meshwright.cycle.backlash import backlash
from meshwright.cycle.pairs import Mesh
from meshwright.cycle.transmission import TransmissionError, transmission_error
from meshwright.cycle.windows import Event


@dataclass(frozen=True)
class ContactRatio:
    """Angles in rad, as the user counts them; NaN for what does not exist.

    ``begin`` and ``end`` in the order in which the driving pinion turns. ``status`` is the status word of the path of
    contact; without one there is no ``transmission_error``. ``backlash`` is an angle of the wheel, negative where the
    drive jams. ``mesh`` answers for any angle which pairs touch. ``impossible`` are the flags of points between begin
    and end that bodies cannot make: the figures are then those of the equations alone.
    """

    begin: Event
    end: Event
    status: str
    contact_ratio: float
    average_over_pitch: float
    average_begin_to_end: float
    transmission_error: TransmissionError | None
    backlash: float
    mesh: Mesh
    impossible: tuple[str, ...]


def contact_ratio(drive):
    """The :class:`ContactRatio` of a drive."""
    mesh = Mesh.of(drive)
    window = mesh.window
    return ContactRatio(
        begin=window.begin,
        end=window.end,
        status=window.status,
        contact_ratio=mesh.contact_ratio,
        average_over_pitch=mesh.average_over_pitch(),
        average_begin_to_end=mesh.average_begin_to_end(),
        transmission_error=None if window.path is None else transmission_error(mesh),
        backlash=backlash(drive),
        mesh=mesh,
        impossible=_impossible(drive, window),
    )


def _impossible(drive, window):
    """Flags that points between the ends of a window carry and that mark what bodies cannot make."""
    path = window.path
    if path is None:
        return ()
    lower, upper = window.bounds
    inside = (path.angles >= lower) & (path.angles <= upper)
    found = analysis.at_solutions(drive, path.angles[inside], path.unknowns[inside])
    return tuple(dict.fromkeys(f for flags in found.flags for f in flags if results.impossible(f)))
