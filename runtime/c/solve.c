/* One contact point from a cold start.  SPDX-License-Identifier: MIT-0 */
#include <string.h>
#include "newton.h"
#include "refine.h"

enum { MAX_ATTEMPTS = 100 };

static const double SMALLEST_STEP = 1e-8;   /* share of the misalignments */
static const double SINGULAR_SHARE = 1e-2;  /* of the aligned drive's: a pivot falls as the root of the way left */

static int ended_well(int status)
{
    return status >= 0;
}

static int is_misalignment(const mw_model *m, int parameter)
{
    return strcmp(m->parameters[parameter].table, "misalignment") == 0;
}

/* State for the share of the misalignments, 0 to 1. */
static int setup_share(const mw_model *m, const double *p, double share, double phi, double *s, double *work)
{
    for (int i = 0; i < m->np; i++) work[i] = is_misalignment(m, i) ? share * p[i] : p[i];
    const int guard = m->setup(work, s);
    m->set_phi(s, phi);
    return guard;
}

/* Start values x from the model's start system, or from its first guess where it has no solution. */
static int start_values(const mw_model *m, const double *s, double *x, mw_info *info)
{
    double y[MW_MAX_UNKNOWNS], scale[MW_MAX_UNKNOWNS];
    memset(info, 0, sizeof *info);
    m->guess(s, y);
    m->start_scale(s, scale);
    if (m->nstart > 0 && !ended_well(mw_newton(m->start_eval, m->nstart, s, scale, y, info))) m->guess(s, y);
    m->start_solution(s, y, x);
    return info->status;
}

static int start(const mw_model *m, const double *s, double *x, mw_info *info)
{
    if (ended_well(start_values(m, s, x, info))) mw_refine(m, s, x, info);
    return info->status;
}

/* Smallest over largest pivot at a solution. */
static double pivot_gap(const mw_model *m, const double *s, const double *x)
{
    double at[MW_MAX_UNKNOWNS], scale[MW_MAX_UNKNOWNS];
    mw_info info = { 0 };
    for (int i = 0; i < m->nx; i++) at[i] = x[i];
    m->scale(s, scale);
    mw_newton(m->eval, m->nx, s, scale, at, &info);
    return info.rank_gap;
}

/* Raise the misalignments from share `from` to 1, halving the step where Newton fails. Contact is lost on the way if
 * the equations become singular where the solutions end. */
static int raise(const mw_model *m, const double *p, double phi, double from, double *s, double *work, double *x,
                 mw_info *info)
{
    double good[MW_MAX_UNKNOWNS];
    double share = from, step = 1.0 - from;
    const double regular = pivot_gap(m, s, x);
    for (int i = 0; i < m->nx; i++) good[i] = x[i];
    for (int attempt = 0; attempt < MAX_ATTEMPTS && step > SMALLEST_STEP && share < 1.0; attempt++) {
        const double next = share + step < 1.0 ? share + step : 1.0;
        setup_share(m, p, next, phi, s, work);
        if (ended_well(mw_refine(m, s, x, info))) {
            share = next;
            step *= 2.0;
            for (int i = 0; i < m->nx; i++) good[i] = x[i];
        } else {
            step *= 0.5;
            for (int i = 0; i < m->nx; i++) x[i] = good[i];
        }
    }
    if (share < 1.0 && info->status == MW_DIVERGED) {
        setup_share(m, p, share, phi, s, work);
        if (pivot_gap(m, s, good) <= SINGULAR_SHARE * regular) info->status = MW_NO_CONTACT;
    }
    return info->status;
}

int mw_solve(const mw_model *m, const double *p, double phi, double *s, double *work, double *x, mw_info *info)
{
    double near[MW_MAX_UNKNOWNS];
    mw_info started;
    memset(info, 0, sizeof *info);
    info->guard = setup_share(m, p, 1.0, phi, s, work);
    if (info->guard) return info->status = MW_BAD_INPUT;
    if (!ended_well(start(m, s, x, info))) {
        setup_share(m, p, 0.0, phi, s, work);
        if (ended_well(start(m, s, x, info))) raise(m, p, phi, 0.0, s, work, x, info);
        setup_share(m, p, 1.0, phi, s, work);
    }
    start_values(m, s, near, &started);
    mw_search(m, s, near, x, info);
    return info->status;
}
