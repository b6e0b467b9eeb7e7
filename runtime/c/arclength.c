/* Follow a branch of contact in arclength, through folds and past crossings.  SPDX-License-Identifier: MIT-0 */
#include <math.h>
#include <string.h>
#include "linear.h"
#include "meshwright.h"

enum { N = MW_MAX_UNKNOWNS + 1, MAX_CORRECTIONS = 15, MAX_SPLITS = 10 };

static const double DONE = 1e-12, ENOUGH = 1e-8;
static const double SMOOTH = 0.9;       /* cosine by which chord and tangent may turn on a step; past it lie other branches */

/* A point of the curve in natural sizes: the unknowns, then the input angle in rad. */
typedef struct curve {
    const mw_model *m;
    double *s;
    int n;
    double scale[N];
} curve;

static void unscaled(const curve *c, const double *y, double *x)
{
    for (int i = 0; i < c->n; i++) x[i] = y[i] * c->scale[i];
}

/* Residual R[n] and bordered matrix A[(n+1)*(n+1)]: dR/dy above the row `border`. */
static void equations(const curve *c, const double *y, const double *border, double *R, double *A)
{
    const int n = c->n, w = n + 1;
    double x[N], J[N * N], with_angle[N] = { 0.0 }, by_angle[N];
    unscaled(c, y, x);
    with_angle[n] = 1.0;
    c->m->set_phi(c->s, y[n]);
    c->m->eval(c->s, x, R, J);
    c->m->along(c->s, y[n], x, with_angle, by_angle, NULL);
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) A[i * w + j] = J[i * n + j] * c->scale[j];
        A[i * w + n] = by_angle[i];
    }
    memcpy(A + n * w, border, sizeof(double) * (size_t)w);
}

/* Unit tangent t[n+1] of the curve at y, on the side of `before`; returns the bordered determinant. */
static double tangent(const curve *c, const double *y, const double *before, double *t)
{
    const int w = c->n + 1;
    double R[N], A[N * N], length = 0.0;
    equations(c, y, before, R, A);
    memset(t, 0, sizeof(double) * N);
    t[c->n] = 1.0;
    mw_bordered_solve(w, A, t);
    for (int i = 0; i < w; i++) length += t[i] * t[i];
    for (int i = 0; i < w; i++) t[i] /= sqrt(length);
    equations(c, y, t, R, A);
    double unused[N] = { 0.0 };
    return mw_bordered_solve(w, A, unused);
}

/* Newton from y on the plane through it across t. Nonzero if it settles. */
static int correct(const curve *c, const double *t, double *y)
{
    const int w = c->n + 1;
    double R[N], A[N * N], previous = HUGE_VAL;
    for (int k = 0; k < MAX_CORRECTIONS; k++) {
        equations(c, y, t, R, A);
        R[c->n] = 0.0;
        mw_bordered_solve(w, A, R);
        double change = 0.0;
        for (int i = 0; i < w; i++) {
            y[i] -= R[i];
            change += R[i] * R[i];
        }
        change = sqrt(change);
        if (change < DONE) return 1;
        if (!(change < previous)) return previous < ENOUGH;
        previous = change;
    }
    return previous < ENOUGH;
}

/* From y one step of at most this length along the tangent `before`, shorter where the curve bends: y, the tangent t there
 * and the bordered determinant. Zero where no step succeeds. */
static int advance(const curve *c, const double *before, double length, double *y, double *t, double *determinant)
{
    for (int splits = 0; splits <= MAX_SPLITS; splits++, length *= 0.5) {
        double trial[N], chord = 0.0, turn = 0.0;
        for (int i = 0; i <= c->n; i++) trial[i] = y[i] + length * before[i];
        if (!correct(c, before, trial)) continue;
        for (int i = 0; i <= c->n; i++) chord += (trial[i] - y[i]) * (trial[i] - y[i]);
        if (!(length >= SMOOTH * sqrt(chord))) continue;
        *determinant = tangent(c, trial, before, t);
        for (int i = 0; i <= c->n; i++) turn += before[i] * t[i];
        if (!(turn >= SMOOTH)) continue;
        memcpy(y, trial, sizeof trial);
        return 1;
    }
    return 0;
}

size_t mw_arclength(const mw_model *m, double *s, double phi0, const double *x0, double step, size_t count, double *phi,
                    double *x, double *slope, double *determinant)
{
    curve c = { m, s, m->nx, { 0.0 } };
    double y[N], t[N], before[N] = { 0.0 };
    if (m->nx > MW_MAX_UNKNOWNS) return 0;
    m->scale(s, c.scale);
    for (int i = 0; i < c.n; i++) y[i] = x0[i] / c.scale[i];
    y[c.n] = phi0;
    before[c.n] = step > 0.0 ? 1.0 : -1.0;
    if (!correct(&c, before, y)) return 0;
    determinant[0] = tangent(&c, y, before, t);
    for (size_t k = 0;; k++) {
        unscaled(&c, y, x + k * (size_t)c.n);
        phi[k] = y[c.n];
        slope[k] = t[c.n];
        if (k == count || !(fabs(determinant[k]) < HUGE_VAL)) return k + 1;
        memcpy(before, t, sizeof t);
        if (!advance(&c, before, fabs(step), y, t, determinant + k + 1)) return k + 1;
    }
}
