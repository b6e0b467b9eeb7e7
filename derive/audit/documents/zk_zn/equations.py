"""Grinding, cutting and mesh: Eqs (1) to (14)."""

from itertools import product

from derive.audit.documents.zk_zn import letters
from derive.audit.paragraphs import claims

#: Row 2 of Eq (5) as printed, with any signs.
ROW_2 = "\n".join(
    f"""reading signs {a} {b} {c} {d}:
    R2.y = {a.strip("+")}a21*Xh {b} a11*Yh {c} sin(gamma)*cos(phi2)*Zh {d} A2*sin(phi2)"""
    for a, b, c, d in product("+-", repeat=4)
)

CLAIMS = claims(
    f"""
eq-1 | Eq (1) | GRINDING
> R1 = [ Xc cos φ1 � Yc sin φ1 cos λ � Zc sin φ1 sin λ � A1 cos φ1 ; Xc sin φ1 � Yc cos φ1 cos λ � Zc cos φ1 sin λ � A1
> sin φ1 ; Yc sin λ � Zc cos λ � p1φ1 ]
With the signs of the second reading this is the grinding wheel, its axis inclined by λ at distance rc + r1, in screw
motion.
reading every lost sign +:
    R1.x = Xc*cos(phi1) + Yc*sin(phi1)*cos(lam) + Zc*sin(phi1)*sin(lam) + A1*cos(phi1)
    R1.y = Xc*sin(phi1) + Yc*cos(phi1)*cos(lam) + Zc*cos(phi1)*sin(lam) + A1*sin(phi1)
    R1.z = Yc*sin(lam) + Zc*cos(lam) + p1*phi1
reading - - + +; - + - +; + + +:
    R1.x = -Xc*cos(phi1) - Yc*sin(phi1)*cos(lam) + Zc*sin(phi1)*sin(lam) + A1*cos(phi1)
    R1.y = -Xc*sin(phi1) + Yc*cos(phi1)*cos(lam) - Zc*cos(phi1)*sin(lam) + A1*sin(phi1)
    R1.z = Yc*sin(lam) + Zc*cos(lam) + p1*phi1
damage: the signs are lost in the extraction

eq-2 | Eq (2) | GRINDING
> n1 = [ nxc cos φ1 � nyc sin φ1 cos λ � nzc sin φ1 sin λ ; ... ]; nxc = sin α1 cos θ, nyc = sin α1 sin θ, nzc = cos α1
The normal turned like the surface; (sin α1 cos θ, sin α1 sin θ, ±cos α1) is the unit normal of the cone.
reading every lost sign +:
    n1.x = nxc*cos(phi1) + nyc*sin(phi1)*cos(lam) + nzc*sin(phi1)*sin(lam)
reading - - +; - + -; + +:
    n1.x = -nxc*cos(phi1) - nyc*sin(phi1)*cos(lam) + nzc*sin(phi1)*sin(lam)
    n1.y = -nxc*sin(phi1) + nyc*cos(phi1)*cos(lam) - nzc*cos(phi1)*sin(lam)
    n1.z = nyc*sin(lam) + nzc*cos(lam)
    dot(n_c, d(vec(Xc, Yc, Zc), u1)) = 0
    dot(n_c, d(vec(Xc, Yc, Zc), theta)) = 0
    dot(n_c, n_c) = 1
damage: the signs are lost in the extraction

where-disc | where, at Eq (2) | GRINDING
> Xc = u1 cos α1 cos θ; Yc = u1 cos α1 sin θ; Zc = ±(b1 � u1 sin α1)
The cone of the grinding wheel: with minus in the bracket it is the disc of the description, seen from the wheel's own
centre.
reading every lost sign +:
    wheel = vec(A1 - Xc, Yc, s*(b1 + u1*sin(alpha1)))
reading - in the bracket:
    wheel = vec(A1 - Xc, Yc, s*(b1 - u1*sin(alpha1)))
damage: the signs are lost in the extraction

where-distance | where, at Eq (2) | GRINDING
> A1 = rc � r1
The distance of the two axes while grinding.
reading -:
    wheel.x + Xc = rc - r1
reading +:
    wheel.x + Xc = rc + r1
damage: the signs are lost in the extraction

where-normal | where, at Eq (2) | GRINDING
> nxc = sin α1 cos θ; nyc = sin α1 sin θ; nzc = ±cos α1
The cone's unit normal, as the description gives it in the disc's frame.
    wheel_normal = vec(-sin(alpha1)*cos(theta), sin(alpha1)*sin(theta), s*cos(alpha1))

where-width | where, at Eq (2) | GRINDING
> b1 = ma cos λ π/4 � rc tan α1
Half the groove's width on the pitch circle, and what the cone's slope adds down to its centre.
reading -:
    b_at_centre = m_a*cos(lam)*pi/4 - rc*tan(alpha1)
reading +:
    b_at_centre = m_a*cos(lam)*pi/4 + rc*tan(alpha1)
damage: the signs are lost in the extraction

eq-3 | Eq (3)
> n1 · V1(1c) = 0
Definition of the equation of meshing.
kind: definition

eq-4 | Eq (4) | GRINDING
> u1 = b1 sin α1 � (r1 � rc � p1 cot λ) cos α1/cos θ � ((rc � r1) cot λ � p1) sin α1 tan θ
With minus before p1 cot λ and minus-or-plus before the last bracket this is the u1 by which the drive's own equation of
meshing between disc and worm is solved.
reading every lost sign +:
    U1 = b1*sin(alpha1) + (r1 + rc + p1*cos(lam)/sin(lam))*cos(alpha1)/cos(theta) + ((rc + r1)*cos(lam)/sin(lam)
        + p1)*sin(alpha1)*tan(theta)
reading - before p1 cot λ, ∓ before the last bracket:
    U1 = b1*sin(alpha1) + (r1 + rc - p1*cos(lam)/sin(lam))*cos(alpha1)/cos(theta) - s*((rc + r1)*cos(lam)/sin(lam)
        + p1)*sin(alpha1)*tan(theta)
where: cos θ ≠ 0
where: sin λ ≠ 0
damage: the signs are lost in the extraction

eq-5-row-1 | Eq (5), row 1 | HOBBING
> a11 Xh � a12 Yh � sin γ sin φ2 Zh � A2 cos φ2
True with + + + -, as in Eq (7) of the recess-action paper, whose γ is 180° less the shaft angle; and true with + + - +
where γ is the shaft angle itself, as Table 1 has it.
reading every lost sign +:
    R2.x = a11*Xh + a12*Yh + sin(gamma)*sin(phi2)*Zh + A2*cos(phi2)
reading + + -, γ = 180° - Σ:
    R2.x = a11*Xh + a12*Yh + sin(gamma)*sin(phi2)*Zh - A2*cos(phi2)
reading + - +, γ = Σ:
    R2_across.x = b11*Xh + b12*Yh - sin(gamma)*sin(phi2)*Zh + A2*cos(phi2)
damage: the signs are lost in the extraction

eq-5-row-2 | Eq (5), row 2 | HOBBING
> a21 Xh � a11 Yh � sin γ cos φ2 Zh � A2 sin φ2
The index of the second coefficient is printed 11; it must be 22, which the paper defines and uses nowhere else. With 11
all 16 choices of the four signs of this row are refuted, the other signs being those of row 1.
{ROW_2}
confusable: a11 a12 a21 a22

eq-5-row-2-index | Eq (5), row 2 | BEGINNING
> a21 Xh � a11 Yh � sin γ cos φ2 Zh � A2 sin φ2
No other choice of signs saves the index 11, in either sense of γ: where hob and wheel begin to turn the coefficient of
Yh is cos γ or its negative, and a coefficient of the form of a11 is 1 or -1.
contradiction:
    d(R2.y, Yh)**2 = cos(gamma)**2
    d(R2_across.y, Yh)**2 = cos(gamma)**2
    printed_11**2 = 1
where: sin γ ≠ 0

eq-5-row-3 | Eq (5), row 3 | HOBBING
> sin γ sin φh Xh � sin γ cos φh Yh � cos γ Zh
True with - - +, or - - - where γ is the shaft angle itself.
reading every lost sign +:
    R2.z = sin(gamma)*sin(phih)*Xh + sin(gamma)*cos(phih)*Yh + cos(gamma)*Zh
reading - - +, γ = 180° - Σ:
    R2.z = -sin(gamma)*sin(phih)*Xh - sin(gamma)*cos(phih)*Yh + cos(gamma)*Zh
reading - - -, γ = Σ:
    R2_across.z = -sin(gamma)*sin(phih)*Xh - sin(gamma)*cos(phih)*Yh - cos(gamma)*Zh
damage: the signs are lost in the extraction

where-hob | where, at Eq (5) | HOB_SURFACE
> Xh = (rt � l cos α2) cos θ2 � l sin α2 sin λ sin θ2; Yh = �(rt � l cos α2) sin θ2 � l sin α2 sin λ cos θ2; Zh = �l sin
> α2 cos λ � p2 θ2
The hob's surface, as in Eq (1) of the recess-action paper: the terms with l sin α2 follow the flank.
reading every lost sign +:
    R_h.x = (rt + l*cos(alpha2))*cos(theta2) + l*sin(alpha2)*sin(lam)*sin(theta2)
    R_h.y = (rt + l*cos(alpha2))*sin(theta2) + l*sin(alpha2)*sin(lam)*cos(theta2)
    R_h.z = l*sin(alpha2)*cos(lam) + p2*theta2
reading + ∓; - + ∓; ± -:
    R_h.x = (rt + l*cos(alpha2))*cos(theta2) - s*l*sin(alpha2)*sin(lam)*sin(theta2)
    R_h.y = -(rt + l*cos(alpha2))*sin(theta2) - s*l*sin(alpha2)*sin(lam)*cos(theta2)
    R_h.z = s*l*sin(alpha2)*cos(lam) - p2*theta2
damage: the signs are lost in the extraction

where-hob-distance | where, at Eq (5) | DISTANCE
> A2 = rh � r2
The drive's rule for the cutting distance: the hob's radius and the wheel's.
reading -:
    A2 = rh - r2
reading +:
    A2 = rh + r2
    r2 = pitch_radius
damage: the signs are lost in the extraction

where-coefficients | where, at Eq (5) | HOBBING
> a11 = sin φ2 cos γ sin φh � cos φ2 cos φh; a12 = sin φ2 cos γ cos φh � cos φ2 sin φh; a21 = cos φ2 cos γ sin φh � sin
> φ2 cos φh; a22 = cos φ2 cos γ cos φh � sin φ2 sin φh
Entries of the rotation from hob to wheel: true with + - - +, or - + + - where γ is the shaft angle itself.
reading every lost sign +:
    entry(L2h, 1, 1) = a11
    entry(L2h, 1, 2) = sin(phi2)*cos(gamma)*cos(phih) + cos(phi2)*sin(phih)
    entry(L2h, 2, 1) = cos(phi2)*cos(gamma)*sin(phih) + sin(phi2)*cos(phih)
    entry(L2h, 2, 2) = a22
reading + - - +, γ = 180° - Σ:
    entry(L2h, 1, 1) = a11
    entry(L2h, 1, 2) = a12
    entry(L2h, 2, 1) = a21
    entry(L2h, 2, 2) = a22
reading - + + -, γ = Σ:
    entry(L2h_across, 1, 1) = b11
    entry(L2h_across, 1, 2) = b12
    entry(L2h_across, 2, 1) = b21
    entry(L2h_across, 2, 2) = b22
damage: the signs are lost in the extraction

eq-6 | Eq (6) | BLADE
> rt = √( rh² � Sn² sin² λ/4 ) � Sn/(2 tan α2)
The edge crosses the pitch cylinder where the groove is Sn wide.
    rt = sqrt(rh**2 - Sn**2*sin(lam)**2/4) - Sn/(2*tan(alpha2))
    (rt + Sn/(2*sin(alpha2))*cos(alpha2))**2 + (Sn/2*sin(lam))**2 = rh**2
where: rh ≥ Sn sin λ / 2
damage: the signs are lost in the extraction

eq-7 | Eqs (7)–(13)
> f = N · V(h2) = 0; R_f(1) = M_f1 R_1; R_f(2) = M M M R_2; R_f(1) = R_f(2); n_f(1) - n_f(2) = 0
Definitions and conditions to be solved.
kind: definition

assembly-angle | §4 | ASSEMBLY
> axes Z_fw and Z_f form an angle of γ � Δγh during the meshing
The wheel's axis as the drive mounts it, without the vertical error: γ + Δγh in the sense in which γ is counted.
reading +:
    axis.z = cos(gamma + dgh)
    axis.y = -sin(gamma + dgh)
reading -:
    axis.z = cos(gamma - dgh)
    axis.y = -sin(gamma - dgh)
damage: the signs are lost in the extraction

count | §5 | COUNT
> three independent equations; two independent equations; two additional independent equations of meshing; totally seven
> independent equations with eight unknowns
Three coordinates; of the three equations between unit normals one follows from the other two and no more, since any
change of a normal at right angles to it can come about. Eq (4) is linear in u1, which the others leave open, and gives
it wherever its slope is not 0. Eq (7) changes with φ2, which the others leave open as well: where the hob's normal is
axial it is m sin γ (A2 - Xh cos φh + Yh sin φh). That the seven are independent at a contact of given surfaces each
certified contact proves, its Jacobian being regular.
    dot(na - nb, na + nb) = dot(na, na) - dot(nb, nb)
    cross(cross(na, e), na) = dot(na, na)*e - dot(na, e)*na
    f_disc = d(f_disc, u1)*(u1 - U1)
    V_hob.z = m2h*sin(gamma)*(A2 - Xh*cos(phih) + Yh*sin(phih))
where: near parallel normals (n1 + n2 ≠ 0)
where: ∂(n1·V)/∂u1 ≠ 0

eq-14 | Eq (14)
> Δφ2′(φ1′) = φ2′(φ1′) - (T1/T2) φ1′
Definition of the transmission error.
kind: definition
""",
    vars(letters),
)
