/* Functions of one variable t, -1 <= t <= 1, as polynomials with an error bound: Taylor models. SPDX-License-Identifier: MIT-0
 *
 * A number is every function within radius of c[0] + c[1] t + ... + c[8] t^8 (Makino, Berz, "Taylor models and other validated
 * functional inclusion methods", Int. J. Pure Appl. Math. 4 (2003)). What a product has beyond the eighth power joins the
 * radius, and so does every rounding, by ball.h. Quotients and roots are power series, found as they come; the radius is what
 * their own equation leaves over. */
#ifndef MWC_POLYNOMIAL_H
#define MWC_POLYNOMIAL_H

#include "../mw_certify.h"
#include "ball.h"

enum { MWC_ORDER = MW_ORDER };

/* Makes good what up to 2^10 roundings of one operation's radius lose. */
static const double MWC_SUMMED = 1.0000000000002274;

/* Beyond this range sine and cosine are not expanded; terms of their series. */
static const double MWC_BENDING = 4.0;
enum { MWC_TERMS = 18 };

static inline mw_polynomial mwc_poly_of_ball(mw_ball b)
{
    mw_polynomial p = { { 0.0 }, 0.0 };
    p.c[0] = b.mid;
    p.radius = mwc_reach(b);
    return p;
}

static inline mw_polynomial mwc_poly_of_wide(mw_wide w)
{
    return mwc_poly_of_ball(mwc_of_wide(w));
}

static inline mw_polynomial mwc_poly_undefined(mw_polynomial p)
{
    p.radius = HUGE_VAL;
    return p;
}

/* Largest size of the powers from `from` on, and of all with the radius. */
static inline double mwc_poly_part(const mw_polynomial *a, int from)
{
    double sum = 0.0;
    for (int k = from; k <= MWC_ORDER; k++) sum += mwc_abs(a->c[k]);
    return sum * MWC_SUMMED;
}

static inline double mwc_poly_most(const mw_polynomial *a)
{
    return (mwc_poly_part(a, 0) + a->radius) * MWC_SUMMED;
}

/* Least size, or not above zero. */
static inline double mwc_poly_least(const mw_polynomial *a)
{
    return (mwc_abs(a->c[0]) - (mwc_poly_part(a, 1) + a->radius) * MWC_SUMMED) * (1.0 - 8.0 * MWC_U);
}

static inline mw_polynomial mwc_poly_add(mw_polynomial a, mw_polynomial b)
{
    double rounded = 0.0;
    for (int k = 0; k <= MWC_ORDER; k++) {
        a.c[k] += b.c[k];
        rounded += mwc_abs(a.c[k]);
    }
    a.radius = ((a.radius + b.radius) + MWC_U * rounded) * MWC_SUMMED;
    return a;
}

static inline mw_polynomial mwc_poly_neg(mw_polynomial a)
{
    for (int k = 0; k <= MWC_ORDER; k++) a.c[k] = -a.c[k];
    return a;
}

static inline mw_polynomial mwc_poly_sub(mw_polynomial a, mw_polynomial b)
{
    return mwc_poly_add(a, mwc_poly_neg(b));
}

static mw_polynomial mwc_poly_mul(mw_polynomial a, mw_polynomial b)
{
    mw_polynomial p;
    double rounded = 0.0, beyond = 0.0, rest = 0.0;
    for (int k = 0; k <= MWC_ORDER; k++) {
        double sum = a.c[0] * b.c[k];
        rounded += mwc_abs(sum);
        for (int i = 1; i <= k; i++) {
            const double term = a.c[i] * b.c[k - i];
            sum += term;
            rounded += mwc_abs(term) + mwc_abs(sum);
        }
        p.c[k] = sum;
    }
    for (int i = 1; i <= MWC_ORDER; i++) { /* a[i] meets b[j] with i + j > order */
        rest += mwc_abs(b.c[MWC_ORDER + 1 - i]);
        beyond += mwc_abs(a.c[i]) * rest;
    }
    const double spread = mwc_poly_part(&a, 0) * b.radius + a.radius * (mwc_poly_part(&b, 0) + b.radius);
    p.radius = (spread + beyond + (MWC_U * rounded + 100.0 * MWC_TINY)) * MWC_SUMMED;
    return p;
}

static inline mw_polynomial mwc_poly_sqr(mw_polynomial a)
{
    return mwc_poly_mul(a, a);
}

