"""Options that several commands share: designs, settings and angles."""

import argparse
import re
import sys

import numpy as np

from meshwright.base.errors import DesignError, UsageError
from meshwright.contact.analysis import largest_angle
from meshwright.contact.friction import Friction
from meshwright.design import description, outline
from meshwright.design import design as designs
from meshwright.drive import BACKENDS, Drive


def add_design(parser):
    """DESIGN, --set and --backend."""
    parser.add_argument("design", metavar="DESIGN", help="packaged design or TOML file")
    parser.add_argument(
        "--set", action="append", default=[], metavar="TABLE.KEY=VALUE", help="change a key of the design; repeatable"
    )
    parser.add_argument("--backend", choices=sorted(BACKENDS), default="c", help="what evaluates the equations")


def drive_of(options):
    """The drive that the options ask for."""
    changes = dict(setting(text) for text in options.set)
    return Drive.from_tables(designs.changed(designs.read(options.design), changes), options.backend)


def setting(text):
    """``TABLE.KEY=VALUE`` as (place, value)."""
    place, equals, value = text.partition("=")
    if not equals or not place:
        raise UsageError(f"--set {text}: not TABLE.KEY=VALUE; for example --set misalignment.vertical_deg=0.05")
    try:
        return place.strip(), designs.parsed(f"value = {value}", "--set")["value"] if "\n" not in value else value
    except DesignError:  # text without quotes, or what no number or table can be
        return place.strip(), value.strip()


#: As many sizes are named at most where flanks do not meet.
HANDFUL = 5

#: More angles than this are taken for a mistake.
MOST_ANGLES = 10_000_000

_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"


def angles(text):
    """Radians from ``A:B:STEP`` (both ends included) or ``v1,v2,…`` in degrees."""
    if re.fullmatch(rf"{_NUMBER}:{_NUMBER}:{_NUMBER}", text):
        return np.radians(_spaced(text))
    if re.fullmatch(rf"{_NUMBER}(,{_NUMBER})*", text):
        return np.radians(_degrees(text, text.split(",")))
    raise UsageError(f"--phi-deg {text}: not A:B:STEP and not v1,v2,…; for example --phi-deg=-400:400:50")


def _spaced(text):
    begin, end, step = _degrees(text, text.split(":"))
    if step == 0:
        raise UsageError(f"--phi-deg {text}: a step of 0 leads nowhere; give another")
    if (end - begin) / step < 0:
        raise UsageError(f"--phi-deg {text}: the step does not lead from the first angle to the last; change its sign")
    steps = np.floor((end - begin) / step + 1e-9)
    if steps >= MOST_ANGLES:
        raise UsageError(f"--phi-deg {text}: {steps:g} angles; choose a larger step")
    return begin + step * np.arange(int(steps) + 1)


def _degrees(text, words):
    values = [float(word) for word in words]
    if not np.all(np.abs(values) <= np.degrees(largest_angle())):
        most = int(np.degrees(largest_angle()))
        raise UsageError(f"--phi-deg {text}: an angle is beyond {most} degrees; give smaller angles")
    return values


def beside_proportions(drive):
    """A handful of sizes that leave the family's proportions, a sentence each."""
    solved = drive.design.as_solved()
    tables = {name: entries for name, entries in solved.items() if isinstance(entries, dict)}
    given = {f"{table}.{key}": value for table, entries in tables.items() for key, value in entries.items()}
    return outline.beside_proportions(description.families()[drive.design.family], given)[:HANDFUL]


def say_proportions(drive):
    """On standard error, for flanks that meet nowhere: a handful of sizes that leave the family's proportions."""
    if told := beside_proportions(drive):
        print("the flanks meet at none of these angles; first to look at:", *told, sep="\n  ", file=sys.stderr)


#: Magnitudes of an option's number, in its own unit, outside which products and quotients of it leave double precision.
SMALLEST = 1e-12
LARGEST = 1e12


def beyond_arithmetic(value):
    """Why a number is not computed with, empty if it is: it is neither 0 nor of a magnitude that can be."""
    if 0.0 < abs(value) < SMALLEST:
        return f"smaller than {SMALLEST:g}; choose a larger number"
    return f"larger than {LARGEST:g}; choose a smaller number" if abs(value) > LARGEST else ""


def say_other_design(drive, points):
    """On standard error, that measured points were written for another design than this one, if they were."""
    from meshwright.shop.located import other_design

    if other := other_design(drive, points):
        print(f"note: {other}", file=sys.stderr)


def number(text):
    """A finite number, for an option."""
    if not re.fullmatch(_NUMBER, text) or not np.isfinite(value := float(text)):
        raise argparse.ArgumentTypeError(f"{text}: not a finite number")
    if reason := beyond_arithmetic(value):
        raise argparse.ArgumentTypeError(f"{text}: {reason}")
    return value


def positive(text):
    """A finite number above zero, for an option."""
    if not (value := number(text)) > 0.0:
        raise argparse.ArgumentTypeError(f"{text}: must be above zero")
    return value


def key_and_size(option, text, example):
    """``KEY=SIZE`` as (key, size above zero)."""
    key, _, size = text.partition("=")
    try:
        return key.strip(), positive(size.strip())
    except argparse.ArgumentTypeError as error:
        raise UsageError(f"{option} {text}: not KEY=SIZE with a size above zero ({error}); e.g. {example}") from None


def numbers(text, kind=number):
    """Numbers ``v1,v2,…``, for an option."""
    return tuple(kind(part) for part in text.split(","))


def radii(text):
    """Radii ``r1,r2,…``, for an option."""
    return numbers(text, positive)


def count(text):
    """A positive whole number, for an option."""
    if not re.fullmatch(r"[1-9]\d*", text):
        raise argparse.ArgumentTypeError(f"{text}: not a positive whole number")
    return int(text)


def add_angles(parser):
    """--phi-deg."""
    parser.add_argument(
        "--phi-deg", metavar="A:B:STEP|v1,v2,…",
        help="pinion angles, degrees; default: one pitch in 12 steps about the angle to which relative errors refer",
    )  # fmt: skip


def angles_of(options, drive):
    """The angles asked for, rad."""
    if options.phi_deg is not None:
        return angles(options.phi_deg)
    return drive.about_the_middle(np.linspace(-0.5, 0.5, 13))


def add_friction(parser):
    """--friction and --pinion-rpm."""
    parser.add_argument(
        "--friction", metavar="MU|FILE.csv",
        help="coefficient of friction, or a table velocity_m_per_s,friction: adds the efficiency",
    )  # fmt: skip
    parser.add_argument("--pinion-rpm", type=positive, metavar="N", help="speed of the pinion, for a table of friction")


def friction_of(options):
    """The friction that the options give, None if they give none."""
    if options.friction is None:
        if options.pinion_rpm is not None:
            raise UsageError(f"--pinion-rpm {options.pinion_rpm:g}: only a table of friction needs it: give --friction")
        return None
    return Friction.of(options.friction, options.pinion_rpm)
