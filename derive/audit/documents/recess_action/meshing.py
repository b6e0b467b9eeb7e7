"""The mesh: Eqs (17) to (35) and what is computed from them."""

from derive.audit.documents.recess_action import letters
from derive.audit.paragraphs import claims

CLAIMS = claims(
    r"""
eq-17 | Eq (17)
> R_w(3) = R_w(2)
Contact: equal positions. A condition to be solved, not an identity.
kind: definition

eq-18 | Eq (18)
> n_w(3) � n_w(2) = 0
Contact: equal unit normals. A condition to be solved, not an identity.
kind: definition

eq-19 | Eqs (19), (20)
> R_w(3) = M_w3 R_3(3); R_w(2) = M_wu M_u2 R_2(2) = M_w2 R_2(2)
Definition of the positions in the fixed frame.
kind: definition

eq-21 | Eq (21) | MESH
> M_w3 = [cos φ3′ � sin φ3′ 0 0; sin φ3′ cos φ3′ 0 0; 0 0 1 0; 0 0 0 1]
Rotation of the worm by φ3′.
    L_w3 = mat([cos(phi3p), -sin(phi3p), 0], [sin(phi3p), cos(phi3p), 0], [0, 0, 1])

eq-22 | Eq (22) | MESH
> M_w2 = [cos Δγv cos φ3′, � cos Δγv sin φ2′, sin Δγv, C3 + ΔC; b21, b22, � sin(γ3 + Δγh) cos Δγv, 0; b31, b32, cos(γ3 +
> Δγh) cos Δγv, 0; 0 0 0 1]
The first entry turns with the wheel: φ2′ for φ3′.
    L_w2 = mat([cos(dgv)*cos(phi3p), -cos(dgv)*sin(phi2p), sin(dgv)], [b21, b22, -sin(gamma3
        + dgh)*cos(dgv)], [b31, b32, cos(gamma3 + dgh)*cos(dgv)])
confusable: phi2p phi3p
confusable: dgh dgv

eq-23 | Eq (23) | MESH
> b21 = sin(γ3 + Δγh) sin Δγv cos φ2′ + cos(γ3 + Δγh) sin φ2′; b22 = � sin(γ3 + Δγh) sin Δγv sin φ2′ + cos(γ3 + Δγh) cos
> φ2′; b31 = � cos(γ3 + Δγh) sin Δγv cos φ2′ + sin(γ3 + Δγh) sin φ2′; b32 = cos(γ3 + Δγh) sin Δγv sin φ2′ + sin(γ3 +
> Δγh) cos φ2′
Rows 2 and 3 of Rx(γ3 + Δγh) Ry(Δγv) Rz(φ2′).
    entry(L_w2, 2, 1) = b21
    entry(L_w2, 2, 2) = b22
    entry(L_w2, 3, 1) = b31
    entry(L_w2, 3, 2) = b32

eq-24 | Eq (24) | MESH
> R_w(3) = [cos φ3′X3 � sin φ3′Y3; sin φ3′X3 + cos φ3′Y3; Z3; 1]
Worm point in the fixed frame.
    R_w3.x = cos(phi3p)*X3 - sin(phi3p)*Y3
    R_w3.y = sin(phi3p)*X3 + cos(phi3p)*Y3
    R_w3.z = Z3

eq-25 | Eq (25) | MESH
> R_w(2) = [cos Δγv cos φ2′X2 � cos Δγv sin φ2′Y2 + sin Δγv Z2 + (C3 + ΔC); b21X2 + b22Y2 � sin(γ3 + Δγh) cos Δγv Z2;
> b31X2 + b32Y2 + cos(γ3 + Δγh) cos Δγv Z2; 1]
Wheel point in the fixed frame; here φ2′ is printed correctly.
    R_w2.x = cos(dgv)*cos(phi2p)*X2 - cos(dgv)*sin(phi2p)*Y2 + sin(dgv)*Z2 + (C3 + dC)
    R_w2.y = b21*X2 + b22*Y2 - sin(gamma3 + dgh)*cos(dgv)*Z2
    R_w2.z = b31*X2 + b32*Y2 + cos(gamma3 + dgh)*cos(dgv)*Z2

eq-26 | Eqs (26), (27)
> n_w(3) = L_w3 n_3(3); n_w(2) = L_wu L_u2 n_2(2) = L_w2 n_2(2)
Definition of the normals in the fixed frame.
kind: definition

worm-normal | text at Eq (27) | BLADE
> the unit normal vector of RA worm expressed\n\nin coordinate system S3, which is identical to the unit normal
> vector\nn1 of oversize ZN worm-type hob cutter as expressed in Eq. (4).
Identical in form: the worm of the drive has the hob's surface and normal with sizes of its own in the place of r1, λ1,
p1 and rt.
    worm = R1
    cross(d(worm, l1), d(worm, th1)) = N1

eq-28 | Eq (28) | MESH
> n_w(3) = [cos φ3′nx3 � sin φ3′ny3; sin φ3′nx3 + cos φ3′ny3; nz3]
Worm normal in the fixed frame.
    n_w3.x = cos(phi3p)*nx3 - sin(phi3p)*ny3
    n_w3.y = sin(phi3p)*nx3 + cos(phi3p)*ny3
    n_w3.z = nz3

eq-29 | Eq (29) | MESH
> n_w(2) = [cos Δγv cos φ3′nx2 � cos Δγv sin φ3′ny2 + sin Δγv nz2; b21nx2 + b22ny2 � sin(γ3 + Δγv) cos Δγv nz2; b31nx2 +
> b32ny2 + cos(γ3 + Δγh) cos Δγv nz2]
Row 1 turns with φ2′, row 2 has sin(γ3 + Δγh), as in Eq (25).
    n_w2.x = cos(dgv)*cos(phi3p)*nx2 - cos(dgv)*sin(phi3p)*ny2 + sin(dgv)*nz2
    n_w2.y = b21*nx2 + b22*ny2 - sin(gamma3 + dgv)*cos(dgv)*nz2
    n_w2.z = b31*nx2 + b32*ny2 + cos(gamma3 + dgh)*cos(dgv)*nz2
confusable: phi2p phi3p
confusable: dgh dgv

count | §8.1 | COUNT
> Since |n_w(3)| = 1 and |n_w(2)| = 1, Eqs. (16)–(18) yield a system of six independent nonlinear equations with seven
> independent parameters
One of the three equations (18) follows from the other two: the difference of two unit vectors is perpendicular to their
sum. None of the others follows from the rest whatever the two surfaces are: a small turn w moves a normal by w × n,
which can be any change e - n(n·e) at right angles to it, a shift moves the three coordinates of (17) and leaves the
normals, and f/ω1 need not be 0 on the locus of the hob: it is m21 sin γ1 Z1 where φ1 = 0, N1 lies along X1 and Y1 = 0.
That the six are independent at a contact of given surfaces is not to be had in letters; each certified contact proves
it there, its Jacobian being regular.
    dot(n_w3 - n_w2, n_w3 + n_w2) = dot(n_w3, n_w3) - dot(n_w2, n_w2)
    cross(cross(n_w3, e), n_w3) = dot(n_w3, n_w3)*e - dot(n_w3, e)*n_w3
    dot(vec(1, 0, 0), V_somewhere) = w1*m21*sin(gamma1)*Z1
where: near parallel normals (n_w3 + n_w2 ≠ 0)

eq-30 | Eq (30)
> KE = Δφ2′(φ3′) = φ2′(φ3′) � (T3/T2) φ3′
Definition of the kinematic (transmission) error.
kind: definition

errors | text at Eq (30) | MESH
> three given assembly errors, i.e., ΔC, Δγh, and Δγh
The third is Δγv: the mesh has no other error.
    errors = vec(dC, dgh, dgh)
confusable: phi2p phi3p
confusable: dgh dgv

eq-31 | Eq (31), Example 1 and 2
> CR = (φ3e′ � φ3b′)/(360 deg/T3): 7.58, 7.39, 6.91; cases 2–4: 7.48, 7.16, 7.34
All six printed contact ratios follow from the printed angles.
    (2745.81 - 15.64)/(360/1) -> 7.58
    (2089.77 - (-569.03))/(360/1) -> 7.39
    (1433.26 - (-1053.29))/(360/1) -> 6.91
    (2740.47 - 48.03)/(360/1) -> 7.48
    (2619.39 - 41.01)/(360/1) -> 7.16
    (2706.40 - 63.66)/(360/1) -> 7.34

acr | Example 2
> ACRs are 7.51, 7.18, and 7.37
Averaged over [begin, end] as the text says, ACR = ((n+1)² f + n² (1-f))/(n+f) for CR = n + f. Averaged over one pitch
it would be CR itself.
    (8**2*((2740.47 - 48.03)/360 - 7) + 7**2*(8 - (2740.47 - 48.03)/360))/((2740.47 - 48.03)/360) -> 7.51
    (8**2*((2619.39 - 41.01)/360 - 7) + 7**2*(8 - (2619.39 - 41.01)/360))/((2619.39 - 41.01)/360) -> 7.18
    (8**2*((2706.40 - 63.66)/360 - 7) + 7**2*(8 - (2706.40 - 63.66)/360))/((2706.40 - 63.66)/360) -> 7.37

eq-35 | Eqs (32), (33), (35) | MESH
> X_T = r_T cos θ_T; Y_T = r_T sin θ_T; tan(θ_T) = Y_T/X_T
Eq (35) follows from (32) and (33), it adds no condition.
    tan(thT) = rT*sin(thT)/(rT*cos(thT))
where: r_T ≠ 0

eq-34 | Eq (34)
> |Z_T(2) � Z_T(3)| = 6.32 µm
Definition of the contact pattern's edge: the separation chosen for marking paint.
kind: definition
""",
    vars(letters),
)
