/* Midpoint and radius, the midpoint in two doubles: 106 bits.  SPDX-License-Identifier: MIT-0
 *
 * Sums and products of doubles split exactly into a double and its rest (Knuth, Dekker: "A floating-point technique for
 * extending the available precision", Numer. Math. 18 (1971)); what is rounded after that is added to the radius, as in
 * ball.h. Quotients, roots and arcs are refined from a double; the radius is what their own equation leaves over. */
#ifndef MWC_WIDE_H
#define MWC_WIDE_H

#include "ball.h"

/* Makes good what up to 2^8 roundings of one operation's radius lose. */
static const double MWC_GROWN = 1.0000000000000284;

/* pi/2 within 2^-109. */
static const mw_wide MWC_HALF_PI = { 1.5707963267948966, 6.123233995736766e-17, 1.5e-33 };

static inline mw_wide mwc_wide(double hi, double lo, double radius)
{
    mw_wide w;
    w.hi = hi;
    w.lo = lo;
    w.radius = radius;
    return w;
}

static inline mw_wide mwc_wide_of(double a)
{
    return mwc_wide(a, 0.0, 0.0);
}

/* a + b = sum + rest */
static inline double mwc_two_sum(double a, double b, double *rest)
{
    const double sum = a + b, other = sum - a;
    *rest = (a - (sum - other)) + (b - other);
    return sum;
}

/* a * b = product + rest, but for underflow of the rest */
static inline double mwc_two_product(double a, double b, double *rest)
{
    const double splitter = 134217729.0, p = a * b, ca = splitter * a, cb = splitter * b; /* 2^27 + 1 */
    const double a1 = ca - (ca - a), a2 = a - a1, b1 = cb - (cb - b), b2 = b - b1;
    *rest = ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2;
    return p;
}

static inline mw_wide mwc_wide_joined(double hi, double lo, double radius)
{
    double rest;
    const double sum = mwc_two_sum(hi, lo, &rest);
    return mwc_wide(sum, rest, radius * MWC_GROWN);
}

/* Largest and least size within the radius. */
static inline double mwc_wide_most(mw_wide a)
{
    return (mwc_abs(a.hi) + mwc_abs(a.lo) + a.radius) * MWC_GROWN;
}

static inline double mwc_wide_least(mw_wide a)
{
    return mwc_abs(a.hi) - (mwc_abs(a.lo) + a.radius) * MWC_GROWN;
}

static inline mw_wide mwc_wide_where(int defined, mw_wide a)
{
    if (!defined) a.radius = HUGE_VAL;
    return a;
}

static inline mw_wide mwc_wide_neg(mw_wide a)
{
    return mwc_wide(-a.hi, -a.lo, a.radius);
}

static inline mw_wide mwc_wide_add(mw_wide a, mw_wide b)
{
    double e, f;
    const double s = mwc_two_sum(a.hi, b.hi, &e), t = mwc_two_sum(a.lo, b.lo, &f), c = e + t, low = c + f;
    return mwc_wide_joined(s, low, (a.radius + b.radius) + MWC_U * (mwc_abs(c) + mwc_abs(low)));
}

static inline mw_wide mwc_wide_sub(mw_wide a, mw_wide b)
{
    return mwc_wide_add(a, mwc_wide_neg(b));
}

static inline mw_wide mwc_wide_mul(mw_wide a, mw_wide b)
{
    double e;
    const double p = mwc_two_product(a.hi, b.hi, &e), c = a.hi * b.lo, d = a.lo * b.hi, cross = c + d, low = e + cross;
    const double size = mwc_abs(a.hi) + mwc_abs(a.lo), other = mwc_abs(b.hi) + mwc_abs(b.lo);
    const double spread = size * b.radius + a.radius * (other + b.radius);
    const double rounding = MWC_U * (mwc_abs(c) + mwc_abs(d) + mwc_abs(cross) + mwc_abs(low)) + mwc_abs(a.lo * b.lo);
    const int split = mwc_abs(p) > 1e-250 || a.hi == 0.0 || b.hi == 0.0; /* else the rest may have underflowed */
    return mwc_wide_where(split, mwc_wide_joined(p, low, spread + (rounding + MWC_TINY)));
}

static inline mw_wide mwc_wide_sqr(mw_wide a)
{
    return mwc_wide_mul(a, a);
}

