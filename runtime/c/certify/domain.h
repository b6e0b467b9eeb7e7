/* What is known beforehand of the equations at many points.  SPDX-License-Identifier: MIT-0
 *
 * Bounds for every point of a domain: the middle of a number, as doubles compute it at any of them, is not above `most`, and
 * its true value, anywhere in a box about that point, within `radius` of the middle. Every bound of ball.h grows with sizes
 * and radii and falls with what a divisor or a radicand is at least, so that these take their places. Sizes are sums and
 * products of sizes, far too large where terms cancel; so what is divided, and what a quotient is a factor of, is looked at
 * at each point, as divisors and radicands are. The Jacobian's radii are then known once for all points. */
#ifndef MWC_DOMAIN_H
#define MWC_DOMAIN_H

#include "lane.h"
#include "tables.h"

/* Most numbers of a function that are looked at. */
enum { MWC_GUARDS = 128 };

typedef struct mwc_bound {
    double most, radius;
} mwc_bound;

MWI_INLINE mwc_bound mwc_bound_of(double most, double radius)
{
    mwc_bound b;
    b.most = most * MWC_READ;
    b.radius = radius;
    return b;
}

/* A bound where the operation is defined in all of the domain. */
MWI_INLINE mwc_bound mwc_bound_where(int defined, double most, double radius)
{
    return mwc_bound_of(most, defined ? radius : HUGE_VAL);
}

MWI_INLINE double mwc_bound_reach(mwc_bound a)
{
    return MWC_READ * a.radius;
}

MWI_INLINE mwc_bound mwc_bound_sum(mwc_bound a, mwc_bound b)
{
    const double most = a.most + b.most;
    return mwc_bound_of(most, a.radius + b.radius + MWC_U * most);
}

MWI_INLINE mwc_bound mwc_bound_product(mwc_bound a, mwc_bound b)
{
    const double most = a.most * b.most + MWC_TINY;
    return mwc_bound_of(most, a.most * b.radius + a.radius * (b.most + mwc_bound_reach(b)) + (MWC_U * most + MWC_TINY));
}

MWI_INLINE mwc_bound mwc_bound_quotient(mwc_bound a, mwc_bound b, double least)
{
    const double rest = least - mwc_bound_reach(b), most = a.most / least + MWC_TINY;
    const double spread = (most * b.radius + a.radius) / (rest * (1.0 - 8.0 * MWC_U));
    return mwc_bound_where(rest > 0.0, most, spread + (MWC_U * most + MWC_TINY));
}

MWI_INLINE mwc_bound mwc_bound_root(mwc_bound a, double least)
{
    const double most = sqrt(a.most);
    return mwc_bound_where(least - mwc_bound_reach(a) > 0.0, most, a.radius * (1.0 + 8.0 * MWC_U) / sqrt(least) + MWC_U * most);
}

/* |sin m| <= |m|, and |cos(m + d) - cos m| <= (|m| + |d|) |d| */
MWI_INLINE mwc_bound mwc_bound_sine(mwc_bound a)
{
    const double size = a.most < 0.78 ? a.most : 1.0; /* what the kernel's error is a share of: see MWC_SINE */
    return mwc_bound_where(a.most < MWC_FAR, size * (1.0 + MWC_SINE) + MWC_TINY, a.radius + (MWC_SINE * size + MWC_TINY));
}

MWI_INLINE mwc_bound mwc_bound_cosine(mwc_bound a)
{
    const double slope = a.most + mwc_bound_reach(a);
    return mwc_bound_where(a.most < MWC_FAR, 1.0 + MWC_SINE, a.radius * (slope < 1.0 ? slope : 1.0) + (MWC_SINE + MWC_TINY));
}

/* The same, of a size that is known to be at most so much. */
MWI_INLINE mwc_bound mwc_bound_within(mwc_bound a, double most)
{
    if (most < a.most) a.most = most;
    return a;
}

/* The error of mwc_atan2's middle at a point: that of a sine and a cosine, of two products and their difference. */
MWI_INLINE mwc_bound mwc_bound_angle(mwc_bound y, mwc_bound x, double least)
{
    const double off = mwc_bound_reach(y) + mwc_bound_reach(x), rest = least - off;
    return mwc_bound_where(rest > 0.0, 3.15, off / (rest * (1.0 - 8.0 * MWC_U)) + 32.0 * MWC_U);
}

MWI_INLINE mwc_bound mwc_bound_sign(mwc_bound a, double least)
{
    return mwc_bound_where(least - mwc_bound_reach(a) > 0.0, 1.0, 0.0);
}

