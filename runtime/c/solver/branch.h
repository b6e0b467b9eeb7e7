/* Follow one branch of contact over the input angle.  SPDX-License-Identifier: MIT-0 */
#if !defined(MWI_BRANCH_H) && !defined(MW_DEVICE_ONLY)
#define MWI_BRANCH_H

#include "refine.h"
#include "arclength.h"
#include "steps.h"

enum { MWI_MAX_SPLITS = 12, MWI_ARC_STEPS = 32, MWI_ARC_PARTS = 16 };

/* The longest step of a walk, in natural sizes of the unknowns. Flanks change over one (a module, a radian), so a step of half
 * of one is predicted to a good part of it. */
static const double MWI_STRIDE = 0.5;

/* Newton from a good prediction takes two or three steps. One that needs more crosses a place where the equations are
 * nearly singular, and only there can it come out on another branch. */
static const int MWI_USUAL_ITERATIONS = 4;

/* A step in arclength, natural sizes and rad. ARC_PARTS times ARC_STEPS of them lead off any flank. */
static const double MWI_ARC_STEP = 0.1;

static const double MWI_NUDGE = 1e-3; /* rad */

/* The last points solved, newest first; x points to nx numbers each. */
typedef struct mwi_history {
    int count;
    const double *x[MW_HISTORY];
    double phi[MW_HISTORY];
} mwi_history;

static inline mwi_history mwi_no_history(void)
{
    mwi_history h;
    h.count = 0;
    for (int i = 0; i < MW_HISTORY; i++) h.x[i] = NULL, h.phi[i] = 0.0;
    return h;
}

static inline void mwi_remember(mwi_history *h, double phi, const double *x)
{
    for (int i = 0; i < MW_HISTORY; i++) { /* each moves on by one place */
        const double *older = h->x[i], before = h->phi[i];
        h->x[i] = x;
        h->phi[i] = phi;
        x = older;
        phi = before;
    }
    if (h->count < MW_HISTORY) h->count++;
}

/* Polynomial through the history, at phi. */
static inline void mwi_predict(const mwi_history *h, double phi, int n, double *x)
{
    double weight[MW_HISTORY];
    const double d = phi - h->phi[0];
    int uniform = h->count == MW_HISTORY;
    for (int i = 1; uniform && i < MW_HISTORY; i++)
        uniform = mwi_abs(h->phi[i - 1] - h->phi[i] - d) <= MW_EQUAL_SPACING * mwi_abs(d);
    if (uniform) {
        for (int j = 0; j < n; j++)
            x[j] = MW_PREDICT_CUBIC(h->x[0][j], h->x[1][j], h->x[2][j], h->x[3][j]);
        return;
    }
    for (int i = 0; i < h->count; i++) {
        weight[i] = 1.0;
        for (int k = 0; k < h->count; k++)
            if (k != i) weight[i] *= (phi - h->phi[k]) / (h->phi[i] - h->phi[k]);
    }
    for (int j = 0; j < n; j++) {
        x[j] = 0.0;
        for (int i = 0; i < h->count; i++) x[j] += weight[i] * h->x[i][j];
    }
}

static inline int mwi_bend(const mw_model *m, const double *s, const double *x)
{
    double o[MW_MAX_OBSERVATION];
    mw_contact c;
    mwi_contact_at(m, s, x, o, &c);
    return mwi_bend_of(&c);
}

/* Give a history of one point a second one close by, near[nx], on the side of phi, so that it has a direction: a point
 * alone predicts itself, and a pitch further on that is the contact of the neighbouring pair. */
static inline void mwi_take_direction(const mw_model *m, mwi_history *h, double phi, double *s, double *beside)
{
    mw_info info;
    const double next = h->phi[0] + (phi > h->phi[0] ? MWI_NUDGE : -MWI_NUDGE);
        mwi_copy(beside, h->x[0], m->nx);
    m->set_phi(s, next);
    if (mwi_refine(m, s, beside, &info) >= 0) mwi_remember(h, next, beside);
}

/* Two solutions on the way, newest first, and the sign of curvature of their branch. */
typedef struct mwi_way {
    mwi_history h;
    double x[2][MW_MAX_UNKNOWNS];
    int mwi_bend;
} mwi_way;

static inline void mwi_begin(const mw_model *m, const mwi_history *from, double *s, mwi_way *w)
{
    w->h = mwi_no_history();
    w->h.count = from->count > 1 ? 2 : 1;
    for (int i = 0; i < w->h.count; i++) {
        mwi_copy(w->x[i], from->x[i], m->nx);
        w->h.x[i] = w->x[i];
        w->h.phi[i] = from->phi[i];
    }
    m->set_phi(s, w->h.phi[0]);
    w->mwi_bend = mwi_bend(m, s, w->x[0]);
}

static inline void mwi_advance(const mw_model *m, mwi_way *w, double phi, const double *x)
{
    mwi_copy(w->x[1], w->x[0], m->nx);
    mwi_copy(w->x[0], x, m->nx);
    const double before = w->h.phi[0];
    w->h = mwi_no_history();
    mwi_remember(&w->h, before, w->x[1]);
    mwi_remember(&w->h, phi, w->x[0]);
}

