/* What is true of polynomials of sheet.h everywhere in [-1, 1]^3: bounds, and halves of it.  SPDX-License-Identifier: MIT-0 */
#ifndef MWC_CUBE_H
#define MWC_CUBE_H

#include "sheet.h"

typedef struct mwc_range { double low, high; } mwc_range;

/* Place of the coefficient of s^i t^j u^k. */
static inline int mwc_cube_at(int i, int j, int k)
{
    return MWC_BLOCK[k] + (i + j) * (i + j + 1) / 2 + j;
}

static inline mwc_range mwc_cube_range(const mwc_sheet *a)
{
    const double side = (mwc_sheet_part(a, 1) + a->radius) * MWC_SHEET_SUMMED, low = a->c[0] - side, high = a->c[0] + side;
    mwc_range r = { -HUGE_VAL, HUGE_VAL };
    if (side < HUGE_VAL) {
        r.low = low - 2.0 * MWC_U * mwc_abs(low);
        r.high = high + 2.0 * MWC_U * mwc_abs(high);
    }
    return r;
}

/* The polynomial over half of the cube, end = -1 or 1 of variable 0, 1 or 2, in variables of that half: v = (v' + end)/2. Of
 * the sums in four stages each rounds what is at most the sum of all sizes. */
static inline void mwc_cube_half(mwc_sheet *a, int variable, double end)
{
    const int most = variable == 2 ? a->along : a->across;
    const double size = mwc_sheet_part(a, 0);
    if (!most) return;
    for (int m = 0; m <= MWC_DEGREE; m++)
        for (int n = 0; n + m <= MWC_DEGREE; n++) {
            const int last = mwc_sheet_less(MWC_DEGREE - m - n, most);
            double f[MWC_DEGREE + 1], share = 1.0, *at[MWC_DEGREE + 1];
            if ((variable == 2 ? m + n > a->across : n > a->along || m > a->across)) continue;
            for (int k = 0; k <= last; k++, share *= 0.5) {
                at[k] = a->c + (variable == 0 ? mwc_cube_at(k, m, n) : variable == 1 ? mwc_cube_at(m, k, n) : mwc_cube_at(m, n, k));
                f[k] = *at[k] * share;
            }
            for (int stage = 0; stage < last; stage++)
                for (int k = last - 1; k >= stage; k--) f[k] += end * f[k + 1];
            for (int k = 0; k <= last; k++) *at[k] = f[k];
        }
    a->radius = (a->radius + (8.0 * MWC_U * size + 100.0 * MWC_TINY)) * MWC_SHEET_SUMMED;
}

/* Second derivatives by s, t and both: middles and how far they are off anywhere in the cube. */
typedef struct mwc_bend { double middle[3], off[3]; } mwc_bend;

static inline mwc_bend mwc_cube_bend(const mwc_sheet *a)
{
    mwc_bend b = { { 2.0 * a->c[3], 2.0 * a->c[5], a->c[4] }, { 0.0, 0.0, 0.0 } };
    for (int k = 0; k <= a->along; k++)
        for (int d = k ? 2 : 3; d <= mwc_sheet_less(a->across, MWC_DEGREE - k); d++)
            for (int j = 0; j <= d; j++) {
                const int i = d - j;
                const double size = mwc_abs(a->c[mwc_cube_at(i, j, k)]);
                b.off[0] += (double)(i * (i - 1)) * size;
                b.off[1] += (double)(j * (j - 1)) * size;
                b.off[2] += (double)(i * j) * size;
            }
    return b;
}

/* Whether the polynomial, without its radius, is convex in s and t at every u. */
static inline int mwc_cube_convex(const mwc_bend *b)
{
    const double rounding = 64.0 * MWC_U, along = b->middle[0] * (1.0 - rounding) - b->off[0] * (1.0 + rounding);
    const double across = b->middle[1] * (1.0 - rounding) - b->off[1] * (1.0 + rounding);
    const double both = (mwc_abs(b->middle[2]) + b->off[2]) * (1.0 + rounding);
    return along > 0.0 && across > 0.0 && along * across * (1.0 - rounding) > both * both;
}

