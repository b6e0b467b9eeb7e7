"""The worm as a rack, contact and its limits: sections 1 to 4, and the pitch line."""

from derive.audit.documents.rack_and_pinion import letters
from derive.audit.paragraphs import claims

CLAIMS = claims(
    """
frames | §1 | WORM
> I set i_2 = -i_1, j_2 = -k_1, k_2 = -j_1.
The wheel frame is right-handed, its axis perpendicular to the worm's. Worm and wheel of the drive turn about k1 and k2
with the angular velocities 1 and I, the wheel's centre at A i1.
    cross(i2, j2) = k2
    dot(k1, k2) = 0
    omega1 = k1
    omega2 = I*k2
    seat = -A*i2

ratio-sign | §1 | WORM
> Assume |ω(1)| = 1 and |ω(2)| = I.
As a length, I is positive. That is right for a right-hand worm (p > 0). A left-hand worm turns the wheel about +j1 with
p < 0: the rack's velocity -p k1 is then met only if I carries the sign of p.
reading right-hand worm, ω(2) = I k2:
    cross(omega2, (R1j - A)*i1) = -p*omega1
reading left-hand worm, ω(2) = I j1 with I = |ω(2)|:
    cross(I*j1, (R1j - A)*i1) = -p*omega1

worm-surface | §1 | WORM
> R(1) = ξ(u) e(λ) + η(u) e_1(λ) + (ζ(u) + pλ) k_1; e(λ) = cos λ i_1 + sin λ j_1, e_1(λ) = -sin λ i_1 + cos λ j_1
The drive's own screw motion, of any profile.
    R1 = xi*vec(cos(lam), sin(lam), 0) + eta*vec(-sin(lam), cos(lam), 0) + (zeta + p*lam)*k1

family | §1 | WORM
> r(1) = B_1(φ_1) R(1) = ξ e(λ+φ_1) + η e_1(λ+φ_1) + (ζ+pλ) k_1
Turning the helicoid about its axis only adds φ1 to λ in the circular vectors.
    r1 = xi*e + eta*e1 + (zeta + p*lam)*k1

wheel-family | §1 | WORM
> r(2) = B_2(φ_2) R(2)
With B2 = Ry(-φ2) this is the contact point seen from the wheel's centre, as the drive mounts its wheel.
    B2@R2 = r1 - A*i1

inverse-rotation | §1 | WORM
> B_2^{-1}(φ_2) = B_2(-φ_2)
The inverse of a rotation turns back.
    T(B2)@B2 = mat([1, 0, 0], [0, 1, 0], [0, 0, 1])
    T(B2) = Ry(phi2)

meshing | §1 | WORM
> f(u,λ,φ_1) = (ω(2)×r(2) - ω(1)×r(1))·n = 0
The velocity form is minus the envelope condition (R2_u × R2_λ)·∂R2/∂φ1, for every profile.
    f = -triple(R2_u, R2_lam, R2_phi1)

helicoid | §1 | WORM
> the identity (pω(1) + ω(1)×r(1))·n = 0 always holds
A screw motion moves a helicoid along itself.
    dot(p*omega1 + cross(omega1, r1), n) = 0

both-terms | §1 | WORM
> f(u,λ,φ_1) = (ω(2)×r(2) - ω(1)×r(1) - pω(1) + pω(1))·n = 0
p ω(1) taken away and added; with the identity of the helicoid the two middle terms go together.
    f = dot(cross(omega2, r2) - cross(omega1, r1) - p*omega1 + p*omega1, n)
    dot(-cross(omega1, r1) - p*omega1, n) = 0

rack-form | §1 | WORM
> ⇒ (ω(2)×r(2) - (-pω(1)))·n = 0
The turning worm may be replaced by one that slides by -p k1 per radian.
    f = dot(cross(omega2, r2) - (-p*omega1), n)
where: worm of unlimited length

pitch-radius-wheel | §1 | WORM
> The derived pitch circle radius of the worm gear is R_2j = p/I.
At that distance from its axis the wheel moves as fast as the rack.
    cross(omega2, -R2j*i1) = -p*omega1
where: I ≠ 0
where: I has the sign of p

psi | §1 | WORM
> r(1) = ξ e(ψ) + η e_1(ψ) + (ζ+pψ) k_1 - pφ_1 k_1
With ψ = λ + φ1 the family is one surface that slides along -k1.
    r1 = xi*e + eta*e1 + (zeta + p*psi)*k1 - p*phi1*k1

sliding | §1 | RACK
> a family of surfaces translating along -k_1 at constant speed p
At fixed ψ the point moves by -p k1 per radian of φ1.
    d(r1, phi1) = -p*k1

pitch-line | §2 | WORM
> The instantaneous axis (pitch line) is given by r_j = R_1j i_1 - Q j_1
Wheel and sliding worm have the same velocity on this line.
    cross(omega2, rj - A*i1) = -p*omega1

normal-meets-axis | §2 | WORM
> r(1) + S_0 n = R_1j i_1 - Q_0 j_1 with S_0 = -r(1)·k_1 / n·k_1 and Q_0 = -(r(1)+S_0 n)·j_1
The normal ends beside the pitch line by f/(I n·k1): it meets the line exactly where f = 0.
    r1 + S0*n - (R1j*i1 - Q0*j1) = f/(I*dot(n, k1))*i1
where: n·k1 ≠ 0

elimination | §2 | WORM
> By taking the dot product with (j_1 × n), I eliminate S_0 and Q_0
Neither S nor Q survives the product, whatever their values.
    dot(r1 + S*n - (R1j*i1 - Q*j1), cross(j1, n)) = dot(cross(r1, j1) - R1j*k1, n)

eq-1 | Eq (1) | WORM
> (r(1)×j_1 - R_1j k_1)·n = 0   (1)
The spatial condition is I times this one; the two agree wherever I ≠ 0.
    f = I*dot(cross(r1, j1) - R1j*k1, n)
where: I ≠ 0
drops: I

lemma | §2 | WORM
> for any non-singular point on a surface, the profile normal, surface normal, and plane normal are coplanar
The profile's tangent is n × j1, its normal in the plane (n × j1) × j1: a combination of n and j1.
    triple(cross(cross(n, j1), j1), n, j1) = 0
where: n not parallel to j1

eq-2 | Eq (2) | WORM
> { (r(1)×j_1 - R_1j k_1)·n = 0 ; r(1)·j_1 = C   (2)
In the plane y = C this says that the planar normal (n_x, n_z) passes the pitch point (R1j, 0).
    f = I*((r1.x - R1j)*n.z - r1.z*n.x)
where: n not parallel to j1
where: C within the worm
drops: I

wheel-profile | §2 | WORM
> R(2) = B_2^{-1}(φ_2)(r(1) - A i_1)
With this surface the envelope condition is -f.
    triple(R2_u, R2_lam, R2_phi1) = -f

section-points | §2 | WORM
> The intersection of the cutting plane with the instantaneous axis is the pitch point; with the worm gear axis, the
> gear center
In the section y = C wheel and sliding worm have one velocity at R1j i1 + C j1, and the wheel stands still p/I from
there along i1.
    cross(omega2, R1j*i1 + C*j1 - seat) = -p*omega1
    cross(omega2, (R1j + p/I)*i1 + C*j1 - seat) = vec(0, 0, 0)

meshing-surface | §3 | CONTACT_SURFACE
> n_p = ∂r(2)/∂u × ∂r(2)/∂λ
The normal of the surface of contact: the derivatives are total ones, along which φ1 follows u and λ and keeps f = 0: a
step (a, b, c) of u, λ and φ1 does so where c = a φ_u + b φ_λ, φ_u = -f_u/f_φ1 and φ_λ = -f_λ/f_φ1, and such a step of
the contact point is at right angles to n_p.
    d(f, (u, a), (lam, b), (phi1, c)) = (c - a*keep_u - b*keep_lam)*d(f, phi1)
    dot(n_p, d(r2, (u, a), (lam, b), (phi1, c))) = (c - a*phi_u - b*phi_lam)*triple(D_u, D_lam, d(r2, phi1))
where: ∂f/∂φ1 ≠ 0

eq-3 | Eq (3) | LIMIT
> (r(2), n_p, k_2) = 0   (3)
I times the triple product is (T_u × T_λ)·(ω2 × r2), T the tangents of the wheel surface: it vanishes where the wheel
surface is singular, so the condition is necessary. It is sufficient only where n·k1 ≠ 0, because on f = 0 the normal
meets ω2 × r2 with -p n·k1.
    I*triple(r2, n_p, k2) = dot(cross(T_u, T_lam), w)
    dot(n, w) = f - p*dot(n, k1)
where: necessary; sufficient where n·k1 ≠ 0
where: n_p from total derivatives: φ1 = φ1(u, λ)
where: ∂f/∂φ1 ≠ 0

planar-limit | §3 | SECTION
> for a planar curve, at the first-type limit point of its conjugate curve, the normal to the meshing line passes
> through the center of rotation
Where the conjugate curve stands still, the meshing line's tangent is perpendicular to the arm from the centre.
    dot(d(m, t) - phi_t*sweep, arm) = dot(d(m, t), arm)
where: the meshing line is regular

eq-4 | Eq (4) | WORM
> { (r(2), n_p, k_2) = 0 ; r(2)·k_2 = C   (4)
k2 = -j1, so the section r(1)·j1 = C of Eq (2) is r(2)·k2 = -C.
    dot(r2, k2) = dot(r1, j1)

ruled-surface | §4
> r_h(λ,u,φ_1,s) = r(1) + s n
Definition of the surface of the contact normals.
kind: definition

eq-5 | Eq (5) | WORM
> { (∂r_h/∂φ_1, ∂r_h/∂s, j_1) = 0 ; s = S_0   (5)
The triple product is -(1/I) ∂f/∂φ1: the two contacts of one revolution coincide. The normal has to turn with φ1 as
well.
    triple(d(r1, phi1) + S0*d(n, phi1), n, j1) = -d(f, phi1)/I
    triple(d(r1, phi1) + S0*d(n, phi1), n, j1) = -Q0*dot(n, k1)
where: n·k1 ≠ 0
where: I ≠ 0

twice | §4 | EARLIER
> the instantaneous axis (pitch line) intersects this ruled surface twice for |φ_1| < 2π
f is a cos ψ + b sin ψ less a constant: two contacts a revolution where a² + b² exceeds its square. At φ1 - 2π f is what
it is at φ1, so each of the two contacts between 0 and 2π has a third and a fourth between -2π and 0: |φ1| < 2π holds
four. The text means a half-open interval of length 2π.
contradiction:
    f/I = a*cos(psi) + b*sin(psi) - R1j*n_k
    a*cos(before) + b*sin(before) - R1j*n_k = f/I
    n = n_e*e + n_1*e1 + n_k*k1

axis-1 | §5 | WORM
> the derived instantaneous axis itself is one meshing axis
Every contact normal has no moment about the pitch line.
    I*dot(cross(r1 - R1j*i1, j1), n) = f
drops: I
""",
    vars(letters),
)
