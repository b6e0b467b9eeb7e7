"""What drawings of cylindrical worm drives state: ISO/TR 10828 (diameter quotient, profile shift, thread thickness).

Backlash is the worm's: each flank of its thread is moved along its axis and stays the helicoid of the hob, so that an
equal hob keeps its line of contact. What an oversize hob or its feed adds is no part of it.
"""

import sympy as sp

from derive.drives import cylindrical_worm_keys as k
from derive.drives.cylindrical_worm_keys import POSITIVE, T_1, T_2, A, Sigma, alpha, lam, m_n, m_x, r_1
from derive.language.choice import only_where_zero
from derive.language.drawing import Assumed, Drawing, Relation, relation
from derive.language.symbols import parameter

quotient = parameter("worm_diameter_quotient", "q", "diameter quotient of the worm", domain=POSITIVE)
axial_pitch = parameter("axial_pitch_mm", "p_x", "axial pitch of the worm", domain=POSITIVE)
lead = parameter("lead_worm_mm", "p_z", "lead of the worm", domain=POSITIVE)
wheel_radius = parameter("wheel_pitch_radius_mm", "r_2", "reference radius of the wheel", domain=POSITIVE)
wheel_shift = parameter("wheel_profile_shift_coefficient", "x_2", "profile shift coefficient of the wheel")
axial_thickness = parameter(
    "worm_axial_thread_thickness_mm", "s_mx1", "axial thread thickness of the worm", domain=POSITIVE
)
normal_thickness = parameter(
    "worm_normal_thread_thickness_mm", "s_mn1", "normal thread thickness of the worm", domain=POSITIVE
)
hob_thickness = parameter(
    "hob_axial_thread_thickness_mm", "s_hob", "axial thread thickness of an equal hob", domain=POSITIVE
)
upper = parameter("worm_thickness_upper_allowance_um", "A_sne", "upper allowance of the normal thread thickness")
lower = parameter("worm_thickness_lower_allowance_um", "A_sni", "lower allowance of the normal thread thickness")
axial_backlash = parameter("axial_backlash_mm", "j_x", "backlash along the worm's axis, by its thread thickness")
circumferential_backlash = parameter(
    "circumferential_backlash_mm", "j_t", "backlash on the wheel's reference circle, by the thread thickness"
)
normal_backlash = parameter("normal_backlash_mm", "j_n", "backlash along the normal at the worm's reference cylinder")
least_backlash = parameter("normal_backlash_min_mm", "j_n_min", "normal backlash of the thickest thread")
most_backlash = parameter("normal_backlash_max_mm", "j_n_max", "normal backlash of the thinnest thread")
wheel_backlash = parameter("wheel_backlash_deg", "j_phi", "angle by which the wheel turns, the worm at rest")

SIZES = (
    quotient, axial_pitch, lead, wheel_radius, wheel_shift, axial_thickness, normal_thickness, hob_thickness, upper,
    lower, axial_backlash, circumferential_backlash, normal_backlash, least_backlash, most_backlash, wheel_backlash,
)  # fmt: skip


def _relations():
    q, p_x, p_z, r_2, x_2 = (size.symbol for size in (quotient, axial_pitch, lead, wheel_radius, wheel_shift))
    allowance, s_n, s_x = (size.symbol for size in (k.thickness_allowance, normal_thickness, axial_thickness))
    j_x, j_t, j_n = (size.symbol for size in (axial_backlash, circumferential_backlash, normal_backlash))
    nominal = sp.pi * m_n - k.groove_width
    right = Sigma - sp.pi / 2
    slanted = m_n * T_1 / (2 * r_1)
    return (
        relation(r_1, q * m_x / 2, q, m_x),
        relation(p_x, sp.pi * m_x, m_x),
        relation(p_z, p_x * T_1, p_x),
        Relation(
            lam, sp.atan2(m_x * T_1 / 2, r_1),
            {r_1: m_x * T_1 / (2 * sp.tan(lam)), m_x: 2 * r_1 * sp.tan(lam) / T_1},
        ),
        Relation(m_n, m_x * sp.cos(lam), {m_x: m_n / sp.cos(lam), lam: sp.acos(m_n / m_x)}),
        Relation(lam, sp.asin(slanted), {r_1: m_n * T_1 / (2 * sp.sin(lam)), m_n: 2 * r_1 * sp.sin(lam) / T_1}),
        Relation(r_2, only_where_zero(right, m_x * T_2 / 2), {m_x: only_where_zero(right, 2 * r_2 / T_2)}),
        relation(A, r_1 + r_2 + x_2 * m_x, r_1, r_2, x_2),
        relation(s_n, nominal + allowance, allowance),
        relation(s_x, s_n / sp.cos(lam), s_n),
        relation(hob_thickness.symbol, nominal / sp.cos(lam)),
        relation(allowance, (upper.symbol + lower.symbol) / 2, upper.symbol, lower.symbol),
        relation(j_x, -allowance / sp.cos(lam), allowance),
        relation(j_t, j_x, j_x),
        relation(j_n, j_x * sp.cos(lam) * sp.cos(alpha), j_x),
        relation(least_backlash.symbol, -upper.symbol * sp.cos(alpha), upper.symbol),
        relation(most_backlash.symbol, -lower.symbol * sp.cos(alpha), lower.symbol),
        relation(wheel_backlash.symbol, 2 * j_x / (m_x * T_2), j_x),
    )  # fmt: skip


def drawing():
    """The drawing of the family."""
    return Drawing(
        sizes=SIZES,
        relations=_relations(),
        defaults=(
            Assumed(
                k.thickness_allowance.symbol, sp.Integer(0), "no allowance",
                unless=(axial_thickness.symbol, normal_thickness.symbol, upper.symbol, lower.symbol),
            ),
        ),
    )  # fmt: skip
