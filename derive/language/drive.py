"""What a drive is to every later stage: bodies on motions, parameters, and the limits that its flanks have."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from enum import Enum
from functools import cached_property
from typing import TypeAlias

import sympy as sp

from derive.language.chain import Motion
from derive.language.definitions import Definitions
from derive.language.drawing import Drawing
from derive.language.functions import Function, LeastTeeth, ToolClearance
from derive.language.origin import Cited, cited
from derive.language.outline import Outline
from derive.language.surface import Surface
from derive.language.symbols import Guard, Parameter, Quantity, Rule, Unknown
from derive.language.tool import Tool
from derive.language.vectors import Number, Vector
from derive.language.written import remember

#: Symbols and what they are.
Values: TypeAlias = Mapping[Quantity, Number]


class Role(Enum):
    """What part of a tooth, or of its generation, ends a surface at a margin.

    The blank ends it at tip, throat, face and root; the tool where its edge ends, where the next region joins it, or at
    the bottom of the space; the generation by an undercut, an edge of regression or another sheet of the surface.
    """

    TIP = "tip"
    THROAT = "throat"
    FACE = "face"
    ROOT = "root"
    TOOL_END = "tool_end"
    JUNCTION = "junction"
    BOTTOM = "bottom"
    UNDERCUT = "undercut"
    REGRESSION = "regression"
    SPURIOUS_SHEET = "spurious_sheet"


#: The size that every drive has.
RATIO = "ratio"

#: Ends of a face that lie nearer to the axis and farther from it.
TOE_AND_HEEL = ("toe", "heel")


@dataclass(frozen=True)
class Margin:
    """A limit of validity: where ``positive`` < 0 the point carries ``flag``.

    ``positive`` is formed from body coordinates, surface parameters and design parameters. A limit whose design
    key is not given is "not a number" and never raises its flag. ``event`` is the word by which a contact window
    that ends here says what ended it. A ``relative`` margin is divided by its value at the body's regular
    reference point, for functions whose sign has no meaning of its own. With ``along``, a surface parameter, the
    limit is where ``positive`` stops growing along it. ``role`` is what ends the surface here, by default what the
    event says; ``joins`` names the region of the same member that goes on beyond the limit. ``ends`` are the words for
    the two ends of a face, first the one nearer to the origin of the body, such as toe and heel; where none are given,
    they are the left face and the right one, at larger z.
    """

    flag: str
    event: str
    positive: sp.Expr
    role: Role | None = None
    relative: bool = False
    along: Quantity | None = None
    joins: str = ""
    ends: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if self.role is None and self.event in {role.value for role in Role}:
            object.__setattr__(self, "role", Role(self.event))


@dataclass(frozen=True)
class Body:
    """A member of the drive: its flank in its own frame, its motion in mesh, its limits.

    ``point`` and ``normal`` are symbols for the body-frame coordinates, used by ``margins``. ``reference`` gives
    the surface parameters of a regular point, where the singular function has its good sign; where that sign is known,
    ``regular`` is an expression which has it everywhere, and no point is needed. ``recovered`` are
    parameters that the reduce stage removed and a user still wants to read. ``lengthwise`` is what runs along the
    tooth, for grids and solids: "axial" or "radius" (body frame), the key ("table.key") of the angle of the pitch cone
    along which it lies, or "" for the last surface parameter; the first surface parameter runs across it, along the
    profile.
    """

    name: str
    surface: Surface
    motion: Motion
    reference: Values
    regular: sp.Expr | None = None
    point: tuple[Quantity, ...] = ()
    margins: tuple[Margin, ...] = ()
    recovered: tuple[Quantity, ...] = ()
    lengthwise: str = ""

    def __post_init__(self) -> None:
        remember(self.name, f"flank_{self.name}")

    @cached_property
    def placed(self) -> Surface:
        return self.surface.placed(self.motion)


def body_point(name: str) -> tuple[Quantity, ...]:
    """Symbols for the body-frame coordinates of a contact point, for use in margins."""
    return tuple(Quantity(f"{axis}_at_{name}", "mm", f"{axis} of the point, {name} frame", name) for axis in "xyz")


@dataclass(frozen=True)
class System:
    """Equations ``residual`` = 0 for ``unknowns`` at given parameters and, if there is one, instant.

    ``outputs`` are what the solution is wanted for, ``fixed`` replaces symbols by constants throughout.
    """

    name: str
    definitions: Definitions
    unknowns: tuple[Unknown, ...]
    residual: Vector
    outputs: Values = field(default_factory=dict[Quantity, Number])
    fixed: Values = field(default_factory=dict[Quantity, Number])


#: The share of the way from a system's easy start to the design that is wanted, 0 to 1.
PATH = Quantity("path", "", "share of the way of a continuation")


@dataclass(frozen=True)
class DesignSystem:
    """Equations that a design solves once, before anything else; their solution fills in open parameters.

    Systems run in order after the rules, and the rules run again after each, so that what follows from a solution is
    known to the next. ``residual`` may contain :data:`PATH`: the ``guess`` solves it (nearly) at 0 and the solution is
    followed to 1. ``regular``, where given, is a surface and a sign: sign × its singular function must stay positive
    all along. A design for which this fails is illegal for the reason ``message``, in which ``keys`` meet. ``fills``
    are parameters and their values; a design that gives them all skips the system. ``fixed`` replaces symbols by
    constants throughout. With ``homotopy`` any guess will do that leads there: what the residual is at the guess falls
    to zero along the path. ``start``: the solution only begins the search for contact, and where there is none the
    place nearest to one serves.
    """

    name: str
    unknowns: tuple[Unknown, ...]
    residual: Vector
    guess: Values
    fills: Values
    message: str
    keys: tuple[str, ...]
    fixed: Values = field(default_factory=dict[Quantity, Number])
    regular: tuple[Surface, Number] | None = None
    homotopy: bool = False
    start: bool = False
    definitions: Definitions = field(default_factory=Definitions)

    def __post_init__(self) -> None:
        remember(self.name, f"{self.name}_fill")


@dataclass(frozen=True)
class Region:
    """A surface of a member beside its flank: a fillet, or a surface from which the design was derived.

    It is regular where ``regular`` (a sign) times its singular function is positive. ``margins`` are of surface and
    design parameters; ``lengthwise`` as in :class:`Body`.
    """

    member: str
    name: str
    surface: Surface
    regular: sp.Expr
    margins: tuple[Margin, ...] = ()
    lengthwise: str = ""

    def __post_init__(self) -> None:
        remember(f"{self.member}/{self.name}", f"{self.name}_{self.member}")


@dataclass(frozen=True)
class Source:
    """What a drive's page follows: author, title, year (None if unknown), and where in it."""

    author: str
    title: str
    year: int | None
    where: str = ""


