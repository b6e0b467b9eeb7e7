"""Blade of a face-mill cutter: a straight or circular edge and a rounded tip, turned about the cutter's axis.

Frame of the cutter: z along its axis towards the blank, tip plane at z = 0, edge in the plane x–z, x outwards. ``side``
+1 is an outside blade, which leaves a concave flank, −1 an inside blade. Surfaces are those of the cutter: their
normals point out of the blade into the metal that it leaves.
"""

from dataclasses import dataclass

import sympy as sp

from derive.language import vectors as v
from derive.language.definitions import Definitions
from derive.language.surface import revolved

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
        turned = self._bend * (u - self.reference)
        sagitta = 2 * sp.sin(turned / 2) ** 2 / self._bend
        point = v.sub(
            v.scale(self.reference + sp.sin(turned) / self._bend, self._along), v.scale(sagitta, self._out)
        )
        return self._revolved(point, u, theta, self.side)

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
    def junction(self):
        """Arc length at which the rounding of the tip joins a straight edge."""
        return self.tip_radius * (1 - sp.sin(self.angle)) / sp.cos(self.angle)

    @property
    def tip_centre(self):
        return v.add(v.scale(self.junction, self._along), v.scale(self.tip_radius, self._out))

    def tip(self, tau, theta):
        """The rounding of the tip; ``tau`` is the inclination of its normal, the blade angle at the junction."""
        out = -self.side * sp.cos(tau), sp.Integer(0), -sp.sin(tau)
        point = v.sub(self.tip_centre, v.scale(self.tip_radius, out))
        slope = -self.side * sp.sin(tau), sp.Integer(0), sp.cos(tau)  # also of a sharp tip
        return self._revolved(point, tau, theta, -self.side, slope).with_pole(self._from_axis(self.tip_centre))

    def _revolved(self, profile, along, theta, outward, slope=None):
        return revolved(
            self.definitions, self._from_axis(profile), along=along, turn=theta, outward=outward, sense=self.hand,
            slope=slope,
        )  # fmt: skip

    def _from_axis(self, point):
        return v.add((self.point_radius, sp.Integer(0), sp.Integer(0)), point)