static mw_polynomial mwc_poly_div(mw_polynomial a, mw_polynomial b)
{
    mw_polynomial q;
    for (int k = 0; k <= MWC_ORDER; k++) {
        double left = a.c[k];
        for (int j = 1; j <= k; j++) left -= b.c[j] * q.c[k - j];
        q.c[k] = left / b.c[0];
    }
    q.radius = 0.0;
    const double least = mwc_poly_least(&b);
    const mw_polynomial left = mwc_poly_sub(a, mwc_poly_mul(q, b));
    q.radius = least > 0.0 ? mwc_poly_most(&left) / least * MWC_SUMMED : HUGE_VAL;
    return q;
}

static mw_polynomial mwc_poly_sqrt(mw_polynomial a)
{
    mw_polynomial s;
    if (a.c[0] == 0.0 && mwc_poly_part(&a, 1) == 0.0 && a.radius == 0.0) return a;
    s.c[0] = sqrt(a.c[0]);
    for (int k = 1; k <= MWC_ORDER; k++) {
        double left = a.c[k];
        for (int j = 1; j < k; j++) left -= s.c[j] * s.c[k - j];
        s.c[k] = left / (2.0 * s.c[0]);
    }
    s.radius = 0.0;
    const double least = mwc_poly_least(&s);
    const mw_polynomial left = mwc_poly_sub(a, mwc_poly_sqr(s));
    s.radius = a.c[0] > 0.0 && mwc_poly_least(&a) > 0.0 && least > 0.0 ? mwc_poly_most(&left) / least * MWC_SUMMED : HUGE_VAL;
    return s;
}

/* 1 - z/(n(n+1)) (1 - z/((n+2)(n+3)) (...)), the tail after MWC_TERMS below `tail` */
static inline mw_polynomial mwc_poly_series(mw_polynomial z, int n, double tail)
{
    const mw_polynomial one = mwc_poly_of_ball(mwc_make(1.0, 0.0));
    mw_polynomial sum = one;
    for (int k = n + 2 * (MWC_TERMS - 1); k >= n; k -= 2) {
        const mw_polynomial divisor = mwc_poly_of_ball(mwc_make((double)(k * (k + 1)), 0.0));
        sum = mwc_poly_sub(one, mwc_poly_mul(mwc_poly_div(z, divisor), sum));
    }
    sum.radius += tail;
    return sum;
}

/* About the middle m, a = m + p: sin m cos p + cos m sin p; the radius is carried by the slope, at most 1. */
static void mwc_poly_sincos(mw_polynomial a, mw_polynomial *sine, mw_polynomial *cosine)
{
    const double range = mwc_poly_part(&a, 1), radius = a.radius;
    mw_ball s, c;
    mwc_sincos(mwc_make(a.c[0], 0.0), &s, &c);
    a.c[0] = 0.0;
    a.radius = 0.0;
    /* range^36/36! and less where the range is below MWC_BENDING */
    const double tail = range < MWC_BENDING ? 2e-20 : HUGE_VAL;
    const mw_polynomial z = mwc_poly_sqr(a), straight = mwc_poly_series(z, 1, tail);
    const mw_polynomial bent = mwc_poly_mul(a, mwc_poly_series(z, 2, tail));
    const mw_polynomial ps = mwc_poly_of_ball(s), pc = mwc_poly_of_ball(c);
    *sine = mwc_poly_add(mwc_poly_mul(ps, straight), mwc_poly_mul(pc, bent));
    *cosine = mwc_poly_sub(mwc_poly_mul(pc, straight), mwc_poly_mul(ps, bent));
    sine->radius = (sine->radius + radius) * MWC_SUMMED;
    cosine->radius = (cosine->radius + radius) * MWC_SUMMED;
}

/* About an angle t of the middle: t + atan d, d = (y cos t - x sin t)/(x cos t + y sin t). The arc's series ends where d is
 * below a half: d^41/41. */
