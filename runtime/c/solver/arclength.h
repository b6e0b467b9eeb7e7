/* Follow a branch of contact in arclength, through folds and past crossings.  SPDX-License-Identifier: MIT-0 */
#if !defined(MWI_ARCLENGTH_H) && !defined(MW_DEVICE_ONLY)
#define MWI_ARCLENGTH_H

#include "linear.h"

enum { MWI_ARC_N = MW_MAX_UNKNOWNS + 1, MWI_ARC_MAX_CORRECTIONS = 15, MWI_ARC_MAX_SPLITS = 10 };

static const double MWI_ARC_DONE = 1e-12, MWI_ARC_ENOUGH = 1e-8;
static const double MWI_ARC_SMOOTH = 0.9;       /* cosine by which chord and tangent may turn on a step; past it lie other branches */

/* A point of the curve in natural sizes: the unknowns, then the input angle in rad. */
typedef struct mwi_arc_curve {
    const mw_model *m;
    double *s;
    int n;
    double scale[MWI_ARC_N];
} mwi_arc_curve;

static inline void mwi_arc_unscaled(const mwi_arc_curve *c, const double *y, double *x)
{
    for (int i = 0; i < c->n; i++) x[i] = y[i] * c->scale[i];
}

/* Residual R[n] and bordered matrix A[(n+1)*(n+1)]: dR/dy above the row `border`. */
static inline void mwi_arc_equations(const mwi_arc_curve *c, const double *y, const double *border, double *R, double *A)
{
    const int n = c->n, w = n + 1;
    double x[MWI_ARC_N], J[MWI_ARC_N * MWI_ARC_N], with_angle[MWI_ARC_N], by_angle[MWI_ARC_N];
    mwi_arc_unscaled(c, y, x);
    mwi_clear(with_angle, MWI_ARC_N);
    with_angle[n] = 1.0;
    c->m->set_phi(c->s, y[n]);
    c->m->eval(c->s, x, R, J);
    c->m->along(c->s, y[n], x, with_angle, by_angle, NULL);
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) A[i * w + j] = J[i * n + j] * c->scale[j];
        A[i * w + n] = by_angle[i];
    }
    mwi_copy(A + n * w, border, w);
}

/* Unit tangent t[n+1] of the curve at y, on the side of `before`; returns the bordered determinant. */
static inline double mwi_arc_tangent(const mwi_arc_curve *c, const double *y, const double *before, double *t)
{
    const int w = c->n + 1;
    double R[MWI_ARC_N], A[MWI_ARC_N * MWI_ARC_N], length = 0.0;
    mwi_arc_equations(c, y, before, R, A);
    mwi_clear(t, MWI_ARC_N);
    t[c->n] = 1.0;
    mwi_bordered_solve(w, A, t);
    for (int i = 0; i < w; i++) length += t[i] * t[i];
    for (int i = 0; i < w; i++) t[i] /= sqrt(length);
    mwi_arc_equations(c, y, t, R, A);
    double unused[MWI_ARC_N];
    mwi_clear(unused, MWI_ARC_N);
    return mwi_bordered_solve(w, A, unused);
}

/* Newton from y on the plane through it across t. Nonzero if it settles. */
static inline int mwi_arc_correct(const mwi_arc_curve *c, const double *t, double *y)
{
    const int w = c->n + 1;
    double R[MWI_ARC_N], A[MWI_ARC_N * MWI_ARC_N], previous = HUGE_VAL;
    for (int k = 0; k < MWI_ARC_MAX_CORRECTIONS; k++) {
        mwi_arc_equations(c, y, t, R, A);
        R[c->n] = 0.0;
        mwi_bordered_solve(w, A, R);
        double change = 0.0;
        for (int i = 0; i < w; i++) {
            y[i] -= R[i];
            change += R[i] * R[i];
        }
        change = sqrt(change);
        if (change < MWI_ARC_DONE) return 1;
        if (!(change < previous)) return previous < MWI_ARC_ENOUGH;
        previous = change;
    }
    return previous < MWI_ARC_ENOUGH;
}

/* From y one step of at most this length along the tangent `before`, shorter where the curve bends: y, the tangent t there
 * and the bordered determinant. Zero where no step succeeds. */
static inline int mwi_arc_advance(const mwi_arc_curve *c, const double *before, double length, double *y, double *t, double *determinant)
{
    for (int splits = 0; splits <= MWI_ARC_MAX_SPLITS; splits++, length *= 0.5) {
        double trial[MWI_ARC_N], chord = 0.0, turn = 0.0;
        for (int i = 0; i <= c->n; i++) trial[i] = y[i] + length * before[i];
        if (!mwi_arc_correct(c, before, trial)) continue;
        for (int i = 0; i <= c->n; i++) chord += (trial[i] - y[i]) * (trial[i] - y[i]);
        if (!(length >= MWI_ARC_SMOOTH * sqrt(chord))) continue;
        *determinant = mwi_arc_tangent(c, trial, before, t);
        for (int i = 0; i <= c->n; i++) turn += before[i] * t[i];
        if (!(turn >= MWI_ARC_SMOOTH)) continue;
        mwi_copy(y, trial, c->n + 1);
        return 1;
    }
    return 0;
}

static inline size_t mwi_arclength(const mw_model *m, double *s, double phi0, const double *x0, double step, size_t count, double *phi,
                    double *x, double *slope, double *determinant)
{
    mwi_arc_curve c;
    double y[MWI_ARC_N], t[MWI_ARC_N], before[MWI_ARC_N];
    c.m = m, c.s = s, c.n = m->nx;
    mwi_clear(before, MWI_ARC_N);
    m->scale(s, c.scale);
    for (int i = 0; i < c.n; i++) y[i] = x0[i] / c.scale[i];
    y[c.n] = phi0;
    before[c.n] = step > 0.0 ? 1.0 : -1.0;
    if (!mwi_arc_correct(&c, before, y)) return 0;
    determinant[0] = mwi_arc_tangent(&c, y, before, t);
    for (size_t k = 0;; k++) {
        mwi_arc_unscaled(&c, y, x + k * (size_t)c.n);
        phi[k] = y[c.n];
        slope[k] = t[c.n];
        if (k == count || !(mwi_abs(determinant[k]) < HUGE_VAL)) return k + 1;
        mwi_copy(before, t, MWI_ARC_N);
        if (!mwi_arc_advance(&c, before, mwi_abs(step), y, t, determinant + k + 1)) return k + 1;
    }
}

#endif
