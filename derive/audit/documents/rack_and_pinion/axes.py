"""Meshing axes: section 5, and what is said in the end."""

from derive.audit.documents.rack_and_pinion import letters
from derive.audit.paragraphs import claims

CLAIMS = claims(
    """
second-line | §5 | SECOND_AXIS
> r_2f = R_2f i_1 + v(-cos α k_1 + sin α j_1)
The moment of a contact normal about this line, whatever v, is sin α f/I and two terms more, which vanish for every
normal where R2f = 0 and tan α = p/R1j.
    dot(cross(r1 - r_2f, along), n)
        = sin(alpha)*f/I + (R1j*sin(alpha) - p*cos(alpha))*dot(n, k1) - R2f*dot(cross(i1, along), n)
where: R1j ≠ 0

decomposition | §5 | AXES
> ω_1 + ω_2 = ω(2) - ω(1);  R_1j i_1×ω_1 + R_2f i_1×ω_2 - A i_1×ω(2) = 0;  R_2f = 0, tan α = p/R_1j
R2f = 0 and tan α = p/R1j are a solution: both equations hold with them. That there is no other is not said here; the
roots at 90° are those of right-angle-roots.
    omega_a + omega_b = omega2 - omega1
    R1j*cross(i1, omega_a) + R2f*cross(i1, omega_b) - cross(seat, omega2) = vec(0, 0, 0)
    tan(alpha) = p/R1j
where: R1j ≠ 0

axis-2 | §5 | WORM
> the second meshing axis passes through the origin (R_2f = 0) and is inclined at an angle α
The moment of a normal about the line of direction p j1 - R1j k1 through o1 is p f/I.
    dot(cross(r1, p*j1 - R1j*k1), n) = p*f/I
where: R1j ≠ 0

lead-angle | §5 | PITCH_HELIX
> an angle α, which is exactly the lead angle of the worm at the pitch circle
A helix of the worm at the derived pitch radius R1j is inclined by the α of tan α = p/R1j. At the nominal reference
radius it is so only when A = r1 + p/I (no profile shift).
reading pitch circle of radius R1j:
    cross(at_pitch, inclined) = vec(0, 0, 0)
reading reference circle of radius r_ref:
    cross(at_reference, inclined) = vec(0, 0, 0)

worm-axis | §5 | WORM
> the other is the worm axis itself (after projection)
The moment of a contact normal about the worm axis is p n·k1, not 0: the second axis passes the worm axis at o1 but is
inclined to it.
    dot(cross(r1, k1), n) = 0
corrected:
    dot(cross(r1, k1), n) = p*dot(n, k1)

existence | §5 | ONES
> It is known that in crossed-axis gear drives where one member has a helical surface (as in worm gear pairs), meshing
> axes exist.
A line that every contact normal of every helicoid meets belongs to a twist -(relative motion) + τ times the screw
motion, which is a rotation only where its axis is square to its velocity, D·W = 0. For p = I = A = 1, 4 D·W is a square
and 4 sin Σ - 2 (1 + cos Σ)(1 + sin Σ), which is 2√2 - 1 at Σ = 135°: no real τ, no meshing axis.
contradiction:
    dot(n, cross(D, r1) + W) = f
    4*dot(D, W) = (2*tau - middle)**2 + 4*sin(shaft) - 2*(1 + cos(shaft))*(1 + sin(shaft))

right-angle-roots | §5 | RIGHT_ANGLE
> the worm gear pair possesses two distinct meshing axes
At 90° the roots are τ = 1 (pitch line) and τ = AI/p (second axis); they are distinct unless R1j = 0.
    dot(D, W) = p*(tau - 1)*(tau - A*I/p)
    A*I/p - 1 = I/p*R1j
where: R1j ≠ 0

uniqueness | §5 | HELICAL
> This property is unique to cylindrical worm gear drives
What is needed is one helicoid, of any profile, not a worm: the pinion of crossed helical gears is one as well
(cylindrical gears, involute helicoid: screw). Helix angles of 45° on both, twice as many teeth on the gear (Σ = 90°, p
= 1, I = 1/2, A = 3) give two distinct meshing axes, at τ = 1 and τ = 3/2.
contradiction:
    dot(n, cross(D, r1) + W) = f
    dot(D, W) = (tau - 1)*(tau - 3/2)

face-width | §4
> important for determining the effective face width of the worm gear
A recommendation, not an equation.
kind: not_mathematical

scope | §6
> applicable to any straight-line or non-straight-line cylindrical worm gear drive that satisfies the orthogonal-axis
> and constant lead conditions
The proofs above hold for every profile (ξ, η, ζ) of constant lead at 90°; the sentence itself is a summary.
kind: not_mathematical

table-r1j | §6 table | WORM
> Derived pitch radius of worm (rack): R_1j = A - p/I
Wheel and sliding worm have one velocity at this distance from the worm's axis and at no other.
    cross(omega2, (x - A)*i1) + p*omega1 = I*(x - (A - p/I))*k1
where: I ≠ 0
""",
    vars(letters),
)