/* a/b - q = (a - q b)/b */
static inline mw_wide mwc_wide_div(mw_wide a, mw_wide b)
{
    const mw_wide first = mwc_wide_of(a.hi / b.hi);
    const mw_wide more = mwc_wide_of(mwc_wide_sub(a, mwc_wide_mul(first, b)).hi / b.hi);
    const mw_wide q = mwc_wide_joined(first.hi, more.hi, 0.0);
    const double least = mwc_wide_least(b);
    const double left = mwc_wide_most(mwc_wide_sub(a, mwc_wide_mul(q, b)));
    return mwc_wide_where(least > 0.0, mwc_wide_joined(q.hi, q.lo, left / (least * (1.0 - 8.0 * MWC_U))));
}

/* sqrt(a) - s = (a - s^2)/(sqrt(a) + s) */
static inline mw_wide mwc_wide_sqrt(mw_wide a)
{
    if (a.hi == 0.0 && a.radius == 0.0) return a;
    const mw_wide first = mwc_wide_of(sqrt(a.hi));
    const mw_wide s = mwc_wide_joined(first.hi, mwc_wide_sub(a, mwc_wide_sqr(first)).hi / (2.0 * first.hi), 0.0);
    const double left = mwc_wide_most(mwc_wide_sub(a, mwc_wide_sqr(s))), least = mwc_wide_least(s) * (1.0 - 8.0 * MWC_U);
    return mwc_wide_where(a.hi > 0.0 && mwc_wide_least(a) > 0.0, mwc_wide_joined(s.hi, s.lo, left / least));
}

/* From 0 to the largest size, where the sign is not known. */
static inline mw_wide mwc_wide_magnitude(mw_wide a)
{
    if (mwc_wide_least(a) > 0.0) return a.hi < 0.0 ? mwc_wide_neg(a) : a;
    const double half = 0.5 * mwc_wide_most(a);
    return mwc_wide_where(half < HUGE_VAL, mwc_wide(half, 0.0, half * (1.0 + 8.0 * MWC_U)));
}

/* 1/n! for n = 1, 3, ... and for n = 0, 2, ..., and the doubles nearest to those that follow. */
enum { MWC_WIDE_TERMS = 11, MWC_MORE_TERMS = 6 };
static const mw_wide MWC_OF_SINE[] = {
    { 1.0, 0.0, 0.0 },
    { 0.16666666666666666, 9.25185853854297e-18, 5.19e-34 },
    { 0.008333333333333333, 1.1564823173178714e-19, 1.62e-36 },
    { 0.0001984126984126984, 1.7209558293420705e-22, 1.51e-40 },
    { 2.7557319223985893e-06, -1.858393274046472e-22, 8.58e-39 },
    { 2.505210838544172e-08, -1.448814070935912e-24, 2.06e-41 },
    { 1.6059043836821613e-10, 1.2585294588752098e-26, 5.37e-43 },
    { 7.647163731819816e-13, 7.03872877733453e-30, 7.91e-48 },
    { 2.8114572543455206e-15, 1.6508842730861433e-31, 2.91e-50 },
    { 8.22063524662433e-18, 2.2141894119604265e-34, 1.52e-50 },
    { 1.9572941063391263e-20, -1.3643503830087908e-36, 1.35e-53 }
}, MWC_OF_COSINE[] = {
    { 1.0, 0.0, 0.0 },
    { 0.5, 0.0, 0.0 },
    { 0.041666666666666664, 2.3129646346357427e-18, 1.30e-34 },
    { 0.001388888888888889, -5.300543954373577e-20, 1.76e-36 },
    { 2.48015873015873e-05, 2.1511947866775882e-23, 1.88e-41 },
    { 2.755731922398589e-07, 2.3767714622250297e-23, 3.30e-40 },
    { 2.08767569878681e-09, -1.20734505911326e-25, 1.72e-42 },
    { 1.1470745597729725e-11, 2.0655512752830745e-28, 6.96e-45 },
    { 4.779477332387385e-14, 4.399205485834081e-31, 4.94e-49 },
    { 1.5619206968586225e-16, 1.1910679660273754e-32, 4.62e-49 },
    { 4.110317623312165e-19, 1.4412973378659527e-36, 5.34e-53 }
};
static const double MWC_MORE_OF_SINE[] = {
    3.868170170630684e-23, 6.446950284384474e-26, 9.183689863795546e-29, 1.1309962886447716e-31, 1.216125041553518e-34, 1.151633562077195e-37
}, MWC_MORE_OF_COSINE[] = {
    8.896791392450574e-22, 1.6117375710961184e-24, 2.4795962632247976e-27, 3.279889237069838e-30, 3.7699876288159054e-33, 3.8003907548547434e-36
};

