/* Whether the arithmetic of this program is that for which results are promised.  SPDX-License-Identifier: MIT-0 */
#if !defined(MWI_SELF_TEST_H) && !defined(MW_DEVICE_ONLY)
#define MWI_SELF_TEST_H

#include "choice.h"

/* What of the arithmetic is not sound, 0 where all is: the compiler's and the processor's, which volatile numbers keep from being
 * worked out before the program runs. */
enum { MWI_SOUND, MWI_CONTRACTS, MWI_EXCEEDS, MWI_REORDERS, MWI_INVERTS, MWI_FLUSHES, MWI_NO_NAN, MWI_WRONG_ROOT, MWI_WRONG_CONTACT };

static inline int mwi_unsound(void)
{
    volatile double of_one = 1.0 + 1.0 / 1073741824.0, of_square = 1.0 + 1.0 / 536870912.0, one = 1.0, large = 9007199254740992.0;
    volatile double largest = DBL_MAX, ten = 10.0, seven = 7.0, three = 3.0, least = DBL_MIN, two = 2.0, nothing = NAN;
    const double a = of_one, b = of_square, u = one, l = large, m = largest, t = ten, s = seven, d = three, e = least, w = two;
    const double unknown = nothing, part = e / t;
    volatile double rest = a * a - b;
    if (rest != 0.0) return MWI_CONTRACTS;
    if (m * t / t < HUGE_VAL) return MWI_EXCEEDS;
    if ((l + u) - l != 0.0 || (u + l) + u != l) return MWI_REORDERS;
    if (s / d != 2.3333333333333335 || t / d != 3.3333333333333335 || w / d != 0.6666666666666666) return MWI_INVERTS;
    if (!(part > 0.0) || !(part * t > 0.5 * e)) return MWI_FLUSHES;
    if (unknown == unknown || unknown < u || unknown >= u) return MWI_NO_NAN;
    if (sqrt(w) != 1.4142135623730951 || sqrt(d) != 1.7320508075688772) return MWI_WRONG_ROOT;
    return MWI_SOUND;
}

/* Whether the contact x0[nx] of a design p[np] at an angle is found; s[ns], work[np] and x[nx] are written. */
static inline int mwi_finds(const mw_model *m, const double *p, double phi, const double *x0, double *s, double *work, double *x)
{
    mw_info info;
    return mwi_solve(m, p, phi, s, work, x, &info) >= 0 && mwi_near(m, s, x, x0, MWI_NO_FURTHER) ? MWI_SOUND : MWI_WRONG_CONTACT;
}

#endif
