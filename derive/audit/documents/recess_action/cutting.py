"""Hob, and the wheel that it cuts: Eqs (1) to (16)."""

from derive.audit.documents.recess_action import letters
from derive.audit.paragraphs import claims

CLAIMS = claims(
    """
eq-1 | Eq (1) | BLADE
> R1 = [ (rt + l1 cos α1) cos θ1 � l1 sin λ1 sin α1 sin θ1 ; �(rt + l1 cos α1) sin θ1 � l1 sin λ1 sin α1 cos θ1 ; ± l1
> cos λ1 sin α1 � p1 θ1 ; 1 ]
Both terms with l1 sin λ1 sin α1 follow the flank: minus for the right side, plus for the left. Read as a plain minus,
the left flank is wrong; the ± in Eq (6) shows what was meant.
reading � is minus:
    R1.x = (rt + l1*cos(a1))*cos(th1) - l1*sin(lam1)*sin(a1)*sin(th1)
    R1.y = -(rt + l1*cos(a1))*sin(th1) - l1*sin(lam1)*sin(a1)*cos(th1)
    R1.z = s*l1*cos(lam1)*sin(a1) - p1*th1
reading � in the second terms is minus-or-plus:
    R1.x = (rt + l1*cos(a1))*cos(th1) - s*l1*sin(lam1)*sin(a1)*sin(th1)
    R1.y = -(rt + l1*cos(a1))*sin(th1) - s*l1*sin(lam1)*sin(a1)*cos(th1)
    R1.z = s*l1*cos(lam1)*sin(a1) - p1*th1
damage: the sign of this term is the glyph '�', which stands for minus and for minus-or-plus

eq-2 | Eq (2) | WIDTH
> rt = √( r1² � (bx/2 sin λ1)² ) � bx / (2 tan α1)
With this rt the edge crosses the pitch cylinder exactly where the groove is bx wide.
    rt = sqrt(r1**2 - (bx/2*sin(lam1))**2) - bx/(2*tan(a1))
    (rt + bx/(2*sin(a1))*cos(a1))**2 + (bx/2*sin(lam1))**2 = r1**2
where: r1 ≥ bx sin λ1 / 2
where: 0 < α1 < 90°

eq-3 | Eq (3) | WIDTH
> bx = bn � 2 dx tan α1, bn = π mn/2
Groove width at the shifted pitch line, as the drive's own sizes give it.
    width = pi*mn/2 - 2*dx*tan(a1)

eq-4 | Eq (4)
> N1 = ∂R1/∂l1 × ∂R1/∂θ1, n1 = N1/|N1|
Definition of the normal.
kind: definition

eq-5 | Eq (5) | BLADE
> ∂R1/∂l1 = [ cos α1 cos θ1 � sin α1 sin λ1 sin θ1 ; � cos α1 sin θ1 � sin α1 sin λ1 cos θ1 ; ± sin α1 cos λ1 ]
The derivative of Eq (1); the same two signs follow the flank.
reading � is minus:
    R1_l.x = cos(a1)*cos(th1) - sin(a1)*sin(lam1)*sin(th1)
    R1_l.y = -cos(a1)*sin(th1) - sin(a1)*sin(lam1)*cos(th1)
    R1_l.z = s*sin(a1)*cos(lam1)
reading � in the second terms is minus-or-plus:
    R1_l.x = cos(a1)*cos(th1) - s*sin(a1)*sin(lam1)*sin(th1)
    R1_l.y = -cos(a1)*sin(th1) - s*sin(a1)*sin(lam1)*cos(th1)
    R1_l.z = s*sin(a1)*cos(lam1)
damage: the sign of this term is the glyph '�', which stands for minus and for minus-or-plus

eq-6 | Eq (6) | BLADE
> ∂R1/∂θ1 = [ �(rt + l1 cos α1) sin θ1 � l1 sin λ1 sin α1 cos θ1 ; �(rt + l1 cos α1) cos θ1 ± l1 sin λ1 sin α1 sin θ1 ;
> �p1 ]
The ± of the second row is legible and right; the first row needs minus-or-plus.
reading � is minus:
    R1_th.x = -(rt + l1*cos(a1))*sin(th1) - l1*sin(lam1)*sin(a1)*cos(th1)
    R1_th.y = -(rt + l1*cos(a1))*cos(th1) + s*l1*sin(lam1)*sin(a1)*sin(th1)
    R1_th.z = -p1
reading � in the second term of row 1 is minus-or-plus:
    R1_th.x = -(rt + l1*cos(a1))*sin(th1) - s*l1*sin(lam1)*sin(a1)*cos(th1)
    R1_th.y = -(rt + l1*cos(a1))*cos(th1) + s*l1*sin(lam1)*sin(a1)*sin(th1)
    R1_th.z = -p1
damage: the sign of this term is the glyph '�', which stands for minus and for minus-or-plus

eq-7 | Eq (7) | CUT
> R2 = [ a11X1 + a12Y1 + sin γ1 sin φ2 Z1 � cos φ2 C1 ; a21X1 + a22Y1 + sin γ1 cos φ2 Z1 � sin φ2 C1 ; � sin γ1 sin φ1
> X1 � sin γ1 cos φ1 Y1 + cos γ1 Z1 ; 1 ]
Row 2 must end in + sin φ2 C1: the centre offset (-C1, 0, 0) turned by -φ2.
    R2.x = a11*X1 + a12*Y1 + sin(gamma1)*sin(phi2)*Z1 - cos(phi2)*C1
    R2.y = a21*X1 + a22*Y1 + sin(gamma1)*cos(phi2)*Z1 - sin(phi2)*C1
    R2.z = -sin(gamma1)*sin(phi1)*X1 - sin(gamma1)*cos(phi1)*Y1 + cos(gamma1)*Z1
damage: the sign before sin φ2 C1 is the glyph '�'

eq-8 | Eq (8) | CUT
> a11 = cos φ1 cos φ2 + cos γ1 sin φ1 sin φ2; a12 = � sin φ1 cos φ2 + cos γ1 cos φ1 sin φ2; a21 = � cos φ1 sin φ2 + cos
> γ1 sin φ1 cos φ2; a22 = sin φ1 sin φ2 + cos γ1 cos φ1 cos φ2
Entries of the rotation from hob to wheel.
    entry(L21, 1, 1) = a11
    entry(L21, 1, 2) = a12
    entry(L21, 2, 1) = a21
    entry(L21, 2, 2) = a22

ratio | §6
> φ2 = (T1/T2) φ1
The gearing of the hobbing machine: a definition.
kind: definition

eq-9 | Eq (9) | CUT
> n2 = [ a11nx1 + a12ny1 + sin γ1 sin φ2 nz1 ; a21nx1 + a22ny1 + sin γ1 cos φ2 nz1 ; � sin γ1 sin φ1 nx1 � sin γ1 cos φ1
> ny1 + cos γ1 nz1 ]
The normal turned like the surface.
    n2.x = a11*nx + a12*ny + sin(gamma1)*sin(phi2)*nz
    n2.y = a21*nx + a22*ny + sin(gamma1)*cos(phi2)*nz
    n2.z = -sin(gamma1)*sin(phi1)*nx - sin(gamma1)*cos(phi1)*ny + cos(gamma1)*nz

eq-10 | Eq (10) | ENVELOPE
> N1 · V12 = N1 · (V1 � V2) = 0   (10)
ω1 times the envelope condition (R2_l × R2_θ)·∂R2/∂φ1, so both vanish together.
    dot(N1, V12) = w1*triple(d(R2, l1), d(R2, th1), d(R2, (phi1, 1), (phi2, m21)))
where: ω1 ≠ 0
drops: w1

eq-11 | Eq (11) | CUT
> V12 = (ω1 � ω2) × R1 � O1O2 × ω2   (11)
The velocity of a hob point seen from the wheel.
    V12 = cross(omega1 - omega2, hob) - cross(O1O2, omega2)

eq-12 | Eq (12) | CUT
> ω1 = ω1 [0 0 1]ᵀ
The velocity of any hob point by the hob's own turn in the machine, in S1, is this vector × R1.
    V1 = cross(w1*vec(0, 0, 1), hob)

eq-13 | Eq (13) | CUT
> x1(1) = ω1 [ �m21 sin γ1 sin φ1 ; �m21 sin γ1 cos φ1 ; m21 cos γ1 ]
The left side is ω2, the wheel's angular velocity; ω1 is Eq (12).
    omega1 = w1*vec(-m21*sin(gamma1)*sin(phi1), -m21*sin(gamma1)*cos(phi1), m21*cos(gamma1))
confusable: omega1 omega2

eq-14 | Eq (14) | CUT
> O1O2 = [ cos φ1 C1 ; � sin φ1 C1 ; 0 ]
The wheel's centre seen from the hob.
    O1O2 = vec(cos(phi1)*C1, -sin(phi1)*C1, 0)

eq-15 | Eq (15) | CUT
> V12 = ω1 [ (m21 cos γ1 � 1)Y1 + m21(sin γ1 cos φ1 Z1 + cos γ1 sin φ1 C1) ; �(m21 cos γ1 � 1)X1 + m21(� sin γ1 sin φ1
> Z1 + cos γ1 cos φ1 C1) ; m21 sin γ1(� cos φ1X1 + sin φ1Y1 + C1) ]
Eqs (12) to (14) in Eq (11).
    V12.x = w1*((m21*cos(gamma1) - 1)*Y1 + m21*(sin(gamma1)*cos(phi1)*Z1 + cos(gamma1)*sin(phi1)*C1))
    V12.y = w1*(-(m21*cos(gamma1) - 1)*X1 + m21*(-sin(gamma1)*sin(phi1)*Z1 + cos(gamma1)*cos(phi1)*C1))
    V12.z = w1*(m21*sin(gamma1)*(-cos(phi1)*X1 + sin(phi1)*Y1 + C1))

eq-16 | Eq (16) | CUT
> f = ω1{[(m21 cos γ1 � 1)Y1 + m21(cos φ1 sin γ1Z1 + sin φ1 cos γ1C1)]Nx1 + [�(m21 sin γ1 � 1)X1 + m21(� sin φ1 sin γ1Z1
> + cos φ1 cos γ1C1)]Ny1 + [m21 sin γ1(� cos φ1X1 + sin φ1Y1 + C1)]Nz1} = 0
In the second bracket it must be m21 cos γ1 - 1, as in Eq (15).
    dot(N1, V12) = w1*(((m21*cos(gamma1) - 1)*Y1 + m21*(cos(phi1)*sin(gamma1)*Z1 + sin(phi1)*cos(gamma1)*C1))*Nx
        + (-(m21*sin(gamma1) - 1)*X1 + m21*(-sin(phi1)*sin(gamma1)*Z1 + cos(phi1)*cos(gamma1)*C1))*Ny
        + (m21*sin(gamma1)*(-cos(phi1)*X1 + sin(phi1)*Y1 + C1))*Nz)
""",
    vars(letters),
)
