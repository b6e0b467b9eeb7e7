/* Follow a line of contact at one angle.  SPDX-License-Identifier: MIT-0
 *
 * All along the line the Jacobian of the equations lacks one rank: the line's own direction is its right null vector. With
 * a row and a column that span both null spaces, nearly, the bordered matrix is regular (H. B. Keller, "Numerical solution
 * of bifurcation and nonlinear eigenvalue problems", 1977), and Newton's steps with it go straight across the line. */
#include "exact.h"
#include "meshwright.h"
#include "solver/linear.h"

enum { WIDTH = MW_MAX_UNKNOWNS + 1, MAX_CORRECTIONS = 12 };

/* In natural sizes: a step below the first is the last one; so is one after which, as quadratic convergence from steps
 * that grow shorter by the second has it, the next would be below. */
static const double SETTLED = 1e-12, FALLING = 1e-2;

/* Residual R[n] and Jacobian J[n*n] by unknowns in natural sizes at x. */
static void equations(const mw_model *m, const double *s, const double *scale, const double *x, double *R, double *J)
{
    m->eval(s, x, R, J);
    for (int i = 0; i < m->nx; i++)
        for (int j = 0; j < m->nx; j++) J[i * m->nx + j] *= scale[j];
}

/* The bordered matrix A[(n+1)*(n+1)] or its transpose. border[2*n]: row, then column. */
static void bordered(int n, const double *J, const double *border, int transposed, double *A)
{
    const int w = n + 1, down = transposed ? 1 : w, right = transposed ? w : 1;
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) A[i * down + j * right] = J[i * n + j];
        A[n * down + i * right] = border[i];
        A[i * down + n * right] = border[n + i];
    }
    A[n * w + n] = 0.0;
}

/* The unit vector in direction of the first n numbers that the bordered matrix takes to (0, ..., 0, 1). */
static void null_vector(int n, double *A, double *found)
{
    double b[WIDTH], length = 0.0;
    mwi_clear(b, n);
    b[n] = 1.0;
    mwi_bordered_solve(n + 1, A, b);
    for (int i = 0; i < n; i++) length += b[i] * b[i];
    for (int i = 0; i < n; i++) found[i] = b[i] / sqrt(length);
}

/* From x straight to the line. Nonzero if it settles there. */
static int corrected(const mw_model *m, const double *s, const double *scale, const double *border, double *x)
{
    double J[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], A[WIDTH * WIDTH], R[WIDTH], before = 0.0;
    for (int k = 0; k < MAX_CORRECTIONS; k++) {
        equations(m, s, scale, x, R, J);
        bordered(m->nx, J, border, 0, A);
        R[m->nx] = 0.0;
        mwi_bordered_solve(m->nx + 1, A, R);
        double size = 0.0;
        for (int i = 0; i < m->nx; i++) {
            x[i] -= R[i] * scale[i];
            if (!(mwi_abs(R[i]) <= size)) size = size == size ? mwi_abs(R[i]) : size;
        }
        if (!(size < HUGE_VAL)) return 0;
        if (size < SETTLED || (size < FALLING * before && size * (size / before) * (size / before) < SETTLED)) return 1;
        before = size;
    }
    return 0;
}

size_t mw_line(const mw_model *m, const double *s, double *border, double step, size_t count, double *x)
{
    if (!mwi_usable(m)) return 0;
    const int n = m->nx;
    double scale[MW_MAX_UNKNOWNS], J[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], A[WIDTH * WIDTH], R[MW_MAX_UNKNOWNS];
    double turned[2 * MW_MAX_UNKNOWNS];
    m->scale(s, scale);
    for (size_t k = 0;; k++, x += n) {
        if (!corrected(m, s, scale, border, x)) return k;
        equations(m, s, scale, x, R, J);
        for (int transposed = 0; transposed < 2; transposed++) {
            bordered(n, J, border, transposed, A);
            null_vector(n, A, turned + transposed * n);
        }
        mwi_copy(border, turned, 2 * n);
        if (k == count) return k + 1;
        for (int i = 0; i < n; i++) x[n + i] = x[i] + step * border[i] * scale[i];
    }
}
