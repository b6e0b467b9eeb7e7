/* Krawczyk's test on one system of equations.  SPDX-License-Identifier: MIT-0
 *
 * About a point x, with any matrix C near the inverse of the Jacobian J, half-widths d > 0 and the box X = x + [-d, d]:
 *     z = C R(x),  M = |I - C J(X)|,  K = |z| + M d.
 * K < d in every component: exactly one zero of R in X, within e = K of x, and then within |z| + M e (Krawczyk, "Newton-
 * Algorithmen zur Bestimmung von Nullstellen mit Fehlerschranken", Computing 4 (1969); Neumaier, "Interval Methods for
 * Systems of Equations" (1990), 5.1). |z| > K + d - |z| in a component: none in X. */
#ifndef MWC_KRAWCZYK_H
#define MWC_KRAWCZYK_H

#include "../mw_model.h"
#include "../mw_status.h"
#include "wide.h"

/* Most unknowns of a system. */
#ifndef MWC_LARGEST
#define MWC_LARGEST MW_MAX_UNKNOWNS
#endif

/* C = inverse of the n x n midpoints of J, row by row; 0 where they are singular in double. J is not changed. */
static inline int mwc_inverse(int n, const mw_ball *J, double *C)
{
    double a[MWC_LARGEST * MWC_LARGEST];
    for (int i = 0; i < n * n; i++) a[i] = J[i].mid, C[i] = i % (n + 1) == 0 ? 1.0 : 0.0;
    for (int k = 0; k < n; k++) {
        int pivot = k;
        for (int i = k + 1; i < n; i++)
            if (mwc_abs(a[i * n + k]) > mwc_abs(a[pivot * n + k])) pivot = i;
        if (!(mwc_abs(a[pivot * n + k]) > 0.0)) return 0;
        for (int j = 0; j < n; j++) {
            const double t = a[k * n + j], s = C[k * n + j];
            a[k * n + j] = a[pivot * n + j], a[pivot * n + j] = t;
            C[k * n + j] = C[pivot * n + j], C[pivot * n + j] = s;
        }
        const double by = 1.0 / a[k * n + k];
        for (int j = 0; j < n; j++) a[k * n + j] *= by, C[k * n + j] *= by;
        for (int i = 0; i < n; i++) {
            const double f = a[i * n + k];
            if (i == k || f == 0.0) continue;
            for (int j = 0; j < n; j++) a[i * n + j] -= f * a[k * n + j], C[i * n + j] -= f * C[k * n + j];
        }
    }
    return 1;
}

/* M = |I - C J|, upper bounds, n x n. */
static inline void mwc_defect(int n, const double *C, const mw_ball *J, double *M)
{
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            mw_ball sum = mwc_make(i == j ? 1.0 : 0.0, 0.0);
            for (int k = 0; k < n; k++) sum = mwc_sub(sum, mwc_mul(mwc_make(C[i * n + k], 0.0), J[k * n + j]));
            M[i * n + j] = (mwc_abs(sum.mid) + sum.radius) * MWC_READ;
        }
}

/* |C R| as balls, n. */
static inline void mwc_shift(int n, const double *C, const mw_ball *R, mw_ball *z)
{
    for (int i = 0; i < n; i++) {
        z[i] = mwc_make(0.0, 0.0);
        for (int k = 0; k < n; k++) z[i] = mwc_add(z[i], mwc_mul(mwc_make(C[i * n + k], 0.0), R[k]));
    }
}

/* |z| + M d, upper bounds, n. */
static inline void mwc_image(int n, const mw_ball *z, const double *M, const double *d, double *K)
{
    for (int i = 0; i < n; i++) {
        double sum = mwc_abs(z[i].mid) + z[i].radius;
        for (int j = 0; j < n; j++) sum += M[i * n + j] * d[j];
        K[i] = sum * MWC_READ;
    }
}

/* Whether the image lies in the interior: false where a bound is not a number. */
static inline int mwc_inside(int n, const double *K, const double *d)
{
    int inside = 1;
    for (int i = 0; i < n; i++) inside = inside && K[i] < d[i];
    return inside;
}

/* Whether the image misses the box in a component: then there is no zero in it. */
static inline int mwc_misses(int n, const mw_ball *z, const double *M, const double *d)
{
    for (int i = 0; i < n; i++) {
        double sum = z[i].radius + d[i];
        for (int j = 0; j < n; j++) sum += M[i * n + j] * d[j];
        if (mwc_abs(z[i].mid) > sum * MWC_READ) return 1;
    }
    return 0;
}

#endif
