/* The tangency in the middle of the flanks, from the model's start values.  SPDX-License-Identifier: MIT-0 */
#include <string.h>
#include "choice.h"
#include "newton.h"

enum { MAX_ATTEMPTS = 100 };

/* Share of the misalignments below which no further step is tried. */
static const double SMALLEST_STEP = 1e-8;

/* Where two tangencies meet and vanish, the smallest pivot falls as the square root of the way left. A search that ends
 * within SMALLEST_STEP of such a place sees a pivot of 1e-4 of the aligned drive's; this share leaves room for its
 * factor, and a pivot that only varies with the geometry stays far above it. */
static const double SINGULAR_SHARE = 1e-2;

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

int mw_start_values(const mw_model *m, const double *s, double *x, mw_info *info)
{
    double y[MW_MAX_UNKNOWNS], scale[MW_MAX_UNKNOWNS];
    memset(info, 0, sizeof *info);
    m->guess(s, y);
    m->start_scale(s, scale);
    if (m->nstart > 0 && !ended_well(mw_newton(m->start_eval, m->nstart, s, scale, y, info))) m->guess(s, y);
    m->start_solution(s, y, x);
    return info->status;
}

static int from_middle(const mw_model *m, const double *s, double *x, mw_info *info)
{
    if (ended_well(mw_start_values(m, s, x, info))) mw_refine(m, s, x, info);
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
static int raise_misalignments(const mw_model *m, const double *p, double phi, double from, double *s, double *work,
                               double *x, mw_info *info)
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
    if (share < 1.0 && ended_well(info->status)) info->status = MW_DIVERGED; /* no attempts left */
    if (share < 1.0 && info->status == MW_SINGULAR) info->status = MW_NO_CONTACT;
    if (share < 1.0 && info->status == MW_DIVERGED) {
        setup_share(m, p, share, phi, s, work);
        if (pivot_gap(m, s, good) <= SINGULAR_SHARE * regular) info->status = MW_NO_CONTACT;
    }
    return info->status;
}

int mw_start(const mw_model *m, const double *p, double phi, double *s, double *work, double *x, mw_info *info)
{
    memset(info, 0, sizeof *info);
    info->guard = setup_share(m, p, 1.0, phi, s, work);
    if (info->guard) return info->status = MW_BAD_INPUT;
    if (!ended_well(from_middle(m, s, x, info))) {
        setup_share(m, p, 0.0, phi, s, work);
        if (ended_well(from_middle(m, s, x, info))) raise_misalignments(m, p, phi, 0.0, s, work, x, info);
        setup_share(m, p, 1.0, phi, s, work);
    }
    return info->status;
}