@dataclass(frozen=True)
class ToolUse:
    """A tool as a drive uses it: for which body, under which word of the design file, with which design keys."""

    body: str
    word: str
    tool: Tool
    keys: tuple[str, ...] = ()


@dataclass(frozen=True)
class Loading:
    """How the drive is loaded: how many tooth pairs can share the load, and the member whose torque is stated.

    ``keys`` are design keys ("table.key") that messages about solid teeth name: of a wheel that a threaded tool
    generates its ``wheel_face`` and ``wheel_tip`` and the ``tool_rounding``.
    """

    pairs: int
    torque_on: str
    keys: dict[str, str] = field(default_factory=dict[str, str])


@dataclass(frozen=True)
class Regrind:
    """How a tool that is resharpened enters a design, and the ``command`` that follows it over its life (``summary``).

    Design keys: ``words`` that choose the drive with such a tool, the ``amount`` that is ground off, the ``radius`` of
    the new tool, that of the member for which it stands (``mate``), the ``working`` radius that the tool then has, and
    ``settings`` of the machine, which follow the tool: what a design gives of them is moved as their rules move.
    """

    command: str
    summary: str
    words: dict[str, str]
    amount: str
    radius: str
    mate: str
    working: str
    settings: tuple[str, ...] = ()


@dataclass(frozen=True)
class Count:
    """A whole number from ``least`` to ``most``, or any from there on: how a key that counts chooses a drive."""

    least: int
    most: int | None = None


