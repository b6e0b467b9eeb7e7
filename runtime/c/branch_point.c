/* Folds and crossings of branches of contact as solutions of extended systems.  SPDX-License-Identifier: MIT-0 */
#include "exact.h"
#include <math.h>
#include <string.h>
#include "solver/linear.h"
#include "meshwright.h"

enum { NX = MW_MAX_UNKNOWNS, NY = NX + 1, NZ = NY + NX + 1, MAX_STEPS = 30, POWER_STEPS = 20 };

static const double DONE = 1e-13, ENOUGH = 1e-10; /* steps, natural sizes and rad */
static const double NEARBY = 0.5;                 /* how far a singular point may lie from the start */
static const double ATTACHED = 1e-9;              /* share of the left null vector by which the residual is unfolded */
static const double SHIFT = 1e-12;

/* The residual in natural sizes y[n + 1] of the unknowns and the input angle, its rows scaled to slopes of size 1. */
typedef struct singular {
    const mw_model *m;
    double *s;
    int n, columns; /* unknowns; columns of the derivative that is singular */
    double scale[NY], row[NX];
} singular;

/* Residual R[n] and derivative A[n][n + 1] at y; x[n] receives the unknowns. */
static void derivative(const singular *e, const double *y, double *x, double *R, double A[NX][NY])
{
    const int n = e->n;
    double J[NX * NX], direction[NY] = { 0.0 }, by_angle[NX];
    for (int i = 0; i < n; i++) x[i] = y[i] * e->scale[i];
    direction[n] = 1.0;
    e->m->set_phi(e->s, y[n]);
    e->m->eval(e->s, x, R, J);
    e->m->along(e->s, y[n], x, direction, by_angle, NULL);
    for (int i = 0; i < n; i++) {
        R[i] *= e->row[i];
        for (int j = 0; j < n; j++) A[i][j] = J[i * n + j] * e->scale[j] * e->row[i];
        A[i][n] = by_angle[i] * e->row[i];
    }
}

/* Second derivative of psi . R along v. */
static double bent(const singular *e, const double *y, const double *x, const double *psi, const double *v)
{
    double direction[NY], first[NX], second[NX], total = 0.0;
    for (int i = 0; i <= e->n; i++) direction[i] = v[i] * e->scale[i];
    e->m->along(e->s, y[e->n], x, direction, first, second);
    for (int i = 0; i < e->n; i++) total += psi[i] * e->row[i] * second[i];
    return total;
}

/* Second derivatives H of psi . R by y: from those along the axes and along their sums. */
static void hessian(const singular *e, const double *y, const double *x, const double *psi, double H[NY][NY])
{
    const int w = e->n + 1;
    for (int j = 0; j < w; j++) {
        double v[NY] = { 0.0 };
        v[j] = 1.0;
        H[j][j] = bent(e, y, x, psi, v);
    }
    for (int j = 0; j < w; j++)
        for (int k = 0; k < j; k++) {
            double v[NY] = { 0.0 };
            v[j] = v[k] = 1.0;
            H[j][k] = H[k][j] = 0.5 * (bent(e, y, x, psi, v) - H[j][j] - H[k][k]);
        }
}

/* The left vector that A's columns see least: inverse iteration on A A^T. */
static void left_null(const singular *e, double A[NX][NY], double *psi)
{
    const int n = e->n;
    for (int i = 0; i < n; i++) psi[i] = 1.0 / (1.0 + i);
    for (int step = 0; step < POWER_STEPS; step++) {
        double B[NX * NX], length = 0.0;
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++) {
                B[i * n + j] = i == j ? SHIFT : 0.0;
                for (int k = 0; k < e->columns; k++) B[i * n + j] += A[i][k] * A[j][k];
            }
        mwi_bordered_solve(n, B, psi);
        for (int i = 0; i < n; i++) length += psi[i] * psi[i];
        for (int i = 0; i < n; i++) psi[i] /= sqrt(length);
    }
}

