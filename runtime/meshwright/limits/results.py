"""What limits are asked for and what they are: frozen records in mm and rad, and their plain data."""

from dataclasses import dataclass, field, replace

import numpy as np

from meshwright.flank.pointed import Pointed
from meshwright.limits.clearance import Judgement


@dataclass(frozen=True)
class Request:
    """What to compute beside the default: a section y = C, radii on the pinion, axial positions, fineness of grids."""

    section_y: float | None = None
    radii: tuple[float, ...] = ()
    axial: tuple[float, ...] = ()
    grid: int = 15


@dataclass(frozen=True)
class SurfaceLimit:
    """A point of a flank's undercut line or edge of regression; ``point`` (3,) in the member's frame.

    ``extra`` holds further numbers under their interface names. ``on_flank``: within every limit of the design.
    """

    member: str
    point: np.ndarray
    parameters: dict[str, float] = field(default_factory=dict)
    on_flank: bool = True
    extra: dict[str, float] = field(default_factory=dict)

    @property
    def radius(self):
        """Distance from the member's axis."""
        return float(np.hypot(self.point[0], self.point[1]))

    def seen_in(self, mirror):
        """The same limit of the drive of a :class:`~meshwright.design.mirror.Mirror`."""
        return replace(self, point=self.point * mirror.flip, parameters=mirror.numbers(self.parameters))

    def plain(self):
        data = {"member": self.member, "parameters": self.parameters, "point_mm": self.point.tolist()}
        data |= {"radius_mm": self.radius, "axial_mm": float(self.point[2])}
        return data | self.extra | {"on_flank": self.on_flank}


@dataclass(frozen=True)
class ContactPoint:
    """A contact in generation: ``point`` and ``normal`` (out of the pinion) (3,) fixed frame, ``wheel_point`` (3,)
    wheel frame, ``angle`` of the tool; ``body``: what the drive calls the pinion.
    """

    point: np.ndarray
    normal: np.ndarray
    wheel_point: np.ndarray
    angle: float
    parameters: dict[str, float]
    wheel_radius: float
    body: str
    flags: tuple[str, ...] = ()

    @property
    def radius(self):
        """Distance from the tool's axis."""
        return float(np.hypot(self.point[0], self.point[1]))

    def seen_in(self, mirror):
        """The same contact of the drive of a :class:`~meshwright.design.mirror.Mirror`."""
        return replace(
            self,
            point=self.point * mirror.flip,
            normal=self.normal * mirror.flip,
            wheel_point=self.wheel_point * mirror.flip,
            angle=mirror.sign * self.angle,
            parameters=mirror.numbers(self.parameters),
        )

    def as_limit(self):
        """Plain data as a limit point."""
        return {
            "parameters": self.parameters,
            "point_mm": self.point.tolist(),
            "radius_mm": self.radius,
            "pinion_angle_deg": float(np.degrees(self.angle)),
            "wheel_point_mm": self.wheel_point.tolist(),
            "wheel_radius_mm": self.wheel_radius,
            "flags": list(self.flags),
        }

    def as_profile(self):
        """Plain data as a point of a section profile."""
        return {
            "radius_mm": self.radius,
            f"{self.body}_point_mm": self.point.tolist(),
            "normal": self.normal.tolist(),
            "pinion_angle_deg": float(np.degrees(self.angle)),
            "wheel_point_mm": self.wheel_point.tolist(),
            "parameters": self.parameters,
        }


@dataclass(frozen=True)
class Axis:
    """A line that every contact normal meets, fixed frame of generation; ``direction`` is a unit vector."""

    point: np.ndarray
    direction: np.ndarray

    @property
    def inclination(self):
        """Angle to the tool's axis, 0 to 90°, rad."""
        return float(np.arctan2(np.hypot(self.direction[0], self.direction[1]), abs(self.direction[2])))

    def seen_in(self, mirror):
        """The same axis of the drive of a :class:`~meshwright.design.mirror.Mirror`."""
        return Axis(self.point * mirror.flip, self.direction * mirror.flip)

    def plain(self):
        return {
            "point_mm": self.point.tolist(),
            "direction": self.direction.tolist(),
            "inclination_deg": float(np.degrees(self.inclination)),
        }