/* Sum of (-z)^k times these, to k = 16: the later ones do not need two doubles. */
static inline mw_wide mwc_wide_series(mw_wide z, const mw_wide *terms, const double *more)
{
    const mw_ball near = mwc_of_wide(z);
    mw_ball rest = mwc_make(0.0, 1e-38); /* the first that is left out, 1/34!, and what follows */
    for (int k = MWC_MORE_TERMS - 1; k >= 0; k--)
        rest = mwc_sub(mwc_make(more[k], MWC_U * more[k]), mwc_mul(near, rest));
    mw_wide sum = mwc_wide(rest.mid, 0.0, mwc_reach(rest));
    for (int k = MWC_WIDE_TERMS - 1; k >= 0; k--) sum = mwc_wide_sub(terms[k], mwc_wide_mul(z, sum));
    return sum;
}

static inline void mwc_wide_sincos(mw_wide a, mw_wide *sine, mw_wide *cosine)
{
    const int near = mwc_abs(a.hi) < MWC_FAR;
    const double magic = 6755399441055744.0, k = near ? (a.hi * 0.6366197723675814 + magic) - magic : 0.0;
    const double d = a.radius;
    const mw_wide middle = mwc_wide(near ? a.hi : 0.0, a.lo, 0.0);
    const mw_wide r = mwc_wide_sub(middle, mwc_wide_mul(mwc_wide_of(k), MWC_HALF_PI)), z = mwc_wide_sqr(r);
    const mw_wide s = mwc_wide_mul(r, mwc_wide_series(z, MWC_OF_SINE, MWC_MORE_OF_SINE));
    const mw_wide c = mwc_wide_series(z, MWC_OF_COSINE, MWC_MORE_OF_COSINE);
    const int quadrant = (int)k, odd = quadrant & 1;
    const mw_wide first = odd ? c : s, second = odd ? s : c;
    *sine = (quadrant & 2) ? mwc_wide_neg(first) : first;
    *cosine = ((quadrant + 1) & 2) ? mwc_wide_neg(second) : second;
    const double by_sine = mwc_wide_most(*cosine) * d + 0.5 * d * d, by_cosine = mwc_wide_most(*sine) * d + 0.5 * d * d;
    sine->radius = near ? (sine->radius + by_sine) * MWC_GROWN : HUGE_VAL;
    cosine->radius = near ? (cosine->radius + by_cosine) * MWC_GROWN : HUGE_VAL;
}

/* As mwc_atan2. */
static inline mw_wide mwc_wide_atan2(mw_wide y, mw_wide x)
{
    const double t = mwi_angle(y.hi, x.hi);
    const int uncut = (x.hi > 0.0 && mwc_wide_least(x) > 0.0) || mwc_wide_least(y) > 0.0;
    mw_wide s, c;
    mwc_wide_sincos(mwc_wide_of(t), &s, &c);
    const mw_wide along = mwc_wide_add(mwc_wide_mul(x, c), mwc_wide_mul(y, s));
    const mw_wide d = mwc_wide_div(mwc_wide_sub(mwc_wide_mul(y, c), mwc_wide_mul(x, s)), along);
    const double size = mwc_abs(d.hi) + mwc_abs(d.lo), cube = size * size * size; /* three times what is needed */
    mw_wide sum = mwc_wide_add(mwc_wide_of(t), d);
    sum.radius = (sum.radius + cube) * MWC_GROWN;
    return mwc_wide_where(uncut && along.hi > 0.0 && mwc_abs(t) < 3.15 && (t < 0.0) == (y.hi < 0.0), sum);
}

static inline mw_wide mwc_wide_sign(mw_wide a)
{
    const int known = mwc_wide_least(a) > 0.0 || (a.hi == 0.0 && a.radius == 0.0);
    return mwc_wide_where(known, mwc_wide_of(a.hi < 0.0 ? -1.0 : 1.0));
}

#endif