/* One step to phi, to a solution of the same branch. */
static inline int mwi_stepped(const mw_model *m, const mwi_way *w, double phi, double *s, double *x, mw_info *info)
{
    double predicted[MW_MAX_UNKNOWNS];
    mwi_predict(&w->h, phi, m->nx, predicted);
    m->set_phi(s, phi);
    if (!mwi_near(m, s, predicted, w->x[0], MWI_STRIDE)) return 0;
    mwi_copy(x, predicted, m->nx);
    return mwi_refine(m, s, x, info) >= 0 && mwi_near(m, s, x, predicted, MWI_BRANCH_WIDTH) && mwi_bend(m, s, x) == w->mwi_bend;
}

/* Walk to phi in steps as small as the branch needs. Returns 0 where it takes too small ones. */
static inline int mwi_walked(const mw_model *m, mwi_way *w, double to, double *s, double *x, mw_info *info)
{
    double step = to - w->h.phi[0];
    const double smallest = (mwi_abs(step) < MWI_STRIDE ? mwi_abs(step) : MWI_STRIDE) / (double)(1 << MWI_MAX_SPLITS);
    while (mwi_abs(step) > smallest) {
        const double next = mwi_abs(to - w->h.phi[0]) <= 1.0001 * mwi_abs(step) ? to : w->h.phi[0] + step;
        if (!mwi_stepped(m, w, next, s, x, info)) {
            step *= 0.5;
            continue;
        }
        if (next == to) return 1;
        mwi_advance(m, w, next, x);
        step *= 2.0;
    }
    return 0;
}

/* Points of a stretch of branch in arclength. */
typedef struct mwi_arc {
    double phi[MWI_ARC_STEPS + 1], x[(MWI_ARC_STEPS + 1) * MW_MAX_UNKNOWNS], slope[MWI_ARC_STEPS + 1], determinant[MWI_ARC_STEPS + 1];
} mwi_arc;

/* Why the branch cannot be followed from x: the equations do not exist there, or nothing true can be said. */
static inline int mwi_stuck(const mw_model *m, double phi, double *s, double *x, mw_info *info)
{
    m->set_phi(s, phi);
    if (mwi_refine(m, s, x, info) >= 0) info->status = MW_DIVERGED;
    return info->status;
}

/* Follow the branch in arclength towards `to`, through places where the angle cannot lead. Where it arrives, x and info
 * are the solution; else info->status says what became of the branch. */
static inline int mwi_along_arc(const mw_model *m, const mwi_way *w, double to, double *s, double *x, mw_info *info)
{
    mwi_arc a;
    double from = w->h.phi[0];
    const double sign = to > from ? 1.0 : -1.0;
    const size_t nx = (size_t)m->nx;
    mwi_copy(x, w->x[0], m->nx);
    for (int part = 0; part < MWI_ARC_PARTS; part++) {
        const size_t n = mwi_arclength(m, s, from, x, sign * MWI_ARC_STEP, MWI_ARC_STEPS, a.phi, a.x, a.slope, a.determinant);
        for (size_t k = 1; k < n; k++) {
            if (!mwi_within_bounds(m, a.x + k * nx)) return info->status = MW_LEFT_FLANK;
            if (sign * a.slope[k] <= 0.0) return info->status = MW_FOLD;
            if (sign * (a.phi[k] - to) < 0.0) continue;
            const double share = (to - a.phi[k - 1]) / (a.phi[k] - a.phi[k - 1]);
            for (size_t i = 0; i < nx; i++)
                x[i] = a.x[(k - 1) * nx + i] + share * (a.x[k * nx + i] - a.x[(k - 1) * nx + i]);
            m->set_phi(s, to);
            return mwi_refine(m, s, x, info);
        }
        if (n < MWI_ARC_STEPS + 1) return mwi_stuck(m, from, s, x, info);
        from = a.phi[MWI_ARC_STEPS];
        mwi_copy(x, a.x + MWI_ARC_STEPS * nx, m->nx);
    }
    return info->status = MW_LEFT_FLANK;
}

/* Continue the branch of h to phi in one step: x[nx] and info. Returns 0 where that does not succeed. Beside a place where
 * the equations are singular the step may come out on another branch. */
static inline int mwi_leap(const mw_model *m, const mwi_history *h, double phi, double *s, double *x, mw_info *info)
{
    *info = mwi_ended(MW_CONVERGED, 0);
    m->set_phi(s, phi);
    mwi_predict(h, phi, m->nx, x);
    return mwi_near(m, s, x, h->x[0], MWI_STRIDE) && mwi_newton_fused(m, s, x, MW_FUSED_TOLERANCE, info) &&
           info->iterations <= MWI_USUAL_ITERATIONS && mwi_within_bounds(m, x);
}

/* Continue the branch of h to phi in steps as small as it needs: x[nx] and info. Negative, with the reason, if the branch
 * does not reach phi. s is set up; it is left at phi or on the way to it. */
static inline int mwi_walk(const mw_model *m, const mwi_history *h, double phi, double *s, double *x, mw_info *info)
{
    mwi_way w;
    *info = mwi_ended(MW_CONVERGED, 0);
    mwi_begin(m, h, s, &w);
    if (mwi_walked(m, &w, phi, s, x, info)) return info->status;
    return mwi_along_arc(m, &w, phi, s, x, info);
}

#endif