/* A place of the square for each u, z[v][0] + z[v][1] u, near where the polynomial's quadratic part is least. */
static inline void mwc_cube_lowest(const mwc_sheet *a, double (*z)[2])
{
    const double *c = a->c, det = 4.0 * c[3] * c[5] - c[4] * c[4];
    const double by_u[2] = { a->along ? c[mwc_cube_at(1, 0, 1)] : 0.0, a->along ? c[mwc_cube_at(0, 1, 1)] : 0.0 };
    z[0][0] = (c[4] * c[2] - 2.0 * c[5] * c[1]) / det;
    z[1][0] = (c[4] * c[1] - 2.0 * c[3] * c[2]) / det;
    z[0][1] = (c[4] * by_u[1] - 2.0 * c[5] * by_u[0]) / det;
    z[1][1] = (c[4] * by_u[0] - 2.0 * c[3] * by_u[1]) / det;
    if (mwc_abs(z[0][0]) + mwc_abs(z[0][1]) <= 1.0 && mwc_abs(z[1][0]) + mwc_abs(z[1][1]) <= 1.0) return;
    double least = HUGE_VAL; /* the lowest place of each side, at u = 0 */
    for (int side = 0; side < 4; side++) {
        const double on = side & 1 ? 1.0 : -1.0;
        const double s = side < 2 ? on : fmin(1.0, fmax(-1.0, -(c[1] + c[4] * on) / (2.0 * c[3])));
        const double t = side < 2 ? fmin(1.0, fmax(-1.0, -(c[2] + c[4] * on) / (2.0 * c[5]))) : on;
        const double value = s * (c[1] + c[3] * s + c[4] * t) + t * (c[2] + c[5] * t);
        if (value < least || !(mwc_abs(z[0][0]) <= 1.0)) least = value, z[0][0] = s, z[1][0] = t;
    }
    if (!(mwc_abs(z[0][0]) <= 1.0)) z[0][0] = 0.0;
    if (!(mwc_abs(z[1][0]) <= 1.0)) z[1][0] = 0.0;
    z[0][1] = z[1][1] = 0.0;
}

/* Lower bound. Where it is convex in s and t, from value and slope at any place z(u) of the square, best its lowest:
 * a(x, u) >= a(z, u) + slope (x - z). On the line z(u) value and slopes are polynomials of u; powers of z are at most 1 in the
 * sum of their sizes, so that some hundred roundings come to a share of the sum of all sizes at most. */
static inline double mwc_cube_low(const mwc_sheet *a)
{
    const double plain = mwc_cube_range(a).low;
    if (a->across < 2) return plain;
    const mwc_bend bend = mwc_cube_bend(a);
    if (!mwc_cube_convex(&bend)) return plain;
    double z[2][2], power[2][MWC_DEGREE + 1][MWC_DEGREE + 1], on[3][MWC_DEGREE + 1] = { { 0.0 } };
    mwc_cube_lowest(a, z);
    memset(power, 0, sizeof power);
    for (int v = 0; v < 2; v++) {
        power[v][0][0] = 1.0;
        for (int n = 1; n <= MWC_DEGREE; n++)
            for (int k = 0; k <= n; k++) power[v][n][k] = z[v][0] * power[v][n - 1][k] + (k ? z[v][1] * power[v][n - 1][k - 1] : 0.0);
    }
    for (int k = 0; k <= a->along; k++)
        for (int d = 0; d <= mwc_sheet_less(a->across, MWC_DEGREE - k); d++)
            for (int j = 0; j <= d; j++)
                for (int by = 0; by < 3; by++) { /* value, slope by s, slope by t */
                    const int i = d - j, m = by == 1 ? i - 1 : i, n = by == 2 ? j - 1 : j;
                    const double c = a->c[mwc_cube_at(i, j, k)] * (by == 0 ? 1.0 : by == 1 ? (double)i : (double)j);
                    if (m < 0 || n < 0) continue;
                    for (int p = 0; p <= m && (p == 0 || a->along); p++)
                        for (int q = 0; q <= n && (q == 0 || a->along); q++) on[by][p + q + k] += c * power[0][m][p] * power[1][n][q];
                }
    double spread[3] = { 0.0, 0.0, 0.0 }, low, fall = a->radius;
    for (int by = 0; by < 3; by++)
        for (int k = 1; k <= MWC_DEGREE; k++) spread[by] += mwc_abs(on[by][k]);
    for (int v = 0; v < 2; v++) {
        const double up = fmax(on[1 + v][0] + spread[1 + v], 0.0), down = fmax(spread[1 + v] - on[1 + v][0], 0.0);
        fall += up * (1.0 + z[v][0] + mwc_abs(z[v][1])) + down * (1.0 - z[v][0] + mwc_abs(z[v][1]));
    }
    fall += 4096.0 * MWC_U * mwc_sheet_part(a, 0) + spread[0];
    low = on[0][0] - fall * (1.0 + 32.0 * MWC_U);
    low -= 2.0 * MWC_U * mwc_abs(low);
    return low > plain ? low : plain;
}

#endif
