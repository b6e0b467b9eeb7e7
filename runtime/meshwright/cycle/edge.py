"""Does a drive whose transmission error is designed as a parabola run on an edge?

The parabola absorbs the errors of assembly while its vertex lies between the ends of contact. If the extreme of a
pair's error is at an end, the pair drives until its contact leaves the flank over the edge of a face.
"""

from meshwright.cycle.pairs import Mesh
from meshwright.cycle.transmission import rides_on_edge


def edge_window(drive):
    """Smaller and larger pinion angle, rad, of a pair that runs on an edge; None if it does not, or has no ends."""
    mesh = Mesh.of(drive)
    window = mesh.window
    if mesh.path is None or not window.complete or not rides_on_edge(mesh):
        return None
    return tuple(sorted((window.begin.angle, window.end.angle)))