@dataclass(frozen=True)
class Drive:
    """A gear drive, complete: the input of the schedule and emit stages.

    ``variant`` are the words of the design file that choose this drive within its family, or numbers
    (:class:`Count`); a key in ``variant_defaults`` may be left out and then follows the key named there, or is the word
    or number there. A drive ``handed``
    "right" or "left", the hand in which its equations are written, exists as its own mirror image. ``pinion_teeth`` is
    the key of the pinion's (worm's) number of teeth. The nominal ratio is that of the wheel's motion (:attr:`law`); a
    page need not say it, and where it does in ``ratio``, ``wheel_angle`` or the size "ratio" it says the same. Of each
    group in ``exclusive`` a design gives exactly one key; of each group in ``together`` ("table.key") all or none.
    ``tools`` are the generating tools with the keys of their own.
    ``reference_angle`` (a parameter, or 0) is the input angle at which the pair meets in the middle of its flanks: the
    start values lead there, and relative transmission errors refer to it.
    ``proportions`` are rules that complete a blank whose sizes the design leaves open, for what needs a whole blank;
    contact itself leaves them open. ``loading`` says how it is usually loaded, ``regrind`` how a resharpened tool
    enters, ``sources`` what its page follows, ``exchange`` what of it a neutral file holds
    (:class:`~derive.exchange.rexs.Exchange`), ``outline`` the function that says how a first design is made,
    ``drawing`` what drawings state of it beside its keys.
    Contact begins on the side from which the driving pinion comes; on an ``ascending_path`` it begins at the smaller
    angle on either flank. ``flanks_apart``: each flank has a design of its own, so that no backlash follows.
    ``least_teeth``, by member, says how the least number of teeth without undercut is sought; ``tool_clearance`` what
    tool must clear finished teeth.
    ``absorbs_errors``: its transmission error is designed as a parabola, whose extreme at an end of contact means that
    the drive runs on an edge.
    """

    name: str
    family: str
    title: str
    parameters: tuple[Parameter, ...]
    rules: tuple[Rule, ...]
    guards: tuple[Guard, ...]
    instant: Quantity
    error: Quantity
    pinion: Body
    wheel: Body
    unknowns: tuple[Unknown, ...]
    residual: Vector
    definitions: Definitions
    start: System
    guess: Values
    sample: Mapping[str, float | int | str]
    sample_angle: float
    pinion_teeth: str
    sizes: tuple[tuple[str, sp.Expr, str], ...] = ()
    ratio: sp.Expr | None = None
    wheel_angle: sp.Expr | None = None
    variant: dict[str, str | Count] = field(default_factory=dict[str, "str | Count"])
    variant_defaults: dict[str, str | int] = field(default_factory=dict[str, "str | int"])
    handed: str = ""
    exclusive: tuple[tuple[str, ...], ...] = ()
    together: tuple[tuple[str, ...], ...] = ()
    systems: tuple[DesignSystem, ...] = ()
    regions: tuple[Region, ...] = ()
    ascending_path: bool = False
    flanks_apart: bool = False
    absorbs_errors: bool = False
    functions: tuple[Function, ...] = ()
    least_teeth: dict[str, LeastTeeth] = field(default_factory=dict[str, LeastTeeth])
    tool_clearance: ToolClearance | None = None
    tools: tuple[ToolUse, ...] = ()
    reference_angle: sp.Expr = sp.S.Zero
    proportions: tuple[Rule, ...] = ()
    loading: Loading | None = None
    regrind: Regrind | None = None
    exchange: object = None
    outline: Callable[[], Outline] | None = None
    drawing: Drawing | None = None
    sources: tuple[Source, ...] = ()

    def __post_init__(self) -> None:
        remember(self.name)

    @property
    def bodies(self) -> tuple[Body, Body]:
        return self.pinion, self.wheel

    @cached_property
    def law(self) -> sp.Expr:
        """Turns of the wheel for one of the pinion, as the wheel's motion has it: the nominal ratio."""
        return self.wheel.motion.law(self.error, self.instant)

    @property
    def turned(self) -> sp.Expr:
        """Angle of the wheel in mesh: nominal angle and transmission error."""
        return self.law * self.instant + self.error

    @property
    def all_sizes(self) -> tuple[tuple[str, sp.Expr, str], ...]:
        """The sizes that the page names, and the ratio, which every drive has."""
        if any(name == RATIO for name, *_ in self.sizes):
            return self.sizes
        return *self.sizes, (RATIO, self.definitions.resolve(self.law), "wheel turns per pinion turn")

    @property
    def completion(self) -> tuple[Rule, ...]:
        """What fills open parameters, in the order in which it runs: the defaults, then the rules."""
        defaults = (Rule(p.symbol, p.default) for p in self.parameters if p.default is not None)
        return *defaults, *self.rules


def citations(drive: Drive) -> Iterator[Cited]:
    """Every statement of the audit record that the pages of a drive cite."""
    for part in (*drive.bodies, *drive.regions):
        yield from cited(part.surface.steps)
    for function in drive.functions:
        yield from cited(function.rests_on)
    for definitions in (drive.definitions, drive.start.definitions, *(s.definitions for s in drive.systems)):
        origins = (definitions.origin(symbol) for symbol, _ in definitions.items())
        yield from cited(origin.statement for origin in origins if origin)
