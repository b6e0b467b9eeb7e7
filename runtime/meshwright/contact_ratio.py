"""Contact ratio of a drive: where contact begins and ends and why, teeth in contact, transmission error, backlash."""

from dataclasses import dataclass

from meshwright.backlash import backlash
from meshwright.pairs import Mesh
from meshwright.transmission import TransmissionError, transmission_error
from meshwright.windows import Event


@dataclass(frozen=True)
class ContactRatio:
    """Angles in rad, as the user counts them; NaN for what does not exist.

    ``begin`` and ``end`` in the order in which the driving pinion turns. ``status`` is the status word of the path of
    contact; without one there is no ``transmission_error``. ``backlash`` is an angle of the wheel, negative where the
    drive jams. ``mesh`` answers for any angle which pairs touch.
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
    )