/* How many numbers of an operation are looked at; quotient: whether a factor is one. */
MWI_INLINE int mwc_guarded(int operation, int quotient)
{
    switch (operation) {
    case MW_OP_DIV: return 2;
    case MW_OP_SQRT: case MW_OP_ATAN2: case MW_OP_SIGN: return 1;
    case MW_OP_MUL: return quotient;
    default: return 0;
    }
}

/* Bounds of a function's numbers. least: of what is looked at, in the order of the table, the smallest of all points: the
 * divisor and the size of what is divided, the latter negative; so the size of what a quotient is multiplied by; how far
 * arguments of other operations are from where these are not defined; NULL: nothing is known. Returns how many; registers
 * NULL: that alone. */
static inline int mwc_run_bounds(const mw_code *code, const mwc_bound *arguments, const double *least, mwc_bound *registers)
{
    const unsigned short *i = code->operation, *const end = i + 4 * code->instructions;
    unsigned char quotient[MWC_REGISTERS] = { 0 };
    int count = 0;
    for (int k = 0; registers && k < code->inputs; k++) registers[k] = arguments[code->input[k]];
    for (int k = 0; registers && k < code->constants; k++) {
        const mw_ball c = mwc_of_wide(code->constant[k]);
        registers[code->inputs + k] = mwc_bound_of(mwc_abs(c.mid), c.radius);
    }
    for (; i < end; i += 4) {
        const int of_quotient = quotient[i[2]] || quotient[i[3]], at = count;
        count += mwc_guarded(i[0], of_quotient);
        if (registers) {
            mwc_bound a = registers[i[2]], b = registers[i[3]], *const result = registers + i[1];
            const double low = least && count > at ? least[at] : 0.0;
            const double size = least && count > at + 1 ? -least[at + 1] : HUGE_VAL;
            switch (i[0]) {
            case MW_OP_ADD: case MW_OP_SUB: *result = mwc_bound_sum(a, b); break;
            case MW_OP_MUL:
                if (quotient[i[2]]) b = mwc_bound_within(b, least ? -low : HUGE_VAL);
                else if (of_quotient) a = mwc_bound_within(a, least ? -low : HUGE_VAL);
                *result = mwc_bound_product(a, b);
                break;
            case MW_OP_SQR: *result = mwc_bound_product(a, a); break;
            case MW_OP_DIV: *result = mwc_bound_quotient(mwc_bound_within(a, size), b, low); break;
            case MW_OP_SQRT: *result = mwc_bound_root(a, low); break;
            case MW_OP_SINCOS: *result = mwc_bound_sine(a), registers[i[3]] = mwc_bound_cosine(a); break;
            case MW_OP_ATAN2: *result = mwc_bound_angle(a, b, low); break;
            case MW_OP_SIGN: *result = mwc_bound_sign(a, low); break;
            default: *result = a; break; /* the negative and the magnitude */
            }
        }
        quotient[i[1]] = i[0] == MW_OP_DIV;
        if (i[0] == MW_OP_SINCOS) quotient[i[3]] = 0;
    }
    return count;
}

/* Of a system of n equations at the points of a domain: places of its rows, in an order in which they are eliminated; least as
 * above; half-widths d of its box, the unknown asked for last, and their reciprocals; of each row in its place, the
 * Jacobian's radii and its share of a sum's rounding, times d: over the box, and near its middle. */
typedef struct mwc_domain {
    int n, error, guards;
    int rows[MWC_MAX];
    double least[MWC_GUARDS], d[MWC_MAX], inverse[MWC_MAX], wide[MWC_MAX], near[MWC_MAX];
} mwc_domain;

/* What near is, in shares of d. */
static const double MWC_NEAR = 9.765625e-4;

/* A sum of n products and a term is within this of the sum of their sizes; an elimination, of the product of its factors'. */
#define MWC_SHARE(n) ((double)((n) + 4) * MWC_U)

/* Places of the rows of the n x n J that partial pivoting takes one after the other. */
static inline void mwc_order(int n, const double *J, int *rows)
{
    double a[MWC_MAX * MWC_MAX];
    int at[MWC_MAX];
    for (int i = 0; i < n * n; i++) a[i] = J[i];
    for (int i = 0; i < n; i++) at[i] = i;
    for (int k = 0; k < n; k++) {
        int pivot = k;
        for (int i = k + 1; i < n; i++)
            if (mwc_abs(a[at[i] * n + k]) > mwc_abs(a[at[pivot] * n + k])) pivot = i;
        const int row = at[pivot];
        at[pivot] = at[k], at[k] = row;
        for (int i = k + 1; i < n; i++) {
            const double f = a[at[i] * n + k] / a[row * n + k];
            for (int j = k + 1; j < n; j++) a[at[i] * n + j] -= f * a[row * n + j];
        }
    }
    for (int i = 0; i < n; i++) rows[at[i]] = i;
}

#endif
