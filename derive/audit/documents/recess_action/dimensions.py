"""Sizes, tables and what is said in words."""

from derive.audit.described import written
from derive.audit.documents.recess_action import letters
from derive.audit.documents.recess_action.letters import (
    EXAMPLE,
    SIZES_OF_TABLE,
    TABLE_2,
)
from derive.audit.paragraphs import claims


def groove(shift: int) -> str:
    """The groove's width where the normal module is 1."""
    return written(SIZES_OF_TABLE.size("groove_width_mm"), EXAMPLE | {"m_n": "1", "dx": str(shift)})


CLAIMS = claims(
    rf"""
eq-36 | Eq (36) | SIZES
> λ1 = sin⁻¹( mn cos λ3 / (2 r1) )
Hob and worm cut and fill the same wheel, so their normal pitches, lead times cosine over threads, are equal. Their
difference is 2π r1/T1 times sin λ1 - mn T1/(2 r1): equal pitch is this equation and no other, and it is the drive's own
rule for λ1. The printed form holds for one thread if mn were the worm's axial module.
    sin(lam1) - mn*cos(lam3)/(2*r1) = T1/(2*pi*r1)*(pitch_1 - pitch_3)
    sin_hob = mn*cos(lam3)/(2*r1)
corrected:
    sin(lam1) - mn*T1/(2*r1) = T1/(2*pi*r1)*(pitch_1 - pitch_3)
    sin_hob = mn*T1/(2*r1)
where: r1 ≠ 0

eq-37 | Eq (37) | ROLLING
> C1 = C3 + r1 � r3
The hob rolls on the wheel's pitch cylinder where the relative velocity at the pitch point lies along its thread. Across
the thread that velocity is a factor times C1 - (C3 + r1 - r3): it vanishes, and the wheel gets the hob's normal pitch,
for this centre distance alone. The factor is not 0 for crossed axes.
    dot(V, across) = T1/T2*sin(gamma1 - lam1)*(C1 - (C3 + r1 - r3))
    dot(V, vec(1, 0, 0)) = 0
    C1_rule = C3 + r1 - r3
where: γ1 ≠ λ1

eq-38 | Eq (38) | SIZES
> γ1 = γ3 + λ1 � λ3
With this angle hob and worm have the same groove direction at the pitch point.
    Rx(-gamma1)@vec(0, cos(lam1), sin(lam1)) = Rx(-gamma3)@vec(0, cos(lam3), sin(lam3))
    gamma1 = gamma3 + lam1 - lam3

table-1 | Table 1
> pitch radius 19.11, 277.38 mm; meshing center distance 296.49 mm
The sizes of worm and wheel follow from mn = 2 mm, 1 and 277 teeth and λ3 = 3 deg.
    {written(SIZES_OF_TABLE.rule("r_worm"), EXAMPLE)} -> 19.11 mm
    {written(SIZES_OF_TABLE.size("wheel_pitch_radius_mm"), EXAMPLE)} -> 277.38 mm
    {written(SIZES_OF_TABLE.rule("A"), EXAMPLE)} -> 296.49 mm

hob-radius | Table 1
> pitch radius 20.00 mm; 4.7% oversize; cutting center distance 297.38 mm
4.7% and 297.38 = 296.49 + 20 - 19.11 agree with r1 = 20 mm. Table 2 does not: its rows come out to the last digit with
r1 = 20.0638 mm (5.0%, 297.45 mm), and with 20 mm the kinematic error is 6% too small and θ1 0.4 deg off. Which radius
was meant cannot be told from the text.
missing: the pitch radius of the hob with which Table 2 was computed

lead-angle | Table 1, §9
> lead angle 2.86 deg; cutting crossing angle 89.86 deg
2.86 deg follows from Eq (36) as printed with r1 = 20 mm, and from the corrected equation with the r1 = 20.0638 mm of
Table 2; the corrected equation with 20 mm gives 2.87 deg, and 89.87 deg for γ1.
missing: the pitch radius of the hob with which it was computed

thickness | §3
> tooth thicknesses ... become 1.22 and 0.86 mn ... tooth thickness of the generated worm gear at its normal pitch
> circle is 1.51 mn
The drive's own width for dx/mn = 1, 2, 0 and mn = 1: π/2 - 2 (dx/mn) tan 10°. The standard value must be 1.57; 0.86 is
cut, not rounded.
    {groove(1)} -> 1.22
    {groove(2)} -> 0.86
    {groove(0)} -> 1.51

throat | §3 | THROAT
> their normal throat radii are (T2 + 2)mn/2 mm and T2mn/2 mm, individually ... normal throat radius is (T2 + 4)mn/2 mm
With a normal module the wheel's pitch radius is mn T2/(2 cos λ3); the throat lies 2 mn - dx above it. The printed radii
lack 1/cos λ3 (0.38 mm in the example), and the limits of the tables only come out with it.
    semi = (T2 + 2)*mn/2
    full = T2*mn/2
    standard = (T2 + 4)*mn/2
corrected:
    semi = (T2/cos(lam3) + 2)*mn/2
    full = T2/cos(lam3)*mn/2
    standard = (T2/cos(lam3) + 4)*mn/2

table-2-heading | Table 2, column 5
> /03 (deg) l3 (mm) h3 (deg) /03 (deg) l1 (mm) h1 (deg) KE (arc-sec) CR\n\nStd �800.0 6.3120 �797.4533 �2.8880 6.3148
> �803.5230 0.3102 6.91\n�400.0 7.5492 �398.8153 �1.4440 7.5498 �401.4447 0.0701\n\n0 8.7733 0 0 8.7732 �0.0002 0\n400.0
> 9.9884 398.9577 1.4441 9.9888 401.0173 0.0589
The heading φ3′ appears twice. At φ3′ = 400 the fifth column holds 1.4441, which is φ2′.
    400 -> 1.4441 deg
corrected:
    400/277 + 0.0589/3600 -> 1.4441 deg

table-2-hob-angle | Table 2, column 7
> {TABLE_2}
Standard, semi and full differ by equal steps of dx, and θ1 with them: 401.0173, 401.0128, 401.0083 deg at 400 deg as
801.7385, 801.7315, 801.7246 deg at 800 deg. One digit is wrong.
    2*401.0128 - 401.0173 -> 400.0083 deg

table-2-wheel-angle | Table 2, column 5
> {TABLE_2}
φ2′ = φ3′/277 + KE/3600. Four entries differ: semi 800, 1200 and 1600 deg, full 800 deg.
    (-800)/277 + 0.3102/3600 -> -2.8880 deg
    (-400)/277 + 0.0701/3600 -> -1.4440 deg
    0/277 + 0/3600 -> 0 deg
    400/277 + 0.0589/3600 -> 1.4441 deg
    800/277 + 0.2181/3600 -> 2.8881 deg
    0/277 + 0/3600 -> 0 deg
    400/277 + 0.0587/3600 -> 1.4441 deg
    800/277 + 0.2173/3600 -> 2.8882 deg
    1200/277 + 0.4552/3600 -> 4.3324 deg
    1600/277 + 0.7569/3600 -> 5.7766 deg
    400/277 + 0.0585/3600 -> 1.4441 deg
    800/277 + 0.2165/3600 -> 2.8882 deg
    1200/277 + 0.4537/3600 -> 4.3323 deg
    1600/277 + 0.7545/3600 -> 5.7764 deg
    2000/277 + 1.1073/3600 -> 7.2205 deg

advantages | §§1, 2, 10
> friction of recess action is lower than that of approach action; KEs are dramatically lower
Statements about friction and comparisons, no equations.
kind: not_mathematical
""",
    vars(letters),
)
