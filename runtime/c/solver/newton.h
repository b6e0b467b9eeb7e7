/* Newton iterations on one system of equations.  SPDX-License-Identifier: MIT-0 */
#if !defined(MWI_NEWTON_H) && !defined(MW_DEVICE_ONLY)
#define MWI_NEWTON_H

#include "linear.h"
#include "steps.h"

/* Where the equations have no solution the residual goes up and down for ever: it must halve within PATIENCE iterations. */
enum { MWI_NEWTON_MAX_ITERATIONS = 60, MWI_NEWTON_MAX_HALVINGS = 5, MWI_NEWTON_PATIENCE = 8 };

/* Steps are in units of the unknowns' natural size. */
static const double MWI_NEWTON_STEP_DONE = 1e-9;      /* the next step would be about its square: below round-off */
static const double MWI_NEWTON_STEP_NOISE = 1e-4;     /* a stagnating step may be noise only below this */
static const double MWI_NEWTON_RANK_TOLERANCE = 1e-12;
static const double MWI_NEWTON_RESIDUAL_NOISE = 1e-10; /* largest |R| that round-off explains, relative to its own terms */

typedef void (*mwi_equations)(const double *s, const double *x, double *R, double *J);

static inline double mwi_largest(int n, const double *a)
{
    double most = 0.0;
    for (int i = 0; i < n; i++) {
        const double size = mwi_abs(a[i]);
        if (!(size <= most)) most = size; /* not-a-number wins */
        if (most != most) return most;
    }
    return most;
}

/* Residual in units of natural steps: rows divided by their largest scaled slope. */
static inline double mwi_merit(int n, const double *R, const double *J, const double *scale)
{
    double most = 0.0;
    for (int i = 0; i < n; i++) {
        double slope = 0.0;
        for (int j = 0; j < n; j++) {
            const double size = mwi_abs(J[i * n + j]) * scale[j];
            if (size > slope) slope = size;
        }
        const double size = mwi_abs(R[i]) / (slope > 0.0 ? slope : 1.0);
        if (!(size <= most)) most = size;
        if (most != most) return most;
    }
    return most;
}

static inline double mwi_scaled_step(int n, const double *step, const double *scale)
{
    double most = 0.0;
    for (int j = 0; j < n; j++) {
        const double size = mwi_abs(step[j]) / scale[j];
        if (!(size <= most)) most = size; /* not-a-number wins */
        if (most != most) return most;
    }
    return most;
}

static inline int mwi_finish(mw_info *info, int status)
{
    info->status = status;
    return status;
}

/* Newton with complete pivoting, limited steps and a rank decision. scale[n]: natural size of each unknown. */
static inline int mwi_newton(mwi_equations f, int n, const double *s, const double *scale, double *x, mw_info *info)
{
    double R[MW_MAX_UNKNOWNS], J[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS], A[MW_MAX_UNKNOWNS * MW_MAX_UNKNOWNS];
    double b[MW_MAX_UNKNOWNS], step[MW_MAX_UNKNOWNS], trial[MW_MAX_UNKNOWNS];
    double previous = HUGE_VAL, halved = HUGE_VAL;
    int since = 0;
    f(s, x, R, J);
    double error = mwi_merit(n, R, J, scale);
    for (info->iterations = 0; info->iterations < MWI_NEWTON_MAX_ITERATIONS; info->iterations++) {
        if (!(error < HUGE_VAL)) return mwi_finish(info, MW_LEFT_FLANK);
        if (error < 0.5 * halved) {
            halved = error;
            since = info->iterations;
        }
        for (int i = 0; i < n * n; i++) A[i] = J[i];
        for (int i = 0; i < n; i++) b[i] = R[i];
        const int rank = mwi_linear_solve(n, A, b, scale, MWI_NEWTON_RANK_TOLERANCE, step, &info->rank_gap);
        info->step = mwi_scaled_step(n, step, scale);
        info->residual = mwi_largest(n, R);
        if (rank < n && error < MWI_NEWTON_RESIDUAL_NOISE) return mwi_finish(info, MW_SINGULAR);
        if (info->step < MWI_NEWTON_STEP_DONE || (info->step < MWI_NEWTON_STEP_NOISE && info->step > 0.5 * previous && error < MWI_NEWTON_RESIDUAL_NOISE)) {
            for (int j = 0; j < n; j++) x[j] -= step[j];
            info->iterations++;
            return mwi_finish(info, rank < n ? MW_SINGULAR : info->step < MWI_NEWTON_STEP_DONE ? MW_CONVERGED : MW_CONVERGED_NOISE);
        }
        if (info->iterations - since > MWI_NEWTON_PATIENCE) break;
        previous = info->step;
        double factor = info->step > MW_STEP_LIMIT ? MW_STEP_LIMIT / info->step : 1.0;
        double after = HUGE_VAL;
        for (int h = 0; h <= MWI_NEWTON_MAX_HALVINGS; h++, factor *= 0.5) {
            for (int j = 0; j < n; j++) trial[j] = x[j] - factor * step[j];
            f(s, trial, R, J);
            after = mwi_merit(n, R, J, scale);
            if (after < error || (h == MWI_NEWTON_MAX_HALVINGS && after < HUGE_VAL)) break;
        }
        for (int j = 0; j < n; j++) x[j] = trial[j];
        error = after;
    }
    return mwi_finish(info, info->rank_gap < 1e-8 ? MW_NO_CONTACT : MW_DIVERGED);
}

/* Newton by the model's fused step: the fast way near a solution. Returns 0 if it should be done again by
 * mwi_newton, 1 if info holds the answer. */
static inline int mwi_newton_fused(const mw_model *m, const double *s, double *x, double tolerance, mw_info *info)
{
    double previous = HUGE_VAL;
    for (info->iterations = 1; info->iterations <= MW_MAX_FUSED; info->iterations++) {
        info->step = m->step(s, x);
        if (info->step < tolerance) {
            info->status = MW_CONVERGED;
            return 1;
        }
        if (!(info->step < 0.5 * previous) || info->step > MW_STEP_LIMIT) return 0;
        previous = info->step;
    }
    return 0;
}

#endif
