/* Small dense linear algebra.  SPDX-License-Identifier: MIT-0 */
#if !defined(MWI_LINEAR_H) && !defined(MW_DEVICE_ONLY)
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

/* Solve A x = b (A[w*w] row-major, both overwritten, x in b) with partial pivoting of rows scaled to unit size; returns the
 * determinant of the scaled matrix. What is singular gives numbers that are not finite. */
static inline double mwi_bordered_solve(int w, double *A, double *b)
{
    double determinant = 1.0;
    for (int i = 0; i < w; i++) {
        double size = 0.0;
        for (int j = 0; j < w; j++) size = mwi_larger(size, mwi_abs(A[i * w + j]));
        for (int j = 0; j < w; j++) A[i * w + j] /= size;
        b[i] /= size;
    }
    for (int k = 0; k < w; k++) {
        int pivot = k;
        for (int i = k + 1; i < w; i++)
            if (mwi_abs(A[i * w + k]) > mwi_abs(A[pivot * w + k])) pivot = i;
        if (pivot != k) {
            for (int j = 0; j < w; j++) {
                const double keep = A[k * w + j];
                A[k * w + j] = A[pivot * w + j];
                A[pivot * w + j] = keep;
            }
            const double keep = b[k];
            b[k] = b[pivot];
            b[pivot] = keep;
            determinant = -determinant;
        }
        determinant *= A[k * w + k];
        for (int i = k + 1; i < w; i++) {
            const double factor = A[i * w + k] / A[k * w + k];
            for (int j = k; j < w; j++) A[i * w + j] -= factor * A[k * w + j];
            b[i] -= factor * b[k];
        }
    }
    for (int k = w - 1; k >= 0; k--) {
        for (int j = k + 1; j < w; j++) b[k] -= A[k * w + j] * b[j];
        b[k] /= A[k * w + k];
    }
    return determinant;
}

#endif
