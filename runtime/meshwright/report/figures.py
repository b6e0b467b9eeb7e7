"""The figures of a report, drawn once with Matplotlib: SVG inside the page, PDF or PNG for print."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, MaxNLocator, NullFormatter

from meshwright.contact.results import ARCSEC
from meshwright.report import loaded_figure, pattern_figure, sensitivity_figures, style, whole_figure
from meshwright.report.branches import broken
from meshwright.report.layout import arrange
from meshwright.report.numbers import number as text_of

PINION_ANGLE = "pinion angle, deg"

#: Least room above and below a curve, arcsec or µm.
LEAST_ROOM = 1e-4

#: Specific sliding beyond this is not drawn.
MOST_SPECIFIC = 20.0


@dataclass(frozen=True)
class Picture:
    """A figure of the report: file ``name``, ``title``, ``caption`` in words, and how it is drawn from an analysis."""

    name: str
    title: str
    caption: str
    draw: Callable[..., Figure]

    def figure(self, analysis):
        """The drawn figure, with the settings of :func:`~meshwright.report.style.drawing`."""
        figure = self.draw(analysis)
        arrange(figure)
        return figure


def pictures(analysis):
    """The :class:`Picture` list of an analysis: those for which it has numbers."""
    solved, known = analysis.tca.solved.any(), np.isfinite(analysis.tca.error).any()
    effects = analysis.sensitivities
    drawn = []
    if analysis.running is not None and analysis.running.known:
        drawn += [_DRIVE_ERROR, _TEETH]
    elif known:
        drawn.append(_PAIR_ERROR)
    drawn += [_whole_pattern(member, analysis) for member in analysis.whole]
    drawn += [_ease_off(member) for member, w in analysis.whole.items()
              if member == "wheel" and np.isfinite(w.ease_off).any()]  # fmt: skip
    if solved or analysis.lines:
        drawn += [_pattern(member, bool(analysis.lines)) for member in analysis.patches]
    if np.isfinite(analysis.tca.semi_axes).all(axis=1).any():
        drawn.append(_SEMI_AXES)
    if solved:
        drawn.append(_SLIDING)
    if analysis.loaded and any(point["pairs"] for point in analysis.loaded["points"]):
        drawn.append(_loaded(analysis.loaded))
        drawn += [_loaded_lines(member, analysis.loaded) for member in analysis.whole]
    if analysis.running is not None and analysis.running.varies:
        drawn.append(_SPECTRUM)
    if known and any(effect.touches for effect in effects):
        drawn.append(_SENSITIVITY_ERROR)
    if solved and any(effect.at_points for effect in effects):
        drawn.append(_SENSITIVITY_PATH)
    return drawn


_PATTERN_CAPTION = (
    "Path of contact, and where the flanks stand closer than the design's separation (filled, cut off at their edges) "
    "beside the quadratic ellipse (thin, none where it reaches far beyond the flank). Where the path breaks, contact "
    "passes to another branch. Dashed red: where a limit of the design ends the flank."
)


def _whole_pattern(member, analysis):
    shown = "Lines along which the flanks touch" if analysis.lines else "Path of contact and single patches"
    if np.isfinite(analysis.whole[member].alone).any():
        shown += (
            f"; filled where the mate comes nearer than a marking compound of {text_of(1000.0 * analysis.marking)} µm: "
            "dark in the running drive, whose leading pair carries; light where only a pair that carries alone does"
        )
    return Picture(
        f"whole-{member}",
        f"Contact pattern on the whole flank of the {member}, true scale",
        f"{shown}. The border is dashed where nothing in the design ends the flank.",
        lambda analysis: whole_figure.pattern(analysis, member),
    )


def _loaded(document):
    return Picture(
        "loaded",
        f"Under {text_of(document['torque_nm'])} N m on the {document['torque_on']}",
        "Over one pitch, elastic teeth: transmission error, how the pairs share the load, and their peak pressure, "
        "of what an edge presses that of the free contact away from it; of a pair that an edge carries there is none. "
        "Gaps are angles for which the method has no figures.",
        loaded_figure.draw,
    )


def _loaded_lines(member, document):
    return Picture(
        f"loaded-lines-{member}",
        f"Contact lines under load on the {member}, true scale",
        f"Under {text_of(document['torque_nm'])} N m on the {document['torque_on']}, at the positions of the figure "
        "above: where each pair's pressure is highest across its contact area, from end to end of it. The wider the "
        "line, the higher the pair's peak pressure.",
        lambda analysis: whole_figure.loaded_lines(analysis, member),
    )


def _ease_off(member):
    return Picture(
        f"ease-off-{member}",
        f"Ease-off on the {member}",
        "How far the flank stands back from the conjugate of its mate, along the normal, in µm: from the surface that "
        "the mate would envelop at a constant ratio. None where that lies beyond the positions of a pair.",
        lambda analysis: whole_figure.ease_off(analysis, member),
    )


def _pattern(member, along_lines):
    if along_lines:
        caption = "Lines along which the flanks touch, at positions spread over the contact of one pair."
    else:
        caption = _PATTERN_CAPTION
    return Picture(
        f"pattern-{member}",
        f"Contact pattern on the {member}, enlarged",
        caption,
        lambda analysis: pattern_figure.draw(analysis, member),
    )


def _pair_error(analysis):
    figure = style.figure(6.4, 3.7)
    axes = figure.subplots()
    axes.plot(np.degrees(analysis.tca.angles), analysis.tca.error / ARCSEC, color=style.INK)
    _zoom(axes, analysis.tca.error / ARCSEC)
    axes.set(xlabel=PINION_ANGLE, ylabel="transmission error, arcsec")
    return figure


def _drive_error(analysis):
    running = analysis.running
    zero = analysis.tca.reference_error
    figure = style.figure(6.4, 4.6)
    whole, zoom = figure.subplots(2, 1, height_ratios=(3, 2))
    for axes, found in ((whole, running.envelopes), (zoom, running.pitch)):
        angles = np.degrees(found.angles)
        followed = np.array(found.numbers) == 0
        relative = (found.pairs - zero) / ARCSEC
        axes.plot(*_joined(angles, relative[~followed]), color=style.SOFT, linewidth=0.8)
        axes.plot(*_joined(angles, relative[followed]), color=style.PINION, linewidth=1.6, label="this pair")
        transmitted = running.transmitted(found)
        axes.plot(angles, (transmitted - zero) / ARCSEC, color=style.WHEEL, linewidth=2.2, label="transmitted")
        axes.set_ylabel("relative error, arcsec")
    values = [running.transmitted(running.pitch)]
    if running.rigid.edge_contact.any():
        values.append(running.transmitted(running.rigid))
        zoom.plot(angles, (values[-1] - zero) / ARCSEC, "--", color=style.WARN, linewidth=1.2)
        whole.plot([], [], "--", color=style.WARN, linewidth=1.2, label="with edges")
    whole.plot([], [], color=style.SOFT, linewidth=0.8, label="other pairs")
    whole.legend(ncols=4, columnspacing=1.2, loc="lower left", bbox_to_anchor=(0.0, 1.0))
    if running.constant:
        _zoom(whole, (running.envelopes.pairs - zero) / ARCSEC)
    _zoom(zoom, (np.concatenate(values) - zero) / ARCSEC)
    zoom.set(xlabel=PINION_ANGLE)
    zoom.set_title("over one pitch", fontsize=8.5, fontweight="normal")
    return figure


def _joined(angles, rows):
    """Curves (K, N) over the same angles as one curve that breaks between them."""
    ends = np.arange(1, len(rows)) * len(angles)
    return broken(np.tile(angles, len(rows)), ends), broken(np.ravel(rows), ends)


def _zoom(axes, values):
    """Room for the values and a little more, but never so little that round-off shows; as it is without any."""
    known = values[np.isfinite(values)]
    if not known.size:
        return
    low, high = known.min(), known.max()
    room = max(0.15 * (high - low), LEAST_ROOM)
    axes.set_ylim(low - room, high + room)


def _teeth(analysis):
    running = analysis.running
    figure = style.figure(6.4, 4.6)
    count, apart = figure.subplots(2, 1, sharex=True, height_ratios=(2, 3))
    angles = np.degrees(running.pitch.angles)
    count.step(angles, running.teeth, where="mid", color=style.INK)
    count.set(ylabel="teeth in contact", ylim=(0, running.teeth.max() + 1))
    count.yaxis.set_major_locator(MaxNLocator(integer=True, nbins=6))
    followed = np.array(running.pitch.numbers) == 0
    for rows, colour in ((~followed, style.SOFT), (followed, style.PINION)):
        apart.plot(*_joined(angles, 1000.0 * running.separations[rows]), color=colour, linewidth=1.2)
    if running.mesh.allowance > 0.0:
        apart.axhline(1000.0 * running.mesh.allowance, color=style.WARN, linestyle="--", label="elastic allowance")
        apart.legend()
    if np.fmax.reduce(running.separations, axis=None) * 1000.0 < LEAST_ROOM:
        apart.set_ylim(-LEAST_ROOM, LEAST_ROOM)
    apart.set(xlabel=PINION_ANGLE, ylabel="separation of each pair, µm")
    return figure


def _semi_axes(analysis):
    figure = style.figure(6.4, 3.6)
    axes = figure.subplots()
    angles = np.degrees(broken(analysis.tca.angles, analysis.breaks))
    for column, name, line in ((0, "major", "-"), (1, "minor", "--")):
        values = broken(analysis.tca.semi_axes[:, column], analysis.breaks)
        axes.plot(angles, values, line, color=style.INK, label=f"{name} semi-axis")
    axes.set(xlabel=PINION_ANGLE, ylabel="semi-axis, mm", yscale="log")
    axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axes.yaxis.set_major_formatter("{x:g}")
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.legend()
    return figure


def _sliding(analysis):
    moving, angles = analysis.moving, np.degrees(broken(analysis.tca.angles, analysis.breaks))
    figure = style.figure(6.4, 4.6)
    speeds, specific = figure.subplots(2, 1, sharex=True)
    for velocity, name, line in ((moving.sliding, "sliding", "-"), (moving.entraining, "entraining", "--")):
        values = broken(np.linalg.norm(velocity, axis=1), analysis.breaks)
        speeds.plot(angles, values, line, color=style.INK, label=name)
    speeds.set(ylabel="velocity, mm/rad", ylim=(0.0, None))
    for member, values in moving.specific_sliding.items():
        shown = np.where(np.abs(values) < MOST_SPECIFIC, values, np.nan)
        if np.isnan(shown).all():
            continue
        specific.plot(angles, broken(shown, analysis.breaks), color=style.MEMBERS[member], label=member)
    specific.set(xlabel=PINION_ANGLE, ylabel="specific sliding")
    for axes in (speeds, specific):
        axes.legend(ncols=2, loc="lower right", bbox_to_anchor=(1.0, 0.98), borderaxespad=0.0)
    return figure


def _spectrum(analysis):
    amplitudes = analysis.running.amplitudes / ARCSEC
    figure = style.figure(6.4, 3.6)
    axes = figure.subplots()
    axes.bar(np.arange(1, len(amplitudes) + 1), amplitudes, width=0.6, color=style.WHEEL)
    axes.set(xlabel="tooth order", ylabel="amplitude, arcsec")
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    axes.grid(visible=False, axis="x")
    return figure


_PAIR_ERROR = Picture(
    "transmission-error",
    "Transmission error",
    "Wheel angle less pinion angle over gear ratio, of one pair.",
    _pair_error,
)
_DRIVE_ERROR = Picture(
    "transmission-error",
    "Transmission error of the pairs and of the drive",
    "Wheel angle less pinion angle over gear ratio, less its value at the reference angle. The wheel follows the pair "
    "that leads: the transmitted envelope. Dashed: of rigid teeth, whose edges go on where a flank has ended.",
    _drive_error,
)
_TEETH = Picture(
    "contact-teeth",
    "Teeth in contact over one pitch",
    "Above: how many pairs share contact. Below: how far each pair inside its window stands from touching while the "
    "leading pair touches, along the contact normal.",
    _teeth,
)
_SEMI_AXES = Picture(
    "semi-axes",
    "Size of the contact ellipse",
    "Semi-axes of the contact ellipse at the design's separation, logarithmic.",
    _semi_axes,
)
_SLIDING = Picture(
    "sliding",
    "Sliding along the path of contact",
    "Above: velocity of the pinion's flank relative to the wheel's, and mean velocity of both through the contact, for "
    f"one radian of the pinion a second. Below: specific sliding, left out beyond {MOST_SPECIFIC:g}, where a flank "
    "almost rests in the contact.",
    _sliding,
)
_SPECTRUM = Picture(
    "fourier",
    "Fourier components of the transmission error",
    "Amplitudes of the transmitted error by tooth order: 1 is once a pinion pitch.",
    _spectrum,
)
_SENSITIVITY_ERROR = Picture(
    "sensitivity-transmission-error",
    "Change of the transmission error under misalignment",
    "Relative transmission error of one pair with one misalignment, less that of the design as given. The constant "
    "offset is in the table below. A misalignment under which no contact is found has no panel.",
    sensitivity_figures.error,
)
_SENSITIVITY_PATH = Picture(
    "sensitivity-path",
    "Path of contact on the wheel under misalignment",
    "With each misalignment alone, either way, on top of the design as given; the axes are stretched, each by its own "
    "scale. One under which no point touches has no panel.",
    sensitivity_figures.path,
)
