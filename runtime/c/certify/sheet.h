/* Functions of three variables s, t, u, each in [-1, 1], as polynomials with an error bound. SPDX-License-Identifier: MIT-0
 *
 * As polynomial.h, of degree 4 in all together: block k of the coefficients, from MWC_BLOCK[k] on, belongs to u^k, in it
 * c[d (d + 1)/2 + j] to s^(d - j) t^j. across: the highest degree in s and t that occurs; along: the highest power of u; what
 * is beyond these is zero, and products leave it out. What a product has beyond the fourth degree joins the radius. A sum of n
 * rounded products is off by n MWC_U at most of what the sizes of its terms sum up to (Higham, "Accuracy and Stability of
 * Numerical Algorithms", 2nd ed., 3.1); no coefficient has more than 13. Series have no
 * more terms than the degree lets be seen. */
#ifndef MWC_SHEET_H
#define MWC_SHEET_H

#include <string.h>
#include "ball.h"

enum { MWC_DEGREE = 4, MWC_COEFFICIENTS = 35, MWC_SHEET_TERMS = 3 };

typedef struct mwc_sheet {
    double c[MWC_COEFFICIENTS];
    double radius;
    int across, along;
} mwc_sheet;

/* Where a block begins and the last ends. */
static const unsigned char MWC_BLOCK[] = { 0, 15, 25, 31, 34, 35 };

/* Makes good what up to 2^10 roundings of one operation's radius lose. Most roundings of a coefficient. */
static const double MWC_SHEET_SUMMED = 1.0000000000002274, MWC_ROUNDINGS = 17.0;

/* Beyond this range sine and cosine are not expanded; a tail of a series that is small enough. */
static const double MWC_SHEET_BENDING = 4.0, MWC_SHEET_TAIL = 1e-20;

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

/* Coefficients up to the last that occurs. */
static inline int mwc_sheet_count(const mwc_sheet *a)
{
    return a->along ? MWC_BLOCK[a->along + 1] : (a->across + 1) * (a->across + 2) / 2;
}

