"""Does a drive whose transmission error is designed as a parabola run on an edge?

The parabola absorbs the errors of assembly while its vertex lies between the ends of contact. If the extreme of a
pair's error is at an end, the pair drives until its contact leaves the flank over the edge of a face.
"""

from meshwright.cycle.pairs import Mesh
from meshwright.cycle.transmission import rides_on_edge
from meshwright.cycle.windows import contact_window


def edge_window(drive):
    """Smaller and larger pinion angle, rad, of a pair that runs on an edge; None if it does not, or has no ends."""
    window = contact_window(drive)
    if window.path is None or not window.complete:
        return None
    if not rides_on_edge(Mesh(drive, window)):
        return None
    return tuple(sorted((window.begin.angle, window.end.angle)))
