/* Small dense linear algebra with complete pivoting.  SPDX-License-Identifier: MIT-0 */
#ifndef MWI_LINEAR_H
#define MWI_LINEAR_H

#include "basics.h"

static inline void mwi_swap(double *a, double *b)
{
    const double t = *a;
    *a = *b;
    *b = t;
}

static inline void mwi_equilibrate(int n, double *A, double *b, const double *scale)
{
    for (int i = 0; i < n; i++) {
        double largest = 0.0;
        for (int j = 0; j < n; j++) {
            A[i * n + j] *= scale[j];
            if (mwi_abs(A[i * n + j]) > largest) largest = mwi_abs(A[i * n + j]);
        }
        if (largest > 0.0) {
            for (int j = 0; j < n; j++) A[i * n + j] /= largest;
            b[i] /= largest;
        }
    }
}

/* Solve A x = b (n <= MW_MAX_UNKNOWNS, A row-major, both overwritten) after scaling columns by scale[n] and rows by
 * their largest entry. Directions whose pivot falls below tolerance times the largest are left out (their x is 0).
 * Returns the rank; *gap = last pivot over first. */
static inline int mwi_linear_solve(int n, double *A, double *b, const double *scale, double tolerance, double *x,
                                   double *gap)
{
    int column[MW_MAX_UNKNOWNS];
    int rank = 0;
    double first = 0.0, last = 0.0;
    mwi_equilibrate(n, A, b, scale);
    for (int j = 0; j < n; j++) column[j] = j;
    for (int k = 0; k < n; k++) {
        int row = k, col = k;
        for (int i = k; i < n; i++)
            for (int j = k; j < n; j++)
                if (mwi_abs(A[i * n + j]) > mwi_abs(A[row * n + col])) row = i, col = j;
        last = mwi_abs(A[row * n + col]);
        if (k == 0) first = last;
        if (!(last > tolerance * first)) break;
        for (int j = 0; j < n; j++) mwi_swap(&A[k * n + j], &A[row * n + j]);
        mwi_swap(&b[k], &b[row]);
        for (int i = 0; i < n; i++) mwi_swap(&A[i * n + k], &A[i * n + col]);
        const int t = column[k];
        column[k] = column[col];
        column[col] = t;
        for (int i = k + 1; i < n; i++) {
            const double factor = A[i * n + k] / A[k * n + k];
            for (int j = k; j < n; j++) A[i * n + j] -= factor * A[k * n + j];
            b[i] -= factor * b[k];
        }
        rank = k + 1;
    }
    for (int j = 0; j < n; j++) x[j] = 0.0;
    for (int k = rank - 1; k >= 0; k--) {
        double sum = b[k];
        for (int j = k + 1; j < rank; j++) sum -= A[k * n + j] * x[column[j]];
        x[column[k]] = sum / A[k * n + k];
    }
    for (int j = 0; j < n; j++) x[j] *= scale[j];
    *gap = first > 0.0 ? last / first : 0.0;
    return rank;
}

#endif
