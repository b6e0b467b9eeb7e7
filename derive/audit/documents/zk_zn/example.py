"""The tables of the example, and what is said in words."""

from derive.audit.documents.zk_zn import letters
from derive.audit.documents.zk_zn.letters import TABLE, size_in_table
from derive.audit.paragraphs import claims


def helix_in_table(crossing: int) -> str:
    """The wheel's helix angle at a crossing angle in degrees."""
    return size_in_table(TABLE.size("wheel_helix_angle_deg"), crossing)


def average(teeth: int, window: str) -> str:
    """The average contact ratio over a window of angles in which so many teeth are in contact, or one more."""
    ratio = f"{window}/120"
    return f"(({teeth} + 1)**2*({ratio} - {teeth}) + {teeth}**2*({teeth} + 1 - {ratio}))/({ratio})"


CLAIMS = claims(
    f"""
table-1 | Table 1
> pitch radius 12.00 mm, 60.05 mm
The drive's own sizes with γ as the shaft angle, mn T1/(2 sin λ) and mn T2/(2 sin(γ + λ)), the latter at γ = 45° only:
at every other crossing angle the wheel is another one. With γ as 180° less the shaft angle it would be 224.09 mm.
    {size_in_table(TABLE.rule("r_worm"), 45)} -> 12.00 mm
    {size_in_table(TABLE.size("wheel_pitch_radius_mm"), 45)} -> 60.05 mm

wheel-lead-angle | Table 1
> lead angle of the worm wheel 30.0°
30° is the worm's and hob's lead angle. At γ = 45° the wheel's teeth are inclined by 15° to its axis: lead angle 75°.
    90 - 180/pi*({helix_in_table(45)}) -> 30.0 deg

contact-ratio | Table 2
> CR 3.624, 3.865, 4.417, 3.688
(end - begin)/120°. The first two are cut after the third digit, not rounded.
    (209.36 + 225.62)/120 -> 3.624
    (241.89 + 221.98)/120 -> 3.865
    (319.76 + 210.33)/120 -> 4.417
    (255.75 + 186.81)/120 -> 3.688

average-contact-ratio | Table 2
> ACR 3.739, 3.921, 4.526, 3.791
The average of the teeth in contact over [begin, end], ((n+1)² f + n² (1-f))/(n+f) for CR = n + f, is lower in every
row, the average over one pitch (CR itself) lower still. The paper counts teeth within 3 µm of each other; how is not
said.
    {average(3, "434.98")} -> 3.739
    {average(3, "463.87")} -> 3.921
    {average(4, "530.09")} -> 4.526
    {average(3, "442.56")} -> 3.791
final: another number is not what should be printed instead

hand | Table 1
> Right/Left handed of teeth RH LH
At γ = 45° the wheel's helix angle 90° - γ - λ is 15°, positive: of the hand opposite to the worm's. So it is at 30°.
    {helix_in_table(45)} -> >0
    {helix_in_table(30)} -> >0

hand-of-the-others | §7 | SPUR
> the right-handed ZK-type worm and left-handed ZN-type worm wheel
Of γ = 60°. There the wheel's helix angle 90° - γ - λ is 0: a spur wheel, of neither hand. At 90° it is -30°,
right-handed like the worm.
contradiction:
    helix = 0

no-error | Table 2, §§7, 8
> KE = 0.0 arc-second at γ = 30.0°, 45.0°, 60.0° and 90.0°
Worm and hob have one screw motion and touch along a helix, on which contact stays: at 30°, 45° and 60° the error of Eq
(14) is constant, the axial gap between the two profiles turned into an angle, and 0 only relative to its value at one
position. At 90° it is so up to a pitchfork of the path of contact and not beyond.
missing: the grinding wheel's radius, the blanks and the origin of φ1′; Eq (14) gives a constant that is not 0

regression | §2
> the mathematical model of the ZK-type worm surface can be obtained by considering Eqs. (1) and (4)
Nothing is said of where that surface ends. Below an edge of regression there is none; with a large grinding wheel it
lies at r1 sin λ/√(sin²λ + tan²α) = 9.70 mm, above the root of a worm of usual depth (12 - 1.2·4 = 7.2 mm).
missing: the grinding wheel's radius and the worm's root radius

low-error | §8
> it can mesh in a very low level of kinematical errors with a high contact ratio even under assembly errors
No case with assembly errors is computed in the paper.
kind: not_mathematical
""",
    vars(letters),
)