/* Largest size of the terms, with or without the constant one, and of all with the radius. */
static inline double mwc_sheet_part(const mwc_sheet *a, int from)
{
    double sum = 0.0;
    for (int k = from, count = mwc_sheet_count(a); k < count; k++) sum += mwc_abs(a->c[k]);
    return sum * MWC_SHEET_SUMMED;
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

/* a + b or, with sign -1, a - b */
static inline mwc_sheet mwc_sheet_sum(mwc_sheet a, const mwc_sheet *b, double sign)
{
    double rounded = 0.0;
    if (b->across > a.across) a.across = b->across;
    if (b->along > a.along) a.along = b->along;
    for (int k = 0, count = mwc_sheet_count(&a); k < count; k++) {
        a.c[k] += sign * b->c[k];
        rounded += mwc_abs(a.c[k]);
    }
    a.radius = ((a.radius + b->radius) + MWC_U * rounded) * MWC_SHEET_SUMMED;
    return a;
}

static inline mwc_sheet mwc_sheet_add(mwc_sheet a, mwc_sheet b)
{
    return mwc_sheet_sum(a, &b, 1.0);
}

static inline mwc_sheet mwc_sheet_sub(mwc_sheet a, mwc_sheet b)
{
    return mwc_sheet_sum(a, &b, -1.0);
}

static inline mwc_sheet mwc_sheet_neg(mwc_sheet a)
{
    for (int k = 0, count = mwc_sheet_count(&a); k < count; k++) a.c[k] = -a.c[k];
    return a;
}

/* a times a number */
static inline mwc_sheet mwc_sheet_times(mwc_sheet a, mw_ball b)
{
    const double most = mwc_abs(b.mid) + mwc_reach(b);
    double rounded = 0.0, size = 0.0;
    for (int k = 0, count = mwc_sheet_count(&a); k < count; k++) {
        size += mwc_abs(a.c[k]);
        a.c[k] *= b.mid;
        rounded += mwc_abs(a.c[k]);
    }
    size *= MWC_SHEET_SUMMED;
    a.radius = ((size * mwc_reach(b) + a.radius * most) + (MWC_U * rounded + 100.0 * MWC_TINY)) * MWC_SHEET_SUMMED;
    return a;
}

/* Sums of the sizes of the terms of each degree in all variables. */
static inline void mwc_sheet_degrees(const mwc_sheet *a, double *sums)
{
    for (int d = 0; d <= MWC_DEGREE; d++) sums[d] = 0.0;
    for (int n = 0; n <= a->along; n++)
        for (int d = 0, k = MWC_BLOCK[n]; d <= MWC_DEGREE - n && d <= a->across; d++)
            for (int j = 0; j <= d; j++, k++) sums[n + d] += mwc_abs(a->c[k]);
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

/* Add the products of degree d of one block with those of another of degrees up to `last`, in s and t. */
static inline void mwc_sheet_row(double *p, const double *a, const double *b, int d, int last)
{
    for (int i = 0; i <= d; i++) {
        const double factor = a[d * (d + 1) / 2 + i];
        for (int e = 0; e <= last; e++)
            for (int j = 0; j <= e; j++) p[(d + e) * (d + e + 1) / 2 + i + j] += factor * b[e * (e + 1) / 2 + j];
    }
}

/* Add the product of two blocks, up to `most` in s and t. Written out, for the compiler, by what is left of the degree. */
static inline void mwc_sheet_blocks(double *p, const double *a, const double *b, int across, int other, int most)
{
    for (int d = 0; d <= across && d <= most; d++) {
        const int left = most - d < other ? most - d : other;
        switch (8 * d + left) {
        case 0: mwc_sheet_row(p, a, b, 0, 0); break;
        case 1: mwc_sheet_row(p, a, b, 0, 1); break;
        case 2: mwc_sheet_row(p, a, b, 0, 2); break;
        case 3: mwc_sheet_row(p, a, b, 0, 3); break;
        case 4: mwc_sheet_row(p, a, b, 0, 4); break;
        case 8: mwc_sheet_row(p, a, b, 1, 0); break;
        case 9: mwc_sheet_row(p, a, b, 1, 1); break;
        case 10: mwc_sheet_row(p, a, b, 1, 2); break;
        case 11: mwc_sheet_row(p, a, b, 1, 3); break;
        case 16: mwc_sheet_row(p, a, b, 2, 0); break;
        case 17: mwc_sheet_row(p, a, b, 2, 1); break;
        case 18: mwc_sheet_row(p, a, b, 2, 2); break;
        case 24: mwc_sheet_row(p, a, b, 3, 0); break;
        case 25: mwc_sheet_row(p, a, b, 3, 1); break;
        default: mwc_sheet_row(p, a, b, 4, 0); break;
        }
    }
}

static inline int mwc_sheet_less(int a, int b)
{
    return a < b ? a : b;
}

static void mwc_sheet_product(mwc_sheet *p, const mwc_sheet *a, const mwc_sheet *b)
{
    double sums[MWC_DEGREE + 1], others[MWC_DEGREE + 1], size, other;
    p->across = mwc_sheet_less(a->across + b->across, MWC_DEGREE);
    p->along = mwc_sheet_less(a->along + b->along, MWC_DEGREE);
    for (int k = 0; k < MWC_COEFFICIENTS; k++) p->c[k] = 0.0;
    for (int n = 0; n <= a->along; n++)
        for (int k = 0; k <= b->along && n + k <= MWC_DEGREE; k++)
            mwc_sheet_blocks(p->c + MWC_BLOCK[n + k], a->c + MWC_BLOCK[n], b->c + MWC_BLOCK[k], a->across, b->across, MWC_DEGREE - n - k);
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
        mwc_sheet_blocks(known, f->c + MWC_BLOCK[k], g->c + MWC_BLOCK[n - k], MWC_DEGREE, MWC_DEGREE, MWC_DEGREE - n);
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

/* Divided by a whole number. */
static inline mwc_sheet mwc_sheet_over(mwc_sheet a, double n)
{
    return mwc_sheet_times(a, mwc_div(mwc_make(1.0, 0.0), mwc_make(n, 0.0)));
}

/* 1 - z/(n(n+1)) (1 - z/((n+2)(n+3)) (...)), of so many terms, and its tail */
static inline mwc_sheet mwc_sheet_series(mwc_sheet z, int n, int terms, double tail)
{
    const mwc_sheet one = mwc_sheet_of_ball(mwc_make(1.0, 0.0));
    mwc_sheet sum = one;
    for (int k = n + 2 * (terms - 1); k >= n; k -= 2)
        sum = mwc_sheet_sub(one, mwc_sheet_over(mwc_sheet_mul(z, sum), (double)(k * (k + 1))));
    sum.radius += tail;
    return sum;
}

/* As mwc_poly_sincos. The first term left out is the largest: range^(2 terms + 2)/(2 terms + 2)! and less. */
static void mwc_sheet_sincos(mwc_sheet a, mwc_sheet *sine, mwc_sheet *cosine)
{
    const double range = mwc_sheet_part(&a, 1), radius = a.radius;
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
    int terms = 2;
    double tail = range < MWC_SHEET_BENDING ? range * range * range * range * range * range / 720.0 : HUGE_VAL;
    for (; tail > MWC_SHEET_TAIL && terms < MWC_SHEET_TERMS; terms++)
        tail *= range * range / (double)((2 * terms + 3) * (2 * terms + 4));
    tail *= 1.0 + 1e-9;
    const mwc_sheet z = mwc_sheet_sqr(a), straight = mwc_sheet_series(z, 1, terms, tail);
    const mwc_sheet bent = mwc_sheet_mul(a, mwc_sheet_series(z, 2, terms, tail));
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
    const mwc_sheet z = mwc_sheet_sqr(d);
    const double most = mwc_sheet_most(&d);
    const int near = most < 0.5 && along.c[0] > 0.0 && mwc_sheet_least(&along) > 0.0;
    int terms = 2;
    double tail = near ? most * most * most * most * most : HUGE_VAL;
    for (; tail > MWC_SHEET_TAIL && terms < MWC_SHEET_TERMS; terms++) tail *= most * most;
    mwc_sheet sum = mwc_sheet_of_ball(mwc_make(0.0, 0.0));
    for (int k = terms - 1; k >= 0; k--)
        sum = mwc_sheet_sub(mwc_sheet_of_ball(mwc_div(mwc_make(1.0, 0.0), mwc_make((double)(2 * k + 1), 0.0))), mwc_sheet_mul(z, sum));
    sum = mwc_sheet_add(mwc_sheet_of_ball(mwc_make(t, 0.0)), mwc_sheet_mul(d, sum));
    sum.radius += tail * (1.0 + 1e-9);
    return uncut && right && near ? sum : mwc_sheet_undefined(sum);
}

/* -1 below 0, else 1, and anything between where both occur: a function that is continuous there is enclosed all the same. */
static inline mwc_sheet mwc_sheet_sign(mwc_sheet a)
{
    const int zero = a.c[0] == 0.0 && mwc_sheet_part(&a, 1) == 0.0 && a.radius == 0.0;
    const int known = zero || mwc_sheet_least(&a) > 0.0;
    return mwc_sheet_of_ball(known ? mwc_make(a.c[0] < 0.0 ? -1.0 : 1.0, 0.0) : mwc_make(0.0, 1.0));
}

#endif
