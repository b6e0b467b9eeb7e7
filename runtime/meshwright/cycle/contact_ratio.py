"""Contact ratio of a drive: where contact begins and ends and why, teeth in contact, transmission error, backlash."""

from dataclasses import dataclass

from meshwright.cycle.backlash import backlash
from meshwright.cycle.pairs import Mesh
from meshwright.cycle.parallel import backlash_lengths, transverse_contact_ratio
from meshwright.cycle.transmission import TransmissionError, transmission_error
from meshwright.cycle.windows import Event


@dataclass(frozen=True)
class ContactRatio:
    """Angles in rad, as the user counts them; NaN for what does not exist.

    ``begin`` and ``end`` in the order in which the driving pinion turns. ``status`` is the status word of the path of
    contact; without one there is no ``transmission_error``. ``backlash`` is an angle of the wheel, negative where the
    drive jams; ``backlash_lengths``: on the working pitch circles and along the normal, mm.
    ``transverse_contact_ratio`` and ``overlap_ratio``: of flanks that touch along lines, on parallel axes. ``mesh``
    answers for any angle which pairs touch. ``impossible`` are the flags of points between begin and end that bodies
    cannot make: the figures are then those of the flanks' extremes or, without a blank, of the equations alone.
    """

    begin: Event
    end: Event
    status: str
    contact_ratio: float
    average_over_pitch: float
    average_begin_to_end: float
    transmission_error: TransmissionError | None
    backlash: float
    backlash_lengths: tuple[float, float]
    transverse_contact_ratio: float
    overlap_ratio: float
    mesh: Mesh
    impossible: tuple[str, ...]


def contact_ratio(drive):
    """The :class:`ContactRatio` of a drive."""
    mesh = Mesh.of(drive)
    window, play, transverse = mesh.window, backlash(drive), transverse_contact_ratio(mesh)
    return ContactRatio(
        begin=window.begin,
        end=window.end,
        status=mesh.status,
        contact_ratio=mesh.contact_ratio,
        average_over_pitch=mesh.average_over_pitch(),
        average_begin_to_end=mesh.average_begin_to_end(),
        transmission_error=transmission_error(mesh) if window.path is not None or window.complete else None,
        backlash=play,
        backlash_lengths=backlash_lengths(mesh, play),
        transverse_contact_ratio=transverse,
        overlap_ratio=mesh.contact_ratio - transverse,
        mesh=mesh,
        impossible=mesh.impossible,
    )
