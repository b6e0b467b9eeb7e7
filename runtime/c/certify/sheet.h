/* Functions of three variables s, t, u, each in [-1, 1], as polynomials with an error bound. SPDX-License-Identifier: MIT-0
 *
 * As polynomial.h, of degree 4 in all together: block k of the coefficients, from MWC_BLOCK[k] on, belongs to u^k, in it
 * c[d (d + 1)/2 + j] to s^(d - j) t^j. across: the highest degree in s and t that occurs; along: the highest power of u; what
 * is beyond these is zero, and products leave it out. What a product has beyond the fourth degree joins the radius. A sum of n
 * rounded products is off by n MWC_U at most of what the sizes of its terms sum up to (Higham, "Accuracy and Stability of
 * Numerical Algorithms", 2nd ed., 3.1); no coefficient has more than 12. Series have no
 * more terms than the degree lets be seen. */
#ifndef MWC_SHEET_H
#define MWC_SHEET_H

#include <string.h>
#include "ball.h"

enum { MWC_DEGREE = 4, MWC_ROOM = 36 };

/* The last place of c is zero: loops over all of it have a constant length, which compilers do at once. */
typedef struct mwc_sheet {
    double c[MWC_ROOM];
    double radius;
    int across, along;
} mwc_sheet;

/* Where a block begins and the last ends. */
static const unsigned char MWC_BLOCK[] = { 0, 15, 25, 31, 34, 35 };

/* Makes good what up to 2^10 roundings of one operation's radius lose. Most roundings of a coefficient. */
static const double MWC_SHEET_SUMMED = 1.0000000000002274, MWC_ROUNDINGS = 17.0;

/* Beyond this range sine and cosine are not expanded. */
static const double MWC_SHEET_BENDING = 4.0;

static inline mwc_sheet mwc_sheet_of_ball(mw_ball b)
{
    mwc_sheet p;
    memset(&p, 0, sizeof p);
    p.c[0] = b.mid;
    p.radius = mwc_reach(b);
    return p;
}

static inline mwc_sheet mwc_sheet_of_wide(mw_wide w)
{
    return mwc_sheet_of_ball(mwc_of_wide(w));
}

static inline mwc_sheet mwc_sheet_undefined(mwc_sheet p)
{
    p.radius = HUGE_VAL;
    return p;
}

