"""Blade of a face-mill or face-hob cutter: a straight or circular edge and a rounded tip, turned about its axis.

Frame of the cutter: z along its axis towards the blank, tip plane at z = 0, edge in the plane x–z, x outwards. ``side``
+1 is an outside blade, which leaves a concave flank, −1 an inside blade. Surfaces are those of the cutter: their
normals point out of the blade into the metal that it leaves. Of a face mill they are surfaces of revolution. Of a face
hob, against which the blank turns while it cuts, they are those that the edge sweeps in the blank, and the plane of the
edge need not pass through the axis: it is turned by ``offset`` about the vertical line through the reference point.
"""

from dataclasses import dataclass

import sympy as sp

from derive.language import vectors as v
from derive.language.chain import Rz, translation
from derive.language.definitions import Definitions
from derive.language.surface import revolved, swept

#: A straight edge is the arc of this curvature, 1/mm: it stands off the line by less than any round-off.
STRAIGHT = sp.Rational(1, 10**30)


@dataclass(frozen=True)
class CutterBlade:
    """Angles in rad, lengths in mm, ``curvature`` in 1/mm.

    The edge is the arc that touches at arc length ``reference`` from the tip a line through the tip plane at
    ``point_radius``, leaning by ``angle`` from the cutter's axis; ``hand`` is the sense in which θ counts.
    """

    definitions: Definitions
    member: str
    hand: int
    side: sp.Expr
    point_radius: sp.Expr
    angle: sp.Expr
    curvature: sp.Expr
    reference: sp.Expr
    tip_radius: sp.Expr
    offset: sp.Expr = sp.S.Zero

    @property
    def _bend(self):
        return self.definitions.let(
            f"bend_{self.member}", self.curvature + STRAIGHT, "curvature of the edge", "1/mm", "tool"
        )

    @property
    def _along(self):
        """Direction of the line, away from the tip."""
        return self.side * sp.sin(self.angle), sp.Integer(0), -sp.cos(self.angle)

    @property
    def _out(self):
        """Its normal, out of the metal that the blade leaves."""
        return -self.side * sp.cos(self.angle), sp.Integer(0), -sp.sin(self.angle)

    def edge(self, u, theta):
        """The cutting surface at arc length ``u`` along the edge from the tip."""
        return self._revolved(self._arc(u), u, theta, self.side)

    def hobbing_edge(self, u, theta, machine):
        """What the edge sweeps in the blank; ``machine`` is the motion, over θ too, that the cutter has in it."""
        return self._hobbing(self._arc(u), u, theta, machine, self.side)

    def _arc(self, u):
        turned = self._bend * (u - self.reference)
        sagitta = 2 * sp.sin(turned / 2) ** 2 / self._bend
        return v.sub(v.scale(self.reference + sp.sin(turned) / self._bend, self._along), v.scale(sagitta, self._out))

    def swung_edge(self, x, theta):
        """The same, where its normal meets the line at the distance ``x`` from the point of contact with the line.

        With the normal's own measure the equation of meshing is linear in ``x``, whatever the curvature: the point
        where normal and line meet is the pole.
        """
        tangent = self._bend * x
        secant = v.root(1 + tangent**2)
        secant = self.definitions.let(f"secant_{self.member}", secant, "secant of the turn along the arc")
        point = v.sub(
            v.scale(self.reference + x / secant, self._along),
            v.scale(tangent * x / (secant * (secant + 1)), self._out),
        )
        pole = v.scale(self.reference + x, self._along)
        slope = v.sub(self._along, v.scale(tangent, self._out))
        return self._revolved(point, x, theta, self.side, slope).with_pole(self._from_axis(pole))

    def arc_length(self, x):
        """Arc length from the tip of the point ``x`` of :meth:`swung_edge`."""
        shortfall = self.definitions.let(
            f"shortfall_{self.member}", x - v.arc(self._bend * x, sp.Integer(1)) / self._bend,
            "by how much the arc is shorter than the line", "mm", "tool",
        )  # fmt: skip
        return self.reference + x - shortfall

    @property
    def straight_junction(self):
        """Arc length at which the rounding of the tip joins a straight edge."""
        return self.tip_radius * (1 - sp.sin(self.angle)) / sp.cos(self.angle)

    @property
    def sine_at_junction(self):
        """Sine of the inclination of the normal where the rounding of the tip joins the edge, between −1 and 1.

        The rounding touches the tip plane, so its centre is below it by its radius; it touches the arc from outside.
        """
        return sp.sin(self.angle) + self._bend * self._short

    @property
    def inclination_at_junction(self):
        """Inclination of the normal there: the blade angle of a straight edge."""
        return self.definitions.let(
            f"tau_joint_{self.member}", v.arc(self.sine_at_junction, self._cosine_at_junction),
            "inclination of the normal where rounding and edge join", "rad", "tool",
        )  # fmt: skip

    @property
    def junction(self):
        """Arc length at which the rounding of the tip joins the edge."""
        cosine = sp.cos(self.angle) * self._cosine_at_junction + sp.sin(self.angle) * self.sine_at_junction
        return self.definitions.let(
            f"u_joint_{self.member}", self.reference + v.arc(self._bend * self._chord, cosine) / self._bend,
            "along the blade from its tip to where its rounding joins", "mm", "tool",
        )  # fmt: skip

    @property
    def _short(self):
        radius, sine = self.tip_radius, sp.sin(self.angle)
        return self.definitions.let(
            f"short_{self.member}",
            (radius * (1 - sine) - self.reference * sp.cos(self.angle)) / (1 + self._bend * radius),
            "sine at the junction less that of the blade angle, over the curvature", "mm", "tool",
        )  # fmt: skip

    @property
    def _cosine_at_junction(self):
        return self.definitions.let(
            f"cosine_joint_{self.member}", v.root(1 - self.sine_at_junction**2),
            "cosine of the inclination of the normal where rounding and edge join", "", "tool",
        )  # fmt: skip

    @property
    def _chord(self):
        """Sine of the turn along the arc from the reference to the junction, over the curvature; no difference of
        nearly equal numbers, so that it holds for a straight edge.
        """
        sine, cosine = sp.sin(self.angle), sp.cos(self.angle)
        change = sine * (sine + self.sine_at_junction) / (cosine + self._cosine_at_junction)
        return self.definitions.let(
            f"chord_{self.member}", self._short * (cosine + change),
            "along the line from the reference to where rounding and edge join", "mm", "tool",
        )  # fmt: skip

    @property
    def tip_centre(self):
        """Centre of the rounding."""
        chord, sine = self._chord, sp.sin(self.angle)
        turned = sp.cos(self.angle) * self._cosine_at_junction + sine * self.sine_at_junction
        joint = (self.reference + chord) * sine + self._bend * chord**2 / (1 + turned) * sp.cos(self.angle)
        centre = self.side * (joint - self.tip_radius * self._cosine_at_junction)
        centre = self.definitions.let(
            f"x_round_{self.member}", centre, "centre of the rounding from the point radius", "mm", "tool"
        )
        return centre, sp.Integer(0), -self.tip_radius

    def tip(self, tau, theta):
        """The rounding of the tip; ``tau`` is the inclination of its normal."""
        point, slope = self._rounding(tau)
        return self._revolved(point, tau, theta, -self.side, slope).with_pole(self._from_axis(self.tip_centre))

    def hobbing_tip(self, tau, theta, machine):
        """What the rounding sweeps in the blank, as :meth:`hobbing_edge`."""
        point, slope = self._rounding(tau)
        return self._hobbing(point, tau, theta, machine, -self.side, slope)

    def _rounding(self, tau):
        """Point and direction, which a sharp tip has too."""
        out = -self.side * sp.cos(tau), sp.Integer(0), -sp.sin(tau)
        slope = -self.side * sp.sin(tau), sp.Integer(0), sp.cos(tau)
        return v.sub(self.tip_centre, v.scale(self.tip_radius, out)), slope

    def _revolved(self, profile, along, theta, outward, slope=None):
        return revolved(
            self.definitions, self._from_axis(profile), along=along, turn=theta, outward=outward, sense=self.hand,
            slope=slope,
        )  # fmt: skip

    def _hobbing(self, profile, along, theta, machine, outward, slope=None):
        reference = self.side * self.reference * sp.sin(self.angle)
        plane = translation(x=self.point_radius + reference) @ Rz(self.hand * self.offset)
        return swept(
            self.definitions, v.sub(profile, (reference, sp.Integer(0), sp.Integer(0))),
            machine @ Rz(self.hand * theta) @ plane, along=along, sweep=theta, outward=self.hand * outward,
            arm=self.point_radius, slope=slope, screw=f"hobbing_{self.member}",
        )  # fmt: skip

    def _from_axis(self, point):
        return v.add((self.point_radius, sp.Integer(0), sp.Integer(0)), point)
