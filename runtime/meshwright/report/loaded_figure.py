"""Contact under load over one pitch: transmission error, share of each pair, peak pressure."""

import numpy as np

from meshwright.report import style

#: A pair counts for the axis of pressure if it carries more than this part of the load.
LEAST_SHARE = 0.1

#: That axis is so much higher than the highest peak of these pairs.
ROOM = 1.1


def draw(analysis):
    """Loaded transmission error, and share and pressure of every pair that carries, over the pinion angle."""
    points = analysis.loaded["points"]
    angles = np.array([point["pinion_angle_deg"] for point in points])
    figure = style.figure(6.4, 6.2)
    error, share, pressure = figure.subplots(3, 1, sharex=True)
    errors = [p["loaded_transmission_error_arcsec"] if p["pairs"] else np.nan for p in points]
    error.plot(angles, errors, color=style.WHEEL, marker=".")
    error.set_ylabel("loaded error, arcsec")
    numbers = sorted({pair["pairs_later"] for point in points for pair in point["pairs"]})
    for number in numbers:
        colour = style.PINION if number == 0 else style.SOFT
        for axes, key in ((share, "share"), (pressure, "peak_pressure_mpa")):
            values = [_of(point, number, key) for point in points]
            axes.plot(angles, values, color=colour, marker=".", label="this pair" if number == 0 else None)
    share.set(ylabel="share of the load", ylim=(0.0, 1.05))
    share.legend(loc="lower right", bbox_to_anchor=(1.0, 0.98), borderaxespad=0.0)
    carrying = [pair for point in points for pair in point["pairs"] if pair["share"] > LEAST_SHARE]
    highest = max((pair["peak_pressure_mpa"] for pair in carrying if not pair.get("carried_by_edge")), default=None)
    pressure.set(xlabel="pinion angle, deg", ylabel="peak pressure, MPa", ylim=(0.0, highest and ROOM * highest))
    return figure


def _of(point, number, key):
    """What a pair has, not a number where an edge carries it and its peak of pressure would dwarf all others."""
    pair = next((pair for pair in point["pairs"] if pair["pairs_later"] == number), None)
    if pair is None or (key == "peak_pressure_mpa" and pair.get("carried_by_edge")):
        return np.nan
    return pair[key]