/* Sum of the sizes of the terms, in four sums so that none waits for the last. */
static inline double mwc_sheet_size(const double *c)
{
    double sum[4] = { 0.0, 0.0, 0.0, 0.0 };
    for (int k = 0; k < MWC_ROOM; k += 4)
        for (int i = 0; i < 4; i++) sum[i] += mwc_abs(c[k + i]);
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/* Largest size of the terms, with (0) or without (1) the constant one, and of all with the radius. */
static inline double mwc_sheet_part(const mwc_sheet *a, int from)
{
    double sum[4] = { from ? 0.0 : mwc_abs(a->c[0]), mwc_abs(a->c[1]), mwc_abs(a->c[2]), mwc_abs(a->c[3]) };
    for (int k = 4; k < MWC_ROOM; k += 4)
        for (int i = 0; i < 4; i++) sum[i] += mwc_abs(a->c[k + i]);
    return ((sum[0] + sum[1]) + (sum[2] + sum[3])) * MWC_SHEET_SUMMED;
}

static inline double mwc_sheet_most(const mwc_sheet *a)
{
    return (mwc_sheet_part(a, 0) + a->radius) * MWC_SHEET_SUMMED;
}

/* Least size, or not above zero. */
static inline double mwc_sheet_least(const mwc_sheet *a)
{
    return (mwc_abs(a->c[0]) - (mwc_sheet_part(a, 1) + a->radius) * MWC_SHEET_SUMMED) * (1.0 - 8.0 * MWC_U);
}

/* r = a + b or, with sign -1, a - b; r may be either. */
static inline void mwc_sheet_sum(mwc_sheet *r, const mwc_sheet *a, const mwc_sheet *b, double sign)
{
    const double radii = a->radius + b->radius;
    r->across = b->across > a->across ? b->across : a->across;
    r->along = b->along > a->along ? b->along : a->along;
    for (int k = 0; k < MWC_ROOM; k++) r->c[k] = a->c[k] + sign * b->c[k];
    r->radius = (radii + MWC_U * mwc_sheet_size(r->c)) * MWC_SHEET_SUMMED;
}

static inline mwc_sheet mwc_sheet_add(mwc_sheet a, mwc_sheet b)
{
    mwc_sheet_sum(&a, &a, &b, 1.0);
    return a;
}

static inline mwc_sheet mwc_sheet_sub(mwc_sheet a, mwc_sheet b)
{
    mwc_sheet_sum(&a, &a, &b, -1.0);
    return a;
}

static inline mwc_sheet mwc_sheet_neg(mwc_sheet a)
{
    for (int k = 0; k < MWC_ROOM; k++) a.c[k] = -a.c[k];
    return a;
}

/* r = a times a number within `radius` of `by`; r may be a. */
static inline void mwc_sheet_scaled(mwc_sheet *r, const mwc_sheet *a, double by, double radius)
{
    const double spread = mwc_sheet_part(a, 0) * radius + a->radius * (mwc_abs(by) + radius);
    r->across = a->across;
    r->along = a->along;
    for (int k = 0; k < MWC_ROOM; k++) r->c[k] = by * a->c[k];
    r->radius = (spread + (MWC_U * mwc_sheet_size(r->c) + 100.0 * MWC_TINY)) * MWC_SHEET_SUMMED;
}

/* a times a number */
static inline mwc_sheet mwc_sheet_times(mwc_sheet a, mw_ball b)
{
    mwc_sheet_scaled(&a, &a, b.mid, mwc_reach(b));
    return a;
}

/* Sums of the sizes of the terms of each degree in all variables. */
static inline void mwc_sheet_degrees(const mwc_sheet *a, double *sums)
{
    double s[MWC_ROOM];
    for (int k = 0; k < MWC_ROOM; k++) s[k] = mwc_abs(a->c[k]);
    sums[0] = s[0];
    sums[1] = (s[1] + s[2]) + s[15];
    sums[2] = ((s[3] + s[4]) + s[5]) + ((s[16] + s[17]) + s[25]);
    sums[3] = ((s[6] + s[7]) + (s[8] + s[9])) + (((s[18] + s[19]) + s[20]) + ((s[26] + s[27]) + s[31]));
    sums[4] = ((s[10] + s[11]) + (s[12] + s[13])) + (s[14] + (s[21] + s[22]));
    sums[4] += ((s[23] + s[24]) + (s[28] + s[29])) + ((s[30] + s[32]) + (s[33] + s[34]));
}

/* What products of degrees beyond the last come to; the sum of all sizes of each factor. */
static inline double mwc_sheet_beyond(const double *a, const double *b, double *size, double *other)
{
    double beyond = 0.0, rest = 0.0;
    *size = a[0];
    *other = b[0];
    for (int d = 1; d <= MWC_DEGREE; d++) {
        rest += b[MWC_DEGREE + 1 - d];
        beyond += a[d] * rest;
        *size += a[d];
        *other += b[d];
    }
    *size *= MWC_SHEET_SUMMED;
    *other *= MWC_SHEET_SUMMED;
    return beyond;
}

/* Add the product of two blocks, up to degree `most` in s and t. */
static inline void mwc_sheet_blocks(double *p, const double *a, const double *b, int most)
{
    p[0] += a[0] * b[0];
    if (most < 1) return;
    p[1] += a[0] * b[1] + a[1] * b[0];
    p[2] += a[0] * b[2] + a[2] * b[0];
    if (most < 2) return;
    p[3] += (a[0] * b[3] + a[3] * b[0]) + a[1] * b[1];
    p[4] += (a[0] * b[4] + a[4] * b[0]) + (a[1] * b[2] + a[2] * b[1]);
    p[5] += (a[0] * b[5] + a[5] * b[0]) + a[2] * b[2];
    if (most < 3) return;
    p[6] += (a[0] * b[6] + a[6] * b[0]) + (a[1] * b[3] + a[3] * b[1]);
    p[7] += ((a[0] * b[7] + a[7] * b[0]) + (a[1] * b[4] + a[4] * b[1])) + (a[2] * b[3] + a[3] * b[2]);
    p[8] += ((a[0] * b[8] + a[8] * b[0]) + (a[1] * b[5] + a[5] * b[1])) + (a[2] * b[4] + a[4] * b[2]);
    p[9] += (a[0] * b[9] + a[9] * b[0]) + (a[2] * b[5] + a[5] * b[2]);
    if (most < 4) return;
    p[10] += ((a[0] * b[10] + a[10] * b[0]) + (a[1] * b[6] + a[6] * b[1])) + a[3] * b[3];
    p[11] += ((a[0] * b[11] + a[11] * b[0]) + (a[1] * b[7] + a[7] * b[1]))
             + ((a[2] * b[6] + a[6] * b[2]) + (a[3] * b[4] + a[4] * b[3]));
    p[12] += (((a[0] * b[12] + a[12] * b[0]) + (a[1] * b[8] + a[8] * b[1]))
              + ((a[2] * b[7] + a[7] * b[2]) + (a[3] * b[5] + a[5] * b[3]))) + a[4] * b[4];
    p[13] += ((a[0] * b[13] + a[13] * b[0]) + (a[1] * b[9] + a[9] * b[1]))
             + ((a[2] * b[8] + a[8] * b[2]) + (a[4] * b[5] + a[5] * b[4]));
    p[14] += ((a[0] * b[14] + a[14] * b[0]) + (a[2] * b[9] + a[9] * b[2])) + a[5] * b[5];
}

/* Add a block times a number, up to degree `most`. */
static inline void mwc_sheet_more(double *p, const double *a, double by, int most)
{
    const int count = (most + 1) * (most + 2) / 2;
    for (int k = 0; k < count; k++) p[k] += by * a[k];
}

static inline int mwc_sheet_less(int a, int b)
{
    return a < b ? a : b;
}

/* p = a b; p is neither. */
static void mwc_sheet_product(mwc_sheet *p, const mwc_sheet *a, const mwc_sheet *b)
{
    double sums[MWC_DEGREE + 1], others[MWC_DEGREE + 1], size, other;
    if (!a->across && !a->along) {
        mwc_sheet_scaled(p, b, a->c[0], a->radius);
        return;
    }
    if (!b->across && !b->along) {
        mwc_sheet_scaled(p, a, b->c[0], b->radius);
        return;
    }
    p->across = mwc_sheet_less(a->across + b->across, MWC_DEGREE);
    p->along = mwc_sheet_less(a->along + b->along, MWC_DEGREE);
    for (int k = 0; k < MWC_ROOM; k++) p->c[k] = 0.0;
    for (int n = 0; n <= a->along; n++)
        for (int k = 0; k <= b->along && n + k <= MWC_DEGREE; k++) {
            double *const to = p->c + MWC_BLOCK[n + k];
            const double *const from = a->c + MWC_BLOCK[n], *const by = b->c + MWC_BLOCK[k];
            const int most = MWC_DEGREE - n - k;
            if (!a->across) mwc_sheet_more(to, by, from[0], most);
            else if (!b->across) mwc_sheet_more(to, from, by[0], most);
            else mwc_sheet_blocks(to, from, by, most);
        }
    mwc_sheet_degrees(a, sums);
    mwc_sheet_degrees(b, others);
    const double beyond = mwc_sheet_beyond(sums, others, &size, &other);
    const double rounding = MWC_ROUNDINGS * MWC_U * size * other + 100.0 * MWC_TINY;
    const double spread = size * b->radius + a->radius * (other + b->radius);
    p->radius = (spread + beyond + rounding) * MWC_SHEET_SUMMED;
}

static inline mwc_sheet mwc_sheet_mul(mwc_sheet a, mwc_sheet b)
{
    mwc_sheet p;
    mwc_sheet_product(&p, &a, &b);
    return p;
}

/* Into r, which may be an argument. */
static inline void mwc_sheet_to_add(mwc_sheet *r, const mwc_sheet *a, const mwc_sheet *b)
{
    mwc_sheet_sum(r, a, b, 1.0);
}

static inline void mwc_sheet_to_sub(mwc_sheet *r, const mwc_sheet *a, const mwc_sheet *b)
{
    mwc_sheet_sum(r, a, b, -1.0);
}

static inline void mwc_sheet_to_mul(mwc_sheet *r, const mwc_sheet *a, const mwc_sheet *b)
{
    mwc_sheet p;
    mwc_sheet_product(&p, a, b);
    *r = p;
}

static inline mwc_sheet mwc_sheet_sqr(mwc_sheet a)
{
    return mwc_sheet_mul(a, a);
}

/* Of block a, up to `most` in s and t, what is left of coefficient (d, i) once the products of block f, degree 1 at least,
 * with block g, degree `from` at least, are taken off. */
static inline double mwc_sheet_left(const double *a, const double *f, const double *g, int d, int i, int from)
{
    double left = a[d * (d + 1) / 2 + i];
    for (int e = 1; e <= d - from; e++)
        for (int j = i > d - e ? i - (d - e) : 0; j <= e && j <= i; j++)
            left -= f[e * (e + 1) / 2 + j] * g[(d - e) * (d - e + 1) / 2 + i - j];
    return left;
}

/* Block n of a less the products of blocks of f from 1 on with those of g, of which `from` and more are known. */
static inline void mwc_sheet_rest(double *rest, const mwc_sheet *a, const mwc_sheet *f, const mwc_sheet *g, int n, int from)
{
    double known[15] = { 0.0 };
    const int count = MWC_BLOCK[n + 1] - MWC_BLOCK[n];
    for (int k = 1; k <= n - from && k <= f->along; k++)
        mwc_sheet_blocks(known, f->c + MWC_BLOCK[k], g->c + MWC_BLOCK[n - k], MWC_DEGREE - n);
    for (int k = 0; k < count; k++) rest[k] = a->c[MWC_BLOCK[n] + k] - known[k];
}

static mwc_sheet mwc_sheet_div(mwc_sheet a, mwc_sheet b)
{
    mwc_sheet q;
    memset(&q, 0, sizeof q);
    q.across = a.across || b.across ? MWC_DEGREE : 0;
    q.along = a.along || b.along ? MWC_DEGREE : 0;
    for (int n = 0; n <= q.along; n++) {
        double rest[15], *const found = q.c + MWC_BLOCK[n];
        mwc_sheet_rest(rest, &a, &b, &q, n, 0);
        for (int d = 0; d <= q.across && d <= MWC_DEGREE - n; d++)
            for (int i = 0; i <= d; i++) found[d * (d + 1) / 2 + i] = mwc_sheet_left(rest, b.c, found, d, i, 0) / b.c[0];
    }
    const double least = mwc_sheet_least(&b);
    const mwc_sheet left = mwc_sheet_sub(a, mwc_sheet_mul(q, b));
    q.radius = least > 0.0 ? mwc_sheet_most(&left) / least * MWC_SHEET_SUMMED : HUGE_VAL;
    return q;
}

static mwc_sheet mwc_sheet_sqrt(mwc_sheet a)
{
    mwc_sheet s;
    if (a.c[0] == 0.0 && mwc_sheet_part(&a, 1) == 0.0 && a.radius == 0.0) return a;
    memset(&s, 0, sizeof s);
    s.across = a.across ? MWC_DEGREE : 0;
    s.along = a.along ? MWC_DEGREE : 0;
    s.c[0] = sqrt(a.c[0]);
    for (int n = 0; n <= s.along; n++) {
        double rest[15] = { 0.0 }, *const found = s.c + MWC_BLOCK[n];
        mwc_sheet_rest(rest, &a, &s, &s, n, 1);
        for (int k = 0; n && k < 15; k++) rest[k] *= 0.5; /* what is left is twice block n by block 0 */
        for (int d = 0; d <= s.across && d <= MWC_DEGREE - n; d++)
            for (int i = 0; i <= d; i++) {
                if (n == 0 && d == 0) continue;
                const double left = mwc_sheet_left(rest, s.c, found, d, i, n ? 0 : 1);
                found[d * (d + 1) / 2 + i] = left / (n ? s.c[0] : 2.0 * s.c[0]);
            }
    }
    s.radius = 0.0;
    const double least = mwc_sheet_least(&s);
    const mwc_sheet left = mwc_sheet_sub(a, mwc_sheet_sqr(s));
    const int defined = a.c[0] > 0.0 && mwc_sheet_least(&a) > 0.0 && least > 0.0;
    s.radius = defined ? mwc_sheet_most(&left) / least * MWC_SHEET_SUMMED : HUGE_VAL;
    return s;
}

/* As mwc_poly_sincos: with d = a without its constant term, sin d = d - d^3/6 + ... and cos d = 1 - d^2/2 + d^4/24 - ..., the
 * first term left out being the largest. */
static void mwc_sheet_sincos(mwc_sheet a, mwc_sheet *sine, mwc_sheet *cosine)
{
    const double range = mwc_sheet_part(&a, 1), radius = a.radius, square = range * range;
    mw_ball s, c;
    mwc_sincos(mwc_make(a.c[0], 0.0), &s, &c);
    if (range == 0.0) {
        *sine = mwc_sheet_of_ball(s);
        *cosine = mwc_sheet_of_ball(c);
        sine->radius += radius;
        cosine->radius += radius;
        return;
    }
    a.c[0] = 0.0;
    a.radius = 0.0;
    const double fifth = range < MWC_SHEET_BENDING ? square * square * range / 120.0 * (1.0 + 1e-9) : HUGE_VAL;
    const mwc_sheet two = mwc_sheet_sqr(a), three = mwc_sheet_mul(two, a), four = mwc_sheet_sqr(two);
    mwc_sheet bent = mwc_sheet_sub(a, mwc_sheet_times(three, mwc_div(mwc_make(1.0, 0.0), mwc_make(6.0, 0.0))));
    mwc_sheet straight = mwc_sheet_times(four, mwc_div(mwc_make(1.0, 0.0), mwc_make(24.0, 0.0)));
    straight = mwc_sheet_sub(straight, mwc_sheet_times(two, mwc_make(0.5, 0.0)));
    straight = mwc_sheet_add(mwc_sheet_of_ball(mwc_make(1.0, 0.0)), straight);
    bent.radius += fifth;
    straight.radius += fifth * range / 6.0 * (1.0 + 1e-9);
    *sine = mwc_sheet_add(mwc_sheet_times(straight, s), mwc_sheet_times(bent, c));
    *cosine = mwc_sheet_sub(mwc_sheet_times(straight, c), mwc_sheet_times(bent, s));
    sine->radius = (sine->radius + radius) * MWC_SHEET_SUMMED;
    cosine->radius = (cosine->radius + radius) * MWC_SHEET_SUMMED;
}

/* As mwc_poly_atan2. The arc's series d - d^3/3 + ... alternates: its tail is below the first term left out. */
static mwc_sheet mwc_sheet_atan2(mwc_sheet y, mwc_sheet x)
{
    const double t = mwi_angle(y.c[0], x.c[0]);
    const int uncut = (x.c[0] > 0.0 && mwc_sheet_least(&x) > 0.0) || mwc_sheet_least(&y) > 0.0;
    const int right = mwc_abs(t) < 3.15 && (x.c[0] > 0.0 || (t < 0.0) == (y.c[0] < 0.0));
    mw_ball s, c;
    mwc_sincos(mwc_make(t, 0.0), &s, &c);
    const mwc_sheet along = mwc_sheet_add(mwc_sheet_times(x, c), mwc_sheet_times(y, s));
    const mwc_sheet d = mwc_sheet_div(mwc_sheet_sub(mwc_sheet_times(y, c), mwc_sheet_times(x, s)), along);
    const double most = mwc_sheet_most(&d);
    const int near = most < 0.5 && along.c[0] > 0.0 && mwc_sheet_least(&along) > 0.0;
    const mwc_sheet three = mwc_sheet_mul(mwc_sheet_sqr(d), d);
    mwc_sheet sum = mwc_sheet_sub(d, mwc_sheet_times(three, mwc_div(mwc_make(1.0, 0.0), mwc_make(3.0, 0.0))));
    sum = mwc_sheet_add(mwc_sheet_of_ball(mwc_make(t, 0.0)), sum);
    sum.radius += most * most * most * most * most * 0.2 * (1.0 + 1e-9);
    return uncut && right && near ? sum : mwc_sheet_undefined(sum);
}

/* From 0 to the largest size, where the sign is not known everywhere. */
static inline mwc_sheet mwc_sheet_magnitude(mwc_sheet a)
{
    if (mwc_sheet_least(&a) > 0.0) return a.c[0] < 0.0 ? mwc_sheet_neg(a) : a;
    const double half = 0.5 * mwc_sheet_most(&a);
    const mwc_sheet size = mwc_sheet_of_ball(mwc_make(half, half * (1.0 + 8.0 * MWC_U)));
    return half < HUGE_VAL ? size : mwc_sheet_undefined(size);
}

/* -1 below 0, else 1, and anything between where both occur: a function that is continuous there is enclosed all the same. */
static inline mwc_sheet mwc_sheet_sign(mwc_sheet a)
{
    const int zero = a.c[0] == 0.0 && mwc_sheet_part(&a, 1) == 0.0 && a.radius == 0.0;
    const int known = zero || mwc_sheet_least(&a) > 0.0;
    return mwc_sheet_of_ball(known ? mwc_make(a.c[0] < 0.0 ? -1.0 : 1.0, 0.0) : mwc_make(0.0, 1.0));
}

#endif