static mw_polynomial mwc_poly_atan2(mw_polynomial y, mw_polynomial x)
{
    const double t = mwi_angle(y.c[0], x.c[0]);
    const int uncut = (x.c[0] > 0.0 && mwc_poly_least(&x) > 0.0) || mwc_poly_least(&y) > 0.0;
    const int right = mwc_abs(t) < 3.15 && (t < 0.0) == (y.c[0] < 0.0);
    mw_ball s, c;
    mwc_sincos(mwc_make(t, 0.0), &s, &c);
    const mw_polynomial ps = mwc_poly_of_ball(s), pc = mwc_poly_of_ball(c);
    const mw_polynomial along = mwc_poly_add(mwc_poly_mul(x, pc), mwc_poly_mul(y, ps));
    const mw_polynomial d = mwc_poly_div(mwc_poly_sub(mwc_poly_mul(y, pc), mwc_poly_mul(x, ps)), along);
    const mw_polynomial z = mwc_poly_sqr(d);
    mw_polynomial sum = mwc_poly_of_ball(mwc_make(0.0, 0.0));
    for (int k = 39; k >= 1; k -= 2) {
        const mw_polynomial share = mwc_poly_of_ball(mwc_div(mwc_make(1.0, 0.0), mwc_make((double)k, 0.0)));
        sum = mwc_poly_sub(share, mwc_poly_mul(z, sum));
    }
    sum = mwc_poly_add(mwc_poly_of_ball(mwc_make(t, 0.0)), mwc_poly_mul(d, sum));
    const double most = mwc_poly_most(&d), fourth = most * most * most * most, eighth = fourth * fourth;
    sum.radius += eighth * eighth * eighth * eighth * eighth * most / 41.0 * MWC_SUMMED;
    const int near = most < 0.5 && along.c[0] > 0.0;
    return uncut && right && near ? sum : mwc_poly_undefined(sum);
}

/* From 0 to the largest size, where the sign is not known everywhere. */
static inline mw_polynomial mwc_poly_magnitude(mw_polynomial a)
{
    if (mwc_poly_least(&a) > 0.0) return a.c[0] < 0.0 ? mwc_poly_neg(a) : a;
    const double half = 0.5 * mwc_poly_most(&a);
    const mw_polynomial size = mwc_poly_of_ball(mwc_make(half, half * (1.0 + 8.0 * MWC_U)));
    return half < HUGE_VAL ? size : mwc_poly_undefined(size);
}

/* Which side is taken of each number whose sign is not known everywhere, in the order in which they are met: bit k of `taken`
 * set, the side above 0. met: so many in this run; bits: in the longest of all runs; most: that may be taken so. */
typedef struct mwc_sides {
    int most, met, bits;
    unsigned taken;
} mwc_sides;

/* Whether there are further sides to take. */
static inline int mwc_other_sides(mwc_sides *s)
{
    if (++s->taken >> s->bits == 0) return 1;
    s->taken = 0;
    return s->bits = 0;
}

/* -1 below 0, else 1, and that of the side which is taken where both occur. */
static inline mw_polynomial mwc_poly_sign(mw_polynomial a, mwc_sides *s)
{
    const int zero = a.c[0] == 0.0 && mwc_poly_part(&a, 1) == 0.0 && a.radius == 0.0;
    const int known = zero || mwc_poly_least(&a) > 0.0, above = known ? a.c[0] >= 0.0 : (int)(s->taken >> s->met & 1U);
    const mw_polynomial sign = mwc_poly_of_ball(mwc_make(above ? 1.0 : -1.0, 0.0));
    if (known) return sign;
    if (s->met == s->most) return mwc_poly_undefined(sign);
    if (++s->met > s->bits) s->bits = s->met;
    return sign;
}

/* Holds what either holds. */
static inline mw_polynomial mwc_poly_hull(mw_polynomial a, mw_polynomial b)
{
    const mw_polynomial half = mwc_poly_of_ball(mwc_make(0.5, 0.0)), apart = mwc_poly_sub(a, b);
    mw_polynomial middle = mwc_poly_mul(half, mwc_poly_add(a, b));
    middle.radius = (middle.radius + 0.5 * mwc_poly_most(&apart)) * MWC_SUMMED;
    return middle;
}

/* Value at a number t of [-1, 1]. */
static inline mw_ball mwc_poly_at(const mw_polynomial *a, mw_ball t)
{
    mw_ball sum = mwc_make(a->c[MWC_ORDER], 0.0);
    for (int k = MWC_ORDER - 1; k >= 0; k--) sum = mwc_add(mwc_mul(sum, t), mwc_make(a->c[k], 0.0));
    sum.radius = mwc_reach(sum) + a->radius;
    return sum;
}

#endif