@dataclass(frozen=True)
class BranchPoint:
    """A point where a branch of contact turns back (``fold``) or two branches cross (``pitchfork``), and what is proved
    of it (a :class:`~meshwright.contact.certificate.BranchCertificate`).
    """

    angle: float
    kind: str
    point: np.ndarray
    certificate: object

    def seen_in(self, mirror):
        """The same branch point of the drive of a :class:`~meshwright.design.mirror.Mirror`."""
        angle, certificate = mirror.sign * self.angle, self.certificate.seen_in(mirror)
        return BranchPoint(angle, self.kind, self.point * mirror.flip, certificate)

    def plain(self):
        return {
            "pinion_angle_deg": float(np.degrees(self.angle)),
            "kind": self.kind,
            "point_mm": self.point.tolist(),
            "certificate": self.certificate.plain(),
        }


@dataclass(frozen=True)
class Thickness:
    """Tooth thickness at the tip of a member, and the radius at which its teeth become pointed (None: nowhere near)."""

    member: str
    radius: float
    thickness: float
    pointed_radius: float | None

    def plain(self):
        return {
            "member": self.member,
            "radius_mm": self.radius,
            "thickness_mm": self.thickness,
            "pointed_radius_mm": self.pointed_radius,
            "pointed": self.thickness <= 0.0,
        }


@dataclass(frozen=True)
class Limits:
    """Everything that bounds a drive; see the classes above. Only helicoids may have meshing ``axes``.

    ``tool_clearance`` is the :class:`~meshwright.limits.clearance.Judgement` of a drive whose tool must clear its
    teeth; in plain data it goes by the tool's name. ``assumed_blank``: the standard proportions that stand for sizes
    of the blank which the design leaves open, by their keys and in the units of these; ``blank_left_open``: why these
    proportions do not fit the design, whose open blank then bounds nothing, or "". ``omitted``: why a limit was not
    computed, by its name in plain data.
    """

    undercut: tuple[SurfaceLimit, ...] = ()
    regression: tuple[SurfaceLimit, ...] = ()
    first_type: tuple[ContactPoint, ...] = ()
    second_type: tuple[ContactPoint, ...] = ()
    axes: tuple[Axis, ...] = ()
    axes_exist: bool = False
    section_profile: tuple[ContactPoint, ...] = ()
    branch_points: tuple[BranchPoint, ...] = ()
    tip_thickness: tuple[Thickness, ...] = ()
    pointed_teeth: tuple[Pointed, ...] = ()
    least_teeth: dict[str, int] | None = None
    tool_clearance: Judgement | None = None
    assumed_blank: dict[str, float] = field(default_factory=dict)
    blank_left_open: str = ""
    omitted: dict[str, str] = field(default_factory=dict)

    def plain(self):
        """The lists of the ``meshwright.limits/1`` schema."""
        judged = {self.tool_clearance.name: self.tool_clearance.plain()} if self.tool_clearance else {}
        return {
            "undercut": [u.plain() for u in self.undercut],
            "regression": [r.plain() for r in self.regression],
            "first_type": [c.as_limit() for c in self.first_type],
            "second_type": [c.as_limit() for c in self.second_type],
            "meshing_axes": [a.plain() for a in self.axes],
            "meshing_axes_exist": self.axes_exist,
            "section_profile": [c.as_profile() for c in self.section_profile],
            "branch_points": [b.plain() for b in self.branch_points],
            "tip_thickness": [t.plain() for t in self.tip_thickness],
            "pointed_teeth": [p.plain() for p in self.pointed_teeth],
            "least_teeth_without_undercut": self.least_teeth,
            "assumed_blank": self.assumed_blank,
            "blank_left_open": self.blank_left_open or None,
            "not_computed": self.omitted,
        } | judged
