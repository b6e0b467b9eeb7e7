/* Midpoint and radius: doubles rounded to nearest, no rounding mode touched.  SPDX-License-Identifier: MIT-0
 *
 * Rounding to nearest puts a result within MWC_U of its own size of the exact one, and, where it is subnormal, within half
 * of the least double (Rump, "Fast and parallel interval arithmetic", BIT 39 (1999); Higham, "Accuracy and Stability of
 * Numerical Algorithms", 2nd ed., 2.1). Each operation adds that to what the radii of its arguments make of it. Radii are
 * sums and products of numbers not below zero: what their own rounding loses, a few thousand factors 1 + MWC_U at most
 * (the printer counts them), MWC_READ makes good where a radius is read. An operation that is not defined everywhere
 * within the radii has an infinite one. Needs IEEE arithmetic with subnormal numbers: see mwc_arithmetic. */
#ifndef MWC_BALL_H
#define MWC_BALL_H

#include <math.h>
#include "../circular.h"
#include "../mw_enclosures.h"

/* a b + c, rounded once where MW_FUSED is defined: the bounds hold for either. */
#ifdef MW_FUSED
#define MWC_FMA(a, b, c) fma(a, b, c)
#else
#define MWC_FMA(a, b, c) ((a) * (b) + (c))
#endif

/* 2^-53; 2^-1073: what underflow loses in one operation, three halves of the least double at most; 1 + 2^-40. */
static const double MWC_U = 1.1102230246251565e-16, MWC_TINY = 9.881312916824931e-324, MWC_READ = 1.0000000000009095;

/* Largest error of mwi_sine for |a| < MWC_FAR. With r the reduced argument, |r| < 0.7854:
 *   reduction   a - k P1 is exact (Sterbenz; k P1 and k P2 are exact, P1 and P2 have 33 bits, |k| < 2^20); the two other
 *               differences round by a quarter of MWC_U each where |r| < 1/2, else by half of it;
 *   series      Taylor's, its first omitted term below 1e-19;
 *   evaluation  last sum half of MWC_U; the terms before it, below 0.08 in the sine and 0.016 in the cosine, four
 *               roundings each; the square in 1 - r^2/2 a quarter of MWC_U.
 * Sine 0.88 + 0.5 + 0.35, cosine 0.71 + 0.5 + 0.25 + 0.08: below two units of MWC_U. Where k = 0 nothing is reduced, and the
 * sine's error is as small a share of the sine itself: 1 for the last sum and 0.6 for the terms before it. */
static const double MWC_SINE = 2.220446049250313e-16, MWC_FAR = MWI_CIRCULAR_FAR;

MWI_INLINE double mwc_abs(double a)
{
#ifdef __GNUC__
    return __builtin_fabs(a);
#else
    return fabs(a);
#endif
}

/* The radius, with what its rounding lost. */
MWI_INLINE double mwc_reach(mw_ball a)
{
    return MWC_READ * a.radius;
}

MWI_INLINE mw_ball mwc_make(double mid, double radius)
{
    mw_ball b;
    b.mid = mid;
    b.radius = radius;
    return b;
}

/* Whatever the operation was, it is not defined everywhere here. */
MWI_INLINE mw_ball mwc_where(int defined, double mid, double radius)
{
    return mwc_make(mid, defined ? radius : HUGE_VAL);
}

MWI_INLINE mw_ball mwc_add(mw_ball a, mw_ball b)
{
    const double m = a.mid + b.mid;
    return mwc_make(m, MWC_FMA(MWC_U, mwc_abs(m), a.radius + b.radius));
}

MWI_INLINE mw_ball mwc_sub(mw_ball a, mw_ball b)
{
    const double m = a.mid - b.mid;
    return mwc_make(m, MWC_FMA(MWC_U, mwc_abs(m), a.radius + b.radius));
}

MWI_INLINE mw_ball mwc_neg(mw_ball a)
{
    return mwc_make(-a.mid, a.radius);
}

MWI_INLINE mw_ball mwc_mul(mw_ball a, mw_ball b)
{
    const double m = a.mid * b.mid;
    const double most = MWC_FMA(MWC_READ, b.radius, mwc_abs(b.mid)), rounding = MWC_FMA(MWC_U, mwc_abs(m), MWC_TINY);
    return mwc_make(m, MWC_FMA(mwc_abs(a.mid), b.radius, MWC_FMA(a.radius, most, rounding)));
}

MWI_INLINE mw_ball mwc_sqr(mw_ball a)
{
    const double m = a.mid * a.mid;
    return mwc_make(m, MWC_FMA(a.radius, 2.0 * mwc_abs(a.mid) + mwc_reach(a), MWC_FMA(MWC_U, m, MWC_TINY)));
}

/* a/b - ma/mb = ((a - ma) - (ma/mb)(b - mb))/b; the factors next to 1 round outwards. */
MWI_INLINE mw_ball mwc_div(mw_ball a, mw_ball b)
{
    const double q = a.mid / b.mid, least = mwc_abs(b.mid) - mwc_reach(b);
    const double spread = (mwc_abs(q) * (1.0 + 4.0 * MWC_U) * b.radius + a.radius) / (least * (1.0 - 8.0 * MWC_U));
    return mwc_where(least > 0.0, q, spread + (MWC_U * mwc_abs(q) + MWC_TINY));
}

