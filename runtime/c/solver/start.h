/* The tangency in the middle of the flanks, from the model's start values.  SPDX-License-Identifier: MIT-0 */
#if !defined(MWI_START_H) && !defined(MW_DEVICE_ONLY)
#define MWI_START_H

#include "refine.h"

enum { MWI_MAX_ATTEMPTS = 100 };

/* Share of the misalignments below which no further step is tried; where only a contact is looked for, and not why there
 * is none: Newton's method takes a larger one wherever two tangencies do not meet nearby. */
static const double MWI_SMALLEST_STEP = 1e-8, MWI_SMALLEST_LOOK = 1.0 / 64.0;

/* Where two tangencies meet and vanish, the smallest pivot falls as the square root of the way left. A search that ends
 * within MWI_SMALLEST_STEP of such a place sees a pivot of 1e-4 of the aligned drive's; this share leaves room for its
 * factor, and a pivot that only varies with the geometry stays far above it. */
static const double MWI_SINGULAR_SHARE = 1e-2;

static inline int mwi_ended_well(int status)
{
    return status >= 0;
}

static inline int mwi_is_misalignment(const mw_model *m, int parameter)
{
    return mwi_same_text(m->parameters[parameter].table, "misalignment");
}

/* State for the share of the misalignments, 0 to 1. */
static inline int mwi_setup_share(const mw_model *m, const double *p, double share, double phi, double *s, double *work)
{
    for (int i = 0; i < m->np; i++) work[i] = mwi_is_misalignment(m, i) ? share * p[i] : p[i];
    const int guard = m->setup(work, s);
    m->set_phi(s, phi);
    return guard;
}

/* Start values x[nx] in the middle of the flanks, from the model's start system, or from its first guess where that has
 * no solution. State s is set up. Returns the status of the start system. */
static inline int mwi_start_values(const mw_model *m, const double *s, double *x, mw_info *info)
{
    double y[MW_MAX_UNKNOWNS], scale[MW_MAX_UNKNOWNS];
    *info = mwi_ended(MW_CONVERGED, 0);
    m->guess(s, y);
    m->start_scale(s, scale);
    if (m->nstart > 0 && !mwi_ended_well(mwi_newton(m->start_eval, m->nstart, s, scale, y, info))) m->guess(s, y);
    m->start_solution(s, y, x);
    return info->status;
}

static inline int mwi_from_middle(const mw_model *m, const double *s, double *x, mw_info *info)
{
    if (mwi_ended_well(mwi_start_values(m, s, x, info))) mwi_refine(m, s, x, info);
    return info->status;
}

/* Smallest over largest pivot at a solution. */
static inline double mwi_pivot_gap(const mw_model *m, const double *s, const double *x)
{
    double at[MW_MAX_UNKNOWNS], scale[MW_MAX_UNKNOWNS];
    mw_info info = mwi_ended(MW_CONVERGED, 0);
    for (int i = 0; i < m->nx; i++) at[i] = x[i];
    m->scale(s, scale);
    mwi_newton(m->eval, m->nx, s, scale, at, &info);
    return info.rank_gap;
}

/* Raise the misalignments from share `from` to 1, halving the step where Newton fails, down to `smallest`. Contact is
 * lost on the way if the equations become singular where the solutions end. */
static inline int mwi_raise_misalignments(const mw_model *m, const double *p, double phi, double from, double smallest,
                                          double *s, double *work, double *x, mw_info *info)
{
    double good[MW_MAX_UNKNOWNS];
    double share = from, step = 1.0 - from;
    const double regular = mwi_pivot_gap(m, s, x);
    for (int i = 0; i < m->nx; i++) good[i] = x[i];
    for (int attempt = 0; attempt < MWI_MAX_ATTEMPTS && step > smallest && share < 1.0; attempt++) {
        const double next = share + step < 1.0 ? share + step : 1.0;
        mwi_setup_share(m, p, next, phi, s, work);
        if (mwi_ended_well(mwi_refine(m, s, x, info))) {
            share = next;
            step *= 2.0;
            for (int i = 0; i < m->nx; i++) good[i] = x[i];
        } else {
            step *= 0.5;
            for (int i = 0; i < m->nx; i++) x[i] = good[i];
        }
    }
    if (share < 1.0 && mwi_ended_well(info->status)) info->status = MW_DIVERGED; /* no attempts left */
    if (share < 1.0 && info->status == MW_SINGULAR) info->status = MW_NO_CONTACT;
    if (share < 1.0 && info->status == MW_DIVERGED) {
        mwi_setup_share(m, p, share, phi, s, work);
        if (mwi_pivot_gap(m, s, good) <= MWI_SINGULAR_SHARE * regular) info->status = MW_NO_CONTACT;
    }
    return info->status;
}

/* The tangency that Newton reaches from the start values, misalignments applied by continuation where it must be, in
 * shares down to `smallest`; s is left set up for p and phi, work[np]. Returns info->status. */
static inline int mwi_start(const mw_model *m, const double *p, double phi, double smallest, double *s, double *work,
                            double *x, mw_info *info)
{
    *info = mwi_ended(MW_CONVERGED, 0);
    info->guard = mwi_setup_share(m, p, 1.0, phi, s, work);
    if (info->guard) return info->status = MW_BAD_INPUT;
    if (!mwi_ended_well(mwi_from_middle(m, s, x, info))) {
        mwi_setup_share(m, p, 0.0, phi, s, work);
        if (mwi_ended_well(mwi_from_middle(m, s, x, info)))
            mwi_raise_misalignments(m, p, phi, 0.0, smallest, s, work, x, info);
        mwi_setup_share(m, p, 1.0, phi, s, work);
    }
    return info->status;
}

#endif