/* One Newton step of the extended system in z = (y, psi[, mu]):
 *   R(y) + mu psi = 0,   A(y)^T psi = 0 (its first columns),   (psi . psi - 1)/2 = 0.
 * mu, with which a crossing stays regular, is 0 at the solution. Returns the step's length in y. */
static double stepped(const singular *e, double *z)
{
    const int n = e->n, w = n + 1, unfolded = e->columns == w, size = w + n + unfolded;
    double *y = z, *psi = z + w, x[NX], R[NX], A[NX][NY], H[NY][NY], M[NZ * NZ], b[NZ], length = 0.0;
    const double mu = unfolded ? z[w + n] : 0.0;
    derivative(e, y, x, R, A);
    hessian(e, y, x, psi, H);
    memset(M, 0, sizeof M);
    memset(b, 0, sizeof b);
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < w; j++) M[i * size + j] = A[i][j];
        M[i * size + w + i] = mu;
        if (unfolded) M[i * size + w + n] = psi[i];
        b[i] = R[i] + mu * psi[i];
    }
    for (int k = 0; k < e->columns; k++) {
        const int row = n + k;
        for (int j = 0; j < w; j++) M[row * size + j] = H[k][j];
        for (int i = 0; i < n; i++) {
            M[row * size + w + i] = A[i][k];
            b[row] += A[i][k] * psi[i];
        }
    }
    const int last = n + e->columns;
    b[last] = -0.5;
    for (int i = 0; i < n; i++) {
        M[last * size + w + i] = psi[i];
        b[last] += 0.5 * psi[i] * psi[i];
    }
    mwi_bordered_solve(size, M, b);
    for (int i = 0; i < size; i++) z[i] -= b[i];
    for (int i = 0; i < w; i++) length += b[i] * b[i];
    return sqrt(length);
}

/* Divide the rows of the residual by their largest slope at y. */
static void scale_rows(singular *e, const double *y)
{
    double x[NX], R[NX], A[NX][NY];
    for (int i = 0; i < e->n; i++) e->row[i] = 1.0;
    derivative(e, y, x, R, A);
    for (int i = 0; i < e->n; i++) {
        double largest = 0.0;
        for (int j = 0; j <= e->n; j++) largest = fmax(largest, fabs(A[i][j]));
        e->row[i] = largest > 0.0 ? 1.0 / largest : 1.0;
    }
}

int mw_branch_point(const mw_model *m, double *s, int crossing, double *phi, double *x)
{
    double z[NZ] = { 0.0 }, start[NY], there[NX], R[NX], A[NX][NY], step = HUGE_VAL, away = 0.0;
    if (!mwi_usable(m) || !mwi_angle_in_range(*phi)) return MW_BAD_INPUT;
    singular e = { m, s, m->nx, crossing ? m->nx + 1 : m->nx, { 0.0 }, { 0.0 } };
    m->set_phi(s, *phi);
    m->scale(s, e.scale);
    e.scale[e.n] = 1.0;
    for (int i = 0; i < e.n; i++) z[i] = x[i] / e.scale[i];
    z[e.n] = *phi;
    memcpy(start, z, sizeof start);
    scale_rows(&e, z);
    derivative(&e, z, there, R, A);
    left_null(&e, A, z + e.n + 1);
    for (int k = 0; k < MAX_STEPS && step > DONE; k++) {
        const double before = step;
        step = stepped(&e, z);
        if (!(step < HUGE_VAL)) return MW_DIVERGED;
        if (before < ENOUGH && step >= 0.5 * before) break; /* round-off */
    }
    for (int i = 0; i <= e.n; i++) away = fmax(away, fabs(z[i] - start[i]));
    if (!(step < ENOUGH && away < NEARBY && fabs(z[e.n + 1 + e.n]) * crossing < ATTACHED)) return MW_DIVERGED;
    for (int i = 0; i < e.n; i++) x[i] = z[i] * e.scale[i];
    *phi = z[e.n];
    return MW_CONVERGED;
}