/* |sqrt(a) - sqrt(m)| = |a - m|/(sqrt(a) + sqrt(m)) <= r/sqrt(m) */
MWI_INLINE mw_ball mwc_sqrt(mw_ball a)
{
    const double root = sqrt(a.mid);
    const int zero = a.mid == 0.0 && a.radius == 0.0;
    const double radius = a.radius * (1.0 + 8.0 * MWC_U) / root + MWC_U * root;
    return mwc_where(zero || a.mid - mwc_reach(a) > 0.0, root, zero ? 0.0 : radius);
}

/* From 0 to the largest size, where the sign is not known. */
MWI_INLINE mw_ball mwc_magnitude(mw_ball a)
{
    const double size = mwc_abs(a.mid), half = 0.5 * (size + mwc_reach(a));
    const int known = size > mwc_reach(a);
    return mwc_where(half < HUGE_VAL, known ? size : half, known ? a.radius : half * (1.0 + 8.0 * MWC_U));
}

/* By value: a compiler that takes several points at once does not do so with places in memory. */
typedef struct mwc_turn {
    mw_ball sine, cosine;
} mwc_turn;

/* |sin(m + d) - sin m| <= |cos m| |d| + d^2/2 */
MWI_INLINE mwc_turn mwc_turned(mw_ball a)
{
    double s, c;
    mwc_turn turn;
    const int near = mwc_abs(a.mid) < MWC_FAR;
    mwi_sine(near ? a.mid : 0.0, &s, &c);
    const double bend = 0.5 * a.radius * mwc_reach(a), size = mwc_abs(a.mid) < 0.78 ? mwc_abs(s) : 1.0;
    turn.sine = mwc_where(near, s, (mwc_abs(c) + MWC_SINE) * a.radius + bend + (MWC_SINE * size + MWC_TINY));
    turn.cosine = mwc_where(near, c, (mwc_abs(s) + MWC_SINE) * a.radius + bend + MWC_SINE);
    return turn;
}

MWI_INLINE void mwc_sincos(mw_ball a, mw_ball *sine, mw_ball *cosine)
{
    const mwc_turn turn = mwc_turned(a);
    *sine = turn.sine;
    *cosine = turn.cosine;
}

/* Angle of the point (x, y): about any angle t near it, t + atan((y cos t - x sin t)/(x cos t + y sin t)), whose arc is
 * within |d|^3/3 of its tangent d. Nothing is asked of t but that it lies on the right side of the cut. */
MWI_INLINE mw_ball mwc_atan2(mw_ball y, mw_ball x)
{
    const double t = mwi_angle(y.mid, x.mid);
    const int uncut = x.mid - mwc_reach(x) > 0.0 || mwc_abs(y.mid) - mwc_reach(y) > 0.0;
    const mwc_turn turn = mwc_turned(mwc_make(t, 0.0));
    const mw_ball s = turn.sine, c = turn.cosine, along = mwc_add(mwc_mul(x, c), mwc_mul(y, s));
    const mw_ball d = mwc_div(mwc_sub(mwc_mul(y, c), mwc_mul(x, s)), along);
    const double m = t + d.mid, cube = mwc_abs(d.mid) * d.mid * d.mid;
    const int side = x.mid > 0.0 || (t < 0.0) == (y.mid < 0.0), right = along.mid > 0.0 && mwc_abs(t) < 3.15 && side;
    return mwc_where(uncut && right, m, d.radius + MWC_FMA(MWC_U, mwc_abs(m), cube));
}

/* -1 below 0, else 1: known only where the radius leaves no choice. */
MWI_INLINE mw_ball mwc_sign(mw_ball a)
{
    const double reach = mwc_reach(a);
    return mwc_where(a.mid - reach >= 0.0 || a.mid + reach < 0.0, a.mid < 0.0 ? -1.0 : 1.0, 0.0);
}

MWI_INLINE mw_ball mwc_of_wide(mw_wide a)
{
    return mwc_make(a.hi, (mwc_abs(a.lo) + a.radius) * MWC_READ);
}

/* Whether the arithmetic is the one that the bounds are proved for: rounded to nearest, even in a tie, with subnormal
 * numbers, in doubles without wider ones between, products not fused into sums. */
static inline int mwc_arithmetic(void)
{
    volatile double one = 1.0, u = 1.1102230246251565e-16, least = 4.9406564584124654e-324, near = 1.0 + 2.0 * u;
    volatile double down = one + u, up = near + u, half = 2.2250738585072014e-308 * 0.5, square = near * near;
    volatile double below = -one - u, rest = near * near - square;
    return down == 1.0 && up == 1.0 + 4.0 * u && below == -1.0 && least > 0.0 && half > 0.0 && half + half > half && rest == 0.0;
}

#endif
