"""Symbols that carry their unit, frame, meaning and domain, and the keys by which a design names them."""

from dataclasses import dataclass, field
from enum import StrEnum
from functools import cache
from typing import Any, Self, TypeAlias

import sympy as sp

from derive.language.vectors import Number
from derive.language.written import remember

#: Lower and upper end of an open interval.
Domain: TypeAlias = tuple[Number, Number]

class Quantity(sp.Symbol):
    """A real SymPy symbol with unit, frame, meaning, open domain and parity.

    Two quantities with one name are equal to SymPy; a drive therefore uses each name once. ``parity`` is −1 where the
    mirror image of the drive (y → −y in every frame) has the negative number: an angle of rotation about an axis in
    the mirror's plane. Design keys describe the drive before it is mirrored and keep their numbers.
    """

    __slots__ = ("unit", "meaning", "frame", "domain", "parity")

    unit: str
    meaning: str
    frame: str
    domain: tuple[sp.Expr, sp.Expr]
    parity: int

    def __new__(
        cls,
        name: str,
        unit: str = "",
        meaning: str = "",
        frame: str = "",
        domain: Domain = (-sp.oo, sp.oo),
        parity: int = 1,
    ) -> Self:
        self = sp.Symbol.__xnew__(cls, name, real=True)
        self.unit, self.meaning, self.frame, self.parity = unit, meaning, frame, parity
        remember(name)
        low, high = domain
        self.domain = sp.sympify(low), sp.sympify(high)
        return self

    def __str__(self) -> str:
        return self.name

    def __getnewargs_ex__(self) -> tuple[tuple[object, ...], dict[str, object]]:
        return (self.name, self.unit, self.meaning, self.frame, self.domain, self.parity), {}


def rotation_angle(name: str, meaning: str, frame: str = "", domain: Domain = (-sp.oo, sp.oo)) -> Quantity:
    """An angle of rotation about an axis in the plane of the mirror: the mirror image has the opposite angle."""
    return Quantity(name, "rad", meaning, frame, domain, parity=-1)


class Table(StrEnum):
    """The tables of a design file that every family may have; a family may name others, such as one a member."""

    FLANK = "flank"
    DESIGN = "design"
    PLACEMENT = "placement"
    MISALIGNMENT = "misalignment"
    BLANK = "blank"
    CONTACT = "contact"


#: Interface unit (key suffix) → the unit used inside and the exact factor to it.
_INTERFACE_UNITS: dict[str, tuple[str, sp.Expr]] = {
    "mm": ("mm", sp.S.One),
    "um": ("mm", sp.Rational(1, 1000)),
    "deg": ("rad", sp.rad(1)),
    "per_mm": ("1/mm", sp.S.One),
    "mm_per_rad": ("mm/rad", sp.S.One),
    "mm_per_rad2": ("mm/rad^2", sp.S.One),
    "in": ("mm", sp.Rational(254, 10)),
    "per_in": ("1/mm", sp.Rational(10, 254)),
}

#: Endings of keys → those of the keys for which they stand, and by what their numbers, in inner units, are larger.
CONVERSIONS: tuple[tuple[str, str, sp.Expr], ...] = (
    ("_in", "_mm", sp.S.One),
    ("_diameter_mm", "_radius_mm", sp.Integer(2)),
    ("_radius_mm", "_diameter_mm", sp.Rational(1, 2)),
)


#: Words of units that end no key of another unit: those above, and others that a key might be meant in.
_OF_UNITS = {
    "mm", "um", "deg", "per", "rad", "rad2", "m", "cm", "nm", "inch", "grad", "gon", "degree", "degrees", "arcmin",
    "arcsec", "rpm", "percent",
}  # fmt: skip


def foreign_unit(key: str) -> str:
    """The word of a unit that ends a key before its suffix, as of a length in cm or a slope per deg, or ""."""
    word = key.removesuffix(interface_unit(key)[0]).rstrip("_").rpartition("_")[2]
    return word if word in _OF_UNITS else ""


def unit_suffixes() -> tuple[str, ...]:
    """The suffixes of keys that name a unit."""
    return tuple(_INTERFACE_UNITS)


@cache
def interface_unit(key: str) -> tuple[str, str, sp.Expr]:
    """Unit suffix of an interface key ("" for a pure number), the inner unit and the exact factor to it."""
    suffix = max((u for u in _INTERFACE_UNITS if key.endswith("_" + u)), key=len, default="")
    unit, factor = _INTERFACE_UNITS.get(suffix, ("", sp.S.One))
    return suffix, unit, factor


@dataclass(frozen=True)
class Parameter:
    """One entry of a drive's parameter vector and the key that sets it in a design file.

    ``default`` is in inner units. ``required`` parameters must be given. The domain is open; ``lower_included`` adds
    its lower end. Where both are given, it must exceed the one with the key ``above`` in the same table. A parameter
    that is neither given nor derived (see :class:`Rule`) stays "not a number": a limit that uses it is not applied.
    """

    symbol: Quantity
    key: str
    table: str = Table.DESIGN
    default: sp.Expr | None = None
    required: bool = False
    integer: bool = False
    lower_included: bool = False
    above: str | None = None
    choices: tuple[tuple[str, int], ...] = ()

    def __post_init__(self) -> None:
        remember(self.key, self.place)

    @property
    def place(self) -> str:
        """The key with its table, by which guards and requirements name it; of [design] the key alone."""
        return self.key if self.table == Table.DESIGN else f"{self.table}.{self.key}"

    @property
    def factor(self) -> sp.Expr:
        """Exact factor from the interface unit to the inner unit."""
        return interface_unit(self.key)[2]


def parameter(
    key: str,
    symbol: str,
    meaning: str,
    *,
    table: str = Table.DESIGN,
    domain: Domain = (-sp.oo, sp.oo),
    default: Number | None = None,
    **kind: Any,  # noqa: ANN401  the other fields of a Parameter
) -> Parameter:
    """Declare a parameter by its design key; the inner unit follows from the key's suffix."""
    _, unit, _ = interface_unit(key)
    value = None if default is None else sp.sympify(default)
    return Parameter(Quantity(symbol, unit, meaning, domain=domain), key, table, value, **kind)


@dataclass(frozen=True)
class Rule:
    """``target`` = ``value`` unless the design gives the target; ``why`` says so to readers. Rules run in order."""

    target: Quantity
    value: sp.Expr
    why: str = ""


@dataclass(frozen=True)
class Guard:
    """A design is legal only where ``positive`` > 0; otherwise ``message`` names the keys that meet in it."""

    positive: sp.Expr
    message: str
    keys: tuple[str, ...]


@dataclass(frozen=True)
class Unknown:
    """An unknown of a system with its bounds and the natural size of its steps (an expression of parameters)."""

    symbol: Quantity
    scale: sp.Expr = field(default_factory=lambda: sp.Integer(1))
