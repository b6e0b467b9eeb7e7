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

/* 1 - z/(n(n+1)) (1 - z/((n+2)(n+3)) (...)): from n = 2 the sine's series over its argument, from n = 1 the cosine's. */
static inline mw_wide mwc_wide_series(mw_wide z, int n)
{
    mw_wide sum = mwc_wide_of(1.0);
    for (int k = n + 30; k >= n; k -= 2)
        sum = mwc_wide_sub(mwc_wide_of(1.0), mwc_wide_mul(mwc_wide_div(z, mwc_wide_of((double)(k * (k + 1)))), sum));
    sum.radius += 1e-39; /* the first omitted term, 0.8^32/32! at most */
    return sum;
}

static inline void mwc_wide_sincos(mw_wide a, mw_wide *sine, mw_wide *cosine)
{
    const int near = mwc_abs(a.hi) < MWC_FAR;
    const double magic = 6755399441055744.0, k = near ? (a.hi * 0.6366197723675814 + magic) - magic : 0.0;
    const double d = a.radius;
    const mw_wide middle = mwc_wide(near ? a.hi : 0.0, a.lo, 0.0);
    const mw_wide r = mwc_wide_sub(middle, mwc_wide_mul(mwc_wide_of(k), MWC_HALF_PI)), z = mwc_wide_sqr(r);
    const mw_wide s = mwc_wide_mul(r, mwc_wide_series(z, 2)), c = mwc_wide_series(z, 1);
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
